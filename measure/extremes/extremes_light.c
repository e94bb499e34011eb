// Variants of lighting: lights, lenses, textures, media and samples at their limits.
#include "measure/extremes/extremes_internal.h"

#include "grammar/ir_features.h"

#include <math.h>

enum {
    ERROR_SAMPLES = 16,
    ERROR_SAMPLES_LEAST = 4,
};
#define DEGREE 0.017453292519943295769
static const double LENS = 0.01;            // of the focus axis, as a fraction of the scene's radius
static const double ERROR = 0.02;           // of the axis of least samples
static const double AMBIENT = 0.3;          // used if the scene has none
static const vec3 COLORED = {1, 0.5, 0.25}; // of what absorbs

// ---- lights

static struct view_light *find_light(const struct variant *v, bool directional) {
    for (uint32_t i = 0; i < v->view.light_count; i++)
        if (v->view.lights[i].directional == directional)
            return &v->view.lights[i];
    return NULL;
}

static bool set_radius(struct variant *v, const struct extreme_base *base, double value) {
    struct view_light *light = find_light(v, false);
    if (!light)
        return false;
    light->extent = value > 0 ? VIEW_SPHERE : VIEW_POINT;
    light->radius = value * base->radius;
    view_light_shine(light, v->view.camera.position);
    return true;
}

static bool set_angle(struct variant *v, const struct extreme_base *base, double value) {
    struct view_light *light = find_light(v, true);
    (void)base;
    if (!light)
        return false;
    light->extent = value > 0 ? VIEW_DISC : VIEW_POINT;
    light->half_angle = 0.5 * value * DEGREE;
    view_light_shine(light, v->view.camera.position);
    return true;
}

static bool set_occlusion(struct variant *v, const struct extreme_base *base, double value) {
    if (vec3_is_zero(v->scene.ambient))
        v->scene.ambient = (vec3){AMBIENT, AMBIENT, AMBIENT};
    v->scene.occlusion = value * base->radius;
    return v->ir.trace.shadows;
}

// ---- the lens

// The IR says that there is a lens, the view holds its values.
static bool set_lens(struct variant *v, const struct extreme_base *base, double aperture, double focus) {
    struct view_camera *camera = &v->view.camera;
    if (v->ir.cameras.count == 0)
        return false;
    v->ir.cameras.items[v->camera].aperture = aperture * base->radius;
    camera->lens_radius = aperture * base->radius / 2;
    camera->focus = focus * fmax(vec3_length(vec3_sub(base->center, camera->position)), base->radius);
    return true;
}

static bool set_aperture(struct variant *v, const struct extreme_base *base, double value) {
    return set_lens(v, base, value, 1);
}

static bool set_focus(struct variant *v, const struct extreme_base *base, double value) {
    return set_lens(v, base, LENS, value);
}

// ---- materials

// The features of the material as if the IR had it so; the IR is changed too.
static void ask_for(struct variant *v, uint32_t index, double roughness, double emission) {
    struct scene_material *m = &v->scene.materials[index];
    const uint32_t own = index % v->scene.assets->material_count; // copies follow after all of them
    struct ir_material ir = v->scene.assets->materials[own];
    ir.roughness = roughness;
    ir.emission = (struct ir_color){.r = emission, .g = emission, .b = emission};
    m->features |= ir_material_features(&ir);
}

static bool set_roughness(struct variant *v, const struct extreme_base *base, double value) {
    bool any = false;
    (void)base;
    for (uint32_t i = 0; i < v->scene.material_count; i++) {
        struct scene_material *m = &v->scene.materials[i];
        if (!(m->reflection > 0 || m->refraction > 0))
            continue;
        m->alpha = value * value;
        ask_for(v, i, value, 0);
        any = true;
    }
    return any;
}

static bool set_emission(struct variant *v, const struct extreme_base *base, double value) {
    (void)base;
    for (uint32_t i = 0; i < v->scene.material_count; i++) {
        v->scene.materials[i].emission = (vec3){value, value, value};
        ask_for(v, i, 0, value);
    }
    return true;
}

static bool set_density(struct variant *v, const struct extreme_base *base, double value) {
    bool any = false;
    for (uint32_t i = 0; i < v->scene.material_count; i++) {
        if (!(v->scene.materials[i].refraction > 0))
            continue;
        v->scene.materials[i].absorption = vec3_mul(COLORED, value / base->radius);
        any = true;
    }
    return any;
}

