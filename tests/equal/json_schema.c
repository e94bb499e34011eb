#include "tests/equal/json_schema.h"

#include "core/number.h"
#include "core/strbuf.h"
#include "grammar/ir_copies.h"
#include "parser/tree/reader.h"

#include <regex.h>
#include <string.h>

// ---- validation

static bool has_type(const char *type, const json_t *value) {
    if (strcmp(type, "number") == 0)
        return json_is_number(value);
    if (strcmp(type, "integer") == 0)
        return json_is_integer(value);
    if (strcmp(type, "string") == 0)
        return json_is_string(value);
    if (strcmp(type, "boolean") == 0)
        return json_is_boolean(value);
    if (strcmp(type, "null") == 0)
        return json_is_null(value);
    return strcmp(type, "array") == 0 ? json_is_array(value) : json_is_object(value);
}

static bool check_type(const json_t *types, const json_t *value) {
    size_t i;
    const json_t *type;
    if (json_is_string(types))
        return has_type(json_string_value(types), value);
    json_array_foreach(types, i, type) {
        if (has_type(json_string_value(type), value))
            return true;
    }
    return false;
}

// ---- patterns of JavaScript, as POSIX has them

static void add_class(bool set[256], char class) {
    for (int c = '0'; class == 'd' && c <= '9'; c++)
        set[c] = true;
    for (const char *blank = " \t\n\r"; class == 's' && *blank; blank++)
        set[(unsigned char)*blank] = true;
}

// The set in brackets at `at`, and the place after it.
static const char *read_set(const char *at, bool set[256]) {
    const bool is_inverse = *at == '^';
    for (at += is_inverse; *at != ']'; at++) {
        const bool is_escape = *at == '\\';
        unsigned char first = (unsigned char)*(at += is_escape), last = first;
        if (is_escape && (first == 'd' || first == 's')) {
            add_class(set, (char)first);
            continue;
        }
        if (at[1] == '-' && at[2] != ']') {
            at += 2;
            last = (unsigned char)*(at += *at == '\\');
        }
        for (int c = first; c <= last; c++)
            set[c] = true;
    }
    for (int c = 1; is_inverse && c < 256; c++)
        set[c] = !set[c];
    return at + 1;
}

// "]" first, "-" last, "^" in between.
static void write_set(const bool set[256], struct strbuf *out) {
    strbuf_cstr(out, set[']'] ? "[]" : "[");
    for (int c = 1; c < 256; c++)
        if (set[c] && c != ']' && c != '-' && c != '^')
            strbuf_char(out, (char)c);
    strbuf_cstr(out, set['^'] ? "^" : "");
    strbuf_cstr(out, set['-'] ? "-]" : "]");
}

static void translate(const char *pattern, struct strbuf *out) {
    while (*pattern) {
        bool set[256] = {false};
        if (*pattern == '[') {
            pattern = read_set(pattern + 1, set);
            write_set(set, out);
        } else if (*pattern == '\\' && (pattern[1] == 'd' || pattern[1] == 's')) {
            add_class(set, pattern[1]);
            write_set(set, out);
            pattern += 2;
        } else {
            if (*pattern == '\\')
                strbuf_char(out, *pattern++);
            strbuf_char(out, *pattern++);
        }
    }
}

static bool check_pattern(const char *pattern, const char *text) {
    regex_t regex;
    const str name = str_from(text);
    if (strstr(pattern,
               "\\u")) { // names of any script, of copies, of bodies in objects: the patterns beyond POSIX
        const char *last = strstr(pattern, "(/") ? strrchr(text, '/') : NULL;
        return str_is_name(strstr(pattern, "(\\[") ? ir_copies_base(last ? str_from(last + 1) : name) : name);
    }
    struct strbuf posix;
    strbuf_init(&posix);
    translate(pattern, &posix);
    strbuf_char(&posix, '\0');
    const bool is_pattern = regcomp(&regex, posix.data, REG_EXTENDED | REG_NOSUB) == 0;
    const bool good = is_pattern && regexec(&regex, text, 0, NULL, 0) == 0;
    if (is_pattern)
        regfree(&regex);
    strbuf_finish(&posix);
    return good;
}

