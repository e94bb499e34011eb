#include "measure/tradeoff/plan/plan.h"

#include "core/heap.h"
#include "core/number.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    ERROR_SAMPLES_LEAST = 4, // one for each of the groups whose means are compared
};

// ---- what a setting is called

enum {
    PAIRS_MAX = PLAN_ROWS_MAX * PLAN_ROWS_MAX / 2
};

bool plan_differs(const struct setting *a, const struct setting *b, enum knob knob) {
    switch (knob) {
    case KNOB_MAX_DEPTH:
        return a->max_depth != b->max_depth;
    case KNOB_MIN_WEIGHT:
        return a->min_weight < b->min_weight || a->min_weight > b->min_weight;
    case KNOB_PRECISION:
        return a->is_double != b->is_double;
    case KNOB_SAMPLES:
        return a->samples != b->samples && !plan_differs(a, b, KNOB_ERROR);
    case KNOB_ERROR:
        return a->error < b->error || a->error > b->error ||
               (a->error > 0 && a->min_samples != b->min_samples);
    case KNOB_SHADOWS:
        return a->shadows != b->shadows;
    case KNOB_RESOLUTION:
        return a->width != b->width || a->height != b->height;
    case KNOB_FEATURES:
        return a->general != b->general;
    case KNOB_ALTERNATIVE:
        return a->alternative != b->alternative;
    default:
        return ((a->without ^ b->without) & KNOBS_WITHOUT) >> knob & 1;
    }
}

// Names of what is left out.
static const char *const without_names[KNOB_COUNT] = {
    [KNOB_CLEAR_SHADOWS] = "transparent_shadows off",
    [KNOB_OCCLUSION] = "occlusion off",
    [KNOB_SOFT_LIGHTS] = "lights without extent",
    [KNOB_LENS] = "pinhole",
    [KNOB_ROUGHNESS] = "no roughness",
    [KNOB_FILTER] = "no filter",
};

static void name_error(const struct setting *s, char *out, size_t capacity) {
    char number[NUMBER_FORMAT_MAX];
    number_format(s->error, number);
    if (s->error > 0)
        snprintf(out, capacity, "error %s by %u to %u samples", number, s->min_samples, s->samples);
    else
        snprintf(out, capacity, "error off, samples %u", s->samples);
}

static void name_part(const struct setting *s, enum knob knob, char *out, size_t capacity) {
    char number[NUMBER_FORMAT_MAX];
    switch (knob) {
    case KNOB_MAX_DEPTH:
        snprintf(out, capacity, "max_depth %u", s->max_depth);
        break;
    case KNOB_MIN_WEIGHT:
        number_format(s->min_weight, number);
        snprintf(out, capacity, "min_weight %s", number);
        break;
    case KNOB_PRECISION:
        snprintf(out, capacity, "precision %s", s->is_double ? "double" : "single");
        break;
    case KNOB_SAMPLES:
        snprintf(out, capacity, "samples %u", s->samples);
        break;
    case KNOB_SHADOWS:
        snprintf(out, capacity, "shadows %s", s->shadows ? "on" : "off");
        break;
    case KNOB_RESOLUTION:
        snprintf(out, capacity, "%u x %u", s->width, s->height);
        break;
    case KNOB_FEATURES:
        snprintf(out, capacity, "general shader");
        break;
    case KNOB_ALTERNATIVE:
        snprintf(out, capacity, "study: %s", render_alternative_name(s->alternative));
        break;
    case KNOB_ERROR:
        name_error(s, out, capacity);
        break;
    default:
        snprintf(out, capacity, "%s", without_names[knob] ? without_names[knob] : "?");
        break;
    }
}

void plan_describe(struct row *row, const struct setting *base) {
    size_t length = 0;
    row->knobs = 0;
    row->name[0] = '\0';
    for (int knob = 0; knob < KNOB_COUNT; knob++) {
        char part[64];
        if (!plan_differs(&row->setting, base, (enum knob)knob))
            continue;
        row->knobs |= 1u << knob;
        name_part(&row->setting, (enum knob)knob, part, sizeof part);
        snprintf(row->name + length, sizeof row->name - length, "%s%s", length ? ", " : "", part);
        length = strlen(row->name);
    }
    if (!row->knobs)
        snprintf(row->name, sizeof row->name, "as the file says");
    row->choosable = !(row->knobs & KNOBS_NEVER_CHOSEN);
}

