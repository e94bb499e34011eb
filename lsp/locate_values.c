// What expressions have come to, in all copies of the entry that they are in.
#include "lsp/locate_given.h"
#include "lsp/position.h"

#include "core/expression.h"
#include "core/number.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_formula.h"
#include "grammar/ir_values.h"
#include "grammar/ir_walk.h"

#include <string.h>

enum {
    TRIPLES_MOST = 3,       // that are shown
    LIST_BYTES = 200,       // of a variable's values
    INSTANCES_MOST = 10000, // of which values are computed
};

// ---- variables

// The evaluated scene's list of what an entry is.
static const struct schema_row *list_of(const struct located_scope *scope) {
    return ir_walk_pool(scope->list->child);
}

// Whether an item of that list is the entry, or a copy of it.
static bool is_made_of(const struct schema_row *list, struct ir_any_list items, uint32_t i,
                       const struct located_scope *scope) {
    return ir_walk_head(ir_walk_item(list, items, i))->origin == ir_walk_head(scope->entry)->origin;
}

uint32_t locate_copies(const struct session *session, const struct located_scope *scope) {
    if (!scope->list)
        return 1;
    const struct ir_any_list items = ir_walk_list(list_of(scope), session->scene);
    uint32_t found = 0;
    for (uint32_t i = 0; i < items.count; i++)
        found += is_made_of(list_of(scope), items, i, scope);
    return found;
}

static bool find_range(const struct session *session, const struct located_scope *scope, uint32_t variable,
                       uint32_t *least, uint32_t *most) {
    const struct schema_row *list = list_of(scope);
    const struct ir_any_list items = ir_walk_list(list, session->scene);
    *least = UINT32_MAX;
    *most = 0;
    for (uint32_t i = 0; i < items.count; i++) {
        const uint32_t *places = ir_copies_at(session->origin.copies, list, i);
        if (!places || places[0] <= variable || !is_made_of(list, items, i, scope))
            continue;
        const uint32_t place = places[1 + variable];
        *least = place < *least ? place : *least;
        *most = place > *most ? place : *most;
    }
    return *least <= *most;
}

void locate_print_variable(const struct session *session, const struct located_scope *scope,
                           const struct ir_variable *variable, struct strbuf *out) {
    uint32_t least, most;
    if (variable->head.poisoned || !scope->list)
        return;
    if (variable->kind == IR_VARIABLE_VALUES) {
        const uint32_t count = ir_values_count(variable->values);
        const str values = position_clip(variable->values, LIST_BYTES);
        if (count > 1)
            strbuf_format(out, "one of %u values: ", count);
        strbuf_str(out, values);
        return;
    }
    const uint32_t index = (uint32_t)(variable - locate_variables(scope).items);
    if (!find_range(session, scope, index, &least, &most)) {
        if (variable->head.formulas || variable->count < 1)
            return;
        least = 0;
        most = (uint32_t)variable->count - 1;
    }
    strbuf_format(out, "%u", least);
    if (least < most)
        strbuf_format(out, " to %u", most);
}

// ---- formulas

struct values {
    const struct ir_formula *formula;
    uint32_t origin; // of the element
    enum expression_type type;
    double least, most;
    double triples[TRIPLES_MOST][EXPRESSION_WIDTH]; // different ones
    uint32_t triple_count;
    bool has_more; // triples
    bool is_known;
};

static void take_number(struct values *values, double number) {
    values->least = !values->is_known || number < values->least ? number : values->least;
    values->most = !values->is_known || number > values->most ? number : values->most;
    values->is_known = true;
}

static void take_triple(struct values *values, const double *triple) {
    const size_t size = sizeof values->triples[0];
    values->type = EXPRESSION_TRIPLE;
    values->is_known = true;
    for (uint32_t i = 0; i < values->triple_count; i++)
        if (memcmp(values->triples[i], triple, size) == 0)
            return;
    if (values->triple_count < TRIPLES_MOST)
        memcpy(values->triples[values->triple_count++], triple, size);
    else
        values->has_more = true;
}

static void take_value(struct values *values, const struct schema_row *row, const char *field) {
    double parts[EXPRESSION_WIDTH] = {0};
    const int component = values->formula->component;
    const uint32_t count = ir_walk_components(row, field, parts);
    const struct ir_color *color = (const void *)field;
    if (row->kind == SCHEMA_BOOLEAN) {
        values->type = EXPRESSION_TRUTH;
        take_number(values, *(const bool *)field);
    } else if (row->kind == SCHEMA_INTEGER) {
        take_number(values, *(const int32_t *)(const void *)field);
    } else if (count == 0) {
        take_number(values, *(const double *)(const void *)field);
    } else if (component != IR_FORMULA_WHOLE || (row->kind != SCHEMA_VECTOR && row->kind != SCHEMA_COLOR)) {
        take_number(values, parts[component == IR_FORMULA_WHOLE ? 0 : component]);
    } else {
        parts[3] = row->kind == SCHEMA_COLOR && color->is_hex ? (double)color->hex : -1;
        take_triple(values, parts);
    }
}

static void take_element(void *context, const struct schema_element *schema, const void *element) {
    struct values *values = context;
    const struct ir_head *head = ir_walk_head(element);
    const struct ir_formula *formula = values->formula;
    const uint32_t row = (uint32_t)(formula->row - schema->rows);
    if (head->origin != values->origin || (head->poisoned >> row & 1))
        return;
    const size_t slot = formula->slot > 0 ? (size_t)formula->slot : 0;
    const char *field = schema_field_const(formula->row, element);
    take_value(values, formula->row, field + slot * formula->row->size);
}

