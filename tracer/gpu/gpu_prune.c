// Removes what a kernel's specialization constants switch off from its module before a driver reads it.
// lavapipe's compiler inlines all functions into one before it evaluates conditions; NVIDIA's makes a kernel
// that takes 4 to 7 % longer if it has to find out by itself. Reference: SPIR-V Specification 1.6, sections
// 2.11 and 3.
#include "tracer/gpu/gpu_prune.h"

#include "core/heap.h"
#include "shaders/packed/packed.h"

#include <stdlib.h>

static void know(struct prune *p, uint32_t id, uint32_t value) {
    p->ids[id].is_known = true;
    p->ids[id].value = value;
}

// The result is another id.
static void be_same(struct prune *p, uint32_t result, uint32_t id) {
    if (p->ids[id].is_known)
        know(p, result, p->ids[id].value);
    else
        p->ids[result].same = id;
}

// Of two numbers. false: it does not know the operation.
static bool calculate(uint32_t opcode, uint32_t a, uint32_t b, uint32_t *result) {
    switch (opcode) {
    case SpvOpIEqual:
        *result = a == b;
        return true;
    case SpvOpINotEqual:
        *result = a != b;
        return true;
    case SpvOpUGreaterThan:
        *result = a > b;
        return true;
    case SpvOpBitwiseAnd:
        *result = a & b;
        return true;
    case SpvOpIAdd:
        *result = a + b;
        return true;
    case SpvOpIMul:
        *result = a * b;
        return true;
    case SpvOpUDiv:
        *result = b ? a / b : 0;
        return b != 0;
    default:
        return false;
    }
}

// Of an operation that one operand decides: where it is `value` that is the result, else the other is.
static void decide(struct prune *p, uint32_t result, const uint32_t *operands, bool value) {
    for (int k = 0; k < 2; k++)
        if (p->ids[operands[k]].is_known && !p->ids[operands[k]].value == !value)
            know(p, result, value);
        else if (p->ids[operands[k]].is_known && !p->ids[result].is_known)
            be_same(p, result, operands[1 - k]);
}

// The result of an operation whose operands are ids, where these are known.
static void compute(struct prune *p, uint32_t result, uint32_t opcode, const uint32_t *operands) {
    const struct prune_id *a = &p->ids[operands[0]];
    uint32_t value;
    switch (opcode) {
    case SpvOpLogicalAnd:
    case SpvOpLogicalOr:
        decide(p, result, operands, opcode == SpvOpLogicalOr);
        break;
    case SpvOpLogicalNot:
        if (a->is_known)
            know(p, result, !a->value);
        break;
    case SpvOpSelect:
        if (a->is_known)
            be_same(p, result, operands[a->value ? 1 : 2]);
        break;
    case SpvOpCopyObject:
        be_same(p, result, operands[0]);
        break;
    default:
        if (a->is_known && p->ids[operands[1]].is_known &&
            calculate(opcode, a->value, p->ids[operands[1]].value, &value))
            know(p, result, value);
        break;
    }
}

static bool is_computed(uint32_t opcode) {
    uint32_t value;
    return (opcode >= SpvOpLogicalOr && opcode <= SpvOpSelect) || opcode == SpvOpCopyObject ||
           calculate(opcode, 0, 1, &value);
}

static void know_constant(struct prune *p, const uint32_t *i, uint32_t value) {
    const uint32_t spec = p->ids[i[2]].spec;
    if (spec && spec <= p->source->constant_count)
        value = p->source->constants[spec - 1];
    know(p, i[2], value);
}