static unsigned count_accepting(const json_t *root, const json_t *schemas, const json_t *value) {
    size_t i;
    const json_t *schema;
    unsigned count = 0;
    json_array_foreach(schemas, i, schema) count += json_schema_accepts(root, schema, value);
    return count;
}

static bool is_known_property(const json_t *schema, const char *key) {
    const json_t *patterns = json_object_get(schema, "patternProperties");
    const char *pattern;
    const json_t *ignored;
    if (json_object_get(json_object_get(schema, "properties"), key))
        return true;
    json_object_foreach((json_t *)patterns, pattern, ignored) {
        if (check_pattern(pattern, key))
            return true;
    }
    return false;
}

static bool check_object(const json_t *root, const json_t *schema, const json_t *object) {
    const json_t *properties = json_object_get(schema, "properties");
    const json_t *others = json_object_get(schema, "additionalProperties");
    const json_t *names = json_object_get(schema, "propertyNames");
    const char *key;
    const json_t *value;
    json_object_foreach((json_t *)object, key, value) {
        const json_t *property = json_object_get(properties, key);
        if (property && !json_schema_accepts(root, property, value))
            return false;
        if (others && !is_known_property(schema, key) && !json_schema_accepts(root, others, value))
            return false;
        json_t *name = json_string(key);
        bool good = !names || json_schema_accepts(root, names, name);
        json_decref(name);
        if (!good)
            return false;
    }
    size_t i;
    json_array_foreach(json_object_get(schema, "required"), i, value) {
        if (!json_object_get(object, json_string_value(value)))
            return false;
    }
    return true;
}

static bool check_array(const json_t *root, const json_t *schema, const json_t *array) {
    const json_t *items = json_object_get(schema, "items");
    const json_t *least = json_object_get(schema, "minItems");
    const json_t *most = json_object_get(schema, "maxItems");
    size_t i;
    const json_t *item;
    if ((least && (json_int_t)json_array_size(array) < json_integer_value(least)) ||
        (most && (json_int_t)json_array_size(array) > json_integer_value(most)))
        return false;
    json_array_foreach(array, i, item) {
        if (items && !json_schema_accepts(root, items, item))
            return false;
    }
    return true;
}

static bool check_enum(const json_t *words, const json_t *value) {
    size_t i;
    const json_t *word;
    json_array_foreach(words, i, word) {
        if (json_equal((json_t *)word, (json_t *)value))
            return true;
    }
    return false;
}

static bool check_number(const char *keyword, double bound, const json_t *value) {
    double number = json_number_value(value);
    if (!json_is_number(value))
        return true;
    if (strcmp(keyword, "minimum") == 0)
        return number >= bound;
    if (strcmp(keyword, "maximum") == 0)
        return number <= bound;
    return strcmp(keyword, "exclusiveMinimum") == 0 ? number > bound : number < bound;
}

// Words that tell and do not ask, and those that are checked together with others.
static bool is_silent(const char *keyword) {
    static const char *const words[] = {
        "$schema",
        "title",
        "description",
        "markdownDescription",
        "enumDescriptions",
        "default",
        "definitions",
        "properties",
        "patternProperties",
        "additionalProperties",
        "propertyNames",
        "required",
        "items",
        "minItems",
        "maxItems",
        "markdownEnumDescriptions",
        "examples",
    };
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strcmp(keyword, words[i]) == 0)
            return true;
    return false;
}

