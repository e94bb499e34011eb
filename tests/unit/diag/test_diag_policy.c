#include "diag/codes/binding.h"
#include "diag/codes/file.h"
#include "diag/codes/rule.h"
#include "diag/diag_policy.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static struct diag_policy policy;

static int set_up(void **state) {
    (void)state;
    policy = (struct diag_policy){0};
    return 0;
}

static bool keeps(diag_code code, enum diag_severity *severity) {
    struct diag item = {.code = code, .severity = diag_info(code)->severity};
    bool kept = diag_policy_keeps(&policy, &item, false);
    *severity = item.severity;
    return kept;
}

static void code_texts(void **state) {
    (void)state;
    assert_true(diag_is_code_text(STR("W401")) && diag_is_code_text(STR("w4xx")) &&
                diag_is_code_text(STR("E9XX")));
    assert_false(diag_is_code_text(STR("W40")) || diag_is_code_text(STR("X401")) ||
                 diag_is_code_text(STR("Wxxx")) || diag_is_code_text(STR("W4x1")) ||
                 diag_is_code_text(STR("")) || diag_is_code_text(STR("W4011")));
    assert_true(diag_code_matches(DIAG_OPEN_DIELECTRIC, STR("W401")));
    assert_true(diag_code_matches(DIAG_OPEN_DIELECTRIC, STR("w4XX")));
    assert_false(diag_code_matches(DIAG_OPEN_DIELECTRIC, STR("W6xx")));
    assert_false(diag_code_matches(DIAG_OPEN_DIELECTRIC, STR("E4xx")));
}

static void levels(void **state) {
    (void)state;
    enum diag_severity severity;
    assert_true(keeps(DIAG_OPEN_DIELECTRIC, &severity));
    assert_int_equal(severity, DIAG_WARNING);
    assert_int_equal(diag_policy_level(&policy, STR("W4xx"), STR("note")), DIAG_POLICY_SET);
    assert_int_equal(diag_policy_level(&policy, STR("W401"), STR("error")), DIAG_POLICY_SET);
    assert_true(keeps(DIAG_OPEN_DIELECTRIC, &severity));
    assert_int_equal(severity, DIAG_ERROR);
    assert_int_equal(diag_policy_level(&policy, STR("W401"), STR("off")), DIAG_POLICY_SET);
    assert_false(keeps(DIAG_OPEN_DIELECTRIC, &severity));
    assert_true(keeps(DIAG_MTL_MISSING, &severity));
    assert_int_equal(diag_policy_level(&policy, STR("W401"), STR("loud")), DIAG_POLICY_BAD_WORD);
    assert_int_equal(diag_policy_level(&policy, STR("W999"), STR("off")), DIAG_POLICY_UNKNOWN_CODE);
}

static void errors_stay(void **state) {
    (void)state;
    enum diag_severity severity;
    assert_int_equal(diag_policy_level(&policy, STR("E206"), STR("off")), DIAG_POLICY_ERROR_CODE);
    assert_int_equal(diag_policy_level(&policy, STR("E2xx"), STR("warning")), DIAG_POLICY_ERROR_CODE);
    assert_int_equal(diag_policy_only(&policy, STR("W401")), DIAG_POLICY_SET);
    assert_true(keeps(DIAG_OUT_OF_RANGE, &severity));
    assert_int_equal(severity, DIAG_ERROR);
    struct diag item = {.code = DIAG_OUT_OF_RANGE, .severity = DIAG_ERROR};
    assert_true(diag_policy_keeps(&policy, &item, true));
}

static void only_these(void **state) {
    (void)state;
    enum diag_severity severity;
    assert_int_equal(diag_policy_only(&policy, STR("N4xx")), DIAG_POLICY_SET);
    assert_false(keeps(DIAG_OPEN_DIELECTRIC, &severity));
    assert_true(keeps(DIAG_DEFAULT_CAMERA, &severity));
    assert_int_equal(diag_policy_only(&policy, STR("N999")), DIAG_POLICY_UNKNOWN_CODE);
}

