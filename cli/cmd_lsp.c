// glint lsp: the language server, over standard input and output.
#include "cli/cli.h"

#include "lsp/server.h"

#include <string.h>
#include <unistd.h>

int cmd_lsp(struct cli *cli) {
    struct lsp_fault fault;
    struct session_options settings = cli_session_options(cli, NULL);
    int status = lsp_serve(STDIN_FILENO, STDOUT_FILENO, GLINT_VERSION, &settings, &fault);
    if (!fault.error)
        return status;
    cli_error(cli, fault.is_input ? DIAG_FILE_UNREADABLE : DIAG_OUTPUT,
              fault.is_input ? "standard input" : "standard output", NULL, "cannot be %s: %s",
              fault.is_input ? "read" : "written", strerror(fault.error));
    return CLI_FILE;
}
