#include "core/heap.h"

#include <stdlib.h>

void *heap_grow(void *items, size_t count, uint32_t *capacity, size_t item_size) {
    if (count < *capacity)
        return items;
    if (*capacity > UINT32_MAX / 2)
        return NULL;
    uint32_t wanted = *capacity ? *capacity * 2 : 8;
    void *moved = realloc(items, wanted * item_size);
    if (moved)
        *capacity = wanted;
    return moved;
}
