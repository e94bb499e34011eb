// Lights with extent: at too few samples, around bodies and cameras; ambient light; backgrounds that light.
#include "diag/codes/rule.h"
#include "lint/lint_internal.h"

#include "grammar/ir.h"

// The row of a light that gives it its extent; NULL: it is a point.
static const char *extent_row(const struct ir_light *light) {
    if (light->kind == IR_LIGHT_RECTANGLE)
        return "rectangle";
    if (light->kind == IR_LIGHT_POSITION)
        return light->radius > 0 ? "radius" : NULL;
    return light->angle > 0 ? "angle" : NULL;
}

static void fix_samples(struct lint *lint, str samples) {
    const struct ir_image *image = &lint->ir->image;
    if (image->head.written >> schema_find_row(&SCHEMA_IMAGE, STR("samples")) & 1)
        diag_fix(lint->sink, false, ir_place_value(lint->origin, &image->head, &SCHEMA_IMAGE, "samples"),
                 samples);
}

// Reports `count` lights with an extent; else ambient light that bodies block.
static void report_few_samples(struct lint *lint, const struct ir_light *first, uint32_t count) {
    const struct ir_ambient *ambient = &lint->ir->ambient;
    if (first)
        diag_add(lint->sink, DIAG_FEW_SAMPLES,
                 ir_place_key(lint->origin, &first->head, &SCHEMA_LIGHT, extent_row(first)),
                 "the shadows of this light have hard edges%s: the image has 1 sample per pixel",
                 count > 1 ? ", as those of others" : "");
    else
        diag_add(lint->sink, DIAG_FEW_SAMPLES,
                 ir_place_key(lint->origin, &ambient->head, &SCHEMA_AMBIENT, "occlusion"),
                 "what is near darkens ambient light with hard edges: the image has 1 sample per pixel");
}

void lint_few_samples(struct lint *lint) {
    const struct ir_image *image = &lint->ir->image;
    const bool darkens = lint->scene->occlusion > 0 && !vec3_is_zero(lint->scene->ambient);
    const struct ir_light *first = NULL;
    uint32_t count = 0;
    for (uint32_t i = 0; i < lint->ir->lights.count; i++)
        if (extent_row(&lint->ir->lights.items[i]) && !count++)
            first = &lint->ir->lights.items[i];
    if (image->samples > 1 || (count == 0 && !darkens) || !lint->ir->trace.shadows)
        return;
    report_few_samples(lint, first, count);
    diag_help(lint->sink, "write image: {samples: 16}, or more");
    fix_samples(lint, STR("16"));
}

// Whether all of the box is within the sphere.
static bool is_around(const struct view_light *light, const struct lint_box *box) {
    const vec3 a = vec3_sub(box->lower, light->position), b = vec3_sub(light->position, box->upper);
    const vec3 far = {fmax(fabs(a.x), fabs(b.x)), fmax(fabs(a.y), fabs(b.y)), fmax(fabs(a.z), fabs(b.z))};
    return vec3_length(far) < light->radius;
}

static void report_around(struct lint *lint, const struct view_light *light, str what, span where) {
    diag_add(
        lint->sink, DIAG_LIGHT_AROUND,
        ir_place_value(lint->origin, &lint->ir->lights.items[light->index].head, &SCHEMA_LIGHT, "radius"),
        "this light is a sphere around %.*s", STR_ARG(what));
    diag_note(lint->sink, where, "here");
    diag_help(lint->sink, "choose a smaller radius, or move the light");
}

static bool find_camera(struct lint *lint, const struct view_light *light) {
    for (uint32_t k = 0; k < lint->ir->cameras.count; k++) {
        const struct ir_camera *camera = &lint->ir->cameras.items[k];
        if (vec3_length(vec3_sub(camera->position, light->position)) >= light->radius)
            continue;
        report_around(lint, light, arena_format(lint->arena, "camera '%.*s'", STR_ARG(camera->name)),
                      ir_place_value(lint->origin, &camera->head, &SCHEMA_CAMERA, "position"));
        return true;
    }
    return false;
}

enum {
    WORK_MAX = 20000000, // lights times bodies: later ones are not looked at
};

// Whether it is a lamp with the light at its centre: rays to the light end before the lamp.
static bool is_lamp(const struct lint *lint, const struct view_light *light, const struct lint_body *body) {
    const vec3 middle = body->is->object_to_world.offset;
    return body->is->shape == SCENE_SPHERE && vec3_length(vec3_sub(middle, light->position)) == 0 &&
           !vec3_is_zero(lint->scene->materials[body->is->materials[0]].emission);
}

