// The allocation functions, which fail as the plan says.
#define _GNU_SOURCE

#include "faults.h"

#include <errno.h>
#include <malloc.h>
#include <stdlib.h>

// The C library's own, under the names that it keeps for this.
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *memory);

#define EXPORTED __attribute__((visibility("default")))

// The last block of the thread that the program itself freed, if nothing was asked for since: a request that
// fits is given it, without the system. glint prepares so for a library that does not look at what it gets.
static _Thread_local size_t freed_bytes;

static bool is_at_hand(size_t size, const void *address) {
    size_t at_hand = freed_bytes;
    freed_bytes = 0;
    return size <= at_hand && !faults_is_program(address);
}

static bool strikes(const char *call, const void *address) {
    static _Thread_local bool inside; // what finds out who calls may allocate
    freed_bytes = 0;
    if (!faults || faults->kind != FAULTS_MEMORY || inside)
        return false;
    inside = true;
    bool strikes = faults_is_ours(address) && faults_strike(FAULTS_MEMORY, call);
    inside = false;
    if (strikes)
        errno = ENOMEM;
    return strikes;
}

EXPORTED void free(void *memory) {
    freed_bytes = memory && faults_is_program(__builtin_return_address(0)) ? malloc_usable_size(memory) : 0;
    __libc_free(memory);
}

EXPORTED void *malloc(size_t size) {
    return !is_at_hand(size, __builtin_return_address(0)) && strikes("malloc", __builtin_return_address(0))
               ? NULL
               : __libc_malloc(size);
}

EXPORTED void *calloc(size_t count, size_t size) {
    return strikes("calloc", __builtin_return_address(0)) ? NULL : __libc_calloc(count, size);
}

EXPORTED void *realloc(void *memory, size_t size) {
    return size && strikes("realloc", __builtin_return_address(0)) ? NULL : __libc_realloc(memory, size);
}

EXPORTED void *reallocarray(void *memory, size_t count, size_t size) {
    if (size && count > SIZE_MAX / size) {
        errno = ENOMEM;
        return NULL;
    }
    return strikes("reallocarray", __builtin_return_address(0)) ? NULL : __libc_realloc(memory, count * size);
}

EXPORTED void *memalign(size_t alignment, size_t size) {
    return strikes("memalign", __builtin_return_address(0)) ? NULL : __libc_memalign(alignment, size);
}

EXPORTED void *aligned_alloc(size_t alignment, size_t size) {
    return strikes("aligned_alloc", __builtin_return_address(0)) ? NULL : __libc_memalign(alignment, size);
}

EXPORTED int posix_memalign(void **memory, size_t alignment, size_t size) {
    *memory =
        strikes("posix_memalign", __builtin_return_address(0)) ? NULL : __libc_memalign(alignment, size);
    return *memory ? 0 : ENOMEM;
}
