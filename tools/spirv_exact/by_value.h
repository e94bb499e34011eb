// What a function only reads it takes by value: a module without the copies that are made for each call.
//
// glslang passes every parameter as a pointer to a variable of its own, which the caller fills before the
// call. Mesa reads and writes each member of each of them, and looks for long for what of that is needed:
// with this, half of what lavapipe takes from a module to its own instructions
// (docs/decisions/first-picture.md).
//
// In: a sound module as glslang writes it (logical addressing, a parameter's variable has no other use);
// `*words` is its length, and that of the result afterwards. Out: a module on the heap that does the same, or
// NULL: no memory. A pointer that is written to, passed on or indexed by what is not a constant stays one.
#ifndef GLINT_TOOLS_SPIRV_EXACT_BY_VALUE_H
#define GLINT_TOOLS_SPIRV_EXACT_BY_VALUE_H

#include <stddef.h>
#include <stdint.h>

uint32_t *by_value(const uint32_t *module, size_t *words);

#endif
