#include "grammar/print/ir_diff.h"

#include "core/strbuf.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_value.h"
#include "grammar/ir_walk.h"
#include "grammar/print/ir_align.h"
#include "grammar/print/ir_print_row.h"
#include "grammar/schema.h"

#include <string.h>

struct differ {
    const struct ir_diff_side *a, *b;
    struct arena *arena;
    struct ir_changes *changes;
    bool quiet;     // only asks whether anything differs
    bool different; // something differed
    struct {
        struct rename {
            str before, after;
        } * items;
        uint32_t count, capacity;
    } renames; // renames of the things that references name
};

// One element in both scenes.
struct pair {
    const struct schema_element *schema;
    const void *a, *b;
    str path_a, path_b;
};

static void diff_rows(struct differ *d, const struct pair *pair);

// ---- text and places

static str take(struct differ *d, struct strbuf *text) {
    str kept = arena_copy(d->arena, strbuf_view(text));
    strbuf_finish(text);
    return kept;
}

static str row_text(struct differ *d, const struct ir_diff_side *side, const struct schema_row *row,
                    const void *element) {
    struct strbuf text;
    strbuf_init(&text);
    print_yaml_row(side->scene, row, element, &text);
    str whole = take(d, &text);
    return str_slice(whole, strlen(schema_yaml_key(row)) + 2, whole.len);
}

static str item_text(struct differ *d, const struct ir_diff_side *side, const struct schema_element *schema,
                     const void *item) {
    struct strbuf text;
    strbuf_init(&text);
    print_yaml_item(side->scene, schema, item, &text);
    return take(d, &text);
}

static span element_place(const struct ir_diff_side *side, const void *element) {
    return ir_place_label(side->origin, ir_walk_head(element));
}

static span row_place(const struct ir_diff_side *side, const void *element, uint32_t row) {
    const struct ir_row_origin *origin = ir_origin_row(side->origin, ir_walk_head(element), row);
    return origin ? origin->value : element_place(side, element);
}

static str join_path(struct differ *d, str path, str key) {
    return path.len ? arena_format(d->arena, "%.*s.%.*s", STR_ARG(path), STR_ARG(key)) : key;
}

// The element's own path stands for its short row.
static str row_path(struct differ *d, const struct schema_element *schema, uint32_t i, str path) {
    bool is_short = schema_short_row(schema) == (int)i && path.len;
    return is_short ? path : join_path(d, path, str_from(schema_yaml_key(&schema->rows[i])));
}

static void add(struct differ *d, struct ir_change change) {
    d->different = true;
    if (!d->quiet)
        *ARENA_PUSH(d->arena, d->changes) = change;
}

static void add_row(struct differ *d, const struct pair *p, uint32_t i, enum ir_change_kind kind) {
    const struct schema_row *row = &p->schema->rows[i];
    struct ir_change change = {.kind = kind};
    d->different = true;
    if (d->quiet)
        return;
    if (kind != IR_ADDED) {
        change.path_before = row_path(d, p->schema, i, p->path_a);
        change.before = row_place(d->a, p->a, i);
        change.value_before = row_text(d, d->a, row, p->a);
        change.default_before = !ir_walk_written(p->schema, i, p->a);
    }
    if (kind != IR_REMOVED) {
        change.path_after = row_path(d, p->schema, i, p->path_b);
        change.after = row_place(d->b, p->b, i);
        change.value_after = row_text(d, d->b, row, p->b);
        change.default_after = !ir_walk_written(p->schema, i, p->b);
    }
    add(d, change);
}

// ---- values

static bool same_color(const struct ir_color *a, const struct ir_color *b) {
    return a->is_hex == b->is_hex &&
           (a->is_hex ? a->hex == b->hex : a->r == b->r && a->g == b->g && a->b == b->b);
}

static bool same_components(const struct schema_row *row, const void *a, const void *b) {
    double x[4], y[4];
    uint32_t count = ir_walk_components(row, a, x);
    ir_walk_components(row, b, y);
    for (uint32_t i = 0; i < count; i++)
        if (x[i] != y[i])
            return false;
    return true;
}

static bool same_text(struct differ *d, const struct pair *p, uint32_t i, str a, str b) {
    const struct schema_row *row = &p->schema->rows[i];
    if (!ir_walk_path(row, p->a) || !ir_walk_path(row, p->b) || !a.len || !b.len || !d->a->file ||
        !d->b->file)
        return str_equal(a, b);
    return str_equal(d->a->file(d->a->context, d->arena, row_place(d->a, p->a, i), a),
                     d->b->file(d->b->context, d->arena, row_place(d->b, p->b, i), b));
}

// Whether two elements mean the same.
static bool same_element(struct differ *d, const struct schema_element *schema, const void *a,
                         const void *b) {
    struct differ quiet = *d;
    struct pair pair = {.schema = schema, .a = a, .b = b};
    quiet.quiet = true;
    quiet.different = false;
    diff_rows(&quiet, &pair);
    return !quiet.different;
}

