#include "measure/tradeoff/choose/choose.h"

#include "core/heap.h"
#include "core/quantile.h"

#include <math.h>
#include <stdlib.h>

static int compare_values(double a, double b) {
    // NaN sorts last.
    if (isnan(a) || isnan(b))
        return isnan(a) - isnan(b);
    return a < b ? -1 : a > b;
}

// Three standard errors of the difference of two times, as a share of them, in the median row.
static double pooled_noise(const struct choice_row *rows, uint32_t count) {
    double *shares = heap_array(count ? count : 1, sizeof *shares);
    uint32_t known = 0;
    for (uint32_t i = 0; shares && i < count; i++)
        if (rows[i].choosable && rows[i].time_ms > 0)
            shares[known++] = rows[i].noise_ms / rows[i].time_ms;
    if (known)
        quantile_sort(shares, known);
    const double median = known ? quantile(shares, known, 0.5) : 0;
    free(shares);
    return fmax(3 * sqrt(2) * median, CHOICE_NOISE_FLOOR);
}

// What a choice is made from.
struct search {
    const struct choice_row *rows;
    uint32_t count;
    double noise;
    bool (*fits)(const struct search *s, const struct choice_row *row);
    double bound, limit_ms; // of the error, of the time
    const bool *taken;      // may be NULL: rows to leave out
};

static bool is_open(const struct search *s, uint32_t i) {
    return s->rows[i].choosable && !(s->taken && s->taken[i]) && (!s->fits || s->fits(s, &s->rows[i]));
}

static uint32_t fastest(const struct search *s, uint32_t without) {
    uint32_t best = CHOICE_NONE;
    for (uint32_t i = 0; i < s->count; i++)
        if (i != without && is_open(s, i) &&
            (best == CHOICE_NONE || s->rows[i].time_ms < s->rows[best].time_ms))
            best = i;
    return best;
}

static bool is_slower(const struct search *s, uint32_t row, uint32_t than) {
    return s->rows[row].time_ms > s->rows[than].time_ms * (1 + s->noise);
}

// The row with the least work among those whose times cannot be distinguished from the fastest.
static uint32_t cheapest(const struct search *s, uint32_t without) {
    const uint32_t first = fastest(s, without);
    uint32_t best = first;
    for (uint32_t i = 0; i < s->count; i++) {
        if (i == without || !is_open(s, i) || is_slower(s, i, first))
            continue;
        int order = compare_values(s->rows[i].work, s->rows[best].work);
        order = order ? order : compare_values(s->rows[i].error, s->rows[best].error);
        if (order < 0 || (order == 0 && i < best))
            best = i;
    }
    return best;
}

double choice_classify(struct choice_row *rows, uint32_t count) {
    bool *taken = heap_zeroed(count ? count : 1, sizeof *taken);
    struct search s = {.rows = rows, .count = count, .noise = pooled_noise(rows, count), .taken = taken};
    for (uint32_t i = 0; i < count; i++) {
        rows[i].time_class = rows[i].rank = CHOICE_NONE;
        rows[i].on_front = false;
    }
    // A class holds the rows that cannot be distinguished from its fastest row.
    for (uint32_t class = 0; taken; class ++) {
        const uint32_t leader = fastest(&s, CHOICE_NONE);
        if (leader == CHOICE_NONE)
            break;
        for (uint32_t i = 0; i < count; i++)
            if (is_open(&s, i) && (i == leader || !is_slower(&s, i, leader)))
                rows[i].time_class = class;
        for (uint32_t i = 0; i < count; i++)
            taken[i] = rows[i].time_class != CHOICE_NONE;
    }
    for (uint32_t i = 0; taken && i < count; i++)
        taken[i] = false;
    double least = INFINITY;
    for (uint32_t rank = 0; taken; rank++) {
        const uint32_t next = cheapest(&s, CHOICE_NONE);
        if (next == CHOICE_NONE)
            break;
        taken[next] = true;
        rows[next].rank = rank;
        rows[next].on_front = rows[next].error < least;
        least = rows[next].on_front ? rows[next].error : least;
    }
    free(taken);
    return s.noise;
}

// ---- the knee

// Errors of 0 have no logarithm: a thousandth of the smallest other one is used instead.
static double error_floor(const struct choice_row *rows, uint32_t count) {
    double least = INFINITY;
    for (uint32_t i = 0; i < count; i++)
        if (rows[i].on_front && rows[i].error > 0)
            least = fmin(least, rows[i].error);
    return isinf(least) ? 1 : least / 1000;
}

