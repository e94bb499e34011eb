#include "grammar/emit/explain.h"

#include "core/nearest.h"
#include "diag/diag.h"
#include "diag/diag_policy.h"
#include "diag/diag_text.h"
#include "grammar/concept.h"
#include "grammar/emit/emit_words.h"

#include <string.h>

enum {
    EXPLAIN_WIDTH = 88,      // columns
    SUGGEST_BYTES = 1 << 20, // for the names of all attributes
};

struct explainer {
    struct strbuf *out;
    bool color;
};

static const char bold[] = "\033[1m";
static const char cyan[] = "\033[36m";
static const char plain[] = "\033[0m";

static void put(struct explainer *e, const char *style, const char *text) {
    if (e->color)
        strbuf_cstr(e->out, style);
    strbuf_cstr(e->out, text);
    if (e->color)
        strbuf_cstr(e->out, plain);
}

// Wraps words into lines of at most EXPLAIN_WIDTH columns.
static void paragraph(struct explainer *e, uint32_t indent, const char *text) {
    size_t column = 0;
    str rest = str_from(text);
    while (rest.len) {
        size_t end = 0;
        while (end < rest.len && rest.ptr[end] != ' ')
            end++;
        str word = str_slice(rest, 0, end);
        size_t width = utf8_count(word);
        if (column && column + 1 + width > EXPLAIN_WIDTH) {
            strbuf_char(e->out, '\n');
            column = 0;
        }
        strbuf_repeat(e->out, ' ', column ? 1 : indent);
        strbuf_str(e->out, word);
        column += width + (column ? 1 : indent);
        rest = str_trim(str_slice(rest, end, rest.len));
    }
    strbuf_char(e->out, '\n');
}

static void paragraph_of(struct explainer *e, uint32_t indent, struct strbuf *text) {
    paragraph(e, indent, text->data ? text->data : "");
    e->out->failed = e->out->failed || text->failed;
    strbuf_clear(text);
}

// ---- codes

static void explain_code(struct explainer *e, diag_code code) {
    static const struct {
        unsigned where;
        const char *text;
    } places[] = {
        {DIAG_IN_YAML, "YAML scenes"},
        {DIAG_IN_XML, "XML scenes"},
        {DIAG_IN_MESH, "mesh and material files"},
        {DIAG_IN_IMAGE, "image files"},
        {DIAG_IN_COMMAND, "what the command line asks for"},
    };
    const struct diag_info *info = diag_info(code);
    put(e, bold, info->code);
    strbuf_format(e->out, " (%s): %s\n\n", diag_severity_name(info->severity), info->title);
    paragraph(e, 2, info->meaning);
    strbuf_char(e->out, '\n');
    struct strbuf text;
    strbuf_init(&text);
    strbuf_format(&text, "What to do: %s", info->remedy);
    paragraph_of(e, 2, &text);
    strbuf_char(e->out, '\n');
    strbuf_cstr(&text, "Occurs in ");
    unsigned left = 0;
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++)
        left += (info->where & places[i].where) != 0;
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        if (!(info->where & places[i].where))
            continue;
        strbuf_cstr(&text, places[i].text);
        strbuf_cstr(&text, --left > 1 ? ", " : left == 1 ? " and " : ".");
    }
    paragraph_of(e, 2, &text);
    strbuf_finish(&text);
}

// ---- rows

static void put_facts(struct explainer *e, const struct schema_element *schema, uint32_t i, uint32_t indent) {
    const struct schema_row *row = &schema->rows[i];
    struct strbuf text;
    struct strbuf part;
    strbuf_init(&text);
    strbuf_init(&part);
    emit_type_words(row, &text);
    emit_range_words(row, &part);
    if (part.len)
        strbuf_format(&text, "; %s", part.data);
    strbuf_clear(&part);
    emit_default_words(row, &part);
    if (row->required)
        strbuf_cstr(&text, "; required");
    else if (part.len)
        strbuf_format(&text, "; default %s", part.data);
    strbuf_clear(&part);
    if (emit_rivals(schema, i, "'", &part))
        strbuf_format(&text, "; not together with %s", part.data);
    strbuf_finish(&part);
    paragraph_of(e, indent, &text);
    strbuf_finish(&text);
}

