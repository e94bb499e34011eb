// What must be known before a row is bound: which row a key names, where it is, whether it is given twice.
#include "core/expression.h"
#include "diag/codes/binding.h"
#include "parser/bind/bind.h"
#include "parser/bind/say.h"

int bind_find_row(const struct bind_context *context, const struct schema_element *schema, tree_index key,
                  bool *is_single) {
    static const enum schema_name_kind kinds[] = {[TREE_KEY_PLAIN] = SCHEMA_NAME_KEY,
                                                  [TREE_KEY_ATTRIBUTE] = SCHEMA_NAME_ATTRIBUTE,
                                                  [TREE_KEY_CHILD] = SCHEMA_NAME_CHILD};
    enum schema_name_kind kind = kinds[tree_node(context->tree, key)->key];
    const str name = tree_text(context->tree, key);
    const int row = schema_index_find(context->index, schema, kind, name, is_single);
    if (row >= 0 || kind != SCHEMA_NAME_ATTRIBUTE)
        return row;
    // A whole vector, computed, is an attribute.
    const int whole = schema_find_row(schema, name);
    *is_single = false;
    return whole >= 0 && schema->rows[whole].kind == SCHEMA_VECTOR &&
                   schema->rows[whole].many == SCHEMA_ONE &&
                   expression_is_meant(tree_text(context->tree, tree_value(context->tree, key)))
               ? whole
               : -1;
}

struct bind_given bind_given_by(const struct bind_context *context, tree_index key) {
    return (struct bind_given){.key = key,
                               .key_span = tree_span(context->tree, key),
                               .comments = tree_comments(context->tree, key),
                               .value = tree_value(context->tree, key)};
}

void bind_note_row(struct bind_context *context, struct bind_frame *frame, uint32_t row,
                   struct bind_given given) {
    const uint32_t comments = ir_origin_add_comments(context->origin, given.comments);
    ir_origin_add_row(context->origin, bind_head(frame)->origin,
                      (struct ir_row_origin){.row = row,
                                             .key = given.key_span,
                                             .value = tree_span(context->tree, given.value),
                                             .comments = comments});
    frame->seen |= bind_bit(row);
}

// 'camera' next to 'cameras': the two forms of one row.
static bool report_both_forms(struct bind_context *context, const struct schema_row *row,
                              const struct ir_row_origin *first, struct bind_given given) {
    str before = first ? source_text(context->sources, first->key) : STR("");
    if (before.len > 2 && (before.ptr[0] == '"' || before.ptr[0] == '\''))
        before = str_slice(before, 1, before.len - 1);
    if (!row->single || context->tree->is_xml || before.len == 0 || !given.key ||
        str_equal(before, tree_text(context->tree, given.key)))
        return false;
    diag_add(context->sink, DIAG_GIVEN_TWICE, given.key_span, "both '%s' and '%s' are given", row->name,
             row->plural);
    diag_note(context->sink, first->key, "'%.*s' is here", STR_ARG(before));
    diag_help(context->sink, "'%s: {...}' is short for '%s: {%s: {...}}'; write all of them there", row->name,
              row->plural, row->single);
    return true;
}

void bind_report_twice(struct bind_context *context, struct bind_frame *frame, uint32_t row,
                       struct bind_given given) {
    const struct schema_row *r = &frame->schema->rows[row];
    const struct ir_row_origin *first = ir_origin_row(context->origin, bind_head(frame), row);
    if (report_both_forms(context, r, first, given))
        return;
    str s = say_subject(context->scratch, bind_subject(frame, r));
    diag_add(context->sink, DIAG_GIVEN_TWICE, given.key_span, "%.*s is given twice", STR_ARG(s));
    if (first)
        diag_note(context->sink, first->key, "first given here");
    diag_help(context->sink, "remove one of the two");
}

struct bind_frame bind_aside(struct bind_context *context, const struct bind_frame *frame) {
    struct bind_frame aside = *frame;
    aside.seen = 0;
    aside.memory = arena_alloc(context->scratch, frame->schema->size);
    schema_index_defaults(context->index, frame->schema, aside.memory);
    bind_head(&aside)->origin =
        ir_origin_add(context->origin, (struct ir_element_origin){.label = frame->label});
    return aside;
}

str bind_copy_once(struct bind_context *context, str text) {
    // Names that belong together differ in their last letters.
    uint32_t end = (uint32_t)text.len;
    for (size_t i = text.len > 3 ? text.len - 3 : 0; i < text.len; i++)
        end = end * 31 + (unsigned char)text.ptr[i];
    str *known = &context->texts->items[(end ^ end >> 8) % BIND_TEXTS];
    if (!str_equal(*known, text))
        *known = arena_copy(context->arena, text);
    return *known;
}
