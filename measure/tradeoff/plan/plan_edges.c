// How well two means of a pixel's samples tell their distance from the truth, at edges.
//
// All pixels have the same samples, so one set of them errs in the same way at every edge, and two sets may
// happen to err alike: with 11 samples, the first six and all of them differ by half of their errors. For
// straight edges all of this is known without a picture.
#include "core/angle.h"
#include "measure/tradeoff/plan/plan_search.h"
#include "scene/view.h"

#include <math.h>

enum {
    EDGES = 256,
    SIDE = 32, // points along a side of a pixel, of which a share is the truth
};
// In sides of a pixel: how far edges may be from its middle. Beyond this they do not touch the pixel.
#define EDGE_MOST 0.7

// A side of a straight edge: where x * a + y * b > from, from the middle of the pixel.
struct edge {
    double a, b, from;
};

static struct edge edge_of(uint32_t i) {
    double turn, from;
    view_sample_offset(i, &turn, &from);
    return (struct edge){cos(2 * PI * turn), sin(2 * PI * turn), EDGE_MOST * (2 * from - 1)};
}

static bool is_within(const struct edge *edge, double x, double y) {
    return (x - 0.5) * edge->a + (y - 0.5) * edge->b > edge->from;
}

static double covered(const struct edge *edge) {
    uint32_t within = 0;
    for (uint32_t i = 0; i < SIDE * SIDE; i++)
        within += is_within(edge, (i % SIDE + 0.5) / SIDE, (double)(i / SIDE + 0.5) / SIDE);
    return within / (double)(SIDE * SIDE);
}

static double sampled(const struct edge *edge, uint32_t first, uint32_t count) {
    uint32_t within = 0;
    double x, y;
    for (uint32_t i = first; i < first + count; i++) {
        view_sample_offset(i, &x, &y);
        within += is_within(edge, x, y);
    }
    return within / (double)count;
}

double plan_search_reach(uint32_t samples, uint32_t older, uint32_t newer) {
    const double o = older, n = newer;
    const double by_chance = samples < older + newer ? sqrt(n / (o + n)) : sqrt(n / o);
    double error = 0, difference = 0;
    for (uint32_t i = 0; i < EDGES; i++) {
        const struct edge edge = edge_of(i);
        const double mean = sampled(&edge, 0, samples);
        error += fabs(mean - covered(&edge));
        difference += fabs(mean - sampled(&edge, older, newer));
    }
    return fmax(error / difference, by_chance);
}
