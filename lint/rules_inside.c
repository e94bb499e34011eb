// Cameras and lights inside bodies, lights on surfaces.
#include "diag/codes/rule.h"
#include "lint/box_tree.h"
#include "lint/lint_internal.h"

#include "grammar/ir.h"
#include "scene/shape.h"

enum {
    WORK_MAX = 8000000, // bodies against trees of cameras or lights: later ones are not looked at
};

// ---- cameras

// A room: the inside of an opaque body is lit, and the camera inside sees it.
static bool holds_light(struct lint *lint, const struct lint_body *body) {
    const struct view *view = &lint->views[0];
    if (!vec3_is_zero(lint->scene->ambient) && lint->scene->occlusion == 0)
        return true;
    for (uint32_t i = 0; i < view->light_count; i++) {
        const struct view_light *light = &view->lights[i];
        if (!light->directional && (light->automatic || lint_is_inside(lint, body, light->position)))
            return true;
    }
    return false;
}

static void report_camera(struct lint *lint, const struct ir_camera *camera, const struct lint_body *body) {
    span at = ir_place_value(lint->origin, &camera->head, &SCHEMA_CAMERA, "position");
    diag_add(lint->sink, DIAG_CAMERA_INSIDE, at, "camera '%.*s' is inside %.*s", STR_ARG(camera->name),
             STR_ARG(lint_words_other(lint, body)));
    if (body->is_opaque)
        diag_note(lint->sink, lint_place(lint, body),
                  "there is no light inside: the camera sees only its dark inner side");
    else
        diag_note(lint->sink, lint_place(lint, body),
                  "it refracts, so rays are bent as they leave it, as in a picture taken under water");
    diag_help(lint->sink, "move the camera out of the body");
}

struct camera_search {
    struct lint *lint;
    const struct lint_body *body;
    const struct lint_body **found; // for each camera: the first body that it is inside
    uint32_t found_count;
};

static bool take_camera(void *context, const void *of) {
    struct camera_search *s = context;
    const struct ir_camera *camera = of;
    const size_t i = (size_t)(camera - s->lint->ir->cameras.items);
    if (!s->found[i] && lint_is_inside(s->lint, s->body, s->lint->views[i].camera.position) &&
        !(s->body->is_opaque && holds_light(s->lint, s->body))) {
        s->found[i] = s->body;
        s->found_count++;
    }
    return true;
}

// The tree is over the cameras, of which there are usually few; bodies are visited in their order, as for
// lights.
void lint_camera_inside(struct lint *lint) {
    const uint32_t count = lint->ir->cameras.count;
    struct lint_box_item *items = ARENA_ARRAY(lint->arena, struct lint_box_item, count);
    struct camera_search s = {.lint = lint};
    struct lint_box_tree tree;
    uint64_t work = 0;
    s.found = ARENA_ARRAY(lint->arena, const struct lint_body *, count);
    for (uint32_t i = 0; i < count; i++) {
        const vec3 position = lint->views[i].camera.position;
        items[i] = (struct lint_box_item){{position, position}, &lint->ir->cameras.items[i]};
    }
    lint_box_tree_build(&tree, lint->arena, items, count);
    for (uint32_t k = 0; k < lint->body_count && s.found_count < count && work < WORK_MAX; k++) {
        s.body = &lint->bodies[k];
        if (s.body->is->closed && lint_is_there(s.body))
            work += lint_box_tree_in_box(&tree, &s.body->box, 0, take_camera, &s);
    }
    for (uint32_t i = 0; i < count; i++)
        if (s.found[i])
            report_camera(lint, &lint->ir->cameras.items[i], s.found[i]);
}

// ---- lights

struct nearest_face {
    const struct lint_tree *tree;
    affine3 object_to_world;
    vec3 point; // in scene units
    double distance;
    uint32_t triangle;
};