// ---- one knob at a time

struct planning {
    const struct plan_input *input;
    struct row *rows;
    uint32_t count;
};

static void add(struct planning *p, struct setting setting) {
    struct row row = {.setting = setting};
    plan_describe(&row, &p->input->base);
    for (uint32_t i = 0; i < p->count; i++)
        if (memcmp(p->rows[i].name, row.name, sizeof row.name) == 0)
            return;
    if (p->count < PLAN_ROWS_MAX)
        p->rows[p->count++] = row;
}

static void add_depths(struct planning *p) {
    static const uint32_t ladder[] = {0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};
    struct setting s = p->input->base;
    // Beyond the deepest level that paths reach nothing changes, unless the file's own limit is what stops
    // them.
    const bool stopped = p->input->deepest >= s.max_depth;
    const uint32_t twice = s.max_depth ? 2 * s.max_depth : 1;
    for (size_t i = 0; i < sizeof ladder / sizeof *ladder; i++) {
        s.max_depth = ladder[i];
        if (stopped ? s.max_depth <= twice : s.max_depth < p->input->deepest)
            add(p, s);
    }
}

static void add_weights(struct planning *p) {
    static const double ladder[] = {0.25, 0.1, 0.03, 0.01, 0.003, 0.0001, 0};
    struct setting s = p->input->base;
    for (size_t i = 0; i < sizeof ladder / sizeof *ladder; i++) {
        s.min_weight = ladder[i];
        add(p, s);
    }
}

uint32_t plan_sizes(const struct setting *base, struct setting sizes[PLAN_SIZES_MAX]) {
    static const struct { uint32_t part, of; } ladder[PLAN_SIZES_MAX] = {{1, 4}, {1, 2}, {3, 4}};
    uint32_t count = 0;
    for (size_t i = 0; i < sizeof ladder / sizeof *ladder; i++) {
        struct setting s = *base;
        s.width = (s.width * ladder[i].part + ladder[i].of / 2) / ladder[i].of;
        s.height = (s.height * ladder[i].part + ladder[i].of / 2) / ladder[i].of;
        if (s.width >= 8 && s.height >= 8)
            sizes[count++] = s;
    }
    return count;
}

static void add_sizes(struct planning *p) {
    struct setting sizes[PLAN_SIZES_MAX];
    const uint32_t count = plan_sizes(&p->input->base, sizes);
    for (uint32_t i = 0; i < count; i++)
        add(p, sizes[i]);
}

static void add_samples(struct planning *p) {
    struct setting s = p->input->base;
    s.error = 0;
    for (s.samples = 1; s.samples <= p->input->most_samples; s.samples *= 2)
        add(p, s);
}

// For a file with an error its own samples, else those of a ladder, a quarter of which are taken before any
// pixel ends.
static void add_errors(struct planning *p) {
    static const double ladder[] = {0.1, 0.05, 0.02, 0.01, 0.005};
    struct setting s = p->input->base;
    if (!(s.error > 0)) {
        s.samples = p->input->most_samples;
        s.min_samples = s.samples / 4 > ERROR_SAMPLES_LEAST ? s.samples / 4 : ERROR_SAMPLES_LEAST;
    }
    for (size_t i = 0; i < sizeof ladder / sizeof *ladder && s.samples > s.min_samples; i++) {
        s.error = ladder[i];
        add(p, s);
    }
}

static void add_parts(struct planning *p) {
    for (uint32_t knob = 0; knob < KNOB_COUNT; knob++) {
        struct setting s = p->input->base;
        s.without = p->input->parts & 1u << knob & KNOBS_WITHOUT;
        if (s.without)
            add(p, s);
    }
}

