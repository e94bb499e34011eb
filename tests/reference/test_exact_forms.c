// Spheres, cylinders, cones, boxes and rings against their closed forms: 100 000 random rays at each, from
// outside and inside, with their places, sides and normals; and the area and volume that lines through them
// measure.
#include "reference_kit.h"
#include "tests/unit/kit/form_kit.h"

#include "core/angle.h"
#include "scene/shape.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

enum {
    RAYS = 100000,
    NEEDLE = 3,       // of FORMS: hit by 5 of as many lines through the ball around it
    TORUS_FIRST = 11, // of FORMS: meshes, within their tolerance
};

static const struct form FORMS[] = {
    {"sphere", FORM_SPHERE, .a = 1.3, .place = {0.4, -2, 1}},
    {"cylinder", FORM_FRUSTUM, 0.7, 0.7, 2.1, .place = {-1, 0.5, 3}, .turn = {40, 0, 70}},
    {"flat cylinder", FORM_FRUSTUM, 3, 3, 0.01, .place = {5, 0, 0}, .turn = {10, 0, -20}},
    {"needle", FORM_FRUSTUM, 1e-3, 1e-3, 40, .place = {0, 1, 0}, .turn = {0, 0, 33}},
    {"cone", FORM_FRUSTUM, 1.1, 0, 2, .place = {0.3, 0.2, 0.1}, .turn = {-25, 0, 15}},
    {"cone from its tip", FORM_FRUSTUM, 0, 0.8, 0.6, .place = {2, 0, 0}, .turn = {120, 0, 5}},
    {"frustum", FORM_FRUSTUM, 0.4, 1.7, 1, .place = {0, -3, 0}, .turn = {80, 0, 80}},
    {"nearly a cylinder", FORM_FRUSTUM, 1, 0.999999, 1, .place = {1, 1, 1}, .turn = {15, 0, -65}},
    {"cube", FORM_BOX, 1, 1, 1, .place = {0, 0, 0}},
    {"turned box", FORM_BOX, 0.3, 2, 5, .place = {-4, 2, 7}, .turn = {25, -50, 110}},
    {"plate", FORM_BOX, 4, 1e-3, 3, .place = {0, 9, 0}, .turn = {5, 100, -15}},
    {"ring", FORM_TORUS, 3, 1, .tolerance = 1e-3, .place = {1, 2, 3}, .turn = {60, 20, -35}},
    {"thin ring", FORM_TORUS, 2, 0.05, .tolerance = 1e-4, .place = {0, 0, -1}, .turn = {0, 90, 45}},
    {"ring without a hole", FORM_TORUS, 1, 1, .tolerance = 1e-3, .place = {-1, 0, 0}, .turn = {200, 0, 0}},
};

enum {
    FORM_COUNT = sizeof FORMS / sizeof *FORMS
};

struct scene_of_form {
    struct kit kit;
    struct mesh room;
    struct reference *reference;
};

static void begin(struct scene_of_form *s, const struct form *form) {
    s->room = (struct mesh){0};
    kit_init(&s->kit);
    form_add(&s->kit, form, &s->room);
    reference_kit_camera(&s->kit, vec3_add(form->place, (vec3){0, 0, 10}));
    s->reference = reference_kit_make(&s->kit, REFERENCE_WATERTIGHT, false);
}

static void end(struct scene_of_form *s) {
    reference_destroy(s->reference);
    kit_finish(&s->kit);
    arena_finish(&s->room.arena);
}

// ---- hits and normals

struct line {
    vec3 origin, direction;
};

// One in eight begins deep inside, which in a thin body is nowhere near the others, one in four near the
// body.
static struct line random_line(const struct form *form, uint64_t *random) {
    const double reach = form_reach(form), away = random_below(random, 4) == 0 ? 1 : 6;
    const vec3 middle = form_middle(form);
    const vec3 from = random_below(random, 8) == 0
                          ? form_inside(form, random_unit(random))
                          : vec3_add(middle, vec3_mul(random_in_cube(random), away * reach));
    const vec3 to = vec3_add(middle, vec3_mul(random_in_cube(random), reach));
    return (struct line){from, vec3_unit(vec3_sub(to, from))};
}

// The largest differences: of places in units of the body's size and the ray's length, of normals as they
// are.
struct worst {
    double place, normal;
    uint32_t hits, inside;
};

