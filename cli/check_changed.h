// What `glint check --changed [REV] [FILE|FOLDER...]` asks for: which files changed, and where scenes are
// looked for.
//
// Ownership: in the command line's arena. Errors: in cli->sink. Thread safety: one thread.
#ifndef GLINT_CLI_CHECK_CHANGED_H
#define GLINT_CLI_CHECK_CHANGED_H

#include "app/changed.h"
#include "cli/cli.h"

struct check_changed {
    struct changed changed;
    struct cli_list folders; // to look in
    bool named_folders;      // they were named; else it is the root
    struct cli_list scenes;  // files that were named, and that may be scenes
};

// Reads the operands: folders are looked in, files changed, and so did all that git says, if a revision is
// named or no file is. false: the mistake is in cli->sink.
bool check_changed_read(struct cli *cli, struct check_changed *out);

#endif
