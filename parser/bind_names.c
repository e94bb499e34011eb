// Names that an element does not have: what may have been meant, and where the name does exist.
#include "parser/bind.h"
#include "parser/mend.h"
#include "parser/say.h"

#include <string.h>

// How a row is spelled at the place of a key of this kind; NULL: not at all, the row has another form there.
static const char *spelling(const struct schema_row *row, enum tree_key kind, bool singular) {
    if (kind == TREE_KEY_CHILD)
        return row->element;
    if (kind == TREE_KEY_ATTRIBUTE)
        return schema_is_attribute(row) ? row->name : NULL;
    if (row->key)
        return NULL;
    return singular && row->single ? row->name : schema_yaml_key(row);
}

static void offer_row(struct mend_search *search, const struct schema_row *row, int id) {
    mend_offer(search, row->name, id);
    if (row->plural)
        mend_offer(search, row->plural, id);
    if (row->element)
        mend_offer(search, row->element, id);
}

// Whether a fix of the key alone makes the file right: an XML element's end tag must not be left behind.
static bool key_stands_alone(struct bind_context *context, tree_index key) {
    if (tree_node(context->tree, key)->key != TREE_KEY_CHILD)
        return true;
    str element = source_text(context->sources, tree_span(context->tree, tree_value(context->tree, key)));
    return element.len >= 2 && element.ptr[element.len - 2] == '/' && element.ptr[element.len - 1] == '>';
}

// The name exists, and has another form in this spelling: a vector as an attribute, a number as an element.
static void wrong_form(struct bind_context *context, struct bind_frame *frame, tree_index key, int id) {
    const struct schema_row *row = &frame->schema->rows[id];
    struct bind_subject subject = {.frame = frame, .row = row, .index = -1};
    tree_index value = tree_value(context->tree, key);
    const struct tree_node *n = tree_node(context->tree, value);
    frame->guessed |= bind_bit((uint32_t)id);
    if ((n->flags | tree_node(context->tree, key)->flags) & TREE_BAD)
        return;
    str found = n->kind == TREE_SCALAR
                    ? arena_format(context->scratch, "'%.*s'",
                                   STR_ARG(say_text(context->scratch, tree_text(context->tree, value))))
                : n->count ? STR("a group of attributes")
                           : STR("an empty group");
    diag_add(context->sink, DIAG_WRONG_SHAPE, tree_span(context->tree, n->kind == TREE_SCALAR ? value : key),
             "%.*s must be %.*s, not %.*s", STR_ARG(say_subject(context->scratch, subject)),
             STR_ARG(say_expected(context->scratch, row)), STR_ARG(found));
    bind_help_shape(context, subject, value);
}

static void did_you_mean(struct bind_context *context, struct bind_frame *frame, tree_index key,
                         const struct mend_search *search) {
    const struct schema_row *row = &frame->schema->rows[search->best_id];
    enum tree_key kind = tree_node(context->tree, key)->key;
    bool singular = str_equal_cstr(search->snake, row->name);
    const char *right = spelling(row, kind, singular);
    frame->guessed |= bind_bit((uint32_t)search->best_id);
    if (!right) {
        diag_help(context->sink, "did you mean %.*s?",
                  STR_ARG(say_example(context->scratch, row, context->tree->is_xml)));
        return;
    }
    str snake = mend_snake(context->scratch, str_from(right));
    bool style_only = str_equal(snake, search->snake);
    if (style_only)
        diag_help(context->sink, "did you mean '%s'? Names are %s here", right,
                  kind == TREE_KEY_CHILD ? "PascalCase" : "snake_case");
    else if (search->distance == 0)
        diag_help(context->sink, "did you mean '%s'? For example %.*s", right,
                  STR_ARG(say_example(context->scratch, row, context->tree->is_xml)));
    else
        diag_help(context->sink, "did you mean '%s'?", right);
    if (key_stands_alone(context, key))
        diag_fix(context->sink, style_only || (search->distance > 0 && mend_is_safe(search)),
                 tree_span(context->tree, key), str_from(right));
}

