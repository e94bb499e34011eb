// Elements, their rows and the entries of these: the recursive part of the binder.
#include "diag/codes/binding.h"
#include "grammar/ir.h"
#include "parser/bind/bind.h"
#include "parser/bind/say.h"
#include "parser/tree/mend.h"

#include <string.h>

// A row that has one value.

static bool bind_reference(struct bind_context *context, struct bind_frame *frame,
                           const struct schema_row *row, struct bind_given given) {
    struct ir_reference *ref = schema_field(row, frame->memory);
    enum tree_kind kind = bind_kind(context, given.value);
    if (kind == TREE_SCALAR && !bind_is_bad(context, given.value)) {
        str name = tree_text(context->tree, given.value);
        if (!bind_name_text(context, bind_subject(frame, row), name, tree_span(context->tree, given.value)))
            return false;
        *ref = (struct ir_reference){bind_copy_once(context, name), IR_NO_INDEX};
        return true;
    }
    if (kind != TREE_MAP)
        return bind_wrong_shape(context, bind_subject(frame, row), given.value);
    void *memory = arena_alloc(context->scratch, row->child->size);
    schema_index_defaults(context->index, row->child, memory);
    struct bind_frame child = {
        .parent = frame, .schema = row->child, .via = row, .memory = memory, .label = given.key_span};
    bind_element(context, &child, given.value);
    const struct schema_row *home = &SCHEMA_SCENE.rows[bind_home_row(row->child)];
    ref->index = bind_list_push(context->arena, schema_field(home, context->scene), memory, row->child->size);
    return true;
}

static bool bind_one(struct bind_context *context, struct bind_frame *frame, const struct schema_row *row,
                     struct bind_given given) {
    if (row->kind == SCHEMA_REFERENCE)
        return bind_reference(context, frame, row, given);
    if (row->kind != SCHEMA_ELEMENT)
        return bind_value(context, bind_subject(frame, row), given.value, schema_field(row, frame->memory));
    struct bind_frame child = {.parent = frame,
                               .schema = row->child,
                               .via = row,
                               .memory = schema_field(row, frame->memory),
                               .label = given.key_span};
    return bind_element(context, &child, given.value);
}

// Whether another row of the same choice was given before; reports it.
static bool is_excluded(struct bind_context *context, struct bind_frame *frame, uint32_t row,
                        struct bind_given given) {
    const struct schema_row *r = &frame->schema->rows[row];
    for (uint32_t i = 0; i < frame->schema->row_count && r->choice; i++) {
        const struct schema_row *other = &frame->schema->rows[i];
        if (i == row || r->choice == 0 || other->choice != r->choice ||
            !(bind_head(frame)->written & bind_bit(i)))
            continue;
        str owner = say_subject(context->scratch, bind_subject(frame, NULL));
        diag_add(context->sink, DIAG_EXCLUSIVE, given.key_span,
                 "%.*s has both '%s' and '%s'; only one is allowed", STR_ARG(owner), other->name, r->name);
        const struct ir_row_origin *first = ir_origin_row(context->origin, bind_head(frame), i);
        if (first)
            diag_note(context->sink, first->key, "'%s' is here", other->name);
        diag_help(context->sink, "remove one of the two");
        return true;
    }
    return false;
}

// A row with several values: lists and maps in YAML, repeated children in XML, gathered at the first one.

bool bind_entry_into(struct bind_context *context, struct bind_frame *child, struct bind_given given) {
    bind_entry_key(context, child, given);
    bool good = bind_element(context, child, given.value);
    // An entry that could not be read stays if it has a name: others may refer to it.
    if (!good)
        bind_head(child)->poisoned = ~(uint64_t)0;
    return good || child->name.len;
}

bool bind_entry(struct bind_context *context, struct bind_frame *parent, const struct schema_row *row,
                str name, struct bind_given given) {
    struct bind_frame child = bind_entry_begin(context, parent, row, name, given);
    if (!bind_entry_into(context, &child, given) || bind_is_second(context, parent, &child))
        return false;
    bind_list_push(context->arena, schema_field(row, parent->memory), child.memory, row->child->size);
    return true;
}

