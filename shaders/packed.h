// How a SPIR-V module is packed before it is deflated (docs/decisions/deflated-kernels.md); shared by the
// tool that packs and the program that unpacks.
//
// Most of a module's words are ids, and code that does the same has others each time. So an id is written as
// its distance from the last result: what repeats then has the same bytes. Three parts follow each other, of
// bytes that hold seven bits each, the lowest first: of each instruction its opcode and its length; words as
// they are; distances, those below zero as odd numbers. The idea is that of SMOL-V (Aras Pranckevičius,
// 2016). Thread safety: pure.
#ifndef GLINT_SHADERS_PACKED_H
#define GLINT_SHADERS_PACKED_H

#include <stdint.h>

enum {
    PACKED_HEADER_WORDS = 5, // of a module: as they are
    PACKED_PARTS = 3,
};

enum packed_kind {
    PACKED_PLAIN,   // all words as they are: names, types, constants
    PACKED_NO_TYPE, // all words are ids
    PACKED_RESULT,  // a type, as it is; then ids, of which the first is the result
};

static inline enum packed_kind packed_kind_of(uint32_t opcode) {
    enum {
        OP_EXT_INST_IMPORT = 11,
        OP_TYPE_FORWARD_POINTER = 39,
        OP_CONSTANT = 43,
        OP_SPEC_CONSTANT = 50,
        OP_STORE = 62,
        OP_COPY_MEMORY = 63,
        OP_DECORATE = 71,
        OP_MEMBER_DECORATE = 72,
        OP_LOOP_MERGE = 246,
        OP_UNREACHABLE = 255,
    };
    if (opcode <= OP_EXT_INST_IMPORT || (opcode > 12 && opcode <= OP_TYPE_FORWARD_POINTER) ||
        opcode == OP_CONSTANT || opcode == OP_SPEC_CONSTANT || opcode == OP_DECORATE ||
        opcode == OP_MEMBER_DECORATE)
        return PACKED_PLAIN;
    if (opcode == OP_STORE || opcode == OP_COPY_MEMORY ||
        (opcode >= OP_LOOP_MERGE && opcode <= OP_UNREACHABLE))
        return PACKED_NO_TYPE;
    return PACKED_RESULT;
}

// The place of the word that later distances count from, 0 for none: the result of an instruction, or a
// label.
static inline uint32_t packed_result(enum packed_kind kind, uint32_t opcode) {
    enum {
        OP_LABEL = 248
    };
    return kind == PACKED_RESULT ? 2 : opcode == OP_LABEL ? 1 : 0;
}

#endif
