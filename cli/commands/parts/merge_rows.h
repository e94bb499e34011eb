// glint merge row by row: only some rows of the picture are in memory, however large it is. Private to
// cli/parts.
#ifndef GLINT_CLI_COMMANDS_PARTS_MERGE_ROWS_H
#define GLINT_CLI_COMMANDS_PARTS_MERGE_ROWS_H

#include "cli/commands/rendering.h"
#include "render/parts/parts.h"

// Whether the job's output can be made from these parts row by row.
bool merge_is_by_rows(const struct rendering *r, const struct part *parts, uint32_t count);
// Writes the job's only output from parts that fit (parts_fit), after checking that each is whole. An exit
// code.
int merge_rows(struct rendering *r, const struct part *parts, const uint32_t *order, uint32_t count);

#endif
