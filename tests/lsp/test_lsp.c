// The language server, driven over its pipes as an editor drives it. Usage: test_lsp GLINT
#include "lsp_kit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *program;

static const char MATERIALS[] = "<?xml version=\"1.0\"?>\n"
                                "<Scene glint=\"1\">\n"
                                "  <Material name=\"glass\" refractive_index=\"1.5\"/>\n"
                                "</Scene>\n";
static const char MAIN[] = "glint: 1\n"
                           "include: [materials.xml]\n"
                           "models:\n"
                           "  - {mesh: tri.obj, material: glass}\n"
                           "spheres:\n"
                           "  - {center: [0, 0, 0], radius: 1, material: glass}\n";
static const char MESH[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";

static int start(void **state) {
    struct lsp_client *client = calloc(1, sizeof *client);
    client_start(client, program);
    client_file(client, "materials.xml", MATERIALS);
    client_file(client, "tri.obj", MESH);
    *state = client;
    return 0;
}

static int stop(void **state) {
    int status = client_stop(*state);
    free(*state);
    return status;
}

static void expect_range(const json_t *range, int line, int begin, int end) {
    const json_t *from = json_object_get(range, "start");
    const json_t *to = json_object_get(range, "end");
    assert_int_equal(json_integer_value(json_object_get(from, "line")), line);
    assert_int_equal(json_integer_value(json_object_get(from, "character")), begin);
    assert_int_equal(json_integer_value(json_object_get(to, "character")), end);
}

// The diagnostic of a code in a list, or NULL.
static json_t *find_code(json_t *list, const char *code) {
    size_t index;
    json_t *item;
    json_array_foreach(list, index, item) {
        if (strcmp(client_text(item, "code"), code) == 0)
            return item;
    }
    return NULL;
}

static json_t *with_code(json_t *list, const char *code) {
    json_t *item = find_code(list, code);
    if (!item) {
        char *text = json_dumps(list, JSON_INDENT(1));
        print_message("no %s in %s\n", code, text);
        free(text);
        fail();
    }
    return item;
}

static size_t errors(json_t *list) {
    size_t index;
    size_t count = 0;
    json_t *item;
    json_array_foreach(list, index, item) count += json_integer_value(json_object_get(item, "severity")) == 1;
    return count;
}

static void change(struct lsp_client *client, const char *name, int version, const char *text) {
    client_notify(client, "textDocument/didChange",
                  json_pack("{s:{s:s, s:i}, s:[{s:s}]}", "textDocument", "uri", client_uri(client, name),
                            "version", version, "contentChanges", "text", text));
}

// ---- tests

static void tells_mistakes_while_one_types(void **state) {
    struct lsp_client *client = *state;
    client_initialize(client, NULL);
    client_open(client, "main.yaml", MAIN);
    assert_int_equal(errors(client_diagnostics(client, "main.yaml", 1)), 0);
    change(
        client, "main.yaml", 2,
        "glint: 1\ninclude: [materials.xml]\nspheres:\n  - {center: [0, 0, 0], radius: 1, material: glas}\n");
    json_t *list = client_diagnostics(client, "main.yaml", 2);
    json_t *unknown = with_code(list, "E301");
    expect_range(json_object_get(unknown, "range"), 3, 45, 49);
    assert_string_equal(client_text(unknown, "source"), "glint");
    assert_non_null(strstr(client_text(unknown, "message"), "did you mean 'glass'?"));
    change(client, "main.yaml", 3, MAIN);
    assert_int_equal(errors(client_diagnostics(client, "main.yaml", 3)), 0);
}

static void takes_edits_in_the_middle_of_characters(void **state) {
    struct lsp_client *client = *state;
    client_initialize(client, NULL);
    // A character outside the basic plane is two units of UTF-16.
    client_open(client, "main.yaml",
                "glint: 1\ndescription: \"\xF0\x9F\x94\xB7 caf\xC3\xA9\"   # x\nspheres: []\n");
    client_diagnostics(client, "main.yaml", 1);
    // Replaces "café" and its quote by `b", nonsense: 1`.
    client_notify(client, "textDocument/didChange",
                  json_pack("{s:{s:s, s:i}, s:[{s:{s:{s:i,s:i}, s:{s:i,s:i}}, s:s}]}", "textDocument", "uri",
                            client_uri(client, "main.yaml"), "version", 2, "contentChanges", "range", "start",
                            "line", 1, "character", 17, "end", "line", 1, "character", 22, "text",
                            "b\"\nnonsense: 1"));
    json_t *unknown = with_code(client_diagnostics(client, "main.yaml", 2), "E202");
    expect_range(json_object_get(unknown, "range"), 2, 0, 8);
}

static const char WIDE[] = "glint: 1\nspheres: [{center: [0, 0, 0], name: \"\xF0\x9F\x94\xB7\", qqq: 2}]\n";

static void expect_column(struct lsp_client *client, int column) {
    client_open(client, "main.yaml", WIDE);
    json_t *unknown = with_code(client_diagnostics(client, "main.yaml", 1), "E202");
    expect_range(json_object_get(unknown, "range"), 1, column, column + 3);
}

static void counts_columns_as_agreed(void **state) {
    static const struct {
        const char *encoding;
        int column;
    } rows[] = {{"utf-16", 42}, {"utf-8", 44}, {"utf-32", 41}};
    struct lsp_client *client = *state;
    client_initialize(client, NULL); // nothing agreed: UTF-16
    expect_column(client, 42);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct lsp_client other;
        client_start(&other, program);
        client_initialize(&other, json_pack("{s:{s:[s]}}", "general", "positionEncodings", rows[i].encoding));
        expect_column(&other, rows[i].column);
        assert_int_equal(client_stop(&other), 0);
    }
}

