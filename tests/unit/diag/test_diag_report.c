#include "core/json_write.h"
#include "diag/codes/binding.h"
#include "diag/codes/rule.h"
#include "diag/diag_report.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

struct fixture {
    struct arena arena;
    struct source_set sources;
    struct diag_sink sink;
    struct report_scene scene;
};
static struct fixture f;

static int set_up(void **state) {
    (void)state;
    arena_init(&f.arena, 1 << 24);
    source_set_init(&f.sources, &f.arena);
    diag_sink_init(&f.sink);
    report_scene_init(&f.scene, STR("a.yaml"));
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    report_scene_finish(&f.scene);
    diag_sink_finish(&f.sink);
    arena_finish(&f.arena);
    return 0;
}

static uint32_t add_source(const char *path, const char *text) {
    return source_add(&f.sources, SOURCE_KIND_FILE, str_from(path), str_from(text));
}

static void fill(uint32_t most) {
    struct report_input input = {.sink = &f.sink, .sources = &f.sources, .root = "/base/of", .most = most};
    assert_true(report_scene_add(&f.scene, &input));
}

static void check_path(const char *path, const char *wanted) {
    str got = report_path(&f.arena, "/base/of", str_from(path));
    assert_int_equal(got.len, strlen(wanted));
    assert_memory_equal(got.ptr, wanted, got.len);
}

static void paths(void **state) {
    (void)state;
    check_path("a.yaml", "a.yaml");
    check_path("./a/./b//c", "a/b/c");
    check_path("a/../b", "b");
    check_path("a/b/../../c", "c");
    check_path("../a", "../a");
    check_path("../../a/../b", "../../b");
    check_path("a/../../b", "../b");
    check_path("/base/of/a", "a");
    check_path("/base/of/x/../a", "a");
    check_path("/base/off/a", "/base/off/a");
    check_path("/base/of", "/base/of");
    check_path("/../a", "/a");
    check_path("", ".");
}

static void findings_are_copied(void **state) {
    (void)state;
    uint32_t source = add_source("x/../a.yaml", "one\n  two: 3\n");
    diag_add(&f.sink, DIAG_OUT_OF_RANGE, (span){source, 6, 9}, "too %s", "large");
    diag_note(&f.sink, (span){source, 0, 3}, "here");
    diag_note(&f.sink, SPAN_NONE, "nowhere");
    diag_help(&f.sink, "smaller");
    diag_fix(&f.sink, true, (span){source, 6, 9}, STR("2"));
    fill(10);
    diag_sink_finish(&f.sink);
    diag_sink_init(&f.sink);
    assert_int_equal(f.scene.findings.count, 1);
    assert_int_equal(f.scene.errors, 1);
    const struct report_finding *found = &f.scene.findings.items[0];
    assert_true(str_equal_cstr(found->at.path, "a.yaml"));
    assert_int_equal(found->at.line, 2);
    assert_int_equal(found->at.column, 3);
    assert_int_equal(found->at.end_column, 6);
    assert_true(str_equal_cstr(found->message, "too large"));
    assert_true(str_equal_cstr(found->line_text, "two: 3"));
    assert_int_equal(found->note_count, 2);
    assert_int_equal(found->notes[0].at.line, 1);
    assert_int_equal(found->notes[1].at.path.len, 0);
    assert_true(found->has_fix && found->fix_is_safe && str_equal_cstr(found->fix_text, "2"));
}

static void the_first_error_has_room(void **state) {
    (void)state;
    uint32_t source = add_source("a.yaml", "0123456789");
    static const diag_code warnings[] = {DIAG_OPEN_DIELECTRIC, DIAG_CAMERA_INSIDE, DIAG_LIGHT_INSIDE,
                                         DIAG_INDEX_ONE, DIAG_AMPLIFYING};
    for (uint32_t i = 0; i < 5; i++)
        diag_add(&f.sink, warnings[i], (span){source, i, i + 1}, "w%u", i);
    diag_add(&f.sink, DIAG_OUT_OF_RANGE, (span){source, 8, 9}, "e");
    fill(2);
    assert_int_equal(f.scene.findings.count, 3);
    assert_int_equal(f.scene.left_out.count, 3);
    assert_int_equal(f.scene.left_out.of[DIAG_LIGHT_INSIDE], 1);
    assert_int_equal(f.scene.findings.items[2].severity, DIAG_ERROR);
    assert_int_equal(f.scene.warnings, 5);
}

// However many are alike, each has its place, and what has none is counted by code.
static void all_have_a_place_up_to_the_limit(void **state) {
    (void)state;
    char text[301];
    memset(text, 'x', 300);
    text[300] = '\0';
    uint32_t source = add_source("a.yaml", text);
    for (uint32_t i = 0; i < 150; i++)
        diag_add(&f.sink, DIAG_OUT_OF_RANGE, (span){source, i, i + 1}, "m");
    diag_add(&f.sink, DIAG_OPEN_DIELECTRIC, (span){source, 200, 201}, "w");
    fill(100);
    assert_int_equal(f.scene.findings.count, 100);
    assert_int_equal(f.scene.findings.items[99].code, DIAG_OPEN_DIELECTRIC);
    assert_int_equal(f.scene.left_out.count, 51);
    assert_int_equal(f.scene.left_out.of[DIAG_OUT_OF_RANGE], 51);
    const uint32_t needed = report_needed(&f.scene);
    assert_int_equal(needed, 151);
    report_scene_finish(&f.scene);
    report_scene_init(&f.scene, STR("a.yaml"));
    fill(needed);
    assert_int_equal(f.scene.findings.count, 151);
    assert_int_equal(f.scene.left_out.count, 0);
    assert_int_equal(f.scene.findings.items[149].at.column, 150);
}

