#include "grammar/ir_print_text.h"

#include "core/number.h"
#include "grammar/ir_value.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"

#include <stdio.h>
#include <string.h>

// Words that some version of YAML reads as a boolean or as null; letter case does not matter.
static bool is_reserved(str text) {
    static const char *const words[] = {"y",    "n",     "yes",  "no",  "on",  "off",
                                        "true", "false", "null", "nan", "inf", NULL};
    for (size_t i = 0; words[i]; i++)
        if (text.len == strlen(words[i]) && str_ends_with_nocase(text, words[i]))
            return true;
    return false;
}

// Characters above ASCII that YAML forbids or folds, or that are invisible.
static bool is_odd(uint32_t c) {
    return c < 0x20 || (c >= 0x7F && c <= 0xA0) || c == 0xAD || (c >= 0x200B && c <= 0x200F) ||
           (c >= 0x2028 && c <= 0x202E) || (c >= 0x2060 && c <= 0x206F) || (c >= 0xE000 && c <= 0xF8FF) ||
           c == 0xFEFF || (c >= 0xFFF0 && c <= 0xFFFF) || c >= 0xE0000;
}

static bool has_odd(str text, const char *but) {
    for (size_t at = 0; at < text.len; at += utf8_sequence_length(text, at)) {
        uint32_t c = utf8_decode(text, at);
        if (utf8_sequence_length(text, at) == 0)
            return true;
        if (is_odd(c) && !(c && c < 0x80 && strchr(but, (int)c)))
            return true;
    }
    return false;
}

static bool begins_plain(str text) {
    char c = text.ptr[0];
    if (char_is_letter(c) || c == '_' || c == '/' || (unsigned char)c >= 0x80)
        return true;
    return str_starts_with(text, STR("./")) || str_starts_with(text, STR("../"));
}

static bool is_plain(str text, bool in_flow) {
    if (text.len == 0 || !begins_plain(text) || text.ptr[text.len - 1] == ' ' || is_reserved(text))
        return false;
    for (size_t i = 0; i < text.len; i++) {
        char c = text.ptr[i];
        bool usual = char_is_letter(c) || char_is_digit(c) || (unsigned char)c >= 0x80;
        if (c == '\0' || !(usual || strchr(in_flow ? "_-./ +()" : "_-./ +(),;'!?=", c)))
            return false;
    }
    return !has_odd(text, "");
}

static void put_yaml_escape(struct strbuf *out, uint32_t c) {
    static const char short_form[] = "\0000\aa\bb\tt\nn\vv\ff\rr\033e\"\"\\\\";
    for (size_t i = 0; i + 1 < sizeof short_form - 1; i += 2)
        if ((uint32_t)(unsigned char)short_form[i] == c) {
            strbuf_char(out, '\\');
            strbuf_char(out, short_form[i + 1]);
            return;
        }
    if (c < 0x100)
        strbuf_format(out, "\\x%02X", (unsigned)c);
    else if (c < 0x10000)
        strbuf_format(out, "\\u%04X", (unsigned)c);
    else
        strbuf_format(out, "\\U%08X", (unsigned)c);
}

static void put_quoted(struct strbuf *out, str text) {
    strbuf_char(out, '"');
    for (size_t at = 0; at < text.len;) {
        size_t n = utf8_sequence_length(text, at);
        uint32_t c = utf8_decode(text, at);
        if (n == 0 || is_odd(c) || c == '"' || c == '\\')
            put_yaml_escape(out, c);
        else
            strbuf_str(out, str_slice(text, at, at + n));
        at += n ? n : 1;
    }
    strbuf_char(out, '"');
}

// YAML reads what begins so, and what has one of the other marks in it, as something else.
static bool is_plain_expression(str text) {
    const char first = text.len ? text.ptr[0] : ' ', second = text.len > 1 ? text.ptr[1] : ' ';
    const bool begins = char_is_letter(first) || char_is_digit(first) || strchr("_(.", first) ||
                        (first == '-' && second != ' ' && second != '-') || (unsigned char)first >= 0x80;
    if (!begins || text.ptr[text.len - 1] == ' ' || is_reserved(text) || has_odd(text, ""))
        return false;
    for (size_t i = 0; i < text.len; i++)
        if (strchr(",[]{}#:\"'\\&", text.ptr[i]))
            return false;
    return true;
}

