// What the tests of reports ask of JSON files:
//
//     report_tool validate SCHEMA FILE...   each file is valid by the schema, whose keywords are all known
//     report_tool validate-yaml SCHEMA FILE the same for one file of YAML
//     report_tool covers SCHEMA FILE...     each property that the schema describes is in one of the files
//     report_tool get FILE PATH             the value at PATH: keys and indices, separated by '/'
//     report_tool unique FILE PATH          the values at PATH, where '*' is every item of a list, all differ
#include "tests/equal/json_schema.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static json_t *load(const char *path) {
    json_error_t error;
    json_t *json = json_load_file(path, JSON_REJECT_DUPLICATES, &error);
    if (!json)
        fprintf(stderr, "%s:%d:%d: %s\n", path, error.line, error.column, error.text);
    return json;
}

static int validate(const char *schema_path, int count, char **paths) {
    json_t *schema = load(schema_path);
    int bad = schema ? 0 : 1;
    for (int i = 0; i < count && schema; i++) {
        json_t *value = load(paths[i]);
        if (!value || !json_schema_accepts(schema, schema, value)) {
            fprintf(stderr, "%s: not valid by %s\n", paths[i], schema_path);
            bad = 1;
        }
        json_decref(value);
    }
    json_decref(schema);
    return bad;
}

static int validate_yaml(const char *schema_path, const char *path) {
    char text[65536];
    FILE *file = fopen(path, "rb");
    json_t *schema = load(schema_path);
    size_t size = file ? fread(text, 1, sizeof text, file) : 0;
    json_t *value = file ? json_from_yaml((str){text, size}) : NULL;
    bool good = schema && value && json_schema_accepts(schema, schema, value);
    if (file)
        fclose(file);
    json_decref(value);
    json_decref(schema);
    return good ? 0 : 1;
}

// Every key of every object below a value.
static void add_keys(json_t *value, json_t *keys) {
    const char *key;
    json_t *item;
    size_t i;
    json_array_foreach(value, i, item) add_keys(item, keys);
    json_object_foreach(value, key, item) {
        json_object_set_new(keys, key, json_true());
        add_keys(item, keys);
    }
}

// Every key that "properties" of a schema name, anywhere below it.
static void add_described(json_t *schema, json_t *keys) {
    const char *key;
    json_t *item;
    size_t i;
    json_array_foreach(schema, i, item) add_described(item, keys);
    json_object_foreach(schema, key, item) {
        if (strcmp(key, "properties") == 0)
            json_object_update(keys, item);
        add_described(item, keys);
    }
}

static int covers(const char *schema_path, int count, char **paths) {
    json_t *schema = load(schema_path);
    json_t *described = json_object(), *seen = json_object();
    const char *key;
    json_t *item;
    int bad = schema && count > 0 ? 0 : 1;
    add_described(schema, described);
    for (int i = 0; i < count; i++) {
        json_t *value = load(paths[i]);
        add_keys(value, seen);
        json_decref(value);
    }
    json_object_foreach(described, key, item) {
        if (json_object_get(seen, key))
            continue;
        fprintf(stderr, "%s: no report has '%s'\n", schema_path, key);
        bad = 1;
    }
    json_decref(seen);
    json_decref(described);
    json_decref(schema);
    return bad;
}

// The next part of a path, at most `size` - 1 bytes; gives what follows it.
static const char *part_of(const char *path, char *part, size_t size) {
    size_t length = strcspn(path, "/");
    snprintf(part, size, "%.*s", (int)length, path);
    return path[length] ? path + length + 1 : path + length;
}

// Appends all values at the path to `found`.
static void collect(json_t *value, const char *path, json_t *found) {
    char part[128];
    size_t i;
    json_t *item;
    if (!value)
        return;
    if (!*path) {
        json_array_append(found, value);
        return;
    }
    const char *rest = part_of(path, part, sizeof part);
    if (strcmp(part, "*") == 0) {
        json_array_foreach(value, i, item) collect(item, rest, found);
    } else if (json_is_array(value)) {
        collect(json_array_get(value, strtoul(part, NULL, 10)), rest, found);
    } else {
        collect(json_object_get(value, part), rest, found);
    }
}

static int get(const json_t *found) {
    const json_t *value = json_array_get(found, 0);
    if (json_is_string(value)) {
        puts(json_string_value(value));
    } else if (value) {
        char *text = json_dumps(value, JSON_ENCODE_ANY | JSON_COMPACT | JSON_SORT_KEYS);
        puts(text ? text : "");
        free(text);
    }
    return value ? 0 : 1;
}

static int unique(const json_t *found) {
    size_t i;
    json_t *item;
    json_t *seen = json_object();
    int bad = json_array_size(found) == 0;
    json_array_foreach(found, i, item) {
        const char *text = json_string_value(item);
        if (!text || json_object_get(seen, text)) {
            fprintf(stderr, "twice: %s\n", text ? text : "(no text)");
            bad = 1;
        } else {
            json_object_set_new(seen, text, json_true());
        }
    }
    json_decref(seen);
    return bad;
}

int main(int argc, char **argv) {
    if (argc > 3 && strcmp(argv[1], "validate") == 0)
        return validate(argv[2], argc - 3, argv + 3);
    if (argc > 3 && strcmp(argv[1], "covers") == 0)
        return covers(argv[2], argc - 3, argv + 3);
    if (argc == 4 && strcmp(argv[1], "validate-yaml") == 0)
        return validate_yaml(argv[2], argv[3]);
    if (argc != 4) {
        fprintf(stderr, "usage: report_tool validate SCHEMA FILE..., covers SCHEMA FILE..., validate-yaml "
                        "SCHEMA FILE, get FILE PATH, unique FILE PATH\n");
        return 2;
    }
    json_t *json = load(argv[2]);
    json_t *found = json_array();
    collect(json, argv[3], found);
    int status = strcmp(argv[1], "get") == 0 ? get(found) : unique(found);
    json_decref(found);
    json_decref(json);
    return json ? status : 1;
}
