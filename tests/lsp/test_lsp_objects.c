// What the language server knows of objects and their instances. Usage: test_lsp_objects GLINT
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

static const char *program;

static int start(void **state) {
    struct lsp_client *client = calloc(1, sizeof *client);
    client_start(client, program);
    client_initialize(client, json_pack("{s:{s:{s:{s:b}}}}", "textDocument", "completion", "completionItem",
                                        "snippetSupport", 1));
    *state = client;
    return 0;
}

static int stop(void **state) {
    int status = client_stop(*state);
    free(*state);
    return status;
}

static const char HALL[] =
    "glint: 1\n"
    "parameters: {columns: 4, pitch: 1.5, wide: 2}\n"
    "lights: [{position: [9, 9, 9]}]\n"
    "objects:\n"
    "  column:\n"
    "    parameters: {h: 3, top: h + 0.5, paint: \"#ff0000\", pitch: 1}\n"
    "    boxes:\n"
    "      - {for: {y: [0.25, top]}, center: [0, y, pitch], size: [1, 0.25, 1], material: {diffuse_color: "
    "paint}}\n"
    "    cylinders: [{from: [0, 0.5, 0], to: [0, h + 1, 0], radius: 0.25}]\n"
    "  pair:\n"
    "    parameters: {tall: 5}\n"
    "    instances: [{for: {s: 2}, object: column, with: {h: tall}, translation: [9*s, 0, 40]}]\n"
    "instances:\n"
    "  - {for: {row: 2, i: columns}, if: i != 3, object: column, with: {h: wide + i}, translation: [i*pitch, "
    "0, row]}\n"
    "  - {object: pair, translation: [0, 0, 90]}\n"
    "  - {object: pair, with: {tall: 7}, translation: [0, 0, 120]}\n"
    "  - for: {k: 3}\n"
    "    object:\n"
    "      parameters: {w: k + 1}\n"
    "      spheres: [{for: {n: 2}, center: [w, k, 2*n], radius: 0.25}]\n"
    "    translation: [0, 50, 0]\n";

static const char HALL_XML[] =
    "<Scene glint=\"1\">\n"
    "  <Parameter name=\"wide\" value=\"2\"/>\n"
    "  <Light><Position x=\"9\" y=\"9\" z=\"9\"/></Light>\n"
    "  <Object name=\"column\"><Parameter name=\"h\" value=\"3\"/>\n"
    "    <Cylinder radius=\"0.25\"><From x=\"0\" y=\"0\" z=\"0\"/><To x=\"0\" y=\"h + 1\" "
    "z=\"0\"/></Cylinder></Object>\n"
    "  <Instance object=\"column\"><For name=\"i\" count=\"3\"/><With name=\"h\" value=\"wide + i\"/>\n"
    "    <Translation x=\"4*i\" y=\"0\" z=\"0\"/></Instance>\n"
    "  <Instance><For name=\"k\" count=\"2\"/><Object><Parameter name=\"w\" value=\"k + 1\"/>\n"
    "    <Sphere radius=\"0.25\"><Center x=\"w\" y=\"k - 9\" z=\"0\"/></Sphere></Object></Instance>\n"
    "</Scene>\n";

static void open_hall(struct lsp_client *client) {
    client_open(client, "main.yaml", HALL);
    client_open(client, "main.xml", HALL_XML);
    for (int i = 0; i < 2; i++) {
        json_t *list = client_diagnostics(client, i ? "main.xml" : "main.yaml", 1);
        if (json_array_size(list) != 1) // there is no camera
            fail_msg("%s", json_dumps(list, JSON_INDENT(1)));
    }
}