static void finds_definitions_over_includes(void **state) {
    struct lsp_client *client = *state;
    client_initialize(client, NULL);
    client_open(client, "main.yaml", MAIN);
    json_t *location =
        client_request(client, "textDocument/definition", client_at(client, "main.yaml", 5, 46), NULL);
    assert_string_equal(client_text(location, "uri"), client_uri(client, "materials.xml"));
    expect_range(json_object_get(location, "range"), 2, 18, 23);
    json_decref(location);
    location = client_request(client, "textDocument/definition", client_at(client, "main.yaml", 1, 12), NULL);
    assert_string_equal(client_text(location, "uri"), client_uri(client, "materials.xml"));
    json_decref(location);
    location = client_request(client, "textDocument/definition", client_at(client, "main.yaml", 3, 12), NULL);
    assert_string_equal(client_text(location, "uri"), client_uri(client, "tri.obj"));
    json_decref(location);
    location = client_request(client, "textDocument/definition", client_at(client, "main.yaml", 0, 2), NULL);
    assert_true(json_is_null(location));
    json_decref(location);
}

// Asks to rename what stands at `place` (client_at), which it takes.
static json_t *rename_to(struct lsp_client *client, json_t *place, const char *name, json_t **error) {
    json_object_set_new(place, "newName", json_string(name));
    return client_request(client, "textDocument/rename", place, error);
}

static void finds_uses_and_renames(void **state) {
    struct lsp_client *client = *state;
    client_initialize(client, NULL);
    client_open(client, "main.yaml", MAIN);
    json_t *params = client_at(client, "main.yaml", 3, 30);
    json_object_set_new(params, "context", json_pack("{s:b}", "includeDeclaration", 1));
    json_t *list = client_request(client, "textDocument/references", params, NULL);
    assert_int_equal(json_array_size(list), 3);
    json_decref(list);
    json_t *edit = rename_to(client, client_at(client, "main.yaml", 3, 30), "window", NULL);
    const json_t *changes = json_object_get(edit, "changes");
    assert_int_equal(json_array_size(json_object_get(changes, client_uri(client, "main.yaml"))), 2);
    json_t *there = json_object_get(changes, client_uri(client, "materials.xml"));
    assert_int_equal(json_array_size(there), 1);
    expect_range(json_object_get(json_array_get(there, 0), "range"), 2, 18, 23);
    json_decref(edit);
    json_t *error = NULL;
    json_decref(rename_to(client, client_at(client, "main.yaml", 3, 30), "no name", &error));
    assert_int_equal(json_integer_value(json_object_get(error, "code")), -32803);
    json_decref(error);
}

