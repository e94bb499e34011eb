// The IR as XML.
#include "grammar/print/ir_print.h"

#include "grammar/ir_print_text.h"
#include "grammar/ir_value.h"
#include "grammar/ir_walk.h"
#include "grammar/print/ir_print_comment.h"
#include "grammar/print/ir_print_row.h"
#include "grammar/print/print_value.h"

struct xml_writer {
    const struct ir_scene *scene;
    struct print_places places;
    struct strbuf *out;
    struct strbuf line; // an element on one line, to see whether it fits
    uint32_t width;
};

enum {
    XML_STEP = 2
};

// An element to write, without its place.
struct xml_node {
    const char *tag;
    const struct schema_element *schema;
    const void *element;
    const char *unnamed; // the name that is not written; NULL: write every name
};

static bool value_is_attribute(const struct xml_writer *w, const struct print_value *v) {
    const struct schema_row *row = v->row;
    const void *field = print_field(v);
    if (print_is_computed(w->scene, v))
        return print_formula(w->scene, v, IR_FORMULA_WHOLE) != NULL;
    switch (row->kind) {
    case SCHEMA_COLOR:
        return ((const struct ir_color *)field)->is_hex || print_is_uniform(row, field);
    case SCHEMA_VECTOR:
    case SCHEMA_PAIR:
    case SCHEMA_POINT:
        return print_is_uniform(row, field);
    case SCHEMA_REFERENCE:
        return !ir_walk_is_inline(w->scene, row, field);
    case SCHEMA_ELEMENT: {
        int only = ir_walk_short(w->scene, row->child, field);
        const struct schema_row *inner = only >= 0 ? &row->child->rows[only] : NULL;
        return inner && value_is_attribute(w, &(struct print_value){inner, field, -1});
    }
    case SCHEMA_WEIGHTS:
    case SCHEMA_QUAD:
    case SCHEMA_LIST:
        return false;
    default:
        return true;
    }
}

// Whether a written row goes into the start tag; the others are child elements.
static bool is_attribute(const struct xml_writer *w, const struct schema_row *row, const void *element) {
    const struct print_value v = {row, element, -1};
    // A whole vector that is computed is one.
    if (row->kind == SCHEMA_VECTOR && row->many == SCHEMA_ONE &&
        print_formula(w->scene, &v, IR_FORMULA_WHOLE))
        return true;
    return schema_is_attribute(row) && value_is_attribute(w, &v);
}

static void put_attribute_value(const struct xml_writer *w, const struct print_value *v, struct strbuf *out) {
    const struct schema_row *row = v->row;
    const void *field = print_field(v);
    const struct ir_formula *formula = print_formula(w->scene, v, IR_FORMULA_WHOLE);
    double n[4];
    if (formula) {
        print_xml_text(out, formula->text);
        return;
    }
    switch (row->kind) {
    case SCHEMA_TEXT:
        print_xml_text(out, *(const str *)field);
        break;
    case SCHEMA_REFERENCE: // to a name that need not be one: only this file is read
        print_xml_text(out, ((const struct ir_reference *)field)->name);
        break;
    case SCHEMA_COLOR:
    case SCHEMA_VECTOR:
    case SCHEMA_PAIR:
    case SCHEMA_POINT:
        if (row->kind == SCHEMA_COLOR && ((const struct ir_color *)field)->is_hex) {
            print_hex_color(out, ((const struct ir_color *)field)->hex);
        } else {
            ir_walk_components(row, field, n);
            print_number(out, n[0]);
        }
        break;
    case SCHEMA_ELEMENT: {
        const struct schema_row *inner = &row->child->rows[schema_short_row(row->child)];
        put_attribute_value(w, &(struct print_value){inner, field, -1}, out);
        break;
    }
    default:
        print_plain_value(out, row, field);
        break;
    }
}

