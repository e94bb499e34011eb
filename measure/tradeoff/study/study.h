// A study of settings as data: what it is given and asked, its rows, what it found.
//
// A row is a setting, what it was measured to cost and what error it brings; the first is the file's own.
// What measures, chooses and reports shares this, and no more. Ownership: struct tradeoff owns its rows and
// their pictures (tradeoff_finish frees them); the rest is the caller's. Units are in the names. Thread
// safety: plain data.
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

// What a whole study may take where nothing else is asked for, in seconds.
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
    KNOB_ALTERNATIVE, // other tracers' ways: never chosen
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

// Whether pixels end by their error: none does before it has the least samples.
static inline bool setting_ends_pixels(const struct setting *s) {
    return s->error > 0 && s->samples > s->min_samples;
}

// What was counted; it does not vary from run to run.
struct work {
    uint64_t rays, nodes, triangles; // rays of all kinds; nodes and triangles (spheres too) tested
    uint32_t deepest;                // level of a ray that was traced
    double samples;                  // of a pixel, on average
    double cost;                     // nodes + triangles, doubled in double precision; see docs/accuracy.md
};

// Mean absolute errors of what comes one after the other; the signed errors add up to that of the picture.
struct error_parts {
    bool known;
    double numeric;    // device against the reference at the same settings
    double truncation; // what max_depth, min_weight, absent shadows and what else is absent leave out
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
    // Of a search, as metric_error: what remains of the error with all samples, of a small picture; and what
    // rounding to the file's format alone brings.
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
    double end;            // clock: when it must be over; 0: when it may
    bool search;           // for choosing alone, by few rows: no alternatives, hits, parts or rounds
    bool allow_resolution; // of a search: smaller pictures, to be scaled up, may be chosen
    double threshold, ppd; // of the metrics
    double levels;         // of a search: steps of the format that is written; 0: it is not rounded
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
    bool is_double;            // what precision 'auto' comes to
};

enum tradeoff_status {
    TRADEOFF_DONE,
    TRADEOFF_CANCELLED,
    TRADEOFF_SCENE,  // see the sink
    TRADEOFF_DEVICE, // see gpu_error
    TRADEOFF_MEMORY,
};

// Why a search found nothing that keeps the error, and what would.
enum search_reason {
    SEARCH_UNKNOWN,
    SEARCH_SAMPLES, // more samples: about so many, which take so long
    SEARCH_FORMAT,  // no picture of the format does: rounding alone has the value
    SEARCH_REMAINS, // no number of samples does: the value remains
};

struct search_verdict {
    enum search_reason kind;
    double samples, seconds, value;
};

// Called with what is done, 0..1, and what is under way; false ends the study.
struct tradeoff_progress {
    bool (*report)(void *context, double fraction, const char *what);
    void *context;
};

struct tradeoff {
    struct tradeoff_options options;
    struct setting base; // the file's own
    struct row *rows;    // of a whole study [0] is the file's own setting
    uint32_t count, capacity;
    uint32_t tried; // by a search: rows, and what showed on a small picture what to draw
    uint32_t ground_truth_samples;
    uint64_t ground_truth_segments;  // rays that a sample of the ground truth might take
    bool ground_truth_cut;           // the budget lowered that, and some samples would have taken more
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
    struct choice cheapest, best_within, both; // the last where both bounds were asked for
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