// The contents of a value of the wrong shape.
static void loose_entries(struct bind_context *context, struct bind_frame *frame, uint32_t row,
                          tree_index value, bool reported) {
    const struct schema_row *r = &frame->schema->rows[row];
    struct bind_entries entries = bind_loose_entries(context, r, value, reported);
    for (uint32_t i = 0; i < entries.count; i++)
        if (bind_entry(context, frame, r, entries.items[i].name, entries.items[i].given))
            bind_head(frame)->written |= bind_bit(row);
}

static void bind_entries(struct bind_context *context, struct bind_frame *frame, uint32_t row,
                         struct bind_given given, struct bind_values values) {
    const struct schema_row *r = &frame->schema->rows[row];
    bind_note_row(context, frame, row, given);
    bool taken = values.repeated && (tree_node(context->tree, values.at)->flags & TREE_TAKEN);
    for (; values.at && !taken; values.at = bind_next_value(context, frame, &values)) {
        bool has_key = values.repeated || values.named;
        if (values.named && !bind_is_bad(context, values.at))
            bind_loose_columns(context, NULL, r, values.at);
        if (values.named && schema_short_row(r->child) >= 0 &&
            !bind_is_bad_pair(context, given.value, values.at) &&
            bind_torn_pair(context, frame, row, given.value, values.at)) {
            // Its name is known, its value is not.
            tree_node(context->tree, values.at)->flags &= (uint8_t)~TREE_BAD;
            tree_node(context->tree, tree_value(context->tree, values.at))->flags |= TREE_BAD;
        }
        struct bind_given entry = {.comments = tree_comments(context->tree, values.at), .value = values.at};
        if (has_key)
            entry = bind_given_by(context, values.at);
        bool bad = values.named ? bind_is_bad_pair(context, given.value, values.at)
                                : has_key && bind_is_bad(context, values.at);
        if (bad)
            continue;
        bind_entry(context, frame, r, values.named ? tree_text(context->tree, values.at) : STR(""), entry);
    }
    if (bind_list_count(schema_field(r, frame->memory)))
        bind_head(frame)->written |= bind_bit(row);
}

// An empty list or map is the same as none.
static bool is_nothing(const struct bind_context *context, const struct schema_row *row, tree_index value) {
    const struct tree_node *node = tree_node(context->tree, value);
    enum tree_kind wanted = row->many == SCHEMA_NAMED_MAP ? TREE_MAP : TREE_LIST;
    return row->many != SCHEMA_FIXED &&
           (node->kind == TREE_NULL || (node->kind == wanted && node->count == 0));
}

static void bind_single(struct bind_context *context, struct bind_frame *frame, uint32_t row,
                        struct bind_given given) {
    const struct schema_row *r = &frame->schema->rows[row];
    bind_note_row(context, frame, row, given);
    if (bind_entry(context, frame, r, str_from(r->single), given))
        bind_head(frame)->written |= bind_bit(row);
}

static void bind_repeated(struct bind_context *context, struct bind_frame *frame, uint32_t row,
                          struct bind_given given) {
    if (frame->seen & bind_bit(row))
        return; // gathered where the first one stands
    struct bind_values all = {.repeated = true, .row = row, .at = given.key};
    if (frame->schema->rows[row].many == SCHEMA_FIXED)
        bind_fixed(context, frame, row, given, all, context->tree->broken);
    else
        bind_entries(context, frame, row, given, all);
}