static void put_pair(struct strbuf *out, const char *name) {
    strbuf_char(out, ' ');
    strbuf_cstr(out, name);
    strbuf_cstr(out, "=\"");
}

static void put_attributes(const struct xml_writer *w, const struct xml_node *node, struct strbuf *out) {
    for (uint32_t i = 0; i < node->schema->row_count; i++) {
        const struct schema_row *row = &node->schema->rows[i];
        if (!ir_walk_written(node->schema, i, node->element) || !is_attribute(w, row, node->element))
            continue;
        if (row->key && node->unnamed &&
            str_equal_cstr(ir_walk_key(node->schema, node->element), node->unnamed))
            continue;
        put_pair(out, row->name);
        put_attribute_value(w, &(struct print_value){row, node->element, -1}, out);
        strbuf_char(out, '"');
    }
}

// The components of a vector, colour or weights as attributes. Weights that are 0 may be left out.
static void put_components(const struct xml_writer *w, const struct print_value *v, struct strbuf *out) {
    const struct schema_row *row = v->row;
    const void *field = print_field(v);
    const char *const *names = schema_components(row->kind);
    double n[4];
    const struct ir_formula *whole = print_formula(w->scene, v, IR_FORMULA_WHOLE);
    if (whole) {
        put_pair(out, SCHEMA_HEX_ATTRIBUTE);
        print_xml_text(out, whole->text);
        strbuf_char(out, '"');
        return;
    }
    if (row->kind == SCHEMA_COLOR && ((const struct ir_color *)field)->is_hex) {
        put_pair(out, SCHEMA_HEX_ATTRIBUTE);
        print_hex_color(out, ((const struct ir_color *)field)->hex);
        strbuf_char(out, '"');
        return;
    }
    uint32_t count = ir_walk_components(row, field, n);
    bool all_zero = true;
    for (uint32_t i = 0; i < count; i++)
        all_zero = all_zero && n[i] == 0 && !print_formula(w->scene, v, (int)i);
    for (uint32_t i = 0; i < count; i++) {
        const struct ir_formula *formula = print_formula(w->scene, v, (int)i);
        if (row->kind == SCHEMA_WEIGHTS && n[i] == 0 && !formula && !(all_zero && i == 0))
            continue;
        put_pair(out, names[i]);
        if (formula)
            print_xml_text(out, formula->text);
        else
            print_number(out, n[i]);
        strbuf_char(out, '"');
    }
}

// The row whose components are the attributes of the element itself: `<DiffuseColor r= g= b=/>`.
static const struct schema_row *own_components(const struct xml_writer *w, const struct xml_node *node) {
    int only = ir_walk_short(w->scene, node->schema, node->element);
    bool has = only >= 0 && schema_components(node->schema->rows[only].kind)[0];
    return has ? &node->schema->rows[only] : NULL;
}

typedef void xml_visit(struct xml_writer *w, const struct xml_node *node, uint32_t indent,
                       struct strbuf *out);

static void put_leaf(const struct xml_writer *w, const struct print_value *v, uint32_t indent,
                     struct strbuf *out) {
    strbuf_repeat(out, ' ', indent);
    strbuf_char(out, '<');
    strbuf_cstr(out, v->row->element);
    put_components(w, v, out);
    strbuf_cstr(out, "/>");
}

// The child elements of one row; `visit` writes those that are elements of the table.
static void put_children(struct xml_writer *w, const struct schema_row *row, const void *element,
                         uint32_t indent, const char *line_end, xml_visit *visit, struct strbuf *out) {
    const char *field = schema_field_const(row, element);
    if (row->kind == SCHEMA_LIST) {
        struct ir_any_list list = ir_walk_list(row, element);
        for (uint32_t i = 0; i < list.count; i++) {
            const void *item = ir_walk_item(row, list, i);
            if (!ir_walk_is_anonymous(row->child, item))
                visit(w, &(struct xml_node){row->element, row->child, item, row->single}, indent, out);
        }
    } else if (row->kind == SCHEMA_ELEMENT) {
        visit(w, &(struct xml_node){row->element, row->child, field, NULL}, indent, out);
    } else if (row->kind == SCHEMA_REFERENCE) {
        const void *body = ir_walk_referent(w->scene, row, (const void *)field);
        visit(w, &(struct xml_node){row->element, row->child, body, NULL}, indent, out);
    } else {
        for (uint32_t i = 0; i < (row->many == SCHEMA_FIXED ? row->fixed_count : 1); i++) {
            put_leaf(w, &(struct print_value){row, element, row->many == SCHEMA_FIXED ? (int)i : -1}, indent,
                     out);
            strbuf_cstr(out, line_end);
        }
    }
}