static void put_samples(struct explainer *e, const struct schema_element *schema, uint32_t i,
                        uint32_t indent) {
    struct strbuf text;
    strbuf_init(&text);
    for (int xml = 0; xml < 2; xml++) {
        if (xml)
            emit_xml_sample(schema, i, &text);
        else
            emit_yaml_sample(schema, i, &text);
        strbuf_repeat(e->out, ' ', indent);
        strbuf_cstr(e->out, xml ? "XML   " : "YAML  ");
        put(e, cyan, text.data ? text.data : "");
        strbuf_char(e->out, '\n');
        strbuf_clear(&text);
    }
    strbuf_finish(&text);
}

static void put_words(struct explainer *e, const struct schema_row *row, uint32_t indent) {
    struct strbuf text;
    strbuf_init(&text);
    for (uint32_t k = 0; row->words && row->words[k]; k++) {
        strbuf_format(&text, "%s: %s", row->words[k], row->word_docs[k]);
        paragraph_of(e, indent, &text);
    }
    strbuf_finish(&text);
}

static void explain_row(struct explainer *e, const struct schema_element *schema, uint32_t i,
                        uint32_t indent) {
    const struct schema_row *row = &schema->rows[i];
    put_facts(e, schema, i, indent);
    paragraph(e, indent, row->doc);
    put_words(e, row, indent + 2);
    bool is_large =
        row->kind == SCHEMA_LIST || (row->kind == SCHEMA_ELEMENT && schema_short_row(row->child) < 0);
    if (!is_large) {
        put_samples(e, schema, i, indent);
        return;
    }
    strbuf_repeat(e->out, ' ', indent);
    strbuf_format(e->out, "YAML  '%s', XML <%s>: see 'glint explain %s'\n", schema_yaml_key(row),
                  row->element, row->child->name);
}

static void explain_attribute(struct explainer *e, const struct schema_element *schema, uint32_t i) {
    if (e->color)
        strbuf_cstr(e->out, bold);
    strbuf_format(e->out, "%s.%s", schema->name, schema->rows[i].name);
    if (e->color)
        strbuf_cstr(e->out, plain);
    strbuf_cstr(e->out, "\n\n");
    explain_row(e, schema, i, 2);
}

// ---- elements

static void put_example(struct explainer *e, const char *title, struct strbuf *example) {
    strbuf_format(e->out, "\n%s\n\n", title);
    str rest = strbuf_view(example);
    while (rest.len) {
        size_t end = 0;
        while (end < rest.len && rest.ptr[end] != '\n')
            end++;
        if (end)
            strbuf_repeat(e->out, ' ', 2);
        if (e->color)
            strbuf_cstr(e->out, cyan);
        strbuf_str(e->out, str_slice(rest, 0, end));
        if (e->color)
            strbuf_cstr(e->out, plain);
        strbuf_char(e->out, '\n');
        rest = str_slice(rest, end + 1, rest.len);
    }
    e->out->failed = e->out->failed || example->failed;
    strbuf_clear(example);
}

// Where the element is written: under its own name, or as the value of an attribute of another.
static void put_spellings(struct explainer *e, const struct schema_element *schema) {
    const struct schema_row *holder = NULL;
    const struct schema_element *owner = NULL;
    bool own = schema == &SCHEMA_SCENE;
    for (const struct schema_element *const *s = schema_elements; *s; s++)
        for (uint32_t i = 0; i < (*s)->row_count; i++) {
            const struct schema_row *row = &(*s)->rows[i];
            if (row->child != schema || !row->element)
                continue;
            own = own || strcmp(row->element, schema->element) == 0;
            owner = *s;
            holder = row;
        }
    if (own || !holder)
        strbuf_format(e->out, "  (XML: <%s>)\n\n", schema->element);
    else
        strbuf_format(e->out, "  (the value of %s.%s, XML: <%s>)\n\n", owner->name, holder->name,
                      holder->element);
}

