// Reference: SPIR-V Specification 1.6, section 3.
#include "tools/spirv_exact/by_value.h"

#include <spirv/unified1/spirv.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum {
    HEADER_WORDS = 5,
    BOUND = 3, // the header's word
    // Words of an instruction, by what they hold.
    TYPE = 1,
    RESULT = 2,
    LOADED = 3,
    STORED_TO = 1,
    STORED = 2,
    BASE = 3,
    INDICES = 4,
    CALLED = 3,
    ARGUMENTS = 4,
    FUNCTION_TYPE = 4,
    FIRST_PARAMETER = 3, // of an OpTypeFunction
};

struct module {
    const uint32_t *words;
    size_t count, functions; // functions: where the first one begins
    uint32_t bound;          // of ids, those that are added included
    // By id.
    size_t *defined; // where: 0 for what is of no interest here
    bool *kept;      // a parameter that stays a pointer
    uint32_t *uses;  // of a variable
    size_t *store;   // of a variable, the last one
    bool *dropped;   // a variable
};

// What is written.
struct output {
    uint32_t *words;
    size_t count;
    size_t *types; // of functions, those that are new: where they begin in words
    size_t type_count;
};

static uint32_t length_of(const uint32_t *at) {
    return at[0] >> 16;
}

static uint32_t opcode_of(const uint32_t *at) {
    return at[0] & 0xffff;
}

// The instruction that defines an id, if it has this opcode; else NULL.
static const uint32_t *find(const struct module *m, uint32_t id, uint32_t opcode) {
    const size_t at = id < m->words[BOUND] ? m->defined[id] : 0;
    return at && opcode_of(m->words + at) == opcode ? m->words + at : NULL;
}

// What a pointer to a function's own memory points to; 0: it is something else.
static uint32_t pointee(const struct module *m, uint32_t type) {
    const uint32_t *pointer = find(m, type, SpvOpTypePointer);
    return pointer && pointer[2] == SpvStorageClassFunction ? pointer[3] : 0;
}

static const uint32_t *pointer_parameter(const struct module *m, uint32_t id) {
    const uint32_t *parameter = find(m, id, SpvOpFunctionParameter);
    return parameter && pointee(m, parameter[TYPE]) ? parameter : NULL;
}

static bool is_by_value(const struct module *m, uint32_t id) {
    return pointer_parameter(m, id) && !m->kept[id];
}

static void index_module(struct module *m) {
    m->functions = m->count;
    for (size_t at = HEADER_WORDS; at < m->count; at += length_of(m->words + at)) {
        const uint32_t *i = m->words + at;
        switch (opcode_of(i)) {
        case SpvOpTypePointer:
        case SpvOpTypeFunction:
            m->defined[i[1]] = at;
            break;
        case SpvOpFunction:
            m->functions = at < m->functions ? at : m->functions;
            m->defined[i[RESULT]] = at;
            break;
        case SpvOpConstant:
        case SpvOpFunctionParameter:
        case SpvOpVariable:
        case SpvOpAccessChain:
            m->defined[i[RESULT]] = at;
            break;
        default:
            break;
        }
    }
}

static bool has_constant_indices(const struct module *m, const uint32_t *chain) {
    for (uint32_t k = INDICES; k < length_of(chain); k++)
        if (!find(m, chain[k], SpvOpConstant))
            return false;
    return true;
}

// Whether a word is a number: those of the commonest instructions are known. One of another that looks like
// an id counts as a use of that.
static bool is_number(uint32_t opcode, uint32_t k) {
    switch (opcode) {
    case SpvOpExtInst:
        return k == 4;
    case SpvOpFunction:
        return k == 3;
    case SpvOpLoad:
    case SpvOpCompositeExtract:
        return k > 3;
    case SpvOpVectorShuffle:
    case SpvOpCompositeInsert:
        return k > 4;
    case SpvOpStore:
    case SpvOpLoopMerge:
        return k > 2;
    case SpvOpSelectionMerge:
        return k > 1;
    default:
        return false;
    }
}

// A word that may be the id of a parameter, or of a place in one.
static void note_read(struct module *m, const uint32_t *i, uint32_t k) {
    const uint32_t opcode = opcode_of(i), id = i[k];
    const bool loads = opcode == SpvOpLoad && k == LOADED;
    const uint32_t *chain = find(m, id, SpvOpAccessChain);
    if (pointer_parameter(m, id))
        m->kept[id] |= !loads && !(opcode == SpvOpFunctionParameter && k == RESULT) &&
                       !(opcode == SpvOpAccessChain && k == BASE && has_constant_indices(m, i));
    else if (chain && pointer_parameter(m, chain[BASE]))
        m->kept[chain[BASE]] |= !loads && i != chain;
}

