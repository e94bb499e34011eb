// Expressions: `columns*pitch - 1`, `4*cos(360*frame/100)`, `i % 2 == 0`, `p if i < 3 else q`.
//
// A text is compiled once, for the names that are in reach, and has a value as often as it is asked for. The
// grammar, from what binds least: `a if c else b`; or; and; not; < <= > >= == != (not in chains); + -; * / %;
// a minus sign; ^ (to the right; a whole exponent); .x .y .z of a triple; numbers, true, false, pi, frame,
// time, names, calls of the functions that expression_words lists, parentheses. Angles are in degrees. A
// value is a number, a truth, or a triple (a vector or a colour); which of them is known without running, and
// nothing converts. Every number on the way is finite, or it is a fault. A value depends on the text, the
// names' values and the frame alone, and has the same bits on every platform.
// Ownership: compiled expressions are in the arena. Thread safety: pure.
#ifndef GLINT_CORE_EXPRESSION_H
#define GLINT_CORE_EXPRESSION_H

#include "core/arena.h"
#include "core/strbuf.h"

enum expression_type {
    EXPRESSION_NUMBER,
    EXPRESSION_TRUTH, // 0 or 1
    EXPRESSION_TRIPLE,
};
const char *expression_type_name(enum expression_type type); // "a number"

// Four numbers hold any value. Of a triple the last is its #rrggbb as a number, if it is a colour that was
// written so and is still as written, else -1; the first three are then that colour, decoded.
enum {
    EXPRESSION_WIDTH = 4
};

// A name of the scene.
struct expression_name {
    enum expression_type type;
    uint32_t slot; // of its value: expression_at.values + EXPRESSION_WIDTH * slot
    bool moves;    // depends on the frame
};
struct expression_scope {
    // false: there is no such name.
    bool (*find)(const void *context, str name, struct expression_name *found);
    const void *context;
};

struct expression_at {
    double frame;
    double time;          // seconds: frame / frames per second
    bool decodes;         // #rrggbb is sRGB, calculated with as linear light
    const double *values; // of names; NULL: there are none
};

enum expression_problem {
    EXPRESSION_WRONG,            // as `what` says
    EXPRESSION_UNKNOWN_NUMBER,   // there is no such name: begin..end
    EXPRESSION_UNKNOWN_FUNCTION, // the same, before a parenthesis
};
struct expression_fault {
    enum expression_problem problem;
    size_t begin, end; // in the text
    char what[160];    // a sentence without its full stop; empty for unknown names
    const char *help;  // what to write; NULL: not known
    const char *fix;   // to be written in the place of begin..end; NULL: not known
};

struct expression_step;
struct expression {
    const struct expression_step *steps;
    uint32_t count;
    enum expression_type type;
    bool moves;    // frame, time or a name that moves is in it
    uint64_t cost; // at most, of one value, in additions
};

// scope: NULL: there are no names.
bool expression_compile(str text, const struct expression_scope *scope, struct arena *arena,
                        struct expression *expression, struct expression_fault *fault);
// 1 number, 1 truth, or all of a triple, in `value`.
bool expression_at(const struct expression *expression, const struct expression_at *at,
                   double value[EXPRESSION_WIDTH], struct expression_fault *fault);
// Appends a value as the scene language writes it: 2.5, true, [0, 1, 0], #c08050.
void expression_print(enum expression_type type, const double value[EXPRESSION_WIDTH], struct strbuf *out);
// Both at once, for a number that is needed in one frame, without names.
bool expression_value(str text, const struct expression_at *at, double *value,
                      struct expression_fault *fault);
// Appends `text` to `out`, with `{...}` replaced by the value of the expression. Braces around a colon, and
// empty ones, are a map of the scene language and stay as they are. *filled: whether there was an expression.
bool expression_fill(str text, const struct expression_at *at, struct strbuf *out, bool *filled,
                     struct expression_fault *fault);

// The language's own words, for messages and completion: functions ("sin"; form: "sin(x)"), constants, frame
// and time, operators that are words. NULL after the last. A scene cannot use them as names.
struct expression_word {
    const char *name, *form, *doc;
    bool is_function;
};
const struct expression_word *expression_words(void);
bool expression_is_word(str name);
// Words of YAML and of number formats, in small letters: no names, and no expressions. NULL after the last.
const char *const *expression_no_words(void);
// Whether the text can be nothing but an expression: it has a name, a call, or an operator between operands.
// A single number with something wrong in it (1_000, 3m, 50%, 1,5) is none.
bool expression_is_meant(str text);
// Bytes of the name, letters, digits and '_', that the text begins with; 0: it begins with none.
size_t expression_name_length(str text);
// The next name in a text from *at on that can be a scene's: no function, no component, no part of #rrggbb.
// false: there is none. *at is then, and after each name, where to go on.
bool expression_next_name(str text, size_t *at, str *name);
// Whether a scene may give the name to something.
bool expression_is_free(str name);
// Whether the text is a name alone.
static inline bool expression_is_name(str text) {
    return text.len > 0 && expression_name_length(text) == text.len;
}

#endif
