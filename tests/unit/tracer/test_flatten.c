// Scenes to buffers: what docs/decisions/numbers.md promises, at the level of bits.
#include "diag/codes/limit.h"
#include "diag/codes/rule.h"
#include "flat_kit.h"
#include "scene/transform.h"
#include "shaders/features.h"
#include "shaders/gpu_scene.h"
#include "shaders/records.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const vec3 tetra_positions[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
static const uint32_t tetra_faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

static struct mesh *tetra(struct kit *kit) {
    return kit_mesh(kit, tetra_positions, 4, tetra_faces, 4, true);
}

static void flatten_ok(struct kit *kit, struct flat_scene *flat) {
    assert_true(kit_flatten(kit, flat));
    assert_int_equal(kit->sink.count, 0);
}

static void assert_vec3(vec3 a, double x, double y, double z) {
    if (a.x != x || a.y != y || a.z != z)
        fail_msg("(%.17g %.17g %.17g) is not (%.17g %.17g %.17g)", a.x, a.y, a.z, x, y, z);
}

static vec3 word_vec3(const struct gpu_word *word) {
    return (vec3){kit_float(word->x), kit_float(word->y), kit_float(word->z)};
}

static void test_empty(void **state) {
    (void)state;
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    flatten_ok(&kit, &flat);
    assert_int_equal(flat.triangle_nodes.count, NODE_WORDS);
    assert_int_equal(flat.sphere_nodes.count, NODE_WORDS);
    assert_int_equal(flat.triangle_count + flat.sphere_count + flat.body_count + flat.light_count, 0);
    assert_int_equal(flat.features & (FEATURE_TRIANGLES | FEATURE_SPHERES | FEATURE_DIFFUSE), 0);
    assert_int_equal(flat.scale_exponent, 0);
    assert_int_equal(flat.materials.count, MATERIAL_WORDS);
    flat_finish(&flat);
    flat_finish(NULL);
    kit_finish(&kit);
}

static void test_rectangle(void **state) {
    (void)state;
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit_sphere(&kit)->center = (vec3){0, 0, -2};
    struct ir_rectangle *r = kit_rectangle(&kit);
    r->corner = (vec3){-1, -2, -8};
    r->edge_u = (vec3){2, 0, 0};
    r->edge_v = (vec3){0, 4, 1};
    flatten_ok(&kit, &flat);
    assert_int_equal(flat.scale_exponent, -3);
    assert_int_equal(flat.triangle_count, 2);
    assert_int_equal(flat.body_count, 2);
    uint32_t low = kit_find_triangle(&flat, 0);
    uint32_t top = kit_find_triangle(&flat, 1);
    assert_vec3(kit_vertex(&flat, low, 0), -0.125, -0.25, -1);
    assert_vec3(kit_vertex(&flat, low, 1), 0.125, -0.25, -1);
    assert_vec3(kit_vertex(&flat, low, 2), 0.125, 0.25, -0.875);
    assert_vec3(kit_vertex(&flat, top, 0), -0.125, -0.25, -1);
    assert_vec3(kit_vertex(&flat, top, 1), 0.125, 0.25, -0.875);
    assert_vec3(kit_vertex(&flat, top, 2), -0.125, 0.25, -0.875);
    const struct gpu_word *words = flat.triangles.words + (size_t)TRIANGLE_WORDS * top;
    assert_int_equal(words[1].w, 1);
    assert_int_equal(words[2].w, TRIANGLE_HALF | TRIANGLE_SECOND_HALF);
    assert_int_equal(flat.triangles.words[(size_t)TRIANGLE_WORDS * low + 2].w, TRIANGLE_HALF);
    const struct gpu_word *sphere = flat.spheres.words;
    assert_vec3(word_vec3(sphere), 0, 0, -0.25);
    assert_true(kit_float(sphere->w) == 0.125f);
    assert_int_equal(sphere[1].x, 0);
    assert_int_equal(sphere[1].y, TRIANGLE_SOLID);
    assert_int_equal(flat.features &
                         (FEATURE_TRIANGLES | FEATURE_SPHERES | FEATURE_DIFFUSE | FEATURE_SPECULAR),
                     FEATURE_TRIANGLES | FEATURE_SPHERES | FEATURE_DIFFUSE);
    flat_finish(&flat);
    kit_finish(&kit);
}

