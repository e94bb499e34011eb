// Images with more texels than a picture can show.
#include "diag/codes/rule.h"
#include "lint/lint_internal.h"

#include "grammar/ir.h"

// Texels along a line per sample of the picture: sixteen times as many texels as samples.
static const double EXCESS = 4;
static const double TURN = 6.283185307179586477;

// Samples per radian of direction, at most: they are densest in the corners of the field, where the direction
// turns least from pixel to pixel.
static double samples_per_radian(const struct lint *lint, const struct view_camera *camera) {
    const struct ir_image *image = lint->input->image;
    const double per_sample = sqrt(image->samples) * image->height;
    // All rays of a pinhole see one place of the image; a lens spreads them by roughly its radius over its
    // focus distance.
    if (camera->projection == IR_PROJECTION_ORTHOGRAPHIC)
        return camera->lens_radius > 0 ? per_sample * camera->focus / camera->lens_radius : INFINITY;
    // Near its poles a panorama has more samples than needed, just as the image has texels.
    if (camera->projection == IR_PROJECTION_PANORAMA)
        return fmax(per_sample, sqrt(image->samples) * image->width / 2) / (TURN / 2);
    // A fisheye has the same number of samples per radian everywhere along the lines from its middle. Across
    // them, at the angle a from the middle, it has a / sin a times as many: 1.57 times at a right angle, and
    // only beyond 132 degrees more than the 3.14 times taken here.
    if (camera->projection == IR_PROJECTION_FISHEYE)
        return per_sample / (2 * camera->half_field) * (TURN / 2);
    double up = camera->tan_half_fov;
    double right = up * image->width / image->height;
    double corner = 1 + up * up + right * right;
    return image->height / (2 * up) * corner * sqrt(image->samples);
}

void lint_oversized_image(struct lint *lint) {
    const struct ir_background *background = &lint->ir->background;
    const struct picture *picture = lint->scene->assets->background;
    if (background->kind != IR_BACKDROP_IMAGE || !picture)
        return;
    double finest = 0;
    for (uint32_t i = 0; i < lint->view_count; i++)
        finest = fmax(finest, samples_per_radian(lint, &lint->views[i].camera));
    double texels = picture->width / TURN;
    if (!(texels > EXCESS * finest))
        return;
    const struct ir_image *image = lint->input->image;
    diag_add(
        lint->sink, DIAG_OVERSIZED_IMAGE,
        ir_place_value(lint->origin, &background->head, &SCHEMA_BACKGROUND, "image"),
        "the background of %u x %u pixels is at least %.3g times finer than a picture of %d x %d can show",
        picture->width, picture->height, texels / finest, image->width, image->height);
    double enough = exp2(ceil(log2(TURN * finest)));
    diag_help(lint->sink, "an image %.0f pixels wide is enough for this picture", enough);
}
