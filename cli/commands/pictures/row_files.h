// Writes a picture whose rows come a few at a time (picture/write/rows.h) to its file, under a temporary name
// until it is whole.
//
// Errors: printed, but for rows that do not come. Thread safety: as cli.h.
#ifndef GLINT_CLI_COMMANDS_PICTURES_ROW_FILES_H
#define GLINT_CLI_COMMANDS_PICTURES_ROW_FILES_H

#include "cli/cli.h"
#include "picture/write/rows.h"
#include "render/parts/part_file.h"

// As a file of parts if `part` is not NULL; `part` then says of what. CLI_OK, or an exit code. *rows_ended:
// rows->take was false, the only error that is not printed; the exit code is then CLI_FILE.
int row_file_write(struct cli *cli, const char *path, const struct image_rows *rows, enum image_format format,
                   struct image_display display, const struct part *part, bool *rows_ended);

#endif
