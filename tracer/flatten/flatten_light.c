// Materials, lights, the background, and which features of the tracer they need.
#include "core/heap.h"
#include "core/parallel.h"
#include "core/srgb.h"
#include "grammar/ir_features.h"
#include "shaders/features.h"
#include "tracer/flatten/flatten_internal.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// A point light farther than this counts as infinitely far away.
#define LIGHT_DISTANCE_MAX FLAT_LENGTH_MAX

enum {
    PIECE_TEXELS = 65536,
    NUMBERS = sizeof(struct gpu_word) / sizeof(uint32_t),
};

// ---- materials

// Converts a number per scene unit to one per flat unit.
static vec3 per_flat_unit(const struct flattening *f, vec3 value) {
    const vec3 flat = vec3_mul(value, 1 / f->factor);
    return (vec3){fmin(flat.x, SCENE_ABSORPTION_MAX), fmin(flat.y, SCENE_ABSORPTION_MAX),
                  fmin(flat.z, SCENE_ABSORPTION_MAX)};
}

#define SAME_NUMBER(name)           .name = m->name,
#define SAME_FLAG(name)             .name = m->name,
#define SAME_COLOR(name)            .name = m->name,
#define SAME_COLORS(name)           .name = m->name[0], .name##_odd = m->name[1],
#define RECORD_MATERIAL(kind, name) SAME_##kind(name)
#define RECORD_FLAT(kind, name)     .name = per_flat_unit(f, m->name),
#define RECORD_APART(kind, name)
#define RECORD_FIELD(kind, name, share, to, ...) RECORD_##to(kind, name)

enum flatten_fault flatten_materials(struct flattening *f) {
    const uint32_t stride = f->out->strides.material;
    if (!flat_array_make(&f->out->materials, (uint64_t)f->scene->material_count * stride))
        return FLATTEN_NO_MEMORY;
    for (uint32_t i = 0; i < f->scene->material_count; i++) {
        const struct scene_material *m = &f->scene->materials[i];
        const struct gpu_material record = {SCENE_MATERIAL_FIELDS(RECORD_FIELD)};
        gpu_pack_material(&record, f->out->is_double, f->out->materials.words + (size_t)stride * i);
    }
    return FLATTEN_DONE;
}

// ---- lights

// In small scenes falloff gives emissions that no float holds; they stay finite.
static double emission_bound(double value) {
    return fmin(value, FLT_MAX);
}

// 1, or the factor that moves a light with an extent to the farthest distance that counts: a smaller light
// there is seen under the same angle.
static double nearer(const struct flattening *f, const struct view_light *light) {
    const double distance = vec3_length(vec3_sub(light->position, f->out->origin)) * f->factor;
    const bool is_far = !light->directional && light->extent != VIEW_POINT && distance > LIGHT_DISTANCE_MAX;
    return is_far ? LIGHT_DISTANCE_MAX / distance : 1;
}

static struct gpu_light light_record(const struct flattening *f, const struct view_light *light) {
    vec3 from_origin = vec3_sub(light->position, f->out->origin);
    // A panel that a body shows is moved in front of the body; shaders/light/extent.glsl does this for a
    // sphere.
    if (light->extent == VIEW_PANEL)
        from_origin = vec3_add(from_origin, vec3_mul(light->outward, light->before_body));
    const double factor = f->factor * nearer(f, light);
    vec3 position = vec3_mul(from_origin, factor);
    struct gpu_light record = {.place = position, .flags = LIGHT_DIRECTIONAL, .emission = light->emission};
    record.axis = light->axis;
    record.open = light->open;
    record.rate = light->rate;
    if (light->directional) {
        record.place = light->to_light;
    } else if (vec3_length(position) > LIGHT_DISTANCE_MAX && light->extent == VIEW_POINT) {
        double distance = vec3_length(from_origin);
        record.place = vec3_unit(from_origin);
        if (light->inverse_square)
            record.emission = vec3_mul(record.emission, 1 / (distance * distance));
    } else {
        record.flags = light->inverse_square ? LIGHT_INVERSE_SQUARE : 0;
        if (light->inverse_square)
            record.emission = vec3_mul(record.emission, factor * factor);
    }
    if (light->extent != VIEW_POINT)
        record.flags |= LIGHT_EXTENT | (light->extent == VIEW_PANEL ? LIGHT_PANEL : 0);
    record.flags |= light->spot ? LIGHT_SPOT : 0;
    record.emission = (vec3){emission_bound(record.emission.x), emission_bound(record.emission.y),
                             emission_bound(record.emission.z)};
    return record;
}

