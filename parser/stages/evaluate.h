// Values that are computed: parameters, and formulas in the place of numbers. Private to parser/stages.
//
// Ownership: everything is in the loader's scratch. Thread safety: one thread.
#ifndef GLINT_PARSER_STAGES_EVALUATE_H
#define GLINT_PARSER_STAGES_EVALUATE_H

#include "core/expression.h"
#include "core/str_map.h"
#include "grammar/ir.h"
#include "grammar/ir_formula.h"
#include "parser/stages/loader.h"

enum parameter_state {
    PARAMETER_NEW,
    PARAMETER_OPEN, // what it is computed from is being looked at
    PARAMETER_DONE,
    PARAMETER_BAD, // reported
};

struct parameter {
    const struct ir_parameter *ir;
    enum parameter_state state;
    enum expression_type type;
    struct expression parts[3]; // one, or one for each component
    uint32_t part_count;        // 0: a colour as written
    str texts[3];
    uint32_t hex;
    bool moves;    // depends on the frame, or is moved by a track
    bool is_moved; // by a track, which has put its value there
    bool is_used;
    bool is_ring; // depends on itself, which was reported
};

// A formula that depends on the frame.
struct moving_formula {
    const struct ir_formula *formula;
    struct expression expression;
    const struct bind_frame *frame; // the element
};

struct evaluation {
    struct loader *loader;
    struct ir_scene *scene;
    struct parameter *items; // of scene->parameters, in their order
    str *names;
    uint32_t count;
    struct str_map by_name; // 1 + index
    uint32_t *order;        // each after those that it is computed from
    uint32_t ordered;
    double *values; // EXPRESSION_WIDTH of each
    struct expression_scope scope;
    struct expression_at at;
    bool is_quiet;      // what has no value is not told
    const char *suffix; // of messages: ", in frame 3"
    // Gives parameters that tracks move their values in at.frame; NULL: there are none.
    void (*move)(void *context, struct evaluation *evaluation);
    void *motion;
    struct {
        struct moving_formula *items;
        uint32_t count, capacity;
    } moving; // after evaluate_formulas
};

// Finds the types of all parameters. NULL: nothing is computed in the scene.
struct evaluation *evaluation_begin(struct loader *loader, struct ir_scene *scene);
// Gives all parameters their values in a frame. false: one has none (reported, unless quiet).
bool evaluation_set_frame(struct evaluation *evaluation, double frame, double time);
// A scene that is taken in a frame no longer moves: what moved is written as its value in that frame.
void evaluation_stop(struct evaluation *evaluation);
// Leaves the parameters' values of that frame in the scene.
void evaluation_keep(const struct evaluation *evaluation);
// Warns of parameters that nothing uses.
void evaluation_tell_unused(struct evaluation *evaluation);

// Reads a text as an expression. false: reported with the code.
bool evaluation_compile(struct evaluation *evaluation, diag_code code, str text, span at,
                        struct expression *expression);
void evaluation_fault(struct evaluation *evaluation, diag_code code, str text, span at,
                      const struct expression_fault *fault);

// evaluate.c
// Puts the values of all formulas of the scene in their places, for the frame that was set.
void evaluate_formulas(struct evaluation *evaluation);
// The same for those that move. false: one has no value that fits (reported, unless quiet).
bool evaluate_moving(struct evaluation *evaluation);

#endif
