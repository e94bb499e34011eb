#include "scene/points.h"

uint32_t points_bits(uint32_t first, uint32_t samples) {
    uint32_t bits = first > 0;
    while (bits < POINT_MOST && UINT32_C(1) << bits < samples)
        bits++;
    return bits;
}

static double coordinate(uint32_t bits) {
    return (bits >> 8) * POINT_FRACTION;
}

void points_words(const struct points *points, uint32_t key, uint32_t *a, uint32_t *b) {
    const uint32_t seed = point_seed(key, points->sample, points->bits);
    const uint32_t place = point_place(points->x, points->y, points->sample, points->bits);
    const uint32_t order = point_order(place, seed);
    *a = point_first(order, seed);
    *b = point_second(order, seed);
}

void points_at(const struct points *points, uint32_t key, double *a, double *b) {
    *a = *b = 0.5;
    if (points->bits == 0)
        return;
    uint32_t first, second;
    points_words(points, key, &first, &second);
    *a = coordinate(first);
    *b = coordinate(second);
}
