// What the schemas of the XML spelling have in common: indented lines, tags, patterns. Private to grammar/.
//
// Thread safety: pure except for `out`.
#ifndef GLINT_GRAMMAR_EMIT_EMIT_LINES_H
#define GLINT_GRAMMAR_EMIT_EMIT_LINES_H

#include "core/strbuf.h"
#include "grammar/schema.h"

// Regular expressions as XML Schema writes them.
#define EMIT_NUMBER_PATTERN "[+\\-]?(\\d+\\.?\\d*|\\.\\d+)([eE][+\\-]?\\d+)?"
#define EMIT_HEX_PATTERN    "#[0-9A-Fa-f]{6}"
// What is not a number can only be an expression if it begins with a name, or with a number and an operator.
// (;-> are also < = and >, which XML would want escaped.)
#define EMIT_EXPRESSION_PATTERN                                                                              \
    "[(\\-\\s]*([^\\d\\s!-/:-@\\[-\\^`{-~].*|"                                                               \
    "[\\d.]+([eE][+\\-]?\\d+)?\\)*\\s*(if\\s|[!%*+\\-/;->\\^])\\s*[^\\s].*)"
#define EMIT_NAME_PATTERN "[^\\d\\s!-,./:-@\\[-\\^`{-~][^\\s!-,./:-@\\[-\\^`{-~]{0,127}"

// What the name of a copy ends in, as in pawn[3][0].
#define EMIT_PLACES_PATTERN "(\\[[0-9]+\\])*"
// Of a body in an object: chairs[3]/seat.
#define EMIT_WHOLE_PATTERN                                                                                   \
    EMIT_NAME_PATTERN EMIT_PLACES_PATTERN "(/" EMIT_NAME_PATTERN EMIT_PLACES_PATTERN ")*"

struct emit_lines {
    struct strbuf *out;
    uint32_t depth;
};

// The indentation of a line.
void emit_indent(const struct emit_lines *w);
void emit_line(const struct emit_lines *w, const char *format, ...) __attribute__((format(printf, 2, 3)));
// A start tag on its own line, with the lines after it deeper; an end tag on its own line.
void emit_open(struct emit_lines *w, const char *format, ...) __attribute__((format(printf, 2, 3)));
void emit_close(struct emit_lines *w, const char *tag);

// Each word that looks like a name and cannot be an expression (yes, null), in small letters, in capitals,
// and with one capital, as `put(to, word)`.
void emit_no_words(void (*put)(void *to, const char *word), void *to);

// Whether the rows of this range are whole numbers.
bool emit_is_integer(enum schema_range range);

#endif
