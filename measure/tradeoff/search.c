// A search: few rows, each chosen from those before it, until one is found that keeps the bounds.
#include "core/clock.h"
#include "measure/tradeoff/plan/plan_search.h"
#include "measure/tradeoff/tradeoff_internal.h"

#include <math.h>

enum {
    STEPS_EXPECTED = 20, // of a search; a larger number would make the last ones look short
};

static struct plan_search_input plan_input_of(const struct measuring *s) {
    const struct tradeoff_options *options = &s->out->options;
    return (struct plan_search_input){.base = s->base,
                                      .metric = options->metric,
                                      .error_most = metric_error(options->metric, options->max_error),
                                      .time_most_ms = options->max_time_ms,
                                      .deepest = s->search.deepest,
                                      .bounces = tradeoff_bounces(s),
                                      .keeps_depth = scene_amplifies(s->input->scene),
                                      .cut = s->search.is_cut,
                                      .allow_resolution = options->allow_resolution};
}

// Tries rows until the search, or the time for it, is over.
static enum tradeoff_status run_rows(struct measuring *s) {
    const struct plan_search_input input = plan_input_of(s);
    struct row next;
    while (plan_search_next(&input, s->out->rows, s->out->count, &next)) {
        struct row *row = tradeoff_add_row(s->out, &next);
        if (!row)
            return TRADEOFF_MEMORY;
        const enum tradeoff_status status = search_row(s, row);
        if (status != TRADEOFF_DONE) {
            tradeoff_drop_row(s->out);
            return status;
        }
    }
    return TRADEOFF_DONE;
}

// Probes told what to draw, but are not pictures.
static void drop_probes(struct tradeoff *t) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < t->count; i++)
        if (t->rows[i].setting.samples != SEARCH_PROBE)
            t->rows[kept++] = t->rows[i];
    t->tried = t->count;
    t->count = kept;
}

enum tradeoff_status tradeoff_search_rows(struct measuring *s) {
    s->steps = STEPS_EXPECTED;
    enum tradeoff_status status = device_open(s);
    if (status == TRADEOFF_DONE && !measuring_step(s, "how far rays go"))
        status = TRADEOFF_CANCELLED;
    if (status == TRADEOFF_DONE)
        status = search_begin(s);
    if (status == TRADEOFF_DONE)
        status = run_rows(s);
    if (status == TRADEOFF_CANCELLED && s->late) {
        s->out->cut_short = true;
        status = TRADEOFF_DONE;
    }
    const struct plan_search_input input = plan_input_of(s);
    if (!isnan(input.error_most))
        s->out->verdict = plan_search_verdict(&input, s->out->rows, s->out->count);
    drop_probes(s->out);
    return status == TRADEOFF_DONE && !plan_order_times(s->out->rows, s->out->count) ? TRADEOFF_MEMORY
                                                                                     : status;
}
