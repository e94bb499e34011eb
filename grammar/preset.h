// Materials that are known by their name (presets.def).
#ifndef GLINT_GRAMMAR_PRESET_H
#define GLINT_GRAMMAR_PRESET_H

struct ir_material;

// Gives a material what its preset says of the rows that are not written.
void preset_take(struct ir_material *material);

#endif
