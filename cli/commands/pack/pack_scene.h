// Puts a scene with all its files into a folder or archive, for other commands that pack one too.
//
// Thread safety: as cli.h.
#ifndef GLINT_CLI_COMMANDS_PACK_PACK_SCENE_H
#define GLINT_CLI_COMMANDS_PACK_PACK_SCENE_H

#include "cli/cli.h"

// An exit code. *packed (may be NULL) is the scene's name in the package, in cli->arena.
int pack_scene(struct cli *cli, const char *scene, const char *out, const char **packed);

#endif
