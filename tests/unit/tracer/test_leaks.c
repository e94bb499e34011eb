// Rays inside and outside closed convex bodies of few and of many triangles: mirrored, refracted and shadow
// rays that leave a face from anywhere, and from close to its edges and corners. None leaves the body through
// its faces, and none hits the face that it leaves or one beside it from behind.
//
// What a ray from a face must hit is known: from inside, a face that it goes out through; outside, nothing.
// Usage: test_leaks [few | full]: `full` sends a hundred million rays in each body and precision; `few` a
// sixteenth of those sent without it.
#include "core/parallel.h"
#include "device_kit.h"
#include "flat_kit.h"
#include "probe_kit.h"
#include "random.h"

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
    MOST_CORNERS = 64,
    MOST_FACES = 128,
};

static uint32_t batch_rays = PROBE_RAYS;
static uint64_t batches = 1;

struct fixture {
    struct device_kit device;
    struct probe_ray *rays;
    struct probe_hit *hits;
    uint64_t sent;
};

static int setup(void **state) {
    struct fixture *f = calloc(1, sizeof *f);
    device_kit_open(&f->device);
    f->rays = calloc(PROBE_RAYS, sizeof *f->rays);
    f->hits = calloc(PROBE_RAYS, sizeof *f->hits);
    *state = f;
    return 0;
}

static int teardown(void **state) {
    struct fixture *f = *state;
    printf("%llu rays were sent, and as many from what they hit\n", (unsigned long long)f->sent);
    free(f->rays);
    free(f->hits);
    return device_kit_teardown(state);
}

// ---- bodies

// Convex, around the origin, about 2 units wide.
struct shape {
    const char *name;
    vec3 corners[MOST_CORNERS];
    uint32_t faces[MOST_FACES][3];
    uint32_t corner_count, face_count;
    int levels; // of an icosphere instead
};

static void add_face(struct shape *s, uint32_t a, uint32_t b, uint32_t c) {
    const vec3 p = s->corners[a], q = s->corners[b], r = s->corners[c];
    const bool out = vec3_dot(vec3_cross(vec3_sub(q, p), vec3_sub(r, p)), vec3_add(p, vec3_add(q, r))) > 0;
    const uint32_t face[3] = {a, out ? b : c, out ? c : b};
    memcpy(s->faces[s->face_count++], face, sizeof face);
}

// Two polygons of n corners, of these radii and heights, and what is between them.
static void make_drum(struct shape *s, uint32_t n, double below, double above, double low, double high) {
    for (uint32_t i = 0; i < 2 * n; i++) {
        const double angle = 6.283185307179586 * (i % n) / n + 0.1, radius = i < n ? below : above;
        s->corners[i] = (vec3){radius * cos(angle), i < n ? low : high, radius * sin(angle)};
    }
    s->corner_count = 2 * n;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t j = (i + 1) % n;
        add_face(s, i, j, n + j);
        add_face(s, i, n + j, n + i);
    }
    for (uint32_t i = 1; i + 1 < n; i++) {
        add_face(s, 0, i, i + 1);
        add_face(s, n, n + i, n + i + 1);
    }
}

