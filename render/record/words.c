#include "render/record/words.h"

#include <ctype.h>
#include <string.h>

static bool is_plain(char c) {
    return isalnum((unsigned char)c) || (c && strchr("_-./=:,+@%", c));
}

static bool is_control(char c) {
    return (unsigned char)c < 0x20 || c == 0x7f;
}

static void add_quoted(struct strbuf *line, str word) {
    strbuf_char(line, '\'');
    for (size_t i = 0; i < word.len; i++)
        if (word.ptr[i] == '\'')
            strbuf_cstr(line, "'\\''");
        else
            strbuf_char(line, word.ptr[i]);
    strbuf_char(line, '\'');
}

static void add_coded(struct strbuf *line, str word) {
    strbuf_cstr(line, "$'");
    for (size_t i = 0; i < word.len; i++)
        if (is_plain(word.ptr[i]) || word.ptr[i] == ' ')
            strbuf_char(line, word.ptr[i]);
        else
            strbuf_format(line, "\\x%02x", (unsigned char)word.ptr[i]);
    strbuf_char(line, '\'');
}

void words_add(struct strbuf *line, str word) {
    bool plain = word.len > 0, control = utf8_first_error(word) < word.len;
    if (line->len)
        strbuf_char(line, ' ');
    for (size_t i = 0; i < word.len; i++) {
        plain = plain && is_plain(word.ptr[i]);
        control = control || is_control(word.ptr[i]);
    }
    if (control)
        add_coded(line, word);
    else if (!plain)
        add_quoted(line, word);
    else
        strbuf_str(line, word);
}

// ---- back

static int digit_of(char c) {
    static const char digits[] = "0123456789abcdef";
    const char *at = c ? strchr(digits, c) : NULL;
    return at ? (int)(at - digits) : -1;
}

// Reads on after "$'". Returns the index after the closing quote; 0: malformed.
static size_t take_coded(str line, size_t at, char *out, size_t *length) {
    while (at < line.len && line.ptr[at] != '\'') {
        if (line.ptr[at] != '\\') {
            out[(*length)++] = line.ptr[at++];
            continue;
        }
        const int high = at + 3 < line.len && line.ptr[at + 1] == 'x' ? digit_of(line.ptr[at + 2]) : -1;
        const int low = high < 0 ? -1 : digit_of(line.ptr[at + 3]);
        if (low < 0)
            return 0;
        out[(*length)++] = (char)(16 * high + low);
        at += 4;
    }
    return at < line.len ? at + 1 : 0;
}

// The same, after "'".
static size_t take_quoted(str line, size_t at, char *out, size_t *length) {
    while (at < line.len && line.ptr[at] != '\'')
        out[(*length)++] = line.ptr[at++];
    return at < line.len ? at + 1 : 0;
}

bool words_take(str *line, struct arena *arena, str *word) {
    const str l = *line = str_trim(*line);
    char *out = arena_alloc(arena, l.len + 1);
    size_t at = 0, length = 0;
    while (at < l.len && l.ptr[at] != ' ') {
        if (l.ptr[at] == '\'')
            at = take_quoted(l, at + 1, out, &length);
        else if (l.ptr[at] == '$' && at + 1 < l.len && l.ptr[at + 1] == '\'')
            at = take_coded(l, at + 2, out, &length);
        else if (l.ptr[at] == '\\' && at + 1 < l.len && l.ptr[at + 1] == '\'')
            out[length++] = '\'', at += 2;
        else if (is_plain(l.ptr[at]) || (unsigned char)l.ptr[at] >= 0x80)
            out[length++] = l.ptr[at++];
        else
            return false;
        if (at == 0)
            return false;
    }
    *line = str_slice(l, at, l.len);
    *word = (str){out, length};
    return l.len > 0;
}
