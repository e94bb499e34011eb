// What the language server offers while one types, shows under the pointer and beside colours. Usage:
// test_lsp_typing GLINT
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

static const char MAIN[] = "glint: 1\n"
                           "materials: {glass: {refractive_index: 1.5}}\n"
                           "spheres:\n"
                           "  - {center: [0, 0, 0], radius: 1, material: glass}\n";

static int start(void **state) {
    struct lsp_client *client = calloc(1, sizeof *client);
    client_start(client, program);
    *state = client;
    return 0;
}

static int stop(void **state) {
    int status = client_stop(*state);
    free(*state);
    return status;
}

static void change(struct lsp_client *client, const char *name, int version, const char *text) {
    client_notify(client, "textDocument/didChange",
                  json_pack("{s:{s:s, s:i}, s:[{s:s}]}", "textDocument", "uri", client_uri(client, name),
                            "version", version, "contentChanges", "text", text));
}

static void initialize_richly(struct lsp_client *client) {
    client_initialize(client, json_pack("{s:{s:{s:{s:b}}, s:{s:[s,s]}}}", "textDocument", "completion",
                                        "completionItem", "snippetSupport", 1, "hover", "contentFormat",
                                        "markdown", "plaintext"));
}

// The text that an item would write; NULL: it is not offered.
static const char *text_offered(const json_t *list, const char *label) {
    size_t index;
    json_t *item;
    json_array_foreach(json_object_get(list, "items"), index, item) {
        if (strcmp(client_text(item, "label"), label) == 0)
            return client_text(json_object_get(item, "textEdit"), "newText");
    }
    return NULL;
}

// `text` with a '|' where one types: what is written for `label` (NULL: nothing), and that `other` is not
// offered.
struct typing {
    const char *name, *text, *label, *wanted, *other;
};

static void expect_typing(struct lsp_client *client, const struct typing *typing, int version) {
    char text[512];
    const char *bar = strchr(typing->text, '|');
    size_t before = (size_t)(bar - typing->text);
    int line = 0, character = 0;
    for (size_t i = 0; i < before; i++) {
        character = typing->text[i] == '\n' ? 0 : character + 1;
        line += typing->text[i] == '\n';
    }
    snprintf(text, sizeof text, "%.*s%s", (int)before, typing->text, bar + 1);
    change(client, typing->name, version, text);
    json_t *list = client_request(client, "textDocument/completion",
                                  client_at(client, typing->name, line, character), NULL);
    const char *written = typing->label ? text_offered(list, typing->label) : NULL;
    if ((typing->label && (!written || strcmp(written, typing->wanted) != 0)) ||
        (typing->other && text_offered(list, typing->other)))
        fail_msg("%s: '%s' writes '%s', not '%s'; or '%s' is offered", typing->text,
                 typing->label ? typing->label : "", written ? written : "nothing", typing->wanted,
                 typing->other ? typing->other : "");
    json_decref(list);
}