static void note_variable(struct module *m, const uint32_t *i, uint32_t k) {
    const uint32_t *variable = find(m, i[k], SpvOpVariable);
    if (!variable || i == variable)
        return;
    m->uses[i[k]]++;
    if (opcode_of(i) == SpvOpStore && k == STORED_TO)
        m->store[i[k]] = (size_t)(i - m->words);
}

static void note_uses(struct module *m) {
    for (size_t at = m->functions; at < m->count; at += length_of(m->words + at))
        for (uint32_t k = 1; k < length_of(m->words + at); k++) {
            if (is_number(opcode_of(m->words + at), k))
                continue;
            note_read(m, m->words + at, k);
            note_variable(m, m->words + at, k);
        }
}

// The parameter that takes argument `k` of a call.
static const uint32_t *parameter_of(const struct module *m, const uint32_t *call, uint32_t k) {
    const uint32_t *at = find(m, call[CALLED], SpvOpFunction);
    for (uint32_t i = 0; at && i <= k - ARGUMENTS; i++)
        at += length_of(at);
    return at;
}

// A variable that exists for this argument alone.
static bool is_for(const struct module *m, uint32_t id, const uint32_t *call) {
    return find(m, id, SpvOpVariable) && m->uses[id] == 2 && m->store[id] && m->words + m->store[id] < call;
}

static void drop_variables(struct module *m) {
    for (size_t at = m->functions; at < m->count; at += length_of(m->words + at)) {
        const uint32_t *i = m->words + at;
        for (uint32_t k = ARGUMENTS; opcode_of(i) == SpvOpFunctionCall && k < length_of(i); k++)
            if (is_by_value(m, parameter_of(m, i, k)[RESULT]) && is_for(m, i[k], i))
                m->dropped[i[k]] = true;
    }
}

// ---- the new module

static void put(struct output *out, uint32_t opcode, const uint32_t *operands, uint32_t count) {
    out->words[out->count++] = (count + 1) << 16 | opcode;
    memcpy(out->words + out->count, operands, count * sizeof *operands);
    out->count += count;
}

static void copy(struct output *out, const uint32_t *i) {
    memcpy(out->words + out->count, i, length_of(i) * sizeof *i);
    out->count += length_of(i);
}

// Whether a function's type, as it becomes, is this one.
static bool is_type_of(const struct module *m, const uint32_t *function, const uint32_t *type) {
    const uint32_t *before = find(m, function[FUNCTION_TYPE], SpvOpTypeFunction);
    bool same = length_of(type) == length_of(before) && type[2] == before[2];
    const uint32_t *parameter = function;
    for (uint32_t k = FIRST_PARAMETER; same && k < length_of(before); k++) {
        parameter += length_of(parameter);
        const uint32_t wanted =
            is_by_value(m, parameter[RESULT]) ? pointee(m, parameter[TYPE]) : parameter[TYPE];
        same = type[k] == wanted;
    }
    return same;
}

// The id of that type; 0: there is none yet.
static uint32_t type_of(const struct module *m, const struct output *out, const uint32_t *function) {
    for (size_t at = HEADER_WORDS; at < m->functions; at += length_of(m->words + at))
        if (opcode_of(m->words + at) == SpvOpTypeFunction && is_type_of(m, function, m->words + at))
            return m->words[at + 1];
    for (size_t i = 0; i < out->type_count; i++)
        if (is_type_of(m, function, out->words + out->types[i]))
            return out->words[out->types[i] + 1];
    return 0;
}

static void put_type(struct module *m, struct output *out, const uint32_t *function) {
    const size_t at = out->count;
    const uint32_t *parameter = function;
    copy(out, find(m, function[FUNCTION_TYPE], SpvOpTypeFunction));
    out->words[at + 1] = m->bound++;
    for (uint32_t k = FIRST_PARAMETER; k < length_of(out->words + at); k++) {
        parameter += length_of(parameter);
        if (is_by_value(m, parameter[RESULT]))
            out->words[at + k] = pointee(m, parameter[TYPE]);
    }
    out->types[out->type_count++] = at;
}

