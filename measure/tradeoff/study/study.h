// A study of settings as data: its input and options, its rows, its findings.
//
// A row is a setting, its measured cost and its error; the first is the file's own. The code that measures,
// chooses and reports shares this and nothing else. Ownership: struct tradeoff owns its rows and their
// pictures (tradeoff_finish frees them); the rest is the caller's. Units are in the names. Thread safety:
// plain data.
#ifndef GLINT_MEASURE_TRADEOFF_STUDY_STUDY_H
#define GLINT_MEASURE_TRADEOFF_STUDY_STUDY_H

#include "core/limits.h"
#include "core/ranges.h"
#include "core/strbuf.h"
#include "diag/diag.h"
#include "files/folder_store.h"
#include "measure/hit_errors.h"
#include "measure/tradeoff/choose/choose.h"
#include "picture/metrics/metrics.h"
#include "scene/view.h"
#include "tracer/render/render.h"

enum {
    TRADEOFF_COST_MOST = 64, // settings that cost more than this many times the file's own are left out
    SEARCH_SAMPLES_MOST = RANGE_SAMPLES_MOST,
};

// How long a whole study may take by default, in seconds.
#define TRADEOFF_BUDGET_S 60

enum knob {
    KNOB_MAX_DEPTH,
    KNOB_MIN_WEIGHT,
    KNOB_PRECISION,
    KNOB_SAMPLES,
    KNOB_SHADOWS,
    KNOB_RESOLUTION,
    KNOB_ERROR, // pixels end by their error; `samples` is then part of it
    // What the picture has is left out, as a bit of setting.without.
    KNOB_CLEAR_SHADOWS,
    KNOB_OCCLUSION,
    KNOB_SOFT_LIGHTS, // these four are not one setting of a file: never chosen
    KNOB_LENS,
    KNOB_ROUGHNESS,
    KNOB_FILTER,
    KNOB_FEATURES,    // what is compiled in: not a setting of the file, never chosen
    KNOB_ALTERNATIVE, // other tracers' methods: never chosen
    KNOB_COUNT,
};

#define KNOBS_WITHOUT                                                                                        \
    (1u << KNOB_CLEAR_SHADOWS | 1u << KNOB_OCCLUSION | 1u << KNOB_SOFT_LIGHTS | 1u << KNOB_LENS |            \
     1u << KNOB_ROUGHNESS | 1u << KNOB_FILTER)
#define KNOBS_NEVER_CHOSEN                                                                                   \
    (1u << KNOB_SOFT_LIGHTS | 1u << KNOB_LENS | 1u << KNOB_ROUGHNESS | 1u << KNOB_FILTER |                   \
     1u << KNOB_FEATURES | 1u << KNOB_ALTERNATIVE)

struct setting {
    uint32_t width, height, samples, max_depth;
    double min_weight;
    double error;         // 0: all pixels take all samples
    uint32_t min_samples; // with an error
    uint32_t without;     // of KNOBS_WITHOUT, what is left out
    bool is_double, shadows;
    bool general; // every feature of the language is compiled in
    enum render_alternative alternative;
};

// Whether pixels end by their error: none does before it has min_samples.
static inline bool setting_ends_pixels(const struct setting *s) {
    return s->error > 0 && s->samples > s->min_samples;
}

// Counted work; it does not vary from run to run.
struct work {
    uint64_t rays, nodes, triangles; // rays of all kinds; nodes and triangles (spheres too) tested
    uint32_t deepest;                // deepest level of a traced ray
    double samples;                  // of a pixel, on average
    double cost;                     // nodes + triangles, doubled in double precision; see docs/accuracy.md
};

// Mean absolute errors of successive causes; their signed errors add up to the picture's.
struct error_parts {
    bool known;
    double numeric;    // device against the reference at the same settings
    double truncation; // left out by max_depth, min_weight, absent shadows and other absent parts
    double sampling;   // few samples against those of the ground truth
    double resolution; // fewer pixels, scaled up
};

