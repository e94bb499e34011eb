#include "parser/bind/visit.h"

#include "parser/bind/bind.h"

// Rows that are references, or contain some.
static uint64_t rows_with_references(const struct schema_element *schema) {
    uint64_t rows = 0;
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *r = &schema->rows[i];
        bool nests = r->kind == SCHEMA_ELEMENT || r->kind == SCHEMA_LIST;
        if (r->kind == SCHEMA_REFERENCE || (nests && rows_with_references(r->child)))
            rows |= bind_bit(i);
    }
    return rows;
}

static void visit_rows(const struct schema_element *schema, uint64_t rows, void *memory,
                       visit_reference *visit, void *context);

static void visit_row(const struct schema_element *schema, void *memory, uint32_t row, visit_reference *visit,
                      void *context) {
    const struct schema_row *r = &schema->rows[row];
    void *field = schema_field(r, memory);
    if (r->kind == SCHEMA_REFERENCE) {
        visit(context, (struct visit_place){schema, memory, row}, field);
        return;
    }
    uint64_t rows = rows_with_references(r->child);
    if (r->kind == SCHEMA_ELEMENT) {
        visit_rows(r->child, rows, field, visit, context);
        return;
    }
    for (uint32_t i = 0; i < bind_list_count(field); i++)
        visit_rows(r->child, rows, bind_list_item(field, i, r->child->size), visit, context);
}

static void visit_rows(const struct schema_element *schema, uint64_t rows, void *memory,
                       visit_reference *visit, void *context) {
    for (uint32_t i = 0; rows >> i; i++)
        if (rows >> i & 1)
            visit_row(schema, memory, i, visit, context);
}

void visit_references(const struct schema_element *schema, void *memory, visit_reference *visit,
                      void *context) {
    visit_rows(schema, rows_with_references(schema), memory, visit, context);
}

int visit_name_row(const struct schema_element *schema) {
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (schema->rows[i].kind == SCHEMA_TEXT && schema->rows[i].text == SCHEMA_TEXT_NAME)
            return (int)i;
    return -1;
}
