// XML Schema 1.0 for the XML spelling, for editors that do not know RELAX NG: completion and hovering.
//
// XML Schema cannot say "an attribute or a child" or "these children in any order, this one once": the schema
// accepts every scene, and some files that are not scenes. RELAX NG and `glint check` report those.
#include "grammar/emit/emit.h"

#include "grammar/emit/emit_pattern.h"
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
        facet(w, "maxInclusive", info->greatest);
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

static void words(struct emit_lines *w, const struct pattern *choice) {
    emit_open(w, "<xs:simpleType>");
    emit_open(w, "<xs:restriction base=\"xs:string\">");
    for (const struct pattern *p = choice->first; p; p = p->next) {
        emit_open(w, "<xs:enumeration value=\"%s\">", p->name);
        documentation(w, p->doc);
        emit_close(w, "xs:enumeration");
    }
    emit_close(w, "xs:restriction");
    emit_close(w, "xs:simpleType");
}

// The type of an attribute's values, except words, which are listed in place.
static void type_of(struct emit_lines *w, const struct pattern *values) {
    const bool is_color = values->kind == PATTERN_CHOICE;
    const struct pattern *p = is_color ? values->first : values;
    if (p->kind == PATTERN_NUMBER)
        strbuf_format(w->out, " type=\"%snumber_%s\"", is_color ? "color_" : "", p->name);
    else if (p->kind == PATTERN_TEXT)
        strbuf_cstr(w->out, " type=\"xs:string\"");
    else if (p->kind == PATTERN_TYPE)
        strbuf_format(w->out, " type=\"%s\"", strcmp(p->name, "name") == 0 ? "some_text" : p->name);
}

static void attribute(struct emit_lines *w, const struct pattern *p, bool required) {
    emit_indent(w);
    strbuf_format(w->out, "<xs:attribute name=\"%s\"", p->name);
    type_of(w, p->first);
    strbuf_format(w->out, "%s%s>\n", required ? " use=\"required\"" : "", p->doc ? "" : "/");
    if (!p->doc)
        return;
    w->depth++;
    documentation(w, p->doc);
    if (p->first->kind == PATTERN_CHOICE && p->first->first->kind == PATTERN_WORD)
        words(w, p->first);
    emit_close(w, "xs:attribute");
}

// Those of a pattern, but not of the elements inside. Those that are part of a choice may be absent.
static void attributes(struct emit_lines *w, const struct pattern *parent, bool required) {
    required = required && parent->kind != PATTERN_CHOICE && parent->kind != PATTERN_OPTIONAL;
    for (const struct pattern *p = parent->first; p; p = p->next)
        if (p->kind == PATTERN_ATTRIBUTE)
            attribute(w, p, required);
        else if (p->kind != PATTERN_ELEMENT)
            attributes(w, p, required);
}

// ---- elements

// The table's element that the elements of a pattern hold; NULL: none.
static const char *content_of(const struct pattern *element) {
    const struct pattern *p = element->first;
    p = p->kind == PATTERN_CHOICE ? p->first : p;
    return p->kind == PATTERN_CONTENT ? p->name : NULL;
}

static void element(struct emit_lines *w, const struct pattern *p) {
    const char *base = content_of(p);
    emit_open(w, "<xs:element name=\"%s\">", p->name);
    documentation(w, p->doc);
    emit_open(w, "<xs:complexType>");
    if (base) {
        emit_open(w, "<xs:complexContent>");
        emit_open(w, "<xs:extension base=\"%s\">", base);
    }
    attributes(w, p, true);
    if (base) {
        emit_close(w, "xs:extension");
        emit_close(w, "xs:complexContent");
    }
    emit_close(w, "xs:complexType");
    emit_close(w, "xs:element");
}

static bool has_elements(const struct pattern *parent) {
    for (const struct pattern *p = parent->first; p; p = p->next)
        if (p->kind == PATTERN_ELEMENT || has_elements(p))
            return true;
    return false;
}

static void elements(struct emit_lines *w, const struct pattern *parent) {
    for (const struct pattern *p = parent->first; p; p = p->next)
        if (p->kind == PATTERN_ELEMENT)
            element(w, p);
        else
            elements(w, p);
}

static void definition(struct emit_lines *w, const struct schema_element *schema,
                       const struct pattern *holds) {
    emit_open(w, "<xs:complexType name=\"%s\">", schema->name);
    documentation(w, schema->doc);
    if (has_elements(holds)) {
        emit_open(w, "<xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">");
        elements(w, holds);
        emit_close(w, "xs:choice");
    }
    attributes(w, holds, true);
    emit_close(w, "xs:complexType");
}

void emit_xml_schema(struct strbuf *out) {
    struct emit_lines w = {.out = out};
    emit_line(&w, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    emit_open(&w, "<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\">");
    emit_line(&w, "<xs:element name=\"%s\" type=\"%s\"/>", SCHEMA_SCENE.element, SCHEMA_SCENE.name);
    emit_patterns(&w, definition);
    text_types(&w);
    number_types(&w);
    emit_close(&w, "xs:schema");
}
