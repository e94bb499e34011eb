// Where outputs go: to the name that the user has typed, or to one that glint has made.
//
// What the user typed may be a link: where it leads is his business. A name that glint makes of it (of a
// camera, a frame, a layer, a plan), or of the scene's name, may have been taken by whoever filled the
// folder: it is written beneath the folder that was typed, over a regular file or nothing. Such names are
// judged before the work begins, so that a refusal costs nothing, and what was judged is what is written, as
// links are not followed any more (door.h). All outputs of commands are opened here, and a name that is
// neither typed nor judged is written, but through no link. Thread safety: names are judged by one thread
// before others open them.
#ifndef GLINT_CLI_MADE_H
#define GLINT_CLI_MADE_H

#include "cli/cli.h"
#include "files/output.h"

// `path` is made of `typed`, whose folder it is held to as far as both begin alike; "" for a name that has
// nothing of what was typed, in the current folder. Names that are the same are typed; "-" is standard
// output. `path` must live as long as `cli`. CLI_OK, or CLI_REFUSED with an error printed.
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
    const char *path;   // that has the name in it
};
void cli_keep_made(struct cli *cli, const char *path, struct made_name name);
// A folder that was typed, links resolved; empty: it is not there.
str cli_made_folder(struct cli *cli, str typed);

#endif
