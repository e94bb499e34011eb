// The words that expressions have by themselves, and whether a text can be meant as an expression.
#include "core/expression_internal.h"

#include "core/number.h"
#include "core/unicode.h"

#include <stdarg.h>
#include <stdio.h>

static const struct expression_word words[] = {
    {"sin", "sin(x)", "The sine of an angle in degrees.", true},
    {"cos", "cos(x)", "The cosine of an angle in degrees.", true},
    {"sqrt", "sqrt(x)", "The square root.", true},
    {"abs", "abs(x)", "The number without its sign.", true},
    {"floor", "floor(x)", "The largest whole number that is not above it.", true},
    {"min", "min(a, b)", "The smaller one.", true},
    {"max", "max(a, b)", "The larger one.", true},
    {"mix", "mix(a, b, share)", "From a, with share 0, to b, with share 1: numbers, vectors or colours.",
     true},
    {"keys", "keys(x, x0, v0, x1, v1, ...)", "Straight from value to value: v0 at x0, v1 at x1, and so on.",
     true},
    {"ease", "ease(x, x0, v0, x1, v1, ...)", "As keys, slow at each.", true},
    {"random", "random(n, ...)",
     "A number from 0 to below 1 that looks random, always the same for the same one to four whole numbers.",
     true},
    {"hsv", "hsv(h, s, v)", "The colour #rrggbb of a hue in degrees, with saturation and value from 0 to 1.",
     true},
    {"pi", "pi", "3.14159...; angles need it nowhere, they are in degrees.", false},
    {"frame", "frame", "The number of the frame, from 0; without a frame 0.", false},
    {"time", "time", "Seconds since frame 0; without a frame 0.", false},
    {"true", "true", "A truth.", false},
    {"false", "false", "A truth.", false},
    {"and", "a and b", "True if both are.", false},
    {"or", "a or b", "True if one of them is, or both.", false},
    {"not", "not a", "True if a is false.", false},
    {"if", "a if c else b", "a where c is true, else b.", false},
    {"else", "a if c else b", "a where c is true, else b.", false},
    {NULL, NULL, NULL, false},
};

const struct expression_word *expression_words(void) {
    return words;
}

bool expression_is_word(str name) {
    for (const struct expression_word *word = words; word->name; word++)
        if (str_equal_cstr(name, word->name))
            return true;
    return false;
}

// What other languages have.
static const struct {
    const char *name, *help;
} foreign[] = {
    {"rand", "write random(n), with another number n for each thing"},
    {"pow", "write a^b, with a whole number b; of a half, sqrt(a)"},
    {"lerp", "write mix(a, b, share)"},
    {"clamp", "write min(max(x, least), greatest)"},
    {"smoothstep", "write ease(x, x0, v0, x1, v1)"},
    {"fabs", "write abs(x)"},
    {"fmod", "write a % b"},
    {"mod", "write a % b"},
    {"round", "write floor(x + 0.5)"},
    {"ceil", "write -floor(-x)"},
    {"tan", "write sin(x)/cos(x); x is in degrees"},
    {"radians", "angles are in degrees: write the angle itself"},
    {"degrees", "angles are in degrees: write the angle itself"},
    {"rgb", "a colour is written [r, g, b]"},
    {"vec3", "a vector is written [x, y, z]"},
    {"range", "a count alone has all values below it: i: 3 is 0, 1 and 2"},
    {"yes", "write true"},
    {"on", "write true"},
    {"no", "write false"},
    {"off", "write false"},
};

const char *expression_foreign(str function) {
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++)
        if (str_equal_cstr(function, foreign[i].name))
            return foreign[i].help;
    return NULL;
}

bool expression_fail(struct expression_fault *fault, size_t begin, size_t end, const char *format, ...) {
    va_list arguments;
    *fault = (struct expression_fault){.begin = begin, .end = end > begin ? end : begin + 1};
    va_start(arguments, format);
    vsnprintf(fault->what, sizeof fault->what, format, arguments);
    va_end(arguments);
    return false;
}

const char *expression_type_name(enum expression_type type) {
    static const char *const names[] = {"a number", "true or false", "a vector or colour"};
    return names[type];
}

// Bytes of the letter, digit or '_' of a name at `at`; 0: there is none.
static size_t name_character(str text, size_t at, bool is_first) {
    const char c = at < text.len ? text.ptr[at] : '+';
    if ((unsigned char)c < 0x80)
        return char_is_letter(c) || c == '_' || (!is_first && char_is_digit(c));
    const size_t length = utf8_sequence_length(text, at);
    const uint32_t code = length ? utf8_decode(text, at) : 0;
    return unicode_is_letter(code) || (!is_first && unicode_is_digit(code)) ? length : 0;
}

size_t expression_name_length(str text) {
    size_t end = 0, length;
    while ((length = name_character(text, end, end == 0)))
        end += length;
    return end;
}

bool expression_next_name(str text, size_t *at, str *name) {
    while (*at < text.len) {
        const size_t begin = *at, length = expression_name_length(str_slice(text, begin, text.len));
        const char before = begin > 0 ? text.ptr[begin - 1] : ' ';
        *at += length ? length : 1;
        const bool is_part = before == '.' || before == '#' || char_is_digit(before);
        *name = str_slice(text, begin, *at);
        if (length && !is_part && (*at == text.len || text.ptr[*at] != '('))
            return true;
    }
    return false;
}

