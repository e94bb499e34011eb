// The IR as JSON, which is YAML too: for files that end in .json, and for other programs.
#include "grammar/print/ir_print.h"

#include "grammar/ir_print_text.h"
#include "grammar/ir_value.h"
#include "grammar/ir_values.h"
#include "grammar/ir_walk.h"
#include "grammar/print/print_value.h"
#include "grammar/schema.h"

struct json_writer {
    const struct ir_scene *scene;
    struct strbuf *out;
};

enum {
    JSON_STEP = 2
};

static void put_line(struct json_writer *w, uint32_t indent) {
    strbuf_char(w->out, '\n');
    strbuf_repeat(w->out, ' ', indent);
}

static void put_key(struct json_writer *w, str key) {
    print_json_text(w->out, key);
    strbuf_cstr(w->out, ": ");
}

static void put_element(struct json_writer *w, const struct schema_element *schema, const void *element,
                        uint32_t indent);

static void put_number(struct json_writer *w, const struct print_value *v, int component, double number) {
    const struct ir_formula *formula = print_formula(w->scene, v, component);
    if (formula)
        print_json_text(w->out, formula->text);
    else
        print_number(w->out, number);
}

static void put_numbers(struct json_writer *w, const struct print_value *v) {
    const struct schema_row *row = v->row;
    const void *field = print_field(v);
    double n[4];
    uint32_t count = ir_walk_components(row, field, n);
    if (row->kind == SCHEMA_COLOR && ((const struct ir_color *)field)->is_hex) {
        strbuf_char(w->out, '"');
        print_hex_color(w->out, ((const struct ir_color *)field)->hex);
        strbuf_char(w->out, '"');
        return;
    }
    if (print_is_uniform(row, field) && !print_is_computed(w->scene, v)) {
        print_number(w->out, n[0]);
        return;
    }
    for (uint32_t i = 0; i < count; i++) {
        strbuf_cstr(w->out, i ? ", " : "[");
        put_number(w, v, (int)i, n[i]);
    }
    strbuf_char(w->out, ']');
}

static void put_value(struct json_writer *w, const struct print_value *v, uint32_t indent) {
    const struct schema_row *row = v->row;
    const void *field = print_field(v);
    const struct ir_formula *formula = print_formula(w->scene, v, IR_FORMULA_WHOLE);
    if (formula) {
        print_json_text(w->out, formula->text);
        return;
    }
    switch (row->kind) {
    case SCHEMA_WORD:
        print_json_text(w->out, str_from(row->words[*(const unsigned *)field]));
        break;
    case SCHEMA_TEXT:
        if (schema_has_values(row))
            ir_values_json(w->out, *(const str *)field, row->text == SCHEMA_TEXT_LIST);
        else
            print_json_text(w->out, *(const str *)field);
        break;
    case SCHEMA_VECTOR:
    case SCHEMA_PAIR:
    case SCHEMA_POINT:
    case SCHEMA_QUAD:
    case SCHEMA_COLOR:
    case SCHEMA_WEIGHTS:
        put_numbers(w, v);
        break;
    case SCHEMA_ELEMENT:
        put_element(w, row->child, field, indent);
        break;
    case SCHEMA_REFERENCE:
        if (ir_walk_is_inline(w->scene, row, field))
            put_element(w, row->child, ir_walk_referent(w->scene, row, field), indent);
        else
            print_json_text(w->out, ((const struct ir_reference *)field)->name);
        break;
    default:
        print_plain_value(w->out, row, field);
        break;
    }
}

static void put_list(struct json_writer *w, const struct schema_row *row, const void *element,
                     uint32_t indent) {
    struct ir_any_list list = ir_walk_list(row, element);
    bool map = row->many == SCHEMA_NAMED_MAP;
    bool is_first = true;
    strbuf_char(w->out, map ? '{' : '[');
    for (uint32_t i = 0; i < list.count; i++) {
        const void *item = ir_walk_item(row, list, i);
        if (ir_walk_is_anonymous(row->child, item))
            continue;
        if (!is_first)
            strbuf_char(w->out, ',');
        is_first = false;
        put_line(w, indent + JSON_STEP);
        if (map)
            put_key(w, ir_walk_key(row->child, item));
        put_element(w, row->child, item, indent + JSON_STEP);
    }
    put_line(w, indent);
    strbuf_char(w->out, map ? '}' : ']');
}

static void put_row(struct json_writer *w, const struct schema_row *row, const void *element,
                    uint32_t indent) {
    if (row->kind == SCHEMA_LIST) {
        put_list(w, row, element, indent);
    } else if (row->many == SCHEMA_FIXED) {
        for (uint32_t i = 0; i < row->fixed_count; i++) {
            strbuf_cstr(w->out, i ? ", " : "[");
            put_value(w, &(struct print_value){row, element, (int)i}, indent);
        }
        strbuf_char(w->out, ']');
    } else {
        put_value(w, &(struct print_value){row, element, -1}, indent);
    }
}

static void put_element(struct json_writer *w, const struct schema_element *schema, const void *element,
                        uint32_t indent) {
    int only = ir_walk_short(w->scene, schema, element);
    bool is_first = true;
    if (only >= 0) {
        put_row(w, &schema->rows[only], element, indent);
        return;
    }
    strbuf_char(w->out, '{');
    for (uint32_t i = 0; i < schema->row_count && !w->out->failed; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (row->key || !ir_walk_written(schema, i, element))
            continue;
        if (!is_first)
            strbuf_char(w->out, ',');
        is_first = false;
        put_line(w, indent + JSON_STEP);
        put_key(w, str_from(schema_yaml_key(row)));
        put_row(w, row, element, indent + JSON_STEP);
    }
    if (!is_first)
        put_line(w, indent);
    strbuf_char(w->out, '}');
}

void ir_write_json(const struct ir_scene *scene, struct strbuf *out) {
    struct json_writer w = {scene, out};
    put_element(&w, &SCHEMA_SCENE, scene, 0);
    strbuf_char(out, '\n');
}
