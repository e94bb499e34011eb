// No ray slips through a closed mesh: a million rays for each place, aimed at edges and vertices of an
// icosphere as flattened, through the compressed tree that ships.
//
// The sphere stands at an offset of 0, 1e3 and 1e5. The origin of flattening is beside it (what a camera
// near it sees) and at 0 (a sphere far from the camera, whose vertices have few bits left). Rays start
// inside, outside near it, and at the camera. A miss is no hit where the target is.
// Usage: test_watertight [few]: `few` shoots a fiftieth of them.
#include "core/parallel.h"
#include "flat_kit.h"
#include "random.h"
#include "shaders/gpu_scene.h"
#include "shaders/records.h"
#include "tests/traverse/traverse.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    RAYS = 500000, // from one origin of two
    RAYS_FEW = 10000,
    PIECE = 4096,
};

static uint32_t rays = RAYS;

struct aim {
    const struct flat_scene *flat;
    vec3 center; // flat
    double radius;
    atomic_uint misses[2]; // at edges, at vertices
    atomic_uint shot;
};

// Where the ray with this number starts; false: the target is not well in view from there.
static bool choose_start(const struct aim *aim, size_t number, vec3 target, uint64_t *state, float start[3]) {
    vec3 at = {0, 0, 0};
    uint32_t kind = number / 2 % 4;
    if (kind < 2)
        at = vec3_add(aim->center, vec3_mul(random_direction(state), aim->radius * 0.9 * random_unit(state)));
    else if (kind == 2)
        at = vec3_add(aim->center,
                      vec3_mul(random_direction(state), aim->radius * (1.2 + 8 * random_unit(state))));
    start[0] = (float)at.x;
    start[1] = (float)at.y;
    start[2] = (float)at.z;
    vec3 out = vec3_unit(vec3_sub(target, aim->center));
    return kind < 2 || vec3_dot(out, vec3_unit(vec3_sub(at, target))) > 0.2;
}

static vec3 choose_target(const struct aim *aim, size_t number, uint64_t *state) {
    uint32_t item = (uint32_t)(random_bits(state) % aim->flat->triangle_count);
    int corner = (int)(random_bits(state) % 3);
    vec3 a = kit_vertex(aim->flat, item, corner);
    vec3 b = kit_vertex(aim->flat, item, (corner + 1) % 3);
    return number % 2 ? a : vec3_add(a, vec3_mul(vec3_sub(b, a), random_unit(state)));
}

static void shoot(void *context, size_t begin, size_t end) {
    struct aim *aim = context;
    struct traverse_scene scene = {aim->flat->triangle_nodes.words, aim->flat->triangles.words};
    for (size_t i = begin; i < end; i++) {
        uint64_t state = i;
        struct traverse_ray ray = {.far = INFINITY};
        vec3 target;
        do
            target = choose_target(aim, i, &state);
        while (!choose_start(aim, i, target, &state, ray.origin));
        vec3 to = vec3_sub(target, (vec3){ray.origin[0], ray.origin[1], ray.origin[2]});
        ray.direction[0] = (float)to.x;
        ray.direction[1] = (float)to.y;
        ray.direction[2] = (float)to.z;
        struct traverse_hit hit;
        bool found = traverse_closest(&scene, &ray, &hit) &&
                     fabs(hit.distance - 1) * vec3_length(to) < 0.2 * aim->radius;
        ray.far = hit.distance * 2;
        if (!found || !traverse_any(&scene, &ray))
            atomic_fetch_add(&aim->misses[i % 2], 1);
        atomic_fetch_add(&aim->shot, 1);
    }
}

static void check_place(double offset, double radius, vec3 origin) {
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit.origin = origin;
    struct ir_model *model = kit_model(&kit, kit_icosphere(&kit, 3, 0));
    model->scale = (vec3){radius, radius, radius};
    model->rotation = (vec3){10, 20, 30};
    model->translation = (vec3){offset, offset * 0.75, -offset};
    assert_true(kit_flatten(&kit, &flat));
    assert_int_equal(flat.dropped_triangles, 0);
    double factor = ldexp(1, flat.scale_exponent);
    struct aim aim = {.flat = &flat,
                      .center = vec3_mul(vec3_sub(model->translation, origin), factor),
                      .radius = radius * factor};
    parallel_for(rays, PIECE, shoot, &aim);
    assert_int_equal(aim.shot, rays);
    if (aim.misses[0] || aim.misses[1])
        fail_msg("offset %g, radius %g, origin %g: %u misses at edges, %u at vertices", offset, radius,
                 origin.x, (unsigned)aim.misses[0], (unsigned)aim.misses[1]);
    flat_finish(&flat);
    kit_finish(&kit);
}

static void check_offset(double offset, double radius) {
    vec3 beside = {offset + 3 * radius, offset * 0.75 + radius, -offset};
    check_place(offset, radius, beside);
    check_place(offset, radius, offset != 0 ? (vec3){0, 0, 0} : (vec3){0, 0, 50 * radius});
}

static void test_at_0(void **state) {
    (void)state;
    check_offset(0, 1);
}

static void test_at_0_small(void **state) {
    (void)state;
    check_offset(0, 1e-3);
}

static void test_at_1e3(void **state) {
    (void)state;
    check_offset(1e3, 2);
}

static void test_at_1e5(void **state) {
    (void)state;
    check_offset(1e5, 2);
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_at_0),
        cmocka_unit_test(test_at_0_small),
        cmocka_unit_test(test_at_1e3),
        cmocka_unit_test(test_at_1e5),
    };
    if (argc > 1 && strcmp(argv[1], "few") == 0)
        rays = RAYS_FEW;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
