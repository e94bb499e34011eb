// A formula in the place of a value: reading it, and what is said where it does not fit there.
#include "diag/codes/binding.h"
#include "diag/diag_expression.h"
#include "parser/stages/evaluate.h"

#include "core/number.h"
#include "parser/bind/bind.h"
#include "parser/bind/say.h"
#include "parser/tree/mend.h"
#include "parser/tree/tree.h"

#include <math.h>

static struct diag_sink *sink(const struct evaluation *e) {
    return e->loader->input->sink;
}

// ---- what does not fit

struct bind_subject formula_subject(const struct bind_frame *frame, const struct ir_formula *f) {
    struct bind_subject subject = {.frame = frame, .row = f->row, .index = f->slot};
    if (f->component != IR_FORMULA_WHOLE)
        subject.component = schema_components(f->row->kind)[f->component];
    return subject;
}

enum {
    SHORT_NAME = 2
};

// A word that is near no name, such as `yes` or `red`, was not meant as a formula: the binder reports what is
// expected there. In an entry with variables, a short one may well have been.
static bool is_plain_mistake(struct evaluation *e, const struct ir_formula *f,
                             const struct expression_fault *fault) {
    bool safe;
    if (f->row->kind == SCHEMA_COLOR && f->component == IR_FORMULA_WHOLE &&
        fault->problem != EXPRESSION_WRONG && mend_color(&e->loader->scratch, f->text, &safe).len)
        return true;
    const struct diag_expression expression = {.names = e->names, .name_count = e->count + e->variable_count};
    return fault->problem == EXPRESSION_UNKNOWN_NUMBER && expression_is_name(f->text) &&
           !(e->variable_count && f->text.len <= SHORT_NAME) && !evaluation_help(e, f->text) &&
           !diag_expression_is_near(sink(e), &expression, f->text);
}

static void tell_plain_mistake(struct evaluation *e, const struct bind_frame *frame,
                               const struct ir_formula *f) {
    struct loader *loader = e->loader;
    struct tree tree;
    tree_init(&tree, &loader->scratch, f->at.source, ir_origin_is_xml(&loader->output->origin, f->at.source));
    tree.root = tree_add(&tree, (struct tree_node){.kind = TREE_SCALAR,
                                                   .begin = f->at.begin,
                                                   .end = f->at.end,
                                                   .value = tree_add_text(&tree, f->text),
                                                   .count = (uint32_t)f->text.len});
    struct bind_context context = loader_binding(loader, sink(e), &tree);
    context.plain = true;
    struct ir_color whole;
    double component;
    if (f->component == IR_FORMULA_WHOLE)
        bind_value(&context, formula_subject(frame, f), tree.root, &whole);
    else
        bind_number(&context, formula_subject(frame, f), tree.root, &component);
}

static bool wrong_type(struct evaluation *e, const struct bind_frame *frame, const struct ir_formula *f,
                       enum expression_type type) {
    struct arena *scratch = &e->loader->scratch;
    const bool is_boolean = f->row->kind == SCHEMA_BOOLEAN;
    diag_add(sink(e), DIAG_EXPRESSION, f->at, "%.*s must be %.*s; '%.*s' is %s",
             STR_ARG(say_subject(scratch, formula_subject(frame, f))),
             STR_ARG(is_boolean ? STR("true or false") : say_expected_of(scratch, formula_subject(frame, f))),
             STR_ARG(say_text(scratch, f->text)), expression_type_name(type));
    if (is_boolean && type == EXPRESSION_NUMBER)
        diag_help(sink(e), "write %.*s > 0", STR_ARG(say_text(scratch, f->text)));
    if (schema_components(f->row->kind)[0] && type == EXPRESSION_NUMBER && evaluation_is_three(e, f->text))
        diag_help(sink(e), "a list of one vector is written in two brackets: [[1, 2, 3]]");
    return false;
}

