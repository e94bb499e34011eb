// A scene that was evaluated, as one that is written without anything computed.
//
// Ownership: new lists are in the arena. Thread safety: one thread.
#ifndef GLINT_GRAMMAR_IR_EXPAND_H
#define GLINT_GRAMMAR_IR_EXPAND_H

#include <stdbool.h>

struct arena;
struct ir_scene;

// Whether frames differ: false where one was taken.
bool ir_moves(const struct ir_scene *scene);
// Puts what copies of instances show into objects in place, so that bodies keep their numbers, names and
// places.
void ir_expand_instances(struct ir_scene *scene, struct arena *arena);
// And forgets parameters and expressions: what they came to stays. Of a scene that moves, expressions that
// depend on the frame stay, and parameters, as values.
void ir_expand(struct ir_scene *scene, struct arena *arena);

#endif
