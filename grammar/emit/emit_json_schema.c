// JSON Schema draft-07 for the YAML spelling.
#include "grammar/emit/emit.h"

#include "core/expression.h"
#include "core/heap.h"
#include "core/number.h"
#include "grammar/emit/emit_lines.h"
#include "grammar/emit/emit_words.h"
#include "grammar/ir_values.h"

#include <jansson.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Letters of the language's names as a negated class, so that no Unicode properties are needed: ASCII except
// letters, '_' and '-', then the blocks of spaces, punctuation, symbols, private use.
#define NOT_IN_NAMES                                                                                         \
    "\\u0000-,./:-@\\[-\\^`{-\\u00a9\\u00ab-\\u00b4\\u00b6-\\u00b9\\u00bb-\\u00bf\\u00d7\\u00f7"             \
    "\\u2000-\\u2bff\\u3000-\\u3004\\u3008-\\u3020\\ue000-\\uf8ff\\ufe00-\\ufe6f\\uff00-\\uff20"
#define NAME_PATTERN  "[^0-9" NOT_IN_NAMES "][^" NOT_IN_NAMES "]{0,127}"
#define BODY_PATTERN  NAME_PATTERN EMIT_PLACES_PATTERN
#define WHOLE_PATTERN "^" BODY_PATTERN "(/" BODY_PATTERN ")*$"

static json_t *json_text(struct strbuf *text) {
    json_t *value = text->failed ? NULL : json_stringn(text->data ? text->data : "", text->len);
    strbuf_finish(text);
    return value;
}

static json_t *json_double(double value) {
    return value == floor(value) && fabs(value) < 1e15 ? json_integer((json_int_t)value) : json_real(value);
}

// ---- values

static json_t *number_schema(const struct schema_row *row) {
    const struct schema_range_info *range = schema_range_info(row->range);
    const char *type = row->kind == SCHEMA_INTEGER ? "integer" : "number";
    if (range->magnitude)
        return json_pack("{s:s, s:[{s:o, s:o}, {s:o, s:o}]}", "type", type, "anyOf", "minimum",
                         json_double(range->least), "maximum", json_double(range->greatest), "minimum",
                         json_double(-range->greatest), "maximum", json_double(-range->least));
    return json_pack("{s:s, s:o, s:o}", "type", type, range->open ? "exclusiveMinimum" : "minimum",
                     json_double(range->least), "maximum", json_double(range->greatest));
}

static void add_word(void *list, const char *word) {
    json_array_append_new(list, json_string(word));
}

static json_t *expression_schema(void) {
    json_t *words = json_array();
    emit_no_words(add_word, words);
    return json_pack("{s:s, s:s, s:s, s:{s:o}}", "description", "An expression, as in columns*pitch - 1.",
                     "type", "string", "pattern", "^(" EMIT_EXPRESSION_PATTERN ")$", "not", "enum", words);
}

// An expression may stand in its place.
static json_t *or_expression(const struct schema_row *row, json_t *value) {
    if (row->plain)
        return value;
    json_t *expression = json_pack("{s:s}", "$ref", "#/definitions/expression");
    json_t *forms = json_object_get(value, "anyOf");
    if (!forms || json_object_get(value, "type"))
        return json_pack("{s:[o, o]}", "anyOf", value, expression);
    json_array_append_new(forms, expression);
    return value;
}

static json_t *components_schema(const struct schema_row *row) {
    const char *const *names = schema_components(row->kind);
    json_t *properties = json_object();
    json_t *required = json_array();
    int count = 0;
    for (; names[count]; count++) {
        json_object_set_new(properties, names[count], or_expression(row, number_schema(row)));
        json_array_append_new(required, json_string(names[count]));
    }
    json_t *list = json_pack("{s:s, s:o, s:i, s:i}", "type", "array", "items",
                             or_expression(row, number_schema(row)), "minItems", count, "maxItems", count);
    json_t *map =
        json_pack("{s:s, s:o, s:b}", "type", "object", "properties", properties, "additionalProperties", 0);
    if (row->kind == SCHEMA_WEIGHTS)
        json_decref(required); // a weight that is missing is 0
    else
        json_object_set_new(map, "required", required);
    json_t *forms = json_pack("[o, o]", list, map);
    if (row->fill || row->kind == SCHEMA_COLOR)
        json_array_append_new(forms, number_schema(row));
    if (row->kind == SCHEMA_COLOR)
        json_array_append_new(forms,
                              json_pack("{s:s, s:s}", "type", "string", "pattern", "^" EMIT_HEX_PATTERN "$"));
    json_t *all = json_pack("{s:o}", "anyOf", forms);
    return row->kind == SCHEMA_VECTOR || row->kind == SCHEMA_COLOR || row->fill ? or_expression(row, all)
                                                                                : all;
}

