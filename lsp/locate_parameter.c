#include "lsp/locate.h"

#include "core/expression.h"
#include "grammar/ir_formula.h"
#include "grammar/ir_walk.h"

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

static void look_at_part(struct hunt *hunt, span at) {
    const str text = source_text(&hunt->session->sources, at);
    size_t end = 0;
    str name;
    while (expression_next_name(text, &end, &name)) {
        const span word = {at.source, at.begin + (uint32_t)(end - name.len), at.begin + (uint32_t)end};
        if (hunt->name.len && str_equal(name, hunt->name))
            *ARENA_PUSH(hunt->arena, &hunt->out->uses) = word;
        else if (!hunt->name.len && word.begin <= hunt->offset && hunt->offset <= word.end)
            hunt->word = word;
    }
}

// In an element of XML expressions are between quotes.
static void look_at(void *context, span at) {
    struct hunt *hunt = context;
    const str text = source_text(&hunt->session->sources, at);
    size_t begin = 0;
    if (text.len == 0 || text.ptr[0] != '<') {
        look_at_part(hunt, at);
        return;
    }
    for (size_t i = 0; i < text.len; i++) {
        const bool is_open = begin > 0;
        if (is_open && text.ptr[i] == text.ptr[begin - 1]) {
            look_at_part(hunt, (span){at.source, at.begin + (uint32_t)begin, at.begin + (uint32_t)i});
            begin = 0;
        } else if (!is_open && (text.ptr[i] == '"' || text.ptr[i] == '\'')) {
            begin = i + 1;
        }
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