void expression_print(enum expression_type type, const double value[EXPRESSION_WIDTH], struct strbuf *out) {
    char digits[NUMBER_FORMAT_MAX];
    if (type == EXPRESSION_TRUTH) {
        strbuf_cstr(out, value[0] != 0 ? "true" : "false");
    } else if (type == EXPRESSION_TRIPLE && value[3] >= 0) {
        strbuf_format(out, "#%06x", (unsigned)value[3]);
    } else {
        const int count = type == EXPRESSION_TRIPLE ? 3 : 1;
        for (int i = 0; i < count; i++) {
            number_format(value[i], digits);
            strbuf_format(out, "%s%s", i ? ", " : count > 1 ? "[" : "", digits);
        }
        strbuf_cstr(out, count > 1 ? "]" : "");
    }
}

// ---- what is meant

enum token {
    TOKEN_END,
    TOKEN_NUMBER, // and letters after it: 3m, 0x10, 1e-3
    TOKEN_NAME,
    TOKEN_OPERATOR,
    TOKEN_OPEN,
    TOKEN_OTHER,
};

const char *const *expression_no_words(void) {
    static const char *const none[] = {"yes", "no",       "on",   "off",  "null",  "nan", "inf",
                                       "nil", "infinity", "none", "true", "false", NULL};
    return none;
}

static bool is_no_word(str text) {
    for (const char *const *word = expression_no_words(); *word; word++) {
        bool same = strlen(*word) == text.len;
        for (size_t k = 0; same && k < text.len; k++)
            same = char_lower(text.ptr[k]) == (*word)[k];
        if (same)
            return true;
    }
    return false;
}

static bool is_word_operator(str name) {
    return str_equal(name, STR("and")) || str_equal(name, STR("or")) || str_equal(name, STR("if")) ||
           str_equal(name, STR("else"));
}

// Digits, and what is written together with them: 3m, 0x10, 1e-3.
static void skip_number(str text, size_t *at) {
    const size_t begin = *at;
    double ignored;
    size_t part;
    while ((part = *at < text.len && text.ptr[*at] == '.' ? 1 : name_character(text, *at, false)))
        *at += part;
    const char last = text.ptr[*at - 1];
    const bool has_sign = *at + 1 < text.len && (text.ptr[*at] == '-' || text.ptr[*at] == '+');
    if ((last == 'e' || last == 'E') && has_sign && char_is_digit(text.ptr[*at + 1]) &&
        number_parse(str_slice(text, begin, *at - 1), &ignored) == NUMBER_OK)
        for (++*at; *at < text.len && char_is_digit(text.ptr[*at]); ++*at) {
        }
}

static enum token take_token(str text, size_t *at, str *name) {
    while (*at < text.len && char_is_space(text.ptr[*at]))
        ++*at;
    if (*at >= text.len)
        return TOKEN_END;
    const char c = text.ptr[*at];
    const size_t length = expression_name_at(text, *at);
    *name = str_slice(text, *at, *at + length);
    if (length) {
        *at += length;
        return is_word_operator(*name) ? TOKEN_OPERATOR : TOKEN_NAME;
    }
    if (char_is_digit(c) || (c == '.' && *at + 1 < text.len && char_is_digit(text.ptr[*at + 1]))) {
        skip_number(text, at);
        return TOKEN_NUMBER;
    }
    const size_t begin = *at;
    while (*at < text.len && memchr("+-*/%^<>=!&|?", text.ptr[*at], 13))
        ++*at;
    if (*at > begin)
        return TOKEN_OPERATOR;
    ++*at;
    return c == '(' ? TOKEN_OPEN : TOKEN_OTHER;
}

static bool is_component(str text, size_t dot) {
    const size_t length = expression_name_at(text, dot + 1);
    return text.len > dot + 1 && text.ptr[dot] == '.' && length == 1 && memchr("xyz", text.ptr[dot + 1], 3);
}

// Several values: none of them is the whole.
static bool is_list(str text) {
    int depth = 0;
    for (size_t i = 0; i < text.len; i++) {
        depth += (text.ptr[i] == '(') - (text.ptr[i] == ')');
        if (text.ptr[i] == ',' && depth == 0)
            return true;
    }
    return false;
}

bool expression_is_meant(str text) {
    double ignored;
    enum token before = TOKEN_END, last = TOKEN_END, token;
    str name = STR(""), one = STR("");
    size_t at = 0;
    if (number_parse(text, &ignored) == NUMBER_OK || is_no_word(text) || is_list(text))
        return false;
    if (expression_is_name(text))
        return true;
    while ((token = take_token(text, &at, &one)) != TOKEN_END) {
        const bool operand = token == TOKEN_NAME || token == TOKEN_NUMBER || token == TOKEN_OPEN;
        if (token == TOKEN_OPEN && last == TOKEN_NAME)
            return true;
        if (token == TOKEN_NAME && !is_no_word(one) &&
            ((last == TOKEN_OPERATOR && before == TOKEN_END) || (last == TOKEN_OPEN && before == TOKEN_END) ||
             is_component(text, at) || str_equal(name, STR("not"))))
            return true;
        if (operand && last == TOKEN_OPERATOR && (before == TOKEN_NAME || before == TOKEN_NUMBER))
            return true;
        before = last;
        last = token;
        name = one;
        // A closed parenthesis is an operand.
        if (token == TOKEN_OTHER && text.ptr[at - 1] == ')')
            last = TOKEN_NUMBER;
    }
    return false;
}

bool expression_is_free(str name) {
    return expression_is_name(name) && !expression_is_word(name) && !is_no_word(name) &&
           !str_equal(name, STR("tau"));
}
