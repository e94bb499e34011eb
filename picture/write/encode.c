// A picture as a file of the format asked for.
#include "core/heap.h"
#include "picture/write/encode_internal.h"
#include "picture/write/image.h"

#include <stdlib.h>

enum {
    DEEP_BITS = 16,
};

// From displayed bytes.
static void encode_bytes(const struct image *image, enum image_format format, const uint8_t *bytes,
                         const struct image_texts *texts, struct strbuf *out) {
    const unsigned quality = image->coding.quality ? image->coding.quality : IMAGE_QUALITY;
    if (format == IMAGE_JPEG)
        encode_jpeg(image->width, image->height, bytes, texts, quality, out);
    else if (format == IMAGE_WEBP)
        encode_webp(image->width, image->height, bytes, quality, out);
    else if (image->coding.bits == DEEP_BITS)
        encode_png_deep(image->width, image->height, bytes, texts, out);
    else
        encode_png(image->width, image->height, bytes, texts, out);
}

static void encode_displayed(const struct image *image, enum image_format format,
                             struct image_display display, const struct image_texts *texts,
                             struct strbuf *out) {
    const bool is_deep = format == IMAGE_PNG && image->coding.bits == DEEP_BITS;
    uint8_t *bytes = heap_array(heap_times(is_deep ? 6 : 3, image->width), image->height);
    if (bytes) {
        (is_deep ? image_to_words : image_to_bytes)(image, display, bytes);
        encode_bytes(image, format, bytes, texts, out);
    } else {
        out->failed = true;
    }
    free(bytes);
}

void image_encode(const struct image *image, enum image_format format, struct image_display display,
                  struct strbuf *out) {
    struct image_text items[IMAGE_TEXTS_MOST + 1];
    struct image_texts texts = {items, 0};
    if (image->note)
        items[texts.count++] = (struct image_text){IMAGE_NOTE_KEYWORD, image->note};
    for (uint32_t i = 0; i < image->texts.count && i < IMAGE_TEXTS_MOST; i++)
        items[texts.count++] = image->texts.items[i];
    if (format == IMAGE_PFM)
        encode_pfm(image->width, image->height, image->rgb, out);
    else if (format == IMAGE_HDR)
        encode_hdr(image->width, image->height, image->rgb, &texts, out);
    else if (format == IMAGE_EXR)
        encode_exr(image, &texts, out);
    else
        encode_displayed(image, format, display, &texts, out);
}
