// Seconds on the wall and of all threads of this process, and what is said of those of several rounds: on a
// busy machine the seconds of processor time are the ones to compare, and the least of them.
//
// Ownership: the caller's arrays. Errors: none. Thread safety: pure, but for the clocks.
#ifndef GLINT_BENCH_CLOCKS_H
#define GLINT_BENCH_CLOCKS_H

#include <stddef.h>

enum {
    BENCH_SAMPLES_MOST = 1024
};

struct bench_clocks {
    double wall, processor;
};

struct bench_clocks bench_clocks_now(void);
struct bench_clocks bench_clocks_since(struct bench_clocks start);

// 0 of none; at most BENCH_SAMPLES_MOST of them.
double bench_median(const double *seconds, size_t count);
// Infinity of none.
double bench_least(const double *seconds, size_t count);
// 0 of none.
double bench_most(const double *seconds, size_t count);

#endif
