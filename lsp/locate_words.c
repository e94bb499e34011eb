// Names in expressions: parameters of the scene, and variables of the entry that the expression is in.
#include "lsp/locate.h"

#include "core/expression.h"
#include "grammar/ir_formula.h"
#include "grammar/ir_walk.h"

#include <stdlib.h>
#include <string.h>

// ---- the expressions of an element

typedef void visit_span(void *context, span at);

static void each_expression(const struct session *session, const struct schema_element *schema,
                            const void *element, visit_span *visit, void *context) {
    const struct ir_formulas *formulas = session->origin.formulas;
    const struct ir_head *head = ir_walk_head(element);
    for (uint32_t i = formulas ? head->formulas : 0; i; i = formulas->items[i].next)
        visit(context, formulas->items[i].at);
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct ir_row_origin *row = ir_origin_row(&session->origin, head, i);
        if (row && schema_has_values(&schema->rows[i]))
            visit(context, row->value);
    }
}

struct reading {
    const struct session *session;
    visit_span *visit; // is given names
    void *context;
};

static void read_names(const struct reading *reading, span at) {
    const str text = source_text(&reading->session->sources, at);
    const bool is_xml = ir_origin_is_xml(&reading->session->origin, at.source);
    size_t end = 0;
    str name;
    while (expression_next_name(text, &end, &name)) {
        const size_t begin = end - name.len;
        if (!is_xml || begin == 0 || text.ptr[begin - 1] != '&') // &lt;
            reading->visit(reading->context,
                           (span){at.source, at.begin + (uint32_t)begin, at.begin + (uint32_t)end});
    }
}

// In an element of XML expressions are between quotes.
static void read_element(const struct reading *reading, str text, span at) {
    size_t begin = 0;
    for (size_t i = 0; i < text.len; i++) {
        const bool is_open = begin > 0;
        if (is_open && text.ptr[i] == text.ptr[begin - 1]) {
            read_names(reading, (span){at.source, at.begin + (uint32_t)begin, at.begin + (uint32_t)i});
            begin = 0;
        } else if (!is_open && (text.ptr[i] == '"' || text.ptr[i] == '\'')) {
            begin = i + 1;
        }
    }
}

// A list of YAML may have comments between its items.
static void read_lines(const struct reading *reading, str text, span at) {
    for (size_t begin = 0; begin < text.len;) {
        size_t end = begin;
        while (end < text.len && text.ptr[end] != '\n' &&
               !(text.ptr[end] == '#' && (end == begin || strchr(" \t", text.ptr[end - 1]))))
            end++;
        read_names(reading, (span){at.source, at.begin + (uint32_t)begin, at.begin + (uint32_t)end});
        while (end < text.len && text.ptr[end] != '\n')
            end++;
        begin = end + 1;
    }
}

static void read_expression(void *context, span at) {
    const struct reading *reading = context;
    const str text = source_text(&reading->session->sources, at);
    if (text.len && text.ptr[0] == '<')
        read_element(reading, text, at);
    else
        read_lines(reading, text, at);
}

static void each_name(const struct session *session, const struct schema_element *schema, const void *element,
                      visit_span *visit, void *context) {
    struct reading reading = {session, visit, context};
    each_expression(session, schema, element, read_expression, &reading);
}

// ---- what a name means

struct meaning {
    const struct schema_element *schema; // NULL: nothing
    const void *element;
};

static const struct ir_parameter *find_parameter(const struct session *session, str name) {
    const struct ir_parameters *parameters = &locate_scene(session)->parameters;
    for (uint32_t i = 0; i < parameters->count; i++)
        if (name.len && str_equal(parameters->items[i].name, name))
            return &parameters->items[i];
    return NULL;
}

static const struct ir_variable *find_variable(const struct located_scope *scope, str name) {
    const struct ir_variables variables = locate_variables(scope);
    for (uint32_t i = 0; i < variables.count && i < scope->reach; i++)
        if (name.len && str_equal(variables.items[i].name, name))
            return &variables.items[i];
    return NULL;
}

static struct meaning meaning_of(const struct session *session, const struct located_scope *scope, str name) {
    const struct ir_variable *variable = find_variable(scope, name);
    const struct ir_parameter *parameter = variable ? NULL : find_parameter(session, name);
    if (variable)
        return (struct meaning){&SCHEMA_VARIABLE, variable};
    return (struct meaning){parameter ? &SCHEMA_PARAMETER : NULL, parameter};
}

// Entries that share their variables through an anchor have the same ones.
static bool is_same(const struct session *session, struct meaning meaning, const struct located_name *name) {
    return meaning.schema == name->schema &&
           (meaning.element == name->element ||
            (meaning.schema == &SCHEMA_VARIABLE &&
             span_equal(locate_name_place(session, meaning.schema, meaning.element), name->definition)));
}

// ---- the name at a place

struct scope_search {
    const void *element;
    struct located_scope found;
};

static void search_scope(void *context, const struct schema_element *schema, const void *element,
                         const struct located_scope *scope) {
    (void)schema;
    struct scope_search *search = context;
    if (element == search->element)
        search->found = *scope;
}

struct located_scope locate_scope(const struct session *session, const void *element, struct arena *arena) {
    struct scope_search search = {.element = element};
    locate_walk_scoped(session, arena, search_scope, &search);
    return search.found;
}

struct word_search {
    size_t offset;
    span word;
};

static void search_word(void *context, span word) {
    struct word_search *search = context;
    if (word.begin <= search->offset && search->offset <= word.end)
        search->word = word;
}

