#include "measure/tradeoff/tradeoff.h"

#include "core/clock.h"
#include "core/heap.h"
#include "core/quantile.h"
#include "measure/tradeoff/plan.h"
#include "measure/tradeoff/study.h"
#include "shaders/features.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    ROUNDS_LEAST = 2,
    ROUNDS_QUICK = 3,
    ROUNDS_QUIET = 4, // at least, where there is no noise
    ROUNDS_MOST = 9,
    PAIRS_MOST = 24,
    PAIRS_MOST_QUICK = 12,
};
// Share of the budget after which no pairs are begun.
static const double PAIRS_SHARE = 0.6;

double tradeoff_error(enum metric metric, double value) {
    return metric_infos[metric].higher_is_better ? -value : value;
}

static double seconds_since_begun(const struct study *s) {
    return clock_seconds() - s->begun;
}

bool study_step(struct study *s, const char *what) {
    s->step = what;
    if (s->steps_done < s->steps)
        s->steps_done++;
    return !s->progress || s->progress->report(s->progress->context, (double)s->steps_done / s->steps, what);
}

static bool report_reference(void *context, double fraction) {
    const struct study *s = context;
    return !s->progress || s->progress->report(s->progress->context,
                                               ((double)s->steps_done + fraction) / (s->steps + 1), s->step);
}

struct reference_progress study_reference_progress(struct study *s) {
    return (struct reference_progress){report_reference, s};
}

bool study_traces_as_file(const struct row *row) {
    return !(row->knobs & ~(1u << KNOB_PRECISION | 1u << KNOB_FEATURES | 1u << KNOB_ALTERNATIVE));
}

enum tradeoff_status study_reference_status(enum reference_result result) {
    return result == REFERENCE_DONE        ? TRADEOFF_DONE
           : result == REFERENCE_CANCELLED ? TRADEOFF_CANCELLED
                                           : TRADEOFF_MEMORY;
}

static uint32_t pairs_most(const struct study *s) {
    return s->out->options.quick ? PAIRS_MOST_QUICK : PAIRS_MOST;
}

static uint32_t rounds_most(const struct study *s) {
    return s->out->options.quick ? ROUNDS_QUICK : ROUNDS_MOST;
}

static bool is_over(const struct study *s, double share) {
    const double budget = s->out->options.budget_s;
    const double now = seconds_since_begun(s);
    // What has been begun must be timed, too.
    return budget > 0 && (now > share * budget || now + ROUNDS_LEAST * s->round_seconds > budget);
}

// ---- rows

static struct row *add_row(struct tradeoff *t, const struct row *row) {
    struct row *rows = heap_grow(t->rows, t->count, &t->capacity, sizeof *rows);
    if (!rows)
        return NULL;
    t->rows = rows;
    struct row *added = &t->rows[t->count++];
    *added = *row;
    strbuf_init(&added->thumbnail);
    strbuf_init(&added->difference);
    for (int i = 0; i < METRIC_COUNT; i++)
        added->value[i] = (double)NAN;
    return added;
}

static void drop_row(struct tradeoff *t) {
    struct row *row = &t->rows[--t->count];
    strbuf_finish(&row->thumbnail);
    strbuf_finish(&row->difference);
}

// Work, picture and errors of a new row. A row that costs far too much, or that the budget's end comes upon
// on the device, is taken out again.
static enum tradeoff_status try_row(struct study *s, const struct row *planned) {
    struct row *row = add_row(s->out, planned);
    if (!row)
        return TRADEOFF_MEMORY;
    if (!study_step(s, row->name))
        return TRADEOFF_CANCELLED;
    // The file's own settings are waited for, whatever they take.
    const double budget = s->out->options.budget_s;
    s->deadline = budget > 0 && s->out->count > 1 ? s->begun + budget : 0;
    enum tradeoff_status status = device_count(s, row);
    const bool costly =
        status == TRADEOFF_DONE && row->work.cost > TRADEOFF_COST_MOST * s->out->rows[0].work.cost;
    if (status == TRADEOFF_DONE && !costly)
        status = errors_measure(s, row);
    s->deadline = 0;
    if (costly || (status == TRADEOFF_CANCELLED && s->late)) {
        drop_row(s->out);
        s->out->too_costly += costly;
        s->out->rows_left_out += !costly;
        s->out->cut_short |= !costly;
        s->late = false;
        return TRADEOFF_DONE;
    }
    if (status != TRADEOFF_DONE || s->out->options.quick)
        return status;
    status = parts_measure(s, row);
    if (status == TRADEOFF_DONE && study_traces_as_file(row))
        status = hits_measure(s, row);
    return status;
}