// Signed volume of all stored triangles, times six.
static double stored_volume(const struct flat_scene *flat) {
    double sum = 0;
    for (uint32_t i = 0; i < flat->triangle_count; i++)
        sum += vec3_dot(kit_vertex(flat, i, 0), vec3_cross(kit_vertex(flat, i, 1), kit_vertex(flat, i, 2)));
    return sum;
}

static uint32_t flags_of(const struct flat_scene *flat, uint32_t item) {
    return flat->triangles.words[(size_t)TRIANGLE_WORDS * item + 2].w & ~TRIANGLE_MATERIAL;
}

static void test_mirrored(void **state) {
    (void)state;
    for (int negative = 0; negative < 8; negative++) {
        struct kit kit;
        struct flat_scene flat;
        kit_init(&kit);
        struct ir_model *model = kit_model(&kit, tetra(&kit));
        model->scale = (vec3){negative & 1 ? -2 : 2, negative & 2 ? -2 : 2, negative & 4 ? -2 : 2};
        model->rotation = (vec3){20, 30, 40};
        model->translation = (vec3){0.25, 0.5, -4};
        flatten_ok(&kit, &flat);
        bool mirrors = negative == 1 || negative == 2 || negative == 4 || negative == 7;
        assert_true(stored_volume(&flat) > 0);
        assert_int_equal(flags_of(&flat, 0), TRIANGLE_SOLID | (mirrors ? TRIANGLE_TURNED : 0));
        flat_finish(&flat);
        kit_finish(&kit);
    }
}

// A mesh that was turned at load, and then mirrored, has the file's winding again.
static void test_turned_mesh(void **state) {
    (void)state;
    for (int mirrored = 0; mirrored < 2; mirrored++) {
        struct kit kit;
        struct flat_scene flat;
        kit_init(&kit);
        struct mesh *mesh = tetra(&kit);
        mesh->turned = true;
        struct ir_model *model = kit_model(&kit, mesh);
        model->scale.x = mirrored ? -1 : 1;
        flatten_ok(&kit, &flat);
        assert_int_equal(flags_of(&flat, 0), TRIANGLE_SOLID | (mirrored ? 0 : TRIANGLE_TURNED));
        flat_finish(&flat);
        kit_finish(&kit);
    }
}

static void test_right_angles(void **state) {
    (void)state;
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    struct ir_model *model = kit_model(&kit, tetra(&kit));
    model->rotation = (vec3){90, 180, -270}; // e_x -> e_z rotated: checked below by hand
    model->scale = (vec3){1.25, 1.5, 1.75};
    flatten_ok(&kit, &flat);
    // Rx(90): (x,y,z) -> (x,-z,y); Ry(180): (-x,y,-z); Rz(-270) = Rz(90): (-y,x,z).
    uint32_t item = kit_find_triangle(&flat, 3); // corners e_x, e_y, e_z
    assert_vec3(kit_vertex(&flat, item, 0), 0, -1.25, 0);
    assert_vec3(kit_vertex(&flat, item, 1), 0, 0, -1.5);
    assert_vec3(kit_vertex(&flat, item, 2), 1.75, 0, 0);
    flat_finish(&flat);
    kit_finish(&kit);
}

// Triangles without area are left out; the others keep the numbers of the file.
static void test_dropped(void **state) {
    (void)state;
    static const vec3 positions[5] = {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {2, 0, -1}, {1, 0, -1.00000001}};
    static const uint32_t faces[5][3] = {{0, 1, 3}, {0, 1, 2}, {1, 1, 2}, {1, 4, 2}, {1, 3, 2}};
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit_rectangle(&kit);
    kit_model(&kit, kit_mesh(&kit, positions, 5, faces, 5, false));
    flatten_ok(&kit, &flat);
    assert_int_equal(flat.triangle_count, 4);
    assert_int_equal(flat.dropped_triangles, 3);
    for (uint32_t number = 0; number < 7; number++)
        assert_int_equal(kit_find_triangle(&flat, number) != UINT32_MAX,
                         number < 2 || number == 3 || number == 6);
    assert_int_equal(flat.bodies.words[BODY_WORDS].x, 2);
    assert_int_equal(flat.triangles.words[(size_t)TRIANGLE_WORDS * kit_find_triangle(&flat, 3) + 2].w,
                     0); // open: a pane
    flat_finish(&flat);
    kit_finish(&kit);
}