static bool is_renamed(const struct differ *d, str before, str after) {
    for (uint32_t i = 0; i < d->renames.count; i++)
        if (str_equal(d->renames.items[i].before, before) && str_equal(d->renames.items[i].after, after))
            return true;
    return false;
}

static void diff_reference(struct differ *d, const struct pair *p, uint32_t i) {
    const struct schema_row *row = &p->schema->rows[i];
    const struct ir_reference *a = schema_field_const(row, p->a), *b = schema_field_const(row, p->b);
    const void *to_a = ir_walk_referent(d->a->scene, row, a), *to_b = ir_walk_referent(d->b->scene, row, b);
    if (!to_a || !to_b) {
        if (to_a || to_b || !same_text(d, p, i, a->name, b->name))
            add_row(d, p, i, to_a ? IR_REMOVED : to_b ? IR_ADDED : IR_CHANGED);
    } else if (a->name.len && b->name.len) {
        if (!str_equal(a->name, b->name) && !is_renamed(d, a->name, b->name))
            add_row(d, p, i, IR_CHANGED);
    } else if (a->name.len || b->name.len) {
        if (!same_element(d, row->child, to_a, to_b))
            add_row(d, p, i, IR_CHANGED);
    } else {
        struct pair bodies = {row->child, to_a, to_b, row_path(d, p->schema, i, p->path_a),
                              row_path(d, p->schema, i, p->path_b)};
        diff_rows(d, &bodies);
    }
}

// Which choice rows the two elements took; equal for equal choices.
static bool same_choices(const struct schema_element *schema, const void *a, const void *b) {
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (ir_walk_taken(schema, &schema->rows[i], a) != ir_walk_taken(schema, &schema->rows[i], b))
            return false;
    return true;
}

static void diff_element(struct differ *d, const struct pair *p, uint32_t i) {
    const struct schema_row *row = &p->schema->rows[i];
    const char *a = schema_field_const(row, p->a), *b = schema_field_const(row, p->b);
    // A colour that becomes a checker counts as one change, not two.
    if (schema_short_row(row->child) >= 0 && !same_choices(row->child, a, b)) {
        add_row(d, p, i, IR_CHANGED);
        return;
    }
    struct pair inner = {row->child, a, b, row_path(d, p->schema, i, p->path_a),
                         row_path(d, p->schema, i, p->path_b)};
    diff_rows(d, &inner);
}

static bool same_value(struct differ *d, const struct pair *p, uint32_t i, const void *a, const void *b) {
    const struct schema_row *row = &p->schema->rows[i];
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        return *(const bool *)a == *(const bool *)b;
    case SCHEMA_INTEGER:
        return *(const int32_t *)a == *(const int32_t *)b;
    case SCHEMA_NUMBER:
        return *(const double *)a == *(const double *)b;
    case SCHEMA_WORD:
        return *(const unsigned *)a == *(const unsigned *)b;
    case SCHEMA_TEXT:
        return same_text(d, p, i, *(const str *)a, *(const str *)b);
    case SCHEMA_COLOR:
        return same_color(a, b);
    default:
        return same_components(row, a, b);
    }
}

// ---- lists

struct lists {
    struct differ *d;
    const struct pair *owner;
    const struct schema_row *row;
    struct ir_any_list a, b;
    uint32_t *a_index, *b_index; // of visible entries in the lists
    struct ir_align align;
};

static const void *entry(const struct lists *l, bool is_b, uint32_t i) {
    return ir_walk_item(l->row, is_b ? l->b : l->a, is_b ? l->b_index[i] : l->a_index[i]);
}

static uint32_t *visible(struct differ *d, const struct schema_row *row, struct ir_any_list list,
                         uint32_t *count) {
    uint32_t *index = ARENA_ARRAY(d->arena, uint32_t, list.count);
    *count = 0;
    for (uint32_t i = 0; i < list.count; i++)
        if (!ir_walk_is_anonymous(row->child, ir_walk_item(row, list, i)))
            index[(*count)++] = i;
    return index;
}

static const struct ir_copies *copies_of(const struct lists *l, bool is_b) {
    const struct ir_origin *origin = is_b ? l->d->b->origin : l->d->a->origin;
    return origin ? origin->copies : NULL;
}

