// Rays on the device, through the kernel's own tree, tests and starts: none slips through a closed mesh, none
// hits the surface that it leaves, none leaks out of a body or through a gap; in single and double precision.
//
// Rays are aimed at edges and vertices of icospheres, and at spheres. A second ray leaves each hit: outward
// from a convex body it must meet nothing, inward it must meet the body again, elsewhere.
// Usage: test_rays [full] [few]: `full` sends ten million rays in each precision, at all sizes and distances;
// `few` a sixteenth of those sent without it.
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

static uint32_t batch_rays = PROBE_RAYS;

// ---- closed bodies

// A body, and how it is looked at.
struct place {
    bool is_double;
    vec3 center; // scene units
    double radius;
    vec3 origin; // where the camera stands
};

struct aim {
    const struct probe *probe;
    const struct flat_scene *flat;
    vec3 center; // flat
    double radius;
    vec3 camera; // flat
};

static vec3 choose_target(const struct aim *aim, uint64_t *state) {
    if (aim->flat->sphere_count)
        return vec3_add(aim->center, vec3_mul(random_direction(state), aim->radius * (1 - 1e-6)));
    const uint32_t item = (uint32_t)(random_bits(state) % aim->flat->triangle_count);
    const int corner = (int)(random_bits(state) % 3);
    const vec3 a = kit_vertex(aim->flat, item, corner), b = kit_vertex(aim->flat, item, (corner + 1) % 3);
    return random_bits(state) % 2 ? a : vec3_add(a, vec3_mul(vec3_sub(b, a), random_unit(state)));
}

// From inside, from near by outside, and in double precision also from the camera: in single precision a ray
// from there is rounded by more than the body's triangles where it is far away.
static vec3 choose_start(const struct aim *aim, bool inside, uint64_t *state) {
    if (!inside && aim->probe->is_double && random_bits(state) % 4 == 0)
        return aim->camera;
    const double away = aim->radius * (inside ? 0.9 * random_unit(state) : 1.2 + 8 * random_unit(state));
    return vec3_add(aim->center, vec3_mul(random_direction(state), away));
}

// A ray at an edge, vertex or sphere, from inside or outside, and one that leaves its target: at least 0.6
// degrees from the surface, since a mesh of rounded vertices is not quite convex.
static void choose_ray(const struct aim *aim, uint64_t seed, struct probe_ray *ray) {
    uint64_t state = seed;
    for (;;) {
        const vec3 target = choose_target(aim, &state);
        const vec3 out = vec3_unit(vec3_sub(target, aim->center));
        const bool inside = random_bits(&state) % 2;
        const vec3 start = probe_round(aim->probe, choose_start(aim, inside, &state));
        const vec3 to = vec3_sub(target, start), next = random_direction(&state);
        if ((!inside && vec3_dot(out, vec3_unit(to)) > -0.2) || fabs(vec3_dot(out, next)) < 0.1)
            continue;
        *ray = (struct probe_ray){start, aim->flat->sphere_count ? vec3_unit(to) : to, 3e38, next};
        return;
    }
}

struct misses {
    unsigned closest, any, self, leaks;
};

static void judge(const struct aim *aim, const struct probe_ray *ray, const struct probe_hit *hit,
                  struct misses *misses) {
    misses->any += !hit->any;
    if (!hit->first.found) {
        misses->closest++;
        return;
    }
    const vec3 at = vec3_add(ray->origin, vec3_mul(ray->direction, hit->first.t));
    const vec3 out = vec3_sub(at, aim->center);
    misses->closest += fabs(vec3_length(out) / aim->radius - 1) > 0.2;
    const bool leaves = vec3_dot(vec3_unit(out), ray->next) > 0, found = hit->second.found;
    misses->self +=
        leaves ? found : found && !aim->flat->sphere_count && hit->second.number == hit->first.number;
    // A chord at 0.1 from the tangent is 0.2 radii long.
    misses->leaks += !leaves && !(found && hit->second.t > 0.05 * aim->radius);
}

