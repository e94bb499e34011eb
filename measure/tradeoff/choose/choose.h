// Which row of a table of costs and errors to choose. Pure: no clock, no device, no scene.
//
// A row has a measured time with its noise, the work that was counted (which does not vary from run to run)
// and an error. Rows whose times differ by less than the noise are one class; within a class counted work
// decides, then the error, then the order of the table. This order is called rank. The front consists of the
// rows whose error no row of lower rank equals or betters. Rows that are not to be chosen (alternatives) take
// no part. Ownership: the caller's array. Thread safety: pure.
#ifndef GLINT_MEASURE_TRADEOFF_CHOOSE_CHOOSE_H
#define GLINT_MEASURE_TRADEOFF_CHOOSE_CHOOSE_H

#include <stdbool.h>
#include <stdint.h>

#define CHOICE_NONE UINT32_MAX

// Times closer than this share are equal, however little they varied.
#define CHOICE_NOISE_FLOOR 0.03

struct choice_row {
    double time_ms;  // median
    double noise_ms; // standard error of it
    double work;     // counted
    double error;    // lower is better; NaN meets no bound
    bool choosable;
    // Filled by choice_classify; CHOICE_NONE where not choosable.
    uint32_t time_class; // from 0, fastest first
    uint32_t rank;       // from 0, cheapest first
    bool on_front;       // no cheaper row has an equal or smaller error
};

// Returns the share of a time below which two are equal: three standard errors of a difference, at least the
// floor.
double choice_classify(struct choice_row *rows, uint32_t count);

// The row of the front furthest below the line between its ends, both axes logarithmic (Satopaa et al. 2011),
// cost taken as counted work. CHOICE_NONE if the front has fewer than three rows.
uint32_t choice_knee(const struct choice_row *rows, uint32_t count);

struct choice {
    uint32_t row;       // CHOICE_NONE: nothing fits
    uint32_t runner_up; // the next that fits; if none does, the next that nearly fits; CHOICE_NONE: none
    bool runner_up_fits;
    uint32_t nearest; // if nothing fits: the nearest row; CHOICE_NONE: no row is choosable
    double short_by;  // and what it lacks: error, or milliseconds; NaN: there is none
};

// The cheapest row with error <= bound. `noise` is what choice_classify returned.
struct choice choice_cheapest(const struct choice_row *rows, uint32_t count, double noise, double bound);
// The cheapest row with error <= bound and time <= limit. The cheapest row by error alone may be slightly
// over the limit where another of its class keeps it. How near the others come is left to the other two
// functions: nearest is CHOICE_NONE, and a runner-up fits.
struct choice choice_both(const struct choice_row *rows, uint32_t count, double noise, double bound,
                          double limit_ms);
// The row with the lowest error and time <= limit; the cheapest among equals.
struct choice choice_best_within(const struct choice_row *rows, uint32_t count, double noise,
                                 double limit_ms);

#endif
