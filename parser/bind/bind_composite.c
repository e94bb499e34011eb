// Values of several components: vectors, colours, weights; as a list, by name, or as one number or #rrggbb.
// All others are in bind_scalar.c.
#include "diag/codes/binding.h"
#include "parser/bind/bind.h"
#include "parser/bind/say.h"
#include "parser/tree/mend.h"

#include "core/expression.h"
#include "core/number.h"
#include "core/vec3.h"

#include <string.h>

enum {
    COMPONENTS_MAX = 4
};

static struct bind_subject component_of(struct bind_subject subject, uint32_t i) {
    subject.component = schema_components(subject.row->kind)[i];
    return subject;
}

// Whether an item is more or less than one number, so that its list is longer or shorter than it seems.
static bool is_several(const struct bind_context *context, tree_index item) {
    enum tree_kind kind = bind_kind(context, item);
    return kind == TREE_LIST || kind == TREE_MAP || bind_is_bad(context, item) ||
           (kind == TREE_SCALAR && mend_is_numbers(tree_text(context->tree, item)));
}

// Red, green, blue, and the values that other programs write after them.
static void help_without_alpha(struct bind_context *context, tree_index node) {
    tree_index r = tree_first(context->tree, node);
    tree_index g = tree_next(context->tree, r), b = tree_next(context->tree, g);
    str list = arena_format(context->scratch, "[%.*s, %.*s, %.*s]", STR_ARG(tree_text(context->tree, r)),
                            STR_ARG(tree_text(context->tree, g)), STR_ARG(tree_text(context->tree, b)));
    diag_help(context->sink, "colours have no alpha: write %.*s", STR_ARG(list));
    diag_fix(context->sink, false, tree_span(context->tree, node), list);
}

static uint32_t items_between(const struct bind_context *context, tree_index first, tree_index last) {
    uint32_t count = 0;
    for (; first != last; first = tree_next(context->tree, first))
        count++;
    return count;
}

static bool bind_list(struct bind_context *context, struct bind_subject subject, tree_index node,
                      double out[COMPONENTS_MAX]) {
    uint32_t wanted = schema_component_count(subject.row->kind);
    uint32_t count = tree_node(context->tree, node)->count;
    bool good = true;
    bool counts = true;
    uint32_t i = 0;
    for (tree_index item = tree_first(context->tree, node); item;
         item = tree_next(context->tree, item), i++) {
        double beyond;
        struct bind_subject of = i < wanted ? component_of(subject, i) : subject;
        const tree_index torn = i < wanted ? bind_torn_item(context, of, item) : 0;
        if (torn) {
            out[i] = 0;
            count -= items_between(context, item, torn);
            item = torn;
            continue;
        }
        bool is_good = bind_number(context, of, item, i < wanted ? &out[i] : &beyond);
        good = is_good && good;
        if (is_good || !is_several(context, item))
            continue;
        counts = false;
        if (!bind_is_known(context, item))
            bind_help_numbers(context, subject, node);
    }
    if (count == wanted)
        return good;
    if (bind_is_known(context, node) || !counts)
        return false;
    const char *const *names = schema_components(subject.row->kind);
    str list = STR("");
    for (i = 0; i < wanted; i++)
        list = arena_format(context->scratch, "%.*s%s%s", STR_ARG(list), i ? ", " : "", names[i]);
    diag_add(context->sink, DIAG_WRONG_COUNT, tree_span(context->tree, node),
             "%.*s has %u number%s; it needs %u: %.*s", STR_ARG(say_subject(context->scratch, subject)),
             count, count == 1 ? "" : "s", wanted, STR_ARG(list));
    if (subject.row->kind != SCHEMA_COLOR || count != 4 || !good)
        bind_help_example(context, subject);
    else
        help_without_alpha(context, node);
    return false;
}

static int find_component(const char *const *names, uint32_t count, str key) {
    for (uint32_t i = 0; i < count && key.len; i++)
        if (key.ptr[0] == names[i][0] && str_equal_cstr(key, names[i]))
            return (int)i;
    return -1;
}

