// XML Schema 1.0 for the XML spelling, for editors that know no RELAX NG: completion and hovering.
//
// XML Schema cannot say "an attribute or a child" or "these children in any order, this one once": the schema
// accepts every scene, and some files that are none. RELAX NG and `glint check` tell those.
#include "grammar/emit.h"

#include "grammar/emit_words.h"
#include "grammar/ir_print_text.h"
#include "grammar/schema.h"

#include <string.h>

enum {
    XSD_STEP = 2
};

struct xsd_writer {
    struct strbuf *out;
    uint32_t depth;
};

static void line(struct xsd_writer *w, const char *text) {
    strbuf_repeat(w->out, ' ', (size_t)w->depth * XSD_STEP);
    strbuf_format(w->out, "%s\n", text);
}

static void open_tag(struct xsd_writer *w, const char *text) {
    line(w, text);
    w->depth++;
}

static void close_tag(struct xsd_writer *w, const char *text) {
    w->depth--;
    line(w, text);
}

static void documentation(struct xsd_writer *w, const char *doc) {
    strbuf_repeat(w->out, ' ', (size_t)w->depth * XSD_STEP);
    strbuf_cstr(w->out, "<xs:annotation><xs:documentation>");
    print_xml_text(w->out, str_from(doc));
    strbuf_cstr(w->out, "</xs:documentation></xs:annotation>\n");
}

// ---- simple types

static void facet(struct xsd_writer *w, const char *name, double value) {
    strbuf_repeat(w->out, ' ', (size_t)w->depth * XSD_STEP);
    strbuf_format(w->out, "<xs:%s value=\"", name);
    print_number(w->out, value);
    strbuf_cstr(w->out, "\"/>\n");
}

static void number_types(struct xsd_writer *w) {
    for (enum schema_range range = SCHEMA_RANGE_NONE + 1; range < SCHEMA_RANGE_COUNT; range++) {
        const struct schema_range_info *info = schema_range_info(range);
        double least = info->magnitude ? -info->greatest : info->least;
        strbuf_repeat(w->out, ' ', (size_t)w->depth * XSD_STEP);
        strbuf_cstr(w->out, "<xs:simpleType name=\"");
        emit_range_name(range, w->out);
        strbuf_cstr(w->out, "\">\n");
        w->depth++;
        open_tag(w, emit_is_integer(range) ? "<xs:restriction base=\"xs:integer\">"
                                           : "<xs:restriction base=\"xs:double\">");
        facet(w, info->open ? "minExclusive" : "minInclusive", least);
        facet(w, info->open ? "maxExclusive" : "maxInclusive", info->greatest);
        close_tag(w, "</xs:restriction>");
        close_tag(w, "</xs:simpleType>");
        // A colour in one attribute: one number for all three, or #rrggbb.
        strbuf_repeat(w->out, ' ', (size_t)w->depth * XSD_STEP);
        strbuf_cstr(w->out, "<xs:simpleType name=\"color_");
        emit_range_name(range, w->out);
        strbuf_cstr(w->out, "\"><xs:union memberTypes=\"");
        emit_range_name(range, w->out);
        strbuf_cstr(w->out, " hex_color\"/></xs:simpleType>\n");
    }
}

static void text_types(struct xsd_writer *w) {
    line(w,
         "<xs:simpleType name=\"boolean\"><xs:restriction base=\"xs:string\"><xs:enumeration value=\"true\"/>"
         "<xs:enumeration value=\"false\"/></xs:restriction></xs:simpleType>");
    line(w, "<xs:simpleType name=\"hex_color\"><xs:restriction base=\"xs:string\"><xs:pattern "
            "value=\"#[0-9A-Fa-f]{6}\"/></xs:restriction></xs:simpleType>");
    line(w, "<xs:simpleType name=\"some_text\"><xs:restriction base=\"xs:string\"><xs:minLength value=\"1\"/>"
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
        strbuf_cstr(out, row->kind == SCHEMA_COLOR ? "color_" : "");
        emit_range_name(row->range, out);
    }
}

