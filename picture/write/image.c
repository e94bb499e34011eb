#include "picture/write/image.h"

#include "core/heap.h"

#include <stdlib.h>

bool image_init(struct image *image, uint32_t width, uint32_t height) {
    *image = (struct image){.width = width, .height = height};
    image->rgb = heap_zeroed(heap_times(width, height), 3 * sizeof *image->rgb);
    return image->rgb != NULL;
}

bool image_fit(struct image *image, uint32_t width, uint32_t height) {
    if (image->rgb && image->width == width && image->height == height)
        return true;
    image_finish(image);
    return image_init(image, width, height);
}

void image_finish(struct image *image) {
    if (!image)
        return;
    free(image->rgb);
    *image = (struct image){0};
}
