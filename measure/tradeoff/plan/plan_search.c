#include "measure/tradeoff/plan/plan_search.h"

#include <math.h>

enum {
    LADDER_MAX = 4,
    PILOT_STEP = 4,       // from one pilot's rays to the next one's
    PILOT_RAYS_TIMES = 2, // how much a pilot may take if too much weight is left
    PROBE_LEAST = 1 << 10,
    PROBE_MOST = 1 << 16, // pixels
    PROBE_SAMPLES = 4,    // at most
    SETTLED = 8,          // samples from which on errors allow predictions
    SETTLED_WELL = 24,    // and from which on they tell that more samples do not help
    DEEPER_MOST = 6,      // times that paths are made longer
    DEPTH_MOST = 64,      // that a scene may have
    STEP_FEW = 2,         // factor on the samples, while they are few
    STEP_MOST = 4,
};
// Rays of the reference that take about half a second, whatever the picture.
static const double TRUTH_RAYS = 6e5;
// Each time that paths are made longer, rays lighter by this factor are followed too.
static const double DEEPER_WEIGHT = 3;
// Errors fall by about this power of the samples: those of edges by about 0.75, of the rest by 0.5.
static const double FALLS_LEAST = 0.4, FALLS = 0.5, FALLS_MOST = 0.75;
// Four times the samples make errors about half as large. If they fall by no more than this power, something
// else is wrong.
static const double STAGNATES = 0.15;
// A row has AIM times the samples that are predicted to keep the bound, but at least STEP_LEAST times those
// of the row before it.
static const double AIM = 1.06, STEP_LEAST = 1.15;
// Shares of the bound that an error which no samples remove may take up. The less it takes up, the fewer
// samples keep the bound: at most 0.6 is aimed at, and with more than 0.9 too many samples would be needed.
static const double FLOOR_AIM = 0.6, FLOOR_SHARE = 0.9;
// How much more error may remain if less is traced, as a share of the bound.
static const double LOWER_SHARE = 0.1;
// After a row that took too long, the next one has this share of the samples that would fit at its pace.
static const double TIME_SHARE = 0.97;

// Up to so many samples may all have missed what is small and bright.
static const uint32_t FEW = 16;
// Samples of all pixels that are soon drawn, and the most for each sample of a picture.
static const double MORE_ALL = 1 << 20, MORE_EACH = 2;

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

// The amount proportional to the size of the differences, from a value as metric_error has it.
static double amount_of(enum metric metric, double error) {
    return metric == METRIC_PSNR     ? pow(10, error / 20)
           : metric == METRIC_SSIM   ? sqrt(fmax(1 + error, 0))
           : metric == METRIC_RELMSE ? sqrt(fmax(error, 0))
                                     : fmax(error, 0);
}

// The bound, or a share of it.
static double share_of_bound(const struct plan_search_input *in, double share) {
    const double value = metric_infos[in->metric].higher_is_better ? -in->error_most : in->error_most;
    return metric_error(in->metric, plan_search_safe(in->metric, value, share - 1));
}

// ---- what samples do

struct climb {
    double floor;                         // amount that remains however many samples there are
    double samples, amount;               // of the last row
    double before_samples, before_amount; // of the one before it; 0: there was none
};

// The part of an amount that is due to chance. The two parts add up like independent errors.
static double by_chance(const struct climb *c, double amount) {
    return amount > c->floor ? sqrt(amount * amount - c->floor * c->floor) : 0;
}

// The power of the samples with which errors by chance fall, judging by the last two rows.
static double falls(const struct climb *c) {
    const double now = by_chance(c, c->amount), before = by_chance(c, c->before_amount);
    if (!(c->before_samples >= 2) || !(now > 0) || !(before > 0))
        return FALLS;
    return fmin(fmax(log(before / now) / log(c->samples / c->before_samples), FALLS_LEAST), FALLS_MOST);
}

// The number of samples that keep the bound, judging by the last rows.
static double foretold(const struct plan_search_input *in, const struct climb *c, double power) {
    const double bound = by_chance(c, amount_of(in->metric, in->error_most));
    return bound > 0 ? c->samples * pow(by_chance(c, c->amount) / bound, 1 / power) : (double)INFINITY;
}

