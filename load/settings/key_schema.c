#include "load/settings/key_schema.h"

#include "core/json_write.h"
#include "core/limits.h"
#include "diag/diag_policy.h"
#include "load/settings/keys.h"

#include <math.h>

// From this depth on everything is on one line.
enum {
    FLAT_DEPTH = 4
};

static const char any_code[] = "^[EWNewn][0-9]([0-9][0-9]|[xX][xX])$";
static const char error_code[] = "^[Ee][0-9]([0-9][0-9]|[xX][xX])$";
static const char changeable_code[] = "^[WNwn][0-9]([0-9][0-9]|[xX][xX])$";

static void put_word(struct json_writer *json, const char *key, const char *word) {
    json_write_text(json, key, str_from(word));
}

static void put_words(struct json_writer *json, const char *const *words) {
    json_open_list(json, "enum");
    for (; *words; words++)
        put_word(json, NULL, *words);
    json_close_list(json);
}

static void put_pattern(struct json_writer *json, const char *key, const char *pattern) {
    json_open_object(json, key);
    put_word(json, "pattern", pattern);
    json_close_object(json);
}

static void put_range(struct json_writer *json, uint64_t least, uint64_t greatest) {
    put_word(json, "type", "integer");
    json_write_integer(json, "minimum", least);
    json_write_integer(json, "maximum", greatest);
}

static void put_lines(struct json_writer *json, const struct key_table *table);

// The same, for the file of `glint test`.
static void put_test_value(struct json_writer *json, const struct key_row *row) {
    switch (row->value) {
    case KEY_SIZE:
        put_word(json, "type", "string");
        put_word(json, "pattern", "^[1-9][0-9]*x[1-9][0-9]*$");
        break;
    case KEY_ASSIGNMENT:
        put_word(json, "type", "string");
        put_word(json, "pattern", "=");
        break;
    case KEY_PATH:
    case KEY_PATTERN:
    case KEY_CAMERA:
    case KEY_DEVICE:
        put_word(json, "type", "string");
        json_write_integer(json, "minLength", 1);
        break;
    case KEY_TEST_BOUNDS:
        put_word(json, "$ref", "#/definitions/bounds");
        break;
    case KEY_TEST_PICTURE:
        json_open_object(json, "additionalProperties");
        put_word(json, "$ref", "#/definitions/picture");
        json_close_object(json);
        break;
    case KEY_METRIC:
    case KEY_THRESHOLD:
    case KEY_PIXELS:
        put_word(json, "type", "number");
        json_write_real(json, "minimum", row->least);
        if (row->greatest < HUGE_VAL)
            json_write_real(json, "maximum", row->greatest);
        break;
    default:
        break;
    }
}

// What one value must be; for a map, what its pairs must be.
static void put_value(struct json_writer *json, const struct key_row *row) {
    const struct limit_info *messages = limit_info(LIMIT_MESSAGES);
    switch (row->value) {
    case KEY_FOLDER:
        put_word(json, "type", "string");
        json_write_integer(json, "minLength", 1);
        break;
    case KEY_CODE:
        put_word(json, "type", "string");
        put_word(json, "pattern", any_code);
        break;
    case KEY_CODE_OR_PATH:
        put_word(json, "type", "string");
        json_write_integer(json, "minLength", 1);
        put_pattern(json, "not", error_code);
        break;
    case KEY_CODE_SEVERITY:
        put_pattern(json, "propertyNames", changeable_code);
        json_open_object(json, "additionalProperties");
        put_words(json, diag_level_words);
        json_close_object(json);
        break;
    case KEY_FAIL_WORD:
        put_words(json, diag_fail_words);
        put_word(json, "default", diag_fail_words[0]);
        break;
    case KEY_LIMIT:
        put_lines(json, &LIMIT_KEYS);
        break;
    case KEY_MAX_MESSAGES:
        put_range(json, messages->least, messages->standard);
        json_write_integer(json, "default", messages->standard);
        break;
    case KEY_WHOLE_NUMBER:
        put_range(json, (uint64_t)row->least, (uint64_t)row->greatest);
        break;
    case KEY_AXIS_BOUNDS:
        put_word(json, "$ref", "#/definitions/bound");
        break;
    case KEY_FROM_TO:
    case KEY_BOUND:
        put_word(json, "type", "number");
        json_write_real(json, "minimum", row->least);
        break;
    default:
        put_test_value(json, row);
        break;
    }
}

// A key without a value means an empty list or map.
static void put_row(struct json_writer *json, const struct key_row *row) {
    json_open_object(json, row->name);
    put_word(json, "description", row->doc);
    if (row->shape != KEY_ONE) {
        json_open_list(json, "type");
        put_word(json, NULL, row->shape == KEY_LIST ? "array" : "object");
        put_word(json, NULL, "null");
        json_close_list(json);
    }
    if (row->shape == KEY_LIST)
        json_open_object(json, "items");
    put_value(json, row);
    if (row->shape == KEY_LIST)
        json_close_object(json);
    json_close_object(json);
}

static void put_properties(struct json_writer *json, const struct key_table *table) {
    json_open_object(json, "properties");
    for (uint32_t i = 0; i < table->count; i++)
        put_row(json, &table->rows[i]);
    json_close_object(json);
    json_write_boolean(json, "additionalProperties", false);
}

// A table inside another: a line per row.
static void put_lines(struct json_writer *json, const struct key_table *table) {
    json->flat_depth++;
    put_properties(json, table);
    json->flat_depth--;
}

static void open_file(struct json_writer *json, struct strbuf *out, const char *title, const char *doc) {
    json_writer_init(json, out, FLAT_DEPTH);
    json_open_object(json, NULL);
    put_word(json, "$schema", "http://json-schema.org/draft-07/schema#");
    put_word(json, "title", title);
    put_word(json, "description", doc);
    put_word(json, "type", "object");
}

void key_schema_settings(struct strbuf *out) {
    struct json_writer json;
    open_file(&json, out, "Settings of glint: .glintrc.yaml",
              "Holds for the scenes in its folder and in those below it. docs/ci.md tells more.");
    put_properties(&json, &SETTING_KEYS);
    json_close_object(&json);
    json_end(&json);
}

void key_schema_bounds(struct strbuf *out) {
    struct json_writer json;
    open_file(&json, out, "Bounds of glint extremes",
              "For each axis, or all, the most that metrics may be. docs/accuracy.md tells more.");
    json_open_object(&json, "definitions");
    json_open_object(&json, "bound");
    put_word(&json, "type", "object");
    put_lines(&json, &BOUND_KEYS);
    json_close_object(&json);
    json_close_object(&json);
    put_properties(&json, &AXIS_KEYS);
    json_close_object(&json);
    json_end(&json);
}

void key_schema_tests(struct strbuf *out) {
    struct json_writer json;
    open_file(&json, out, "Pictures of glint test: glint-test.yaml",
              "How pictures are rendered and how far they may be from their references. docs/test.md tells "
              "more.");
    json_open_object(&json, "definitions");
    json_open_object(&json, "bounds");
    put_word(&json, "type", "object");
    put_lines(&json, &TEST_BOUND_KEYS);
    json_close_object(&json);
    json_open_object(&json, "picture");
    json_open_list(&json, "type");
    put_word(&json, NULL, "object");
    put_word(&json, NULL, "null");
    json_close_list(&json);
    put_lines(&json, &TEST_PICTURE_KEYS);
    json_close_object(&json);
    json_close_object(&json);
    put_properties(&json, &TEST_KEYS);
    json_close_object(&json);
    json_end(&json);
}
