// glint.preview over the server's pipes: pictures of texts that are not saved. Usage: test_lsp_preview GLINT
#define _XOPEN_SOURCE 700
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
#include <unistd.h>

enum {
    CANCELLED = -32800,
    MODIFIED = -32801,
    FAILED = -32803,
    INVALID = -32602,
    LINE_FRONT = 3, // of the scene, from 0
    LINE_SIDE = 4,
    BYTES = 1 << 22,
};

static const char *program;

static const char SCENE[] = "glint: 1\n"
                            "image: {width: 64, height: 48}\n"
                            "cameras:\n"
                            "  front: {position: [0, 0, 6], fov: 40}\n"
                            "  side: {position: [6, 1, 0],\n"
                            "    fov: 40}\n"
                            "background: {color: [0.3, 0.5, 0.8]}\n"
                            "lights: [{position: [-5, 8, 5]}]\n"
                            "spheres:\n"
                            "  - {center: [-0.9, 0, 0], radius: 0.9}\n"
                            "  - {center: [1, 0.4, 0.3], radius: 0.5}\n";
static const char PARTED[] = "glint: 1\n"
                             "image: {width: 64, height: 48}\n"
                             "include: [paint.yaml]\n"
                             "background: {color: [0.3, 0.5, 0.8]}\n"
                             "lights: [{position: [-5, 8, 5]}]\n"
                             "spheres: [{center: [0, 0, 0], radius: 1, material: paint}]\n";
#define PAINT(color) "glint: 1\nmaterials: {paint: {diffuse_color: \"" color "\"}}\n"

static int begin(void **state) {
    struct lsp_client *client = calloc(1, sizeof *client);
    client_start(client, program);
    client_initialize(client, NULL);
    *state = client;
    return 0;
}

static int end(void **state) {
    int status = client_stop(*state);
    free(*state);
    return status;
}

static json_t *wish(struct lsp_client *client, const char *name, int line, int size, int samples,
                    double seconds) {
    return json_pack("{s:s, s:[{s:{s:s}, s:{s:i, s:i}, s:i, s:i, s:f}]}", "command", "glint.preview",
                     "arguments", "textDocument", "uri", client_uri(client, name), "position", "line", line,
                     "character", 6, "size", size, "samples", samples, "seconds", seconds);
}

// Small, and with all the time that a busy machine may need.
static json_t *preview(struct lsp_client *client, const char *name, int line) {
    return client_request(client, "workspace/executeCommand", wish(client, name, line, 32, 1, 60), NULL);
}

static int refused(struct lsp_client *client, json_t *params) {
    json_t *error = NULL;
    json_decref(client_request(client, "workspace/executeCommand", params, &error));
    const int code = (int)json_integer_value(json_object_get(error, "code"));
    json_decref(error);
    return code;
}

static void change(struct lsp_client *client, const char *name, int version, const char *text) {
    client_notify(client, "textDocument/didChange",
                  json_pack("{s:{s:s, s:i}, s:[{s:s}]}", "textDocument", "uri", client_uri(client, name),
                            "version", version, "contentChanges", "text", text));
}

// ---- pictures

struct bytes {
    uint8_t *at;
    size_t count;
};

// Of a PNG in memory, which is then freed: what is in its chunks of data.
static struct bytes data_of(struct bytes png) {
    struct bytes data = {malloc(png.count + 1), 0};
    assert_non_null(data.at);
    assert_true(png.count > 8 && memcmp(png.at, "\x89PNG\r\n\x1a\n", 8) == 0);
    for (size_t i = 8; i + 12 <= png.count;) {
        const uint8_t *p = png.at + i;
        const size_t length = (size_t)p[0] << 24 | (size_t)p[1] << 16 | (size_t)p[2] << 8 | p[3];
        assert_true(length <= png.count - i - 12);
        if (memcmp(p + 4, "IDAT", 4) == 0) {
            memcpy(data.at + data.count, p + 8, length);
            data.count += length;
        }
        i += length + 12;
    }
    free(png.at);
    assert_true(data.count > 0);
    return data;
}

