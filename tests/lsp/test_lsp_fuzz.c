// A hostile client: requests, edits and bytes at random, valid and not. The server answers every request,
// ends only where the protocol is broken for good, and then by itself. Usage: test_lsp_fuzz GLINT [SEEDS]
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
#include <sys/wait.h>
#include <unistd.h>

enum {
    STEPS = 120,
    EDITS = 60,
    TEXT_BYTES = 1 << 16,
};

static const char *program;
static unsigned seeds = 3;

// (xorshift64, Marsaglia 2003.)
static uint64_t draw(uint64_t *state, uint64_t below) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state % below;
}

static const char *const NAMES[] = {"a.yaml",  "b.yaml",      "part.yaml",     "c.xml",
                                    "tri.obj", "gone/x.yaml", ".glintrc.yaml", "m\xC3\xA9 1%.yaml"};
static const char *const PIECES[] = {
    "glint: 1\n",
    "include: [part.yaml, b.yaml]\n",
    "include: [a.yaml, c.xml, gone.yaml]\n",
    "materials:\n  glass: &g {refractive_index: 1.5}\n  \"gl\\x61ss2\": *g\n",
    "spheres:\n  - {center: [0, 0, 0], radius: 1, material: glass}\n",
    "  - {centre: [0, 0], radius: -1, material: glas}\n",
    "  - {for: {i: 3, p: [[0, 0, i], [1, i, 0]]}, if: i != 1, center: p, radius: 0.1 + i}\n",
    "objects: {a: {parameters: {h: 1, k: h}, boxes: [{for: {i: h}, center: [i, k, 0], size: h}]}, b: "
    "{instances: "
    "[{object: a, with: {h: 2}}]}}\n",
    "objects:\n  a:\n    parameters: {h: 2}\n    spheres:\n      - {center: [0, h, 0], radius: h}\n    "
    "instances:\n",
    "instances:\n  - {for: {i: 3}, object: a, with: {h: i + 1}, translation: [i, 0, 0]}\n  - object: "
    "{parameters: {w: 1}, "
    "instances: [{object: b, translation: [w, 0, 0]}]}\n    with:\n      h: 1\n",
    "models: [{mesh: tri.obj, material_map: {red: glass}}]\n",
    "background: {image: nothing.png}\n",
    "description: \"\xF0\x9F\x94\xB7 caf\xC3\xA9\"  # glint: allow W407\n",
    "\r\n",
    "\r",
    "# \xE2\x82\xAC\n",
    "{[",
    "]}",
    ": ",
    "\t- ",
    "\xEF\xBB\xBF",
    "<Scene glint=\"1\">",
    "<Material name=\"g&#108;ass\" refractive_index=\"1.5\"/>",
    "<Sphere radius=\"1\" material=\"glass\"><Center x=\"0\" y=\"&quot;\" z=\"0\"/></Sphere>",
    "<Sphere radius=\"1 + i\" if=\"i &lt; 2\"><For name=\"i\" count=\"3\"/><Center x=\"i\" y=\"0\" "
    "z=\"0\"/></Sphere>",
    "<Object name=\"a\"><Parameter name=\"h\" value=\"1\"/><Sphere radius=\"h\"><Center x=\"h\" y=\"0\" "
    "z=\"0\"/></Sphere>",
    "</Object>",
    "<Instance object=\"a\"><For name=\"i\" count=\"2\"/><With name=\"h\" value=\"i\"/></Instance>",
    "</Scene>",
    "<!-- glint: allow W401 -->",
    "limits: {mesh-bytes: x}\n",
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n",
};
#define COUNT(array) (sizeof(array) / sizeof *(array))

static void compose(uint64_t *state, char *text, size_t size) {
    size_t length = 0;
    text[0] = '\0';
    if (draw(state, 4))
        length = (size_t)snprintf(text, size, "glint: 1\n");
    for (uint64_t i = draw(state, 9); i > 0; i--) {
        const char *piece = PIECES[draw(state, COUNT(PIECES))];
        length += (size_t)snprintf(text + length, size - length, "%s", piece);
    }
}

static json_t *any_number(uint64_t *state) {
    static const json_int_t numbers[] = {-1, 1 << 20, 4294967295, 4294967296, INT64_MAX, INT64_MIN};
    uint64_t kind = draw(state, 12);
    if (kind == 0)
        return json_string("1");
    if (kind == 1)
        return json_integer(numbers[draw(state, COUNT(numbers))]);
    return json_integer((json_int_t)draw(state, kind < 6 ? 8 : 60));
}

static json_t *any_position(uint64_t *state) {
    if (draw(state, 30) == 0)
        return json_null();
    return json_pack("{s:o, s:o}", "line", any_number(state), "character", any_number(state));
}

static json_t *any_range(uint64_t *state) {
    return json_pack("{s:o, s:o}", "start", any_position(state), "end", any_position(state));
}

