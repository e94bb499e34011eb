// Expressions: values, types, where what is wrong with one is, and what was meant.
#include "core/expression.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

// Names of a scene: n is 3, p is 1 2 3, paint is #804020, open is true.
static bool find(const void *context, str name, struct expression_name *found) {
    (void)context;
    static const struct {
        const char *name;
        struct expression_name is;
    } names[] = {{"n", {EXPRESSION_NUMBER, 0, false}},     {"p", {EXPRESSION_TRIPLE, 1, false}},
                 {"paint", {EXPRESSION_TRIPLE, 2, false}}, {"open", {EXPRESSION_TRUTH, 3, false}},
                 {"moving", {EXPRESSION_NUMBER, 0, true}}, {"h\xC3\xB6he", {EXPRESSION_NUMBER, 0, false}}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (str_equal_cstr(name, names[i].name)) {
            *found = names[i].is;
            return true;
        }
    return false;
}

static const struct expression_scope SCOPE = {find, NULL};
static const double VALUES[][EXPRESSION_WIDTH] = {
    {3}, {1, 2, 3, -1}, {128 / 255.0, 64 / 255.0, 32 / 255.0, 0x804020}, {1}};
static const struct expression_at AT = {.frame = 25, .time = 2, .values = VALUES[0]};

static bool evaluate(const char *text, struct expression *expression, double value[EXPRESSION_WIDTH],
                     struct expression_fault *fault) {
    struct arena arena;
    arena_init(&arena, 1 << 20);
    const bool good = expression_compile(str_from(text), &SCOPE, &arena, expression, fault) &&
                      expression_at(expression, &AT, value, fault);
    arena_finish(&arena);
    return good;
}

static const struct {
    const char *text;
    double value;
} NUMBERS[] = {
    {"1+2*3", 7},
    {"(1+2)*3", 9},
    {"-2^2", -4},
    {"2^3^2", 512},
    {"2^-1", 0.5},
    {"2^1024/2^1023", NAN},
    {"0^0", 1},
    {"7%4-1", 2},
    {"-7 % 4", -3},
    {"8/4/2", 1},
    {"1-2-3", -4},
    {" frame / 10 ", 2.5},
    {"time", 2},
    {"1e2 + .5", 100.5},
    {"cos(180)", -1},
    {"sin(30)*2", 1},
    {"cos(-90) + sin(180) + cos(270)", 0},
    {"sqrt(16)+abs(-1)+floor(2.7)", 7},
    {"min(1,2)+max(1,2)", 3},
    {"mix(10, 20, 0.25)", 12.5},
    {"keys(frame, 0,0, 50,10, 100,0)", 5},
    {"keys(frame, 0,0, 10,4, 50,12)", 7},
    {"keys(-1, 0,3, 10,4)", 3},
    {"keys(99, 0,3, 10,4)", 4},
    {"keys(10, 0,3, 10,4, 20,9)", 4},
    {"ease(5, 0,0, 10,8)", 4},
    {"ease(2.5, 0,0, 10,64)", 10},
    {"keys(3, 5,7)", 7},
    {"n*n", 9},
    {"h\xC3\xB6he + 1", 4},
    {"p.x + 10*p.y + 100*p.z", 321},
    {"(p*2).z", 6},
    {"(2*p - p/2).y", 3},
    {"(-p).x", -1},
    {"mix(p, p*3, 0.5).y", 4},
    {"1 if n > 2 else 2", 1},
    {"1 if n < 2 else 2 if n == 3 else 3", 2},
    {"1/(n - 3) if n != 3 else 7", 7},
    {"(1 if open else 2) + (10 if not open else 20)", 21},
    {"1 if n < 2 or n > 2 and open else 0", 1},
    {"1 if n == 2 and 1/(n - 3) > 0 else 0", 0},
    {"1 if open or 1/(n - 3) > 0 else 0", 1},
    {"1 if not n == 2 else 0", 1},
    {"1 if open == true and open != false else 0", 1},
    {"(p if n > 2 else -p).x", 1},
    {"hsv(0, 1, 1).x", 1},
    {"hsv(240, 1, 0.2).z*255", 51},
    {"hsv(-60, 0.5, 1).y*255", 128},
    {"pi - pi", 0},
    {"random(7) - random(7)", 0},
};

static void numbers(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof NUMBERS / sizeof *NUMBERS; i++) {
        struct expression_fault fault = {0};
        struct expression expression;
        double value[EXPRESSION_WIDTH] = {NAN};
        const bool good = evaluate(NUMBERS[i].text, &expression, value, &fault);
        if (isnan(NUMBERS[i].value)) {
            assert_false(good);
            continue;
        }
        if (!good)
            fail_msg("%s: %s", NUMBERS[i].text, fault.what);
        assert_int_equal(expression.type, EXPRESSION_NUMBER);
        if (!(fabs(value[0] - NUMBERS[i].value) < 1e-12))
            fail_msg("%s is %.17g", NUMBERS[i].text, value[0]);
    }
}