static void put_call(struct module *m, struct output *out, const uint32_t *call) {
    uint32_t *values = out->words + out->count; // after the loads, which come before the call
    uint32_t loads = 0;
    for (uint32_t k = ARGUMENTS; k < length_of(call); k++)
        loads += is_by_value(m, parameter_of(m, call, k)[RESULT]) && !m->dropped[call[k]];
    values += loads * 4;
    memcpy(values, call, length_of(call) * sizeof *call);
    for (uint32_t k = ARGUMENTS; k < length_of(call); k++) {
        const uint32_t *parameter = parameter_of(m, call, k);
        if (!is_by_value(m, parameter[RESULT]))
            continue;
        if (m->dropped[call[k]]) {
            values[k] = m->words[m->store[call[k]] + STORED];
            continue;
        }
        const uint32_t load[] = {pointee(m, parameter[TYPE]), m->bound, call[k]};
        put(out, SpvOpLoad, load, 3);
        values[k] = m->bound++;
    }
    out->count += length_of(call);
}

// From memory, or from what came by value.
static void put_load(struct module *m, struct output *out, const uint32_t *load) {
    const uint32_t *chain = find(m, load[LOADED], SpvOpAccessChain);
    if (is_by_value(m, load[LOADED])) {
        put(out, SpvOpCopyObject, load + 1, 3);
    } else if (chain && is_by_value(m, chain[BASE])) {
        const size_t at = out->count;
        copy(out, chain);
        out->words[at] = length_of(chain) << 16 | SpvOpCompositeExtract;
        out->words[at + TYPE] = load[TYPE];
        out->words[at + RESULT] = load[RESULT];
        for (uint32_t k = INDICES; k < length_of(chain); k++)
            out->words[at + k] = find(m, chain[k], SpvOpConstant)[3];
    } else {
        copy(out, load);
    }
}

static void put_instruction(struct module *m, struct output *out, const uint32_t *i) {
    const size_t at = out->count;
    switch (opcode_of(i)) {
    case SpvOpFunction:
        copy(out, i);
        out->words[at + FUNCTION_TYPE] = type_of(m, out, i);
        break;
    case SpvOpFunctionParameter:
        copy(out, i);
        if (is_by_value(m, i[RESULT]))
            out->words[at + TYPE] = pointee(m, i[TYPE]);
        break;
    case SpvOpVariable:
        if (!m->dropped[i[RESULT]])
            copy(out, i);
        break;
    case SpvOpStore:
        if (!(find(m, i[STORED_TO], SpvOpVariable) && m->dropped[i[STORED_TO]]))
            copy(out, i);
        break;
    case SpvOpAccessChain:
        if (!is_by_value(m, i[BASE]))
            copy(out, i);
        break;
    case SpvOpLoad:
        put_load(m, out, i);
        break;
    case SpvOpFunctionCall:
        put_call(m, out, i);
        break;
    default:
        copy(out, i);
        break;
    }
}

static void put_module(struct module *m, struct output *out) {
    memcpy(out->words, m->words, m->functions * sizeof *m->words);
    out->count = m->functions;
    for (size_t at = m->functions; at < m->count; at += length_of(m->words + at))
        if (opcode_of(m->words + at) == SpvOpFunction && type_of(m, out, m->words + at) == 0)
            put_type(m, out, m->words + at);
    for (size_t at = m->functions; at < m->count; at += length_of(m->words + at))
        put_instruction(m, out, m->words + at);
    out->words[BOUND] = m->bound;
}

uint32_t *by_value(const uint32_t *module, size_t *words) {
    const uint32_t ids = module[BOUND];
    struct module m = {.words = module,
                       .count = *words,
                       .bound = ids,
                       .defined = calloc(ids, sizeof *m.defined),
                       .kept = calloc(ids, sizeof *m.kept),
                       .uses = calloc(ids, sizeof *m.uses),
                       .store = calloc(ids, sizeof *m.store),
                       .dropped = calloc(ids, sizeof *m.dropped)};
    // An argument has a word of a call, and may need a load of four; a function's type is not longer than its
    // parameters.
    struct output out = {.words = malloc(6 * *words * sizeof *out.words),
                         .types = calloc(*words, sizeof *out.types)};
    if (m.defined && m.kept && m.uses && m.store && m.dropped && out.words && out.types) {
        index_module(&m);
        note_uses(&m);
        drop_variables(&m);
        put_module(&m, &out);
        *words = out.count;
    } else {
        free(out.words);
        out.words = NULL;
    }
    free(m.defined);
    free(m.kept);
    free(m.uses);
    free(m.store);
    free(m.dropped);
    free(out.types);
    return out.words;
}
