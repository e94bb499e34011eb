#include "parser/visit.h"

#include "parser/bind.h"

static void visit_row(const struct schema_element *schema, void *memory, uint32_t row, visit_reference *visit,
                      void *context) {
    const struct schema_row *r = &schema->rows[row];
    void *field = schema_field(r, memory);
    if (r->kind == SCHEMA_REFERENCE)
        visit(context, (struct visit_place){schema, memory, row}, field);
    if (r->kind == SCHEMA_ELEMENT)
        visit_references(r->child, field, visit, context);
    if (r->kind != SCHEMA_LIST)
        return;
    for (uint32_t i = 0; i < bind_list_count(field); i++)
        visit_references(r->child, bind_list_item(field, i, r->child->size), visit, context);
}

void visit_references(const struct schema_element *schema, void *memory, visit_reference *visit,
                      void *context) {
    for (uint32_t i = 0; i < schema->row_count; i++)
        visit_row(schema, memory, i, visit, context);
}

int visit_name_row(const struct schema_element *schema) {
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (schema->rows[i].kind == SCHEMA_TEXT && schema->rows[i].text == SCHEMA_TEXT_NAME)
            return (int)i;
    return -1;
}
