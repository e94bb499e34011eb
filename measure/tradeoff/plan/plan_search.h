// Which settings are tried when a few must do: for render, which wants an answer and no table. Private to
// measure/tradeoff.
//
// For a bound of the error: samples are doubled until it is kept, then what is traced is lowered, one knob
// after the other, as far as the bound allows. For a bound of the time: as many samples as fit, and the same
// with shorter paths. The search is a function of the rows that were measured: the same rows, the same next
// one. Thread safety: pure.
#ifndef GLINT_MEASURE_TRADEOFF_PLAN_PLAN_SEARCH_H
#define GLINT_MEASURE_TRADEOFF_PLAN_PLAN_SEARCH_H

#include "measure/tradeoff/plan/plan.h"

enum {
    SEARCH_ROWS_MAX = 48,
    SEARCH_SAMPLES_LEAST = 64, // that may be tried, however few the file has
    SEARCH_SAMPLES_TIMES = 4,  // the file's samples
};

struct plan_search_input {
    struct setting base;
    enum metric metric;
    double error_most;   // as metric_error; NaN: not asked for
    double time_most_ms; // NaN: not asked for
    uint32_t deepest;    // level that the file's rays reach
    bool bounces;        // something reflects or refracts
    bool cut;            // the file's settings cut rays that the ground truth follows
    double floor;        // error that the file's settings keep, however many samples; as metric_error
    bool allow_resolution;
};

// Describes the row to be measured next. false: nothing more is worth it.
bool plan_search_next(const struct plan_search_input *input, const struct row *rows, uint32_t count,
                      struct row *next);
// The most samples that are tried.
uint32_t plan_search_samples(const struct setting *base);

// ---- how far the ground truth of a search goes

// The value that is worse by this share of the error.
double plan_search_safe(enum metric metric, double value, double share);
// Samples that a row of `samples` is compared with: several times as many, and not only a few.
uint32_t plan_search_truth(uint32_t samples);

// A pilot of the ground truth, or of the file's settings.
struct plan_search_pilot {
    uint64_t segments; // rays that a sample may take
    double rays;       // and took, on average
    double change;     // mean difference from the picture of the pilot before it; of the first: infinite
    bool cut;          // some samples would have taken more
};

// Rays that a sample of the ground truth may take on average. `own`: of the file's settings.
double plan_search_rays(const struct setting *base, double own);
// Rays a sample of the pilot to be counted next; 0: what is known is enough. `bearable`: a change that does
// not matter.
uint64_t plan_search_pilot(const struct plan_search_pilot *pilots, uint32_t count, double rays_most,
                           uint64_t segments_most, double bearable);

#endif
