// Searches over settings whose errors and times a formula gives: what is tried, what it costs, what is found.
#include "measure/tradeoff/choose/choose.h"
#include "measure/tradeoff/plan/plan_search.h"
#include "scene/view.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

// A scene: what its pictures err by, and what a sample takes.
struct world {
    double noise;     // error of one sample
    double depth;     // error of paths of no bounce; halved by each further one
    double weight;    // error for each 1 of min_weight
    double darkness;  // error without shadows
    uint32_t deepest; // deeper paths are not longer
    double rounding;  // of the format
};

// What remains of the error with all samples.
static double floor_of(const struct world *w, const struct setting *s) {
    const double depth = s->max_depth < w->deepest ? w->depth * pow(0.5, s->max_depth) : 0;
    return depth + w->weight * s->min_weight + (s->shadows ? 0 : w->darkness) + (s->width < 64 ? 0.05 : 0);
}

static double error_of(const struct world *w, const struct setting *s) {
    return w->noise / sqrt(s->samples) + floor_of(w, s);
}

static double time_of(const struct world *w, const struct setting *s) {
    const uint32_t depth = s->max_depth < w->deepest ? s->max_depth : w->deepest;
    return s->samples * (1.0 + depth) * (s->is_double ? 2 : 1) * (s->shadows ? 1.5 : 1);
}

static struct plan_search_input input_of(const struct world *w) {
    const struct setting base = {.width = 64,
                                 .height = 48,
                                 .samples = 4,
                                 .max_depth = 8,
                                 .min_weight = 0.001,
                                 .is_double = true,
                                 .shadows = true};
    return (struct plan_search_input){.base = base,
                                      .metric = METRIC_MAE,
                                      .error_most = (double)NAN,
                                      .time_most_ms = (double)NAN,
                                      .deepest = w->deepest < 8 ? w->deepest : 8,
                                      .bounces = true};
}

struct found {
    struct row rows[SEARCH_ROWS_MAX];
    uint32_t count;
    uint32_t drawn; // samples of pictures: those of the row before go on where only samples differ
};

static uint32_t more_drawn(const struct found *f, const struct setting *next) {
    struct setting same = *next;
    uint32_t before = 0;
    for (uint32_t i = f->count; i-- > 0 && !before;) {
        same.samples = f->rows[i].setting.samples;
        bool equal = same.samples != SEARCH_PROBE;
        for (int knob = 0; knob < KNOB_COUNT; knob++)
            equal &= !plan_differs(&same, &f->rows[i].setting, (enum knob)knob);
        before = equal ? same.samples : 0;
    }
    return f->drawn + (next->samples > before ? next->samples - before : 0);
}

static void run(const struct world *w, const struct plan_search_input *input, struct found *f) {
    struct row next;
    memset(f, 0, sizeof *f);
    while (plan_search_next(input, f->rows, f->count, &next)) {
        assert_true(f->count < SEARCH_ROWS_MAX);
        for (uint32_t i = 0; i < f->count; i++)
            assert_true((f->rows[i].setting.samples == SEARCH_PROBE) !=
                            (next.setting.samples == SEARCH_PROBE) ||
                        strcmp(f->rows[i].name, next.name) != 0);
        for (int i = 0; i < METRIC_COUNT; i++)
            next.value[i] = (double)NAN;
        next.floor = floor_of(w, &next.setting);
        if (next.setting.samples != SEARCH_PROBE)
            next.value[METRIC_MAE] = error_of(w, &next.setting);
        next.time_ms = time_of(w, &next.setting);
        next.rounding = w->rounding;
        f->drawn = more_drawn(f, &next.setting);
        f->rows[f->count++] = next;
    }
}

// The fastest row within the bound; NULL: there is none.
static const struct row *cheapest(const struct found *f, double bound) {
    const struct row *best = NULL;
    for (uint32_t i = 0; i < f->count; i++)
        if (f->rows[i].choosable && f->rows[i].value[METRIC_MAE] <= bound &&
            (!best || f->rows[i].time_ms < best->time_ms))
            best = &f->rows[i];
    return best;
}

static const struct row *best_within(const struct found *f, double limit) {
    const struct row *best = NULL;
    for (uint32_t i = 0; i < f->count; i++)
        if (f->rows[i].time_ms <= limit && (!best || f->rows[i].value[METRIC_MAE] < best->value[METRIC_MAE]))
            best = &f->rows[i];
    return best;
}

