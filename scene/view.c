#include "scene/view.h"
#include "diag/codes/rule.h"

#include "core/angle.h"
#include "grammar/ir.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"
#include "scene/shape.h"
#include "scene/transform.h"
#include <stdlib.h>
#include <string.h>

// ---- the camera

// Right and up vectors for a view direction. An up along the view was rejected where it was written; the
// default up is replaced by +z where the view points up, -z where it points down.
static void orient(struct view_camera *camera, vec3 forward, vec3 up) {
    vec3 right = vec3_cross(forward, vec3_unit(up));
    if (!(vec3_length(right) >= 1e-9))
        right = vec3_cross(forward, (vec3){0, 0, forward.y > 0 ? 1 : -1});
    // A view along z, with an up along z that a diagnostic has already rejected.
    if (!(vec3_length(right) >= 1e-9))
        right = vec3_cross(forward, (vec3){0, 1, 0});
    camera->forward = forward;
    camera->right = vec3_unit(right);
    camera->up = vec3_cross(camera->right, forward);
}

static double tan_half(double degrees) {
    return degrees == 90 ? 1 : tan(degrees / 2 * RADIANS);
}

// For a field that a perspective view can have: one that shows about as much as the other projection does.
static double alike_tan(const struct ir_camera *ir) {
    if (ir->projection == IR_PROJECTION_PERSPECTIVE)
        return tan_half(ir->fov);
    return ir->projection == IR_PROJECTION_FISHEYE ? tan_half(fmin(ir->fov, 90)) : 1;
}

static struct view_camera turned_camera(const struct ir_camera *ir) {
    struct view_camera camera = {.name = ir->name,
                                 .position = ir->position,
                                 .tan_half_fov = alike_tan(ir),
                                 .projection = ir->projection,
                                 .half_height = ir->size / 2,
                                 .half_field = ir->fov / 2 * RADIANS};
    if (ir->view == IR_VIEW_ROTATION) {
        mat3 turn = mat3_rotation(ir->rotation);
        camera.right = mat3_column(turn, 0);
        camera.up = mat3_column(turn, 1);
        camera.forward = vec3_add(vec3_neg(mat3_column(turn, 2)), (vec3){0, 0, 0});
        return camera;
    }
    vec3 along = ir->view == IR_VIEW_LOOK_AT ? vec3_sub(ir->look_at, ir->position) : ir->direction;
    // A view without a direction has its diagnostic; the picture looks along -z.
    orient(&camera, vec3_is_zero(along) ? (vec3){0, 0, -1} : vec3_unit(along), ir->up);
    return camera;
}

static bool looks_all_round(const struct view_camera *camera) {
    return camera->projection == IR_PROJECTION_FISHEYE || camera->projection == IR_PROJECTION_PANORAMA;
}

// The position, where the body is missing or its mesh is not loaded: a diagnostic says so.
static vec3 focus_point(const struct scene *scene, const struct ir_camera *ir) {
    if (ir->focusing == IR_FOCUS_POINT)
        return ir->focus_at;
    if (ir->focusing != IR_FOCUS_BODY)
        return ir->look_at;
    for (uint32_t i = 0; i < scene->body_count; i++) {
        const struct scene_body *body = &scene->bodies[i];
        if (str_equal(body->name, ir->focus_on) && shape_is_there(body))
            return shape_middle(body);
    }
    vec3 lower, upper;
    if (scene_instance_bounds(scene, ir->focus_on, &lower, &upper))
        return vec3_mul(vec3_add(lower, upper), 0.5);
    return ir->position;
}

// 1 where a diagnostic has rejected what is written.
static double focus_of(const struct scene *scene, const struct ir_camera *ir,
                       const struct view_camera *camera) {
    double focus = ir->focus;
    if (ir->focusing != IR_FOCUS_DISTANCE || !(focus > 0)) {
        const vec3 way = vec3_sub(focus_point(scene, ir), ir->position);
        focus = looks_all_round(camera) ? vec3_length(way) : vec3_dot(way, camera->forward);
    }
    return focus > 0 ? focus : 1;
}

static struct view_camera written_camera(const struct scene *scene, const struct ir_camera *ir) {
    struct view_camera camera = turned_camera(ir);
    camera.lens_radius = ir->aperture / 2;
    if (camera.lens_radius > 0)
        camera.focus = focus_of(scene, ir, &camera);
    return camera;
}

