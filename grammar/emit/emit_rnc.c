// RELAX NG in its compact syntax: the same language as emit_relaxng.c, for Emacs and for people.
#include "grammar/emit/emit.h"

#include "grammar/emit/emit_lines.h"
#include "grammar/ir_print_text.h"
#include "grammar/schema.h"

#include <string.h>

static void documentation(struct emit_lines *w, const char *doc) {
    emit_line(w, "## %s", doc);
}

// A definition's name; the syntax' own words need a mark (RELAX NG Compact Syntax, OASIS 2002, section 2.5).
static void definition_name(struct emit_lines *w, const char *name) {
    static const char *const words[] = {"attribute", "default",    "datatypes", "div",     "element",
                                        "empty",     "external",   "grammar",   "include", "list",
                                        "inherit",   "mixed",      "namespace", "parent",  "start",
                                        "text",      "notAllowed", "string",    "token",   NULL};
    for (const char *const *word = words; *word; word++)
        if (strcmp(*word, name) == 0)
            strbuf_char(w->out, '\\');
    strbuf_cstr(w->out, name);
}

// ---- data

static void number_data(struct emit_lines *w, bool integer, double least, double greatest, bool open) {
    strbuf_format(w->out, "xsd:%s {", integer ? "integer" : "double");
    if (!integer)
        strbuf_cstr(w->out, " pattern = \"" EMIT_NUMBER_PATTERN "\"");
    strbuf_format(w->out, " %s = \"", open ? "minExclusive" : "minInclusive");
    print_number(w->out, least);
    strbuf_format(w->out, "\" %s = \"", open ? "maxExclusive" : "maxInclusive");
    print_number(w->out, greatest);
    strbuf_cstr(w->out, "\" }");
}

static void number_definitions(struct emit_lines *w) {
    for (enum schema_range range = SCHEMA_RANGE_NONE + 1; range < SCHEMA_RANGE_COUNT; range++) {
        const struct schema_range_info *info = schema_range_info(range);
        bool integer = emit_is_integer(range);
        strbuf_format(w->out, "number_%s = ", info->name);
        number_data(w, integer, info->least, info->greatest, info->open);
        if (info->magnitude) {
            strbuf_cstr(w->out, " | ");
            number_data(w, integer, -info->greatest, -info->least, info->open);
        }
        strbuf_char(w->out, '\n');
    }
}

static void text_definitions(struct emit_lines *w) {
    emit_line(w, "boolean = xsd:string \"true\" | xsd:string \"false\"");
    emit_line(w, "hex_color = xsd:string { pattern = \"" EMIT_HEX_PATTERN "\" }");
    emit_line(w, "name = xsd:string { pattern = \"" EMIT_NAME_PATTERN "\" }");
    emit_line(w, "some_text = xsd:string { minLength = \"1\" }");
}

// ---- values of attributes

static void attribute_data(struct emit_lines *w, const struct schema_row *row) {
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        strbuf_cstr(w->out, "boolean");
        break;
    case SCHEMA_WORD:
        for (uint32_t i = 0; row->words[i]; i++)
            strbuf_format(w->out, "%sxsd:string \"%s\"", i ? " | " : "", row->words[i]);
        break;
    case SCHEMA_TEXT:
        strbuf_cstr(w->out, row->text == SCHEMA_TEXT_NAME   ? "name"
                            : row->text == SCHEMA_TEXT_FREE ? "xsd:string"
                                                            : "some_text");
        break;
    case SCHEMA_COLOR:
        strbuf_format(w->out, "number_%s | hex_color", schema_range_info(row->range)->name);
        break;
    case SCHEMA_ELEMENT:
        attribute_data(w, &row->child->rows[schema_short_row(row->child)]);
        break;
    case SCHEMA_REFERENCE:
        strbuf_cstr(w->out, "some_text");
        break;
    default:
        strbuf_format(w->out, "number_%s", schema_range_info(row->range)->name);
        break;
    }
}

static void attribute(struct emit_lines *w, const struct schema_row *row) {
    documentation(w, row->doc);
    emit_indent(w);
    strbuf_format(w->out, "attribute %s { ", row->name);
    attribute_data(w, row);
    strbuf_cstr(w->out, " }");
}

// ---- child elements

static void component_attributes(struct emit_lines *w, const struct schema_row *row) {
    const char *const *names = schema_components(row->kind);
    const char *mark = row->kind == SCHEMA_WEIGHTS ? "?" : "";
    emit_indent(w);
    strbuf_cstr(w->out, "(");
    for (uint32_t i = 0; names[i]; i++)
        strbuf_format(w->out, "%sattribute %s { number_%s }%s", i ? ", " : "", names[i],
                      schema_range_info(row->range)->name, mark);
    strbuf_cstr(w->out, ")");
    if (row->kind == SCHEMA_COLOR)
        strbuf_cstr(w->out, " | attribute " SCHEMA_HEX_ATTRIBUTE " { hex_color }");
}

