// The report of a study as text and as CSV.
#include "measure/tradeoff/report/report.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

// ---- the choices

static void paste(const struct tradeoff *t, uint32_t index, struct strbuf *out) {
    const struct setting *base = &t->base, *chosen = &t->rows[index].setting;
    struct strbuf text;
    strbuf_init(&text);
    setting_options(chosen, base, &text);
    if (text.len)
        strbuf_format(out, "  options   %s\n", text.data);
    else
        strbuf_cstr(out, "  the file's own settings: there is nothing to change\n");
    strbuf_clear(&text);
    setting_yaml(chosen, base, &text);
    setting_xml(chosen, base, &text);
    for (const char *line = text.data; line && *line;) {
        const size_t length = strcspn(line, "\n");
        strbuf_format(out, "  %s%.*s\n", *line == '<' ? "XML       " : "YAML      ", (int)length, line);
        line += length + (line[length] == '\n');
    }
    out->failed |= text.failed;
    strbuf_finish(&text);
}

static void one_row(const struct tradeoff *t, const char *what, uint32_t index, struct strbuf *out) {
    const struct row *row = &t->rows[index];
    strbuf_format(out, "%s: row %u, %s: %.4g ms, %s %.4g\n", what, index, row->name, row->time_ms,
                  metric_infos[t->options.metric].name, row->value[t->options.metric]);
}

static void runner_up(const struct tradeoff *t, const struct choice *choice, struct strbuf *out) {
    if (choice->runner_up == CHOICE_NONE)
        strbuf_cstr(out, "  runner-up: none\n");
    else
        one_row(t, choice->runner_up_fits ? "  runner-up" : "  runner-up, which does not fit",
                choice->runner_up, out);
}

static void answer(const struct tradeoff *t, str question, const char *unit, const struct choice *choice,
                   struct strbuf *out) {
    strbuf_format(out, "\n%.*s\n", STR_ARG(question));
    if (choice->row != CHOICE_NONE) {
        one_row(t, "  chosen", choice->row, out);
        runner_up(t, choice, out);
        paste(t, choice->row, out);
        return;
    }
    strbuf_cstr(out, "  nothing fits\n");
    if (choice->nearest == CHOICE_NONE)
        return;
    one_row(t, "  nearest", choice->nearest, out);
    strbuf_format(out, "  it misses by %.4g %s\n", choice->short_by, unit);
    runner_up(t, choice, out);
}

void tradeoff_answers(const struct tradeoff *t, struct strbuf *out) {
    const char *metric = metric_infos[t->options.metric].name;
    struct strbuf question;
    strbuf_init(&question);
    if (!isnan(t->options.max_error)) {
        strbuf_format(&question, "cheapest with %s %s %.6g", metric,
                      metric_infos[t->options.metric].higher_is_better ? "at least" : "at most",
                      t->options.max_error);
        answer(t, strbuf_view(&question), metric, &t->cheapest, out);
    }
    strbuf_clear(&question);
    if (!isnan(t->options.max_time_ms)) {
        strbuf_format(&question, "best %s within %.6g ms", metric, t->options.max_time_ms);
        answer(t, strbuf_view(&question), "ms", &t->best_within, out);
    }
    if (!isnan(t->options.max_error) && !isnan(t->options.max_time_ms)) {
        strbuf_clear(&question);
        strbuf_format(&question, "cheapest that fits both");
        answer(t, strbuf_view(&question), metric, &t->both, out);
    }
    if (t->knee != CHOICE_NONE && isnan(t->options.max_error) && isnan(t->options.max_time_ms)) {
        strbuf_cstr(out, "\n");
        one_row(t, "the knee of the front", t->knee, out);
        paste(t, t->knee, out);
    }
    out->failed |= question.failed;
    strbuf_finish(&question);
}

void tradeoff_search_notes(const struct tradeoff *t, struct strbuf *out) {
    strbuf_format(out, "%u settings tried on %s", t->tried, t->device);
    if (t->is_recalled)
        strbuf_cstr(out, "; found by an earlier call, and kept\n");
    else
        strbuf_format(out, "; %.1f s%s\n", t->seconds, t->cut_short ? ", where the time for it ended" : "");
}

// ---- the table

static void number(struct strbuf *out, int width, double value) {
    if (isnan(value))
        strbuf_format(out, " %*s", width, "-");
    else if (isinf(value))
        strbuf_format(out, " %*s", width, "inf");
    else
        strbuf_format(out, " %*.4g", width, value);
}

