// Values that are computed: expressions are kept as text, and told apart from numbers with a mistake in them.
#include "core/expression.h"
#include "diag/codes/binding.h"
#include "grammar/ir_formula.h"
#include "parser/bind/bind.h"
#include "parser/bind/say.h"
#include "parser/tree/reader_text.h"

#include <string.h>

bool bind_fits(const struct bind_context *context, str text, span at) {
    if (text.len <= context->limits->value[LIMIT_EXPRESSION_BYTES])
        return true;
    reader_limit_needs(context->sink, context->limits, LIMIT_EXPRESSION_BYTES,
                       (span){at.source, at.begin, at.begin + 1}, "bytes in one expression",
                       (double)text.len);
    return false;
}

static void add(struct bind_context *context, struct bind_subject subject, str text, span at) {
    if (!bind_fits(context, text, at)) {
        bind_head(subject.frame)->poisoned |= bind_bit((uint32_t)(subject.row - subject.frame->schema->rows));
        return;
    }
    const char *const *names = schema_components(subject.row->kind);
    int component = IR_FORMULA_WHOLE;
    for (int i = 0; subject.component && names[i]; i++)
        if (strcmp(names[i], subject.component) == 0)
            component = i;
    ir_formula_add(context->origin->arena, context->origin->formulas, bind_head(subject.frame),
                   (struct ir_formula){.row = subject.row,
                                       .slot = subject.index,
                                       .component = component,
                                       .text = arena_copy(context->arena, text),
                                       .at = at});
}

bool bind_formula(struct bind_context *context, struct bind_subject subject, tree_index node) {
    const str text = str_trim(tree_text(context->tree, node));
    if (context->plain || !schema_may_compute(subject.row) || !expression_is_meant(text))
        return false;
    add(context, subject, text, tree_span(context->tree, node));
    return true;
}

// ---- cut at commas

static int depth_after(str text, int depth) {
    for (size_t i = 0; i < text.len && depth >= 0; i++)
        depth += (text.ptr[i] == '(') - (text.ptr[i] == ')');
    return depth;
}

static bool is_plain_scalar(const struct bind_context *context, tree_index node) {
    return bind_kind(context, node) == TREE_SCALAR && tree_node(context->tree, node)->style == TREE_PLAIN &&
           !bind_is_bad(context, node);
}

tree_index bind_torn_item(struct bind_context *context, struct bind_subject subject, tree_index item) {
    const struct tree *tree = context->tree;
    if (tree->is_xml || context->plain || !schema_may_compute(subject.row) || !is_plain_scalar(context, item))
        return 0;
    tree_index last = item;
    int depth = depth_after(tree_text(tree, item), 0);
    while (depth > 0) {
        last = tree_next(tree, last);
        if (!last || !is_plain_scalar(context, last))
            return 0;
        depth = depth_after(tree_text(tree, last), depth);
    }
    const span at = {tree->source, tree_span(tree, item).begin, tree_span(tree, last).end};
    const str written = source_text(context->sources, at);
    if (last == item || depth < 0 || !expression_is_meant(written))
        return 0;
    add(context, subject, written, at);
    return last;
}

bool bind_torn_pair(struct bind_context *context, struct bind_frame *frame, uint32_t row, tree_index map,
                    tree_index key) {
    const struct tree *tree = context->tree;
    const tree_index value = tree_value(tree, key);
    if (tree->is_xml || tree_node(tree, map)->style != TREE_FLOW || !is_plain_scalar(context, value))
        return false;
    int depth = depth_after(tree_text(tree, value), 0);
    tree_index last = key;
    while (depth > 0) {
        last = tree_next_key(tree, last);
        if (!last || bind_kind(context, tree_value(tree, last)) != TREE_NULL)
            return false;
        depth = depth_after(tree_text(tree, last), depth);
    }
    const span at = {tree->source, tree_span(tree, value).begin, tree_span(tree, last).end};
    const str written = source_text(context->sources, at);
    if (last == key || depth != 0 || !expression_is_meant(written))
        return false;
    diag_add(context->sink, DIAG_TORN, at, "YAML ends this value of %.*s at its comma",
             STR_ARG(say_subject(context->scratch, bind_subject(frame, &frame->schema->rows[row]))));
    diag_help(context->sink, "in { }, a value with a comma needs quotes: \"%.*s\"", STR_ARG(written));
    diag_fix(context->sink, true, at, arena_format(context->scratch, "\"%.*s\"", STR_ARG(written)));
    for (tree_index next = key; next; next = tree_next_key(tree, next)) {
        tree_node(tree, next)->flags |= TREE_BAD;
        if (next == last)
            break;
    }
    return true;
}
