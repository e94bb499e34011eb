// Variants of a scene, made in memory: moved, scaled, seen from afar, with other materials.
#include "measure/extremes/extremes_internal.h"

#include "grammar/ir_features.h"
#include "scene/shape.h"

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
static const double radii[] = {1e-9, 1e-2, 1, 100};
static const double angles[] = {1e-9, 0.53, 30, 180};
static const double apertures[] = {1e-9, 1e-3, 0.1, 1};
static const double focuses[] = {1e-3, 1, 1e6, 1e9};
static const double roughnesses[] = {1e-6, 1e-2, 0.3, 1};
static const double densities[] = {1e-9, 1, 1e3, 1e9};
static const double textures[] = {1e-9, 1e-6, 1e-3, 1, 1e3, 1e6};
static const double reaches[] = {1e-9, 1e-2, 1, 1e9};
static const double strengths[] = {1e-9, 1, 1e6};
static const double nests[] = {2, EXTREME_NESTED_MOST};
static const double errors[] = {1e-9, 0.01, 1};
static const double leasts[] = {4, 16};

#define VALUES(array)                                                                                        \
    { array, sizeof(array) / sizeof *(array) }
static const struct {
    const double *values;
    uint32_t count;
} axis_values[EXTREME_AXES] = {
    [EXTREME_MOVE] = VALUES(moves),
    [EXTREME_SCALE] = VALUES(scales),
    [EXTREME_DISTANCE] = VALUES(distances),
    [EXTREME_INDEX] = VALUES(indices),
    [EXTREME_EXPONENT] = VALUES(exponents),
    [EXTREME_SLIVER] = VALUES(aspects),
    [EXTREME_LIGHT] = VALUES(heights),
    [EXTREME_CAMERA] = VALUES(heights),
    [EXTREME_COPLANAR] = VALUES(shifts),
    [EXTREME_GAP] = VALUES(gaps),
    [EXTREME_LIGHT_RADIUS] = VALUES(radii),
    [EXTREME_LIGHT_ANGLE] = VALUES(angles),
    [EXTREME_APERTURE] = VALUES(apertures),
    [EXTREME_FOCUS] = VALUES(focuses),
    [EXTREME_ROUGHNESS] = VALUES(roughnesses),
    [EXTREME_DENSITY] = VALUES(densities),
    [EXTREME_TEXTURE] = VALUES(textures),
    [EXTREME_OCCLUSION] = VALUES(reaches),
    [EXTREME_EMISSION] = VALUES(strengths),
    [EXTREME_NESTED] = VALUES(nests),
    [EXTREME_ERROR_BOUND] = VALUES(errors),
    [EXTREME_MIN_SAMPLES] = VALUES(leasts),
};

uint32_t extreme_values(enum extreme_axis axis, double *values) {
    memcpy(values, axis_values[axis].values, axis_values[axis].count * sizeof *values);
    return axis_values[axis].count;
}

// The range in which an axis is at its end, and the limit's value.
static const struct {
    enum extreme_axis axis;
    double from, to, limit;
} limits[] = {
    {EXTREME_LIGHT_RADIUS, 0, 1e-9, 0}, {EXTREME_LIGHT_ANGLE, 0, 1e-9, 0},
    {EXTREME_APERTURE, 0, 1e-9, 0},     {EXTREME_FOCUS, 1e6, 1e9, 1e12},
    {EXTREME_ROUGHNESS, 0, 1e-6, 0},    {EXTREME_DENSITY, 0, 1e-9, 0},
    {EXTREME_TEXTURE, 0, 1e-6, 0},      {EXTREME_OCCLUSION, 0, 1e-9, 0},
    {EXTREME_EMISSION, 0, 1e-9, 0},     {EXTREME_NESTED, 2, EXTREME_NESTED_MOST, 1},
};

