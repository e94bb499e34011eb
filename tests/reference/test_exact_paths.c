// Paths of the reference against closed forms: facing mirrors, a slab of glass, weights, total reflection;
// what is left where a budget of rays ends; and threads.

// For sched_setaffinity.
#define _GNU_SOURCE

#include "reference_kit.h"

#include <sched.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    SEGMENTS = 4096
};

static struct reference_settings follow_all(void) {
    return (struct reference_settings){.width = 64,
                                       .height = 64,
                                       .samples = 1,
                                       .max_depth = REFERENCE_MAX_DEPTH,
                                       .min_weight = REFERENCE_MIN_WEIGHT,
                                       .segments = 1000000};
}

static struct ir_material *weights(struct kit *kit, double diffuse, double reflection, double refraction,
                                   double index) {
    struct ir_material *material = kit_material(kit);
    material->albedo = (struct ir_weights){diffuse, 0, reflection, refraction};
    material->refractive_index = index;
    return material;
}

// ---- mirrors

static void mirror_at(struct kit *kit, double z) {
    struct ir_rectangle *r = kit_rectangle(kit);
    r->corner = (vec3){-1e3, -1e3, z};
    r->edge_u = (vec3){2e3, 0, 0};
    r->edge_v = (vec3){0, 2e3, 0};
    kit_use_material(&r->material, 0);
}

// Between mirrors at z = -1 and 1 each ray hits the other one, the n-th with weight r^n at 2n + 1 lengths.
static void check_mirrors(double reflection, uint32_t expected) {
    struct kit kit;
    struct reference_segment *log = calloc(SEGMENTS, sizeof *log);
    assert_non_null(log);
    kit_init(&kit);
    reference_kit_camera(&kit, (vec3){0, 0, 0});
    weights(&kit, 0, reflection, 0, 1);
    mirror_at(&kit, -1);
    mirror_at(&kit, 1);
    struct reference *r = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
    struct reference_settings settings = follow_all();
    uint32_t count = reference_log(r, &settings, 40, 20, 0, log, SEGMENTS, NULL);
    assert_int_equal(count, expected);
    vec3 first = log[0].direction;
    for (uint32_t i = 0; i < count; i++) {
        double reach = (2 * i + 1) / fabs(first.z);
        assert_int_equal(log[i].depth, i);
        assert_int_equal(log[i].body, i % 2);
        assert_int_equal(log[i].parent, i ? i - 1 : REFERENCE_NO_SEGMENT);
        assert_true(fabs(log[i].weight - pow(reflection, i)) <= 1e-12 * log[i].weight);
        assert_true(fabs(log[i].point.x - first.x * reach) < 1e-12 * reach);
        assert_true(fabs(log[i].point.y - first.y * reach) < 1e-12 * reach);
        assert_true(fabs(log[i].distance - (i ? 2 : 1) / fabs(first.z)) < 1e-12);
    }
    assert_true(fabs(log[count - 1].cut_weight - pow(reflection, count)) < 1e-15);
    reference_destroy(r);
    kit_finish(&kit);
    free(log);
}

static void test_mirrors_are_counted(void **state) {
    (void)state;
    check_mirrors(0.5, 20);  // 2^-19 is the last above 1e-6
    check_mirrors(0.9, 132); // 0.9^131
    check_mirrors(1, REFERENCE_MAX_DEPTH + 1);
}

// ---- glass

