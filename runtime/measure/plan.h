// Which settings are tried: the ladders of each knob, and pairs of those that mattered. Private to
// runtime/measure.
//
// What is planned depends on the scene and on counted work and measured errors alone, never on a clock.
// Thread safety: pure.
#ifndef GLINT_RUNTIME_MEASURE_PLAN_H
#define GLINT_RUNTIME_MEASURE_PLAN_H

#include "runtime/measure/tradeoff.h"

enum {
    PLAN_ROWS_MAX = 96,
};

struct plan_input {
    struct setting base;
    bool bounces;      // something reflects or refracts
    uint32_t deepest;  // level that the file's settings reach
    bool knows_double; // the device can
    bool has_triangles;
    bool quick;            // only what can be chosen
    uint32_t most_samples; // of a ladder
};

// The file's own settings first, then each knob's ladder from coarse to fine, without the file's own value.
// Gives the number of rows, at most PLAN_ROWS_MAX.
uint32_t plan_single(const struct plan_input *input, struct row *rows);

// Pairs of settings, one from each of two knobs that mattered: by at least 2 % of the work or 5 % of the
// error. Those are taken that no row of their own knob betters in both. First those that the fewest others
// are foretold to better; `most` at most. Gives the number of rows.
uint32_t plan_pairs(const struct row *rows, uint32_t count, enum metric metric, uint32_t most,
                    struct row *pairs, uint32_t *left_out);

// Makes times rise where rays are only added: a row that sends a part of another's rays, by the same kernel
// or one with fewer features, is never the slower one, whatever was measured. What contradicts that is noise,
// and is set to the middle of it; all else stays. false: no memory.
bool plan_order_times(struct row *rows, uint32_t count);

// Whether the knob stands otherwise.
bool plan_differs(const struct setting *a, const struct setting *b, enum knob knob);
// Fills knobs, choosable and name from the setting.
void plan_describe(struct row *row, const struct setting *base);

#endif
