// Rays on the device at cylinders and cones, in single and double precision: each against the body's own
// equation, of which long double finds the roots by halving, and a second ray from each hit. Outward it meets
// nothing, inward it meets the body again, always: no ray slips between the side and a disc.
//
// Bodies from needles to coins (ratios to 10^6), whole and cut off, at sizes of 2^-20 to 2^20; rays at the
// rims, at the side, at the discs, along the surface, from inside and from far away. Usage: test_cones [full]
// [few]: `full` sends 256 times as many rays, `few` a quarter.
#include "flat_kit.h"
#include "probe_kit.h"
#include "random.h"
#include "shaders/records.h"
#include "tracer/gpu_records.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static uint32_t batch_rays = PROBE_RAYS / 64, batches = 1,
                step = 1; // one in `step` is held against the equation

// ---- the body as the device has it

struct frustum {
    long double base[3], axis[3], radius, slope, height;
};

static double field(const struct flat_scene *flat, uint32_t word, uint32_t component, uint32_t word64,
                    uint32_t part64) {
    const unsigned char *words = (const unsigned char *)flat->spheres.words;
    double value;
    float single;
    if (flat->is_double) {
        memcpy(&value, words + 16 * word64 + 4 * part64, sizeof value);
        return value;
    }
    memcpy(&single, words + 16 * word + 4 * component, sizeof single);
    return (double)single;
}

