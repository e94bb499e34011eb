// Extremes as text and as JSON.
#include "measure/extremes/extremes.h"

#include "core/json_write.h"

#include <math.h>

enum {
    COLUMN = 10
};

void extreme_number(enum extreme_metric metric, double value, struct strbuf *out) {
    if (isnan(value))
        strbuf_char(out, '-');
    else if (extreme_metrics[metric].unit == EXTREME_UNIT_WHOLE)
        strbuf_format(out, "%.0f", value);
    else if (extreme_metrics[metric].unit == EXTREME_UNIT_SHARE)
        strbuf_format(out, "%.5f", value);
    else
        strbuf_format(out, "%.2g", value);
}

static void put_number(struct strbuf *out, const struct extreme_cell *cell, int metric) {
    struct strbuf number;
    strbuf_init(&number);
    extreme_number((enum extreme_metric)metric, cell->measured[metric], &number);
    strbuf_format(out, " %*.*s%c", COLUMN, STR_ARG(strbuf_view(&number)),
                  cell->broken >> metric & 1 ? '!' : ' ');
    strbuf_finish(&number);
}

static void put_cell(struct strbuf *out, const struct extreme_cell *cell) {
    strbuf_format(out, "  %-12.9g", cell->value);
    if (cell->left_out) {
        strbuf_format(out, " left out: %s\n", cell->left_out);
        return;
    }
    strbuf_format(out, " %-7s", cell->is_double ? "double" : "single");
    for (int m = 0; m < EXTREME_METRICS; m++)
        put_number(out, cell, m);
    strbuf_cstr(out, cell->broken ? "  BROKEN\n" : "\n");
}

static void put_broken(struct strbuf *out, const struct extreme_cell *cell) {
    for (int m = 0; m < EXTREME_METRICS; m++)
        if (cell->broken >> m & 1)
            strbuf_format(out, "  %s %.9g: %s %.6g, at most %.6g\n", extreme_axes[cell->axis].title,
                          cell->value, extreme_metrics[m].title, cell->measured[m], cell->bound[m]);
}

void extremes_text(const struct extremes_report *report, struct strbuf *out) {
    const struct extremes *e = report->extremes;
    strbuf_format(out, "%.*s at its extremes, %u x %u pixels, on %s; bounds of %.*s\n",
                  STR_ARG(report->scene), report->input->width, report->input->height, e->device,
                  STR_ARG(report->thresholds));
    if (report->input->alternative != RENDER_ALTERNATIVE_NONE)
        strbuf_format(out, "traced by another method: %s\n",
                      render_alternative_name(report->input->alternative));
    for (int m = 0; m < EXTREME_METRICS; m++)
        strbuf_format(out, "  %-10s %s\n", extreme_metrics[m].name, extreme_metrics[m].title);
    for (uint32_t i = 0; i < e->count; i++) {
        const struct extreme_cell *cell = &e->cells[i];
        if (i == 0 || cell->axis != e->cells[i - 1].axis) {
            strbuf_format(out, "\n%-22s", extreme_axes[cell->axis].title);
            for (int m = 0; m < EXTREME_METRICS; m++)
                strbuf_format(out, " %*s ", COLUMN, extreme_metrics[m].name);
            strbuf_char(out, '\n');
        }
        put_cell(out, cell);
    }
    strbuf_format(out, "\n%u cells, %u left out, %u broken, %.1f s\n", e->count, e->left_out, e->broken,
                  e->seconds);
    for (uint32_t i = 0; i < e->count; i++)
        put_broken(out, &e->cells[i]);
}

static void json_numbers(struct json_writer *w, const char *key, const double *values) {
    json_open_object(w, key);
    for (int m = 0; m < EXTREME_METRICS; m++)
        if (!isnan(values[m]))
            json_write_real(w, extreme_metrics[m].name, values[m]);
    json_close_object(w);
}

static void json_cell(struct json_writer *w, const struct extreme_cell *cell) {
    json_open_object(w, NULL);
    json_write_text(w, "axis", str_from(extreme_axes[cell->axis].name));
    json_write_real(w, "value", cell->value);
    if (cell->left_out) {
        json_write_text(w, "left_out", str_from(cell->left_out));
    } else {
        json_write_text(w, "precision", cell->is_double ? STR("double") : STR("single"));
        json_numbers(w, "measured", cell->measured);
        json_numbers(w, "bounds", cell->bound);
        json_open_list(w, "broken");
        for (int m = 0; m < EXTREME_METRICS; m++)
            if (cell->broken >> m & 1)
                json_write_text(w, NULL, str_from(extreme_metrics[m].name));
        json_close_list(w);
    }
    json_write_real(w, "seconds", cell->seconds);
    json_close_object(w);
}

void extremes_json(const struct extremes_report *report, struct strbuf *out) {
    const struct extremes *e = report->extremes;
    struct json_writer w;
    json_writer_init(&w, out, 2);
    json_open_object(&w, NULL);
    json_write_text(&w, "scene", report->scene);
    json_write_text(&w, "thresholds", report->thresholds);
    json_write_text(&w, "device", str_from(e->device));
    json_write_text(&w, "study", str_from(render_alternative_name(report->input->alternative)));
    json_write_integer(&w, "width", report->input->width);
    json_write_integer(&w, "height", report->input->height);
    json_write_integer(&w, "broken", e->broken);
    json_write_integer(&w, "left_out", e->left_out);
    json_write_real(&w, "seconds", e->seconds);
    json_open_list(&w, "cells");
    for (uint32_t i = 0; i < e->count; i++)
        json_cell(&w, &e->cells[i]);
    json_close_list(&w);
    json_close_object(&w);
    json_end(&w);
}
