// The bounds of a parameter, of the scene or of an object.
#include "diag/codes/binding.h"
#include "parser/stages/evaluate.h"

#include "core/number.h"

static struct diag_sink *sink(const struct evaluation *e) {
    return e->loader->input->sink;
}

static span place_of(const struct evaluation *e, const struct parameter *p, const char *row) {
    return ir_place_value(&e->loader->output->origin, &p->ir->head, &SCHEMA_PARAMETER, row);
}

static bool is_row_written(const struct parameter *p, const char *row) {
    return (p->ir->head.written & bind_bit((uint32_t)schema_find_row(&SCHEMA_PARAMETER, str_from(row)))) != 0;
}

bool parameter_bounds_fit(const struct evaluation *e, const struct parameter *p) {
    const bool least = is_row_written(p, "min"), most = is_row_written(p, "max");
    if (!least && !most)
        return true;
    if (p->value.type != EXPRESSION_NUMBER) {
        diag_add(sink(e), DIAG_PARAMETER_VALUE, place_of(e, p, least ? "min" : "max"),
                 "parameter '%.*s' is %s, which has no bounds", STR_ARG(p->ir->name),
                 expression_type_name(p->value.type));
        return false;
    }
    if (!least || !most || p->ir->min <= p->ir->max)
        return true;
    diag_add(sink(e), DIAG_PARAMETER_VALUE, place_of(e, p, "max"),
             "'max' of parameter '%.*s' is less than its 'min'", STR_ARG(p->ir->name));
    return false;
}

bool parameter_is_in_bounds(struct evaluation *e, const struct parameter *p, double value, span at) {
    char digits[NUMBER_FORMAT_MAX], bound[NUMBER_FORMAT_MAX];
    const bool low = is_row_written(p, "min") && value < p->ir->min;
    const bool high = is_row_written(p, "max") && value > p->ir->max;
    if (p->value.type != EXPRESSION_NUMBER || (!low && !high))
        return true;
    if (e->is_quiet || diag_is_repeat(sink(e), DIAG_PARAMETER_VALUE, at))
        return false;
    number_format(value, digits);
    number_format(low ? p->ir->min : p->ir->max, bound);
    diag_add(sink(e), DIAG_PARAMETER_VALUE, at, "parameter '%.*s' is %s%s; it must be at %s %s",
             STR_ARG(p->ir->name), digits, evaluation_suffix(e), low ? "least" : "most", bound);
    evaluation_add_values(e);
    diag_note(sink(e), place_of(e, p, low ? "min" : "max"), "the bound is here");
    return false;
}