void lint_light_around(struct lint *lint) {
    uint64_t work = 0;
    for (uint32_t i = 0; i < lint->ir->lights.count && work < WORK_MAX; i++) {
        const struct view_light *light = &lint->views[0].lights[i];
        if (light->extent != VIEW_SPHERE || find_camera(lint, light))
            continue;
        work += lint->body_count;
        for (uint32_t k = 0; k < lint->body_count; k++) {
            const struct lint_body *body = &lint->bodies[k];
            if (!lint_is_there(body) || !is_around(light, &body->box) || is_lamp(lint, light, body))
                continue;
            report_around(lint, light, lint_words_other(lint, body), lint_place(lint, body));
            break;
        }
    }
}

void lint_ambient(struct lint *lint) {
    const struct ir_ambient *ambient = &lint->ir->ambient;
    const vec3 color = lint->scene->ambient;
    const bool black = vec3_is_zero(color);
    if (ambient->head.written == 0 || (!black && (vec3_max_abs(color) < 1 || ambient->occlusion > 0)))
        return;
    if (black && ambient->head.written >> schema_find_row(&SCHEMA_AMBIENT, STR("color")) & 1)
        return; // switched off
    const span at = ir_place_label(lint->origin, &ambient->head);
    if (black) {
        // An intensity multiplies the colour.
        const bool has_intensity =
            ambient->head.written >> schema_find_row(&SCHEMA_AMBIENT, STR("intensity")) & 1;
        const char *row = has_intensity ? "intensity" : "occlusion", *value = has_intensity ? "1" : "0.2";
        diag_add(lint->sink, DIAG_AMBIENT, at,
                 "this ambient light has no color: it is black and adds nothing");
        diag_help(lint->sink, "write its color, such as color: %s", value);
        lint_fix_row(lint, &ambient->head, &SCHEMA_AMBIENT, "color", row, value);
    } else if (lint->ir->lights.count) {
        diag_add(lint->sink, DIAG_AMBIENT, at,
                 "ambient light of %.6g shows every diffuse colour as if fully lit, in shadows too",
                 vec3_max_abs(color));
        diag_help(lint->sink, "write a weaker color, or an occlusion");
    }
}

void lint_emission(struct lint *lint) {
    if (lint->ir->lights.count || !vec3_is_zero(lint->scene->ambient) || lint->scene->background.lights)
        return;
    for (uint32_t i = 0; i < lint->body_count; i++) {
        const struct lint_body *body = &lint->bodies[i];
        for (uint32_t g = 0; lint_is_there(body) && g < body->is->group_count; g++) {
            if (vec3_is_zero(lint->scene->materials[body->is->materials[g]].emission))
                continue;
            diag_add(lint->sink, DIAG_EMISSION_ALONE, lint_place(lint, body),
                     "%.*s glows but lights nothing, and the scene has no light",
                     STR_ARG(lint_words(lint, body)));
            diag_help(lint->sink, "put a light at the same place, with the ball's radius: lights: - "
                                  "{position: ..., radius: ...}");
            return;
        }
    }
}

// ---- a background that lights

void lint_sky_samples(struct lint *lint) {
    const struct ir_scene *ir = lint->ir;
    if (!lint->scene->background.lights || ir->image.samples > 1 || ir_body_count(ir) == 0)
        return;
    diag_add(lint->sink, DIAG_SKY_SAMPLES,
             ir_place_key(lint->origin, &ir->background.head, &SCHEMA_BACKGROUND, "lights"),
             "the light of this background looks grainy: the image has 1 sample per pixel");
    diag_help(lint->sink, "write image: {samples: 64}, or more");
    fix_samples(lint, STR("64"));
}

void lint_sky_dark(struct lint *lint) {
    const struct ir_background *background = &lint->ir->background;
    const bool has_image = background->kind == IR_BACKDROP_IMAGE && background->intensity > 0;
    if (!background->lights || lint->scene->background.lights || has_image)
        return;
    diag_add(lint->sink, DIAG_SKY_DARK,
             ir_place_key(lint->origin, &background->head, &SCHEMA_BACKGROUND, "lights"),
             background->intensity > 0 ? "this background is black and lights nothing"
                                       : "this background has the intensity 0 and lights nothing");
    diag_help(lint->sink, background->intensity > 0 ? "write its image or its color, such as color: 0.5"
                                                    : "write another intensity, or leave it out");
}