static void check(struct probe_fixture *f, const struct flat_scene *flat, const struct place *place,
                  unsigned batches) {
    struct probe probe;
    const double factor = ldexp(1, flat->scale_exponent);
    const struct aim aim = {&probe, flat, vec3_mul(vec3_sub(place->center, flat->origin), factor),
                            place->radius * factor, vec3_mul(vec3_sub(place->origin, flat->origin), factor)};
    struct misses misses = {0, 0, 0, 0};
    for (uint64_t batch = 0; batch < batches; batch++) {
        // Both ways to keep groups of nodes; this tree is small enough for the short one.
        assert_true(probe_init(&probe, f->device.gpu, flat, batch % 2));
        for (uint64_t i = 0; i < batch_rays; i++)
            choose_ray(&aim, batch * batch_rays + i, &f->rays[i]);
        assert_true(probe_trace(&probe, f->rays, batch_rays, f->hits));
        for (size_t i = 0; i < batch_rays; i++)
            judge(&aim, &f->rays[i], &f->hits[i], &misses);
        probe_finish(&probe);
        f->sent += batch_rays;
    }
    if (misses.closest || misses.any || misses.self || misses.leaks)
        fail_msg("%s: of %u rays at radius %g, center %g %g %g, seen from %g %g %g: %u without their hit, %u "
                 "without any, %u hit what they left, %u leaked",
                 place->is_double ? "double" : "single", batches * batch_rays, place->radius, place->center.x,
                 place->center.y, place->center.z, place->origin.x, place->origin.y, place->origin.z,
                 misses.closest, misses.any, misses.self, misses.leaks);
}

static void check_mesh(void **state, struct place place, unsigned batches) {
    struct probe_fixture *f = probe_need(state, place.is_double);
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit.origin = place.origin;
    kit.is_double = place.is_double;
    struct ir_model *model = kit_model(&kit, kit_icosphere(&kit, 3, 0));
    model->scale = (vec3){place.radius, place.radius, place.radius};
    model->rotation = (vec3){10, 20, 30};
    model->translation = place.center;
    assert_true(kit_flatten(&kit, &flat));
    check(f, &flat, &place, batches);
    flat_finish(&flat);
    kit_finish(&kit);
}

static void check_sphere(void **state, struct place place, unsigned batches) {
    struct probe_fixture *f = probe_need(state, place.is_double);
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit.origin = place.origin;
    kit.is_double = place.is_double;
    struct ir_sphere *sphere = kit_sphere(&kit);
    sphere->center = place.center;
    sphere->radius = place.radius;
    assert_true(kit_flatten(&kit, &flat));
    check(f, &flat, &place, batches);
    flat_finish(&flat);
    kit_finish(&kit);
}

// So many sizes (diameters) from the camera.
static struct place far_away(bool is_double, double radius, double sizes) {
    return (struct place){is_double, {0, 0, 0}, radius, {1.2 * radius * sizes, 0, 1.6 * radius * sizes}};
}

static void test_mesh(void **state) {
    for (int is_double = 0; is_double < 2; is_double++) {
        check_mesh(state, (struct place){is_double, {0, 0, 0}, 1, {3, 1, 0}}, 2);
        check_mesh(state, (struct place){is_double, {1e3, 750, -1e3}, 1e-3, {1e3, 750, -1e3 + 5e-3}}, 1);
        check_mesh(state, (struct place){is_double, {1e5, 7.5e4, -1e5}, 2, {1e5 + 6, 7.5e4 + 2, -1e5}}, 1);
        check_mesh(state, far_away(is_double, 1, is_double ? 1e6 : 100), 1);
    }
}

static void test_sphere(void **state) {
    for (int is_double = 0; is_double < 2; is_double++) {
        check_sphere(state, (struct place){is_double, {0, 0, -3}, 1, {0, 0, 0}}, 1);
        check_sphere(state, far_away(is_double, 1, is_double ? 1e6 : 100), 1);
        check_sphere(state, (struct place){is_double, {0.1, 0.2, 0.3}, 1e3, {0, 0, 0}}, 1);
    }
}

