// Converts between byte offsets and the protocol's positions (line and character from 0), in the encoding
// that client and server agreed on, and between paths and file: URIs.
//
// Lines end as the protocol says: "\n", "\r\n" or "\r". A position past the end of its line means the line's
// end (LSP 3.17, "Position"); one inside a character, its beginning. Thread safety: pure, except for the
// index, which belongs to one thread.
#ifndef GLINT_LSP_POSITION_H
#define GLINT_LSP_POSITION_H

#include "core/arena.h"
#include "core/str.h"

#include <jansson.h>

enum position_encoding {
    POSITION_UTF16, // the protocol's default if nothing is agreed
    POSITION_UTF8,
    POSITION_UTF32,
};

// Marks in a text from which positions are counted. Without them every position needs a walk from the
// beginning.
struct position_mark {
    size_t offset;
    uint32_t line, character;
};
struct position_index {
    str text; // not owned
    enum position_encoding encoding;
    struct position_mark *marks;
    uint32_t count, capacity;
};

// Zeroed memory is an index of no text. Makes it an index of `text`; does nothing if it is one already. If
// memory runs out, positions are right but slow.
void position_index_use(struct position_index *index, str text, enum position_encoding encoding);
// Must be called before the text is freed.
void position_index_forget(struct position_index *index);
void position_index_finish(struct position_index *index);

// The beginning of a line found in the text; valid as long as no byte before it changes. Zeroed: the first
// line.
struct position_hint {
    size_t begin;
    uint32_t line;
};
// The byte offset of a protocol's position object; the text's length if it is malformed. With a hint (NULL:
// none), which is updated, a place near the last one is found at once.
size_t position_read(str text, enum position_encoding encoding, const json_t *position,
                     struct position_hint *hint);
// A protocol's range object for bytes [begin, end).
json_t *position_range(const struct position_index *index, size_t begin, size_t end);
// The range of a whole text's bytes [begin, end), if only one range of the text is needed.
json_t *position_range_once(str text, enum position_encoding encoding, size_t begin, size_t end);

// At most that many bytes from the beginning of the text, in whole characters.
str position_clip(str text, size_t most);
// A JSON string; what is not UTF-8 becomes U+FFFD.
json_t *position_string(str text);

// The path of a file: URI, in the arena; the empty string for URIs of other schemes.
str position_path(struct arena *arena, const char *uri);
// The URI of an absolute path, in the arena.
str position_uri(struct arena *arena, str path);

#endif
