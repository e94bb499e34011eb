// A picture as a file of the format asked for.
#include "core/heap.h"
#include "picture/write/encode_parts.h"
#include "picture/write/image.h"

#include <stdlib.h>

void image_encode(const struct image *image, enum image_format format, struct image_display display,
                  struct strbuf *out) {
    if (format == IMAGE_PFM) {
        encode_pfm(image->width, image->height, image->rgb, out);
    } else if (format == IMAGE_HDR) {
        encode_hdr(image->width, image->height, image->rgb, image->note, out);
    } else {
        uint8_t *bytes = heap_array(heap_times(3, image->width), image->height);
        if (bytes) {
            image_to_bytes(image, display, bytes);
            encode_png(image->width, image->height, bytes, image->note, out);
        } else {
            out->failed = true;
        }
        free(bytes);
    }
}
