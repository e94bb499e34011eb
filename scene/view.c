#include "scene/view.h"

#include "core/srgb.h"

#include <string.h>

#define DEGREE 0.017453292519943295769 // pi / 180

// ---- colours

vec3 view_linear_color(struct ir_color color, unsigned transfer) {
    if (!color.is_hex)
        return (vec3){color.r, color.g, color.b};
    vec3 shown = {(double)(color.hex >> 16 & 0xFF) / 255, (double)(color.hex >> 8 & 0xFF) / 255,
                  (double)(color.hex & 0xFF) / 255};
    if (transfer != IR_TRANSFER_SRGB)
        return shown;
    return (vec3){srgb_decode(shown.x), srgb_decode(shown.y), srgb_decode(shown.z)};
}

// ---- rotations

struct turn {
    double sine, cosine;
};

// Reduced to -45..45 degrees without rounding (remquo is exact), so that quarter turns are.
static struct turn turn_of(double degrees) {
    int quarter;
    double rest = remquo(degrees, 90, &quarter) * DEGREE;
    double s = sin(rest);
    double c = cos(rest);
    switch (quarter & 3) {
    case 0:
        return (struct turn){s, c};
    case 1:
        return (struct turn){c, -s};
    case 2:
        return (struct turn){-s, -c};
    default:
        return (struct turn){-c, s};
    }
}

mat3 view_rotation(vec3 degrees) {
    struct turn x = turn_of(degrees.x);
    struct turn y = turn_of(degrees.y);
    struct turn z = turn_of(degrees.z);
    mat3 rx = {{{1, 0, 0}, {0, x.cosine, -x.sine}, {0, x.sine, x.cosine}}};
    mat3 ry = {{{y.cosine, 0, y.sine}, {0, 1, 0}, {-y.sine, 0, y.cosine}}};
    mat3 rz = {{{z.cosine, -z.sine, 0}, {z.sine, z.cosine, 0}, {0, 0, 1}}};
    mat3 all = mat3_mul(rz, mat3_mul(ry, rx));
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            all.m[i][j] += 0.0; // no -0
    return all;
}

affine3 view_model_transform(const struct ir_model *model) {
    affine3 place = {view_rotation(model->rotation), model->translation};
    double scale[3] = {model->scale.x, model->scale.y, model->scale.z};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            place.linear.m[i][j] *= scale[j];
    return place;
}

static vec3 column(mat3 m, int j) {
    return (vec3){m.m[0][j], m.m[1][j], m.m[2][j]};
}

// ---- bounds

struct bounds {
    vec3 lower, upper;
    bool any;
};

static void include(struct bounds *b, vec3 p) {
    b->lower = b->any ? vec3_min(b->lower, p) : p;
    b->upper = b->any ? vec3_max(b->upper, p) : p;
    b->any = true;
}

static void include_model(struct bounds *b, const struct ir_model *model, const struct mesh *mesh) {
    affine3 place = view_model_transform(model);
    for (uint32_t i = 0; i < mesh->position_count; i++)
        include(b, affine3_apply(place, mesh->positions[i]));
}

bool view_bounds(const struct ir_scene *scene, const struct assets *assets, vec3 *lower, vec3 *upper) {
    struct bounds b = {0};
    for (uint32_t i = 0; i < scene->spheres.count; i++) {
        const struct ir_sphere *sphere = &scene->spheres.items[i];
        vec3 radius = {sphere->radius, sphere->radius, sphere->radius};
        include(&b, vec3_sub(sphere->center, radius));
        include(&b, vec3_add(sphere->center, radius));
    }
    for (uint32_t i = 0; i < scene->rectangles.count; i++) {
        const struct ir_rectangle *r = &scene->rectangles.items[i];
        vec3 along_u = vec3_add(r->corner, r->edge_u);
        include(&b, r->corner);
        include(&b, along_u);
        include(&b, vec3_add(r->corner, r->edge_v));
        include(&b, vec3_add(along_u, r->edge_v));
    }
    for (uint32_t i = 0; i < scene->models.count && i < assets->model_count; i++)
        if (assets->models[i].mesh)
            include_model(&b, &scene->models.items[i], assets->models[i].mesh);
    *lower = b.lower;
    *upper = b.upper;
    return b.any;
}

// ---- the camera

// Right and up for a direction of view. An up along the view was refused where it was written; the default
// one gives way: +z where the view goes up, -z where it goes down.
static void orient(struct view_camera *camera, vec3 forward, vec3 up) {
    vec3 right = vec3_cross(forward, vec3_unit(up));
    if (!(vec3_length(right) >= 1e-9))
        right = vec3_cross(forward, (vec3){0, 0, forward.y > 0 ? 1 : -1});
    // A view along z, with an up along z that a diagnostic has refused already.
    if (!(vec3_length(right) >= 1e-9))
        right = vec3_cross(forward, (vec3){0, 1, 0});
    camera->forward = forward;
    camera->right = vec3_unit(right);
    camera->up = vec3_cross(camera->right, forward);
}

