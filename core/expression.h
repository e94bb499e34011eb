// Numbers that depend on the frame: an expression such as `4*cos(tau*frame/100)`, and texts with such
// expressions in braces.
//
// Input: text, compiled once; which frame it is. Output: a finite number, or the text with numbers in place
// of braces. Errors: a fault and its place in the text. An expression is `+ - * / % ^`, parentheses, numbers,
// the names and functions that expression_names lists; angles are in radians. Its value depends on its text
// and the frame alone. Ownership: compiled expressions are in the arena. Thread safety: pure.
#ifndef GLINT_CORE_EXPRESSION_H
#define GLINT_CORE_EXPRESSION_H

#include "core/arena.h"
#include "core/strbuf.h"

struct expression_at {
    double frame;
    double time; // seconds: frame / frames per second
};

struct expression_fault {
    size_t begin, end; // in the text
    const char *what;  // a sentence without its full stop
};

struct expression_step;
struct expression {
    const struct expression_step *steps;
    uint32_t count;
    uint64_t cost;      // cost of one value, in additions
    size_t text_length; // for faults
};

bool expression_compile(str text, struct arena *arena, struct expression *expression,
                        struct expression_fault *fault);
bool expression_at(const struct expression *expression, const struct expression_at *at, double *value,
                   struct expression_fault *fault);
// Both at once, for a text that is needed in one frame.
bool expression_value(str text, const struct expression_at *at, double *value,
                      struct expression_fault *fault);
// Appends `text` to `out`, with `{...}` replaced by the value of the expression. Braces around a colon, and
// empty ones, are a map of the scene language and stay as they are. *filled: whether there was an expression.
bool expression_fill(str text, const struct expression_at *at, struct strbuf *out, bool *filled,
                     struct expression_fault *fault);
// All names that an expression may use: "frame, time, pi, ... sin(x), ...".
void expression_names(struct strbuf *out);
// The functions and operators in a text with expressions whose last bit depends on the C library, so that a
// frame's numbers may differ between systems: as a set (0: none), and as names, "sin, ^, #rrggbb".
#define EXPRESSION_INEXACT_HEX (1u << 31) // a #rrggbb colour decoded next to an expression
unsigned expression_inexact(str text);
void expression_inexact_names(unsigned used, struct strbuf *out);

#endif
