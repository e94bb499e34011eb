#include "shaders/packed/exact.h"

#include <spirv/unified1/spirv.h>

enum {
    HEADER_WORDS = 5,
    DOUBLE_BITS = 64,
};

static bool is_arithmetic(uint32_t opcode) {
    switch (opcode) {
    case SpvOpFNegate:
    case SpvOpFAdd:
    case SpvOpFSub:
    case SpvOpFMul:
    case SpvOpFDiv:
    case SpvOpFRem:
    case SpvOpFMod:
    case SpvOpVectorTimesScalar:
        return true;
    default:
        return false;
    }
}

bool exact_is_sound(const uint32_t *module, size_t words) {
    if (words < HEADER_WORDS || module[0] != SpvMagicNumber)
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
        if ((opcode >= SpvOpTypeVoid && opcode <= SpvOpTypeForwardPointer) ||
            (opcode >= SpvOpConstantTrue && opcode <= SpvOpFunction))
            return at;
    }
    return words;
}

static bool has_doubles(const uint32_t *module, size_t words) {
    for (size_t at = HEADER_WORDS; at < words; at += module[at] >> 16)
        if ((module[at] & 0xffff) == SpvOpTypeFloat && module[at + 2] == DOUBLE_BITS)
            return true;
    return false;
}

// Copies everything before types and constants; returns the number of words written.
static size_t copy_head(const uint32_t *module, size_t words, size_t end, uint32_t *out) {
    const bool doubles = has_doubles(module, words);
    size_t count = 0;
    for (; count < HEADER_WORDS; count++)
        out[count] = module[count];
    for (size_t at = HEADER_WORDS; at < end; at += module[at] >> 16) {
        const uint32_t length = module[at] >> 16, opcode = module[at] & 0xffff;
        for (uint32_t i = 0; i < length; i++)
            out[count++] = module[at + i];
        if (doubles && opcode == SpvOpExecutionMode &&
            module[at + 2] == SpvExecutionModeSignedZeroInfNanPreserve) {
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
        if ((module[at] & 0xffff) == SpvOpDecorate && module[at + 2] == SpvDecorationNoContraction)
            done[module[at + 1]] = true;
    for (size_t at = end; at < words; at += module[at] >> 16) {
        if (plain || !is_arithmetic(module[at] & 0xffff) || done[module[at + 2]])
            continue;
        out[count++] = 3u << 16 | SpvOpDecorate;
        out[count++] = module[at + 2];
        out[count++] = SpvDecorationNoContraction;
    }
    for (size_t at = end; at < words; at++)
        out[count++] = module[at];
    return count;
}
