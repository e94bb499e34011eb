#include "lsp_marks.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

json_t *at_mark(struct lsp_client *client, const char *name, const char *text, const char *mark) {
    char plain[128];
    const char *bar = strchr(mark, '|');
    assert_non_null(bar);
    snprintf(plain, sizeof plain, "%.*s%s", (int)(bar - mark), mark, bar + 1);
    const char *found = strstr(text, plain);
    if (!found || strstr(found + 1, plain))
        fail_msg("'%s' is not once in the text", plain);
    const char *end = found + (bar - mark), *line = text;
    int number = 0, character = 0;
    for (const char *c = text; c < end; c++)
        if (*c == '\n') {
            line = c + 1;
            number++;
        }
    for (const char *c = line; c < end; c++) // units of UTF-16
        character += ((unsigned char)*c & 0xc0) == 0x80 ? 0 : (unsigned char)*c >= 0xf0 ? 2 : 1;
    return client_at(client, name, number, character);
}

void expect_hover(struct lsp_client *client, const char *name, const char *text, const char *mark,
                  const char *wanted) {
    json_t *hover = client_request(client, "textDocument/hover", at_mark(client, name, text, mark), NULL);
    const char *value = client_text(json_object_get(hover, "contents"), "value");
    if (!strstr(value, wanted))
        fail_msg("at %s there is no '%s', but '%s'", mark, wanted, value);
    json_decref(hover);
}

json_t *rename_at(struct lsp_client *client, const char *name, const char *text, const char *mark,
                  const char *to, json_t **error) {
    json_t *params = at_mark(client, name, text, mark);
    json_object_set_new(params, "newName", json_string(to));
    return client_request(client, "textDocument/rename", params, error);
}

void expect_refusal(struct lsp_client *client, const char *name, const char *text, const char *mark,
                    const char *to, const char *why) {
    json_t *error = NULL;
    json_decref(rename_at(client, name, text, mark, to, &error));
    if (!error || !strstr(client_text(error, "message"), why))
        fail_msg("%s to %s: '%s', not '%s'", mark, to, error ? client_text(error, "message") : "", why);
    json_decref(error);
}

void write_ranges(const json_t *list, char *out, size_t size) {
    size_t index, length = 0;
    const json_t *item;
    out[0] = '\0';
    json_array_foreach(list, index, item) {
        const json_t *range = json_object_get(item, "range");
        const json_t *from = json_object_get(range, "start"), *to = json_object_get(range, "end");
        length += (size_t)snprintf(out + length, size - length, "%s%d:%d-%d", index ? " " : "",
                                   (int)json_integer_value(json_object_get(from, "line")),
                                   (int)json_integer_value(json_object_get(from, "character")),
                                   (int)json_integer_value(json_object_get(to, "character")));
        assert_true(length < size);
    }
}

void expect_rename(struct lsp_client *client, const char *name, const char *text, const char *mark,
                   const char *wanted) {
    char ranges[512];
    json_t *edit = rename_at(client, name, text, mark, "other", NULL);
    const json_t *changes = json_object_get(edit, "changes");
    assert_int_equal(json_object_size(changes), 1);
    write_ranges(json_object_get(changes, client_uri(client, name)), ranges, sizeof ranges);
    assert_string_equal(ranges, wanted);
    json_decref(edit);
}

void expect_places(struct lsp_client *client, const char *method, const char *name, const char *text,
                   const char *mark, const char *wanted) {
    char ranges[512];
    json_t *list = client_request(client, method, at_mark(client, name, text, mark), NULL);
    json_t *one = json_is_object(list) ? json_pack("[O]", list) : json_incref(list);
    write_ranges(one, ranges, sizeof ranges);
    if (strcmp(ranges, wanted) != 0)
        fail_msg("%s at %s: '%s', not '%s'", method, mark, ranges, wanted);
    json_decref(one);
    json_decref(list);
}
