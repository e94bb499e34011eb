#include "parser/tree/mend.h"

#include "core/number.h"

#include <inttypes.h>
#include <string.h>

bool mend_hex_digits(str digits, uint32_t *value) {
    *value = 0;
    for (size_t i = 0; i < digits.len; i++) {
        const int digit = char_hex(digits.ptr[i]);
        if (digit < 0)
            return false;
        *value = *value << 4 | (uint32_t)digit;
    }
    return true;
}

bool mend_hex_color(str text, uint32_t *value) {
    return text.len == 7 && text.ptr[0] == '#' && mend_hex_digits(str_slice(text, 1, 7), value);
}

// The sixteen names of HTML 4, and some that are equally well known.
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

str mend_color(struct arena *arena, str text, bool *safe) {
    str bare = mend_quotes(text);
    const char *c = bare.ptr;
    uint32_t ignored;
    bool hash = bare.len && c[0] == '#' && mend_hex_digits(str_slice(bare, 1, bare.len), &ignored);
    *safe = hash && (bare.len == 4 || bare.len == 7);
    if (hash && bare.len == 4)
        return arena_format(arena, "#%c%c%c%c%c%c", c[1], c[1], c[2], c[2], c[3], c[3]);
    if (hash && (bare.len == 7 || bare.len == 9))
        return str_slice(bare, 0, 7);
    if (bare.len == 6 && mend_hex_digits(bare, &ignored))
        return arena_format(arena, "#%.*s", STR_ARG(bare));
    bool prefix = bare.len == 8 && c[0] == '0' && (c[1] == 'x' || c[1] == 'X');
    if (prefix && mend_hex_digits(str_slice(bare, 2, 8), &ignored))
        return arena_format(arena, "#%.*s", STR_ARG(str_slice(bare, 2, 8)));
    str named = named_color(arena, bare);
    return named.len ? named : called_color(arena, bare);
}
