#include "picture/metrics/picture_file.h"

#include "core/heap.h"
#include "picture/read/picture_read.h"

#include <stdlib.h>

void picture_file_finish(struct picture_file *picture) {
    if (!picture)
        return;
    free(picture->rgb);
    *picture = (struct picture_file){0};
}

static float channel(const struct picture *picture, size_t at, size_t k) {
    if (picture_is_linear(picture))
        return picture_linear(picture, at, k);
    return (float)(picture_stored(picture, at, k) / (double)picture_greatest(picture->depth));
}

static const char *decode(str bytes, struct picture_header *header, struct picture_file *out) {
    struct picture picture;
    const char *fault = picture_decode(bytes, header, &picture);
    if (fault)
        return fault;
    const size_t pixels = heap_times(picture.width, picture.height);
    out->width = picture.width;
    out->height = picture.height;
    out->space = picture_is_linear(&picture) ? MEASURE_LINEAR : MEASURE_DISPLAYED;
    out->rgb = heap_array(heap_times(3, pixels), sizeof *out->rgb);
    for (size_t i = 0; out->rgb && i < pixels; i++)
        for (size_t k = 0; k < 3; k++)
            out->rgb[3 * i + k] = channel(&picture, i, k);
    picture_finish(&picture);
    return out->rgb ? NULL : picture_no_memory;
}

const char *picture_file_decode(str bytes, uint64_t most_bytes, struct picture_file *out, bool *unknown) {
    *out = (struct picture_file){0};
    *unknown = false;
    if (str_starts_with(bytes, STR("PF")) || str_starts_with(bytes, STR("Pf"))) {
        out->kind = image_format_info(IMAGE_PFM)->name;
        return pfm_decode(bytes, most_bytes, out);
    }
    struct picture_header header;
    const char *fault = picture_read_header(bytes, &header);
    out->kind = image_format_info(header.kind)->name;
    if (fault)
        return fault;
    if (header.kind == IMAGE_NONE) {
        *unknown = true;
        return "it is not a " IMAGE_COMPARED_NAMES " picture";
    }
    if (picture_memory(&header, 3 * sizeof *out->rgb) > most_bytes)
        return "it takes more memory than the limit image-memory";
    return decode(bytes, &header, out);
}