// Texts have a bound, too, whatever their number.
static void long_texts_are_left_out(void **state) {
    (void)state;
    uint32_t source = add_source("a.yaml", "0123456789");
    char text[1901];
    memset(text, 'x', 1900);
    text[1900] = '\0';
    for (uint32_t i = 0; i < 100; i++)
        diag_add(&f.sink, DIAG_OUT_OF_RANGE, (span){source, i % 10, 10}, "%u %s", i, text);
    fill(100);
    assert_in_range(f.scene.findings.count, 5, 40);
    assert_int_equal(f.scene.findings.count + f.scene.left_out.count, 100);
}

static void one_list_of_several_scenes(void **state) {
    (void)state;
    struct report_scene scenes[2];
    uint32_t source = add_source("shared.yaml", "a\na\nb\n");
    diag_add(&f.sink, DIAG_OUT_OF_RANGE, (span){source, 0, 1}, "m");
    diag_add(&f.sink, DIAG_OUT_OF_RANGE, (span){source, 2, 3}, "m"); // an equal line
    diag_add(&f.sink, DIAG_OUT_OF_RANGE, (span){source, 4, 5}, "m");
    fill(10);
    scenes[0] = scenes[1] = f.scene;
    struct report report = {.scenes = scenes, .scene_count = 2};
    struct report_list list;
    assert_true(report_list_all(&report, &list));
    assert_int_equal(list.count, 3);
    assert_true(list.items[0].fingerprint == list.items[1].fingerprint);
    assert_int_equal(list.items[0].occurrence, 1);
    assert_int_equal(list.items[1].occurrence, 2);
    assert_true(list.items[0].fingerprint != list.items[2].fingerprint);
    free(list.items);
}

static void json_is_escaped(void **state) {
    (void)state;
    struct strbuf out;
    struct json_writer w;
    strbuf_init(&out);
    json_writer_init(&w, &out, 2);
    json_open_object(&w, NULL);
    json_write_text(&w, "a\"", STR("q\" b\\ n\n t\t u\x01 \xC3\xA9 \xFF"));
    json_open_list(&w, "l");
    json_write_integer(&w, NULL, UINT64_MAX);
    json_write_boolean(&w, NULL, true);
    json_write_null(&w, NULL);
    json_open_object(&w, NULL);
    json_close_object(&w);
    json_close_list(&w);
    json_close_object(&w);
    json_end(&w);
    assert_string_equal(out.data,
                        "{\n  \"a\\\"\": \"q\\\" b\\\\ n\\n t\\u0009 u\\u0001 \xC3\xA9 \xEF\xBF\xBD\",\n"
                        "  \"l\": [18446744073709551615, true, null, {}]\n}\n");
    strbuf_finish(&out);
}

// What a workflow might take for a command, and what XML cannot hold.
static void hostile_texts(void **state) {
    (void)state;
    struct strbuf out;
    uint32_t source = add_source("::error::x", "0123456789");
    for (uint32_t i = 0; i < 12; i++)
        diag_add(&f.sink, DIAG_OUT_OF_RANGE, (span){source, 0, i},
                 "%u ##[add-mask]x\n::set-env name=a::b \x1b[1m \xEF\xBF\xBE ]]> & <", i);
    fill(20);
    struct report report = {
        .program_version = "1.2.3", .root = "/base/of", .scenes = &f.scene, .scene_count = 1};
    strbuf_init(&out);
    report_github(&out, &report);
    assert_non_null(strstr(out.data, "::error file=%3A%3Aerror%3A%3Ax,line=1"));
    assert_null(strstr(out.data, "\n::set-env"));
    const char *plain = strstr(out.data, "\nglint: ");
    assert_non_null(plain);
    assert_null(strstr(plain, "##["));
    strbuf_clear(&out);
    f.scene.state = REPORT_FAILED;
    report_junit(&out, &report);
    assert_null(strstr(out.data, "\x1b"));
    assert_null(strstr(out.data, "\xEF\xBF\xBE"));
    assert_null(strstr(out.data, "]]>"));
    assert_non_null(strstr(out.data, "]]&gt; &amp; &lt;"));
    strbuf_finish(&out);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        TEST(paths),
        TEST(findings_are_copied),
        TEST(the_first_error_has_room),
        TEST(all_have_a_place_up_to_the_limit),
        TEST(long_texts_are_left_out),
        TEST(one_list_of_several_scenes),
        TEST(json_is_escaped),
        TEST(hostile_texts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