static void completes_attributes(void **state) {
    static const struct typing typings[] = {
        {"main.yaml", "glint: 1\nmat|", "materials", "materials:\n  $0", "albedo"},
        {"main.yaml", "glint: 1\nsph|\n", "spheres", "spheres:\n  - $0", "radius"},
        {"main.yaml", "glint: 1\nmaterials:\n  glass:\n    alb|\n", "albedo",
         "albedo: ${1:[0, 0.5, 0.1, 0.8]}", "spheres"},
        {"main.yaml", "glint: 1\nmaterials: {red: {alb|}}", "albedo", "albedo: ${1:[0, 0.5, 0.1, 0.8]}",
         "fov"},
        {"main.yaml", "glint: 1\nmaterials:\n  gl|\n", NULL, NULL, "albedo"},
        {"main.yaml", "glint: 1\nspheres:\n  - {center: [0, 0, 0], ra|}\n", "radius", "radius: ${1:1.5}",
         "spheres"},
        {"main.yaml", "glint: 1\nspheres:\n- center: [0, 0, 0]\n  # here\n  ra|\nlights: []\n", "radius",
         "radius: ${1:1.5}", "lights"},
        {"main.yaml", "glint: 1\nspheres:\n  - center: [0, 0, 0]\n    radius: 1\n  - ma|\n", "material",
         "material: ${1:glass}", "materials"},
        {"main.yaml", "glint: 1\nspheres:\n  - center: [0, |", NULL, NULL, "radius"},
        {"main.yaml", "glint: 1\nspheres:\n  - {center: [0, 0, 0],\n     ra|}\n", "radius",
         "radius: ${1:1.5}", "spheres"},
        {"main.yaml", "glint: 1\nimage: {wi|: 3}\n", "width", "width", "albedo"},
        {"main.yaml", "glint: 1\nmodels:\n  - mesh: a.obj\n    material:\n      re|\n", "refractive_index",
         "refractive_index: ${1:1.5}", "mesh"},
        {"main.xml", "<Scene glint=\"1\">\n  <Sphere ra|", "radius", "radius=\"${1:1.5}\"", "fov"},
        {"main.xml", "<Scene glint=\"1\"><!-- <Camera> --><Sphere radius=\"1\"><|", "Center",
         "Center x=\"0\" y=\"1\" z=\"0\"/>", "Sphere"},
        {"main.xml", "<Scene glint=\"1\"><Sphere radius=\"1\"/><|", "Light",
         "Light name=\"sun\" intensity=\"1.5\"><Position x=\"-20\" y=\"20\" "
         "z=\"20\"/><Color r=\"1\" "
         "g=\"0.9\" b=\"0.8\"/></Light>",
         "Center"},
        {"main.xml", "<Scene glint=\"1\"><Image to|=\"clip\"/></Scene>", "tone", "tone", "radius"},
    };
    struct lsp_client *client = *state;
    initialize_richly(client);
    client_open(client, "main.yaml", MAIN);
    client_open(client, "main.xml", "<Scene glint=\"1\"/>");
    for (size_t i = 0; i < sizeof typings / sizeof *typings; i++)
        expect_typing(client, &typings[i], (int)i + 2);
}

#define HEAD "glint: 1\nparameters: {height: 3, top: height + 1}\nspheres:\n  - "

static void completes_expressions(void **state) {
    static const struct typing typings[] = {
        {"main.yaml", HEAD "{center: [0, 2*he|", "height", "height", "radius"},
        {"main.yaml", HEAD "{radius: |", "sqrt", "sqrt($0)", "center"},
        {"main.yaml", HEAD "{radius: height + (to|", "top", "top", "radius"},
        {"main.yaml", HEAD "{radius: min(height, to|", "top", "top", "center"},
        {"main.yaml", HEAD "{radius: 2, |", "center", "center: ${1:[0, 1, 0]}", "height"},
        {"main.yaml", HEAD "{material: he|", NULL, NULL, "height"},
        {"main.yaml", HEAD "{name: height, mate|", "material", "material: ${1:glass}", "top"},
        {"main.yaml", HEAD "{center: {x: -hei|", "height", "height", "radius"},
        {"main.xml",
         "<Scene glint=\"1\"><Parameter name=\"tall\" value=\"2\"/><Sphere radius=\"2*ta|\"/></Scene>",
         "frame", "frame", "fov"},
    };
    struct lsp_client *client = *state;
    initialize_richly(client);
    client_open(client, "main.yaml", HEAD "{center: [0, 0, 0], radius: 1}\n");
    client_open(client, "main.xml", "<Scene glint=\"1\"/>");
    for (size_t i = 0; i < sizeof typings / sizeof *typings; i++)
        expect_typing(client, &typings[i], (int)i + 2);
}