static void explains_objects(void **state) {
    struct lsp_client *client = *state;
    static const char *const hovers[][3] = {
        {"main.yaml", "  c|olumn:\n",
         "object 'column' of main.yaml:5, with 4 parameters, 1 box, 1 cylinder; 10 instances show it"},
        {"main.yaml", "object: c|olumn, with: {h: wide", "10 instances show it"},
        {"main.yaml",
         "p|air:", "object 'pair' of main.yaml:10, with 1 parameter, 1 instance; 2 instances show it"},
        {"main.yaml", "{|h: 3", "parameter 'h' = 3, of main.yaml:6, 2 to 7 in 10 instances"},
        {"main.yaml", "with: {|h: wide", "parameter 'h' = 3, of main.yaml:6, 2 to 7 in 10 instances"},
        {"main.yaml", "0, |h + 1", "parameter 'h' = 3, of main.yaml:6, 2 to 7 in 10 instances"},
        {"main.yaml", "0, |h + 1", "to.y = 3 to 8 in 10 copies"},
        {"main.yaml", ", |top: h", "parameter 'top' = h + 0.5, of main.yaml:6, 2.5 to 7.5 in 10 instances"},
        {"main.yaml", ": h +| 0.5", "top = 2.5 to 7.5 in 10 instances"},
        {"main.yaml", ", |paint: ", "parameter 'paint' = #ff0000, of main.yaml:6\n"},
        {"main.yaml", "|tall: 5", "parameter 'tall' = 5, of main.yaml:11, 5 to 7 in 2 instances"},
        {"main.yaml", "wide| + i}", "h = 2 to 4 in 6 instances"},
        {"main.yaml", "{h: |tall", "h = 5 to 7 in 4 instances"},
        {"main.yaml", "{|y: [0.25",
         "variable 'y' = one of 2 values: 0.25, top, of main.yaml:8, which makes 20 copies"},
        {"main.yaml", "[0, |y,", "center.y = 0.25 to 7.5 in 20 copies"},
        {"main.yaml", "y, p|itch]", "parameter 'pitch' = 1, of main.yaml:6\n"},
        {"main.yaml", "i*p|itch", "parameter 'pitch' = 1.5, of main.yaml:2"},
        {"main.yaml", "i !|= 3", "makes 6 copies"},
        {"main.yaml", "[|9*s", "translation.x = 0 to 9 in 4 copies"},
        {"main.yaml", "{|w: k", "parameter 'w' = k + 1, of main.yaml:19, 1 to 3 in 3 instances"},
        {"main.yaml", "[w, |k", "variable 'k' = 0 to 2, of main.yaml:17, which makes 3 copies"},
        {"main.yaml", "[w, |k", "center.y = 0 to 2 in 6 copies"},
        {"main.yaml", "2*|n]", "variable 'n' = 0 to 1, of main.yaml:20, which makes 6 copies"},
        {"main.xml", "Instance object=\"c|ol",
         "object 'column' of main.xml:4, with 1 parameter, 1 cylinder; 3 instances"},
        {"main.xml", "With name=\"|h\"", "parameter 'h' = 3, of main.xml:4, 2 to 4 in 3 instances"},
        {"main.xml", "\"wide| + i", "h = 2 to 4 in 3 instances"},
        {"main.xml", "x=\"|w\"", "parameter 'w' = k + 1, of main.xml:8, 1 to 2 in 2 instances"},
        {"main.xml", "y=\"k -| 9", "center.y = -9 to -8 in 2 copies"},
    };
    open_hall(client);
    for (size_t i = 0; i < sizeof hovers / sizeof *hovers; i++)
        expect_hover(client, hovers[i][0], strstr(hovers[i][0], "xml") ? HALL_XML : HALL, hovers[i][1],
                     hovers[i][2]);
}

static void finds_objects(void **state) {
    static const char definition[] = "textDocument/definition", references[] = "textDocument/references",
                      highlights[] = "textDocument/documentHighlight";
    struct lsp_client *client = *state;
    open_hall(client);
    expect_places(client, definition, "main.yaml", HALL, "object: c|olumn, with: {h: wide", "4:2-8");
    expect_places(client, references, "main.yaml", HALL, "  c|olumn:\n", "11:38-44 13:52-58");
    expect_places(client, highlights, "main.yaml", HALL, "  c|olumn:\n", "11:38-44 13:52-58 4:2-8");
    expect_places(client, definition, "main.yaml", HALL, "with: {|h: wide", "5:17-18");
    expect_places(client, definition, "main.yaml", HALL, "0, |h + 1", "5:17-18");
    expect_places(client, references, "main.yaml", HALL, "{|h: 3", "5:28-29 8:44-45 11:53-54 13:67-68");
    expect_places(client, highlights, "main.yaml", HALL, "{|h: wide",
                  "5:28-29 8:44-45 11:53-54 13:67-68 5:17-18");
    expect_places(client, references, "main.yaml", HALL, "for: {|k", "18:22-23 19:42-43");
    expect_places(client, definition, "main.yaml", HALL, "y, p|itch]", "5:55-60");
    expect_places(client, definition, "main.yaml", HALL, "i*p|itch", "1:25-30");
    expect_places(client, definition, "main.yaml", HALL, "{h: |tall", "10:17-21");
    expect_places(client, definition, "main.xml", HALL_XML, "Instance object=\"c|ol", "3:16-22");
    expect_places(client, references, "main.xml", HALL_XML, "Parameter name=\"|h\"", "4:66-67 5:65-66");
    expect_places(client, references, "main.xml", HALL_XML, "For name=\"|k\"", "7:72-73 8:43-44");
}