// An alias spells no name; the value behind its anchor does.
static void renames_behind_anchors_and_to_free_names(void **state) {
    struct lsp_client *client = *state;
    client_initialize(client, NULL);
    client_open(client, "main.yaml",
                "glint: 1\nmaterials: {glass: {}, brass: {}}\nspheres:\n"
                "  - {center: [0, 0, 0], radius: 1, material: &m glass}\n"
                "  - {center: [3, 0, 0], radius: 1, material: *m}\n");
    json_t *edit = rename_to(client, client_at(client, "main.yaml", 1, 14), "window", NULL);
    const json_t *edits = json_object_get(json_object_get(edit, "changes"), client_uri(client, "main.yaml"));
    assert_int_equal(json_array_size(edits), 2);
    expect_range(json_object_get(json_array_get(edits, 0), "range"), 1, 12, 17);
    expect_range(json_object_get(json_array_get(edits, 1), "range"), 3, 48, 53);
    json_decref(edit);
    json_t *error = NULL;
    json_decref(rename_to(client, client_at(client, "main.yaml", 1, 14), "brass", &error));
    assert_int_equal(json_integer_value(json_object_get(error, "code")), -32803);
    json_decref(error);
}

static void offers_fixes(void **state) {
    struct lsp_client *client = *state;
    client_initialize(client, NULL);
    client_open(client, "main.yaml", "glint: 1\nspheres:\n  - {centre: [0, 0, 0], radius: 1}\n");
    client_diagnostics(client, "main.yaml", 1);
    json_t *params = client_at(client, "main.yaml", 2, 6);
    json_t *position = json_incref(json_object_get(params, "position"));
    json_object_set_new(params, "range", json_pack("{s:O, s:o}", "start", position, "end", position));
    json_object_set_new(params, "context", json_pack("{s:[]}", "diagnostics"));
    json_t *actions = client_request(client, "textDocument/codeAction", params, NULL);
    json_t *action = json_array_get(actions, 0);
    assert_string_equal(client_text(action, "kind"), "quickfix");
    const json_t *edits = json_object_get(json_object_get(json_object_get(action, "edit"), "changes"),
                                          client_uri(client, "main.yaml"));
    assert_string_equal(client_text(json_array_get(edits, 0), "newText"), "center");
    expect_range(json_object_get(json_array_get(edits, 0), "range"), 2, 5, 11);
    json_decref(actions);
}

static bool offers(const json_t *list, const char *label) {
    size_t index;
    json_t *item;
    json_array_foreach(json_object_get(list, "items"), index, item) {
        if (strcmp(client_text(item, "label"), label) == 0)
            return true;
    }
    return false;
}

static void completes_names_words_and_files(void **state) {
    struct lsp_client *client = *state;
    client_initialize(client, NULL);
    client_open(client, "main.yaml", MAIN);
    client_diagnostics(client, "main.yaml", 1);
    // The text is broken at the place where one types: what was known before counts.
    change(client, "main.yaml", 2,
           "glint: 1\ninclude: [materials.xml]\nimage: {tone: \nmodels:\n  - {mesh: tr\n    material: \n");
    json_t *list =
        client_request(client, "textDocument/completion", client_at(client, "main.yaml", 2, 14), NULL);
    assert_true(offers(list, "clip") && offers(list, "normalize"));
    json_decref(list);
    list = client_request(client, "textDocument/completion", client_at(client, "main.yaml", 4, 13), NULL);
    assert_true(offers(list, "tri.obj"));
    assert_false(offers(list, "materials.xml"));
    json_decref(list);
    change(client, "main.yaml", 3,
           "glint: 1\ninclude: [materials.xml]\nspheres:\n  - {radius: 1, material: gl}\n");
    list = client_request(client, "textDocument/completion", client_at(client, "main.yaml", 3, 28), NULL);
    assert_true(offers(list, "glass"));
    json_decref(list);
}

