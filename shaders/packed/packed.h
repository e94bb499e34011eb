// How SPIR-V modules are packed before they are deflated (docs/decisions/deflated-kernels.md); shared by the
// tool that packs and the program that unpacks.
//
// Modules that share most of their code differ in nearly all of its words, since most words are ids. So the
// words of a function are written without ids: an id that the function introduces is the next number, one
// that it already has is stored as the distance back to it, and any other (a type, a constant, a function
// that it calls) is the next of its outer ids. The rest is the same in all modules that have the function,
// and is stored once.
//
// A module has bytes of its own: what comes before its first function, the outer ids of each function, and
// the order of its functions. Functions are grouped by the set of modules that have them. A module's
// functions are numbered through its groups. Bytes hold seven bits of a number each, the lowest first.
//
// The words' distances are an idea of SMOL-V (Aras Pranckevičius, 2016). Thread safety: pure.
#ifndef GLINT_SHADERS_PACKED_PACKED_H
#define GLINT_SHADERS_PACKED_PACKED_H

#include <spirv/unified1/spirv.h>
#include <stdbool.h>
#include <stdint.h>

enum {
    PACKED_HEADER_WORDS = 5, // of a module: stored as they are
};

// The parts that follow each other in the bytes of a module, or of a group.
enum packed_part {
    PACKED_HEADS, // of each instruction its opcode and its length
    PACKED_PLAIN, // words that are not ids; types
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
    return opcode == SpvOpExtInst ||
           (opcode >= SpvOpConstantTrue && opcode != SpvOpStore && opcode != SpvOpCopyMemory &&
            opcode != SpvOpDecorate && opcode != SpvOpMemberDecorate &&
            (opcode < SpvOpLoopMerge || opcode > SpvOpUnreachable));
}

// The first word of an instruction from which all words to its end are literals; a large number: none.
static inline uint32_t packed_literals(uint32_t opcode) {
    switch (opcode) {
    case SpvOpTypeInt:
    case SpvOpTypeFloat:
    case SpvOpDecorate:
    case SpvOpMemberDecorate:
        return 2;
    case SpvOpTypeImage:
    case SpvOpConstant:
    case SpvOpSpecConstant:
    case SpvOpStore:
    case SpvOpCopyMemory:
    case SpvOpLoopMerge:
        return 3;
    case SpvOpLoad:
    case SpvOpCompositeExtract:
        return 4;
    case SpvOpVectorShuffle:
    case SpvOpCompositeInsert:
    case SpvOpImageFetch:
        return 5;
    default:
        return opcode < 12 || (opcode > 12 && opcode < 19) ? 1 : UINT32_MAX; // modes, names, capabilities
    }
}

// Whether one word among ids is a literal.
static inline bool packed_single_literal(uint32_t opcode, uint32_t index) {
    switch (opcode) {
    case SpvOpTypePointer:
    case SpvOpSelectionMerge:
        return index == 2;
    case SpvOpTypeVector:
    case SpvOpTypeMatrix:
    case SpvOpSpecConstantOp:
    case SpvOpFunction:
    case SpvOpVariable:
        return index == 3;
    case SpvOpExtInst:
        return index == 4;
    case SpvOpSwitch:
        return index > 2 && index % 2 == 1;
    default:
        return false;
    }
}

// What word `index` of an instruction is, from 1 on. A wrong answer only costs bytes: no word is lost.
static inline enum packed_word packed_word_of(uint32_t opcode, uint32_t index) {
    if (index >= packed_literals(opcode) || packed_single_literal(opcode, index))
        return PACKED_LITERAL;
    return index == 1 && packed_has_type(opcode) ? PACKED_TYPE : PACKED_ID;
}

// Of an instruction before the first function: the word with the id that it makes or decorates. The ids that
// follow, in it and after it, are stored as their distance from this one.
static inline uint32_t packed_result(uint32_t opcode) {
    return packed_has_type(opcode) ? 2 : 1;
}

#endif
