#include "assets/gltf/material.h"

#include "core/srgb.h"
#include "grammar/ir.h"
#include "grammar/schema.h"

#include <math.h>

// Up to this roughness, a surface that is not a metal still shows recognisable reflections.
#define MIRRORS_UNTIL 0.3
#define EXPONENT_MOST 10000.0

enum {
    NEAREST = 9728 // magFilter
};

static void write(struct ir_head *head, const struct schema_element *schema, const char *row) {
    head->written |= UINT64_C(1) << schema_find_row(schema, str_from(row));
}

// ---- images

static uint32_t image_of(const struct gltf *gltf, const struct gltf_texture_use *use) {
    return use->node ? gltf->textures.items[use->texture].image : GLTF_NONE;
}

struct gltf_images gltf_material_images(const struct gltf *gltf, uint32_t material) {
    const struct gltf_material *m = &gltf->materials.items[material];
    struct gltf_images images = {image_of(gltf, &m->base_texture), image_of(gltf, &m->metal_texture)};
    return images;
}

static void put_pair(struct ir_texture *out, const char *row, struct ir_pair *field, double u, double v) {
    *field = (struct ir_pair){u, v};
    write(&out->head, &SCHEMA_TEXTURE, row);
}

// glTF moves the place in the image, with v downwards; the language moves the image.
static void put_transform(struct gltf *gltf, const struct gltf_texture_use *use, struct ir_texture *out) {
    const double su = use->scale[0], sv = use->scale[1];
    if (!use->has_transform)
        return;
    if (use->rotation != 0 || !(su >= 1e-6 && su <= 1e6) || !(sv >= 1e-6 && sv <= 1e6)) {
        gltf_lose(gltf, GLTF_LOSS_TRANSFORM, use->node);
        return;
    }
    const double u = -use->offset[0] / su, v = (sv + use->offset[1] - 1) / sv;
    if (su != 1 || sv != 1)
        put_pair(out, "repeat", &out->repeat, su, sv);
    if ((u != 0 || v != 0) && fabs(u) <= 1e6 && fabs(v) <= 1e6)
        put_pair(out, "offset", &out->offset, u, v);
}

static void put_image(struct gltf *gltf, const struct gltf_texture_use *use, struct ir_material *out) {
    struct ir_texture *texture = &out->diffuse_color.image;
    const struct gltf_sampler *sampler = &gltf->textures.items[use->texture].sampler;
    schema_init(&SCHEMA_TEXTURE, texture);
    out->diffuse_color.kind = IR_PAINT_IMAGE;
    write(&out->head, &SCHEMA_MATERIAL, "diffuse_color");
    write(&out->diffuse_color.head, &SCHEMA_PAINT, "image");
    write(&texture->head, &SCHEMA_TEXTURE, "file");
    if (sampler->magnify == NEAREST) {
        texture->filter = IR_FILTER_NEAREST;
        write(&texture->head, &SCHEMA_TEXTURE, "filter");
    }
    if (sampler->wrap[0] != GLTF_WRAP_REPEAT) {
        texture->wrap = sampler->wrap[0] == GLTF_WRAP_CLAMP ? IR_WRAP_CLAMP : IR_WRAP_MIRROR;
        write(&texture->head, &SCHEMA_TEXTURE, "wrap");
    }
    if (sampler->wrap[0] != sampler->wrap[1])
        gltf_lose(gltf, GLTF_LOSS_WRAP, use->node);
    if (use->set >= GLTF_COORDINATE_SETS)
        gltf_lose(gltf, GLTF_LOSS_TEXCOORD, use->node);
    put_transform(gltf, use, texture);
}

// ---- colours

// To four decimals: people read these numbers, and no picture shows more.
static double tidy(double value) {
    return round(value * 1e4) / 1e4;
}

static struct ir_color color_of(const double *rgb, bool is_linear) {
    double out[3];
    for (int k = 0; k < 3; k++)
        out[k] = tidy(is_linear || rgb[k] > 1 ? rgb[k] : srgb_encode(rgb[k]));
    return (struct ir_color){.r = out[0], .g = out[1], .b = out[2]};
}

