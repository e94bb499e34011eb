#include "assets/obj/obj_lex.h"

#include "assets/file/mesh_number.h"

void obj_lex_init(struct obj_lex *lex, str text) {
    *lex = (struct obj_lex){
        .begin = text.ptr, .end = text.ptr + text.len, .at = text.ptr + str_skip_mark(text), .line = 1};
}

// Length of the line end at `p`, 0 if there is none.
static size_t line_end_length(const char *p, const char *end) {
    if (p == end || !char_is_break(*p))
        return 0;
    return *p == '\r' && p + 1 < end && p[1] == '\n' ? 2 : 1;
}

// Length of the continuation at `p`, 0 if there is none. A backslash elsewhere is an ordinary character (of a
// path).
static size_t continuation_length(const char *p, const char *end) {
    if (p == end || *p != '\\')
        return 0;
    size_t length = line_end_length(p + 1, end);
    return length ? length + 1 : 0;
}

bool obj_lex_more(struct obj_lex *lex) {
    for (;;) {
        while (lex->at < lex->end && (*lex->at == ' ' || *lex->at == '\t'))
            lex->at++;
        size_t length = continuation_length(lex->at, lex->end);
        if (length == 0)
            return lex->at < lex->end && !char_is_break(*lex->at) && *lex->at != '#';
        lex->at += length;
        lex->line++;
    }
}

void obj_lex_next_line(struct obj_lex *lex) {
    // A comment ends with its line, whatever its last character is.
    bool is_comment = lex->at < lex->end && *lex->at == '#';
    for (;;) {
        while (lex->at < lex->end && !char_is_break(*lex->at))
            lex->at++;
        if (lex->at == lex->end)
            return;
        bool continues = !is_comment && lex->at > lex->begin && lex->at[-1] == '\\';
        lex->at += line_end_length(lex->at, lex->end);
        lex->line++;
        if (!continues)
            return;
    }
}

static bool ends_word(const char *p, const char *end) {
    return p == end || *p == ' ' || *p == '\t' || char_is_break(*p) || continuation_length(p, end);
}

bool obj_lex_word_ends(const struct obj_lex *lex) {
    return ends_word(lex->at, lex->end);
}

str obj_lex_word(struct obj_lex *lex) {
    const char *begin = lex->at;
    while (!ends_word(lex->at, lex->end))
        lex->at++;
    return (str){begin, (size_t)(lex->at - begin)};
}

str obj_lex_rest(struct obj_lex *lex) {
    const char *begin = lex->at;
    while (lex->at < lex->end && !char_is_break(*lex->at) && !continuation_length(lex->at, lex->end))
        lex->at++;
    return str_trim((str){begin, (size_t)(lex->at - begin)});
}

enum number_status obj_lex_number(struct obj_lex *lex, double *value) {
    size_t length = number_take((str){lex->at, (size_t)(lex->end - lex->at)}, value);
    if (length && ends_word(lex->at + length, lex->end)) {
        lex->at += length;
        return NUMBER_OK;
    }
    return mesh_number(obj_lex_word(lex), value);
}

bool obj_lex_integer(struct obj_lex *lex, int64_t *value) {
    const char *p = lex->at;
    bool negative = p < lex->end && *p == '-';
    if (p < lex->end && (*p == '-' || *p == '+'))
        p++;
    const char *begin = p;
    int64_t n = 0;
    for (; p < lex->end && char_is_digit(*p); p++)
        n = n < INT64_C(1) << 36 ? n * 10 + (*p - '0') : INT64_C(1) << 40;
    if (p == begin)
        return false;
    lex->at = p;
    *value = negative ? -n : n;
    return true;
}
