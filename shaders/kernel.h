// A compiled kernel as a program holds it: a SPIR-V module, packed and deflated
// (docs/decisions/deflated-kernels.md).
//
// Errors: NULL. Ownership: kernel_inflate's memory is the caller's, to be freed by `free`. Thread safety:
// pure.
#ifndef GLINT_SHADERS_KERNEL_H
#define GLINT_SHADERS_KERNEL_H

#include <stddef.h>
#include <stdint.h>

struct kernel {
    const unsigned char *deflated; // zlib's format, RFC 1950
    size_t deflated_bytes;
    size_t part_bytes[3]; // of the packed module (shaders/packed.h)
    size_t words;         // of the module
};

// The module, `kernel->words` long; NULL: not enough memory.
uint32_t *kernel_inflate(const struct kernel *kernel);

#endif
