// A compiled kernel as a program holds it: a SPIR-V module, packed and deflated; what it shares with other
// kernels is held once (docs/decisions/deflated-kernels.md).
//
// Errors: NULL. Ownership: kernel_inflate's memory is the caller's, to be freed by `free`. Thread safety:
// pure.
#ifndef GLINT_SHADERS_KERNEL_H
#define GLINT_SHADERS_KERNEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The parts of shaders/packed/packed.h, one after another.
struct kernel_bytes {
    const unsigned char *deflated; // zlib's format, RFC 1950
    uint32_t deflated_bytes;
    uint32_t part_bytes[5];
};

struct kernel {
    struct kernel_bytes own;
    const struct kernel_bytes *groups; // of functions, for all kernels
    const uint16_t *group;             // this kernel's groups, `group_count` of them
    size_t group_count;
    size_t packed_words; // of the module before its operations are decorated
    size_t words;        // of the module
    bool may_fuse;       // no operation is decorated
};

// The module, `kernel->words` long; NULL: not enough memory.
uint32_t *kernel_inflate(const struct kernel *kernel);

#endif
