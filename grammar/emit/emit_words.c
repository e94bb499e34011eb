#include "grammar/emit/emit_words.h"

#include "grammar/emit/example.h"
#include "grammar/print/ir_print.h"
#include "grammar/print/ir_print_row.h"

#include <string.h>

enum {
    EXAMPLE_BYTES = 16 << 20
};

static void list_words(const char *const *words, const char *separator, struct strbuf *out) {
    for (uint32_t i = 0; words[i]; i++) {
        if (i)
            strbuf_cstr(out, separator);
        strbuf_cstr(out, words[i]);
    }
}

static void text_words(const struct schema_row *row, struct strbuf *out) {
    static const char *const texts[] = {
        [SCHEMA_TEXT_FREE] = "text",
        [SCHEMA_TEXT_NAME] = "name",
        [SCHEMA_TEXT_BODY_NAME] = "name of a body",
        [SCHEMA_TEXT_FOREIGN_NAME] = "name in another file",
        [SCHEMA_TEXT_PATH] = "path",
        [SCHEMA_TEXT_TARGET] = "way to a value",
        [SCHEMA_TEXT_VALUES] = "one to four numbers or expressions",
        [SCHEMA_TEXT_LIST] = "list of values",
    };
    static const char *const files[] = {"", " of a scene file", " of an image file", " of a mesh file",
                                        " of a font"};
    strbuf_cstr(out, texts[row->text]);
    strbuf_cstr(out, files[row->file]);
    if (row->file == SCHEMA_FILE_MESH) {
        strbuf_cstr(out, " (");
        list_words(schema_file_endings(row->file), ", ", out);
        strbuf_cstr(out, ")");
    }
}

void emit_type_words(const struct schema_row *row, struct strbuf *out) {
    if (row->many == SCHEMA_FIXED)
        strbuf_format(out, "list of %u: ", row->fixed_count);
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        strbuf_cstr(out, "true or false");
        break;
    case SCHEMA_INTEGER:
        strbuf_cstr(out, "whole number");
        break;
    case SCHEMA_NUMBER:
        strbuf_cstr(out, "number");
        break;
    case SCHEMA_WORD:
        strbuf_cstr(out, "one of ");
        list_words(row->words, ", ", out);
        break;
    case SCHEMA_TEXT:
        text_words(row, out);
        break;
    case SCHEMA_VECTOR:
        strbuf_cstr(out, row->fill ? "vector x y z, or one number" : "vector x y z");
        break;
    case SCHEMA_PAIR:
        strbuf_cstr(out, row->fill ? "pair u v, or one number" : "pair u v");
        break;
    case SCHEMA_POINT:
        strbuf_cstr(out, "point x y");
        break;
    case SCHEMA_QUAD:
        strbuf_cstr(out, "numbers x y z t");
        break;
    case SCHEMA_COLOR:
        strbuf_cstr(out, "colour r g b, one number, or #rrggbb");
        break;
    case SCHEMA_WEIGHTS:
        strbuf_cstr(out, "weights ");
        list_words(schema_components(row->kind), " ", out);
        break;
    case SCHEMA_ELEMENT:
        if (schema_short_row(row->child) >= 0) {
            emit_type_words(&row->child->rows[schema_short_row(row->child)], out);
            strbuf_cstr(out, "; or ");
        }
        strbuf_cstr(out, row->child->name);
        break;
    case SCHEMA_REFERENCE: {
        const char *a = strchr("aeio", row->child->name[0]) ? "an" : "a";
        strbuf_format(out, "name of %s %s, or %s %s", a, row->child->name, a, row->child->name);
        break;
    }
    case SCHEMA_LIST:
        strbuf_format(out, row->many == SCHEMA_NAMED_MAP ? "%s by %s" : "list of %s", schema_yaml_key(row),
                      row->many == SCHEMA_NAMED_MAP ? row->child->rows[schema_key_row(row->child)].name
                                                    : row->child->name);
        break;
    }
}