static void test_all_meshes(void **state) {
    static const double offsets[] = {0, 1e3, 1e5};
    for (int is_double = 0; is_double < 2; is_double++)
        for (int i = 0; i < 3; i++)
            for (double radius = 1e-3; radius < 2e3; radius *= 10) {
                const double at = offsets[i];
                const vec3 center = {at, 0.75 * at, -at};
                const vec3 origin = vec3_add(center, (vec3){3 * radius, radius, 0});
                check_mesh(state, (struct place){is_double, center, radius, origin}, 2);
            }
}

static void test_all_distances(void **state) {
    for (double radius = 1e-6; radius < 2e6; radius *= 100) {
        check_mesh(state, far_away(false, radius, 100), 1);
        check_sphere(state, far_away(false, radius, 100), 1);
        for (double sizes = 100; sizes < 2e6; sizes *= 100) {
            check_mesh(state, far_away(true, radius, sizes), 1);
            check_sphere(state, far_away(true, radius, sizes), 1);
        }
    }
}

// ---- from inside

// A closed mesh of 20 * 4^levels triangles with hills and valleys, seen from inside: every ray meets it.
static void check_inside(void **state, bool is_double, int levels, unsigned batches) {
    struct probe_fixture *f = probe_need(state, is_double);
    struct kit kit;
    struct flat_scene flat;
    struct probe probe;
    kit_init(&kit);
    kit.is_double = is_double;
    kit.origin = (vec3){0.31, -0.17, 0.23};
    struct mesh *mesh = kit_icosphere(&kit, levels, 0);
    for (uint32_t i = 0; i < mesh->position_count; i++) {
        const vec3 p = mesh->positions[i];
        const double height = 1 + 0.04 * sin(37 * p.x + 5 * p.y) * cos(41 * p.y - 7 * p.z);
        mesh->positions[i] = vec3_mul(p, height);
    }
    kit_model(&kit, mesh);
    assert_true(kit_flatten(&kit, &flat));
    assert_true(probe_init(&probe, f->device.gpu, &flat, false));
    const vec3 camera = vec3_mul(vec3_sub(kit.origin, flat.origin), ldexp(1, flat.scale_exponent));
    unsigned lost = 0;
    for (uint64_t batch = 0; batch < batches; batch++) {
        for (uint64_t i = 0; i < batch_rays; i++) {
            uint64_t seed = batch * batch_rays + i;
            const vec3 direction = random_direction(&seed);
            f->rays[i] = (struct probe_ray){camera, direction, 3e38, vec3_neg(direction)};
        }
        assert_true(probe_trace(&probe, f->rays, batch_rays, f->hits));
        // The second ray goes back inside from where the first one met the mesh.
        for (size_t i = 0; i < batch_rays; i++)
            lost += !f->hits[i].first.found || !f->hits[i].any || !f->hits[i].second.found;
        f->sent += batch_rays;
    }
    printf("%u triangles, %s: %u of %u rays saw the background\n", flat.triangle_count,
           is_double ? "double" : "single", lost, batches * batch_rays);
    assert_true(flat.triangle_count >= 20u << (2 * levels));
    assert_int_equal(lost, 0);
    probe_finish(&probe);
    flat_finish(&flat);
    kit_finish(&kit);
}

static void test_inside(void **state) {
    check_inside(state, false, 5, 1);
    check_inside(state, true, 5, 1);
}

static void test_inside_a_million(void **state) {
    check_inside(state, false, 8, 8);
    check_inside(state, true, 8, 8);
}

// ---- gaps

// Two plates, and how they are looked at.
struct gap {
    bool is_double;
    double size, width; // of the plates; between them, in sizes
    double sizes;       // between camera and plates
};

struct plates {
    vec3 corner, u, v, normal; // of the first one; the other lies behind it
};

static struct plates plates_of(const struct gap *gap) {
    const double size = gap->size;
    struct plates p = {.u = {size, 0.3 * size, 0.2 * size}, .v = {-0.1 * size, 0.9 * size, -0.4 * size}};
    p.normal = vec3_unit(vec3_cross(p.u, p.v));
    p.corner = vec3_mul((vec3){0.48, 0.36, -0.8}, size * gap->sizes);
    return p;
}

