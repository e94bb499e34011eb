// One form for what is left of a module (gpu_prune.h). Reference: SPIR-V Specification 1.6,
// sections 2.4, 2.11 and 3.
#include "core/heap.h"
#include "shaders/packed/packed.h"
#include "tracer/gpu/gpu_prune.h"

#include <stdlib.h>
#include <string.h>

bool prune_understands(const uint32_t *i) {
    static const uint16_t ranges[][2] = {
        {SpvOpSourceContinued, SpvOpLine},
        {SpvOpExtension, SpvOpExtInst},
        {SpvOpMemoryModel, SpvOpCapability},
        {SpvOpTypeVoid, SpvOpTypeStruct},
        {SpvOpTypePointer, SpvOpTypeFunction},
        {SpvOpConstantTrue, SpvOpConstantComposite},
        {SpvOpSpecConstantTrue, SpvOpSpecConstantOp},
        {SpvOpFunction, SpvOpFunctionCall},
        {SpvOpVariable, SpvOpVariable},
        {SpvOpLoad, SpvOpCopyMemory},
        {SpvOpAccessChain, SpvOpAccessChain},
        {SpvOpDecorate, SpvOpMemberDecorate},
        {SpvOpVectorShuffle, SpvOpCopyObject},
        {SpvOpImageFetch, SpvOpImageFetch},
        {SpvOpImage, SpvOpImage},
        {SpvOpConvertFToU, SpvOpQuantizeToF16},
        {SpvOpBitcast, SpvOpBitcast},
        {SpvOpSNegate, SpvOpBitCount},
        {SpvOpAtomicExchange, SpvOpAtomicXor},
        {SpvOpPhi, SpvOpUnreachable},
    };
    const uint32_t opcode = prune_opcode(i);
    for (size_t k = 0; k < sizeof ranges / sizeof *ranges; k++)
        if (opcode >= ranges[k][0] && opcode <= ranges[k][1])
            return opcode != SpvOpImageFetch || prune_length(i) == 5;
    return false;
}

uint32_t prune_result(const uint32_t *i) {
    const uint32_t opcode = prune_opcode(i);
    if (packed_has_type(opcode) && prune_length(i) > 2)
        return i[2];
    const bool makes = opcode == SpvOpExtInstImport || opcode == SpvOpLabel ||
                       (opcode >= SpvOpTypeVoid && opcode <= SpvOpTypeFunction);
    return makes ? i[1] : 0;
}

static bool is_id(const uint32_t *i, uint32_t k) {
    return packed_word_of(prune_opcode(i), k) != PACKED_LITERAL;
}

static uint32_t *next_of(uint32_t *i) {
    do
        i += prune_length(i);
    while (prune_opcode(i) == PRUNE_NOTHING);
    return i;
}

// ---- blocks

static void count_mentions(struct prune *p) {
    for (uint32_t id = 0; id < p->words[PRUNE_BOUND]; id++)
        p->ids[id].mentions = 0;
    for (size_t at = p->functions; at < p->count; at += prune_length(p->words + at)) {
        const uint32_t *i = p->words + at, opcode = prune_opcode(i);
        const bool leads = (opcode >= SpvOpBranch && opcode <= SpvOpSwitch) || opcode == SpvOpLoopMerge ||
                           opcode == SpvOpSelectionMerge;
        for (uint32_t k = 1; leads && k < prune_length(i); k++)
            if (is_id(i, k))
                p->ids[i[k]].mentions++;
    }
}

// A block that only the one before it leads to goes on there; a phi of one edge is its operand.
static void join_blocks(struct prune *p) {
    uint32_t label = 0, *before = NULL, *last = NULL;
    for (size_t at = p->functions; at < p->count; at += prune_length(p->words + at)) {
        uint32_t *i = p->words + at;
        const uint32_t opcode = prune_opcode(i);
        if (opcode == PRUNE_NOTHING)
            continue;
        if (opcode == SpvOpPhi && prune_length(i) == 5) {
            if (!p->ids[i[2]].is_known)
                p->ids[i[2]].same = i[3];
            prune_drop(i);
            continue;
        }
        if (opcode == SpvOpLabel && last && prune_opcode(last) == SpvOpBranch && last[1] == i[1] &&
            p->ids[i[1]].mentions == 1 && prune_opcode(before) != SpvOpLoopMerge) {
            p->ids[i[1]].same = label;
            prune_drop(last);
            prune_drop(i);
            last = before;
            continue;
        }
        if (opcode == SpvOpLabel)
            label = i[1];
        before = last;
        last = i;
    }
}

// Whether a way of a selection does nothing before the selection's end.
static bool is_empty_way(const struct prune *p, uint32_t label, uint32_t end) {
    uint32_t *first = next_of(p->words + p->ids[label].at);
    return label == end ||
           (p->ids[label].mentions == 1 && prune_opcode(first) == SpvOpBranch && first[1] == end);
}