static json_t *word_schema(const struct schema_row *row) {
    json_t *words = json_array();
    json_t *docs = json_array();
    for (uint32_t i = 0; row->words[i]; i++) {
        json_array_append_new(words, json_string(row->words[i]));
        json_array_append_new(docs, json_string(row->word_docs[i]));
    }
    return json_pack("{s:o, s:O, s:o}", "enum", words, "enumDescriptions", docs, "markdownEnumDescriptions",
                     docs);
}

static json_t *text_schema(const struct schema_row *row) {
    const enum schema_text text = row->text;
    if (text == SCHEMA_TEXT_NAME || text == SCHEMA_TEXT_BODY_NAME)
        return json_pack("{s:s, s:s}", "type", "string", "pattern",
                         text == SCHEMA_TEXT_BODY_NAME ? WHOLE_PATTERN
                         : row->counted                ? "^" BODY_PATTERN "$"
                                                       : "^" NAME_PATTERN "$");
    if (text == SCHEMA_TEXT_LIST) {
        json_t *one = json_pack("{s:[s, s], s:i}", "type", "number", "string", "minLength", 1);
        return json_pack("{s:s, s:{s:[O, {s:s, s:o, s:i, s:i}]}, s:i}", "type", "array", "items", "anyOf",
                         one, "type", "array", "items", one, "minItems", 3, "maxItems", 3, "minItems", 1);
    }
    if (text == SCHEMA_TEXT_VALUES) {
        json_t *one = json_pack("{s:[s, s, s], s:i}", "type", "number", "boolean", "string", "minLength", 1);
        return json_pack("{s:[O, {s:s, s:o, s:i, s:i}]}", "anyOf", one, "type", "array", "items", one,
                         "minItems", 1, "maxItems", IR_VALUES_MOST);
    }
    if (text == SCHEMA_TEXT_FREE)
        return json_pack("{s:s}", "type", "string");
    return json_pack("{s:s, s:i}", "type", "string", "minLength", 1);
}

static json_t *element_reference(const struct schema_element *element) {
    struct strbuf address;
    strbuf_init(&address);
    strbuf_format(&address, "#/definitions/%s", element->name);
    return json_pack("{s:o}", "$ref", json_text(&address));
}

static json_t *value_schema(const struct schema_row *row);

// The element as a map, or the value of its short row.
static json_t *item_schema(const struct schema_element *element) {
    const int only = schema_short_row(element), list = schema_list_row(element);
    if (only < 0)
        return element_reference(element);
    json_t *forms = json_pack("[o, o]", value_schema(&element->rows[only]), element_reference(element));
    if (list != only)
        json_array_append_new(forms, value_schema(&element->rows[list]));
    return json_pack("{s:o}", "anyOf", forms);
}

static json_t *list_schema(const struct schema_row *row) {
    if (row->many == SCHEMA_SEQUENCE)
        return json_pack("{s:[s, s], s:o}", "type", "array", "null", "items", item_schema(row->child));
    const struct schema_row *key = &row->child->rows[schema_key_row(row->child)];
    return json_pack("{s:[s, s], s:o, s:o}", "type", "object", "null", "propertyNames", text_schema(key),
                     "additionalProperties", item_schema(row->child));
}

