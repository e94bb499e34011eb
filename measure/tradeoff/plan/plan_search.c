#include "measure/tradeoff/plan/plan_search.h"

#include <math.h>

enum {
    LADDER_MAX = 4,
    PILOT_STEP = 4,       // from one pilot's rays to the next one's
    PILOT_RAYS_TIMES = 4, // what a pilot may take where too much weight is left
    TRUTH_TIMES = 2,      // samples for one of a row
    TRUTH_LEAST = 8,      // more than that, or as many again if those are fewer
    SETTLED = 8,          // samples from which on errors tell of more
    DEEPER_MOST = 2,      // times that paths are made longer
    TRUTH_RENDERS = 1,    // the file's rays, times this, for a sample that is followed to its end
};
// Rays of the reference that take about a second, whatever the picture.
static const double TRUTH_RAYS_LEAST = 1e6;
// Four times the samples make errors about half as large. Where they do not, something else is wrong.
static const double STAGNATES = 0.9;
// Errors fall no faster than by this power of the samples: those of edges by about 0.75, of the rest by 0.5.
static const double FALLS = 0.75;
// Of the bound: what may remain however many samples there are.
static const double FLOOR_SHARE = 0.9;
// Of the time that is left, for the next try.
static const double TIME_SHARE = 0.97;

struct searching {
    const struct plan_search_input *input;
    const struct row *rows;
    uint32_t count;
    struct row *next;
    bool pending; // a row was asked for that is not measured
};

static bool is_same(const struct setting *a, const struct setting *b) {
    for (int knob = 0; knob < KNOB_COUNT; knob++)
        if (plan_differs(a, b, (enum knob)knob))
            return false;
    return true;
}

// The row of a setting; NULL: it must be measured first, and the search ends here.
static const struct row *ask(struct searching *s, const struct setting *setting) {
    if (s->pending)
        return NULL;
    for (uint32_t i = 0; i < s->count; i++)
        if (is_same(&s->rows[i].setting, setting))
            return &s->rows[i];
    *s->next = (struct row){.setting = *setting};
    s->pending = true;
    return NULL;
}

static double error_of(const struct searching *s, const struct row *row) {
    const double error = metric_error(s->input->metric, row->value[s->input->metric]);
    return row->not_finite || isnan(error) ? (double)INFINITY : error;
}

static bool keeps(const struct searching *s, const struct row *row) {
    return error_of(s, row) <= s->input->error_most;
}

uint32_t plan_search_samples(const struct setting *base) {
    const uint32_t times = SEARCH_SAMPLES_TIMES * base->samples;
    return times > SEARCH_SAMPLES_LEAST ? times : SEARCH_SAMPLES_LEAST;
}

// ---- by error

static struct setting deeper(const struct setting *at) {
    struct setting s = *at;
    s.max_depth = at->max_depth ? 2 * at->max_depth : 2;
    s.min_weight = at->min_weight / 10;
    return s;
}

// Whether samples of this setting could still keep the bound, going by its last rows: errors fall no faster
// than samples rise.
static bool is_hopeless(const struct searching *s, double before_last, double now, uint32_t samples) {
    const double more = (double)plan_search_samples(&s->input->base) / samples;
    const double least = now * pow(more, -FALLS);
    if (samples < 2 || !(now > 0) || !(s->input->error_most >= 0))
        return false;
    return least > s->input->error_most || (samples >= SETTLED && now > STAGNATES * before_last);
}

// Doubles the samples until the bound is kept. NULL: it is not, or a row must be measured first.
static const struct row *climb(struct searching *s, struct setting *at) {
    double last = (double)INFINITY, before_last = (double)INFINITY;
    for (at->samples = 1; at->samples <= plan_search_samples(&s->input->base); at->samples *= 2) {
        const struct row *row = ask(s, at);
        if (!row || keeps(s, row))
            return row;
        if (is_hopeless(s, before_last, error_of(s, row), at->samples))
            return NULL;
        before_last = last;
        last = error_of(s, row);
    }
    return NULL;
}

// Where the file's own settings cut too much for the bound, longer paths.
static const struct row *climb_anywhere(struct searching *s, struct setting *at) {
    const double most = s->input->error_most;
    if (!s->input->cut || s->input->floor <= most - (1 - FLOOR_SHARE) * fabs(most))
        return climb(s, at);
    const struct row *row = NULL;
    for (int i = 0; !row && !s->pending && i < DEEPER_MOST; i++) {
        *at = deeper(at);
        row = climb(s, at);
    }
    return row;
}

// Settings from coarse to fine, all coarser than *at: the coarsest that keeps the bound, by halving.
static void lower(struct searching *s, struct setting *at, const struct setting *ladder, uint32_t count) {
    uint32_t low = 0, high = count; // all below `low` fail; `high` keeps it, or is *at itself
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const struct row *row = ask(s, &ladder[middle]);
        if (!row)
            return;
        if (keeps(s, row))
            high = middle;
        else
            low = middle + 1;
    }
    if (high < count)
        *at = ladder[high];
}

static void lower_samples(struct searching *s, struct setting *at) {
    struct setting fewer = *at;
    fewer.samples = at->samples / 4 * 3;
    if (at->samples >= 4)
        lower(s, at, &fewer, 1);
}

static void lower_size(struct searching *s, struct setting *at) {
    struct setting ladder[LADDER_MAX];
    const uint32_t count = s->input->allow_resolution ? plan_sizes(at, ladder) : 0;
    lower(s, at, ladder, count);
}