static uint32_t end_of_front(const struct choice_row *rows, uint32_t count, bool last) {
    uint32_t end = CHOICE_NONE;
    for (uint32_t i = 0; i < count; i++)
        if (rows[i].on_front && (end == CHOICE_NONE || (rows[i].rank < rows[end].rank) != last))
            end = i;
    return end;
}

uint32_t choice_knee(const struct choice_row *rows, uint32_t count) {
    const uint32_t first = end_of_front(rows, count, false), last = end_of_front(rows, count, true);
    if (first == last)
        return CHOICE_NONE;
    const double floor = error_floor(rows, count);
    const double x0 = log(fmax(rows[first].work, 1)), x1 = log(fmax(rows[last].work, 1));
    const double y0 = log(fmax(rows[first].error, floor)), y1 = log(fmax(rows[last].error, floor));
    uint32_t knee = CHOICE_NONE;
    double most = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (!rows[i].on_front || i == first || i == last || x1 == x0 || y1 == y0)
            continue;
        const double x = (log(fmax(rows[i].work, 1)) - x0) / (x1 - x0);
        const double y = (log(fmax(rows[i].error, floor)) - y0) / (y1 - y0);
        // y runs from 0 (worst) to 1 (best): above the diagonal is better than the line between the ends.
        if (y - x > most) {
            most = y - x;
            knee = i;
        }
    }
    return knee;
}

// ---- choices

static bool by_time(const struct search *s, const struct choice_row *row) {
    return row->time_ms <= s->limit_ms && !isnan(row->error);
}

static bool by_error(const struct search *s, const struct choice_row *row) {
    return row->error <= s->bound;
}

static bool by_both(const struct search *s, const struct choice_row *row) {
    return by_time(s, row) && by_error(s, row);
}

static bool not_by_time(const struct search *s, const struct choice_row *row) {
    return !by_time(s, row);
}

static bool not_by_error(const struct search *s, const struct choice_row *row) {
    return !by_error(s, row);
}

static uint32_t least_error(const struct search *s, uint32_t without) {
    uint32_t best = CHOICE_NONE;
    for (uint32_t i = 0; i < s->count; i++) {
        if (i == without || !is_open(s, i))
            continue;
        const int order = best == CHOICE_NONE ? -1 : compare_values(s->rows[i].error, s->rows[best].error);
        if (order < 0 || (order == 0 && s->rows[i].rank < s->rows[best].rank))
            best = i;
    }
    return best;
}

// What fits is ranked by one measure; what does not fit, by how near it comes in the other.
typedef uint32_t preference(const struct search *s, uint32_t without);

static struct choice choose(const struct search *fitting, const struct search *others, preference *prefer,
                            preference *come_near) {
    struct choice choice = {.nearest = CHOICE_NONE, .short_by = (double)NAN};
    choice.row = prefer(fitting, CHOICE_NONE);
    const uint32_t nearest = come_near(others, CHOICE_NONE);
    if (choice.row == CHOICE_NONE) {
        choice.nearest = nearest;
        choice.runner_up = nearest == CHOICE_NONE ? nearest : come_near(others, nearest);
        return choice;
    }
    choice.runner_up = prefer(fitting, choice.row);
    choice.runner_up_fits = choice.runner_up != CHOICE_NONE;
    if (!choice.runner_up_fits)
        choice.runner_up = nearest;
    return choice;
}

struct choice choice_cheapest(const struct choice_row *rows, uint32_t count, double noise, double bound) {
    const struct search fitting = {rows, count, noise, by_error, bound, 0, NULL};
    const struct search others = {rows, count, noise, not_by_error, bound, 0, NULL};
    struct choice choice = choose(&fitting, &others, cheapest, least_error);
    if (choice.nearest != CHOICE_NONE)
        choice.short_by = rows[choice.nearest].error - bound;
    return choice;
}

struct choice choice_both(const struct choice_row *rows, uint32_t count, double noise, double bound,
                          double limit_ms) {
    const struct search fitting = {rows, count, noise, by_both, bound, limit_ms, NULL};
    const uint32_t row = cheapest(&fitting, CHOICE_NONE);
    const uint32_t runner_up = row == CHOICE_NONE ? row : cheapest(&fitting, row);
    return (struct choice){row, runner_up, runner_up != CHOICE_NONE, CHOICE_NONE, (double)NAN};
}

struct choice choice_best_within(const struct choice_row *rows, uint32_t count, double noise,
                                 double limit_ms) {
    const struct search fitting = {rows, count, noise, by_time, 0, limit_ms, NULL};
    const struct search others = {rows, count, noise, not_by_time, 0, limit_ms, NULL};
    struct choice choice = choose(&fitting, &others, least_error, fastest);
    if (choice.nearest != CHOICE_NONE)
        choice.short_by = rows[choice.nearest].time_ms - limit_ms;
    return choice;
}
