#include "core/heap.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include <sys/mman.h>

enum {
    HUGE_PAGE_BYTES = 1 << 21,
    LARGE_BYTES = 2 * HUGE_PAGE_BYTES, // a huge page lies in it, wherever it begins
};

// Set once, before there are threads.
static heap_handler *on_exhausted;

void heap_on_exhausted(heap_handler *handler) {
    on_exhausted = handler;
}

void heap_exhausted(size_t size_bytes) {
    if (on_exhausted)
        on_exhausted(size_bytes);
}

// Only whole huge pages are named, so nothing changes for the memory around them. A system that has none, or
// does not want them used, gives the memory as usual: its answer does not matter.
void heap_expect(void *memory, size_t size) {
    const int error = errno;
    const uintptr_t begin = ((uintptr_t)memory + HUGE_PAGE_BYTES - 1) & ~(uintptr_t)(HUGE_PAGE_BYTES - 1);
    const uintptr_t end = ((uintptr_t)memory + size) & ~(uintptr_t)(HUGE_PAGE_BYTES - 1);
    if (begin < end)
        madvise((void *)begin, end - begin, MADV_HUGEPAGE);
    errno = error;
}

// A request for nothing may be answered by NULL.
static void *checked(void *memory, size_t size) {
    if (!memory && size)
        heap_exhausted(size);
    else if (size >= LARGE_BYTES)
        heap_expect(memory, size);
    return memory;
}

size_t heap_times(uint64_t a, uint64_t b) {
    return b && a > (HEAP_TOO_MUCH - 1) / b ? HEAP_TOO_MUCH : (size_t)(a * b);
}

void *heap_alloc(size_t size) {
    return checked(size < HEAP_TOO_MUCH ? malloc(size) : NULL, size);
}

void *heap_zeroed(uint64_t count, size_t size) {
    const size_t all = heap_times(count, size);
    return checked(all < HEAP_TOO_MUCH ? calloc(1, all) : NULL, all);
}

void *heap_resize(void *memory, size_t size) {
    return checked(size < HEAP_TOO_MUCH ? realloc(memory, size) : NULL, size);
}

void *heap_array(uint64_t count, size_t size) {
    return heap_alloc(heap_times(count, size));
}

void *heap_resize_array(void *memory, uint64_t count, size_t size) {
    return heap_resize(memory, heap_times(count, size));
}

char *heap_text(const char *text) {
    return heap_text_of(text, strlen(text));
}

char *heap_text_of(const char *text, size_t length) {
    char *copy = heap_alloc(length + 1);
    if (!copy)
        return NULL;
    memcpy(copy, text, length);
    copy[length] = '\0';
    return copy;
}

void *heap_grow(void *items, size_t count, uint32_t *capacity, size_t item_size) {
    if (count < *capacity)
        return items;
    if (*capacity > UINT32_MAX / 2)
        return NULL;
    uint32_t wanted = *capacity ? *capacity * 2 : 8;
    void *moved = heap_resize_array(items, wanted, item_size);
    if (moved)
        *capacity = wanted;
    return moved;
}
