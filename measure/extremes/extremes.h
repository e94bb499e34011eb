// A scene at its extremes: moved, scaled, far away, with other indices, exponents, slivers, gaps, with light
// and camera on surfaces; each variant on a device against the double-precision reference.
//
// Variants are made of the IR in memory, in double; meshes and images are loaded once. Each axis varies one
// thing; a cell is one value of it. Axes that need a shape of their own put it in the scene's place, as large
// as the scene. Compared are the first rays (hits.h), a picture of one sample per pixel, the reference
// obeying the file's depth and weight, and how much of the background each pixel's whole path sees. Precision
// auto is decided anew for each cell. Ownership: extremes_finish frees the cells; the input must outlive the
// run. Errors: a status; device errors in gpu_error. Thread safety: the gpu's thread.
#ifndef GLINT_MEASURE_EXTREMES_EXTREMES_H
#define GLINT_MEASURE_EXTREMES_EXTREMES_H

#include "core/limits.h"
#include "core/strbuf.h"
#include "scene/view.h"
#include "tracer/render/render.h"

enum extreme_axis {
#define X(NAME, name, title) EXTREME_##NAME,
#include "measure/extremes/axes.def"
#undef X
    EXTREME_AXES,
};

enum extreme_metric {
#define X(NAME, name, title, unit) EXTREME_##NAME,
#include "measure/extremes/metrics.def"
#undef X
    EXTREME_METRICS,
};

struct extreme_axis_info {
    const char *name;  // "move"
    const char *title; // "moved by"
};
enum extreme_unit {
    EXTREME_UNIT_WHOLE,
    EXTREME_UNIT_SHARE,
    EXTREME_UNIT_SMALL, // two significant digits
};
struct extreme_metric_info {
    const char *name, *title;
    enum extreme_unit unit;
};
extern const struct extreme_axis_info extreme_axes[EXTREME_AXES];
extern const struct extreme_metric_info extreme_metrics[EXTREME_METRICS];

struct extreme_cell {
    enum extreme_axis axis;
    double value;
    const char *left_out;             // why it was not measured; NULL: it was
    bool is_double;                   // the precision that was chosen
    double measured[EXTREME_METRICS]; // NaN: not measured
    double bound[EXTREME_METRICS];    // the strictest one that applies; NaN: none
    uint32_t broken;                  // bit 1 << metric
    double seconds;
};

// A bound holds for the cells of an axis from one value to another.
struct extreme_bound {
    uint32_t axes; // bit 1 << axis
    double from, to;
    double bound[EXTREME_METRICS]; // NaN: none
};

struct extremes_input {
    const struct scene *scene;
    uint32_t camera;        // index in the scene; 0 where it has none
    uint32_t width, height; // pixels
    const struct limits *limits;
    struct gpu *gpu;
    const struct extreme_bound *bounds;
    uint32_t bound_count;
    uint32_t axes;                       // bit 1 << axis: those wanted
    enum render_alternative alternative; // another tracer's method, in single precision; else glint's own
};

// Called before each cell with the share done, 0..1, and the cell; false ends the run.
struct extremes_progress {
    bool (*report)(void *context, double fraction, const struct extreme_cell *cell);
    void *context;
};

// The bounds used if no others are given: YAML (load/settings/extreme_bounds.h).
extern const char extremes_default_bounds[];

enum extremes_status {
    EXTREMES_DONE,
    EXTREMES_CANCELLED,
    EXTREMES_DEVICE, // see gpu_error
    EXTREMES_MEMORY,
};

struct extremes {
    struct extreme_cell *cells; // by axis, then by value
    uint32_t count;
    uint32_t broken, left_out; // cells
    char device[256];
    double seconds;
};

enum extremes_status extremes_run(struct extremes *extremes, const struct extremes_input *input,
                                  const struct extremes_progress *progress);
void extremes_finish(struct extremes *extremes); // NULL and zeroed ones are fine

// A value in readable form; "-" if it is NaN.
void extreme_number(enum extreme_metric metric, double value, struct strbuf *out);

// ---- reports (extremes_report.c, extremes_html.c)

struct extremes_report {
    const struct extremes *extremes;
    const struct extremes_input *input;
    str scene, thresholds; // paths as shown
};
void extremes_text(const struct extremes_report *report, struct strbuf *out);
void extremes_json(const struct extremes_report *report, struct strbuf *out);
// One file, without scripts: the matrix as SVG, and each cell's numbers.
void extremes_html(const struct extremes_report *report, struct strbuf *out);

#endif
