#include "shaders/kernel.h"

#include "core/heap.h"

#include <stdlib.h>

#include <zlib.h>

uint32_t *kernel_inflate(const struct kernel *kernel) {
    uLongf bytes = kernel->words * sizeof(uint32_t);
    uint32_t *words = heap_alloc(bytes);
    int result = words ? uncompress((unsigned char *)words, &bytes, kernel->deflated, kernel->deflated_bytes)
                       : Z_MEM_ERROR;
    if (result == Z_OK && bytes == kernel->words * sizeof *words)
        return words;
    if (result == Z_MEM_ERROR)
        heap_exhausted(0);
    free(words);
    return NULL;
}
