#include "picture/read/stb_decode.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

// stb_image's allocator takes no context, so the budget of the decode under way is a variable of its thread:
// the one exception to "no globals".
static _Thread_local size_t budget_left;
static _Thread_local bool budget_exceeded;

// Before each block, so that freeing knows what to give back.
struct block {
    size_t size;
    max_align_t begin;
};
#define BLOCK_HEAD offsetof(struct block, begin)

static void *budget_malloc(size_t size) {
    if (size > SIZE_MAX - BLOCK_HEAD || size + BLOCK_HEAD > budget_left) {
        budget_exceeded = true;
        return NULL;
    }
    // Zeroed, so that no file can make a picture of what lay in memory.
    struct block *block = calloc(1, BLOCK_HEAD + size);
    if (!block)
        return NULL;
    block->size = size;
    budget_left -= size + BLOCK_HEAD;
    return &block->begin;
}

static void budget_free(void *memory) {
    if (!memory)
        return;
    struct block *block = (struct block *)((char *)memory - BLOCK_HEAD);
    budget_left += block->size + BLOCK_HEAD;
    free(block);
}

static void *budget_realloc(void *memory, size_t old_size, size_t size) {
    void *moved = budget_malloc(size);
    if (!moved)
        return NULL;
    if (memory)
        memcpy(moved, memory, old_size < size ? old_size : size);
    budget_free(memory);
    return moved;
}

#define STBI_MALLOC(size)                        budget_malloc(size)
#define STBI_FREE(memory)                        budget_free(memory)
#define STBI_REALLOC_SIZED(memory, before, size) budget_realloc(memory, before, size)
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_ASSERT(condition) ((void)0)
#define STBI_MAX_DIMENSIONS    (1 << 27)
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>

void *stb_decode(const struct stb_job *job, const char **why) {
    int width = 0, height = 0, channels = 0;
    void *pixels;
    if (job->count > INT_MAX) {
        *why = "it is larger than 2 GiB";
        return NULL;
    }
    budget_left = job->budget_bytes;
    budget_exceeded = false;
    if (job->is_16_bit)
        pixels = stbi_load_16_from_memory(job->bytes, (int)job->count, &width, &height, &channels, 4);
    else
        pixels = stbi_load_from_memory(job->bytes, (int)job->count, &width, &height, &channels, 4);
    *why = pixels            ? NULL
           : budget_exceeded ? "it has more data than a picture of its size needs"
                             : stbi_failure_reason();
    if (pixels && ((uint32_t)width != job->width || (uint32_t)height != job->height)) {
        *why = "its parts contradict each other about its size";
        budget_free(pixels);
        return NULL;
    }
    return pixels;
}

void stb_free(void *pixels) {
    budget_free(pixels);
}
