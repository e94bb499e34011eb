// Removes what a kernel's specialization constants switch off from its module before a driver reads it.
// lavapipe's compiler inlines all functions into one before it evaluates conditions; NVIDIA's makes a kernel
// that takes 4 to 7 % longer if it has to find out by itself. Reference: SPIR-V Specification 1.6, sections
// 2.11 and 3.
#include "core/heap.h"
#include "tracer/gpu/gpu_private.h"

#include <spirv/unified1/spirv.h>
#include <stdlib.h>
#include <string.h>

enum {
    HEADER_WORDS = 5,
    BOUND = 3, // the header's word
};

enum block_state {
    BLOCK_DEAD,   // nothing leads there
    BLOCK_MERGE,  // nothing leads there, but a selection or a loop names it as its end
    BLOCK_REPEAT, // the same as the continue part of the loop whose header is `header`
    BLOCK_LIVE,
};

// What is known about an id.
struct prune_id {
    bool is_known; // a scalar of 32 bits, or a truth value: `value`
    uint32_t value;
    size_t function; // where its function begins; 0: the id is none
    bool is_called;
    bool is_kept;    // a word after the type of an instruction that is left: where a result is
    uint8_t block;   // enum block_state, of a label
    uint32_t taken;  // of a label: the only one that it continues to; 0: all that it names
    uint32_t header; // of BLOCK_REPEAT
    uint32_t spec;   // SpecId + 1; 0: none
    bool is_seen;    // of a label: its block was looked at
};

struct prune {
    uint32_t *words;
    size_t count;
    struct prune_id *ids;
    const struct gpu_program_source *source;
    bool is_odd; // a block comes before one that leads to it: everything is left as it is
};

static uint32_t length_of(const uint32_t *i) {
    return i[0] >> 16;
}

static uint32_t opcode_of(const uint32_t *i) {
    return i[0] & 0xffff;
}

static void know(struct prune *p, uint32_t id, uint32_t value) {
    p->ids[id].is_known = true;
    p->ids[id].value = value;
}

// The result of an operation whose operands are ids, where these are known.
static void compute(struct prune *p, uint32_t result, uint32_t opcode, const uint32_t *operands) {
    const struct prune_id *a = &p->ids[operands[0]];
    const struct prune_id *b = opcode == SpvOpLogicalNot ? a : &p->ids[operands[1]];
    const bool both = a->is_known && b->is_known;
    if (opcode == SpvOpLogicalAnd && ((a->is_known && !a->value) || (b->is_known && !b->value)))
        know(p, result, 0);
    else if (opcode == SpvOpLogicalOr && ((a->is_known && a->value) || (b->is_known && b->value)))
        know(p, result, 1);
    else if (both && opcode == SpvOpLogicalAnd)
        know(p, result, a->value && b->value);
    else if (both && opcode == SpvOpLogicalOr)
        know(p, result, a->value || b->value);
    else if (both && opcode == SpvOpLogicalNot)
        know(p, result, !a->value);
    else if (both && opcode == SpvOpIEqual)
        know(p, result, a->value == b->value);
    else if (both && opcode == SpvOpINotEqual)
        know(p, result, a->value != b->value);
    else if (both && opcode == SpvOpBitwiseAnd)
        know(p, result, a->value & b->value);
}

static bool is_computed(uint32_t opcode) {
    return (opcode >= SpvOpLogicalOr && opcode <= SpvOpLogicalNot) || opcode == SpvOpIEqual ||
           opcode == SpvOpINotEqual || opcode == SpvOpBitwiseAnd;
}

static void know_constant(struct prune *p, const uint32_t *i, uint32_t value) {
    const uint32_t spec = p->ids[i[2]].spec;
    if (spec && spec <= p->source->constant_count)
        value = p->source->constants[spec - 1];
    know(p, i[2], value);
}

// Reads what comes before the functions.
static void take_global(struct prune *p, const uint32_t *i) {
    switch (opcode_of(i)) {
    case SpvOpDecorate:
        if (i[2] == SpvDecorationSpecId)
            p->ids[i[1]].spec = i[3] + 1;
        break;
    case SpvOpConstantTrue:
    case SpvOpSpecConstantTrue:
        know_constant(p, i, 1);
        break;
    case SpvOpConstantFalse:
    case SpvOpSpecConstantFalse:
        know_constant(p, i, 0);
        break;
    case SpvOpConstant:
    case SpvOpSpecConstant:
        if (length_of(i) == 4)
            know_constant(p, i, i[3]);
        break;
    case SpvOpSpecConstantOp:
        if (is_computed(i[3]))
            compute(p, i[2], i[3], i + 4);
        break;
    default:
        break;
    }
}