// Sizes as large as the distance at which lights count as infinitely far away are as good as any larger one.
static double length_bound(double value) {
    return fmin(value, LIGHT_DISTANCE_MAX);
}

static struct gpu_extent extent_record(const struct flattening *f, const struct view_light *light) {
    const double sine = sin(light->half_angle / 2), factor = f->factor * nearer(f, light);
    return (struct gpu_extent){.edge_u = vec3_mul(light->edge_u, factor),
                               .edge_v = vec3_mul(light->edge_v, factor),
                               .outward = light->outward,
                               .radius = length_bound(light->radius * factor),
                               .gap = 2 * sine * sine,
                               .before_body = length_bound(light->before_body * factor)};
}

// ---- lights that rays see

static vec3 bounded(vec3 color) {
    return (vec3){emission_bound(color.x), emission_bound(color.y), emission_bound(color.z)};
}

// The vector whose product with a place relative to a panel's middle tells how far it is along the first
// edge, in half edges.
static vec3 along_edge(vec3 edge, vec3 other, vec3 outward) {
    const vec3 across = vec3_cross(vec3_unit(other), outward);
    return vec3_mul(across, 2 / vec3_dot(edge, across));
}

static struct gpu_seen seen_record(const struct flattening *f, const struct view_light *light) {
    const double factor = f->factor * nearer(f, light);
    struct gpu_seen record = {.radiance = bounded(light->radiance)};
    record.place =
        light->directional ? light->to_light : vec3_mul(vec3_sub(light->position, f->out->origin), factor);
    if (light->extent == VIEW_DISC) {
        record.flags = LIGHT_DIRECTIONAL;
        record.size = sin(light->half_angle);
    } else if (light->extent == VIEW_PANEL) {
        record.flags = LIGHT_PANEL;
        record.outward = light->outward;
        record.along_u = along_edge(vec3_mul(light->edge_u, factor), light->edge_v, light->outward);
        record.along_v = along_edge(vec3_mul(light->edge_v, factor), light->edge_u, light->outward);
    } else {
        record.size = length_bound(light->radius * factor);
    }
    return record;
}

static uint32_t count_seen(const struct view *view) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < view->light_count; i++)
        count += view_light_is_seen(&view->lights[i]);
    return count;
}

static void fill_seen(struct flattening *f) {
    const struct view *view = f->input->view;
    const uint32_t stride = f->out->is_double ? SEEN64_WORDS : SEEN_WORDS;
    struct gpu_word *words = f->out->lights.words + f->out->seen_table;
    for (uint32_t i = 0; i < view->light_count; i++) {
        if (!view_light_is_seen(&view->lights[i]))
            continue;
        struct gpu_seen record = seen_record(f, &view->lights[i]);
        record.light = i;
        gpu_pack_seen(&record, f->out->is_double, words);
        words += stride;
    }
    f->light_features |= f->out->seen_count ? FEATURE_SEEN_LIGHT : 0;
}

static bool any_extent(const struct view *view) {
    bool any = false;
    for (uint32_t i = 0; i < view->light_count; i++)
        any = any || view->lights[i].extent != VIEW_POINT;
    return any;
}

// Written after all light data: four numbers per word.
static bool fill_sky(struct flattening *f) {
    struct flat_scene *out = f->out;
    bool is_black = false;
    if (!out->sky.rows)
        return true;
    if (!sky_fill(f->scene, out->sky, (uint32_t *)(out->lights.words + out->sky_table), &is_black))
        return false;
    if (is_black)
        out->sky = (struct sky_size){0, 0, 0};
    return true;
}

