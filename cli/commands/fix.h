// `glint check --fix`: makes the changes that findings propose. Thread safety: one thread.
#ifndef GLINT_CLI_COMMANDS_FIX_H
#define GLINT_CLI_COMMANDS_FIX_H

#include "cli/cli.h"
#include "load/session.h"

// Repairs the scene of `options` and the files that it includes, as --fix says: writes them, or with --diff
// appends a patch. Returns an exit code.
int cli_fix(struct cli *cli, const struct session_options *options, struct asset_store *store,
            struct strbuf *patch);

#endif
