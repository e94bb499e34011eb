// Geometry that is shared with the flat scene of before is what flattening would have made; it is shared if
// nothing changed that it depends on, and then only.
#include "flat_kit.h"
#include "shaders/records.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// A scene and its mesh; `mesh` NULL: it makes one.
static struct mesh *build(struct kit *kit, struct mesh *mesh) {
    kit_init(kit);
    mesh = mesh ? mesh : kit_icosphere(kit, 2, 0);
    kit->origin = (vec3){0, 0, 5};
    kit_material(kit)->diffuse_color.color = (struct ir_color){.r = 1};
    kit_material(kit);
    struct ir_sphere *sphere = kit_sphere(kit);
    sphere->center = (vec3){0, 2, -3};
    kit_use_material(&sphere->material, 0);
    kit_rectangle(kit)->corner = (vec3){-1, -2, -4};
    for (uint32_t i = 0; i < 2; i++) {
        struct ir_model *model = kit_model(kit, mesh);
        model->smooth = i == 1;
        model->translation = (vec3){3.0 * i, 0, -6};
        kit_model_material(kit, i, i);
    }
    kit_light(kit, (vec3){5, 5, 5});
    return mesh;
}

static bool flatten_after(struct kit *kit, const struct flat_scene *before, enum flat_sharing sharing,
                          struct bvh_keep *keep, struct flat_scene *flat) {
    const struct flat_input input = {.scene = &kit->resolved,
                                     .view = &kit->view,
                                     .origin = kit->origin,
                                     .is_double = kit->is_double,
                                     .sharing = sharing,
                                     .keep = keep,
                                     .before = before,
                                     .limits = &kit->limits,
                                     .sink = &kit->sink};
    return flatten(&input, flat);
}

static void check_array(const struct flat_array *a, const struct flat_array *b) {
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->words, b->words, a->count * sizeof *a->words);
}

static void check_equal(const struct flat_scene *a, const struct flat_scene *b) {
    check_array(&a->triangle_nodes, &b->triangle_nodes);
    check_array(&a->triangles, &b->triangles);
    check_array(&a->normals, &b->normals);
    check_array(&a->sphere_nodes, &b->sphere_nodes);
    check_array(&a->spheres, &b->spheres);
    check_array(&a->bodies, &b->bodies);
    check_array(&a->materials, &b->materials);
    check_array(&a->lights, &b->lights);
    check_array(&a->paints, &b->paints);
    assert_int_equal(a->instance_count, b->instance_count);
    if (a->instance_count)
        check_array(&a->instances, &b->instances);
    assert_memory_equal(&a->strides, &b->strides, sizeof a->strides);
    assert_memory_equal(a->first_triangle, b->first_triangle, a->body_count * sizeof *a->first_triangle);
    assert_true(a->features == b->features && a->scale_exponent == b->scale_exponent &&
                a->top_nodes == b->top_nodes && a->instance_table == b->instance_table &&
                a->instance_shift == b->instance_shift && a->use_count == b->use_count &&
                a->sphere_count == b->sphere_count && a->triangle_count == b->triangle_count &&
                a->shown_triangles == b->shown_triangles && a->dropped_triangles == b->dropped_triangles &&
                a->triangle_depth == b->triangle_depth && a->sphere_depth == b->sphere_depth &&
                a->body_count == b->body_count);
}

static void change_nothing(struct kit *kit) {
    (void)kit;
}
static void change_color(struct kit *kit) {
    kit->scene.materials.items[0].diffuse_color.color = (struct ir_color){.g = 0.5, .b = 1};
}
static void change_weights(struct kit *kit) {
    kit->scene.materials.items[1].albedo = (struct ir_weights){0.1, 0.2, 0.3, 0.4};
}
static void change_light(struct kit *kit) {
    kit->view.lights[0].position.x = 7;
    kit_light(kit, (vec3){-5, 5, 5});
}
static void change_place(struct kit *kit) {
    kit->scene.models.items[1].translation.x += 0.25;
}
static void change_scale(struct kit *kit) {
    kit->scene.models.items[0].scale = (vec3){2, 2, 2};
}
static void change_center(struct kit *kit) {
    kit->scene.spheres.items[0].center.y += 0.5;
}
static void change_radius(struct kit *kit) {
    kit->scene.spheres.items[0].radius = 0.5;
}
static void change_edge(struct kit *kit) {
    kit->scene.rectangles.items[0].edge_u.x = 2;
}
static void change_material(struct kit *kit) {
    kit_model_material(kit, 0, 1);
}
static void change_smooth(struct kit *kit) {
    kit->scene.models.items[0].smooth = true;
}
static void change_origin(struct kit *kit) {
    kit->origin.x = 0.5;
}
static void change_bodies(struct kit *kit) {
    kit_sphere(kit)->center = (vec3){4, 4, -4};
}
static void change_checker(struct kit *kit) {
    kit->scene.materials.items[0].diffuse_color.kind = IR_PAINT_CHECKER;
    kit->scene.materials.items[0].diffuse_color.checker.size = 1;
}
static void change_limit(struct kit *kit) {
    kit->limits.value[LIMIT_SCENE_TRIANGLES]--;
}

