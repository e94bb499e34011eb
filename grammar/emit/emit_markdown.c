// The reference page.
#include "grammar/emit/emit.h"

#include "grammar/emit/emit_words.h"

// Text inside a cell of a table.
static void cell(struct strbuf *out, str text) {
    for (size_t i = 0; i < text.len; i++) {
        if (text.ptr[i] == '|')
            strbuf_char(out, '\\');
        strbuf_char(out, text.ptr[i]);
    }
}

static void cell_of(struct strbuf *out, struct strbuf *text) {
    cell(out, strbuf_view(text));
    out->failed = out->failed || text->failed;
    strbuf_clear(text);
}

static void anchor(struct strbuf *out, const struct schema_element *element) {
    strbuf_format(out, "[%s](#%s)", element->name, element->name);
}

static void put_type(struct strbuf *out, const struct schema_row *row, struct strbuf *scratch) {
    bool is_list = row->kind == SCHEMA_LIST;
    bool is_plain = is_list || (row->kind == SCHEMA_ELEMENT && schema_short_row(row->child) < 0);
    if (!is_plain) {
        emit_type_words(row, scratch);
        cell_of(out, scratch);
    }
    if (is_list)
        strbuf_cstr(out, row->many == SCHEMA_NAMED_MAP ? "any number by name: " : "any number: ");
    if (row->child) {
        strbuf_cstr(out, is_plain ? "" : ", see ");
        anchor(out, row->child);
    }
    emit_range_words(row, scratch);
    if (scratch->len) {
        strbuf_cstr(out, "; ");
        cell_of(out, scratch);
    }
}

static void put_default(struct strbuf *out, const struct schema_row *row, struct strbuf *scratch) {
    if (row->required) {
        strbuf_cstr(out, "**required**");
        return;
    }
    emit_default_words(row, scratch);
    if (scratch->len) {
        strbuf_char(out, '`');
        cell_of(out, scratch);
        strbuf_char(out, '`');
    }
}

static void put_doc(struct strbuf *out, const struct schema_element *schema, uint32_t i,
                    struct strbuf *scratch) {
    const struct schema_row *row = &schema->rows[i];
    cell(out, str_from(row->doc));
    for (uint32_t k = 0; row->words && row->words[k]; k++) {
        strbuf_format(out, " `%s`: ", row->words[k]);
        cell(out, str_from(row->word_docs[k]));
    }
    if (emit_rivals(schema, i, "`", scratch)) {
        strbuf_cstr(out, " Not together with ");
        cell_of(out, scratch);
        strbuf_char(out, '.');
    }
    if (row->single)
        strbuf_format(out, " `%s: {...}` is short for `%s: {%s: {...}}`.", row->name, schema_yaml_key(row),
                      row->single);
}

static void put_row(struct strbuf *out, const struct schema_element *schema, uint32_t i,
                    struct strbuf *scratch) {
    const struct schema_row *row = &schema->rows[i];
    bool is_large =
        row->kind == SCHEMA_LIST || (row->kind == SCHEMA_ELEMENT && schema_short_row(row->child) < 0);
    strbuf_format(out, "| `%s` | `", row->name);
    if (is_large)
        strbuf_format(out, "%s:", schema_yaml_key(row));
    else
        emit_yaml_sample(schema, i, scratch);
    cell_of(out, scratch);
    strbuf_cstr(out, "` | `");
    if (is_large)
        strbuf_format(out, "<%s>", row->element);
    else
        emit_xml_sample(schema, i, scratch);
    cell_of(out, scratch);
    strbuf_cstr(out, "` | ");
    put_type(out, row, scratch);
    strbuf_cstr(out, " | ");
    put_default(out, row, scratch);
    strbuf_cstr(out, " | ");
    put_doc(out, schema, i, scratch);
    strbuf_cstr(out, " |\n");
}

static void put_choices(struct strbuf *out, const struct schema_element *schema) {
    for (uint8_t c = 1; c <= 3; c++) {
        const char *separator = "";
        if (schema->choices[c - 1].rule != SCHEMA_CHOICE_EXACTLY_ONE)
            continue;
        strbuf_cstr(out, "Exactly one of ");
        for (uint32_t i = 0; i < schema->row_count; i++) {
            if (schema->rows[i].choice != c)
                continue;
            strbuf_format(out, "%s`%s`", separator, schema->rows[i].name);
            separator = ", ";
        }
        strbuf_cstr(out, " is required.\n\n");
    }
}

static bool has_aside(const struct schema_element *schema) {
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (schema->rows[i].aside && !schema->rows[i].example_alone)
            return true;
    return false;
}

static void put_element(struct strbuf *out, const struct schema_element *schema, struct strbuf *scratch) {
    int only = schema_short_row(schema), list = schema_list_row(schema);
    strbuf_format(out, "\n## %s\n\n%s\n\n", schema->name, schema->doc);
    if (only >= 0)
        strbuf_format(out, "If it has only `%s`, the value of `%s` can be written instead.",
                      schema->rows[only].name, schema->rows[only].name);
    if (list >= 0 && list != only)
        strbuf_format(out, " So can the list of `%s`, in YAML.", schema->rows[list].name);
    if (only >= 0)
        strbuf_cstr(out, "\n\n");
    put_choices(out, schema);
    strbuf_cstr(out, "| attribute | YAML | XML | value | default | meaning |\n|---|---|---|---|---|---|\n");
    for (uint32_t i = 0; i < schema->row_count; i++)
        put_row(out, schema, i, scratch);
    // Nothing uses what these examples name.
    const char *mark = has_aside(schema)            ? "<!-- test: finds W205 -->\n"
                       : schema == &SCHEMA_VARIABLE ? "<!-- test: finds W207 -->\n"
                                                    : "";
    strbuf_format(out, "\n%s```yaml\n", mark);
    emit_yaml_example(schema, out);
    strbuf_format(out, "```\n\n%s```xml\n", mark);
    emit_xml_example(schema, out);
    strbuf_cstr(out, "```\n");
}

void emit_markdown(struct strbuf *out) {
    struct strbuf scratch;
    strbuf_init(&scratch);
    strbuf_cstr(out,
                "# Reference of the scene language\n\n"
                "<!-- Made from the grammar table by `glint schema markdown`; do not edit. -->\n\n"
                "Every element and attribute, in both spellings. `glint explain ELEMENT` shows the same in a "
                "terminal.\n\nElements: ");
    for (const struct schema_element *const *e = schema_elements; *e; e++) {
        if (e != schema_elements)
            strbuf_cstr(out, ", ");
        anchor(out, *e);
    }
    strbuf_cstr(out, ".\n");
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        put_element(out, *e, &scratch);
    out->failed = out->failed || scratch.failed;
    strbuf_finish(&scratch);
}
