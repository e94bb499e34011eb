// The IR as YAML: the canonical dump, and files for people.
#include "grammar/print/ir_print.h"

#include "grammar/ir.h"
#include "grammar/ir_print_text.h"
#include "grammar/ir_values.h"
#include "grammar/ir_walk.h"
#include "grammar/print/ir_print_comment.h"
#include "grammar/print/ir_print_row.h"
#include "grammar/print/print_value.h"

struct yaml_writer {
    const struct ir_scene *scene;
    struct print_places places;
    struct strbuf *out;
    struct strbuf flow; // a piece in flow style, to see whether it fits
    uint32_t width;
    bool canonical;
    bool bare;
};

enum {
    YAML_STEP = 2
};

// ---- flow style: everything on one line

static void flow_element(struct yaml_writer *w, const struct schema_element *schema, const void *element,
                         struct strbuf *out);
static void flow_row(struct yaml_writer *w, const struct schema_row *row, const void *element,
                     struct strbuf *out);

static void flow_item(struct yaml_writer *w, const struct schema_element *schema, const void *item,
                      struct strbuf *out) {
    int only = ir_walk_short(w->scene, schema, item);
    if (only >= 0)
        flow_row(w, &schema->rows[only], item, out);
    else
        flow_element(w, schema, item, out);
}

static void flow_list(struct yaml_writer *w, const struct schema_row *row, const void *element,
                      struct strbuf *out) {
    struct ir_any_list list = ir_walk_list(row, element);
    bool map = row->many == SCHEMA_NAMED_MAP;
    const char *separator = "";
    strbuf_char(out, map ? '{' : '[');
    for (uint32_t i = 0; i < list.count && !out->failed; i++) {
        const void *item = ir_walk_item(row, list, i);
        if (ir_walk_is_anonymous(row->child, item))
            continue;
        strbuf_cstr(out, separator);
        if (map) {
            print_yaml_text(out, ir_walk_key(row->child, item), true);
            strbuf_cstr(out, ": ");
        }
        flow_item(w, row->child, item, out);
        separator = ", ";
    }
    strbuf_char(out, map ? '}' : ']');
}

static void flow_number(struct yaml_writer *w, const struct print_value *v, int component, double number,
                        struct strbuf *out) {
    const struct ir_formula *formula = print_formula(w->scene, v, component);
    if (formula)
        print_yaml_expression(out, formula->text);
    else
        print_number(out, number);
}

static void flow_numbers(struct yaml_writer *w, const struct print_value *v, struct strbuf *out) {
    const struct schema_row *row = v->row;
    const void *field = print_field(v);
    double n[4];
    uint32_t count = ir_walk_components(row, field, n);
    if (row->kind == SCHEMA_COLOR && ((const struct ir_color *)field)->is_hex) {
        strbuf_char(out, '"');
        print_hex_color(out, ((const struct ir_color *)field)->hex);
        strbuf_char(out, '"');
    } else if (print_is_uniform(row, field) && !print_is_computed(w->scene, v)) {
        print_number(out, n[0]);
    } else {
        for (uint32_t i = 0; i < count; i++) {
            strbuf_cstr(out, i ? ", " : "[");
            flow_number(w, v, (int)i, n[i], out);
        }
        strbuf_char(out, ']');
    }
}

static void flow_value(struct yaml_writer *w, const struct print_value *v, struct strbuf *out) {
    const struct schema_row *row = v->row;
    const void *field = print_field(v);
    const struct ir_formula *formula = print_formula(w->scene, v, IR_FORMULA_WHOLE);
    if (formula) {
        print_yaml_expression(out, formula->text);
        return;
    }
    switch (row->kind) {
    case SCHEMA_TEXT:
        if (schema_has_values(row))
            ir_values_yaml(out, *(const str *)field, row->text == SCHEMA_TEXT_LIST);
        else
            print_yaml_text(out, *(const str *)field, true);
        break;
    case SCHEMA_VECTOR:
    case SCHEMA_PAIR:
    case SCHEMA_POINT:
    case SCHEMA_QUAD:
    case SCHEMA_COLOR:
    case SCHEMA_WEIGHTS:
        flow_numbers(w, v, out);
        break;
    case SCHEMA_ELEMENT:
        flow_item(w, row->child, field, out);
        break;
    case SCHEMA_REFERENCE:
        if (ir_walk_is_inline(w->scene, row, field))
            flow_element(w, row->child, ir_walk_referent(w->scene, row, field), out);
        else
            print_yaml_text(out, ((const struct ir_reference *)field)->name, true);
        break;
    default:
        print_plain_value(out, row, field);
        break;
    }
}

