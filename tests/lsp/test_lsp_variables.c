// What the language server knows of the variables of `for`. Usage: test_lsp_variables GLINT
#include "lsp_marks.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LIGHTS "lights: [{position: [9, 9, 9]}]\n"

static const char *program;

static int start(void **state) {
    struct lsp_client *client = calloc(1, sizeof *client);
    client_start(client, program);
    client_initialize(client, NULL);
    *state = client;
    return 0;
}

static int stop(void **state) {
    int status = client_stop(*state);
    free(*state);
    return status;
}

static size_t count_code(json_t *list, const char *code) {
    size_t index, count = 0;
    const json_t *item;
    json_array_foreach(list, index, item) count += strcmp(client_text(item, "code"), code) == 0;
    return count;
}

// ---- tests

static const char GRID[] =
    "glint: 1\ninclude: [part.xml]\n" LIGHTS "parameters: {wide: 2, n: 4}\n"
    "spheres:\n"
    "  - {name: a, for: {i: n, p: [[0, 0, 1], [wide, 0, 1]]}, if: i != 3, center: p, radius: 0.1 + i/10, "
    "material: {diffuse_color: [i/4, 0, 0]}}\n"
    "  - for:\n      i: 3\n      j: 3 - i # not i\n    center: [i, 4 + j, 0]\n    radius: 0.2\n"
    "  - {for: {k: [9, wide + 6], s: 2}, center: [0, k, 9 + s], radius: 0.1}\n";
static const char PART[] = "<Scene glint=\"1\">\n"
                           "  <Sphere radius=\"0.1 + i/100\" if=\"i &lt; 3\"><For name=\"i\" count=\"5\"/>"
                           "<Center x=\"3*i\" y=\"wide - 9\" z=\"0\"/></Sphere>\n</Scene>\n";

static void open_grid(struct lsp_client *client) {
    client_file(client, "part.xml", PART);
    client_open(client, "main.yaml", GRID);
    assert_int_equal(json_array_size(client_diagnostics(client, "main.yaml", 1)), 1); // there is no camera
}

static void explains_variables(void **state) {
    struct lsp_client *client = *state;
    static const char *const hovers[][2] = {
        {"{|i: n", "variable 'i' = 0 to 2, of main.yaml:6, which makes 6 copies"},
        {"+ |i/10", "variable 'i' = 0 to 2, of main.yaml:6, which makes 6 copies"},
        {"|0.1 + i/10", "radius = 0.1 to 0.3"},
        {"center: |p,", "variable 'p' = one of 2 values: [0, 0, 1], [wide, 0, 1], of main.yaml:6"},
        {"center: |p,", "center = [0, 0, 1], [2, 0, 1] in 6 copies"},
        {"[|i/4", "color.r = 0 to 0.5 in 6 copies"},
        {"!|= 3", "makes 6 copies"},
        {"f|or: {i", "makes 6 copies"},
        {"|j: 3", "variable 'j' = 0 to 2, of main.yaml:9, which makes 6 copies"},
        {"j: 3| - i", "j = 0 to 2"},
        {"3 - |i", "variable 'i' = 0 to 2, of main.yaml:8"},
        {"4 +| j", "center.y = 4 to 6 in 6 copies"},
        {"[|wide", "parameter 'wide' = 2, of main.yaml:4"},
        {"{|wide", "parameter 'wide' = 2, of main.yaml:4"},
        {"|k: [9", "variable 'k' = one of 2 values: 9, wide + 6, of main.yaml:12, which makes 4 copies"},
    };
    open_grid(client);
    for (size_t i = 0; i < sizeof hovers / sizeof *hovers; i++)
        expect_hover(client, "main.yaml", GRID, hovers[i][0], hovers[i][1]);
    client_open(client, "part.xml", PART);
    expect_hover(client, "part.xml", PART, "+ |i/100",
                 "variable 'i' = 0 to 2, of part.xml:2, which makes 3 copies");
    expect_hover(client, "part.xml", PART, "\"|i\" count", "variable 'i' = 0 to 2");
    expect_hover(client, "part.xml", PART, "y=\"wide| -", "center.y = -7 in 3 copies");
}

