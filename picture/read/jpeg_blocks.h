// Memory for the coefficients of JPEG files that are decoded in several scans: each block of a component, row
// by row, in our own memory instead of libjpeg-turbo's "virtual arrays".
//
// They are most of the memory that decoding touches: two bytes per sample of the picture. Here they come
// zeroed from the system, in huge pages where it has them (core/heap.h), and are not cleared again.
//
// Errors: libjpeg-turbo's own, by its error handler: JERR_OUT_OF_MEMORY (with heap.h's handler before it),
// JERR_NO_BACKING_STORE where the arrays take more than decoder->mem->max_memory_to_use. Ownership: the
// struct is the caller's; jpeg_blocks_finish frees what it holds, after the decoder is destroyed. Thread
// safety: one thread.
#ifndef GLINT_PICTURE_READ_JPEG_BLOCKS_H
#define GLINT_PICTURE_READ_JPEG_BLOCKS_H

#include <stdio.h> // which jpeglib.h needs

#include <jpeglib.h>

enum {
    JPEG_BLOCKS_PLANES = MAX_COMPS_IN_SCAN, // components of a file that is accepted
};

struct jvirt_barray_control {
    JDIMENSION width, height; // in blocks
    JBLOCKARRAY rows;         // NULL: not made yet
};

struct jpeg_blocks {
    unsigned count;
    struct jvirt_barray_control planes[JPEG_BLOCKS_PLANES];
    void *memory;
};

// After jpeg_create_decompress; decoder->client_data points to `blocks`, which is zeroed.
void jpeg_blocks_use(j_decompress_ptr decoder, struct jpeg_blocks *blocks);
void jpeg_blocks_finish(struct jpeg_blocks *blocks);

#endif