// ---- before the rows

static struct setting file_setting(const struct tradeoff_input *in) {
    const struct ir_trace *trace = &in->scene->trace;
    return (struct setting){.width = (uint32_t)in->image->width,
                            .height = (uint32_t)in->image->height,
                            .samples = (uint32_t)in->image->samples,
                            .max_depth = (uint32_t)trace->max_depth,
                            .min_weight = trace->min_weight,
                            .is_double = in->is_double,
                            .shadows = trace->shadows};
}

static void open_reference(struct study *s) {
    const struct tradeoff_input *in = s->input;
    const struct folder_store none = {0};
    struct reference_input input = {.scene = in->scene, .assets = in->assets, .view = in->view};
    reference_source_init(&s->source[0], &input, in->store);
    s->scene_shadowless = *in->scene;
    s->scene_shadowless.trace.shadows = false;
    input.scene = &s->scene_shadowless;
    reference_source_init(&s->source[1], &input, none);
}

static bool bounces(const struct study *s) {
    return s->flat[s->base.is_double].features & (FEATURE_REFLECTION | FEATURE_REFRACTION);
}

// ---- the rows

static enum tradeoff_status run_pairs(struct study *s) {
    struct row *pairs = calloc(PLAN_ROWS_MAX, sizeof *pairs);
    if (!pairs)
        return TRADEOFF_MEMORY;
    const uint32_t count = plan_pairs(s->out->rows, s->out->count, s->out->options.metric, pairs_most(s),
                                      pairs, &s->out->pairs_left_out);
    enum tradeoff_status status = TRADEOFF_DONE;
    for (uint32_t i = 0; i < count && status == TRADEOFF_DONE; i++) {
        if (is_over(s, PAIRS_SHARE)) {
            s->out->pairs_left_out += count - i;
            s->out->cut_short = true;
            break;
        }
        status = try_row(s, &pairs[i]);
    }
    free(pairs);
    return status;
}

static enum tradeoff_status run_rows(struct study *s) {
    struct row *planned = calloc(PLAN_ROWS_MAX, sizeof *planned);
    if (!planned)
        return TRADEOFF_MEMORY;
    // The file's own settings are counted first: how deep paths go decides the ladders.
    struct row own = {.setting = s->base};
    enum tradeoff_status status = device_count(s, &own);
    if (status == TRADEOFF_DONE && !study_step(s, "the reference"))
        status = TRADEOFF_CANCELLED;
    if (status == TRADEOFF_DONE)
        status = truth_make(s, &own.work, bounces(s));
    const struct plan_input input = {.base = s->base,
                                     .bounces = bounces(s),
                                     .deepest = own.work.deepest,
                                     .knows_double = gpu_info(s->input->gpu)->has_double,
                                     .has_triangles = s->flat[s->base.is_double].triangle_count > 0,
                                     .quick = s->out->options.quick,
                                     .most_samples = s->out->truth_samples / 2};
    const uint32_t count = status == TRADEOFF_DONE ? plan_single(&input, planned) : 0;
    s->steps = 1 + count + pairs_most(s) + rounds_most(s); // the reference is the first
    for (uint32_t i = 0; i < count && status == TRADEOFF_DONE; i++) {
        if (i > 0 && is_over(s, STUDY_ROWS_SHARE)) {
            s->out->rows_left_out += count - i;
            s->out->cut_short = true;
            break;
        }
        status = try_row(s, &planned[i]);
    }
    free(planned);
    return status == TRADEOFF_DONE ? run_pairs(s) : status;
}

