// Files made from the tables of the language and of the codes: for editors and readers. The committed copies
// (docs/schema/, docs/reference.md, docs/limits.md, docs/codes.md)
// are kept equal by a test.
//
// Errors: only lack of memory; check `out->failed`. Thread safety: pure except for `out`.
#ifndef GLINT_GRAMMAR_EMIT_EMIT_H
#define GLINT_GRAMMAR_EMIT_EMIT_H

#include "core/strbuf.h"

// JSON Schema draft-07 for the YAML spelling: closed objects, descriptions for hovering.
void emit_json_schema(struct strbuf *out);
// RELAX NG (XML syntax) for the XML spelling.
void emit_relaxng(struct strbuf *out);
// RELAX NG in its compact syntax: the same language.
void emit_relaxng_compact(struct strbuf *out);
// XML Schema 1.0 for the XML spelling, for completion; it also accepts texts that are not scenes.
// The reference page, docs/reference.md.
void emit_markdown(struct strbuf *out);
// The features of other tools and what to do instead, docs/limits.md.
void emit_limits(struct strbuf *out);
// The page of all codes of messages, docs/codes.md.
void emit_codes(struct strbuf *out);

#endif
