// RELAX NG (XML syntax) for the XML spelling: attributes and children in any order.
#include "grammar/emit/emit.h"

#include "grammar/emit/emit_pattern.h"
#include "grammar/ir_print_text.h"

static void documentation(struct emit_lines *w, const char *doc) {
    emit_indent(w);
    strbuf_cstr(w->out, "<a:documentation>");
    print_xml_text(w->out, str_from(doc));
    strbuf_cstr(w->out, "</a:documentation>\n");
}

// ---- data

static void number_data(struct emit_lines *w, bool integer, double least, double greatest, bool open) {
    emit_open(w, "<data type=\"%s\">", integer ? "integer" : "double");
    if (!integer)
        emit_line(w, "<param name=\"pattern\">" EMIT_NUMBER_PATTERN "</param>");
    for (int end = 0; end < 2; end++) {
        const char *name = end ? "maxInclusive" : open ? "minExclusive" : "minInclusive";
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

static void except_word(void *w, const char *word) {
    emit_line(w, "<value type=\"string\">%s</value>", word);
}

static void text_definitions(struct emit_lines *w) {
    emit_open(w, "<define name=\"boolean\">");
    emit_line(w, "<choice><value type=\"string\">true</value><value type=\"string\">false</value></choice>");
    emit_close(w, "define");
    emit_open(w, "<define name=\"hex_color\">");
    emit_line(w, "<data type=\"string\"><param name=\"pattern\">" EMIT_HEX_PATTERN "</param></data>");
    emit_close(w, "define");
    emit_open(w, "<define name=\"expression\">");
    emit_open(w, "<data type=\"string\">");
    emit_line(w, "<param name=\"pattern\">%s</param>", EMIT_EXPRESSION_PATTERN);
    emit_open(w, "<except>");
    emit_open(w, "<choice>");
    emit_no_words(except_word, w);
    emit_close(w, "choice");
    emit_close(w, "except");
    emit_close(w, "data");
    emit_close(w, "define");
    emit_open(w, "<define name=\"name\">");
    emit_line(w, "<data type=\"string\"><param name=\"pattern\">" EMIT_NAME_PATTERN "</param></data>");
    emit_close(w, "define");
    emit_open(w, "<define name=\"body_name\">");
    emit_line(w, "<data type=\"string\"><param name=\"pattern\">" EMIT_NAME_PATTERN EMIT_PLACES_PATTERN
                 "</param></data>");
    emit_close(w, "define");
    emit_open(w, "<define name=\"whole_name\">");
    emit_line(w, "<data type=\"string\"><param name=\"pattern\">" EMIT_WHOLE_PATTERN "</param></data>");
    emit_close(w, "define");
    emit_open(w, "<define name=\"some_text\">");
    emit_line(w, "<data type=\"string\"><param name=\"minLength\">1</param></data>");
    emit_close(w, "define");
}

// ---- elements

static void print(struct emit_lines *w, const struct pattern *p);

static void print_all(struct emit_lines *w, const struct pattern *parent) {
    for (uint32_t i = 0; i < parent->times; i++)
        for (const struct pattern *p = parent->first; p; p = p->next)
            print(w, p);
}

// The RELAX NG element of a pattern, around the patterns inside.
static void print_around(struct emit_lines *w, const struct pattern *p) {
    static const char *const tags[] = {
        [PATTERN_INTERLEAVE] = "interleave", [PATTERN_ELEMENT] = "element", [PATTERN_ATTRIBUTE] = "attribute",
        [PATTERN_OPTIONAL] = "optional",     [PATTERN_MANY] = "zeroOrMore", [PATTERN_CHOICE] = "choice",
        [PATTERN_GROUP] = "group",
    };
    if (p->name)
        emit_open(w, "<%s name=\"%s\">", tags[p->kind], p->name);
    else
        emit_open(w, "<%s>", tags[p->kind]);
    if (p->doc)
        documentation(w, p->doc);
    print_all(w, p);
    emit_close(w, tags[p->kind]);
}

static void print(struct emit_lines *w, const struct pattern *p) {
    switch (p->kind) {
    case PATTERN_CONTENT:
    case PATTERN_TYPE:
        emit_line(w, "<ref name=\"%s\"/>", p->name);
        break;
    case PATTERN_NUMBER:
        emit_line(w, "<ref name=\"number_%s\"/>", p->name);
        break;
    case PATTERN_WORD:
        emit_line(w, "<value type=\"string\">%s</value>", p->name);
        documentation(w, p->doc);
        break;
    case PATTERN_TEXT:
        emit_line(w, "<data type=\"string\"/>");
        break;
    case PATTERN_ATTRIBUTE:
        if (!p->doc && p->first->kind == PATTERN_TYPE) {
            emit_line(w, "<attribute name=\"%s\"><ref name=\"%s\"/></attribute>", p->name, p->first->name);
            break;
        }
        print_around(w, p);
        break;
    default:
        print_around(w, p);
        break;
    }
}

static void definition(struct emit_lines *w, const struct schema_element *schema,
                       const struct pattern *holds) {
    emit_open(w, "<define name=\"%s\">", schema->name);
    print(w, holds);
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
    emit_patterns(&w, definition);
    text_definitions(&w);
    number_definitions(&w);
    emit_close(&w, "grammar");
}