// As thin as floats can be, and as small.
static void test_slivers(void **state) {
    (void)state;
    static const vec3 positions[7] = {{0, 0, 0},       {1 + 0x1p-23, 1, 0}, {1, 1 - 0x1p-23, 0},
                                      {1, 0x1p-23, 0}, {0x1p-100, 0, 0},    {0, 0x1p-100, 0},
                                      {1.5, 0, 0}};
    static const uint32_t faces[3][3] = {{0, 1, 2}, {0, 3, 6}, {0, 4, 5}};
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit_model(&kit, kit_mesh(&kit, positions, 7, faces, 3, false));
    flatten_ok(&kit, &flat);
    // The product of the first one's edges rounds to 0 at its first corner, but not at its best one.
    assert_int_equal(flat.dropped_triangles, 0);
    assert_true(flags_of(&flat, kit_find_triangle(&flat, 0)) >> TRIANGLE_CORNER_SHIFT > 0);
    flat_finish(&flat);
    kit_finish(&kit);
}

// ---- the same bits wherever and however large

static void build_variety(struct kit *kit, vec3 move, double scale) {
    kit_init(kit);
    kit->origin = vec3_mul(vec3_add((vec3){0.5, 1.25, 7.0625}, move), scale);
    struct mesh *sphere = kit_icosphere(kit, 3, 0x1p-16);
    for (int i = 0; i < 3; i++) {
        struct ir_model *model = kit_model(kit, i == 1 ? tetra(kit) : sphere);
        model->smooth = i != 1;
        model->scale = vec3_mul((vec3){0.75, i == 2 ? -0.5 : 1.5, 1.25}, scale);
        model->rotation = (vec3){12, 34.5, -56.7 * i};
        model->translation = vec3_mul(vec3_add((vec3){-3.0 * i, 0.0625, -0.71875}, move), scale);
    }
    struct ir_sphere *ball = kit_sphere(kit);
    ball->center = vec3_mul(vec3_add((vec3){4.34375, 1, 1}, move), scale);
    ball->radius = 0.65625 * scale;
    struct ir_rectangle *floor = kit_rectangle(kit);
    floor->corner = vec3_mul(vec3_add((vec3){-8, -2.0000152587890625, -8}, move), scale);
    floor->edge_u = vec3_mul((vec3){16, 0.25, 0}, scale);
    floor->edge_v = vec3_mul((vec3){0, 0, 19.71875}, scale);
    kit_light(kit, vec3_mul(vec3_add((vec3){20, 20, 20}, move), scale));
    struct view_light *fading = kit_light(kit, vec3_mul(vec3_add((vec3){-3, 7, 2}, move), scale));
    fading->inverse_square = true;
    fading->emission = vec3_mul((vec3){3, 2.7, 0.1}, scale * scale);
    kit_light(kit, (vec3){0, 0, 0})->directional = true;
    kit->view.lights[2].to_light = vec3_unit((vec3){1, 2, 3});
}

static void assert_same_array(const char *name, struct flat_array a, struct flat_array b) {
    assert_int_equal(a.count, b.count);
    if (memcmp(a.words, b.words, a.count * sizeof *a.words) != 0)
        fail_msg("%s differ", name);
}

static void check_same(vec3 move, double scale) {
    struct kit kit, other_kit;
    struct flat_scene flat, other;
    build_variety(&kit, (vec3){0, 0, 0}, 1);
    build_variety(&other_kit, move, scale);
    flatten_ok(&kit, &flat);
    flatten_ok(&other_kit, &other);
    assert_same_array("triangle nodes", flat.triangle_nodes, other.triangle_nodes);
    assert_same_array("triangles", flat.triangles, other.triangles);
    assert_same_array("normals", flat.normals, other.normals);
    assert_same_array("sphere nodes", flat.sphere_nodes, other.sphere_nodes);
    assert_same_array("spheres", flat.spheres, other.spheres);
    assert_same_array("bodies", flat.bodies, other.bodies);
    assert_same_array("materials", flat.materials, other.materials);
    assert_same_array("lights", flat.lights, other.lights);
    assert_int_equal(flat.features, other.features);
    flat_finish(&flat);
    flat_finish(&other);
    kit_finish(&kit);
    kit_finish(&other_kit);
}

static void test_moved(void **state) {
    (void)state;
    check_same((vec3){0, 0, 0}, 1);
    check_same((vec3){0x1p20, 0, 0}, 1);
    check_same((vec3){-0x1p20, 0x1p19, 0x1p20}, 1);
    check_same((vec3){0x1p-16, 0x1p-3, -0x1p7}, 1);
}