static void bind_many(struct bind_context *context, struct bind_frame *frame, uint32_t row, bool single,
                      struct bind_given given) {
    const struct schema_row *r = &frame->schema->rows[row];
    if (given.key && tree_node(context->tree, given.key)->key == TREE_KEY_CHILD) {
        bind_repeated(context, frame, row, given);
        return;
    }
    if (!single && is_nothing(context, r, given.value)) {
        if (bind_is_bad(context, given.value))
            bind_poison(frame, row);
        return;
    }
    if (frame->seen & bind_bit(row)) {
        bind_report_twice(context, frame, row, given);
        struct bind_frame aside = bind_aside(context, frame);
        bind_many(context, &aside, row, single, given);
        return;
    }
    if (single) {
        bind_single(context, frame, row, given);
        return;
    }
    enum tree_kind kind = bind_kind(context, given.value);
    if (kind != (r->many == SCHEMA_NAMED_MAP ? TREE_MAP : TREE_LIST)) {
        frame->seen |= bind_bit(row);
        bind_poison(frame, row);
        bind_wrong_shape(context, bind_subject(frame, r), given.value);
        loose_entries(context, frame, row, given.value, true);
        return;
    }
    if (bind_flat_numbers(context, bind_subject(frame, r), given.value) ||
        bind_short_rows(context, bind_subject(frame, r), given.value)) {
        frame->seen |= bind_bit(row);
        bind_poison(frame, row);
        return;
    }
    struct bind_values all = {
        .named = kind == TREE_MAP, .row = row, .at = tree_first(context->tree, given.value)};
    if (r->many == SCHEMA_FIXED)
        bind_fixed(context, frame, row, given, all,
                   (tree_node(context->tree, given.value)->flags & TREE_CUT) != 0);
    else
        bind_entries(context, frame, row, given, all);
}

// Any row.

void bind_row(struct bind_context *context, struct bind_frame *frame, uint32_t row, bool single,
              struct bind_given given) {
    const struct schema_row *r = &frame->schema->rows[row];
    if (r->many != SCHEMA_ONE) {
        bind_many(context, frame, row, single, given);
        return;
    }
    if (frame->seen & bind_bit(row)) {
        bind_report_twice(context, frame, row, given);
        struct bind_frame aside = bind_aside(context, frame);
        bind_one(context, &aside, r, given);
        return;
    }
    if (is_excluded(context, frame, row, given)) {
        struct bind_frame aside = bind_aside(context, frame);
        bind_one(context, &aside, r, given);
        bind_note_row(context, frame, row, given);
        bind_poison(frame, row);
        return;
    }
    bind_note_row(context, frame, row, given);
    bind_head(frame)->written |= bind_bit(row);
    if (r->choice) {
        unsigned tag = r->alternative;
        memcpy((char *)frame->memory + frame->schema->choices[r->choice - 1].tag_offset, &tag, sizeof tag);
    }
    if (!bind_one(context, frame, r, given))
        bind_poison(frame, row);
}

// Rows that are read despite a reported mistake.

// Whether a value has the shape of the row: one without it would be reported again for the same mistake.
static bool fits(const struct bind_context *context, const struct schema_row *row, bool single,
                 tree_index value) {
    enum tree_kind kind = bind_kind(context, value);
    if (row->many == SCHEMA_SEQUENCE)
        return kind == TREE_LIST;
    if (row->many == SCHEMA_NAMED_MAP || single)
        return kind == TREE_MAP;
    if (row->kind == SCHEMA_ELEMENT && schema_short_row(row->child) < 0)
        return kind == TREE_MAP;
    return kind != TREE_NULL;
}

// The value of a key that names a row in another style.
static void loose_row(struct bind_context *context, struct bind_frame *frame, uint32_t row, tree_index key) {
    const struct schema_row *r = &frame->schema->rows[row];
    const struct tree *tree = context->tree;
    struct bind_given given = bind_given_by(context, key);
    bool child = tree_node(tree, key)->key == TREE_KEY_CHILD;
    if ((frame->seen & bind_bit(row)) || bind_is_known(context, given.value))
        return;
    if (child && r->many != SCHEMA_ONE) {
        if (r->many != SCHEMA_FIXED && bind_entry(context, frame, r, STR(""), given))
            bind_head(frame)->written |= bind_bit(row);
        return;
    }
    str snake = mend_snake(context->scratch, tree_text(tree, key));
    bool single = r->single && !child && str_equal_cstr(snake, r->name);
    if (fits(context, r, single, given.value))
        bind_row(context, frame, row, single, given);
    else if (r->many != SCHEMA_ONE)
        loose_entries(context, frame, row, given.value, false);
    bind_poison(frame, row);
}