void print_yaml_expression(struct strbuf *out, str text) {
    if (is_plain_expression(text))
        strbuf_str(out, text);
    else
        put_quoted(out, text);
}

void print_yaml_text(struct strbuf *out, str text, bool in_flow) {
    if (is_plain(text, in_flow))
        strbuf_str(out, text);
    else
        put_quoted(out, text);
}

bool print_yaml_is_literal(str text) {
    if (text.len < 2 || !memchr(text.ptr, '\n', text.len - 1) || has_odd(text, "\n"))
        return false;
    if (text.ptr[0] == ' ' || text.ptr[0] == '\n' || str_ends_with_nocase(text, "\n\n"))
        return false;
    for (size_t i = 1; i <= text.len; i++)
        if ((i == text.len || text.ptr[i] == '\n') && text.ptr[i - 1] == ' ')
            return false;
    return true;
}

void print_yaml_literal(struct strbuf *out, str text, uint32_t indent) {
    bool ends = text.ptr[text.len - 1] == '\n';
    strbuf_cstr(out, ends ? "|\n" : "|-\n");
    if (ends)
        text.len--;
    for (size_t begin = 0; begin <= text.len;) {
        size_t end = begin;
        while (end < text.len && text.ptr[end] != '\n')
            end++;
        if (end > begin) {
            strbuf_repeat(out, ' ', indent);
            strbuf_str(out, str_slice(text, begin, end));
        }
        strbuf_char(out, '\n');
        begin = end + 1;
    }
}

void print_json_text(struct strbuf *out, str text) {
    strbuf_char(out, '"');
    for (size_t at = 0; at < text.len;) {
        size_t n = utf8_sequence_length(text, at);
        uint32_t c = utf8_decode(text, at);
        if (c == '"' || c == '\\')
            strbuf_format(out, "\\%c", (char)c);
        else if (c == '\n' || c == '\t')
            strbuf_cstr(out, c == '\n' ? "\\n" : "\\t");
        else if (n == 0 || (is_odd(c) && c < 0x10000)) // YAML has no pairs of surrogates
            strbuf_format(out, "\\u%04X", (unsigned)c);
        else
            strbuf_str(out, str_slice(text, at, at + n));
        at += n ? n : 1;
    }
    strbuf_char(out, '"');
}

void print_xml_text(struct strbuf *out, str text) {
    for (size_t at = 0; at < text.len;) {
        size_t n = utf8_sequence_length(text, at);
        uint32_t c = utf8_decode(text, at);
        if (is_odd(c))
            strbuf_format(out, "&#%u;", (unsigned)c);
        else
            strbuf_markup(out, str_slice(text, at, at + n));
        at += n ? n : 1;
    }
}

void print_number(struct strbuf *out, double value) {
    char digits[NUMBER_FORMAT_MAX];
    size_t length = number_format(value, digits);
    strbuf_add(out, digits, length);
}

void print_hex_color(struct strbuf *out, uint32_t hex) {
    strbuf_format(out, "#%06x", (unsigned)(hex & 0xFFFFFF));
}

bool print_is_uniform(const struct schema_row *row, const void *field) {
    double n[4];
    if (row->kind == SCHEMA_COLOR ? ((const struct ir_color *)field)->is_hex : !row->fill)
        return false;
    uint32_t count = ir_walk_components(row, field, n);
    return (count == 2 || count == 3) && n[0] == n[1] && n[1] == n[count - 1];
}

void print_plain_value(struct strbuf *out, const struct schema_row *row, const void *field) {
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        strbuf_cstr(out, *(const bool *)field ? "true" : "false");
        break;
    case SCHEMA_INTEGER:
        strbuf_format(out, "%d", (int)*(const int32_t *)field);
        break;
    case SCHEMA_NUMBER:
        print_number(out, *(const double *)field);
        break;
    case SCHEMA_WORD:
        strbuf_cstr(out, row->words[*(const unsigned *)field]);
        break;
    case SCHEMA_TEXT:
        strbuf_str(out, *(const str *)field);
        break;
    case SCHEMA_REFERENCE:
        strbuf_str(out, ((const struct ir_reference *)field)->name);
        break;
    default:
        break;
    }
}

size_t print_column(const struct strbuf *out) {
    str all = strbuf_view(out);
    size_t begin = all.len;
    while (begin && all.ptr[begin - 1] != '\n')
        begin--;
    return utf8_count(str_slice(all, begin, all.len));
}
