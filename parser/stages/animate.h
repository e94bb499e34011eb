// The tracks of a scene's animation: the target of each, and its value in a frame. Private to parser/stages.
//
// Ownership: everything is in the scene's arena, frames in the loader's scratch. Thread safety: one thread.
#ifndef GLINT_PARSER_STAGES_ANIMATE_H
#define GLINT_PARSER_STAGES_ANIMATE_H

#include "core/curve.h"
#include "core/expression.h"
#include "grammar/ir.h"
#include "parser/stages/evaluate.h"
#include "parser/stages/override.h"

// A compiled text of one or more numbers.
struct moving_text {
    str parts[CURVE_WIDTH_MOST];
    struct expression values[CURVE_WIDTH_MOST];
    double constant[CURVE_WIDTH_MOST];
    uint32_t count; // how many values; 0: it is `constant`, a colour in hexadecimal digits
};

// One track, found good so far.
struct moving {
    const struct ir_track *track;
    struct override *path;
    struct bind_frame *frame;     // the element whose row moves
    const struct schema_row *row; // a number, vector, pair, colour or weights
    uint32_t row_number;
    int slot, component;         // as a formula there has them (grammar/ir_formula.h)
    struct bind_subject subject; // for messages
    double *field;               // in the scene: `width` numbers side by side
    struct ir_color *color;      // the colour that the field is all of; NULL: none
    uint32_t width;
    bool fills;         // one number stands for all
    uint32_t parameter; // 1 + its index in the scene's list; 0: a value of the scene
    struct curve curve; // of keys; count 0: the track's value is an expression
    struct moving_text text;
    bool is_repeat; // of another copy of the same entry
    uint64_t cost;  // cost of its value in a frame, in additions
};

struct motion {
    struct loader *loader;
    struct ir_scene *scene;
    const struct ir_animation *animation;
    struct evaluation *evaluation; // NULL: nothing else is computed
    struct moving *items;
    uint32_t count, capacity;
    struct override_index index; // index of the names in the tracks
    // While all frames are checked.
    const struct bind_frame **elements; // elements in which tracks move something, each once
    uint32_t element_count;
    int32_t step; // from one frame that is checked to the next
};

// animate_target.c
// Takes what a path leads to as what a track moves. false: it cannot move (reported).
bool moving_take_target(const struct motion *motion, struct moving *m, const struct override_target *target);

// animate_copies.c
// Adds a track, for each copy that it moves. false: it cannot move (reported).
bool moving_push_all(struct motion *motion, struct moving *m);

// animate_tracks.c: finds the targets of the tracks, and reads their keys. Tracks with mistakes are reported
// and left out.
void motion_find(struct motion *motion);
// The value in a frame, by keys or expression. false: the expression has none (reported).
bool moving_value(const struct motion *motion, const struct moving *m, int32_t frame,
                  double out[CURVE_WIDTH_MOST]);
// The key, or the expression, that a value in a frame comes from.
span moving_place(const struct motion *motion, const struct moving *m, int32_t frame);
// Whether the row takes the values; else it is reported, with the frame.
bool moving_fits(const struct motion *motion, const struct moving *m, int32_t frame,
                 const double value[CURVE_WIDTH_MOST]);

#endif
