// How many refracted rays may wait in a path at the same time. If paths are long, these rays decide the
// memory of a portion's pixel, so the bound decides how many portions there are.
#include "grammar/ir.h"
#include "tracer/render/render_private.h"

#include <math.h>

// For each factor of a ray's weight, generously: what rounding may add to it.
static const double ROUNDING = 1e-5;

// The most that a surface multiplies a ray's weight by, at least 1. Under total reflection the ray has both
// weights; with Fresnel's equations it has that of the reflected ray.
static double greatest_factor(const struct scene_material *m) {
    const bool adds = !m->fresnel && m->refraction > 0;
    const double one = fmax(1, fmax(m->reflection, m->refraction));
    return adds ? fmax(one, m->reflection + m->refraction) : one;
}

// Every ray that waits in a path was left behind where its ray was both reflected and refracted, and the
// reflected one was followed: that one had at least the minimum weight of followed rays, and lost some of it
// at each of those surfaces. UINT32_MAX: weights set no bound.
static uint32_t most_by_weight(const struct renderer *renderer) {
    const struct render_settings *settings = &renderer->settings;
    const struct scene *scene = renderer->flat->scene;
    double reflection = 0, factor = 1; // the largest: of surfaces that leave a ray behind; of all
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const struct scene_material *m = &scene->materials[i];
        factor = fmax(factor, greatest_factor(m));
        if (m->refraction > 0)
            reflection = fmax(reflection, m->reflection);
    }
    const double gain = pow(factor * (1 + 2 * ROUNDING), settings->max_depth + 1.0);
    const double least = settings->min_weight / gain;
    if (!(least > 0) || reflection >= 1)
        return UINT32_MAX;
    const double most = least < 1 && reflection > 0 ? log(least) / log(reflection) : 0;
    return (uint32_t)fmax(1, fmin(most, settings->max_depth + 1.0));
}

uint32_t renderer_most_waiting(const struct renderer *renderer, bool by_weight) {
    const uint64_t bounces = FEATURE_REFLECTION | FEATURE_REFRACTION;
    const struct render_settings *settings = &renderer->settings;
    if ((settings->features & bounces) != bounces)
        return 0;
    // A surface at the last level also leaves a ray behind, which sees the background.
    const uint32_t levels = settings->max_depth + 1;
    const uint32_t most = by_weight ? most_by_weight(renderer) : levels;
    return most < levels ? most : levels;
}