bool extreme_limit(enum extreme_axis axis, double value, double *limit) {
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++)
        if (limits[i].axis == axis && value >= limits[i].from && value <= limits[i].to) {
            *limit = limits[i].limit;
            return true;
        }
    return false;
}

// ---- copying

enum {
    ROOM_BODIES = EXTREME_NESTED_MOST // that a probe may add
};

static void *copied(struct arena *arena, const void *items, size_t count, size_t size, size_t room) {
    void *copy = arena_alloc_array(arena, count + room, size);
    if (count)
        memcpy(copy, items, count * size);
    return copy;
}

static void make_view(struct variant *v) {
    view_build(&v->scene, v->camera, (int32_t)v->width, (int32_t)v->height, v->arena, NULL, &v->view);
    view_turn_aside(&v->view.camera);
}

// After the materials follows a copy of each, for meshes: their checkers do not grow with the scene.
static void copy_materials(struct variant *v) {
    struct scene *scene = &v->scene;
    const uint32_t count = scene->material_count;
    const size_t size = sizeof *scene->materials;
    scene->materials = copied(v->arena, scene->materials, count, size, count);
    memcpy(scene->materials + count, scene->materials, count * size);
    scene->material_count = 2 * count;
    for (uint32_t i = 0; i < scene->body_count; i++) {
        struct scene_body *body = &scene->bodies[i];
        if (!body->mesh)
            continue;
        uint32_t *moved = copied(v->arena, body->materials, body->group_count, sizeof *moved, 0);
        for (uint32_t k = 0; k < body->group_count; k++)
            moved[k] += count;
        body->materials = moved;
    }
}

void variant_copy(struct variant *v, struct arena *arena, const struct extremes_input *input) {
    const struct scene *from = input->scene;
    const struct ir_cameras *cameras = &from->ir->cameras;
    const struct ir_lights *lights = &from->ir->lights;
    *v = (struct variant){.arena = arena,
                          .ir = *from->ir,
                          .scene = *from,
                          .camera = input->camera,
                          .width = input->width,
                          .height = input->height,
                          .samples = ir_features(from->ir) & FEATURE_POINTS ? SOFT_SAMPLES : 1};
    v->ir.cameras.items = copied(arena, cameras->items, cameras->count, sizeof *cameras->items, 0);
    v->ir.lights.items = copied(arena, lights->items, lights->count, sizeof *lights->items, 0);
    v->scene.ir = &v->ir;
    v->scene.bodies = copied(arena, from->bodies, from->body_count, sizeof *v->scene.bodies, ROOM_BODIES);
    copy_materials(v);
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
    for (uint32_t i = 0; i < v->scene.body_count; i++) {
        struct scene_body *body = &v->scene.bodies[i];
        affine3 map = body->object_to_world;
        map.offset = changed(c, map.offset);
        for (int k = 0; k < 9 && !shape_traits(body->shape).has_radius; k++)
            map.linear.m[k / 3][k % 3] *= c->factor;
        body->radius_to *= c->factor;
        body->height *= c->factor;
        scene_body_place(body, map, body->radius * c->factor);
    }
}

static void change_camera(struct ir_camera *camera, const struct change *c) {
    camera->position = changed(c, camera->position);
    camera->look_at = changed(c, camera->look_at);
    camera->size *= c->factor;
    camera->aperture *= c->factor;
    camera->focus *= c->factor;
    camera->focus_at = changed(c, camera->focus_at);
}

