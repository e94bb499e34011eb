// What the two halves of expressions share: steps, and functions.
#ifndef GLINT_CORE_EXPRESSION_INTERNAL_H
#define GLINT_CORE_EXPRESSION_INTERNAL_H

#include "core/expression.h"

enum {
    EXPRESSION_ARGUMENTS_MOST = 64,
    EXPRESSION_DEPTH_MOST = 64,
    EXPRESSION_STACK_MOST = 256, // numbers that wait for an operator
};

// A step takes its values from the end of a list of numbers and appends its result: a triple is four of them.
enum step_kind {
    STEP_NUMBER,
    STEP_NAME,   // a number or truth: the first number of a slot
    STEP_TRIPLE, // a name: all of a slot
    STEP_FRAME,
    STEP_TIME,
    STEP_NEGATE,
    STEP_ADD,
    STEP_SUBTRACT,
    STEP_MULTIPLY,
    STEP_DIVIDE,
    STEP_REMAINDER,
    STEP_POWER,
    STEP_LESS,
    STEP_LESS_EQUAL,
    STEP_GREATER,
    STEP_GREATER_EQUAL,
    STEP_EQUAL,
    STEP_UNEQUAL,
    STEP_NOT,
    STEP_NEGATE_TRIPLE,
    STEP_ADD_TRIPLES,
    STEP_SUBTRACT_TRIPLES,
    STEP_SCALE,        // triple, number
    STEP_SCALE_TRIPLE, // number, triple
    STEP_SHRINK,       // triple / number
    STEP_COMPONENT,    // `at`: 0 to 2
    STEP_AND,          // jumps by `at` steps and keeps the truth if it is false; else takes it away
    STEP_OR,           // the same if it is true
    STEP_BRANCH,       // takes a truth away, and jumps if it is false
    STEP_JUMP,
    STEP_CALL,       // of `function`, with `count` numbers
    STEP_MIX_COLORS, // mix of two triples
    STEP_HSV,
    STEP_RANDOM, // `count` numbers
};

struct expression_step {
    uint8_t kind; // step_kind
    uint8_t function;
    uint16_t count;
    uint32_t begin, end; // in the text: what the step computes
    union {
        double number;
        uint32_t at; // a slot, a component, a way in steps
    };
};

// A function of numbers with a number as its value. Keys come in pairs after the first argument.
struct expression_function {
    const char *name;
    int count;                                  // of arguments; 0: keys; -1: one to four
    unsigned cost;                              // in additions
    double (*call)(const double *a, int count); // NULL: a step of its own
    const char *wrong;                          // where it is not given that many
};
extern const struct expression_function expression_functions[];
int expression_find_function(str name); // -1: none
// What to write instead of a word of another language; NULL: it is not one.
const char *expression_foreign(str function);

// Bytes of the name that begins at `at`; 0: none does.
static inline size_t expression_name_at(str text, size_t at) {
    return expression_name_length(str_slice(text, at, text.len));
}

__attribute__((format(printf, 4, 5))) bool expression_fail(struct expression_fault *fault, size_t begin,
                                                           size_t end, const char *format, ...);

#endif
