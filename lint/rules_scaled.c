// Instances that scale their object, and hold what has a law of its own: it does not scale with the object.
#include "diag/codes/rule.h"
#include "lint/lint_internal.h"

#include "grammar/ir.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_walk.h"
#include "scene/media.h"

#include <math.h>

// What an instance holds, by the place where it is written: 1 + number of the first body, of the first light.
struct held {
    uint32_t medium, light;
};

static double scale_in(const struct lint *lint, uint32_t instance) {
    return instance ? cbrt(fabs(mat3_determinant(lint->scene->places[instance - 1].linear))) : 1;
}

static bool is_scaled(double scale) {
    return fabs(scale - 1) > 1e-9;
}

// 1 + the innermost instance around an item that scales it; 0: it has its own size.
static uint32_t scaled_by(const struct lint *lint, const struct schema_element *element, uint32_t index) {
    const struct ir_copies *copies = lint->origin->copies;
    const struct schema_row *row = ir_walk_pool(&SCHEMA_INSTANCE);
    uint32_t instance = ir_copies_instance(copies, ir_walk_pool(element), index);
    if (!is_scaled(scale_in(lint, instance)))
        return 0;
    for (;;) {
        const uint32_t around = ir_copies_instance(copies, row, instance - 1);
        if (!around || is_scaled(scale_in(lint, instance) / scale_in(lint, around)))
            return instance;
        instance = around;
    }
}

static struct held *held_by(const struct lint *lint, struct held *all, uint32_t instance) {
    return &all[lint->ir->instances.items[instance - 1].head.origin];
}

static bool is_attenuating(const struct lint *lint, const struct lint_body *body) {
    const struct scene *scene = lint->scene;
    return lint_is_there(body) && body->is->element && scene_is_medium(scene, body->is) &&
           !vec3_is_zero(scene->materials[scene_medium_material(scene, body->is)].absorption);
}

static void note_medium(struct lint *lint, const struct lint_body *body) {
    const struct ir_material *material =
        &lint->scene->assets->materials[scene_medium_material(lint->scene, body->is)];
    diag_note(lint->sink, lint_place(lint, body), "'attenuation_distance' stays as it is: of %.*s, in %.*s",
              STR_ARG(lint_material_words(lint, material)), STR_ARG(lint_words(lint, body)));
}

static void report(struct lint *lint, uint32_t instance, const struct held *held) {
    const double scale = scale_in(lint, instance);
    diag_add(lint->sink, DIAG_SCALED_LAW,
             ir_place_label(lint->origin, &lint->ir->instances.items[instance - 1].head),
             "all in this instance is %.3g times its size, but not %s", scale,
             held->medium && held->light ? "how far light goes inside a medium, nor how strong a light is"
             : held->medium              ? "how far light goes inside a medium"
                                         : "how strong a light is");
    if (held->medium)
        note_medium(lint, &lint->bodies[held->medium - 1]);
    if (held->light)
        diag_note(
            lint->sink, ir_place_label(lint->origin, &lint->ir->lights.items[held->light - 1].head),
            "'intensity' of this light stays as it is, and falls off by the longer or shorter distance");
    if (held->light)
        diag_help(lint->sink, "for surfaces as bright as without the scale, multiply 'intensity' by %.3g",
                  scale * scale);
    else
        diag_help(lint->sink,
                  "for glass as deep in colour as without the scale, multiply "
                  "'attenuation_distance' by %.3g",
                  scale);
}

void lint_scaled(struct lint *lint) {
    if (!lint->scene->places)
        return;
    struct held *all = ARENA_ARRAY(lint->arena, struct held, lint->origin->elements.count);
    for (uint32_t i = 0; i < lint->body_count; i++) {
        const struct scene_body *body = lint->bodies[i].is;
        const uint32_t by =
            is_attenuating(lint, &lint->bodies[i]) ? scaled_by(lint, body->element, body->index) : 0;
        if (by && !held_by(lint, all, by)->medium)
            held_by(lint, all, by)->medium = i + 1;
    }
    for (uint32_t i = 0; i < lint->ir->lights.count; i++) {
        const bool falls = lint->ir->lights.items[i].falloff == IR_FALLOFF_INVERSE_SQUARE;
        const uint32_t by = falls ? scaled_by(lint, &SCHEMA_LIGHT, i) : 0;
        if (by && !held_by(lint, all, by)->light)
            held_by(lint, all, by)->light = i + 1;
    }
    for (uint32_t i = 1; i <= lint->ir->instances.count; i++) {
        struct held *held = held_by(lint, all, i);
        if (held->medium || held->light)
            report(lint, i, held);
        *held = (struct held){0};
    }
}
