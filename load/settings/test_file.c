#include "load/settings/test_file.h"
#include "diag/codes/command.h"

#include "core/number.h"
#include "load/settings/keys.h"
#include "load/settings/settings_file.h"

#include <math.h>
#include <string.h>

struct binder {
    const struct reader_context *input;
    const struct tree *tree;
    struct test_file *out;
};

static void report(const struct binder *b, tree_index node, const char *words, const char *help) {
    if (tree_node(b->tree, node)->flags & (TREE_BAD | TREE_CUT))
        return;
    diag_add(b->input->sink, DIAG_CONFIG_VALUE, tree_span(b->tree, node), "%s", words);
    if (help)
        diag_help(b->input->sink, "write '%s'", help);
}

static void bad_value(const struct binder *b, tree_index node, const struct key_row *row) {
    report(b, node,
           arena_format(b->input->arena, "'%s' must be %s", row->name, key_form(row, b->input->arena)).ptr,
           row->example);
}

static const struct key_row *find_key(const struct binder *b, const struct key_table *table, tree_index key) {
    struct nearest search;
    const str name = tree_text(b->tree, key);
    const struct key_row *row = key_find(table, name, &search);
    if (!row && !(tree_node(b->tree, key)->flags & (TREE_BAD | TREE_CUT)) &&
        !key_report_unknown(table, b->input->sink, DIAG_CONFIG_KEY, tree_span(b->tree, key), name, &search))
        diag_help(b->input->sink, "there are %.*s", STR_ARG(key_list(table, b->input->arena)));
    return row;
}

static bool is_text(const struct binder *b, tree_index node) {
    return tree_node(b->tree, node)->kind == TREE_SCALAR && tree_text(b->tree, node).len > 0;
}

// ---- values

static void take_text(struct binder *b, const struct key_row *row, tree_index value, str *out, span *at) {
    if (!is_text(b, value)) {
        bad_value(b, value, row);
        return;
    }
    *out = arena_copy(b->input->arena, tree_text(b->tree, value));
    if (at)
        *at = tree_span(b->tree, value);
}

static void take_list(struct binder *b, const struct key_row *row, tree_index value, struct test_list *out) {
    const enum tree_kind kind = tree_node(b->tree, value)->kind;
    if (kind != TREE_LIST && kind != TREE_NULL)
        bad_value(b, value, row);
    for (tree_index item = kind == TREE_LIST ? tree_first(b->tree, value) : 0; item;
         item = tree_next(b->tree, item)) {
        const bool is_set = row->value == KEY_ASSIGNMENT;
        if (!is_text(b, item) ||
            (is_set && !memchr(tree_text(b->tree, item).ptr, '=', tree_text(b->tree, item).len)))
            bad_value(b, item, row);
        else
            *(str *)ARENA_PUSH(b->input->arena, out) = arena_copy(b->input->arena, tree_text(b->tree, item));
    }
}

static str text_of(const struct binder *b, tree_index value) {
    return tree_node(b->tree, value)->kind == TREE_SCALAR ? tree_text(b->tree, value) : STR("");
}

static void take_bound(struct binder *b, tree_index key, struct test_settings *out) {
    const struct key_row *row = find_key(b, &TEST_BOUND_KEYS, key);
    const tree_index value = tree_value(b->tree, key);
    double number = 0;
    if (!row)
        return;
    if (!number_parse_real(text_of(b, value), row->least, row->greatest, &number)) {
        bad_value(b, value, row);
        return;
    }
    switch (row->value) {
    case KEY_THRESHOLD:
        out->has_threshold = true;
        out->threshold = number;
        break;
    case KEY_PIXELS:
        out->has_not_finite = true;
        out->bounds.not_finite = number;
        break;
    default:
        out->bounds.has[row->offset] = true;
        out->bounds.bound[row->offset] = number;
        break;
    }
}

static void take_bounds(struct binder *b, const struct key_row *row, tree_index value,
                        struct test_settings *out) {
    if (tree_node(b->tree, value)->kind != TREE_MAP) {
        bad_value(b, value, row);
        return;
    }
    for (tree_index key = tree_first(b->tree, value); key; key = tree_next_key(b->tree, key))
        take_bound(b, key, out);
}

// Takes a setting that both all pictures and one picture may have. false: it is not such a setting.
static bool take_setting(struct binder *b, const struct key_row *row, tree_index value,
                         struct test_settings *out) {
    switch (row->value) {
    case KEY_CAMERA:
        take_text(b, row, value, &out->camera, &out->camera_at);
        return true;
    case KEY_DEVICE:
        take_text(b, row, value, &out->device, &out->device_at);
        return true;
    case KEY_SIZE:
        if (!number_parse_size(text_of(b, value), "x", (int32_t)row->greatest, &out->width, &out->height))
            bad_value(b, value, row);
        return true;
    case KEY_WHOLE_NUMBER:
        if (!number_parse_whole(text_of(b, value), (int64_t)row->least, (int64_t)row->greatest,
                                &out->samples))
            bad_value(b, value, row);
        return true;
    case KEY_ASSIGNMENT:
        take_list(b, row, value, &out->sets);
        return true;
    case KEY_TEST_BOUNDS:
        take_bounds(b, row, value, out);
        return true;
    default:
        return false;
    }
}

