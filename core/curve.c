#include "core/curve.h"

#include <math.h>
#include <stdbool.h>

// The frame between the first and the last key that the loop maps to.
static double inside(const struct curve *c, double frame) {
    const double first = c->frames[0], span = c->frames[c->count - 1] - first;
    if (c->loop == CURVE_ONCE || !(span > 0))
        return frame;
    const double turns = floor((frame - first) / span), rest = frame - first - turns * span;
    const double way = fmin(fmax(rest, 0), span);
    return first + (c->loop == CURVE_MIRROR && fmod(turns, 2) != 0 ? span - way : way);
}

static uint32_t find(const struct curve *c, double frame) {
    uint32_t low = 0, high = c->count; // the key is in [low, high)
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (c->frames[middle] <= frame)
            low = middle;
        else
            high = middle;
    }
    return low;
}

uint32_t curve_key(const struct curve *c, double frame) {
    return find(c, inside(c, frame));
}

static double value(const struct curve *c, uint32_t key, uint32_t i) {
    return c->values[(uint64_t)key * c->width + i];
}

static double slope_between(const struct curve *c, uint32_t a, uint32_t b, uint32_t i) {
    return (value(c, b, i) - value(c, a, i)) / (c->frames[b] - c->frames[a]);
}

// A mirrored loop has no speed at its ends. A repeated one passes its seam at one speed: the slope from the
// key before the last to the key after the first, where the first and the last key count as the same moment,
// even if their values differ, as those of a whole turn do.
static double slope(const struct curve *c, uint32_t key, uint32_t i) {
    const uint32_t last = c->count - 1;
    if (key > 0 && key < last)
        return slope_between(c, key - 1, key + 1, i);
    if (c->loop == CURVE_MIRROR)
        return 0;
    if (c->loop == CURVE_REPEAT) {
        const double before = c->frames[last] - c->frames[last - 1], after = c->frames[1] - c->frames[0];
        const double jump = value(c, last, i) - value(c, 0, i);
        return (value(c, 1, i) - value(c, last - 1, i) + jump) / (before + after);
    }
    return key == 0 ? slope_between(c, 0, 1, i) : slope_between(c, last - 1, last, i);
}

static double smooth(const struct curve *c, uint32_t key, double u, uint32_t i) {
    const double width = c->frames[key + 1] - c->frames[key];
    const double a = value(c, key, i), b = value(c, key + 1, i);
    const double at_a = slope(c, key, i) * width, at_b = slope(c, key + 1, i) * width;
    const double v = 1 - u;
    return a * (1 + 2 * u) * v * v + b * u * u * (1 + 2 * v) + at_a * u * v * v - at_b * u * u * v;
}

void curve_at(const struct curve *c, double frame, double out[CURVE_WIDTH_MOST]) {
    const double at = inside(c, frame);
    const uint32_t key = find(c, at);
    const bool ends = at <= c->frames[key] || key + 1 == c->count || c->way == CURVE_STEP;
    const double u = ends ? 0 : (at - c->frames[key]) / (c->frames[key + 1] - c->frames[key]);
    const double share = c->way == CURVE_EASE ? u * u * (3 - 2 * u) : u;
    for (uint32_t i = 0; i < c->width; i++) {
        const double a = value(c, key, i), b = ends ? a : value(c, key + 1, i);
        out[i] = !ends && c->way == CURVE_SMOOTH ? smooth(c, key, u, i)
                 : a == b                        ? a // without rounding
                                                 : a * (1 - share) + b * share;
    }
}