static void renames_objects(void **state) {
    struct lsp_client *client = *state;
    open_hall(client);
    expect_rename(client, "main.yaml", HALL, "  c|olumn:\n", "4:2-8 11:38-44 13:52-58");
    expect_rename(client, "main.yaml", HALL, "{|h: 3", "5:17-18 5:28-29 8:44-45 11:53-54 13:67-68");
    expect_rename(client, "main.yaml", HALL, "{|h: wide", "5:17-18 5:28-29 8:44-45 11:53-54 13:67-68");
    expect_rename(client, "main.yaml", HALL, "y, p|itch]", "5:55-60 7:47-52");
    expect_rename(client, "main.yaml", HALL, "i*p|itch", "1:25-30 13:97-102");
    expect_rename(client, "main.yaml", HALL, "[w, |k", "16:10-11 18:22-23 19:42-43");
    expect_rename(client, "main.yaml", HALL, "[|w, k", "18:19-20 19:39-40");
    expect_rename(client, "main.xml", HALL_XML, "With name=\"|h\"", "3:41-42 4:66-67 5:65-66");
    expect_rename(client, "main.xml", HALL_XML, "x=\"|w\"", "7:62-63 8:37-38");
    expect_refusal(client, "main.yaml", HALL, "  c|olumn:\n", "pair", "already has this name");
    expect_refusal(client, "main.yaml", HALL, "{|h: 3", "top", "another parameter of this object");
    expect_refusal(client, "main.yaml", HALL, "{|h: 3", "y", "something in reach");
    expect_refusal(client, "main.yaml", HALL, "{|h: 3", "sin", "is not a word of expressions");
    expect_refusal(client, "main.yaml", HALL, "{|y: [0.25", "h", "something around it");
    expect_refusal(client, "main.yaml", HALL, "{|y: [0.25", "columns", "a parameter of this file");
    expect_refusal(client, "main.yaml", HALL, "for: {|k", "w", "something in place in it");
    expect_refusal(client, "main.yaml", HALL, "for: {|k", "n", "something in place in it");
    expect_refusal(client, "main.yaml", HALL, "{|w: k", "k", "something around it");
    expect_refusal(client, "main.yaml", HALL, "{|w: k", "n", "something in reach");
    expect_refusal(client, "main.yaml", HALL, "i*p|itch", "k", "a variable of this file");
    // A parameter of an object may hide one of the scene, and the other way round, where no expression needs
    // both.
    json_decref(rename_at(client, "main.yaml", HALL, "{|h: 3", "columns", NULL));
    json_decref(rename_at(client, "main.yaml", HALL, "i*p|itch", "h", NULL));
}

static const char STAGE[] =
    "glint: 1\n"
    "parameters: {size: 0.5}\n"
    "cameras:\n"
    "  main: {position: [0, 1, 9], aperture: 0.1, focus_on: \"chairs[1]/seat\"}\n"
    "  near: {position: [0, 1, 5], aperture: 0.1, focus_on: \"pawn[2]\"}\n"
    "  far: {position: [0, 1, 50], aperture: 0.1, focus_on: \"instances[0]/leg\"}\n"
    "lights: [{position: [9, 9, 9 + frame]}]\n"
    "materials: {oak: {diffuse_color: [0.5, 0.3, 0.1]}}\n"
    "objects:\n"
    "  chair: {boxes: [{name: seat, center: [0, 1, 0], size: [1, 0.1, 1], material: oak}, {name: leg, "
    "center: [0, "
    "0, 0], size: 0.1}]}\n"
    "instances: [{object: chair}, {name: chairs, for: {n: 2}, object: chair, translation: [2*n, 0, -3]}]\n"
    "spheres: [{name: pawn, for: {i: 3}, center: [i, frame/8, i*frame], radius: size}, {for: {j: 3}, center: "
    "[j, 5 + frame/8, 9], "
    "radius: 0.25}]\n"
    "animation:\n"
    "  frames: 48\n"
    "  frame: 16\n"
    "  tracks:\n"
    "    spheres[pawn].center.x: 0.3 + frame/100\n"
    "    objects.chair.boxes[seat].size.y: 0.1 + frame/100\n"
    "    instances[chairs].translation.y: frame/100\n"
    "    \"materials.oak.diffuse_color\": 0.1, 0.2, frame/100\n"
    "    cameras.near.fov: 40 + frame\n"
    "    parameters.size: 0.4 + frame/1000\n";