// ---- the file

static void take_entry(struct binder *b, tree_index key) {
    const tree_index map = tree_value(b->tree, key);
    const enum tree_kind kind = tree_node(b->tree, map)->kind;
    struct test_entry *entry = ARENA_PUSH(b->input->arena, &b->out->entries);
    *entry = (struct test_entry){.picture = arena_copy(b->input->arena, tree_text(b->tree, key)),
                                 .picture_at = tree_span(b->tree, key)};
    entry->scene_at = entry->picture_at;
    if (kind != TREE_MAP && kind != TREE_NULL) {
        report(b, map, "a picture must have a map of settings, such as {camera: side}", NULL);
        return;
    }
    for (tree_index k = kind == TREE_MAP ? tree_first(b->tree, map) : 0; k; k = tree_next_key(b->tree, k)) {
        const struct key_row *row = find_key(b, &TEST_PICTURE_KEYS, k);
        if (row && !take_setting(b, row, tree_value(b->tree, k), &entry->own))
            take_text(b, row, tree_value(b->tree, k), &entry->scene, &entry->scene_at);
    }
}

static void take_entries(struct binder *b, const struct key_row *row, tree_index map) {
    const enum tree_kind kind = tree_node(b->tree, map)->kind;
    if (kind != TREE_MAP && kind != TREE_NULL)
        bad_value(b, map, row);
    for (tree_index key = kind == TREE_MAP ? tree_first(b->tree, map) : 0; key;
         key = tree_next_key(b->tree, key))
        take_entry(b, key);
}

static void take_key(void *binder, const struct tree *tree, tree_index key) {
    struct binder *b = binder;
    b->tree = tree;
    const struct key_row *row = find_key(b, &TEST_KEYS, key);
    const tree_index value = tree_value(b->tree, key);
    if (!row || take_setting(b, row, value, &b->out->all))
        return;
    if (row->value == KEY_TEST_PICTURE)
        take_entries(b, row, value);
    else if (row->value == KEY_PATTERN)
        take_list(b, row, value, &b->out->skip);
    else
        take_text(b, row, value, &b->out->pictures, &b->out->pictures_at);
}

void test_file_init(struct test_file *file) {
    struct measure_bounds bounds = {0};
    bounds.has[METRIC_SHARE] = bounds.has[METRIC_MAE] = true;
    bounds.bound[METRIC_SHARE] = TEST_SHARE;
    bounds.bound[METRIC_MAE] = TEST_MAE;
    *file = (struct test_file){.all = {.bounds = bounds, .has_threshold = true, .threshold = TEST_THRESHOLD}};
}

bool test_file_read(const struct reader_context *input, uint32_t source, struct test_file *out) {
    static const struct settings_words words = {"the file of 'glint test' must be a map of settings",
                                                "write a setting, such as size: 320x240"};
    struct binder binder = {.input = input, .out = out};
    if (settings_read(input, source, &words, take_key, &binder) != ARENA_FAULT_NONE)
        return false;
    diag_sort(input->sink);
    return true;
}

struct test_settings test_settings_join(const struct test_settings *all, const struct test_settings *own,
                                        struct arena *arena) {
    struct test_settings s = *all;
    if (own->camera.len) {
        s.camera = own->camera;
        s.camera_at = own->camera_at;
    }
    if (own->device.len) {
        s.device = own->device;
        s.device_at = own->device_at;
    }
    if (own->width) {
        s.width = own->width;
        s.height = own->height;
    }
    s.samples = own->samples ? own->samples : s.samples;
    s.sets = (struct test_list){0};
    for (uint32_t i = 0; i < all->sets.count; i++)
        *(str *)ARENA_PUSH(arena, &s.sets) = all->sets.items[i];
    for (uint32_t i = 0; i < own->sets.count; i++)
        *(str *)ARENA_PUSH(arena, &s.sets) = own->sets.items[i];
    for (int m = 0; m < METRIC_COUNT; m++)
        if (own->bounds.has[m]) {
            s.bounds.has[m] = true;
            s.bounds.bound[m] = own->bounds.bound[m];
        }
    if (own->has_threshold)
        s.threshold = own->threshold;
    if (own->has_not_finite)
        s.bounds.not_finite = own->bounds.not_finite;
    return s;
}
