// RELAX NG in its compact syntax: the same language as emit_relaxng.c, for Emacs and for people.
#include "grammar/emit/emit.h"

#include "grammar/emit/emit_pattern.h"
#include "grammar/ir_print_text.h"
#include "grammar/schema.h"

#include <string.h>

static void documentation(struct emit_lines *w, const char *doc) {
    emit_line(w, "## %s", doc);
}

// A definition's name; the syntax's own words need a mark (RELAX NG Compact Syntax, OASIS 2002, section 2.5).
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
    strbuf_cstr(w->out, "\" maxInclusive = \"");
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

static void add_word(void *out, const char *word) {
    strbuf_format(out, " | xsd:string \"%s\"", word);
}

static void text_definitions(struct emit_lines *w) {
    emit_line(w, "boolean = xsd:string \"true\" | xsd:string \"false\"");
    emit_line(w, "hex_color = xsd:string { pattern = \"" EMIT_HEX_PATTERN "\" }");
    strbuf_cstr(w->out, "no_expression = xsd:string \"\"");
    emit_no_words(add_word, w->out);
    emit_line(w, "\nexpression = xsd:string { pattern = \"%s\" } - no_expression", EMIT_EXPRESSION_PATTERN);
    emit_line(w, "name = xsd:string { pattern = \"" EMIT_NAME_PATTERN "\" }");
    emit_line(w, "body_name = xsd:string { pattern = \"" EMIT_NAME_PATTERN EMIT_PLACES_PATTERN "\" }");
    emit_line(w, "whole_name = xsd:string { pattern = \"" EMIT_WHOLE_PATTERN "\" }");
    emit_line(w, "some_text = xsd:string { minLength = \"1\" }");
}

// ---- on one line: values, and attributes without documentation

static bool fits_line(const struct pattern *p) {
    if (p->kind == PATTERN_ELEMENT || p->kind == PATTERN_CONTENT || p->doc)
        return false;
    return p->kind == PATTERN_ATTRIBUTE || !p->first || fits_line(p->first);
}

static void print_inline(struct emit_lines *w, const struct pattern *p);

static void join_inline(struct emit_lines *w, const struct pattern *parent, const char *separator) {
    for (const struct pattern *p = parent->first; p; p = p->next) {
        print_inline(w, p);
        strbuf_cstr(w->out, p->next ? separator : "");
    }
}

static void print_inline(struct emit_lines *w, const struct pattern *p) {
    switch (p->kind) {
    case PATTERN_ATTRIBUTE:
        strbuf_format(w->out, "attribute %s { ", p->name);
        print_inline(w, p->first);
        strbuf_cstr(w->out, " }");
        break;
    case PATTERN_OPTIONAL:
        print_inline(w, p->first);
        strbuf_char(w->out, '?');
        break;
    case PATTERN_GROUP:
        strbuf_char(w->out, '(');
        join_inline(w, p, ", ");
        strbuf_char(w->out, ')');
        break;
    case PATTERN_CHOICE:
        join_inline(w, p, " | ");
        break;
    case PATTERN_NUMBER:
        strbuf_format(w->out, "number_%s", p->name);
        break;
    case PATTERN_WORD:
        strbuf_format(w->out, "xsd:string \"%s\"", p->name);
        break;
    default:
        strbuf_cstr(w->out, p->kind == PATTERN_TEXT ? "xsd:string" : p->name);
        break;
    }
}

// ---- on lines of their own; the last one has no line end yet

static void print(struct emit_lines *w, const struct pattern *p);

static void join(struct emit_lines *w, const struct pattern *parent, const char *separator) {
    for (uint32_t i = 0; i < parent->times; i++)
        for (const struct pattern *p = parent->first; p; p = p->next) {
            print(w, p);
            strbuf_cstr(w->out, p->next || i + 1 < parent->times ? separator : "");
        }
}

static void print_element(struct emit_lines *w, const struct pattern *p) {
    documentation(w, p->doc);
    emit_open(w, "element %s {", p->name);
    join(w, p, ",\n");
    w->depth--;
    strbuf_char(w->out, '\n');
    emit_indent(w);
    strbuf_char(w->out, '}');
}

static void print(struct emit_lines *w, const struct pattern *p) {
    if (p->kind == PATTERN_ATTRIBUTE || fits_line(p)) {
        if (p->doc)
            documentation(w, p->doc);
        emit_indent(w);
        print_inline(w, p);
    } else if (p->kind == PATTERN_ELEMENT) {
        print_element(w, p);
    } else if (p->kind == PATTERN_CONTENT) {
        emit_indent(w);
        definition_name(w, p->name);
    } else if (p->kind == PATTERN_GROUP) {
        join(w, p, ",\n");
    } else if (p->kind ==
               PATTERN_CHOICE) { // what an element of the table holds, or its short row's components
        emit_indent(w);
        strbuf_char(w->out, '(');
        definition_name(w, p->first->name);
        strbuf_cstr(w->out, " |\n");
        print(w, p->first->next);
        strbuf_char(w->out, ')');
    } else {
        emit_line(w, "(");
        print(w, p->first);
        strbuf_cstr(w->out, p->kind == PATTERN_MANY ? ")*" : ")?");
    }
}

// ---- rows and elements

static void print_choice(struct emit_lines *w, const struct pattern *choice) {
    for (const struct pattern *p = choice->first; p; p = p->next) {
        if (p->kind == PATTERN_CHOICE) {
            print_choice(w, p);
        } else if (p->kind == PATTERN_GROUP) {
            emit_line(w, "(");
            print(w, p);
            strbuf_char(w->out, ')');
        } else {
            print(w, p);
        }
        strbuf_cstr(w->out, p->next ? " |\n" : "");
    }
}

// A row, or the rows of a choice, in parentheses with their mark.
static void print_row(struct emit_lines *w, const struct pattern *p) {
    const char *mark = p->kind == PATTERN_OPTIONAL ? "?" : p->kind == PATTERN_MANY ? "*" : "";
    const struct pattern *inside = *mark ? p->first : p;
    emit_open(w, "(");
    if (inside->kind == PATTERN_CHOICE)
        print_choice(w, inside);
    else
        print(w, inside);
    w->depth--;
    strbuf_format(w->out, ")%s", mark);
}

static void definition(struct emit_lines *w, const struct schema_element *schema,
                       const struct pattern *holds) {
    strbuf_char(w->out, '\n');
    definition_name(w, schema->name);
    strbuf_cstr(w->out, " =\n");
    w->depth++;
    for (const struct pattern *p = holds->first; p; p = p->next) {
        print_row(w, p);
        strbuf_cstr(w->out, p->next ? " &\n" : "\n");
    }
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
    emit_patterns(&w, definition);
    strbuf_char(out, '\n');
    text_definitions(&w);
    number_definitions(&w);
}
