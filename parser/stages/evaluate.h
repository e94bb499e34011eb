// Values that are computed: parameters, and formulas in the place of numbers. Private to parser/stages.
//
// Ownership: everything is in the loader's scratch. Thread safety: one thread.
#ifndef GLINT_PARSER_STAGES_EVALUATE_H
#define GLINT_PARSER_STAGES_EVALUATE_H

#include "core/expression.h"
#include "core/str_map.h"
#include "grammar/ir.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_formula.h"
#include "parser/bind/bind.h"
#include "parser/stages/loader.h"

enum parameter_state {
    PARAMETER_NEW,
    PARAMETER_OPEN, // what it is computed from is being looked at
    PARAMETER_DONE,
    PARAMETER_BAD, // reported
};

// A number, truth, vector or colour (computed.c).
struct computed {
    enum expression_type type;
    struct expression parts[3]; // one, or one for each component
    uint32_t part_count;        // 0: a colour as written
    str texts[3];
    uint32_t hex;
    bool moves;
};

struct parameter {
    const struct ir_parameter *ir;
    enum parameter_state state;
    struct computed value;
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
    const struct copy_entry *entry; // of which it is a copy; NULL: of none
    uint32_t places, instance;
};

// A formula of an entry with copies is read once.
struct copy_formula {
    struct expression expression;
    bool is_read, is_good;
};

// A name in reach beyond the scene's parameters: a parameter of an object, or a variable of an entry.
struct copy_variable {
    enum expression_type type;
    bool moves;
    bool is_bad; // reported: it has no value
    bool *is_used;
};
enum {
    REACH_MOST = 512 // such names at one place
};

struct copy_entry;
struct copying;
struct objects;

