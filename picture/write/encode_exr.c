// OpenEXR: linear floats or halves in the channels R, G and B, and layers next to them.
#include "core/heap.h"
#include "picture/write/encode_internal.h"
#include "picture/write/exr_file.h"
#include "picture/write/rows.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum {
    COLORS = 3,
    HALF_BITS = 16,
    NAME_ROOM = 32,
};

typedef char text_name[NAME_ROOM];

// "Scene hash": sceneHash.
static void name_attribute(const char *keyword, text_name name) {
    size_t length = 0;
    for (const char *k = keyword; *k && length + 1 < NAME_ROOM; k++)
        if (*k != ' ')
            name[length++] = (char)(k > keyword && k[-1] == ' ' ? toupper((unsigned char)*k)
                                    : k == keyword              ? tolower((unsigned char)*k)
                                                                : *k);
    name[length] = '\0';
}

static void put_colors(const struct image *image, struct exr_channel channels[COLORS]) {
    static const char *const names[COLORS] = {"R", "G", "B"};
    for (int k = 0; k < COLORS; k++)
        channels[k] =
            (struct exr_channel){.name = names[k],
                                 .type = image->coding.bits == HALF_BITS ? EXR_TYPE_HALF : EXR_TYPE_FLOAT,
                                 .first = image->rgb + k,
                                 .step_bytes = COLORS * sizeof(float)};
}

static void put_texts(const struct image_texts *texts, text_name *names, struct exr_attribute *attributes) {
    for (uint32_t i = 0; i < texts->count; i++) {
        name_attribute(texts->items[i].keyword, names[i]);
        attributes[i] = (struct exr_attribute){names[i], texts->items[i].text};
    }
}

void encode_exr(const struct image *image, const struct image_texts *texts, struct strbuf *out) {
    static const struct image_layers none;
    const struct image_layers *layers = image->layers ? image->layers : &none;
    text_name names[IMAGE_TEXTS_MOST + 1];
    struct exr_channel *channels = heap_array(layers->channel_count + COLORS, sizeof *channels);
    struct exr_attribute *attributes =
        heap_array((uint64_t)layers->attribute_count + texts->count + 1, sizeof *attributes);
    if (channels && attributes) {
        put_colors(image, channels);
        if (layers->channel_count)
            memcpy(channels + COLORS, layers->channels, layers->channel_count * sizeof *channels);
        if (layers->attribute_count)
            memcpy(attributes, layers->attributes, layers->attribute_count * sizeof *attributes);
        put_texts(texts, names, attributes + layers->attribute_count);
        const struct exr_file file = {.width = image->width,
                                      .height = image->height,
                                      .compression = image->coding.compression,
                                      .channels = channels,
                                      .channel_count = layers->channel_count + COLORS,
                                      .attributes = attributes,
                                      .attribute_count = layers->attribute_count + texts->count};
        exr_file_write(&file, out);
    } else {
        out->failed = true;
    }
    free(attributes);
    free(channels);
}

bool encode_exr_rows(const struct image_rows *rows, const struct image_sink *sink) {
    static const float pixel[COLORS];
    text_name names[IMAGE_TEXTS_MOST + 1];
    struct exr_attribute attributes[IMAGE_TEXTS_MOST + 1];
    struct exr_channel channels[COLORS];
    struct strbuf failure;
    const struct image image = {.rgb = (float *)pixel, .coding = rows->coding};
    put_colors(&image, channels);
    put_texts(&rows->texts, names, attributes);
    const struct exr_file file = {.width = rows->width,
                                  .height = rows->height,
                                  .compression = rows->coding.compression,
                                  .channels = channels,
                                  .channel_count = COLORS,
                                  .attributes = attributes,
                                  .attribute_count = rows->texts.count,
                                  .rows = rows,
                                  .sink = sink};
    strbuf_init(&failure);
    exr_file_write(&file, &failure);
    const bool written = !failure.failed;
    strbuf_finish(&failure);
    return written;
}
