// From the IR to bodies and materials with everything resolved.
#include "reference/parts.h"

#include "grammar/ir.h"

// Cofactors are the inverse transpose times the determinant, whose sign is taken back.
static mat3 normal_map(const mat3 *a, bool mirrors) {
    mat3 out;
    for (int i = 0; i < 3; i++) {
        const double *p = a->m[(i + 1) % 3];
        const double *q = a->m[(i + 2) % 3];
        for (int k = 0; k < 3; k++) {
            double minor = p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3];
            out.m[i][k] = mirrors ? -minor : minor;
        }
    }
    return out;
}

// ---- materials

static struct finish make_finish(const struct ir_material *material, unsigned transfer) {
    const struct ir_paint *paint = &material->diffuse_color;
    const struct ir_weights *albedo = &material->albedo;
    struct finish f = {.checker = paint->kind == IR_PAINT_CHECKER,
                       .exponent = material->specular_exponent,
                       .reflection = albedo->reflection,
                       .refraction = albedo->refraction,
                       .index = material->refractive_index};
    f.cell = f.checker ? paint->checker.size : 1;
    for (int i = 0; i < 2; i++)
        f.diffuse[i] =
            vec3_mul(view_linear_color(f.checker ? paint->checker.colors[i] : paint->color, transfer),
                     albedo->diffuse);
    f.specular = vec3_mul(view_linear_color(material->specular_color, transfer), albedo->specular);
    return f;
}

// ---- bodies

static void make_rectangle(const struct reference *r, const struct ir_rectangle *ir, struct body *body) {
    *body = (struct body){.kind = BODY_RECTANGLE,
                          .primitive_count = 2,
                          .material = assets_material(r->input.scene, &ir->material),
                          .corner = vec3_sub(ir->corner, r->origin),
                          .edge_u = ir->edge_u,
                          .edge_v = ir->edge_v};
}

// The origin is taken off before any vertex is placed.
static void make_model(const struct reference *r, uint32_t model, struct body *body) {
    const struct assets_model *asset = &r->input.assets->models[model];
    *body = (struct body){.kind = BODY_MODEL, .mesh = asset->mesh, .group_material = asset->group_material};
    body->place = view_model_transform(&r->input.scene->models.items[model]);
    body->place.offset = vec3_sub(body->place.offset, r->origin);
    body->mirrors = mat3_determinant(body->place.linear) < 0;
    body->normal_map = normal_map(&body->place.linear, body->mirrors);
    if (!asset->mesh)
        return;
    body->primitive_count = asset->mesh->triangle_count;
    body->solid = asset->mesh->closed;
}

// Models that show one mesh share its normals.
static void make_normals(struct reference *r, uint32_t model, uint32_t first_model) {
    const struct ir_models *models = &r->input.scene->models;
    struct body *body = &r->bodies[first_model + model];
    if (!models->items[model].smooth || !body->mesh)
        return;
    for (uint32_t i = 0; i < model && !body->normals; i++)
        if (r->bodies[first_model + i].mesh == body->mesh)
            body->normals = r->bodies[first_model + i].normals;
    if (!body->normals)
        body->normals = mesh_smooth_normals(body->mesh, &r->arena);
}

void reference_make_bodies(struct reference *r) {
    const struct ir_scene *scene = r->input.scene;
    const struct assets *assets = r->input.assets;
    r->body_count = ir_body_count(scene);
    r->sphere_count = scene->spheres.count;
    r->bodies = ARENA_ARRAY(&r->arena, struct body, r->body_count);
    struct body *body = r->bodies;
    for (uint32_t i = 0; i < scene->spheres.count; i++)
        *body++ = (struct body){.kind = BODY_SPHERE,
                                .primitive_count = 1,
                                .solid = true,
                                .material = assets_material(scene, &scene->spheres.items[i].material)};
    for (uint32_t i = 0; i < scene->rectangles.count; i++)
        make_rectangle(r, &scene->rectangles.items[i], body++);
    uint32_t first_model = (uint32_t)(body - r->bodies);
    for (uint32_t i = 0; i < scene->models.count; i++) {
        make_model(r, i, body++);
        make_normals(r, i, first_model);
    }
    uint32_t count = 0;
    for (uint32_t i = 0; i < r->body_count; i++) {
        r->bodies[i].first_primitive = count;
        count += r->bodies[i].primitive_count;
    }
    r->primitive_count = count;
    r->finishes = ARENA_ARRAY(&r->arena, struct finish, assets->material_count);
    for (uint32_t i = 0; i < assets->material_count; i++)
        r->finishes[i] = make_finish(&assets->materials[i], scene->image.transfer);
}

// ---- primitives

static void put(double out[3], vec3 v) {
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

// Shared corners are computed once, so that both halves hold the same bits.
static void rectangle_half(const struct body *body, uint32_t half, struct primitive *out) {
    vec3 along_u = vec3_add(body->corner, body->edge_u);
    vec3 along_v = vec3_add(body->corner, body->edge_v);
    put(out->v[0], body->corner);
    put(out->v[1], half ? vec3_add(along_u, body->edge_v) : along_u);
    put(out->v[2], half ? along_v : vec3_add(along_u, body->edge_v));
}

bool reference_make_primitive(const struct reference *r, const struct body *body, uint32_t triangle,
                              struct primitive *out) {
    out->body = (uint32_t)(body - r->bodies);
    out->triangle = triangle;
    if (body->kind == BODY_SPHERE) {
        const struct ir_sphere *sphere = &r->input.scene->spheres.items[out->body];
        put(out->v[0], vec3_sub(sphere->center, r->origin));
        put(out->v[1], (vec3){sphere->radius, 0, 0});
        put(out->v[2], (vec3){0, 0, 0});
        return true;
    }
    if (body->kind == BODY_RECTANGLE)
        rectangle_half(body, triangle, out);
    else
        for (int k = 0; k < 3; k++)
            put(out->v[k], affine3_apply(body->place,
                                         body->mesh->positions[body->mesh->triangles[triangle].corners[k]]));
    vec3 u = {out->v[1][0] - out->v[0][0], out->v[1][1] - out->v[0][1], out->v[1][2] - out->v[0][2]};
    vec3 v = {out->v[2][0] - out->v[0][0], out->v[2][1] - out->v[0][1], out->v[2][2] - out->v[0][2]};
    return !vec3_is_zero(vec3_cross(u, v));
}
