#include "core/expression.h"

#include "core/angle.h"
#include "core/heap.h"
#include "core/number.h"

#include <math.h>
#include <stdlib.h>

enum {
    ARGUMENTS_MAX = 64,
    DEPTH_MAX = 64,
    // The operands that wait at each depth: arguments, the left sides of a sum and of a product, a power's
    // base.
    VALUES_MAX = DEPTH_MAX * (ARGUMENTS_MAX + 3),
};

enum step_kind {
    STEP_NUMBER,
    STEP_FRAME,
    STEP_TIME,
    STEP_NEGATE,
    STEP_ADD,
    STEP_SUBTRACT,
    STEP_MULTIPLY,
    STEP_DIVIDE,
    STEP_REMAINDER,
    STEP_POWER,
    STEP_CALL,
};

// Costs in units of an addition. A remainder costs one per binary digit by which its operands' sizes differ.
enum {
    COST_POWER = 8,
    COST_REMAINDER = 128,
};

// A step takes its values from the end of a list and appends its result.
struct expression_step {
    uint8_t kind;        // step_kind
    uint8_t function;    // STEP_CALL: in `functions`
    uint16_t count;      // of its arguments
    uint32_t begin, end; // in the text: the call
    double number;
};

// Each step takes at least one character, so a text has no more steps than characters.
struct scan {
    str text;
    size_t at;
    int depth;
    struct expression_step *steps;
    uint32_t count;
    uint64_t cost;
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

static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool sum(struct scan *s);

static void add(struct scan *s, enum step_kind kind, uint64_t cost) {
    s->steps[s->count++] = (struct expression_step){.kind = (uint8_t)kind};
    s->cost += cost;
}

static void add_number(struct scan *s, double value) {
    add(s, STEP_NUMBER, 1);
    s->steps[s->count - 1].number = value;
}

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
    int count;     // of arguments; 0: keys
    unsigned cost; // in additions
    double (*call)(const double *a, int count);
    const char *wrong;
    bool is_inexact; // its last bit depends on the C library
} functions[] = {
    {"sin", "sin(x)", 1, 8, call_sin, "'sin' takes one argument", true},
    {"cos", "cos(x)", 1, 8, call_cos, "'cos' takes one argument", true},
    {"sqrt", "sqrt(x)", 1, 2, call_sqrt, "'sqrt' takes one argument", false},
    {"abs", "abs(x)", 1, 1, call_abs, "'abs' takes one argument", false},
    {"floor", "floor(x)", 1, 2, call_floor, "'floor' takes one argument", false},
    {"min", "min(a, b)", 2, 2, call_min, "'min' takes two arguments", false},
    {"max", "max(a, b)", 2, 2, call_max, "'max' takes two arguments", false},
    {"mix", "mix(a, b, share)", 3, 4, call_mix, "'mix' takes three arguments", false},
    {"keys", "keys(x, x0, v0, x1, v1, ...)", 0, 64, call_keys,
     "'keys' takes x and then pairs, a place and the value there, the places in rising order", false},
    {"ease", "ease(x, x0, v0, x1, v1, ...)", 0, 64, call_ease,
     "'ease' takes x and then pairs, a place and the value there, the places in rising order", false},
};

static const struct constant {
    const char *name;
    double value;
} constants[] = {{"pi", PI}, {"tau", 6.28318530717958647692}};

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
        while (at < text.len && (is_letter(text.ptr[at]) || char_is_digit(text.ptr[at])))
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
    if (used & EXPRESSION_INEXACT_HEX)
        strbuf_format(out, "%s#rrggbb", between);
}

static bool count_is_good(const struct function *f, int count) {
    return f->count ? count == f->count : count >= 3 && count % 2 == 1;
}

static bool keys_rise(const double *a, int count) {
    bool good = true;
    for (int i = 3; good && i < count; i += 2)
        good = a[i] > a[i - 2];
    return good;
}

static bool call(struct scan *s, int function, size_t begin) {
    const struct function *f = &functions[function];
    int count = 0;
    do {
        if (count++ == ARGUMENTS_MAX)
            return fail(s, begin, s->at, "there are more than 64 arguments");
        if (!sum(s))
            return false;
    } while (take(s, ','));
    if (!take(s, ')'))
        return fail(s, s->at, s->at + 1, "')' is missing here");
    if (!count_is_good(f, count))
        return fail(s, begin, s->at, f->wrong);
    add(s, STEP_CALL, f->cost);
    struct expression_step *step = &s->steps[s->count - 1];
    step->function = (uint8_t)function;
    step->count = (uint16_t)count;
    step->begin = (uint32_t)begin;
    step->end = (uint32_t)s->at;
    return true;
}

// ---- the grammar, by recursive descent

static bool name(struct scan *s) {
    const size_t begin = s->at;
    while (s->at < s->text.len && (is_letter(s->text.ptr[s->at]) || char_is_digit(s->text.ptr[s->at])))
        s->at++;
    const str word = str_slice(s->text, begin, s->at);
    if (take(s, '(')) {
        for (int i = 0; i < FUNCTIONS; i++)
            if (str_equal_cstr(word, functions[i].name))
                return call(s, i, begin);
        return fail(s, begin, begin + word.len, "there is no function of this name");
    }
    for (int i = 0; i < CONSTANTS; i++)
        if (str_equal_cstr(word, constants[i].name)) {
            add_number(s, constants[i].value);
            return true;
        }
    const bool is_frame = str_equal_cstr(word, "frame");
    if (!is_frame && !str_equal_cstr(word, "time"))
        return fail(s, begin, begin + word.len, "there is no number of this name");
    add(s, is_frame ? STEP_FRAME : STEP_TIME, 1);
    return true;
}