// ---- which blocks of a function are left

static bool is_edge(const struct prune *p, uint32_t from, uint32_t to) {
    const struct prune_id *block = &p->ids[from];
    return block->block == BLOCK_LIVE && (block->taken == 0 || block->taken == to);
}

// Known if it is the same from all blocks that lead to the label, and all of these were looked at.
static void compute_phi(struct prune *p, const uint32_t *i, uint32_t label) {
    bool any = false;
    uint32_t value = 0;
    for (uint32_t k = 3; k + 1 < length_of(i); k += 2) {
        const struct prune_id *from = &p->ids[i[k + 1]], *operand = &p->ids[i[k]];
        if (!from->is_seen)
            return;
        if (!is_edge(p, i[k + 1], label))
            continue;
        if (!operand->is_known || (any && operand->value != value))
            return;
        any = true;
        value = operand->value;
    }
    if (any)
        know(p, i[2], value);
}

static void name_block(struct prune *p, uint32_t label, enum block_state state) {
    p->is_odd |= state == BLOCK_LIVE && p->ids[label].is_seen && p->ids[label].block != BLOCK_LIVE;
    if (p->ids[label].block < state)
        p->ids[label].block = (uint8_t)state;
}

// Where a block continues.
static void lead(struct prune *p, const uint32_t *i, uint32_t label) {
    switch (opcode_of(i)) {
    case SpvOpBranch:
        name_block(p, i[1], BLOCK_LIVE);
        break;
    case SpvOpBranchConditional:
        if (p->ids[i[1]].is_known)
            p->ids[label].taken = p->ids[i[1]].value ? i[2] : i[3];
        for (uint32_t k = 2; k <= 3; k++)
            if (p->ids[label].taken == 0 || p->ids[label].taken == i[k])
                name_block(p, i[k], BLOCK_LIVE);
        break;
    case SpvOpSwitch:
        name_block(p, i[2], BLOCK_LIVE);
        for (uint32_t k = 4; k < length_of(i); k += 2)
            name_block(p, i[k], BLOCK_LIVE);
        break;
    default:
        break;
    }
}

// Whether a selection's condition is known: `i` is its OpSelectionMerge, the branch comes next.
static bool is_decided(const struct prune *p, const uint32_t *i) {
    const uint32_t *branch = i + length_of(i);
    return opcode_of(branch) == SpvOpBranchConditional && p->ids[branch[1]].is_known;
}

static void look_at(struct prune *p, const uint32_t *i, uint32_t label) {
    const uint32_t opcode = opcode_of(i);
    if (opcode == SpvOpFunctionCall)
        p->ids[i[3]].is_called = true;
    else if (opcode == SpvOpPhi)
        compute_phi(p, i, label);
    else if (is_computed(opcode))
        compute(p, i[2], opcode, i + 3);
    else if (opcode == SpvOpSelectionMerge && !is_decided(p, i))
        name_block(p, i[1], BLOCK_MERGE);
    else if (opcode == SpvOpLoopMerge) {
        name_block(p, i[1], BLOCK_MERGE);
        name_block(p, i[2], BLOCK_REPEAT);
        p->ids[i[2]].header = label;
    } else {
        lead(p, i, label);
    }
}

// A block comes after the one that dominates it, so one look at each is enough.
static void look_at_function(struct prune *p, size_t at) {
    uint32_t label = 0;
    for (; opcode_of(p->words + at) != SpvOpFunctionEnd; at += length_of(p->words + at)) {
        const uint32_t *i = p->words + at;
        if (opcode_of(i) == SpvOpLabel) {
            if (label == 0)
                name_block(p, i[1], BLOCK_LIVE);
            label = i[1];
            p->ids[label].is_seen = true;
        } else if (label && p->ids[label].block == BLOCK_LIVE) {
            look_at(p, i, label);
        }
    }
}

// glslang writes functions before or after those that call them: repeats until no more are called.
static void look_at_functions(struct prune *p) {
    for (bool more = true; more;) {
        more = false;
        for (uint32_t id = 0; id < p->words[BOUND]; id++) {
            struct prune_id *function = &p->ids[id];
            if (!function->is_called || function->function == 0)
                continue;
            look_at_function(p, function->function);
            function->function = 0;
            more = true;
        }
    }
}

// ---- what is left of the module

struct output {
    uint32_t *words; // reuses the module's words: the result is never longer
    size_t count;
};

static void put(struct output *out, uint32_t word) {
    out->words[out->count++] = word;
}