static const struct ir_formula *formula_at(const struct session *session, const struct located *at) {
    const struct ir_formulas *formulas = session->origin.formulas;
    for (uint32_t i = formulas ? ir_walk_head(at->element)->formulas : 0; i; i = formulas->items[i].next) {
        const struct ir_formula *formula = &formulas->items[i];
        if (formula->row == at->row && formula->at.source == at->at.source &&
            formula->at.begin <= at->offset && at->offset <= formula->at.end)
            return formula;
    }
    return NULL;
}

static void print_values(const struct values *values, struct strbuf *out) {
    char digits[NUMBER_FORMAT_MAX];
    if (values->type == EXPRESSION_TRUTH) {
        strbuf_cstr(out, values->least != values->most ? "true or false"
                         : values->most != 0           ? "true"
                                                       : "false");
    } else if (values->type == EXPRESSION_NUMBER) {
        number_format(values->least, digits);
        strbuf_cstr(out, digits);
        number_format(values->most, digits);
        if (values->least < values->most)
            strbuf_format(out, " to %s", digits);
    }
    for (uint32_t i = 0; i < values->triple_count; i++) {
        strbuf_cstr(out, i ? ", " : "");
        expression_print(EXPRESSION_TRIPLE, values->triples[i], out);
    }
    strbuf_cstr(out, values->has_more ? ", ..." : "");
}

static bool is_of_frame(str text) {
    str name;
    for (size_t at = 0; expression_next_name(text, &at, &name);)
        if (str_equal_cstr(name, "frame") || str_equal_cstr(name, "time"))
            return true;
    return false;
}

bool locate_print_value(const struct session *session, const struct located *at, struct arena *arena,
                        struct strbuf *out) {
    const struct ir_formula *formula = at->row && at->in_value ? formula_at(session, at) : NULL;
    if (!formula)
        return false;
    struct values values = {.formula = formula, .origin = ir_walk_head(at->element)->origin};
    locate_walk(&SCHEMA_SCENE, session->scene, take_element, &values);
    if (!values.is_known)
        return false;
    const struct located_scope scope = locate_scope(session, at->element, arena);
    const uint32_t copies = scope.list ? locate_copies(session, &scope) : 1;
    strbuf_cstr(out, formula->row->name);
    if (formula->component != IR_FORMULA_WHOLE)
        strbuf_format(out, ".%s", schema_components(formula->row->kind)[formula->component]);
    strbuf_cstr(out, " = ");
    print_values(&values, out);
    if (copies > 1)
        strbuf_format(out, " in %u copies", copies);
    if (is_of_frame(formula->text))
        strbuf_format(out, "%s in frame %d", copies > 1 ? "," : "",
                      session->origin.written ? (int)session->origin.written->animation.frame : 0);
    return true;
}

// ---- parameters of objects

uint32_t locate_instances(const struct session *session, const struct ir_object *object,
                          struct arena *arena) {
    const struct located_copies copies = locate_copies_begin(session, arena);
    uint32_t count = 0;
    for (uint32_t i = 0; i < session->scene->instances.count; i++) {
        const struct located_scope *made = locate_made(&copies, i);
        count += made && locate_shown(session, made->entry) == object;
    }
    return count;
}

struct argument_search {
    struct located_copies copies;
    struct arena arena; // for each value anew
    const struct located_scope *scope;
    const struct ir_parameter *parameter; // NULL: the text of `with`
    const struct ir_with *with;
    struct values values;
    uint32_t count, taken;
};

static bool is_asked(const struct argument_search *search, const struct located_scope *made) {
    return search->with ? made->entry == search->scope->entry
                        : locate_shown(search->copies.session, made->entry) == search->scope->object;
}

static void search_values(void *context) {
    struct argument_search *search = context;
    const uint32_t count = search->copies.session->scene->instances.count;
    struct ir_result result;
    for (uint32_t i = 0; i < count; i++) {
        const struct located_scope *made = locate_made(&search->copies, i);
        if (!made || !is_asked(search, made) || search->count++ >= INSTANCES_MOST)
            continue;
        arena_reset(&search->arena);
        search->taken++;
        if (search->with ? !locate_given(&search->copies, &search->arena, i, search->with->value, &result)
                         : !locate_argument(&search->copies, &search->arena, i, search->scope,
                                            search->parameter, &result))
            continue;
        search->values.type = result.type;
        if (result.type == EXPRESSION_TRIPLE)
            take_triple(&search->values, result.value);
        else
            take_number(&search->values, result.value[0]);
    }
}

static bool print_found(struct argument_search *search, struct strbuf *out) {
    arena_init(&search->arena, (size_t)1 << 26);
    arena_guarded(&search->arena, search_values, search);
    arena_finish(&search->arena);
    if (!search->values.is_known)
        return false;
    print_values(&search->values, out);
    if (search->taken < search->count)
        strbuf_format(out, " in the first %u of %u instances", search->taken, search->count);
    else if (search->count > 1)
        strbuf_format(out, " in %u instances", search->count);
    return true;
}

bool locate_print_argument(const struct session *session, const struct located_scope *scope,
                           const struct ir_parameter *parameter, struct arena *arena, struct strbuf *out) {
    struct argument_search search = {
        .copies = locate_copies_begin(session, arena), .scope = scope, .parameter = parameter};
    return print_found(&search, out);
}

bool locate_print_given(const struct session *session, const struct located_scope *scope,
                        const struct ir_with *with, struct arena *arena, struct strbuf *out) {
    struct argument_search search = {
        .copies = locate_copies_begin(session, arena), .scope = scope, .with = with};
    return scope->list && print_found(&search, out);
}