static bool stagnates(const struct climb *c) {
    return c->before_samples >= SETTLED_WELL && c->samples >= STEP_FEW * c->before_samples &&
           c->amount > c->before_amount * pow(c->before_samples / c->samples, STAGNATES);
}

static bool is_hopeless(const struct plan_search_input *in, const struct climb *c) {
    const bool known = c->samples >= SETTLED;
    return !(amount_of(in->metric, in->error_most) > 0) ||
           (known && (stagnates(c) || foretold(in, c, FALLS_MOST) > SEARCH_SAMPLES_MOST));
}

// After a row that does not keep the bound; 0: no number of samples does.
static uint32_t more_samples(const struct plan_search_input *in, const struct climb *c) {
    const double most = (c->samples < SETTLED ? STEP_FEW : STEP_MOST) * c->samples;
    const double wanted = fmax(AIM * foretold(in, c, falls(c)), STEP_LEAST * c->samples);
    if (is_hopeless(in, c) || c->samples >= SEARCH_SAMPLES_MOST)
        return 0;
    return (uint32_t)fmin(ceil(fmin(wanted, most)), SEARCH_SAMPLES_MOST);
}

static void climb_on(const struct plan_search_input *in, struct climb *c, uint32_t samples, double error) {
    c->before_samples = c->samples;
    c->before_amount = c->amount;
    c->samples = samples;
    c->amount = amount_of(in->metric, error);
}

// ---- by error

static struct setting probe_of(const struct setting *setting) {
    struct setting s = *setting;
    s.samples = SEARCH_PROBE;
    return s;
}

// The amount of error that remains with a setting, however many samples there are; 0: unknown.
static double floor_of(enum metric metric, const struct row *rows, uint32_t count, const struct setting *at) {
    const struct setting probe = probe_of(at);
    for (uint32_t i = 0; i < count; i++)
        if (is_same(&rows[i].setting, &probe))
            return amount_of(metric, rows[i].floor);
    return 0;
}

static struct setting deeper(const struct setting *at, bool keeps_depth) {
    struct setting s = *at;
    const uint32_t twice = at->max_depth ? 2 * at->max_depth : 2;
    if (!keeps_depth)
        s.max_depth = twice < DEPTH_MOST ? twice : DEPTH_MOST;
    s.min_weight = at->min_weight / DEEPER_WEIGHT;
    return s;
}

// Samples are added until the bound is kept. NULL: it is not, or a row must be measured first.
static const struct row *climb(struct searching *s, struct setting *at) {
    struct climb c = {.floor = floor_of(s->input->metric, s->rows, s->count, at)};
    for (at->samples = 1; at->samples; at->samples = more_samples(s->input, &c)) {
        const struct row *row = ask(s, at);
        if (!row || keeps(s, row))
            return row;
        climb_on(s->input, &c, at->samples, error_of(s, row));
        if (!isfinite(c.amount) || row->rounding > s->input->error_most)
            return NULL;
    }
    return NULL;
}

// Finds the first setting with which no more than this share of the bound remains, with longer paths if the
// file cuts too much for it. false: there is none, or it must be measured first.
static bool is_deep_enough(struct searching *s, struct setting *at, double share) {
    const double most = share_of_bound(s->input, share);
    for (int i = 0; i <= DEEPER_MOST; i++) {
        const struct setting probe = probe_of(at);
        const struct row *row = ask(s, &probe);
        if (!row || row->floor <= most)
            return row;
        if (!s->input->cut)
            return false;
        *at = deeper(at, s->input->keeps_depth);
    }
    return false;
}

// Whether samples can keep the bound.
static bool is_in_reach(struct searching *s, struct setting *at) {
    struct setting aim = *at;
    if (!is_deep_enough(s, &aim, FLOOR_AIM))
        return is_deep_enough(s, at, FLOOR_SHARE);
    *at = aim;
    return true;
}