static bool measure(void *context, uint32_t first, uint32_t count) {
    struct nearest_face *nearest = context;
    for (uint32_t i = first; i < first + count; i++) {
        struct lint_triangle t = lint_mesh_triangle(nearest->tree->mesh, nearest->tree->order[i]);
        t = lint_triangle_place(t, &nearest->object_to_world);
        double distance = lint_triangle_distance(&t, nearest->point);
        if (distance < nearest->distance) {
            nearest->distance = distance;
            nearest->triangle = nearest->tree->order[i];
        }
    }
    return true;
}

// Whether the point is at most `near` from the body's surface; *triangle: where, on a mesh.
static bool is_on(struct lint *lint, const struct lint_body *body, vec3 point, double near,
                  uint32_t *triangle) {
    const affine3 *map = &body->is->object_to_world;
    struct lint_triangle flat[LINT_FLAT_TRIANGLES];
    switch (body->is->shape) {
    case SCENE_SPHERE:
        return fabs(vec3_length(vec3_sub(point, map->offset)) - body->is->radius) <= near;
    case SCENE_PARALLELOGRAM:
        for (uint32_t i = 0, count = lint_flat_triangles(body, flat); i < count; i++)
            if (lint_triangle_distance(&flat[i], point) <= near)
                return true;
        return false;
    case SCENE_MESH:
        break;
    case SCENE_CONE: {
        const struct shape_cone cone = shape_cone_of(body->is);
        return fabs(shape_cone_distance(&cone, point)) <= near;
    }
    }
    if (!body->mesh)
        return false;
    struct nearest_face nearest = {lint_tree_of(lint, body->mesh), *map, point, INFINITY, 0};
    affine3 back = transform_inverse(*map);
    struct lint_box around = lint_box_grow((struct lint_box){point, point}, near);
    around = lint_box_place(around, &back);
    lint_tree_in_box(nearest.tree, &around, measure, &nearest);
    *triangle = nearest.triangle;
    return nearest.distance <= near;
}

// The largest of its coordinates.
static double body_size(const struct lint_body *body) {
    return fmax(vec3_max_abs(body->box.lower), vec3_max_abs(body->box.upper));
}

static bool any_camera_inside(struct lint *lint, const struct lint_body *body) {
    for (uint32_t i = 0; i < lint->view_count; i++)
        if (lint_is_inside(lint, body, lint->views[i].camera.position))
            return true;
    return false;
}

// What is wrong with a light: the first body that it is inside or on.
struct light_finding {
    const struct lint_body *body; // NULL: nothing
    bool is_on;
    uint32_t triangle; // on which it lies, of a mesh
};

// Whether it is a sphere that is not entirely inside the body: then some of its light gets out.
static bool reaches_out(const struct view_light *light, const struct lint_body *body, double near) {
    const double radius = light->radius;
    const vec3 p = light->position, lower = body->box.lower, upper = body->box.upper;
    if (!(radius > 0))
        return false;
    if (shape_traits(body->is->shape).items == SHAPE_CONE) {
        const struct shape_cone cone = shape_cone_of(body->is);
        return shape_cone_distance(&cone, p) + radius >= -near;
    }
    if (shape_traits(body->is->shape).items == SHAPE_BALL)
        return vec3_length(vec3_sub(p, body->is->object_to_world.offset)) + radius >= body->is->radius - near;
    return p.x - radius < lower.x || p.y - radius < lower.y || p.z - radius < lower.z ||
           p.x + radius > upper.x || p.y + radius > upper.y || p.z + radius > upper.z;
}

static struct light_finding judge_light(struct lint *lint, const struct view_light *light,
                                        const struct lint_body *body) {
    // A few units in the last place of the light's and the body's coordinates in single precision.
    double near = LINT_RESOLUTION * fmax(body_size(body), vec3_max_abs(light->position));
    struct lint_box reach = lint_box_grow(body->box, near);
    struct light_finding found = {.body = NULL};
    if (!lint_box_holds(&reach, light->position) || reaches_out(light, body, near))
        return found;
    // Light shines through bodies that refract, wherever it comes from.
    const bool shines = lint->ir->trace.transparent_shadows && !body->is_opaque && body->is->closed;
    found.is_on = is_on(lint, body, light->position, near, &found.triangle);
    if (found.is_on ||
        (!shines && lint_is_inside(lint, body, light->position) && !any_camera_inside(lint, body)))
        found.body = body;
    return found;
}

