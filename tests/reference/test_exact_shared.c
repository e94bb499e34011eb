// Bodies that share their mesh's triangles in the reference: the same hits and the same pictures, bit for
// bit, as with triangles of their own; and when that is done.
#include "reference/reference_internal.h"
#include "reference_kit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum {
    FIGURES = 8,
    SHEET_SIDE = 10, // squares
    WIDTH = 48,
    HEIGHT = 36
};

static struct reference *make(struct kit *kit, enum reference_sharing sharing, bool as_single,
                              bool few_rays) {
    const struct reference_input input = {.scene = &kit->resolved,
                                          .view = &kit->view,
                                          .sharing = sharing,
                                          .as_single = as_single,
                                          .few_rays = few_rays};
    struct reference *r = reference_create(&input);
    assert_non_null(r);
    return r;
}

static vec3 random_scale(uint64_t *random) {
    const double size = exp2(2 * random_unit(random) - 1.5);
    const double flat = exp2(-6 * random_unit(random)), mirrored = random_below(random, 2) ? 1 : -1;
    return (vec3){size, size * flat, size * mirrored};
}

static void put(struct ir_model *model, uint64_t *random, vec3 away) {
    model->scale = random_scale(random);
    model->rotation = vec3_mul(random_in_cube(random), 180);
    model->translation = vec3_add(away, vec3_mul(random_in_cube(random), 2));
    model->smooth = random_below(random, 2);
}

// As loading leaves it.
static struct mesh *bounded(struct mesh *mesh) {
    mesh->lower = mesh->upper = mesh->positions[0];
    for (uint32_t i = 1; i < mesh->position_count; i++) {
        mesh->lower = vec3_least(mesh->lower, mesh->positions[i]);
        mesh->upper = vec3_greatest(mesh->upper, mesh->positions[i]);
    }
    return mesh;
}

// A flat square, whose boxes end where its triangles do.
static struct mesh *sheet(struct kit *kit) {
    vec3 positions[(SHEET_SIDE + 1) * (SHEET_SIDE + 1)];
    uint32_t faces[2 * SHEET_SIDE * SHEET_SIDE][3], count = 0;
    for (uint32_t i = 0; i < (SHEET_SIDE + 1) * (SHEET_SIDE + 1); i++)
        positions[i] = (vec3){0.2 * (i % (SHEET_SIDE + 1)) - 1, 0.2 * (i / (SHEET_SIDE + 1)) - 1, 0};
    for (uint32_t i = 0; i < SHEET_SIDE * SHEET_SIDE; i++) {
        const uint32_t at = i / SHEET_SIDE * (SHEET_SIDE + 1) + i % SHEET_SIDE, above = at + SHEET_SIDE + 1;
        memcpy(faces[count++], (uint32_t[]){at, at + 1, above + 1}, sizeof faces[0]);
        memcpy(faces[count++], (uint32_t[]){at, above + 1, above}, sizeof faces[0]);
    }
    return kit_mesh(kit, positions, (SHEET_SIDE + 1) * (SHEET_SIDE + 1), (const uint32_t(*)[3])faces, count,
                    false);
}

// Glass balls, sheets and a soup of triangles, turned, flattened and mirrored, around `away`.
static void fill(struct kit *kit, vec3 away, vec3 camera, uint64_t seed) {
    uint64_t random = seed;
    kit_init(kit);
    struct ir_material *glass = kit_material(kit);
    glass->albedo = (struct ir_weights){0.2, 0.2, 0.3, 0.5};
    glass->refractive_index = 1.3;
    struct mesh *ball = bounded(kit_icosphere(kit, 3, 0));
    struct mesh *soup = bounded(reference_kit_soup(kit, 300, seed));
    struct mesh *meshes[] = {ball, bounded(sheet(kit)), soup};
    for (uint32_t i = 0; i < FIGURES; i++) {
        put(kit_model(kit, meshes[i % 3]), &random, away);
        if (i % 4 != 3)
            kit_model_material(kit, i, 0);
    }
    kit_sphere(kit)->center = vec3_add(away, random_in_cube(&random));
    kit_rectangle(kit)->corner = vec3_add(away, (vec3){-1, -1, -2});
    kit_light(kit, vec3_add(away, (vec3){3, 5, 4}));
    reference_kit_camera(kit, vec3_add(away, camera));
    kit_resolve(kit);
}

