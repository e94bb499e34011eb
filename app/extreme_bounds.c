#include "app/extreme_bounds.h"

#include "core/nearest.h"
#include "core/number.h"
#include "parser/tree/reader.h"

#include <math.h>

struct binder {
    const struct extreme_bounds_input *input;
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

static void unknown_key(const struct binder *b, tree_index key, const char *kind,
                        const struct nearest *search) {
    if (is_reported(b, key))
        return;
    diag_add(b->input->sink, DIAG_CONFIG_KEY, tree_span(b->tree, key), "there is no %s '%.*s'", kind,
             STR_ARG(tree_text(b->tree, key)));
    if (nearest_best(search).len)
        diag_help(b->input->sink, "did you mean '%.*s'?", STR_ARG(nearest_best(search)));
}

// Where the number of a key of a bound goes; NULL: there is no such key.
static double *place_of(struct extreme_bound *bound, str key, struct nearest *search) {
    nearest_offer(search, STR("from"));
    nearest_offer(search, STR("to"));
    if (str_equal_cstr(key, "from"))
        return &bound->from;
    if (str_equal_cstr(key, "to"))
        return &bound->to;
    for (int m = 0; m < EXTREME_METRICS; m++) {
        nearest_offer(search, str_from(extreme_metrics[m].name));
        if (str_equal_cstr(key, extreme_metrics[m].name))
            return &bound->bound[m];
    }
    return NULL;
}

static bool has_metric(const struct binder *b, tree_index node) {
    for (tree_index key = tree_first(b->tree, node); key; key = tree_next_key(b->tree, key))
        if (!str_equal_cstr(tree_text(b->tree, key), "from") &&
            !str_equal_cstr(tree_text(b->tree, key), "to"))
            return true;
    return false;
}

static void take_bound(struct binder *b, uint32_t axes, tree_index node) {
    struct extreme_bound bound = {.axes = axes, .from = -HUGE_VAL, .to = HUGE_VAL};
    for (int m = 0; m < EXTREME_METRICS; m++)
        bound.bound[m] = (double)NAN;
    if (tree_node(b->tree, node)->kind != TREE_MAP) {
        bad_value(b, node, "a bound is a map from metrics to numbers, such as {to: 1.0e+6, off: 0.0005}");
        return;
    }
    for (tree_index key = tree_first(b->tree, node); key; key = tree_next_key(b->tree, key)) {
        const tree_index value = tree_value(b->tree, key);
        struct nearest search = nearest_begin(tree_text(b->tree, key));
        double *place = place_of(&bound, tree_text(b->tree, key), &search);
        double number;
        if (!place)
            unknown_key(b, key, "metric", &search);
        else if (tree_node(b->tree, value)->kind != TREE_SCALAR ||
                 number_parse(tree_text(b->tree, value), &number) != NUMBER_OK || number < 0)
            bad_value(b, value, "a bound must be a number that is not negative");
        else
            *place = number;
    }
    if (bound.from > bound.to)
        bad_value(b, node, "'from' is above 'to': the bound applies to no value");
    else if (!has_metric(b, node))
        bad_value(b, node, "this bounds nothing: name a metric, such as off: 0.0005");
    *ARENA_PUSH(b->input->arena, b->out) = bound;
}

static void take_axis(struct binder *b, tree_index key) {
    const tree_index list = tree_value(b->tree, key);
    const str name = tree_text(b->tree, key);
    struct nearest search = nearest_begin(name);
    uint32_t axes = str_equal_cstr(name, "all") ? (1u << EXTREME_AXES) - 1 : 0;
    nearest_offer(&search, STR("all"));
    for (int axis = 0; axis < EXTREME_AXES; axis++) {
        nearest_offer(&search, str_from(extreme_axes[axis].name));
        if (str_equal_cstr(name, extreme_axes[axis].name))
            axes = 1u << axis;
    }
    if (!axes)
        unknown_key(b, key, "axis", &search);
    else if (tree_node(b->tree, list)->kind == TREE_LIST)
        for (tree_index item = tree_first(b->tree, list); item; item = tree_next(b->tree, item))
            take_bound(b, axes, item);
    else if (tree_node(b->tree, list)->kind != TREE_NULL)
        bad_value(b, list, "an axis must have a list of bounds, such as [{off: 0.0005}]");
}

// The reader knows scenes: what it says of a file that is no map has other words here.
static bool keep_for_bounds(void *context, struct diag *item) {
    (void)context;
    if (item->code == DIAG_NOT_A_SCENE) {
        item->code = DIAG_CONFIG_VALUE;
        item->message = STR("bounds are a map from axes to lists of bounds");
        item->help = STR("write an axis, such as move: [{off: 0.0005}]");
    }
    return item->code != DIAG_EMPTY_FILE;
}

struct reading {
    struct binder binder;
    uint32_t source;
    struct tree tree;
};

static void read_and_bind(void *context) {
    struct reading *r = context;
    const struct extreme_bounds_input *input = r->binder.input;
    const struct reader_context reader = {
        .sources = input->sources, .sink = input->sink, .limits = input->limits, .arena = input->arena};
    if (read_yaml(&reader, r->source, &r->tree))
        for (tree_index key = tree_first(&r->tree, r->tree.root); key; key = tree_next_key(&r->tree, key))
            take_axis(&r->binder, key);
}

bool extreme_bounds_read(const struct extreme_bounds_input *input, uint32_t source,
                         struct extreme_bounds *out) {
    struct reading reading = {.binder = {input, &reading.tree, out}, .source = source};
    *out = (struct extreme_bounds){0};
    if (arena_guarded(input->arena, read_and_bind, &reading) != ARENA_FAULT_NONE)
        return false;
    diag_filter(input->sink, keep_for_bounds, NULL);
    // A run without bounds would pass whatever it measured.
    if (out->count == 0 && input->sink->errors == 0) {
        diag_add(input->sink, DIAG_CONFIG_VALUE, (span){source, 0, 0}, "the file contains no bounds");
        diag_help(input->sink, "write an axis, such as move: [{off: 0.0005}]");
    }
    diag_sort(input->sink);
    return true;
}
