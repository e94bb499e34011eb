// The features that a scene needs from the tracer: the OR over the feature columns of the rows that it uses.
//
// A row's bit is on while its value is not zero, false, the first word or empty; a row of a choice while
// it is the one taken; a component of weights while it is not 0. Materials count if a body or a
// material_map uses them; a body without one has the default material. Scenes without a light have one at
// the camera. Features of materials that meshes bring along, and those the renderer itself needs (slices,
// counters), are added by the code that knows them.
// Thread safety: pure functions.
#ifndef GLINT_GRAMMAR_IR_FEATURES_H
#define GLINT_GRAMMAR_IR_FEATURES_H

#include "diag/source.h"
#include "grammar/ir_origin.h"
#include "shaders/features.h"

struct ir_material;
struct ir_scene;

enum {
    IR_FEATURE_WORDS_MAX = 200
};

// Why a feature is on: the first place that switches it on.
struct ir_feature_reason {
    uint64_t bit;                     // FEATURE_
    span at;                          // SPAN_NONE: nothing written says so, it is the default
    char words[IR_FEATURE_WORDS_MAX]; // "material 'glass': albedo refraction is 0.8"
};

struct ir_feature_reasons {
    uint64_t mask;
    uint32_t count;
    struct ir_feature_reason items[FEATURE_COUNT]; // in the order of the bits
};

// `scene` is merged and resolved.
uint64_t ir_features(const struct ir_scene *scene);
// The same with reasons; `origin` may be NULL.
void ir_features_explain(const struct ir_scene *scene, const struct ir_origin *origin,
                         struct ir_feature_reasons *out);

// The bits of a single material (NULL: the default material), for materials that meshes bring along.
uint64_t ir_material_features(const struct ir_material *material);

// "refraction"; "unknown" for anything but a single FEATURE_ bit.
const char *feature_name(uint64_t bit);

#endif