static double tan_half(double degrees) {
    return degrees == 90 ? 1 : tan(degrees / 2 * DEGREE);
}

static struct view_camera written_camera(const struct ir_camera *ir) {
    struct view_camera camera = {
        .name = ir->name, .position = ir->position, .tan_half_fov = tan_half(ir->fov)};
    if (ir->view == IR_VIEW_ROTATION) {
        mat3 turn = view_rotation(ir->rotation);
        camera.right = column(turn, 0);
        camera.up = column(turn, 1);
        camera.forward = vec3_add(vec3_neg(column(turn, 2)), (vec3){0, 0, 0});
        return camera;
    }
    vec3 along = ir->view == IR_VIEW_LOOK_AT ? vec3_sub(ir->look_at, ir->position) : ir->direction;
    // A view of no direction has its diagnostic; the picture looks along -z.
    orient(&camera, vec3_is_zero(along) ? (vec3){0, 0, -1} : vec3_unit(along), ir->up);
    return camera;
}

// All bodies in view: their box's sphere touches the narrower field.
static struct view_camera automatic_camera(const struct ir_scene *scene, const struct assets *assets,
                                           int32_t width, int32_t height) {
    struct view_camera camera = {.name = STR("main"), .tan_half_fov = tan_half(60), .automatic = true};
    orient(&camera, (vec3){0, 0, -1}, (vec3){0, 1, 0});
    vec3 lower, upper;
    if (!view_bounds(scene, assets, &lower, &upper))
        return camera;
    vec3 half = vec3_mul(vec3_sub(upper, lower), 0.5);
    double aspect = (double)width / height;
    double half_field = atan(camera.tan_half_fov * fmin(1, aspect));
    camera.position = vec3_add(lower, half);
    camera.position.z += vec3_length(half) / sin(half_field);
    return camera;
}

// ---- lights

static struct view_light written_light(const struct ir_light *ir, uint32_t index, unsigned transfer) {
    struct view_light light = {.index = index,
                               .emission = vec3_mul(view_linear_color(ir->color, transfer), ir->intensity)};
    light.directional = ir->kind == IR_LIGHT_DIRECTION;
    if (light.directional)
        light.to_light = vec3_unit(vec3_neg(ir->direction));
    else
        light.position = ir->position;
    light.inverse_square = !light.directional && ir->falloff == IR_FALLOFF_INVERSE_SQUARE;
    return light;
}

static span scene_place(const struct ir_scene *scene, const struct assets *assets) {
    return assets->origin ? ir_place_label(assets->origin, &scene->head) : SPAN_NONE;
}

static void build_lights(const struct ir_scene *scene, struct arena *arena, struct view *out) {
    uint32_t count = scene->lights.count;
    out->light_count = count ? count : 1;
    out->lights = ARENA_ARRAY(arena, struct view_light, out->light_count);
    for (uint32_t i = 0; i < count; i++)
        out->lights[i] = written_light(&scene->lights.items[i], i, scene->image.transfer);
    if (count == 0)
        out->lights[0] = (struct view_light){
            .position = out->camera.position, .emission = {1, 1, 1}, .automatic = true, .index = IR_NO_INDEX};
}

void view_build(const struct ir_scene *scene, const struct assets *assets, uint32_t camera_index,
                int32_t width, int32_t height, struct arena *arena, struct diag_sink *sink,
                struct view *out) {
    *out = (struct view){0};
    out->camera = scene->cameras.count ? written_camera(&scene->cameras.items[camera_index])
                                       : automatic_camera(scene, assets, width, height);
    build_lights(scene, arena, out);
    vec3 p = out->camera.position;
    if (sink && out->camera.automatic)
        diag_add(sink, DIAG_DEFAULT_CAMERA, scene_place(scene, assets),
                 "the scene has no camera; one at %.6g %.6g %.6g looks along -z", p.x, p.y, p.z);
    if (sink && out->lights[0].automatic)
        diag_add(sink, DIAG_DEFAULT_LIGHT, scene_place(scene, assets),
                 "the scene has no light; one shines from the camera");
}

void view_sample_offset(uint32_t n, double *a, double *b) {
    const double ratio = 1.32471795724474602596; // the plastic number
    double x = 0.5 + n / ratio;
    double y = 0.5 + n / (ratio * ratio);
    *a = x - floor(x);
    *b = y - floor(y);
}
