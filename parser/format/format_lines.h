// The lines that the formatter writes, each with the comment after it: comments that were in the same column
// are aligned again. Private to parser/format*.c.
//
// Ownership: lists in the arena (which must be guarded), text in the strbuf; both the caller's.
// Thread safety: one thread.
#ifndef GLINT_PARSER_FORMAT_FORMAT_LINES_H
#define GLINT_PARSER_FORMAT_FORMAT_LINES_H

#include "core/arena.h"
#include "core/strbuf.h"

struct format_line {
    size_t begin, end; // in `body`
    str comment;       // after the text on this line; may hold line ends; empty: none
    uint32_t column;   // column of the comment in the source, in characters
    bool is_ended;     // by an LS or PS in its text
};

struct format_lines {
    struct arena *arena;
    struct strbuf body;
    struct {
        struct format_line *items;
        uint32_t count, capacity;
    } lines;
    uint32_t comment_gap; // spaces before a comment after a line
    uint32_t column;      // column of what comes next, in characters
    bool begun;           // something was written
    bool is_open;         // the source ends within the last line, where a line end would change it
};

void format_lines_init(struct format_lines *lines, struct arena *arena, uint32_t comment_gap);
void format_lines_finish(struct format_lines *lines);
// Begins a line after `blank` empty ones; the very first line begins at once.
void format_lines_next(struct format_lines *lines, uint32_t blank, uint32_t indent);
void format_lines_text(struct format_lines *lines, str text);
// The line that was begun last needs no line end.
void format_lines_ended(struct format_lines *lines);
// A comment after the line that was begun last. A comment of several lines is moved as a whole. A further
// comment there must follow the first in the same text, with only spaces between.
void format_lines_comment(struct format_lines *lines, str comment, uint32_t column);
// A comment of one or several lines that was at `column` and now begins at the line's column.
void format_lines_moved(struct format_lines *lines, str comment, uint32_t column);
// All lines, each ended by `line_end` or already ended, the last one only if `last_end` is set.
void format_lines_write(const struct format_lines *lines, str line_end, bool last_end, struct strbuf *out);

// The part of `text` from *at to its line's end, spaces included; *at moves past the line end (LF, CRLF or
// CR).
str format_take_line(str text, size_t *at);
// A place in a text and its column, from which the next one is counted.
struct format_place {
    uint32_t at, column;
    bool is_yaml; // NEL, LS and PS end lines, too
};
// Characters between the line's beginning and `at`, which is not before *last; *last moves to `at`.
uint32_t format_column(str text, struct format_place *last, uint32_t at);

#endif