// Selections without effect: true if there was one. Counted mentions are those of before.
static bool drop_selections(struct prune *p) {
    bool any = false;
    for (size_t at = p->functions; at < p->count; at += prune_length(p->words + at)) {
        uint32_t *merge = p->words + at, *branch = merge + prune_length(merge);
        if (prune_opcode(merge) != SpvOpSelectionMerge || prune_opcode(branch) != SpvOpBranchConditional)
            continue;
        const uint32_t end = merge[1], ways[2] = {branch[2], branch[3]};
        if (prune_opcode(next_of(p->words + p->ids[end].at)) == SpvOpPhi || !is_empty_way(p, ways[0], end) ||
            !is_empty_way(p, ways[1], end))
            continue;
        for (int k = 0; k < 2; k++) {
            uint32_t *label = p->words + p->ids[ways[k]].at;
            if (ways[k] != end) {
                prune_drop(next_of(label));
                prune_drop(label);
            }
        }
        prune_drop(merge);
        branch[1] = end;
        prune_shorten(branch, 2, SpvOpBranch);
        any = true;
    }
    return any;
}

// ---- what has no effect

static bool is_pure(uint32_t opcode) {
    return packed_has_type(opcode) && opcode != SpvOpFunction && opcode != SpvOpFunctionParameter &&
           opcode != SpvOpFunctionCall && (opcode < SpvOpAtomicExchange || opcode > SpvOpAtomicXor);
}

// Whether it stores into a variable of the invocation that nothing reads.
static bool is_lost(const struct prune *p, const uint32_t *i) {
    const uint32_t *place = p->words + p->ids[prune_same(p, i[1])].at;
    while (prune_opcode(place) == SpvOpAccessChain)
        place = p->words + p->ids[prune_same(p, place[3])].at;
    return prune_opcode(place) == SpvOpVariable && !p->ids[place[2]].is_used &&
           (place[3] == SpvStorageClassFunction || place[3] == SpvStorageClassPrivate);
}

static bool has_effect(const struct prune *p, const uint32_t *i) {
    const uint32_t opcode = prune_opcode(i);
    if (opcode == PRUNE_NOTHING || opcode == SpvOpStore)
        return opcode == SpvOpStore && !is_lost(p, i);
    return !prune_result(i) || !is_pure(opcode) || p->ids[prune_result(i)].is_used;
}

// Marks what an instruction reads; true if there was something new.
static bool use(struct prune *p, const uint32_t *i) {
    bool any = false;
    for (uint32_t k = 1; k < prune_length(i); k++) {
        const uint32_t id = is_id(i, k) ? prune_same(p, i[k]) : 0;
        if (id == 0 || p->ids[id].is_known || p->ids[id].is_used || id == prune_result(i))
            continue;
        p->ids[id].is_used = true;
        any = true;
    }
    return any;
}

// `starts`: where the instructions of functions begin.
static void drop_unused(struct prune *p, const size_t *starts, size_t count) {
    for (uint32_t id = 0; id < p->words[PRUNE_BOUND]; id++)
        p->ids[id].is_used = false;
    for (bool more = true; more;) {
        more = false;
        for (size_t k = count; k-- > 0;)
            more |= has_effect(p, p->words + starts[k]) && use(p, p->words + starts[k]);
    }
    for (size_t k = count; k-- > 0;) // a store before the place that it names
        if (!has_effect(p, p->words + starts[k]))
            prune_drop(p->words + starts[k]);
}

// ---- the new module

struct output {
    uint32_t *words;
    size_t count;
};

struct tidy {
    struct prune *p;
    struct output head, globals, code;
    uint32_t next; // id
};

static uint32_t number(struct tidy *t, uint32_t id) {
    if (t->p->ids[id].number == 0)
        t->p->ids[id].number = t->next++;
    return t->p->ids[id].number;
}

static uint32_t number_of(struct tidy *t, uint32_t id);

// With new ids. What the instruction needs comes before it.
static void put(struct tidy *t, struct output *out, const uint32_t *i) {
    const uint32_t result = prune_result(i);
    for (uint32_t k = 1; k < prune_length(i); k++)
        if (is_id(i, k) && i[k] != result)
            number_of(t, i[k]);
    uint32_t *to = out->words + out->count;
    to[0] = i[0];
    for (uint32_t k = 1; k < prune_length(i); k++)
        to[k] = !is_id(i, k) ? i[k] : i[k] == result ? number(t, result) : number_of(t, i[k]);
    out->count += prune_length(i);
}

// The constant of a type and a value.
static uint32_t constant_of(struct tidy *t, uint32_t type, uint32_t value) {
    const uint32_t type_number = number_of(t, type);
    const bool is_truth = prune_opcode(t->p->words + t->p->ids[type].at) == SpvOpTypeBool;
    const uint32_t opcode = !is_truth ? SpvOpConstant : value ? SpvOpConstantTrue : SpvOpConstantFalse;
    const uint32_t length = is_truth ? 3 : 4;
    uint32_t *end = t->globals.words + t->globals.count;
    for (const uint32_t *i = t->globals.words; i < end; i += prune_length(i))
        if (i[0] == (length << 16 | opcode) && i[1] == type_number && (is_truth || i[3] == value))
            return i[2];
    end[0] = length << 16 | opcode;
    end[1] = type_number;
    end[2] = t->next++;
    if (!is_truth)
        end[3] = value;
    t->globals.count += length;
    return end[2];
}

