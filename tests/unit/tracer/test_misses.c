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

static const uint32_t batch_rays = PROBE_RAYS / 16;

// A closed mesh of `radius`, this many radii from the corner of a scene where its numbers count from.
struct place {
    double radius, radii;
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
                     struct probe_hit *hits) {
    struct probe probe;
    assert_true(probe_init_way(&probe, f->device.gpu, &view->flat, true, way));
    assert_true(probe_trace(&probe, f->rays, batch_rays, hits));
    probe_finish(&probe);
    f->sent += batch_rays;
}

// How many of the rays end otherwise than where all triangles are tested in double precision.
static unsigned differ_by(struct probe_fixture *f, const struct far_scene *view, enum probe_way way) {
    struct probe_hit *whole = malloc(batch_rays * sizeof *whole);
    assert_non_null(whole);
    trace_by(f, view, PROBE_WHOLE, whole);
    trace_by(f, view, way, f->hits);
    unsigned differ = 0, found = 0;
    for (uint32_t i = 0; i < batch_rays; i++) {
        differ += !same_hit(&whole[i], &f->hits[i]);
        found += whole[i].first.found;
    }
    free(whole);
    assert_true(found > batch_rays / 4);
    return differ;
}

static unsigned count_differing(void **state, struct place place, enum probe_way way) {
    struct probe_fixture *f = probe_need(state, true);
    struct far_scene view;
    make_view(&view, &place);
    for (uint32_t i = 0; i < batch_rays; i++)
        f->rays[i] = choose_ray(&view.flat, i);
    const unsigned differ = differ_by(f, &view, way);
    flat_finish(&view.flat);
    kit_finish(&view.kit);
    return differ;
}

static const struct place places[] = {{1, 3},     {1e-3, 1e3}, {1, 1e5},  {2, 1e7},
                                      {1e15, 30}, {1e-15, 30}, {1e3, 1e9}};

static void test_margins(void **state) {
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        if (count_differing(state, places[i], PROBE_EXACT))
            fail_msg("radius %g, %g radii away: hits differ", places[i].radius, places[i].radii);
}

static void test_no_margins(void **state) {
    for (size_t i = 0; i < 4; i++)
        if (!count_differing(state, places[i], PROBE_BOLD))
            fail_msg("radius %g, %g radii away: no hit is lost", places[i].radius, places[i].radii);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_margins),
        cmocka_unit_test(test_no_margins),
        cmocka_unit_test(device_kit_silent),
    };
    return cmocka_run_group_tests_name("misses", tests, probe_setup, probe_teardown);
}
