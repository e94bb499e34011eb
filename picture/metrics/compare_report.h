// The report of `glint compare`: what was compared, each metric, and whether it keeps its bound.
//
// Ownership: text points to the caller's. Thread safety: pure.
#ifndef GLINT_PICTURE_METRICS_COMPARE_REPORT_H
#define GLINT_PICTURE_METRICS_COMPARE_REPORT_H

#include "core/strbuf.h"
#include "picture/metrics/metrics.h"

// One bound per metric: its maximum, or its minimum if higher is better.
struct measure_bounds {
    bool has[METRIC_COUNT];
    double bound[METRIC_COUNT];
    double not_finite; // how many pixels may be not a number; 0 if no bound was given
};

struct compare_report {
    const char *path[2]; // picture, reference
    const char *kind[2]; // "PNG"
    uint32_t width, height;
    const struct measure_options *options;
    const struct measure_result *result;
    const struct measure_bounds *bounds;
};

// Whether a metric keeps its bound; true if it has none. NaN keeps no bound.
bool measure_keeps(const struct measure_bounds *bounds, const struct measure_result *result,
                   enum metric metric);
// All bounds together: if there is any, pixels that are not a number are bounded too.
bool compare_keeps_bounds(const struct compare_report *report);
void compare_text(const struct compare_report *report, struct strbuf *out);
void compare_json(const struct compare_report *report, struct strbuf *out);

#endif
