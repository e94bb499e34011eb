// Where text comes from, and places in it.
//
// A source is a file, a `--set` option, an overlay (unsaved text, fuzz input) or the built-in defaults.
// A `span` names a source and a range of bytes; lines and columns are computed when text is made,
// from a line map that is built on first use. Lines and columns count from 1, columns in code points.
// Ownership: the set copies paths and takes its text from the caller's arena, which must outlive it.
// Thread safety: adding is for one thread; a set that no longer grows may be read by many once
// `source_locate` has been called for each source, or under the caller's lock.
#ifndef GLINT_DIAG_SOURCE_H
#define GLINT_DIAG_SOURCE_H

#include "core/arena.h"
#include "core/str.h"

#include <stdint.h>

typedef struct {
    uint32_t source; // index in the set; 0 is the built-in default, which has no text
    uint32_t begin;  // bytes
    uint32_t end;
} span;

enum {
    SOURCE_DEFAULT = 0
};
#define SPAN_NONE ((span){0, 0, 0})

enum source_kind {
    SOURCE_KIND_DEFAULT, // values that nobody wrote
    SOURCE_KIND_FILE,
    SOURCE_KIND_OPTION,    // a --set option
    SOURCE_KIND_OVERLAY,   // text from memory in place of a file
    SOURCE_KIND_GENERATED, // text that nobody wrote, around a file: it is never shown
};

struct source {
    str path; // as shown to people
    str text;
    enum source_kind kind;
    uint32_t *line_starts; // byte offsets, built on demand
    uint32_t line_count;
    uint32_t *characters; // byte offsets of every SOURCE_STEPth character, built with them
    uint32_t character_count;
};

enum {
    SOURCE_STEP = 1024
};

struct source_set {
    struct arena *arena;
    struct source *items;
    uint32_t count;
    uint32_t capacity;
};

struct source_place {
    str path;
    uint32_t line;
    uint32_t column;
    uint32_t end_line;
    uint32_t end_column; // the column after the last character
    str line_text;       // without its line end; empty if the source has no text
    uint32_t begin, end; // the place's part of line_text, in bytes
};

// Creates the set with source 0, "default".
void source_set_init(struct source_set *set, struct arena *arena);
// Adds a source and returns its index. `text` is not copied and must be shorter than 4 GiB; `path` is copied.
uint32_t source_add(struct source_set *set, enum source_kind kind, str path, str text);
// The same sources in an arena of their own; their texts and paths are shared.
void source_set_copy(const struct source_set *from, struct arena *arena, struct source_set *out);
struct source_place source_locate(struct source_set *set, span at);
// Only the line: the time does not depend on the line's length.
uint32_t source_line(struct source_set *set, span at);
// A line, counted from 1, without its line end; after the last line: nothing, at the end of the text.
span source_line_span(struct source_set *set, uint32_t source, uint32_t line);
// The text of a span; the empty string for spans without text.
str source_text(const struct source_set *set, span at);
// From the beginning of `a` to the end of `b`; both in one source.
span span_join(span a, span b);
bool span_is_none(span s);
bool span_equal(span a, span b);

#endif
