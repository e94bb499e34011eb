// Walks over the IR by the table. Private to parser/. Thread safety: pure.
#ifndef GLINT_PARSER_BIND_VISIT_H
#define GLINT_PARSER_BIND_VISIT_H

#include <stdint.h>

struct ir_reference;
struct schema_element;

struct visit_place {
    const struct schema_element *schema; // of the element that holds the reference
    void *memory;
    uint32_t row;
};

// Called for every reference of an element, of its children and of the entries of its lists, in table order.
typedef void visit_reference(void *context, struct visit_place place, struct ir_reference *reference);
void visit_references(const struct schema_element *schema, void *memory, visit_reference *visit,
                      void *context);

// The row of an element's own name, or -1.
int visit_name_row(const struct schema_element *schema);

#endif
