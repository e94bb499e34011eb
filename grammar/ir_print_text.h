// Scalars of the two spellings: quoting, escapes, numbers. Part of the writers (ir_print.h).
//
// Thread safety: pure except for `out`.
#ifndef GLINT_GRAMMAR_IR_PRINT_TEXT_H
#define GLINT_GRAMMAR_IR_PRINT_TEXT_H

#include "core/strbuf.h"

struct schema_row;

// Text as YAML: plain if every reader of YAML 1.1 and 1.2 reads it as the same text, else in double
// quotes, on one line. `in_flow`: between brackets or as a key, where fewer characters may be plain.
void print_yaml_text(struct strbuf *out, str text, bool in_flow);
// An expression, in quotes only where YAML would end it or read it as something else.
void print_yaml_expression(struct strbuf *out, str text);
// Whether a literal block ('|') shows the text as it is: several lines, nothing that needs an escape.
bool print_yaml_is_literal(str text);
// The block's header ("|" or "|-") and its lines, indented; ends with a line end.
void print_yaml_literal(struct strbuf *out, str text, uint32_t indent);
// Text as a JSON string that YAML reads the same.
void print_json_text(struct strbuf *out, str text);
// Text inside double quotes in XML; line ends and tabs as character references.
void print_xml_text(struct strbuf *out, str text);

void print_number(struct strbuf *out, double value);
void print_hex_color(struct strbuf *out, uint32_t hex);
// Whether one number is enough: equal components of a colour, or of a vector that accepts one number.
bool print_is_uniform(const struct schema_row *row, const void *field);
// The value of a scalar row (number, word, boolean, text, reference by name) without quotes.
void print_plain_value(struct strbuf *out, const struct schema_row *row, const void *field);
// Code points after the last line end.
size_t print_column(const struct strbuf *out);

#endif