static void change_all(struct variant *v, const struct change *c) {
    for (uint32_t i = 0; i < v->ir.cameras.count; i++)
        change_camera(&v->ir.cameras.items[i], c);
    for (uint32_t i = 0; i < v->ir.lights.count; i++) {
        struct ir_light *light = &v->ir.lights.items[i];
        light->position = changed(c, light->position);
        light->radius *= c->factor;
        light->rectangle.corner = changed(c, light->rectangle.corner);
        light->rectangle.edge_u = vec3_mul(light->rectangle.edge_u, c->factor);
        light->rectangle.edge_v = vec3_mul(light->rectangle.edge_v, c->factor);
        if (light->falloff == IR_FALLOFF_INVERSE_SQUARE)
            light->intensity *= c->factor * c->factor;
    }
    for (uint32_t i = 0; i < v->scene.material_count / 2; i++)
        v->scene.materials[i].cell *= c->factor;
    for (uint32_t i = 0; i < v->scene.material_count; i++)
        v->scene.materials[i].absorption = vec3_mul(v->scene.materials[i].absorption, 1 / c->factor);
    v->scene.occlusion *= c->factor;
    change_bodies(v, c);
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

// Turns a panel so that it shines against `normal`: about the axis perpendicular to both directions, by
// Rodrigues' formula.
static void face_surface(struct view_light *light, vec3 normal) {
    const vec3 to = vec3_neg(normal), from = light->outward;
    vec3 axis = vec3_cross(from, to);
    const double sine = vec3_length(axis), cosine = vec3_dot(from, to);
    if (sine > 0)
        axis = vec3_mul(axis, 1 / sine);
    else
        axis = vec3_unit(light->edge_u); // it shines along the normal, or against it already
    vec3 *const edges[] = {&light->edge_u, &light->edge_v};
    for (int k = 0; k < 2; k++) {
        const vec3 e = *edges[k];
        *edges[k] = vec3_add(vec3_add(vec3_mul(e, cosine), vec3_mul(vec3_cross(axis, e), sine)),
                             vec3_mul(axis, vec3_dot(axis, e) * (1 - cosine)));
    }
    light->outward = to;
}

static void light_surface(struct variant *v, const struct extreme_base *base, double height) {
    struct view_light *light = &v->view.lights[0];
    light->directional = false;
    if (light->extent == VIEW_DISC)
        light->extent = VIEW_POINT; // a disc is in the sky
    if (light->extent == VIEW_PANEL)
        face_surface(light, base->normal);
    light->before_body = 0;
    light->to_light = (vec3){0, 0, 0};
    light->position = over_surface(base, height);
    light->inverse_square = false;
    light->emission = (vec3){1, 1, 1};
    view_light_shine(light, v->view.camera.position);
}

// Looks from the surface in the mirrored direction of the ray that found it.
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
    for (uint32_t i = 0; i < v->scene.material_count; i++)
        if (v->scene.materials[i].refraction > 0) {
            v->scene.materials[i].refractive_index = index;
            any = true;
        }
    return any;
}

static bool set_exponents(struct variant *v, double exponent) {
    bool any = false;
    for (uint32_t i = 0; i < v->scene.material_count; i++)
        if (v->scene.materials[i].specular_weight > 0) {
            v->scene.materials[i].specular_exponent = exponent;
            any = true;
        }
    return any;
}

// ---- the background alone

bool variant_bounces(const struct variant *v) {
    for (uint32_t i = 0; i < v->scene.material_count; i++)
        if (v->scene.materials[i].reflection > 0 || v->scene.materials[i].refraction > 0)
            return true;
    return false;
}

void variant_show_background(struct variant *v) {
    v->scene.background = (struct scene_background){.color = {1, 1, 1}, .intensity = 1, .cosine = 1};
    v->ir.background.kind = IR_BACKDROP_COLOR;
    v->ir.trace.depth_limit = IR_DEPTH_BLACK;
    v->view.light_count = 0;
}

// ---- all

const char *variant_make(struct variant *v, struct arena *arena, const struct extreme_base *base,
                         enum extreme_axis axis, double value) {
    const bool on_surface = axis == EXTREME_LIGHT || axis == EXTREME_CAMERA;
    if (on_surface && !base->has_surface)
        return "the camera sees no surface that does not refract";
    variant_copy(v, arena, base->input);
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
    default:
        return variant_change_light(v, base, axis, value);
    }
    return NULL;
}
