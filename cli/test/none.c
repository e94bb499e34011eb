// In place of `glint test` in a module of WebAssembly: pictures of a folder are rendered by the installed
// glint, and what renders and reports them is a part of what a browser would fetch.
#include "cli/cli.h"

int cmd_test(struct cli *cli) {
    const int status = cli_usage(cli, 1, "a module of WebAssembly does not test folders of pictures");
    diag_help(&cli->sink, "'glint test' of the installed glint does: docs/install.md");
    return status;
}