static void check_rays(const struct reference *a, const struct reference *b, vec3 away, uint32_t count) {
    uint64_t random = 11;
    uint32_t hits = 0;
    for (uint32_t i = 0; i < count; i++) {
        struct reference_hit x, y;
        const vec3 origin = vec3_add(away, vec3_mul(random_in_cube(&random), 4));
        const vec3 axis = {i % 3 == 0, i % 3 == 1, i % 3 == 2};
        const vec3 to = vec3_add(away, vec3_mul(random_in_cube(&random), 2));
        const vec3 direction = i % 5 ? vec3_unit(vec3_sub(to, origin)) : axis;
        memset(&x, 0, sizeof x);
        memset(&y, 0, sizeof y);
        reference_closest(a, origin, direction, INFINITY, &x);
        reference_closest(b, origin, direction, INFINITY, &y);
        assert_memory_equal(&x, &y, sizeof x);
        const double far = x.body == HIT_NONE ? 10 : x.t * (i % 2 ? 2 : 0.9);
        assert_int_equal(reference_occluded(a, origin, direction, far),
                         reference_occluded(b, origin, direction, far));
        hits += x.body != HIT_NONE;
    }
    assert_true(hits > count / 10 && hits < count);
}

static void check_pictures(const struct reference *a, const struct reference *b) {
    static double x[3 * WIDTH * HEIGHT], y[3 * WIDTH * HEIGHT];
    const struct reference_settings settings = {.width = WIDTH,
                                                .height = HEIGHT,
                                                .samples = 1,
                                                .max_depth = 6,
                                                .min_weight = 1e-3,
                                                .segments = 10000};
    struct reference_statistics of_a, of_b;
    assert_int_equal(reference_render(a, &settings, x, NULL, &of_a), REFERENCE_DONE);
    assert_int_equal(reference_render(b, &settings, y, NULL, &of_b), REFERENCE_DONE);
    assert_memory_equal(x, y, sizeof x);
    assert_int_equal(of_a.refracted, of_b.refracted);
    assert_int_equal(of_a.shadow, of_b.shadow);
    assert_true(of_a.refracted > WIDTH);
}

static void compare(vec3 away, vec3 camera, const struct reference_input *how, uint64_t seed) {
    struct kit kit;
    fill(&kit, away, camera, seed);
    struct reference *copies = make(&kit, REFERENCE_COPIES, how->as_single, how->few_rays);
    struct reference *shared = make(&kit, REFERENCE_SHARED, how->as_single, how->few_rays);
    assert_int_equal(copies->instance_count, 0);
    assert_int_equal(shared->instance_count, FIGURES);
    check_rays(copies, shared, away, REFERENCE_TEST_RAYS / 50);
    check_pictures(copies, shared);
    reference_destroy(copies);
    reference_destroy(shared);
    kit_finish(&kit);
}

static void test_same_as_copies(void **state) {
    static const struct reference_input in[] = {{0}, {.few_rays = true}, {.as_single = true}};
    (void)state;
    for (uint64_t i = 0; i < 3; i++) {
        compare((vec3){0, 0, 0}, (vec3){0.1, 0.2, 4}, &in[i], 3 + i);
        compare((vec3){1000, -300, 7e5}, (vec3){0.1, 0.2, 4}, &in[i], 13 + i);
    }
}

// What comes of `count` models of 81 920 triangles.
static void check_choice(uint32_t count, bool few_rays, uint32_t instances) {
    struct kit kit;
    kit_init(&kit);
    struct mesh *ball = bounded(kit_icosphere(&kit, 6, 0));
    for (uint32_t i = 0; i < count; i++)
        kit_model(&kit, ball)->translation.x = 3 * i;
    kit_resolve(&kit);
    struct reference *r = make(&kit, REFERENCE_CHEAPER, false, few_rays);
    assert_int_equal(r->instance_count, instances);
    assert_int_equal(r->primitive_count, instances ? instances : count * ball->triangle_count);
    reference_destroy(r);
    kit_finish(&kit);
}

static void test_shared_where_it_saves(void **state) {
    (void)state;
    check_choice(1, true, 0);
    check_choice(2, true, 0);
    check_choice(3, true, 3);
    check_choice(3, false, 0);
}

// A map without an inverse that is good enough.
static void test_too_flat(void **state) {
    (void)state;
    struct kit kit;
    kit_init(&kit);
    struct mesh *ball = bounded(kit_icosphere(&kit, 3, 0));
    kit_model(&kit, ball)->scale = (vec3){1, 1e-15, 1};
    kit.scene.models.items[0].rotation = (vec3){10, 20, 30};
    kit_model(&kit, ball);
    reference_kit_camera(&kit, (vec3){0, 0, 4});
    kit_resolve(&kit);
    struct reference *copies = make(&kit, REFERENCE_COPIES, false, false);
    struct reference *shared = make(&kit, REFERENCE_SHARED, false, false);
    assert_int_equal(shared->instance_count, 1);
    check_rays(copies, shared, (vec3){0, 0, 0}, 2000);
    reference_destroy(copies);
    reference_destroy(shared);
    kit_finish(&kit);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_as_copies),
                                       cmocka_unit_test(test_shared_where_it_saves),
                                       cmocka_unit_test(test_too_flat)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