bool locate_word(const struct session *session, const struct located *at, struct arena *arena,
                 struct located_name *out) {
    struct word_search search = {at->offset, SPAN_NONE};
    if (!at->schema || !at->row || !at->in_value || !locate_scene(session))
        return false;
    each_name(session, at->schema, at->element, search_word, &search);
    if (span_is_none(search.word) || search.word.source != at->at.source)
        return false;
    out->scope = locate_scope(session, at->element, arena);
    const struct meaning meaning =
        meaning_of(session, &out->scope, source_text(&session->sources, search.word));
    out->schema = meaning.schema;
    out->element = meaning.element;
    out->here = search.word;
    return meaning.element != NULL;
}

// ---- its uses

struct spans {
    span *items;
    uint32_t count, capacity;
};

struct use_search {
    const struct session *session;
    struct arena *arena;
    struct located_name *name;
    const struct located_scope *scope; // of the element
    struct spans others;               // the same name, with another meaning
};

static void search_use(void *context, span word) {
    struct use_search *search = context;
    const str text = source_text(&search->session->sources, word);
    if (!str_equal(text, search->name->name))
        return;
    const struct meaning meaning = meaning_of(search->session, search->scope, text);
    if (is_same(search->session, meaning, search->name))
        *ARENA_PUSH(search->arena, &search->name->uses) = word;
    else if (meaning.element)
        *ARENA_PUSH(search->arena, &search->others) = word;
}

static void search_uses(void *context, const struct schema_element *schema, const void *element,
                        const struct located_scope *scope) {
    struct use_search *search = context;
    search->scope = scope;
    each_name(search->session, schema, element, search_use, search);
}

static int compare_spans(const void *a, const void *b) {
    const span *x = a, *y = b;
    if (x->source != y->source)
        return x->source < y->source ? -1 : 1;
    return (x->begin > y->begin) - (x->begin < y->begin);
}

void locate_word_uses(const struct session *session, struct arena *arena, struct located_name *name) {
    struct use_search search = {.session = session, .arena = arena, .name = name};
    uint32_t kept = 0;
    locate_walk_scoped(session, arena, search_uses, &search);
    span *uses = name->uses.items;
    if (name->uses.count)
        qsort(uses, name->uses.count, sizeof *uses, compare_spans);
    for (uint32_t i = 0; i < name->uses.count; i++) // what an alias stands for is there again
        if (kept == 0 || !span_equal(uses[kept - 1], uses[i]))
            uses[kept++] = uses[i];
    name->uses.count = kept;
    for (uint32_t i = 0; kept && i < search.others.count; i++)
        name->is_shared |= bsearch(&search.others.items[i], uses, kept, sizeof *uses, compare_spans) != NULL;
}

// ---- another name for it

struct conflict_search {
    const struct session *session;
    const struct located_name *name;
    str text; // the new name
    const struct located_scope *scope;
    const char *found;
};

static void search_captured(void *context, span word) {
    struct conflict_search *search = context;
    const struct session *session = search->session;
    const str text = source_text(&session->sources, word);
    if (search->name->schema == &SCHEMA_VARIABLE) {
        const struct ir_variable *own = find_variable(search->scope, search->name->name);
        if (own && str_equal(text, search->text) &&
            is_same(session, (struct meaning){&SCHEMA_VARIABLE, own}, search->name) &&
            meaning_of(session, search->scope, text).element)
            search->found = "an expression of this entry uses something else with this name";
    } else if (str_equal(text, search->name->name) && find_variable(search->scope, search->text) &&
               is_same(session, meaning_of(session, search->scope, text), search->name)) {
        search->found = "a variable of an entry that uses it has this name";
    }
}

// A variable beside those of the entry, or in the same file as the parameter.
static bool is_in_the_way(const struct conflict_search *search, const struct ir_variable *other,
                          const struct located_scope *scope) {
    if (!str_equal(other->name, search->text))
        return false;
    if (search->name->schema == &SCHEMA_PARAMETER)
        return locate_name_place(search->session, &SCHEMA_VARIABLE, other).source ==
               search->name->definition.source;
    const struct located_scope whole = {scope->list, scope->entry, scope->index, UINT32_MAX};
    const struct ir_variable *own = find_variable(&whole, search->name->name);
    return own && is_same(search->session, (struct meaning){&SCHEMA_VARIABLE, own}, search->name);
}

static void search_conflict(void *context, const struct schema_element *schema, const void *element,
                            const struct located_scope *scope) {
    struct conflict_search *search = context;
    search->scope = scope;
    if (schema == &SCHEMA_VARIABLE && is_in_the_way(search, element, scope))
        search->found = search->name->schema == &SCHEMA_VARIABLE
                            ? "another variable of this entry has this name"
                            : "a variable of this file has this name";
    if (!search->found)
        each_name(search->session, schema, element, search_captured, search);
}

const char *locate_word_conflict(const struct session *session, struct arena *arena,
                                 const struct located_name *name, str text) {
    struct conflict_search search = {.session = session, .name = name, .text = text};
    const struct ir_parameter *parameter = find_parameter(session, text);
    if (str_equal(name->name, text))
        return NULL;
    if (name->schema == &SCHEMA_VARIABLE && parameter &&
        locate_name_place(session, &SCHEMA_PARAMETER, parameter).source == name->definition.source)
        return "a parameter of this file has this name";
    if (name->is_shared)
        return "this text stands for other entries too, through an anchor, where the name is another's";
    locate_walk_scoped(session, arena, search_conflict, &search);
    return search.found;
}
