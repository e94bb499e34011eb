// The report of a study as JSON.
#include "measure/tradeoff/report/report.h"

#include "core/json_write.h"

#include <math.h>

static void put_time(const struct row *row, struct json_writer *json) {
    json_open_object(json, "time_ms");
    json_write_real(json, "median", row->time_ms);
    json_write_real(json, "low", row->time_low_ms);
    json_write_real(json, "high", row->time_high_ms);
    json_write_real(json, "noise", row->noise_ms);
    json_close_object(json);
}

static void put_work(const struct work *work, struct json_writer *json) {
    json_open_object(json, "work");
    json_write_integer(json, "rays", work->rays);
    json_write_integer(json, "nodes", work->nodes);
    json_write_integer(json, "triangles", work->triangles);
    json_write_real(json, "cost", work->cost);
    json_write_real(json, "mean_samples", work->samples);
    json_close_object(json);
}

static void put_setting(const struct setting *s, struct json_writer *json) {
    json_open_object(json, "settings");
    json_write_integer(json, "width", s->width);
    json_write_integer(json, "height", s->height);
    json_write_integer(json, "samples", s->samples);
    json_write_integer(json, "max_depth", s->max_depth);
    json_write_real(json, "min_weight", s->min_weight);
    json_write_text(json, "precision", s->is_double ? STR("double") : STR("single"));
    json_write_boolean(json, "shadows", s->shadows);
    if (s->error > 0) {
        json_write_real(json, "error", s->error);
        json_write_integer(json, "min_samples", s->min_samples);
    }
    json_close_object(json);
}

static void put_errors(const struct row *row, struct json_writer *json) {
    json_open_object(json, "errors");
    for (int i = 0; i < METRIC_COUNT; i++)
        json_write_real(json, metric_infos[i].name, row->value[i]);
    json_write_integer(json, "not_finite_pixels", row->not_finite);
    json_close_object(json);
    if (row->parts.known) {
        json_open_object(json, "mae_parts");
        json_write_real(json, "numeric", row->parts.numeric);
        json_write_real(json, "truncation", row->parts.truncation);
        json_write_real(json, "sampling", row->parts.sampling);
        json_write_real(json, "resolution", row->parts.resolution);
        json_close_object(json);
    }
    if (row->hits.known) {
        json_open_object(json, "hits_per_million");
        json_write_real(json, "band", row->hits.silhouette);
        json_write_real(json, "wrong_inside", row->hits.wrong_inside);
        json_write_real(json, "wrong_outside", row->hits.wrong_outside);
        json_write_real(json, "acne", row->hits.acne);
        json_write_real(json, "leaks", row->hits.leaks);
        json_write_real(json, "shadow_edge", row->hits.shadow_edge);
        json_write_real(json, "holes", row->hits.holes);
        json_write_real(json, "wrong_second", row->hits.wrong_second);
        json_close_object(json);
    }
}

static void put_row(const struct tradeoff *t, uint32_t index, struct json_writer *json) {
    const struct row *row = &t->rows[index];
    json_open_object(json, NULL);
    json_write_integer(json, "row", index);
    json_write_text(json, "name", str_from(row->name));
    json_write_boolean(json, "choosable", row->choosable);
    json_write_boolean(json, "front", row->on_front);
    if (row->time_class != CHOICE_NONE) {
        json_write_integer(json, "class", row->time_class);
        json_write_integer(json, "rank", row->rank);
    }
    put_setting(&row->setting, json);
    put_time(row, json);
    put_work(&row->work, json);
    put_errors(row, json);
    json_close_object(json);
}

static void put_index(const char *key, uint32_t row, struct json_writer *json) {
    if (row == CHOICE_NONE)
        json_write_real(json, key, (double)NAN); // null
    else
        json_write_integer(json, key, row);
}

static void put_choice(const struct tradeoff *t, const char *key, double bound, const struct choice *choice,
                       struct json_writer *json) {
    struct strbuf text;
    if (isnan(bound))
        return;
    json_open_object(json, key);
    if (choice != &t->both) // its bounds are those of the two others
        json_write_real(json, "bound", bound);
    put_index("row", choice->row, json);
    put_index("runner_up", choice->runner_up, json);
    json_write_boolean(json, "runner_up_fits", choice->runner_up_fits);
    if (choice->row == CHOICE_NONE) {
        put_index("nearest", choice->nearest, json);
        json_write_real(json, "misses_by", choice->short_by);
        json_close_object(json);
        return;
    }
    strbuf_init(&text);
    setting_options(&t->rows[choice->row].setting, &t->base, &text);
    json_write_text(json, "options", strbuf_view(&text));
    strbuf_clear(&text);
    setting_yaml(&t->rows[choice->row].setting, &t->base, &text);
    json_write_text(json, "yaml", strbuf_view(&text));
    strbuf_clear(&text);
    setting_xml(&t->rows[choice->row].setting, &t->base, &text);
    json_write_text(json, "xml", strbuf_view(&text));
    json->out->failed |= text.failed;
    strbuf_finish(&text);
    json_close_object(json);
}

void tradeoff_json(const struct tradeoff *t, const char *scene, struct strbuf *out) {
    struct json_writer json;
    json_report_begin(&json, out, 3, "glint tradeoff", 1);
    json_write_text(&json, "scene", str_from(scene));
    json_write_text(&json, "device", str_from(t->device));
    json_write_text(&json, "metric", str_from(metric_infos[t->options.metric].name));
    json_write_real(&json, "seconds", t->seconds);
    if (t->options.budget_s > 0)
        json_write_real(&json, "budget_s", t->options.budget_s);
    json_write_integer(&json, "rounds", t->rounds);
    json_write_integer(&json, "truth_samples", t->ground_truth_samples);
    json_write_integer(&json, "truth_segments", t->ground_truth_segments);
    json_write_boolean(&json, "truth_cut", t->ground_truth_cut);
    json_write_real(&json, "truth_left_weight", t->ground_truth_left_weight);
    json_write_real(&json, "samples_slope", t->slope);
    json_write_integer(&json, "parts_left_out", t->parts_out);
    json_write_boolean(&json, "numeric_probed", t->numeric_probed);
    json_write_boolean(&json, "hits_left_out", t->hits_out);
    json_write_integer(&json, "rows_left_out", t->rows_left_out);
    json_write_integer(&json, "pairs_left_out", t->pairs_left_out);
    json_write_integer(&json, "too_costly", t->too_costly);
    json_write_boolean(&json, "cut_short", t->cut_short);
    put_index("knee", t->knee, &json);
    put_choice(t, "cheapest", t->options.max_error, &t->cheapest, &json);
    put_choice(t, "best_within", t->options.max_time_ms, &t->best_within, &json);
    if (!isnan(t->options.max_error) && !isnan(t->options.max_time_ms))
        put_choice(t, "both", 0, &t->both, &json);
    json_open_list(&json, "rows");
    for (uint32_t i = 0; i < t->count; i++)
        put_row(t, i, &json);
    json_close_list(&json);
    json_report_end(&json);
}
