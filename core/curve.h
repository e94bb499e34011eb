// Keys and the values between them: the value of a track at a frame.
//
// Input: keys in the order of their frames, no two at the same frame. Output: finite numbers if the keys'
// are; at a key, exactly its value. Errors: none. Ownership: the caller's. Thread safety: pure.
#ifndef GLINT_CORE_CURVE_H
#define GLINT_CORE_CURVE_H

#include <stdint.h>

enum curve_way {
    CURVE_LINEAR,
    CURVE_SMOOTH, // a cubic between two keys, whose slope at each is that between its neighbours
                  // (Catmull-Rom)
    CURVE_EASE,   // linear, with no speed at each key
    CURVE_STEP,   // the key before
};

enum curve_loop {
    CURVE_ONCE,   // the first key's value before it, the last key's after it
    CURVE_REPEAT, // after the last key again from the first; smooth: the same speed on both sides
    CURVE_MIRROR, // from the last key on back to the first
};

enum {
    CURVE_WIDTH_MOST = 4
};

struct curve {
    const double *frames; // count
    const double *values; // count * width
    uint32_t count;       // at least 1
    uint32_t width;       // numbers of a value, 1 to 4
    enum curve_way way;
    enum curve_loop loop;
};

void curve_at(const struct curve *curve, double frame, double out[CURVE_WIDTH_MOST]);
// The last key at or before the frame, once loops are folded away; the first key for frames before all.
uint32_t curve_key(const struct curve *curve, double frame);

#endif
