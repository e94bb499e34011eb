// OpenEXR: linear floats or halves in the channels R, G and B.
#include "picture/write/encode_parts.h"
#include "picture/write/exr_file.h"
#include "picture/write/image.h"

#include <ctype.h>

enum {
    COLORS = 3,
    HALF_BITS = 16,
    NAME_ROOM = 32,
};

// "Scene hash": sceneHash.
static void name_attribute(const char *keyword, char name[NAME_ROOM]) {
    size_t length = 0;
    for (const char *k = keyword; *k && length + 1 < NAME_ROOM; k++)
        if (*k != ' ')
            name[length++] = (char)(k > keyword && k[-1] == ' ' ? toupper((unsigned char)*k)
                                    : k == keyword              ? tolower((unsigned char)*k)
                                                                : *k);
    name[length] = '\0';
}

void encode_exr(const struct image *image, const struct image_texts *texts, struct strbuf *out) {
    static const char *const names[COLORS] = {"R", "G", "B"};
    struct exr_channel channels[COLORS];
    struct exr_attribute attributes[IMAGE_TEXTS_MOST + 1];
    char attribute_names[IMAGE_TEXTS_MOST + 1][NAME_ROOM];
    for (uint32_t i = 0; i < texts->count; i++) {
        name_attribute(texts->items[i].keyword, attribute_names[i]);
        attributes[i] = (struct exr_attribute){attribute_names[i], texts->items[i].text};
    }
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
                                  .attributes = attributes,
                                  .attribute_count = texts->count};
    exr_file_write(&file, out);
}
