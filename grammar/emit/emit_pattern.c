#include "grammar/emit/emit_pattern.h"

#include "core/arena.h"

enum {
    ELEMENT_BYTES = 1 << 20 // some hundred patterns
};

struct builder {
    struct arena *arena;
    struct pattern spare; // takes what is appended after memory has run out; never printed
    bool failed;
};

static struct pattern *add(struct builder *b, struct pattern *parent, enum pattern_kind kind,
                           const char *name, const char *doc) {
    struct pattern *p = arena_try_alloc(b->arena, sizeof *p);
    if (!p) {
        b->failed = true;
        return &b->spare;
    }
    *p = (struct pattern){.kind = kind, .times = 1, .name = name, .doc = doc};
    if (parent->last)
        parent->last->next = p;
    else
        parent->first = p;
    parent->last = p;
    return p;
}

static struct pattern *wrap(struct builder *b, struct pattern *parent, bool needed, enum pattern_kind kind) {
    return needed ? add(b, parent, kind, NULL, NULL) : parent;
}

// ---- attributes

// A number, or an expression in its place.
static void add_number(struct builder *b, struct pattern *parent, const struct schema_row *row) {
    parent = wrap(b, parent, !row->plain, PATTERN_CHOICE);
    if (!row->plain)
        add(b, parent, PATTERN_TYPE, "expression", NULL);
    add(b, parent, PATTERN_NUMBER, schema_range_info(row->range)->name, NULL);
}

static void add_text(struct builder *b, struct pattern *parent, const struct schema_row *row) {
    const bool is_name = row->text == SCHEMA_TEXT_NAME || row->text == SCHEMA_TEXT_BODY_NAME;
    if (row->text == SCHEMA_TEXT_FREE)
        add(b, parent, PATTERN_TEXT, NULL, NULL);
    else
        add(b, parent, PATTERN_TYPE,
            !is_name                             ? "some_text"
            : row->text == SCHEMA_TEXT_BODY_NAME ? "whole_name"
            : row->counted                       ? "body_name"
                                                 : "name",
            NULL);
}

static void add_values(struct builder *b, struct pattern *parent, const struct schema_row *row) {
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        parent = add(b, parent, PATTERN_CHOICE, NULL, NULL);
        add(b, parent, PATTERN_TYPE, "boolean", NULL);
        add(b, parent, PATTERN_TYPE, "expression", NULL);
        break;
    case SCHEMA_WORD:
        parent = add(b, parent, PATTERN_CHOICE, NULL, NULL);
        for (uint32_t i = 0; row->words[i]; i++)
            add(b, parent, PATTERN_WORD, row->words[i], row->word_docs[i]);
        break;
    case SCHEMA_TEXT:
        add_text(b, parent, row);
        break;
    case SCHEMA_COLOR:
        parent = add(b, parent, PATTERN_CHOICE, NULL, NULL);
        add_number(b, parent, row);
        add(b, parent, PATTERN_TYPE, "hex_color", NULL);
        break;
    case SCHEMA_ELEMENT:
        add_values(b, parent, &row->child->rows[schema_short_row(row->child)]);
        break;
    case SCHEMA_REFERENCE:
        add(b, parent, PATTERN_TYPE, "some_text", NULL);
        break;
    default:
        add_number(b, parent, row);
        break;
    }
}

static void add_attribute(struct builder *b, struct pattern *parent, const struct schema_row *row) {
    add_values(b, add(b, parent, PATTERN_ATTRIBUTE, row->name, row->doc), row);
}

static void add_hex(struct builder *b, struct pattern *parent) {
    parent = add(b, parent, PATTERN_CHOICE, NULL, NULL);
    add(b, parent, PATTERN_TYPE, "hex_color", NULL);
    add(b, parent, PATTERN_TYPE, "expression", NULL);
}

static void add_components(struct builder *b, struct pattern *parent, const struct schema_row *row) {
    const char *const *names = schema_components(row->kind);
    parent = wrap(b, parent, row->kind == SCHEMA_COLOR, PATTERN_CHOICE);
    struct pattern *group = add(b, parent, PATTERN_GROUP, NULL, NULL);
    for (uint32_t i = 0; names[i]; i++) {
        struct pattern *at = wrap(b, group, row->kind == SCHEMA_WEIGHTS, PATTERN_OPTIONAL);
        add_number(b, add(b, at, PATTERN_ATTRIBUTE, names[i], NULL), row);
    }
    if (row->kind == SCHEMA_COLOR)
        add_hex(b, add(b, parent, PATTERN_ATTRIBUTE, SCHEMA_HEX_ATTRIBUTE, NULL));
}

