// `glint explain CODE|element[.attribute]`: the entries of the diagnostics' list and of the table, as text.
//
// `glint explain --list [CODE]`: the codes, a line each.
// Codes: title, meaning, remedy, and where they can occur. Elements: every attribute with both spellings,
// and an example in both. Attributes: type, range, unit, default, words. Features of other tools
// (grammar/concept.h): what to do instead. Nothing here is written by hand.
// Thread safety: pure except for `out`.
#ifndef GLINT_GRAMMAR_EMIT_EXPLAIN_H
#define GLINT_GRAMMAR_EMIT_EXPLAIN_H

#include "core/str.h"
#include "core/strbuf.h"

// `what`: "E206", "material", "material.albedo" or "Material" (case of codes does not matter; an attribute by
// itself will do if it is unique). `color`: ANSI colours.
// false: there is no such thing; `out` then holds one sentence that names the nearest thing.
bool explain(str what, bool color, struct strbuf *out);

// One line for each code that `family` names ("W401", "W4xx"; empty: all): code, severity, title.
// false: there is none; `out` then holds one sentence.
bool explain_codes(str family, struct strbuf *out);

#endif
