// Single rays of the reference: its two triangle tests against each other, its tree against no tree, and what
// must hold of any tracer: no ray slips through a closed mesh, none meets again the surface that it left.
#include "reference_kit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static bool same(const struct reference_hit *a, const struct reference_hit *b) {
    return a->body == b->body && a->triangle == b->triangle;
}

// On an edge or vertex, where several triangles are hit at one distance.
static bool is_tie(const struct reference_hit *hit) {
    return hit->body != HIT_NONE && (hit->b1 == 0 || hit->b2 == 0 || hit->b1 + hit->b2 == 1);
}

// ---- two tests

static uint32_t differing(struct kit *kit, uint32_t rays, uint64_t seed) {
    struct reference *a = reference_kit_make(kit, REFERENCE_WATERTIGHT, false);
    struct reference *b = reference_kit_make(kit, REFERENCE_MOELLER_TRUMBORE, false);
    uint64_t random = seed;
    uint32_t different = 0;
    uint32_t hits = 0;
    for (uint32_t i = 0; i < rays; i++) {
        struct reference_hit x, y;
        vec3 origin = vec3_mul(random_in_cube(&random), 3);
        vec3 direction = vec3_unit(vec3_sub(random_in_cube(&random), origin));
        reference_closest(a, origin, direction, INFINITY, &x);
        reference_closest(b, origin, direction, INFINITY, &y);
        hits += x.body != HIT_NONE;
        different += !same(&x, &y) && !is_tie(&x) && !is_tie(&y);
    }
    assert_true(hits > rays / 10);
    reference_destroy(a);
    reference_destroy(b);
    return different;
}

static void test_both_triangle_tests_agree(void **state) {
    (void)state;
    struct kit kit;
    kit_init(&kit);
    kit_model(&kit, kit_icosphere(&kit, 5, 0));
    kit_model(&kit, reference_kit_soup(&kit, 2000, 3));
    uint32_t different = differing(&kit, REFERENCE_TEST_RAYS, 1);
    print_message("%u of %u hits differ\n", different, REFERENCE_TEST_RAYS);
    assert_true(different <= (REFERENCE_TEST_RAYS + 999999) / 1000000);
    kit_finish(&kit);
}

// ---- the tree

static void check_tree(const struct reference *tree, const struct reference *plain, vec3 origin,
                       vec3 direction) {
    struct reference_hit x, y;
    reference_closest(tree, origin, direction, INFINITY, &x);
    reference_closest(plain, origin, direction, INFINITY, &y);
    assert_true(same(&x, &y));
    assert_true(x.t == y.t);
    double t_max = x.body == HIT_NONE ? 10 : 1.5 * x.t;
    assert_int_equal(reference_occluded(tree, origin, direction, t_max),
                     reference_occluded(plain, origin, direction, t_max));
    assert_int_equal(reference_occluded(tree, origin, direction, t_max), x.body != HIT_NONE);
}

static void test_tree_loses_nothing(void **state) {
    (void)state;
    struct kit kit;
    uint64_t random = 5;
    kit_init(&kit);
    kit_model(&kit, reference_kit_soup(&kit, 300, 7));
    for (int i = 0; i < 5; i++) {
        struct ir_sphere *sphere = kit_sphere(&kit);
        sphere->center = random_in_cube(&random);
        sphere->radius = exp2(-5 * random_unit(&random));
    }
    kit_rectangle(&kit);
    struct reference *tree = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
    struct reference *quick = reference_kit_make_quickly(&kit);
    struct reference *plain = reference_kit_make(&kit, REFERENCE_WATERTIGHT, true);
    for (uint32_t i = 0; i < REFERENCE_TEST_RAYS / 20; i++) {
        vec3 origin = vec3_mul(random_in_cube(&random), 2);
        const vec3 direction = random_direction(&random);
        check_tree(tree, plain, origin, direction);
        check_tree(quick, plain, origin, direction);
        // Along an axis, where a slab is never left.
        double sign = i & 1 ? 1 : -1;
        check_tree(tree, plain, origin,
                   (vec3){i % 3 == 0 ? sign : 0, i % 3 == 1 ? sign : -0.0, i % 3 == 2 ? sign : 0});
    }
    reference_destroy(tree);
    reference_destroy(quick);
    reference_destroy(plain);
    kit_finish(&kit);
}