// Of an answer with a picture, which is given back.
static struct bytes picture_in(json_t *answer) {
    static const char head[] = "data:image/png;base64,";
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *text = client_text(answer, "image");
    if (strncmp(text, head, sizeof head - 1) != 0) {
        char *all = json_dumps(answer, JSON_INDENT(1));
        print_message("no picture: %s\n", all);
        free(all);
        fail();
    }
    struct bytes png = {malloc(strlen(text) + 1), 0};
    assert_non_null(png.at);
    unsigned bits = 0;
    int held = 0;
    for (text += sizeof head - 1; *text && *text != '='; text++) {
        const char *digit = strchr(digits, *text);
        assert_non_null(digit);
        bits = bits << 6 | (unsigned)(digit - digits);
        held += 6;
        if (held >= 8)
            png.at[png.count++] = (uint8_t)(bits >> (held -= 8));
    }
    json_decref(answer);
    return data_of(png);
}

// What `glint render` makes of a file in the folder, as large as the preview.
static struct bytes rendered(struct lsp_client *client, const char *name, const char *options) {
    char command[2000], path[600];
    struct bytes png = {malloc(BYTES), 0};
    snprintf(path, sizeof path, "%s/rendered.png", client->folder);
    snprintf(command, sizeof command, "'%s' render '%s/%s' --size 32x24 --samples 1 -q -o '%s' %s", program,
             client->folder, name, path, options);
    assert_int_equal(system(command), 0); // NOLINT: the test's own words
    FILE *file = fopen(path, "rb");
    assert_true(file && png.at);
    png.count = fread(png.at, 1, BYTES, file);
    fclose(file);
    return data_of(png);
}

static bool same(struct bytes a, struct bytes b) {
    const bool is = a.count == b.count && memcmp(a.at, b.at, a.count) == 0;
    free(a.at);
    free(b.at);
    return is;
}

// ---- tests

static void is_offered(void **unused) {
    (void)unused;
    struct lsp_client client;
    client_start(&client, program);
    json_t *answer = client_request(&client, "initialize", json_pack("{s:{}}", "capabilities"), NULL);
    const json_t *commands = json_object_get(
        json_object_get(json_object_get(answer, "capabilities"), "executeCommandProvider"), "commands");
    assert_string_equal(json_string_value(json_array_get(commands, 0)), "glint.preview");
    json_decref(answer);
    client_stop(&client);
}

static void draws_what_is_not_saved(void **state) {
    struct lsp_client *client = *state;
    client_file(client, "main.glint.yaml", "glint: 1\n"); // what is on the disk counts for nothing
    client_file(client, "same.glint.yaml", SCENE);
    client_open(client, "main.glint.yaml", SCENE);
    json_t *answer = preview(client, "main.glint.yaml", 0);
    assert_int_equal(json_integer_value(json_object_get(answer, "width")), 32);
    assert_int_equal(json_integer_value(json_object_get(answer, "height")), 24);
    assert_int_equal(json_integer_value(json_object_get(answer, "samples")), 1);
    assert_int_equal(json_integer_value(json_object_get(answer, "version")), 1);
    assert_int_equal(json_array_size(json_object_get(answer, "findings")), 0);
    assert_true(json_is_null(json_object_get(answer, "camera")));
    assert_true(same(picture_in(answer), rendered(client, "same.glint.yaml", "")));
    change(client, "main.glint.yaml", 2,
           "glint: 1\nimage: {width: 64, height: 48}\nbackground: {color: [0.9, 0, 0]}\n");
    answer = preview(client, "main.glint.yaml", 0);
    assert_int_equal(json_integer_value(json_object_get(answer, "version")), 2);
    client_file(client, "same.glint.yaml", "glint: 1\nbackground: {color: [0.9, 0, 0]}\n");
    assert_true(same(picture_in(answer), rendered(client, "same.glint.yaml", "")));
}

static void looks_through_the_camera_at_the_cursor(void **state) {
    struct lsp_client *client = *state;
    client_file(client, "same.glint.yaml", SCENE);
    client_open(client, "main.glint.yaml", SCENE);
    static const struct {
        int line;
        const char *name;
    } rows[] = {{LINE_FRONT, "front"}, {LINE_SIDE, "side"}, {LINE_SIDE + 1, "side"}, {LINE_SIDE + 2, NULL}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char option[40] = "";
        json_t *answer = preview(client, "main.glint.yaml", rows[i].line);
        const char *name = json_string_value(json_object_get(answer, "camera"));
        if (rows[i].name) {
            assert_string_equal(name, rows[i].name);
            snprintf(option, sizeof option, "--camera %s", rows[i].name);
        } else {
            assert_null(name);
        }
        assert_true(same(picture_in(answer), rendered(client, "same.glint.yaml", option)));
    }
}