static void a_loose_bound_needs_one_sample(void **state) {
    (void)state;
    const struct world w = {.noise = 0.02, .depth = 0.04, .weight = 0.1, .darkness = 0.5, .deepest = 8};
    struct plan_search_input input = input_of(&w);
    struct found f;
    input.error_most = 0.05;
    run(&w, &input, &f);
    const struct row *row = cheapest(&f, 0.05);
    assert_non_null(row);
    assert_int_equal(row->setting.samples, 1);
    assert_true(row->setting.max_depth < 8 && !row->setting.is_double && row->setting.shadows);
    assert_true(f.drawn <= 4);
}

// Samples are added until the bound is kept, as many as are foretold, and each is drawn once.
static void a_tight_bound_needs_more(void **state) {
    (void)state;
    const struct world w = {.noise = 0.02, .depth = 0.4, .weight = 1, .darkness = 0.5, .deepest = 8};
    struct plan_search_input input = input_of(&w);
    struct found f;
    input.error_most = 0.0085;
    run(&w, &input, &f);
    const struct row *row = cheapest(&f, 0.0085);
    assert_non_null(row);
    assert_true(row->setting.samples >= 7 && row->setting.samples <= 9);
    assert_true(f.drawn <= row->setting.samples + 2);
    for (uint32_t i = 0; i < f.count; i++)
        assert_true(f.rows[i].setting.width == 64);
}

// Many times the file's samples, if that is what it takes, and hardly more of them than that.
static void samples_go_on_until_the_bound_is_kept(void **state) {
    (void)state;
    const struct world w = {.noise = 0.1, .darkness = 0.5, .deepest = 2};
    struct plan_search_input input = input_of(&w);
    struct found f;
    for (double samples = 100; samples < 3600; samples *= 1.37) {
        input.error_most = 0.1 / sqrt(samples);
        run(&w, &input, &f);
        const struct row *row = cheapest(&f, input.error_most);
        assert_non_null(row);
        assert_true(row->setting.samples >= samples - 1 && row->setting.samples < 1.3 * samples);
        assert_true(f.drawn <= row->setting.samples + 4);
    }
}

// What no picture's samples can keep is not tried to its end, and it says what would.
static void hopeless_bounds_are_given_up(void **state) {
    (void)state;
    const struct world w = {.noise = 0.02, .depth = 0, .weight = 0, .darkness = 0.5, .deepest = 2};
    struct plan_search_input input = input_of(&w);
    struct found f;
    input.error_most = 1e-5;
    run(&w, &input, &f);
    assert_null(cheapest(&f, 1e-5));
    assert_true(f.drawn <= 16);
    const struct search_verdict v = plan_search_verdict(&input, f.rows, f.count);
    assert_int_equal(v.kind, SEARCH_SAMPLES);
    assert_true(fabs(v.samples / 4e6 - 1) < 0.1 && v.seconds > 0);
}

static void what_is_out_of_reach_is_said(void **state) {
    (void)state;
    struct world w = {.noise = 0.02, .darkness = 0.5, .deepest = 2, .rounding = 0.001};
    struct plan_search_input input = input_of(&w);
    struct found f;
    input.error_most = 0.0009;
    run(&w, &input, &f);
    assert_null(cheapest(&f, 0.0009));
    assert_true(f.drawn <= 2);
    assert_int_equal(plan_search_verdict(&input, f.rows, f.count).kind, SEARCH_FORMAT);
    w.rounding = 0;
    w.weight = 10; // of 0.001
    run(&w, &input, &f);
    assert_true(f.drawn == 0);
    const struct search_verdict v = plan_search_verdict(&input, f.rows, f.count);
    assert_int_equal(v.kind, SEARCH_REMAINS);
    assert_true(fabs(v.value - 0.01) < 1e-9);
}