static bool has_children(const struct xml_writer *w, const struct xml_node *node) {
    for (uint32_t i = 0; i < node->schema->row_count; i++)
        if (ir_walk_written(node->schema, i, node->element) &&
            !is_attribute(w, &node->schema->rows[i], node->element))
            return true;
    return false;
}

// Opens the tag; true if it was closed at once.
static bool begin_element(struct xml_writer *w, const struct xml_node *node, struct strbuf *out) {
    const struct schema_row *own = own_components(w, node);
    strbuf_char(out, '<');
    strbuf_cstr(out, node->tag);
    if (own) {
        put_components(w, &(struct print_value){own, node->element, -1}, out);
    } else {
        put_attributes(w, node, out);
        if (has_children(w, node)) {
            strbuf_char(out, '>');
            return false;
        }
    }
    strbuf_cstr(out, "/>");
    return true;
}

static void end_element(const struct xml_node *node, struct strbuf *out) {
    strbuf_cstr(out, "</");
    strbuf_cstr(out, node->tag);
    strbuf_char(out, '>');
}

static void put_on_one_line(struct xml_writer *w, const struct xml_node *node, uint32_t indent,
                            struct strbuf *out) {
    (void)indent;
    if (out->failed || begin_element(w, node, out))
        return;
    for (uint32_t i = 0; i < node->schema->row_count; i++)
        if (ir_walk_written(node->schema, i, node->element) &&
            !is_attribute(w, &node->schema->rows[i], node->element))
            put_children(w, &node->schema->rows[i], node->element, 0, "", put_on_one_line, out);
    end_element(node, out);
}

static void put_comments(struct xml_writer *w, span comments, uint32_t indent) {
    if (w->places.origin)
        print_xml_comments(&w->places, comments, indent, w->out);
}

// Comments before the element and, since attributes cannot have comments, before rows that became attributes.
static void node_comments(struct xml_writer *w, const struct xml_node *node, uint32_t indent) {
    const struct ir_head *head = ir_walk_head(node->element);
    put_comments(w, print_comments_of_element(&w->places, head), indent);
    for (uint32_t i = 0; i < node->schema->row_count; i++) {
        const struct schema_row *row = &node->schema->rows[i];
        if (!ir_walk_written(node->schema, i, node->element) || !is_attribute(w, row, node->element))
            continue;
        put_comments(w, print_comments_of_row(&w->places, head, i), indent);
        if (row->kind == SCHEMA_ELEMENT)
            node_comments(
                w, &(struct xml_node){row->element, row->child, schema_field_const(row, node->element), NULL},
                indent);
    }
}

// Whether there are comments before a row that becomes a child element, so that it needs lines of its own.
static bool child_has_comments(const struct xml_writer *w, const struct xml_node *node) {
    for (uint32_t i = 0; i < node->schema->row_count; i++)
        if (ir_walk_written(node->schema, i, node->element) &&
            !is_attribute(w, &node->schema->rows[i], node->element) &&
            print_row_has_comments(&w->places, w->scene, node->schema, i, node->element))
            return true;
    return false;
}