static void lower_depth(struct searching *s, struct setting *at) {
    struct setting ladder[LADDER_MAX];
    uint32_t count = 0;
    const uint32_t own = at->max_depth < s->input->deepest ? at->max_depth : s->input->deepest;
    for (uint32_t part = 8; part > 1; part /= 2)
        if (count == 0 || own / part > ladder[count - 1].max_depth) {
            ladder[count] = *at;
            ladder[count++].max_depth = own / part;
        }
    lower(s, at, ladder, own ? count : 0);
}

static void lower_weight(struct searching *s, struct setting *at) {
    static const double weights[] = {0.1, 0.03, 0.01};
    struct setting ladder[LADDER_MAX];
    uint32_t count = 0;
    for (size_t i = 0; i < sizeof weights / sizeof *weights; i++)
        if (weights[i] > at->min_weight) {
            ladder[count] = *at;
            ladder[count++].min_weight = weights[i];
        }
    lower(s, at, ladder, at->max_depth ? count : 0);
}

static void lower_others(struct searching *s, struct setting *at) {
    struct setting coarse = *at;
    coarse.is_double = false;
    lower(s, at, &coarse, at->is_double);
    coarse = *at;
    coarse.shadows = false;
    lower(s, at, &coarse, at->shadows);
}

static void by_error(struct searching *s) {
    struct setting at = s->input->base;
    at.error = 0; // the search says how many samples there are
    if (!climb_anywhere(s, &at))
        return;
    lower_samples(s, &at);
    lower_size(s, &at);
    if (s->input->bounces) {
        lower_depth(s, &at);
        lower_weight(s, &at);
    }
    lower_others(s, &at);
}

// ---- by time

// How many samples of the row's setting fit into the time, going by the row's own.
static uint32_t samples_in(const struct searching *s, const struct row *row) {
    const double fit = s->input->time_most_ms / row->time_ms * row->setting.samples;
    const uint32_t most = plan_search_samples(&s->input->base);
    return fit >= most ? most : fit >= 1 ? (uint32_t)fit : 0;
}

// As many samples as fit, more than `more_than`; returns how many, or 0.
static uint32_t fill(struct searching *s, struct setting at, uint32_t more_than) {
    at.samples = 1;
    const struct row *one = ask(s, &at);
    const uint32_t fit = one ? samples_in(s, one) : 0;
    if (fit <= 1 || fit <= more_than)
        return fit <= more_than ? 0 : fit;
    at.samples = fit;
    const struct row *row = ask(s, &at);
    if (!row || row->time_ms <= s->input->time_most_ms)
        return fit;
    // One sample told too little of the others.
    at.samples = (uint32_t)fmax(TIME_SHARE * samples_in(s, row), 1);
    ask(s, &at);
    return at.samples;
}

// Shorter paths, and lighter ones left out.
static struct setting cheaper(const struct searching *s, const struct setting *at) {
    const uint32_t own = at->max_depth < s->input->deepest ? at->max_depth : s->input->deepest;
    struct setting c = *at;
    c.max_depth = own / 2;
    c.min_weight = fmax(at->min_weight, 0.03);
    return c;
}

static void by_time(struct searching *s) {
    struct setting at = s->input->base;
    at.error = 0; // the search says how many samples there are
    uint32_t fit = fill(s, at, 0);
    for (int i = 0; s->input->bounces && !s->pending && at.max_depth > 0 && i < (fit ? 2 : 8); i++) {
        at = cheaper(s, &at);
        const uint32_t more = fill(s, at, fit);
        if (fit && more)
            break; // of a bound of time that is kept, one shorter way shows whether it is worth it
        fit = more > fit ? more : fit;
    }
    if (s->pending || fit)
        return;
    at.shadows = false;
    fill(s, at, 0);
    struct setting sizes[LADDER_MAX];
    const uint32_t count = s->input->allow_resolution ? plan_sizes(&at, sizes) : 0;
    for (uint32_t i = count; i-- > 0 && !s->pending && !fit;)
        fit = fill(s, sizes[i], 0);
}

bool plan_search_next(const struct plan_search_input *input, const struct row *rows, uint32_t count,
                      struct row *next) {
    struct searching s = {input, rows, count, next, false};
    if (count >= SEARCH_ROWS_MAX)
        return false;
    if (isnan(input->error_most))
        by_time(&s);
    else
        by_error(&s);
    if (s.pending)
        plan_describe(next, &input->base);
    return s.pending;
}

// ---- the ground truth

double plan_search_safe(enum metric metric, double value, double share) {
    if (metric == METRIC_PSNR)
        return value - 20 * log10(1 + share);
    if (metric == METRIC_SSIM)
        return 1 - (1 + share) * (1 - value);
    return (1 + share) * value;
}

uint32_t plan_search_truth(uint32_t samples) {
    const uint32_t times = TRUTH_TIMES * samples, more = times < TRUTH_LEAST ? times : TRUTH_LEAST;
    return times + more > TRUTH_LEAST ? times + more : TRUTH_LEAST;
}

double plan_search_rays(const struct setting *base, double own) {
    const double pixels = (double)base->width * base->height;
    return fmax(TRUTH_RENDERS * own * base->samples, TRUTH_RAYS_LEAST / pixels);
}

uint64_t plan_search_pilot(const struct plan_search_pilot *pilots, uint32_t count, double rays_most,
                           uint64_t segments_most, double bearable) {
    if (count == 0)
        return segments_most < PLAN_PILOT_SEGMENTS ? segments_most : PLAN_PILOT_SEGMENTS;
    const struct plan_search_pilot *last = &pilots[count - 1];
    const double most = last->change > bearable ? PILOT_RAYS_TIMES * rays_most : rays_most;
    if (!last->cut || last->segments >= segments_most || count == PLAN_PILOTS_MAX || last->rays > most)
        return 0;
    const uint64_t next = last->segments * PILOT_STEP;
    return next < segments_most ? next : segments_most;
}