// A parameter is used in expressions of all files of the scene, in either spelling.
static void knows_parameters(void **state) {
    struct lsp_client *client = *state;
    client_file(
        client, "part.xml",
        "<Scene glint=\"1\">\n"
        "  <Sphere radius=\"height\"><Center x=\"0\" y=\"1\" z=\"2*height - top\"/></Sphere>\n</Scene>\n");
    client_initialize(client, NULL);
    client_open(
        client, "main.yaml",
        "glint: 1\ninclude: [part.xml]\nparameters:\n  height: 3\n  top: {value: height + 1, max: 9}\n"
        "spheres:\n  - {center: [0, max(height, 2), 0], radius: top/4}\n");
    assert_int_equal(errors(client_diagnostics(client, "main.yaml", 1)), 0);
    json_t *place =
        client_request(client, "textDocument/definition", client_at(client, "main.yaml", 6, 46), NULL);
    expect_range(json_object_get(place, "range"), 4, 2, 5);
    json_decref(place);
    json_t *hover = client_request(client, "textDocument/hover", client_at(client, "main.yaml", 6, 22), NULL);
    assert_non_null(strstr(client_text(json_object_get(hover, "contents"), "value"), "'height' = 3,"));
    json_decref(hover);
    json_t *edit = rename_to(client, client_at(client, "main.yaml", 4, 17), "h", NULL);
    const json_t *changes = json_object_get(edit, "changes");
    assert_int_equal(json_array_size(json_object_get(changes, client_uri(client, "main.yaml"))), 3);
    json_t *there = json_object_get(changes, client_uri(client, "part.xml"));
    assert_int_equal(json_array_size(there), 2);
    expect_range(json_object_get(json_array_get(there, 0), "range"), 1, 18, 24);
    expect_range(json_object_get(json_array_get(there, 1), "range"), 1, 51, 57);
    json_decref(edit);
    static const char *const taken[] = {"top", "sin", "a-b", "yes"};
    for (size_t i = 0; i < sizeof taken / sizeof *taken; i++) {
        json_t *error = NULL;
        json_decref(rename_to(client, client_at(client, "main.yaml", 3, 4), taken[i], &error));
        assert_int_equal(json_integer_value(json_object_get(error, "code")), -32803);
        json_decref(error);
    }
}

static void explains_outlines_and_links(void **state) {
    struct lsp_client *client = *state;
    client_initialize(client, NULL);
    client_open(client, "main.yaml", MAIN);
    json_t *hover = client_request(client, "textDocument/hover", client_at(client, "main.yaml", 5, 25), NULL);
    assert_non_null(strstr(client_text(json_object_get(hover, "contents"), "value"), "radius"));
    json_decref(hover);
    hover = client_request(client, "textDocument/hover", client_at(client, "main.yaml", 5, 46), NULL);
    assert_non_null(
        strstr(client_text(json_object_get(hover, "contents"), "value"), "refractive_index=\"1.5\""));
    json_decref(hover);
    json_t *params = json_pack("{s:{s:s}}", "textDocument", "uri", client_uri(client, "main.yaml"));
    json_t *symbols = client_request(client, "textDocument/documentSymbol", json_incref(params), NULL);
    assert_int_equal(json_array_size(symbols), 2);
    json_decref(symbols);
    json_t *links = client_request(client, "textDocument/documentLink", params, NULL);
    assert_int_equal(json_array_size(links), 2);
    json_decref(links);
}

static void checks_a_part_as_part_of_its_scene(void **state) {
    struct lsp_client *client = *state;
    client_file(client, "main.yaml", "glint: 1\ninclude: [materials.xml, part.yaml]\n");
    client_initialize(client, NULL);
    client_open(client, "part.yaml",
                "glint: 1\nspheres: [{center: [0, 0, 0], radius: 1, material: glass}]\n");
    assert_int_equal(errors(client_diagnostics(client, "part.yaml", 1)), 0);
    change(client, "part.yaml", 2, "glint: 1\nspheres: [{center: [0, 0, 0], radius: 1, material: glasss}]\n");
    with_code(client_diagnostics(client, "part.yaml", 2), "E301");
}

