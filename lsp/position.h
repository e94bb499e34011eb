// Between byte offsets and the protocol's positions (line and character from 0), in the encoding that client
// and server agreed on; and between paths and file: URIs.
//
// A position behind the end of its line means the line's end (LSP 3.17, "Position"); one inside a character
// means its beginning. Thread safety: pure.
#ifndef GLINT_LSP_POSITION_H
#define GLINT_LSP_POSITION_H

#include "core/arena.h"
#include "core/str.h"

#include <jansson.h>

enum position_encoding {
    POSITION_UTF16, // what the protocol takes where nothing is agreed
    POSITION_UTF8,
    POSITION_UTF32,
};

size_t position_offset(str text, enum position_encoding encoding, uint32_t line, uint32_t character);
void position_of(str text, enum position_encoding encoding, size_t offset, uint32_t *line,
                 uint32_t *character);
// The byte offset of a protocol's position object; the text's length where it is malformed.
size_t position_read(str text, enum position_encoding encoding, const json_t *position);
// A protocol's range object for bytes [begin, end).
json_t *position_range(str text, enum position_encoding encoding, size_t begin, size_t end);

// The path of a file: URI, in the arena; the empty string for URIs of other schemes.
str position_path(struct arena *arena, const char *uri);
// The URI of an absolute path, in the arena.
str position_uri(struct arena *arena, str path);

#endif
