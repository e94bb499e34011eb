#include "core/arena.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    ARENA_ALIGN = 16,
    ARENA_BLOCK_BYTES = 64 * 1024,
    ARENA_SHARED_BYTES = ARENA_BLOCK_BYTES / 4, // a larger allocation gets a block of its own
};

struct arena_block {
    struct arena_block *previous;
    size_t used;
    size_t size;
    size_t reserved; // keeps the bytes behind the header aligned to 16
};

void arena_init(struct arena *arena, size_t cap_bytes) {
    *arena = (struct arena){.cap_bytes = cap_bytes};
}

void arena_finish(struct arena *arena) {
    if (!arena)
        return;
    struct arena_block *block = arena->last;
    while (block) {
        struct arena_block *previous = block->previous;
        free(block);
        block = previous;
    }
    arena->last = NULL;
    arena->used_bytes = 0;
}

void arena_set_guard(struct arena *arena, struct arena_guard *guard) {
    arena->guard = guard;
    if (guard)
        guard->fault = ARENA_FAULT_NONE;
}

static struct arena_block *new_block(size_t size) {
    struct arena_block *block = calloc(1, sizeof(struct arena_block) + size);
    if (block)
        block->size = size;
    return block;
}

// A block with room for `need` bytes. A block of a single allocation goes behind the last one, which
// stays in use: what it has left is not lost.
static struct arena_block *block_with_room(struct arena *arena, size_t need) {
    struct arena_block *last = arena->last;
    if (last && last->size - last->used >= need)
        return last;
#ifdef GLINT_ARENA_EXACT
    bool single = true;
#else
    bool single = need > ARENA_SHARED_BYTES;
#endif
    struct arena_block *block = new_block(single ? need : ARENA_BLOCK_BYTES);
    if (block && single && last) {
        block->previous = last->previous;
        last->previous = block;
    } else if (block) {
        block->previous = last;
        arena->last = block;
    }
    return block;
}

static void *alloc_or_fault(struct arena *arena, size_t size, enum arena_fault *fault) {
    *fault = ARENA_FAULT_CAP;
    if (size > arena->cap_bytes || arena->used_bytes > arena->cap_bytes - size)
        return NULL;
    *fault = ARENA_FAULT_SYSTEM;
    if (size > SIZE_MAX / 2)
        return NULL;
#ifdef GLINT_ARENA_EXACT
    size_t need = size ? size : 1;
#else
    size_t need = size ? (size + ARENA_ALIGN - 1) & ~(size_t)(ARENA_ALIGN - 1) : ARENA_ALIGN;
#endif
    struct arena_block *block = block_with_room(arena, need);
    if (!block)
        return NULL;
    void *memory = (char *)(block + 1) + block->used;
    block->used += need;
    arena->used_bytes += need;
    return memory;
}

void *arena_try_alloc(struct arena *arena, size_t size) {
    enum arena_fault fault;
    return alloc_or_fault(arena, size, &fault);
}

_Noreturn void arena_raise(struct arena *arena, enum arena_fault fault) {
    if (!arena->guard)
        abort();
    arena->guard->fault = fault;
    longjmp(arena->guard->jump, 1);
}

void *arena_alloc(struct arena *arena, size_t size) {
    enum arena_fault fault;
    void *memory = alloc_or_fault(arena, size, &fault);
    if (!memory)
        arena_raise(arena, fault);
    return memory;
}

void *arena_alloc_array(struct arena *arena, size_t count, size_t size) {
    bool overflows = size && count > SIZE_MAX / size;
    return arena_alloc(arena, overflows ? SIZE_MAX : count * size);
}

str arena_copy(struct arena *arena, str s) {
    char *copy = arena_alloc(arena, s.len + 1);
    if (s.len)
        memcpy(copy, s.ptr, s.len);
    return (str){copy, s.len};
}

// The arguments are read twice, with the jump that `arena_alloc` may take in between, outside of both.
str arena_format(struct arena *arena, const char *format, ...) {
    va_list args;
    va_start(args, format);
    int length = vsnprintf(NULL, 0, format, args);
    va_end(args);
    size_t size = length < 0 ? 0 : (size_t)length;
    char *text = arena_alloc(arena, size + 1);
    va_start(args, format);
    vsnprintf(text, size + 1, format, args);
    va_end(args);
    return (str){text, size};
}

void *arena_grow(struct arena *arena, void *items, size_t count, uint32_t *capacity, size_t item_size) {
    if (count < *capacity)
        return items;
    uint32_t wanted = *capacity == 0 ? 8 : *capacity > UINT32_MAX / 2 ? UINT32_MAX : *capacity * 2;
    // A full list of 2^32 - 1 items cannot grow.
    if (count >= wanted)
        arena_raise(arena, ARENA_FAULT_SYSTEM);
    void *moved = arena_alloc_array(arena, wanted, item_size);
    if (count)
        memcpy(moved, items, count * item_size);
    *capacity = wanted;
    return moved;
}
