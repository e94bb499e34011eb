#include "motion/expression.h"

#include "core/number.h"

#include <math.h>

enum {
    ARGUMENTS_MAX = 64,
    DEPTH_MAX = 64,
};

struct scan {
    str text;
    size_t at;
    int depth;
    const struct expression_at *frame;
    struct expression_fault *fault;
};

static bool fail(struct scan *s, size_t begin, size_t end, const char *what) {
    *s->fault = (struct expression_fault){begin, end > begin ? end : begin + 1, what};
    return false;
}

static void skip_blanks(struct scan *s) {
    while (s->at < s->text.len && char_is_space(s->text.ptr[s->at]))
        s->at++;
}

static char next(struct scan *s) {
    skip_blanks(s);
    return s->at < s->text.len ? s->text.ptr[s->at] : '\0';
}

static bool take(struct scan *s, char c) {
    if (next(s) != c)
        return false;
    s->at++;
    return true;
}

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool sum(struct scan *s, double *value);

// ---- functions

static double smooth(double x) {
    const double u = fmin(fmax(x, 0), 1);
    return u * u * (3 - 2 * u);
}

// Between the keys x0, v0, x1, v1, ... after `x` in `a`; before the first and after the last it stays.
static double between_keys(const double *a, int count, bool eased) {
    int i = 3;
    while (i + 2 < count && a[0] >= a[i])
        i += 2;
    if (count < 5 || a[0] <= a[1])
        return a[2];
    const double width = a[i] - a[i - 2], u = width > 0 ? fmin((a[0] - a[i - 2]) / width, 1) : 1;
    const double share = eased ? smooth(u) : u;
    return a[i - 1] * (1 - share) + a[i + 1] * share;
}

static double call_sin(const double *a, int count) {
    (void)count;
    return sin(a[0]);
}
static double call_cos(const double *a, int count) {
    (void)count;
    return cos(a[0]);
}
static double call_sqrt(const double *a, int count) {
    (void)count;
    return sqrt(a[0]);
}
static double call_abs(const double *a, int count) {
    (void)count;
    return fabs(a[0]);
}
static double call_floor(const double *a, int count) {
    (void)count;
    return floor(a[0]);
}
static double call_min(const double *a, int count) {
    (void)count;
    return fmin(a[0], a[1]);
}
static double call_max(const double *a, int count) {
    (void)count;
    return fmax(a[0], a[1]);
}
static double call_mix(const double *a, int count) {
    (void)count;
    return a[0] * (1 - a[2]) + a[1] * a[2];
}
static double call_keys(const double *a, int count) {
    return between_keys(a, count, false);
}
static double call_ease(const double *a, int count) {
    return between_keys(a, count, true);
}

// Keys come in pairs after the first argument.
static const struct function {
    const char *name, *form;
    int count; // of arguments; 0: keys
    double (*call)(const double *a, int count);
    const char *wrong;
    bool is_inexact; // its last bit depends on the C library
} functions[] = {
    {"sin", "sin(x)", 1, call_sin, "'sin' takes one argument", true},
    {"cos", "cos(x)", 1, call_cos, "'cos' takes one argument", true},
    {"sqrt", "sqrt(x)", 1, call_sqrt, "'sqrt' takes one argument", false},
    {"abs", "abs(x)", 1, call_abs, "'abs' takes one argument", false},
    {"floor", "floor(x)", 1, call_floor, "'floor' takes one argument", false},
    {"min", "min(a, b)", 2, call_min, "'min' takes two arguments", false},
    {"max", "max(a, b)", 2, call_max, "'max' takes two arguments", false},
    {"mix", "mix(a, b, share)", 3, call_mix, "'mix' takes three arguments", false},
    {"keys", "keys(x, x0, v0, x1, v1, ...)", 0, call_keys,
     "'keys' takes x and then pairs, a place and the value there, the places in rising order", false},
    {"ease", "ease(x, x0, v0, x1, v1, ...)", 0, call_ease,
     "'ease' takes x and then pairs, a place and the value there, the places in rising order", false},
};

static const struct constant {
    const char *name;
    double value;
} constants[] = {{"pi", 3.14159265358979323846}, {"tau", 6.28318530717958647692}};

enum {
    FUNCTIONS = sizeof functions / sizeof *functions,
    CONSTANTS = sizeof constants / sizeof *constants,
};

void expression_names(struct strbuf *out) {
    strbuf_cstr(out, "frame, time");
    for (int i = 0; i < CONSTANTS; i++)
        strbuf_format(out, ", %s", constants[i].name);
    for (int i = 0; i < FUNCTIONS; i++)
        strbuf_format(out, ", %s", functions[i].form);
}

// '^' is pow.
unsigned expression_inexact(str text) {
    unsigned used = (text.len && memchr(text.ptr, '^', text.len)) ? 1u << FUNCTIONS : 0;
    for (size_t at = 0; at < text.len; at++) {
        const size_t begin = at;
        while (at < text.len && (is_letter(text.ptr[at]) || is_digit(text.ptr[at])))
            at++;
        for (int i = 0; i < FUNCTIONS; i++)
            if (functions[i].is_inexact && str_equal_cstr(str_slice(text, begin, at), functions[i].name))
                used |= 1u << i;
    }
    return used;
}

void expression_inexact_names(unsigned used, struct strbuf *out) {
    const char *between = "";
    for (int i = 0; i <= FUNCTIONS; i++)
        if (used >> i & 1) {
            strbuf_format(out, "%s%s", between, i < FUNCTIONS ? functions[i].name : "^");
            between = ", ";
        }
}