static void test_scaled(void **state) {
    (void)state;
    check_same((vec3){0, 0, 0}, 0x1p20);
    check_same((vec3){0, 0, 0}, 0x1p-20);
    check_same((vec3){0, 0, 0}, 0x1p55);
    check_same((vec3){0, 0, 0}, 0x1p-55);
    check_same((vec3){0x1p20, -0x1p20, 0x1p10}, 0x1p-20);
}

// ---- shading data

static void test_normals(void **state) {
    (void)state;
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    struct mesh *sphere = kit_icosphere(&kit, 2, 0);
    for (int i = 0; i < 3; i++) {
        struct ir_model *model = kit_model(&kit, i == 1 ? tetra(&kit) : sphere);
        model->smooth = i != 1;
        model->scale = (vec3){i ? -2 : 1, 1, 0.5};
        model->rotation = (vec3){10, 20, 30};
        model->translation = (vec3){i * 5.0, 0, 0};
    }
    flatten_ok(&kit, &flat);
    const vec3 *of_mesh = mesh_smooth_normals(sphere, 180, &kit.arena);
    assert_int_equal(flat.normals.count, 2 * 3 * sphere->triangle_count);
    assert_true(flat.features & FEATURE_SMOOTH);
    for (uint32_t body = 0; body < 3; body += 2) {
        uint32_t first = flat.bodies.words[(size_t)BODY_WORDS * body].x;
        uint32_t base = flat.bodies.words[(size_t)BODY_WORDS * body].y;
        assert_int_equal(base, body ? 3 * sphere->triangle_count : 0);
        for (uint32_t i = 0; i < sphere->triangle_count; i++) {
            uint32_t item = kit_find_triangle(&flat, first + i);
            assert_int_equal(flags_of(&flat, item),
                             TRIANGLE_SMOOTH | TRIANGLE_SOLID | (body ? TRIANGLE_TURNED : 0));
            vec3 face = vec3_cross(vec3_sub(kit_vertex(&flat, item, 1), kit_vertex(&flat, item, 0)),
                                   vec3_sub(kit_vertex(&flat, item, 2), kit_vertex(&flat, item, 0)));
            for (uint32_t k = 0; k < 3; k++) {
                vec3 normal = word_vec3(&flat.normals.words[base + 3 * i + k]);
                assert_true(fabs(vec3_length(normal) - 1) < 1e-6);
                assert_true(vec3_dot(normal, vec3_unit(face)) > 0.8);
                const struct ir_model *ir = &kit.scene.models.items[body];
                affine3 map = transform_of(ir->scale, ir->rotation, ir->translation);
                vec3 m = of_mesh[3 * i + (body && k ? 3 - k : k)];
                vec3 expected = {m.x / (ir->scale.x * ir->scale.x), m.y / (ir->scale.y * ir->scale.y),
                                 m.z / (ir->scale.z * ir->scale.z)};
                expected = vec3_unit(mat3_apply(map.linear, expected));
                assert_true(vec3_length(vec3_sub(normal, expected)) < 1e-6);
            }
        }
    }
    flat_finish(&flat);
    kit_finish(&kit);
}

static vec3 own_of(const struct flat_scene *flat, uint32_t body, vec3 point) {
    const struct gpu_word *words = flat->bodies.words + (size_t)BODY_WORDS * body + 1;
    double own[3];
    for (int i = 0; i < 3; i++)
        own[i] = vec3_dot(word_vec3(&words[i]), point) + kit_float(words[i].w);
    return (vec3){own[0], own[1], own[2]};
}