static void check_exact(const struct reference *r, const struct form *form, const struct line *line,
                        struct worst *worst) {
    struct form_hit truth;
    struct reference_hit hit;
    const bool found = form_first(form, line->origin, line->direction, 0, &truth);
    reference_closest(r, line->origin, line->direction, INFINITY, &hit);
    if (found != (hit.body != HIT_NONE))
        fail_msg("%s: found %d, and should be %d, from %.17g %.17g %.17g", form->name, hit.body != HIT_NONE,
                 found, line->origin.x, line->origin.y, line->origin.z);
    if (!found)
        return;
    worst->hits++;
    worst->inside += !truth.enters;
    assert_int_equal(hit.enters, truth.enters);
    // A ray that grazes the surface stays at it for as long as rounding divided by the cosine.
    const double steep = fabs(vec3_dot(truth.normal, line->direction)), size = form_reach(form) + truth.t;
    const vec3 at = vec3_add(line->origin, vec3_mul(line->direction, truth.t));
    worst->place = fmax(worst->place, fabs(hit.t - truth.t) * steep / size);
    worst->place = fmax(worst->place, vec3_length(vec3_sub(hit.point, at)) * steep / size);
    const vec3 normal = truth.enters ? truth.normal : vec3_neg(truth.normal);
    const double off =
        fmax(vec3_length(vec3_sub(hit.geometric, normal)), vec3_length(vec3_sub(hit.shading, normal)));
    worst->normal = fmax(worst->normal, off * steep);
}

static double least_of(double a, double b) {
    return a > 0 && a < b ? a : b;
}

static void test_rays(void **state) {
    (void)state;
    for (int i = 0; i < TORUS_FIRST; i++) {
        const struct form *form = &FORMS[i];
        struct scene_of_form s;
        struct worst worst = {0};
        uint64_t random = (uint64_t)i + 1;
        begin(&s, form);
        for (uint32_t k = 0; k < RAYS; k++) {
            const struct line line = random_line(form, &random);
            check_exact(s.reference, form, &line, &worst);
        }
        end(&s);
        printf("%-20s %6u of %u rays hit, %6u from inside; places off by %.2g, normals by %.2g\n", form->name,
               worst.hits, RAYS, worst.inside, worst.place, worst.normal);
        assert_in_range(worst.hits, RAYS / 10, RAYS);
        assert_in_range(worst.inside, RAYS / 10, RAYS / 2);
        // The corners of a box and the ends of an axis are rounded, which turns faces; and the smaller a
        // radius, the more the surface turns where its place is rounded.
        const double far = vec3_length(form->place) + form_reach(form);
        const double edge = form->kind == FORM_BOX       ? least_of(form->a, least_of(form->b, form->c))
                            : form->kind == FORM_FRUSTUM ? form->c
                                                         : form->a;
        assert_true(worst.place < 1e-14 * (1 + far / edge));
        assert_true(worst.normal < 1e-13 * (1 + far / least_of(form->a, least_of(form->b, edge))));
    }
}

// ---- rings, within their tolerance

struct worst_ring {
    double off, normal,
        face; // of the tolerance; of what it lets them be, which is more where curves are narrow
    uint32_t hits, inside, skipped;
};

static void check_ring(const struct reference *r, const struct form *form, const struct line *line,
                       struct worst_ring *worst) {
    const double most = form->tolerance * (form->a + form->b);
    const double start = form_near_torus(form, line->origin).outside;
    if (fabs(start) <= most) {
        worst->skipped++;
        return;
    }
    // The mesh lies between two rings: a ray that reaches the farther one has passed it.
    struct form_hit nearer, farther;
    struct reference_hit hit;
    const double side = start > 0 ? most : -most;
    const bool may = form_first(form, line->origin, line->direction, side, &nearer),
               must = form_first(form, line->origin, line->direction, -side, &farther);
    reference_closest(r, line->origin, line->direction, INFINITY, &hit);
    const bool found = hit.body != HIT_NONE;
    if ((must && !found) || (found && !may))
        fail_msg("%s: found %d, from %.17g %.17g %.17g", form->name, found, line->origin.x, line->origin.y,
                 line->origin.z);
    if (!found)
        return;
    worst->hits++;
    worst->inside += start < 0;
    assert_int_equal(hit.enters, start > 0);
    assert_true(hit.t >= nearer.t && (!must || hit.t <= farther.t));
    const struct form_near near = form_near_torus(form, hit.point);
    const vec3 normal = hit.enters ? near.normal : vec3_neg(near.normal);
    // A chord that is at most so far from its circle of radius r is within sqrt(2 most / r) of its
    // directions.
    const double bend = most / form->b + most / near.around;
    worst->off = fmax(worst->off, fabs(near.outside) / most);
    worst->normal = fmax(worst->normal, vec3_length(vec3_sub(hit.shading, normal)) / bend);
    worst->face = fmax(worst->face, vec3_length(vec3_sub(hit.geometric, normal)) / sqrt(bend));
}

