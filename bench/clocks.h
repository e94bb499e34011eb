// Seconds on the wall and of all threads of this process: on a busy machine the second are the ones to
// compare.
#ifndef GLINT_BENCH_CLOCKS_H
#define GLINT_BENCH_CLOCKS_H

#include "core/clock.h"

#include <sys/resource.h>

struct bench_clocks {
    double wall, processor;
};

static inline struct bench_clocks bench_clocks_now(void) {
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    return (struct bench_clocks){clock_seconds(),
                                 (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                                     1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec)};
}
static inline void bench_clocks_since(struct bench_clocks start, double seconds[2]) {
    struct bench_clocks now = bench_clocks_now();
    seconds[0] = now.wall - start.wall;
    seconds[1] = now.processor - start.processor;
}

#endif