// How much error may remain if less is traced, as an amount of amount_of. To what remains with this setting
// it adds a share of the bound, or what the error of a single sample leaves of the bound if that is more. 0:
// a row must be measured first.
static double allowance(struct searching *s, const struct setting *at) {
    struct setting one = probe_of(at);
    const struct row *probe = ask(s, &one);
    one.samples = 1;
    const struct row *row = ask(s, &one);
    if (!row || !probe)
        return 0;
    const double bound = amount_of(s->input->metric, s->input->error_most);
    const double left = bound - amount_of(s->input->metric, error_of(s, row));
    const double floor = amount_of(s->input->metric, probe->floor);
    return floor + fmax(fmin(LOWER_SHARE * bound, FLOOR_SHARE * bound - floor), left);
}

// Among settings from coarse to fine, all coarser than *at, finds by halving the coarsest with which no more
// error remains than allowed.
static void lower(struct searching *s, struct setting *at, const struct setting *ladder, uint32_t count,
                  double allowed) {
    uint32_t low = 0, high = count; // all below `low` leave more; `high` does not, or it is *at itself
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const struct setting probe = probe_of(&ladder[middle]);
        const struct row *row = ask(s, &probe);
        if (!row)
            return;
        if (amount_of(s->input->metric, row->floor) <= allowed)
            high = middle;
        else
            low = middle + 1;
    }
    if (high < count)
        *at = ladder[high];
}

// Smaller pictures are tried as they are.
static void lower_size(struct searching *s, struct setting *at) {
    struct setting ladder[LADDER_MAX];
    const uint32_t count = s->input->allow_resolution ? plan_sizes(at, ladder) : 0;
    for (uint32_t i = count; i-- > 0;) {
        const struct row *row = ask(s, &ladder[i]);
        if (!row || !keeps(s, row))
            return;
        *at = ladder[i];
    }
}

static void lower_depth(struct searching *s, struct setting *at, double allowed) {
    struct setting ladder[LADDER_MAX];
    uint32_t count = 0;
    const uint32_t own = at->max_depth < s->input->deepest ? at->max_depth : s->input->deepest;
    for (uint32_t part = 8; part > 1; part /= 2)
        if (count == 0 || own / part > ladder[count - 1].max_depth) {
            ladder[count] = *at;
            ladder[count++].max_depth = own / part;
        }
    lower(s, at, ladder, own ? count : 0, allowed);
}

static void lower_weight(struct searching *s, struct setting *at, double allowed) {
    static const double weights[] = {0.1, 0.03, 0.01};
    struct setting ladder[LADDER_MAX];
    uint32_t count = 0;
    for (size_t i = 0; i < sizeof weights / sizeof *weights; i++)
        if (weights[i] > at->min_weight) {
            ladder[count] = *at;
            ladder[count++].min_weight = weights[i];
        }
    lower(s, at, ladder, at->max_depth ? count : 0, allowed);
}

static void lower_others(struct searching *s, struct setting *at, double allowed) {
    struct setting coarse = *at;
    coarse.is_double = false;
    lower(s, at, &coarse, at->is_double, allowed);
    coarse = *at;
    coarse.shadows = false;
    lower(s, at, &coarse, at->shadows, allowed);
}

static void by_error(struct searching *s) {
    struct setting at = s->input->base;
    at.error = 0; // the search determines the number of samples
    if (!is_in_reach(s, &at))
        return;
    const double allowed = allowance(s, &at);
    if (s->input->bounces) {
        lower_depth(s, &at, allowed);
        lower_weight(s, &at, allowed);
    }
    lower_others(s, &at, allowed);
    if (climb(s, &at))
        lower_size(s, &at);
}

// ---- by time

// How many samples of the row's setting fit into the time, judging by the row's own.
static uint32_t samples_in(const struct searching *s, const struct row *row) {
    const double fit = s->input->time_most_ms / row->time_ms * row->setting.samples;
    return fit >= SEARCH_SAMPLES_MOST ? SEARCH_SAMPLES_MOST : fit >= 1 ? (uint32_t)fit : 0;
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
    // One sample told too little about the others.
    at.samples = (uint32_t)fmax(TIME_SHARE * samples_in(s, row), 1);
    ask(s, &at);
    return at.samples;
}

