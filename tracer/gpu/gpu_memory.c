// Memory that the Vulkan loader and the driver request from glint: if it runs out, the program learns that at
// once, and not as a driver that cannot be found.
#include "core/heap.h"
#include "tracer/gpu/gpu_private.h"

#include <stdlib.h>
#include <string.h>

// Drivers also request zero bytes and expect an address. In front of each piece: what the heap returned, and
// how much was requested.
struct piece {
    void *given;
    size_t size;
};

static VKAPI_ATTR void *VKAPI_CALL allocate(void *user, size_t size, size_t alignment,
                                            VkSystemAllocationScope scope) {
    (void)user;
    (void)scope;
    if (size > SIZE_MAX / 2)
        return NULL;
    const size_t step = alignment < sizeof(struct piece) ? sizeof(struct piece) : alignment;
    char *given = heap_alloc(size + sizeof(struct piece) + step);
    if (!given)
        return NULL;
    const uintptr_t first = (uintptr_t)given + sizeof(struct piece);
    struct piece *piece = (struct piece *)(given + sizeof(struct piece) + (step - first % step) % step);
    piece[-1] = (struct piece){given, size};
    return piece;
}

static VKAPI_ATTR void VKAPI_CALL release(void *user, void *memory) {
    (void)user;
    if (memory)
        free(((struct piece *)memory)[-1].given);
}

static VKAPI_ATTR void *VKAPI_CALL reallocate(void *user, void *memory, size_t size, size_t alignment,
                                              VkSystemAllocationScope scope) {
    void *moved = size ? allocate(user, size, alignment, scope) : NULL;
    if (memory && moved) {
        const size_t had = ((struct piece *)memory)[-1].size;
        memcpy(moved, memory, had < size ? had : size);
    }
    if (moved || size == 0)
        release(user, memory);
    return moved;
}

const VkAllocationCallbacks gpu_memory = {
    .pfnAllocation = allocate, .pfnReallocation = reallocate, .pfnFree = release};