static const char STAGE_XML[] =
    "<Scene glint=\"1\">\n"
    "  <Camera aperture=\"0.1\" focus_on=\"ball\"><Position x=\"0\" y=\"0\" z=\"9\"/></Camera>\n"
    "  <Light><Position x=\"9\" y=\"9\" z=\"9\"/></Light>\n"
    "  <Sphere name=\"ball\" radius=\"0.5\"><Center x=\"0\" y=\"frame/4\" z=\"0\"/></Sphere>\n"
    "  <Sphere name=\"block\" radius=\"0.5\"><Center x=\"3\" y=\"0\" z=\"0\"/></Sphere>\n"
    "  <Animation frames=\"8\"><Track target=\"spheres[ball].radius\" value=\"0.5 + frame/9\"/></Animation>\n"
    "</Scene>\n";

// Also where other text has their names: the ways of tracks, and 'focus_on'.
static void follows_names_in_text(void **state) {
    struct lsp_client *client = *state;
    client_open(client, "main.yaml", STAGE);
    client_open(client, "main.xml", STAGE_XML);
    expect_rename(client, "main.yaml", STAGE, "{name: |pawn", "11:17-21 4:56-60 16:12-16");
    expect_rename(client, "main.yaml", STAGE, "spheres[pa|wn]", "11:17-21 4:56-60 16:12-16");
    expect_rename(client, "main.yaml", STAGE, "\"pa|wn[2]", "11:17-21 4:56-60 16:12-16");
    expect_rename(client, "main.yaml", STAGE, "{name: |seat", "9:25-29 3:66-70 17:24-28");
    expect_rename(client, "main.yaml", STAGE, "{name: |leg", "9:92-95 5:69-72");
    expect_rename(client, "main.yaml", STAGE, "{name: |chairs", "10:36-42 3:56-62 18:14-20");
    expect_rename(client, "main.yaml", STAGE, "  c|hair:", "9:2-7 10:21-26 10:65-70 17:12-17");
    expect_rename(client, "main.yaml", STAGE, "{|oak", "7:12-15 9:79-82 19:15-18");
    expect_rename(client, "main.yaml", STAGE, "  n|ear:", "4:2-6 20:12-16");
    expect_rename(client, "main.yaml", STAGE, "{|size", "1:13-17 11:75-79 21:15-19");
    expect_rename(client, "main.xml", STAGE_XML, "focus_on=\"|ball", "3:16-20 1:35-39 5:47-51");
    expect_places(client, "textDocument/definition", "main.yaml", STAGE, "chairs[1]/s|eat", "9:25-29");
    expect_refusal(client, "main.yaml", STAGE, "{name: |seat", "leg", "already has this name");
    expect_refusal(client, "main.yaml", STAGE, "{name: |pawn", "chairs", "already has this name");
    json_decref(rename_at(client, "main.yaml", STAGE, "{name: |pawn", "seat", NULL)); // which is in an object
    expect_hover(client, "main.yaml", STAGE, "9 |+ frame", "position.z = 25 in frame 16");
    expect_hover(client, "main.yaml", STAGE, "5 |+ frame/8", "center.y = 7 in 3 copies, in frame 16");
    expect_hover(client, "main.xml", STAGE_XML, "f|rame/4", "center.y = 0 in frame 0");
}

