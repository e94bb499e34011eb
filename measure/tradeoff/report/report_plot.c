// The plot of the report: time and error of every row, coloured by its kind, the front as a line.
#include "core/heap.h"
#include "measure/tradeoff/report/report_html.h"

#include <math.h>
#include <stdlib.h>

enum {
    WIDTH = 860,
    HEIGHT = 460,
    LEFT = 74,
    RIGHT = 20,
    TOP = 18,
    BOTTOM = 52,
};

struct axis {
    double low, high; // of the logarithm
    double from, to;  // pixels
};

static double place(const struct axis *axis, double value) {
    const double at = (log10(value) - axis->low) / (axis->high - axis->low);
    return axis->from + at * (axis->to - axis->from);
}

// Errors of 0, and equal pictures, are drawn at the end of the axis.
static double shown_error(const struct tradeoff *t, const struct row *row, double least) {
    const double value = row->value[t->options.metric];
    const double error = t->options.metric == METRIC_SSIM ? 1 - value : value;
    return isfinite(error) && error > least ? error : least;
}

static struct axis axis_over(double low, double high, double from, double to) {
    const double margin = fmax(0.06 * (log10(high) - log10(low)), 0.05);
    return (struct axis){log10(low) - margin, log10(high) + margin, from, to};
}

static void label(struct strbuf *out, double value) {
    if (value >= 0.001 && value < 100000)
        strbuf_format(out, "%.5g", value);
    else
        strbuf_format(out, "%.0e", value);
}

static void ticks(const struct axis *axis, bool vertical, struct strbuf *out) {
    static const double steps[] = {1, 2, 5};
    const bool sparse = axis->high - axis->low > 2.2;
    for (double decade = floor(axis->low); decade <= ceil(axis->high); decade++)
        for (int i = 0; i < (sparse ? 1 : 3); i++) {
            const double value = steps[i] * pow(10, decade);
            if (log10(value) < axis->low || log10(value) > axis->high)
                continue;
            const double at = place(axis, value);
            if (vertical)
                strbuf_format(out,
                              "<line class=\"grid\" x1=\"%d\" x2=\"%d\" y1=\"%.1f\" y2=\"%.1f\"/><text "
                              "class=\"tick\" text-anchor=\"end\" x=\"%d\" y=\"%.1f\">",
                              LEFT, WIDTH - RIGHT, at, at, LEFT - 8, at + 4);
            else
                strbuf_format(out,
                              "<line class=\"grid\" x1=\"%.1f\" x2=\"%.1f\" y1=\"%d\" y2=\"%d\"/><text "
                              "class=\"tick\" text-anchor=\"middle\" x=\"%.1f\" y=\"%d\">",
                              at, at, TOP, HEIGHT - BOTTOM, at, HEIGHT - BOTTOM + 18);
            label(out, value);
            strbuf_cstr(out, "</text>\n");
        }
}

struct plot {
    const struct tradeoff *t;
    struct axis x, y;
    double least; // error drawn for an error of 0
};

static struct plot plan(const struct tradeoff *t) {
    double fast = INFINITY, slow = 0, small = INFINITY, large = 0;
    for (uint32_t i = 0; i < t->count; i++) {
        const double error = shown_error(t, &t->rows[i], 0);
        fast = fmin(fast, t->rows[i].time_ms);
        slow = fmax(slow, t->rows[i].time_ms);
        small = error > 0 ? fmin(small, error) : small;
        large = fmax(large, error);
    }
    fast = fmax(fast, 1e-6);
    small = isfinite(small) ? small : 1e-6;
    struct plot p = {.t = t, .least = small};
    p.x = axis_over(fast, fmax(slow, fast), LEFT, WIDTH - RIGHT);
    p.y = axis_over(small, fmax(large, small), HEIGHT - BOTTOM, TOP);
    if (metric_infos[t->options.metric].higher_is_better && t->options.metric != METRIC_SSIM)
        p.y = axis_over(small, fmax(large, small), TOP, HEIGHT - BOTTOM);
    return p;
}

