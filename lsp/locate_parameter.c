#include "lsp/locate.h"

#include "core/expression.h"
#include "grammar/ir_formula.h"
#include "grammar/ir_walk.h"

// ---- names in a text

struct words {
    str text;
    size_t at;
    bool in_tag; // an element of XML: expressions are between quotes
    char quote;  // that is open
};

// The next word that can be a parameter's name: no function, no component, no part of #rrggbb.
static bool next_word(struct words *words, size_t *begin, size_t *end) {
    const str text = words->text;
    while (words->at < text.len) {
        const char c = text.ptr[words->at];
        const size_t length = expression_name_length(str_slice(text, words->at, text.len));
        const char before = words->at > 0 ? text.ptr[words->at - 1] : ' ';
        *begin = words->at;
        *end = words->at + length;
        words->at += length ? length : 1;
        if (words->in_tag && (c == '"' || c == '\''))
            words->quote = words->quote == c ? 0 : words->quote ? words->quote : c;
        if (!length || (words->in_tag && !words->quote))
            continue;
        const bool is_part = before == '.' || before == '#' || (before >= '0' && before <= '9');
        if (!is_part && (*end == text.len || text.ptr[*end] != '('))
            return true;
    }
    return false;
}

// ---- the expressions of an element

typedef void visit_text(void *context, span at);

static void each_expression(const struct session *session, const struct schema_element *schema,
                            const void *element, visit_text *visit, void *context) {
    const struct ir_formulas *formulas = session->origin.formulas;
    const struct ir_head *head = ir_walk_head(element);
    for (uint32_t i = formulas ? head->formulas : 0; i; i = formulas->items[i].next)
        visit(context, formulas->items[i].at);
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct ir_row_origin *row = ir_origin_row(&session->origin, head, i);
        if (row && schema->rows[i].kind == SCHEMA_TEXT && schema->rows[i].text == SCHEMA_TEXT_VALUES)
            visit(context, row->value);
    }
}

struct hunt {
    struct session *session;
    size_t offset;
    str name; // whose uses are noted; empty: the word at `offset` is wanted
    struct arena *arena;
    struct located_name *out;
    span word;
};

static void look_at(void *context, span at) {
    struct hunt *hunt = context;
    const str text = source_text(&hunt->session->sources, at);
    struct words words = {.text = text, .in_tag = text.len && text.ptr[0] == '<'};
    size_t begin, end;
    while (next_word(&words, &begin, &end)) {
        const span word = {at.source, at.begin + (uint32_t)begin, at.begin + (uint32_t)end};
        if (hunt->name.len && str_equal(str_slice(text, begin, end), hunt->name))
            *ARENA_PUSH(hunt->arena, &hunt->out->uses) = word;
        else if (!hunt->name.len && word.begin <= hunt->offset && hunt->offset <= word.end)
            hunt->word = word;
    }
}

static void look_at_element(void *context, const struct schema_element *schema, const void *element) {
    const struct hunt *hunt = context;
    each_expression(hunt->session, schema, element, look_at, context);
}

// ---- parameters

static const struct ir_parameter *find(const struct session *session, str name) {
    const struct ir_parameters *parameters = &session->scene->parameters;
    for (uint32_t i = 0; i < parameters->count; i++)
        if (name.len && str_equal(parameters->items[i].name, name))
            return &parameters->items[i];
    return NULL;
}

const struct ir_parameter *locate_parameter(struct session *session, const struct located *at, span *word) {
    struct hunt hunt = {.session = session, .offset = at->offset, .word = SPAN_NONE};
    if (!at->schema || !at->row || !at->in_value)
        return NULL;
    look_at_element(&hunt, at->schema, at->element);
    *word = hunt.word;
    return span_is_none(hunt.word) || hunt.word.source != at->at.source
               ? NULL
               : find(session, source_text(&session->sources, hunt.word));
}

void locate_parameter_uses(struct session *session, const struct ir_parameter *parameter, struct arena *arena,
                           struct located_name *out) {
    struct hunt hunt = {.session = session, .name = parameter->name, .arena = arena, .out = out};
    locate_walk(&SCHEMA_SCENE, session->scene, look_at_element, &hunt);
}
