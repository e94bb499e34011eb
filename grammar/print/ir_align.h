// Which entries of two lists are the same entry: part of ir_diff.
// Ownership: the given arena, which must be guarded. Thread safety: pure except for the arena.
#ifndef GLINT_GRAMMAR_PRINT_IR_ALIGN_H
#define GLINT_GRAMMAR_PRINT_IR_ALIGN_H

#include "core/arena.h"

enum {
    IR_ALIGN_NONE = -1
};

struct ir_align {
    struct arena *arena;
    int32_t *b_of_a, *a_of_b; // IR_ALIGN_NONE: no partner
    uint32_t a_count, b_count;
};

void ir_align_init(struct ir_align *align, struct arena *arena, uint32_t a_count, uint32_t b_count);
// Pairs free entries whose keys are equal, in order; empty keys pair with nothing.
void ir_align_keys(struct ir_align *align, const str *a_keys, const str *b_keys);
// Pairs the remaining free entries by how alike they are. `likeness` returns a number from 0 (nothing in
// common) to 1; below a third two entries pair only if each is the last one left in its list.
typedef double ir_align_likeness(void *context, uint32_t a, uint32_t b);
void ir_align_rest(struct ir_align *align, ir_align_likeness *likeness, void *context);
// Sets moved[a] for the fewest pairs that are not in the same order in both lists.
void ir_align_moved(const struct ir_align *align, bool *moved);

#endif