// Reads what comes before the functions.
static void take_global(struct prune *p, const uint32_t *i) {
    switch (prune_opcode(i)) {
    case SpvOpEntryPoint:
        p->entry = i[2];
        break;
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
        if (prune_length(i) == 4)
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
    for (uint32_t k = 3; k + 1 < prune_length(i); k += 2) {
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
    switch (prune_opcode(i)) {
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
        for (uint32_t k = 4; k < prune_length(i); k += 2)
            name_block(p, i[k], BLOCK_LIVE);
        break;
    default:
        break;
    }
}

// Whether a selection's condition is known: `i` is its OpSelectionMerge, the branch comes next.
static bool is_decided(const struct prune *p, const uint32_t *i) {
    const uint32_t *branch = i + prune_length(i);
    return prune_opcode(branch) == SpvOpBranchConditional && p->ids[branch[1]].is_known;
}

// Whether it holds nothing before the first store: a parameter does.
static bool is_own_variable(const struct prune *p, size_t at) {
    const uint32_t *i = p->words + at;
    return at >= p->functions && prune_opcode(i) == SpvOpVariable && prune_length(i) == 4;
}

// A variable of a function into which one known value is stored, and nothing else, holds no other.
static void take_access(struct prune *p, const uint32_t *i) {
    struct prune_id *variable = &p->ids[i[prune_opcode(i) == SpvOpStore ? 1 : 3]];
    if (!is_own_variable(p, variable->at) || variable->uses != 1)
        return;
    if (prune_opcode(i) == SpvOpStore)
        variable->holds = i[2];
    else if (variable->holds && p->ids[variable->holds].is_known)
        know(p, i[2], p->ids[variable->holds].value);
}

static void look_at(struct prune *p, const uint32_t *i, uint32_t label) {
    const uint32_t opcode = prune_opcode(i);
    if (opcode == SpvOpFunctionCall)
        p->ids[i[3]].is_called = true;
    else if (opcode == SpvOpStore || opcode == SpvOpLoad)
        take_access(p, i);
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

// Counts how often variables are used, but for loads.
static void count_uses(struct prune *p, const uint32_t *i) {
    for (uint32_t k = 1; k < prune_length(i) && prune_opcode(i) != SpvOpLoad; k++)
        if (packed_word_of(prune_opcode(i), k) == PACKED_ID && p->words + p->ids[i[k]].at != i)
            p->ids[i[k]].uses += prune_opcode(i) == SpvOpStore && k == 1 ? 1 : 2;
}

// A block comes after the one that dominates it, so one look at each is enough.
static void look_at_function(struct prune *p, size_t at) {
    uint32_t label = 0;
    for (size_t k = at; prune_opcode(p->words + k) != SpvOpFunctionEnd; k += prune_length(p->words + k))
        count_uses(p, p->words + k);
    for (; prune_opcode(p->words + at) != SpvOpFunctionEnd; at += prune_length(p->words + at)) {
        const uint32_t *i = p->words + at;
        if (prune_opcode(i) == SpvOpLabel) {
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
    for (uint32_t id = 0; id < p->words[PRUNE_BOUND]; id++) {
        struct prune_id *one = &p->ids[id];
        one->is_called = id == p->entry;
        one->is_looked = one->is_seen = false;
        one->block = BLOCK_DEAD;
        one->taken = one->uses = one->holds = 0;
    }
    for (bool more = true; more;) {
        more = false;
        for (uint32_t id = 0; id < p->words[PRUNE_BOUND]; id++) {
            struct prune_id *function = &p->ids[id];
            if (!function->is_called || function->is_looked)
                continue;
            look_at_function(p, function->at);
            function->is_looked = true;
            more = true;
        }
    }
}

// ---- what is left of the module

static void drop_edges(const struct prune *p, uint32_t *phi, uint32_t label) {
    uint32_t count = 3;
    for (uint32_t k = 3; k + 1 < prune_length(phi); k += 2) {
        if (!is_edge(p, phi[k + 1], label) && p->ids[phi[k + 1]].block != BLOCK_REPEAT)
            continue;
        phi[count++] = phi[k];
        phi[count++] = phi[k + 1];
    }
    prune_shorten(phi, count, SpvOpPhi);
}

static void change(const struct prune *p, uint32_t *i, uint32_t label) {
    const uint32_t opcode = prune_opcode(i);
    if (opcode == SpvOpSelectionMerge && is_decided(p, i)) {
        prune_drop(i);
    } else if (opcode == SpvOpPhi) {
        drop_edges(p, i, label);
    } else if (opcode == SpvOpBranchConditional && p->ids[label].taken) {
        i[1] = p->ids[label].taken;
        prune_shorten(i, 2, SpvOpBranch);
    }
}

// In a block that nothing leads to, but which may have to exist, only its end is left.
static void change_empty(const struct prune *p, uint32_t *i, uint32_t label) {
    const struct prune_id *block = &p->ids[label];
    const uint32_t opcode = prune_opcode(i);
    if (opcode < SpvOpBranch || opcode > SpvOpUnreachable) {
        if (opcode != SpvOpLabel)
            prune_drop(i);
    } else if (block->block == BLOCK_MERGE) {
        prune_shorten(i, 1, SpvOpUnreachable);
    } else {
        i[1] = block->header;
        prune_shorten(i, 2, SpvOpBranch);
    }
}

// false: nothing was left to take out.
static bool take_out(const struct prune *p) {
    bool called = false, any = false;
    uint32_t label = 0;
    for (size_t at = p->functions, length; at < p->count; at += length) {
        uint32_t *i = p->words + at;
        const uint32_t before = i[0];
        length = prune_length(i);
        if (prune_opcode(i) == SpvOpFunction)
            called = p->ids[i[2]].is_called;
        if (prune_opcode(i) == SpvOpLabel)
            label = i[1];
        if (prune_opcode(i) == SpvOpFunctionEnd)
            label = 0;
        if (!called || (label && p->ids[label].block == BLOCK_DEAD))
            prune_drop(i);
        else if (label && p->ids[label].block != BLOCK_LIVE)
            change_empty(p, i, label);
        else
            change(p, i, label);
        any |= i[0] != before;
    }
    return any;
}

static void index_module(struct prune *p) {
    for (size_t at = PRUNE_HEADER_WORDS; at < p->count; at += prune_length(p->words + at)) {
        const uint32_t *i = p->words + at;
        const uint32_t result = prune_result(i);
        p->is_odd |= !prune_understands(i);
        if (result)
            p->ids[result].at = (uint32_t)at;
        if (prune_opcode(i) == SpvOpFunction && p->functions == p->count)
            p->functions = at;
        if (p->functions == p->count && !p->is_odd)
            take_global(p, i);
    }
}

bool gpu_prune(const struct gpu_program_source *source, uint32_t *spirv, size_t *words) {
    struct prune p = {.words = spirv, .count = *words, .functions = *words, .source = source};
    p.ids = heap_zeroed(spirv[PRUNE_BOUND], sizeof *p.ids);
    if (!p.ids)
        return false;
    index_module(&p);
    if (!p.is_odd)
        look_at_functions(&p);
    const bool understood = !p.is_odd;
    while (!p.is_odd && take_out(&p)) // stores were among it: more is known then
        look_at_functions(&p);
    const bool done = !understood || prune_tidy(&p);
    *words = p.count;
    free(p.ids);
    return done;
}
