#include "picture/write/image.h"

#include "picture/write/encode_parts.h"

#include <stdlib.h>

bool image_init(struct image *image, uint32_t width, uint32_t height) {
    *image = (struct image){width, height, calloc((size_t)width * height, 3 * sizeof *image->rgb)};
    return image->rgb != NULL;
}

void image_finish(struct image *image) {
    if (!image)
        return;
    free(image->rgb);
    *image = (struct image){0};
}

static const char *const endings[] = {[IMAGE_PNG] = ".png", [IMAGE_PFM] = ".pfm", [IMAGE_HDR] = ".hdr"};

bool image_format_of_path(str path, enum image_format *format) {
    for (int i = 0; i < (int)(sizeof endings / sizeof *endings); i++)
        if (str_ends_with_nocase(path, endings[i])) {
            *format = (enum image_format)i;
            return true;
        }
    return false;
}

const char *image_format_endings(void) {
    return ".png, .pfm or .hdr";
}

void image_encode(const struct image *image, enum image_format format, struct image_display display,
                  struct strbuf *out) {
    if (format == IMAGE_PFM) {
        encode_pfm(image->width, image->height, image->rgb, out);
    } else if (format == IMAGE_HDR) {
        encode_hdr(image->width, image->height, image->rgb, out);
    } else {
        uint8_t *bytes = malloc((size_t)3 * image->width * image->height);
        if (bytes) {
            image_to_bytes(image, display, bytes);
            encode_png(image->width, image->height, bytes, out);
        } else {
            out->failed = true;
        }
        free(bytes);
    }
}