// A row's value; several side by side make a list.
static void flow_row(struct yaml_writer *w, const struct schema_row *row, const void *element,
                     struct strbuf *out) {
    if (row->kind == SCHEMA_LIST) {
        flow_list(w, row, element, out);
        return;
    }
    if (row->many != SCHEMA_FIXED) {
        flow_value(w, &(struct print_value){row, element, -1}, out);
        return;
    }
    for (uint32_t i = 0; i < row->fixed_count; i++) {
        strbuf_cstr(out, i ? ", " : "[");
        flow_value(w, &(struct print_value){row, element, (int)i}, out);
    }
    strbuf_char(out, ']');
}

static void flow_element(struct yaml_writer *w, const struct schema_element *schema, const void *element,
                         struct strbuf *out) {
    const char *separator = "{";
    for (uint32_t i = 0; i < schema->row_count && !out->failed; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (row->key || !ir_walk_written(schema, i, element))
            continue;
        strbuf_cstr(out, separator);
        strbuf_cstr(out, schema_yaml_key(row));
        strbuf_cstr(out, ": ");
        flow_row(w, row, element, out);
        separator = ", ";
    }
    strbuf_cstr(out, separator[0] == '{' ? "{}" : "}");
}

// ---- block style

static bool is_body(const struct yaml_writer *w, const struct schema_row *row, const void *field) {
    if (row->kind == SCHEMA_REFERENCE)
        return ir_walk_is_inline(w->scene, row, field);
    return row->kind == SCHEMA_ELEMENT;
}

static const void *body_of(const struct yaml_writer *w, const struct schema_row *row, const void *field) {
    return row->kind == SCHEMA_REFERENCE ? ir_walk_referent(w->scene, row, field) : field;
}

static bool is_empty(const struct schema_element *schema, const void *element) {
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (!schema->rows[i].key && ir_walk_written(schema, i, element))
            return false;
    return true;
}

static void block_rows(struct yaml_writer *w, const struct schema_element *schema, const void *element,
                       uint32_t indent, bool first_is_placed);

// Empties `flow`, and limits it to what is left of the line.
static size_t begin_flow(struct yaml_writer *w) {
    size_t column = print_column(w->out) + 1;
    strbuf_clear(&w->flow);
    w->flow.failed = false;
    w->flow.cap_bytes = (size_t)w->width * 4 + 16;
    return column;
}

static bool end_flow(struct yaml_writer *w, size_t column) {
    str text = strbuf_view(&w->flow);
    // A line of braces is harder to read than a line of text, so it gets less room.
    if (w->flow.failed || column + utf8_count(text) > w->width * 4 / 5)
        return false;
    strbuf_char(w->out, ' ');
    strbuf_str(w->out, text);
    strbuf_char(w->out, '\n');
    return true;
}

// Writes what follows "key:" or "-": on the same line if it is short enough, else below.
static void block_body(struct yaml_writer *w, const struct schema_element *schema, const void *element,
                       uint32_t indent, bool in_sequence) {
    int only = ir_walk_short(w->scene, schema, element);
    bool nothing = is_empty(schema, element);
    if (only >= 0 || nothing) {
        strbuf_char(w->out, ' ');
        flow_item(w, schema, element, w->out);
        strbuf_char(w->out, '\n');
        return;
    }
    if (!w->canonical && !print_has_comments(&w->places, w->scene, schema, element)) {
        size_t column = begin_flow(w);
        flow_element(w, schema, element, &w->flow);
        if (end_flow(w, column))
            return;
    }
    strbuf_char(w->out, in_sequence ? ' ' : '\n');
    block_rows(w, schema, element, indent, in_sequence);
}

