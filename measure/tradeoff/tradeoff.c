#include "measure/tradeoff/tradeoff.h"

#include "core/clock.h"
#include "core/heap.h"
#include "measure/tradeoff/choose/choose.h"
#include "measure/tradeoff/plan/plan.h"
#include "measure/tradeoff/tradeoff_internal.h"
#include "shaders/features.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    PAIRS_MOST = 24,
};
// Share of the budget after which no pairs are started.
static const double PAIRS_SHARE = 0.6;

static bool is_over(const struct measuring *s, double share) {
    const double budget = s->out->options.budget_s;
    const double now = measuring_seconds(s);
    // Rows that were started must also be timed, in at least one round: most frames are preceded by another,
    // since they differ from those before.
    return budget > 0 && (now > share * budget || now + 2 * s->round_seconds > budget);
}

// ---- rows

// Work, picture and errors of a new row. A row that costs far too much, or that the end of the budget
// interrupts on the device, is removed again.
static enum tradeoff_status try_row(struct measuring *s, const struct row *planned) {
    struct row *row = tradeoff_add_row(s->out, planned);
    if (!row)
        return TRADEOFF_MEMORY;
    if (!measuring_step(s, row->name))
        return TRADEOFF_CANCELLED;
    // The file's own settings are always awaited, however long they take.
    const double budget = s->out->options.budget_s;
    s->deadline = budget > 0 && s->out->count > 1 ? s->begun + budget : 0;
    enum tradeoff_status status = device_count(s, row);
    const bool costly =
        status == TRADEOFF_DONE && row->work.cost > TRADEOFF_COST_MOST * s->out->rows[0].work.cost;
    if (status == TRADEOFF_DONE && !costly)
        status = errors_measure(s, row);
    s->deadline = 0;
    if (costly || (status == TRADEOFF_CANCELLED && s->late)) {
        tradeoff_drop_row(s->out);
        s->out->too_costly += costly;
        s->out->rows_left_out += !costly;
        s->out->cut_short |= !costly;
        s->late = false;
        return TRADEOFF_DONE;
    }
    if (status != TRADEOFF_DONE)
        return status;
    status = parts_measure(s, row);
    if (status == TRADEOFF_DONE && measuring_traces_as_file(row))
        status = hits_measure(s, row);
    return status;
}

// ---- before the rows

// Includes the file's error even if pixels do not end by it: rows that set the number of samples switch it
// off.
static struct setting file_setting(const struct tradeoff_input *in) {
    const struct ir_trace *trace = &in->scene->ir->trace;
    return (struct setting){.width = (uint32_t)in->image->width,
                            .height = (uint32_t)in->image->height,
                            .samples = (uint32_t)in->image->samples,
                            .max_depth = (uint32_t)trace->max_depth,
                            .min_weight = trace->min_weight,
                            .error = in->scene->ir->image.error,
                            .min_samples = (uint32_t)in->image->min_samples,
                            .is_double = in->is_double,
                            .shadows = trace->shadows};
}

static void open_reference(struct measuring *s) {
    const struct tradeoff_input *in = s->input;
    const struct folder_store none = {0};
    struct reference_input input = {.scene = in->scene, .view = in->view};
    reference_source_init(&s->source[0], &input, in->store);
    s->ir_shadowless = *in->scene->ir;
    s->ir_shadowless.trace.shadows = false;
    s->scene_shadowless = *in->scene;
    s->scene_shadowless.ir = &s->ir_shadowless;
    input.scene = &s->scene_shadowless;
    reference_source_init(&s->source[1], &input, none);
}

// ---- the rows