static void test_checker(void **state) {
    (void)state;
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit.origin = (vec3){100, -3, 2};
    struct ir_material *material = kit_material(&kit);
    material->diffuse_color.kind = IR_PAINT_CHECKER;
    material->diffuse_color.checker.colors[0] = (struct ir_color){.r = 0.1, .g = 0.2, .b = 0.3};
    material->diffuse_color.checker.colors[1] = (struct ir_color){.is_hex = true, .hex = 0xff0033};
    material->diffuse_color.checker.size = 2;
    struct ir_sphere *sphere = kit_sphere(&kit);
    sphere->center = (vec3){101, 4, 5};
    kit_use_material(&sphere->material, 0);
    struct ir_rectangle *rectangle = kit_rectangle(&kit);
    rectangle->edge_u = (vec3){3, 4, 0};
    kit_use_material(&rectangle->material, 0);
    struct ir_model *model = kit_model(&kit, tetra(&kit));
    model->scale = (vec3){2, -3, 4};
    model->rotation = (vec3){30, 60, 80};
    model->translation = (vec3){120, 3, 1};
    kit_model_material(&kit, 0, 0);
    flatten_ok(&kit, &flat);
    assert_true(flat.features & FEATURE_CHECKER);
    const struct gpu_word *words = flat.materials.words;
    assert_true(kit_float(words[1].x) == 0.1f && kit_float(words[3].x) == 1 && kit_float(words[3].z) == 0.2f);
    assert_true(kit_float(words[3].w) == 2);
    double factor = ldexp(1, flat.scale_exponent);
    vec3 own = own_of(&flat, 0, vec3_mul((vec3){1.5, 7.25, 3.5}, factor)); // center + (.5, .25, .5)
    assert_true(vec3_length(vec3_sub(own, (vec3){0.5, 0.25, 0.5})) < 1e-5);
    assert_vec3(word_vec3(&flat.bodies.words[BODY_WORDS + 1]), 5, 1, 0);
    for (int k = 0; k < 3; k++) {
        uint32_t item = kit_find_triangle(&flat, 2 + 3);
        vec3 expected = tetra_positions[tetra_faces[3][k ? 3 - k : 0]];
        assert_true(vec3_length(vec3_sub(own_of(&flat, 2, kit_vertex(&flat, item, k)), expected)) < 1e-5);
        assert_true(flags_of(&flat, item) & TRIANGLE_CHECKER);
    }
    flat_finish(&flat);
    kit_finish(&kit);
}

static void test_lights(void **state) {
    (void)state;
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit_sphere(&kit)->center = (vec3){0, 0, -7};
    kit_light(&kit, (vec3){8, 16, -4});
    struct view_light *fading = kit_light(&kit, (vec3){0, 8, 0});
    fading->inverse_square = true;
    struct view_light *far = kit_light(&kit, (vec3){3e15, 4e15, 0});
    far->emission = (vec3){1e30, 2e30, 4e30};
    far->inverse_square = true;
    flatten_ok(&kit, &flat);
    assert_int_equal(flat.scale_exponent, -3);
    const struct gpu_word *words = flat.lights.words;
    assert_vec3(word_vec3(&words[0]), 1, 2, -0.5);
    assert_int_equal(words[0].w, 0);
    assert_int_equal(words[3].w, LIGHT_INVERSE_SQUARE);
    assert_vec3(word_vec3(&words[4]), 1.0 / 64, 1.0 / 64, 1.0 / 64);
    assert_int_equal(words[6].w, LIGHT_DIRECTIONAL);
    assert_vec3(word_vec3(&words[6]), 0.6f, 0.8f, 0);
    assert_true(fabs(kit_float(words[7].z) / (4e30 / 25e30) - 1) < 1e-6);
    assert_int_equal(flat.features & (FEATURE_POINT_LIGHT | FEATURE_DIRECTION_LIGHT | FEATURE_INVERSE_SQUARE),
                     FEATURE_POINT_LIGHT | FEATURE_DIRECTION_LIGHT | FEATURE_INVERSE_SQUARE);
    flat_finish(&flat);
    kit_finish(&kit);
}

static void assert_doubles(const struct gpu_word *words, vec3 wanted) {
    double place[3];
    memcpy(place, words, sizeof place);
    const vec3 got = {place[0], place[1], place[2]};
    if (!(vec3_length(vec3_sub(got, wanted)) <= 1e-15 * vec3_length(wanted)))
        fail_msg("(%.17g %.17g %.17g) is not (%.17g %.17g %.17g)", got.x, got.y, got.z, wanted.x, wanted.y,
                 wanted.z);
}

