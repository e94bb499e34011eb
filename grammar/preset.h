// Materials that are known by their name (presets.def).
#ifndef GLINT_GRAMMAR_PRESET_H
#define GLINT_GRAMMAR_PRESET_H

#include <stdbool.h>

struct ir_material;
struct ir_scene;

// Gives a material what its preset says of the rows that are not written.
void preset_fill(struct ir_material *material);
// The same for all of a scene; whether any has a preset.
bool preset_take(struct ir_scene *scene);
// Takes it back: in all materials of a scene, what is not written has its default.
void preset_leave(struct ir_scene *scene);

#endif
