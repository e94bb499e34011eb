// What both readers share: the text as the library gets it, and limits.
//
// Mistakes that glint itself finds in the text (bytes that are not UTF-8, control characters, '/ >', ...)
// are reported and overwritten in a copy of equal length, so that the library reads on and every offset
// holds. Scalars that overlap such a place are marked TREE_BAD by the readers.
// Ownership: the arena of the reader_context, whose guard catches its cap. Thread safety: one thread.
#ifndef GLINT_PARSER_TREE_READER_TEXT_H
#define GLINT_PARSER_TREE_READER_TEXT_H

#include "parser/tree/reader.h"

struct reader_range {
    uint32_t begin, end;
};

struct reader_text {
    uint32_t source;
    uint32_t begin;      // where reading begins: after a byte order mark, or inside a --set option
    str bytes;           // the whole source; what a library reads is bytes[begin..]
    char *copy;          // NULL until something is overwritten; then bytes.ptr
    bool is_overwritten; // by reader_text_open
    bool is_binary;      // so much was wrong that the library's failure adds nothing
    struct {
        struct reader_range *items;
        uint32_t count, capacity;
    } bad; // sorted by reader_text_seal
};

// Reports and overwrites control characters and bytes that are not UTF-8 (unless `foreign_encoding`: that has
// been reported). false: UTF-16 or binary data, reported; there is nothing to read.
bool reader_text_open(const struct reader_context *context, uint32_t source, uint32_t begin,
                      bool foreign_encoding, struct reader_text *text);
// Whether a line that begins like this is the first mark of a merge conflict.
bool reader_begins_conflict(str line);
// Reports the marks of merge conflicts; they and the second version are overwritten, the first one is read.
void reader_conflicts(const struct reader_context *context, struct reader_text *text);
// Overwrites the copy from `begin` on.
void reader_text_put(const struct reader_context *context, struct reader_text *text, uint32_t begin,
                     str replacement);
// Marks a range: a scalar that overlaps it is bad.
void reader_text_mark(const struct reader_context *context, struct reader_text *text, uint32_t begin,
                      uint32_t end);
void reader_text_seal(struct reader_text *text);
bool reader_text_is_bad(const struct reader_text *text, uint32_t begin, uint32_t end);
// Whether the text is only spaces and line ends.
bool reader_text_is_blank(const struct reader_text *text);

// Offset of the first control character in decoded text, except tabs and line ends; its length if none.
size_t reader_find_control(str decoded);

// The beginning of a text from the file, short enough for a message.
str reader_clip(str text);
// E501 at `at`: "<what> (more than N); raise it with ...".
void reader_limit(struct diag_sink *sink, const struct limits *limits, enum limit which, span at,
                  const char *what);
// The same where it is known what is `needed`: the help gives at least that, or none where no limit is so
// great.
void reader_limit_needs(struct diag_sink *sink, const struct limits *limits, enum limit which, span at,
                        const char *what, double needed);

#endif
