// Panels that light nothing, and panels in the plane of a face.
#include "diag/codes/rule.h"
#include "lint/lint_internal.h"

#include "grammar/ir.h"

enum {
    WORK_MAX = 20000000, // panels times bodies and triangles
};

// A few units in the last place of the coordinates in single precision, as for cameras and lights.
static const double NEAR = LINT_RESOLUTION;

static span panel_place(const struct lint *lint, const struct view_light *light) {
    const struct ir_light *ir = &lint->ir->lights.items[light->index];
    return ir_place_key(lint->origin, &ir->head, &SCHEMA_LIGHT, "rectangle");
}

// ---- the wrong way round

// Whether all of the box is on the side that the panel does not shine on.
static bool is_in_the_dark(const struct view_light *light, const struct lint_box *box) {
    const vec3 n = light->outward, p = light->position;
    const vec3 corner = {n.x > 0 ? box->upper.x : box->lower.x, n.y > 0 ? box->upper.y : box->lower.y,
                         n.z > 0 ? box->upper.z : box->lower.z};
    return vec3_dot(n, vec3_sub(corner, p)) <= LINT_RESOLUTION * fmax(vec3_max_abs(corner), vec3_max_abs(p));
}

static bool lights_nothing(const struct lint *lint, const struct view_light *light) {
    for (uint32_t k = 0; k < lint->body_count; k++)
        if (lint_is_there(&lint->bodies[k]) && !is_in_the_dark(light, &lint->bodies[k].box))
            return false;
    return true;
}

void lint_panel_away(struct lint *lint) {
    const struct view *view = &lint->views[0];
    for (uint32_t i = 0; i < view->light_count && lint->body_count > 0; i++) {
        const struct view_light *light = &view->lights[i];
        if (light->extent != VIEW_PANEL || !lights_nothing(lint, light))
            continue;
        diag_add(lint->sink, DIAG_PANEL_AWAY, panel_place(lint, light),
                 "this panel lights nothing: all bodies are on the side that it does not shine on");
        diag_help(lint->sink, "exchange edge_u and edge_v: it shines to the side of edge_u x edge_v");
    }
}

// ---- in the plane of a face

struct panel_search {
    struct lint_face halves[2];
    const struct lint_tree *tree; // of the body's mesh
    affine3 to_world;
    double near;
    uint64_t work;
    bool found;
    uint32_t triangle; // of a mesh
};

static bool is_in_plane(const struct panel_search *s, struct lint_triangle triangle) {
    const struct lint_face face = lint_face_of(triangle);
    return lint_faces_coincide(&s->halves[0], &face, s->near, 16 * s->near) ||
           lint_faces_coincide(&s->halves[1], &face, s->near, 16 * s->near);
}

static bool visit(void *context, uint32_t first, uint32_t count) {
    struct panel_search *s = context;
    for (uint32_t i = first; i < first + count && !s->found; i++) {
        s->triangle = s->tree->order[i];
        s->found =
            is_in_plane(s, lint_triangle_place(lint_mesh_triangle(s->tree->mesh, s->triangle), &s->to_world));
    }
    s->work += count;
    return !s->found && s->work < WORK_MAX;
}

static void search_body(struct lint *lint, struct panel_search *s, const struct lint_box *box,
                        const struct lint_body *body) {
    struct lint_triangle flat[LINT_FLAT_TRIANGLES];
    for (uint32_t i = 0, count = lint_flat_triangles(body, flat); i < count && !s->found; i++)
        s->found = is_in_plane(s, flat[i]);
    if (s->found || !body->mesh)
        return;
    s->to_world = body->is->object_to_world;
    s->tree = lint_tree_of(lint, body->mesh);
    const affine3 back = transform_inverse(s->to_world);
    const struct lint_box own = lint_box_place(*box, &back);
    lint_tree_in_box(s->tree, &own, visit, s);
}

static void report_in_plane(struct lint *lint, const struct view_light *light, const struct lint_body *body,
                            const struct panel_search *s) {
    diag_add(lint->sink, DIAG_PANEL_IN_PLANE, panel_place(lint, light),
             "this panel lies in the plane of %.*s: rounding decides where its light comes through",
             STR_ARG(lint_words_other(lint, body)));
    if (body->mesh)
        lint_note_mesh(lint, body->mesh, body->mesh->mesh->triangles[s->triangle].line, "in this face");
    else
        diag_note(lint->sink, lint_place(lint, body), "this body");
    diag_help(lint->sink, "move the panel a little to the side that it shines on");
}

static struct panel_search begin_search(const struct view_light *light, struct lint_box *box) {
    const vec3 u = vec3_mul(light->edge_u, 0.5), v = vec3_mul(light->edge_v, 0.5), p = light->position;
    const vec3 a = vec3_sub(vec3_sub(p, u), v), b = vec3_sub(vec3_add(p, u), v),
               c = vec3_add(vec3_add(p, u), v), d = vec3_add(vec3_sub(p, u), v);
    const struct lint_triangle first = {{a, b, c}}, second = {{a, c, d}};
    struct panel_search s = {.halves = {lint_face_of(first), lint_face_of(second)}};
    *box = lint_box_join(lint_box_of(&first), lint_box_of(&second));
    s.near = NEAR * fmax(vec3_max_abs(box->lower), vec3_max_abs(box->upper));
    *box = lint_box_grow(*box, s.near);
    return s;
}

// A body that is the panel's own surface keeps shadow rays away from everything in its plane (scene/view.h).
void lint_panel_in_plane(struct lint *lint) {
    const struct view *view = &lint->views[0];
    uint64_t work = 0;
    for (uint32_t i = 0; lint->ir->trace.shadows && i < view->light_count && work < WORK_MAX; i++) {
        const struct view_light *light = &view->lights[i];
        if (light->extent != VIEW_PANEL || light->before_body > 0)
            continue;
        struct lint_box box;
        struct panel_search s = begin_search(light, &box);
        for (uint32_t k = 0; k < lint->body_count && !s.found && work + s.work < WORK_MAX; k++) {
            const struct lint_body *body = &lint->bodies[k];
            s.work++;
            if (!lint_is_there(body) || !lint_boxes_overlap(&box, &body->box))
                continue;
            search_body(lint, &s, &box, body);
            if (s.found)
                report_in_plane(lint, light, body, &s);
        }
        work += s.work;
    }
}
