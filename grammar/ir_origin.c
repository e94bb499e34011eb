#include "grammar/ir_origin.h"

#include "grammar/ir_formula.h"
#include "grammar/ir_value.h"
#include "grammar/schema.h"

#include <assert.h>

static uint32_t push_row(struct ir_origin *origin, struct ir_row_origin row) {
    if (ARENA_IS_FULL(&origin->rows))
        origin->rows.items = arena_regrow(origin->arena, origin->rows.items, origin->rows.count,
                                          &origin->rows.capacity, sizeof *origin->rows.items);
    origin->rows.items[origin->rows.count++] = row;
    return origin->rows.count - 1;
}

void ir_origin_init(struct ir_origin *origin, struct arena *arena) {
    *origin = (struct ir_origin){.arena = arena, .formulas = ir_formulas_new(arena)};
    *ARENA_PUSH(arena, &origin->comments) = SPAN_NONE;
    ir_origin_add(origin, (struct ir_element_origin){.at = SPAN_NONE});
    push_row(origin, (struct ir_row_origin){.row = 0});
}

uint32_t ir_origin_add(struct ir_origin *origin, struct ir_element_origin element) {
    if (ARENA_IS_FULL(&origin->elements))
        origin->elements.items = arena_regrow(origin->arena, origin->elements.items, origin->elements.count,
                                              &origin->elements.capacity, sizeof *origin->elements.items);
    origin->elements.items[origin->elements.count++] = element;
    return origin->elements.count - 1;
}

uint32_t ir_origin_add_comments(struct ir_origin *origin, span comments) {
    if (span_is_none(comments))
        return 0;
    *ARENA_PUSH(origin->arena, &origin->comments) = comments;
    return origin->comments.count - 1;
}

void ir_origin_add_row(struct ir_origin *origin, uint32_t element, struct ir_row_origin row) {
    uint32_t last = 0;
    for (uint32_t r = origin->elements.items[element].rows; r; r = origin->rows.items[r].next) {
        struct ir_row_origin *there = &origin->rows.items[r];
        if (there->row == row.row) {
            row.next = there->next;
            *there = row;
            return;
        }
        last = r;
    }
    row.next = 0;
    uint32_t added = push_row(origin, row);
    if (last)
        origin->rows.items[last].next = added;
    else
        origin->elements.items[element].rows = added;
}

void ir_origin_remove_row(struct ir_origin *origin, uint32_t element, uint32_t row) {
    uint32_t *at = &origin->elements.items[element].rows;
    while (*at && origin->rows.items[*at].row != row)
        at = &origin->rows.items[*at].next;
    if (*at)
        *at = origin->rows.items[*at].next;
}

const struct ir_row_origin *ir_origin_row(const struct ir_origin *origin, const struct ir_head *head,
                                          uint32_t row) {
    if (head->origin >= origin->elements.count)
        return NULL;
    for (uint32_t r = origin->elements.items[head->origin].rows; r; r = origin->rows.items[r].next)
        if (origin->rows.items[r].row == row)
            return &origin->rows.items[r];
    return NULL;
}

bool ir_origin_is_xml(const struct ir_origin *origin, uint32_t source) {
    for (uint32_t i = 0; i < origin->files.count; i++)
        if (origin->files.items[i].source == source)
            return origin->files.items[i].is_xml;
    return false;
}

span ir_place_label(const struct ir_origin *origin, const struct ir_head *head) {
    if (head->origin >= origin->elements.count)
        return SPAN_NONE;
    const struct ir_element_origin *element = &origin->elements.items[head->origin];
    return span_is_none(element->label) ? element->at : element->label;
}

static const struct ir_row_origin *named_row(const struct ir_origin *origin, const struct ir_head *head,
                                             const struct schema_element *schema, const char *row_name) {
    int row = schema_find_row(schema, str_from(row_name));
    assert(row >= 0);
    return ir_origin_row(origin, head, (uint32_t)row);
}

span ir_place_value(const struct ir_origin *origin, const struct ir_head *head,
                    const struct schema_element *schema, const char *row_name) {
    const struct ir_row_origin *row = named_row(origin, head, schema, row_name);
    return row ? row->value : ir_place_label(origin, head);
}

span ir_place_key(const struct ir_origin *origin, const struct ir_head *head,
                  const struct schema_element *schema, const char *row_name) {
    const struct ir_row_origin *row = named_row(origin, head, schema, row_name);
    return row ? row->key : ir_place_label(origin, head);
}
