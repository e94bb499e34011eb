// Names in expressions: parameters of the scene, of the object that the expression is in, and variables of
// its entry.
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
    struct located_scope scope; // where it is written; of a parameter of the scene nothing
};

static const struct ir_parameter *find_parameter(const struct ir_parameters *parameters, str name) {
    for (uint32_t i = 0; parameters && i < parameters->count; i++)
        if (name.len && str_equal(parameters->items[i].name, name))
            return &parameters->items[i];
    return NULL;
}

static const struct ir_parameters *arguments_of(const struct ir_object *object) {
    return object ? &object->parameters : NULL;
}

static const struct ir_variable *find_variable(const struct located_scope *scope, str name) {
    const struct ir_variables variables = locate_variables(scope);
    for (uint32_t i = 0; i < variables.count && i < scope->reach; i++)
        if (name.len && str_equal(variables.items[i].name, name))
            return &variables.items[i];
    return NULL;
}

// All that an entry or object adds to what is around it.
static struct meaning meaning_here(const struct located_scope *scope, str name) {
    const struct ir_variable *variable = find_variable(scope, name);
    const struct ir_parameter *parameter =
        variable ? NULL : find_parameter(arguments_of(scope->object), name);
    struct meaning meaning = {.scope = *scope};
    meaning.scope.reach = UINT32_MAX;
    if (variable) {
        meaning.schema = &SCHEMA_VARIABLE;
        meaning.element = variable;
    } else if (parameter) {
        meaning.schema = &SCHEMA_PARAMETER;
        meaning.element = parameter;
        meaning.scope.list = NULL;
    }
    return meaning;
}

static struct meaning meaning_of(const struct session *session, const struct located_scope *scope, str name) {
    for (const struct located_scope *at = scope; at; at = at->around) {
        const struct meaning meaning = meaning_here(at, name);
        if (meaning.element)
            return meaning;
    }
    const struct ir_parameter *parameter = find_parameter(&locate_scene(session)->parameters, name);
    return (struct meaning){.schema = parameter ? &SCHEMA_PARAMETER : NULL, .element = parameter};
}

// The parameter of its object that an instance gives a value.
static struct meaning meaning_given(const struct session *session, const struct located_scope *scope,
                                    str name) {
    const struct ir_object *object =
        scope->list && scope->list->child == &SCHEMA_INSTANCE ? locate_shown(session, scope->entry) : NULL;
    // An object in place takes no values.
    const struct located_scope inside = {.reach = UINT32_MAX,
                                         .object = object && object->name.len ? object : NULL};
    return meaning_here(&inside, name);
}

