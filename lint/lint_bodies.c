// Bodies, meshes and cameras as the rules need them.
#include "lint/lint_parts.h"

#include "grammar/ir.h"

// ---- materials

const struct ir_material *lint_material(const struct lint *lint, const struct lint_body *body,
                                        uint32_t group) {
    const struct ir_scene *scene = lint->scene;
    uint32_t index = 0;
    switch (body->kind) {
    case LINT_SPHERE:
        index = assets_material(scene, &scene->spheres.items[body->index].material);
        break;
    case LINT_RECTANGLE:
        index = assets_material(scene, &scene->rectangles.items[body->index].material);
        break;
    case LINT_MODEL:
        index = lint->assets->models[body->index].group_material[group];
        break;
    }
    return &lint->assets->materials[index];
}

uint32_t lint_group_count(const struct lint_body *body) {
    if (body->kind != LINT_MODEL)
        return 1;
    return body->mesh ? body->mesh->mesh->group_count : 0;
}

static void weigh(const struct lint *lint, struct lint_body *body) {
    body->is_opaque = true;
    for (uint32_t i = 0; i < lint_group_count(body); i++) {
        const struct ir_weights *w = &lint_material(lint, body, i)->albedo;
        body->reflection = fmax(body->reflection, w->reflection);
        body->refraction = fmax(body->refraction, w->refraction);
        body->gain = fmax(body->gain, w->reflection + w->refraction);
        body->is_opaque = body->is_opaque && !(w->refraction > 0);
    }
}

// ---- meshes

static struct lint_mesh *mesh_of(struct lint *lint, const struct mesh *mesh, uint32_t model) {
    // Models of one mesh mostly stand together.
    for (uint32_t i = lint->meshes.count; i > 0; i--)
        if (lint->meshes.items[i - 1]->mesh == mesh)
            return lint->meshes.items[i - 1];
    struct lint_mesh *added = ARENA_NEW(lint->arena, struct lint_mesh);
    added->mesh = mesh;
    added->first_model = model;
    added->first_smooth = added->first_refracting = IR_NO_INDEX;
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

// The inverse of T·R·S: columns of R·S are orthogonal, so that each row is a column over its square.
affine3 lint_inverse(affine3 a) {
    affine3 b;
    for (int i = 0; i < 3; i++) {
        vec3 column = {a.linear.m[0][i], a.linear.m[1][i], a.linear.m[2][i]};
        double length = vec3_length(column);
        b.linear.m[i][0] = column.x / length / length;
        b.linear.m[i][1] = column.y / length / length;
        b.linear.m[i][2] = column.z / length / length;
    }
    b.offset = vec3_neg(mat3_apply(b.linear, a.offset));
    return b;
}

affine3 lint_placing(const struct lint *lint, const struct lint_body *body) {
    return view_model_transform(&lint->scene->models.items[body->index]);
}

static void add_sphere(struct lint *lint, uint32_t i) {
    const struct ir_sphere *sphere = &lint->scene->spheres.items[i];
    struct lint_body *body = &lint->bodies[lint->body_count++];
    *body = (struct lint_body){.kind = LINT_SPHERE,
                               .index = i,
                               .head = &sphere->head,
                               .name = sphere->name,
                               .box = {sphere->center, sphere->center},
                               .is_solid = true};
    body->box = lint_box_grow(body->box, sphere->radius);
    weigh(lint, body);
}

static void add_rectangle(struct lint *lint, uint32_t i) {
    const struct ir_rectangle *r = &lint->scene->rectangles.items[i];
    struct lint_body *body = &lint->bodies[lint->body_count++];
    *body = (struct lint_body){.kind = LINT_RECTANGLE, .index = i, .head = &r->head, .name = r->name};
    struct lint_triangle halves[2];
    lint_rectangle(body, lint, halves);
    body->box = lint_box_join(lint_box_of(&halves[0]), lint_box_of(&halves[1]));
    weigh(lint, body);
}

static void add_model(struct lint *lint, uint32_t i) {
    const struct ir_model *model = &lint->scene->models.items[i];
    const struct mesh *mesh = i < lint->assets->model_count ? lint->assets->models[i].mesh : NULL;
    struct lint_body *body = &lint->bodies[lint->body_count++];
    *body = (struct lint_body){
        .kind = LINT_MODEL, .index = i, .head = &model->head, .name = model->name, .box = lint_box_empty()};
    if (!mesh)
        return;
    affine3 placing = view_model_transform(model);
    body->is_mirrored = mat3_determinant(placing.linear) < 0;
    body->box = lint_box_place((struct lint_box){mesh->lower, mesh->upper}, &placing);
    body->mesh = mesh_of(lint, mesh, i);
    body->is_solid = mesh->closed;
    weigh(lint, body);
    body->mesh->model_count++;
    if (model->smooth && body->mesh->first_smooth == IR_NO_INDEX)
        body->mesh->first_smooth = i;
    if (body->refraction > 0 && body->mesh->first_refracting == IR_NO_INDEX)
        body->mesh->first_refracting = i;
}

void lint_rectangle(const struct lint_body *body, const struct lint *lint, struct lint_triangle out[2]) {
    const struct ir_rectangle *r = &lint->scene->rectangles.items[body->index];
    vec3 u = vec3_add(r->corner, r->edge_u);
    vec3 v = vec3_add(r->corner, r->edge_v);
    vec3 far = vec3_add(u, r->edge_v);
    out[0] = (struct lint_triangle){{r->corner, u, far}};
    out[1] = (struct lint_triangle){{r->corner, far, v}};
}

int lint_winding(struct lint *lint, const struct lint_body *body, vec3 point) {
    if (body->kind == LINT_SPHERE) {
        const struct ir_sphere *sphere = &lint->scene->spheres.items[body->index];
        return vec3_length(vec3_sub(point, sphere->center)) < sphere->radius;
    }
    if (!body->mesh)
        return 0;
    affine3 back = lint_inverse(lint_placing(lint, body));
    return lint_tree_winding(lint_tree_of(lint, body->mesh), affine3_apply(back, point));
}

void lint_collect(struct lint *lint) {
    const struct ir_scene *scene = lint->scene;
    lint->bodies = ARENA_ARRAY(lint->arena, struct lint_body, ir_body_count(scene));
    for (uint32_t i = 0; i < scene->spheres.count; i++)
        add_sphere(lint, i);
    for (uint32_t i = 0; i < scene->rectangles.count; i++)
        add_rectangle(lint, i);
    for (uint32_t i = 0; i < scene->models.count; i++)
        add_model(lint, i);
    lint->view_count = scene->cameras.count ? scene->cameras.count : 1;
    lint->views = ARENA_ARRAY(lint->arena, struct view, lint->view_count);
    const struct ir_image *image = lint->input->image;
    for (uint32_t i = 0; i < lint->view_count; i++)
        view_build(scene, lint->assets, i, image->width, image->height, lint->arena, NULL, &lint->views[i]);
}
