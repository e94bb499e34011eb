// Whether single precision suffices for a scene, from its numbers alone (docs/decisions/precision.md).
//
// A coordinate at distance D from the flat scene's origin is rounded to steps of D * 2^-24, and details about
// as small as a step are lost: so each feature is measured in steps at its place, and needs PRECISION_STEPS
// of them. Measured: the shortest edge of every triangle; the size of every model and sphere; the gaps
// between bodies, by their boxes, exact among spheres and parallelograms; the camera's height above large
// triangles. Not measured: gaps inside a model other than along an edge (its size represents them: gaps down
// to 1e-4 of it), and gaps between bodies whose boxes overlap, one of which is a model. All in double
// precision, in scene units. Input: as flatten. Errors: false when memory ends. Thread safety: pure.
#ifndef GLINT_TRACER_FLATTEN_PRECISION_H
#define GLINT_TRACER_FLATTEN_PRECISION_H

#include "tracer/flatten/flatten.h"

#define PRECISION_STEPS 16.0
// How finely single precision must resolve other features, as the fraction of them that needs
// PRECISION_STEPS.
#define PRECISION_MODEL_PART  1e-4 // of a model's size: its finest gaps
#define PRECISION_SPHERE_PART 0.01 // of a sphere's radius: keeps 99.9 % of the pixels within 1/255
#define PRECISION_HEIGHT_PART                                                                                \
    (1.0 / 32) // of the camera's height above a triangle, relative to the triangle's reach

enum precision_feature {
    PRECISION_EDGE,   // shortest edge of a triangle
    PRECISION_SIZE,   // diagonal of a model's box, or radius of a sphere
    PRECISION_GAP,    // between two bodies
    PRECISION_HEIGHT, // of the camera above a large triangle
    PRECISION_FEATURES,
};

struct precision_measure {
    bool any;
    double length;        // of the feature, scene units
    double part;          // fraction of it that must be resolved
    double distance;      // at which it lies: largest coordinate difference to the origin
    double steps;         // length * part / (distance * 2^-24)
    uint32_t body, other; // in IR order; `other` only for a gap
    uint32_t triangle;    // of the body, in file order; only for edges and heights
};

struct precision_report {
    struct precision_measure least[PRECISION_FEATURES]; // for each kind the one with the fewest steps
    enum precision_feature decides;                     // the kind with the fewest steps
    bool suffices;                                      // single precision is enough
    bool all_pairs; // false: too many bodies are close together to look at all pairs
};

bool precision_measure(const struct flat_input *input, struct precision_report *out);

#endif
