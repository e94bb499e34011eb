// Extremes as one HTML file: the matrix as SVG, with a row per axis, a cell per value and in it a strip per
// metric; then all numbers. No scripts, no external resources.
#include "measure/extremes/extremes.h"

#include <math.h>

enum {
    CELL_WIDTH = 77, // EXTREME_METRICS strips of 7
    CELL_HEIGHT = 30,
    STRIP_WIDTH = CELL_WIDTH / EXTREME_METRICS,
    COLUMN = CELL_WIDTH + 5,
    ROW = CELL_HEIGHT + 24,
    LEFT = 170,
    TOP = 10,
};

static const char style[] =
    "body{font:15px/1.5 system-ui,sans-serif;margin:2em auto;max-width:76em;padding:0 1em;"
    "color:#1b1b1b;background:#fff}"
    "h1{font-size:1.4em}h2{font-size:1.1em;margin:1.6em 0 .4em}"
    "table{border-collapse:collapse;font-size:13px;font-variant-numeric:tabular-nums}"
    "th,td{padding:.15em .7em;text-align:right;border-bottom:1px solid #ddd}th{text-align:right}"
    "th:first-child,td:first-child{text-align:left}.b{background:#f6c7c0;font-weight:600}"
    ".n{color:#777}svg text{font:12px system-ui,sans-serif;fill:#1b1b1b}"
    ".key span{display:inline-block;width:1em;height:1em;vertical-align:-.15em;margin:0 .3em 0 1em}"
    "@media(prefers-color-scheme:dark){body{color:#e6e6e6;background:#181818}svg text{fill:#e6e6e6}"
    "th,td{border-color:#444}.b{background:#7a2b22}}";

// Green if nothing is wrong, yellow to orange the nearer to the bound, red beyond; blue to violet if there is
// no bound; grey if nothing was measured.
static const char *strip_color(const struct extreme_cell *cell, int metric) {
    static const char *const bounded[] = {"#2f9e62", "#8fbf4d", "#e0b93c", "#e08a3c"};
    static const char *const unbounded[] = {"#9fc3dd", "#6f8fd0", "#6a5acd"};
    const double value = cell->measured[metric], bound = cell->bound[metric];
    if (isnan(value))
        return "#c8c8c8";
    if (cell->broken >> metric & 1)
        return "#d0342c";
    if (isnan(bound))
        return value == 0                                     ? unbounded[0]
               : value < 1e-3 || (value >= 1 && value < 1000) ? unbounded[1]
                                                              : unbounded[2];
    if (value == 0)
        return bounded[0];
    return value <= bound / 10 ? bounded[1] : value <= bound / 2 ? bounded[2] : bounded[3];
}

static void put_title(struct strbuf *out, const struct extreme_cell *cell) {
    strbuf_format(out, "<title>%s %.9g", extreme_axes[cell->axis].title, cell->value);
    if (cell->left_out) {
        strbuf_format(out, "\nleft out: %s", cell->left_out);
    } else {
        strbuf_format(out, ", %s precision", cell->is_double ? "double" : "single");
        for (int m = 0; m < EXTREME_METRICS; m++)
            if (!isnan(cell->measured[m])) {
                strbuf_format(out, "\n%s: %.6g", extreme_metrics[m].title, cell->measured[m]);
                if (!isnan(cell->bound[m]))
                    strbuf_format(out, " (at most %.6g)", cell->bound[m]);
            }
    }
    strbuf_cstr(out, "</title>");
}

static void put_square(struct strbuf *out, const struct extreme_cell *cell, int column, int row) {
    const int x = LEFT + column * COLUMN, y = TOP + row * ROW;
    strbuf_cstr(out, "<g>");
    put_title(out, cell);
    for (int m = 0; m < EXTREME_METRICS; m++)
        strbuf_format(out, "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" fill=\"%s\"/>",
                      x + m * STRIP_WIDTH, y, STRIP_WIDTH, CELL_HEIGHT, strip_color(cell, m));
    strbuf_format(out,
                  "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" fill=\"none\" stroke=\"%s\" "
                  "stroke-width=\"%d\"/><text x=\"%d\" y=\"%d\" text-anchor=\"middle\">%.*g%s</text></g>\n",
                  x, y, CELL_WIDTH, CELL_HEIGHT, cell->broken ? "#d0342c" : "#555", cell->broken ? 3 : 1,
                  x + CELL_WIDTH / 2, y + CELL_HEIGHT + 14, cell->value < 1e5 ? 9 : 3, cell->value,
                  cell->is_double ? " d" : "");
}

