// Variants of a scene, made in memory: moved, scaled, seen from afar, of other materials.
#include "measure/extremes/extremes_parts.h"

#include <math.h>
#include <string.h>

static const double moves[] = {0, 1, 10, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
static const double scales[] = {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1, 10, 1e2, 1e3, 1e4, 1e5, 1e6};
static const double distances[] = {1, 10, 100, 1e3, 1e4, 1e5, 1e6};
static const double indices[] = {1, 1 + 1e-7, 1 + 1e-5, 1 + 1e-3, 1.1, 1.33, 1.5, 2.4, 4};
static const double exponents[] = {0, 0.5, 1, 10, 100, 1e3, 1e4, 1e5, 1e6};
static const double aspects[] = {1, 10, 100, 1e3, 1e4, 1e5, 1e6};
static const double heights[] = {0, 1e-9, 1e-7, 1e-5, 1e-3, 0.1};
static const double shifts[] = {0, 1e-3, 0.1, 0.37};
static const double gaps[] = {0.1, 1e-2, 1e-3, 1e-4, 1e-5};

#define VALUES(array)                                                                                        \
    { array, sizeof(array) / sizeof *(array) }
static const struct {
    const double *values;
    uint32_t count;
} axis_values[EXTREME_AXES] = {
    [EXTREME_MOVE] = VALUES(moves),         [EXTREME_SCALE] = VALUES(scales),
    [EXTREME_DISTANCE] = VALUES(distances), [EXTREME_INDEX] = VALUES(indices),
    [EXTREME_EXPONENT] = VALUES(exponents), [EXTREME_SLIVER] = VALUES(aspects),
    [EXTREME_LIGHT] = VALUES(heights),      [EXTREME_CAMERA] = VALUES(heights),
    [EXTREME_COPLANAR] = VALUES(shifts),    [EXTREME_GAP] = VALUES(gaps),
};

uint32_t extreme_values(enum extreme_axis axis, double *values) {
    memcpy(values, axis_values[axis].values, axis_values[axis].count * sizeof *values);
    return axis_values[axis].count;
}

// ---- copying

static void *copied(struct arena *arena, const void *items, size_t count, size_t size, size_t room) {
    void *copy = arena_alloc_array(arena, count + room, size);
    if (count)
        memcpy(copy, items, count * size);
    return copy;
}
#define COPY(v, list, room)                                                                                  \
    (v)->ir.list.items =                                                                                     \
        copied((v)->arena, (v)->ir.list.items, (v)->ir.list.count, sizeof *(v)->ir.list.items, room);        \
    (v)->ir.list.capacity = (v)->ir.list.count + (room)

enum {
    ROOM_BODIES = 2 // that a probe may add
};

static void turn(vec3 *a, vec3 *b, double angle) {
    const vec3 before = *a;
    *a = vec3_add(vec3_mul(before, cos(angle)), vec3_mul(*b, sin(angle)));
    *b = vec3_sub(vec3_mul(*b, cos(angle)), vec3_mul(before, sin(angle)));
}

// Turned by a part of a pixel: in a symmetric view, pixels lie exactly on edges and lines of a checker, where
// any rounding is right.
static void turn_a_little(struct view_camera *camera) {
    turn(&camera->forward, &camera->right, 1.3e-3 * camera->tan_half_fov);
    turn(&camera->forward, &camera->up, 1.7e-3 * camera->tan_half_fov);
    turn(&camera->right, &camera->up, 1.9e-3);
}

static void make_view(struct variant *v) {
    scene_build(&v->ir, &v->assets, v->arena, &v->scene);
    view_build(&v->scene, v->camera, (int32_t)v->width, (int32_t)v->height, v->arena, NULL, &v->view);
    turn_a_little(&v->view.camera);
}

void variant_copy(struct variant *v, struct arena *arena, const struct extremes_input *input) {
    *v = (struct variant){.arena = arena,
                          .ir = *input->scene->ir,
                          .assets = *input->scene->assets,
                          .camera = input->camera,
                          .width = input->width,
                          .height = input->height};
    COPY(v, cameras, 0);
    COPY(v, lights, 0);
    COPY(v, materials, 0);
    COPY(v, spheres, ROOM_BODIES);
    COPY(v, rectangles, ROOM_BODIES);
    COPY(v, models, ROOM_BODIES);
    // Behind the materials, a copy of each for models: their checkers do not grow with the scene.
    const uint32_t count = v->assets.material_count;
    v->assets.materials = copied(arena, v->assets.materials, count, sizeof *v->assets.materials, count);
    memcpy(v->assets.materials + count, v->assets.materials, count * sizeof *v->assets.materials);
    v->assets.material_count = 2 * count;
    v->assets.models =
        copied(arena, v->assets.models, v->assets.model_count, sizeof *v->assets.models, ROOM_BODIES);
    for (uint32_t i = 0; i < v->assets.model_count; i++) {
        struct assets_model *model = &v->assets.models[i];
        const uint32_t groups = model->mesh ? model->mesh->group_count : 0;
        model->group_material =
            copied(arena, model->group_material, groups, sizeof *model->group_material, 0);
        for (uint32_t k = 0; k < groups; k++)
            model->group_material[k] += count;
    }
    make_view(v);
}

// ---- moving and scaling: x becomes factor * x + offset

struct change {
    double factor;
    vec3 offset;
};

static vec3 changed(const struct change *c, vec3 p) {
    return vec3_add(vec3_mul(p, c->factor), c->offset);
}

static void change_bodies(struct variant *v, const struct change *c) {
    for (uint32_t i = 0; i < v->ir.spheres.count; i++) {
        struct ir_sphere *sphere = &v->ir.spheres.items[i];
        sphere->center = changed(c, sphere->center);
        sphere->radius *= c->factor;
    }
    for (uint32_t i = 0; i < v->ir.rectangles.count; i++) {
        struct ir_rectangle *r = &v->ir.rectangles.items[i];
        r->corner = changed(c, r->corner);
        r->edge_u = vec3_mul(r->edge_u, c->factor);
        r->edge_v = vec3_mul(r->edge_v, c->factor);
    }
    for (uint32_t i = 0; i < v->ir.models.count; i++) {
        struct ir_model *model = &v->ir.models.items[i];
        model->scale = vec3_mul(model->scale, c->factor);
        model->translation = changed(c, model->translation);
    }
}

static void change_all(struct variant *v, const struct change *c) {
    change_bodies(v, c);
    for (uint32_t i = 0; i < v->ir.cameras.count; i++) {
        struct ir_camera *camera = &v->ir.cameras.items[i];
        camera->position = changed(c, camera->position);
        camera->look_at = changed(c, camera->look_at);
    }
    for (uint32_t i = 0; i < v->ir.lights.count; i++) {
        struct ir_light *light = &v->ir.lights.items[i];
        light->position = changed(c, light->position);
        if (light->falloff == IR_FALLOFF_INVERSE_SQUARE)
            light->intensity *= c->factor * c->factor;
    }
    for (uint32_t i = 0; i < v->assets.material_count / 2; i++)
        v->assets.materials[i].diffuse_color.checker.size *= c->factor;
    make_view(v);
}

// ---- seen from afar, from a surface, lit from a surface

static void move_away(struct variant *v, const struct extreme_base *base, double times) {
    struct view_camera *camera = &v->view.camera;
    const double distance = vec3_length(vec3_sub(base->center, camera->position));
    const double from = fmax(distance, base->radius);
    camera->position = vec3_sub(camera->position, vec3_mul(camera->forward, from * (times - 1)));
    camera->tan_half_fov /= times;
}

static vec3 over_surface(const struct extreme_base *base, double height) {
    return vec3_add(base->surface, vec3_mul(base->normal, height * base->radius));
}

static void light_surface(struct variant *v, const struct extreme_base *base, double height) {
    struct view_light *light = &v->view.lights[0];
    light->directional = false;
    light->to_light = (vec3){0, 0, 0};
    light->position = over_surface(base, height);
    light->inverse_square = false;
    light->emission = (vec3){1, 1, 1};
}

// From the surface into the mirrored direction of the ray that found it.
static void stand_on_surface(struct variant *v, const struct extreme_base *base, double height) {
    struct view_camera *camera = &v->view.camera;
    camera->position = over_surface(base, height);
    const double along = vec3_dot(base->seen_along, base->normal);
    camera->forward = vec3_unit(vec3_sub(base->seen_along, vec3_mul(base->normal, 2 * along)));
    const vec3 up =
        fabs(vec3_dot(camera->forward, base->normal)) < 0.99 ? base->normal : (vec3){0.6, 0.48, 0.64};
    camera->right = vec3_unit(vec3_cross(camera->forward, up));
    camera->up = vec3_cross(camera->right, camera->forward);
}

// ---- materials

static bool set_indices(struct variant *v, double index) {
    bool any = false;
    for (uint32_t i = 0; i < v->assets.material_count; i++)
        if (v->assets.materials[i].albedo.refraction > 0) {
            v->assets.materials[i].refractive_index = index;
            any = true;
        }
    return any;
}

static bool set_exponents(struct variant *v, double exponent) {
    bool any = false;
    for (uint32_t i = 0; i < v->assets.material_count; i++)
        if (v->assets.materials[i].albedo.specular > 0) {
            v->assets.materials[i].specular_exponent = exponent;
            any = true;
        }
    return any;
}

// ---- all

static const char *change(struct variant *v, const struct extreme_base *base, enum extreme_axis axis,
                          double value) {
    switch (axis) {
    case EXTREME_MOVE:
        change_all(v, &(struct change){1, {value, -0.5 * value, 0.75 * value}});
        break;
    case EXTREME_SCALE:
        change_all(v, &(struct change){value, {0, 0, 0}});
        break;
    case EXTREME_DISTANCE:
        move_away(v, base, value);
        break;
    case EXTREME_INDEX:
        return set_indices(v, value) ? NULL : "no material refracts";
    case EXTREME_EXPONENT:
        return set_exponents(v, value) ? NULL : "no material has highlights";
    case EXTREME_SLIVER:
        probe_slivers(v, base, value);
        break;
    case EXTREME_LIGHT:
        light_surface(v, base, value);
        break;
    case EXTREME_CAMERA:
        stand_on_surface(v, base, value);
        break;
    case EXTREME_COPLANAR:
        probe_coplanar(v, base, value);
        break;
    case EXTREME_GAP:
        probe_gap(v, base, value);
        break;
    case EXTREME_AXES:
        break;
    }
    return NULL;
}

const char *variant_make(struct variant *v, struct arena *arena, const struct extreme_base *base,
                         enum extreme_axis axis, double value) {
    const bool on_surface = axis == EXTREME_LIGHT || axis == EXTREME_CAMERA;
    if (on_surface && !base->has_surface)
        return "the camera sees no surface that does not refract";
    variant_copy(v, arena, base->input);
    const char *left_out = change(v, base, axis, value);
    scene_build(&v->ir, &v->assets, arena, &v->scene);
    return left_out;
}