// In double precision nothing on the way from a scene's numbers to a record is a float.
static void test_doubles_stay(void **state) {
    (void)state;
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit.is_double = true;
    struct ir_model *model = kit_model(&kit, tetra(&kit));
    model->smooth = true;
    model->rotation = (vec3){10, 20, 30};
    model->scale = (vec3){1.1, 0.7, 0.9};
    model->translation = (vec3){0.1, 0.2, 0.3};
    struct view_light *sun = kit_light(&kit, (vec3){0, 0, 0});
    sun->directional = true;
    sun->to_light = vec3_unit((vec3){1, 2, 3});
    kit_light(&kit, (vec3){1e15, 2e15, 3e15});
    kit_light(&kit, (vec3){0.1, 0.7, 0.3});
    flatten_ok(&kit, &flat);
    const double factor = ldexp(1, flat.scale_exponent);
    const struct ir_model *ir = &kit.scene.models.items[0];
    const affine3 map = transform_of(ir->scale, ir->rotation, ir->translation);
    for (uint32_t k = 0; k < 3; k++) {
        vec3 vertex = kit_vertex(&flat, kit_find_triangle(&flat, 3), (int)k);
        vec3 place = affine3_apply(map, tetra_positions[tetra_faces[3][k]]);
        vec3 wanted = vec3_mul(vec3_sub(place, flat.origin), factor);
        if (!(vec3_length(vec3_sub(vertex, wanted)) < 4e-15 * factor))
            fail_msg("corner %u: (%.17g %.17g %.17g) is not (%.17g %.17g %.17g)", (unsigned)k, vertex.x,
                     vertex.y, vertex.z, wanted.x, wanted.y, wanted.z);
    }
    const vec3 *of_mesh = mesh_smooth_normals(kit.assets.models[0].mesh, 180, &kit.arena);
    const mat3 turn = transform_for_normals(map.linear);
    for (uint32_t i = 0; i < 12; i++)
        assert_doubles(flat.normals.words + (size_t)flat.strides.normal * i,
                       vec3_unit(mat3_apply(turn, of_mesh[i])));
    const struct gpu_word *lights = flat.lights.words;
    assert_doubles(lights, vec3_unit((vec3){1, 2, 3}));
    assert_int_equal(lights[flat.strides.light + 1].z, LIGHT_DIRECTIONAL);
    assert_doubles(lights + flat.strides.light, vec3_unit((vec3){1, 2, 3}));
    assert_doubles(lights + 2 * (size_t)flat.strides.light,
                   vec3_mul(vec3_sub((vec3){0.1, 0.7, 0.3}, flat.origin), factor));
    flat_finish(&flat);
    kit_finish(&kit);
}

// Only materials that bodies have count.
static void test_features(void **state) {
    (void)state;
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit_material(&kit)->albedo = (struct ir_weights){0, 0, 0.5, 0.5};
    kit_material(&kit)->albedo = (struct ir_weights){0, 0.5, 0, 0};
    kit_light(&kit, (vec3){1, 2, 3});
    struct ir_sphere *sphere = kit_sphere(&kit);
    kit_use_material(&sphere->material, 1);
    flatten_ok(&kit, &flat);
    assert_int_equal(flat.features,
                     FEATURE_SPHERES | FEATURE_SPECULAR | FEATURE_SHADOWS | FEATURE_POINT_LIGHT);
    flat_finish(&flat);
    kit_use_material(&sphere->material, 0);
    kit.scene.trace.depth_limit = IR_DEPTH_BLACK;
    flatten_ok(&kit, &flat);
    assert_int_equal(flat.features,
                     FEATURE_SPHERES | FEATURE_REFLECTION | FEATURE_REFRACTION | FEATURE_DEPTH_BLACK);
    flat_finish(&flat);
    kit_finish(&kit);
}

