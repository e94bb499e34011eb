#include "grammar/ir_walk.h"
#include "lsp/locate.h"

void locate_walk(const struct schema_element *schema, const void *element, locate_visit *visit,
                 void *context) {
    visit(context, schema, element);
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (row->kind == SCHEMA_ELEMENT)
            locate_walk(row->child, schema_field_const(row, element), visit, context);
        struct ir_any_list list = ir_walk_list(row, element);
        for (uint32_t k = 0; k < list.count; k++)
            locate_walk(row->child, ir_walk_item(row, list, k), visit, context);
    }
}
