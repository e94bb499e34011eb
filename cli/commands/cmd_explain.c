// glint explain CODE|element[.attribute], or --list.
#include "cli/commands/commands.h"

#include "grammar/emit/explain.h"

#include <unistd.h>

int cmd_explain(struct cli *cli) {
    struct strbuf text;
    bool color = cli_has_color(cli, STDOUT_FILENO);
    strbuf_init(&text);
    int status = CLI_OK;
    if (cli->options.list) {
        str family = cli->operand_count ? str_from(cli->operands[0]) : STR("");
        if (explain_codes(family, &text))
            status = cli_print(cli, strbuf_view(&text));
        else
            status = cli_usage(cli, cli_operand_place(cli, 0), "%.*s", STR_ARG(strbuf_view(&text)));
    } else if (cli->operand_count == 0) {
        status = cli_usage(cli, 1, "'glint explain' needs CODE|ELEMENT[.ATTRIBUTE]");
        diag_help(&cli->sink, "'glint explain --list' lists the codes, 'glint explain scene' the elements");
    } else if (explain(str_from(cli->operands[0]), color, &text))
        status = cli_print(cli, strbuf_view(&text));
    else
        status = cli_usage(cli, cli_operand_place(cli, 0), "%.*s", STR_ARG(str_trim(strbuf_view(&text))));
    strbuf_finish(&text);
    return status;
}