static void attribute(struct xsd_writer *w, const struct schema_row *row, bool required) {
    struct strbuf type;
    strbuf_init(&type);
    type_name(&type, row);
    strbuf_repeat(w->out, ' ', (size_t)w->depth * XSD_STEP);
    strbuf_format(w->out, "<xs:attribute name=\"%s\"", row->name);
    if (type.len)
        strbuf_format(w->out, " type=\"%.*s\"", STR_ARG(strbuf_view(&type)));
    strbuf_format(w->out, "%s>\n", required ? " use=\"required\"" : "");
    w->depth++;
    documentation(w, row->doc);
    if (row->kind == SCHEMA_WORD) {
        open_tag(w, "<xs:simpleType>");
        open_tag(w, "<xs:restriction base=\"xs:string\">");
        for (uint32_t i = 0; row->words[i]; i++) {
            strbuf_repeat(w->out, ' ', (size_t)w->depth * XSD_STEP);
            strbuf_format(w->out, "<xs:enumeration value=\"%s\">\n", row->words[i]);
            w->depth++;
            documentation(w, row->word_docs[i]);
            close_tag(w, "</xs:enumeration>");
        }
        close_tag(w, "</xs:restriction>");
        close_tag(w, "</xs:simpleType>");
    }
    close_tag(w, "</xs:attribute>");
    strbuf_finish(&type);
}

static void component_attributes(struct xsd_writer *w, const struct schema_row *row, bool required) {
    const char *const *names = schema_components(row->kind);
    for (uint32_t i = 0; names[i]; i++) {
        strbuf_repeat(w->out, ' ', (size_t)w->depth * XSD_STEP);
        strbuf_format(w->out, "<xs:attribute name=\"%s\" type=\"", names[i]);
        emit_range_name(row->range, w->out);
        strbuf_format(w->out, "\"%s/>\n", required && row->kind == SCHEMA_VECTOR ? " use=\"required\"" : "");
    }
    if (row->kind == SCHEMA_COLOR)
        line(w, "<xs:attribute name=\"" SCHEMA_HEX_ATTRIBUTE "\" type=\"hex_color\"/>");
}

// ---- elements

static void child_element(struct xsd_writer *w, const struct schema_row *row) {
    int only = row->child ? schema_short_row(row->child) : -1;
    int key = row->child && row->many == SCHEMA_NAMED_MAP ? schema_key_row(row->child) : -1;
    strbuf_repeat(w->out, ' ', (size_t)w->depth * XSD_STEP);
    strbuf_format(w->out, "<xs:element name=\"%s\">\n", row->element);
    w->depth++;
    documentation(w, row->doc);
    open_tag(w, "<xs:complexType>");
    if (row->child) {
        open_tag(w, "<xs:complexContent>");
        strbuf_repeat(w->out, ' ', (size_t)w->depth * XSD_STEP);
        strbuf_format(w->out, "<xs:extension base=\"%s\">\n", row->child->name);
        w->depth++;
        if (only >= 0 && schema_components(row->child->rows[only].kind)[0])
            component_attributes(w, &row->child->rows[only], false);
        if (key >= 0)
            attribute(w, &row->child->rows[key], !row->single);
        close_tag(w, "</xs:extension>");
        close_tag(w, "</xs:complexContent>");
    } else {
        component_attributes(w, row, true);
    }
    close_tag(w, "</xs:complexType>");
    close_tag(w, "</xs:element>");
}

static bool has_children(const struct schema_element *schema) {
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (schema->rows[i].element)
            return true;
    return false;
}

static void element_type(struct xsd_writer *w, const struct schema_element *schema) {
    strbuf_repeat(w->out, ' ', (size_t)w->depth * XSD_STEP);
    strbuf_format(w->out, "<xs:complexType name=\"%s\">\n", schema->name);
    w->depth++;
    documentation(w, schema->doc);
    if (has_children(schema)) {
        open_tag(w, "<xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">");
        for (uint32_t i = 0; i < schema->row_count; i++)
            if (schema->rows[i].element)
                child_element(w, &schema->rows[i]);
        close_tag(w, "</xs:choice>");
    }
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        // A key stands where the element is one of a list.
        if (!row->key && schema_is_attribute(row))
            attribute(w, row, row->required && !row->element && !row->choice);
    }
    close_tag(w, "</xs:complexType>");
}

void emit_xml_schema(struct strbuf *out) {
    struct xsd_writer w = {.out = out};
    line(&w, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    open_tag(&w, "<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\">");
    strbuf_repeat(out, ' ', XSD_STEP);
    strbuf_format(out, "<xs:element name=\"%s\" type=\"%s\"/>\n", SCHEMA_SCENE.element, SCHEMA_SCENE.name);
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        element_type(&w, *e);
    text_types(&w);
    number_types(&w);
    close_tag(&w, "</xs:schema>");
}