// Quarters and sixths are exact, not only near.
static void exact(void **state) {
    static const struct {
        const char *text;
        double value;
    } rows[] = {{"sin(30)", 0.5}, {"cos(60)", 0.5},       {"cos(90)", 0},     {"sin(720)", 0},
                {"sin(-90)", -1}, {"3^20", 3486784401.0}, {"0.1*3", 0.1 * 3}, {"cos(-1e9*360)", 1}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct expression_fault fault = {0};
        struct expression expression;
        double value[EXPRESSION_WIDTH] = {NAN};
        assert_true(evaluate(rows[i].text, &expression, value, &fault));
        if (value[0] != rows[i].value)
            fail_msg("%s is %a", rows[i].text, value[0]);
    }
}

static void colors_stay_as_written(void **state) {
    static const struct {
        const char *text;
        double hex;
    } rows[] = {{"paint", 0x804020},
                {"hsv(0, 1, 1)", 0xff0000},
                {"paint if open else p", 0x804020},
                {"p", -1},
                {"paint*1", -1},
                {"p if n > 9 else hsv(120, 1, 1)", 0x00ff00},
                {"hsv(210, 0.25, 0.5)", 0x607080}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct expression_fault fault = {0};
        struct expression expression;
        double value[EXPRESSION_WIDTH] = {NAN};
        assert_true(evaluate(rows[i].text, &expression, value, &fault));
        assert_int_equal(expression.type, EXPRESSION_TRIPLE);
        if (value[3] != rows[i].hex)
            fail_msg("%s is %06x", rows[i].text, (unsigned)value[3]);
    }
}

static void what_moves(void **state) {
    static const char *const still[] = {"n", "1 if open else 2", "random(3)"}, *const moving[] = {
                                                                                   "frame", "n + time",
                                                                                   "1 if open else frame",
                                                                                   "moving*2"};
    struct expression_fault fault;
    struct expression expression;
    double value[EXPRESSION_WIDTH];
    (void)state;
    for (size_t i = 0; i < sizeof still / sizeof *still; i++) {
        assert_true(evaluate(still[i], &expression, value, &fault));
        assert_false(expression.moves);
    }
    for (size_t i = 0; i < sizeof moving / sizeof *moving; i++) {
        assert_true(evaluate(moving[i], &expression, value, &fault));
        assert_true(expression.moves);
    }
}

// random() is evenly spread, and neighbours are no alike.
static void random_numbers(void **state) {
    enum {
        COUNT = 20000,
        BINS = 20
    };
    int bins[BINS] = {0};
    double product = 0, last = 0.5;
    (void)state;
    for (int i = 0; i < COUNT; i++) {
        struct expression_fault fault;
        const struct expression_at at = {.frame = i};
        double value;
        assert_true(expression_value(STR("random(frame, 3)"), &at, &value, &fault));
        assert_true(value >= 0 && value < 1);
        bins[(int)(value * BINS)]++;
        product += (value - 0.5) * (last - 0.5);
        last = value;
    }
    for (int i = 0; i < BINS; i++)
        assert_in_range(bins[i], COUNT / BINS * 0.85, COUNT / BINS * 1.15);
    assert_true(fabs(product / COUNT) < 0.003);
}

static const struct {
    const char *text;
    size_t begin, end;
    const char *fix; // NULL: none
} FAULTS[] = {
    {"", 0, 1, NULL},
    {"1+", 2, 3, NULL},
    {"1 2", 2, 3, NULL},
    {"(1", 2, 3, NULL},
    {"1+foo*2", 2, 5, NULL},
    {"foo(1)", 0, 3, NULL},
    {"sin(1,2)", 0, 8, NULL},
    {"1/0", 0, 3, NULL},
    {"2 + 1/(n - 3)*2", 4, 13, NULL},
    {"7 % 0", 0, 5, NULL},
    {"p/0", 0, 3, NULL},
    {"0^-1", 0, 4, NULL},
    {"2^0.5", 0, 5, NULL},
    {"2^2000", 0, 6, NULL},
    {"10^300*10^300", 0, 13, NULL},
    {"1..2", 0, 4, NULL},
    {"keys(1, 5,1, 2,3)", 0, 17, NULL},
    {"sin 1", 0, 3, NULL},
    {"2*#", 2, 3, NULL},
    {"keys(1, 2)", 0, 10, NULL},
    {"sqrt(-1)", 0, 8, NULL},
    {"n if n else 1", 5, 6, NULL},
    {"1 if open else open", 0, 19, NULL},
    {"1 if open", 9, 10, NULL},
    {"not n", 4, 5, NULL},
    {"n and open", 0, 1, NULL},
    {"p + n", 0, 5, NULL},
    {"p*p", 0, 3, NULL},
    {"1/p", 2, 3, NULL},
    {"open + 1", 0, 4, NULL},
    {"n.x", 1, 3, NULL},
    {"p.w", 1, 3, NULL},
    {"sin(p)", 4, 5, NULL},
    {"random(0.5)", 0, 11, NULL},
    {"hsv(1, 2, 1)", 0, 12, NULL},
    {"1 < n < 5", 6, 7, NULL},
    {"frame*tau", 6, 9, "360"},
    {"sin(2*pi*time)", 6, 8, "180"},
    {"open && open", 5, 7, "and"},
    {"open || open", 5, 7, "or"},
    {"!open", 0, 1, "not "},
    {"n ** 2", 2, 4, "^"},
    {"1 if n = 3 else 2", 7, 8, "=="},
    {"open ? 1 : 2", 5, 6, NULL},
    {"+1", 0, 1, ""},
    {"else", 0, 4, NULL},
    {"n mod 2", 2, 5, "%"},
    {"n div 2", 2, 5, NULL},
    {"2n", 1, 2, NULL},
    {"Math.sqrt(n)", 0, 5, ""},
    {"$n", 0, 1, ""},
    {"range(3)", 0, 5, NULL},
    {"yes", 0, 3, NULL},
};

