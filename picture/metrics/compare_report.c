#include "picture/metrics/compare_report.h"

#include "core/json_write.h"

#include <inttypes.h>
#include <math.h>

bool measure_keeps(const struct measure_bounds *bounds, const struct measure_result *result,
                   enum metric metric) {
    const double value = result->value[metric], bound = bounds->bound[metric];
    return !bounds->has[metric] || (metric_infos[metric].higher_is_better ? value >= bound : value <= bound);
}

static bool has_bounds(const struct measure_bounds *bounds) {
    bool any = false;
    for (int i = 0; i < METRIC_COUNT; i++)
        any |= bounds->has[i];
    return any;
}

static bool keeps_finite(const struct compare_report *report) {
    return !has_bounds(report->bounds) ||
           (double)report->result->not_finite_together <= report->bounds->not_finite;
}

bool compare_keeps_bounds(const struct compare_report *report) {
    bool good = keeps_finite(report);
    for (int i = 0; i < METRIC_COUNT; i++)
        good &= measure_keeps(report->bounds, report->result, (enum metric)i);
    return good;
}

static const char *space_name(const struct compare_report *report) {
    return report->options->space == MEASURE_LINEAR ? "linear" : "displayed";
}

static const char *metric_space(const struct compare_report *report, enum metric metric) {
    return metric_infos[metric].of_displayed ? "displayed" : space_name(report);
}

// ---- text

static void text_value(struct strbuf *out, double value) {
    if (isnan(value))
        strbuf_format(out, "%12s", "none");
    else if (isinf(value))
        strbuf_format(out, "%12s", "infinite");
    else
        strbuf_format(out, "%12.6g", value);
}

static void text_metric(const struct compare_report *report, enum metric metric, struct strbuf *out) {
    const struct measure_bounds *bounds = report->bounds;
    const struct metric_info *info = &metric_infos[metric];
    strbuf_format(out, "  %-8s", info->name);
    text_value(out, report->result->value[metric]);
    strbuf_format(out, "  %s, %s", info->title, metric_space(report, metric));
    if (bounds->has[metric])
        strbuf_format(out, "; %s %.6g: %s", info->higher_is_better ? "at least" : "at most",
                      bounds->bound[metric],
                      measure_keeps(bounds, report->result, metric) ? "passed" : "FAILED");
    strbuf_char(out, '\n');
}

void compare_text(const struct compare_report *report, struct strbuf *out) {
    const struct measure_result *r = report->result;
    strbuf_format(out, "picture    %s (%s)\nreference  %s (%s)\n", report->path[0], report->kind[0],
                  report->path[1], report->kind[1]);
    strbuf_format(out, "%u x %u pixels, compared as %s values\n", report->width, report->height,
                  space_name(report));
    for (int i = 0; i < METRIC_COUNT; i++)
        text_metric(report, (enum metric)i, out);
    if (r->value[METRIC_LARGEST] > 0)
        strbuf_format(out, "the largest difference is at %u,%u in %s: %.6g against %.6g\n", r->largest.x,
                      r->largest.y,
                      r->largest.channel == 0   ? "red"
                      : r->largest.channel == 1 ? "green"
                                                : "blue",
                      r->largest.value, r->largest.reference);
    strbuf_format(out, "%" PRIu64 " of %" PRIu64 " pixels differ by more than %.6g\n", r->over, r->pixels,
                  report->options->threshold);
    if (r->not_finite_together)
        strbuf_format(out,
                      "%" PRIu64 " pixels are infinite or not a number in the picture, %" PRIu64
                      " in the reference, and left out of the means%s\n",
                      r->not_finite[0], r->not_finite[1], keeps_finite(report) ? "" : ": FAILED");
}

// ---- JSON

static void json_picture(const struct compare_report *report, int which, const char *key,
                         struct json_writer *json) {
    json_open_object(json, key);
    json_write_text(json, "path", str_from(report->path[which]));
    json_write_text(json, "kind", str_from(report->kind[which]));
    json_write_integer(json, "not_finite_pixels", report->result->not_finite[which]);
    json_close_object(json);
}

static void json_metric(const struct compare_report *report, enum metric metric, struct json_writer *json) {
    json_open_object(json, metric_infos[metric].name);
    json_write_real(json, "value", report->result->value[metric]);
    json_write_text(json, "space", str_from(metric_space(report, metric)));
    if (report->bounds->has[metric]) {
        json_write_real(json, metric_infos[metric].higher_is_better ? "at_least" : "at_most",
                        report->bounds->bound[metric]);
        json_write_boolean(json, "kept", measure_keeps(report->bounds, report->result, metric));
    }
    json_close_object(json);
}

static void json_largest(const struct measure_place *place, struct json_writer *json) {
    json_open_object(json, "largest_at");
    json_write_integer(json, "x", place->x);
    json_write_integer(json, "y", place->y);
    json_write_integer(json, "channel", place->channel);
    json_write_real(json, "value", place->value);
    json_write_real(json, "reference", place->reference);
    json_close_object(json);
}

void compare_json(const struct compare_report *report, struct strbuf *out) {
    const struct measure_result *r = report->result;
    struct json_writer json;
    json_report_begin(&json, out, 2, "glint compare", 1);
    json_picture(report, 0, "picture", &json);
    json_picture(report, 1, "reference", &json);
    json_write_integer(&json, "width", report->width);
    json_write_integer(&json, "height", report->height);
    json_write_text(&json, "space", str_from(space_name(report)));
    json_write_real(&json, "threshold", report->options->threshold);
    json_write_real(&json, "pixels_per_degree", report->options->pixels_per_degree);
    json_open_object(&json, "metrics");
    for (int i = 0; i < METRIC_COUNT; i++)
        json_metric(report, (enum metric)i, &json);
    json_close_object(&json);
    json_largest(&r->largest, &json);
    json_write_integer(&json, "pixels_over", r->over);
    json_write_integer(&json, "not_finite_pixels", r->not_finite_together);
    json_write_boolean(&json, "bounds_kept", compare_keeps_bounds(report));
    json_report_end(&json);
}
