// Colours, materials and the background.
#include "core/srgb.h"
#include "grammar/ir.h"
#include "grammar/ir_features.h"
#include "scene/scene_internal.h"
#include "scene/shape.h"
#include "scene/transform.h"

#include <math.h>

vec3 scene_linear_color(struct ir_color color, unsigned transfer) {
    if (!color.is_hex)
        return (vec3){color.r, color.g, color.b};
    vec3 shown = {(double)(color.hex >> 16 & 0xFF) / 255, (double)(color.hex >> 8 & 0xFF) / 255,
                  (double)(color.hex & 0xFF) / 255};
    if (transfer != IR_TRANSFER_SRGB)
        return shown;
    return (vec3){srgb_decode(shown.x), srgb_decode(shown.y), srgb_decode(shown.z)};
}

// The loss per scene unit in a channel of which `left` remains after a distance.
static double absorbed(double left, double distance) {
    return left < 1 ? fmin(-log(left) / distance, SCENE_ABSORPTION_MAX) : 0;
}

static vec3 absorption_of(const struct ir_material *ir, unsigned transfer) {
    const vec3 color = scene_linear_color(ir->attenuation_color, transfer);
    const double distance = ir->attenuation_distance;
    return (vec3){absorbed(color.x, distance), absorbed(color.y, distance), absorbed(color.z, distance)};
}

static bool has_checker(const struct ir_material *ir) {
    return ir->diffuse_color.kind == IR_PAINT_CHECKER;
}

static vec3 paint_color(const struct ir_material *ir, int odd, unsigned transfer) {
    const struct ir_paint *paint = &ir->diffuse_color;
    return scene_linear_color(has_checker(ir) ? paint->checker.colors[odd] : paint->color, transfer);
}

#define FROM_IR(kind, name, share, record, ...) .name = __VA_ARGS__,
static struct scene_material material_of(const struct ir_material *ir, unsigned transfer) {
    return (struct scene_material){SCENE_MATERIAL_FIELDS(FROM_IR)};
}

static struct scene_background background_of(const struct ir_background *ir, const struct assets *assets,
                                             unsigned transfer) {
    mat3 turn = mat3_rotation((vec3){0, ir->rotation, 0});
    struct scene_background b = {.picture = assets->background,
                                 .intensity = ir->intensity,
                                 .sine = turn.m[0][2],
                                 .cosine = turn.m[0][0]};
    if (ir->kind == IR_BACKDROP_COLOR)
        b.color = vec3_mul(scene_linear_color(ir->color, transfer), ir->intensity);
    b.lights = ir->lights && (b.picture ? ir->intensity > 0 : !vec3_is_zero(b.color));
    return b;
}

void scene_build(const struct ir_scene *ir, const struct assets *assets, struct arena *arena,
                 struct scene *out) {
    const unsigned transfer = ir->image.transfer;
    *out = (struct scene){
        .ir = ir,
        .assets = assets,
        .material_count = assets->material_count,
        .background = background_of(&ir->background, assets, transfer),
        .ambient = vec3_mul(scene_linear_color(ir->ambient.color, transfer), ir->ambient.intensity),
        .occlusion = ir->ambient.occlusion};
    out->materials = ARENA_ARRAY(arena, struct scene_material, assets->material_count);
    for (uint32_t i = 0; i < assets->material_count; i++)
        out->materials[i] = material_of(&assets->materials[i], transfer);
    scene_build_textures(out, arena);
    scene_build_places(out, arena);
    scene_build_bodies(out, arena);
}

// ---- what surfaces send on

// Weights written to add up to 1 may round to a little more.
static const double GAIN_ROUNDING = 1e-9;

// The most of a mirrored channel that is left; a metal is white at its edge. Decoding makes no number larger.
static double mirrored(const struct ir_material *material) {
    const vec3 color = scene_linear_color(material->reflection_color, IR_TRANSFER_NONE);
    return material->metal ? 1 : fmax(color.x, fmax(color.y, color.z));
}

double scene_gain(const struct ir_material *material) {
    const double reflection = material->albedo.reflection * mirrored(material);
    const double refraction = material->albedo.refraction;
    return material->fresnel && !material->metal ? fmax(reflection, refraction) : reflection + refraction;
}

bool scene_amplifies(const struct scene *scene) {
    double first = 0, second = 0; // the two largest gains, from two different bodies
    for (uint32_t i = 0; i < scene->body_count; i++) {
        const struct scene_body *body = &scene->bodies[i];
        double gain = 0, refraction = 0;
        for (uint32_t g = 0; g < body->group_count; g++) {
            const struct ir_material *material = &scene->assets->materials[body->materials[g]];
            gain = fmax(gain, scene_gain(material));
            refraction = fmax(refraction, material->albedo.refraction);
        }
        // Within a mesh, and inside glass, light returns to the surface that it left.
        if (gain > 1 + GAIN_ROUNDING &&
            (shape_traits(body->shape).sees_itself || (body->closed && refraction > 0)))
            return true;
        second = fmax(second, fmin(gain, first));
        first = fmax(first, gain);
    }
    return first * second > 1 + GAIN_ROUNDING;
}