static void draws_the_scene_of_an_included_text(void **state) {
    struct lsp_client *client = *state;
    client_file(client, "main.glint.yaml", PARTED);
    client_file(client, "paint.yaml", PAINT("#ff0000"));
    struct bytes red = rendered(client, "main.glint.yaml", "");
    client_open(client, "paint.yaml", PAINT("#00ff00"));
    struct bytes green = picture_in(preview(client, "paint.yaml", 1));
    client_file(client, "paint.yaml", PAINT("#00ff00"));
    struct bytes saved = rendered(client, "main.glint.yaml", "");
    assert_true(saved.count == green.count && memcmp(saved.at, green.at, green.count) == 0);
    free(saved.at);
    assert_false(same(red, green));
}

// The code of the first finding that is an error, in an answer without a picture.
static const char *first_error(json_t *answer, const char *uri) {
    size_t index;
    json_t *item;
    assert_true(json_is_null(json_object_get(answer, "image")));
    json_array_foreach(json_object_get(answer, "findings"), index, item) {
        if (json_integer_value(json_object_get(item, "severity")) != 1)
            continue;
        assert_string_equal(client_text(item, "uri"), uri);
        return client_text(item, "code");
    }
    return "none";
}

static void says_why_there_is_no_picture(void **state) {
    struct lsp_client *client = *state;
    char uri[1000];
    snprintf(uri, sizeof uri, "%s", client_uri(client, "main.glint.yaml"));
    client_open(client, "main.glint.yaml", "glint: 1\nspheres: [{center: [0, 0, 0], radius: -1}]\n");
    json_t *answer = preview(client, "main.glint.yaml", 0);
    assert_string_equal(first_error(answer, uri), "E206");
    json_decref(answer);
    change(client, "main.glint.yaml", 2, "glint: 1\nspheres: [{center: [0, 0\n");
    answer = preview(client, "main.glint.yaml", 0);
    assert_string_equal(first_error(answer, uri), "E101");
    json_decref(answer);
    // A picture's pixels are looked at only here: diagnostics come when nobody types.
    static const char sky[] = "glint: 1\nbackground: {image: sky.hdr}\n";
    client_file(client, "sky.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n\2");
    change(client, "main.glint.yaml", 3, sky);
    answer = preview(client, "main.glint.yaml", 0);
    snprintf(uri, sizeof uri, "%s", client_uri(client, "sky.hdr"));
    assert_string_equal(first_error(answer, uri), "E620");
    json_decref(answer);
    change(client, "main.glint.yaml", 4, SCENE);
    client_file(client, "same.glint.yaml", SCENE);
    assert_true(
        same(picture_in(preview(client, "main.glint.yaml", 0)), rendered(client, "same.glint.yaml", "")));
}

static void refuses_what_it_cannot_draw(void **state) {
    struct lsp_client *client = *state;
    client_open(client, "main.glint.yaml", SCENE);
    assert_int_equal(refused(client, NULL), INVALID);
    assert_int_equal(refused(client, json_pack("{s:s}", "command", "glint.nothing")), INVALID);
    assert_int_equal(refused(client, json_pack("{s:s}", "command", "glint.preview")), INVALID);
    assert_int_equal(refused(client, json_pack("{s:s, s:[i]}", "command", "glint.preview", "arguments", 3)),
                     INVALID);
    assert_int_equal(refused(client, wish(client, "main.glint.yaml", 0, 15, 1, 1)), INVALID);
    assert_int_equal(refused(client, wish(client, "main.glint.yaml", 0, 1025, 1, 1)), INVALID);
    assert_int_equal(refused(client, wish(client, "main.glint.yaml", 0, 32, 0, 1)), INVALID);
    assert_int_equal(refused(client, wish(client, "main.glint.yaml", 0, 32, 1, 0.01)), INVALID);
    assert_int_equal(refused(client, wish(client, "main.glint.yaml", 0, 32, 1, 61)), INVALID);
    assert_int_equal(refused(client, wish(client, "closed.glint.yaml", 0, 32, 1, 1)), FAILED);
    client_open(client, "other.yaml", "services: {web: {image: nginx}}\n");
    assert_int_equal(refused(client, wish(client, "other.yaml", 0, 32, 1, 1)), FAILED);
    client_notify(client, "$/cancelRequest", json_pack("{s:i}", "id", 4711));
    client_notify(client, "$/cancelRequest", NULL);
    json_decref(preview(client, "main.glint.yaml", 99999));
}