// What an expression means must stay.
static void refuses_names_that_others_need(void **state) {
    static const char text[] =
        "glint: 1\nparameters: {wide: 2, far: 3}\nlights: [{position: [9, 9, 9]}]\nobjects:\n"
        "  ball: {parameters: {r: 1}, spheres: [{center: [wide, r, 0], radius: r}]}\n"
        "  cube: {parameters: {wide: 4}, boxes: [{center: [far, wide, 0], size: [1, 1, 1]}]}\n"
        "instances: [{object: ball}, {object: cube, translation: [9, 9, 9]}]\n";
    struct lsp_client *client = *state;
    client_open(client, "main.yaml", text);
    assert_int_equal(json_array_size(client_diagnostics(client, "main.yaml", 1)), 1);
    expect_refusal(client, "main.yaml", text, "{|r: 1", "wide",
                   "an expression of this object uses something else");
    expect_refusal(client, "main.yaml", text, "{|wide: 4", "far",
                   "an expression of this object uses something else");
    expect_refusal(client, "main.yaml", text, "{|wide: 2", "r", "a parameter of an object that uses it");
    expect_refusal(client, "main.yaml", text, "|far: 3", "wide", "a parameter of an object that uses it");
    expect_rename(client, "main.yaml", text, "{|wide: 2", "1:13-17 4:49-53");
    expect_rename(client, "main.yaml", text, "{|wide: 4", "5:22-26 5:55-59");
}

// An object of a library, in the other spelling.
static void renames_in_all_files(void **state) {
    static const char text[] =
        "glint: 1\ninclude: [shelf.xml]\nlights: [{position: [9, 9, 9]}]\nparameters: {r: 2}\n"
        "instances: [{object: ball, with: {r: r}}, {object: ball, with: {\"r\": 3}, translation: [99, 9, "
        "9]}]\n";
    static const char shelf[] =
        "<Scene glint=\"1\">\n<Object name=\"ball\"><Parameter name=\"r\" value=\"1\"/>"
        "<Sphere radius=\"r\"><Center x=\"0\" y=\"r\" z=\"0\"/></Sphere></Object></Scene>\n";
    struct lsp_client *client = *state;
    char ranges[256];
    client_file(client, "shelf.xml", shelf);
    client_open(client, "main.yaml", text);
    assert_int_equal(json_array_size(client_diagnostics(client, "main.yaml", 1)), 1);
    static const char *const renames[][3] = {
        {"with: {|r: r", "4:34-35 4:65-66", "1:37-38 1:67-68 1:87-88"},
        {"t: |ball, with: {r", "4:21-25 4:51-55", "1:14-18"},
    };
    for (size_t i = 0; i < sizeof renames / sizeof *renames; i++) {
        json_t *edit = rename_at(client, "main.yaml", text, renames[i][0], "other", NULL);
        const json_t *changes = json_object_get(edit, "changes");
        write_ranges(json_object_get(changes, client_uri(client, "main.yaml")), ranges, sizeof ranges);
        assert_string_equal(ranges, renames[i][1]);
        write_ranges(json_object_get(changes, client_uri(client, "shelf.xml")), ranges, sizeof ranges);
        assert_string_equal(ranges, renames[i][2]);
        json_decref(edit);
    }
    expect_rename(client, "main.yaml", text, "{r: |r}", "3:13-14 4:37-38");
    expect_hover(client, "main.yaml", text, "with: {|r: r",
                 "parameter 'r' = 1, of shelf.xml:2, 2 to 3 in 2 instances");
}

static const json_t *child(const json_t *list, size_t index, const char *name, const char *detail) {
    const json_t *item = json_array_get(list, index);
    assert_string_equal(client_text(item, "name"), name);
    assert_string_equal(client_text(item, "detail"), detail);
    return json_object_get(item, "children");
}

static void outlines_objects(void **state) {
    struct lsp_client *client = *state;
    open_hall(client);
    json_t *params = json_pack("{s:{s:s}}", "textDocument", "uri", client_uri(client, "main.yaml"));
    json_t *symbols = client_request(client, "textDocument/documentSymbol", params, NULL);
    assert_int_equal(json_array_size(symbols), 3 + 1 + 2 + 4);
    const json_t *column = child(symbols, 4, "column", "Object");
    child(column, 0, "h", "Parameter");
    const json_t *box = child(column, 4, "box 1", "Box");
    child(box, 0, "y", "For");
    child(child(symbols, 5, "pair", "Object"), 1, "instance column", "Instance");
    child(symbols, 6, "instance column", "Instance");
    const json_t *group = child(symbols, 9, "instance 4", "Instance");
    child(group, 0, "k", "For");
    const json_t *object = child(group, 1, "object", "Object");
    child(object, 0, "w", "Parameter");
    child(object, 1, "sphere 1", "Sphere");
    json_decref(symbols);
}

