// In place of `glint farm` in a module of WebAssembly: a page starts no jobs on other machines, and its
// scripts are a fiftieth of all that a browser would fetch.
#include "cli/cli.h"

int cmd_farm(struct cli *cli) {
    const int status = cli_usage(cli, 1, "a module of WebAssembly does not write scripts for other machines");
    diag_help(&cli->sink, "'glint farm' of the installed glint does: docs/install.md");
    return status;
}
