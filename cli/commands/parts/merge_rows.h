// glint merge row by row: what is in memory are some rows of the picture, however large it is. Private to
// cli/parts.
#ifndef GLINT_CLI_COMMANDS_PARTS_MERGE_ROWS_H
#define GLINT_CLI_COMMANDS_PARTS_MERGE_ROWS_H

#include "cli/commands/rendering.h"
#include "render/parts/parts.h"

// Whether the job's output can be made so of these parts.
bool merge_is_by_rows(const struct rendering *r, const struct part *parts, uint32_t count);
// The job's only output, of parts that fit (parts_fit), after each was seen to be whole. An exit code.
int merge_rows(struct rendering *r, const struct part *parts, const uint32_t *order, uint32_t count);

#endif
