// A picture of few pixels, enlarged to all of them: something to see before a frame that takes long.
//
// Thread safety: as render/shot.h.
#ifndef GLINT_RENDER_LIVE_COARSE_H
#define GLINT_RENDER_LIVE_COARSE_H

#include "render/shot.h"

// By how much to shrink width and height, by the seconds that a sample of a pixel took before (0: not known);
// 1: the whole picture is there as soon.
uint32_t coarse_shrink(const struct render_settings *settings, double pixel_seconds);
// One sample of each of those pixels, into an image of the shot's size. The shot's settings stay as they are,
// but for SHOT_DEVICE.
enum shot_status coarse_take(struct shot *shot, uint32_t shrink, struct image *image,
                             const struct render_progress *progress);

#endif