static json_t *any_document(struct lsp_client *client, uint64_t *state) {
    static const char *const others[] = {"", "untitled:Untitled-1", "file:", "file:///%00/%zz.yaml",
                                         "http://example.org/a.yaml"};
    if (draw(state, 20) == 0)
        return json_pack("{s:s, s:i}", "uri", others[draw(state, COUNT(others))], "version", 1);
    return json_pack("{s:s, s:i}", "uri", client_uri(client, NAMES[draw(state, COUNT(NAMES))]), "version",
                     (int)draw(state, 100));
}

static void change_something(struct lsp_client *client, uint64_t *state, char *text) {
    json_t *changes = json_array();
    for (uint64_t i = draw(state, 4); i > 0; i--) {
        json_t *change = json_object();
        compose(state, text, TEXT_BYTES);
        if (draw(state, 20))
            json_object_set_new(change, "text", json_string(text));
        if (draw(state, 3))
            json_object_set_new(change, "range", any_range(state));
        json_array_append_new(changes, change);
    }
    client_notify(
        client, "textDocument/didChange",
        json_pack("{s:o, s:o}", "textDocument", any_document(client, state), "contentChanges", changes));
}

static void tell_something(struct lsp_client *client, uint64_t *state, char *text) {
    static const char *const methods[] = {"textDocument/didClose", "textDocument/didSave",
                                          "workspace/didChangeWatchedFiles", "$/cancelRequest",
                                          "initialized"};
    json_t *document = any_document(client, state);
    if (draw(state, 2) == 0) {
        compose(state, text, TEXT_BYTES);
        json_object_set_new(document, "text", json_string(text));
        client_notify(client, "textDocument/didOpen", json_pack("{s:o}", "textDocument", document));
    } else {
        client_notify(client, methods[draw(state, COUNT(methods))],
                      json_pack("{s:o}", "textDocument", document));
    }
}

// Whole frames that hold no message.
static void send_nonsense(struct lsp_client *client, uint64_t *state) {
    static const char *const bodies[] = {
        "",
        "{",
        "[]",
        "null",
        "{\"id\":1}",
        "{\"method\":3}",
        "{\"id\":{},\"method\":\"\"}",
        "\"\xFF\"",
        "{\"a\":\"\\ud800\"}",
        "{\"a\":1,\"a\":2}",
    };
    char frame[300];
    const char *body = bodies[draw(state, COUNT(bodies))];
    int length =
        snprintf(frame, sizeof frame, "%sContent-Length: %zu\r\n%s\r\n%s", draw(state, 2) ? "X: y\r\n" : "",
                 strlen(body),
                 draw(state, 2) ? "Content-Type: application/vscode-jsonrpc; charset=utf-8\r\n" : "", body);
    int cut = (int)draw(state, (uint64_t)length);
    client_send_bytes(client, frame, (size_t)cut);
    client_send_bytes(client, frame + cut, (size_t)(length - cut));
}

// An answer comes to every request, or the kit gives up.
static void ask_something(struct lsp_client *client, uint64_t *state) {
    static const char *const methods[] = {"textDocument/codeAction",
                                          "textDocument/definition",
                                          "textDocument/references",
                                          "textDocument/rename",
                                          "textDocument/documentHighlight",
                                          "textDocument/prepareRename",
                                          "textDocument/hover",
                                          "textDocument/completion",
                                          "textDocument/documentSymbol",
                                          "textDocument/documentLink",
                                          "textDocument/formatting",
                                          "textDocument/documentColor",
                                          "textDocument/colorPresentation",
                                          "workspace/executeCommand",
                                          "initialize",
                                          "nonsense"};
    static const char *const names[] = {"window", "", "9", "gl ass", "\xC3\xA9t\xC3\xA9"};
    json_t *error = NULL;
    json_t *params = json_pack("{s:o, s:o, s:o, s:s, s:{s:b}}", "textDocument", any_document(client, state),
                               "position", any_position(state), "range", any_range(state), "newName",
                               names[draw(state, COUNT(names))], "context", "includeDeclaration", 1);
    json_decref(client_request(client, methods[draw(state, COUNT(methods))], params, &error));
    json_decref(error);
}

