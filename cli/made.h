// Where outputs go: to the name that the user has typed, or to one that glint has made.
//
// What the user typed may be a link, wherever it leads. A name that glint makes from it (for a camera, a
// frame, a layer, a plan), or from the scene's name, may have been taken by whoever filled the folder: it is
// written below the folder that was typed, over a regular file or nothing. Such names are judged before the
// work begins, so a refusal costs nothing. What was judged is what is written, because links are no longer
// followed (door.h). All outputs of commands are opened here; a name that is neither typed nor judged is
// written, but not through a link. Thread safety: names are judged by one thread before others open them.
#ifndef GLINT_CLI_MADE_H
#define GLINT_CLI_MADE_H

#include "cli/cli.h"
#include "files/output.h"

// `path` is made from `typed`, and must stay in its folder as far as both begin alike. `typed` "": the name
// has nothing of what was typed, and must stay in the current folder. If both are the same, the name is
// typed; "-" is standard output. `path` must live as long as `cli`. CLI_OK, or CLI_REFUSED with an error
// printed.
int cli_judge_made(struct cli *cli, const char *typed, const char *path);
// The same for a folder that glint, or a script of it, makes or uses.
int cli_judge_made_folder(struct cli *cli, const char *typed, const char *path);

// As output_open. Prints nothing.
bool cli_open_output(const struct cli *cli, struct output *output, const char *path);
// As output_whole.
int cli_put_output(const struct cli *cli, const char *path, str bytes);

// What judging a path found: where it is written. Private to the two files of this header.
struct made_name {
    const char *folder; // links resolved; NULL: it was not there
    const char *path;   // the path that contains the name
};
void cli_keep_made(struct cli *cli, const char *path, struct made_name name);
// A folder that was typed, links resolved; empty: it is not there.
str cli_made_folder(struct cli *cli, str typed);

#endif
