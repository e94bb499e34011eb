// Values that nothing uses: what is written has no effect on the picture.
#include "diag/codes/rule.h"
#include "lint/lint_internal.h"

#include "grammar/ir.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_walk.h"

// ---- a focus without a lens

static void look_at_camera(struct lint *lint, const struct ir_camera *camera) {
    const char *const rows[] = {
        [IR_FOCUS_DISTANCE] = "focus", [IR_FOCUS_POINT] = "focus_at", [IR_FOCUS_BODY] = "focus_on"};
    const char *row = rows[camera->focusing];
    if (camera->aperture > 0 || !lint_is_written(&camera->head, &SCHEMA_CAMERA, row) ||
        lint_is_written(&camera->head, &SCHEMA_CAMERA, "aperture")) // 0: a lens that is switched off
        return;
    diag_add(lint->sink, DIAG_UNUSED_VALUE, ir_place_key(lint->origin, &camera->head, &SCHEMA_CAMERA, row),
             "'%s' of camera '%.*s' has no effect: without an aperture all is sharp", row,
             STR_ARG(camera->name));
    diag_help(lint->sink, "write aperture, the diameter of the lens, or leave '%s' out", row);
}

// ---- materials

static void report_row(struct lint *lint, const struct ir_material *material, const char *row) {
    diag_add(lint->sink, DIAG_UNUSED_VALUE,
             ir_place_key(lint->origin, &material->head, &SCHEMA_MATERIAL, row),
             "'%s' of %.*s has no effect: it neither reflects nor refracts", row,
             STR_ARG(lint_material_words(lint, material)));
    diag_help(lint->sink,
              "give it a weight of reflection or refraction, the third and fourth number of albedo, or "
              "leave '%s' out",
              row);
}

static void report_image(struct lint *lint, const struct ir_material *material,
                         const struct ir_texture *image, const char *row, const char *weight) {
    diag_add(lint->sink, DIAG_UNUSED_VALUE,
             ir_place_value(lint->origin, &image->head, &SCHEMA_TEXTURE, "file"),
             "the image in '%s' of %.*s is not shown: its %s weight is 0", row,
             STR_ARG(lint_material_words(lint, material)), weight);
    diag_help(lint->sink, "give it a %s weight, the %s number of albedo, or leave the image out", weight,
              weight[0] == 'd' ? "first" : "second");
}

// Values about light inside a body, in a material that lets none in. `fresnel` also uses the index, as of a
// varnish.
static void look_inside(struct lint *lint, const struct ir_material *material) {
    const struct ir_weights *w = &material->albedo;
    if (w->refraction > 0)
        return;
    const bool varnished = material->fresnel && !material->metal && w->reflection > 0;
    const char *row = material->priority != 0 ? "priority" : "refractive_index";
    if (material->priority == 0 && (varnished || material->refractive_index == 1))
        return;
    diag_add(
        lint->sink, DIAG_UNUSED_VALUE, ir_place_key(lint->origin, &material->head, &SCHEMA_MATERIAL, row),
        "'%s' of %.*s has no effect: it does not refract", row, STR_ARG(lint_material_words(lint, material)));
    diag_help(lint->sink,
              "give it a weight of refraction, the fourth number of albedo, such as [0, 0.5, 0.1, 0.8] for "
              "glass, or leave "
              "'%s' out",
              row);
}

