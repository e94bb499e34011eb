// Rays inside and outside closed convex bodies of few and of many triangles: mirrored, refracted and shadow
// rays that leave a face from anywhere, and from close to its edges and corners. None leaves the body through
// its faces, and none hits the face that it leaves or one beside it from behind.
//
// What a ray from a face must hit is known: from inside, a face that it goes out through; outside, nothing.
// Usage: test_leaks [few | full]: `full` sends a hundred million rays in each body and precision; `few` a
// sixteenth of those sent without it.
#include "core/parallel.h"
#include "flat_kit.h"
#include "probe_kit.h"
#include "random.h"
#include "shape_kit.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    PIECE = 4096,
};

static uint32_t batch_rays = PROBE_RAYS;
static uint64_t batches = 1;

// ---- bodies

// Convex, around the origin, about 2 units wide.
enum {
    CUBE,
    TETRAHEDRON,
    WEDGE,
    PRISM,
    ROOM,
    GEM,
    ICOSPHERE,
    FINE_ICOSPHERE,
    SHAPES
};
static const char *const names[SHAPES] = {"cube", "tetrahedron", "wedge",     "prism",
                                          "room", "gem",         "icosphere", "icosphere of 1280"};

static void make_tetrahedron(struct kit *kit, struct shape *s) {
    static const vec3 corners[4] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    shape_init(kit, s, corners, 4, 4);
    shape_add(s, 0, 1, 2);
    shape_add(s, 0, 1, 3);
    shape_add(s, 0, 2, 3);
    shape_add(s, 1, 2, 3);
}

// Two large faces that meet at 11 degrees.
static void make_wedge(struct kit *kit, struct shape *s) {
    static const vec3 corners[6] = {{-1, 0, -1}, {-1, 0, 1},    {1, 0.2, -1},
                                    {1, 0.2, 1}, {1, -0.2, -1}, {1, -0.2, 1}};
    static const uint32_t quads[3][4] = {{0, 1, 3, 2}, {0, 1, 5, 4}, {2, 3, 5, 4}};
    shape_init(kit, s, corners, 6, 8);
    for (int i = 0; i < 3; i++)
        shape_add_quad(s, quads[i]);
    shape_add(s, 0, 2, 4);
    shape_add(s, 1, 3, 5);
}

static struct mesh *make_mesh(struct kit *kit, int which) {
    struct shape shape;
    if (which == ICOSPHERE || which == FINE_ICOSPHERE)
        return kit_icosphere(kit, which == ICOSPHERE ? 1 : 3, 0);
    if (which == CUBE)
        shape_box(kit, &shape, (vec3){1, 1, 1});
    else if (which == TETRAHEDRON)
        make_tetrahedron(kit, &shape);
    else if (which == WEDGE)
        make_wedge(kit, &shape);
    else if (which == PRISM)
        shape_drum(kit, &shape, &(struct drum){3, {1, 1}, {-1, 1}});
    else if (which == ROOM)
        shape_box(kit, &shape, (vec3){1.6, 0.5, 1});
    else
        shape_drum(kit, &shape, &(struct drum){8, {0.15, 1}, {-0.8, 0.2}});
    return shape_mesh(kit, &shape);
}

// ---- rays

struct aim {
    const struct probe *probe;
    const struct flat_scene *flat;
    vec3 center; // flat
    double size; // flat
    uint64_t batch;
    struct probe_fixture *f;
    uint64_t counts[PROBE_RAYS / PIECE][4];
};

// On a triangle: anywhere, or as close to an edge or a corner as 1e-9 of its size.
static vec3 choose_target(const struct aim *aim, uint64_t *state) {
    const uint32_t item = (uint32_t)(random_bits(state) % aim->flat->triangle_count);
    double b[3] = {random_unit(state), random_unit(state), random_unit(state)};
    const uint64_t kind = random_bits(state) % 4;
    for (uint64_t k = 0; k < kind && k < 2; k++)
        b[k] = pow(10, -9 * random_unit(state));
    const double sum = b[0] + b[1] + b[2];
    vec3 at = {0, 0, 0};
    for (int k = 0; k < 3; k++)
        at = vec3_add(at, vec3_mul(kit_vertex(aim->flat, item, k), b[k] / sum));
    return at;
}

static void choose_rays(void *context, size_t begin, size_t end) {
    const struct aim *aim = context;
    for (size_t i = begin; i < end; i++) {
        uint64_t state = aim->batch * PROBE_RAYS + i;
        const vec3 within = vec3_mul(random_direction(&state), 0.05 * aim->size * random_unit(&state));
        const vec3 start = probe_round(aim->probe, vec3_add(aim->center, within));
        const vec3 to = vec3_sub(choose_target(aim, &state), start);
        aim->f->rays[i] = (struct probe_ray){start, to, 3e38, random_direction(&state)};
    }
}

enum {
    LOST,   // the first ray
    LEAKED, // inside
    BEHIND, // inside: hit a face from behind, that is itself or one in its plane
    HIT,    // outside
};

