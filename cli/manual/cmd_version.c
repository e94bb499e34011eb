// glint --version.
#include "cli/about/about.h"
#include "cli/cli.h"

int cmd_version(struct cli *cli) {
    struct strbuf text;
    strbuf_init(&text);
    about_program(GLINT_VERSION, GLINT_DEVICE, &text);
    const int status = cli_print(cli, strbuf_view(&text));
    strbuf_finish(&text);
    return status;
}
