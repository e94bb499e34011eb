// Values of a track: one to four numbers, expressions or #rrggbb, as a value, or as a list of them in YAML.
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
    for (str all = rest; ir_values_next(&all, &value);)
        if (value.len == 0)
            return empty_value(context, subject, node);
    if (text->len)
        strbuf_cstr(text, ", ");
    ir_values_normal(text, rest);
    return true;
}

static bool take_list(struct bind_context *context, struct bind_subject subject, tree_index list,
                      struct strbuf *text) {
    bool good = tree_first(context->tree, list) || empty_value(context, subject, list);
    for (tree_index item = tree_first(context->tree, list); item; item = tree_next(context->tree, item)) {
        if (bind_is_known(context, item)) {
            good = false;
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
    good = kind == TREE_LIST ? take_list(context, subject, node, &text)
                             : take_scalar(context, subject, node, &text);
    const uint32_t count = ir_values_count(strbuf_view(&text));
    if (good && count > IR_VALUES_MOST)
        good = wrong_count(context, subject, node, count);
    if (good)
        *out = arena_copy(context->arena, strbuf_view(&text));
    strbuf_finish(&text);
    return good;
}