// As much as can be asked for, which takes its whole time.
static int ask_for_much(struct lsp_client *client) {
    return client_ask(client, "workspace/executeCommand", wish(client, "main.glint.yaml", 0, 1024, 256, 2));
}

static int code_of(json_t *answer) {
    const int code = (int)json_integer_value(json_object_get(json_object_get(answer, "error"), "code"));
    json_decref(answer);
    return code;
}

static void can_be_cancelled(void **state) {
    struct lsp_client *client = *state;
    if (sysconf(_SC_NPROCESSORS_ONLN) < 2)
        skip(); // it is drawn before anything else is read
    client_open(client, "main.glint.yaml", SCENE);
    const int first = ask_for_much(client), second = ask_for_much(client);
    client_notify(client, "$/cancelRequest", json_pack("{s:i}", "id", second));
    assert_int_equal(code_of(client_answer(client, second)), CANCELLED);
    client_notify(client, "$/cancelRequest", json_pack("{s:i}", "id", first));
    assert_int_equal(code_of(client_answer(client, first)), CANCELLED);
    free(picture_in(preview(client, "main.glint.yaml", 0)).at);
    const int last = ask_for_much(client);
    const int shutdown = client_ask(client, "shutdown", NULL);
    assert_int_equal(code_of(client_answer(client, last)), CANCELLED);
    json_decref(client_answer(client, shutdown));
}

// Diagnostics do not wait for it, and of those that wait the newest is drawn.
static void holds_nothing_up(void **state) {
    struct lsp_client *client = *state;
    if (sysconf(_SC_NPROCESSORS_ONLN) < 2)
        skip();
    client_open(client, "main.glint.yaml", SCENE);
    client_diagnostics(client, "main.glint.yaml", 1);
    const int first = ask_for_much(client);
    change(client, "main.glint.yaml", 2, "glint: 1\nspheres: [{center: [0, 0, 0], radius: -1}]\n");
    for (bool told = false; !told;) {
        json_t *message = client_receive(client);
        assert_int_not_equal(json_integer_value(json_object_get(message, "id")), first);
        told = strcmp(client_text(message, "method"), "textDocument/publishDiagnostics") == 0;
        json_decref(message);
    }
    const int second = ask_for_much(client), third = ask_for_much(client);
    assert_int_equal(code_of(client_answer(client, second)), MODIFIED);
    json_t *answer = client_answer(client, first);
    json_t *result = json_incref(json_object_get(answer, "result"));
    json_decref(answer);
    assert_int_equal(json_integer_value(json_object_get(result, "version")), 1);
    free(picture_in(result).at);
    answer = client_answer(client, third);
    assert_string_equal(first_error(json_object_get(answer, "result"), client_uri(client, "main.glint.yaml")),
                        "E206");
    json_decref(answer);
}

static void the_reference_draws_where_no_device_is(void **unused) {
    (void)unused;
    struct lsp_client client;
    setenv("GLINT_DEVICE", "reference", 1);
    client_start(&client, program);
    unsetenv("GLINT_DEVICE");
    client_initialize(&client, NULL);
    client_open(&client, "main.glint.yaml", SCENE);
    json_t *answer = preview(&client, "main.glint.yaml", 0);
    assert_string_equal(client_text(answer, "device"), "reference");
    assert_int_equal(json_integer_value(json_object_get(answer, "width")), 32);
    struct bytes front = picture_in(answer);
    assert_false(same(front, picture_in(preview(&client, "main.glint.yaml", LINE_SIDE))));
    change(&client, "main.glint.yaml", 2, "glint: 1\nspheres: [{center: [0, 0, 0], radius: -1}]\n");
    answer = preview(&client, "main.glint.yaml", 0);
    assert_string_equal(first_error(answer, client_uri(&client, "main.glint.yaml")), "E206");
    json_decref(answer);
    client_stop(&client);
}

int main(int argc, char **argv) {
    if (argc != 2)
        return 2;
    program = argv[1];
#define TEST(name) cmocka_unit_test_setup_teardown(name, begin, end)
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_offered),
        TEST(draws_what_is_not_saved),
        TEST(looks_through_the_camera_at_the_cursor),
        TEST(draws_the_scene_of_an_included_text),
        TEST(says_why_there_is_no_picture),
        TEST(refuses_what_it_cannot_draw),
        TEST(can_be_cancelled),
        TEST(holds_nothing_up),
        cmocka_unit_test(the_reference_draws_where_no_device_is),
    };
#undef TEST
    return cmocka_run_group_tests(tests, NULL, NULL);
}
