// Weights and indices: what a material can and cannot do with light.
#include "diag/codes/rule.h"
#include "lint/lint_internal.h"

#include "core/number.h"
#include "grammar/ir.h"
#include "scene/media.h"
#include "scene/shape.h"

// Growth over all bounces below this is merely an error in the last digit of each weight.
static const double GROWTH_MIN = 2;

static str number(struct lint *lint, double value) {
    char text[NUMBER_FORMAT_MAX];
    size_t length = number_format(value, text);
    return arena_copy(lint->arena, (str){text, length});
}

static span material_part(const struct lint *lint, const struct ir_material *material, const char *row,
                          const struct lint_body *user) {
    // Materials of mesh files and the default one have no place of their own.
    if (material->head.origin == 0)
        return lint_place(lint, user);
    return ir_place_value(lint->origin, &material->head, &SCHEMA_MATERIAL, row);
}

// ---- refraction with index 1

static void report_index(struct lint *lint, const struct lint_body *body,
                         const struct ir_material *material) {
    diag_add(lint->sink, DIAG_INDEX_ONE, material_part(lint, material, "refractive_index", body),
             "%.*s refracts with weight %.*s but has the same index as the air around it, 1: nothing is bent",
             STR_ARG(lint_material_words(lint, material)),
             STR_ARG(number(lint, material->albedo.refraction)));
    diag_note(lint->sink, lint_place(lint, body), "%.*s has this material", STR_ARG(lint_words(lint, body)));
    diag_help(lint->sink,
              "write refractive_index: 1.5 for glass, 1.33 for water; for a thin pane use a rectangle");
}

// Whether index 1 is meant: a surrounding body may have another index, as with an air bubble in glass, or the
// body is seen by its colour.
static bool is_meant(const struct lint *lint, const struct lint_body *body,
                     const struct ir_material *material) {
    const uint32_t index = (uint32_t)(material - lint->scene->assets->materials);
    if (!vec3_is_zero(lint->scene->materials[index].absorption))
        return true;
    for (uint32_t i = 0; i < lint->body_count; i++) {
        const struct lint_body *other = &lint->bodies[i];
        if (other != body && lint_is_there(other) && lint_boxes_overlap(&body->box, &other->box) &&
            scene_is_medium(lint->scene, other->is))
            return true;
    }
    return false;
}

void lint_index_one(struct lint *lint) {
    bool *told = ARENA_ARRAY(lint->arena, bool, lint->scene->assets->material_count);
    for (uint32_t i = 0; i < lint->body_count; i++) {
        const struct lint_body *body = &lint->bodies[i];
        // Open surfaces are thin panes, which need no index.
        if (!body->is->closed || body->is_opaque)
            continue;
        for (uint32_t g = 0; g < body->is->group_count; g++) {
            const struct ir_material *material = lint_material(lint, body, g);
            bool *here = &told[material - lint->scene->assets->materials];
            if (*here || !(material->albedo.refraction > 0) || material->refractive_index != 1)
                continue;
            if (is_meant(lint, body, material))
                continue;
            *here = true;
            report_index(lint, body, material);
        }
    }
}

// ---- weights that amplify

struct cycle {
    const struct lint_body *a, *b; // the same where light can go round within one
    double gain;                   // of one bounce on each body
};

static const struct ir_material *strongest(const struct lint *lint, const struct lint_body *body) {
    const struct ir_material *found = NULL;
    for (uint32_t g = 0; g < body->is->group_count; g++) {
        const struct ir_material *material = lint_material(lint, body, g);
        if (!found || scene_gain(material) > scene_gain(found))
            found = material;
    }
    return found;
}

// Light that leaves a convex mirror does not come back to it by itself; inside glass, and between the parts
// of a mesh, it does. The worst cycle is one body alone or the two strongest bodies: any other cycle has two
// neighbours whose product is no smaller, since the cycle's mean is no larger than theirs.
static struct cycle worst_cycle(const struct lint *lint) {
    struct cycle worst = {0};
    const struct lint_body *first = NULL;
    const struct lint_body *second = NULL;
    for (uint32_t i = 0; i < lint->body_count; i++) {
        const struct lint_body *body = &lint->bodies[i];
        bool alone = shape_traits(body->is->shape).sees_itself || (body->is->closed && body->refraction > 0);
        if (alone && body->gain * body->gain > worst.gain)
            worst = (struct cycle){body, body, body->gain * body->gain};
        if (!first || body->gain > first->gain) {
            second = first;
            first = body;
        } else if (!second || body->gain > second->gain) {
            second = body;
        }
    }
    if (second && first->gain * second->gain > worst.gain)
        worst = (struct cycle){first, second, first->gain * second->gain};
    return worst;
}