static void add_text(struct evaluation *e, const struct ir_formula *f) {
    evaluation_add_values(e);
    if (f->text.len <= 60)
        diag_note(sink(e), SPAN_NONE, "%s = %.*s", f->row->name, STR_ARG(f->text));
}

static bool out_of_range(struct evaluation *e, struct bind_subject subject, const struct ir_formula *f,
                         double value) {
    char digits[NUMBER_FORMAT_MAX];
    if (e->is_quiet || diag_is_repeat(sink(e), DIAG_OUT_OF_RANGE, f->at))
        return false;
    number_format(value, digits);
    diag_add(sink(e), DIAG_OUT_OF_RANGE, f->at, "%.*s is %s%s; it must be %s%s",
             STR_ARG(say_subject(&e->loader->scratch, subject)), digits, evaluation_suffix(e),
             schema_range_info(f->row->range)->text, say_unit(f->row));
    add_text(e, f);
    return false;
}

bool evaluate_fits(struct evaluation *e, struct bind_subject subject, const struct ir_formula *f,
                   double value) {
    char digits[NUMBER_FORMAT_MAX];
    if (!schema_in_range(f->row->range, value))
        return out_of_range(e, subject, f, value);
    if (f->row->kind != SCHEMA_INTEGER || value == floor(value))
        return true;
    if (e->is_quiet || diag_is_repeat(sink(e), DIAG_OUT_OF_RANGE, f->at))
        return false;
    number_format(value, digits);
    diag_add(sink(e), DIAG_OUT_OF_RANGE, f->at, "%.*s is %s%s; it must be a whole number",
             STR_ARG(say_subject(&e->loader->scratch, subject)), digits, evaluation_suffix(e));
    add_text(e, f);
    diag_help(sink(e), "write floor(%.*s)", STR_ARG(say_text(&e->loader->scratch, f->text)));
    return false;
}

// ---- one formula

static bool type_fits(const struct ir_formula *f, enum expression_type type) {
    const enum schema_kind kind = f->row->kind;
    if (f->component != IR_FORMULA_WHOLE || kind == SCHEMA_NUMBER || kind == SCHEMA_INTEGER)
        return type == EXPRESSION_NUMBER;
    if (kind == SCHEMA_BOOLEAN)
        return type == EXPRESSION_TRUTH;
    if (type == EXPRESSION_TRIPLE)
        return kind == SCHEMA_VECTOR || kind == SCHEMA_COLOR;
    return type == EXPRESSION_NUMBER && (f->row->fill || kind == SCHEMA_COLOR);
}

// ---- reading

static bool read(struct evaluation *e, const struct bind_frame *frame, const struct ir_formula *f,
                 struct expression *expression) {
    struct expression_fault fault;
    if (!expression_compile(f->text, &e->scope, &e->loader->scratch, expression, &fault)) {
        const bool is_known = fault.problem == EXPRESSION_UNKNOWN_NUMBER &&
                              evaluation_is_known(e, str_slice(f->text, fault.begin, fault.end));
        if (e->is_quiet || is_known)
            return false;
        if (is_plain_mistake(e, f, &fault))
            tell_plain_mistake(e, frame, f);
        else
            evaluation_fault(e, DIAG_EXPRESSION, f->text, f->at, false, &fault);
        return false;
    }
    return type_fits(f, expression->type) || (!e->is_quiet && wrong_type(e, frame, f, expression->type));
}

bool evaluate_read(struct evaluation *e, const struct bind_frame *frame, const struct ir_formula *f,
                   struct expression *expression) {
    const uint32_t index = (uint32_t)(f - e->scene->formulas->items);
    if (!e->entry || index >= e->formula_count)
        return read(e, frame, f, expression);
    struct copy_formula *of_copies = &e->formulas[index];
    if (!of_copies->is_read) {
        of_copies->is_good = read(e, frame, f, &of_copies->expression);
        of_copies->is_read = true;
    }
    *expression = of_copies->expression;
    return of_copies->is_good;
}