static void add_alternatives(struct planning *p) {
    struct setting s = p->input->base;
    s.is_double = false;
    for (int i = RENDER_ALTERNATIVE_NONE + 1; i < RENDER_ALTERNATIVES; i++) {
        s.alternative = (enum render_alternative)i;
        if (p->input->has_triangles || (i != RENDER_ALTERNATIVE_MOELLER && i != RENDER_ALTERNATIVE_ORIGINAL))
            add(p, s);
    }
}

uint32_t plan_single(const struct plan_input *input, struct row *rows) {
    struct planning p = {input, rows, 0};
    add(&p, input->base);
    if (input->bounces) {
        add_depths(&p);
        add_weights(&p);
    }
    struct setting s = input->base;
    s.is_double = !s.is_double;
    if (input->knows_double || !s.is_double)
        add(&p, s);
    add_samples(&p);
    add_errors(&p);
    add_parts(&p);
    s = input->base;
    s.shadows = false;
    add(&p, s);
    add_sizes(&p);
    s = input->base;
    s.general = true;
    add(&p, s);
    add_alternatives(&p);
    return p.count;
}

// ---- times

// Whether all rays of `a` are rays of `b` too. Which pixels end earlier with a larger error is less simple.
static bool is_part(const struct setting *a, const struct setting *b) {
    const uint32_t rays_only = 1u << KNOB_CLEAR_SHADOWS | 1u << KNOB_OCCLUSION;
    return !plan_differs(a, b, KNOB_ERROR) && !((a->without ^ b->without) & ~rays_only) &&
           !(b->without & ~a->without) && a->max_depth <= b->max_depth && a->min_weight >= b->min_weight &&
           a->samples <= b->samples && a->width <= b->width && a->height <= b->height &&
           a->shadows <= b->shadows && a->is_double == b->is_double && a->general == b->general &&
           a->alternative == b->alternative;
}

bool plan_order_times(struct row *rows, uint32_t count) {
    double *ordered = heap_array(count ? count : 1, sizeof *ordered);
    if (!ordered)
        return false;
    for (uint32_t i = 0; i < count; i++) {
        // The fastest of those above and the slowest of those below both rise where they ought to.
        double above = rows[i].time_ms, below = rows[i].time_ms;
        for (uint32_t k = 0; k < count; k++) {
            if (is_part(&rows[i].setting, &rows[k].setting))
                above = fmin(above, rows[k].time_ms);
            if (is_part(&rows[k].setting, &rows[i].setting))
                below = fmax(below, rows[k].time_ms);
        }
        ordered[i] = 0.5 * (above + below);
    }
    for (uint32_t i = 0; i < count; i++)
        rows[i].time_ms = ordered[i];
    free(ordered);
    return true;
}

// ---- pairs

static bool is_single(const struct row *row, uint32_t *knob) {
    *knob = 0;
    while (*knob < KNOB_COUNT && row->knobs != 1u << *knob)
        ++*knob;
    return *knob < KNOB_COUNT && row->choosable;
}

static double error_of(const struct row *row, enum metric metric) {
    return metric_error(metric, row->value[metric]);
}

static bool matters(const struct row *row, const struct row *base, enum metric metric) {
    const double work = fabs(row->work.cost - base->work.cost), error = error_of(base, metric);
    return work >= 0.02 * base->work.cost || fabs(error_of(row, metric) - error) >= 0.05 * fabs(error);
}

// Whether no other row of the knob, nor the file's own, costs no more and has no larger error.
static bool is_worth_it(const struct row *rows, uint32_t count, uint32_t index, enum metric metric) {
    const struct row *row = &rows[index];
    for (uint32_t i = 0; i < count; i++) {
        if (i == index || (rows[i].knobs && rows[i].knobs != row->knobs))
            continue;
        const double cost = rows[i].work.cost - row->work.cost;
        const double error = error_of(&rows[i], metric) - error_of(row, metric);
        if (cost <= 0 && error <= 0 && (cost < 0 || error < 0 || i < index))
            return false;
    }
    return !isnan(error_of(row, metric));
}

// Whether two knobs count as one: both `samples` and `error` set the number of samples.
static bool are_one(uint32_t a, uint32_t b) {
    const uint32_t samples = 1u << KNOB_SAMPLES | 1u << KNOB_ERROR;
    return a == b || (1u << a & samples && 1u << b & samples);
}

