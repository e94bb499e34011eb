// A part of a picture while it is rendered: aimed at, and what its file says. For who renders parts: one
// picture (render_part.c), or many (cli/batch).
//
// Thread safety: part_aim is for the gpu's thread; part_describe as cli.h.
#ifndef GLINT_CLI_COMMANDS_PARTS_PART_MADE_H
#define GLINT_CLI_COMMANDS_PARTS_PART_MADE_H

#include "cli/cli.h"
#include "render/parts/part_file.h"
#include "render/shot.h"

// Has a shot of the whole picture render the part, whose size, region and samples are known. false: see
// gpu_error.
bool part_aim(struct shot *shot, const struct part *part);
// What the part's file says of how it was made, by the shot that made it.
void part_describe(struct cli *cli, const struct shot *shot, uint32_t camera, struct part *part);

#endif
