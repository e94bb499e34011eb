#include "bench/clocks.h"

#include "core/clock.h"
#include "core/quantile.h"

#include <math.h>
#include <string.h>
#include <time.h>

struct bench_clocks bench_clocks_now(void) {
    struct timespec spent = {0};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &spent);
    return (struct bench_clocks){clock_seconds(), (double)spent.tv_sec + 1e-9 * (double)spent.tv_nsec};
}

struct bench_clocks bench_clocks_since(struct bench_clocks start) {
    const struct bench_clocks now = bench_clocks_now();
    return (struct bench_clocks){now.wall - start.wall, now.processor - start.processor};
}

double bench_median(const double *seconds, size_t count) {
    double sorted[BENCH_SAMPLES_MOST];
    if (count == 0)
        return 0;
    memcpy(sorted, seconds, count * sizeof *sorted);
    quantile_sort(sorted, count);
    return quantile(sorted, count, 0.5);
}

double bench_least(const double *seconds, size_t count) {
    double least = INFINITY;
    for (size_t i = 0; i < count; i++)
        least = fmin(least, seconds[i]);
    return least;
}

double bench_most(const double *seconds, size_t count) {
    double most = 0;
    for (size_t i = 0; i < count; i++)
        most = fmax(most, seconds[i]);
    return most;
}