// Those of the entry, however torn its text is.
static void completes_variables(void **state) {
    static const struct typing typings[] = {
        {"main.yaml", HEAD "{for: {i: 12}, center: [|", "i", "i", "radius"},
        {"main.yaml", HEAD "{for: {i: 12}, center: [i, |", "height", "height", "radius"},
        {"main.yaml", HEAD "{for: {i: 12}, radius: 1}\n  - {for: {k: 2}, radius: |, center: [0, 0, 0]}\n",
         "k", "k", "i"},
        {"main.yaml", HEAD "{center: [2*|, 0, 0], for: {i: height}}\n", "i", "i", "radius"},
        {"main.yaml", HEAD "{\"for\": {\"i\": 5}, \"center\": [|", "i", "i", "radius"},
        {"main.yaml", HEAD "for:\n      i: {count: 12}\n    center:\n      x: |\n  - for: {k: 2}\n", "i", "i",
         "k"},
        {"main.yaml", HEAD "center: [i, |\n    radius: 1\n    for:\n      i: 12\n      k:\n        - 2\n",
         "k", "k", "radius"},
        {"main.yaml", HEAD "for: {i: 12}\n    material:\n      diffuse_color: [0, |\n", "i", "i", "checker"},
        {"main.yaml", HEAD "{for: {i: 12}, material: {diffuse_color: hsv(30*|", "i", "i", "checker"},
        {"main.yaml", HEAD "{for: {i: |", "height", "height", "i"},
        {"main.yaml", HEAD "{for: {i: 5, k: 5 - |", "i", "i", "k"},
        {"main.yaml", HEAD "for:\n      i: 5\n      k: 5 - |\n", "i", "i", "k"},
        {"main.yaml", HEAD "{for: {i: 5, p: [[0, |", "i", "i", "p"},
        {"main.yaml", HEAD "{for: {i: 5}, if: i < |", "i", "i", "center"},
        {"main.yaml", HEAD "{for: {i: 5}, if: i != |", "i", "i", "center"},
        {"main.yaml", HEAD "{for: {i: 5}, radius: 1}\ncameras: [{fov: |", "height", "height", "i"},
        {"main.yaml",
         HEAD "{for: {gr\xc3\xb6\xc3\x9f"
              "e: 5}, radius: |",
         "gr\xc3\xb6\xc3\x9f"
         "e",
         "gr\xc3\xb6\xc3\x9f"
         "e",
         "i"},
        {"main.yaml", HEAD "{fo|", "for", "for: {${1:i: 5}}", "fov"},
        {"main.yaml", HEAD "i|", "if", "if: ${1:i != 3}", "fov"},
        {"main.yaml", "glint: 1\nparameters: {height: 3, top: 2*|", "height", "height", "glint"},
        {"main.xml", "<Scene glint=\"1\"><Sphere radius=\"|\"><For name=\"i\" count=\"5\"/></Sphere></Scene>",
         "i", "i", "center"},
        {"main.xml", "<Scene glint=\"1\"><Sphere radius=\"|\n<For name=\"i\" count=\"5\"/></Sphere>", "i",
         "i", "center"},
        {"main.xml",
         "<Scene glint=\"1\"><Sphere><For name=\"i\" values=\"1, 2\"/></Sphere><Sphere if=\"3 > |\"><For "
         "name=\"k\"",
         "frame", "frame", "i"},
        {"main.xml",
         "<Scene glint=\"1\"><Sphere><For name=\"i\" count=\"5\"/><Material><DiffuseColor r=\"i/5\" g=\"|",
         "i", "i", "material"},
        {"main.xml", "<Scene glint=\"1\"><Sphere><For name=\"i\" count=\"5\"/><For name=\"k\" values=\"1, |",
         "i", "i", "k"},
        {"main.xml", "<Scene glint=\"1\"><Sphere radius=\"1\" ma|", "material", "material=\"${1:glass}\"",
         "sin"},
        {"main.xml", "<Scene glint=\"1\"><Sphere><F|", "For", "For name=\"i\" count=\"5\"/>", "for"},
    };
    struct lsp_client *client = *state;
    initialize_richly(client);
    client_open(client, "main.yaml", HEAD "{center: [0, 0, 0], radius: 1}\n");
    client_open(client, "main.xml", "<Scene glint=\"1\"/>");
    for (size_t i = 0; i < sizeof typings / sizeof *typings; i++)
        expect_typing(client, &typings[i], (int)i + 2);
}

#define OBJECTS                                                                                              \
    "glint: 1\nparameters: {height: 3}\nobjects:\n  chair:\n    parameters: {seat: 0.5, legs: {value: 4, "   \
    "min: 3, "                                                                                               \
    "description: of one}}\n    spheres: [{radius: seat}]\ninstances:\n  - "
#define XML_OBJECTS "<Scene glint=\"1\"><Object name=\"chair\"><Parameter name=\"seat\" value=\"0.5\"/>"

