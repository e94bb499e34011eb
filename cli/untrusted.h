// --untrusted: what a command may still do with files from unknown sources.
//
// Before it looks at them, the process gives up all rights but reading below the folders of its operands and
// writing where its options say (files/sandbox.h). Thread safety: as cli.h.
#ifndef GLINT_CLI_UNTRUSTED_H
#define GLINT_CLI_UNTRUSTED_H

#include "cli/cli.h"

// Does nothing without the option. `searched`: a folder that no operand names; NULL: none. CLI_OK, or an exit
// code with the mistake in cli->sink.
int cli_enter_untrusted(struct cli *cli, const struct cli_command *command, const char *searched);
// The same for git, which is asked before: its repository is trusted no more than its files.
void cli_distrust_git(const struct cli *cli);
// Adds the root below which a folder's contents may name files: the folder of the nearest .glintrc.yaml, else
// the work tree of git, else the folder itself.
void cli_add_root(struct files *files, str folder);

#endif
