// Materials, lights, the background and what of the tracer all of it needs.
#include "core/parallel.h"
#include "core/srgb.h"
#include "grammar/ir_features.h"
#include "shaders/features.h"
#include "shaders/gpu_scene.h"
#include "tracer/flatten/flatten_parts.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// A point light further than this, in flat units, is as good as infinitely far away.
#define LIGHT_DISTANCE_MAX 0x1p40

enum {
    PIECE_TEXELS = 65536
};

// ---- materials

static void put_material(const struct flattening *f, const struct ir_material *material,
                         struct gpu_word *words) {
    unsigned transfer = f->input->scene->image.transfer;
    const struct ir_paint *paint = &material->diffuse_color;
    bool is_checker = paint->kind == IR_PAINT_CHECKER;
    vec3 diffuse = view_linear_color(is_checker ? paint->checker.colors[0] : paint->color, transfer);
    vec3 specular = view_linear_color(material->specular_color, transfer);
    words[0] =
        (struct gpu_word){flat_bits(material->albedo.diffuse), flat_bits(material->albedo.specular),
                          flat_bits(material->albedo.reflection), flat_bits(material->albedo.refraction)};
    words[1] = flat_word(diffuse, flat_bits(material->specular_exponent));
    words[2] = flat_word(specular, flat_bits(material->refractive_index));
    if (is_checker)
        words[3] =
            flat_word(view_linear_color(paint->checker.colors[1], transfer), flat_bits(paint->checker.size));
    if (f->out->is_double)
        words[4] = flat_doubles(material->refractive_index, is_checker ? paint->checker.size : 0);
}

enum flatten_fault flatten_materials(struct flattening *f) {
    const struct assets *assets = f->input->assets;
    if (!flat_array_make(&f->out->materials, (uint64_t)assets->material_count * f->out->strides.material))
        return FLATTEN_NO_MEMORY;
    for (uint32_t i = 0; i < assets->material_count; i++)
        put_material(f, &assets->materials[i],
                     f->out->materials.words + (size_t)f->out->strides.material * i);
    return FLATTEN_DONE;
}

// ---- lights

// Small scenes with falloff have emissions that no float holds; they stay finite.
static double emission_bound(double value) {
    return fmin(value, FLT_MAX);
}

static void put_light(const struct flattening *f, const struct view_light *light, struct gpu_word *words) {
    vec3 from_origin = vec3_sub(light->position, f->out->origin);
    vec3 position = vec3_mul(from_origin, f->factor);
    vec3 emission = light->emission;
    vec3 place = position;
    uint32_t flags = LIGHT_DIRECTIONAL;
    if (light->directional) {
        place = light->to_light;
    } else if (vec3_length(position) > LIGHT_DISTANCE_MAX) {
        double distance = vec3_length(from_origin);
        place = vec3_unit(from_origin);
        if (light->inverse_square)
            emission = vec3_mul(emission, 1 / (distance * distance));
    } else {
        flags = light->inverse_square ? LIGHT_INVERSE_SQUARE : 0;
        if (light->inverse_square)
            emission = vec3_mul(emission, f->factor * f->factor);
    }
    emission = (vec3){emission_bound(emission.x), emission_bound(emission.y), emission_bound(emission.z)};
    if (f->out->is_double)
        flat_put_real3(words, place, (struct flat_pair){flags, 0});
    else
        words[0] = flat_word(place, flags);
    words[f->out->strides.light - 1] = flat_word(emission, 0);
}

enum flatten_fault flatten_lights(struct flattening *f) {
    const struct view *view = f->input->view;
    f->out->light_count = view->light_count;
    if (!flat_array_make(&f->out->lights, (uint64_t)view->light_count * f->out->strides.light))
        return FLATTEN_NO_MEMORY;
    for (uint32_t i = 0; i < view->light_count; i++)
        put_light(f, &view->lights[i], f->out->lights.words + (size_t)f->out->strides.light * i);
    return FLATTEN_DONE;
}

// ---- background

struct texels {
    const struct picture *picture;
    const float *decoded; // by stored value, where these are whole numbers
    float *to;
};

static void put_texels(void *context, size_t begin, size_t end) {
    const struct texels *t = context;
    for (size_t i = begin; i < end; i++) {
        for (size_t c = 4 * i; c < 4 * i + 3; c++) {
            if (t->picture->depth == PICTURE_8)
                t->to[c] = t->decoded[((const uint8_t *)t->picture->pixels)[c]];
            else if (t->picture->depth == PICTURE_16)
                t->to[c] = t->decoded[((const uint16_t *)t->picture->pixels)[c]];
            else
                t->to[c] = ((const float *)t->picture->pixels)[c];
        }
        t->to[4 * i + 3] = 1;
    }
}