// Reports a name that the element does not have, and reads its contents if their meaning is clear.
static void unknown_name(struct bind_context *context, struct bind_frame *frame, tree_index key) {
    struct bind_meant meant = bind_unknown_name(context, frame, key);
    uint64_t seen = frame->seen;
    switch (meant.what) {
    case BIND_MEANT_NOTHING:
        return;
    case BIND_MEANT_ROW:
        loose_row(context, frame, meant.row, key);
        return;
    case BIND_MEANT_ITSELF:
        bind_pairs(context, frame, tree_value(context->tree, key));
        frame->seen |= seen;
        return;
    case BIND_MEANT_ENTRIES:
        frame->seen = 0; // <Sphere> may be inside and outside
        bind_pairs(context, frame, tree_value(context->tree, key));
        frame->seen = seen;
        return;
    }
}

// Elements.

// Names come first, so that messages can use them; so does the version, which decides whether to go on.
static bool comes_first(const struct schema_row *row) {
    return row->range == SCHEMA_RANGE_VERSION || row->key ||
           (row->kind == SCHEMA_TEXT && row->text == SCHEMA_TEXT_NAME);
}

// Root keys for anchors; and in an element that was never closed, what belongs outside it.
static bool is_ignored(const struct bind_context *context, const struct bind_frame *frame, tree_index map,
                       tree_index key) {
    bool single;
    if (!frame->parent)
        return tree_node(context->tree, key)->key == TREE_KEY_PLAIN &&
               str_starts_with(tree_text(context->tree, key), STR("x-"));
    if (!(tree_node(context->tree, map)->flags & TREE_CUT))
        return false;
    const struct bind_frame *outer = frame->parent;
    while (outer && bind_find_row(context, outer->schema, key, &single) < 0)
        outer = outer->parent;
    return outer != NULL;
}

static void report_named_inline(struct bind_context *context, struct bind_frame *frame, tree_index key) {
    str owner = say_owner(context->scratch, frame);
    str name = tree_text(context->tree, tree_value(context->tree, key));
    diag_add(context->sink, DIAG_NAMED_INLINE, tree_span(context->tree, key),
             "a %s written in place must not have a name: it belongs only to %.*s", frame->schema->name,
             STR_ARG(owner));
    if (str_is_name(name))
        diag_help(context->sink, "to use a %s of the scene write %s=\"%.*s\"", frame->schema->name,
                  frame->via->name, STR_ARG(name));
}

static int find_row_once(const struct bind_context *context, const struct bind_frame *frame, tree_index key,
                         uint32_t number, struct bind_key_rows *known, bool *single) {
    if (number < known->count) {
        *single = known->items[number].single;
        return known->items[number].row;
    }
    int row = bind_find_row(context, frame->schema, key, single);
    if (number == known->count && number < sizeof known->items / sizeof *known->items) {
        known->items[number].row = row;
        known->items[number].single = *single;
        known->count++;
    }
    return row;
}

void bind_keys(struct bind_context *context, struct bind_frame *frame, tree_index node, bool first,
               struct bind_key_rows *known) {
    const struct tree *tree = context->tree;
    uint32_t number = 0;
    for (tree_index key = tree_first(tree, node); key; key = tree_next_key(tree, key), number++) {
        bool single = false;
        bool bad = bind_is_bad_pair(context, node, key);
        int row = find_row_once(context, frame, key, number, known, &single);
        if (row >= 0 && !first && !bad) {
            bind_loose_columns(context, frame, &frame->schema->rows[row], key);
            bad = bind_loose_numbers(context, frame, (uint32_t)row, node, key) ||
                  bind_torn_pair(context, frame, (uint32_t)row, node, key);
        }
        if (row >= 0 && comes_first(&frame->schema->rows[row]) != first)
            continue;
        if (row < 0) {
            if (!first && !bad && !is_ignored(context, frame, node, key))
                unknown_name(context, frame, key);
        } else if (bad) {
            if (!(frame->seen & bind_bit((uint32_t)row)))
                bind_poison(frame, (uint32_t)row);
            frame->seen |= bind_bit((uint32_t)row);
        } else if (frame->schema->rows[row].key && frame->via && frame->via->kind == SCHEMA_REFERENCE) {
            report_named_inline(context, frame, key);
        } else {
            bind_row(context, frame, (uint32_t)row, single, bind_given_by(context, key));
            const struct schema_row *r = &frame->schema->rows[row];
            if (r->kind == SCHEMA_TEXT && comes_first(r))
                frame->name = *(const str *)schema_field_const(r, frame->memory);
        }
    }
}