static void explain_element(struct explainer *e, const struct schema_element *schema) {
    put(e, bold, schema->name);
    put_spellings(e, schema);
    paragraph(e, 2, schema->doc);
    for (uint32_t i = 0; i < schema->row_count; i++) {
        strbuf_cstr(e->out, "\n  ");
        put(e, bold, schema->rows[i].name);
        strbuf_char(e->out, '\n');
        explain_row(e, schema, i, 4);
    }
    struct strbuf example;
    strbuf_init(&example);
    emit_yaml_example(schema, &example);
    put_example(e, "In YAML:", &example);
    emit_xml_example(schema, &example);
    put_example(e, "In XML:", &example);
    strbuf_finish(&example);
}

// ---- what is meant

// Whether two names differ in style only: LookAt, look_at, look-at, lookat.
static bool is_called(str name, const char *known) {
    size_t at = 0;
    for (;; known++, at++) {
        while (at < name.len && (name.ptr[at] == '_' || name.ptr[at] == '-'))
            at++;
        while (*known == '_')
            known++;
        if (at == name.len || !*known)
            return at == name.len && !*known;
        if (char_lower(name.ptr[at]) != char_lower(*known))
            return false;
    }
}

static bool is_row(const struct schema_row *row, str name) {
    return is_called(name, row->name) || is_called(name, schema_yaml_key(row));
}

static const struct schema_element *find_element(str name) {
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        if (is_called(name, (*e)->name) || str_equal_cstr(name, (*e)->element))
            return *e;
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++)
        if (SCHEMA_SCENE.rows[i].child && is_row(&SCHEMA_SCENE.rows[i], name))
            return SCHEMA_SCENE.rows[i].child;
    return NULL;
}

static int find_row(const struct schema_element *schema, str name) {
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (is_row(&schema->rows[i], name))
            return (int)i;
    return -1;
}

// The only element that has this attribute, and its row; NULL: none, or several.
static const struct schema_element *find_alone(str name, int *row) {
    const struct schema_element *only = NULL;
    for (const struct schema_element *const *s = schema_elements; *s; s++) {
        int i = find_row(*s, name);
        if (i >= 0 && only)
            return NULL;
        only = i >= 0 ? *s : only;
        *row = i >= 0 ? i : *row;
    }
    return only;
}

static bool is_component(const struct schema_row *row, str name) {
    const char *const *names = schema_components(row->kind);
    while (*names && !is_called(name, *names))
        names++;
    return *names != NULL;
}

// The part of a path up to the next '.', an index in brackets left out.
static str next_part(str *rest) {
    size_t end = 0;
    while (end < rest->len && rest->ptr[end] != '.')
        end++;
    str part = str_slice(*rest, 0, end);
    *rest = str_slice(*rest, end < rest->len ? end + 1 : end, rest->len);
    const char *bracket = part.len ? memchr(part.ptr, '[', part.len) : NULL;
    return bracket ? str_slice(part, 0, (size_t)(bracket - part.ptr)) : part;
}

// "material.diffuse_color.checker": an element, then rows, each inside the one before. Paths of --set, with
// indices and names of entries, are understood too.
static bool explain_path(struct explainer *e, str what) {
    if (what.len && what.ptr[what.len - 1] == '.')
        return false;
    str first = next_part(&what);
    const struct schema_element *schema = find_element(first);
    bool may_be_name = schema && schema_key_row(schema) >= 0;
    int row = -1;
    if (!schema && what.len)
        schema = find_alone(first, &row);
    while (schema && what.len) {
        str part = next_part(&what);
        const struct schema_row *above = row >= 0 ? &schema->rows[row] : NULL;
        if (above && what.len == 0 && is_component(above, part))
            break;
        if (above)
            schema = above->child;
        row = schema ? find_row(schema, part) : -1;
        if (schema && row < 0)
            row = schema_find_also(schema, part, 0);
        if (row < 0 && !(may_be_name && what.len))
            return false;
        may_be_name = false;
    }
    if (!schema)
        return false;
    if (row < 0)
        explain_element(e, schema);
    else
        explain_attribute(e, schema, (uint32_t)row);
    return true;
}

