// The markers that version control leaves in a file that two people changed at the same place.
#include "diag/codes/syntax.h"
#include "parser/tree/reader_text.h"

#include <string.h>

enum {
    MARKER = 7, // equal characters, and a space or the line's end after them
    LOOK_BYTES = 512
};

// Looks no further than it must: a text may have one kind of line end only.
static uint32_t line_end(str text, uint32_t at) {
    for (;;) {
        uint32_t most = text.len - at < LOOK_BYTES ? (uint32_t)text.len : at + LOOK_BYTES;
        const char *feed = memchr(text.ptr + at, '\n', most - at);
        uint32_t end = feed ? (uint32_t)(feed - text.ptr) : most;
        const char *carriage = memchr(text.ptr + at, '\r', end - at);
        if (carriage)
            return (uint32_t)(carriage - text.ptr);
        if (feed || end == text.len)
            return end;
        at = end;
    }
}

static bool is_marker(str text, uint32_t at, char c) {
    if (text.len - at < MARKER)
        return false;
    for (uint32_t i = 0; i < MARKER; i++)
        if (text.ptr[at + i] != c)
            return false;
    return text.len - at == MARKER || memchr(" \r\n", text.ptr[at + MARKER], 3);
}

bool reader_begins_conflict(str line) {
    return is_marker(line, 0, '<');
}

// The first line from `at` on that is a marker of `c`; the text's length if there is none.
static uint32_t find_marker(str text, uint32_t at, char c) {
    while (at < text.len && !is_marker(text, at, c)) {
        at = line_end(text, at);
        at += at < text.len;
    }
    return at;
}

static void blank_out(const struct reader_context *context, struct reader_text *text, uint32_t begin,
                      uint32_t end) {
    for (uint32_t at = begin; at < end; at++)
        if (text->bytes.ptr[at] != '\n' && text->bytes.ptr[at] != '\r')
            reader_text_put(context, text, at, STR(" "));
    reader_text_mark(context, text, begin, end);
}

static span marker_at(const struct reader_text *text, uint32_t at) {
    return (span){text->source, at, at + MARKER};
}

void reader_conflicts(const struct reader_context *context, struct reader_text *text) {
    str all = text->bytes;
    struct diag_sink *sink = context->sink;
    bool has_end = true;
    for (uint32_t at = find_marker(all, text->begin, '<'); at < all.len; at = find_marker(all, at, '<')) {
        uint32_t middle = has_end ? find_marker(all, at, '=') : (uint32_t)all.len;
        uint32_t end = find_marker(all, middle, '>');
        has_end = end < all.len; // if there is none here, there is none later either
        diag_add(sink, DIAG_MERGE_CONFLICT, marker_at(text, at),
                 "a merge conflict in these lines was not resolved");
        blank_out(context, text, at, line_end(all, at));
        at = line_end(all, at);
        if (end < all.len) {
            // The common ancestor of both versions.
            uint32_t base = find_marker(str_slice(all, 0, middle), at, '|');
            diag_note(sink, marker_at(text, middle), "the second version begins here");
            diag_note(sink, marker_at(text, end), "it ends here");
            diag_help(sink, "keep one version, or parts of both, and remove the lines with the marks");
            at = line_end(all, end);
            blank_out(context, text, base < middle ? base : middle, at);
        } else {
            diag_help(sink, "remove the line, and everything that does not belong to the scene");
        }
        all = text->bytes;
    }
}