// ---- mistakes are no reason to end

static void change(struct lsp_client *client, const char *name, int version, const char *text,
                   size_t length) {
    client_notify(client, "textDocument/didChange",
                  json_pack("{s:{s:s, s:i}, s:[{s:s%}]}", "textDocument", "uri", client_uri(client, name),
                            "version", version, "contentChanges", "text", text, length));
}

// Everything that can be asked about a place.
static void ask_all(struct lsp_client *client, const char *name, const char *text, size_t at) {
    static const char *const methods[] = {"textDocument/hover",         "textDocument/definition",
                                          "textDocument/references",    "textDocument/rename",
                                          "textDocument/completion",    "textDocument/documentHighlight",
                                          "textDocument/documentSymbol"};
    int line = 0, character = 0;
    for (size_t i = 0; i < at; i++) {
        character = text[i] == '\n' ? 0 : character + 1;
        line += text[i] == '\n';
    }
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        json_t *error = NULL, *params = client_at(client, name, line, character);
        json_object_set_new(params, "newName", json_string("k"));
        json_decref(client_request(client, methods[i], params, &error));
        json_decref(error);
    }
}

static void lives_with_mistakes(void **state) {
    static const char *const texts[] = {
        "glint: 1\nobjects: {a: {parameters: {h: h2, h2: h}, instances: [{object: a, with: {h: 1}}]}}\n",
        "glint: 1\nobjects: {a: {parameters: {h: 1}}, a2: {instances: [{object: a, with: {g: 1, h: [1, "
        "2]}}]}}\n"
        "instances: [{object: {instances: [{object: gone, with: {h: 2}}]}, with: {h: 3}}, {with: {h: 1}}, "
        "7]\n",
        "glint: 1\nobjects: {a: {parameters: {h: 1, k: h^2}, spheres: [{for: {h: 2}, radius: h, center: [k, "
        "k, k]}]}}\n"
        "instances: [{for: {i: 3}, object: a, with: {h: 1/i, k: \"#ff00\"}}]\n",
        "glint: 1\nobjects: &a {a: {parameters: &p {h: 1}, spheres: [{radius: h}]}, b: {parameters: *p}}\n"
        "instances: [&i {object: a, with: {h: 2}}, *i, {object: {parameters: *p, instances: [*i]}}]\n",
    };
    struct lsp_client *client = *state;
    int version = 1;
    client_open(client, "main.yaml", "glint: 1\n");
    for (size_t t = 0; t < sizeof texts / sizeof *texts; t++) {
        change(client, "main.yaml", ++version, texts[t], strlen(texts[t]));
        for (size_t at = 0; texts[t][at]; at++)
            ask_all(client, "main.yaml", texts[t], at);
    }
}

static void lives_with_torn_text(void **state) {
    struct lsp_client *client = *state;
    int version = 1;
    open_hall(client);
    for (size_t length = 0; length < sizeof HALL; length += 3) {
        change(client, "main.yaml", ++version, HALL, length);
        ask_all(client, "main.yaml", HALL, length);
    }
    for (size_t length = 0; length < sizeof HALL_XML; length += 3) {
        change(client, "main.xml", ++version, HALL_XML, length);
        ask_all(client, "main.xml", HALL_XML, length);
    }
    for (size_t length = 0; length < sizeof STAGE; length += 3) {
        change(client, "main.yaml", ++version, STAGE, length);
        ask_all(client, "main.yaml", STAGE, length);
    }
}

int main(int argc, char **argv) {
    program = argc > 1 ? argv[1] : "glint";
#define TEST(name) cmocka_unit_test_setup_teardown(name, start, stop)
    const struct CMUnitTest tests[] = {
        TEST(explains_objects),
        TEST(finds_objects),
        TEST(renames_objects),
        TEST(follows_names_in_text),
        TEST(refuses_names_that_others_need),
        TEST(renames_in_all_files),
        TEST(outlines_objects),
        TEST(lives_with_mistakes),
        TEST(lives_with_torn_text),
    };
#undef TEST
    return cmocka_run_group_tests(tests, NULL, NULL);
}
