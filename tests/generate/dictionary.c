#include "tests/generate/dictionary.h"

#include "grammar/schema.h"

#include <string.h>

struct word_list {
    struct strbuf *out;
    struct strbuf seen; // each word with line ends around it
};

static void put_word(struct word_list *list, const char *before, const char *word, const char *after) {
    struct strbuf line;
    strbuf_init(&line);
    strbuf_format(&line, "\n%s%s%s\n", before, word, after);
    if (!line.failed && !list->seen.failed && !strstr(list->seen.data, line.data)) {
        strbuf_cstr(&list->seen, line.data);
        strbuf_char(list->out, '"');
        for (const char *c = line.data + 1; *c != '\n'; c++) {
            if (*c == '"' || *c == '\\')
                strbuf_char(list->out, '\\');
            strbuf_char(list->out, *c);
        }
        strbuf_cstr(list->out, "\"\n");
    }
    list->out->failed = list->out->failed || line.failed || list->seen.failed;
    strbuf_finish(&line);
}

static void put_row(struct word_list *list, const struct schema_row *row) {
    const char *const *components = schema_components(row->kind);
    put_word(list, "", schema_yaml_key(row), ": ");
    if (row->single)
        put_word(list, "", row->name, ": ");
    if (schema_is_attribute(row))
        put_word(list, " ", row->name, "=\"");
    if (row->element) {
        put_word(list, "<", row->element, "");
        put_word(list, "</", row->element, ">");
    }
    for (uint32_t i = 0; row->words && row->words[i]; i++)
        put_word(list, "", row->words[i], "");
    for (uint32_t i = 0; components[i]; i++) {
        put_word(list, "", components[i], ": ");
        put_word(list, " ", components[i], "=\"");
    }
}

// What neither spelling's own dictionary would hold.
static const char *const others[] = {
    "true",
    "false",
    "null",
    "~",
    "&a ",
    "*a",
    "<<: ",
    "!!float ",
    "--- ",
    "...",
    "| ",
    "> ",
    "# ",
    "[",
    "]",
    "{",
    "}",
    "- ",
    "? ",
    ", ",
    "\"#ff8800\"",
    "1e18",
    "1e-18",
    "-1",
    "0.5",
    ".inf",
    "0x10",
    "1_000",
    "1,5",
    "x-",
    "/>",
    "</",
    "<!--",
    "-->",
    "<?xml version=\"1.0\"?>",
    "<?xml-model href=\"",
    "<!DOCTYPE ",
    "<![CDATA[",
    "]]>",
    "&amp;",
    "&#10;",
    "&#x41;",
    "xmlns=\"",
    "xsi:noNamespaceSchemaLocation=\"",
};

void dictionary_write(struct strbuf *out) {
    struct word_list list = {.out = out};
    strbuf_init(&list.seen);
    strbuf_char(&list.seen, '\n');
    strbuf_cstr(out, "# Made from the grammar table; do not edit.\n");
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        for (uint32_t i = 0; i < (*e)->row_count; i++)
            put_row(&list, &(*e)->rows[i]);
    put_word(&list, "<", SCHEMA_SCENE.element, " ");
    put_word(&list, "</", SCHEMA_SCENE.element, ">");
    put_word(&list, " ", SCHEMA_HEX_ATTRIBUTE, "=\"#");
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        put_word(&list, "", others[i], "");
    strbuf_finish(&list.seen);
}
