// RELAX NG (XML syntax) for the XML spelling: attributes and children in any order.
#include "grammar/emit/emit.h"

#include "grammar/emit/emit_lines.h"
#include "grammar/ir_print_text.h"

#include <string.h>

static void documentation(struct emit_lines *w, const char *doc) {
    emit_indent(w);
    strbuf_cstr(w->out, "<a:documentation>");
    print_xml_text(w->out, str_from(doc));
    strbuf_cstr(w->out, "</a:documentation>\n");
}

static void number_reference(struct emit_lines *w, const struct schema_row *row) {
    emit_line(w, "<ref name=\"number_%s\"/>", schema_range_info(row->range)->name);
}

// ---- data

static void number_data(struct emit_lines *w, bool integer, double least, double greatest, bool open) {
    emit_open(w, "<data type=\"%s\">", integer ? "integer" : "double");
    if (!integer)
        emit_line(w, "<param name=\"pattern\">" EMIT_NUMBER_PATTERN "</param>");
    for (int end = 0; end < 2; end++) {
        const char *name =
            end ? (open ? "maxExclusive" : "maxInclusive") : (open ? "minExclusive" : "minInclusive");
        emit_indent(w);
        strbuf_format(w->out, "<param name=\"%s\">", name);
        print_number(w->out, end ? greatest : least);
        strbuf_cstr(w->out, "</param>\n");
    }
    emit_close(w, "data");
}

static void number_definitions(struct emit_lines *w) {
    for (enum schema_range range = SCHEMA_RANGE_NONE + 1; range < SCHEMA_RANGE_COUNT; range++) {
        const struct schema_range_info *info = schema_range_info(range);
        bool integer = emit_is_integer(range);
        emit_open(w, "<define name=\"number_%s\">", info->name);
        if (info->magnitude) {
            emit_open(w, "<choice>");
            number_data(w, integer, info->least, info->greatest, info->open);
            number_data(w, integer, -info->greatest, -info->least, info->open);
            emit_close(w, "choice");
        } else {
            number_data(w, integer, info->least, info->greatest, info->open);
        }
        emit_close(w, "define");
    }
}

static void text_definitions(struct emit_lines *w) {
    emit_open(w, "<define name=\"boolean\">");
    emit_line(w, "<choice><value type=\"string\">true</value><value type=\"string\">false</value></choice>");
    emit_close(w, "define");
    emit_open(w, "<define name=\"hex_color\">");
    emit_line(w, "<data type=\"string\"><param name=\"pattern\">" EMIT_HEX_PATTERN "</param></data>");
    emit_close(w, "define");
    emit_open(w, "<define name=\"name\">");
    emit_line(w, "<data type=\"string\"><param name=\"pattern\">" EMIT_NAME_PATTERN "</param></data>");
    emit_close(w, "define");
    emit_open(w, "<define name=\"some_text\">");
    emit_line(w, "<data type=\"string\"><param name=\"minLength\">1</param></data>");
    emit_close(w, "define");
}

// ---- values of attributes

static void attribute_data(struct emit_lines *w, const struct schema_row *row) {
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        emit_line(w, "<ref name=\"boolean\"/>");
        break;
    case SCHEMA_WORD:
        emit_open(w, "<choice>");
        for (uint32_t i = 0; row->words[i]; i++) {
            emit_line(w, "<value type=\"string\">%s</value>", row->words[i]);
            documentation(w, row->word_docs[i]);
        }
        emit_close(w, "choice");
        break;
    case SCHEMA_TEXT:
        emit_line(w, row->text == SCHEMA_TEXT_NAME   ? "<ref name=\"name\"/>"
                     : row->text == SCHEMA_TEXT_FREE ? "<data type=\"string\"/>"
                                                     : "<ref name=\"some_text\"/>");
        break;
    case SCHEMA_COLOR:
        emit_open(w, "<choice>");
        number_reference(w, row);
        emit_line(w, "<ref name=\"hex_color\"/>");
        emit_close(w, "choice");
        break;
    case SCHEMA_ELEMENT:
        attribute_data(w, &row->child->rows[schema_short_row(row->child)]);
        break;
    case SCHEMA_REFERENCE:
        emit_line(w, "<ref name=\"some_text\"/>");
        break;
    default:
        number_reference(w, row);
        break;
    }
}

static void attribute(struct emit_lines *w, const struct schema_row *row) {
    emit_open(w, "<attribute name=\"%s\">", row->name);
    documentation(w, row->doc);
    attribute_data(w, row);
    emit_close(w, "attribute");
}

// ---- child elements