static const char *const knob_names[KNOB_COUNT] = {
    "max_depth", "min_weight", "precision", "samples", "shadows", "resolution", "error", "without",
    "without",   "without",    "without",   "without", "without", "features",   "study",
};

const char *html_kind(const struct row *row) {
    if (!row->knobs)
        return "file";
    if (row->knobs & 1u << KNOB_ALTERNATIVE)
        return "study";
    for (int i = 0; i < KNOB_COUNT; i++)
        if (row->knobs == 1u << i)
            return knob_names[i];
    return "pair";
}

static int by_rank(const void *a, const void *b) {
    const struct row *p = *(const struct row *const *)a, *q = *(const struct row *const *)b;
    return p->rank < q->rank ? -1 : p->rank > q->rank;
}

static void front_line(const struct plot *p, struct strbuf *out) {
    const struct tradeoff *t = p->t;
    const struct row **front = heap_array(t->count ? t->count : 1, sizeof *front);
    uint32_t count = 0;
    if (!front) {
        out->failed = true;
        return;
    }
    for (uint32_t i = 0; i < t->count; i++)
        if (t->rows[i].on_front)
            front[count++] = &t->rows[i];
    qsort(front, count, sizeof *front, by_rank);
    strbuf_cstr(out, "<polyline class=\"front\" points=\"");
    for (uint32_t i = 0; i < count; i++)
        strbuf_format(out, "%.1f,%.1f ", place(&p->x, fmax(front[i]->time_ms, 1e-6)),
                      place(&p->y, shown_error(t, front[i], p->least)));
    strbuf_cstr(out, "\"/>\n");
    free(front);
}

static void point(const struct plot *p, uint32_t index, struct strbuf *out) {
    const struct tradeoff *t = p->t;
    const struct row *row = &t->rows[index];
    const double x = place(&p->x, fmax(row->time_ms, 1e-6)), y = place(&p->y, shown_error(t, row, p->least));
    strbuf_format(out,
                  "<g class=\"point %s\"><line class=\"spread\" x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" "
                  "y2=\"%.1f\"/><circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\"/><title>row %u: ",
                  html_kind(row), place(&p->x, fmax(row->time_low_ms, 1e-6)),
                  place(&p->x, fmax(row->time_high_ms, 1e-6)), y, y, x, y, row->on_front ? "6" : "4", index);
    strbuf_markup(out, str_from(row->name));
    strbuf_format(out, "\n%.4g ms, %s %.4g</title></g>\n", row->time_ms, metric_infos[t->options.metric].name,
                  row->value[t->options.metric]);
    if (index == t->knee)
        strbuf_format(
            out,
            "<circle class=\"knee\" cx=\"%.1f\" cy=\"%.1f\" r=\"11\"/><text class=\"note\" x=\"%.1f\" "
            "y=\"%.1f\">knee</text>\n",
            x, y, x + 14, y - 8);
}

void html_plot(const struct tradeoff *t, struct strbuf *out) {
    const struct plot p = plan(t);
    const struct metric_info *info = &metric_infos[t->options.metric];
    strbuf_format(out, "<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"time against error\">\n", WIDTH,
                  HEIGHT);
    ticks(&p.x, false, out);
    ticks(&p.y, true, out);
    strbuf_format(
        out,
        "<text class=\"axis\" text-anchor=\"middle\" x=\"%d\" y=\"%d\">time of a frame on the device, "
        "ms</text>\n",
        (LEFT + WIDTH - RIGHT) / 2, HEIGHT - 10);
    strbuf_format(out,
                  "<text class=\"axis\" text-anchor=\"middle\" transform=\"translate(16 %d) "
                  "rotate(-90)\">%s%s</text>\n",
                  (TOP + HEIGHT - BOTTOM) / 2, t->options.metric == METRIC_SSIM ? "1 - " : "", info->name);
    front_line(&p, out);
    for (uint32_t i = t->count; i-- > 0;)
        point(&p, i, out);
    strbuf_cstr(out, "</svg>\n");
}