static void put_phi(const struct prune *p, struct output *out, const uint32_t *i, uint32_t label) {
    const uint32_t length = length_of(i);
    const size_t at = out->count;
    put(out, 0);
    put(out, i[1]);
    put(out, i[2]);
    for (uint32_t k = 3; k + 1 < length; k += 2) {
        const uint32_t value = i[k], from = i[k + 1];
        if (!is_edge(p, from, label) && p->ids[from].block != BLOCK_REPEAT)
            continue;
        put(out, value);
        put(out, from);
    }
    out->words[at] = (uint32_t)(out->count - at) << 16 | SpvOpPhi;
}

static void put_instruction(struct prune *p, struct output *out, const uint32_t *i, uint32_t label) {
    const uint32_t opcode = opcode_of(i), length = length_of(i);
    if (length > 2)
        p->ids[i[2] < p->words[BOUND] ? i[2] : 0].is_kept = true;
    if (opcode == SpvOpSelectionMerge && is_decided(p, i))
        return;
    if (opcode == SpvOpPhi) {
        put_phi(p, out, i, label);
    } else if (opcode == SpvOpBranchConditional && p->ids[label].taken) {
        put(out, 2u << 16 | SpvOpBranch);
        put(out, p->ids[label].taken);
    } else {
        memmove(out->words + out->count, i, length * sizeof *i);
        out->count += length;
    }
}

static size_t block_length(const uint32_t *label) {
    const uint32_t *end = label + length_of(label);
    while (opcode_of(end) != SpvOpLabel && opcode_of(end) != SpvOpFunctionEnd)
        end += length_of(end);
    return (size_t)(end - label);
}

// A block that nothing leads to, but which may have to exist.
static void put_empty(const struct prune *p, struct output *out, uint32_t label) {
    const struct prune_id *block = &p->ids[label];
    if (block->block == BLOCK_DEAD)
        return;
    put(out, 2u << 16 | SpvOpLabel);
    put(out, label);
    if (block->block == BLOCK_MERGE) {
        put(out, 1u << 16 | SpvOpUnreachable);
    } else {
        put(out, 2u << 16 | SpvOpBranch);
        put(out, block->header);
    }
}

static size_t put_functions(struct prune *p, size_t at) {
    struct output out = {p->words, at};
    bool called = false;
    uint32_t label = 0;
    for (size_t length; at < p->count; at += length) {
        const uint32_t *i = p->words + at, opcode = opcode_of(i);
        length = length_of(i);
        if (opcode == SpvOpFunction)
            called = p->ids[i[2]].is_called;
        if (opcode == SpvOpLabel)
            label = i[1];
        if (called && opcode == SpvOpLabel && p->ids[label].block != BLOCK_LIVE) {
            length = block_length(i);
            put_empty(p, &out, label);
        } else if (called) {
            put_instruction(p, &out, i, label);
        }
    }
    return out.count;
}

// Drops the decorations of removed results.
static size_t drop_decorations(struct prune *p, size_t functions, size_t count) {
    struct output out = {p->words, HEADER_WORDS};
    for (size_t at = HEADER_WORDS, length; at < functions; at += length) {
        const uint32_t *i = p->words + at;
        length = length_of(i);
        if (opcode_of(i) == SpvOpDecorate && i[2] == SpvDecorationNoContraction && !p->ids[i[1]].is_kept)
            continue;
        memmove(out.words + out.count, i, length * sizeof *i);
        out.count += length;
    }
    memmove(out.words + out.count, p->words + functions, (count - functions) * sizeof *p->words);
    return out.count + count - functions;
}

bool gpu_prune(const struct gpu_program_source *source, uint32_t *spirv, size_t *words) {
    struct prune p = {.words = spirv, .count = *words, .source = source};
    p.ids = heap_zeroed(spirv[BOUND], sizeof *p.ids);
    if (!p.ids)
        return false;
    size_t functions = *words;
    for (size_t at = HEADER_WORDS; at < *words; at += length_of(spirv + at)) {
        const uint32_t *i = spirv + at;
        if (opcode_of(i) == SpvOpFunction) {
            functions = at < functions ? at : functions;
            p.ids[i[2]].function = at;
        } else if (functions == *words) {
            if (opcode_of(i) == SpvOpEntryPoint)
                p.ids[i[2]].is_called = true;
            take_global(&p, i);
        }
    }
    look_at_functions(&p);
    if (!p.is_odd) {
        const size_t count = put_functions(&p, functions);
        *words = drop_decorations(&p, functions, count);
    }
    free(p.ids);
    return true;
}
