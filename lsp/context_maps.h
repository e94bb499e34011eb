// The maps of YAML around a place of a text that may be torn, and their keys.
//
// Output: pieces of the text, nothing that is allocated. Thread safety: pure functions.
#ifndef GLINT_LSP_CONTEXT_MAPS_H
#define GLINT_LSP_CONTEXT_MAPS_H

#include "core/str.h"

#include <stdbool.h>
#include <stddef.h>

struct context_map {
    size_t begin; // of its first key
    size_t end;   // of the lines that it can have
    int column;   // of its keys; of one in braces, of the line that it begins in
    bool is_flow;
};
// On the way outwards.
struct context_climb {
    str text;
    size_t at;         // all maps that begin after it were met
    int limit;         // the next map begins left of this column
    bool is_inclusive; // or there
    bool is_block;     // no bracket is open at `at`
};
struct context_climb context_climb_from(str text, size_t offset);
// The next map around the place. false: there is none.
bool context_climb(struct context_climb *climb, struct context_map *map);

struct context_key {
    str name;
    size_t begin, end; // of the value
};
// The key at *at, first map->begin, and where the next one is. false: there is none.
bool context_next_key(str text, const struct context_map *map, size_t *at, struct context_key *key);

// A key with or without quotes, and its colon. *after: behind that. Empty: there is none.
str context_take_key(str text, size_t at, size_t end, size_t *after);
// Where a value in braces ends: at the comma or bracket behind it.
size_t context_value_end(str text, size_t at, size_t end);
// The bracket that is open at `at`, looking back; text.len: none.
size_t context_open_bracket(str text, size_t at);
size_t context_line_begin(str text, size_t at);
size_t context_line_end(str text, size_t at, size_t end);
// Where the content of a line begins, after spaces and the '-' of entries, and before `most`. *dash: the
// column of the last '-'; -1: none.
size_t context_content(str text, size_t begin, size_t most, int *dash);
// The column of the first thing in a line; *at: its place. -1: the line is empty, or a comment.
int context_column(str text, size_t begin, size_t *at);

static inline bool context_is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
static inline size_t context_skip_spaces(str text, size_t at, size_t end) {
    while (at < end && context_is_space(text.ptr[at]))
        at++;
    return at;
}

#endif