static void compare(struct kit *old, struct mesh *mesh, enum flat_sharing sharing,
                    void (*change)(struct kit *), bool shares) {
    struct flat_scene before, now, fresh;
    struct kit kit;
    struct bvh_keep *keep = bvh_keep_create();
    assert_non_null(keep);
    assert_true(flatten_after(old, NULL, sharing, keep, &before));
    bvh_keep_sweep(keep);
    const uint32_t built = bvh_keep_built(keep);
    build(&kit, mesh);
    kit.is_double = old->is_double;
    change(&kit);
    kit_resolve(&kit);
    assert_true(flatten_after(&kit, &before, sharing, keep, &now));
    assert_true(flatten_after(&kit, NULL, sharing, NULL, &fresh));
    check_equal(&now, &fresh);
    assert_int_equal(shares, now.triangles.words == before.triangles.words);
    assert_int_equal(shares, now.shares);
    // A tree that was not asked for because its nodes are shared is still known.
    bvh_keep_sweep(keep);
    struct flat_scene again;
    if (shares) {
        assert_int_equal(built, bvh_keep_built(keep));
        assert_true(flatten_after(&kit, NULL, sharing, keep, &again));
        assert_int_equal(built, bvh_keep_built(keep));
        flat_finish(&again);
    }
    // Whoever ends first: the new one has what both shared.
    flat_take(&now, &before);
    flat_finish(&before);
    check_equal(&now, &fresh);
    flat_finish(&now);
    flat_finish(&fresh);
    bvh_keep_destroy(keep);
    kit_finish(&kit);
}

static void compare_all(bool is_double, enum flat_sharing sharing) {
    static const struct {
        void (*change)(struct kit *kit);
        bool shares;
    } rows[] = {{change_nothing, true},   {change_color, true},   {change_weights, true},
                {change_light, true},     {change_place, false},  {change_scale, false},
                {change_center, false},   {change_radius, false}, {change_edge, false},
                {change_smooth, false},   {change_bodies, false}, {change_limit, false},
                {change_material, false}, {change_checker, false}};
    struct kit old;
    struct mesh *mesh = build(&old, NULL);
    old.is_double = is_double;
    kit_resolve(&old);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        compare(&old, mesh, sharing, rows[i].change, rows[i].shares);
    // In double precision it is the bodies' place that counts.
    compare(&old, mesh, sharing, change_origin, false);
    kit_finish(&old);
}

static void test_single(void **state) {
    (void)state;
    compare_all(false, FLAT_COPIES);
}

static void test_double(void **state) {
    (void)state;
    compare_all(true, FLAT_COPIES);
}

static void test_instances(void **state) {
    (void)state;
    compare_all(false, FLAT_SHARED);
}

// Another precision, or another way of sharing, makes all anew; a flat scene that ends without having taken
// what it shares leaves it.
static void test_others(void **state) {
    (void)state;
    struct kit kit;
    struct flat_scene before, now;
    build(&kit, NULL);
    kit_resolve(&kit);
    assert_true(flatten_after(&kit, NULL, FLAT_COPIES, NULL, &before));
    assert_true(flatten_after(&kit, &before, FLAT_SHARED, NULL, &now));
    assert_false(now.shares);
    flat_finish(&now);
    kit.is_double = true;
    assert_true(flatten_after(&kit, &before, FLAT_COPIES, NULL, &now));
    assert_false(now.shares);
    flat_finish(&now);
    kit.is_double = false;
    assert_true(flatten_after(&kit, &before, FLAT_COPIES, NULL, &now));
    assert_true(now.shares);
    flat_finish(&now);
    assert_true(flatten_after(&kit, &before, FLAT_COPIES, NULL, &now));
    check_equal(&now, &before);
    flat_finish(&now);
    flat_finish(&before);
    kit_finish(&kit);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_single), cmocka_unit_test(test_double),
                                       cmocka_unit_test(test_instances), cmocka_unit_test(test_others)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