static void child_content(struct emit_lines *w, const struct schema_row *row) {
    int only = schema_short_row(row->child);
    int key = row->many == SCHEMA_NAMED_MAP ? schema_key_row(row->child) : -1;
    bool has_components = only >= 0 && schema_components(row->child->rows[only].kind)[0];
    emit_indent(w);
    strbuf_cstr(w->out, has_components ? "(" : "");
    definition_name(w, row->child->name);
    if (has_components) {
        strbuf_cstr(w->out, " |\n");
        component_attributes(w, &row->child->rows[only]);
        strbuf_cstr(w->out, ")");
    }
    if (key < 0)
        return;
    strbuf_cstr(w->out, ",\n");
    if (row->single)
        emit_line(w, "(");
    attribute(w, &row->child->rows[key]);
    if (row->single)
        strbuf_cstr(w->out, ")?");
}

static void child_element(struct emit_lines *w, const struct schema_row *row) {
    documentation(w, row->doc);
    emit_open(w, "element %s {", row->element);
    if (row->child)
        child_content(w, row);
    else
        component_attributes(w, row);
    w->depth--;
    strbuf_char(w->out, '\n');
    emit_indent(w);
    strbuf_cstr(w->out, "}");
}

// ---- rows and elements

static void row_pattern(struct emit_lines *w, const struct schema_row *row) {
    if (row->many == SCHEMA_FIXED) {
        for (uint32_t i = 0; i < row->fixed_count; i++) {
            strbuf_cstr(w->out, i ? ",\n" : "");
            child_element(w, row);
        }
        return;
    }
    if (schema_is_attribute(row))
        attribute(w, row);
    if (schema_is_attribute(row) && row->element)
        strbuf_cstr(w->out, " |\n");
    if (row->element)
        child_element(w, row);
}

// The patterns of a choice, or of a row outside of one, in parentheses with their mark.
static void grouped(struct emit_lines *w, const struct schema_element *schema, uint32_t first) {
    const struct schema_row *row = &schema->rows[first];
    const char *mark = row->kind == SCHEMA_LIST ? "*" : row->required ? "" : "?";
    if (row->choice)
        mark = schema->choices[row->choice - 1].rule == SCHEMA_CHOICE_AT_MOST_ONE ? "?" : "";
    emit_line(w, "(");
    w->depth++;
    bool any = false;
    for (uint32_t i = first; i < schema->row_count; i++) {
        if (i != first && (!row->choice || schema->rows[i].choice != row->choice))
            continue;
        strbuf_cstr(w->out, any ? " |\n" : "");
        bool inner = row->choice && schema->rows[i].many == SCHEMA_FIXED;
        if (inner)
            emit_line(w, "(");
        row_pattern(w, &schema->rows[i]);
        if (inner)
            strbuf_cstr(w->out, ")");
        any = true;
    }
    w->depth--;
    strbuf_format(w->out, ")%s", mark);
}

static void element_definition(struct emit_lines *w, const struct schema_element *schema) {
    strbuf_char(w->out, '\n');
    definition_name(w, schema->name);
    strbuf_cstr(w->out, " =\n");
    w->depth++;
    bool any = false;
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        // A key stands where the element is one of a list; an element in place has none.
        if (row->key || (row->choice && !emit_is_first_of_choice(schema, i)))
            continue;
        strbuf_cstr(w->out, any ? " &\n" : "");
        grouped(w, schema, i);
        any = true;
    }
    strbuf_char(w->out, '\n');
    w->depth--;
}

void emit_relaxng_compact(struct strbuf *out) {
    struct emit_lines w = {.out = out};
    emit_line(&w, "namespace xsi = \"http://www.w3.org/2001/XMLSchema-instance\"");
    emit_line(&w, "datatypes xsd = \"http://www.w3.org/2001/XMLSchema-datatypes\"");
    strbuf_char(out, '\n');
    emit_line(&w, "start =");
    w.depth++;
    documentation(&w, SCHEMA_SCENE.doc);
    emit_line(&w, "element %s { attribute xsi:* { text }*, %s }", SCHEMA_SCENE.element, SCHEMA_SCENE.name);
    w.depth--;
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        element_definition(&w, *e);
    strbuf_char(out, '\n');
    text_definitions(&w);
    number_definitions(&w);
}
