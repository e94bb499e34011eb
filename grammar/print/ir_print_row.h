// One row of an element in both spellings, on one line. Part of the writers (ir_print.h), for code that shows
// examples. Thread safety: pure except for `out`.
#ifndef GLINT_GRAMMAR_PRINT_IR_PRINT_ROW_H
#define GLINT_GRAMMAR_PRINT_IR_PRINT_ROW_H

#include "core/strbuf.h"

struct ir_scene;
struct schema_element;
struct schema_row;

// `fov: 45`; a key row is the key itself. `scene` holds the anonymous elements; NULL: there are none.
void print_yaml_row(const struct ir_scene *scene, const struct schema_row *row, const void *element,
                    struct strbuf *out);
// `fov="45"`, or the child element.
void print_xml_row(const struct ir_scene *scene, const struct schema_row *row, const void *element,
                   struct strbuf *out);
// Only the value, as YAML: `45`, `[0, 1, 0]`.
void print_yaml_value(const struct schema_row *row, const void *element, struct strbuf *out);
// A whole entry of a list on one line: `{radius: 1, center: [0, 1, 0]}`.
void print_yaml_item(const struct ir_scene *scene, const struct schema_element *schema, const void *item,
                     struct strbuf *out);

#endif