static void table_row(const struct tradeoff *t, uint32_t index, struct strbuf *out) {
    const struct row *row = &t->rows[index];
    strbuf_format(out, "%3u %c%c %-38.38s %9.3f %7.3f", index,
                  row->on_front    ? '*'
                  : row->choosable ? ' '
                                   : 's',
                  index == t->knee ? 'K' : ' ', row->name, row->time_ms,
                  0.5 * (row->time_high_ms - row->time_low_ms));
    if (row->time_class == CHOICE_NONE)
        strbuf_cstr(out, "   -");
    else
        strbuf_format(out, " %3u", row->time_class);
    number(out, 9, row->work.cost / 1e6);
    number(out, 9, row->value[METRIC_MAE]);
    number(out, 9, row->value[METRIC_FLIP]);
    number(out, 9, row->value[METRIC_SHARE]);
    if (row->parts.known) {
        number(out, 9, row->parts.numeric);
        number(out, 9, row->parts.truncation);
        number(out, 9, row->parts.sampling);
        number(out, 9, row->parts.resolution);
    }
    strbuf_char(out, '\n');
}

static void hits_table(const struct tradeoff *t, struct strbuf *out) {
    bool any = false;
    for (uint32_t i = 0; i < t->count; i++)
        any |= t->rows[i].hits.known;
    if (!any)
        return;
    strbuf_cstr(out,
                "\nfirst hits against the reference, per million pixels (in: within a pixel of a "
                "silhouette)\n"
                "  #    setting                                 wrong, in  wrong, out      acne     leaks"
                "   shadows     holes    second       NaN\n");
    for (uint32_t i = 0; i < t->count; i++) {
        const struct row *row = &t->rows[i];
        const struct hit_errors *h = &row->hits;
        if (!h->known)
            continue;
        strbuf_format(out, "%3u %c  %-38.38s", i, row->choosable ? ' ' : 's', row->name);
        number(out, 11, h->wrong_inside);
        number(out, 11, h->wrong_outside);
        number(out, 9, h->acne);
        number(out, 9, h->leaks);
        number(out, 9, h->shadow_edge);
        number(out, 9, h->holes);
        number(out, 9, h->wrong_second);
        strbuf_format(out, " %9" PRIu64 "\n", row->not_finite);
    }
}

void tradeoff_notes(const struct tradeoff *t, struct strbuf *out) {
    strbuf_format(out, "%u rows, %u rounds, %.1f s in all, %.1f s of it for the reference of %u samples",
                  t->count, t->rounds, t->seconds, t->reference_seconds, t->ground_truth_samples);
    if (t->options.budget_s > 0)
        strbuf_format(out, "; the budget was %.6g s", t->options.budget_s);
    strbuf_cstr(out, "\ntimes are by the device's clock, as the last number of 'render --repeat'\n");
    if (!isnan(t->slope))
        strbuf_format(out, "errors (mae) change as samples to the power of %.2f\n", t->slope);
    if (t->ground_truth_samples <= t->rows[0].work.samples)
        strbuf_cstr(out, "the budget allowed the reference no more samples than the file: what more samples "
                         "would improve is not measured\n");
    if (t->ground_truth_cut)
        strbuf_format(out,
                      "the budget allowed the reference only %" PRIu64
                      " rays per sample; those left out weigh %.2g of a pixel on average, and settings that "
                      "follow more rays may look worse than they are\n",
                      t->ground_truth_segments, t->ground_truth_left_weight);
    if (t->parts_out)
        strbuf_format(out, "settings whose errors were not split into parts, for lack of time: %u\n",
                      t->parts_out);
    if (t->numeric_probed)
        strbuf_cstr(out, "for lack of time the numeric part was measured at the same pixels as the others, "
                         "not over the whole picture\n");
    if (t->hits_out)
        strbuf_cstr(out, "first hits were left out for lack of time\n");
    if (t->rounds == 0)
        strbuf_cstr(out, "no time was left to time the settings in rounds: each time is that of one frame\n");
    if (t->rows_left_out)
        strbuf_format(out, "%u settings were left out for lack of time\n", t->rows_left_out);
    if (t->pairs_left_out)
        strbuf_format(out, "%u less promising pairs were left out\n", t->pairs_left_out);
    if (t->too_costly)
        strbuf_format(out, "%u settings that would cost more than %d times the file's own were left out\n",
                      t->too_costly, TRADEOFF_COST_MOST);
    if (t->cut_short)
        strbuf_cstr(out, "the budget cut the study short: further pairs or rounds might change the choice\n");
    if (t->options.budget_s > 0 && t->seconds > t->options.budget_s)
        strbuf_format(out, "the minimum that a study needs took %.1f s longer than the budget\n",
                      t->seconds - t->options.budget_s);
}