// What only light that is mirrored shows, and what a metal has no use for.
static void look_at_mirror(struct lint *lint, const struct ir_material *material) {
    const char *const rows[] = {"reflection_color", "metal"};
    const bool has[] = {lint_is_written(&material->head, &SCHEMA_MATERIAL, rows[0]), material->metal};
    for (int i = 0; i < 2 && !(material->albedo.reflection > 0); i++) {
        if (!has[i] || !lint_is_written(&material->head, &SCHEMA_MATERIAL, rows[i]))
            continue;
        diag_add(lint->sink, DIAG_UNUSED_VALUE,
                 ir_place_key(lint->origin, &material->head, &SCHEMA_MATERIAL, rows[i]),
                 "'%s' of %.*s has no effect: it does not reflect", rows[i],
                 STR_ARG(lint_material_words(lint, material)));
        diag_help(lint->sink, "give it a weight of reflection, the third number of albedo, or leave '%s' out",
                  rows[i]);
    }
    if (!(material->albedo.reflection > 0) && material->metal &&
        !lint_is_written(&material->head, &SCHEMA_MATERIAL, "metal")) {
        diag_add(lint->sink, DIAG_UNUSED_VALUE,
                 ir_place_key(lint->origin, &material->head, &SCHEMA_MATERIAL, "preset"),
                 "nothing of the metal is seen on %.*s: its 'albedo' has no weight of reflection",
                 STR_ARG(lint_material_words(lint, material)));
        diag_help(lint->sink, "leave 'albedo' out, or give it a third number");
    }
    if (!material->metal || !material->fresnel ||
        !lint_is_written(&material->head, &SCHEMA_MATERIAL, "fresnel"))
        return;
    diag_add(lint->sink, DIAG_UNUSED_VALUE,
             ir_place_key(lint->origin, &material->head, &SCHEMA_MATERIAL, "fresnel"),
             "'fresnel' of %.*s has no effect: it is a metal, which mirrors more towards its edge by itself",
             STR_ARG(lint_material_words(lint, material)));
    diag_help(lint->sink, "leave 'fresnel' out, or 'metal' for a surface with a 'refractive_index'");
}

static void look_at_material(struct lint *lint, const struct ir_material *material) {
    const struct ir_weights *w = &material->albedo;
    const bool sends_rays = w->reflection > 0 || w->refraction > 0;
    if (!sends_rays && material->roughness > 0)
        report_row(lint, material, "roughness");
    if (!sends_rays && material->fresnel)
        report_row(lint, material, "fresnel");
    look_at_mirror(lint, material);
    look_inside(lint, material);
    if (material->diffuse_color.kind == IR_PAINT_IMAGE && !(w->diffuse > 0))
        report_image(lint, material, &material->diffuse_color.image, "diffuse_color", "diffuse");
    if (material->specular_color.kind == IR_PAINT_IMAGE && !(w->specular > 0))
        report_image(lint, material, &material->specular_color.image, "specular_color", "specular");
}

// ---- lights that must be seen

static void look_at_light(struct lint *lint, const struct view_light *light) {
    const struct ir_light *ir = &lint->ir->lights.items[light->index];
    if (!ir->visible || view_light_is_seen(light))
        return;
    const bool is_point = light->extent == VIEW_POINT;
    diag_add(
        lint->sink, DIAG_UNUSED_VALUE, ir_place_key(lint->origin, &ir->head, &SCHEMA_LIGHT, "visible"),
        is_point
            ? "'visible' of this light has no effect: a point has no size to be seen"
            : "'visible' of this light has no effect: a body has its very surface and is seen in its place");
    if (is_point)
        diag_help(lint->sink, "write its %s, or leave 'visible' out",
                  light->directional ? "angle" : "radius");
    else
        diag_help(lint->sink, "remove the body, or leave 'visible' out");
}

// ---- bodies

static bool has_pattern(const struct lint *lint, const struct lint_body *body) {
    for (uint32_t i = 0; i < body->is->group_count; i++) {
        const struct ir_material *material = lint_material(lint, body, i);
        if (material->diffuse_color.kind != IR_PAINT_COLOR || material->specular_color.kind != IR_PAINT_COLOR)
            return true;
    }
    return false;
}

static void look_at_body(struct lint *lint, const struct lint_body *body) {
    const struct schema_element *element = body->is->element;
    // In an object another instance may give it a material with a pattern.
    const bool is_shown_again =
        ir_copies_instance(lint->origin->copies, ir_walk_pool(element), body->is->index);
    if (element == &SCHEMA_SPHERE && lint_is_written(body->is->head, element, "rotation") &&
        !is_shown_again && !has_pattern(lint, body)) {
        diag_add(lint->sink, DIAG_UNUSED_VALUE,
                 ir_place_key(lint->origin, body->is->head, element, "rotation"),
                 "'rotation' of %.*s has no effect: a sphere of one colour looks the same from all sides",
                 STR_ARG(lint_words(lint, body)));
        diag_help(lint->sink, "give its material an image or a checker, or leave 'rotation' out");
    }
    if (element == &SCHEMA_MODEL && body->mesh && lint_is_written(body->is->head, element, "crease_angle") &&
        (!body->is->smooth || !mesh_lacks_normals(body->mesh->mesh))) {
        diag_add(lint->sink, DIAG_UNUSED_VALUE,
                 ir_place_key(lint->origin, body->is->head, element, "crease_angle"),
                 "'crease_angle' of %.*s has no effect: %s", STR_ARG(lint_words(lint, body)),
                 body->is->smooth ? "its mesh says itself which edges are sharp, by a normal at each corner"
                                  : "it is flat, and all of its edges are sharp");
        diag_help(lint->sink, body->is->smooth ? "leave 'crease_angle' out"
                                               : "write smooth: true beside it, or leave 'crease_angle' out");
    }
}

