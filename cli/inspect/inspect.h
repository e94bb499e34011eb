// glint inspect of a picture: what its file says of how it was made.
//
// Thread safety: as cli.h.
#ifndef GLINT_CLI_INSPECT_INSPECT_H
#define GLINT_CLI_INSPECT_INSPECT_H

#include "cli/cli.h"

// Whether the path ends as a picture does, whatever its case.
bool inspect_is_picture(const char *path);
// Reads and reports the picture that is the first operand; an exit code.
int inspect_picture(struct cli *cli);

#endif
