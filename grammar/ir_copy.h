// A copy of a scene and of its places in its files, to be changed while the original stays.
//
// Lists are the copy's own, at every level; texts are shared. Ownership: the arena, which must be guarded;
// texts belong to the original, which must outlive the copy. Thread safety: pure functions.
#ifndef GLINT_GRAMMAR_IR_COPY_H
#define GLINT_GRAMMAR_IR_COPY_H

#include "core/arena.h"

struct ir_origin;
struct ir_scene;

struct ir_scene *ir_copy(const struct ir_scene *scene, struct arena *arena);
// The scenes of single files are shared.
void ir_origin_copy(const struct ir_origin *from, struct arena *arena, struct ir_origin *out);

#endif