void lint_amplifying(struct lint *lint) {
    struct cycle worst = worst_cycle(lint);
    if (!(worst.gain > 1))
        return;
    int32_t depth = lint->ir->trace.max_depth;
    double growth = pow(worst.gain, depth / 2.0);
    if (growth < GROWTH_MIN)
        return;
    const struct lint_body *body = worst.a->gain >= worst.b->gain ? worst.a : worst.b;
    const struct ir_material *material = strongest(lint, body);
    diag_add(lint->sink, DIAG_AMPLIFYING, material_part(lint, material, "albedo", body),
             "%.*s passes on %.*s times the light that it receives; between mirrors it grows %.3g times in "
             "%d bounces",
             STR_ARG(lint_material_words(lint, material)), STR_ARG(number(lint, body->gain)), growth, depth);
    if (worst.a == worst.b)
        diag_note(lint->sink, lint_place(lint, body), "light can bounce around inside %.*s",
                  STR_ARG(lint_words_other(lint, body)));
    else
        diag_note(lint->sink, lint_place(lint, worst.b),
                  "light can bounce back and forth between %.*s and %.*s",
                  STR_ARG(lint_words_other(lint, worst.a)), STR_ARG(lint_words_other(lint, worst.b)));
    diag_help(lint->sink, "let the weights of reflection and refraction add up to 1 at most");
}

// ---- attenuation that nothing shows

// Whether light goes through the inside of a body of each material.
static bool *shown_inside(struct lint *lint) {
    bool *shown = ARENA_ARRAY(lint->arena, bool, lint->scene->assets->material_count);
    for (uint32_t i = 0; i < lint->body_count; i++)
        if (lint_is_there(&lint->bodies[i]) && scene_is_medium(lint->scene, lint->bodies[i].is))
            shown[scene_medium_material(lint->scene, lint->bodies[i].is)] = true;
    return shown;
}

static const char *why_not_shown(const struct ir_material *material, bool colored) {
    if (!colored)
        return "its attenuation_color is white";
    if (!(material->albedo.refraction > 0))
        return "its weight of refraction is 0";
    return "no sphere and no closed mesh is filled with it";
}

void lint_attenuation(struct lint *lint) {
    const bool *shown = shown_inside(lint);
    bool *used = ARENA_ARRAY(lint->arena, bool, lint->scene->assets->material_count);
    for (uint32_t i = 0; i < lint->body_count; i++)
        for (uint32_t g = 0; lint_is_there(&lint->bodies[i]) && g < lint->bodies[i].is->group_count; g++)
            used[lint->bodies[i].is->materials[g]] = true;
    for (uint32_t i = 0; i < lint->scene->assets->material_count; i++) {
        const struct ir_material *material = &lint->scene->assets->materials[i];
        const bool colored = !vec3_is_zero(lint->scene->materials[i].absorption);
        const char *row = lint_is_written(&material->head, &SCHEMA_MATERIAL, "attenuation_color")
                              ? "attenuation_color"
                              : "attenuation_distance";
        // Materials that no body has are reported as such (W408).
        if (!used[i] || material->head.origin == 0 ||
            !lint_is_written(&material->head, &SCHEMA_MATERIAL, row) || (colored && shown[i]))
            continue;
        diag_add(lint->sink, DIAG_NO_EFFECT,
                 ir_place_key(lint->origin, &material->head, &SCHEMA_MATERIAL, row),
                 "'%s' of %.*s has no effect: %s", row, STR_ARG(lint_material_words(lint, material)),
                 why_not_shown(material, colored));
        diag_help(lint->sink,
                  colored ? "light is attenuated on its way inside a body: through a sphere or closed mesh "
                            "that refracts"
                          : "write what is left of white light after that distance: attenuation_color");
    }
}

// ---- media in which light ends at once

// The channels of which nothing is left; empty: something is left of each.
static const char *channels_gone(vec3 left) {
    static const char *const names[] = {"",     "red",         "green",         "red or green",
                                        "blue", "red or blue", "green or blue", "red, green or blue"};
    return names[!(left.x > 0) + 2 * !(left.y > 0) + 4 * !(left.z > 0)];
}

void lint_black_medium(struct lint *lint) {
    const bool *shown = shown_inside(lint);
    for (uint32_t i = 0; i < lint->scene->assets->material_count; i++) {
        const struct ir_material *material = &lint->scene->assets->materials[i];
        const char *gone =
            channels_gone(scene_linear_color(material->attenuation_color, lint->ir->image.transfer));
        if (!shown[i] || material->head.origin == 0 || !*gone)
            continue;
        diag_add(lint->sink, DIAG_BLACK_MEDIUM,
                 ir_place_value(lint->origin, &material->head, &SCHEMA_MATERIAL, "attenuation_color"),
                 "%.*s lets no %s through, however short the way inside is: 'attenuation_color' is 0 there",
                 STR_ARG(lint_material_words(lint, material)), gone);
        diag_help(lint->sink, "write what is left after 'attenuation_distance', such as 0.02, in place of 0");
    }
}