// ---- shadows and samples

static bool any_refracts(const struct lint *lint) {
    for (uint32_t i = 0; i < lint->body_count; i++)
        if (lint_is_there(&lint->bodies[i]) && !(lint->bodies[i].is_opaque))
            return true;
    return false;
}

static void look_at_shadows(struct lint *lint) {
    const struct ir_trace *trace = &lint->ir->trace;
    const struct ir_ambient *ambient = &lint->ir->ambient;
    if (trace->transparent_shadows && (!trace->shadows || !any_refracts(lint))) {
        diag_add(lint->sink, DIAG_UNUSED_VALUE,
                 ir_place_key(lint->origin, &trace->head, &SCHEMA_TRACE, "transparent_shadows"),
                 "'transparent_shadows' has no effect: %s",
                 trace->shadows ? "no body refracts" : "all shadows are switched off");
        diag_help(lint->sink, trace->shadows
                                  ? "light passes through materials with a weight of refraction, the "
                                    "fourth number of albedo"
                                  : "remove shadows: false, or leave 'transparent_shadows' out");
    }
    if (ambient->occlusion > 0 && !trace->shadows) {
        diag_add(lint->sink, DIAG_UNUSED_VALUE,
                 ir_place_key(lint->origin, &ambient->head, &SCHEMA_AMBIENT, "occlusion"),
                 "'occlusion' of ambient light has no effect: all shadows are switched off");
        diag_help(lint->sink, "remove shadows: false, or leave 'occlusion' out");
    }
}

// Both must say so, as in lint_never_ends.
static void look_at_samples(struct lint *lint) {
    const struct ir_image *image = &lint->ir->image;
    if (!lint_is_written(&image->head, &SCHEMA_IMAGE, "min_samples") ||
        lint_is_written(&image->head, &SCHEMA_IMAGE, "error") || lint->input->image->error > 0)
        return;
    diag_add(lint->sink, DIAG_UNUSED_VALUE,
             ir_place_key(lint->origin, &image->head, &SCHEMA_IMAGE, "min_samples"),
             "'min_samples' has no effect: without an error all pixels take the same number of samples, %d",
             image->samples);
    diag_help(lint->sink,
              "write the error at which pixels end, such as error: 0.01, or leave 'min_samples' out");
}

// W408 reports materials that no body has; mesh files define more than they use.
void lint_unused_value(struct lint *lint) {
    const struct scene *scene = lint->scene;
    bool *told = ARENA_ARRAY(lint->arena, bool, scene->assets->material_count);
    for (uint32_t i = 0; i < lint->ir->cameras.count; i++)
        look_at_camera(lint, &lint->ir->cameras.items[i]);
    for (uint32_t i = 0; i < lint->views[0].light_count; i++)
        if (!lint->views[0].lights[i].automatic)
            look_at_light(lint, &lint->views[0].lights[i]);
    look_at_shadows(lint);
    look_at_samples(lint);
    for (uint32_t i = 0; i < lint->body_count; i++)
        look_at_body(lint, &lint->bodies[i]);
    for (uint32_t i = 0; i < lint->body_count; i++)
        for (uint32_t g = 0; lint_is_there(&lint->bodies[i]) && g < lint->bodies[i].is->group_count; g++) {
            const struct ir_material *material = lint_material(lint, &lint->bodies[i], g);
            bool *here = &told[material - scene->assets->materials];
            if (!*here && material->head.origin != 0)
                look_at_material(lint, material);
            *here = true;
        }
}