// "AreaLight", "area-light" and "area light" are area_light.
static void put_snake(struct strbuf *out, str what) {
    for (size_t i = 0; i < what.len; i++) {
        char c = what.ptr[i];
        char before = i ? what.ptr[i - 1] : '_';
        if (char_lower(c) != c && char_lower(before) == before && before != '_' && before != '-' &&
            before != ' ')
            strbuf_char(out, '_');
        strbuf_char(out, c == '-' || c == ' ' ? '_' : char_lower(c));
    }
}

// A feature that other tools have.
static bool explain_concept(struct explainer *e, str what) {
    struct strbuf text;
    strbuf_init(&text);
    put_snake(&text, what);
    const struct concept *concept = concept_find(NULL, strbuf_view(&text));
    strbuf_clear(&text);
    if (concept) {
        put(e, bold, concept->title);
        strbuf_cstr(e->out, "\n\n");
        strbuf_format(&text, "In glint %s; %s.", concept->lacks, concept->instead);
        paragraph_of(e, 2, &text);
        strbuf_cstr(&text, concept->example ? concept->example : "");
        if (concept->example)
            put_example(e, "In YAML:", &text);
    }
    strbuf_finish(&text);
    return concept != NULL;
}

// What other programs call `what`: explained if it is one attribute, else all are listed.
static bool explain_other_word(struct explainer *e, str what, bool *known) {
    const struct schema_element *last = NULL;
    unsigned count = 0;
    for (const struct schema_element *const *s = schema_elements; *s; s++)
        if (schema_find_also(*s, what, 0) >= 0) {
            last = *s;
            count++;
        }
    if (count == 1)
        explain_attribute(e, last, (uint32_t)schema_find_also(last, what, 0));
    *known = count > 1;
    if (!*known)
        return count == 1;
    strbuf_format(e->out, "several attributes are like '%.*s'; say which: ", STR_ARG(what));
    for (const struct schema_element *const *s = schema_elements; *s; s++) {
        const int row = schema_find_also(*s, what, 0);
        if (row >= 0) {
            strbuf_format(e->out, "'%s.%s'", (*s)->name, (*s)->rows[row].name);
            strbuf_cstr(e->out, --count > 1 ? ", " : count == 1 ? " or " : "\n");
        }
    }
    return false;
}

// After an attribute: what else other programs call so.
static void put_other_meanings(struct explainer *e, str what) {
    struct strbuf text;
    strbuf_init(&text);
    for (const struct schema_element *const *s = schema_elements; *s; s++) {
        const int row = schema_find_also(*s, what, 0);
        if (row >= 0)
            strbuf_format(&text, "%s'%s.%s'",
                          text.len ? ", " : "Other programs use this word for what is here ", (*s)->name,
                          (*s)->rows[row].name);
    }
    if (text.len) {
        strbuf_char(&text, '.');
        strbuf_char(e->out, '\n');
        paragraph_of(e, 2, &text);
    }
    strbuf_finish(&text);
}

// The first of the elements that have an attribute, if it is the same in all of them; else NULL. Appends
// their names.
static const struct schema_element *find_alike(str what, int *row, struct strbuf *names) {
    const struct schema_element *first = NULL;
    for (const struct schema_element *const *s = schema_elements; *s; s++) {
        const int here = find_row(*s, what);
        if (here < 0)
            continue;
        if (first && strcmp((*s)->rows[here].doc, first->rows[*row].doc) != 0)
            return NULL;
        strbuf_format(names, "%s%s", names->len ? ", " : "", (*s)->name);
        first = first ? first : *s;
        *row = *s == first ? here : *row;
    }
    return first;
}

