#include "render/live/coarse.h"

#include <string.h>

enum {
    SHRINK_MOST = 8,
};
#define WHOLE_SECONDS  0.2  // that a frame may take without a coarse one before it
#define COARSE_SECONDS 0.03 // that a coarse one should take

uint32_t coarse_shrink(const struct render_settings *settings, double pixel_seconds) {
    const double sample = pixel_seconds * settings->width * settings->height;
    uint32_t shrink = 2;
    if (sample * settings->samples <= WHOLE_SECONDS)
        return 1;
    while (shrink < SHRINK_MOST && sample / (shrink * shrink) > COARSE_SECONDS)
        shrink *= 2;
    return shrink;
}

static bool set_up(struct shot *shot, uint32_t width, uint32_t height) {
    shot->settings.width = width;
    shot->settings.height = height;
    shot->settings.samples = 1;
    shot->settings.error = 0;
    return renderer_change(shot->renderer, &shot->flat, &shot->settings);
}

// Goes backwards from the last pixel, so no pixel is overwritten before it is read.
static void enlarge(struct image *image, uint32_t width, uint32_t height) {
    for (uint32_t y = image->height; y-- > 0;)
        for (uint32_t x = image->width; x-- > 0;) {
            const size_t from = (size_t)((uint64_t)y * height / image->height) * width +
                                (size_t)((uint64_t)x * width / image->width);
            const size_t to = (size_t)y * image->width + x;
            memmove(image->rgb + 3 * to, image->rgb + 3 * from, 3 * sizeof *image->rgb);
        }
}

enum shot_status coarse_take(struct shot *shot, uint32_t shrink, struct image *image,
                             const struct render_progress *progress) {
    const uint32_t width = image->width < shrink ? 1 : image->width / shrink;
    const uint32_t height = image->height < shrink ? 1 : image->height / shrink;
    struct render_statistics statistics;
    if (!set_up(shot, width, height))
        return SHOT_DEVICE;
    const enum render_result result =
        renderer_render(shot->renderer, &shot->view.camera, image->rgb, progress, &statistics);
    shot_set_up(shot);
    if (result == RENDER_FAILED || !renderer_change(shot->renderer, &shot->flat, &shot->settings))
        return SHOT_DEVICE;
    if (result == RENDER_CANCELLED)
        return SHOT_CANCELLED;
    enlarge(image, width, height);
    return SHOT_OK;
}
