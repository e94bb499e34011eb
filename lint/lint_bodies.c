// Bodies, meshes and cameras as the rules need them.
#include "lint/lint_internal.h"

#include "grammar/ir.h"
#include "scene/shape.h"

// ---- materials

bool lint_sends_rays_on(const struct lint *lint) {
    for (uint32_t i = 0; i < lint->body_count; i++)
        if (lint->bodies[i].gain > 0)
            return true;
    return false;
}

const struct ir_material *lint_material(const struct lint *lint, const struct lint_body *body,
                                        uint32_t group) {
    return &lint->scene->assets->materials[body->is->materials[group]];
}

static void weigh(const struct lint *lint, struct lint_body *body) {
    body->is_opaque = true;
    for (uint32_t i = 0; i < body->is->group_count; i++) {
        const struct ir_weights *w = &lint_material(lint, body, i)->albedo;
        body->reflection = fmax(body->reflection, w->reflection);
        body->refraction = fmax(body->refraction, w->refraction);
        body->gain = fmax(body->gain, scene_gain(lint_material(lint, body, i)));
        body->is_opaque = body->is_opaque && !(w->refraction > 0);
    }
}

// ---- meshes

static struct lint_mesh *mesh_of(struct lint *lint, const struct lint_body *body) {
    const struct mesh *mesh = body->is->mesh;
    // Models of one mesh are usually next to each other.
    for (uint32_t i = lint->meshes.count; i > 0; i--)
        if (lint->meshes.items[i - 1]->mesh == mesh)
            return lint->meshes.items[i - 1];
    struct lint_mesh *added = ARENA_NEW(lint->arena, struct lint_mesh);
    added->mesh = mesh;
    added->first = body;
    added->facets_of = -1;
    added->tolerance = LINT_RESOLUTION * fmax(vec3_max_abs(mesh->lower), vec3_max_abs(mesh->upper));
    *ARENA_PUSH(lint->arena, &lint->meshes) = added;
    return added;
}

const struct lint_tree *lint_tree_of(struct lint *lint, struct lint_mesh *mesh) {
    if (!mesh->has_tree)
        lint_tree_build(&mesh->tree, mesh->mesh, lint->arena);
    mesh->has_tree = true;
    return &mesh->tree;
}

// ---- bodies

static void take_mesh(struct lint *lint, struct lint_body *body) {
    struct lint_mesh *mesh = body->mesh = mesh_of(lint, body);
    mesh->model_count++;
    if (body->is->smooth && !mesh->first_smooth)
        mesh->first_smooth = body;
    if (body->refraction > 0 && !mesh->first_refracting)
        mesh->first_refracting = body;
}

static void collect_body(struct lint *lint, struct lint_body *body, const struct scene_body *is) {
    *body = (struct lint_body){.is = is, .box = {is->lower, is->upper}};
    if (!shape_is_there(is))
        return;
    weigh(lint, body);
    if (is->mesh)
        take_mesh(lint, body);
}

uint32_t lint_flat_triangles(const struct lint_body *body, struct lint_triangle out[LINT_FLAT_TRIANGLES]) {
    if (body->is->mesh)
        return 0;
    for (uint32_t i = 0; i < body->is->triangle_count; i++)
        scene_corners(body->is, &body->is->object_to_world, i, out[i].p);
    return body->is->triangle_count;
}

int lint_winding(struct lint *lint, const struct lint_body *body, vec3 point) {
    const affine3 *map = &body->is->object_to_world;
    switch (body->is->shape) {
    case SCENE_SPHERE:
        return vec3_length(vec3_sub(point, map->offset)) < body->is->radius;
    case SCENE_PARALLELOGRAM:
        break;
    case SCENE_MESH:
        return !body->mesh ? 0
                           : lint_tree_winding(lint_tree_of(lint, body->mesh),
                                               affine3_apply(transform_inverse(*map), point));
    case SCENE_CONE: {
        const struct shape_cone cone = shape_cone_of(body->is);
        return shape_cone_distance(&cone, point) < 0;
    }
    }
    return 0;
}

void lint_collect(struct lint *lint) {
    const struct scene *scene = lint->scene;
    lint->body_count = scene->body_count;
    lint->bodies = ARENA_ARRAY(lint->arena, struct lint_body, scene->body_count);
    for (uint32_t i = 0; i < scene->body_count; i++)
        collect_body(lint, &lint->bodies[i], &scene->bodies[i]);
    lint->view_count = lint->ir->cameras.count ? lint->ir->cameras.count : 1;
    lint->views = ARENA_ARRAY(lint->arena, struct view, lint->view_count);
    const struct ir_image *image = lint->input->image;
    for (uint32_t i = 0; i < lint->view_count; i++)
        view_build(scene, i, image->width, image->height, lint->arena, NULL, &lint->views[i]);
}