static double luminance(const double *rgb) {
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

// A grey factor on an image's colours is a weight; a coloured factor cannot be expressed.
static double weight_of_factor(struct gltf *gltf, const struct gltf_material *m) {
    if (m->base[0] != m->base[1] || m->base[1] != m->base[2])
        gltf_lose(gltf, GLTF_LOSS_TINT, m->node);
    return luminance(m->base);
}

static void put_base(struct gltf *gltf, const struct gltf_material *m, bool is_linear,
                     struct ir_material *out) {
    const uint32_t image = image_of(gltf, &m->base_texture);
    if (image != GLTF_NONE) {
        put_image(gltf, &m->base_texture, out);
        return;
    }
    out->diffuse_color.color = color_of(m->base, is_linear);
    write(&out->head, &SCHEMA_MATERIAL, "diffuse_color");
    write(&out->diffuse_color.head, &SCHEMA_PAINT, "color");
}

// ---- light

struct surface {
    double metal, roughness, clear; // clear: share of light that goes through
    double mirror;                  // share of perpendicular light
    bool is_thin;                   // light that goes through is not bent
};

static struct surface surface_of(const struct gltf_material *m, struct gltf_wording wording) {
    struct surface s = {.metal = m->metallic * wording.metal, .roughness = m->roughness * wording.roughness};
    const double bend = m->index > 0 ? (m->index - 1) / (m->index + 1) : 1;
    s.mirror = bend * bend;
    s.clear = m->transmission * (1 - s.metal);
    s.is_thin = !(m->thickness > 0);
    if (s.clear == 0 && m->alpha == GLTF_ALPHA_BLEND && m->base[3] < 1) {
        s.clear = 1 - m->base[3];
        s.is_thin = true;
    }
    return s;
}

static bool mirrors(const struct surface *s) {
    return s->metal < 0.5 && s->roughness <= MIRRORS_UNTIL && s->mirror > 0;
}

// A metal whose colour is an image shows it as a matt surface does: what is mirrored has one colour.
static bool is_plain_metal(const struct gltf_material *m, const struct surface *s) {
    return s->metal > 0 && s->clear == 0 && !m->base_texture.node;
}

static void put_albedo(const struct gltf_material *m, const struct surface *s, double factor,
                       struct ir_material *out) {
    struct ir_weights *w = &out->albedo;
    const double shine = s->metal + (1 - s->metal) * s->mirror,
                 alpha = fmax(s->roughness * s->roughness, 0.01);
    // Of a metal with an image: a rough one scatters nearly like a matt surface of its colour.
    const bool is_plain = is_plain_metal(m, s);
    const double matt = is_plain ? 0 : s->roughness + (1 - s->roughness) / 2;
    w->diffuse = factor * ((1 - s->metal) * (1 - s->clear) + s->metal * matt);
    w->reflection = is_plain ? 1 : s->metal * (1 - matt) * (m->base_texture.node ? 1 : luminance(m->base));
    w->refraction = s->clear;
    // The peak of the microfacet distribution (Walter et al. 2007), and the Phong lobe of the same width.
    w->specular = is_plain || s->roughness < 0.9 ? fmin(1, shine / (4 * alpha * alpha)) : 0;
    if (s->clear > 0 && s->is_thin) {
        w->reflection += s->mirror * s->clear;
        w->refraction *= 1 - s->mirror;
    } else if (s->clear > 0 || mirrors(s)) {
        w->reflection = fmax(w->reflection, 1 - s->metal);
    }
    *w = (struct ir_weights){tidy(w->diffuse), tidy(w->specular), tidy(w->reflection), tidy(w->refraction)};
    write(&out->head, &SCHEMA_MATERIAL, "albedo");
    if (w->specular > 0) {
        out->specular_exponent = tidy(fmin(fmax((2 / (alpha * alpha) - 2) / 4, 1), EXPONENT_MOST));
        write(&out->head, &SCHEMA_MATERIAL, "specular_exponent");
    }
}

// Straight on, a metal mirrors its own colour and another surface `mirror`; what is between them, both.
static void put_metal(const struct gltf_material *m, const struct surface *s, bool is_linear,
                      struct ir_material *out) {
    double color[3];
    for (int k = 0; k < 3; k++)
        color[k] = fmin(s->metal * m->base[k] + (1 - s->metal) * s->mirror, 1);
    out->metal = true;
    out->reflection_color = color_of(color, is_linear);
    write(&out->head, &SCHEMA_MATERIAL, "metal");
    write(&out->head, &SCHEMA_MATERIAL, "reflection_color");
}

static void put_fresnel(const struct gltf_material *m, const struct surface *s, struct ir_material *out) {
    if (is_plain_metal(m, s) || (s->clear > 0 && s->is_thin) || (s->clear == 0 && !mirrors(s)))
        return;
    out->fresnel = true;
    out->refractive_index = fmin(fmax(m->index, 1), 10);
    write(&out->head, &SCHEMA_MATERIAL, "fresnel");
    write(&out->head, &SCHEMA_MATERIAL, "refractive_index");
}

static void put_roughness(const struct surface *s, struct ir_material *out) {
    const bool is_seen = out->albedo.reflection > 0 || (out->albedo.refraction > 0 && !s->is_thin);
    if (!is_seen || s->roughness < 0.01)
        return;
    out->roughness = tidy(s->roughness);
    write(&out->head, &SCHEMA_MATERIAL, "roughness");
}

static void put_volume(const struct gltf_material *m, const struct surface *s, bool is_linear,
                       struct ir_material *out) {
    if (!(s->clear > 0) || s->is_thin)
        return;
    const bool is_clear = !isfinite(m->attenuation_distance);
    const double *color = is_clear ? m->base : m->attenuation_color;
    const double distance = is_clear ? m->thickness : m->attenuation_distance;
    if (color[0] == 1 && color[1] == 1 && color[2] == 1)
        return;
    out->attenuation_color = color_of(color, is_linear);
    out->attenuation_distance = fmin(fmax(distance, 1e-18), 1e18);
    write(&out->head, &SCHEMA_MATERIAL, "attenuation_color");
    write(&out->head, &SCHEMA_MATERIAL, "attenuation_distance");
}

static void put_emission(struct gltf *gltf, const struct gltf_material *m, bool is_linear,
                         struct ir_material *out) {
    const bool is_plain = m->is_unlit && !m->base_texture.node;
    const double *color = is_plain ? m->base : m->emission;
    if (m->emission_texture.node) {
        gltf_lose(gltf, GLTF_LOSS_EMISSION_TEXTURE, m->emission_texture.node);
        return;
    }
    if (color[0] + color[1] + color[2] == 0)
        return;
    out->emission = color_of(color, is_linear);
    out->emission.r = fmin(out->emission.r, 1e6);
    out->emission.g = fmin(out->emission.g, 1e6);
    out->emission.b = fmin(out->emission.b, 1e6);
    write(&out->head, &SCHEMA_MATERIAL, "emission");
}

// Emission: seen in its own colour, whatever lights there are.
static void put_unlit(struct gltf *gltf, const struct gltf_material *m, double factor,
                      struct ir_material *out) {
    const bool has_image = out->diffuse_color.kind == IR_PAINT_IMAGE;
    out->albedo = (struct ir_weights){.diffuse = has_image ? factor : 0};
    write(&out->head, &SCHEMA_MATERIAL, "albedo");
    if (has_image)
        gltf_lose(gltf, GLTF_LOSS_UNLIT, m->node);
}

static void count_losses(struct gltf *gltf, const struct gltf_material *m) {
    if (m->normal_texture.node)
        gltf_lose(gltf, GLTF_LOSS_NORMAL_TEXTURE, m->normal_texture.node);
    if (m->occlusion_texture.node)
        gltf_lose(gltf, GLTF_LOSS_OCCLUSION_TEXTURE, m->occlusion_texture.node);
    if (m->transmission_texture)
        gltf_lose(gltf, GLTF_LOSS_TRANSMISSION_TEXTURE, m->transmission_texture);
    if (m->metallic > 0.5 && m->roughness < 0.9 && m->base_texture.node && !m->metal_texture.node &&
        !m->is_unlit)
        gltf_lose(gltf, GLTF_LOSS_METAL_COLOR, m->node);
    if (image_of(gltf, &m->metal_texture) != GLTF_NONE && !m->is_unlit)
        gltf_lose(gltf, GLTF_LOSS_METAL_TEXTURE, m->metal_texture.node);
    if (m->alpha == GLTF_ALPHA_MASK || (m->alpha == GLTF_ALPHA_BLEND && m->base_texture.node))
        gltf_lose(gltf, GLTF_LOSS_ALPHA, m->node);
}

void gltf_to_material(struct gltf *gltf, uint32_t material, struct gltf_wording wording,
                      struct ir_material *out) {
    const struct gltf_material *m = &gltf->materials.items[material];
    const struct surface surface = surface_of(m, wording);
    *out = (struct ir_material){0};
    schema_init(&SCHEMA_MATERIAL, out);
    put_base(gltf, m, wording.is_linear, out);
    const double factor = out->diffuse_color.kind == IR_PAINT_IMAGE ? weight_of_factor(gltf, m) : 1;
    put_emission(gltf, m, wording.is_linear, out);
    count_losses(gltf, m);
    if (m->is_unlit) {
        put_unlit(gltf, m, factor, out);
        return;
    }
    put_albedo(m, &surface, factor, out);
    if (surface.metal > 0 && out->albedo.specular > 0 && out->diffuse_color.kind == IR_PAINT_COLOR) {
        double color[3];
        for (int k = 0; k < 3; k++)
            color[k] = 1 - surface.metal + surface.metal * m->base[k];
        out->specular_color.color = color_of(color, wording.is_linear);
        write(&out->head, &SCHEMA_MATERIAL, "specular_color");
        write(&out->specular_color.head, &SCHEMA_HIGHLIGHT, "color");
    }
    if (is_plain_metal(m, &surface))
        put_metal(m, &surface, wording.is_linear, out);
    put_fresnel(m, &surface, out);
    put_roughness(&surface, out);
    put_volume(m, &surface, wording.is_linear, out);
}

// ---- names

str gltf_material_name(const struct gltf *gltf, uint32_t material) {
    const str own = gltf->materials.items[material].name;
    return gltf->materials.items[material].is_named ? own
                                                    : arena_format(gltf->arena, "material %u", material);
}
