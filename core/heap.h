// Arrays on the heap that grow item by item, for owners without an arena.
//
// Ownership: the caller's, to be freed by `free`. Errors: NULL when memory runs out. Thread safety: pure.
#ifndef GLINT_CORE_HEAP_H
#define GLINT_CORE_HEAP_H

#include <stddef.h>
#include <stdint.h>

// As arena_grow: makes room for one more item; `items` (NULL: none yet) holds `count` of `*capacity` items.
// Returns the array, moved to twice the room if it was full; on NULL the old one is unchanged.
void *heap_grow(void *items, size_t count, uint32_t *capacity, size_t item_size);

#endif
