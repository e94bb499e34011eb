#include "load/settings/extreme_bounds.h"
#include "diag/codes/command.h"

#include "core/number.h"
#include "load/settings/keys.h"
#include "load/settings/settings_file.h"

#include <math.h>

struct binder {
    const struct reader_context *input;
    const struct tree *tree;
    struct extreme_bounds *out;
};

static bool is_reported(const struct binder *b, tree_index node) {
    return tree_node(b->tree, node)->flags & (TREE_BAD | TREE_CUT);
}

static void bad_value(const struct binder *b, tree_index node, const char *words) {
    if (!is_reported(b, node))
        diag_add(b->input->sink, DIAG_CONFIG_VALUE, tree_span(b->tree, node), "%s", words);
}

static const struct key_row *find_key(const struct binder *b, const struct key_table *table, tree_index key) {
    struct nearest search;
    const str name = tree_text(b->tree, key);
    const struct key_row *row = key_find(table, name, &search);
    if (!row && !is_reported(b, key))
        key_report_unknown(table, b->input->sink, DIAG_CONFIG_KEY, tree_span(b->tree, key), name, &search);
    return row;
}

static void take_number(struct binder *b, struct extreme_bound *bound, const struct key_row *row,
                        tree_index value) {
    double number;
    if (tree_node(b->tree, value)->kind != TREE_SCALAR ||
        number_parse(tree_text(b->tree, value), &number) != NUMBER_OK || number < row->least)
        bad_value(b, value, "a bound must be a number that is not negative");
    else
        *(double *)((char *)bound + row->offset) = number;
}

static void take_bound(struct binder *b, uint32_t axes, tree_index node) {
    struct extreme_bound bound = {.axes = axes, .from = -HUGE_VAL, .to = HUGE_VAL};
    for (int m = 0; m < EXTREME_METRICS; m++)
        bound.bound[m] = (double)NAN;
    if (tree_node(b->tree, node)->kind != TREE_MAP) {
        bad_value(b, node, "a bound is a map from metrics to numbers, such as {to: 1.0e+6, off: 0.0005}");
        return;
    }
    bool has_metric = false;
    for (tree_index key = tree_first(b->tree, node); key; key = tree_next_key(b->tree, key)) {
        const struct key_row *row = find_key(b, &BOUND_KEYS, key);
        has_metric |= !row || row->value == KEY_BOUND;
        if (row)
            take_number(b, &bound, row, tree_value(b->tree, key));
    }
    if (bound.from > bound.to)
        bad_value(b, node, "'from' is above 'to': the bound applies to no value");
    else if (!has_metric)
        bad_value(b, node, "this bounds nothing: name a metric, such as off: 0.0005");
    *ARENA_PUSH(b->input->arena, b->out) = bound;
}

static void take_axis(struct binder *b, tree_index key) {
    const tree_index list = tree_value(b->tree, key);
    const struct key_row *row = find_key(b, &AXIS_KEYS, key);
    if (!row)
        return;
    if (tree_node(b->tree, list)->kind == TREE_LIST)
        for (tree_index item = tree_first(b->tree, list); item; item = tree_next(b->tree, item))
            take_bound(b, row->axes, item);
    else if (tree_node(b->tree, list)->kind != TREE_NULL)
        bad_value(b, list, "an axis must have a list of bounds, such as [{off: 0.0005}]");
}

static void take_key(void *binder, const struct tree *tree, tree_index key) {
    struct binder *b = binder;
    b->tree = tree;
    take_axis(b, key);
}

bool extreme_bounds_read(const struct reader_context *input, uint32_t source, struct extreme_bounds *out) {
    static const struct settings_words words = {"bounds are a map from axes to lists of bounds",
                                                "write an axis, such as move: [{off: 0.0005}]"};
    struct binder binder = {.input = input, .out = out};
    *out = (struct extreme_bounds){0};
    if (settings_read(input, source, &words, take_key, &binder) != ARENA_FAULT_NONE)
        return false;
    // A run without bounds would pass whatever it measured.
    if (out->count == 0 && input->sink->errors == 0) {
        diag_add(input->sink, DIAG_CONFIG_VALUE, (span){source, 0, 0}, "the file contains no bounds");
        diag_help(input->sink, "%s", words.help);
    }
    diag_sort(input->sink);
    return true;
}
