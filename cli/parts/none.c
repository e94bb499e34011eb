// In place of `glint merge` in a module of WebAssembly: what has been rendered is on a disk, beside the
// installed glint.
#include "cli/cli.h"

int cmd_merge(struct cli *cli) {
    const int status = cli_usage(cli, 1, "a module of WebAssembly does not join parts of pictures");
    diag_help(&cli->sink, "'glint merge' of the installed glint does: docs/install.md");
    return status;
}
