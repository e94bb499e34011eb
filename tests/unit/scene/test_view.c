// Cameras, lights, rotations and colours, against values worked out by hand.
#include "diag/codes/rule.h"
#include "scene/transform.h"
#include "scene/view.h"

#include "core/angle.h"
#include "core/srgb.h"

#include "assets_scene.h"

#include <math.h>

static void assert_exact(vec3 v, double x, double y, double z) {
    if (v.x != x || v.y != y || v.z != z)
        fail_msg("(%.17g %.17g %.17g) is not (%.17g %.17g %.17g)", v.x, v.y, v.z, x, y, z);
}

static void assert_near(vec3 v, double x, double y, double z) {
    if (!(vec3_length(vec3_sub(v, (vec3){x, y, z})) < 1e-14))
        fail_msg("(%.17g %.17g %.17g) is not (%.17g %.17g %.17g)", v.x, v.y, v.z, x, y, z);
}

static struct ir_camera *add_camera(struct assets_scene *s) {
    struct ir_camera *camera = ARENA_PUSH(&s->arena, &s->scene.cameras);
    schema_init(&SCHEMA_CAMERA, camera);
    camera->name = STR("eye");
    return camera;
}

static struct view build(struct assets_scene *s, int32_t width, int32_t height) {
    struct view view;
    assets_scene_load(s);
    view_build(&s->resolved, 0, width, height, &s->arena, &s->sink, &view);
    return view;
}

// A direction along no axis, to the last digits of a double.
static void a_view_is_exact(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    struct ir_camera *camera = add_camera(s);
    camera->view = IR_VIEW_DIRECTION;
    camera->direction = (vec3){1, 2, -3};
    const struct view_camera found = build(s, 4, 3).camera;
    const double length = sqrt(14), across = sqrt(10);
    assert_near(found.forward, 1 / length, 2 / length, -3 / length);
    assert_near(found.right, 3 / across, 0, 1 / across);
    assert_near(found.up, -2 / (length * across), 10 / (length * across), 6 / (length * across));
    assets_scene_end(s);
}

