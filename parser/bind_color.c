// Colours as text: #rrggbb, one number, and what people write who come from other programs.
#include "parser/bind.h"
#include "parser/mend.h"
#include "parser/say.h"

#include "core/number.h"

#include <ctype.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

static bool hex_digits(str digits, uint32_t *value) {
    *value = 0;
    for (size_t i = 0; i < digits.len; i++) {
        char c = digits.ptr[i];
        uint32_t digit = c >= '0' && c <= '9'   ? (uint32_t)(c - '0')
                         : c >= 'a' && c <= 'f' ? (uint32_t)(c - 'a') + 10
                         : c >= 'A' && c <= 'F' ? (uint32_t)(c - 'A') + 10
                                                : 16;
        if (digit == 16)
            return false;
        *value = *value << 4 | digit;
    }
    return true;
}

static bool is_hex_color(str text) {
    uint32_t ignored;
    return text.len == 7 && text.ptr[0] == '#' && hex_digits(str_slice(text, 1, 7), &ignored);
}

// The sixteen names of HTML 4, and some that are as well known.
static str named_color(struct arena *arena, str text) {
    static const struct {
        const char *name;
        uint32_t rgb;
    } colors[] = {{"black", 0x000000},  {"white", 0xffffff},  {"red", 0xff0000},     {"green", 0x008000},
                  {"blue", 0x0000ff},   {"yellow", 0xffff00}, {"cyan", 0x00ffff},    {"aqua", 0x00ffff},
                  {"lime", 0x00ff00},   {"orange", 0xffa500}, {"magenta", 0xff00ff}, {"fuchsia", 0xff00ff},
                  {"purple", 0x800080}, {"gray", 0x808080},   {"grey", 0x808080},    {"silver", 0xc0c0c0},
                  {"maroon", 0x800000}, {"olive", 0x808000},  {"navy", 0x000080},    {"teal", 0x008080},
                  {"pink", 0xffc0cb},   {"brown", 0xa52a2a},  {"gold", 0xffd700},    {"violet", 0xee82ee}};
    for (size_t i = 0; i < sizeof colors / sizeof *colors; i++)
        if (text.len == strlen(colors[i].name) && str_ends_with_nocase(text, colors[i].name))
            return arena_format(arena, "#%06" PRIx32, colors[i].rgb);
    return STR("");
}

// "rgb(12, 30, 4)"
static str called_color(struct arena *arena, str text) {
    bool alpha = str_starts_with(text, STR("rgba("));
    if ((!alpha && !str_starts_with(text, STR("rgb("))) || text.ptr[text.len - 1] != ')')
        return STR("");
    str rest = str_slice(text, alpha ? 5 : 4, text.len - 1);
    uint32_t rgb = 0;
    for (int i = 0; i < 3; i++) {
        size_t end = 0;
        while (end < rest.len && rest.ptr[end] != ',')
            end++;
        int64_t byte;
        if (number_parse_integer(str_trim(str_slice(rest, 0, end)), &byte) != NUMBER_OK || byte < 0 ||
            byte > 255 || (i < 2 && end == rest.len))
            return STR("");
        rgb = rgb << 8 | (uint32_t)byte;
        rest = str_slice(rest, end + (end < rest.len), rest.len);
    }
    return arena_format(arena, "#%06" PRIx32, rgb);
}

// The colour as #rrggbb that a text means elsewhere; empty: none is known. *safe: nothing else can be meant.
static str mend_color(struct arena *arena, str text, bool *safe) {
    str bare = mend_quotes(text);
    const char *c = bare.ptr;
    uint32_t ignored;
    bool hash = bare.len && c[0] == '#' && hex_digits(str_slice(bare, 1, bare.len), &ignored);
    *safe = hash && (bare.len == 4 || bare.len == 7);
    if (hash && bare.len == 4)
        return arena_format(arena, "#%c%c%c%c%c%c", c[1], c[1], c[2], c[2], c[3], c[3]);
    if (hash && (bare.len == 7 || bare.len == 9))
        return str_slice(bare, 0, 7);
    if (bare.len == 6 && hex_digits(bare, &ignored))
        return arena_format(arena, "#%.*s", STR_ARG(bare));
    bool prefix = bare.len == 8 && c[0] == '0' && (c[1] == 'x' || c[1] == 'X');
    if (prefix && hex_digits(str_slice(bare, 2, 8), &ignored))
        return arena_format(arena, "#%.*s", STR_ARG(str_slice(bare, 2, 8)));
    str named = named_color(arena, bare);
    return named.len ? named : called_color(arena, bare);
}