static void unknown_component(struct bind_context *context, struct bind_subject subject, tree_index key) {
    const char *const *names = schema_components(subject.row->kind);
    str text = tree_text(context->tree, key);
    struct mend_search search = mend_begin(context->sink, context->scratch, text);
    str list = STR("");
    for (int i = 0; names[i]; i++) {
        mend_offer(&search, names[i], i);
        list = arena_format(context->scratch, "%.*s%s'%s'", STR_ARG(list), i ? ", " : "", names[i]);
    }
    span at = tree_span(context->tree, key);
    diag_add(context->sink, DIAG_UNKNOWN_NAME, at, "%.*s has no '%.*s'; it has %.*s",
             STR_ARG(say_subject(context->scratch, subject)), STR_ARG(say_text(context->scratch, text)),
             STR_ARG(list));
    if (!search.best)
        return;
    diag_help(context->sink, "did you mean '%s'?", search.best);
    diag_fix(context->sink, mend_is_safe(&search), at, str_from(search.best));
}

static bool takes_zero(struct bind_subject subject) {
    return schema_in_range(subject.row->range, 0);
}

// The given components, with 0 for the rest (1 if 0 is not allowed), in the spelling of the file.
static void help_with_rest(struct bind_context *context, struct bind_subject subject, tree_index node) {
    const struct tree *tree = context->tree;
    const char *const *names = schema_components(subject.row->kind);
    const str rest = takes_zero(subject) ? STR("0") : STR("1");
    str list = STR("");
    for (uint32_t i = 0; names[i]; i++) {
        str value = rest;
        for (tree_index key = tree_first(tree, node); key; key = tree_next_key(tree, key))
            if (str_equal_cstr(tree_text(tree, key), names[i]))
                value = tree_text(tree, tree_value(tree, key));
        list = arena_format(context->scratch, "%.*s%s%.*s", STR_ARG(list), i ? ", " : "", STR_ARG(value));
    }
    str all = context->tree->is_xml ? say_components(context->scratch, subject, list)
                                    : arena_format(context->scratch, "[%.*s]", STR_ARG(list));
    diag_help(context->sink, "with %.*s for the rest: %.*s", STR_ARG(rest),
              STR_ARG(say_text(context->scratch, all)));
    // The missing number may be another one, so this is a suggestion. A comment inside would be lost.
    str written = source_text(context->sources, tree_span(tree, node));
    bool has_comment = written.len && memchr(written.ptr, tree->is_xml ? '!' : '#', written.len);
    if (!has_comment)
        diag_fix(context->sink, false, tree_span(tree, node), all);
}

static bool report_missing(struct bind_context *context, struct bind_subject subject, tree_index node,
                           const bool given[COMPONENTS_MAX], bool numbers_are_good) {
    const char *const *names = schema_components(subject.row->kind);
    str list = STR("");
    for (uint32_t i = 0; names[i]; i++)
        if (!given[i])
            list =
                arena_format(context->scratch, "%.*s%s'%s'", STR_ARG(list), list.len ? ", " : "", names[i]);
    if (list.len == 0)
        return true;
    if (bind_is_known(context, node))
        return false;
    diag_add(context->sink, DIAG_MISSING_COMPONENT, tree_span(context->tree, node),
             "%.*s lacks %.*s; write every component%s", STR_ARG(say_subject(context->scratch, subject)),
             STR_ARG(list), takes_zero(subject) ? ", even if it is 0" : "");
    if (numbers_are_good && tree_node(context->tree, node)->count)
        help_with_rest(context, subject, node);
    else
        bind_help_example(context, subject);
    return false;
}

// {0, 0, 0}: numbers without keys.
static bool is_braced_list(const struct bind_context *context, tree_index node) {
    const struct tree *tree = context->tree;
    for (tree_index key = tree_first(tree, node); key; key = tree_next_key(tree, key)) {
        double ignored;
        bool empty = bind_kind(context, tree_value(tree, key)) == TREE_NULL;
        if (!empty || number_parse(tree_text(tree, key), &ignored) != NUMBER_OK)
            return false;
    }
    return tree_first(tree, node) != 0;
}

static bool bind_named(struct bind_context *context, struct bind_subject subject, tree_index node,
                       double out[COMPONENTS_MAX]) {
    const struct tree *tree = context->tree;
    uint32_t wanted = schema_component_count(subject.row->kind);
    bool given[COMPONENTS_MAX] = {false};
    bool all_known = true;
    bool as_element = false; // <x>1</x> for x="1"
    bool good = true;
    for (tree_index key = tree_first(tree, node); key; key = tree_next_key(tree, key)) {
        bool bad = bind_is_bad_pair(context, node, key);
        int i = find_component(schema_components(subject.row->kind), wanted, tree_text(tree, key));
        if (i >= 0 && tree_node(tree, key)->key != TREE_KEY_CHILD) {
            given[i] = true;
            good = !bad &&
                   bind_number(context, component_of(subject, (uint32_t)i), tree_value(tree, key), &out[i]) &&
                   good;
            continue;
        }
        all_known = false;
        bool reported = bad || (i >= 0 && (bind_is_bad(context, tree_value(tree, key)) || as_element));
        as_element = as_element || i >= 0;
        if (!reported && i >= 0)
            bind_wrong_shape(context, subject, node);
        else if (!reported)
            unknown_component(context, subject, key);
    }
    // A name that does not exist was probably meant to be the missing component.
    if (all_known && subject.row->kind != SCHEMA_WEIGHTS)
        good = report_missing(context, subject, node, given, good) && good;
    return good && all_known;
}