// Each entry has its own, whatever their names.
static void finds_and_renames_variables(void **state) {
    struct lsp_client *client = *state;
    char ranges[512];
    open_grid(client);
    expect_rename(client, "main.yaml", GRID, "+ |i/10", "5:20-21 5:61-62 5:94-95 5:127-128");
    expect_rename(client, "main.yaml", GRID, "{|i: n", "5:20-21 5:61-62 5:94-95 5:127-128");
    expect_rename(client, "main.yaml", GRID, "|i: 3", "7:6-7 8:13-14 9:13-14");
    expect_rename(client, "main.yaml", GRID, "4 + |j", "8:6-7 9:20-21");
    client_open(client, "part.xml", PART);
    expect_rename(client, "part.xml", PART, "\"|i &lt", "1:56-57 1:24-25 1:35-36 1:83-84");
    expect_refusal(client, "main.yaml", GRID, "|j: 3", "i", "another variable of this entry");
    expect_refusal(client, "main.yaml", GRID, "|j: 3", "wide", "a parameter of this file");
    expect_refusal(client, "main.yaml", GRID, "|j: 3", "sin", "is not a word of expressions");
    expect_refusal(client, "main.yaml", GRID, "|j: 3", "a-b", "letters, digits and '_'");
    expect_refusal(client, "main.yaml", GRID, "{|wide", "j", "a variable of this file");
    expect_refusal(client, "part.xml", PART, "\"|i\" count", "wide", "uses something else with this name");
    // It may hide the name of another file, but no expression may mean another thing then.
    json_decref(rename_at(client, "part.xml", PART, "\"|i\" count", "n", NULL));
    json_t *list =
        client_request(client, "textDocument/references", at_mark(client, "main.yaml", GRID, "4 + |j"), NULL);
    write_ranges(list, ranges, sizeof ranges);
    assert_string_equal(ranges, "9:20-21");
    json_decref(list);
    list = client_request(client, "textDocument/documentHighlight",
                          at_mark(client, "main.yaml", GRID, "4 + |j"), NULL);
    write_ranges(list, ranges, sizeof ranges);
    assert_string_equal(ranges, "9:20-21 8:6-7");
    json_decref(list);
    json_t *place =
        client_request(client, "textDocument/definition", at_mark(client, "main.yaml", GRID, "[|i/4"), NULL);
    assert_int_equal(json_integer_value(json_object_get(
                         json_object_get(json_object_get(place, "range"), "start"), "character")),
                     20);
    json_decref(place);
    json_t *range = client_request(client, "textDocument/prepareRename",
                                   at_mark(client, "main.yaml", GRID, "[|i/4"), NULL);
    assert_int_equal(json_integer_value(json_object_get(json_object_get(range, "end"), "character")), 128);
    json_decref(range);
}

// A parameter's uses are not those of a variable that hides it in another file.
static void renames_parameters_around_variables(void **state) {
    static const char text[] = "glint: 1\ninclude: [hides.yaml]\n" LIGHTS
                               "parameters: {i: 2}\nspheres: [{center: [i, 0, 0], radius: 0.1}]\n";
    static const char hides[] = "glint: 1\nspheres:\n  - {for: {i: 3}, center: [i, 1, 0], radius: 0.1}\n"
                                "  - {for: {k: i}, center: [k, i, 5], radius: 0.1}\n";
    struct lsp_client *client = *state;
    char ranges[512];
    client_file(client, "hides.yaml", hides);
    client_open(client, "main.yaml", text);
    assert_int_equal(json_array_size(client_diagnostics(client, "main.yaml", 1)), 1);
    json_t *edit = rename_at(client, "main.yaml", text, "{|i: 2", "m", NULL);
    const json_t *changes = json_object_get(edit, "changes");
    write_ranges(json_object_get(changes, client_uri(client, "main.yaml")), ranges, sizeof ranges);
    assert_string_equal(ranges, "3:13-14 4:20-21");
    write_ranges(json_object_get(changes, client_uri(client, "hides.yaml")), ranges, sizeof ranges);
    assert_string_equal(ranges, "3:14-15 3:30-31");
    json_decref(edit);
    expect_refusal(client, "main.yaml", text, "{|i: 2", "k", "a variable of an entry that uses it");
    client_open(client, "hides.yaml", hides);
    expect_rename(client, "hides.yaml", hides, "{|i: 3", "2:11-12 2:27-28");
    expect_refusal(client, "hides.yaml", hides, "{|k: i", "i", "uses something else with this name");
}

static void counts_units_in_names_of_any_script(void **state) {
    static const char text[] = "glint: 1\n" LIGHTS "spheres: # \xf0\x9f\x98\x80\n"
                               "  - {name: \xd1\x88\xd0\xb0\xd1\x80, for: {gr\xc3\xb6\xc3\x9f"
                               "e: 3}, center: "
                               "[gr\xc3\xb6\xc3\x9f"
                               "e, 0, 0], radius: 0.1}\n";
    struct lsp_client *client = *state;
    client_open(client, "main.yaml", text);
    assert_int_equal(json_array_size(client_diagnostics(client, "main.yaml", 1)), 1);
    expect_rename(client, "main.yaml", text, "[|gr", "3:22-27 3:42-47");
    expect_hover(client, "main.yaml", text, "[|gr", "which makes 3 copies");
}