enum flatten_fault flatten_lights(struct flattening *f) {
    const struct view *view = f->input->view;
    const uint32_t extent_words = !any_extent(view) ? 0 : f->out->is_double ? EXTENT64_WORDS : EXTENT_WORDS;
    const uint64_t words = (uint64_t)view->light_count * (f->out->strides.light + extent_words);
    f->out->light_count = view->light_count;
    f->out->sky = sky_size(f->scene);
    f->out->sky_table = (uint32_t)words;
    f->out->seen_count = count_seen(view);
    f->out->seen_table = (uint32_t)(words + sky_count(f->out->sky) / NUMBERS);
    const uint32_t seen_words = f->out->seen_count * (f->out->is_double ? SEEN64_WORDS : SEEN_WORDS);
    if (!flat_array_make(&f->out->lights, (uint64_t)f->out->seen_table + seen_words) || !fill_sky(f))
        return FLATTEN_NO_MEMORY;
    fill_seen(f);
    struct gpu_word *extents = f->out->lights.words + (size_t)view->light_count * f->out->strides.light;
    for (uint32_t i = 0; i < view->light_count; i++) {
        struct gpu_light record = light_record(f, &view->lights[i]);
        f->light_features |= record.flags & LIGHT_DIRECTIONAL ? FEATURE_DIRECTION_LIGHT : FEATURE_POINT_LIGHT;
        f->light_features |= record.flags & LIGHT_INVERSE_SQUARE ? FEATURE_INVERSE_SQUARE : 0;
        f->light_features |= record.flags & LIGHT_EXTENT ? FEATURE_SOFT_LIGHT : 0;
        f->light_features |= record.flags & LIGHT_SPOT ? FEATURE_SPOT : 0;
        gpu_pack_light(&record, f->out->is_double, f->out->lights.words + (size_t)f->out->strides.light * i);
        if (!extent_words)
            continue;
        const struct gpu_extent extent = extent_record(f, &view->lights[i]);
        gpu_pack_extent(&extent, f->out->is_double, extents + (size_t)extent_words * i);
    }
    return FLATTEN_DONE;
}

// ---- background

struct texels {
    const struct flat_scene *flat;
    size_t first;
    void *to;
};

static void put_bytes(void *context, size_t begin, size_t end) {
    const struct texels *t = context;
    uint8_t *to = t->to;
    for (size_t i = begin; i < end; i++) {
        memcpy(to + 4 * i, (const uint8_t *)t->flat->background->pixels + 3 * (t->first + i), 3);
        to[4 * i + 3] = UINT8_MAX;
    }
}

static void put_decoded(void *context, size_t begin, size_t end) {
    const struct texels *t = context;
    float *to = t->to;
    for (size_t i = begin; i < end; i++) {
        for (size_t c = 0; c < 3; c++)
            to[4 * i + c] =
                t->flat->background_texels.decoded[picture_stored(t->flat->background, t->first + i, c)];
        to[4 * i + 3] = 1;
    }
}

static void put_linear(void *context, size_t begin, size_t end) {
    const struct texels *t = context;
    float *to = t->to;
    for (size_t i = begin; i < end; i++) {
        for (size_t c = 0; c < 3; c++)
            to[4 * i + c] = picture_linear(t->flat->background, t->first + i, c);
        to[4 * i + 3] = 1;
    }
}

void flat_background(const struct flat_scene *flat, size_t begin, size_t end, void *to) {
    struct texels texels = {flat, begin, to};
    parallel_for(end - begin, PIECE_TEXELS,
                 !flat->background_texels.is_float ? put_bytes
                 : flat->background_texels.decoded ? put_decoded
                                                   : put_linear,
                 &texels);
}

enum flatten_fault flatten_background(struct flattening *f) {
    const struct picture *picture = f->out->background;
    bool is_srgb = f->scene->ir->image.transfer == IR_TRANSFER_SRGB;
    if (!picture)
        return FLATTEN_DONE;
    size_t count = (size_t)picture->width * picture->height;
    f->out->background_texels.is_float = is_srgb || picture->depth != PICTURE_8;
    f->out->background_texels.bytes = count * (f->out->background_texels.is_float ? 4 * sizeof(float) : 4);
    if (!f->out->background_texels.is_float || picture_is_linear(picture))
        return FLATTEN_DONE;
    uint32_t greatest = picture_greatest(picture->depth);
    float *decoded = heap_array((size_t)greatest + 1, sizeof *decoded);
    if (!decoded)
        return FLATTEN_NO_MEMORY;
    for (uint32_t i = 0; i <= greatest; i++) {
        double value = (double)i / greatest;
        decoded[i] = (float)(is_srgb ? srgb_decode(value) : value);
    }
    f->out->background_texels.decoded = decoded;
    return FLATTEN_DONE;
}

// ---- features

