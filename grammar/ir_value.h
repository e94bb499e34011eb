// What every element of the IR is made of: its head, and the values that are structs. Code that walks the
// table and knows no element's name includes this instead of ir.h, and so is not rebuilt for a new attribute.
#ifndef GLINT_GRAMMAR_IR_VALUE_H
#define GLINT_GRAMMAR_IR_VALUE_H

#include "core/str.h"

#include <stdbool.h>
#include <stdint.h>

#define IR_NO_INDEX UINT32_MAX

struct ir_head {
    uint64_t written;  // bit i: row i of the element's schema is in the file
    uint64_t poisoned; // bit i: row i was written and wrong
    uint32_t origin;   // id in struct ir_origin; 0: no place (made by the program)
    uint32_t formulas; // the first of its values that are computed (grammar/ir_formula.h); 0: none
};

struct ir_color {
    double r, g, b; // as written, linear; zero if is_hex
    bool is_hex;    // written as #rrggbb, a displayed colour: decoded by flattening (ir_color_linear)
    uint32_t hex;   // 0xrrggbb
};

struct ir_weights {
    double diffuse, specular, reflection, refraction;
};

// Along the two coordinates of a surface.
struct ir_pair {
    double u, v;
};

// In a plane.
struct ir_point {
    double x, y;
};

// A row of a matrix: what x, y, z and 1 are multiplied by.
struct ir_quad {
    double x, y, z, t;
};

// To a material, a mesh or an object.
struct ir_reference {
    str name; // as written; empty for an element in place
    uint32_t
        index; // in the scene's list of its kind; IR_NO_INDEX: none written, or not found, or a file's path
};

// How a picture is displayed: words of the image element, known to pictures without a scene too.
enum ir_tone {
    IR_TONE_CLIP,
    IR_TONE_NORMALIZE,
    IR_TONE_NEUTRAL,
    IR_TONE_FILMIC
};
enum ir_transfer {
    IR_TRANSFER_NONE,
    IR_TRANSFER_SRGB
};

#endif