static void formats(void **state) {
    struct lsp_client *client = *state;
    client_initialize(client, NULL);
    client_open(client, "main.yaml",
                "glint:   1\nspheres:\n      - {center: [0,0,0],   radius: 1}   # kept\n");
    json_t *params = json_pack("{s:{s:s}, s:{s:i, s:b}}", "textDocument", "uri",
                               client_uri(client, "main.yaml"), "options", "tabSize", 2, "insertSpaces", 1);
    json_t *edits = client_request(client, "textDocument/formatting", params, NULL);
    assert_int_equal(json_array_size(edits), 1);
    const char *text = client_text(json_array_get(edits, 0), "newText");
    assert_non_null(strstr(text, "glint: 1\n"));
    assert_non_null(strstr(text, "# kept\n"));
    json_decref(edits);
}

static void renames_what_is_spelled_with_entities(void **state) {
    struct lsp_client *client = *state;
    client_initialize(client, NULL);
    client_open(
        client, "x.xml",
        "<Scene glint=\"1\">\n<Material name=\"gl&#97;ss\"/>\n"
        "<Sphere radius=\"1\" material='g&#108;ass'><Center x=\"0\" y=\"0\" z=\"0\"/></Sphere>\n</Scene>\n");
    json_t *edit = rename_to(client, client_at(client, "x.xml", 2, 33), "window", NULL);
    const json_t *edits = json_object_get(json_object_get(edit, "changes"), client_uri(client, "x.xml"));
    assert_int_equal(json_array_size(edits), 2);
    expect_range(json_object_get(json_array_get(edits, 0), "range"), 1, 16, 25);
    expect_range(json_object_get(json_array_get(edits, 1), "range"), 2, 29, 39);
    json_decref(edit);
}

// An answer to any request says that everything before it was worked through.
static void settle(struct lsp_client *client) {
    json_decref(client_request(client, "textDocument/hover", client_at(client, "main.yaml", 0, 0), NULL));
}

static void follows_includes_that_come_and_go(void **state) {
    static const char WITH[] = "glint: 1\ninclude: [materials.xml, part.yaml]\n";
    struct lsp_client *client = *state;
    client_initialize(client, NULL);
    client_open(client, "main.yaml", WITH);
    client_open(client, "part.yaml",
                "glint: 1\nspheres: [{center: [0, 0, 0], radius: 1, material: glass}]\n");
    assert_int_equal(errors(client_diagnostics(client, "part.yaml", 1)), 0);
    change(client, "main.yaml", 2, "glint: 1\n");
    client_diagnostics(client, "main.yaml", 2);
    settle(client);
    with_code(json_object_get(client->diagnostics, client_uri(client, "part.yaml")), "E301");
    change(client, "main.yaml", 3, WITH);
    client_diagnostics(client, "main.yaml", 3);
    settle(client);
    assert_int_equal(errors(json_object_get(client->diagnostics, client_uri(client, "part.yaml"))), 0);
}

static void leaves_other_files_alone(void **state) {
    struct lsp_client *client = *state;
    client_initialize(client, NULL);
    client_open(client, "compose.yaml", "services:\n  a: [}\n");
    settle(client);
    assert_null(json_object_get(client->diagnostics, client_uri(client, "compose.yaml")));
    client_open(client, "new.glint.yaml", "services: 1\n");
    assert_true(errors(client_diagnostics(client, "new.glint.yaml", 1)) > 0);
    change(client, "compose.yaml", 2, "glint: 1\nservices: 1\n");
    with_code(client_diagnostics(client, "compose.yaml", 2), "E202");
    change(client, "compose.yaml", 3, "services: 1\n"); // it was a scene a moment ago
    assert_true(errors(client_diagnostics(client, "compose.yaml", 3)) > 0);
}

