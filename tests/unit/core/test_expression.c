// Numbers that depend on the frame: values, and where what is wrong with an expression is.
#include "core/expression.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const struct expression_at AT = {.frame = 25, .time = 2};

static void values(void **state) {
    static const struct {
        const char *text;
        double value;
    } rows[] = {
        {"1+2*3", 7},
        {"(1+2)*3", 9},
        {"-2^2", -4},
        {"2^3^2", 512},
        {"2^-1", 0.5},
        {"7%4-1", 2},
        {"8/4/2", 1},
        {"1-2-3", -4},
        {" frame / 10 ", 2.5},
        {"time", 2},
        {"1e2 + .5", 100.5},
        {"cos(pi)", -1},
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
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct expression_fault fault = {0};
        double value = NAN;
        if (!expression_value(str_from(rows[i].text), &AT, &value, &fault))
            fail_msg("%s: %s", rows[i].text, fault.what);
        if (!(fabs(value - rows[i].value) < 1e-12))
            fail_msg("%s is %.17g", rows[i].text, value);
    }
}

static void faults(void **state) {
    static const struct {
        const char *text;
        size_t begin, end;
    } rows[] = {
        {"", 0, 1},
        {"1+", 2, 3},
        {"1 2", 2, 3},
        {"(1", 2, 3},
        {"1+foo*2", 2, 5},
        {"foo(1)", 0, 3},
        {"sin(1,2)", 0, 8},
        {"1/0", 0, 3},
        {"1..2", 0, 4},
        {"keys(1, 5,1, 2,3)", 0, 17},
        {"sin 1", 0, 3},
        {"2*#", 2, 3},
        {"keys(1, 2)", 0, 10},
        {"sqrt(-1)", 0, 8},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct expression_fault fault = {0};
        double value;
        if (expression_value(str_from(rows[i].text), &AT, &value, &fault))
            fail_msg("'%s' is %g", rows[i].text, value);
        if (fault.begin != rows[i].begin || fault.end != rows[i].end)
            fail_msg("'%s': %zu to %zu, %s", rows[i].text, fault.begin, fault.end, fault.what);
    }
}

static void nesting_has_an_end(void **state) {
    struct expression_fault fault = {0};
    struct strbuf text;
    double value;
    (void)state;
    strbuf_init(&text);
    strbuf_repeat(&text, '(', 100000);
    assert_false(expression_value(strbuf_view(&text), &AT, &value, &fault));
    assert_in_range(fault.begin, 1, 200);
    strbuf_finish(&text);
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
        cmocka_unit_test(values),
        cmocka_unit_test(faults),
        cmocka_unit_test(nesting_has_an_end),
        cmocka_unit_test(texts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