static uint64_t used_material_features(const struct flattening *f) {
    uint64_t mask = 0;
    for (uint32_t i = 0; i < f->scene->material_count; i++) {
        if (!f->material_used[i])
            continue;
        uint64_t bits = f->scene->materials[i].features;
        // Attenuation only matters inside a body: flatten_media.c.
        bits &= ~(FEATURE_ATTENUATION | FEATURE_TEXTURES | FEATURE_FOOTPRINT);
        bits &= bits & FEATURE_REFLECTION ? ~UINT64_C(0) : ~FEATURE_REFLECTION_COLOR;
        mask |= bits & FEATURE_DIFFUSE ? bits : bits & ~FEATURE_CHECKER;
        mask |= flatten_paint_features(&f->scene->materials[i]);
    }
    return mask;
}

static uint64_t ambient_features(struct flattening *f) {
    const struct scene *scene = f->scene;
    if (vec3_is_zero(scene->ambient))
        return 0;
    f->out->occlusion = length_bound(scene->occlusion * f->factor);
    return FEATURE_AMBIENT | (f->out->occlusion > 0 ? FEATURE_OCCLUSION : 0);
}

// A scene that is only asked for sizes and features has no pixels.
static bool has_pixels(const struct flattening *f) {
    const struct picture *picture = f->scene->background.picture;
    return !picture || picture->pixels;
}

// The features that the scene's rows need, given its final materials, lights, bodies and background.
void flatten_features(struct flattening *f) {
    const uint64_t own = FEATURE_TRIANGLES | FEATURE_SPHERES | FEATURE_DIFFUSE | FEATURE_SPECULAR |
                         FEATURE_REFLECTION | FEATURE_REFRACTION | FEATURE_CHECKER | FEATURE_SMOOTH |
                         FEATURE_POINT_LIGHT | FEATURE_DIRECTION_LIGHT | FEATURE_INVERSE_SQUARE |
                         FEATURE_BACKGROUND_IMAGE | FEATURE_MEDIA | FEATURE_ATTENUATION | FEATURE_TEXTURES |
                         FEATURE_FOOTPRINT | FEATURE_SOFT_LIGHT | FEATURE_AMBIENT | FEATURE_OCCLUSION |
                         FEATURE_EMISSION | FEATURE_SKY_LIGHT | FEATURE_SEEN_LIGHT | FEATURE_CONES |
                         FEATURE_TURNED | FEATURE_REFLECTION_COLOR | FEATURE_SPOT;
    struct flat_scene *out = f->out;
    uint64_t mask = ir_features(f->scene->ir) & FEATURE_SCENE_MASK & ~own;
    mask |= out->triangle_count ? FEATURE_TRIANGLES : 0;
    mask |= out->sphere_count ? FEATURE_SPHERES : 0;
    mask |= out->cone_count ? FEATURE_CONES : 0;
    mask |= out->normals.count ? FEATURE_SMOOTH : 0;
    mask |= out->background ? FEATURE_BACKGROUND_IMAGE : 0;
    mask |= used_material_features(f);
    mask |= f->light_features;
    mask |= ambient_features(f);
    mask |= mask & FEATURE_TEXTURES && flatten_turns_spheres(f) ? FEATURE_TURNED : 0;
    mask |= out->sky.rows || (f->scene->background.lights && !has_pixels(f)) ? FEATURE_SKY_LIGHT : 0;
    if (!(mask & FEATURE_DIFFUSE))
        mask &= ~(FEATURE_AMBIENT | FEATURE_OCCLUSION);
    if (!(mask & FEATURE_SHADOWS))
        mask &= ~FEATURE_OCCLUSION;
    if (!(mask & (FEATURE_DIFFUSE | FEATURE_SPECULAR)))
        mask &= ~(FEATURE_SHADOWS | FEATURE_POINT_LIGHT | FEATURE_DIRECTION_LIGHT | FEATURE_INVERSE_SQUARE |
                  FEATURE_SOFT_LIGHT | FEATURE_SKY_LIGHT);
    if (!(mask & (FEATURE_REFLECTION | FEATURE_REFRACTION)))
        mask &= ~(FEATURE_DEPTH_BLACK | FEATURE_FRESNEL);
    if (!(mask & FEATURE_REFRACTION) || !(mask & FEATURE_SHADOWS))
        mask &= ~FEATURE_CLEAR_SHADOWS;
    mask |= f->media_features;
    out->features = mask;
}
