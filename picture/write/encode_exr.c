// OpenEXR: linear floats or halves in the channels R, G and B.
#include "picture/write/encode_parts.h"
#include "picture/write/exr_file.h"
#include "picture/write/image.h"

enum {
    COLORS = 3,
    HALF_BITS = 16,
};

void encode_exr(const struct image *image, struct strbuf *out) {
    static const char *const names[COLORS] = {"R", "G", "B"};
    struct exr_channel channels[COLORS];
    const struct exr_attribute note = {"accuracy", image->note};
    for (int k = 0; k < COLORS; k++)
        channels[k] =
            (struct exr_channel){.name = names[k],
                                 .type = image->coding.bits == HALF_BITS ? EXR_TYPE_HALF : EXR_TYPE_FLOAT,
                                 .first = image->rgb + k,
                                 .step_bytes = COLORS * sizeof(float)};
    const struct exr_file file = {.width = image->width,
                                  .height = image->height,
                                  .compression = image->coding.compression,
                                  .channels = channels,
                                  .channel_count = COLORS,
                                  .attributes = &note,
                                  .attribute_count = image->note ? 1 : 0};
    exr_file_write(&file, out);
}
