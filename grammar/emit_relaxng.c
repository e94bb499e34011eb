// RELAX NG (XML syntax) for the XML spelling: attributes and children in any order.
#include "grammar/emit.h"

#include "grammar/emit_words.h"
#include "grammar/ir_print_text.h"

#include <string.h>

enum {
    RNG_STEP = 2
};

struct rng_writer {
    struct strbuf *out;
    uint32_t depth;
};

static void line(struct rng_writer *w, const char *text) {
    strbuf_repeat(w->out, ' ', (size_t)w->depth * RNG_STEP);
    strbuf_cstr(w->out, text);
    strbuf_char(w->out, '\n');
}

static void open_tag(struct rng_writer *w, const char *tag, const char *attribute, const char *value) {
    strbuf_repeat(w->out, ' ', (size_t)w->depth * RNG_STEP);
    strbuf_format(w->out, "<%s", tag);
    if (attribute)
        strbuf_format(w->out, " %s=\"%s\"", attribute, value);
    strbuf_cstr(w->out, ">\n");
    w->depth++;
}

static void close_tag(struct rng_writer *w, const char *tag) {
    w->depth--;
    strbuf_repeat(w->out, ' ', (size_t)w->depth * RNG_STEP);
    strbuf_format(w->out, "</%s>\n", tag);
}

static void documentation(struct rng_writer *w, const char *doc) {
    strbuf_repeat(w->out, ' ', (size_t)w->depth * RNG_STEP);
    strbuf_cstr(w->out, "<a:documentation>");
    print_xml_text(w->out, str_from(doc));
    strbuf_cstr(w->out, "</a:documentation>\n");
}

// The name under which a range of numbers is defined: "field_of_view", "integer_extent".
static void number_reference(struct rng_writer *w, const struct schema_row *row) {
    strbuf_repeat(w->out, ' ', (size_t)w->depth * RNG_STEP);
    strbuf_cstr(w->out, "<ref name=\"");
    emit_range_name(row->range, w->out);
    strbuf_cstr(w->out, "\"/>\n");
}

// ---- data

static void number_data(struct rng_writer *w, bool integer, double least, double greatest, bool open) {
    open_tag(w, "data", "type", integer ? "integer" : "double");
    if (!integer)
        line(w, "<param name=\"pattern\">[+\\-]?(\\d+\\.?\\d*|\\.\\d+)([eE][+\\-]?\\d+)?</param>");
    for (int end = 0; end < 2; end++) {
        const char *name =
            end ? (open ? "maxExclusive" : "maxInclusive") : (open ? "minExclusive" : "minInclusive");
        strbuf_repeat(w->out, ' ', (size_t)w->depth * RNG_STEP);
        strbuf_format(w->out, "<param name=\"%s\">", name);
        print_number(w->out, end ? greatest : least);
        strbuf_cstr(w->out, "</param>\n");
    }
    close_tag(w, "data");
}

static void number_definitions(struct rng_writer *w) {
    for (enum schema_range range = SCHEMA_RANGE_NONE + 1; range < SCHEMA_RANGE_COUNT; range++) {
        const struct schema_range_info *info = schema_range_info(range);
        bool integer = emit_is_integer(range);
        struct strbuf name;
        strbuf_init(&name);
        emit_range_name(range, &name);
        open_tag(w, "define", "name", name.data ? name.data : "");
        strbuf_finish(&name);
        if (info->magnitude) {
            open_tag(w, "choice", NULL, NULL);
            number_data(w, integer, info->least, info->greatest, info->open);
            number_data(w, integer, -info->greatest, -info->least, info->open);
            close_tag(w, "choice");
        } else {
            number_data(w, integer, info->least, info->greatest, info->open);
        }
        close_tag(w, "define");
    }
}

static void text_definitions(struct rng_writer *w) {
    open_tag(w, "define", "name", "boolean");
    line(w, "<choice><value type=\"string\">true</value><value type=\"string\">false</value></choice>");
    close_tag(w, "define");
    open_tag(w, "define", "name", "hex_color");
    line(w, "<data type=\"string\"><param name=\"pattern\">#[0-9A-Fa-f]{6}</param></data>");
    close_tag(w, "define");
    open_tag(w, "define", "name", "name");
    line(w, "<data type=\"string\"><param "
            "name=\"pattern\">[^\\d\\s!-,./:-@\\[-\\^`{-~][^\\s!-,./:-@\\[-\\^`{-~]{0,127}"
            "</param></data>");
    close_tag(w, "define");
    open_tag(w, "define", "name", "some_text");
    line(w, "<data type=\"string\"><param name=\"minLength\">1</param></data>");
    close_tag(w, "define");
}

// ---- values of attributes

static void attribute_data(struct rng_writer *w, const struct schema_row *row) {
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        line(w, "<ref name=\"boolean\"/>");
        break;
    case SCHEMA_WORD:
        open_tag(w, "choice", NULL, NULL);
        for (uint32_t i = 0; row->words[i]; i++) {
            strbuf_repeat(w->out, ' ', (size_t)w->depth * RNG_STEP);
            strbuf_format(w->out, "<value type=\"string\">%s</value>\n", row->words[i]);
            documentation(w, row->word_docs[i]);
        }
        close_tag(w, "choice");
        break;
    case SCHEMA_TEXT:
        line(w, row->text == SCHEMA_TEXT_NAME   ? "<ref name=\"name\"/>"
                : row->text == SCHEMA_TEXT_FREE ? "<data type=\"string\"/>"
                                                : "<ref name=\"some_text\"/>");
        break;
    case SCHEMA_COLOR:
        open_tag(w, "choice", NULL, NULL);
        number_reference(w, row);
        line(w, "<ref name=\"hex_color\"/>");
        close_tag(w, "choice");
        break;
    case SCHEMA_ELEMENT:
        attribute_data(w, &row->child->rows[schema_short_row(row->child)]);
        break;
    case SCHEMA_REFERENCE:
        line(w, "<ref name=\"some_text\"/>");
        break;
    default:
        number_reference(w, row);
        break;
    }
}