// A ray at the first plate, and on from there towards the second.
static struct probe_ray choose_gap_ray(const struct probe *probe, const struct plates *p,
                                       const struct gap *gap, const struct flat_scene *flat, uint64_t seed) {
    const double factor = ldexp(1, flat->scale_exponent);
    vec3 from, next;
    do
        from = random_direction(&seed);
    while (vec3_dot(from, p->normal) < 0.1);
    do
        next = random_direction(&seed);
    while (vec3_dot(next, p->normal) > -0.1);
    const vec3 place = vec3_add(vec3_mul(p->u, 0.1 + 0.8 * random_unit(&seed)),
                                vec3_mul(p->v, 0.1 + 0.8 * random_unit(&seed)));
    const vec3 target = vec3_mul(vec3_sub(vec3_add(p->corner, place), flat->origin), factor);
    const vec3 start = probe_round(probe, vec3_add(target, vec3_mul(from, gap->size * factor * 2)));
    return (struct probe_ray){start, vec3_neg(from), 3e38, next};
}

static void check_gap(void **state, struct gap gap) {
    struct probe_fixture *f = probe_need(state, gap.is_double);
    struct kit kit;
    struct flat_scene flat;
    struct probe probe;
    const struct plates plates = plates_of(&gap);
    kit_init(&kit);
    kit.is_double = gap.is_double;
    for (int plate = 0; plate < 2; plate++) {
        struct ir_rectangle *r = kit_rectangle(&kit);
        r->corner = vec3_sub(plates.corner, vec3_mul(plates.normal, plate * gap.width * gap.size));
        r->edge_u = plates.u;
        r->edge_v = plates.v;
    }
    assert_true(kit_flatten(&kit, &flat));
    assert_true(probe_init(&probe, f->device.gpu, &flat, true));
    for (uint64_t i = 0; i < batch_rays; i++)
        f->rays[i] = choose_gap_ray(&probe, &plates, &gap, &flat, i);
    assert_true(probe_trace(&probe, f->rays, batch_rays, f->hits));
    unsigned lost = 0;
    for (size_t i = 0; i < batch_rays; i++) {
        const struct probe_hit *hit = &f->hits[i];
        lost += !(hit->first.found && hit->first.number < 2 && hit->second.found && hit->second.number >= 2);
    }
    probe_finish(&probe);
    flat_finish(&flat);
    kit_finish(&kit);
    f->sent += batch_rays;
    if (lost)
        fail_msg("%s, size %g, %g sizes away: %u of %u rays were lost in a gap of %g sizes",
                 gap.is_double ? "double" : "single", gap.size, gap.sizes, lost, batch_rays, gap.width);
}

static void test_gap(void **state) {
    check_gap(state, (struct gap){false, 1, 2e-5, 3});
    check_gap(state, (struct gap){false, 1e-3, 2e-5, 3});
    check_gap(state, (struct gap){false, 1e3, 1e-4, 100});
    check_gap(state, (struct gap){true, 1, 1e-4, 1e6});
    check_gap(state, (struct gap){true, 1e-3, 1e-8, 3});
}

static void test_all_gaps(void **state) {
    for (double size = 1e-6; size < 2e6; size *= 10) {
        check_gap(state, (struct gap){false, size, 1e-4, 3});
        check_gap(state, (struct gap){false, size, 1e-4, 100});
        for (double sizes = 1; sizes < 2e6; sizes *= 100)
            check_gap(state, (struct gap){true, size, 1e-4, sizes});
    }
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mesh), cmocka_unit_test(test_sphere),       cmocka_unit_test(test_inside),
        cmocka_unit_test(test_gap),  cmocka_unit_test(device_kit_silent),
    };
    const struct CMUnitTest all[] = {
        cmocka_unit_test(test_all_meshes),       cmocka_unit_test(test_all_distances),
        cmocka_unit_test(test_inside_a_million), cmocka_unit_test(test_all_gaps),
        cmocka_unit_test(device_kit_silent),
    };
    const bool full = argc > 1 && strcmp(argv[1], "full") == 0;
    if (argc > 1 && strcmp(argv[argc - 1], "few") == 0)
        batch_rays = PROBE_RAYS / 16;
    if (full)
        return cmocka_run_group_tests_name("rays, all", all, probe_setup, probe_teardown);
    return cmocka_run_group_tests_name("rays", tests, probe_setup, probe_teardown);
}
