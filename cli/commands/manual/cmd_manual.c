// glint manual: man pages and completions, from the tables of commands and options.
#include "cli/about/about.h"
#include "cli/commands/commands.h"
#include "cli/commands/manual/manual.h"
#include "core/nearest.h"

#include <string.h>

static const struct cli_command *find(const struct cli_command *commands, const char *name) {
    for (const struct cli_command *c = commands; c->name; c++)
        if (strcmp(c->name, name) == 0)
            return c;
    return NULL;
}

// The index of the first operand; -1, with the mistake reported.
static int kind_of(struct cli *cli, const char *const *kinds) {
    struct nearest search = nearest_begin(str_from(cli->operands[0]));
    for (int i = 0; kinds[i]; i++) {
        if (strcmp(cli->operands[0], kinds[i]) == 0)
            return i;
        nearest_offer(&search, str_from(kinds[i]));
    }
    cli_usage(cli, cli_operand_place(cli, 0), "there is no manual '%s'; write page, bash, zsh or fish",
              cli->operands[0]);
    cli_did_you_mean(cli, &search, NULL);
    return -1;
}

int cmd_manual(struct cli *cli) {
    static const char *const kinds[] = {"page", "bash", "zsh", "fish", NULL};
    const int kind = kind_of(cli, kinds);
    const char *name = cli->operand_count > 1 ? cli->operands[1] : NULL;
    if (kind < 0)
        return CLI_USAGE;
    if (name && kind > 0)
        return cli_usage(cli, cli_operand_place(cli, 1), "completions are those of all commands");
    const struct manual manual = {.version = GLINT_VERSION,
                                  .date = about_date,
                                  .purpose = cli_purpose,
                                  .exits = cli_exits,
                                  .commands = cli->commands};
    const struct cli_command *command = name ? find(cli->commands, name) : NULL;
    if (name && !command)
        return cli_usage(cli, cli_operand_place(cli, 1), "there is no command '%s'", name);
    struct strbuf text;
    strbuf_init(&text);
    if (kind == 0)
        manual_page(&manual, command, &text);
    else
        (kind == 1 ? manual_bash : kind == 2 ? manual_zsh : manual_fish)(&manual, &text);
    const int status = cli_print(cli, strbuf_view(&text));
    strbuf_finish(&text);
    return status;
}
