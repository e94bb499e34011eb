// What the kernels in double precision reject in single precision (shaders/misses.glsl): rays close to edges
// hit what they hit where every triangle is tested in double precision, bit for bit. Without the margins they
// do not.
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
    RAYS = PROBE_RAYS / 16,
    RAYS_FAR = RAYS / 8, // where boxes are so wide that each ray opens nearly all of them
};

// A closed mesh of `radius`, this many radii from the corner of a scene where its numbers count from.
struct place {
    double radius, radii;
    uint32_t rays;
};

struct far_scene {
    struct kit kit;
    struct flat_scene flat;
};

// The mesh, and far from it a rectangle where the camera stands.
static void make_view(struct far_scene *view, const struct place *place) {
    const double far = place->radius * place->radii;
    kit_init(&view->kit);
    view->kit.is_double = true;
    view->kit.origin = (vec3){-far, -far, far};
    struct ir_model *model = kit_model(&view->kit, kit_icosphere(&view->kit, 3, 0));
    model->scale = (vec3){place->radius, place->radius, place->radius};
    model->rotation = (vec3){10, 20, 30};
    struct ir_rectangle *r = kit_rectangle(&view->kit);
    r->corner = view->kit.origin;
    r->edge_u = (vec3){-place->radius, 0, 0};
    r->edge_v = (vec3){0, 0, place->radius};
    assert_true(kit_flatten(&view->kit, &view->flat));
}

// From a place some edges away to one beside an edge, by 10^-1 to 10^-17 of the edge; the second ray goes
// anywhere.
static struct probe_ray choose_ray(const struct flat_scene *flat, uint64_t seed) {
    uint64_t state = seed;
    const uint32_t item = (uint32_t)(random_bits(&state) % flat->triangle_count);
    const int corner = (int)(random_bits(&state) % 3);
    const vec3 a = kit_vertex(flat, item, corner), b = kit_vertex(flat, item, (corner + 1) % 3);
    const vec3 edge = vec3_sub(b, a);
    const double length = vec3_length(edge);
    const double beside = length * pow(10, -1 - 16 * random_unit(&state));
    const vec3 on = vec3_add(a, vec3_mul(edge, random_bits(&state) % 4 ? random_unit(&state) : 0));
    const vec3 target = vec3_add(on, vec3_mul(random_direction(&state), beside));
    const vec3 start =
        vec3_add(on, vec3_mul(random_direction(&state), length * (0.1 + 20 * random_unit(&state))));
    return (struct probe_ray){start, vec3_sub(target, start), 3e38, random_direction(&state)};
}

static bool same_met(const struct probe_met *a, const struct probe_met *b) {
    return a->found == b->found && (!a->found || (a->number == b->number && a->t == b->t));
}

static bool same_hit(const struct probe_hit *a, const struct probe_hit *b) {
    return same_met(&a->first, &b->first) && a->any == b->any &&
           (!a->first.found ||
            (same_met(&a->second, &b->second) && a->same_side == b->same_side && a->blocked == b->blocked));
}

static void trace_by(struct probe_fixture *f, const struct far_scene *view, enum probe_way way,
                     uint32_t count, struct probe_hit *hits) {
    struct probe probe;
    assert_true(probe_init_way(&probe, f->device.gpu, &view->flat, true, way));
    assert_true(probe_trace(&probe, f->rays, count, hits));
    probe_finish(&probe);
    f->sent += count;
}

// How many of the rays end otherwise than where all triangles are tested in double precision.
static unsigned count_differing(const struct probe_hit *whole, const struct probe_hit *hits, uint32_t count) {
    unsigned differ = 0;
    for (uint32_t i = 0; i < count; i++)
        differ += !same_hit(&whole[i], &hits[i]);
    return differ;
}

static unsigned count_found(const struct probe_hit *hits, uint32_t count) {
    unsigned found = 0;
    for (uint32_t i = 0; i < count; i++)
        found += hits[i].first.found;
    return found;
}

// Without the margins the first four lose hits.
static const struct place places[] = {{1, 3, RAYS},        {1e-3, 1e3, RAYS}, {1, 1e5, RAYS},
                                      {2, 1e7, RAYS_FAR},  {1e15, 30, RAYS},  {1e-15, 30, RAYS},
                                      {1e3, 1e9, RAYS_FAR}};
enum {
    PLACES = sizeof places / sizeof *places,
    PLACES_OF_LOSSES = 4,
};

// The deepest tree of all: a kernel made for that serves each place, and making one takes seconds.
static uint32_t deepest(void) {
    uint32_t most = 0;
    for (size_t i = 0; i < PLACES; i++) {
        struct far_scene view;
        make_view(&view, &places[i]);
        most = view.flat.triangle_depth > most ? view.flat.triangle_depth : most;
        flat_finish(&view.flat);
        kit_finish(&view.kit);
    }
    return most;
}

static void test_place(struct probe_fixture *f, size_t i, uint32_t depth) {
    const struct place *place = &places[i];
    struct probe_hit *whole = malloc(place->rays * sizeof *whole);
    struct far_scene view;
    assert_non_null(whole);
    make_view(&view, place);
    view.flat.triangle_depth = depth;
    for (uint32_t k = 0; k < place->rays; k++)
        f->rays[k] = choose_ray(&view.flat, k);
    trace_by(f, &view, PROBE_WHOLE, place->rays, whole);
    assert_true(count_found(whole, place->rays) > place->rays / 4);
    trace_by(f, &view, PROBE_EXACT, place->rays, f->hits);
    if (count_differing(whole, f->hits, place->rays))
        fail_msg("radius %g, %g radii away: hits differ", place->radius, place->radii);
    if (i < PLACES_OF_LOSSES) {
        trace_by(f, &view, PROBE_BOLD, place->rays, f->hits);
        if (!count_differing(whole, f->hits, place->rays))
            fail_msg("radius %g, %g radii away: no hit is lost without margins", place->radius, place->radii);
    }
    free(whole);
    flat_finish(&view.flat);
    kit_finish(&view.kit);
}

static void test_margins(void **state) {
    struct probe_fixture *f = probe_need(state, true);
    const uint32_t depth = deepest();
    for (size_t i = 0; i < PLACES; i++)
        test_place(f, i, depth);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_margins),
        cmocka_unit_test(device_kit_silent),
    };
    return cmocka_run_group_tests_name("misses", tests, probe_setup, probe_teardown);
}
