// A picture of few pixels, enlarged to all of them: something to see before a frame that takes long.
//
// Thread safety: as render/shot.h.
#ifndef GLINT_RENDER_LIVE_COARSE_H
#define GLINT_RENDER_LIVE_COARSE_H

#include "render/shot.h"

// The factor to shrink width and height by, given the seconds that a sample of a pixel took before (0: not
// known). 1: the whole picture is soon there anyway.
uint32_t coarse_shrink(const struct render_settings *settings, double pixel_seconds);
// Takes one sample of each of these few pixels, into an image of the shot's size. The shot's settings stay as
// they are, except with SHOT_DEVICE.
enum shot_status coarse_take(struct shot *shot, uint32_t shrink, struct image *image,
                             const struct render_progress *progress);

#endif