// ---- times

// What a whole round was slower or faster than the others is the machine's, not the rows'.
static void remove_drift(double *times, uint32_t rows, uint32_t rounds) {
    double mean = 0;
    for (uint32_t r = 0; r < rounds; r++)
        for (uint32_t i = 0; i < rows; i++)
            mean += log(fmax(times[r * rows + i], 1e-9)) / ((double)rows * rounds);
    for (uint32_t r = 0; r < rounds; r++) {
        double own = 0;
        for (uint32_t i = 0; i < rows; i++)
            own += log(fmax(times[r * rows + i], 1e-9)) / rows;
        for (uint32_t i = 0; i < rows; i++)
            times[r * rows + i] *= exp(mean - own);
    }
}

static void fill_times(struct tradeoff *t, double *times) {
    double own[ROUNDS_MOST];
    remove_drift(times, t->count, t->rounds);
    for (uint32_t i = 0; i < t->count; i++) {
        struct row *row = &t->rows[i];
        for (uint32_t r = 0; r < t->rounds; r++)
            own[r] = times[r * t->count + i];
        quantile_sort(own, t->rounds);
        row->time_ms = quantile(own, t->rounds, 0.5);
        row->time_low_ms = quantile(own, t->rounds, 0.25);
        row->time_high_ms = quantile(own, t->rounds, 0.75);
        // 1.4826 MAD is the deviation of a normal distribution, 1.2533 / sqrt(n) its median's share of it.
        for (uint32_t r = 0; r < t->rounds; r++)
            own[r] = fabs(own[r] - row->time_ms);
        quantile_sort(own, t->rounds);
        row->noise_ms = 1.2533 * 1.4826 * quantile(own, t->rounds, 0.5) / sqrt(t->rounds);
    }
}

// Whether the noise has come down to the floor of the choice: further rounds would change nothing.
static bool is_quiet(struct tradeoff *t, const double *times) {
    const size_t count = (size_t)t->rounds * t->count;
    double *copy = malloc(count * sizeof *copy), *shares = malloc(t->count * sizeof *shares);
    bool quiet = false;
    if (copy && shares) {
        memcpy(copy, times, count * sizeof *copy);
        fill_times(t, copy);
        for (uint32_t i = 0; i < t->count; i++)
            shares[i] = t->rows[i].noise_ms / fmax(t->rows[i].time_ms, 1e-9);
        quantile_sort(shares, t->count);
        quiet = 3 * sqrt(2) * quantile(shares, t->count, 0.5) <= CHOICE_NOISE_FLOOR;
    }
    free(copy);
    free(shares);
    return quiet;
}

// Every round times every row once, each time from another row on.
static enum tradeoff_status run_times(struct study *s) {
    struct tradeoff *t = s->out;
    double *times = malloc((size_t)ROUNDS_MOST * t->count * sizeof *times);
    enum tradeoff_status status = times ? device_wake(s) : TRADEOFF_MEMORY;
    const double begun = seconds_since_begun(s), budget = t->options.budget_s;
    // A single row is compared with none: its noise, which would go with the drift, decides nothing.
    const uint32_t least = t->count > 1 ? ROUNDS_LEAST : 1;
    while (status == TRADEOFF_DONE && t->rounds < rounds_most(s)) {
        const double now = seconds_since_begun(s);
        if (t->rounds >= ROUNDS_QUIET && is_quiet(t, times))
            break;
        if (budget > 0 && t->rounds >= least && now + (now - begun) / t->rounds > budget) {
            t->cut_short |= t->rounds < ROUNDS_QUICK;
            break;
        }
        if (!study_step(s, "times"))
            status = TRADEOFF_CANCELLED;
        for (uint32_t i = 0; i < t->count && status == TRADEOFF_DONE; i++) {
            const uint32_t row = (i + t->rounds * 7) % t->count;
            status = device_time(s, &t->rows[row].setting, &times[t->rounds * t->count + row]);
        }
        t->rounds += status == TRADEOFF_DONE;
    }
    if (status == TRADEOFF_DONE) {
        fill_times(t, times);
        status = plan_order_times(t->rows, t->count) ? status : TRADEOFF_MEMORY;
    }
    free(times);
    return status;
}