// ---- elements

// The contents of the element of a row with a child: its rows, or only the components of its short row.
static void add_content(struct builder *b, struct pattern *parent, const struct schema_row *row) {
    const int only = schema_short_row(row->child);
    const int key = row->many == SCHEMA_NAMED_MAP ? schema_key_row(row->child) : -1;
    const bool has_components = only >= 0 && schema_components(row->child->rows[only].kind)[0];
    struct pattern *at = wrap(b, parent, has_components, PATTERN_CHOICE);
    add(b, at, PATTERN_CONTENT, row->child->name, NULL);
    if (has_components)
        add_components(b, at, &row->child->rows[only]);
    if (key >= 0)
        add_attribute(b, wrap(b, parent, row->single, PATTERN_OPTIONAL), &row->child->rows[key]);
}

static void add_element(struct builder *b, struct pattern *parent, const struct schema_row *row) {
    struct pattern *element = add(b, parent, PATTERN_ELEMENT, row->element, row->doc);
    if (row->child)
        add_content(b, element, row);
    else
        add_components(b, element, row);
}

static void add_row(struct builder *b, struct pattern *parent, const struct schema_row *row) {
    const bool is_attribute = schema_is_attribute(row);
    if (row->kind == SCHEMA_LIST) {
        add_element(b, add(b, parent, PATTERN_MANY, NULL, NULL), row);
        return;
    }
    if (row->many == SCHEMA_FIXED) {
        parent = add(b, parent, PATTERN_GROUP, NULL, NULL);
        parent->times = row->fixed_count;
    }
    const bool is_whole =
        row->kind == SCHEMA_VECTOR && row->many == SCHEMA_ONE && !is_attribute && !row->plain;
    parent = wrap(b, parent, (is_attribute || is_whole) && row->element, PATTERN_CHOICE);
    if (is_attribute)
        add_attribute(b, parent, row);
    if (is_whole)
        add(b, add(b, parent, PATTERN_ATTRIBUTE, row->name, NULL), PATTERN_TYPE, "expression", NULL);
    if (row->element)
        add_element(b, parent, row);
}

static void add_choice(struct builder *b, struct pattern *parent, const struct schema_element *schema,
                       uint8_t choice) {
    const bool may_lack = schema->choices[choice - 1].rule == SCHEMA_CHOICE_AT_MOST_ONE;
    parent = add(b, wrap(b, parent, may_lack, PATTERN_OPTIONAL), PATTERN_CHOICE, NULL, NULL);
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (schema->rows[i].choice == choice)
            add_row(b, parent, &schema->rows[i]);
}

static bool is_first_of_choice(const struct schema_element *schema, uint32_t i) {
    for (uint32_t k = 0; k < i; k++)
        if (schema->rows[k].choice == schema->rows[i].choice)
            return false;
    return true;
}

static void add_rows(struct builder *b, struct pattern *parent, const struct schema_element *schema) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const bool may_lack = !row->required && row->kind != SCHEMA_LIST;
        // An element of a list has a key; an element in place has none.
        if (row->key)
            continue;
        if (!row->choice)
            add_row(b, wrap(b, parent, may_lack, PATTERN_OPTIONAL), row);
        else if (is_first_of_choice(schema, i))
            add_choice(b, parent, schema, row->choice);
    }
}

void emit_patterns(struct emit_lines *w, emit_pattern_print *print) {
    struct arena arena;
    arena_init(&arena, ELEMENT_BYTES);
    for (const struct schema_element *const *e = schema_elements; *e; e++) {
        struct builder builder = {.arena = &arena};
        struct pattern pattern = {.kind = PATTERN_INTERLEAVE, .times = 1};
        add_rows(&builder, &pattern, *e);
        if (builder.failed)
            w->out->failed = true;
        else
            print(w, *e, &pattern);
        arena_reset(&arena);
    }
    arena_finish(&arena);
}