void tradeoff_text(const struct tradeoff *t, const char *scene, struct strbuf *out) {
    const struct setting *base = &t->base;
    strbuf_format(out, "%s, %u x %u, on %s\n", scene, base->width, base->height, t->device);
    tradeoff_notes(t, out);
    strbuf_format(out,
                  "front and choices by %s; * on the front, K its knee, s never chosen; work in millions "
                  "of nodes and triangles\n",
                  metric_infos[t->options.metric].name);
    strbuf_cstr(out, "\n  #    setting                                     time ms  spread cls      work"
                     "       mae      flip     share");
    if (t->part_pixels)
        strbuf_format(out, "   numeric truncated   sampled  resolved   (mae of the parts, at %u pixels)",
                      t->part_pixels);
    strbuf_char(out, '\n');
    for (uint32_t i = 0; i < t->count; i++)
        table_row(t, i, out);
    hits_table(t, out);
    tradeoff_answers(t, out);
}

// ---- CSV

static void csv_number(struct strbuf *out, double value) {
    if (isfinite(value))
        strbuf_format(out, ",%.9g", value);
    else
        strbuf_cstr(out, isinf(value) ? ",inf" : ",");
}

static void csv_hits(const struct row *row, struct strbuf *out) {
    const struct hit_errors *h = &row->hits;
    const double values[] = {h->wrong_inside, h->wrong_outside, h->acne,        h->leaks,
                             h->shadow_edge,  h->holes,         h->wrong_second};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        csv_number(out, h->known ? values[i] : (double)NAN);
}

void tradeoff_csv(const struct tradeoff *t, struct strbuf *out) {
    strbuf_cstr(out,
                "row,setting,choosable,front,class,rank,width,height,samples,max_depth,min_weight,precision,"
                "shadows,time_ms,time_low_ms,time_high_ms,noise_ms,rays,nodes,triangles,cost");
    for (int i = 0; i < METRIC_COUNT; i++)
        strbuf_format(out, ",%s", metric_infos[i].name);
    strbuf_cstr(out,
                ",numeric,truncation,sampling,resolution,wrong_inside,wrong_outside,acne,leaks,shadow_edge,"
                "holes,wrong_second,not_finite,error,min_samples,mean_samples\n");
    for (uint32_t i = 0; i < t->count; i++) {
        const struct row *row = &t->rows[i];
        const struct setting *s = &row->setting;
        strbuf_format(out, "%u,\"%s\",%d,%d,", i, row->name, row->choosable, row->on_front);
        if (row->time_class != CHOICE_NONE)
            strbuf_format(out, "%u,%u", row->time_class, row->rank);
        else
            strbuf_char(out, ',');
        strbuf_format(out, ",%u,%u,%u,%u", s->width, s->height, s->samples, s->max_depth);
        csv_number(out, s->min_weight);
        strbuf_format(out, ",%s,%s", s->is_double ? "double" : "single", s->shadows ? "true" : "false");
        csv_number(out, row->time_ms);
        csv_number(out, row->time_low_ms);
        csv_number(out, row->time_high_ms);
        csv_number(out, row->noise_ms);
        strbuf_format(out, ",%" PRIu64 ",%" PRIu64 ",%" PRIu64, row->work.rays, row->work.nodes,
                      row->work.triangles);
        csv_number(out, row->work.cost);
        for (int k = 0; k < METRIC_COUNT; k++)
            csv_number(out, row->value[k]);
        const double parts[] = {row->parts.numeric, row->parts.truncation, row->parts.sampling,
                                row->parts.resolution};
        for (size_t k = 0; k < sizeof parts / sizeof *parts; k++)
            csv_number(out, row->parts.known ? parts[k] : (double)NAN);
        csv_hits(row, out);
        strbuf_format(out, ",%" PRIu64, row->not_finite);
        csv_number(out, s->error);
        strbuf_format(out, ",%u", s->error > 0 ? s->min_samples : s->samples);
        csv_number(out, row->work.samples);
        strbuf_char(out, '\n');
    }
}