// The file's paths are too short: longer ones are tried, and only then.
static void longer_paths_where_the_file_cuts(void **state) {
    (void)state;
    const struct world w = {.noise = 0.004, .depth = 4, .weight = 0, .darkness = 1, .deepest = 14};
    struct plan_search_input input = input_of(&w);
    struct found f;
    input.error_most = 0.01;
    input.cut = true;
    run(&w, &input, &f);
    const struct row *row = cheapest(&f, 0.01);
    assert_non_null(row);
    assert_true(row->setting.max_depth > 8);
    const struct world short_paths = {.noise = 0.004, .darkness = 1, .deepest = 14};
    run(&short_paths, &input, &f);
    for (uint32_t i = 0; i < f.count; i++)
        assert_true(f.rows[i].setting.max_depth <= 8);
}

// A scene may not ask for more than 64: no row does.
static void paths_grow_no_longer_than_a_scene_may_ask_for(void **state) {
    (void)state;
    const struct world w = {.noise = 0.02, .depth = 1e12, .deepest = 100};
    struct plan_search_input input = input_of(&w);
    struct found f;
    uint32_t deepest = 0;
    input.base.max_depth = 12;
    input.deepest = 12;
    input.cut = true;
    input.error_most = 1e-6;
    run(&w, &input, &f);
    for (uint32_t i = 0; i < f.count; i++)
        deepest = f.rows[i].setting.max_depth > deepest ? f.rows[i].setting.max_depth : deepest;
    assert_int_equal(deepest, 64);
}

static void smaller_pictures_only_where_allowed(void **state) {
    (void)state;
    const struct world w = {.noise = 0.01, .darkness = 1, .deepest = 1};
    struct plan_search_input input = input_of(&w);
    struct found f;
    input.error_most = 0.08;
    run(&w, &input, &f);
    assert_int_equal(cheapest(&f, 0.08)->setting.width, 64);
    input.allow_resolution = true;
    run(&w, &input, &f);
    assert_true(f.rows[f.count - 1].setting.width < 64);
}

static void as_many_samples_as_fit(void **state) {
    (void)state;
    const struct world w = {.noise = 0.02, .depth = 0.4, .weight = 1, .darkness = 1, .deepest = 8};
    struct plan_search_input input = input_of(&w);
    struct found f;
    input.time_most_ms = 200; // a sample takes 27
    run(&w, &input, &f);
    const struct row *row = best_within(&f, 200);
    assert_non_null(row);
    assert_int_equal(row->setting.samples, 7);
    assert_int_equal(row->setting.max_depth, 8);
}

static void shorter_paths_where_one_sample_takes_too_long(void **state) {
    (void)state;
    const struct world w = {.noise = 0.02, .depth = 0.4, .weight = 1, .darkness = 1, .deepest = 8};
    struct plan_search_input input = input_of(&w);
    struct found f;
    input.time_most_ms = 10;
    run(&w, &input, &f);
    const struct row *row = best_within(&f, 10);
    assert_non_null(row);
    assert_true(row->setting.max_depth < 8 && row->setting.samples == 1);
}

// Pilots go on while samples want more rays, and end where they cost too much; longer where it still matters.
static void pilots_end_where_rays_cost_too_much(void **state) {
    (void)state;
    struct plan_search_pilot pilots[PLAN_PILOTS_MAX] = {{16, 10, (double)INFINITY, true}};
    assert_int_equal(plan_search_pilot(pilots, 0, 100, 16384, 0.001), PLAN_PILOT_SEGMENTS);
    assert_int_equal(plan_search_pilot(pilots, 1, 100, 16384, 0.001), 64);
    assert_int_equal(plan_search_pilot(pilots, 1, 9, 16384, 0.001), 64);
    assert_int_equal(plan_search_pilot(pilots, 1, 2, 16384, 0.001), 0);
    pilots[1] = (struct plan_search_pilot){64, 30, 0.0001, true};
    assert_int_equal(plan_search_pilot(pilots, 2, 100, 16384, 0.001), 256);
    assert_int_equal(plan_search_pilot(pilots, 2, 20, 16384, 0.001), 0);
    pilots[1].cut = false;
    assert_int_equal(plan_search_pilot(pilots, 2, 100, 16384, 0.001), 0);
    assert_int_equal(plan_search_pilot(pilots, 1, 100, 40, 0.001), 40);
}

static void safe_values_are_worse(void **state) {
    (void)state;
    assert_true(fabs(plan_search_safe(METRIC_MAE, 0.1, 0.1) - 0.11) < 1e-12);
    assert_true(fabs(plan_search_safe(METRIC_SSIM, 0.9, 0.1) - 0.89) < 1e-12);
    assert_true(plan_search_safe(METRIC_PSNR, 40, 0.1) < 40);
}