static void report_light(struct lint *lint, const struct view_light *light,
                         const struct light_finding *found) {
    const struct lint_body *body = found->body;
    span at =
        ir_place_value(lint->origin, &lint->ir->lights.items[light->index].head, &SCHEMA_LIGHT, "position");
    if (!found->is_on) {
        diag_add(lint->sink, DIAG_LIGHT_INSIDE, at,
                 "this light is inside %.*s, which blocks its light from everything outside",
                 STR_ARG(lint_words_other(lint, body)));
        if (body->is_opaque || lint->ir->trace.transparent_shadows) {
            diag_note(lint->sink, lint_place(lint, body), "this body lets no light through");
            diag_help(lint->sink, "move the light out, or set trace.shadows to false");
        } else {
            diag_note(lint->sink, lint_place(lint, body), "all bodies, even glass, cast full shadows");
            diag_help(lint->sink,
                      "move the light out, or let glass shine: trace: {transparent_shadows: true}");
        }
        return;
    }
    diag_add(lint->sink, DIAG_LIGHT_INSIDE, at,
             "this light is on the surface of %.*s: rounding decides which side it shines on",
             STR_ARG(lint_words_other(lint, body)));
    if (body->mesh)
        lint_note_mesh(lint, body->mesh, body->mesh->mesh->triangles[found->triangle].line, "on this face");
    else
        diag_note(lint->sink, lint_place(lint, body), "this body");
    diag_help(lint->sink, "move the light off the surface");
}

struct light_search {
    struct lint *lint;
    const struct lint_body *body;
    struct light_finding *found; // for each light
    uint64_t work;
};

static bool take_light(void *context, const void *of) {
    struct light_search *s = context;
    const struct view_light *light = of;
    struct light_finding *found = &s->found[light->index];
    s->work++;
    if (!found->body)
        *found = judge_light(s->lint, light, s->body);
    return true;
}

static uint32_t collect_lights(const struct lint *lint, struct lint_box_item *items) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < lint->ir->lights.count; i++) {
        const struct view_light *light = &lint->views[0].lights[i];
        if (light->directional || light->extent == VIEW_PANEL)
            continue;
        // Twice what judge_light allows for the light's size: a body with a light within its reach must be
        // found here, however the sums round.
        double near = 2 * LINT_RESOLUTION * vec3_max_abs(light->position);
        struct lint_box point = {light->position, light->position};
        items[count++] = (struct lint_box_item){lint_box_grow(point, near), light};
    }
    return count;
}

// The tree is over the lights, of which there are usually few; bodies are visited in their order, so the
// first one found for a light is the first in the scene.
void lint_light_inside(struct lint *lint) {
    uint32_t light_count = lint->ir->lights.count;
    if (!lint->ir->trace.shadows || light_count == 0)
        return;
    struct lint_box_item *items = ARENA_ARRAY(lint->arena, struct lint_box_item, light_count);
    struct light_search s = {.lint = lint};
    s.found = ARENA_ARRAY(lint->arena, struct light_finding, light_count);
    struct lint_box_tree tree;
    lint_box_tree_build(&tree, lint->arena, items, collect_lights(lint, items));
    for (uint32_t k = 0; k < lint->body_count && s.work < WORK_MAX; k++) {
        s.body = &lint->bodies[k];
        struct lint_box reach = lint_box_grow(s.body->box, LINT_RESOLUTION * body_size(s.body));
        if (lint_is_there(s.body))
            s.work += lint_box_tree_in_box(&tree, &reach, 0, take_light, &s);
    }
    for (uint32_t i = 0; i < light_count; i++)
        if (s.found[i].body)
            report_light(lint, &lint->views[0].lights[i], &s.found[i]);
}
