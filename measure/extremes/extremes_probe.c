// Shapes that extremes puts in the scene's place: a disc of slivers, two plates in the same plane, two with a
// gap.
#include "measure/extremes/extremes_internal.h"

#include <math.h>
#include <string.h>

enum {
    SECTORS_MAX = 1024, // of the disc: two triangles each
    SECTORS_LEAST = 8,
};
#define TWO_PI 6.28318530717958647692

// A frame that no axis of the scene is parallel to, facing the camera: the probe's own right, up and normal.
struct pose {
    vec3 center, right, up, normal;
    double size;
};

// In front of the camera, large enough to fill half of the view's height, and tilted a little.
static struct pose before_camera(const struct variant *v, const struct extreme_base *base) {
    const struct view_camera *camera = &v->view.camera;
    const double far = fmax(vec3_length(vec3_sub(base->center, camera->position)), base->radius);
    const double distance = 0.25 * far;
    struct pose pose = {.size = 0.5 * distance * camera->tan_half_fov};
    pose.center = vec3_add(camera->position, vec3_mul(camera->forward, distance));
    const vec3 leaning = vec3_add(vec3_neg(camera->forward),
                                  vec3_add(vec3_mul(camera->right, 0.31), vec3_mul(camera->up, 0.23)));
    pose.normal = vec3_unit(leaning);
    pose.right = vec3_unit(vec3_cross(camera->up, pose.normal));
    pose.up = vec3_cross(pose.normal, pose.right);
    return pose;
}

static vec3 on_pose(const struct pose *pose, double x, double y) {
    const vec3 across = vec3_mul(pose->right, x * pose->size), along = vec3_mul(pose->up, y * pose->size);
    return vec3_add(pose->center, vec3_add(across, along));
}

// ---- slivers

// Around the rim alternate a needle of the aspect and the rest of the sector.
static struct mesh *make_disc(struct arena *arena, const struct pose *pose, double aspect) {
    const double wanted = ceil(TWO_PI * aspect);
    const uint32_t sectors = wanted < SECTORS_LEAST ? SECTORS_LEAST
                             : wanted > SECTORS_MAX ? SECTORS_MAX
                                                    : (uint32_t)wanted;
    const double sector = TWO_PI / sectors, needle = fmin(1 / aspect, 0.5 * sector);
    struct mesh *mesh = ARENA_NEW(arena, struct mesh);
    mesh->path = STR("a disc of slivers");
    mesh->position_count = 2 * sectors + 1;
    mesh->triangle_count = 2 * sectors;
    mesh->positions = ARENA_ARRAY(arena, vec3, mesh->position_count);
    mesh->merged = ARENA_ARRAY(arena, uint32_t, mesh->position_count);
    mesh->triangles = ARENA_ARRAY(arena, struct mesh_triangle, mesh->triangle_count);
    mesh->groups = ARENA_NEW(arena, struct mesh_group);
    mesh->group_count = 1;
    mesh->positions[2 * sectors] = pose->center;
    for (uint32_t i = 0; i < 2 * sectors; i++) {
        const double angle = sector * (i / 2) + (i % 2 ? needle : 0);
        mesh->positions[i] = on_pose(pose, cos(angle), sin(angle));
        mesh->triangles[i] = (struct mesh_triangle){.corners = {2 * sectors, i, (i + 1) % (2 * sectors)},
                                                    .normals = {IR_NO_INDEX, IR_NO_INDEX, IR_NO_INDEX},
                                                    .line = i + 1};
    }
    for (uint32_t i = 0; i < mesh->position_count; i++)
        mesh->merged[i] = i;
    mesh->face_count = mesh->triangle_count;
    mesh->lower = mesh->upper = pose->center;
    for (uint32_t i = 0; i < mesh->position_count; i++) {
        mesh->lower = vec3_min(mesh->lower, mesh->positions[i]);
        mesh->upper = vec3_max(mesh->upper, mesh->positions[i]);
    }
    return mesh;
}

// With the default material. The variant was made with room for it.
static struct scene_body *add_body(struct variant *v, enum scene_shape shape) {
    uint32_t *material = ARENA_ARRAY(v->arena, uint32_t, 1);
    *material = v->ir.materials.count;
    struct scene_body *body = &v->scene.bodies[v->scene.body_count++];
    *body = (struct scene_body){.head = &v->ir.head, .shape = shape, .materials = material, .group_count = 1};
    return body;
}