// All bodies in view: the sphere around their box touches the narrower field.
static struct view_camera automatic_camera(const struct scene *scene, int32_t width, int32_t height) {
    struct view_camera camera = {.name = STR("main"), .tan_half_fov = tan_half(60), .automatic = true};
    orient(&camera, (vec3){0, 0, -1}, (vec3){0, 1, 0});
    vec3 lower, upper;
    if (!scene_bounds(scene, &lower, &upper))
        return camera;
    vec3 half = vec3_mul(vec3_sub(upper, lower), 0.5);
    double aspect = (double)width / height;
    double half_field = atan(camera.tan_half_fov * fmin(1, aspect));
    camera.position = vec3_add(lower, half);
    camera.position.z += vec3_length(half) / sin(half_field);
    return camera;
}

// ---- lights

// A float has room for it; an edge that is narrower is as sharp.
#define RATE_MOST 1e30

static void put_extent(struct view_light *light, const struct ir_light *ir) {
    const struct ir_panel *panel = &ir->rectangle;
    if (ir->kind == IR_LIGHT_RECTANGLE) {
        light->extent = VIEW_PANEL;
        light->edge_u = panel->edge_u;
        light->edge_v = panel->edge_v;
        light->outward = vec3_unit(vec3_cross(vec3_unit(panel->edge_u), vec3_unit(panel->edge_v)));
        light->position = vec3_add(panel->corner, vec3_mul(vec3_add(panel->edge_u, panel->edge_v), 0.5));
    } else if (ir->kind == IR_LIGHT_POSITION && ir->radius > 0) {
        light->extent = VIEW_SPHERE;
        light->radius = ir->radius;
    } else if (ir->kind == IR_LIGHT_DIRECTION && ir->angle > 0) {
        light->extent = VIEW_DISC;
        light->half_angle = ir->angle / 2 * RADIANS;
    }
}

// 1 - the cosine of an angle.
static double versine(double angle) {
    return 2 * sin(angle / 2) * sin(angle / 2);
}

// The square of a ramp between two cosines, as in KHR_lights_punctual.
static void put_spot(struct view_light *light, const struct ir_light *ir) {
    const struct ir_spot *spot = &ir->spot;
    const uint32_t row = (uint32_t)schema_find_row(&SCHEMA_LIGHT, STR("spot"));
    light->spot = ir->kind == IR_LIGHT_POSITION && ir_walk_written(&SCHEMA_LIGHT, row, ir);
    if (!light->spot)
        return;
    const double edge = spot->angle / 2 * RADIANS;
    light->axis = spot->aim == IR_AIM_DIRECTION ? spot->direction : vec3_sub(spot->look_at, ir->position);
    light->axis = vec3_unit(light->axis);
    light->open = versine(edge);
    light->rate = fmin(1 / (light->open - versine(edge * (1 - spot->softness))), RATE_MOST);
}

// The radiance that gives this emission on a surface facing the light, over pi (docs/language.md, "Lights
// that are seen").
void view_light_shine(struct view_light *light, vec3 place) {
    const double distance = light->inverse_square ? 1 : vec3_length(vec3_sub(light->position, place));
    double over = 1; // solid angle over pi, at that distance; for a disc weighted by the cosine
    if (light->extent == VIEW_DISC)
        over = sin(light->half_angle) * sin(light->half_angle);
    else if (light->extent == VIEW_SPHERE)
        over = pow(light->radius / fmax(distance, light->inverse_square ? 0 : light->radius), 2);
    else if (light->extent == VIEW_PANEL)
        over = vec3_length(vec3_cross(light->edge_u, light->edge_v)) / (PI * distance * distance);
    light->radiance = vec3_mul(light->emission, 1 / over);
}

// From the object of an instance to the world.
static void take_place(struct view_light *light, const affine3 *place) {
    if (light->directional) {
        light->to_light = vec3_unit(mat3_apply(place->linear, light->to_light));
        return;
    }
    light->position = affine3_apply(*place, light->position);
    light->axis = vec3_unit(mat3_apply(place->linear, light->axis));
    light->radius *= vec3_length(mat3_column(place->linear, 0));
    if (light->extent != VIEW_PANEL)
        return;
    const double sign = mat3_determinant(place->linear) < 0 ? -1 : 1;
    light->edge_u = mat3_apply(place->linear, light->edge_u);
    light->edge_v = mat3_apply(place->linear, light->edge_v);
    light->outward =
        vec3_mul(vec3_unit(vec3_cross(vec3_unit(light->edge_u), vec3_unit(light->edge_v))), sign);
}

