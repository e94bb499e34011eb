// The canonical layout of a scene file, in both spellings: text in, text out. docs/format.md describes it.
//
// Only white space changes: comments, quoting, numbers, anchors, aliases, merge keys and the order of
// keys stay, as do the byte order mark, the kind of line ends and whether the last line has one. The output
// is read again and compared with the input; text with another meaning is never returned.
// Ownership: the result is appended to the caller's strbuf. Errors: diagnostics in the context's sink.
// Thread safety: one call belongs to one thread; the context's arena must be guarded.
#ifndef GLINT_PARSER_FORMAT_FORMAT_H
#define GLINT_PARSER_FORMAT_FORMAT_H

#include "core/strbuf.h"
#include "parser/stages/upgrade.h"
#include "parser/tree/reader.h"

enum format_status {
    FORMAT_DONE,    // also if the file has mistakes of meaning, which stay unchanged
    FORMAT_REFUSED, // the text cannot be read to its end, or in part: the sink says why
    FORMAT_UNSAFE,  // the layout would have changed what the file means: a mistake of this program
};

// `upgrade` NULL: versions stay. The sink gets all that the reader reports about the text, warnings and
// mistakes of meaning included: callers show it if the status is not FORMAT_DONE.
enum format_status format_source(const struct reader_context *context, uint32_t source,
                                 const struct upgrade_table *upgrade, struct strbuf *out);

#endif
