// What the viewer asks of the renderer: other settings, and first hits.
#include "core/heap.h"
#include "window/viewer_private.h"

#include <stdlib.h>

bool viewer_set_up(struct viewer *v, uint32_t width, uint32_t height, uint32_t samples) {
    struct shot *shot = &v->live->shot;
    shot->settings.width = width;
    shot->settings.height = height;
    shot->settings.samples = samples;
    // All pixels get the same number of samples, because they are shown on the way.
    shot->settings.error = 0;
    return renderer_change(shot->renderer, &shot->flat, &shot->settings);
}

bool viewer_find_hits(struct viewer *v) {
    const struct image *image = &v->shown.image;
    struct shot *shot = &v->live->shot;
    const size_t pixels = heap_times(image->width, image->height);
    if (v->has_hits)
        return true;
    free(v->hits);
    v->hits = heap_zeroed(pixels, sizeof *v->hits);
    if (!v->hits || !viewer_set_up(v, image->width, image->height, 1) ||
        renderer_hits(shot->renderer, &v->eye, v->hits, NULL) != RENDER_DONE)
        return false;
    v->has_hits = true;
    return true;
}