static void honours_settings_and_checks_them(void **state) {
    static const char SCENE[] =
        "glint: 1\nmaterials: {stone: {}}\nspheres: [{center: [0, 0, -4], radius: 1}]\n";
    struct lsp_client *client = *state;
    client_file(client, ".glintrc.yaml", "severity: {W408: error}\n");
    client_initialize(client, NULL);
    client_open(client, "main.yaml", SCENE);
    json_t *unused = with_code(client_diagnostics(client, "main.yaml", 1), "W408");
    assert_int_equal(json_integer_value(json_object_get(unused, "severity")), 1);
    // The text in the editor counts, and what is wrong in it is told there.
    client_open(client, ".glintrc.yaml", "severity: {W408: off}\nlimitss: {}\n");
    with_code(client_diagnostics(client, ".glintrc.yaml", 1), "E805");
    change(client, ".glintrc.yaml", 2, "ignore: [W408, N401, N402]\n");
    assert_int_equal(json_array_size(client_diagnostics(client, ".glintrc.yaml", 2)), 0);
    settle(client);
    assert_int_equal(json_array_size(json_object_get(client->diagnostics, client_uri(client, "main.yaml"))),
                     0);
}

static void remembers_names_while_the_text_is_broken(void **state) {
    struct lsp_client *client = *state;
    client_initialize(client, NULL);
    client_open(client, "main.yaml", "glint: 1\nspheres: []\nmaterials:\n  stone: {}\n");
    client_diagnostics(client, "main.yaml", 1);
    change(client, "main.yaml", 2, "glint: 1\nspheres:\n  - {material: s\n  - [\nmaterials:\n  stone: {}\n");
    json_t *list =
        client_request(client, "textDocument/completion", client_at(client, "main.yaml", 2, 16), NULL);
    assert_true(offers(list, "stone"));
    json_decref(list);
}

enum {
    MANY = 4000,
};

// A strip of triangles whose check takes a while, and a material that nothing uses.
static void tells_costly_findings_when_no_one_types(void **state) {
    struct lsp_client *client = *state;
    char *text = calloc(MANY, 64);
    size_t length = 0;
    assert_non_null(text);
    for (int i = 0; i < MANY; i++)
        length += (size_t)snprintf(text + length, 64, "v %d 0 0\nv %d 1 0\nv %d 0 1\nf -1 -2 -3\n", i, i, i);
    client_file(client, "strip.obj", text);
    free(text);
    client_initialize(client, NULL);
    client_open(client, "main.yaml", "glint: 1\nmaterials: {a: {}}\nmodels: [{mesh: strip.obj}]\n");
    with_code(client_diagnostics(client, "main.yaml", 1), "W408");
    for (int version = 2; version < 6; version++)
        change(client, "main.yaml", version, "glint: 1\nmaterials: {b: {}}\nmodels: [{mesh: strip.obj}]\n");
    json_t *list = client_diagnostics(client, "main.yaml", 5);
    // The list may come without them first.
    while (!find_code(list, "W408")) {
        json_t *message = client_receive(client);
        assert_non_null(message);
        json_decref(message);
        list = json_object_get(client->diagnostics, client_uri(client, "main.yaml"));
    }
}

// What is quadratic takes minutes here.
#define SKY      "glint: 1\nbackground: {image: sky.hdr}\n"
#define HDR_HEAD "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 5\n\x80\x40\x20\x81\1\1\1"

// What an image's pixels hide is looked for once nobody types, and from then on known with every key, until
// the file changes.
static void decodes_images_when_no_one_types(void **state) {
    struct lsp_client *client = *state;
    client_file(client, "sky.hdr", HDR_HEAD "\5");
    client_initialize(client, NULL);
    client_open(client, "main.yaml", SKY);
    while (!find_code(json_object_get(client->diagnostics, client_uri(client, "sky.hdr")), "E620")) {
        json_t *message = client_receive(client);
        assert_non_null(message);
        json_decref(message);
    }
    change(client, "main.yaml", 2, SKY "description: more\n");
    client_diagnostics(client, "main.yaml", 2);
    // Whatever belongs to that version comes before this answer.
    json_decref(client_request(client, "textDocument/hover", client_at(client, "main.yaml", 1, 1), NULL));
    with_code(json_object_get(client->diagnostics, client_uri(client, "sky.hdr")), "E620");
    client_file(client, "sky.hdr", HDR_HEAD "\4 ");
    change(client, "main.yaml", 3, SKY);
    client_diagnostics(client, "main.yaml", 3);
    json_decref(client_request(client, "textDocument/hover", client_at(client, "main.yaml", 1, 1), NULL));
    assert_int_equal(errors(json_object_get(client->diagnostics, client_uri(client, "sky.hdr"))), 0);
}