enum flatten_fault flatten_background(struct flattening *f) {
    const struct picture *picture = f->out->background;
    bool is_srgb = f->input->scene->image.transfer == IR_TRANSFER_SRGB;
    if (!picture)
        return FLATTEN_DONE;
    size_t count = (size_t)picture->width * picture->height;
    if (picture->depth == PICTURE_8 && !is_srgb) {
        f->out->background_texels.texels = picture->pixels;
        f->out->background_texels.bytes = count * 4;
        return FLATTEN_DONE;
    }
    uint32_t greatest = picture->depth == PICTURE_8 ? UINT8_MAX : UINT16_MAX;
    float *decoded = malloc(((size_t)greatest + 1) * sizeof *decoded);
    float *to = malloc(count * 4 * sizeof *to);
    if (!decoded || !to) {
        free(decoded);
        free(to);
        return FLATTEN_NO_MEMORY;
    }
    for (uint32_t i = 0; i <= greatest; i++) {
        double value = (double)i / greatest;
        decoded[i] = (float)(is_srgb ? srgb_decode(value) : value);
    }
    struct texels texels = {picture, decoded, to};
    parallel_for(count, PIECE_TEXELS, put_texels, &texels);
    free(decoded);
    f->out->background_texels.texels = f->out->background_texels.owned = to;
    f->out->background_texels.bytes = count * 4 * sizeof *to;
    f->out->background_texels.is_float = true;
    return FLATTEN_DONE;
}

// ---- features

static uint32_t used_material_features(const struct flattening *f) {
    uint32_t mask = 0;
    for (uint32_t i = 0; i < f->input->assets->material_count; i++) {
        if (!f->material_used[i])
            continue;
        uint32_t bits = ir_material_features(&f->input->assets->materials[i]);
        mask |= bits & FEATURE_DIFFUSE ? bits : bits & ~FEATURE_CHECKER;
    }
    return mask;
}

static uint32_t light_features(const struct flat_scene *flat) {
    uint32_t mask = 0;
    for (uint32_t i = 0; i < flat->light_count; i++) {
        const struct gpu_word *words = flat->lights.words + (size_t)flat->strides.light * i;
        uint32_t flags = flat->is_double ? words[1].z : words[0].w;
        mask |= flags & LIGHT_DIRECTIONAL ? FEATURE_DIRECTION_LIGHT : FEATURE_POINT_LIGHT;
        mask |= flags & LIGHT_INVERSE_SQUARE ? FEATURE_INVERSE_SQUARE : 0;
    }
    return mask;
}

// What the scene's rows ask for, materials, lights, bodies and background as they turned out.
void flatten_features(struct flattening *f) {
    const uint32_t own = FEATURE_TRIANGLES | FEATURE_SPHERES | FEATURE_DIFFUSE | FEATURE_SPECULAR |
                         FEATURE_REFLECTION | FEATURE_REFRACTION | FEATURE_CHECKER | FEATURE_SMOOTH |
                         FEATURE_POINT_LIGHT | FEATURE_DIRECTION_LIGHT | FEATURE_INVERSE_SQUARE |
                         FEATURE_BACKGROUND_IMAGE;
    struct flat_scene *out = f->out;
    uint32_t mask = ir_features(f->input->scene) & FEATURE_SCENE_MASK & ~own;
    mask |= out->triangle_count ? FEATURE_TRIANGLES : 0;
    mask |= out->sphere_count ? FEATURE_SPHERES : 0;
    mask |= out->normals.count ? FEATURE_SMOOTH : 0;
    mask |= out->background_texels.texels ? FEATURE_BACKGROUND_IMAGE : 0;
    mask |= used_material_features(f);
    mask |= light_features(out);
    if (!(mask & (FEATURE_DIFFUSE | FEATURE_SPECULAR)))
        mask &= ~(FEATURE_SHADOWS | FEATURE_POINT_LIGHT | FEATURE_DIRECTION_LIGHT | FEATURE_INVERSE_SQUARE);
    if (!(mask & (FEATURE_REFLECTION | FEATURE_REFRACTION)))
        mask &= ~FEATURE_DEPTH_BLACK;
    out->features = mask;
}
