// In place of many pictures and films in a module of WebAssembly: a page shows one, and these are a thirtieth
// of all that a browser would fetch.
#include "cli/cli.h"

int cmd_batch(struct cli *cli) {
    const int status = cli_usage(cli, 1, "a module of WebAssembly renders one picture, and no films");
    diag_help(&cli->sink, "'glint render' of the installed glint renders many: docs/films.md");
    return status;
}