static void quarter_turns_are_exact(void **state) {
    (void)state;
    static const struct {
        vec3 degrees;
        double m[3][3];
    } cases[] = {
        {{0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
        {{90, 0, 0}, {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}},
        {{0, 90, 0}, {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}},
        {{0, 0, 90}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}},
        {{180, 0, 0}, {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}},
        {{0, -90, 0}, {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}},
        {{0, 270, 0}, {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}},
        {{360000, -720, 990}, {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}},
        // Rz·Ry·Rx: z goes to -y about x, stays there about y, and to x about z.
        {{90, 90, 90}, {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        mat3 m = mat3_rotation(cases[i].degrees);
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++)
                if (m.m[r][c] != cases[i].m[r][c] || signbit(m.m[r][c]) != signbit(cases[i].m[r][c]))
                    fail_msg("case %zu: m[%d][%d] is %.17g", i, r, c, m.m[r][c]);
    }
}

static void the_order_is_x_then_y_then_z(void **state) {
    (void)state;
    mat3 m = mat3_rotation((vec3){30, 45, 60});
    double sx = 0.5, cx = sqrt(3) / 2, sy = sqrt(0.5), cy = sqrt(0.5), sz = sqrt(3) / 2, cz = 0.5;
    assert_near((vec3){m.m[0][0], m.m[1][0], m.m[2][0]}, cz * cy, sz * cy, -sy);
    assert_near((vec3){m.m[0][1], m.m[1][1], m.m[2][1]}, cz * sy * sx - sz * cx, sz * sy * sx + cz * cx,
                cy * sx);
    assert_near((vec3){m.m[0][2], m.m[1][2], m.m[2][2]}, cz * sy * cx + sz * sx, sz * sy * cx - cz * sx,
                cy * cx);
}

static void angles_are_exact_to_an_ulp(void **state) {
    (void)state;
    assert_true(mat3_rotation((vec3){0, 0, 30}).m[1][0] == 0.49999999999999994 ||
                mat3_rotation((vec3){0, 0, 30}).m[1][0] == 0.5);
    assert_true(fabs(mat3_rotation((vec3){0, 0, 1e6}).m[1][0] - sin(fmod(1e6, 360) * PI / 180)) < 1e-15);
}

static void a_model_is_scaled_then_turned_then_moved(void **state) {
    (void)state;
    struct ir_model model = {.scale = {2, 3, -4}, .rotation = {0, 0, 90}, .translation = {10, 20, 30}};
    affine3 place = transform_of(model.scale, model.rotation, model.translation);
    assert_exact(affine3_apply(place, (vec3){1, 0, 0}), 10, 22, 30);
    assert_exact(affine3_apply(place, (vec3){0, 1, 0}), 7, 20, 30);
    assert_exact(affine3_apply(place, (vec3){0, 0, 1}), 10, 20, 26);
}

static void cameras_look_where_they_are_told(void **state) {
    (void)state;
    static const struct {
        unsigned view;
        vec3 value, up;
        double forward[3], right[3], upward[3];
    } cases[] = {
        {IR_VIEW_DIRECTION, {0, 0, -1}, {0, 1, 0}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}},
        {IR_VIEW_DIRECTION, {5, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
        {IR_VIEW_DIRECTION, {0, 0, 1e-200}, {0, 1e18, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}},
        {IR_VIEW_DIRECTION, {3, -4, 0}, {0, 1, 0}, {0.6, -0.8, 0}, {0, 0, 1}, {0.8, 0.6, 0}},
        // The default up gives way: +z where the view goes up, -z where it goes down.
        {IR_VIEW_DIRECTION, {0, 2, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
        {IR_VIEW_DIRECTION, {0, -2, 0}, {0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
        // So near to the up that rounding would decide; and where it does not.
        {IR_VIEW_DIRECTION, {0, 1, 1e-10}, {0, 1, 0}, {0, 1, 1e-10}, {1, 0, 0}, {0, -1e-10, 1}},
        {IR_VIEW_DIRECTION, {0, 1, 1e-8}, {0, 1, 0}, {0, 1, 1e-8}, {-1, 0, 0}, {0, 1e-8, -1}},
        // An up along z has no default to give way to but y.
        {IR_VIEW_DIRECTION, {0, 0, -1}, {0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}},
        {IR_VIEW_LOOK_AT, {1, 2, 13}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}},
        {IR_VIEW_ROTATION, {0, 0, 0}, {0, 1, 0}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}},
        {IR_VIEW_ROTATION, {0, 90, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
        {IR_VIEW_ROTATION, {90, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
        {IR_VIEW_ROTATION, {0, 0, 90}, {0, 1, 0}, {0, 0, -1}, {0, 1, 0}, {-1, 0, 0}},
        // Refused where it was written (look_at equal to position): the picture looks along -z.
        {IR_VIEW_LOOK_AT, {1, 2, 3}, {0, 1, 0}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct assets_scene *s = assets_scene_begin();
        struct ir_camera *ir = add_camera(s);
        ir->position = (vec3){1, 2, 3};
        ir->view = cases[i].view;
        ir->direction = ir->look_at = ir->rotation = cases[i].value;
        ir->up = cases[i].up;
        struct view_camera camera = build(s, 4, 3).camera;
        assert_exact(camera.position, 1, 2, 3);
        assert_near(camera.forward, cases[i].forward[0], cases[i].forward[1], cases[i].forward[2]);
        assert_near(camera.right, cases[i].right[0], cases[i].right[1], cases[i].right[2]);
        assert_near(camera.up, cases[i].upward[0], cases[i].upward[1], cases[i].upward[2]);
        assert_near((vec3){camera.tan_half_fov, 0, 0}, sqrt(1.0 / 3), 0, 0);
        assert_false(camera.automatic);
        assert_true(str_equal_cstr(camera.name, "eye"));
        assets_scene_end(s);
    }
}

static void a_field_of_90_degrees_is_exact(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    add_camera(s)->fov = 90;
    assert_true(build(s, 1, 1).camera.tan_half_fov == 1);
    assets_scene_end(s);
}

static void add_sphere(struct assets_scene *s, vec3 center, double radius) {
    struct ir_sphere *sphere = ARENA_PUSH(&s->arena, &s->scene.spheres);
    schema_init(&SCHEMA_SPHERE, sphere);
    sphere->center = center;
    sphere->radius = radius;
}

static void bounds_hold_all_bodies(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    vec3 lower, upper;
    assets_scene_load(s);
    assert_false(scene_bounds(&s->resolved, &lower, &upper));
    assets_scene_end(s);

    s = assets_scene_begin();
    add_sphere(s, (vec3){1, 2, 3}, 2);
    struct ir_rectangle *rectangle = ARENA_PUSH(&s->arena, &s->scene.rectangles);
    schema_init(&SCHEMA_RECTANGLE, rectangle);
    rectangle->corner = (vec3){-2, 0, 0};
    rectangle->edge_u = (vec3){-1, 0, 0};
    rectangle->edge_v = (vec3){0, -3, 0};
    assets_scene_file(s, "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 99 99 99\nf 1 2 3\n");
    struct ir_model *model = assets_scene_model(s, "mesh.obj");
    model->scale = (vec3){4, 4, 4};
    model->rotation = (vec3){0, 90, 0}; // x goes to -z
    model->translation = (vec3){0, 10, 0};
    assets_scene_load(s);
    assert_true(scene_bounds(&s->resolved, &lower, &upper));
    assert_exact(lower, -3, -3, -4);
    assert_exact(upper, 3, 14, 5);
    assets_scene_end(s);
}

// Each corner of a square on its tip is the farthest one to a side.
static void bounds_hold_each_corner(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    struct ir_rectangle *rectangle = ARENA_PUSH(&s->arena, &s->scene.rectangles);
    schema_init(&SCHEMA_RECTANGLE, rectangle);
    rectangle->corner = (vec3){-5, 1, 0};
    rectangle->edge_u = (vec3){1, 1, 0};
    rectangle->edge_v = (vec3){2, -2, 0};
    vec3 lower, upper;
    assets_scene_load(s);
    assert_true(scene_bounds(&s->resolved, &lower, &upper));
    assert_exact(lower, -5, -1, 0);
    assert_exact(upper, -2, 2, 0);
    assets_scene_end(s);
}

// A sphere of radius 3: its box's half diagonal is r = 3√3; the camera stands r / sin(half the narrower
// field) before its middle.
static void the_automatic_camera_sees_all(void **state) {
    (void)state;
    static const struct {
        int32_t width, height;
        double half_field;
    } cases[] = {{400, 300, PI / 6}, {300, 300, PI / 6}, {100, 300, 0.19012560334646675}}; // atan(tan(30°)/3)
    for (size_t i = 0; i < 3; i++) {
        struct assets_scene *s = assets_scene_begin();
        add_sphere(s, (vec3){10, 20, 30}, 3);
        struct view view = build(s, cases[i].width, cases[i].height);
        assert_true(view.camera.automatic);
        assert_exact(view.camera.forward, 0, 0, -1);
        assert_exact(view.camera.right, 1, 0, 0);
        assert_near((vec3){view.camera.tan_half_fov, 0, 0}, sqrt(1.0 / 3), 0, 0);
        assert_exact((vec3){view.camera.position.x, view.camera.position.y, 0}, 10, 20, 0);
        assert_true(fabs(view.camera.position.z - 30 - 3 * sqrt(3) / sin(cases[i].half_field)) < 1e-12);
        assert_int_equal(assets_scene_count(s, DIAG_DEFAULT_CAMERA), 1);
        assert_int_equal(assets_scene_count(s, DIAG_DEFAULT_LIGHT), 1);
        assert_int_equal(view.light_count, 1);
        assert_true(view.lights[0].automatic);
        assert_int_equal(view.lights[0].index, IR_NO_INDEX);
        assert_memory_equal(&view.lights[0].position, &view.camera.position, sizeof(vec3));
        assert_exact(view.lights[0].emission, 1, 1, 1);
        assets_scene_end(s);
    }
    struct assets_scene *s = assets_scene_begin();
    assert_exact(build(s, 4, 3).camera.position, 0, 0, 0);
    assets_scene_end(s);
}

static void lights_are_as_written(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    add_camera(s);
    struct ir_light *point = ARENA_PUSH(&s->arena, &s->scene.lights);
    schema_init(&SCHEMA_LIGHT, point);
    point->kind = IR_LIGHT_POSITION;
    point->position = (vec3){1, 2, 3};
    point->intensity = 2;
    point->color = (struct ir_color){.r = 0.5, .g = 1, .b = 4};
    point->falloff = IR_FALLOFF_INVERSE_SQUARE;
    struct ir_light *sun = ARENA_PUSH(&s->arena, &s->scene.lights);
    schema_init(&SCHEMA_LIGHT, sun);
    sun->kind = IR_LIGHT_DIRECTION;
    sun->direction = (vec3){0, -8, 6};
    sun->color = (struct ir_color){.is_hex = true, .hex = 0xFF8000};
    s->scene.image.transfer = IR_TRANSFER_SRGB;
    struct view view = build(s, 4, 3);
    assert_silent(s);
    assert_int_equal(view.light_count, 2);
    assert_exact(view.lights[0].position, 1, 2, 3);
    assert_exact(view.lights[0].emission, 1, 2, 8);
    assert_true(view.lights[0].inverse_square && !view.lights[0].directional && !view.lights[0].automatic);
    assert_true(view.lights[1].directional && !view.lights[1].inverse_square);
    assert_near(view.lights[1].to_light, 0, 0.8, -0.6);
    assert_near(view.lights[1].emission, 1, 0.21586050011389926, 0);
    assert_int_equal(view.lights[1].index, 1);
    assets_scene_end(s);
}

static void hex_colours_are_displayed_ones(void **state) {
    (void)state;
    struct ir_color hex = {.is_hex = true, .hex = 0x0A80FF};
    assert_near(scene_linear_color(hex, IR_TRANSFER_NONE), 10.0 / 255, 128.0 / 255, 1);
    assert_near(scene_linear_color(hex, IR_TRANSFER_SRGB), 0.0030352698354883752, 0.21586050011389926, 1);
    struct ir_color numbers = {.r = 0.25, .g = 3, .b = 0};
    assert_exact(scene_linear_color(numbers, IR_TRANSFER_SRGB), 0.25, 3, 0);
    assert_true(srgb_decode(0) == 0 && srgb_decode(1) == 1);
}

static void samples_follow_the_sequence(void **state) {
    (void)state;
    double a, b;
    view_sample_offset(0, &a, &b);
    assert_true(a == 0.5 && b == 0.5);
    view_sample_offset(1, &a, &b);
    // As floats: devices and the reference look at the same place.
    assert_exact((vec3){a, b, 0}, (double)0.25487766624669272F, (double)0.06984029099805327F, 0);
    view_sample_offset(2, &a, &b);
    assert_exact((vec3){a, b, 0}, (double)0.00975533249338543F, (double)0.63968058199610653F, 0);
    for (uint32_t n = 0; n < 4096; n++) {
        view_sample_offset(n, &a, &b);
        assert_true(a >= 0 && a < 1 && b >= 0 && b < 1);
    }
}

static double distance_of(uint32_t apart) {
    double a, b;
    view_sample_offset(apart, &a, &b);
    a = fabs(a - 0.5);
    b = fabs(b - 0.5);
    return hypot(fmin(a, 1 - a), fmin(b, 1 - b));
}

// Of n samples from 0 on, and 4 n others, none lie closer together than half of what the 4 n do.
static void other_samples_are_apart(void **state) {
    (void)state;
    for (uint32_t n = 4; n <= 256; n *= 2) {
        double own = 1, others = 1;
        for (uint32_t i = 1; i < 4 * n; i++)
            own = fmin(own, distance_of(i));
        for (uint32_t i = 0; i < 5 * n; i++)
            others = fmin(others, distance_of(VIEW_OTHER_SAMPLES - n + i));
        assert_true(others > 0.5 * own);
    }
}

// What a picture shows of a point is what the ray of that place comes to, and how much of it there is follows
// from where its neighbours are.
static void a_sight_is_the_inverse_of_a_ray(void **state) {
    (void)state;
    static const struct {
        unsigned projection;
        double fov;
    } cases[] = {{IR_PROJECTION_PERSPECTIVE, 70},
                 {IR_PROJECTION_ORTHOGRAPHIC, 60},
                 {IR_PROJECTION_FISHEYE, 200},
                 {IR_PROJECTION_PANORAMA, 60}};
    const double aspect = 1.5, far = 7, step = 1e-4;
    for (uint32_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct assets_scene *s = assets_scene_begin();
        struct ir_camera *ir = add_camera(s);
        ir->projection = cases[i].projection;
        ir->fov = cases[i].fov;
        ir->size = 3;
        ir->position = (vec3){1, -2, 4};
        ir->view = IR_VIEW_DIRECTION;
        ir->direction = (vec3){1, 2, -3};
        const struct view_camera camera = build(s, 3, 2).camera;
        for (int k = 0; k < 25; k++) {
            const double x = (k % 5 - 2) * 0.42 + 0.01, y = (k / 5 - 2) * 0.43 + 0.02;
            struct view_sight sight, beside, above;
            const struct view_ray ray = view_ray_at(&camera, aspect, x, y);
            const vec3 point = vec3_add(ray.start, vec3_mul(ray.direction, far));
            assert_true(view_sight_of(&camera, aspect, point, &sight));
            assert_true(fabs(sight.x - x) < 1e-12 && fabs(sight.y - y) < 1e-12);
            assert_true(vec3_length(vec3_sub(sight.direction, ray.direction)) < 1e-12);
            // A small square across the ray, as the picture has it.
            const vec3 a = vec3_unit(vec3_cross(ray.direction, (vec3){0.3, 0.5, 0.7}));
            const vec3 b = vec3_cross(ray.direction, a);
            view_sight_of(&camera, aspect, vec3_add(point, vec3_mul(a, step)), &beside);
            view_sight_of(&camera, aspect, vec3_add(point, vec3_mul(b, step)), &above);
            // In heights of the picture: x and y go over 2, and a picture is aspect heights wide.
            const double area =
                fabs((beside.x - x) * (above.y - y) - (above.x - x) * (beside.y - y)) * aspect / 4;
            const double density = area / (step * step);
            assert_true(fabs(density / sight.density - 1) < 1e-3);
        }
        assets_scene_end(s);
    }
}

// Heights of the whole picture, and points that it does not show.
static void a_sight_ends_with_the_picture(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    add_camera(s);
    struct view_camera camera = build(s, 3, 2).camera;
    struct view_sight sight;
    camera.tan_half_fov = 0.5;
    assert_true(view_sight_of(&camera, 1, (vec3){0, 0, -4}, &sight) && sight.height == 4);
    assert_true(view_sight_of(&camera, 1, (vec3){1.9, 0, -4}, &sight) && sight.height == 4);
    assert_false(view_sight_of(&camera, 1, (vec3){2.1, 0, -4}, &sight));
    assert_false(view_sight_of(&camera, 1, (vec3){0, 0, 4}, &sight));
    assert_false(view_sight_of(&camera, 1, camera.position, &sight));
    camera.projection = IR_PROJECTION_ORTHOGRAPHIC;
    camera.half_height = 3;
    assert_true(view_sight_of(&camera, 1, (vec3){2.9, 0, -4}, &sight) && sight.height == 6);
    assert_true(view_sight_of(&camera, 1, (vec3){2.9, 0, -400}, &sight) && sight.height == 6);
    camera.projection = IR_PROJECTION_FISHEYE;
    camera.half_field = 1;
    assert_true(view_sight_of(&camera, 1, (vec3){0, 0, -4}, &sight) && sight.height == 8);
    assert_false(view_sight_of(&camera, 1, (vec3){0, 4 * sin(1.01), -4 * cos(1.01)}, &sight));
    camera.projection = IR_PROJECTION_PANORAMA;
    assert_true(view_sight_of(&camera, 2, (vec3){0, 3, 4}, &sight) && fabs(sight.height - 5 * PI) < 1e-12);
    assets_scene_end(s);
}

// Through the middle of a body by its name, whatever its shape: as by its distance, written by hand.
static void a_lens_is_focused_on_a_body(void **state) {
    (void)state;
    static const struct {
        const char *name;
        double focus;
    } cases[] = {{"ball", 4}, {"wall", 7}, {"gone", 1}, {"behind", 1}};
    for (uint32_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct assets_scene *s = assets_scene_begin();
        struct ir_camera *camera = add_camera(s);
        camera->position = (vec3){0, 0, 5};
        camera->view = IR_VIEW_DIRECTION;
        camera->direction = (vec3){0, 0, -1};
        camera->aperture = 0.5;
        camera->focusing = IR_FOCUS_BODY;
        camera->focus_on = str_from(cases[i].name);
        add_sphere(s, (vec3){3, 0, 1}, 0.5);
        s->scene.spheres.items[0].name = STR("ball");
        add_sphere(s, (vec3){0, 0, 8}, 0.5);
        s->scene.spheres.items[1].name = STR("behind");
        struct ir_rectangle *wall = ARENA_PUSH(&s->arena, &s->scene.rectangles);
        schema_init(&SCHEMA_RECTANGLE, wall);
        wall->name = STR("wall");
        wall->corner = (vec3){-1, -1, -3};
        wall->edge_u = (vec3){2, 0, 2};
        wall->edge_v = (vec3){0, 2, 0};
        struct view view = build(s, 4, 3);
        assert_true(view.camera.focus == cases[i].focus);
        assets_scene_end(s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_view_is_exact),
        cmocka_unit_test(quarter_turns_are_exact),
        cmocka_unit_test(the_order_is_x_then_y_then_z),
        cmocka_unit_test(angles_are_exact_to_an_ulp),
        cmocka_unit_test(a_model_is_scaled_then_turned_then_moved),
        cmocka_unit_test(cameras_look_where_they_are_told),
        cmocka_unit_test(a_field_of_90_degrees_is_exact),
        cmocka_unit_test(bounds_hold_all_bodies),
        cmocka_unit_test(bounds_hold_each_corner),
        cmocka_unit_test(the_automatic_camera_sees_all),
        cmocka_unit_test(lights_are_as_written),
        cmocka_unit_test(hex_colours_are_displayed_ones),
        cmocka_unit_test(samples_follow_the_sequence),
        cmocka_unit_test(other_samples_are_apart),
        cmocka_unit_test(a_sight_is_the_inverse_of_a_ray),
        cmocka_unit_test(a_sight_ends_with_the_picture),
        cmocka_unit_test(a_lens_is_focused_on_a_body),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