static void put_comments(struct yaml_writer *w, span comments, uint32_t indent) {
    if (w->places.origin)
        print_yaml_comments(&w->places, comments, indent, w->out);
}

// The comments before an item of a list, and before its first row, which follows the "-".
static void item_comments(struct yaml_writer *w, const struct schema_row *row, const void *item,
                          uint32_t indent) {
    put_comments(w, print_comments_of_element(&w->places, ir_walk_head(item)), indent);
    if (row->many == SCHEMA_NAMED_MAP)
        return;
    for (uint32_t i = 0; i < row->child->row_count; i++)
        if (!row->child->rows[i].key && ir_walk_written(row->child, i, item)) {
            put_comments(w, print_comments_of_row(&w->places, ir_walk_head(item), i), indent);
            return;
        }
}

static bool all_short(struct yaml_writer *w, const struct schema_row *row, const void *element) {
    struct ir_any_list list = ir_walk_list(row, element);
    for (uint32_t i = 0; i < list.count; i++) {
        const void *item = ir_walk_item(row, list, i);
        if (!ir_walk_is_anonymous(row->child, item) && ir_walk_short(w->scene, row->child, item) < 0)
            return false;
        if (!span_is_none(print_comments_of_element(&w->places, ir_walk_head(item))))
            return false;
    }
    return true;
}

static void block_list(struct yaml_writer *w, const struct schema_row *row, const void *element,
                       uint32_t indent) {
    struct ir_any_list list = ir_walk_list(row, element);
    if (!w->canonical && all_short(w, row, element)) {
        size_t column = begin_flow(w);
        flow_list(w, row, element, &w->flow);
        if (end_flow(w, column))
            return;
    }
    strbuf_char(w->out, '\n');
    for (uint32_t i = 0; i < list.count; i++) {
        const void *item = ir_walk_item(row, list, i);
        if (ir_walk_is_anonymous(row->child, item))
            continue;
        item_comments(w, row, item, indent);
        strbuf_repeat(w->out, ' ', indent);
        if (row->many == SCHEMA_NAMED_MAP) {
            print_yaml_text(w->out, ir_walk_key(row->child, item), true);
            strbuf_char(w->out, ':');
        } else {
            strbuf_char(w->out, '-');
        }
        block_body(w, row->child, item, indent + YAML_STEP, row->many != SCHEMA_NAMED_MAP);
    }
}

// The only item of a named map, if it may be written under the singular key: `camera: {...}`.
static const void *single_item(const struct yaml_writer *w, const struct schema_row *row,
                               const void *element) {
    struct ir_any_list list = ir_walk_list(row, element);
    if (w->canonical || !row->single || list.count != 1)
        return NULL;
    const void *item = ir_walk_item(row, list, 0);
    return str_equal_cstr(ir_walk_key(row->child, item), row->single) ? item : NULL;
}

static void block_row(struct yaml_writer *w, const struct schema_row *row, const void *element,
                      uint32_t indent) {
    const void *field = schema_field_const(row, element);
    const void *single = single_item(w, row, element);
    uint32_t below = indent + YAML_STEP;
    strbuf_cstr(w->out, single ? row->name : schema_yaml_key(row));
    strbuf_char(w->out, ':');
    if (single) {
        block_body(w, row->child, single, below, false);
    } else if (row->kind == SCHEMA_LIST) {
        block_list(w, row, element, below);
    } else if (is_body(w, row, field)) {
        block_body(w, row->child, body_of(w, row, field), below, false);
    } else if (!w->canonical && row->kind == SCHEMA_TEXT && print_yaml_is_literal(*(const str *)field)) {
        strbuf_char(w->out, ' ');
        print_yaml_literal(w->out, *(const str *)field, below);
    } else {
        strbuf_char(w->out, ' ');
        if (row->kind == SCHEMA_TEXT && !schema_has_values(row))
            print_yaml_text(w->out, *(const str *)field, false);
        else
            flow_row(w, row, element, w->out);
        strbuf_char(w->out, '\n');
    }
}

