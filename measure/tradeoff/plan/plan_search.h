// Which settings are tried when a few must be enough: for render, which wants an answer, not a table. Private
// to measure/tradeoff.
//
// For a bound on the error: less is traced, one knob after the other, if a few samples of a small picture
// show that little more error remains, or paths are made longer if the file's are too short for the bound;
// then samples are added until the bound is kept, as many as the rows so far predict. For a bound on the
// time: as many samples as fit, and the same with shorter paths. The search is a function of the rows that
// were measured: the same rows give the same next one. Thread safety: pure.
#ifndef GLINT_MEASURE_TRADEOFF_PLAN_PLAN_SEARCH_H
#define GLINT_MEASURE_TRADEOFF_PLAN_PLAN_SEARCH_H

#include "measure/tradeoff/plan/plan.h"

enum {
    SEARCH_ROWS_MAX = 64,
    SEARCH_PROBE = 0, // samples of a row that is not a picture: its `floor` is wanted
};

struct plan_search_input {
    struct setting base;
    enum metric metric;
    double error_most;   // as metric_error; NaN: not asked for
    double time_most_ms; // NaN: not asked for
    uint32_t deepest;    // level that the file's rays reach
    bool bounces;        // something reflects or refracts
    bool keeps_depth;    // max_depth is a part of the picture: paths are not made longer
    bool cut;            // the file's settings cut rays that the ground truth follows
    bool allow_resolution;
};

// Describes the row to be measured next. false: no further row is worth it.
bool plan_search_next(const struct plan_search_input *input, const struct row *rows, uint32_t count,
                      struct row *next);
// What the rows of a search for a bound on the error tell about it, if none keeps it.
struct search_verdict plan_search_verdict(const struct plan_search_input *input, const struct row *rows,
                                          uint32_t count);

// ---- how far the ground truth of a search goes

// The value that is worse by this share of the error.
double plan_search_safe(enum metric metric, double value, double share);

// A pilot of the ground truth, or of the file's settings.
struct plan_search_pilot {
    uint64_t segments; // rays that a sample may take
    double rays;       // and took, on average
    double change;     // mean difference from the picture of the pilot before it; of the first: infinite
    bool cut;          // some samples would have taken more
};

// Rays that a sample of the ground truth may take on average.
double plan_search_rays(void);
// The size and samples of the picture that the reference makes if a sample takes this many rays: it has at
// most the file's pixels.
struct plan_search_probe {
    uint32_t width, height, samples;
};
struct plan_search_probe plan_search_probe(const struct setting *base, double rays);
// Rays per sample of the pilot to be counted next; 0: enough is known. `bearable`: a change that does not
// matter.
uint64_t plan_search_pilot(const struct plan_search_pilot *pilots, uint32_t count, double rays_most,
                           uint64_t segments_most, double bearable);

// For the mean of a pixel's first `samples` samples and that of the last `newer` of `older` + `newer`: the
// distance of the first from the truth over the distance between them. At least what chance gives, and at
// least what straight edges give.
double plan_search_reach(uint32_t samples, uint32_t older, uint32_t newer);

// How many samples to draw beyond those of a whole picture, in order to judge by them whether it keeps its
// bound; 0: its own are enough. At most twice as many.
uint32_t plan_search_more(const struct setting *setting);

#endif