// The row of another element that has this name, or one a letter off where `near`.
static const struct schema_row *row_elsewhere(struct bind_context *context,
                                              const struct schema_element *element, str snake, bool near) {
    for (uint32_t i = 0; i < element->row_count; i++) {
        struct mend_search search = mend_begin(context->scratch, snake);
        if (!element->rows[i].key)
            offer_row(&search, &element->rows[i], 0);
        if (search.best && search.distance <= (near ? 1 : 0))
            return &element->rows[i];
    }
    return NULL;
}

// Where else the name exists: "'color' belongs to a background or a light"; empty: nowhere, or in many
// places.
static str elsewhere(struct bind_context *context, const struct bind_frame *frame, str snake, bool near) {
    str list = STR("");
    const char *name = NULL;
    unsigned count = 0;
    for (const struct schema_element *const *e = schema_elements; *e; e++) {
        const struct schema_row *row = *e == frame->schema ? NULL : row_elsewhere(context, *e, snake, near);
        if (!row || ++count > 2)
            continue;
        str kind = *e == &SCHEMA_SCENE ? STR("the scene itself") : say_article(context->scratch, (*e)->name);
        list = arena_format(context->scratch, "%.*s%s%.*s", STR_ARG(list), list.len ? " or " : "",
                            STR_ARG(kind));
        name = name ? name : row->name;
    }
    if (count == 0)
        return STR("");
    return arena_format(context->scratch, "'%s' belongs to %.*s%s", name, STR_ARG(list),
                        count > 2 ? " or others" : "");
}

static void list_what_there_is(struct bind_context *context, const struct bind_frame *frame,
                               enum tree_key kind) {
    str list = STR("");
    for (uint32_t i = 0; i < frame->schema->row_count; i++) {
        const struct schema_row *row = &frame->schema->rows[i];
        const char *name = spelling(row, kind, false);
        if (!name)
            name = kind == TREE_KEY_PLAIN ? NULL : row->element ? row->element : row->name;
        if (name)
            list = arena_format(context->scratch, "%.*s%s%s", STR_ARG(list), list.len ? ", " : "", name);
    }
    diag_help(context->sink, "it can have: %.*s", STR_ARG(list));
}

void bind_unknown_name(struct bind_context *context, struct bind_frame *frame, tree_index key) {
    enum tree_key kind = tree_node(context->tree, key)->key;
    str text = tree_text(context->tree, key);
    if (diag_is_full(context->sink)) {
        diag_add(context->sink, DIAG_UNKNOWN_NAME, tree_span(context->tree, key), "unknown name");
        return;
    }
    struct mend_search search = mend_begin(context->scratch, text);
    for (uint32_t i = 0; i < frame->schema->row_count; i++)
        offer_row(&search, &frame->schema->rows[i], (int)i);
    const struct schema_row *near = search.best ? &frame->schema->rows[search.best_id] : NULL;
    bool exact = near && search.distance == 0;
    bool style_is_right = near && (str_equal_cstr(text, near->name) || kind == TREE_KEY_CHILD);
    if (exact && !near->key && !spelling(near, kind, false) && style_is_right) {
        wrong_form(context, frame, key, search.best_id);
        return;
    }
    str other = exact ? STR("") : elsewhere(context, frame, search.snake, false);
    if (!near && other.len == 0 && search.snake.len > 3)
        other = elsewhere(context, frame, search.snake, true);
    diag_add(context->sink, DIAG_UNKNOWN_NAME, tree_span(context->tree, key), "%.*s has no '%.*s'",
             STR_ARG(say_kind(context->scratch, frame)), STR_ARG(say_text(context->scratch, text)));
    if (exact && near->key)
        diag_help(context->sink, frame->via->kind == SCHEMA_REFERENCE ? "written in place it needs no name"
                                                                      : "the key above it is its name");
    else if (near && (search.distance <= 1 || !other.len))
        did_you_mean(context, frame, key, &search);
    else if (other.len)
        diag_help(context->sink, "%.*s", STR_ARG(other));
    else
        list_what_there_is(context, frame, kind);
}
