// Values of parameters, tracks and variables: numbers, expressions or #rrggbb, as a value, or as a list of
// them in YAML. In the list of a variable three of them may stand in a list of their own.
#include "diag/codes/binding.h"
#include "parser/bind/bind.h"
#include "parser/bind/say.h"

#include "core/strbuf.h"
#include "grammar/ir_values.h"

static bool wrong_count(struct bind_context *context, struct bind_subject subject, tree_index node,
                        uint32_t count) {
    diag_add(context->sink, DIAG_WRONG_COUNT, tree_span(context->tree, node),
             "%.*s has %u values; it can have up to %d", STR_ARG(say_subject(context->scratch, subject)),
             count, IR_VALUES_MOST);
    return false;
}

static bool no_values(struct bind_context *context, struct bind_subject subject, tree_index list) {
    diag_add(context->sink, DIAG_EMPTY_TEXT, tree_span(context->tree, list), "%.*s has no value in it",
             STR_ARG(say_subject(context->scratch, subject)));
    return false;
}

static bool empty_value(struct bind_context *context, struct bind_subject subject, tree_index node) {
    diag_add(context->sink, DIAG_EMPTY_TEXT, tree_span(context->tree, node),
             "a value of %.*s is empty; it must be a number or an expression",
             STR_ARG(say_subject(context->scratch, subject)));
    return false;
}

// One value, or several with commas between them. Appends it to `text`.
static bool take_scalar(struct bind_context *context, struct bind_subject subject, tree_index node,
                        struct strbuf *text) {
    str rest = tree_text(context->tree, node);
    str value;
    rest = rest.ptr ? rest : STR("");
    for (str all = rest; ir_values_next(&all, &value);) {
        if (value.len == 0)
            return empty_value(context, subject, node);
        if (!bind_fits(context, value, tree_span(context->tree, node)))
            return false;
    }
    if (text->len)
        strbuf_cstr(text, ", ");
    ir_values_normal(text, rest);
    return true;
}

static bool take_list(struct bind_context *context, struct bind_subject subject, tree_index list,
                      bool may_nest, struct strbuf *text);

static bool not_a_vector(struct bind_context *context, struct bind_subject subject, span at, uint32_t count) {
    diag_add(context->sink, DIAG_WRONG_COUNT, at,
             "a vector among the values of %.*s has %u numbers; it must have 3",
             STR_ARG(say_subject(context->scratch, subject)), count);
    return false;
}

// A vector among the values of a variable.
static bool take_vector(struct bind_context *context, struct bind_subject subject, tree_index list,
                        struct strbuf *text) {
    struct strbuf inside;
    strbuf_init(&inside);
    bool good = take_list(context, subject, list, false, &inside);
    const uint32_t count = ir_values_count(strbuf_view(&inside));
    if (good && count != 3)
        good = not_a_vector(context, subject, tree_span(context->tree, list), count);
    strbuf_format(text, "%s[%.*s]", text->len ? ", " : "", STR_ARG(strbuf_view(&inside)));
    strbuf_finish(&inside);
    return good;
}

// XML writes them in brackets: [0, 0, 1], [2, 0, 1].
static bool vectors_fit(struct bind_context *context, struct bind_subject subject, tree_index node,
                        str text) {
    str value, inside;
    while (ir_values_next(&text, &value))
        if (ir_values_open(value, &inside) && ir_values_count(inside) != 3)
            return not_a_vector(context, subject, tree_span(context->tree, node), ir_values_count(inside));
    return true;
}

static bool take_list(struct bind_context *context, struct bind_subject subject, tree_index list,
                      bool may_nest, struct strbuf *text) {
    bool good = tree_first(context->tree, list) || no_values(context, subject, list);
    for (tree_index item = tree_first(context->tree, list); item; item = tree_next(context->tree, item)) {
        if (bind_is_known(context, item)) {
            good = false;
        } else if (may_nest && bind_kind(context, item) == TREE_LIST) {
            good = take_vector(context, subject, item, text) && good;
        } else if (bind_kind(context, item) != TREE_SCALAR) {
            diag_add(context->sink, DIAG_WRONG_SHAPE, tree_span(context->tree, item),
                     "a value of %.*s must be a number or an expression",
                     STR_ARG(say_subject(context->scratch, subject)));
            good = false;
        } else {
            good = take_scalar(context, subject, item, text) && good;
        }
    }
    return good;
}

bool bind_values(struct bind_context *context, struct bind_subject subject, tree_index node, str *out) {
    struct strbuf text;
    bool good = false;
    if (bind_is_known(context, node))
        return false;
    const enum tree_kind kind = bind_kind(context, node);
    if (kind != TREE_SCALAR && kind != TREE_LIST)
        return bind_wrong_shape(context, subject, node);
    strbuf_init(&text);
    const bool is_list = subject.row->text == SCHEMA_TEXT_LIST;
    good = kind == TREE_LIST ? take_list(context, subject, node, is_list, &text)
                             : take_scalar(context, subject, node, &text);
    const uint32_t count = ir_values_count(strbuf_view(&text));
    if (good && is_list)
        good = vectors_fit(context, subject, node, strbuf_view(&text));
    else if (good && count > IR_VALUES_MOST)
        good = wrong_count(context, subject, node, count);
    if (good)
        *out = arena_copy(context->arena, strbuf_view(&text));
    strbuf_finish(&text);
    return good;
}
