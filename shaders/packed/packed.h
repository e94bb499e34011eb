// How SPIR-V modules are packed before they are deflated (docs/decisions/deflated-kernels.md); shared by the
// tool that packs and the program that unpacks.
//
// Modules that share most of their code differ in nearly all of its words, since most words are ids. So the
// words of a function are written without ids: one that the function introduces is the next number, one that
// it has is the distance back to it, and any other (a type, a constant, a function that it calls) is the next
// of its outer ids. What is left is the same in all modules that have the function, and is stored once.
//
// A module has bytes of its own: what stands before its first function, the outer ids of each function, and
// the order of its functions. Its functions are in groups: those that the same modules have. A module's
// functions are numbered through its groups. Bytes hold seven bits of a number each, the lowest first.
//
// The words' distances are an idea of SMOL-V (Aras Pranckevičius, 2016). Thread safety: pure.
#ifndef GLINT_SHADERS_PACKED_PACKED_H
#define GLINT_SHADERS_PACKED_PACKED_H

#include <stdbool.h>
#include <stdint.h>

enum {
    PACKED_HEADER_WORDS = 5, // of a module: as they are
    PACKED_FUNCTION = 54,    // the opcodes between which a function is
    PACKED_FUNCTION_END = 56,
    PACKED_LABEL = 248,
};

// The parts that follow each other in the bytes of a module, or of a group.
enum packed_part {
    PACKED_HEADS, // of each instruction its opcode and its length
    PACKED_PLAIN, // words that are no ids; types
    PACKED_REFS,  // ids
    PACKED_CODE_PARTS,
    PACKED_SIZES = PACKED_CODE_PARTS, // of a group: how many bytes of each part above are each function's
    PACKED_OUTER = PACKED_CODE_PARTS, // of a module: outer ids, in the order in which functions meet them
    PACKED_ORDER,                     // of a module: its functions by their numbers
    PACKED_PARTS,
};

enum packed_word {
    PACKED_LITERAL,
    PACKED_TYPE,
    PACKED_ID,
};

// Whether an instruction begins with a type and its result.
static inline bool packed_has_type(uint32_t opcode) {
    enum {
        OP_EXT_INST = 12,
        OP_CONSTANT_TRUE = 41,
        OP_STORE = 62,
        OP_COPY_MEMORY = 63,
        OP_DECORATE = 71,
        OP_MEMBER_DECORATE = 72,
        OP_LOOP_MERGE = 246,
        OP_UNREACHABLE = 255,
    };
    return opcode == OP_EXT_INST ||
           (opcode >= OP_CONSTANT_TRUE && opcode != OP_STORE && opcode != OP_COPY_MEMORY &&
            opcode != OP_DECORATE && opcode != OP_MEMBER_DECORATE &&
            (opcode < OP_LOOP_MERGE || opcode > OP_UNREACHABLE));
}

// The first of the words of an instruction that are literals to its end; a large number: none.
static inline uint32_t packed_literals(uint32_t opcode) {
    switch (opcode) {
    case 21: // OpTypeInt
    case 22: // OpTypeFloat
    case 71: // OpDecorate
    case 72: // OpMemberDecorate
        return 2;
    case 25:  // OpTypeImage
    case 43:  // OpConstant
    case 50:  // OpSpecConstant
    case 62:  // OpStore
    case 63:  // OpCopyMemory
    case 246: // OpLoopMerge
        return 3;
    case 61: // OpLoad
    case 81: // OpCompositeExtract
        return 4;
    case 79: // OpVectorShuffle
    case 82: // OpCompositeInsert
    case 95: // OpImageFetch
        return 5;
    default:
        return opcode < 12 || (opcode > 12 && opcode < 19) ? 1 : UINT32_MAX; // modes, names, capabilities
    }
}

// Whether one word among ids is a literal.
static inline bool packed_single_literal(uint32_t opcode, uint32_t index) {
    switch (opcode) {
    case 32:  // OpTypePointer
    case 247: // OpSelectionMerge
        return index == 2;
    case 23: // OpTypeVector
    case 24: // OpTypeMatrix
    case 52: // OpSpecConstantOp
    case 54: // OpFunction
    case 59: // OpVariable
        return index == 3;
    case 12: // OpExtInst
        return index == 4;
    case 251: // OpSwitch
        return index > 2 && index % 2 == 1;
    default:
        return false;
    }
}

// What word `index` of an instruction is, from 1 on. A wrong answer costs bytes, not a word.
static inline enum packed_word packed_word_of(uint32_t opcode, uint32_t index) {
    if (index >= packed_literals(opcode) || packed_single_literal(opcode, index))
        return PACKED_LITERAL;
    return index == 1 && packed_has_type(opcode) ? PACKED_TYPE : PACKED_ID;
}

// The word of an instruction that the ids after it are counted from, before the first function: what it makes
// or decorates.
static inline uint32_t packed_result(uint32_t opcode) {
    return packed_has_type(opcode) ? 2 : 1;
}

#endif