static bool number(struct scan *s) {
    const size_t begin = s->at;
    double value;
    while (s->at < s->text.len) {
        const char c = s->text.ptr[s->at];
        const bool exponent = (c == 'e' || c == 'E') && s->at > begin;
        if (!char_is_digit(c) && c != '.' && !exponent)
            break;
        s->at++;
        if (exponent && s->at < s->text.len && (s->text.ptr[s->at] == '-' || s->text.ptr[s->at] == '+'))
            s->at++;
    }
    if (number_parse(str_slice(s->text, begin, s->at), &value) != NUMBER_OK)
        return fail(s, begin, s->at, "this is not a number");
    add_number(s, value);
    return true;
}

static bool atom(struct scan *s) {
    const char c = next(s);
    if (char_is_digit(c) || c == '.')
        return number(s);
    if (is_letter(c))
        return name(s);
    if (!take(s, '('))
        return fail(s, s->at, s->at + 1, "a number, a name or '(' is missing here");
    return sum(s) && (take(s, ')') || fail(s, s->at, s->at + 1, "')' is missing here"));
}

// -x^2 is -(x^2), and 2^-1 is right.
static bool signed_power(struct scan *s) {
    if (++s->depth > DEPTH_MAX)
        return fail(s, s->at, s->at + 1, "the expression is nested too deeply");
    bool good;
    if (take(s, '-')) {
        good = signed_power(s);
        add(s, STEP_NEGATE, 1);
    } else {
        good = atom(s);
        if (good && take(s, '^') && (good = signed_power(s)))
            add(s, STEP_POWER, COST_POWER);
    }
    s->depth--;
    return good;
}

static bool product(struct scan *s) {
    if (!signed_power(s))
        return false;
    for (char c = next(s); c == '*' || c == '/' || c == '%'; c = next(s)) {
        s->at++;
        if (!signed_power(s))
            return false;
        add(s,
            c == '*'   ? STEP_MULTIPLY
            : c == '/' ? STEP_DIVIDE
                       : STEP_REMAINDER,
            c == '%' ? COST_REMAINDER : 1);
    }
    return true;
}

static bool sum(struct scan *s) {
    if (!product(s))
        return false;
    for (char c = next(s); c == '+' || c == '-'; c = next(s)) {
        s->at++;
        if (!product(s))
            return false;
        add(s, c == '+' ? STEP_ADD : STEP_SUBTRACT, 1);
    }
    return true;
}

static bool compile(struct scan *s, struct expression *expression) {
    if (!sum(s))
        return false;
    if (next(s) != '\0' || s->at < s->text.len)
        return fail(s, s->at, s->text.len, "an operator is missing before this");
    *expression = (struct expression){s->steps, s->count, s->cost, s->text.len};
    return true;
}

bool expression_compile(str text, struct arena *arena, struct expression *expression,
                        struct expression_fault *fault) {
    struct scan s = {
        .text = text, .steps = ARENA_ARRAY(arena, struct expression_step, text.len + 1), .fault = fault};
    return compile(&s, expression);
}

// ---- values

static double between(enum step_kind kind, double a, double b) {
    switch (kind) {
    case STEP_ADD:
        return a + b;
    case STEP_SUBTRACT:
        return a - b;
    case STEP_MULTIPLY:
        return a * b;
    case STEP_DIVIDE:
        return a / b;
    case STEP_REMAINDER:
        return fmod(a, b);
    default:
        return pow(a, b);
    }
}

bool expression_at(const struct expression *expression, const struct expression_at *at, double *value,
                   struct expression_fault *fault) {
    double values[VALUES_MAX], *end = values;
    for (uint32_t i = 0; i < expression->count; i++) {
        const struct expression_step *step = &expression->steps[i];
        if (step->kind <= STEP_TIME) {
            *end++ = step->kind == STEP_NUMBER  ? step->number
                     : step->kind == STEP_FRAME ? at->frame
                                                : at->time;
        } else if (step->kind == STEP_NEGATE) {
            end[-1] = -end[-1];
        } else if (step->kind == STEP_CALL) {
            const struct function *f = &functions[step->function];
            end -= step->count;
            if (f->count == 0 && !keys_rise(end, step->count)) {
                *fault = (struct expression_fault){step->begin, step->end, f->wrong};
                return false;
            }
            *end = f->call(end, step->count);
            end++;
        } else {
            end--;
            end[-1] = between((enum step_kind)step->kind, end[-1], end[0]);
        }
    }
    *value = values[0];
    if (!isfinite(*value))
        *fault = (struct expression_fault){0, expression->text_length, "the value of this is not finite"};
    return isfinite(*value);
}

bool expression_value(str text, const struct expression_at *at, double *value,
                      struct expression_fault *fault) {
    struct expression expression;
    struct scan s = {.text = text, .steps = heap_array(text.len + 1, sizeof *s.steps), .fault = fault};
    const bool good = compile(&s, &expression) && expression_at(&expression, at, value, fault);
    if (!good)
        *value = 0;
    free(s.steps);
    return good;
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