// Entries that share their variables through an anchor have the same ones, objects their parameters.
static bool is_same(const struct session *session, struct meaning meaning, const struct located_name *name) {
    return meaning.element && meaning.schema == name->schema &&
           (meaning.element == name->element ||
            span_equal(locate_name_place(session, meaning.schema, meaning.element), name->definition));
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

static bool take_meaning(struct meaning meaning, span here, struct located_name *out) {
    out->schema = meaning.schema;
    out->element = meaning.element;
    out->scope = meaning.scope;
    out->here = here;
    return meaning.element != NULL;
}

bool locate_word(const struct session *session, const struct located *at, struct arena *arena,
                 struct located_name *out) {
    struct word_search search = {at->offset, SPAN_NONE};
    struct located_scope scope;
    struct meaning meaning = {0};
    if (!at->schema || !locate_scene(session))
        return false;
    if (at->schema == &SCHEMA_WITH &&
        span_equal(at->at, locate_name_place(session, at->schema, at->element))) {
        scope = locate_scope(session, at->element, arena);
        meaning = meaning_given(session, &scope, ir_walk_key(at->schema, at->element));
        return take_meaning(meaning, at->at, out);
    }
    if (!at->row || !at->in_value)
        return false;
    each_name(session, at->schema, at->element, search_word, &search);
    if (span_is_none(search.word) || search.word.source != at->at.source)
        return false;
    scope = locate_scope(session, at->element, arena);
    meaning = meaning_of(session, &scope, source_text(&session->sources, search.word));
    return take_meaning(meaning, search.word, out);
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

static void note_use(struct use_search *search, struct meaning meaning, span place) {
    if (is_same(search->session, meaning, search->name))
        *ARENA_PUSH(search->arena, &search->name->uses) = place;
    else if (meaning.element)
        *ARENA_PUSH(search->arena, &search->others) = place;
}

static void search_use(void *context, span word) {
    struct use_search *search = context;
    const str text = source_text(&search->session->sources, word);
    if (str_equal(text, search->name->name))
        note_use(search, meaning_of(search->session, search->scope, text), word);
}

static void search_uses(void *context, const struct schema_element *schema, const void *element,
                        const struct located_scope *scope) {
    struct use_search *search = context;
    search->scope = scope;
    if (schema == &SCHEMA_WITH && str_equal(ir_walk_key(schema, element), search->name->name))
        note_use(search, meaning_given(search->session, scope, search->name->name),
                 locate_name_place(search->session, schema, element));
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
    const char *in_the_way; // a variable or parameter
    const char *captured;   // an expression that would mean something else
};

static bool is_argument(const struct conflict_search *search) {
    return locate_is_argument(search->name->schema, &search->name->scope);
}

// Whether the name is one of those that an entry or object adds.
static bool is_of(const struct conflict_search *search, const struct located_scope *scope) {
    return is_same(search->session, meaning_here(scope, search->name->name), search->name);
}

// What has the new name already, and is met before the old one, or where that is: from there out it would be
// hidden.
static struct meaning meaning_before(const struct conflict_search *search, bool *hides) {
    for (const struct located_scope *at = search->scope; at; at = at->around) {
        const struct meaning meaning = meaning_here(at, search->text);
        *hides = is_of(search, at);
        if (*hides || meaning.element)
            return meaning;
    }
    return (struct meaning){0};
}

static void search_captured(void *context, span word) {
    struct conflict_search *search = context;
    const str text = source_text(&search->session->sources, word);
    bool hides = false;
    if (str_equal(text, search->text)) {
        meaning_before(search, &hides);
        if (hides && meaning_of(search->session, search->scope, text).element)
            search->captured = is_argument(search)
                                   ? "an expression of this object uses something else with this name"
                                   : "an expression of this entry uses something else with this name";
    } else if (str_equal(text, search->name->name) &&
               is_same(search->session, meaning_of(search->session, search->scope, text), search->name)) {
        const struct meaning nearer = meaning_before(search, &hides);
        if (!hides && nearer.element)
            search->captured = nearer.schema == &SCHEMA_VARIABLE
                                   ? "a variable of an entry that uses it has this name"
                                   : "a parameter of an object that uses it has this name";
    }
}

// Whether a variable, or a parameter of an object, with the new name is where a variable or parameter of an
// object cannot have it too.
static const char *in_the_way(const struct conflict_search *search, struct meaning other) {
    for (const struct located_scope *at = &other.scope; at; at = at->around)
        if (is_of(search, at) && at != &other.scope)
            return "something in place in it has this name";
        else if (is_of(search, at))
            return other.schema != search->name->schema ? "something in reach has this name"
                   : is_argument(search)                ? "another parameter of this object has this name"
                                                        : "another variable of this entry has this name";
    for (const struct located_scope *at = &search->name->scope; at; at = at->around)
        if (meaning_here(at, search->text).element == other.element)
            return "something around it has this name";
    return NULL;
}

static void search_conflict(void *context, const struct schema_element *schema, const void *element,
                            const struct located_scope *scope) {
    struct conflict_search *search = context;
    const bool is_scenes = search->name->schema == &SCHEMA_PARAMETER && !is_argument(search);
    search->scope = scope;
    if ((schema == &SCHEMA_VARIABLE || locate_is_argument(schema, scope)) &&
        str_equal(ir_walk_key(schema, element), search->text)) {
        struct meaning other = {schema, element, *scope};
        other.scope.reach = UINT32_MAX;
        if (!is_scenes)
            search->in_the_way = in_the_way(search, other);
        else if (schema == &SCHEMA_VARIABLE && // an object's parameter may hide the scene's
                 locate_name_place(search->session, schema, element).source ==
                     search->name->definition.source)
            search->in_the_way = "a variable of this file has this name";
    }
    if (!search->in_the_way && !search->captured)
        each_name(search->session, schema, element, search_captured, search);
}

static void search_first_conflict(void *context, const struct schema_element *schema, const void *element,
                                  const struct located_scope *scope) {
    const struct conflict_search *search = context;
    if (!search->in_the_way)
        search_conflict(context, schema, element, scope);
}

const char *locate_word_conflict(const struct session *session, struct arena *arena,
                                 const struct located_name *name, str text) {
    struct conflict_search search = {.session = session, .name = name, .text = text};
    const struct ir_parameter *parameter = find_parameter(&locate_scene(session)->parameters, text);
    if (str_equal(name->name, text))
        return NULL;
    if (name->schema == &SCHEMA_VARIABLE && parameter &&
        locate_name_place(session, &SCHEMA_PARAMETER, parameter).source == name->definition.source)
        return "a parameter of this file has this name";
    if (name->is_shared)
        return "this text stands for other entries too, through an anchor, where the name is another's";
    locate_walk_scoped(session, arena, search_first_conflict, &search);
    return search.in_the_way ? search.in_the_way : search.captured;
}