// The reference's share of a search is bounded, whatever the picture and its paths.
static void probes_are_small_where_paths_are_long(void **state) {
    (void)state;
    const struct setting base = {.width = 4000, .height = 3000};
    for (double rays = 1; rays < 500; rays *= 2) {
        const struct plan_search_probe p = plan_search_probe(&base, rays);
        assert_true(p.samples >= 1 && rays * p.width * p.height * p.samples < 1.1e6);
    }
    const struct setting small = {.width = 48, .height = 32};
    const struct plan_search_probe p = plan_search_probe(&small, 3);
    assert_true(p.width == 48 && p.height == 32 && p.samples == 4);
}

// With nine tenths of the bound used up by what longer paths would add, samples would never end: they are few
// where lighter paths are followed first.
static void little_remains_before_samples_are_many(void **state) {
    (void)state;
    const struct world w = {.noise = 0.02, .weight = 3.4, .darkness = 0.5, .deepest = 8};
    struct plan_search_input input = input_of(&w);
    struct found f;
    input.error_most = 0.004;
    input.cut = true;
    run(&w, &input, &f);
    const struct row *row = cheapest(&f, 0.004);
    assert_non_null(row);
    assert_true(row->setting.min_weight < 0.001 && row->setting.samples <= 60);
    assert_true(f.drawn <= 2 * row->setting.samples);
}

// ---- two means of samples at straight edges, by edges of this test

static double mean_within(double a, double b, double from, uint32_t first, uint32_t count) {
    double x, y, within = 0;
    for (uint32_t i = first; i < first + count; i++) {
        view_sample_offset(i, &x, &y);
        within += (x - 0.5) * a + (y - 0.5) * b > from;
    }
    return within / count;
}

// Of a pixel, by lines of it.
static double share_within(double a, double b, double from) {
    double share = 0;
    for (int i = 0; i < 200; i++) {
        const double rest = from - ((i + 0.5) / 200 - 0.5) * a;
        const double y = fmin(fmax(rest / b, -0.5), 0.5);
        share += (b > 0 ? 0.5 - y : y + 0.5) / 200;
    }
    return share;
}

static void means_tell_how_far_edges_are_off(void **state) {
    (void)state;
    for (uint32_t n = 2; n < 60; n++) {
        const uint32_t older = (n + 1) / 2, newer = n - older;
        double error = 0, apart = 0;
        for (int turn = 0; turn < 45; turn++)
            for (int k = -10; k <= 10; k++) {
                const double angle = 0.07 + turn * 8 * 3.14159265358979 / 180, a = cos(angle), b = sin(angle);
                const double mean = mean_within(a, b, 0.07 * k, 0, n);
                error += fabs(mean - share_within(a, b, 0.07 * k));
                apart += fabs(mean - mean_within(a, b, 0.07 * k, older, newer));
            }
        assert_true(plan_search_reach(n, older, newer) * apart > 0.9 * error);
    }
    assert_true(plan_search_reach(11, 6, 5) > 1.5 * sqrt(5.0 / 6));
    assert_true(plan_search_reach(1, 1, 1) >= sqrt(0.5));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_loose_bound_needs_one_sample),
        cmocka_unit_test(a_tight_bound_needs_more),
        cmocka_unit_test(samples_go_on_until_the_bound_is_kept),
        cmocka_unit_test(what_is_out_of_reach_is_said),
        cmocka_unit_test(probes_are_small_where_paths_are_long),
        cmocka_unit_test(hopeless_bounds_are_given_up),
        cmocka_unit_test(longer_paths_where_the_file_cuts),
        cmocka_unit_test(paths_grow_no_longer_than_a_scene_may_ask_for),
        cmocka_unit_test(smaller_pictures_only_where_allowed),
        cmocka_unit_test(as_many_samples_as_fit),
        cmocka_unit_test(shorter_paths_where_one_sample_takes_too_long),
        cmocka_unit_test(pilots_end_where_rays_cost_too_much),
        cmocka_unit_test(safe_values_are_worse),
        cmocka_unit_test(little_remains_before_samples_are_many),
        cmocka_unit_test(means_tell_how_far_edges_are_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
