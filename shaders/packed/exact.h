// Decorates every floating-point arithmetic operation of a SPIR-V module with NoContraction, so that no
// compiler may fuse a multiplication and an addition. A module that computes with doubles and requests
// SignedZeroInfNanPreserve for floats then requests it for doubles too: GLSL can request it for one width
// only.
//
// GLSL's `precise` stops at function calls and does nothing for dot and cross; watertight intersection and
// conservative boxes need every operation rounded once. Shared by tools/spirv_exact and the program, which
// stores modules undecorated. Reference: SPIR-V Specification 1.6, sections 2.3, 2.4 and 3.
//
// In: a sound module. Out: the decorated one. Ownership: all memory is the caller's. Thread safety: pure.
#ifndef GLINT_SHADERS_PACKED_EXACT_H
#define GLINT_SHADERS_PACKED_EXACT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Whether the words are instructions to their end.
bool exact_is_sound(const uint32_t *module, size_t words);

// The most words after decoration: an operation has at least 3 words, a mode 4.
#define EXACT_ROOM(words) ((words)*2 + 7)

// Writes to `out`, which has room for EXACT_ROOM(words), and returns the number of words. `done` holds false
// for each of the module's module[3] ids. With `plain` no operation is decorated.
size_t exact_decorate(const uint32_t *module, size_t words, bool plain, bool *done, uint32_t *out);

#endif