static struct frustum frustum_of(const struct flat_scene *flat) {
    struct frustum f;
#define TAKE3(name, word, word64)                                                                            \
    for (uint32_t k = 0; k < 3; k++)                                                                         \
        f.name[k] = field(flat, word, k, word64 + k / 2, k % 2 * 2);
#define TAKE(name, word, component, word64, half64)                                                          \
    f.name = field(flat, word, GPU_PART_##component, word64, GPU_PART_##half64);
#define SKIP3(name, word, word64)
#define SKIP(name, word, component, word64, component64)
    FRUSTUM_FIELDS(TAKE3, TAKE, SKIP3, SKIP, SKIP)
    return f;
}

// A place of a ray relative to the base.
struct line {
    long double from[3], to[3];
};

static struct line line_of(const struct frustum *f, vec3 origin, vec3 direction) {
    return (struct line){{origin.x - f->base[0], origin.y - f->base[1], origin.z - f->base[2]},
                         {direction.x, direction.y, direction.z}};
}

// How far outside the body the place is; negative inside. Convex along a line.
static long double outside(const struct frustum *f, const struct line *line, long double t) {
    long double p[3], e2 = 0, z = 0;
    for (int k = 0; k < 3; k++) {
        p[k] = line->from[k] + line->to[k] * t;
        z += p[k] * f->axis[k];
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const long double e = p[i] * f->axis[j] - p[j] * f->axis[i];
        e2 += e * e;
    }
    const long double side = (sqrtl(e2) - f->radius - f->slope * z) / sqrtl(1 + f->slope * f->slope);
    return fmaxl(side, fmaxl(-z, z - f->height));
}

static long double root_between(const struct frustum *f, const struct line *line, long double in,
                                long double out) {
    for (int i = 0; i < 200; i++) {
        const long double middle = (in + out) / 2;
        if (outside(f, line, middle) <= 0)
            in = middle;
        else
            out = middle;
    }
    return in;
}

struct truth {
    long double deepest; // least value of outside(), and where
    long double at;
    long double first, last; // where it is 0, if deepest < 0
};

// By the golden section in a stretch around the place nearest to the middle; outside() is never flat beyond
// its least.
static struct truth truth_of(const struct frustum *f, const struct line *line) {
    const long double reach = f->height + f->radius + f->slope * f->height;
    long double d2 = 0, along = 0;
    for (int k = 0; k < 3; k++) {
        d2 += line->to[k] * line->to[k];
        along += (f->axis[k] * f->height / 2 - line->from[k]) * line->to[k];
    }
    const long double middle = along / d2, half = 4 * reach / sqrtl(d2), golden = 0.6180339887498948482L;
    long double a = middle - half, b = middle + half;
    long double c = b - golden * (b - a), d = a + golden * (b - a);
    long double fc = outside(f, line, c), fd = outside(f, line, d);
    for (int i = 0; i < 200 && (fc > 0 || fd > 0 || i < 100); i++) {
        if (fc < fd) {
            b = d, d = c, fd = fc;
            c = b - golden * (b - a), fc = outside(f, line, c);
        } else {
            a = c, c = d, fc = fd;
            d = a + golden * (b - a), fd = outside(f, line, d);
        }
    }
    struct truth t = {.at = fc < fd ? c : d, .deepest = fminl(fc, fd)};
    if (t.deepest < 0) {
        t.first = root_between(f, line, t.at, middle - half);
        t.last = root_between(f, line, t.at, middle + half);
    }
    return t;
}

// ---- rays

struct aim {
    struct frustum body;
    bool is_double;
    double unit; // 2^-24 or 2^-53
};

static vec3 place_on(const struct frustum *f, double height, double around, double share) {
    const vec3 axis = {(double)f->axis[0], (double)f->axis[1], (double)f->axis[2]};
    const vec3 x = vec3_unit(vec3_cross(axis, fabs(axis.x) < 0.5 ? (vec3){1, 0, 0} : (vec3){0, 1, 0})),
               y = vec3_cross(axis, x);
    const double r = share * (double)(f->radius + f->slope * (long double)height);
    const vec3 base = {(double)f->base[0], (double)f->base[1], (double)f->base[2]};
    return vec3_add(vec3_add(base, vec3_mul(axis, height)),
                    vec3_add(vec3_mul(x, r * cos(around)), vec3_mul(y, r * sin(around))));
}

// On the side, a disc, a rim, the axis, or inside.
static vec3 choose_place(const struct frustum *f, uint64_t *state) {
    const double u = random_unit(state), v = random_unit(state),
                 turn = 6.283185307179586 * random_unit(state);
    const double height = (double)f->height;
    switch (random_bits(state) % 6) {
    case 0:
        return place_on(f, u * height, turn, 1);
    case 1:
        return place_on(f, u < 0.5 ? 0 : height, turn, sqrt(v));
    case 2:
        return place_on(f, u < 0.5 ? 0 : height, turn, 1);
    case 3:
        return place_on(f, u < 0.5 ? u * 1e-5 * height : height - u * 1e-5 * height, turn, 1 - v * 1e-5);
    case 4:
        return place_on(f, u * height, 0, 0);
    default:
        return place_on(f, u * height, turn, v);
    }
}

static struct probe_ray choose_ray(const struct probe *probe, const struct aim *aim, uint64_t seed) {
    uint64_t state = seed;
    const struct frustum *f = &aim->body;
    const double reach = (double)(f->height + f->radius + f->slope * f->height);
    const vec3 target = choose_place(f, &state);
    vec3 start;
    switch (random_bits(&state) % 4) {
    case 0: // near, or inside
        start = choose_place(f, &state);
        start =
            vec3_add(start, vec3_mul(random_direction(&state), reach * pow(2, -20 * random_unit(&state))));
        break;
    case 1: // from one place of it to another: along the surface, or along the axis
        start = vec3_add(target, vec3_mul(vec3_sub(choose_place(f, &state), target), -3));
        break;
    default:
        start = vec3_add(target, vec3_mul(random_direction(&state), reach * (1 + 4 * random_unit(&state))));
        break;
    }
    start = probe_round(probe, start);
    vec3 to = vec3_sub(target, start);
    if (random_bits(&state) % 2)
        to = vec3_unit(to);
    if (vec3_is_zero(to))
        to = (vec3){1, 0, 0};
    // The second one: often nearly along the axis, or across it, which is how it grazes.
    vec3 next = random_direction(&state);
    const vec3 axis = {(double)f->axis[0], (double)f->axis[1], (double)f->axis[2]};
    const double part = pow(2, -30 * random_unit(&state));
    if (random_bits(&state) % 4 == 0)
        next = vec3_unit(vec3_add(vec3_mul(next, part), axis));
    else if (random_bits(&state) % 4 == 0)
        next = vec3_unit(vec3_sub(next, vec3_mul(axis, vec3_dot(next, axis) * (1 - part))));
    return (struct probe_ray){start, probe_round(probe, to), 3e38, probe_round(probe, next)};
}

struct counts {
    unsigned rays, hits, lost, invented, wrong, any, leaks, self;
    double worst; // distance of a hit from the surface, in units of rounding
};

// What rounding may move places by, in units of the precision.
static long double slack_of(const struct aim *aim, const struct line *line, long double t) {
    const struct frustum *f = &aim->body;
    long double most = f->height + f->radius + f->slope * f->height;
    for (int k = 0; k < 3; k++)
        most = fmaxl(most, fmaxl(fabsl(line->from[k] + f->base[k]),
                                 fmaxl(fabsl(line->from[k]), fabsl(line->to[k] * t))));
    return aim->unit * most;
}

// Outward the second ray meets nothing, inward it meets the body, always.
static void judge_second(const struct aim *aim, const struct probe_ray *ray, const struct probe_hit *hit,
                         struct counts *n) {
    const struct line line = line_of(&aim->body, ray->origin, ray->direction);
    const long double at_start = outside(&aim->body, &line, 0);
    n->rays++;
    n->hits += hit->first.found;
    n->any += hit->any != hit->first.found;
    if (!hit->first.found)
        return;
    const bool outward = hit->same_side == (at_start > 0);
    const bool met = hit->second.found && hit->blocked, missed = !hit->second.found && !hit->blocked;
    if (outward ? missed : met)
        return;
    // Which side a ray comes from is open where it starts on the surface, or only grazes it.
    const struct truth truth = truth_of(&aim->body, &line);
    const long double slack = 16 * slack_of(aim, &line, truth.at);
    if (fabsl(at_start) <= slack || truth.deepest > -slack)
        return;
    n->self += outward;
    n->leaks += !outward;
}

static void judge_first(const struct aim *aim, const struct probe_ray *ray, const struct probe_hit *hit,
                        struct counts *n) {
    const struct frustum *f = &aim->body;
    const struct line line = line_of(f, ray->origin, ray->direction);
    const struct truth truth = truth_of(f, &line);
    const long double slack = 16 * slack_of(aim, &line, truth.at), at_start = outside(f, &line, 0);
    const bool ahead = truth.deepest < 0 && truth.last > 0;
    if (!hit->first.found) {
        // Certain where the line is deep inside, ahead of the start, by more than rounding.
        n->lost += ahead && truth.deepest < -slack && outside(f, &line, fmaxl(truth.at, 0)) < -slack &&
                   fabsl(at_start) > slack;
        return;
    }
    n->invented += truth.deepest > slack;
    const long double t = (long double)hit->first.t, off = outside(f, &line, t);
    n->worst = fmax(n->worst, (double)(fabsl(off) / (slack / 16)));
    // At the nearer end, unless it starts inside.
    const bool far_end = t > truth.at && truth.deepest < -slack && at_start > slack;
    n->wrong += fabsl(off) > slack || far_end || t < 0;
}

// ---- bodies

struct shape {
    double radius_from, radius_to, height;
};

static void check(void **state, struct shape shape, bool is_double, double scale, double away,
                  uint64_t seed) {
    struct probe_fixture *fixture = probe_need(state, is_double);
    struct kit kit;
    struct flat_scene flat;
    struct probe probe;
    kit_init(&kit);
    kit.is_double = is_double;
    const vec3 axis = random_direction(&seed),
               from = vec3_mul(random_direction(&seed), 0.7 * scale * shape.height);
    const double reach = shape.height + shape.radius_from + shape.radius_to;
    struct ir_cone *cone = kit_cone(&kit);
    cone->from = from;
    cone->to = vec3_add(from, vec3_mul(axis, shape.height * scale));
    cone->radius_from = shape.radius_from * scale;
    cone->radius_to = shape.radius_to * scale;
    kit.origin = vec3_add(from, vec3_mul(random_direction(&seed), away * reach * scale));
    assert_true(kit_flatten(&kit, &flat));
    const struct aim aim = {frustum_of(&flat), is_double, is_double ? 0x1p-53 : 0x1p-24};
    assert_true(probe_init(&probe, fixture->device.gpu, &flat, true));
    struct counts n = {0};
    for (uint64_t batch = 0; batch < batches; batch++) {
        for (uint64_t i = 0; i < batch_rays; i++)
            fixture->rays[i] = choose_ray(&probe, &aim, seed + (batch * batch_rays + i) * 977);
        assert_true(probe_trace(&probe, fixture->rays, batch_rays, fixture->hits));
        for (size_t i = 0; i < batch_rays; i++)
            judge_second(&aim, &fixture->rays[i], &fixture->hits[i], &n);
        for (size_t i = 0; i < batch_rays; i += step)
            judge_first(&aim, &fixture->rays[i], &fixture->hits[i], &n);
        fixture->sent += batch_rays;
    }
    probe_finish(&probe);
    flat_finish(&flat);
    kit_finish(&kit);
    if (getenv("CONES_SHOW"))
        printf("%s %g %g %g at %g from %g: %u of %u hit, %.1f units off\n", is_double ? "double" : "single",
               shape.radius_from, shape.radius_to, shape.height, scale, away, n.hits, n.rays, n.worst);
    if (n.lost || n.invented || n.wrong || n.any || n.leaks || n.self)
        fail_msg("%s, radii %g %g, height %g, scale %g, %g sizes away: of %u rays %u lost, %u invented, %u "
                 "wrong, %u "
                 "otherwise by any, %u leaked, %u hit what they left; %.1f units off",
                 is_double ? "double" : "single", shape.radius_from, shape.radius_to, shape.height, scale,
                 away, n.rays, n.lost, n.invented, n.wrong, n.any, n.leaks, n.self, n.worst);
}

static void check_both(void **state, struct shape shape, double scale, double away) {
    static uint64_t seed;
    for (int is_double = 0; is_double < 2; is_double++)
        check(state, shape, is_double, scale, away, ++seed);
}

static void test_shapes(void **state) {
    static const struct shape shapes[] = {{1, 1, 2},     {1, 0, 2},     {0, 1, 2},       {1, 0.4, 1},
                                          {0.3, 0.9, 2}, {1, 0.999, 1}, {1, 0.999, 5e3}, {1e-3, 1, 1e-3}};
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        check_both(state, shapes[i], 1, 2);
}

static void test_ratios(void **state) {
    for (double ratio = 1e-6; ratio < 2e6; ratio *= 100) {
        check_both(state, (struct shape){1, 1, ratio}, 1, 1);
        check_both(state, (struct shape){1, 0, ratio}, 1, 1);
        check_both(state, (struct shape){0.25, 1, ratio}, 1, 1);
    }
}

static void test_scales(void **state) {
    for (int exponent = -20; exponent <= 20; exponent += 10) {
        check_both(state, (struct shape){1, 1, 2}, ldexp(1, exponent), 1.5);
        check_both(state, (struct shape){1, 0, 3}, ldexp(1.1, exponent), 100);
    }
}

// ---- the same body in other words

static void flatten_one(bool as_cone, bool is_double, struct flat_scene *flat) {
    struct kit kit;
    kit_init(&kit);
    kit.is_double = is_double;
    kit.origin = (vec3){3, -1, 2};
    const vec3 from = {0.3, -0.7, 0.1}, to = {1.9, 2.2, -0.6};
    if (as_cone) {
        struct ir_cone *cone = kit_cone(&kit);
        cone->from = from;
        cone->to = to;
        cone->radius_from = cone->radius_to = 0.37;
    } else {
        struct ir_cylinder *cylinder = kit_cylinder(&kit);
        cylinder->from = from;
        cylinder->to = to;
        cylinder->radius = 0.37;
    }
    assert_true(kit_flatten(&kit, flat));
    kit_finish(&kit);
}

static void test_cylinder_is_cone(void **state) {
    (void)state;
    for (int is_double = 0; is_double < 2; is_double++) {
        struct flat_scene a, b;
        flatten_one(false, is_double, &a);
        flatten_one(true, is_double, &b);
        assert_int_equal(a.spheres.count, b.spheres.count);
        assert_memory_equal(a.spheres.words, b.spheres.words, a.spheres.count * sizeof *a.spheres.words);
        assert_int_equal(a.sphere_nodes.count, b.sphere_nodes.count);
        assert_memory_equal(a.sphere_nodes.words, b.sphere_nodes.words,
                            a.sphere_nodes.count * sizeof *a.sphere_nodes.words);
        assert_int_equal(a.features, b.features);
        flat_finish(&a);
        flat_finish(&b);
    }
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shapes),       cmocka_unit_test(test_ratios),
        cmocka_unit_test(test_scales),       cmocka_unit_test(test_cylinder_is_cone),
        cmocka_unit_test(device_kit_silent),
    };
    if (argc > 1 && strcmp(argv[1], "full") == 0)
        batches = 4, batch_rays *= 64, step = 64;
    if (argc > 1 && strcmp(argv[argc - 1], "few") == 0)
        batch_rays /= 4;
    return cmocka_run_group_tests_name("cones", tests, probe_setup, probe_teardown);
}
