// Names in reach of expressions, and what is said of an expression that is wrong.
#include "diag/codes/binding.h"
#include "diag/diag_expression.h"
#include "parser/stages/objects.h"

#include "parser/bind/say.h"

static struct diag_sink *sink(const struct evaluation *e) {
    return e->loader->input->sink;
}

bool copies_may(const struct schema_row *row) {
    return row->kind == SCHEMA_LIST && schema_find_row(row->child, STR("for")) >= 0;
}

struct ir_scene *copies_written(const struct evaluation *e) {
    return e->copying ? &e->copying->written : e->scene;
}

// ---- names that are not in reach

// All that are named in entries of an element's lists.
static void list_variables(struct evaluation *e, const struct schema_element *schema, const void *element) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const struct ir_any_list list = ir_walk_list(row, element);
        for (uint32_t k = 0; copies_may(row) && k < list.count; k++) {
            const struct schema_row *variables = &row->child->rows[schema_find_row(row->child, STR("for"))];
            const struct ir_any_list of_entry = ir_walk_list(variables, ir_walk_item(row, list, k));
            for (uint32_t v = 0; v < of_entry.count; v++)
                *str_map_at(&e->variables_named, ((const struct ir_variable *)of_entry.items)[v].name) = 1;
        }
    }
}

const char *evaluation_help(struct evaluation *e, str name) {
    for (uint32_t i = e->variable_count - e->base; e->entry && i < e->entry->variable_count; i++)
        if (str_equal(e->entry->variables[i].ir->name, name))
            return "a variable of 'for' can use those before it, not those after it: exchange them";
    if (!e->has_variables_named)
        str_map_init(&e->variables_named, &e->loader->scratch);
    const struct ir_scene *written = copies_written(e);
    if (!e->has_variables_named)
        list_variables(e, &SCHEMA_SCENE, written);
    for (uint32_t i = 0; !e->has_variables_named && i < written->objects.count; i++)
        list_variables(e, &SCHEMA_OBJECT, &written->objects.items[i]);
    e->has_variables_named = true;
    if (!str_map_find(&e->variables_named, name))
        return NULL;
    if (e->entry && e->entry->in && e->entry->in->ir->name.len)
        return "an object with a name sees its own parameters, not the variables of its instances: give it a "
               "parameter, and the "
               "instance 'with'";
    return "a variable of 'for' is known in its entry, and in what is written in place there";
}

bool evaluation_is_three(const struct evaluation *e, str name) {
    for (uint32_t i = e->base; e->entry && i < e->variable_count; i++)
        if (str_equal(e->names[e->count + i], name))
            return e->entry->variables[i - e->base].is_list &&
                   e->entry->variables[i - e->base].value_count == 3;
    return false;
}

bool evaluation_is_known(const struct evaluation *e, str name) {
    for (uint32_t i = e->variable_count; i-- > 0;)
        if (str_equal(e->names[e->count + i], name))
            return true;
    return str_map_find(&e->by_name, name) != 0;
}

// ---- messages

static void print_value(const struct evaluation *e, uint32_t variable, struct strbuf *out) {
    expression_print(e->variables[variable].type,
                     e->values + (size_t)EXPRESSION_WIDTH * (e->count + variable), out);
}

// Appends ", with i = 3, j = 4".
static void print_variables(const struct evaluation *e, struct strbuf *out) {
    bool any = false;
    for (uint32_t i = 0; i < e->variable_count; i++) {
        if (e->variables[i].is_bad)
            continue;
        strbuf_format(out, "%s%.*s = ", any ? ", " : ", with ", STR_ARG(e->names[e->count + i]));
        print_value(e, i, out);
        any = true;
    }
}

void evaluation_add_values(const struct evaluation *e) {
    for (uint32_t i = 0; i < e->variable_count; i++) {
        struct strbuf text;
        strbuf_init(&text);
        print_value(e, i, &text);
        if (!e->variables[i].is_bad)
            diag_with(sink(e), e->names[e->count + i], strbuf_view(&text));
        strbuf_finish(&text);
    }
}

const char *evaluation_suffix(const struct evaluation *e) {
    if (!e->variable_count)
        return e->suffix;
    struct strbuf text;
    strbuf_init(&text);
    print_variables(e, &text);
    const char *suffix =
        arena_format(&e->loader->scratch, "%.*s%s", STR_ARG(strbuf_view(&text)), e->suffix).ptr;
    strbuf_finish(&text);
    return suffix;
}

void evaluation_fault(struct evaluation *e, diag_code code, str text, span at, bool with_values,
                      const struct expression_fault *fault) {
    if (e->is_quiet || diag_is_repeat(sink(e), code, at))
        return;
    const struct diag_expression expression = {.text = text,
                                               .at = at,
                                               .suffix = with_values ? evaluation_suffix(e) : e->suffix,
                                               .names = e->names,
                                               .name_count = e->count + e->variable_count};
    struct expression_fault told = *fault;
    if (fault->problem == EXPRESSION_UNKNOWN_NUMBER && !fault->help)
        told.help = evaluation_help(e, str_slice(text, fault->begin, fault->end));
    diag_expression_fault(sink(e), e->loader->input->sources, code, &expression, &told);
    if (with_values)
        evaluation_add_values(e);
}

bool evaluation_compile(struct evaluation *e, diag_code code, str text, span at,
                        struct expression *expression) {
    struct expression_fault fault;
    if (expression_compile(text, &e->scope, &e->loader->scratch, expression, &fault))
        return true;
    // A parameter that was reported is known.
    if (fault.problem != EXPRESSION_UNKNOWN_NUMBER ||
        !evaluation_is_known(e, str_slice(text, fault.begin, fault.end)))
        evaluation_fault(e, code, text, at, false, &fault);
    return false;
}

bool evaluation_name_fits(const struct evaluation *e, str name, span at, const char *what) {
    if (expression_is_word(name) || str_equal(name, STR("tau"))) {
        diag_add(sink(e), DIAG_BAD_NAME, at, "'%.*s' is a word of expressions and cannot be a %s's name",
                 STR_ARG(name), what);
        diag_help(sink(e), "choose another name");
        return false;
    }
    if (expression_is_free(name))
        return true;
    diag_add(sink(e), DIAG_BAD_NAME, at, "'%.*s' cannot be a %s's name",
             STR_ARG(say_text(&e->loader->scratch, name)), what);
    str mended = arena_copy(&e->loader->scratch, name);
    for (size_t i = 0; i < mended.len; i++)
        if (mended.ptr[i] == '-')
            ((char *)mended.ptr)[i] = '_';
    if (!expression_is_free(mended)) {
        diag_help(
            sink(e),
            "a name in expressions has letters, digits and '_', and is not a word such as 'yes' or 'on'");
        return false;
    }
    diag_help(sink(e), "'-' subtracts: write %.*s", STR_ARG(mended));
    diag_fix(sink(e), false, at, mended);
    return false;
}

void evaluation_mark_named(struct evaluation *e, str text) {
    size_t at = 0;
    str name;
    while (expression_next_name(text, &at, &name)) {
        const uint32_t number = str_map_find(&e->by_name, name);
        if (number)
            e->items[number - 1].is_used = true;
    }
}