static bool fits_one_line(struct xml_writer *w, const struct xml_node *node, uint32_t indent) {
    if (child_has_comments(w, node))
        return false;
    strbuf_clear(&w->line);
    w->line.failed = false;
    w->line.cap_bytes = (size_t)w->width * 4 + 16;
    put_on_one_line(w, node, 0, &w->line);
    return !w->line.failed && indent + utf8_count(strbuf_view(&w->line)) <= w->width;
}

static void put_rows(struct xml_writer *w, const struct xml_node *node, uint32_t indent, bool sections);

static void put_element(struct xml_writer *w, const struct xml_node *node, uint32_t indent,
                        struct strbuf *out) {
    node_comments(w, node, indent);
    strbuf_repeat(out, ' ', indent);
    if (fits_one_line(w, node, indent)) {
        strbuf_str(out, strbuf_view(&w->line));
    } else if (!begin_element(w, node, out)) {
        strbuf_char(out, '\n');
        put_rows(w, node, indent + XML_STEP, false);
        strbuf_repeat(out, ' ', indent);
        end_element(node, out);
    }
    strbuf_char(out, '\n');
}

// The child elements, row by row; `sections`: an empty line before each row.
static void put_rows(struct xml_writer *w, const struct xml_node *node, uint32_t indent, bool sections) {
    bool is_first = true;
    for (uint32_t i = 0; i < node->schema->row_count; i++) {
        const struct schema_row *row = &node->schema->rows[i];
        if (!ir_walk_written(node->schema, i, node->element) || is_attribute(w, row, node->element))
            continue;
        if (!is_first && sections)
            strbuf_char(w->out, '\n');
        is_first = false;
        span comments = print_comments_of_list_row(&w->places, node->schema, i, node->element);
        put_comments(w, comments, indent);
        put_children(w, row, node->element, indent, "\n", put_element, w->out);
    }
}

static void put_root_start(struct xml_writer *w, const struct xml_node *root,
                           const struct ir_file_origin *file) {
    strbuf_char(w->out, '<');
    strbuf_cstr(w->out, root->tag);
    if (file && file->xsi_attributes.len) {
        strbuf_char(w->out, ' ');
        strbuf_str(w->out, str_trim(file->xsi_attributes));
    }
    put_attributes(w, root, w->out);
    strbuf_cstr(w->out, ">\n");
}

void ir_write_xml(const struct ir_scene *scene, const struct ir_origin *origin,
                  const struct source_set *sources, struct ir_write_options options, struct strbuf *out) {
    struct xml_writer w = {.scene = scene,
                           .places = {sources ? origin : NULL, sources, SPAN_NONE},
                           .out = out,
                           .width = options.width ? options.width : 100};
    const struct xml_node root = {SCHEMA_SCENE.element, &SCHEMA_SCENE, scene, NULL};
    const struct ir_file_origin *file = print_file_of(&w.places, scene);
    strbuf_init(&w.line);
    if (options.bare) {
        put_rows(&w, &root, 0, false);
    } else {
        strbuf_cstr(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
        print_xml_schema_line(&w.places, file, out);
        node_comments(&w, &root, 0);
        put_root_start(&w, &root, file);
        put_rows(&w, &root, XML_STEP, true);
        if (file && !span_is_none(file->closing_comments)) {
            strbuf_char(out, '\n');
            put_comments(&w, file->closing_comments, XML_STEP);
        }
        end_element(&root, out);
        strbuf_char(out, '\n');
    }
    strbuf_finish(&w.line);
}

void print_xml_row(const struct ir_scene *scene, const struct schema_row *row, const void *element,
                   struct strbuf *out) {
    struct xml_writer w = {.scene = scene, .out = out};
    if (!is_attribute(&w, row, element)) {
        put_children(&w, row, element, 0, "", put_on_one_line, out);
        return;
    }
    strbuf_cstr(out, row->name);
    strbuf_cstr(out, "=\"");
    put_attribute_value(&w, &(struct print_value){row, element, -1}, out);
    strbuf_char(out, '"');
}