struct row {
    struct setting setting;
    uint32_t knobs; // 1 << KNOB_...: what differs from the file's
    bool choosable;
    char name[96]; // "max_depth 4, samples 2"
    struct work work;
    double time_ms;                             // median, ordered by plan_order_times
    double time_low_ms, time_high_ms, noise_ms; // quartiles, standard error of the median
    double value[METRIC_COUNT];                 // as measure_result
    uint64_t not_finite;                        // pixels the device reported
    // For a search, as metric_error: the error that remains with all samples, in a small picture; and the
    // error from rounding to the file's format alone.
    double floor, rounding;
    struct error_parts parts;
    struct hit_errors hits;
    struct strbuf thumbnail, difference; // PNG; empty where not wanted
    uint32_t time_class, rank;           // by the metric of the study
    bool on_front;
};

struct tradeoff_options {
    enum metric metric;    // of front, knee and choices
    double max_error;      // NaN: not asked. In the metric's own sense: at least, where higher is better
    double max_time_ms;    // NaN: not asked
    double budget_s;       // wall time; 0: as long as it takes
    bool thumbnails;       // for a report with pictures
    double end;            // clock: when it must end; 0: no limit
    bool search;           // only for choosing, from few rows: no alternatives, hits, parts or rounds
    bool allow_resolution; // for a search: smaller pictures, to be scaled up, may be chosen
    double threshold, ppd; // of the metrics
    double levels;         // for a search: steps of the format that is written; 0: it is not rounded
};

struct tradeoff_input {
    const struct scene *scene;
    const struct view *view;
    const struct ir_image *image; // size and samples to start from
    vec3 origin;
    const struct limits *limits;
    struct diag_sink *sink;
    struct gpu *gpu;
    struct folder_store store; // of the reference
    bool is_double;            // what precision 'auto' resolves to
};

enum tradeoff_status {
    TRADEOFF_DONE,
    TRADEOFF_CANCELLED,
    TRADEOFF_SCENE,  // see the sink
    TRADEOFF_DEVICE, // see gpu_error
    TRADEOFF_MEMORY,
};

// Why a search found nothing that keeps the error, and what would keep it.
enum search_reason {
    SEARCH_UNKNOWN,
    SEARCH_SAMPLES, // more samples: about this many, which take this long
    SEARCH_FORMAT,  // no picture in this format does: rounding alone has this value
    SEARCH_REMAINS, // no number of samples does: this value remains
};

struct search_verdict {
    enum search_reason kind;
    double samples, seconds, value;
};

// Called with the share done, 0..1, and the current step; false ends the study.
struct tradeoff_progress {
    bool (*report)(void *context, double fraction, const char *what);
    void *context;
};

struct tradeoff {
    struct tradeoff_options options;
    struct setting base; // the file's own
    struct row *rows;    // of a whole study [0] is the file's own setting
    uint32_t count, capacity;
    uint32_t tried; // by a search: rows, and small pictures that showed what to draw
    uint32_t ground_truth_samples;
    uint64_t ground_truth_segments;  // rays that a sample of the ground truth may take
    bool ground_truth_cut;           // the budget lowered that limit, and some samples would have taken more
    double ground_truth_left_weight; // of the rays that the ground truth did not follow, mean of the pixels
    // For lack of time:
    uint32_t parts_out;  // rows without parts
    bool numeric_probed; // the numeric part was measured at the probes only
    bool hits_out;       // first hits were not compared
    uint32_t rounds;
    uint32_t rows_left_out;        // for which the budget was too small
    uint32_t pairs_left_out;       // less promising ones, and those for which the budget was too small
    uint32_t too_costly;           // settings that would have cost far more than the file's
    bool cut_short;                // by the budget
    bool is_recalled;              // measured by an earlier call
    struct search_verdict verdict; // of a search for an error that found nothing
    uint32_t part_pixels;          // at which the parts were measured
    double seconds, reference_seconds;
    char device[256];
    double noise;  // share of a time below which two are equal
    double slope;  // errors (mae) fall as samples to this power; NaN: too few rows
    uint32_t knee; // CHOICE_NONE: none
    struct choice cheapest, best_within, both; // the last if both bounds were asked for
};

// ---- what to paste (setting_text.c); only what differs from `base` is written.

void setting_yaml(const struct setting *setting, const struct setting *base, struct strbuf *out);
void setting_xml(const struct setting *setting, const struct setting *base, struct strbuf *out);
// " --set trace.max_depth=4 …"
void setting_options(const struct setting *setting, const struct setting *base, struct strbuf *out);
// PATH=VALUE, number `index` of them; false: there are no more.
bool setting_assignment(const struct setting *setting, const struct setting *base, uint32_t index, char *out,
                        size_t capacity);

#endif
