// glint lsp: the language server, over standard input and output.
#include "cli/cli.h"

#include "lsp/server.h"

#include <unistd.h>

int cmd_lsp(struct cli *cli) {
    struct session_options settings = cli_session_options(cli, NULL);
    return lsp_serve(STDIN_FILENO, STDOUT_FILENO, GLINT_VERSION, &settings);
}