// Names of objects, what instances give them, and what is known inside them.
static const struct typing OF_OBJECTS[] = {
    {"main.yaml", OBJECTS "{object: |", "chair", "chair", "seat"},
    {"main.yaml", OBJECTS "object: ch|\n", "chair", "chair", "seat"},
    {"main.yaml", OBJECTS "{object: chair, with: {|", "seat", "seat: ${1:0.5}", "height"},
    {"main.yaml", OBJECTS "{object: chair, with: {|}}\n", "legs", "legs: ${1:4}", "sin"},
    {"main.yaml", OBJECTS "{with: {se|: 2}, object: \"chair\"}\n", "seat", "seat", "height"},
    {"main.yaml", OBJECTS "{object: chair, with: {seat: 2, |", "legs", "legs: ${1:4}", "seat"},
    {"main.yaml", OBJECTS "object: chair\n    with:\n      seat: 2\n      |\n", "legs", "legs: ${1:4}",
     "seat"},
    {"main.yaml", OBJECTS "with:\n      |\n    object: chair # of wood\n", "seat", "seat: ${1:0.5}",
     "height"},
    {"main.yaml", OBJECTS "{object: gone, with: {|", NULL, NULL, "seat"},
    {"main.yaml", OBJECTS "{object: chair, with: {seat: |", "height", "height", "seat"},
    {"main.yaml", OBJECTS "{for: {i: 3}, object: chair, with: {seat: 2*|", "i", "i", "seat"},
    {"main.yaml", OBJECTS "{object: chair, |", "with", "with: {${1:height: 4}}", "radius"},
    {"main.yaml", OBJECTS "{object: {bo|", "boxes", "boxes: [{$0}]", "object"},
    {"main.yaml", OBJECTS "{for: {i: 3}, object: {spheres: [{radius: |", "i", "i", "seat"},
    {"main.yaml",
     OBJECTS "for: {i: 3}\n    object:\n      parameters: {w: 2}\n      spheres:\n        - for: {k: 2}\n"
             "          center: [|\n",
     "i", "i", "seat"},
    {"main.yaml",
     OBJECTS "for: {i: 3}\n    object:\n      parameters: {w: 2}\n      spheres:\n        - center: [|\n",
     "w", "w", "seat"},
    {"main.yaml", OBJECTS "object:\n      parameters:\n        w: 2\n        v: 3*|\n    for: {i: 3}\n", "i",
     "i", "v"},
    {"main.yaml", OBJECTS "object:\n      spheres:\n      - radius: |\n      parameters:\n        w: 2\n",
     "w", "w", "seat"},
    {"main.yaml", OBJECTS "{for: {i: 3}, object: {spheres: [{for: {k: |", "i", "i", "k"},
    {"main.yaml",
     "glint: 1\nobjects:\n  chair:\n    parameters:\n      back: 3\n    spheres:\n      - {radius: |\n"
     "  stool: {parameters: {low: 1}}\n",
     "back", "back", "low"},
    {"main.yaml", "glint: 1\nobjects: {chair: {parameters: {back: 3}, spheres: [{radius: |", "back", "back",
     "center"},
    {"main.yaml", "glint: 1\nobjects:\n  chair:\n    parameters: {back: 3, top: |", "back", "back", "top"},
    {"main.yaml", "glint: 1\nobjects:\n  chair:\n    c|\n", "cones", "cones:\n  - $0", "mesh"},
    {"main.yaml", "glint: 1\nobjects:\n  ch|\n", NULL, NULL, "boxes"},
    {"main.xml", XML_OBJECTS "</Object><Instance object=\"chair\"/></Scene>|", NULL, NULL, "chair"},
    {"main.xml", XML_OBJECTS "</Object><Instance object=\"|\"/></Scene>", "chair", "chair", "seat"},
    {"main.xml", XML_OBJECTS "</Object><Instance object=\"chair\"><With name=\"|", "seat", "seat", "height"},
    {"main.xml",
     XML_OBJECTS "<Parameter name=\"legs\" value=\"4\"/></Object><Instance object=\"chair\"><With "
                 "name=\"seat\" value=\"1\"/><With name=\"|\"/></Instance></Scene>",
     "legs", "legs", "seat"},
    {"main.xml",
     XML_OBJECTS "</Object><Instance object=\"chair\"><For name=\"i\" count=\"3\"/><With name=\"seat\" "
                 "value=\"|",
     "i", "i", "seat"},
    {"main.xml", XML_OBJECTS "<Sphere radius=\"|", "seat", "seat", "center"},
    {"main.xml", XML_OBJECTS "<Parameter name=\"top\" value=\"|", "seat", "seat", "top"},
    {"main.xml",
     XML_OBJECTS "</Object><Instance><For name=\"i\" count=\"3\"/><Object><Parameter name=\"w\" value=\"2\"/>"
                 "<Sphere><For name=\"k\" count=\"|",
     "i", "i", "k"},
    {"main.xml", XML_OBJECTS "</Object><Instance object=\"chair\"><|", "With",
     "With name=\"height\" value=\"4\"/>", "Sphere"},
};