static void put_matrix(struct strbuf *out, const struct extremes *e) {
    int rows = 0, widest = 0, column = 0;
    for (uint32_t i = 0; i < e->count; i++) {
        const bool begins = i == 0 || e->cells[i].axis != e->cells[i - 1].axis;
        rows += begins;
        column = begins ? 1 : column + 1;
        widest = column > widest ? column : widest;
    }
    strbuf_format(out, "<svg width=\"%d\" height=\"%d\" role=\"img\" aria-label=\"matrix of cells\">\n",
                  LEFT + widest * COLUMN, TOP + rows * ROW);
    int row = -1;
    for (uint32_t i = 0; i < e->count; i++) {
        const struct extreme_cell *cell = &e->cells[i];
        if (i == 0 || cell->axis != e->cells[i - 1].axis) {
            row++;
            column = 0;
            strbuf_format(out, "<text x=\"0\" y=\"%d\">%s</text>\n", TOP + row * ROW + 20,
                          extreme_axes[cell->axis].title);
        }
        put_square(out, cell, column++, row);
    }
    strbuf_cstr(out, "</svg>\n");
}

static void put_row(struct strbuf *out, const struct extreme_cell *cell) {
    strbuf_format(out, "<tr><td>%.9g</td>", cell->value);
    if (cell->left_out) {
        strbuf_format(out,
                      "<td class=\"n\" colspan=\"%d\" style=\"text-align:left\">left out: %s</td></tr>\n",
                      EXTREME_METRICS + 1, cell->left_out);
        return;
    }
    strbuf_format(out, "<td>%s</td>", cell->is_double ? "double" : "single");
    for (int m = 0; m < EXTREME_METRICS; m++) {
        strbuf_cstr(out, cell->broken >> m & 1 ? "<td class=\"b\">" : "<td>");
        extreme_number((enum extreme_metric)m, cell->measured[m], out);
        if (cell->broken >> m & 1)
            strbuf_format(out, " &gt; %.4g", cell->bound[m]);
        strbuf_cstr(out, "</td>");
    }
    strbuf_cstr(out, "</tr>\n");
}

static void put_tables(struct strbuf *out, const struct extremes *e) {
    for (uint32_t i = 0; i < e->count; i++) {
        const struct extreme_cell *cell = &e->cells[i];
        if (i == 0 || cell->axis != e->cells[i - 1].axis) {
            strbuf_format(out, "%s<h2>%s</h2>\n<table><tr><th></th><th>precision</th>", i ? "</table>\n" : "",
                          extreme_axes[cell->axis].title);
            for (int m = 0; m < EXTREME_METRICS; m++)
                strbuf_format(out, "<th title=\"%s\">%s</th>", extreme_metrics[m].title,
                              extreme_metrics[m].name);
            strbuf_cstr(out, "</tr>\n");
        }
        put_row(out, cell);
    }
    strbuf_cstr(out, e->count ? "</table>\n" : "");
}

void extremes_html(const struct extremes_report *report, struct strbuf *out) {
    const struct extremes *e = report->extremes;
    strbuf_cstr(out, "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>");
    strbuf_markup(out, report->scene);
    strbuf_format(out, " at its extremes</title><style>%s</style></head><body>\n<h1>", style);
    strbuf_markup(out, report->scene);
    strbuf_format(out,
                  " at its extremes</h1>\n<p>%u cells, %u left out, <b>%u broken</b>. %u x %u pixels on ",
                  e->count, e->left_out, e->broken, report->input->width, report->input->height);
    strbuf_markup(out, str_from(e->device));
    if (report->input->alternative != RENDER_ALTERNATIVE_NONE)
        strbuf_format(out, ", traced by another method (%s)",
                      render_alternative_name(report->input->alternative));
    strbuf_cstr(out, ", against the double-precision reference; bounds of ");
    strbuf_markup(out, report->thresholds);
    strbuf_cstr(out, ".</p>\n");
    put_matrix(out, e);
    strbuf_cstr(out, "<p>The strips of a cell are metrics, from the left: ");
    for (int m = 0; m < EXTREME_METRICS; m++)
        strbuf_format(out, "%s%s", m ? "; " : "", extreme_metrics[m].title);
    strbuf_cstr(out, ". A cell with a d was traced in double precision.</p>\n<p class=\"key\">"
                     "<span style=\"background:#2f9e62\"></span>nothing wrong"
                     "<span style=\"background:#8fbf4d\"></span>up to a tenth of the bound"
                     "<span style=\"background:#e0b93c\"></span>up to half of it"
                     "<span style=\"background:#e08a3c\"></span>up to the bound"
                     "<span style=\"background:#d0342c\"></span>beyond it"
                     "<span style=\"background:#9fc3dd\"></span>no bound, nothing wrong"
                     "<span style=\"background:#6a5acd\"></span>no bound, something wrong"
                     "<span style=\"background:#c8c8c8\"></span>not measured</p>\n");
    put_tables(out, e);
    strbuf_cstr(out, "</body></html>\n");
}