static str entry_path(const struct lists *l, bool is_b, uint32_t i) {
    struct differ *d = l->d;
    str path = join_path(d, is_b ? l->owner->path_b : l->owner->path_a, str_from(schema_yaml_key(l->row)));
    str name = ir_walk_name(l->row->child, entry(l, is_b, i));
    if (l->row->many == SCHEMA_NAMED_MAP)
        return join_path(d, path, name);
    const struct ir_copies *copies = copies_of(l, is_b);
    struct strbuf label;
    if (ir_copies_instance(copies, l->row, i) && name.len)
        return name;
    strbuf_init(&label);
    if (ir_copies_instance(copies, l->row, i)) {
        ir_copies_label(copies, l->row, i, &label);
        path = STR("");
    } else if (name.len) {
        strbuf_format(&label, "[%.*s]", STR_ARG(name));
    } else {
        ir_copies_index(copies, l->row, i, &label);
    }
    path = arena_format(d->arena, "%.*s%.*s", STR_ARG(path), STR_ARG(strbuf_view(&label)));
    strbuf_finish(&label);
    return path;
}

static bool written_in_either(const struct schema_element *schema, uint32_t i, const void *a, const void *b) {
    return !schema->rows[i].key && (ir_walk_written(schema, i, a) || ir_walk_written(schema, i, b));
}

static void diff_row(struct differ *d, const struct pair *pair, uint32_t i);

static double likeness(void *context, uint32_t a, uint32_t b) {
    struct lists *l = context;
    struct differ quiet = *l->d;
    struct pair pair = {.schema = l->row->child, .a = entry(l, false, a), .b = entry(l, true, b)};
    unsigned equal = 0, all = 0;
    str name_a = ir_walk_name(l->row->child, pair.a), name_b = ir_walk_name(l->row->child, pair.b);
    quiet.quiet = true;
    // In a map each entry has a name, and only equal content shows that it was renamed.
    if (l->row->many == SCHEMA_NAMED_MAP)
        return same_element(l->d, l->row->child, pair.a, pair.b) ? 1 : -1;
    if (name_a.len && name_b.len)
        return -1;
    const struct ir_copies *copies_a = copies_of(l, false), *copies_b = copies_of(l, true);
    if (!ir_copies_are_same(copies_a, ir_copies_instance(copies_a, l->row, a), copies_b,
                            ir_copies_instance(copies_b, l->row, b)))
        return -1;
    for (uint32_t i = 0; i < l->row->child->row_count; i++) {
        if (!written_in_either(l->row->child, i, pair.a, pair.b))
            continue;
        quiet.different = false;
        diff_row(&quiet, &pair, i);
        equal += !quiet.different;
        all++;
    }
    return all ? (double)equal / all : 1;
}

// What an entry says, and whose it is.
static str content_of(const struct lists *l, bool is_b, uint32_t i) {
    struct differ *d = l->d;
    const struct ir_copies *copies = copies_of(l, is_b);
    const str text = item_text(d, is_b ? d->b : d->a, l->row->child, entry(l, is_b, i));
    const uint32_t instance = ir_copies_instance(copies, l->row, i);
    if (!instance)
        return text;
    struct strbuf name;
    strbuf_init(&name);
    ir_copies_instance_name(copies, instance - 1, &name);
    const str both = arena_format(d->arena, "%.*s/%.*s", STR_ARG(strbuf_view(&name)), STR_ARG(text));
    strbuf_finish(&name);
    return both;
}

static void align_lists(struct lists *l) {
    struct differ *d = l->d;
    uint32_t a_count, b_count;
    l->a_index = visible(d, l->row, l->a, &a_count);
    l->b_index = visible(d, l->row, l->b, &b_count);
    ir_align_init(&l->align, d->arena, a_count, b_count);
    str *a_keys = ARENA_ARRAY(d->arena, str, a_count), *b_keys = ARENA_ARRAY(d->arena, str, b_count);
    for (uint32_t i = 0; i < a_count; i++)
        a_keys[i] = ir_walk_name(l->row->child, entry(l, false, i));
    for (uint32_t i = 0; i < b_count; i++)
        b_keys[i] = ir_walk_name(l->row->child, entry(l, true, i));
    ir_align_keys(&l->align, a_keys, b_keys);
    for (uint32_t i = 0; i < a_count; i++)
        a_keys[i] = l->align.b_of_a[i] < 0 ? content_of(l, false, i) : STR("");
    for (uint32_t i = 0; i < b_count; i++)
        b_keys[i] = l->align.a_of_b[i] < 0 ? content_of(l, true, i) : STR("");
    ir_align_keys(&l->align, a_keys, b_keys);
    ir_align_rest(&l->align, likeness, l);
}

static void add_entry(struct lists *l, bool is_b, uint32_t i) {
    struct differ *d = l->d;
    const void *item = entry(l, is_b, i);
    struct ir_change change = {.kind = is_b ? IR_ADDED : IR_REMOVED};
    if (is_b) {
        change.path_after = entry_path(l, true, i);
        change.after = element_place(d->b, item);
        change.value_after = item_text(d, d->b, l->row->child, item);
    } else {
        change.path_before = entry_path(l, false, i);
        change.before = element_place(d->a, item);
        change.value_before = item_text(d, d->a, l->row->child, item);
    }
    add(d, change);
}