static void test_background(void **state) {
    (void)state;
    uint8_t bytes[6] = {0, 51, 255, 1, 2, 128};
    uint16_t words[6] = {0, 13107, 65535, 1, 2, 32768};
    uint8_t shared[8] = {0, 64, 128, 129, 3, 4, 5, 138};
    struct picture picture = {2, 1, PICTURE_8, bytes, sizeof bytes, NULL, 0};
    struct kit kit;
    struct flat_scene flat;
    uint8_t device[8];
    float texels[8];
    kit_init(&kit);
    kit.assets.background = &picture;
    flatten_ok(&kit, &flat);
    assert_true(flat.features & FEATURE_BACKGROUND_IMAGE);
    assert_int_equal(flat.background_texels.bytes, 8);
    assert_false(flat.background_texels.is_float);
    flat_background(&flat, 0, 2, device);
    assert_memory_equal(device, "\0\x33\xFF\xFF\1\2\x80\xFF", 8);
    flat_background(&flat, 1, 2, device);
    assert_memory_equal(device, "\1\2\x80\xFF", 4);
    flat_finish(&flat);
    kit.scene.image.transfer = IR_TRANSFER_SRGB;
    flatten_ok(&kit, &flat);
    flat_background(&flat, 0, 2, texels);
    assert_true(flat.background_texels.is_float);
    assert_int_equal(flat.background_texels.bytes, 32);
    assert_true(texels[0] == 0 && texels[2] == 1 && fabsf(texels[1] - 0.0331048f) < 1e-6f);
    flat_finish(&flat);
    kit.scene.image.transfer = IR_TRANSFER_NONE;
    picture = (struct picture){2, 1, PICTURE_16, words, sizeof words, NULL, 0};
    flatten_ok(&kit, &flat);
    flat_background(&flat, 0, 2, texels);
    assert_true(texels[1] == 0.2f && texels[2] == 1 && texels[4] == (float)(1.0 / 65535));
    flat_finish(&flat);
    kit.scene.image.transfer = IR_TRANSFER_SRGB; // linear always
    picture = (struct picture){2, 1, PICTURE_RGBE, shared, sizeof shared, NULL, 0};
    flatten_ok(&kit, &flat);
    flat_background(&flat, 0, 2, texels);
    assert_true(texels[1] == 0.5f && texels[2] == 1 && texels[6] == 20 && texels[7] == 1);
    flat_finish(&flat);
    kit_finish(&kit);
}

// What only asks for sizes and features, as `inspect` does, needs no pixels.
static void test_background_without_pixels(void **state) {
    (void)state;
    struct picture picture = {2, 1, PICTURE_16, NULL, 12, NULL, 0};
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit.assets.background = &picture;
    flatten_ok(&kit, &flat);
    assert_true(flat.features & FEATURE_BACKGROUND_IMAGE);
    assert_int_equal(flat.background_texels.bytes, 32);
    flat_finish(&flat);
    kit_finish(&kit);
}

// ---- limits

static void test_limits(void **state) {
    (void)state;
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit_rectangle(&kit);
    kit_model(&kit, tetra(&kit));
    kit.limits.value[LIMIT_SCENE_TRIANGLES] = 6;
    flatten_ok(&kit, &flat);
    flat_finish(&flat);
    kit.limits.value[LIMIT_SCENE_TRIANGLES] = 5;
    assert_false(kit_flatten(&kit, &flat));
    assert_int_equal(kit.sink.count, 1);
    assert_int_equal(kit.sink.items[0].code, DIAG_LIMIT);
    assert_null(flat.triangles.words);
    kit_finish(&kit);
}

static void test_overflow(void **state) {
    (void)state;
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    for (int i = 0; i < 2; i++) {
        struct ir_model *model = kit_model(&kit, tetra(&kit));
        model->scale = (vec3){9e17, 1, 1};
        model->translation = (vec3){i ? 0 : 2e17, 0, 0};
    }
    assert_false(kit_flatten(&kit, &flat));
    assert_int_equal(kit.sink.count, 1);
    assert_int_equal(kit.sink.items[0].code, DIAG_TRANSFORM_OVERFLOW);
    kit_finish(&kit);
}

// A mesh that could not be loaded is a body without triangles.
static void test_missing_mesh(void **state) {
    (void)state;
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit_model(&kit, NULL)->smooth = true;
    kit_model(&kit, tetra(&kit));
    flatten_ok(&kit, &flat);
    assert_int_equal(flat.triangle_count, 4);
    assert_int_equal(flat.triangles.words[1].w, 1);
    assert_false(flat.features & FEATURE_SMOOTH);
    flat_finish(&flat);
    kit_finish(&kit);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_empty),        cmocka_unit_test(test_rectangle),
        cmocka_unit_test(test_mirrored),     cmocka_unit_test(test_turned_mesh),
        cmocka_unit_test(test_right_angles), cmocka_unit_test(test_dropped),
        cmocka_unit_test(test_slivers),      cmocka_unit_test(test_moved),
        cmocka_unit_test(test_scaled),       cmocka_unit_test(test_normals),
        cmocka_unit_test(test_checker),      cmocka_unit_test(test_lights),
        cmocka_unit_test(test_doubles_stay), cmocka_unit_test(test_features),
        cmocka_unit_test(test_background),   cmocka_unit_test(test_background_without_pixels),
        cmocka_unit_test(test_limits),       cmocka_unit_test(test_overflow),
        cmocka_unit_test(test_missing_mesh)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
