// The rows' times on the device's clock, in rounds, until the noise is low.
#include "core/heap.h"
#include "measure/tradeoff/measure/measure.h"

#include "core/quantile.h"
#include "measure/tradeoff/plan/plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    ROUNDS_FEW = 3,   // with fewer rounds the choice may differ
    ROUNDS_QUIET = 4, // at least, where there is no noise
};

// If a whole round was slower or faster than the others, the machine was, not the rows.
static void remove_drift(double *times, uint32_t rows, uint32_t rounds) {
    double mean = 0;
    for (uint32_t r = 0; r < rounds; r++)
        for (uint32_t i = 0; i < rows; i++)
            mean += log(fmax(times[r * rows + i], 1e-9)) / ((double)rows * rounds);
    for (uint32_t r = 0; r < rounds; r++) {
        double own = 0;
        for (uint32_t i = 0; i < rows; i++)
            own += log(fmax(times[r * rows + i], 1e-9)) / rows;
        for (uint32_t i = 0; i < rows; i++)
            times[r * rows + i] *= exp(mean - own);
    }
}

static void fill_times(struct tradeoff *t, double *times) {
    double own[TIMES_ROUNDS_MOST];
    remove_drift(times, t->count, t->rounds);
    for (uint32_t i = 0; i < t->count; i++) {
        struct row *row = &t->rows[i];
        for (uint32_t r = 0; r < t->rounds; r++)
            own[r] = times[r * t->count + i];
        quantile_sort(own, t->rounds);
        row->time_ms = quantile(own, t->rounds, 0.5);
        row->time_low_ms = quantile(own, t->rounds, 0.25);
        row->time_high_ms = quantile(own, t->rounds, 0.75);
        // 1.4826 MAD is the deviation of a normal distribution, 1.2533 / sqrt(n) its median's share of it.
        for (uint32_t r = 0; r < t->rounds; r++)
            own[r] = fabs(own[r] - row->time_ms);
        quantile_sort(own, t->rounds);
        row->noise_ms = 1.2533 * 1.4826 * quantile(own, t->rounds, 0.5) / sqrt(t->rounds);
    }
}

// Whether the noise has come down to the floor of the choice: further rounds would change nothing.
static bool is_quiet(struct tradeoff *t, const double *times) {
    const size_t count = heap_times(t->rounds, t->count);
    double *copy = heap_array(count, sizeof *copy), *shares = heap_array(t->count, sizeof *shares);
    bool quiet = false;
    if (copy && shares) {
        memcpy(copy, times, count * sizeof *copy);
        fill_times(t, copy);
        for (uint32_t i = 0; i < t->count; i++)
            shares[i] = t->rows[i].noise_ms / fmax(t->rows[i].time_ms, 1e-9);
        quantile_sort(shares, t->count);
        quiet = 3 * sqrt(2) * quantile(shares, t->count, 0.5) <= CHOICE_NOISE_FLOOR;
    }
    free(copy);
    free(shares);
    return quiet;
}

// Times every row once; each round begins with a different row. A round that the end of the budget interrupts
// does not count.
static enum tradeoff_status time_round(struct measuring *s, double *times) {
    struct tradeoff *t = s->out;
    enum tradeoff_status status = measuring_step(s, "times") ? TRADEOFF_DONE : TRADEOFF_CANCELLED;
    for (uint32_t i = 0; i < t->count && status == TRADEOFF_DONE; i++) {
        const uint32_t row = (i + t->rounds * 7) % t->count;
        status = device_time(s, &t->rows[row].setting, &times[t->rounds * t->count + row]);
    }
    t->rounds += status == TRADEOFF_DONE;
    return status;
}

static bool has_time(const struct measuring *s, double begun, const double *times) {
    struct tradeoff *t = s->out;
    const double now = measuring_seconds(s), budget = t->options.budget_s;
    if (t->rounds == TIMES_ROUNDS_MOST || (t->rounds >= ROUNDS_QUIET && is_quiet(t, times)))
        return false;
    return !(budget > 0) || t->rounds == 0 || now + (now - begun) / t->rounds <= budget;
}

enum tradeoff_status times_measure(struct measuring *s) {
    struct tradeoff *t = s->out;
    double *times = heap_array(heap_times(TIMES_ROUNDS_MOST, t->count), sizeof *times);
    const double budget = t->options.budget_s;
    if (!times)
        return TRADEOFF_MEMORY;
    s->deadline = budget > 0 ? s->begun + budget : 0;
    enum tradeoff_status status = device_wake(s);
    const double begun = measuring_seconds(s);
    while (status == TRADEOFF_DONE && has_time(s, begun, times))
        status = time_round(s, times);
    if (status == TRADEOFF_CANCELLED && s->late)
        status = TRADEOFF_DONE;
    s->deadline = 0;
    t->cut_short |= t->rounds < ROUNDS_FEW && t->count > 1;
    // Without any round the times are those of the pictures' own frames.
    if (status == TRADEOFF_DONE && t->rounds)
        fill_times(t, times);
    if (status == TRADEOFF_DONE)
        status = plan_order_times(t->rows, t->count) ? status : TRADEOFF_MEMORY;
    free(times);
    return status;
}
