// Converts comments and the editor's schema line from one spelling to the other. Part of the writers
// (ir_print.h).
//
// `# text` is `<!-- text -->` and back. XML forbids `--` inside a comment: there a backslash is put between
// the two (`-\-`, and one more for each that was there), which YAML's writer removes again.
// Thread safety: pure except for `out`.
#ifndef GLINT_GRAMMAR_PRINT_IR_PRINT_COMMENT_H
#define GLINT_GRAMMAR_PRINT_IR_PRINT_COMMENT_H

#include "core/strbuf.h"
#include "diag/source.h"
#include "grammar/ir_origin.h"
#include "grammar/schema.h"

// Where the writers find what is kept outside the IR; both NULL: nothing is kept.
struct print_places {
    const struct ir_origin *origin;
    const struct source_set *sources;
    span last; // the comments written last, so that a place recorded twice is written once
};

span print_comments_of_row(const struct print_places *places, const struct ir_head *head, uint32_t row);
span print_comments_of_element(const struct print_places *places, const struct ir_head *head);
// The comments of any row. In XML a list has no key of its own, and comments before an item belong to the
// item: SPAN_NONE if the row's comments are an item's.
span print_comments_of_list_row(const struct print_places *places, const struct schema_element *schema,
                                uint32_t i, const void *element);
// Whether there are comments before the row, or before anything inside it.
bool print_row_has_comments(const struct print_places *places, const struct ir_scene *scene,
                            const struct schema_element *schema, uint32_t i, const void *element);
// The same for all rows that an element has.
bool print_has_comments(const struct print_places *places, const struct ir_scene *scene,
                        const struct schema_element *schema, const void *element);
const struct ir_file_origin *print_file_of(const struct print_places *places, const struct ir_scene *scene);

// Writes the comments, each line after `indent` spaces and with its line end. Nothing for SPAN_NONE.
void print_yaml_comments(struct print_places *places, span comments, uint32_t indent, struct strbuf *out);
void print_xml_comments(struct print_places *places, span comments, uint32_t indent, struct strbuf *out);

// The schema line of `file`, with its line end; nothing if it has none.
void print_yaml_schema_line(const struct print_places *places, const struct ir_file_origin *file,
                            struct strbuf *out);
void print_xml_schema_line(const struct print_places *places, const struct ir_file_origin *file,
                           struct strbuf *out);

#endif
