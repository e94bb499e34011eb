// OpenEXR: linear floats or halves in the channels R, G and B, and layers beside them.
#include "core/heap.h"
#include "picture/write/encode_parts.h"
#include "picture/write/exr_file.h"
#include "picture/write/image.h"

#include <stdlib.h>
#include <string.h>

enum {
    COLORS = 3,
    HALF_BITS = 16,
};

static void put_colors(const struct image *image, struct exr_channel channels[COLORS]) {
    static const char *const names[COLORS] = {"R", "G", "B"};
    for (int k = 0; k < COLORS; k++)
        channels[k] =
            (struct exr_channel){.name = names[k],
                                 .type = image->coding.bits == HALF_BITS ? EXR_TYPE_HALF : EXR_TYPE_FLOAT,
                                 .first = image->rgb + k,
                                 .step_bytes = COLORS * sizeof(float)};
}

void encode_exr(const struct image *image, struct strbuf *out) {
    static const struct image_layers none;
    const struct image_layers *layers = image->layers ? image->layers : &none;
    struct exr_channel *channels = heap_array(layers->channel_count + COLORS, sizeof *channels);
    struct exr_attribute *attributes = heap_array(layers->attribute_count + 1, sizeof *attributes);
    if (channels && attributes) {
        put_colors(image, channels);
        if (layers->channel_count)
            memcpy(channels + COLORS, layers->channels, layers->channel_count * sizeof *channels);
        if (layers->attribute_count)
            memcpy(attributes, layers->attributes, layers->attribute_count * sizeof *attributes);
        attributes[layers->attribute_count] = (struct exr_attribute){"accuracy", image->note};
        const struct exr_file file = {.width = image->width,
                                      .height = image->height,
                                      .compression = image->coding.compression,
                                      .channels = channels,
                                      .channel_count = layers->channel_count + COLORS,
                                      .attributes = attributes,
                                      .attribute_count = layers->attribute_count + (image->note ? 1 : 0)};
        exr_file_write(&file, out);
    } else {
        out->failed = true;
    }
    free(attributes);
    free(channels);
}
