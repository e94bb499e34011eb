#include "core/limits.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static enum limit_status set(struct limits *limits, const char *assignment, enum limit *which) {
    return limits_set(limits, str_from(assignment), which);
}

static void the_table_is_sane(void **state) {
    (void)state;
    struct limits limits = limits_default();
    for (int i = 0; i < LIMIT_COUNT; i++) {
        const struct limit_info *info = limit_info((enum limit)i);
        assert_true(info->least <= info->standard && info->standard <= info->greatest);
        assert_true(info->least > 0 && info->greatest <= INT64_MAX);
        assert_int_equal(limits.value[i], info->standard);
        assert_true(strlen(info->doc) > 5);
        assert_true(strspn(info->name, "abcdefghijklmnopqrstuvwxyz-") == strlen(info->name));
        for (int j = 0; j < i; j++)
            assert_string_not_equal(info->name, limit_info((enum limit)j)->name);
    }
}

static void every_limit_takes_its_range_and_no_more(void **state) {
    (void)state;
    for (int i = 0; i < LIMIT_COUNT; i++) {
        const struct limit_info *info = limit_info((enum limit)i);
        const uint64_t inside[] = {info->least, info->standard, info->greatest};
        const uint64_t outside[] = {info->least - 1, info->greatest + 1};
        for (size_t k = 0; k < 5; k++) {
            struct limits limits = limits_default();
            enum limit which = LIMIT_COUNT;
            uint64_t value = k < 3 ? inside[k] : outside[k - 3];
            char text[80];
            snprintf(text, sizeof text, "%s=%llu", info->name, (unsigned long long)value);
            assert_int_equal(set(&limits, text, &which), k < 3 ? LIMIT_SET : LIMIT_BAD_VALUE);
            assert_int_equal(which, i);
            assert_int_equal(limits.value[i], k < 3 ? value : info->standard);
        }
    }
}

static void refuses_what_is_no_assignment(void **state) {
    (void)state;
    struct limits limits = limits_default();
    const struct limits before = limits;
    enum limit which = LIMIT_COUNT;
    static const char *const unknown[] = {
        "", "=", "=5", "scene_bytes=5", "scene-byte=5", "SCENE-BYTES=5", " scene-bytes=5"};
    for (size_t i = 0; i < sizeof unknown / sizeof *unknown; i++) {
        assert_int_equal(set(&limits, unknown[i], &which), LIMIT_UNKNOWN_NAME);
        assert_int_equal(which, LIMIT_COUNT);
    }
    static const char *const bad[] = {"scene-bytes",
                                      "scene-bytes=",
                                      "scene-bytes=a",
                                      "scene-bytes=-1",
                                      "scene-bytes=1.5",
                                      "scene-bytes=1e6",
                                      "scene-bytes= 5",
                                      "scene-bytes=1_000",
                                      "scene-bytes=5M",
                                      "scene-bytes==5",
                                      "scene-bytes=99999999999999999999"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(set(&limits, bad[i], &which), LIMIT_BAD_VALUE);
        assert_int_equal(which, LIMIT_SCENE_BYTES);
    }
    assert_memory_equal(&limits, &before, sizeof limits);
}

static void a_size_is_never_cut(void **state) {
    (void)state;
    struct limits limits = limits_default();
    limits.value[LIMIT_MESH_MEMORY] = 4096;
    assert_int_equal(limits_size(&limits, LIMIT_MESH_MEMORY), 4096);
    limits.value[LIMIT_MESH_MEMORY] = UINT64_MAX;
    assert_int_equal(limits_size(&limits, LIMIT_MESH_MEMORY), SIZE_MAX / 2);
    limits.value[LIMIT_MESH_MEMORY] = (uint64_t)SIZE_MAX / 2 + 1; // whose lower half is zero in 32 bits
    assert_int_equal(limits_size(&limits, LIMIT_MESH_MEMORY), SIZE_MAX / 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_table_is_sane),
        cmocka_unit_test(a_size_is_never_cut),
        cmocka_unit_test(every_limit_takes_its_range_and_no_more),
        cmocka_unit_test(refuses_what_is_no_assignment),
    };
    return cmocka_run_group_tests_name("limits", tests, NULL, NULL);
}
