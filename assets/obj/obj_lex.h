// The words of Wavefront's text formats (OBJ, MTL): spaces, line ends, continuation lines, numbers.
//
// Lines end with \n, \r\n or a \r by itself; a backslash directly before a line end continues the line; '#'
// at the beginning of a word begins a comment. Offsets are bytes from the beginning of the text.
// Thread safety: a cursor belongs to one thread.
#ifndef GLINT_ASSETS_OBJ_OBJ_LEX_H
#define GLINT_ASSETS_OBJ_OBJ_LEX_H

#include "core/number.h"
#include "core/str.h"

struct obj_lex {
    const char *begin;
    const char *end;
    const char *at;
    uint32_t line; // of `at`, from 1
};

// Skips a byte order mark.
void obj_lex_init(struct obj_lex *lex, str text);
static inline bool obj_lex_done(const struct obj_lex *lex) {
    return lex->at == lex->end;
}
static inline size_t obj_lex_offset(const struct obj_lex *lex) {
    return (size_t)(lex->at - lex->begin);
}

// Moves over spaces, tabs and continued line ends; false if the line (or its comment) ends there.
bool obj_lex_more(struct obj_lex *lex);
// Moves past the line end, continued lines included.
void obj_lex_next_line(struct obj_lex *lex);
// The word at the cursor, up to a space, tab, line end or continuation; moves past it.
str obj_lex_word(struct obj_lex *lex);
// The rest of the line, trimmed, '#' included: names may contain spaces. A continuation ends it.
str obj_lex_rest(struct obj_lex *lex);

// Reads the word at the cursor as a number, written as in the scene language, but leading zeros are allowed;
// too small ones are 0, and -0 is 0. The cursor is after the word in any case. On failure *value = 0.
enum number_status obj_lex_number(struct obj_lex *lex, double *value);

// Reads a decimal integer with an optional sign at the cursor, which moves past its digits; false if there is
// none. Values beyond ±2^40 are clamped to it.
bool obj_lex_integer(struct obj_lex *lex, int64_t *value);
// Whether the cursor is at the end of a word.
bool obj_lex_word_ends(const struct obj_lex *lex);

#endif