static void answers_large_documents(void **state) {
    struct lsp_client *client = *state;
    size_t size = (size_t)MANY * 64 + 64;
    char *text = malloc(size);
    assert_non_null(text);
    size_t length = (size_t)snprintf(text, size, "glint: 1\nspheres: [");
    for (int i = 0; i < MANY; i++)
        length += (size_t)snprintf(text + length, size - length, "{center: [%d, 0, 0], radius: 1}, ", 3 * i);
    snprintf(text + length, size - length, "]\n");
    client_initialize(client, NULL);
    client_open(client, "main.yaml", text);
    free(text);
    json_t *params = json_pack("{s:{s:s}}", "textDocument", "uri", client_uri(client, "main.yaml"));
    json_t *symbols = client_request(client, "textDocument/documentSymbol", params, NULL);
    assert_int_equal(json_array_size(symbols), MANY);
    json_decref(symbols);
}

static void refuses_what_it_does_not_know(void **state) {
    struct lsp_client *client = *state;
    json_t *error = NULL;
    json_decref(client_request(client, "textDocument/hover", json_object(), &error));
    assert_int_equal(json_integer_value(json_object_get(error, "code")), -32002);
    json_decref(error);
    client_initialize(client, NULL);
    json_decref(client_request(client, "workspace/nothing", json_object(), &error));
    assert_int_equal(json_integer_value(json_object_get(error, "code")), -32601);
    json_decref(error);
    static const char broken[] = "Content-Length: 5\r\n\r\n{\"a\":";
    client_send_bytes(client, broken, sizeof broken - 1);
    json_t *answer = client_receive(client);
    assert_int_equal(json_integer_value(json_object_get(json_object_get(answer, "error"), "code")), -32700);
    json_decref(answer);
    // Malformed parameters of every method: an answer or silence, and the server lives on.
    static const char *const methods[] = {
        "textDocument/codeAction",       "textDocument/definition",    "textDocument/references",
        "textDocument/prepareRename",    "textDocument/rename",        "textDocument/hover",
        "textDocument/documentSymbol",   "textDocument/documentLink",  "textDocument/completion",
        "textDocument/formatting",       "textDocument/documentColor", "textDocument/colorPresentation",
        "textDocument/documentHighlight"};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        json_decref(client_request(client, methods[i], NULL, NULL));
        json_decref(client_request(client, methods[i],
                                   json_pack("{s:i, s:s}", "textDocument", 3, "position", "x"), NULL));
    }
    client_notify(client, "textDocument/didOpen", json_pack("{s:{s:s}}", "textDocument", "uri", "nonsense:"));
    client_notify(client, "textDocument/didChange", json_array());
    client_open(client, "main.yaml", MAIN);
    assert_int_equal(errors(client_diagnostics(client, "main.yaml", 1)), 0);
}

int main(int argc, char **argv) {
    if (argc != 2)
        return 2;
    program = argv[1];
#define TEST(name) cmocka_unit_test_setup_teardown(name, start, stop)
    const struct CMUnitTest tests[] = {
        TEST(tells_mistakes_while_one_types),
        TEST(takes_edits_in_the_middle_of_characters),
        TEST(counts_columns_as_agreed),
        TEST(finds_definitions_over_includes),
        TEST(finds_uses_and_renames),
        TEST(renames_behind_anchors_and_to_free_names),
        TEST(offers_fixes),
        TEST(completes_names_words_and_files),
        TEST(knows_parameters),
        TEST(explains_outlines_and_links),
        TEST(checks_a_part_as_part_of_its_scene),
        TEST(formats),
        TEST(renames_what_is_spelled_with_entities),
        TEST(follows_includes_that_come_and_go),
        TEST(leaves_other_files_alone),
        TEST(honours_settings_and_checks_them),
        TEST(remembers_names_while_the_text_is_broken),
        TEST(tells_costly_findings_when_no_one_types),
        TEST(decodes_images_when_no_one_types),
        TEST(answers_large_documents),
        TEST(refuses_what_it_does_not_know),
    };
#undef TEST
    return cmocka_run_group_tests(tests, NULL, NULL);
}
