#include "core/heap.h"
#include "picture/read/picture_read.h"

#include <stdlib.h>

const char picture_no_memory[] = "there is not enough memory";

void picture_finish(struct picture *picture) {
    if (!picture)
        return;
    free(picture->pixels);
    *picture = (struct picture){0};
}

enum picture_depth picture_depth_of(const struct picture_header *header) {
    return header->kind == IMAGE_HDR   ? PICTURE_RGBE
           : header->kind == IMAGE_EXR ? PICTURE_FLOAT
           : header->is_16_bit         ? PICTURE_16
                                       : PICTURE_8;
}

uint64_t picture_memory(const struct picture_header *header, uint64_t more_bytes) {
    const uint64_t pixels = (uint64_t)header->width * header->height;
    const uint64_t each = picture_pixel_bytes(picture_depth_of(header)) + more_bytes;
    if (pixels > (UINT64_MAX - header->decoder_bytes) / each)
        return UINT64_MAX;
    return pixels * each + header->decoder_bytes;
}

struct picture picture_of_header(const struct picture_header *header) {
    enum picture_depth depth = picture_depth_of(header);
    return (struct picture){.width = header->width,
                            .height = header->height,
                            .depth = depth,
                            .size_bytes =
                                (uint64_t)header->width * header->height * picture_pixel_bytes(depth),
                            .ignored = header->ignored};
}