static const vec3 box_corners[8] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                                    {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
static const uint32_t box_faces[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                          {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};

// A slab from z = -2 to z = -1, wide, seen from 0: what leaves it is parallel to what came, displaced by
// d sin(a - b) / cos(b) with sin(a) = n sin(b).
static void check_slab(double index) {
    struct kit kit;
    struct reference_segment log[64];
    kit_init(&kit);
    reference_kit_camera(&kit, (vec3){0, 0, 0});
    weights(&kit, 0, 0, 1, index);
    struct ir_model *model = kit_model(&kit, kit_mesh(&kit, box_corners, 8, box_faces, 12, true));
    model->scale = (vec3){100, 100, 0.5};
    model->translation = (vec3){0, 0, -1.5};
    kit_model_material(&kit, 0, 0);
    struct reference *r = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
    struct reference_settings settings = follow_all();
    for (uint32_t x = 0; x < 64; x++) {
        uint32_t count = reference_log(r, &settings, x, 11, 0, log, 64, NULL);
        assert_int_equal(count, 3);
        assert_int_equal(log[2].body, HIT_NONE);
        double a = acos(-log[0].direction.z);
        double b = asin(sin(a) / index);
        double inside = acos(-log[1].direction.z);
        assert_true(log[0].enters && !log[1].enters);
        assert_true(fabs(inside - b) < 1e-12);
        double turned = vec3_length(vec3_sub(log[2].direction, log[0].direction));
        assert_true(turned < 1e-14);
        vec3 moved = vec3_sub(log[2].origin, log[0].point);
        double along = vec3_dot(moved, log[0].direction);
        double aside = vec3_length(vec3_sub(moved, vec3_mul(log[0].direction, along)));
        assert_true(fabs(aside - fabs(sin(a - b) / cos(b))) < 1e-12);
        assert_true(log[2].weight == 1);
    }
    reference_destroy(r);
    kit_finish(&kit);
}

static void test_slab_of_glass(void **state) {
    (void)state;
    check_slab(1.5);
    check_slab(1 + 1e-7);
    check_slab(4);
    check_slab(0.999);
}

// From inside a ball of glass rays beyond the critical angle are turned back with both weights.
static void test_total_reflection_to_a_billionth(void **state) {
    (void)state;
    struct kit kit;
    struct reference_segment log[16];
    kit_init(&kit);
    weights(&kit, 0, 0.25, 0.5, 1.5);
    kit_use_material(&kit_sphere(&kit)->material, 0);
    struct reference_settings settings = follow_all();
    settings.max_depth = 1;
    // At a distance s from the centre, straight to the side: the angle of incidence is asin(s).
    for (int side = -1; side <= 1; side += 2) {
        double angle = asin(1 / 1.5) + side * 1e-9;
        reference_kit_camera(&kit, (vec3){0, sin(angle), 0});
        kit.view.camera.tan_half_fov = 1e-30;
        struct reference *r = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
        uint32_t count = reference_log(r, &settings, 32, 32, 0, log, 16, NULL);
        assert_false(log[0].enters);
        assert_int_equal(log[0].total_reflection, side > 0);
        assert_int_equal(count, side > 0 ? 2 : 3);
        for (uint32_t i = 1; i < count; i++)
            assert_true(log[i].weight == (side > 0 ? 0.75 : log[i].kind == REFERENCE_REFLECTED ? 0.25 : 0.5));
        reference_destroy(r);
    }
    kit_finish(&kit);
}

// Every ray's weight is its parent's times one of the surface's weights.
static void test_weights_along_paths(void **state) {
    (void)state;
    struct kit kit;
    struct reference_segment *log = calloc(SEGMENTS, sizeof *log);
    assert_non_null(log);
    kit_init(&kit);
    reference_kit_camera(&kit, (vec3){0.1, 0.2, 3});
    weights(&kit, 0.1, 0.3, 0.6, 1.5);
    kit_use_material(&kit_sphere(&kit)->material, 0);
    struct reference *r = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
    struct reference_settings settings = follow_all();
    uint32_t count = reference_log(r, &settings, 30, 33, 0, log, SEGMENTS, NULL);
    assert_true(count > 20 && count < SEGMENTS);
    double sent = 0;
    double kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (i) {
            const struct reference_segment *parent = &log[log[i].parent];
            double factor = parent->total_reflection ? 0.9 : log[i].kind == REFERENCE_REFLECTED ? 0.3 : 0.6;
            assert_true(log[i].parent < i);
            assert_int_equal(log[i].depth, parent->depth + 1);
            assert_true(fabs(log[i].weight - parent->weight * factor) < 1e-15);
            assert_true(log[i].weight <= parent->weight); // the heaviest first
            kept += log[i].weight;
        }
        sent += log[i].body == HIT_NONE ? 0 : 0.9 * log[i].weight - log[i].cut_weight;
    }
    assert_true(fabs(sent - kept) < 1e-12);
    reference_destroy(r);
    kit_finish(&kit);
    free(log);
}

// ---- the budget

static void glass_pile(struct kit *kit) {
    kit_init(kit);
    reference_kit_camera(kit, (vec3){0, 0, 4});
    weights(kit, 0.2, 0.5, 0.5, 1.3);
    for (int i = 0; i < 6; i++) {
        struct ir_sphere *sphere = kit_sphere(kit);
        sphere->center = (vec3){0.9 * (i % 3) - 0.9, 0.8 * (i % 2) - 0.4, -0.5 * i};
        sphere->radius = 0.5;
        kit_use_material(&sphere->material, 0);
    }
    kit->scene.background.color = (struct ir_color){.r = 1, .g = 0.5, .b = 0.25};
    kit_light(kit, (vec3){3, 4, 5});
}

static struct reference_statistics picture(const struct reference *r, uint64_t segments, double *rgb) {
    struct reference_settings settings = follow_all();
    struct reference_statistics statistics;
    settings.width = 40;
    settings.height = 30;
    settings.samples = 2;
    settings.segments = segments;
    assert_int_equal(reference_render(r, &settings, rgb, NULL, &statistics), REFERENCE_DONE);
    return statistics;
}

static void test_what_is_left_bounds_the_error(void **state) {
    (void)state;
    enum {
        VALUES = 40 * 30 * 3
    };
    static const uint64_t budgets[] = {8, 64, 512};
    struct kit kit;
    double *best = calloc(2 * VALUES, sizeof *best);
    double *some = best + VALUES;
    glass_pile(&kit);
    struct reference *r = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
    struct reference_statistics whole = picture(r, 20000, best);
    double before = HUGE_VAL;
    for (size_t b = 0; b < sizeof budgets / sizeof budgets[0]; b++) {
        struct reference_statistics s = picture(r, budgets[b], some);
        double error = 0;
        for (size_t i = 0; i < VALUES; i++)
            error = fmax(error, fabs(some[i] - best[i]));
        print_message("%llu rays: error %.3g, bound %.3g\n", (unsigned long long)budgets[b], error, s.bound);
        assert_true(s.cut_by_segments > 0 && s.over_segments.pixels == 0);
        assert_true(s.cut_short.pixels > 0 && s.cut_short.pixels < 40 * 30);
        // The brightest thing in view is known once enough was followed.
        assert_true(error > 0 && error <= s.left_weight_most * whole.brightest);
        assert_true(s.left_weight_most < before);
        before = s.left_weight_most;
    }
    assert_true(whole.left_weight_most < before);
    reference_destroy(r);
    kit_finish(&kit);
    free(best);
}

// ---- threads, faults, cancelling

static void test_threads_cannot_show(void **state) {
    (void)state;
    enum {
        VALUES = 40 * 30 * 3
    };
    struct kit kit;
    cpu_set_t all, one;
    double *many = calloc(2 * VALUES, sizeof *many);
    double *alone = many + VALUES;
    glass_pile(&kit);
    kit_model(&kit, reference_kit_soup(&kit, 30000, 1));
    struct reference *r = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
    struct reference_statistics a = picture(r, 100, many);
    reference_destroy(r);
    assert_int_equal(sched_getaffinity(0, sizeof all, &all), 0);
    CPU_ZERO(&one);
    for (int i = 0; i < CPU_SETSIZE && CPU_COUNT(&one) == 0; i++)
        if (CPU_ISSET(i, &all))
            CPU_SET(i, &one);
    assert_int_equal(sched_setaffinity(0, sizeof one, &one), 0);
    r = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
    struct reference_statistics b = picture(r, 100, alone);
    reference_destroy(r);
    assert_int_equal(sched_setaffinity(0, sizeof all, &all), 0);
    assert_memory_equal(many, alone, VALUES * sizeof *many);
    assert_int_equal(a.shadow, b.shadow);
    assert_true(a.left_weight_mean == b.left_weight_mean && a.bound == b.bound);
    kit_finish(&kit);
    free(many);
}

static void test_values_that_are_not_finite_are_told(void **state) {
    (void)state;
    struct kit kit;
    double rgb[40 * 30 * 3];
    kit_init(&kit);
    reference_kit_camera(&kit, (vec3){0, 0, 4});
    weights(&kit, 1, 0, 0, 1);
    kit_use_material(&kit_sphere(&kit)->material, 0);
    kit_light(&kit, (vec3){0, 0, 5})->emission = (vec3){INFINITY, 0, 0};
    struct reference *r = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
    struct reference_statistics s = picture(r, 100, rgb);
    assert_true(s.not_finite.pixels > 10);
    assert_int_equal(s.not_finite.body, 0);
    const double *first = rgb + 3 * (s.not_finite.y * 40 + s.not_finite.x);
    assert_true(isnan(first[0]) && isnan(first[1]) && isnan(first[2]));
    assert_true(rgb[0] == 0);
    reference_destroy(r);
    kit_finish(&kit);
}

// Of two samples of one pixel the first runs out of rays at one body, the second meets infinite light at
// another: each fault names its own.
static void test_faults_of_one_pixel_keep_apart(void **state) {
    (void)state;
    struct kit kit;
    double rgb[3];
    struct reference_statistics s;
    struct reference_settings settings = follow_all();
    settings.width = settings.height = 1;
    settings.samples = 2;
    settings.segments = 1;
    settings.as_file = true;
    kit_init(&kit);
    reference_kit_camera(&kit, (vec3){0, 0, 0});
    kit.scene.trace.shadows = false;
    weights(&kit, 1, 0.5, 0, 1);
    weights(&kit, 1, 0, 0, 1);
    // The light stands between them: the nearer one turns its back to it.
    kit_light(&kit, (vec3){0, 0, -2})->emission = (vec3){INFINITY, 0, 0};
    struct reference *r = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
    double slopes[2];
    for (uint32_t i = 0; i < 2; i++) {
        vec3 direction = reference_camera_ray(r, &settings, 0, 0, i, NULL);
        slopes[i] = direction.x / -direction.z;
    }
    double middle = (slopes[0] + slopes[1]) / 2;
    reference_destroy(r);
    for (uint32_t i = 0; i < 2; i++) {
        struct ir_rectangle *rectangle = kit_rectangle(&kit);
        double depth = i ? 3 : 1;
        rectangle->corner = (vec3){middle * depth, -9, -depth};
        rectangle->edge_u = (vec3){copysign(9, slopes[i] - middle), 0, 0};
        rectangle->edge_v = (vec3){0, 18, 0};
        kit_use_material(&rectangle->material, i);
    }
    r = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
    assert_int_equal(reference_render(r, &settings, rgb, NULL, &s), REFERENCE_DONE);
    assert_int_equal(s.over_segments.pixels, 1);
    assert_int_equal(s.over_segments.body, 0);
    assert_int_equal(s.not_finite.pixels, 1);
    assert_int_equal(s.not_finite.body, 1);
    reference_destroy(r);
    kit_finish(&kit);
}

static bool stop(void *context, double fraction) {
    int *calls = context;
    assert_true(fraction > 0 && fraction <= 1);
    return ++*calls < 3;
}

static void test_cancelled(void **state) {
    (void)state;
    struct kit kit;
    double rgb[64 * 64 * 3];
    int calls = 0;
    struct reference_progress progress = {stop, &calls};
    struct reference_settings settings = follow_all();
    glass_pile(&kit);
    struct reference *r = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
    assert_int_equal(reference_render(r, &settings, rgb, &progress, NULL), REFERENCE_CANCELLED);
    assert_true(calls >= 3);
    reference_destroy(r);
    kit_finish(&kit);
}

// One pixel of thousands of rays: whoever cancels it is not kept waiting for its end.
static bool stop_at_once(void *context, double fraction) {
    double *last = context;
    *last = fraction;
    return false;
}

static void test_cancelled_inside_of_a_pixel(void **state) {
    (void)state;
    struct kit kit;
    double rgb[3], fraction;
    struct reference_progress progress = {stop_at_once, &fraction};
    struct reference_settings settings = follow_all();
    struct reference_statistics statistics;
    glass_pile(&kit);
    settings.width = settings.height = settings.samples = 1;
    struct reference *r = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
    assert_int_equal(reference_render(r, &settings, rgb, NULL, &statistics), REFERENCE_DONE);
    const uint64_t whole = statistics.reflected + statistics.refracted;
    assert_int_equal(reference_render(r, &settings, rgb, &progress, &statistics), REFERENCE_CANCELLED);
    print_message("%llu of %llu rays\n", (unsigned long long)(statistics.reflected + statistics.refracted),
                  (unsigned long long)whole);
    assert_true(whole > 64 && statistics.reflected + statistics.refracted <= 16);
    reference_destroy(r);
    kit_finish(&kit);
}

static void test_nothing_in_view(void **state) {
    (void)state;
    struct kit kit;
    double rgb[40 * 30 * 3];
    kit_init(&kit);
    reference_kit_camera(&kit, (vec3){0, 0, 0});
    kit.scene.background.color = (struct ir_color){.r = 0.5, .g = 0.25, .b = 2};
    struct reference *r = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
    struct reference_statistics s = picture(r, 100, rgb);
    assert_true(rgb[0] == 0.5 && rgb[1] == 0.25 && rgb[2] == 2);
    assert_int_equal(s.primary, 2 * 40 * 30);
    assert_true(s.brightest == 2 && s.bound == 0);
    reference_destroy(r);
    kit_finish(&kit);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mirrors_are_counted),
        cmocka_unit_test(test_slab_of_glass),
        cmocka_unit_test(test_total_reflection_to_a_billionth),
        cmocka_unit_test(test_weights_along_paths),
        cmocka_unit_test(test_what_is_left_bounds_the_error),
        cmocka_unit_test(test_threads_cannot_show),
        cmocka_unit_test(test_values_that_are_not_finite_are_told),
        cmocka_unit_test(test_faults_of_one_pixel_keep_apart),
        cmocka_unit_test(test_cancelled),
        cmocka_unit_test(test_cancelled_inside_of_a_pixel),
        cmocka_unit_test(test_nothing_in_view),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
