// In place of `glint manual` in a module of WebAssembly: pages and completions are installed beside the
// program.
#include "cli/cli.h"

int cmd_manual(struct cli *cli) {
    const int status = cli_usage(cli, 1, "a module of WebAssembly has no pages and completions to install");
    diag_help(&cli->sink, "'glint manual' of the installed glint does: docs/install.md");
    return status;
}