static void lives_through_anything(void **unused) {
    (void)unused;
    char *text = malloc(TEXT_BYTES);
    assert_non_null(text);
    for (unsigned seed = 1; seed <= seeds; seed++) {
        struct lsp_client client;
        uint64_t state = 0x9E3779B97F4A7C15U * seed;
        client_start(&client, program);
        client_file(&client, "tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
        client_file(&client, "b.yaml", "glint: 1\ninclude: [a.yaml, part.yaml]\n");
        client_file(&client, ".glintrc.yaml", "ignore: [N401]\n");
        client_initialize(&client, NULL);
        for (int step = 0; step < STEPS; step++) {
            uint64_t kind = draw(&state, 10);
            if (kind < 3)
                tell_something(&client, &state, text);
            else if (kind < 6)
                change_something(&client, &state, text);
            else if (kind < 7)
                send_nonsense(&client, &state);
            ask_something(&client, &state);
        }
        if (client_stop(&client) != 0)
            fail_msg("seed %u", seed);
    }
    free(text);
}

// ---- edits, against a text that the test keeps itself

// Line and UTF-16 character of a byte offset, the plain way.
static json_t *plain_position(const char *text, size_t offset) {
    int line = 0;
    int character = 0;
    for (size_t i = 0; i < offset; i++) {
        unsigned char c = (unsigned char)text[i];
        if (c == '\n' || (c == '\r' && text[i + 1] != '\n')) {
            line++;
            character = 0;
        } else if (c != '\r' && (c & 0xC0) != 0x80) {
            character += c >= 0xF0 ? 2 : 1;
        }
    }
    return json_pack("{s:i, s:i}", "line", line, "character", character);
}

// A place between characters, and not within a line end.
static size_t any_place(uint64_t *state, const char *text) {
    size_t at = (size_t)draw(state, strlen(text) + 1);
    while (at > 0 && (((unsigned char)text[at] & 0xC0) == 0x80 || (text[at] == '\n' && text[at - 1] == '\r')))
        at--;
    return at;
}

static json_t *edit_somewhere(uint64_t *state, char *text) {
    static const char *const inserts[] = {
        "", "x", "\r\n", "\r", "\n", "\xF0\x9F\x94\xB7", "\xC3\xA9: 2\n", "qqq: 1\n"};
    const char *insert = inserts[draw(state, COUNT(inserts))];
    size_t begin = any_place(state, text);
    size_t end = draw(state, 3) ? begin : any_place(state, text);
    if (end < begin || end - begin > 12)
        end = begin;
    json_t *change = json_pack("{s:{s:o, s:o}, s:s}", "range", "start", plain_position(text, begin), "end",
                               plain_position(text, end), "text", insert);
    size_t length = strlen(insert);
    memmove(text + begin + length, text + end, strlen(text + end) + 1);
    memcpy(text + begin, insert, length);
    return change;
}

static void send_changes(struct lsp_client *client, int version, json_t *changes) {
    client_notify(client, "textDocument/didChange",
                  json_pack("{s:{s:s, s:i}, s:o}", "textDocument", "uri", client_uri(client, "a.yaml"),
                            "version", version, "contentChanges", changes));
}

static void keeps_the_text_that_the_editor_has(void **unused) {
    (void)unused;
    static char text[TEXT_BYTES];
    struct lsp_client client;
    uint64_t state = 88172645463325252U;
    int version = 1;
    client_start(&client, program);
    client_initialize(&client, NULL);
    client_open(&client, "a.yaml", "glint: 1\n");
    for (int round = 0; round < EDITS; round++) {
        if (round % 10 == 0) {
            snprintf(
                text, sizeof text,
                "glint: 1\r\ndescription: \"\xF0\x9F\x94\xB7 caf\xC3\xA9\"\nimage: {width: 3}\rqqq: 1\n");
            send_changes(&client, ++version, json_pack("[{s:s}]", "text", text));
        }
        json_t *changes = json_array();
        for (uint64_t i = draw(&state, 3) + 1; i > 0; i--)
            json_array_append_new(changes, edit_somewhere(&state, text));
        send_changes(&client, ++version, changes);
        json_t *edited = json_incref(client_diagnostics(&client, "a.yaml", version));
        send_changes(&client, ++version, json_pack("[{s:s}]", "text", text));
        json_t *whole = client_diagnostics(&client, "a.yaml", version);
        if (!json_equal(edited, whole))
            fail_msg("round %d: the server has another text than\n%s", round, text);
        json_decref(edited);
    }
    assert_int_equal(client_stop(&client), 0);
}

// ---- broken for good

static void ends_where_no_frames_come(void **unused) {
    (void)unused;
    static const char *const ends[] = {
        "",
        "Content-Length: 10\r\n\r\n{",
        "Content-Length: 99999999999999999999\r\n\r\n{}",
        "Content-Length: -1\r\n\r\n{}",
        "Content-Length: x\r\n\r\n",
        "Content-Type: x\r\n\r\n",
        "Content-Len",
        "\r\n\r\n",
        "{\"jsonrpc\":\"2.0\"}\n",
    };
    for (size_t i = 0; i < COUNT(ends); i++) {
        struct lsp_client client;
        int status = 0;
        client_start(&client, program);
        client_initialize(&client, NULL);
        client_send_bytes(&client, ends[i], strlen(ends[i]));
        close(client.to);
        json_t *rest;
        while ((rest = client_receive(&client)) != NULL)
            json_decref(rest);
        waitpid(client.pid, &status, 0);
        client.pid = 0;
        client_free(&client);
        assert_true(WIFEXITED(status));
        assert_int_equal(WEXITSTATUS(status), 1);
    }
}

int main(int argc, char **argv) {
    if (argc < 2)
        return 2;
    program = argv[1];
    if (argc > 2)
        seeds = (unsigned)strtoul(argv[2], NULL, 10);
    // What a sanitizer finds is told apart from the server's own status.
    setenv("ASAN_OPTIONS", "exitcode=99:abort_on_error=0", 1);
    setenv("UBSAN_OPTIONS", "exitcode=99:halt_on_error=1:print_stacktrace=1", 1);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lives_through_anything),
        cmocka_unit_test(keeps_the_text_that_the_editor_has),
        cmocka_unit_test(ends_where_no_frames_come),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