static void completes_objects(void **state) {
    struct lsp_client *client = *state;
    initialize_richly(client);
    client_open(client, "main.yaml", OBJECTS "{object: chair}\n");
    client_open(client, "main.xml", "<Scene glint=\"1\"/>");
    for (size_t i = 0; i < sizeof OF_OBJECTS / sizeof *OF_OBJECTS; i++)
        expect_typing(client, &OF_OBJECTS[i], (int)i + 2);
}

static void tells_what_parameters_are(void **state) {
    static const char text[] = OBJECTS "{object: chair, with: {}}\n";
    struct lsp_client *client = *state;
    initialize_richly(client);
    client_open(client, "main.yaml", text);
    json_t *list =
        client_request(client, "textDocument/completion", client_at(client, "main.yaml", 7, 27), NULL);
    const json_t *items = json_object_get(list, "items");
    assert_int_equal(json_array_size(items), 2);
    assert_string_equal(client_text(json_array_get(items, 0), "detail"), "0.5");
    assert_string_equal(client_text(json_array_get(items, 1), "detail"), "4");
    assert_string_equal(client_text(json_array_get(items, 1), "documentation"), "of one");
    json_decref(list);
}

// What an item says beside its name.
static void expect_detail(struct lsp_client *client, int version, const char *entry, const char *wanted) {
    char text[256];
    snprintf(text, sizeof text, HEAD "{for: {%s}, radius: ", entry);
    change(client, "main.yaml", version, text);
    json_t *list =
        client_request(client, "textDocument/completion",
                       client_at(client, "main.yaml", 3, (int)strlen(text) - (int)strlen(HEAD) + 4), NULL);
    const json_t *item = json_array_get(json_object_get(list, "items"), 0);
    assert_string_equal(client_text(item, "label"), "i");
    assert_string_equal(client_text(item, "detail"), wanted);
    json_decref(list);
}

static void tells_what_variables_are(void **state) {
    struct lsp_client *client = *state;
    initialize_richly(client);
    client_open(client, "main.yaml", HEAD "{center: [0, 0, 0], radius: 1}\n");
    expect_detail(client, 2, "i: 12", "0 to 11");
    expect_detail(client, 3, "i: 1", "0");
    expect_detail(client, 4, "i: 0", "no value");
    expect_detail(client, 5, "i: 2*height", "from 0, less than 2*height");
    expect_detail(client, 6, "i: [[0, 0, 1], [max(1, 2), 0, 1]]", "one of 2 values");
    expect_detail(client, 7, "i: {values: [7]}", "one value");
}

// A client without snippets gets no places to fill in.
static void completes_attributes_without_snippets(void **state) {
    static const struct typing plain[] = {
        {"main.yaml", "glint: 1\nmaterials:\n  glass:\n    alb|\n", "albedo", "albedo: ", NULL},
        {"main.xml", "<Scene glint=\"1\"><Sphere ra|", "radius", "radius=\"\"", NULL},
        {"main.xml", "<Scene glint=\"1\"><|", "Light", "Light", NULL},
    };
    struct lsp_client *client = *state;
    client_initialize(client, NULL);
    client_open(client, "main.yaml", MAIN);
    client_open(client, "main.xml", "<Scene glint=\"1\"/>");
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++)
        expect_typing(client, &plain[i], (int)i + 2);
}

static void explains_in_markdown(void **state) {
    struct lsp_client *client = *state;
    initialize_richly(client);
    client_open(client, "main.yaml", MAIN);
    json_t *hover = client_request(client, "textDocument/hover", client_at(client, "main.yaml", 3, 46), NULL);
    const json_t *contents = json_object_get(hover, "contents");
    assert_string_equal(client_text(contents, "kind"), "markdown");
    assert_non_null(strstr(client_text(contents, "value"), "```yaml\nglass: {refractive_index: 1.5}\n```"));
    assert_non_null(strstr(client_text(contents, "value"), "**sphere.material**"));
    assert_non_null(strstr(client_text(contents, "value"), "```yaml\nmaterial: glass\n```"));
    json_decref(hover);
}

static json_t *colors_of(struct lsp_client *client, const char *name, size_t count) {
    json_t *params = json_pack("{s:{s:s}}", "textDocument", "uri", client_uri(client, name));
    json_t *list = client_request(client, "textDocument/documentColor", params, NULL);
    assert_int_equal(json_array_size(list), count);
    return list;
}