static struct view_light written_light(const struct ir_light *ir, uint32_t index, unsigned transfer) {
    struct view_light light = {.index = index,
                               .emission = vec3_mul(scene_linear_color(ir->color, transfer), ir->intensity)};
    light.directional = ir->kind == IR_LIGHT_DIRECTION;
    if (light.directional)
        light.to_light = vec3_unit(vec3_neg(ir->direction));
    else
        light.position = ir->position;
    light.inverse_square = !light.directional && ir->falloff == IR_FALLOFF_INVERSE_SQUARE;
    put_extent(&light, ir);
    put_spot(&light, ir);
    light.seen = ir->visible;
    return light;
}

// ---- lights that bodies show

// Lights with a place and an extent, in the order of their places.
static int compare_places(const void *a, const void *b) {
    const struct view_light *const *first = a, *const *second = b;
    const vec3 p = (*first)->position, q = (*second)->position;
    if (p.x != q.x)
        return p.x < q.x ? -1 : 1;
    if (p.y != q.y)
        return p.y < q.y ? -1 : 1;
    return (p.z > q.z) - (p.z < q.z);
}

static bool is_equal(vec3 a, vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

// Whether both are made by the same edges, in either order and direction.
static bool are_edges(const struct view_light *light, vec3 u, vec3 v) {
    const vec3 a = light->edge_u, b = light->edge_v;
    const bool is_u = is_equal(u, a) || is_equal(u, vec3_neg(a));
    const bool is_v = is_equal(v, b) || is_equal(v, vec3_neg(b));
    const bool is_turned =
        (is_equal(u, b) || is_equal(u, vec3_neg(b))) && (is_equal(v, a) || is_equal(v, vec3_neg(a)));
    return (is_u && is_v) || is_turned;
}

static bool is_surface(const struct scene_body *body, const struct view_light *light) {
    const mat3 *edges = &body->object_to_world.linear;
    switch (body->shape) {
    case SCENE_SPHERE:
        return light->extent == VIEW_SPHERE && light->radius == body->radius;
    case SCENE_PARALLELOGRAM:
        return light->extent == VIEW_PANEL &&
               are_edges(light, mat3_column(*edges, 0), mat3_column(*edges, 1));
    case SCENE_MESH: // no light is one
    case SCENE_CONE:
        break;
    }
    return false;
}

// 2^-19 of the coordinates: some ten units in the last place of their single precision.
static double before_body(const struct view_light *light, vec3 origin) {
    const double reach = light->radius + vec3_max_abs(light->edge_u) + vec3_max_abs(light->edge_v);
    return 0x1p-19 * (vec3_max_abs(vec3_sub(light->position, origin)) + reach);
}

// Finds each light that has the body's surface, among `count` lights with a place and an extent, sorted by
// place.
static void take_body(const struct scene_body *body, struct view_light **lights, uint32_t count,
                      vec3 origin) {
    struct view_light at = {.position = shape_middle(body)};
    const struct view_light *key = &at;
    uint32_t low = 0, high = count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (compare_places(&lights[middle], &key) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < count && compare_places(&lights[low], &key) == 0; low++)
        if (is_surface(body, lights[low]))
            lights[low]->before_body = before_body(lights[low], origin);
}

// The first camera's position: flattening subtracts it from all positions.
static vec3 origin_of(const struct scene *scene, const struct view *view) {
    return scene->ir->cameras.count ? scene->ir->cameras.items[0].position : view->camera.position;
}

static void find_bodies(const struct scene *scene, struct arena *arena, struct view *out) {
    uint32_t count = 0;
    struct view_light **lights = ARENA_ARRAY(arena, struct view_light *, out->light_count);
    for (uint32_t i = 0; i < out->light_count; i++)
        if (out->lights[i].extent == VIEW_SPHERE || out->lights[i].extent == VIEW_PANEL)
            lights[count++] = &out->lights[i];
    if (count == 0)
        return;
    qsort(lights, count, sizeof *lights, compare_places);
    const vec3 origin = origin_of(scene, out);
    for (uint32_t i = 0; i < scene->body_count; i++)
        if (!shape_traits(scene->bodies[i].shape).needs_mesh)
            take_body(&scene->bodies[i], lights, count, origin);
}

static span whole_place(const struct scene *scene) {
    const struct ir_origin *origin = scene->assets->origin;
    return origin ? ir_place_label(origin, &scene->ir->head) : SPAN_NONE;
}

// A scene without lights has one at the camera, unless there is ambient light or the background lights.
static void build_lights(const struct scene *scene, struct arena *arena, struct view *out) {
    const struct ir_scene *ir = scene->ir;
    const uint32_t count = ir->lights.count;
    const bool automatic = count == 0 && vec3_is_zero(scene->ambient) && !scene->background.lights;
    out->light_count = automatic ? 1 : count;
    out->lights = ARENA_ARRAY(arena, struct view_light, out->light_count);
    for (uint32_t i = 0; i < count; i++) {
        const affine3 *place = scene_place(scene, &SCHEMA_LIGHT, i);
        out->lights[i] = written_light(&ir->lights.items[i], i, ir->image.transfer);
        if (place)
            take_place(&out->lights[i], place);
    }
    if (automatic)
        out->lights[0] = (struct view_light){
            .position = out->camera.position, .emission = {1, 1, 1}, .automatic = true, .index = IR_NO_INDEX};
}

void view_build(const struct scene *scene, uint32_t camera_index, int32_t width, int32_t height,
                struct arena *arena, struct diag_sink *sink, struct view *out) {
    const struct ir_cameras *cameras = &scene->ir->cameras;
    *out = (struct view){0};
    out->camera = cameras->count ? written_camera(scene, &cameras->items[camera_index])
                                 : automatic_camera(scene, width, height);
    build_lights(scene, arena, out);
    find_bodies(scene, arena, out);
    for (uint32_t i = 0; i < out->light_count; i++)
        if (view_light_is_seen(&out->lights[i]))
            view_light_shine(&out->lights[i], origin_of(scene, out));
    vec3 p = out->camera.position;
    if (sink && out->camera.automatic)
        diag_add(sink, DIAG_DEFAULT_CAMERA, whole_place(scene),
                 "the scene has no camera; one at %.6g %.6g %.6g looks along -z", p.x, p.y, p.z);
    if (sink && out->light_count && out->lights[0].automatic)
        diag_add(sink, DIAG_DEFAULT_LIGHT, whole_place(scene),
                 "the scene has no light; one shines from the camera");
}

void view_sample_offset(uint32_t n, double *a, double *b) {
    const double ratio = 1.32471795724474602596; // the plastic number
    double x = 0.5 + n / ratio;
    double y = 0.5 + n / (ratio * ratio);
    // Rounded to what devices store.
    *a = (double)(float)(x - floor(x));
    *b = (double)(float)(y - floor(y));
}

struct view_ray view_ray_at(const struct view_camera *camera, double aspect, double x, double y) {
    const vec3 f = camera->forward, s = camera->right, u = camera->up;
    struct view_ray ray = {camera->position, f};
    const vec3 across = vec3_add(vec3_mul(s, x * aspect), vec3_mul(u, y));
    const double angle = camera->half_field * vec3_length(across);
    switch (camera->projection) {
    case IR_PROJECTION_ORTHOGRAPHIC:
        ray.start = vec3_add(ray.start, vec3_mul(across, camera->half_height));
        break;
    case IR_PROJECTION_FISHEYE:
        if (angle > 0)
            ray.direction =
                vec3_add(vec3_mul(f, cos(angle)), vec3_mul(across, camera->half_field * sin(angle) / angle));
        break;
    case IR_PROJECTION_PANORAMA: {
        const vec3 level = vec3_add(vec3_mul(f, cos(x * 180 * RADIANS)), vec3_mul(s, sin(x * 180 * RADIANS)));
        ray.direction = vec3_add(vec3_mul(level, cos(y * 90 * RADIANS)), vec3_mul(u, sin(y * 90 * RADIANS)));
        break;
    }
    default:
        ray.direction = vec3_unit(vec3_add(f, vec3_mul(across, camera->tan_half_fov)));
    }
    return ray;
}

static void turn(vec3 *a, vec3 *b, double angle) {
    const vec3 before = *a;
    *a = vec3_add(vec3_mul(before, cos(angle)), vec3_mul(*b, sin(angle)));
    *b = vec3_sub(vec3_mul(*b, cos(angle)), vec3_mul(before, sin(angle)));
}

void view_turn_aside(struct view_camera *camera) {
    turn(&camera->forward, &camera->right, 1.3e-3 * camera->tan_half_fov);
    turn(&camera->forward, &camera->up, 1.7e-3 * camera->tan_half_fov);
    turn(&camera->right, &camera->up, 1.9e-3);
}
