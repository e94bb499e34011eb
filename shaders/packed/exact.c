#include "shaders/packed/exact.h"

enum {
    HEADER_WORDS = 5,
    MAGIC = 0x07230203,
    DECORATION_NO_CONTRACTION = 42,
    MODE_NAN_PRESERVE = 4461,
    DOUBLE_BITS = 64,
    OP_EXECUTION_MODE = 16,
    OP_TYPE_FLOAT = 22,
    OP_DECORATE = 71,
    OP_DECORATION_GROUP = 73,
    OP_TYPE_VOID = 19,
    OP_TYPE_FORWARD_POINTER = 39,
    OP_SPEC_CONSTANT_OP = 52,
    OP_CONSTANT_TRUE = 41,
    OP_FUNCTION = 54,
    OP_FNEGATE = 127,
    OP_FADD = 129,
    OP_FSUB = 131,
    OP_FMUL = 133,
    OP_FDIV = 136,
    OP_FREM = 140,
    OP_FMOD = 141,
    OP_VECTOR_TIMES_SCALAR = 142,
};

static bool is_arithmetic(uint32_t opcode) {
    switch (opcode) {
    case OP_FNEGATE:
    case OP_FADD:
    case OP_FSUB:
    case OP_FMUL:
    case OP_FDIV:
    case OP_FREM:
    case OP_FMOD:
    case OP_VECTOR_TIMES_SCALAR:
        return true;
    default:
        return false;
    }
}

bool exact_is_sound(const uint32_t *module, size_t words) {
    if (words < HEADER_WORDS || module[0] != MAGIC)
        return false;
    for (size_t at = HEADER_WORDS; at < words; at += module[at] >> 16)
        if (module[at] >> 16 == 0 || module[at] >> 16 > words - at)
            return false;
    return true;
}

// Annotations end where the first type or constant begins (section 2.4, logical layout).
static size_t annotations_end(const uint32_t *module, size_t words) {
    for (size_t at = HEADER_WORDS; at < words; at += module[at] >> 16) {
        const uint32_t opcode = module[at] & 0xffff;
        if ((opcode >= OP_TYPE_VOID && opcode <= OP_TYPE_FORWARD_POINTER) ||
            (opcode >= OP_CONSTANT_TRUE && opcode <= OP_FUNCTION))
            return at;
    }
    return words;
}

static bool has_doubles(const uint32_t *module, size_t words) {
    for (size_t at = HEADER_WORDS; at < words; at += module[at] >> 16)
        if ((module[at] & 0xffff) == OP_TYPE_FLOAT && module[at + 2] == DOUBLE_BITS)
            return true;
    return false;
}

// Copies what is before types and constants; gives the words written.
static size_t copy_head(const uint32_t *module, size_t words, size_t end, uint32_t *out) {
    const bool doubles = has_doubles(module, words);
    size_t count = 0;
    for (; count < HEADER_WORDS; count++)
        out[count] = module[count];
    for (size_t at = HEADER_WORDS; at < end; at += module[at] >> 16) {
        const uint32_t length = module[at] >> 16, opcode = module[at] & 0xffff;
        for (uint32_t i = 0; i < length; i++)
            out[count++] = module[at + i];
        if (doubles && opcode == OP_EXECUTION_MODE && module[at + 2] == MODE_NAN_PRESERVE) {
            for (uint32_t i = 0; i + 1 < length; i++)
                out[count++] = module[at + i];
            out[count++] = DOUBLE_BITS;
        }
    }
    return count;
}

size_t exact_decorate(const uint32_t *module, size_t words, bool plain, bool *done, uint32_t *out) {
    const size_t end = annotations_end(module, words);
    size_t count = copy_head(module, words, end, out);
    for (size_t at = HEADER_WORDS; at < end; at += module[at] >> 16)
        if ((module[at] & 0xffff) == OP_DECORATE && module[at + 2] == DECORATION_NO_CONTRACTION)
            done[module[at + 1]] = true;
    for (size_t at = end; at < words; at += module[at] >> 16) {
        if (plain || !is_arithmetic(module[at] & 0xffff) || done[module[at + 2]])
            continue;
        out[count++] = 3u << 16 | OP_DECORATE;
        out[count++] = module[at + 2];
        out[count++] = DECORATION_NO_CONTRACTION;
    }
    for (size_t at = end; at < words; at++)
        out[count++] = module[at];
    return count;
}