static void attribute(struct rng_writer *w, const struct schema_row *row) {
    open_tag(w, "attribute", "name", row->name);
    documentation(w, row->doc);
    attribute_data(w, row);
    close_tag(w, "attribute");
}

// ---- child elements

static void component_attributes(struct rng_writer *w, const struct schema_row *row) {
    const char *const *names = schema_components(row->kind);
    bool may_lack = row->kind == SCHEMA_WEIGHTS;
    if (row->kind == SCHEMA_COLOR)
        open_tag(w, "choice", NULL, NULL);
    open_tag(w, "group", NULL, NULL);
    for (uint32_t i = 0; names[i]; i++) {
        if (may_lack)
            open_tag(w, "optional", NULL, NULL);
        open_tag(w, "attribute", "name", names[i]);
        number_reference(w, row);
        close_tag(w, "attribute");
        if (may_lack)
            close_tag(w, "optional");
    }
    close_tag(w, "group");
    if (row->kind != SCHEMA_COLOR)
        return;
    line(w, "<attribute name=\"" SCHEMA_HEX_ATTRIBUTE "\"><ref name=\"hex_color\"/></attribute>");
    close_tag(w, "choice");
}

// What stands inside the element of a row with a child: its rows, or those of its short row alone.
static void child_content(struct rng_writer *w, const struct schema_row *row) {
    int only = schema_short_row(row->child);
    bool has_components = only >= 0 && schema_components(row->child->rows[only].kind)[0];
    if (has_components)
        open_tag(w, "choice", NULL, NULL);
    strbuf_repeat(w->out, ' ', (size_t)w->depth * RNG_STEP);
    strbuf_format(w->out, "<ref name=\"%s\"/>\n", row->child->name);
    if (has_components) {
        component_attributes(w, &row->child->rows[only]);
        close_tag(w, "choice");
    }
    int key = row->many == SCHEMA_NAMED_MAP ? schema_key_row(row->child) : -1;
    if (key < 0)
        return;
    if (row->single)
        open_tag(w, "optional", NULL, NULL);
    attribute(w, &row->child->rows[key]);
    if (row->single)
        close_tag(w, "optional");
}

static void child_element(struct rng_writer *w, const struct schema_row *row) {
    open_tag(w, "element", "name", row->element);
    documentation(w, row->doc);
    if (row->child)
        child_content(w, row);
    else
        component_attributes(w, row);
    close_tag(w, "element");
}

// ---- rows and elements

static void row_pattern(struct rng_writer *w, const struct schema_row *row) {
    bool both = schema_is_attribute(row) && row->element;
    if (row->kind == SCHEMA_LIST) {
        open_tag(w, "zeroOrMore", NULL, NULL);
        child_element(w, row);
        close_tag(w, "zeroOrMore");
        return;
    }
    if (row->many == SCHEMA_FIXED) {
        open_tag(w, "group", NULL, NULL);
        for (uint32_t i = 0; i < row->fixed_count; i++)
            child_element(w, row);
        close_tag(w, "group");
        return;
    }
    if (both)
        open_tag(w, "choice", NULL, NULL);
    if (schema_is_attribute(row))
        attribute(w, row);
    if (row->element)
        child_element(w, row);
    if (both)
        close_tag(w, "choice");
}

static void choice_pattern(struct rng_writer *w, const struct schema_element *schema, uint8_t choice) {
    bool optional = schema->choices[choice - 1].rule == SCHEMA_CHOICE_AT_MOST_ONE;
    if (optional)
        open_tag(w, "optional", NULL, NULL);
    open_tag(w, "choice", NULL, NULL);
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (schema->rows[i].choice == choice)
            row_pattern(w, &schema->rows[i]);
    close_tag(w, "choice");
    if (optional)
        close_tag(w, "optional");
}

static void element_definition(struct rng_writer *w, const struct schema_element *schema) {
    open_tag(w, "define", "name", schema->name);
    open_tag(w, "interleave", NULL, NULL);
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
            open_tag(w, "optional", NULL, NULL);
        row_pattern(w, row);
        if (optional)
            close_tag(w, "optional");
    }
    close_tag(w, "interleave");
    close_tag(w, "define");
}

void emit_relaxng(struct strbuf *out) {
    struct rng_writer w = {.out = out};
    line(&w, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    line(&w, "<grammar xmlns=\"http://relaxng.org/ns/structure/1.0\"");
    line(&w, "         xmlns:a=\"http://relaxng.org/ns/compatibility/annotations/1.0\"");
    line(&w, "         datatypeLibrary=\"http://www.w3.org/2001/XMLSchema-datatypes\">");
    w.depth++;
    open_tag(&w, "start", NULL, NULL);
    open_tag(&w, "element", "name", SCHEMA_SCENE.element);
    documentation(&w, SCHEMA_SCENE.doc);
    // Editors find the schema by attributes such as xsi:noNamespaceSchemaLocation.
    line(&w, "<zeroOrMore><attribute><nsName ns=\"http://www.w3.org/2001/XMLSchema-instance\"/></attribute>"
             "</zeroOrMore>");
    strbuf_repeat(out, ' ', (size_t)w.depth * RNG_STEP);
    strbuf_format(out, "<ref name=\"%s\"/>\n", SCHEMA_SCENE.name);
    close_tag(&w, "element");
    close_tag(&w, "start");
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        element_definition(&w, *e);
    text_definitions(&w);
    number_definitions(&w);
    close_tag(&w, "grammar");
}