void probe_slivers(struct variant *v, const struct extreme_base *base, double aspect) {
    static const affine3 in_place = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}};
    const struct pose pose = before_camera(v, base);
    struct scene_body *body = add_body(v, SCENE_MESH);
    body->mesh = make_disc(v->arena, &pose, aspect);
    body->triangle_count = body->mesh->triangle_count;
    scene_body_place(body, in_place, 0);
}

// ---- plates

static void add_plate(struct variant *v, vec3 corner, vec3 edge_u, vec3 edge_v) {
    struct scene_body *body = add_body(v, SCENE_PARALLELOGRAM);
    body->triangle_count = 2;
    scene_body_place(body, scene_parallelogram(corner, edge_u, edge_v), 0);
}

void probe_coplanar(struct variant *v, const struct extreme_base *base, double shift) {
    const struct pose pose = before_camera(v, base);
    for (int plate = 0; plate < 2; plate++) {
        const double moved = plate * 2 * shift;
        add_plate(v, on_pose(&pose, -1 + moved, -1 + 0.7 * moved), vec3_mul(pose.right, 2 * pose.size),
                  vec3_mul(pose.up, 2 * pose.size));
    }
}

// Alone in the scene's place: the camera in the middle between the plates, a light between them in front of
// it, and one above them that must not be seen.
void probe_gap(struct variant *v, const struct extreme_base *base, double gap) {
    struct view_camera *camera = &v->view.camera;
    const double size = 2 * base->radius;
    v->scene.body_count = 0;
    v->scene.background.lights = false;
    struct pose pose = {.center = base->center, .size = base->radius};
    pose.normal = vec3_unit((vec3){0.31, 0.87, 0.23});
    pose.right = vec3_unit(vec3_cross(pose.normal, (vec3){0.2, 0.1, 0.97}));
    pose.up = vec3_cross(pose.normal, pose.right);
    for (int plate = 0; plate < 2; plate++) {
        const vec3 off = vec3_mul(pose.normal, (plate ? 0.5 : -0.5) * gap * size);
        add_plate(v, vec3_add(on_pose(&pose, -1, -1), off), vec3_mul(pose.right, size),
                  vec3_mul(pose.up, size));
    }
    camera->position = base->center;
    camera->forward = vec3_unit(vec3_add(pose.right, vec3_mul(pose.up, 0.3)));
    camera->up = pose.normal;
    camera->right = vec3_unit(vec3_cross(camera->forward, camera->up));
    camera->tan_half_fov = 0.6;
    v->view.lights = ARENA_ARRAY(v->arena, struct view_light, 2);
    v->view.light_count = 2;
    const vec3 ahead = vec3_mul(camera->forward, 0.4 * size);
    const vec3 above = vec3_mul(pose.normal, size);
    v->view.lights[0] = (struct view_light){
        .position = vec3_add(base->center, ahead), .emission = {1, 1, 1}, .index = IR_NO_INDEX};
    v->view.lights[1] = (struct view_light){.position = vec3_add(base->center, vec3_add(ahead, above)),
                                            .emission = {1, 1, 1},
                                            .index = IR_NO_INDEX};
}

// ---- balls

// Inserted after the existing spheres: tracers number spheres first, as the IR does.
static struct scene_body *add_ball(struct variant *v, const uint32_t *material) {
    struct scene_body *bodies = v->scene.bodies;
    uint32_t at = 0;
    while (at < v->scene.body_count && bodies[at].shape == SCENE_SPHERE)
        at++;
    memmove(bodies + at + 1, bodies + at, (v->scene.body_count - at) * sizeof *bodies);
    v->scene.body_count++;
    bodies[at] = (struct scene_body){
        .head = &v->ir.head, .shape = SCENE_SPHERE, .closed = true, .materials = material, .group_count = 1};
    return &bodies[at];
}

bool probe_nested(struct variant *v, const struct extreme_base *base, uint32_t balls) {
    uint32_t glass = 0;
    while (glass < v->scene.material_count && !(v->scene.materials[glass].refraction > 0))
        glass++;
    if (glass == v->scene.material_count)
        return false;
    const struct pose pose = before_camera(v, base);
    const affine3 place = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, pose.center};
    uint32_t *material = ARENA_ARRAY(v->arena, uint32_t, 1);
    *material = glass;
    for (uint32_t i = 0; i < balls; i++)
        scene_body_place(add_ball(v, material), place, pose.size * (1 - (double)i / EXTREME_NESTED_MOST));
    return true;
}
