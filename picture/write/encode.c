// A picture as a file of the format asked for.
#include "core/heap.h"
#include "picture/write/encode_parts.h"
#include "picture/write/image.h"

#include <stdlib.h>

enum {
    DEEP_BITS = 16,
};

// From displayed bytes.
static void encode_bytes(const struct image *image, enum image_format format, const uint8_t *bytes,
                         struct strbuf *out) {
    const unsigned quality = image->coding.quality ? image->coding.quality : IMAGE_QUALITY;
    if (format == IMAGE_JPEG)
        encode_jpeg(image->width, image->height, bytes, image->note, quality, out);
    else if (format == IMAGE_WEBP)
        encode_webp(image->width, image->height, bytes, quality, out);
    else if (image->coding.bits == DEEP_BITS)
        encode_png_deep(image->width, image->height, bytes, image->note, out);
    else
        encode_png(image->width, image->height, bytes, image->note, out);
}

static void encode_displayed(const struct image *image, enum image_format format,
                             struct image_display display, struct strbuf *out) {
    const bool is_deep = format == IMAGE_PNG && image->coding.bits == DEEP_BITS;
    uint8_t *bytes = heap_array(heap_times(is_deep ? 6 : 3, image->width), image->height);
    if (bytes) {
        (is_deep ? image_to_words : image_to_bytes)(image, display, bytes);
        encode_bytes(image, format, bytes, out);
    } else {
        out->failed = true;
    }
    free(bytes);
}

void image_encode(const struct image *image, enum image_format format, struct image_display display,
                  struct strbuf *out) {
    if (format == IMAGE_PFM)
        encode_pfm(image->width, image->height, image->rgb, out);
    else if (format == IMAGE_HDR)
        encode_hdr(image->width, image->height, image->rgb, image->note, out);
    else if (format == IMAGE_EXR)
        encode_exr(image, out);
    else
        encode_displayed(image, format, display, out);
}