// ---- paint

// The colour of an image if a pixel covers all of it: its last level, which is one pixel.
static vec3 mean_of(const struct scene_texture *texture) {
    return scene_texel(texture, texture->level_count - 1, 0, 0);
}

// Filtered, and scaled about the origin of its coordinates; scaled by 0: its mean.
static void scale_image(struct scene_image *image, vec3 colors[], uint32_t color_count, double value) {
    if (value > 0) {
        image->filter = IR_FILTER_AUTO;
        for (int k = 0; k < 3; k++) {
            image->u[k] /= value;
            image->v[k] /= value;
        }
        return;
    }
    for (uint32_t i = 0; i < color_count; i++)
        colors[i] = mean_of(image->texture);
    image->texture = NULL;
}

static void scale_checker(struct scene_material *m, double value) {
    m->soft = value > 0;
    m->cell *= value > 0 ? value : 1;
    if (value > 0)
        return;
    m->diffuse[0] = m->diffuse[1] = vec3_mul(vec3_add(m->diffuse[0], m->diffuse[1]), 0.5);
}

static bool set_texture(struct variant *v, const struct extreme_base *base, double value) {
    bool any = false;
    (void)base;
    for (uint32_t i = 0; i < v->scene.material_count; i++) {
        struct scene_material *m = &v->scene.materials[i];
        if (m->checker)
            scale_checker(m, value);
        any |= m->checker || m->images[ASSETS_DIFFUSE].texture || m->images[ASSETS_SPECULAR].texture;
        if (m->images[ASSETS_DIFFUSE].texture)
            scale_image(&m->images[ASSETS_DIFFUSE], m->diffuse, 2, value);
        if (m->images[ASSETS_SPECULAR].texture)
            scale_image(&m->images[ASSETS_SPECULAR], &m->specular, 1, value);
    }
    return any;
}

// ---- shapes, and samples

static bool set_nested(struct variant *v, const struct extreme_base *base, double value) {
    return probe_nested(v, base, (uint32_t)value);
}

static bool set_error(struct variant *v, const struct extreme_base *base, double value) {
    (void)base;
    v->error = value;
    v->min_samples = ERROR_SAMPLES_LEAST;
    return true;
}

// As a session does: with no more samples than these no pixel ends.
static bool set_least(struct variant *v, const struct extreme_base *base, double value) {
    (void)base;
    v->error = value < ERROR_SAMPLES ? ERROR : 0;
    v->min_samples = (uint32_t)value;
    return true;
}

static const struct light_axis {
    enum extreme_axis axis;
    uint32_t samples;
    bool (*change)(struct variant *v, const struct extreme_base *base, double value);
    const char *lacks; // why the axis may change nothing
} light_axes[] = {
    {EXTREME_LIGHT_RADIUS, SOFT_SAMPLES, set_radius, "no light has a place"},
    {EXTREME_LIGHT_ANGLE, SOFT_SAMPLES, set_angle, "no light has a direction"},
    {EXTREME_APERTURE, SOFT_SAMPLES, set_aperture, "the scene has no camera"},
    {EXTREME_FOCUS, SOFT_SAMPLES, set_focus, "the scene has no camera"},
    {EXTREME_ROUGHNESS, SOFT_SAMPLES, set_roughness, "no material reflects or refracts"},
    {EXTREME_DENSITY, 1, set_density, "no material refracts"},
    {EXTREME_TEXTURE, 1, set_texture, "no material has an image or a checker"},
    {EXTREME_OCCLUSION, SOFT_SAMPLES, set_occlusion, "the scene has no shadows"},
    {EXTREME_EMISSION, 1, set_emission, NULL},
    {EXTREME_NESTED, 1, set_nested, "no material refracts"},
    {EXTREME_ERROR_BOUND, ERROR_SAMPLES, set_error, NULL},
    {EXTREME_MIN_SAMPLES, ERROR_SAMPLES, set_least, NULL},
};

const char *variant_change_light(struct variant *v, const struct extreme_base *base, enum extreme_axis axis,
                                 double value) {
    for (size_t i = 0; i < sizeof light_axes / sizeof *light_axes; i++) {
        const struct light_axis *a = &light_axes[i];
        if (a->axis != axis)
            continue;
        v->samples = a->samples;
        return a->change(v, base, value) ? NULL : a->lacks;
    }
    return NULL;
}