static void faults(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof FAULTS / sizeof *FAULTS; i++) {
        struct expression_fault fault = {0};
        struct expression expression;
        double value[EXPRESSION_WIDTH];
        if (evaluate(FAULTS[i].text, &expression, value, &fault))
            fail_msg("'%s' is %g", FAULTS[i].text, value[0]);
        if (fault.begin != FAULTS[i].begin || fault.end != FAULTS[i].end)
            fail_msg("'%s': %zu to %zu, %s", FAULTS[i].text, fault.begin, fault.end, fault.what);
        if ((fault.fix != NULL) != (FAULTS[i].fix != NULL) ||
            (fault.fix && strcmp(fault.fix, FAULTS[i].fix) != 0))
            fail_msg("'%s': written as '%s'", FAULTS[i].text, fault.fix ? fault.fix : "(none)");
        assert_true(fault.what[0] || fault.problem != EXPRESSION_WRONG);
    }
}

static void nesting_has_an_end(void **state) {
    static const char *const begins[] = {"(", "-", "not ", "1 if true else ", "min(1,", "1+(", "true and ("};
    (void)state;
    for (size_t i = 0; i < sizeof begins / sizeof *begins; i++) {
        struct expression_fault fault = {0};
        struct strbuf text;
        double value;
        strbuf_init(&text);
        for (int k = 0; k < 100000; k++)
            strbuf_cstr(&text, begins[i]);
        assert_false(expression_value(strbuf_view(&text), &AT, &value, &fault));
        assert_in_range(fault.begin, 1, 2000);
        strbuf_finish(&text);
    }
}

static void what_is_meant(void **state) {
    static const char *const meant[] = {
        "two",    "columns*pitch", "n - 1",     "1-2",           "2026-11-23", "-n", "sin(30)",
        "f(",     "p.x",           "(n)",       "1 if n else 2", "a ? b : c",  "y",  "not open",
        "3m - 2", "n==2",          "2*(1 + 1)", "höhe",          "1e3 + 400"};
    static const char *const plain[] = {
        "yes",    "on",         "~",     "null",    "0x10",    "1_000",   "1:30",     ".inf",      "1e",
        "3m",     "50%",        "1,5",   "007",     "",        "1 2 3",   "640x480",  "true",      "16:9",
        "5",      "-1.5e-3",    "1 m",   "(0, 0)",  "#c08050", "a b",     "wood.png", "https://x", "- 5",
        "1e+400", "0, 30*r, 0", "1,5*x", "-1e-400", "2E+3",    "\u22125", "5\u20133"};
    (void)state;
    for (size_t i = 0; i < sizeof meant / sizeof *meant; i++)
        if (!expression_is_meant(str_from(meant[i])))
            fail_msg("'%s' is taken as no expression", meant[i]);
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++)
        if (expression_is_meant(str_from(plain[i])))
            fail_msg("'%s' is taken as an expression", plain[i]);
}

static void texts(void **state) {
    struct expression_fault fault = {0};
    struct strbuf out;
    bool filled;
    (void)state;
    strbuf_init(&out);
    assert_true(expression_fill(STR("a.b=[{frame/100}, 1, {-time}]"), &AT, &out, &filled, &fault));
    assert_true(filled);
    assert_string_equal(out.data, "a.b=[0.25, 1, -2]");
    strbuf_clear(&out);
    assert_true(expression_fill(STR("a={color: [1, 2, 3]} {}"), &AT, &out, &filled, &fault));
    assert_false(filled);
    assert_string_equal(out.data, "a={color: [1, 2, 3]} {}");
    strbuf_clear(&out);
    assert_false(expression_fill(STR("a={1}{2+}"), &AT, &out, &filled, &fault));
    assert_int_equal(fault.begin, 8);
    strbuf_finish(&out);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers),
        cmocka_unit_test(exact),
        cmocka_unit_test(colors_stay_as_written),
        cmocka_unit_test(what_moves),
        cmocka_unit_test(random_numbers),
        cmocka_unit_test(faults),
        cmocka_unit_test(nesting_has_an_end),
        cmocka_unit_test(what_is_meant),
        cmocka_unit_test(texts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