// What is written for orange in place of a colour of the list; "": nothing more.
static void expect_picked(struct lsp_client *client, const char *name, const json_t *item, const char *first,
                          const char *second) {
    json_t *params = json_pack("{s:{s:s}, s:O, s:{s:f, s:f, s:f, s:f}}", "textDocument", "uri",
                               client_uri(client, name), "range", json_object_get(item, "range"), "color",
                               "red", 1.0, "green", 0.5, "blue", 0.0, "alpha", 1.0);
    json_t *list = client_request(client, "textDocument/colorPresentation", params, NULL);
    assert_int_equal(json_array_size(list), 1 + (second[0] != '\0'));
    assert_string_equal(client_text(json_object_get(json_array_get(list, 0), "textEdit"), "newText"), first);
    if (second[0])
        assert_string_equal(client_text(json_object_get(json_array_get(list, 1), "textEdit"), "newText"),
                            second);
    json_decref(list);
}

static double channel(const json_t *list, size_t index, const char *name) {
    return json_number_value(json_object_get(json_object_get(json_array_get(list, index), "color"), name));
}

static void shows_colours_and_takes_them(void **state) {
    struct lsp_client *client = *state;
    client_initialize(client, NULL);
    client_open(client, "main.yaml",
                "glint: 1\nbackground: {color: [0.5, 0.2, 7]}\nlights: [{position: [0, 1, 0], color: "
                "\"#ff0080\"}]\n");
    json_t *list = colors_of(client, "main.yaml", 2);
    assert_true(channel(list, 0, "red") == 0.5 && channel(list, 0, "blue") == 1);
    const json_t *from = json_object_get(json_object_get(json_array_get(list, 0), "range"), "start");
    assert_int_equal(json_integer_value(json_object_get(from, "character")), 20);
    assert_true(channel(list, 1, "red") == 1 && channel(list, 1, "green") == 0);
    expect_picked(client, "main.yaml", json_array_get(list, 0), "[1, 0.5, 0]", "\"#ff8000\"");
    expect_picked(client, "main.yaml", json_array_get(list, 1), "\"#ff8000\"", "[1, 0.5, 0]");
    json_decref(list);
    // Linear numbers, as the picture shows them.
    change(client, "main.yaml", 2, "glint: 1\nimage: {transfer: srgb}\nbackground: {color: 0.2140411}\n");
    list = colors_of(client, "main.yaml", 1);
    assert_true(channel(list, 0, "red") > 0.4999 && channel(list, 0, "red") < 0.5001);
    expect_picked(client, "main.yaml", json_array_get(list, 0), "[1, 0.214, 0]", "\"#ff8000\"");
    json_decref(list);
    change(client, "main.yaml", 3,
           "glint: 1\nparameters: {dusk: \"#403050\"}\nbackground: {color: dusk}\nlights: [{position: [0, 9, "
           "0], color: "
           "0.5}]\n");
    json_decref(colors_of(client, "main.yaml", 1)); // none of the expression
    client_open(client, "other.xml",
                "<Scene glint=\"1\"><Background><Color r=\"1\" g=\"0\" b=\"0\"/></Background><Light "
                "color=\"#00ff00\"><Position x=\"1\" y=\"1\" z=\"1\"/></Light></Scene>");
    list = colors_of(client, "other.xml", 2);
    expect_picked(client, "other.xml", json_array_get(list, 0), "<Color r=\"1\" g=\"0.5\" b=\"0\"/>",
                  "<Color hex=\"#ff8000\"/>");
    expect_picked(client, "other.xml", json_array_get(list, 1), "#ff8000", "");
    json_decref(list);
}

int main(int argc, char **argv) {
    program = argc > 1 ? argv[1] : "glint";
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(completes_attributes, start, stop),
        cmocka_unit_test_setup_teardown(completes_expressions, start, stop),
        cmocka_unit_test_setup_teardown(completes_variables, start, stop),
        cmocka_unit_test_setup_teardown(completes_objects, start, stop),
        cmocka_unit_test_setup_teardown(tells_what_parameters_are, start, stop),
        cmocka_unit_test_setup_teardown(tells_what_variables_are, start, stop),
        cmocka_unit_test_setup_teardown(completes_attributes_without_snippets, start, stop),
        cmocka_unit_test_setup_teardown(explains_in_markdown, start, stop),
        cmocka_unit_test_setup_teardown(shows_colours_and_takes_them, start, stop),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