// ---- closed meshes

struct placed {
    double scale;
    vec3 offset;
    vec3 camera;
};

static struct reference *place_ball(struct kit *kit, const struct placed *placed, int levels) {
    kit_init(kit);
    struct ir_model *model = kit_model(kit, kit_icosphere(kit, levels, 0));
    model->scale = (vec3){placed->scale, placed->scale, placed->scale};
    model->translation = placed->offset;
    reference_kit_camera(kit, placed->camera);
    return reference_kit_make(kit, REFERENCE_WATERTIGHT, false);
}

static vec3 on_edge(const struct mesh *mesh, uint64_t *random, bool vertex) {
    const struct mesh_triangle *t = &mesh->triangles[random_below(random, mesh->triangle_count)];
    double part = vertex ? 0 : random_unit(random);
    uint32_t k = random_below(random, 3);
    return vec3_add(vec3_mul(mesh->positions[t->corners[k]], 1 - part),
                    vec3_mul(mesh->positions[t->corners[(k + 1) % 3]], part));
}

static void test_no_ray_slips_through(void **state) {
    (void)state;
    static const struct placed places[] = {{1, {0, 0, 0}, {0, 0, 3}},
                                           {1e-3, {1e3, 0, 0}, {1e3, 0, 1}},
                                           {1e3, {0, 1e5, 0}, {0, 0, 0}},
                                           {1, {1e6, -1e6, 1e6}, {0, 0, 0}},
                                           {1, {1e9, 0, 1e9}, {1e9, 0, 1e9}}};
    for (size_t p = 0; p < sizeof places / sizeof places[0]; p++) {
        struct kit kit;
        uint64_t random = p + 1;
        struct reference *r = place_ball(&kit, &places[p], 3);
        uint32_t misses = 0;
        for (uint32_t i = 0; i < REFERENCE_TEST_RAYS / 5; i++) {
            struct reference_hit hit;
            vec3 inside = vec3_mul(random_direction(&random), 0.9 * random_unit(&random));
            vec3 aim = on_edge(kit.assets.models[0].mesh, &random, i & 1);
            vec3 origin = vec3_add(places[p].offset, vec3_mul(inside, places[p].scale));
            reference_closest(r, origin, vec3_unit(vec3_sub(aim, inside)), INFINITY, &hit);
            misses += hit.body == HIT_NONE;
        }
        assert_int_equal(misses, 0);
        reference_destroy(r);
        kit_finish(&kit);
    }
}

// A ray that leaves a convex mesh outward meets nothing; inward it meets the other side.
static void test_starts_are_on_their_side(void **state) {
    (void)state;
    static const struct placed places[] = {{1, {0, 0, 0}, {0, 0, 3}},
                                           {1e-6, {0, 0, 0}, {0, 0, 1e-4}},
                                           {1e6, {0, 0, 0}, {0, 0, 1e8}},
                                           {1, {1e2, 0, 0}, {0, 0, 0}},
                                           {1, {1e6, 0, 0}, {0, 0, 0}}};
    for (size_t p = 0; p < sizeof places / sizeof places[0]; p++) {
        struct kit kit;
        uint64_t random = p + 1;
        struct reference *r = place_ball(&kit, &places[p], 4);
        uint32_t left = 0;
        uint32_t again = 0;
        uint32_t lost = 0;
        for (uint32_t i = 0; i < REFERENCE_TEST_RAYS / 10; i++) {
            struct reference_hit hit, next;
            vec3 from = vec3_mul(random_direction(&random), 3);
            vec3 aim = on_edge(kit.assets.models[0].mesh, &random, i % 3 == 0);
            vec3 origin = vec3_add(places[p].offset, vec3_mul(from, places[p].scale));
            reference_closest(r, origin, vec3_unit(vec3_sub(aim, from)), INFINITY, &hit);
            // At the outline a corner may be missed, or belong to a face that is seen from behind.
            if (hit.body == HIT_NONE || !hit.enters)
                continue;
            left++;
            vec3 out = random_direction(&random);
            out = vec3_dot(out, hit.geometric) < 0 ? vec3_neg(out) : out;
            reference_closest(r, hit.start_back, out, INFINITY, &next);
            again += next.body != HIT_NONE && vec3_dot(out, hit.geometric) > 1e-6;
            vec3 radius = vec3_unit(vec3_sub(hit.point, places[p].offset));
            // Well inward: beside a corner's own face its neighbours are the outside.
            vec3 inward = vec3_neg(vec3_unit(vec3_add(radius, vec3_mul(out, 0.5))));
            reference_closest(r, hit.start_through, inward, INFINITY, &next);
            lost += next.body == HIT_NONE || next.triangle == hit.triangle;
        }
        print_message("scale %g: of %u that left, %u met again, %u lost\n", places[p].scale, left, again,
                      lost);
        assert_true(left > REFERENCE_TEST_RAYS / 40);
        assert_int_equal(again, 0);
        assert_int_equal(lost, 0);
        reference_destroy(r);
        kit_finish(&kit);
    }
}

