// Memory on the heap for owners without an arena, and what happens when the system has none left.
//
// A program may name a handler (`heap_on_exhausted`): it is called when memory runs out and does not return,
// so no caller can mistake missing memory for another answer. Without a handler, as in tests and in programs
// that embed glint, these calls return NULL and their callers report that. For libraries that allocate by
// themselves and report that memory ran out, call `heap_exhausted`.
//
// Ownership: the caller's, to be freed by `free`. Errors: the handler, or NULL. Thread safety: all calls are
// safe on any thread except heap_on_exhausted, which belongs at the beginning of the program; the handler is
// called on the thread that got no memory.
#ifndef GLINT_CORE_HEAP_H
#define GLINT_CORE_HEAP_H

#include <stddef.h>
#include <stdint.h>

// Gets the number of bytes asked for, 0 if unknown. It must neither return nor allocate.
typedef void heap_handler(size_t size_bytes);
// NULL: none.
void heap_on_exhausted(heap_handler *handler);
// The system refused memory to a library, or to a system call. Returns only where there is no handler.
void heap_exhausted(size_t size_bytes);

// The one way to multiply sizes: a * b, or HEAP_TOO_MUCH if the product is at least that. HEAP_TOO_MUCH may
// be multiplied again, and a little may be added to it: no call ever grants it; asking for it is treated as
// memory having run out. `lint/sizes` finds products that are made without it.
#define HEAP_TOO_MUCH (SIZE_MAX / 2 + 1)
size_t heap_times(uint64_t a, uint64_t b);

// As malloc, calloc, realloc, strdup and strndup; large blocks get huge pages, as by heap_expect.
void *heap_alloc(size_t size);
void *heap_zeroed(uint64_t count, size_t size);
void *heap_resize(void *memory, size_t size);
// As heap_alloc and heap_resize, for `count` items of `size` bytes.
void *heap_array(uint64_t count, size_t size);
void *heap_resize_array(void *memory, uint64_t count, size_t size);
char *heap_text(const char *text);
char *heap_text_of(const char *text, size_t length);

// Says that all of this memory, which a library gave, is about to be filled. If the system has huge pages, it
// uses them: the first touch of each page is a fault, and a huge page has one instead of 512. Changes no
// byte.
void heap_expect(void *memory, size_t size);

// As arena_grow: makes room for one more item; `items` (NULL: none yet) holds `count` of `*capacity` items.
// Returns the array, moved to twice the room if it was full; on NULL the old one is unchanged.
void *heap_grow(void *items, size_t count, uint32_t *capacity, size_t item_size);

#endif