bool bind_bad_color(struct bind_context *context, struct bind_subject subject, tree_index node) {
    str text = tree_text(context->tree, node);
    span at = tree_span(context->tree, node);
    diag_add(context->sink, DIAG_BAD_COLOR, at, "%.*s: '%.*s' is not a colour",
             STR_ARG(say_subject(context->scratch, subject)), STR_ARG(say_text(context->scratch, text)));
    bool safe;
    str mended = mend_color(context->scratch, text, &safe);
    if (mended.len == 0) {
        str example = say_subject_example(context->scratch, subject, context->tree->is_xml);
        diag_help(context->sink, "for example %.*s, or six hexadecimal digits as in \"#ff8800\"",
                  STR_ARG(example));
        return false;
    }
    bool has_alpha = text.len == 9 || str_starts_with(text, STR("rgba"));
    diag_help(context->sink, "write \"%.*s\"%s", STR_ARG(mended),
              has_alpha && text.ptr[0] != '\xE2' ? ": colours have no alpha" : "");
    str written = source_text(context->sources, at);
    bool bare = !context->tree->is_xml && written.len && written.ptr[0] != '"' && written.ptr[0] != '\'';
    diag_fix(context->sink, safe, at,
             bare ? arena_format(context->scratch, "\"%.*s\"", STR_ARG(mended))
                  : mend_like(context->scratch, written, mended));
    return false;
}

// Three bytes, as other programs write colours, rather than light: whole numbers, one of them above what a
// bright light needs.
static bool are_bytes(const double rgb[3]) {
    double largest = 0;
    for (int i = 0; i < 3; i++) {
        if (!(rgb[i] >= 0 && rgb[i] <= 255) || rgb[i] != floor(rgb[i]))
            return false;
        largest = fmax(largest, rgb[i]);
    }
    return largest >= 32;
}

// What stands in the place of a list, or of an element without children.
static str hex_like(struct bind_context *context, tree_index node, uint32_t rgb) {
    if (!context->tree->is_xml)
        return arena_format(context->scratch, "\"#%06" PRIx32 "\"", rgb);
    str written = source_text(context->sources, tree_span(context->tree, node));
    size_t end = 1;
    while (end < written.len && !isspace((unsigned char)written.ptr[end]))
        end++;
    if (written.len < 2 || written.ptr[0] != '<' || written.ptr[written.len - 2] != '/')
        return STR("");
    return arena_format(context->scratch, "%.*s " SCHEMA_HEX_ATTRIBUTE "=\"#%06" PRIx32 "\"/>",
                        STR_ARG(str_slice(written, 0, end)), rgb);
}

void bind_check_bytes(struct bind_context *context, struct bind_subject subject, tree_index node,
                      const double rgb[3]) {
    if (!are_bytes(rgb))
        return;
    uint32_t hex = (uint32_t)rgb[0] << 16 | (uint32_t)rgb[1] << 8 | (uint32_t)rgb[2];
    diag_add(context->sink, DIAG_COLOR_BYTES, tree_span(context->tree, node),
             "%.*s is %.0f %.0f %.0f, which looks like bytes: 1 is white, 255 is 255 times as bright",
             STR_ARG(say_subject(context->scratch, subject)), rgb[0], rgb[1], rgb[2]);
    str mended = hex_like(context, node, hex);
    if (mended.len) {
        diag_help(context->sink, "write %.*s, or divide by 255", STR_ARG(mended));
        diag_fix(context->sink, false, tree_span(context->tree, node), mended);
    } else {
        diag_help(context->sink, "divide by 255");
    }
}

// Whether a text that is no number and not #rrggbb was meant as a colour.
static bool looks_like_color(str text, enum number_status status, bool is_quoted) {
    uint32_t ignored;
    str bare = mend_quotes(text);
    bool letter = text.len && isalpha((unsigned char)text.ptr[0]);
    bool six_digits = text.len == 6 && (status == NUMBER_UNIT || is_quoted) && hex_digits(text, &ignored);
    bool prefix = status == NUMBER_HEX && text.len == 8;
    return six_digits || prefix || (bare.len && bare.ptr[0] == '#') ||
           (letter && status == NUMBER_NOT_A_NUMBER);
}

bool bind_color_text(struct bind_context *context, struct bind_subject subject, tree_index node,
                     struct ir_color *out) {
    str text = tree_text(context->tree, node);
    uint32_t hex;
    if (is_hex_color(text) && hex_digits(str_slice(text, 1, 7), &hex)) {
        *out = (struct ir_color){.is_hex = true, .hex = hex};
        return true;
    }
    double value = 0;
    enum number_status status = number_parse(text, &value);
    if (looks_like_color(text, status, tree_node(context->tree, node)->style == TREE_QUOTED))
        return bind_bad_color(context, subject, node);
    if (!bind_number(context, subject, node, &value))
        return false;
    *out = (struct ir_color){.r = value, .g = value, .b = value};
    return true;
}