static json_t *value_schema(const struct schema_row *row) {
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        return or_expression(row, json_pack("{s:s}", "type", "boolean"));
    case SCHEMA_INTEGER:
    case SCHEMA_NUMBER:
        return or_expression(row, number_schema(row));
    case SCHEMA_WORD:
        return word_schema(row);
    case SCHEMA_TEXT:
        return text_schema(row);
    case SCHEMA_VECTOR:
    case SCHEMA_PAIR:
    case SCHEMA_POINT:
    case SCHEMA_QUAD:
    case SCHEMA_COLOR:
    case SCHEMA_WEIGHTS:
        return components_schema(row);
    case SCHEMA_ELEMENT:
        return item_schema(row->child);
    case SCHEMA_REFERENCE:
        return json_pack("{s:[{s:s, s:i}, o]}", "anyOf", "type", "string", "minLength", 1,
                         element_reference(row->child));
    case SCHEMA_LIST:
        return list_schema(row);
    }
    return NULL;
}

// ---- rows

static json_t *markdown(const struct schema_element *schema, uint32_t i) {
    const struct schema_row *row = &schema->rows[i];
    struct strbuf text;
    strbuf_init(&text);
    strbuf_format(&text, "%s\n\n*", row->doc);
    emit_type_words(row, &text);
    if (row->range != SCHEMA_RANGE_NONE || row->unit != SCHEMA_UNIT_NONE) {
        strbuf_cstr(&text, "; ");
        emit_range_words(row, &text);
    }
    strbuf_cstr(&text, "*");
    if (row->required)
        strbuf_cstr(&text, "\n\nRequired.");
    size_t before = text.len;
    strbuf_cstr(&text, "\n\nDefault: `");
    size_t begin = text.len;
    emit_default_words(row, &text);
    if (text.len > begin && !row->required)
        strbuf_cstr(&text, "`");
    else if (!text.failed)
        text.len = before;
    for (uint32_t k = 0; row->words && row->words[k]; k++)
        strbuf_format(&text, "%s- `%s`: %s", k ? "\n" : "\n\n", row->words[k], row->word_docs[k]);
    strbuf_cstr(&text, "\n\nXML: `");
    emit_xml_sample(schema, i, &text);
    strbuf_cstr(&text, "`");
    return json_text(&text);
}

// Scene text ("0 1 0") as JSON.
static json_t *literal(const struct schema_row *row, const char *text) {
    json_t *list = json_array();
    str rest = str_from(text);
    double number;
    if (row->kind == SCHEMA_BOOLEAN)
        return json_decref(list), json_boolean(text[0] == 't');
    while (rest.len && row->range != SCHEMA_RANGE_NONE) {
        size_t end = 0;
        while (end < rest.len && rest.ptr[end] != ' ')
            end++;
        if (number_parse(str_slice(rest, 0, end), &number) == NUMBER_OK)
            json_array_append_new(list, json_double(number));
        rest = str_trim(str_slice(rest, end, rest.len));
    }
    json_t *result = json_array_size(list) > 1    ? json_incref(list)
                     : json_array_size(list) == 1 ? json_incref(json_array_get(list, 0))
                                                  : json_string(text);
    json_decref(list);
    return result;
}

static json_t *row_schema(const struct schema_element *schema, uint32_t i) {
    const struct schema_row *row = &schema->rows[i];
    json_t *value = value_schema(row);
    if (row->many == SCHEMA_FIXED)
        value = json_pack("{s:s, s:o, s:i, s:i}", "type", "array", "items", value, "minItems",
                          (int)row->fixed_count, "maxItems", (int)row->fixed_count);
    // Draft-07 ignores what is next to a $ref.
    if (json_object_get(value, "$ref"))
        value = json_pack("{s:[o]}", "allOf", value);
    json_object_set_new(value, "description", json_string(row->doc));
    json_object_set_new(value, "markdownDescription", markdown(schema, i));
    if (row->standard && row->many == SCHEMA_ONE)
        json_object_set_new(value, "default", literal(row, row->standard));
    if (row->example && row->many == SCHEMA_ONE)
        json_object_set_new(value, "examples", json_pack("[o]", literal(row, row->example)));
    return value;
}

// ---- elements

static json_t *required_alone(const struct schema_row *row) {
    return json_pack("{s:[s]}", "required", row->name);
}