static void test_rings(void **state) {
    (void)state;
    for (int i = TORUS_FIRST; i < FORM_COUNT; i++) {
        const struct form *form = &FORMS[i];
        struct scene_of_form s;
        struct worst_ring worst = {0};
        uint64_t random = (uint64_t)i + 1;
        begin(&s, form);
        for (uint32_t k = 0; k < RAYS; k++) {
            const struct line line = random_line(form, &random);
            check_ring(s.reference, form, &line, &worst);
        }
        end(&s);
        printf("%-20s %6u of %u rays hit, %6u from inside, %u began at the surface; off by %.2f of the "
               "tolerance, normals by %.2f, faces by %.2f\n",
               form->name, worst.hits, RAYS, worst.inside, worst.skipped, worst.off, worst.normal,
               worst.face);
        assert_in_range(worst.hits, RAYS / 10, RAYS);
        assert_in_range(worst.inside, RAYS / 10, RAYS / 2);
        assert_in_range(worst.skipped, 0, RAYS / 1000);
        assert_true(worst.off <= 1 && worst.normal <= 1 && worst.face <= 1);
    }
}

// ---- area and volume

static double radical_inverse(uint32_t n, uint32_t base) {
    double part = 1.0 / base, sum = 0;
    for (; n; n /= base, part /= base)
        sum += part * (n % base);
    return sum;
}

// Lines through a ball, every one as likely (Santaló 1976): a direction, and a place of the disc across it.
static struct line even_line(const struct form *form, double radius, uint32_t i) {
    const double z = 2 * radical_inverse(i, 2) - 1, turn = 2 * PI * radical_inverse(i, 3);
    const double away = radius * sqrt(radical_inverse(i, 5)), around = 2 * PI * radical_inverse(i, 7);
    const double flat = sqrt(1 - z * z);
    const vec3 direction = {flat * cos(turn), flat * sin(turn), z};
    const vec3 u = {-sin(turn), cos(turn), 0}, v = vec3_cross(direction, u);
    const vec3 across = vec3_add(vec3_mul(u, away * cos(around)), vec3_mul(v, away * sin(around)));
    const vec3 middle = vec3_add(form_middle(form), across);
    return (struct line){vec3_sub(middle, vec3_mul(direction, 2 * radius)), direction};
}

struct measures {
    double area, volume;
    uint32_t hits;
};

// Crofton's formulas: the mean number of crossings is the area divided by 2 pi r^2, and the mean length
// inside the volume divided by pi r^2.
static struct measures measure(const struct reference *r, const struct form *form) {
    const double radius = 1.01 * form_reach(form);
    uint32_t hits = 0, crossings = 0;
    double inside = 0;
    for (uint32_t k = 1; k <= RAYS; k++) {
        const struct line line = even_line(form, radius, k);
        struct reference_hit hit;
        vec3 from = line.origin;
        uint32_t n = 0;
        for (;; n++) {
            reference_closest(r, from, line.direction, INFINITY, &hit);
            if (hit.body == HIT_NONE)
                break;
            assert_int_equal(hit.enters, n % 2 == 0);
            inside += hit.enters ? 0 : vec3_length(vec3_sub(hit.point, from));
            from = hit.start_through;
        }
        assert_true(n % 2 == 0 && n <= (form->kind == FORM_TORUS ? 4 : 2));
        crossings += n;
        hits += n > 0;
    }
    return (struct measures){2 * PI * radius * radius * crossings / RAYS,
                             PI * radius * radius * inside / RAYS, hits};
}

// What facets within the tolerance leave out of a ring's volume, to first order; of its area a quarter of it.
static double left_out(const struct form *form) {
    return form->kind == FORM_TORUS ? 2.0 / 3 * form->tolerance * (1 + (form->a + form->b) / form->b) : 0;
}

static void test_measures(void **state) {
    (void)state;
    for (int i = 0; i < FORM_COUNT; i++) {
        const struct form *form = &FORMS[i];
        struct scene_of_form s;
        if (i == NEEDLE)
            continue;
        begin(&s, form);
        const struct measures got = measure(s.reference, form);
        end(&s);
        const double area = got.area / form_area(form) - 1, volume = got.volume / form_volume(form) - 1;
        printf("%-20s %6u of %u lines hit; area off by %8.2g, volume by %8.2g\n", form->name, got.hits, RAYS,
               area, volume);
        // These lines cover space more evenly than random ones, whose error this would be.
        const double chance = 1 / sqrt(got.hits);
        assert_true(fabs(area) < chance + left_out(form) / 4 && fabs(volume) < 2 * chance + left_out(form));
    }
}

// The volume that rules compute with.
static void test_volumes(void **state) {
    (void)state;
    for (int i = 0; i < FORM_COUNT; i++) {
        const struct form *form = &FORMS[i];
        struct scene_of_form s;
        begin(&s, form);
        const double off = shape_volume(&s.kit.resolved.bodies[0]) / form_volume(form) - 1;
        end(&s);
        // The height of the flat cylinder is a difference of places 500 times as large.
        assert_true(form->kind == FORM_TORUS ? off <= 0 && off >= -left_out(form) : fabs(off) < 1e-13);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rays),
        cmocka_unit_test(test_rings),
        cmocka_unit_test(test_measures),
        cmocka_unit_test(test_volumes),
    };
    return cmocka_run_group_tests_name("exact forms", tests, NULL, NULL);
}
