#include "picture/write/image.h"

#include "core/heap.h"

#include <stdlib.h>

bool image_init(struct image *image, uint32_t width, uint32_t height) {
    *image = (struct image){.width = width, .height = height};
    image->rgb = heap_zeroed(heap_times(width, height), 3 * sizeof *image->rgb);
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