static void ignored_paths(void **state) {
    (void)state;
    struct arena arena;
    arena_init(&arena, 1 << 20);
    diag_policy_ignore_path(&policy, &arena, STR("/a/b"), STR("x/**"));
    diag_policy_ignore_path(&policy, &arena, STR("/"), STR("/r.yaml"));
    assert_true(diag_policy_ignores(&policy, STR("/a/b/x/c.yaml")));
    assert_false(diag_policy_ignores(&policy, STR("/a/x/c.yaml")));
    assert_false(diag_policy_ignores(&policy, STR("/a/bx/c.yaml")));
    assert_false(diag_policy_ignores(&policy, STR("/a/b")));
    assert_true(diag_policy_ignores(&policy, STR("/r.yaml")));
    arena_finish(&arena);
}

static void what_lies_over_counts(void **state) {
    (void)state;
    struct arena arena;
    struct diag_policy over = {0};
    enum diag_severity severity;
    arena_init(&arena, 1 << 20);
    diag_policy_level(&policy, STR("W401"), STR("off"));
    diag_policy_level(&policy, STR("W601"), STR("error"));
    diag_policy_only(&policy, STR("N401"));
    diag_policy_fail_on(&policy, STR("warning"));
    diag_policy_level(&over, STR("W401"), STR("note"));
    diag_policy_only(&over, STR("W4xx"));
    diag_policy_only(&over, STR("W6xx"));
    diag_policy_overlay(&policy, &arena, &over);
    assert_true(keeps(DIAG_OPEN_DIELECTRIC, &severity));
    assert_int_equal(severity, DIAG_NOTE);
    assert_true(keeps(DIAG_MTL_MISSING, &severity));
    assert_int_equal(severity, DIAG_ERROR);
    assert_false(keeps(DIAG_DEFAULT_CAMERA, &severity));
    assert_int_equal(policy.fail_on, DIAG_FAIL_ON_WARNING);
    diag_policy_fail_on(&over, STR("error"));
    diag_policy_overlay(&policy, &arena, &over);
    assert_int_equal(policy.fail_on, DIAG_FAIL_ON_ERROR);
    assert_int_equal(diag_policy_fail_on(&over, STR("note")), DIAG_POLICY_BAD_WORD);
    arena_finish(&arena);
}

// A sink whose findings are filtered counts what is left.
static bool lower(void *context, struct diag *item) {
    *(int *)context += 1;
    item->severity = DIAG_NOTE;
    return item->code != DIAG_MTL_MISSING;
}

static void filtering_counts(void **state) {
    (void)state;
    struct diag_sink sink;
    int calls = 0;
    diag_sink_init(&sink);
    for (uint32_t i = 0; i < 9; i++)
        diag_add(&sink, DIAG_OPEN_DIELECTRIC, (span){1, i, i + 1}, "a");
    diag_add(&sink, DIAG_MTL_MISSING, (span){1, 20, 21}, "b");
    diag_add(&sink, DIAG_OUT_OF_RANGE, (span){1, 30, 31}, "c");
    diag_sort(&sink);
    assert_int_equal(sink.warnings, 10);
    diag_filter(&sink, lower, &calls);
    assert_int_equal(calls, 11);
    assert_int_equal(sink.count, 10);
    assert_int_equal(sink.errors + sink.warnings, 0);
    assert_int_equal(sink.notes, 10);
    assert_false(diag_policy_fails(&policy, &sink));
    diag_sink_finish(&sink);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(code_texts, set_up),
        cmocka_unit_test_setup(levels, set_up),
        cmocka_unit_test_setup(errors_stay, set_up),
        cmocka_unit_test_setup(only_these, set_up),
        cmocka_unit_test_setup(ignored_paths, set_up),
        cmocka_unit_test_setup(what_lies_over_counts, set_up),
        cmocka_unit_test_setup(filtering_counts, set_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