// ---- spheres

static void test_outline_of_a_sphere(void **state) {
    (void)state;
    static const double distances[] = {1.001, 3, 1e3, 1e6};
    for (size_t i = 0; i < sizeof distances / sizeof distances[0]; i++) {
        struct kit kit;
        kit_init(&kit);
        kit_sphere(&kit)->center = (vec3){0, 0, -distances[i]};
        struct reference *r = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
        uint64_t random = i;
        for (int k = 0; k < 2000; k++) {
            double turn = 6.283185307179586 * random_unit(&random);
            double sine = 1 / distances[i];
            // The part of the radius by which a ray passes inside or outside.
            for (double part = 1e-9; part < 0.1; part *= 10)
                for (int side = -1; side <= 1; side += 2) {
                    struct reference_hit hit;
                    double s = sine * (1 + side * part);
                    if (s >= 1)
                        continue;
                    vec3 d = {s * cos(turn), s * sin(turn), -sqrt(1 - s * s)};
                    reference_closest(r, (vec3){0, 0, 0}, d, INFINITY, &hit);
                    assert_int_equal(hit.body != HIT_NONE, side < 0);
                }
        }
        reference_destroy(r);
        kit_finish(&kit);
    }
}

// Faces in one plane, whatever the plane and however they are cut: rounding must not choose.
static void test_equal_distance_goes_to_the_lower_body(void **state) {
    (void)state;
    uint64_t random = 9;
    for (int turn = 0; turn < 20; turn++) {
        struct kit kit;
        kit_init(&kit);
        vec3 u = random_direction(&random);
        vec3 v = random_direction(&random);
        vec3 corner = vec3_mul(random_in_cube(&random), 10);
        for (int i = 0; i < 3; i++) {
            struct ir_rectangle *r = kit_rectangle(&kit);
            // One plane, but for the rounding of its corners.
            r->corner = vec3_sub(corner, vec3_add(vec3_mul(u, 0.7 * i), vec3_mul(v, 0.3 * i)));
            r->edge_u = vec3_mul(u, 3 + i);
            r->edge_v = vec3_mul(v, 3 + 0.37 * i);
        }
        struct reference *r = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
        for (int i = 0; i < 1000; i++) {
            struct reference_hit hit;
            vec3 in_plane =
                vec3_add(vec3_mul(u, 0.1 + random_unit(&random)), vec3_mul(v, 0.1 + random_unit(&random)));
            vec3 aim = vec3_add(corner, in_plane);
            vec3 origin = vec3_add(corner, vec3_mul(random_in_cube(&random), 10));
            reference_closest(r, origin, vec3_sub(aim, origin), INFINITY, &hit);
            assert_int_equal(hit.body, 0);
            // A light on the surface itself has nothing before it.
            assert_false(reference_occluded(r, origin, vec3_sub(aim, origin), 1));
        }
        reference_destroy(r);
        kit_finish(&kit);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_both_triangle_tests_agree),
        cmocka_unit_test(test_tree_loses_nothing),
        cmocka_unit_test(test_no_ray_slips_through),
        cmocka_unit_test(test_starts_are_on_their_side),
        cmocka_unit_test(test_outline_of_a_sphere),
        cmocka_unit_test(test_equal_distance_goes_to_the_lower_body),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