// One text for two entries, through anchors.
static void follows_anchors(void **state) {
    static const char same[] = "glint: 1\n" LIGHTS "spheres:\n"
                               "  - {for: &f {i: 3}, center: [i, 0, 0], radius: &r 0.1 + i/10}\n"
                               "  - {for: *f, center: [0, i, 9], radius: *r}\n";
    static const char other[] = "glint: 1\n" LIGHTS "spheres:\n"
                                "  - {for: {i: 3}, center: [i, 0, 0], radius: &r 0.1 + i/10}\n"
                                "  - {for: {i: 4}, center: [0, i, 9], radius: *r}\n";
    struct lsp_client *client = *state;
    client_open(client, "same.glint.yaml", same);
    client_open(client, "other.glint.yaml", other);
    assert_int_equal(json_array_size(client_diagnostics(client, "same.glint.yaml", 1)), 1);
    expect_rename(client, "same.glint.yaml", same, "0, |i, 9", "3:14-15 3:30-31 3:57-58 4:26-27");
    expect_refusal(client, "other.glint.yaml", other, "0, |i, 9", "k", "through an anchor");
}

// An entry without copies is there all the same, and one with many is there once.
static void knows_entries_as_they_are_written(void **state) {
    static const char text[] =
        "glint: 1\n" LIGHTS "materials: {red: {}}\nspheres:\n"
        "  - {for: {i: 0}, center: [i, 0, 0], radius: 0.1, material: red}\n"
        "  - {for: {k: 3}, center: [k, 0, 0], radius: 0.1, material: {diffuse_color: \"#ff0000\"}}\n";
    struct lsp_client *client = *state;
    client_open(client, "main.yaml", text);
    client_diagnostics(client, "main.yaml", 1);
    expect_rename(client, "main.yaml", text, "{|red", "2:12-15 4:60-63");
    expect_hover(client, "main.yaml", text, "|i: 0", "which makes 0 copies");
    expect_hover(client, "main.yaml", text, "ra|dius: 0.1, material: red", "sphere.radius");
    json_t *params = json_pack("{s:{s:s}}", "textDocument", "uri", client_uri(client, "main.yaml"));
    json_t *colors = client_request(client, "textDocument/documentColor", json_incref(params), NULL);
    assert_int_equal(json_array_size(colors), 1);
    json_decref(colors);
    json_t *symbols = client_request(client, "textDocument/documentSymbol", params, NULL);
    assert_int_equal(json_array_size(symbols), 4);
    const json_t *children = json_object_get(json_array_get(symbols, 3), "children");
    assert_string_equal(client_text(json_array_get(children, 0), "name"), "k");
    assert_string_equal(client_text(json_array_get(children, 0), "detail"), "For");
    json_decref(symbols);
}

static void mends_names(void **state) {
    static const char text[] =
        "glint: 1\n" LIGHTS "spheres: [{for: {column: 3}, center: [column, 2*colum, 0], radius: 0.1}]\n";
    struct lsp_client *client = *state;
    client_open(client, "main.yaml", text);
    assert_int_equal(count_code(client_diagnostics(client, "main.yaml", 1), "E228"), 1);
    json_t *params = at_mark(client, "main.yaml", text, "2*|colum,");
    json_t *position = json_incref(json_object_get(params, "position"));
    json_object_set_new(params, "range", json_pack("{s:O, s:o}", "start", position, "end", position));
    json_object_set_new(params, "context", json_pack("{s:[]}", "diagnostics"));
    json_t *actions = client_request(client, "textDocument/codeAction", params, NULL);
    assert_string_equal(client_text(json_array_get(actions, 0), "title"), "Replace with 'column'");
    json_decref(actions);
}

int main(int argc, char **argv) {
    program = argc > 1 ? argv[1] : "glint";
#define TEST(name) cmocka_unit_test_setup_teardown(name, start, stop)
    const struct CMUnitTest tests[] = {
        TEST(explains_variables),
        TEST(finds_and_renames_variables),
        TEST(renames_parameters_around_variables),
        TEST(counts_units_in_names_of_any_script),
        TEST(follows_anchors),
        TEST(knows_entries_as_they_are_written),
        TEST(mends_names),
    };
#undef TEST
    return cmocka_run_group_tests(tests, NULL, NULL);
}
