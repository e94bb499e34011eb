// Examples made from the table: an element with its rows, at its place in a scene.
//
// Ownership: all is in `arena`. Thread safety: pure except for the arena.
#ifndef GLINT_GRAMMAR_EMIT_EXAMPLE_H
#define GLINT_GRAMMAR_EMIT_EXAMPLE_H

#include "core/arena.h"

struct ir_scene;
struct schema_element;
struct schema_row;

// A scene in which the element has every row with an example, and around it only what is needed to reach it.
// The scene element itself shows everything.
struct ir_scene *example_scene(const struct schema_element *element, struct arena *arena);
// Sets one row of an element to its example, its default, or its first word.
void example_row(const struct schema_row *row, uint32_t i, void *element, struct arena *arena);

#endif
