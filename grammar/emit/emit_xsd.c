// XML Schema 1.0 for the XML spelling, for editors that know no RELAX NG: completion and hovering.
//
// XML Schema cannot say "an attribute or a child" or "these children in any order, this one once": the schema
// accepts every scene, and some files that are none. RELAX NG and `glint check` tell those.
#include "grammar/emit/emit.h"

#include "grammar/emit/emit_lines.h"
#include "grammar/ir_print_text.h"
#include "grammar/schema.h"

#include <string.h>

static void documentation(struct emit_lines *w, const char *doc) {
    emit_indent(w);
    strbuf_cstr(w->out, "<xs:annotation><xs:documentation>");
    print_xml_text(w->out, str_from(doc));
    strbuf_cstr(w->out, "</xs:documentation></xs:annotation>\n");
}

// ---- simple types

static void facet(struct emit_lines *w, const char *name, double value) {
    emit_indent(w);
    strbuf_format(w->out, "<xs:%s value=\"", name);
    print_number(w->out, value);
    strbuf_cstr(w->out, "\"/>\n");
}

static void number_types(struct emit_lines *w) {
    for (enum schema_range range = SCHEMA_RANGE_NONE + 1; range < SCHEMA_RANGE_COUNT; range++) {
        const struct schema_range_info *info = schema_range_info(range);
        double least = info->magnitude ? -info->greatest : info->least;
        emit_open(w, "<xs:simpleType name=\"number_%s\">", info->name);
        emit_open(w, "<xs:restriction base=\"xs:%s\">", emit_is_integer(range) ? "integer" : "double");
        facet(w, info->open ? "minExclusive" : "minInclusive", least);
        facet(w, info->open ? "maxExclusive" : "maxInclusive", info->greatest);
        emit_close(w, "xs:restriction");
        emit_close(w, "xs:simpleType");
        // A colour in one attribute: one number for all three, or #rrggbb.
        emit_line(w,
                  "<xs:simpleType name=\"color_number_%s\"><xs:union memberTypes=\"number_%s hex_color\"/>"
                  "</xs:simpleType>",
                  info->name, info->name);
    }
}

static void text_types(struct emit_lines *w) {
    emit_line(
        w,
        "<xs:simpleType name=\"boolean\"><xs:restriction base=\"xs:string\"><xs:enumeration value=\"true\"/>"
        "<xs:enumeration value=\"false\"/></xs:restriction></xs:simpleType>");
    emit_line(w, "<xs:simpleType name=\"hex_color\"><xs:restriction base=\"xs:string\"><xs:pattern "
                 "value=\"" EMIT_HEX_PATTERN "\"/></xs:restriction></xs:simpleType>");
    emit_line(
        w, "<xs:simpleType name=\"some_text\"><xs:restriction base=\"xs:string\"><xs:minLength value=\"1\"/>"
           "</xs:restriction></xs:simpleType>");
}

// ---- attributes

// The type of an attribute's value; the empty string: an enumeration in place.
static void type_name(struct strbuf *out, const struct schema_row *row) {
    if (row->kind == SCHEMA_ELEMENT) {
        type_name(out, &row->child->rows[schema_short_row(row->child)]);
    } else if (row->kind == SCHEMA_BOOLEAN) {
        strbuf_cstr(out, "boolean");
    } else if (row->kind == SCHEMA_TEXT || row->kind == SCHEMA_REFERENCE) {
        bool is_free = row->kind == SCHEMA_TEXT && row->text == SCHEMA_TEXT_FREE;
        strbuf_cstr(out, is_free ? "xs:string" : "some_text");
    } else if (row->kind != SCHEMA_WORD) {
        strbuf_format(out, "%snumber_%s", row->kind == SCHEMA_COLOR ? "color_" : "",
                      schema_range_info(row->range)->name);
    }
}