static uint32_t number_of(struct tidy *t, uint32_t id) {
    id = prune_same(t->p, id);
    struct prune_id *one = &t->p->ids[id];
    const uint32_t *i = t->p->words + one->at;
    if (one->number == 0 && one->is_known)
        one->number = constant_of(t, i[1], one->value);
    else if (one->number == 0 && one->at < t->p->functions && prune_opcode(i) != SpvOpExtInstImport)
        put(t, &t->globals, i);
    return number(t, id);
}

// Of an entry point only the variables that are left; it is known by then what that is.
static void put_entry(struct tidy *t, const uint32_t *i) {
    uint32_t *to = t->head.words + t->head.count, length = 3;
    memcpy(to, i, prune_length(i) * sizeof *i);
    to[2] = number_of(t, i[2]);
    while (to[length++] >> 24) // the name's last word ends with 0
        ;
    for (uint32_t k = length; k < prune_length(i); k++)
        if (t->p->ids[i[k]].number)
            to[length++] = t->p->ids[i[k]].number;
    to[0] = length << 16 | SpvOpEntryPoint;
    t->head.count += length;
}

static void put_head(struct tidy *t) {
    for (size_t at = PRUNE_HEADER_WORDS; at < t->p->functions; at += prune_length(t->p->words + at)) {
        const uint32_t *i = t->p->words + at, opcode = prune_opcode(i);
        uint32_t *to = t->head.words + t->head.count;
        if (opcode == SpvOpEntryPoint) {
            put_entry(t, i);
        } else if (opcode == SpvOpExtInstImport ? t->p->ids[i[1]].number != 0
                                                : opcode >= SpvOpExtension && opcode <= SpvOpCapability) {
            memcpy(to, i, prune_length(i) * sizeof *i);
            if (opcode == SpvOpExtInstImport || opcode == SpvOpExecutionMode)
                to[1] = number_of(t, i[1]);
            t->head.count += prune_length(i);
        }
    }
}

// Of what is left, in the order of its new ids. false: no memory.
static bool put_decorations(struct tidy *t) {
    size_t *ends = heap_zeroed(t->next + 1, sizeof *ends);
    if (!ends)
        return false;
    for (int pass = 0; pass < 2; pass++) {
        for (size_t at = PRUNE_HEADER_WORDS; at < t->p->functions; at += prune_length(t->p->words + at)) {
            const uint32_t *i = t->p->words + at, length = prune_length(i);
            if ((prune_opcode(i) != SpvOpDecorate && prune_opcode(i) != SpvOpMemberDecorate) ||
                t->p->ids[i[1]].number == 0 || t->p->ids[i[1]].is_known)
                continue;
            uint32_t *to = t->head.words + ends[t->p->ids[i[1]].number];
            if (pass) {
                memcpy(to, i, length * sizeof *i);
                to[1] = t->p->ids[i[1]].number;
            }
            ends[t->p->ids[i[1]].number + !pass] += length;
        }
        ends[0] += pass ? 0 : t->head.count;
        for (uint32_t k = 0; !pass && k < t->next; k++)
            ends[k + 1] += ends[k];
    }
    t->head.count = ends[t->next];
    free(ends);
    return true;
}

static bool write_anew(struct prune *p) {
    uint32_t *room = heap_array(p->count, 3 * sizeof *room);
    if (!room)
        return false;
    struct tidy t = {p, {room, PRUNE_HEADER_WORDS}, {room + p->count, 0}, {room + 2 * p->count, 0}, 1};
    memcpy(room, p->words, PRUNE_HEADER_WORDS * sizeof *room);
    for (uint32_t *i = p->words + p->functions; i < p->words + p->count; i += prune_length(i))
        if (prune_opcode(i) != PRUNE_NOTHING)
            put(&t, &t.code, i);
    put_head(&t);
    const bool done = put_decorations(&t);
    room[PRUNE_BOUND] = t.next;
    const struct output parts[] = {t.head, t.globals, t.code};
    p->count = 0;
    for (size_t k = 0; done && k < 3; k++) {
        memcpy(p->words + p->count, parts[k].words, parts[k].count * sizeof *room);
        p->count += parts[k].count;
    }
    free(room);
    return done;
}

bool prune_tidy(struct prune *p) {
    size_t *starts = heap_array(p->count - p->functions + 1, sizeof *starts);
    if (!starts)
        return false;
    do {
        count_mentions(p);
        join_blocks(p);
        size_t count = 0;
        for (size_t at = p->functions; at < p->count; at += prune_length(p->words + at))
            if (prune_opcode(p->words + at) != PRUNE_NOTHING)
                starts[count++] = at;
        drop_unused(p, starts, count);
    } while (drop_selections(p));
    free(starts);
    return write_anew(p);
}