static struct setting join(const struct setting *a, uint32_t knob_a, const struct setting *b) {
    // The setting of `b`, with the one knob of `a`.
    struct setting s = *b;
    switch ((enum knob)knob_a) {
    case KNOB_MAX_DEPTH:
        s.max_depth = a->max_depth;
        break;
    case KNOB_MIN_WEIGHT:
        s.min_weight = a->min_weight;
        break;
    case KNOB_PRECISION:
        s.is_double = a->is_double;
        break;
    case KNOB_SAMPLES:
        s.samples = a->samples;
        break;
    case KNOB_SHADOWS:
        s.shadows = a->shadows;
        break;
    case KNOB_RESOLUTION:
        s.width = a->width;
        s.height = a->height;
        break;
    case KNOB_ERROR:
        s.error = a->error;
        s.min_samples = a->min_samples;
        s.samples = a->samples;
        break;
    default:
        s.without |= a->without & 1u << knob_a;
        break;
    }
    return s;
}

// A pair's cost and error as predicted from its parts.
struct pair {
    uint32_t a, b;
    double cost, error;
    uint32_t better; // rows and pairs predicted to cost no more and have no larger error
};

static int by_promise(const void *a, const void *b) {
    const struct pair *p = a, *q = b;
    if (p->better != q->better)
        return p->better < q->better ? -1 : 1;
    if (p->cost < q->cost || p->cost > q->cost)
        return p->cost < q->cost ? -1 : 1;
    return p->a != q->a ? (p->a < q->a ? -1 : 1) : p->b < q->b ? -1 : p->b > q->b;
}

static struct pair foretell(const struct row *rows, uint32_t a, uint32_t b, enum metric metric) {
    // Works multiply. Errors of two knobs hide each other as often as they add: the larger one is used for
    // both.
    return (struct pair){.a = a,
                         .b = b,
                         .cost = rows[a].work.cost * rows[b].work.cost / fmax(rows[0].work.cost, 1),
                         .error = fmax(error_of(&rows[a], metric), error_of(&rows[b], metric))};
}

static void count_better(const struct row *rows, uint32_t count, enum metric metric, struct pair *pairs,
                         uint32_t pair_count) {
    for (uint32_t i = 0; i < pair_count; i++) {
        struct pair *p = &pairs[i];
        for (uint32_t k = 0; k < count; k++)
            p->better +=
                rows[k].choosable && rows[k].work.cost <= p->cost && error_of(&rows[k], metric) <= p->error;
        for (uint32_t k = 0; k < pair_count; k++)
            p->better += k != i && pairs[k].cost <= p->cost && pairs[k].error <= p->error;
    }
}

uint32_t plan_pairs(const struct row *rows, uint32_t count, enum metric metric, uint32_t most,
                    struct row *pairs, uint32_t *left_out) {
    struct pair *found = heap_array(PAIRS_MAX, sizeof *found);
    uint32_t found_count = 0, made = 0, knob_a, knob_b;
    *left_out = 0;
    for (uint32_t a = 1; found && a < count; a++)
        for (uint32_t b = a + 1; b < count && found_count < PAIRS_MAX; b++)
            if (is_single(&rows[a], &knob_a) && is_single(&rows[b], &knob_b) && !are_one(knob_a, knob_b) &&
                matters(&rows[a], &rows[0], metric) && matters(&rows[b], &rows[0], metric) &&
                is_worth_it(rows, count, a, metric) && is_worth_it(rows, count, b, metric))
                found[found_count++] = foretell(rows, a, b, metric);
    if (found)
        count_better(rows, count, metric, found, found_count);
    if (found)
        qsort(found, found_count, sizeof *found, by_promise);
    for (uint32_t i = 0; i < found_count; i++) {
        if (made == most) {
            ++*left_out;
            continue;
        }
        is_single(&rows[found[i].a], &knob_a);
        pairs[made] =
            (struct row){.setting = join(&rows[found[i].a].setting, knob_a, &rows[found[i].b].setting)};
        plan_describe(&pairs[made++], &rows[0].setting);
    }
    free(found);
    return made;
}