static void store(enum schema_kind kind, const double n[COMPONENTS_MAX], void *out) {
    if (kind == SCHEMA_VECTOR)
        *(vec3 *)out = (vec3){n[0], n[1], n[2]};
    else if (kind == SCHEMA_PAIR)
        *(struct ir_pair *)out = (struct ir_pair){n[0], n[1]};
    else if (kind == SCHEMA_POINT)
        *(struct ir_point *)out = (struct ir_point){n[0], n[1]};
    else if (kind == SCHEMA_QUAD)
        *(struct ir_quad *)out = (struct ir_quad){n[0], n[1], n[2], n[3]};
    else if (kind == SCHEMA_COLOR)
        *(struct ir_color *)out = (struct ir_color){.r = n[0], .g = n[1], .b = n[2]};
    else
        *(struct ir_weights *)out = (struct ir_weights){n[0], n[1], n[2], n[3]};
}

// XML: the value of `<Color hex="#rrggbb"/>`; 0 if the element has other attributes.
static tree_index hex_attribute(const struct bind_context *context, const struct schema_row *row,
                                tree_index node) {
    const struct tree_node *n = tree_node(context->tree, node);
    if (row->kind != SCHEMA_COLOR || n->kind != TREE_MAP || n->count != 1 || n->flags & TREE_BAD)
        return 0;
    tree_index key = tree_first(context->tree, node);
    bool is_hex = tree_node(context->tree, key)->key == TREE_KEY_ATTRIBUTE &&
                  str_equal_cstr(tree_text(context->tree, key), SCHEMA_HEX_ATTRIBUTE);
    return is_hex ? tree_value(context->tree, key) : 0;
}

static bool bind_composite(struct bind_context *context, struct bind_subject subject, tree_index node,
                           void *out) {
    const struct tree_node *n = tree_node(context->tree, node);
    const struct schema_row *row = subject.row;
    double numbers[COMPONENTS_MAX] = {0};
    tree_index hex = hex_attribute(context, row, node);
    if (hex) {
        const str text = tree_text(context->tree, hex);
        bool good = str_starts_with(text, STR("#")) || expression_is_meant(text);
        return good ? bind_color_text(context, subject, hex, out) : bind_bad_color(context, subject, hex);
    }
    if (n->kind == TREE_LIST) {
        if (!bind_list(context, subject, node, numbers))
            return false;
    } else if (n->kind == TREE_MAP) {
        if (is_braced_list(context, node))
            return bind_wrong_shape(context, subject, node);
        if (!bind_named(context, subject, node, numbers))
            return false;
    } else if (n->kind == TREE_SCALAR && row->kind == SCHEMA_COLOR && !(n->flags & TREE_BAD)) {
        return bind_color_text(context, subject, node, out);
    } else if (n->kind == TREE_SCALAR && row->kind == SCHEMA_VECTOR && !(n->flags & TREE_BAD) &&
               bind_formula(context, subject, node)) {
        numbers[0] = 0;
    } else if (n->kind == TREE_SCALAR && row->fill && !(n->flags & TREE_BAD)) {
        if (!bind_number(context, subject, node, &numbers[0]))
            return false;
        numbers[1] = numbers[2] = numbers[0];
    } else {
        return bind_wrong_shape(context, subject, node);
    }
    // A list or map that the reader has reported is checked, but its value is not used.
    if (n->flags & TREE_BAD)
        return false;
    if (row->kind == SCHEMA_COLOR)
        bind_check_bytes(context, subject, node, numbers);
    store(row->kind, numbers, out);
    return true;
}

bool bind_value(struct bind_context *context, struct bind_subject subject, tree_index node, void *out) {
    const enum schema_kind kind = subject.row->kind;
    if (schema_has_values(subject.row))
        return bind_values(context, subject, node, out);
    return schema_components(kind)[0] ? bind_composite(context, subject, node, out)
                                      : bind_scalar(context, subject, node, out);
}
