// What the two halves of pruning share: gpu_prune.c finds what constants switch off and takes it out in
// place, gpu_tidy.c writes what is left in one form. Thread safety: as gpu.h.
#ifndef GLINT_TRACER_GPU_GPU_PRUNE_H
#define GLINT_TRACER_GPU_GPU_PRUNE_H

#include "tracer/gpu/gpu_private.h"

enum {
    PRUNE_HEADER_WORDS = 5,
    PRUNE_BOUND = 3,   // the header's word
    PRUNE_NOTHING = 0, // opcode of an instruction, of any length, that was taken out
};

enum block_state {
    BLOCK_DEAD,   // nothing leads there
    BLOCK_MERGE,  // nothing leads there, but a selection or a loop names it as its end
    BLOCK_REPEAT, // the same as the continue part of the loop whose header is `header`
    BLOCK_LIVE,
};

// What is known about an id.
struct prune_id {
    bool is_known;             // a scalar of 32 bits, or a truth value: `value`
    bool is_called, is_looked; // of a function: its blocks were looked at
    bool is_seen;              // of a label: its block was looked at
    bool is_used;
    uint8_t block; // enum block_state, of a label
    uint32_t value;
    uint32_t same;     // the id that takes its place; 0: none
    uint32_t at;       // where the instruction begins that makes it
    uint32_t taken;    // of a label: the only one that it continues to; 0: all that it names
    uint32_t header;   // of BLOCK_REPEAT
    uint32_t spec;     // SpecId + 1; 0: none
    uint32_t uses;     // of a variable: 1: one store, and loads
    uint32_t holds;    // of a variable: what is stored there
    uint32_t mentions; // of a label: how often branches lead there, or merges name it
    uint32_t number;   // its new id; 0: none yet
};

struct prune {
    uint32_t *words;
    size_t count, functions; // where the first function begins
    struct prune_id *ids;
    const struct gpu_program_source *source;
    uint32_t entry; // a function
    bool is_odd;    // not understood: everything is left as it is
};

static inline uint32_t prune_length(const uint32_t *i) {
    return i[0] >> 16;
}

static inline uint32_t prune_opcode(const uint32_t *i) {
    return i[0] & 0xffff;
}

static inline void prune_drop(uint32_t *i) {
    i[0] &= 0xffff0000; // PRUNE_NOTHING
}

// Makes an instruction shorter; what it loses is nothing.
static inline void prune_shorten(uint32_t *i, uint32_t length, uint32_t opcode) {
    if (length < prune_length(i))
        i[length] = (prune_length(i) - length) << 16;
    i[0] = length << 16 | opcode;
}

// The id that takes its place, in the end.
static inline uint32_t prune_same(const struct prune *p, uint32_t id) {
    while (p->ids[id].same)
        id = p->ids[id].same;
    return id;
}

// The id that an instruction makes; 0: none.
uint32_t prune_result(const uint32_t *i);
// Whether it is known which of an instruction's words are ids, and what it does.
bool prune_understands(const uint32_t *i);
// Takes out what has no effect, joins blocks, and writes the module anew: its globals in the order in which
// functions need them, its ids counting up. So modules that do the same are the same, whatever was taken out
// of them. Changes words and count; false: no memory.
bool prune_tidy(struct prune *p);

#endif