// Shorter paths, with lighter ones left out.
static struct setting cheaper(const struct searching *s, const struct setting *at) {
    const uint32_t own = at->max_depth < s->input->deepest ? at->max_depth : s->input->deepest;
    struct setting c = *at;
    c.max_depth = own / 2;
    c.min_weight = fmax(at->min_weight, 0.03);
    return c;
}

static void by_time(struct searching *s) {
    struct setting at = s->input->base;
    at.error = 0; // the search determines the number of samples
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
    if (!s.pending)
        return false;
    const bool is_probe = next->setting.samples == SEARCH_PROBE;
    if (is_probe)
        next->setting.samples = input->base.samples;
    plan_describe(next, &input->base);
    if (is_probe) {
        next->setting.samples = SEARCH_PROBE;
        next->choosable = false;
    }
    return true;
}

// ---- what it would take

struct search_verdict plan_search_verdict(const struct plan_search_input *input, const struct row *rows,
                                          uint32_t count) {
    struct search_verdict v = {SEARCH_UNKNOWN, 0, 0, (double)NAN};
    struct climb c = {0};
    double ms = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct row *row = &rows[i];
        const double error = metric_error(input->metric, row->value[input->metric]);
        if (row->setting.samples == SEARCH_PROBE) {
            if (v.kind == SEARCH_UNKNOWN || v.kind == SEARCH_REMAINS)
                v.kind = row->floor > share_of_bound(input, FLOOR_SHARE) ? SEARCH_REMAINS : SEARCH_UNKNOWN;
            v.value = v.kind == SEARCH_REMAINS ? row->floor : (double)NAN;
            continue;
        }
        if (row->rounding > input->error_most)
            return (struct search_verdict){SEARCH_FORMAT, 0, 0, row->rounding};
        if (!isfinite(error) || row->not_finite || row->setting.width != input->base.width)
            continue;
        if (row->setting.samples <= c.samples)
            c = (struct climb){0};
        c.floor = floor_of(input->metric, rows, count, &row->setting);
        v.value = error;
        climb_on(input, &c, row->setting.samples, error);
        ms = row->time_ms / row->setting.samples;
        v.kind = SEARCH_SAMPLES;
    }
    if (v.kind != SEARCH_SAMPLES)
        return v;
    v.samples = foretold(input, &c, falls(&c));
    v.seconds = 1e-3 * ms * v.samples;
    if (stagnates(&c) || !isfinite(v.samples))
        return (struct search_verdict){SEARCH_REMAINS, 0, 0, v.value};
    v.value = (double)NAN;
    return v;
}

// ---- the ground truth

double plan_search_safe(enum metric metric, double value, double share) {
    if (metric == METRIC_PSNR)
        return value - 20 * log10(1 + share);
    if (metric == METRIC_SSIM)
        return 1 - (1 + share) * (1 - value);
    return (1 + share) * value;
}

uint32_t plan_search_more(const struct setting *setting) {
    const double pixels = (double)setting->width * setting->height;
    const double each = fmin(fmax(MORE_ALL / (pixels * setting->samples), 1), MORE_EACH);
    return setting->samples <= FEW ? (uint32_t)(each * setting->samples) : 0;
}

double plan_search_rays(void) {
    return TRUTH_RAYS / PROBE_LEAST;
}

struct plan_search_probe plan_search_probe(const struct setting *base, double rays) {
    const double all = (double)base->width * base->height;
    const double pixels = fmin(fmax(TRUTH_RAYS / fmax(rays, 1), PROBE_LEAST), PROBE_MOST);
    const double scale = fmin(sqrt(pixels / all), 1);
    struct plan_search_probe p = {(uint32_t)fmax(scale * base->width, 1),
                                  (uint32_t)fmax(scale * base->height, 1), 1};
    const double samples = TRUTH_RAYS / (fmax(rays, 1) * p.width * p.height);
    p.samples = (uint32_t)fmin(fmax(samples, 1), PROBE_SAMPLES);
    return p;
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