static bool are_good(const struct function *f, const double *a, int count) {
    if (f->count)
        return count == f->count;
    bool good = count >= 3 && count % 2 == 1;
    for (int i = 3; good && i < count; i += 2)
        good = a[i] > a[i - 2];
    return good;
}

static bool call(struct scan *s, const struct function *f, size_t begin, double *value) {
    double a[ARGUMENTS_MAX];
    int count = 0;
    do {
        if (count == ARGUMENTS_MAX)
            return fail(s, begin, s->at, "there are more than 64 arguments");
        if (!sum(s, &a[count++]))
            return false;
    } while (take(s, ','));
    if (!take(s, ')'))
        return fail(s, s->at, s->at + 1, "')' is missing here");
    if (!are_good(f, a, count))
        return fail(s, begin, s->at, f->wrong);
    *value = f->call(a, count);
    return true;
}

// ---- the grammar, by recursive descent

static bool name(struct scan *s, double *value) {
    const size_t begin = s->at;
    while (s->at < s->text.len && (is_letter(s->text.ptr[s->at]) || is_digit(s->text.ptr[s->at])))
        s->at++;
    const str word = str_slice(s->text, begin, s->at);
    if (take(s, '(')) {
        for (int i = 0; i < FUNCTIONS; i++)
            if (str_equal_cstr(word, functions[i].name))
                return call(s, &functions[i], begin, value);
        return fail(s, begin, begin + word.len, "there is no function of this name");
    }
    for (int i = 0; i < CONSTANTS; i++)
        if (str_equal_cstr(word, constants[i].name)) {
            *value = constants[i].value;
            return true;
        }
    const bool is_frame = str_equal_cstr(word, "frame");
    if (!is_frame && !str_equal_cstr(word, "time"))
        return fail(s, begin, begin + word.len, "there is no number of this name");
    *value = is_frame ? s->frame->frame : s->frame->time;
    return true;
}

static bool number(struct scan *s, double *value) {
    const size_t begin = s->at;
    while (s->at < s->text.len) {
        const char c = s->text.ptr[s->at];
        const bool exponent = (c == 'e' || c == 'E') && s->at > begin;
        if (!is_digit(c) && c != '.' && !exponent)
            break;
        s->at++;
        if (exponent && s->at < s->text.len && (s->text.ptr[s->at] == '-' || s->text.ptr[s->at] == '+'))
            s->at++;
    }
    return number_parse(str_slice(s->text, begin, s->at), value) == NUMBER_OK ||
           fail(s, begin, s->at, "this is not a number");
}

static bool atom(struct scan *s, double *value) {
    const char c = next(s);
    if (is_digit(c) || c == '.')
        return number(s, value);
    if (is_letter(c))
        return name(s, value);
    if (!take(s, '('))
        return fail(s, s->at, s->at + 1, "a number, a name or '(' is missing here");
    return sum(s, value) && (take(s, ')') || fail(s, s->at, s->at + 1, "')' is missing here"));
}

// -x^2 is -(x^2), and 2^-1 is right.
static bool signed_power(struct scan *s, double *value) {
    double exponent;
    if (++s->depth > DEPTH_MAX)
        return fail(s, s->at, s->at + 1, "the expression is nested too deeply");
    bool good;
    if (take(s, '-')) {
        good = signed_power(s, value);
        *value = good ? -*value : 0;
    } else {
        good = atom(s, value);
        if (good && take(s, '^') && (good = signed_power(s, &exponent)))
            *value = pow(*value, exponent);
    }
    s->depth--;
    return good;
}

static bool product(struct scan *s, double *value) {
    double other;
    if (!signed_power(s, value))
        return false;
    for (char c = next(s); c == '*' || c == '/' || c == '%'; c = next(s)) {
        s->at++;
        if (!signed_power(s, &other))
            return false;
        *value = c == '*' ? *value * other : c == '/' ? *value / other : fmod(*value, other);
    }
    return true;
}

static bool sum(struct scan *s, double *value) {
    double other;
    if (!product(s, value))
        return false;
    for (char c = next(s); c == '+' || c == '-'; c = next(s)) {
        s->at++;
        if (!product(s, &other))
            return false;
        *value = c == '+' ? *value + other : *value - other;
    }
    return true;
}

bool expression_value(str text, const struct expression_at *at, double *value,
                      struct expression_fault *fault) {
    struct scan s = {.text = text, .frame = at, .fault = fault};
    *value = 0;
    if (!sum(&s, value))
        return false;
    if (next(&s) != '\0' || s.at < text.len)
        return fail(&s, s.at, text.len, "an operator is missing before this");
    return isfinite(*value) || fail(&s, 0, text.len, "the value of this is not finite");
}

// ---- texts with expressions

static bool is_map(str inside) {
    return str_trim(inside).len == 0 || memchr(inside.ptr, ':', inside.len);
}

bool expression_fill(str text, const struct expression_at *at, struct strbuf *out, bool *filled,
                     struct expression_fault *fault) {
    char digits[NUMBER_FORMAT_MAX];
    double value;
    *filled = false;
    for (size_t i = 0; i < text.len; i++) {
        const char *close = text.ptr[i] == '{' ? memchr(text.ptr + i, '}', text.len - i) : NULL;
        const size_t end = close ? (size_t)(close - text.ptr) : i;
        const str inside = close ? str_slice(text, i + 1, end) : STR("");
        if (!close || is_map(inside)) {
            strbuf_char(out, text.ptr[i]);
            continue;
        }
        if (!expression_value(inside, at, &value, fault)) {
            fault->begin += i + 1;
            fault->end += i + 1;
            return false;
        }
        strbuf_add(out, digits, number_format(value, digits));
        *filled = true;
        i = end;
    }
    return true;
}
