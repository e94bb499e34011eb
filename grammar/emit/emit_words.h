// The words in which schemas, the reference page and `explain` describe a row. Private to grammar/.
//
// Thread safety: pure except for `out`.
#ifndef GLINT_GRAMMAR_EMIT_EMIT_WORDS_H
#define GLINT_GRAMMAR_EMIT_EMIT_WORDS_H

#include "core/strbuf.h"
#include "grammar/schema.h"

// The kind of value: "number", "vector x y z", "one of clip, normalize", "list of lights".
void emit_type_words(const struct schema_row *row, struct strbuf *out);
// Range and unit: "greater than 0 and less than 180, degrees"; nothing if neither says anything.
void emit_range_words(const struct schema_row *row, struct strbuf *out);
// The default as YAML: `60`, `[0, 1, 0]`; nothing if there is none.
void emit_default_words(const struct schema_row *row, struct strbuf *out);
// The element's choice rows that exclude this one: "`look_at`, `rotation`"; returns their number.
uint32_t emit_rivals(const struct schema_element *schema, uint32_t i, const char *quote, struct strbuf *out);
// An example of the row in both spellings, each on one line.
void emit_yaml_sample(const struct schema_element *schema, uint32_t i, struct strbuf *out);
void emit_xml_sample(const struct schema_element *schema, uint32_t i, struct strbuf *out);
// The whole element at its place in a scene, in both spellings.
void emit_yaml_example(const struct schema_element *schema, struct strbuf *out);
void emit_xml_example(const struct schema_element *schema, struct strbuf *out);

#endif