static bool check_keyword(const json_t *root, const char *keyword, const json_t *operand,
                          const json_t *value) {
    if (is_silent(keyword))
        return true;
    if (strcmp(keyword, "$ref") == 0)
        return json_schema_accepts(root,
                                   json_object_get(json_object_get(root, "definitions"),
                                                   strrchr(json_string_value(operand), '/') + 1),
                                   value);
    if (strcmp(keyword, "type") == 0)
        return check_type(operand, value);
    if (strcmp(keyword, "enum") == 0)
        return check_enum(operand, value);
    if (strcmp(keyword, "const") == 0)
        return json_equal((json_t *)operand, (json_t *)value);
    if (strcmp(keyword, "anyOf") == 0)
        return count_accepting(root, operand, value) > 0;
    if (strcmp(keyword, "oneOf") == 0)
        return count_accepting(root, operand, value) == 1;
    if (strcmp(keyword, "allOf") == 0)
        return count_accepting(root, operand, value) == json_array_size(operand);
    if (strcmp(keyword, "not") == 0)
        return !json_schema_accepts(root, operand, value);
    if (strcmp(keyword, "pattern") == 0)
        return !json_is_string(value) || check_pattern(json_string_value(operand), json_string_value(value));
    if (strcmp(keyword, "minLength") == 0)
        return !json_is_string(value) || json_string_length(value) >= (size_t)json_integer_value(operand);
    return strstr(keyword, "imum") && check_number(keyword, json_number_value(operand), value);
}

bool json_schema_accepts(const json_t *root, const json_t *schema, const json_t *value) {
    const char *keyword;
    const json_t *operand;
    if (json_is_boolean(schema))
        return json_is_true(schema);
    if (!json_is_object(schema))
        return false;
    json_object_foreach((json_t *)schema, keyword, operand) {
        if (!check_keyword(root, keyword, operand, value))
            return false;
    }
    if (json_is_object(value))
        return check_object(root, schema, value);
    return !json_is_array(value) || check_array(root, schema, value);
}

// ---- YAML

static json_t *from_scalar(const struct tree *tree, tree_index node) {
    str text = tree_text(tree, node);
    double number;
    int64_t whole;
    if (tree_node(tree, node)->style == TREE_PLAIN) {
        if (str_equal(text, STR("true")) || str_equal(text, STR("false")))
            return json_boolean(text.ptr[0] == 't');
        if (number_parse_integer(text, &whole) == NUMBER_OK)
            return json_integer(whole);
        if (number_parse(text, &number) == NUMBER_OK)
            return json_real(number);
    }
    return json_stringn(text.ptr, text.len);
}

static json_t *from_node(const struct tree *tree, tree_index node) {
    if (tree_node(tree, node)->kind == TREE_SCALAR)
        return from_scalar(tree, node);
    if (tree_node(tree, node)->kind == TREE_NULL)
        return json_null();
    if (tree_node(tree, node)->kind == TREE_LIST) {
        json_t *array = json_array();
        for (tree_index i = tree_first(tree, node); i; i = tree_next(tree, i))
            json_array_append_new(array, from_node(tree, i));
        return array;
    }
    json_t *object = json_object();
    for (tree_index key = tree_first(tree, node); key; key = tree_next_key(tree, key)) {
        str name = tree_text(tree, key);
        json_object_setn_new(object, name.ptr, name.len, from_node(tree, tree_value(tree, key)));
    }
    return object;
}

json_t *json_from_yaml(str text) {
    struct arena arena;
    struct source_set sources;
    struct diag_sink sink;
    struct tree tree;
    struct limits limits = limits_default();
    arena_init(&arena, (size_t)1 << 28);
    source_set_init(&sources, &arena);
    diag_sink_init(&sink);
    struct reader_context context = {.sources = &sources, .sink = &sink, .limits = &limits, .arena = &arena};
    uint32_t source = source_add(&sources, SOURCE_KIND_OVERLAY, STR("in.yaml"), text);
    json_t *result = NULL;
    if (read_yaml(&context, source, &tree) && tree.root)
        result = from_node(&tree, tree.root);
    diag_sink_finish(&sink);
    arena_finish(&arena);
    return result;
}