static void judge_rays(void *context, size_t begin, size_t end) {
    struct aim *aim = context;
    uint64_t *counts = aim->counts[begin / PIECE];
    for (size_t i = begin; i < end; i++) {
        const struct probe_ray *ray = &aim->f->rays[i];
        const struct probe_hit *hit = &aim->f->hits[i];
        counts[LOST] += !hit->first.found || !hit->any;
        if (!hit->first.found)
            continue;
        const double rises = vec3_dot(probe_normal(aim->probe, hit->first.number), ray->next);
        // Closer to the face than this, rounding of the corners decides on which side of it the ray goes.
        if (fabs(rises) < 1e-5)
            continue;
        const bool outside = rises > 0;
        counts[HIT] += outside && (hit->second.found || hit->blocked);
        counts[LEAKED] += !outside && (!hit->second.found || !hit->blocked);
        if (!outside && hit->second.found)
            counts[BEHIND] += vec3_dot(probe_normal(aim->probe, hit->second.number), ray->next) < -1e-5;
    }
}

static void send_batch(struct aim *aim, struct probe *probe, uint64_t sums[4]) {
    memset(aim->counts, 0, sizeof aim->counts);
    parallel_for(batch_rays, PIECE, choose_rays, aim);
    assert_true(probe_trace(probe, aim->f->rays, batch_rays, aim->f->hits));
    parallel_for(batch_rays, PIECE, judge_rays, aim);
    for (size_t piece = 0; piece < PROBE_RAYS / PIECE; piece++)
        for (int k = 0; k < 4; k++)
            sums[k] += aim->counts[piece][k];
    aim->f->sent += batch_rays;
}

struct view_of {
    bool is_double;
    enum probe_way way;
    double scale;
};

static void send(void **state, int which, struct view_of view, uint64_t seed, uint64_t sums[4]) {
    struct probe_fixture *f = probe_need(state, view.is_double);
    struct kit kit;
    struct flat_scene flat;
    struct probe probe;
    kit_init(&kit);
    kit.is_double = view.is_double;
    // Somewhere inside, so that no coordinate is round.
    kit.origin = (vec3){0.03 * view.scale, -0.02 * view.scale, 0.05 * view.scale};
    struct ir_model *model = kit_model(&kit, make_mesh(&kit, which));
    model->scale = (vec3){view.scale, view.scale, view.scale};
    model->rotation = (vec3){13, 29, 41};
    assert_true(kit_flatten(&kit, &flat));
    const double factor = ldexp(1, flat.scale_exponent);
    struct aim *aim = calloc(1, sizeof *aim);
    *aim = (struct aim){.probe = &probe,
                        .flat = &flat,
                        .center = vec3_mul(flat.origin, -factor),
                        .size = view.scale * factor,
                        .batch = seed,
                        .f = f};
    assert_true(probe_init_way(&probe, f->device.gpu, &flat, true, view.way));
    for (uint64_t i = 0; i < batches; i++, aim->batch++)
        send_batch(aim, &probe, sums);
    probe_finish(&probe);
    free(aim);
    flat_finish(&flat);
    kit_finish(&kit);
}

static void check_precision(void **state, bool is_double) {
    static const double scales[] = {1e-6, 1e-3, 1, 1e3, 1e6};
    for (int which = 0; which < SHAPES; which++) {
        uint64_t sums[4] = {0};
        const uint64_t before = ((struct probe_fixture *)*state)->sent;
        for (uint64_t i = 0; i < sizeof scales / sizeof *scales; i++)
            send(state, which, (struct view_of){is_double, PROBE_EXACT, scales[i]},
                 ((uint64_t)which * 8 + i) * batches, sums);
        printf("%-18s %s: of %llu rays %llu were lost, %llu leaked, %llu hit from behind, %llu hit outside\n",
               names[which], is_double ? "double" : "single",
               (unsigned long long)(((struct probe_fixture *)*state)->sent - before),
               (unsigned long long)sums[LOST], (unsigned long long)sums[LEAKED],
               (unsigned long long)sums[BEHIND], (unsigned long long)sums[HIT]);
        for (int k = 0; k < 4; k++)
            assert_int_equal(sums[k], 0);
    }
}

static void test_single(void **state) {
    check_precision(state, false);
}

static void test_double(void **state) {
    check_precision(state, true);
}

// What the test is for: other ways to end the search do not pass it.
static void check_way(void **state, enum probe_way way, int counted) {
    uint64_t sums[4] = {0};
    send(state, CUBE, (struct view_of){false, way, 1}, 0, sums);
    send(state, WEDGE, (struct view_of){false, way, 1}, 0, sums);
    assert_true(sums[counted] > 0);
}

static void test_bound(void **state) {
    check_way(state, PROBE_BOUND, LEAKED);
}

static void test_positive(void **state) {
    check_way(state, PROBE_POSITIVE, BEHIND);
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_single),   cmocka_unit_test(test_double),       cmocka_unit_test(test_bound),
        cmocka_unit_test(test_positive), cmocka_unit_test(device_kit_silent),
    };
    if (argc > 1 && strcmp(argv[1], "full") == 0)
        batches = 77; // of 262 144 rays, at five scales
    if (argc > 1 && strcmp(argv[1], "few") == 0)
        batch_rays = PROBE_RAYS / 16;
    return cmocka_run_group_tests_name("leaks", tests, probe_setup, probe_teardown);
}
