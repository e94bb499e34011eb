#include "shaders/kernel.h"

#include <stdlib.h>

#include <zlib.h>

uint32_t *kernel_inflate(const struct kernel *kernel) {
    uLongf bytes = kernel->words * sizeof(uint32_t);
    uint32_t *words = malloc(bytes);
    if (words &&
        uncompress((unsigned char *)words, &bytes, kernel->deflated, kernel->deflated_bytes) == Z_OK &&
        bytes == kernel->words * sizeof *words)
        return words;
    free(words);
    return NULL;
}