// Appends to `rules` the rules by which the rows of choice `c` exclude each other.
static void add_choice(const struct schema_element *schema, uint8_t c, json_t *rules) {
    enum schema_choice_rule rule = schema->choices[c - 1].rule;
    json_t *single = json_array();
    json_t *pairs = json_array();
    for (uint32_t i = 0; i < schema->row_count; i++) {
        if (schema->rows[i].choice != c)
            continue;
        json_array_append_new(single, required_alone(&schema->rows[i]));
        for (uint32_t k = i + 1; k < schema->row_count; k++)
            if (schema->rows[k].choice == c)
                json_array_append_new(
                    pairs, json_pack("{s:[s, s]}", "required", schema->rows[i].name, schema->rows[k].name));
    }
    if (rule == SCHEMA_CHOICE_EXACTLY_ONE)
        json_array_append_new(rules, json_pack("{s:O}", "oneOf", single));
    if (rule == SCHEMA_CHOICE_AT_MOST_ONE)
        json_array_append_new(rules, json_pack("{s:{s:O}}", "not", "anyOf", pairs));
    json_decref(single);
    json_decref(pairs);
}

// `camera: {...}` instead of `cameras: {...}`: the same child under its own name, never both.
static void add_single(const struct schema_element *schema, uint32_t i, json_t *properties, json_t *rules) {
    const struct schema_row *row = &schema->rows[i];
    struct strbuf doc;
    strbuf_init(&doc);
    strbuf_format(&doc, "Short for `%s: {%s: {...}}`. %s", schema_yaml_key(row), row->single,
                  row->child->doc);
    json_t *text = json_text(&doc);
    json_t *value = json_pack("{s:[o]}", "allOf", item_schema(row->child));
    json_object_set_new(value, "description", json_string(row->child->doc));
    json_object_set_new(value, "markdownDescription", text);
    json_object_set_new(properties, row->name, value);
    json_array_append_new(rules,
                          json_pack("{s:{s:[s, s]}}", "not", "required", row->name, schema_yaml_key(row)));
}

static json_t *element_schema(const struct schema_element *schema) {
    json_t *properties = json_object();
    json_t *required = json_array();
    json_t *rules = json_array();
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (row->key)
            continue;
        if (row->single)
            add_single(schema, i, properties, rules);
        json_object_set_new(properties, schema_yaml_key(row), row_schema(schema, i));
        if (row->required)
            json_array_append_new(required, json_string(schema_yaml_key(row)));
    }
    for (uint8_t c = 1; c <= 3; c++)
        add_choice(schema, c, rules);
    json_t *object = json_pack("{s:s, s:s, s:s, s:o}", "type", "object", "description", schema->doc,
                               "markdownDescription", schema->doc, "properties", properties);
    json_object_set_new(object, "additionalProperties", json_false());
    if (json_array_size(required))
        json_object_set(object, "required", required);
    if (json_array_size(rules))
        json_object_set(object, "allOf", rules);
    json_decref(required);
    json_decref(rules);
    return object;
}

void emit_json_schema(struct strbuf *out) {
    json_set_alloc_funcs(heap_alloc, free);
    json_t *root = json_pack("{s:s, s:s}", "$schema", "http://json-schema.org/draft-07/schema#", "title",
                             "A glint scene");
    json_t *scene = element_schema(&SCHEMA_SCENE);
    json_t *definitions = json_object();
    json_object_update(root, scene);
    json_decref(scene);
    // A home for YAML anchors.
    json_object_set_new(root, "patternProperties", json_pack("{s:{}}", "^x-"));
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        if (*e != &SCHEMA_SCENE)
            json_object_set_new(definitions, (*e)->name, element_schema(*e));
    json_object_set_new(definitions, "expression", expression_schema());
    json_object_set_new(root, "definitions", definitions);
    char *text = json_dumps(root, JSON_INDENT(2) | JSON_REAL_PRECISION(15));
    json_decref(root);
    if (text)
        strbuf_cstr(out, text);
    else
        out->failed = true;
    strbuf_char(out, '\n');
    free(text);
}