static void make_box(struct shape *s, vec3 half) {
    static const uint32_t sides[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    for (int i = 0; i < 8; i++)
        s->corners[i] = (vec3){i & 4 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 1 ? half.z : -half.z};
    s->corner_count = 8;
    for (int i = 0; i < 6; i++) {
        add_face(s, sides[i][0], sides[i][1], sides[i][2]);
        add_face(s, sides[i][0], sides[i][2], sides[i][3]);
    }
}

static void make_tetrahedron(struct shape *s) {
    static const vec3 corners[4] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    memcpy(s->corners, corners, sizeof corners);
    s->corner_count = 4;
    add_face(s, 0, 1, 2);
    add_face(s, 0, 1, 3);
    add_face(s, 0, 2, 3);
    add_face(s, 1, 2, 3);
}

// Two large faces that meet at 11 degrees.
static void make_wedge(struct shape *s) {
    static const vec3 corners[6] = {{-1, 0, -1}, {-1, 0, 1},    {1, 0.2, -1},
                                    {1, 0.2, 1}, {1, -0.2, -1}, {1, -0.2, 1}};
    memcpy(s->corners, corners, sizeof corners);
    s->corner_count = 6;
    static const uint32_t quads[3][4] = {{0, 1, 3, 2}, {0, 1, 5, 4}, {2, 3, 5, 4}};
    for (int i = 0; i < 3; i++) {
        add_face(s, quads[i][0], quads[i][1], quads[i][2]);
        add_face(s, quads[i][0], quads[i][2], quads[i][3]);
    }
    add_face(s, 0, 2, 4);
    add_face(s, 1, 3, 5);
}

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

static void make_shape(int which, struct shape *s) {
    static const char *const names[SHAPES] = {"cube", "tetrahedron", "wedge",     "prism",
                                              "room", "gem",         "icosphere", "icosphere of 1280"};
    *s = (struct shape){.name = names[which]};
    if (which == CUBE)
        make_box(s, (vec3){1, 1, 1});
    else if (which == TETRAHEDRON)
        make_tetrahedron(s);
    else if (which == WEDGE)
        make_wedge(s);
    else if (which == PRISM)
        make_drum(s, 3, 1, 1, -1, 1);
    else if (which == ROOM)
        make_box(s, (vec3){1.6, 0.5, 1});
    else if (which == GEM)
        make_drum(s, 8, 0.15, 1, -0.8, 0.2);
    else
        s->levels = which == ICOSPHERE ? 1 : 3;
}

// ---- rays

struct aim {
    const struct probe *probe;
    const struct flat_scene *flat;
    uint32_t *items; // by triangle number
    vec3 center;     // flat
    double size;     // flat
    uint64_t batch;
    struct fixture *f;
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

static vec3 normal_of(const struct aim *aim, uint32_t number) {
    const uint32_t item = aim->items[number];
    const vec3 a = kit_vertex(aim->flat, item, 0);
    return vec3_unit(
        vec3_cross(vec3_sub(kit_vertex(aim->flat, item, 1), a), vec3_sub(kit_vertex(aim->flat, item, 2), a)));
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
        const double rises = vec3_dot(normal_of(aim, hit->first.number), ray->next);
        // Closer to the face than this, rounding of the corners decides on which side of it the ray goes.
        if (fabs(rises) < 1e-5)
            continue;
        const bool outside = rises > 0;
        counts[HIT] += outside && (hit->second.found || hit->blocked);
        counts[LEAKED] += !outside && (!hit->second.found || !hit->blocked);
        if (!outside && hit->second.found)
            counts[BEHIND] += vec3_dot(normal_of(aim, hit->second.number), ray->next) < -1e-5;
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
    struct fixture *f = *state;
    device_kit_need(state, view.is_double);
    struct kit kit;
    struct flat_scene flat;
    struct shape shape;
    struct probe probe;
    make_shape(which, &shape);
    kit_init(&kit);
    kit.is_double = view.is_double;
    // Somewhere inside, so that no coordinate is round.
    kit.origin = (vec3){0.03 * view.scale, -0.02 * view.scale, 0.05 * view.scale};
    struct mesh *mesh = shape.levels ? kit_icosphere(&kit, shape.levels, 0)
                                     : kit_mesh(&kit, shape.corners, shape.corner_count,
                                                (const uint32_t(*)[3])shape.faces, shape.face_count, true);
    struct ir_model *model = kit_model(&kit, mesh);
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
    aim->items = calloc(flat.triangle_count, sizeof *aim->items);
    for (uint32_t i = 0; i < flat.triangle_count; i++)
        aim->items[i] = kit_find_triangle(&flat, i);
    assert_true(probe_init_way(&probe, f->device.gpu, &flat, true, view.way));
    for (uint64_t i = 0; i < batches; i++, aim->batch++)
        send_batch(aim, &probe, sums);
    probe_finish(&probe);
    free(aim->items);
    free(aim);
    flat_finish(&flat);
    kit_finish(&kit);
}

static void check_precision(void **state, bool is_double) {
    static const double scales[] = {1e-6, 1e-3, 1, 1e3, 1e6};
    for (int which = 0; which < SHAPES; which++) {
        uint64_t sums[4] = {0};
        const uint64_t before = ((struct fixture *)*state)->sent;
        struct shape shape;
        make_shape(which, &shape);
        for (uint64_t i = 0; i < sizeof scales / sizeof *scales; i++)
            send(state, which, (struct view_of){is_double, PROBE_EXACT, scales[i]},
                 ((uint64_t)which * 8 + i) * batches, sums);
        printf("%-18s %s: of %llu rays %llu were lost, %llu leaked, %llu hit from behind, %llu hit outside\n",
               shape.name, is_double ? "double" : "single",
               (unsigned long long)(((struct fixture *)*state)->sent - before),
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
    return cmocka_run_group_tests_name("leaks", tests, setup, teardown);
}