static void row_comments(struct yaml_writer *w, const struct schema_element *schema, uint32_t i,
                         const void *element, uint32_t indent) {
    const struct schema_row *row = &schema->rows[i];
    const void *single = single_item(w, row, element);
    put_comments(w, print_comments_of_list_row(&w->places, schema, i, element), indent);
    const void *field = schema_field_const(row, element);
    if (single)
        put_comments(w, print_comments_of_element(&w->places, ir_walk_head(single)), indent);
    else if (is_body(w, row, field))
        put_comments(w, print_comments_of_element(&w->places, ir_walk_head(body_of(w, row, field))), indent);
}

static void block_rows(struct yaml_writer *w, const struct schema_element *schema, const void *element,
                       uint32_t indent, bool first_is_placed) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (row->key || !ir_walk_written(schema, i, element))
            continue;
        if (!first_is_placed) {
            row_comments(w, schema, i, element, indent);
            strbuf_repeat(w->out, ' ', indent);
        }
        first_is_placed = false;
        block_row(w, row, element, indent);
    }
}

static void write_root(struct yaml_writer *w) {
    const struct schema_element *schema = &SCHEMA_SCENE;
    bool is_first = true;
    bool was_section = false;
    put_comments(w, print_comments_of_element(&w->places, &w->scene->head), 0);
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (!ir_walk_written(schema, i, w->scene))
            continue;
        bool is_section = row->kind == SCHEMA_ELEMENT || row->kind == SCHEMA_LIST;
        if (!is_first && (is_section || was_section) && !w->canonical && !w->bare)
            strbuf_char(w->out, '\n');
        row_comments(w, schema, i, w->scene, 0);
        block_row(w, row, w->scene, 0);
        was_section = is_section;
        is_first = false;
    }
}

void ir_dump(const struct ir_scene *scene, struct strbuf *out) {
    struct yaml_writer w = {.scene = scene, .out = out, .width = 100, .canonical = true};
    strbuf_init(&w.flow);
    write_root(&w);
    strbuf_finish(&w.flow);
}

void ir_write_yaml(const struct ir_scene *scene, const struct ir_origin *origin,
                   const struct source_set *sources, struct ir_write_options options, struct strbuf *out) {
    struct yaml_writer w = {.scene = scene,
                            .places = {sources ? origin : NULL, sources, SPAN_NONE},
                            .out = out,
                            .width = options.width ? options.width : 100,
                            .bare = options.bare};
    const struct ir_file_origin *file = print_file_of(&w.places, scene);
    strbuf_init(&w.flow);
    if (!options.bare)
        print_yaml_schema_line(&w.places, file, out);
    write_root(&w);
    if (file && !span_is_none(file->closing_comments)) {
        strbuf_char(out, '\n');
        put_comments(&w, file->closing_comments, 0);
    }
    strbuf_finish(&w.flow);
}

void print_yaml_value(const struct schema_row *row, const void *element, struct strbuf *out) {
    struct yaml_writer w = {.out = out};
    flow_row(&w, row, element, out);
}

void print_yaml_item(const struct ir_scene *scene, const struct schema_element *schema, const void *item,
                     struct strbuf *out) {
    struct yaml_writer w = {.scene = scene, .out = out};
    flow_item(&w, schema, item, out);
}

void print_yaml_row(const struct ir_scene *scene, const struct schema_row *row, const void *element,
                    struct strbuf *out) {
    struct yaml_writer w = {.scene = scene, .out = out};
    if (!row->key) {
        strbuf_cstr(out, schema_yaml_key(row));
        strbuf_cstr(out, ": ");
    }
    flow_row(&w, row, element, out);
    if (row->key)
        strbuf_char(out, ':');
}