static void attribute(struct emit_lines *w, const struct schema_row *row, bool required) {
    struct strbuf type;
    strbuf_init(&type);
    type_name(&type, row);
    emit_indent(w);
    strbuf_format(w->out, "<xs:attribute name=\"%s\"", row->name);
    if (type.len)
        strbuf_format(w->out, " type=\"%.*s\"", STR_ARG(strbuf_view(&type)));
    strbuf_format(w->out, "%s>\n", required ? " use=\"required\"" : "");
    w->depth++;
    documentation(w, row->doc);
    if (row->kind == SCHEMA_WORD) {
        emit_open(w, "<xs:simpleType>");
        emit_open(w, "<xs:restriction base=\"xs:string\">");
        for (uint32_t i = 0; row->words[i]; i++) {
            emit_open(w, "<xs:enumeration value=\"%s\">", row->words[i]);
            documentation(w, row->word_docs[i]);
            emit_close(w, "xs:enumeration");
        }
        emit_close(w, "xs:restriction");
        emit_close(w, "xs:simpleType");
    }
    emit_close(w, "xs:attribute");
    strbuf_finish(&type);
}

static void component_attributes(struct emit_lines *w, const struct schema_row *row, bool required) {
    const char *const *names = schema_components(row->kind);
    for (uint32_t i = 0; names[i]; i++)
        emit_line(w, "<xs:attribute name=\"%s\" type=\"number_%s\"%s/>", names[i],
                  schema_range_info(row->range)->name,
                  required && row->kind == SCHEMA_VECTOR ? " use=\"required\"" : "");
    if (row->kind == SCHEMA_COLOR)
        emit_line(w, "<xs:attribute name=\"" SCHEMA_HEX_ATTRIBUTE "\" type=\"hex_color\"/>");
}

// ---- elements

static void child_element(struct emit_lines *w, const struct schema_row *row) {
    int only = row->child ? schema_short_row(row->child) : -1;
    int key = row->child && row->many == SCHEMA_NAMED_MAP ? schema_key_row(row->child) : -1;
    emit_open(w, "<xs:element name=\"%s\">", row->element);
    documentation(w, row->doc);
    emit_open(w, "<xs:complexType>");
    if (row->child) {
        emit_open(w, "<xs:complexContent>");
        emit_open(w, "<xs:extension base=\"%s\">", row->child->name);
        if (only >= 0 && schema_components(row->child->rows[only].kind)[0])
            component_attributes(w, &row->child->rows[only], false);
        if (key >= 0)
            attribute(w, &row->child->rows[key], !row->single);
        emit_close(w, "xs:extension");
        emit_close(w, "xs:complexContent");
    } else {
        component_attributes(w, row, true);
    }
    emit_close(w, "xs:complexType");
    emit_close(w, "xs:element");
}

static bool has_children(const struct schema_element *schema) {
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (schema->rows[i].element)
            return true;
    return false;
}

static void element_type(struct emit_lines *w, const struct schema_element *schema) {
    emit_open(w, "<xs:complexType name=\"%s\">", schema->name);
    documentation(w, schema->doc);
    if (has_children(schema)) {
        emit_open(w, "<xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">");
        for (uint32_t i = 0; i < schema->row_count; i++)
            if (schema->rows[i].element)
                child_element(w, &schema->rows[i]);
        emit_close(w, "xs:choice");
    }
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        // A key stands where the element is one of a list.
        if (!row->key && schema_is_attribute(row))
            attribute(w, row, row->required && !row->element && !row->choice);
    }
    emit_close(w, "xs:complexType");
}

void emit_xml_schema(struct strbuf *out) {
    struct emit_lines w = {.out = out};
    emit_line(&w, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    emit_open(&w, "<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\">");
    emit_line(&w, "<xs:element name=\"%s\" type=\"%s\"/>", SCHEMA_SCENE.element, SCHEMA_SCENE.name);
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        element_type(&w, *e);
    text_types(&w);
    number_types(&w);
    emit_close(&w, "xs:schema");
}