struct evaluation {
    struct loader *loader;
    struct ir_scene *scene;
    struct parameter *items; // of scene->parameters, in their order
    str *names;              // of parameters, and then of variables
    uint32_t count;
    struct copy_variable *variables; // those of objects, then those of the entry
    uint32_t variable_count;
    uint32_t base;    // so many of them are not the entry's own
    uint32_t base_of; // 1 + the instance whose object's parameters they are; 0: of none, or not known
    const struct copy_entry *entry; // whose variables these are; NULL: there are none
    uint32_t places;                // of the copy
    uint32_t instance;              // 1 + that in whose object it is; 0: in none
    struct objects *objects;        // NULL: the scene has none
    struct copying *copying;        // NULL: nothing is copied
    struct copy_formula *formulas;  // by their index
    uint32_t formula_count;
    bool only_types;                // formulas are read, and not computed
    uint64_t operations;            // done, in additions
    bool is_over;                   // the limit on them, which was reported
    struct str_map by_name;         // 1 + index
    struct str_map variables_named; // of all entries, once asked for
    bool has_variables_named;
    uint32_t *order; // each after those that it is computed from
    uint32_t ordered;
    double *values; // EXPRESSION_WIDTH of each, parameters first
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

// parameters.c
// Finds the types of all parameters. NULL: nothing is computed in the scene.
struct evaluation *evaluation_begin(struct loader *loader, struct ir_scene *scene);
// Gives all parameters their values in a frame. false: one has none (reported, unless quiet).
bool evaluation_set_frame(struct evaluation *evaluation, double frame, double time);
// A scene that is taken in a frame no longer moves: what moved is written as its value in that frame.
void evaluation_stop(struct evaluation *evaluation);
// Leaves the parameters' values of that frame in the scene.
void evaluation_keep(const struct evaluation *evaluation);
// Warns of parameters, and of variables of copies, that nothing uses.
void evaluation_tell_unused(struct evaluation *evaluation);

// parameter_bounds.c
// Whether the bounds of a parameter, whose type is known, fit it and each other; else it is reported.
bool parameter_bounds_fit(const struct evaluation *evaluation, const struct parameter *parameter);
// Whether a number is within the bounds of a parameter; else it is reported at `at`.
bool parameter_is_in_bounds(struct evaluation *evaluation, const struct parameter *parameter, double value,
                            span at);

// scope.c
// Reads a text as an expression. false: reported with the code.
bool evaluation_compile(struct evaluation *evaluation, diag_code code, str text, span at,
                        struct expression *expression);
// `with_values`: the message ends in those of the variables in reach.
void evaluation_fault(struct evaluation *evaluation, diag_code code, str text, span at, bool with_values,
                      const struct expression_fault *fault);
// Whether a name can be that of a parameter or variable; else it is reported.
bool evaluation_name_fits(const struct evaluation *evaluation, str name, span at, const char *what);
// What messages end in: ", with i = 3, in frame 3".
const char *evaluation_suffix(const struct evaluation *evaluation);
// What was reported last is about a copy, with these values.
void evaluation_add_values(const struct evaluation *evaluation);
// A parameter that a text names is used.
void evaluation_mark_named(struct evaluation *evaluation, str text);
// What is said of a name that is not in reach, and is a variable of some entry; NULL: it is of none.
const char *evaluation_help(struct evaluation *evaluation, str name);
// Whether a name is in reach and has no value, which was reported.
bool evaluation_is_known(const struct evaluation *evaluation, str name);
// Whether a name is that of a variable, in reach, with a list of three numbers.
bool evaluation_is_three(const struct evaluation *evaluation, str name);
// Whether entries of a list can have copies.
bool copies_may(const struct schema_row *list);
// The scene as it is written, for the paths of tracks.
struct ir_scene *copies_written(const struct evaluation *evaluation);

// computed.c
// Reads one to three expressions, or #rrggbb; `what` begins messages: "parameter 'tall'". false: reported.
bool computed_read(struct evaluation *evaluation, str text, str what, span at, struct computed *computed);
// false: there is none in this frame (reported, unless quiet).
bool computed_value(struct evaluation *evaluation, const struct computed *computed, span at, double *value);

// formula.c
// Reads a formula of an element. false: reported.
bool evaluate_read(struct evaluation *evaluation, const struct bind_frame *frame, const struct ir_formula *f,
                   struct expression *expression);
// Whether a number fits its row; else it is reported.
bool evaluate_fits(struct evaluation *evaluation, struct bind_subject subject, const struct ir_formula *f,
                   double value);
struct bind_subject formula_subject(const struct bind_frame *frame, const struct ir_formula *f);

// evaluate.c
// Puts the values of all formulas of the scene in their places, for the frame that was set.
void evaluate_formulas(struct evaluation *evaluation);
// The same for those that move. false: one has no value that fits (reported, unless quiet).
bool evaluate_moving(struct evaluation *evaluation);
// Reads all formulas of an entry that has no copies, so that mistakes in them are found.
void evaluate_types(struct evaluation *evaluation, const struct schema_row *row, void *entry);

// copies_reach.c
// The variables of an item of a list of the scene come into reach, with their values. false: the item is not
// one that has values, or a parameter around it has none (reported).
bool copies_enter(struct evaluation *evaluation, const struct schema_row *row, uint32_t index);
bool copies_enter_again(struct evaluation *evaluation, const struct copy_entry *entry, uint32_t places,
                        uint32_t instance);
// The variables of the entry leave it.
void copies_leave(struct evaluation *evaluation);
// All names but the scene's parameters leave it.
void copies_leave_all(struct evaluation *evaluation);
// Whether an item of a list of the scene was made of an entry of an object.
bool copies_is_of(const struct evaluation *evaluation, const struct schema_row *row, uint32_t index,
                  const void *entry);
// The first item of the scene's list that an entry made, as it is numbered there, and how many; an entry that
// is as written makes one.
uint32_t copies_of(const struct evaluation *evaluation, const struct schema_row *row, uint32_t entry,
                   uint32_t *count);

// copies.c
// Whether any entry of the scene has `for` or `if`, or the scene has objects or instances.
bool copies_are_written(const struct ir_scene *scene);

// copies_make.c
// Gives the scene's lists what `for`, `if` and instances make, still with their formulas.
void copies_make(struct evaluation *evaluation);

// copies_finish.c
// Copies have values, and no formulas.
void copies_finish(struct evaluation *evaluation);
void copies_tell_unused(const struct evaluation *evaluation);
// Cameras that are focused on a copy.
void copies_check_focus(struct evaluation *evaluation);

#endif
