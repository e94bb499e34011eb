#include "picture/read/jpeg_blocks.h"

#include "core/heap.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h> // jerror.h

#include <jerror.h>

enum {
    ALIGNMENT = 64, // more than the library's vector instructions need
};

static jvirt_barray_ptr request(j_common_ptr decoder, int pool, boolean pre_zero, JDIMENSION width,
                                JDIMENSION height, JDIMENSION most_rows) {
    struct jpeg_blocks *blocks = decoder->client_data;
    (void)pool;
    (void)pre_zero;
    (void)most_rows;
    if (blocks->count == JPEG_BLOCKS_PLANES)
        ERREXIT(decoder, JERR_COMPONENT_COUNT);
    struct jvirt_barray_control *plane = &blocks->planes[blocks->count++];
    *plane = (struct jvirt_barray_control){.width = width, .height = height};
    return plane;
}

static size_t plane_bytes(const struct jvirt_barray_control *plane) {
    return heap_times(heap_times(plane->width, plane->height), sizeof(JBLOCK));
}

// Rows of one plane: pointers to where they begin, as the library wants them.
static JBLOCK *make_rows(j_common_ptr decoder, struct jvirt_barray_control *plane, JBLOCK *first) {
    plane->rows = decoder->mem->alloc_large(decoder, JPOOL_IMAGE, plane->height * sizeof *plane->rows);
    for (JDIMENSION y = 0; y < plane->height; y++)
        plane->rows[y] = first + (size_t)y * plane->width;
    return first + (size_t)plane->height * plane->width;
}

static void realize(j_common_ptr decoder) {
    struct jpeg_blocks *blocks = decoder->client_data;
    uint64_t bytes = 0;
    for (unsigned i = 0; i < blocks->count; i++)
        bytes += plane_bytes(&blocks->planes[i]);
    if (bytes == 0 || blocks->memory)
        return;
    if (bytes > (uint64_t)decoder->mem->max_memory_to_use)
        ERREXITS(decoder, JERR_NO_BACKING_STORE, "");
    blocks->memory = heap_zeroed(bytes + ALIGNMENT, 1);
    if (!blocks->memory)
        ERREXIT1(decoder, JERR_OUT_OF_MEMORY, 0);
    JBLOCK *first = (JBLOCK *)(((uintptr_t)blocks->memory + ALIGNMENT - 1) & ~(uintptr_t)(ALIGNMENT - 1));
    for (unsigned i = 0; i < blocks->count; i++)
        first = make_rows(decoder, &blocks->planes[i], first);
}

static JBLOCKARRAY access(j_common_ptr decoder, jvirt_barray_ptr plane, JDIMENSION first, JDIMENSION count,
                          boolean writable) {
    (void)writable;
    if (!plane->rows || first > plane->height || count > plane->height - first)
        ERREXIT(decoder, JERR_BAD_VIRTUAL_ACCESS);
    return plane->rows + first;
}

void jpeg_blocks_use(j_decompress_ptr decoder, struct jpeg_blocks *blocks) {
    decoder->client_data = blocks;
    decoder->mem->request_virt_barray = request;
    decoder->mem->realize_virt_arrays = realize;
    decoder->mem->access_virt_barray = access;
}

void jpeg_blocks_finish(struct jpeg_blocks *blocks) {
    free(blocks->memory);
    *blocks = (struct jpeg_blocks){0};
}
