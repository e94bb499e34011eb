// In place of `glint verify` in a module of WebAssembly: what has been rendered is on a disk, beside the
// installed glint.
#include "cli/cli.h"

int cmd_verify(struct cli *cli) {
    const int status = cli_usage(cli, 1, "a module of WebAssembly does not render pictures again");
    diag_help(&cli->sink, "'glint verify' of the installed glint does: docs/install.md");
    return status;
}
