// Which settings are tried: the ladders of each knob, and pairs of those that mattered; and how far the
// ground truth that they are compared with goes. Private to measure/tradeoff.
//
// The plan depends only on the scene, counted work and measured errors, never on a clock. Thread safety:
// pure.
#ifndef GLINT_MEASURE_TRADEOFF_PLAN_PLAN_H
#define GLINT_MEASURE_TRADEOFF_PLAN_PLAN_H

#include "measure/tradeoff/study/study.h"

enum {
    PLAN_ROWS_MAX = 96,
    PLAN_PILOT_SEGMENTS = 16, // rays that a sample of the first pilot may take
    PLAN_PILOTS_MAX = 16,
    PLAN_SIZES_MAX = 3,
};

struct plan_input {
    struct setting base;
    bool bounces;      // something reflects or refracts
    uint32_t deepest;  // level that the file's settings reach
    bool knows_double; // the device supports it
    bool has_triangles;
    uint32_t most_samples; // of a ladder
    uint32_t parts;        // the parts among KNOBS_WITHOUT that the scene has
};

// The file's own settings first, then each knob's ladder from coarse to fine, without the file's own value.
// Returns the number of rows, at most PLAN_ROWS_MAX.
uint32_t plan_single(const struct plan_input *input, struct row *rows);

// Smaller pictures, from coarse to fine; returns how many there are.
uint32_t plan_sizes(const struct setting *base, struct setting sizes[PLAN_SIZES_MAX]);

// Pairs of settings, one from each of two knobs that mattered: by at least 2 % of the work or 5 % of the
// error. Only settings that no row of their own knob betters in both are taken. Pairs that the fewest others
// are predicted to better come first; at most `most`. Returns the number of rows.
uint32_t plan_pairs(const struct row *rows, uint32_t count, enum metric metric, uint32_t most,
                    struct row *pairs, uint32_t *left_out);

// Makes times rise where rays are only added: a row that sends a part of another's rays, with the same kernel
// or one with fewer features, is never the slower one, whatever was measured. Times that contradict this are
// noise, and are set to their middle; all others stay. false: no memory.
bool plan_order_times(struct row *rows, uint32_t count);

// ---- the ground truth (plan_ground_truth.c)

// A small picture of the ground truth, to count what the whole one would take: the file's own rays do not
// tell, because they end at max_depth and min_weight.
struct plan_pilot {
    uint64_t segments; // rays that a sample might take
    double rays;       // and took, on average
    bool cut;          // some samples would have taken more
};

struct plan_ground_truth_input {
    uint32_t file_samples;
    uint64_t pixels, pilot_pixels; // traced for the study, and by a pilot
    double rays_most;              // that all may take together; INFINITY: no bound
    uint64_t segments_most;        // that a sample may take if there is no bound
    const struct plan_pilot *pilots;
    uint32_t pilot_count; // at most PLAN_PILOTS_MAX
};

// Rays per sample of the pilot to be counted next; 0: enough is known.
uint64_t plan_next_pilot(const struct plan_ground_truth_input *input);

struct plan_ground_truth {
    uint32_t samples;
    uint64_t segments; // rays that a sample may take, the heaviest first
    bool fits;         // into rays_most; else it is the least worth comparing with
};

// As many samples as fit, at least twice the file's; if these do not fit either, with fewer rays each; and if
// that is far from fitting, the file's own samples.
struct plan_ground_truth plan_ground_truth(const struct plan_ground_truth_input *input);

// Whether the knob has another value.
bool plan_differs(const struct setting *a, const struct setting *b, enum knob knob);
// Fills knobs, choosable and name from the setting.
void plan_describe(struct row *row, const struct setting *base);

#endif