static void component_attributes(struct emit_lines *w, const struct schema_row *row) {
    const char *const *names = schema_components(row->kind);
    bool may_lack = row->kind == SCHEMA_WEIGHTS;
    if (row->kind == SCHEMA_COLOR)
        emit_open(w, "<choice>");
    emit_open(w, "<group>");
    for (uint32_t i = 0; names[i]; i++) {
        if (may_lack)
            emit_open(w, "<optional>");
        emit_open(w, "<attribute name=\"%s\">", names[i]);
        number_reference(w, row);
        emit_close(w, "attribute");
        if (may_lack)
            emit_close(w, "optional");
    }
    emit_close(w, "group");
    if (row->kind != SCHEMA_COLOR)
        return;
    emit_line(w, "<attribute name=\"" SCHEMA_HEX_ATTRIBUTE "\"><ref name=\"hex_color\"/></attribute>");
    emit_close(w, "choice");
}

// What stands inside the element of a row with a child: its rows, or those of its short row alone.
static void child_content(struct emit_lines *w, const struct schema_row *row) {
    int only = schema_short_row(row->child);
    bool has_components = only >= 0 && schema_components(row->child->rows[only].kind)[0];
    if (has_components)
        emit_open(w, "<choice>");
    emit_line(w, "<ref name=\"%s\"/>", row->child->name);
    if (has_components) {
        component_attributes(w, &row->child->rows[only]);
        emit_close(w, "choice");
    }
    int key = row->many == SCHEMA_NAMED_MAP ? schema_key_row(row->child) : -1;
    if (key < 0)
        return;
    if (row->single)
        emit_open(w, "<optional>");
    attribute(w, &row->child->rows[key]);
    if (row->single)
        emit_close(w, "optional");
}

static void child_element(struct emit_lines *w, const struct schema_row *row) {
    emit_open(w, "<element name=\"%s\">", row->element);
    documentation(w, row->doc);
    if (row->child)
        child_content(w, row);
    else
        component_attributes(w, row);
    emit_close(w, "element");
}

// ---- rows and elements

static void row_pattern(struct emit_lines *w, const struct schema_row *row) {
    bool both = schema_is_attribute(row) && row->element;
    if (row->kind == SCHEMA_LIST) {
        emit_open(w, "<zeroOrMore>");
        child_element(w, row);
        emit_close(w, "zeroOrMore");
        return;
    }
    if (row->many == SCHEMA_FIXED) {
        emit_open(w, "<group>");
        for (uint32_t i = 0; i < row->fixed_count; i++)
            child_element(w, row);
        emit_close(w, "group");
        return;
    }
    if (both)
        emit_open(w, "<choice>");
    if (schema_is_attribute(row))
        attribute(w, row);
    if (row->element)
        child_element(w, row);
    if (both)
        emit_close(w, "choice");
}

static void choice_pattern(struct emit_lines *w, const struct schema_element *schema, uint8_t choice) {
    bool optional = schema->choices[choice - 1].rule == SCHEMA_CHOICE_AT_MOST_ONE;
    if (optional)
        emit_open(w, "<optional>");
    emit_open(w, "<choice>");
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (schema->rows[i].choice == choice)
            row_pattern(w, &schema->rows[i]);
    emit_close(w, "choice");
    if (optional)
        emit_close(w, "optional");
}

static void element_definition(struct emit_lines *w, const struct schema_element *schema) {
    emit_open(w, "<define name=\"%s\">", schema->name);
    emit_open(w, "<interleave>");
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        // A key stands where the element is one of a list; an element in place has none.
        if (row->key)
            continue;
        if (row->choice) {
            if (emit_is_first_of_choice(schema, i))
                choice_pattern(w, schema, row->choice);
            continue;
        }
        bool optional = !row->required && row->kind != SCHEMA_LIST;
        if (optional)
            emit_open(w, "<optional>");
        row_pattern(w, row);
        if (optional)
            emit_close(w, "optional");
    }
    emit_close(w, "interleave");
    emit_close(w, "define");
}

void emit_relaxng(struct strbuf *out) {
    struct emit_lines w = {.out = out};
    emit_line(&w, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    emit_line(&w, "<grammar xmlns=\"http://relaxng.org/ns/structure/1.0\"");
    emit_line(&w, "         xmlns:a=\"http://relaxng.org/ns/compatibility/annotations/1.0\"");
    emit_line(&w, "         datatypeLibrary=\"http://www.w3.org/2001/XMLSchema-datatypes\">");
    w.depth++;
    emit_open(&w, "<start>");
    emit_open(&w, "<element name=\"%s\">", SCHEMA_SCENE.element);
    documentation(&w, SCHEMA_SCENE.doc);
    // Editors find the schema by attributes such as xsi:noNamespaceSchemaLocation.
    emit_line(&w,
              "<zeroOrMore><attribute><nsName ns=\"http://www.w3.org/2001/XMLSchema-instance\"/></attribute>"
              "</zeroOrMore>");
    emit_line(&w, "<ref name=\"%s\"/>", SCHEMA_SCENE.name);
    emit_close(&w, "element");
    emit_close(&w, "start");
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        element_definition(&w, *e);
    text_definitions(&w);
    number_definitions(&w);
    emit_close(&w, "grammar");
}
