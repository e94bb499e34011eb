#include "grammar/ir_origin.h"

#include "grammar/schema.h"

#include <assert.h>

void ir_origin_init(struct ir_origin *origin, struct arena *arena) {
    *origin = (struct ir_origin){.arena = arena};
    ir_origin_add(origin, (struct ir_element_origin){.at = SPAN_NONE});
}

uint32_t ir_origin_add(struct ir_origin *origin, struct ir_element_origin element) {
    struct ir_element_origin *added = ARENA_PUSH(origin->arena, &origin->elements);
    *added = element;
    return origin->elements.count - 1;
}

void ir_origin_add_row(struct ir_origin *origin, uint32_t element, struct ir_row_origin row) {
    struct ir_row_origin **at = &origin->elements.items[element].rows;
    while (*at && (*at)->row != row.row)
        at = &(*at)->next;
    if (!*at)
        *at = ARENA_NEW(origin->arena, struct ir_row_origin);
    struct ir_row_origin *next = (*at)->next;
    **at = row;
    (*at)->next = next;
}

void ir_origin_remove_row(struct ir_origin *origin, uint32_t element, uint32_t row) {
    struct ir_row_origin **at = &origin->elements.items[element].rows;
    while (*at && (*at)->row != row)
        at = &(*at)->next;
    if (*at)
        *at = (*at)->next;
}

const struct ir_row_origin *ir_origin_row(const struct ir_origin *origin, const struct ir_head *head,
                                          uint32_t row) {
    if (head->origin >= origin->elements.count)
        return NULL;
    for (const struct ir_row_origin *r = origin->elements.items[head->origin].rows; r; r = r->next)
        if (r->row == row)
            return r;
    return NULL;
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
