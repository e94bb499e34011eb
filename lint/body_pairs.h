// Finds pairs of bodies whose boxes overlap, each once, with a tree over the boxes: n bodies that lie apart
// cost n log n, however they are arranged.
//
// Input: boxes of bodies of one array, which are put into another order. If nearly all boxes overlap each
// other, the pairs per body are limited, so that the work stays in proportion to the scene. Ownership: the
// arena's, which must be guarded. Thread safety: one call belongs to one thread.
#ifndef GLINT_LINT_BODY_PAIRS_H
#define GLINT_LINT_BODY_PAIRS_H

#include "lint/box_tree.h"

struct lint_body;

// false: no more pairs are wanted.
typedef bool lint_take_pair(void *context, const struct lint_body *a, const struct lint_body *b);
void lint_body_pairs(struct arena *arena, struct lint_box_item *items, uint32_t count, lint_take_pair *take,
                     void *context);

#endif