void emit_range_words(const struct schema_row *row, struct strbuf *out) {
    static const char *const units[] = {"", "scene units", "degrees", "pixels"};
    if (row->range != SCHEMA_RANGE_NONE)
        strbuf_cstr(out, schema_range_info(row->range)->text);
    if (row->range != SCHEMA_RANGE_NONE && row->unit != SCHEMA_UNIT_NONE)
        strbuf_cstr(out, ", ");
    strbuf_cstr(out, units[row->unit]);
}

void emit_default_words(const struct schema_row *row, struct strbuf *out) {
    _Alignas(16) char memory[128] = {0};
    if (row->kind == SCHEMA_ELEMENT && schema_short_row(row->child) >= 0) {
        emit_default_words(&row->child->rows[schema_short_row(row->child)], out);
        return;
    }
    if (!row->standard)
        return;
    struct schema_row alone = *row;
    alone.offset = 0;
    alone.many = SCHEMA_ONE;
    schema_set_field(&alone, memory, row->standard);
    print_yaml_value(&alone, memory, out);
}

uint32_t emit_rivals(const struct schema_element *schema, uint32_t i, const char *quote, struct strbuf *out) {
    uint32_t count = 0;
    for (uint32_t k = 0; k < schema->row_count; k++) {
        if (k == i || !schema->rows[i].choice || schema->rows[k].choice != schema->rows[i].choice)
            continue;
        strbuf_format(out, "%s%s%s%s", count ? ", " : "", quote, schema->rows[k].name, quote);
        count++;
    }
    return count;
}

typedef void print_row(const struct ir_scene *scene, const struct schema_row *row, const void *element,
                       struct strbuf *out);

static void emit_sample(const struct schema_element *schema, uint32_t i, print_row *print,
                        struct strbuf *out) {
    struct arena arena;
    arena_init(&arena, EXAMPLE_BYTES);
    void *element = arena_alloc(&arena, schema->size);
    schema_init(schema, element);
    example_row(&schema->rows[i], i, element, &arena);
    print(NULL, &schema->rows[i], element, out);
    arena_finish(&arena);
}

// A truth that is computed in the example.
static bool is_computed(const struct schema_row *row) {
    return row->kind == SCHEMA_BOOLEAN && row->example && strcmp(row->example, "true") != 0 &&
           strcmp(row->example, "false") != 0;
}

void emit_yaml_sample(const struct schema_element *schema, uint32_t i, struct strbuf *out) {
    const struct schema_row *row = &schema->rows[i];
    if (is_computed(row)) {
        strbuf_format(out, "%s: %s", row->name, row->example);
        return;
    }
    emit_sample(schema, i, print_yaml_row, out);
}

void emit_xml_sample(const struct schema_element *schema, uint32_t i, struct strbuf *out) {
    const struct schema_row *row = &schema->rows[i];
    if (is_computed(row)) {
        strbuf_format(out, "%s=\"%s\"", row->name, row->example);
        return;
    }
    emit_sample(schema, i, print_xml_row, out);
}

typedef void write_scene(const struct ir_scene *scene, const struct ir_origin *origin,
                         const struct source_set *sources, struct ir_write_options options,
                         struct strbuf *out);

static void emit_example(const struct schema_element *schema, write_scene *write, struct strbuf *out) {
    struct arena arena;
    arena_init(&arena, EXAMPLE_BYTES);
    const struct ir_scene *scene = example_scene(schema, &arena);
    write(scene, NULL, NULL, (struct ir_write_options){.bare = schema != &SCHEMA_SCENE}, out);
    arena_finish(&arena);
}

void emit_yaml_example(const struct schema_element *schema, struct strbuf *out) {
    emit_example(schema, ir_write_yaml, out);
}

void emit_xml_example(const struct schema_element *schema, struct strbuf *out) {
    emit_example(schema, ir_write_xml, out);
}