static enum tradeoff_status run_pairs(struct measuring *s) {
    struct row *pairs = heap_zeroed(PLAN_ROWS_MAX, sizeof *pairs);
    if (!pairs)
        return TRADEOFF_MEMORY;
    const uint32_t count = plan_pairs(s->out->rows, s->out->count, s->out->options.metric, PAIRS_MOST, pairs,
                                      &s->out->pairs_left_out);
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

static enum tradeoff_status run_rows(struct measuring *s) {
    struct row *planned = heap_zeroed(PLAN_ROWS_MAX, sizeof *planned);
    if (!planned)
        return TRADEOFF_MEMORY;
    // The file's own settings are counted first: the depth of paths decides the ladders.
    struct row own = {.setting = s->base};
    enum tradeoff_status status = device_count(s, &own);
    if (status == TRADEOFF_DONE && !measuring_step(s, "the reference"))
        status = TRADEOFF_CANCELLED;
    if (status == TRADEOFF_DONE)
        status = ground_truth_make(s, &own.work, tradeoff_bounces(s));
    const struct plan_input input = {
        .base = s->base,
        .bounces = tradeoff_bounces(s),
        .deepest = own.work.deepest,
        .knows_double = gpu_info(s->input->gpu)->has_double,
        .has_triangles = s->flat[s->base.is_double].triangle_count > 0,
        .most_samples = s->out->ground_truth_samples / 2,
        .parts = without_parts(s->flat[s->base.is_double].features, &s->input->view->camera)};
    const uint32_t count = status == TRADEOFF_DONE ? plan_single(&input, planned) : 0;
    s->steps = 1 + count + PAIRS_MOST + TIMES_ROUNDS_MOST; // the reference is the first
    for (uint32_t i = 0; i < count && status == TRADEOFF_DONE; i++) {
        if (i > 0 && is_over(s, MEASURE_ROWS_SHARE)) {
            s->out->rows_left_out += count - i;
            s->out->cut_short = true;
            break;
        }
        status = try_row(s, &planned[i]);
    }
    free(planned);
    return status == TRADEOFF_DONE ? run_pairs(s) : status;
}

// ---- how errors fall with samples

static bool is_of_samples(const struct row *row) {
    return !(row->knobs & ~(1u << KNOB_SAMPLES | 1u << KNOB_ERROR)) && !setting_ends_pixels(&row->setting) &&
           row->value[METRIC_MAE] > 0;
}

// Least squares over the logarithms.
static double slope_of(const struct tradeoff *t) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (uint32_t i = 0; i < t->count; i++) {
        if (!is_of_samples(&t->rows[i]))
            continue;
        const double a = log(t->rows[i].setting.samples), b = log(t->rows[i].value[METRIC_MAE]);
        n++;
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
    }
    return n >= 3 ? (n * xy - x * y) / (n * xx - x * x) : (double)NAN;
}

// ---- the choice

static enum tradeoff_status choose(struct tradeoff *t) {
    const enum metric metric = t->options.metric;
    struct choice_row *choices = heap_array(t->count ? t->count : 1, sizeof *choices);
    if (!choices)
        return TRADEOFF_MEMORY;
    for (uint32_t i = 0; i < t->count; i++) {
        const struct row *row = &t->rows[i];
        // A picture with NaN pixels is never chosen.
        choices[i] = (struct choice_row){.time_ms = row->time_ms,
                                         .noise_ms = row->noise_ms,
                                         .work = row->work.cost,
                                         .error = metric_error(metric, row->value[metric]),
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
    const double bound = metric_error(metric, t->options.max_error), limit = t->options.max_time_ms;
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

// The earlier of what the budget and the caller allow; 0: there is none.
static double deadline_of(const struct tradeoff_options *options, double begun) {
    const double by_budget = options->budget_s > 0 ? begun + options->budget_s : (double)INFINITY;
    const double end = fmin(by_budget, options->end > 0 ? options->end : (double)INFINITY);
    return isfinite(end) ? end : 0;
}

enum tradeoff_status tradeoff_run(struct tradeoff *study, const struct tradeoff_input *input,
                                  const struct tradeoff_options *options,
                                  const struct tradeoff_progress *progress) {
    *study = (struct tradeoff){.options = *options, .knee = CHOICE_NONE};
    struct measuring *s = heap_zeroed(1, sizeof *s);
    if (!s)
        return TRADEOFF_MEMORY;
    s->input = input;
    s->progress = progress;
    s->out = study;
    s->begun = clock_seconds();
    s->steps = 1 + PLAN_ROWS_MAX; // until the rows are planned
    s->step = "the scene";
    s->display = image_display_of(input->image);
    study->base = s->base = file_setting(input);
    s->deadline = options->search ? deadline_of(options, s->begun) : 0;
    snprintf(study->device, sizeof study->device, "%s", gpu_info(input->gpu)->name);
    open_reference(s);
    enum tradeoff_status status = options->search ? tradeoff_search_rows(s) : run_rows(s);
    if (status == TRADEOFF_DONE && !options->search)
        status = times_measure(s);
    if (status == TRADEOFF_DONE)
        status = choose(study);
    study->slope = slope_of(study);
    study->seconds = measuring_seconds(s);
    device_close(s);
    parts_close(s);
    without_close(s);
    search_close(s);
    for (int i = 0; i < 2; i++) {
        reference_source_finish(&s->source[i]);
        free(s->hits[i]);
    }
    free(s->ground_truth);
    free(s->shown);
    free(s->picture);
    free(s->taken);
    free(s);
    return status;
}

void tradeoff_finish(struct tradeoff *study) {
    if (!study)
        return;
    while (study->count)
        tradeoff_drop_row(study);
    free(study->rows);
    *study = (struct tradeoff){0};
}
