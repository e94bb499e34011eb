// The internals of extremes: variants of a scene, and the values of the axes. Private to measure/extremes.
//
// Ownership: a variant's copies lie in the arena given; meshes and images stay the base's. Where the arena
// ends, its guard is jumped to. Thread safety: one thread.
#ifndef GLINT_MEASURE_EXTREMES_EXTREMES_INTERNAL_H
#define GLINT_MEASURE_EXTREMES_EXTREMES_INTERNAL_H

#include "grammar/ir.h"
#include "measure/extremes/extremes.h"
#include "scene/hits.h"

enum {
    SOFT_SAMPLES = 4 // of anything with extent: one sample takes the middle of everything
};

// A scene that can be changed without changing its base: its bodies and materials are copies, as are the
// cameras and lights of its IR. `scene` points into the variant, which must not move.
struct variant {
    struct arena *arena;
    struct ir_scene ir;
    struct scene scene;
    struct view view;
    uint32_t camera;
    uint32_t width, height;
    uint32_t samples;
    double error; // above 0: pixels end by it, once they have min_samples
    uint32_t min_samples;
};

// What a variant is made from.
struct extreme_base {
    const struct extremes_input *input;
    struct view view;
    vec3 center; // of the bodies' box
    double radius;
    bool has_surface;                 // the camera sees such a surface
    vec3 surface, normal, seen_along; // a point on it, towards the viewer, the ray's direction
};

// The values of an axis; `values` has room for EXTREME_VALUES_MAX.
enum {
    EXTREME_VALUES_MAX = 16,
    EXTREME_NESTED_MOST = 8,
};
uint32_t extreme_values(enum extreme_axis axis, double *values);

// Fills `v` with a copy, changed as the cell says, and its view. Returns NULL, or why there is no such
// variant.
const char *variant_make(struct variant *v, struct arena *arena, const struct extreme_base *base,
                         enum extreme_axis axis, double value);
// Whether the value is so near the end of its axis that the picture is that of the limit; *limit is then the
// limit's value: for example a radius of 0, which is a point.
bool extreme_limit(enum extreme_axis axis, double value, double *limit);
// Only the copy, with its view.
void variant_copy(struct variant *v, struct arena *arena, const struct extremes_input *input);

// Whether any surface sends rays on.
bool variant_bounces(const struct variant *v);
// Makes only the background shine, with 1: a pixel is then the weight with which its path sees the
// background.
void variant_show_background(struct variant *v);

// ---- extremes_probe.c: shapes of their own. All take their place from the base.

void probe_slivers(struct variant *v, const struct extreme_base *base, double aspect);
void probe_coplanar(struct variant *v, const struct extreme_base *base, double shift);
void probe_gap(struct variant *v, const struct extreme_base *base, double gap);
// Balls of the first material that refracts, one in another. false: none does.
bool probe_nested(struct variant *v, const struct extreme_base *base, uint32_t balls);

// ---- extremes_light.c: lights with extent, lenses, paint, media, and pixels that end by their error

// As variant_make, for one of these axes; the copy is already made.
const char *variant_change_light(struct variant *v, const struct extreme_base *base, enum extreme_axis axis,
                                 double value);

#endif
