// The values of a row that has several, one after the other; and rows that have a fixed number of them.
#include "diag/codes/binding.h"
#include "parser/bind/bind.h"
#include "parser/bind/say.h"

#include <string.h>

tree_index bind_next_value(const struct bind_context *context, const struct bind_frame *frame,
                           const struct bind_values *values) {
    const struct tree *tree = context->tree;
    bool single;
    if (!values->repeated)
        return values->named ? tree_next_key(tree, values->at) : tree_next(tree, values->at);
    tree_index key = tree_next_key(tree, values->at);
    while (key && bind_find_row(context, frame->schema, key, &single) != (int)values->row)
        key = tree_next_key(tree, key);
    return key;
}

// Returns the number of values; *good: all are valid, and there are as many as required.
static uint32_t bind_slots(struct bind_context *context, struct bind_frame *frame, struct bind_values values,
                           bool *good) {
    const struct schema_row *row = &frame->schema->rows[values.row];
    char *field = schema_field(row, frame->memory);
    uint32_t count = 0;
    for (; values.at; values.at = bind_next_value(context, frame, &values), count++) {
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

void bind_fixed(struct bind_context *context, struct bind_frame *frame, uint32_t row, struct bind_given given,
                struct bind_values values, bool may_be_cut) {
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
