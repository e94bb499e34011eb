// Values of expressions, and their functions.
#include "core/expression_internal.h"

#include "core/splitmix.h"
#include "core/srgb.h"
#include "core/turn.h"

#include <math.h>

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
    return turn_sine(a[0]);
}
static double call_cos(const double *a, int count) {
    (void)count;
    return turn_cosine(a[0]);
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

#define ONE  "one number"
#define TWO  "two numbers"
#define KEYS "x and then pairs, a place and the value there, the places in rising order"
const struct expression_function expression_functions[] = {
    {"sin", 1, 16, call_sin, ONE},
    {"cos", 1, 16, call_cos, ONE},
    {"sqrt", 1, 2, call_sqrt, ONE},
    {"abs", 1, 1, call_abs, ONE},
    {"floor", 1, 2, call_floor, ONE},
    {"min", 2, 2, call_min, TWO},
    {"max", 2, 2, call_max, TWO},
    {"mix", 3, 4, call_mix, "two values and a share"},
    {"keys", 0, 64, call_keys, KEYS},
    {"ease", 0, 64, call_ease, KEYS},
    {"random", -1, 16, NULL, "one to four whole numbers"},
    {"hsv", 3, 16, NULL, "a hue in degrees, a saturation and a value"},
    {NULL, 0, 0, NULL, NULL},
};

int expression_find_function(str name) {
    for (int i = 0; expression_functions[i].name; i++)
        if (str_equal_cstr(name, expression_functions[i].name))
            return i;
    return -1;
}

static bool keys_rise(const double *a, int count) {
    bool good = true;
    for (int i = 3; good && i < count; i += 2)
        good = a[i] > a[i - 2];
    return good;
}

static bool is_whole(double value) {
    return value >= -0x1p53 && value <= 0x1p53 && value == floor(value);
}

// ---- steps that can fail

static bool fail(struct expression_fault *fault, const struct expression_step *step, const char *what) {
    return expression_fail(fault, step->begin, step->end, "%s", what);
}

// By repeated squaring, so that the bits do not depend on the C library.
static double power(double base, double exponent) {
    double result = 1;
    for (int n = (int)fabs(exponent); n; n >>= 1, base *= base)
        if (n & 1)
            result *= base;
    return exponent < 0 ? 1 / result : result;
}

static bool between(const struct expression_step *step, double a, double b, double *value,
                    struct expression_fault *fault) {
    switch (step->kind) {
    case STEP_ADD:
        *value = a + b;
        break;
    case STEP_SUBTRACT:
        *value = a - b;
        break;
    case STEP_MULTIPLY:
        *value = a * b;
        break;
    case STEP_DIVIDE:
    case STEP_REMAINDER:
        if (b == 0)
            return fail(fault, step, "division by 0");
        *value = step->kind == STEP_DIVIDE ? a / b : fmod(a, b);
        break;
    default:
        if (!is_whole(b) || fabs(b) > 1024)
            return fail(fault, step, "an exponent is a whole number, at most 1024; of a half, sqrt(x)");
        if (a == 0 && b < 0)
            return fail(fault, step, "division by 0");
        *value = power(a, b);
    }
    return isfinite(*value) || fail(fault, step, "the value of this is not finite");
}

static double compare(enum step_kind kind, double a, double b) {
    switch (kind) {
    case STEP_LESS:
        return a < b;
    case STEP_LESS_EQUAL:
        return a <= b;
    case STEP_GREATER:
        return a > b;
    case STEP_GREATER_EQUAL:
        return a >= b;
    case STEP_EQUAL:
        return a == b;
    default:
        return a != b;
    }
}

static bool call(const struct expression_step *step, double *a, struct expression_fault *fault) {
    const struct expression_function *f = &expression_functions[step->function];
    if (f->count == 0 && !keys_rise(a, step->count))
        return expression_fail(fault, step->begin, step->end, "'%s' takes %s", f->name, f->wrong);
    if (f->call == call_sqrt && a[0] < 0)
        return fail(fault, step, "the square root of a negative number");
    *a = f->call(a, step->count);
    return isfinite(*a) || fail(fault, step, "the value of this is not finite");
}

// splitmix64 of one number after the other; 53 bits of it.
static bool take_random(const struct expression_step *step, double *a, struct expression_fault *fault) {
    uint64_t hash = 0;
    for (int i = 0; i < step->count; i++) {
        if (!is_whole(a[i]))
            return fail(fault, step, "'random' takes whole numbers");
        hash = splitmix(hash ^ (uint64_t)(int64_t)a[i]);
    }
    *a = (double)(hash >> 11) * 0x1p-53;
    return true;
}

static void put_color(const struct expression_at *at, uint32_t hex, double *out) {
    srgb_of_hex(hex, at->decodes, out);
    out[3] = hex;
}

// The hexcone model of A. R. Smith, "Color Gamut Transform Pairs", 1978.
static bool take_hsv(const struct expression_at *at, const struct expression_step *step, double *a,
                     struct expression_fault *fault) {
    if (!(a[1] >= 0 && a[1] <= 1 && a[2] >= 0 && a[2] <= 1))
        return fail(fault, step, "saturation and value are from 0 to 1");
    double hue = fmod(a[0], 360) / 60;
    hue += hue < 0 ? 6 : 0;
    uint32_t hex = 0;
    for (int i = 0; i < 3; i++) {
        double from = hue - 2 * i; // red has its middle at 0, green at 2, blue at 4
        from = fabs(from) > 3 ? 6 - fabs(from) : fabs(from);
        const double share = fmin(fmax(2 - from, 0), 1);
        hex = hex << 8 | (uint32_t)floor(255 * a[2] * (1 - a[1] * (1 - share)) + 0.5);
    }
    put_color(at, hex, a);
    return true;
}

static bool is_finite_triple(const struct expression_step *step, const double *a,
                             struct expression_fault *fault) {
    return (isfinite(a[0]) && isfinite(a[1]) && isfinite(a[2])) ||
           fail(fault, step, "the value of this is not finite");
}

// ---- all steps

struct run {
    const struct expression_at *at;
    double *end; // of the numbers that wait
    struct expression_fault *fault;
};

static bool triples(struct run *run, const struct expression_step *step) {
    double *a;
    double factor;
    switch (step->kind) {
    case STEP_NEGATE_TRIPLE:
        a = run->end - EXPRESSION_WIDTH;
        for (int i = 0; i < 3; i++)
            a[i] = -a[i];
        break;
    case STEP_ADD_TRIPLES:
    case STEP_SUBTRACT_TRIPLES:
        run->end -= EXPRESSION_WIDTH;
        a = run->end - EXPRESSION_WIDTH;
        for (int i = 0; i < 3; i++)
            a[i] += step->kind == STEP_ADD_TRIPLES ? a[EXPRESSION_WIDTH + i] : -a[EXPRESSION_WIDTH + i];
        break;
    case STEP_SCALE_TRIPLE:
        a = run->end - EXPRESSION_WIDTH - 1;
        factor = a[0];
        for (int i = 0; i < 3; i++)
            a[i] = factor * a[i + 1];
        run->end--;
        break;
    case STEP_MIX_COLORS:
        run->end -= EXPRESSION_WIDTH + 1;
        a = run->end - EXPRESSION_WIDTH;
        factor = a[2 * EXPRESSION_WIDTH];
        for (int i = 0; i < 3; i++)
            a[i] = a[i] * (1 - factor) + a[EXPRESSION_WIDTH + i] * factor;
        break;
    default:
        a = --run->end - EXPRESSION_WIDTH;
        factor = *run->end;
        if (step->kind == STEP_SHRINK && factor == 0)
            return fail(run->fault, step, "division by 0");
        for (int i = 0; i < 3; i++)
            a[i] = step->kind == STEP_SHRINK ? a[i] / factor : a[i] * factor;
    }
    a[3] = -1;
    return is_finite_triple(step, a, run->fault);
}

// Steps that only add a value.
static bool adds(struct run *run, const struct expression_step *step) {
    const double *value;
    switch (step->kind) {
    case STEP_NUMBER:
        *run->end++ = step->number;
        return true;
    case STEP_NAME:
        *run->end++ = run->at->values[(size_t)EXPRESSION_WIDTH * step->at];
        return true;
    case STEP_TRIPLE:
        value = run->at->values + (size_t)EXPRESSION_WIDTH * step->at;
        memcpy(run->end, value, EXPRESSION_WIDTH * sizeof *value);
        run->end += EXPRESSION_WIDTH;
        return true;
    case STEP_FRAME:
        *run->end++ = run->at->frame;
        return true;
    case STEP_TIME:
        *run->end++ = run->at->time;
        return true;
    default:
        return false;
    }
}

// Steps that decide what comes next.
static bool jumps(struct run *run, const struct expression_step *step, const struct expression_step **next) {
    switch (step->kind) {
    case STEP_AND:
    case STEP_OR:
        if ((run->end[-1] != 0) == (step->kind == STEP_OR))
            *next += step->at;
        else
            run->end--;
        return true;
    case STEP_BRANCH:
        if (*--run->end == 0)
            *next += step->at;
        return true;
    case STEP_JUMP:
        *next += step->at;
        return true;
    default:
        return false;
    }
}

static bool computes(struct run *run, const struct expression_step *step) {
    switch (step->kind) {
    case STEP_NEGATE:
        run->end[-1] = -run->end[-1];
        return true;
    case STEP_NOT:
        run->end[-1] = run->end[-1] == 0;
        return true;
    case STEP_COMPONENT:
        run->end -= EXPRESSION_WIDTH - 1;
        run->end[-1] = run->end[(int)step->at - 1];
        return true;
    case STEP_CALL:
        run->end -= step->count - 1;
        return call(step, run->end - 1, run->fault);
    case STEP_RANDOM:
        run->end -= step->count - 1;
        return take_random(step, run->end - 1, run->fault);
    case STEP_HSV:
        run->end += EXPRESSION_WIDTH - 3;
        return take_hsv(run->at, step, run->end - EXPRESSION_WIDTH, run->fault);
    case STEP_LESS:
    case STEP_LESS_EQUAL:
    case STEP_GREATER:
    case STEP_GREATER_EQUAL:
    case STEP_EQUAL:
    case STEP_UNEQUAL:
        run->end--;
        run->end[-1] = compare((enum step_kind)step->kind, run->end[-1], run->end[0]);
        return true;
    case STEP_ADD:
    case STEP_SUBTRACT:
    case STEP_MULTIPLY:
    case STEP_DIVIDE:
    case STEP_REMAINDER:
    case STEP_POWER:
        run->end--;
        return between(step, run->end[-1], run->end[0], &run->end[-1], run->fault);
    default:
        return triples(run, step);
    }
}

bool expression_at(const struct expression *expression, const struct expression_at *at,
                   double value[EXPRESSION_WIDTH], struct expression_fault *fault) {
    double values[EXPRESSION_STACK_MOST + EXPRESSION_WIDTH];
    struct run run = {at, values, fault};
    const struct expression_step *step = expression->steps, *last = step + expression->count;
    while (step < last) {
        const struct expression_step *next = step + 1;
        if (!adds(&run, step) && !jumps(&run, step, &next) && !computes(&run, step))
            return false;
        step = next;
    }
    for (int i = 0; i < (expression->type == EXPRESSION_TRIPLE ? EXPRESSION_WIDTH : 1); i++)
        value[i] = values[i] + 0.0; // no -0
    return true;
}