static void diff_entry(struct lists *l, uint32_t a, uint32_t b, bool moved) {
    struct differ *d = l->d;
    struct pair pair = {l->row->child, entry(l, false, a), entry(l, true, b), entry_path(l, false, a),
                        entry_path(l, true, b)};
    struct ir_change place = {.path_before = pair.path_a,
                              .path_after = pair.path_b,
                              .before = element_place(d->a, pair.a),
                              .after = element_place(d->b, pair.b)};
    if (l->row->many == SCHEMA_NAMED_MAP &&
        !str_equal(ir_walk_name(pair.schema, pair.a), ir_walk_name(pair.schema, pair.b))) {
        place.kind = IR_RENAMED;
        add(d, place);
        *ARENA_PUSH(d->arena, &d->renames) =
            (struct rename){ir_walk_name(pair.schema, pair.a), ir_walk_name(pair.schema, pair.b)};
    }
    diff_rows(d, &pair);
    if (moved) {
        place.kind = IR_MOVED;
        add(d, place);
    }
}

static bool is_referenced(const struct schema_element *target) {
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        for (uint32_t i = 0; i < (*e)->row_count; i++)
            if ((*e)->rows[i].kind == SCHEMA_REFERENCE && (*e)->rows[i].child == target)
                return true;
    return false;
}

// The order of named things has no meaning, except that the first camera is the one to look through.
static bool first_moved(const struct lists *l, uint32_t b) {
    bool in_scene = l->owner->schema == &SCHEMA_SCENE && !is_referenced(l->row->child);
    return in_scene && b == 0 && l->align.a_count > 0 && l->align.a_of_b[0] > 0;
}

static void diff_list(struct differ *d, const struct pair *p, uint32_t i) {
    const struct schema_row *row = &p->schema->rows[i];
    struct lists l = {
        .d = d, .owner = p, .row = row, .a = ir_walk_list(row, p->a), .b = ir_walk_list(row, p->b)};
    align_lists(&l);
    bool *moved = ARENA_ARRAY(d->arena, bool, l.align.a_count);
    if (row->many == SCHEMA_SEQUENCE)
        ir_align_moved(&l.align, moved);
    for (uint32_t a = 0; a < l.align.a_count; a++)
        if (l.align.b_of_a[a] == IR_ALIGN_NONE)
            add_entry(&l, false, a);
    for (uint32_t b = 0; b < l.align.b_count; b++) {
        int32_t a = l.align.a_of_b[b];
        if (a == IR_ALIGN_NONE)
            add_entry(&l, true, b);
        else
            diff_entry(&l, (uint32_t)a, b, row->many == SCHEMA_NAMED_MAP ? first_moved(&l, b) : moved[a]);
    }
}

// ---- rows

static void diff_row(struct differ *d, const struct pair *p, uint32_t i) {
    const struct schema_row *row = &p->schema->rows[i];
    const char *a = schema_field_const(row, p->a), *b = schema_field_const(row, p->b);
    bool in_a = ir_walk_taken(p->schema, row, p->a), in_b = ir_walk_taken(p->schema, row, p->b);
    if (row->key || (!in_a && !in_b))
        return;
    if (in_a != in_b) {
        if (ir_walk_written(p->schema, i, in_a ? p->a : p->b))
            add_row(d, p, i, in_a ? IR_REMOVED : IR_ADDED);
    } else if (row->many == SCHEMA_FIXED) {
        bool same = true;
        for (uint32_t k = 0; k < row->fixed_count; k++)
            same = same && same_value(d, p, i, a + (size_t)k * row->size, b + (size_t)k * row->size);
        if (!same)
            add_row(d, p, i, IR_CHANGED);
    } else if (row->kind == SCHEMA_LIST) {
        diff_list(d, p, i);
    } else if (row->kind == SCHEMA_ELEMENT) {
        diff_element(d, p, i);
    } else if (row->kind == SCHEMA_REFERENCE) {
        diff_reference(d, p, i);
    } else if (!same_value(d, p, i, a, b)) {
        add_row(d, p, i, IR_CHANGED);
    }
}

static void diff_rows(struct differ *d, const struct pair *pair) {
    for (uint32_t i = 0; i < pair->schema->row_count && !(d->quiet && d->different); i++)
        diff_row(d, pair, i);
}

void ir_diff(const struct ir_diff_side *before, const struct ir_diff_side *after, struct arena *arena,
             struct ir_changes *changes) {
    struct differ d = {.a = before, .b = after, .arena = arena, .changes = changes};
    struct pair scene = {.schema = &SCHEMA_SCENE, .a = before->scene, .b = after->scene};
    *changes = (struct ir_changes){0};
    diff_rows(&d, &scene);
}