static bool explain_alike(struct explainer *e, str what) {
    int row = -1;
    struct strbuf names, text;
    strbuf_init(&names), strbuf_init(&text);
    const struct schema_element *first = find_alike(what, &row, &names);
    if (first) {
        explain_attribute(e, first, (uint32_t)row);
        strbuf_format(&text, "It is the same in all that have it: %.*s.", STR_ARG(strbuf_view(&names)));
        strbuf_char(e->out, '\n');
        paragraph_of(e, 2, &text);
    }
    strbuf_finish(&names), strbuf_finish(&text);
    return first != NULL;
}

// An attribute without its element: explained if only one element has it or it is the same in all, else the
// elements are listed.
static bool explain_alone(struct explainer *e, str what, bool *known) {
    int row = -1;
    const struct schema_element *only = find_alone(what, &row);
    *known = only || row >= 0;
    if (only) {
        explain_attribute(e, only, (uint32_t)row);
        put_other_meanings(e, what);
    }
    if (only || row < 0)
        return only || explain_concept(e, what) || explain_other_word(e, what, known);
    if (explain_alike(e, what))
        return true;
    strbuf_format(e->out, "several elements have '%.*s'; say which: ", STR_ARG(what));
    unsigned left = 0;
    for (const struct schema_element *const *s = schema_elements; *s; s++)
        left += find_row(*s, what) >= 0;
    for (const struct schema_element *const *s = schema_elements; *s; s++) {
        row = find_row(*s, what);
        if (row < 0)
            continue;
        strbuf_format(e->out, "'%s.%s'", (*s)->name, (*s)->rows[row].name);
        strbuf_cstr(e->out, --left > 1 ? ", " : left == 1 ? " or " : "\n");
    }
    return false;
}

// The nearest of all names that can be explained.
static str suggest(str what, struct arena *arena) {
    struct nearest search = nearest_begin(what);
    bool dotted = memchr(what.ptr, '.', what.len) != NULL;
    for (diag_code code = diag_next(-1); code < DIAG_CODE_COUNT && !dotted; code = diag_next(code)) {
        str text = str_from(diag_info(code)->code);
        if (nearest_distance(what, text) == 1)
            nearest_offer(&search, text);
    }
    for (const struct schema_element *const *s = schema_elements; *s; s++) {
        if (!dotted)
            nearest_offer(&search, str_from((*s)->name));
        for (uint32_t i = 0; i < (*s)->row_count; i++) {
            const char *name = (*s)->rows[i].name;
            nearest_offer(&search, dotted ? arena_format(arena, "%s.%s", (*s)->name, name) : str_from(name));
        }
    }
    return nearest_best(&search);
}

bool explain_codes(str family, struct strbuf *out) {
    bool any = false;
    for (diag_code i = diag_next(-1); i < DIAG_CODE_COUNT; i = diag_next(i)) {
        const struct diag_info *info = diag_info(i);
        if (family.len && !diag_code_matches(i, family))
            continue;
        strbuf_format(out, "%s  %-7s  %s\n", info->code, diag_severity_name(info->severity), info->title);
        any = true;
    }
    if (!any)
        strbuf_format(out,
                      "there is no code '%.*s'; a code is a letter and three digits, such as W401, or a "
                      "family, such as W4xx",
                      STR_ARG(family));
    return any;
}

bool explain(str what, bool color, struct strbuf *out) {
    struct explainer e = {out, color};
    diag_code code = diag_find(what);
    if (code != DIAG_CODE_COUNT) {
        explain_code(&e, code);
        return true;
    }
    bool known = false;
    if (explain_path(&e, what) || explain_alone(&e, what, &known))
        return true;
    if (known)
        return false;
    struct arena arena;
    arena_init(&arena, SUGGEST_BYTES);
    str best = suggest(what, &arena);
    strbuf_format(out, "'%.*s' is not a code, element or attribute", STR_ARG(what));
    if (best.len)
        strbuf_format(out, "; did you mean '%.*s'?\n", STR_ARG(best));
    else
        strbuf_cstr(out, "; begin with 'glint explain scene'\n");
    arena_finish(&arena);
    return false;
}
