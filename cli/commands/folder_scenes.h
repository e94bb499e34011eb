// The scenes in folders that operands name, for the commands that take folders.
#ifndef GLINT_CLI_COMMANDS_FOLDER_SCENES_H
#define GLINT_CLI_COMMANDS_FOLDER_SCENES_H

#include "cli/cli.h"
#include "load/scope/scene_names.h"

// Adds those of a folder. CLI_OK, or CLI_FILE with an error printed.
int cli_find_scenes(struct cli *cli, const char *folder, struct scene_names *names);
// Reports that a place has no scene, with the names that may be meant: CLI_USAGE.
int cli_no_scene(struct cli *cli, int arg, const char *where, const struct scene_names *names);
// Warns of files that begin as scenes do, which none of these scenes reads. For commands that have no
// sessions of them.
void cli_tell_others(struct cli *cli, struct scene_names *names);

#endif