// ---- the choice

static enum tradeoff_status choose(struct tradeoff *t) {
    const enum metric metric = t->options.metric;
    struct choice_row *choices = malloc(t->count * sizeof *choices);
    if (!choices)
        return TRADEOFF_MEMORY;
    for (uint32_t i = 0; i < t->count; i++) {
        const struct row *row = &t->rows[i];
        // A picture with pixels that are no number is never chosen.
        choices[i] = (struct choice_row){.time_ms = row->time_ms,
                                         .noise_ms = row->noise_ms,
                                         .work = row->work.cost,
                                         .error = tradeoff_error(metric, row->value[metric]),
                                         .choosable = row->choosable && !row->not_finite};
    }
    t->noise = choice_classify(choices, t->count);
    for (uint32_t i = 0; i < t->count; i++) {
        t->rows[i].time_class = choices[i].time_class;
        t->rows[i].rank = choices[i].rank;
        t->rows[i].on_front = choices[i].on_front;
    }
    t->knee = choice_knee(choices, t->count);
    t->cheapest = t->best_within = t->both =
        (struct choice){CHOICE_NONE, CHOICE_NONE, false, CHOICE_NONE, (double)NAN};
    const double bound = tradeoff_error(metric, t->options.max_error), limit = t->options.max_time_ms;
    if (!isnan(bound))
        t->cheapest = choice_cheapest(choices, t->count, t->noise, bound);
    if (!isnan(limit))
        t->best_within = choice_best_within(choices, t->count, t->noise, limit);
    if (!isnan(bound) && !isnan(limit))
        t->both = choice_both(choices, t->count, t->noise, bound, limit);
    free(choices);
    return TRADEOFF_DONE;
}

const struct choice *tradeoff_choice(const struct tradeoff *t) {
    const bool by_error = !isnan(t->options.max_error), by_time = !isnan(t->options.max_time_ms);
    return by_error && by_time ? &t->both : by_error ? &t->cheapest : by_time ? &t->best_within : NULL;
}

enum tradeoff_status tradeoff_run(struct tradeoff *study, const struct tradeoff_input *input,
                                  const struct tradeoff_options *options,
                                  const struct tradeoff_progress *progress) {
    *study = (struct tradeoff){.options = *options, .knee = CHOICE_NONE};
    struct study *s = calloc(1, sizeof *s);
    if (!s)
        return TRADEOFF_MEMORY;
    s->input = input;
    s->progress = progress;
    s->out = study;
    s->begun = clock_seconds();
    s->steps = 1 + PLAN_ROWS_MAX; // until the rows are planned
    s->step = "the scene";
    s->display = (struct image_display){input->image->tone, input->image->transfer};
    s->base = file_setting(input);
    snprintf(study->device, sizeof study->device, "%s", gpu_info(input->gpu)->name);
    open_reference(s);
    enum tradeoff_status status = run_rows(s);
    if (status == TRADEOFF_DONE)
        status = run_times(s);
    if (status == TRADEOFF_DONE)
        status = choose(study);
    study->seconds = seconds_since_begun(s);
    device_close(s);
    parts_close(s);
    for (int i = 0; i < 2; i++) {
        reference_source_finish(&s->source[i]);
        free(s->hits[i]);
    }
    free(s->truth);
    free(s->shown);
    free(s->picture);
    free(s);
    return status;
}

void tradeoff_finish(struct tradeoff *study) {
    if (!study)
        return;
    while (study->count)
        drop_row(study);
    free(study->rows);
    *study = (struct tradeoff){0};
}
