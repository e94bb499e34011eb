// Several of a row: lists and maps in YAML, repeated children in XML, gathered where the first one stands.
#include "parser/bind/bind.h"
#include "parser/bind/say.h"

#include <string.h>

// The values of one row, one after the other.
struct values {
    bool repeated; // XML
    bool named;    // a YAML map
    uint32_t row;
    tree_index at; // a key where repeated or named, else an item; 0: no more
};

static tree_index following(const struct bind_context *context, const struct bind_frame *frame,
                            const struct values *values) {
    const struct tree *tree = context->tree;
    bool single;
    if (!values->repeated)
        return values->named ? tree_next_key(tree, values->at) : tree_next(tree, values->at);
    tree_index key = tree_next_key(tree, values->at);
    while (key && bind_find_row(context, frame->schema, key, &single) != (int)values->row)
        key = tree_next_key(tree, key);
    return key;
}

// Gives the number of values; *good: all of them, and as many as there must be.
static uint32_t bind_slots(struct bind_context *context, struct bind_frame *frame, struct values values,
                           bool *good) {
    const struct schema_row *row = &frame->schema->rows[values.row];
    char *field = schema_field(row, frame->memory);
    uint32_t count = 0;
    for (; values.at; values.at = following(context, frame, &values), count++) {
        tree_index node = values.repeated ? tree_value(context->tree, values.at) : values.at;
        struct bind_subject subject = {.frame = frame, .row = row, .index = (int)count};
        char *slot = arena_alloc(context->scratch, row->size);
        if (!bind_value(context, subject, node, slot))
            *good = false;
        else if (count < row->fixed_count)
            memcpy(field + (size_t)count * row->size, slot, row->size);
    }
    return count;
}

static void bind_fixed(struct bind_context *context, struct bind_frame *frame, uint32_t row,
                       struct bind_given given, struct values values, bool may_be_cut) {
    const struct schema_row *r = &frame->schema->rows[row];
    bool good = !bind_is_bad(context, given.value) || values.repeated;
    uint32_t count = bind_slots(context, frame, values, &good);
    bool too_few = count < r->fixed_count;
    if (count != r->fixed_count) {
        bool silent = (bind_is_bad(context, given.value) && !values.repeated) || (too_few && may_be_cut);
        good = false;
        if (!silent) {
            diag_add(context->sink, DIAG_WRONG_COUNT,
                     values.repeated ? given.key_span : tree_span(context->tree, given.value),
                     "%.*s has %u value%s; it needs %u",
                     STR_ARG(say_subject(context->scratch, bind_subject(frame, r))), count,
                     count == 1 ? "" : "s", r->fixed_count);
            diag_help(context->sink, "for example %.*s",
                      STR_ARG(say_example(context->scratch, r, context->tree->is_xml)));
        }
    }
    if (!good)
        bind_clear_row(context->scratch, context->origin, frame->schema, frame->memory, row);
    bind_note_row(context, frame, row, given);
    bind_head(frame)->written |= bind_bit(row);
    if (!good)
        bind_poison(frame, row);
}

static void bind_entries(struct bind_context *context, struct bind_frame *frame, uint32_t row,
                         struct bind_given given, struct values values) {
    const struct schema_row *r = &frame->schema->rows[row];
    bind_note_row(context, frame, row, given);
    bool taken = values.repeated && (tree_node(context->tree, values.at)->flags & TREE_TAKEN);
    for (; values.at && !taken; values.at = following(context, frame, &values)) {
        bool has_key = values.repeated || values.named;
        if (values.named && !bind_is_bad(context, values.at))
            bind_loose_columns(context, NULL, r, values.at);
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

// A list or map that is there and holds nothing is the same as none.
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
    struct values all = {.repeated = true, .row = row, .at = given.key};
    if (frame->schema->rows[row].many == SCHEMA_FIXED)
        bind_fixed(context, frame, row, given, all, context->tree->broken);
    else
        bind_entries(context, frame, row, given, all);
}

void bind_many(struct bind_context *context, struct bind_frame *frame, uint32_t row, bool single,
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
        bind_loose_entries(context, frame, row, given, true);
        return;
    }
    struct values all = {.named = kind == TREE_MAP, .row = row, .at = tree_first(context->tree, given.value)};
    if (r->many == SCHEMA_FIXED)
        bind_fixed(context, frame, row, given, all,
                   (tree_node(context->tree, given.value)->flags & TREE_CUT) != 0);
    else
        bind_entries(context, frame, row, given, all);
}