void bind_pairs(struct bind_context *context, struct bind_frame *frame, tree_index node) {
    struct bind_key_rows known;
    known.count = 0;
    bind_keys(context, frame, node, true, &known);
    bind_keys(context, frame, node, false, &known);
}

// Whether a map is the short row's value and not the element: all its keys are those of the short row.
static bool is_bare_map(const struct bind_context *context, const struct bind_frame *frame,
                        const struct schema_row *bare, tree_index node) {
    const char *const *names = schema_components(bare->kind);
    bool is_value = false;
    bool single;
    for (tree_index key = tree_first(context->tree, node); key; key = tree_next_key(context->tree, key)) {
        if (bind_find_row(context, frame->schema, key, &single) >= 0)
            return false;
        for (uint32_t i = 0; names[i]; i++)
            is_value = is_value || str_equal_cstr(tree_text(context->tree, key), names[i]);
        is_value = is_value || (bare->kind == SCHEMA_COLOR &&
                                str_equal_cstr(tree_text(context->tree, key), SCHEMA_HEX_ATTRIBUTE));
        is_value = is_value || (bare->child && bind_find_row(context, bare->child, key, &single) >= 0);
    }
    return is_value;
}

static bool is_bare(const struct bind_context *context, const struct bind_frame *frame, int bare,
                    tree_index node) {
    enum tree_kind kind = bind_kind(context, node);
    if (bare < 0 || kind == TREE_NULL)
        return false;
    return kind != TREE_MAP || is_bare_map(context, frame, &frame->schema->rows[bare], node);
}

// The name is the best place for messages about a whole entry.
static span best_label(const struct bind_context *context, const struct bind_frame *frame, int name_row) {
    if (frame->via->many == SCHEMA_ONE || name_row < 0 || !(frame->seen & bind_bit((uint32_t)name_row)))
        return frame->label;
    const struct ir_row_origin *name = ir_origin_row(context->origin, bind_head(frame), (uint32_t)name_row);
    return name ? name->value : frame->label;
}

bool bind_element(struct bind_context *context, struct bind_frame *frame, tree_index node) {
    struct ir_head *head = bind_head(frame);
    const uint32_t comments = ir_origin_add_comments(context->origin, frame->comments);
    head->origin =
        ir_origin_add(context->origin, (struct ir_element_origin){.at = tree_span(context->tree, node),
                                                                  .label = frame->label,
                                                                  .comments = comments});
    const struct schema_facts *facts = schema_index_facts(context->index, frame->schema);
    int bare = facts->short_row;
    if (is_bare(context, frame, bare, node)) {
        frame->bare = true;
        struct bind_given given = {.key_span = frame->label, .value = node};
        if (bind_kind(context, node) == TREE_LIST)
            bare = schema_list_row(frame->schema);
        bind_row(context, frame, (uint32_t)bare, false, given);
    } else if (bind_kind(context, node) == TREE_MAP) {
        struct bind_key_rows known;
        known.count = 0;
        if (facts->names)
            bind_keys(context, frame, node, true, &known);
        frame->label = best_label(context, frame, facts->name_row);
        context->origin->elements.items[head->origin].label = frame->label;
        bind_default_key(context, frame);
        bind_keys(context, frame, node, false, &known);
    } else {
        return bind_wrong_shape(context, bind_subject(frame, NULL), node);
    }
    bind_missing(context, frame, (tree_node(context->tree, node)->flags & (TREE_BAD | TREE_CUT)) != 0);
    return true;
}
