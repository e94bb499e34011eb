// How a row is written, in both spellings, with the table's examples.
#include "parser/bind/say.h"

// The words of an example ("0 1 0"), at most four.
static uint32_t split(const char *text, str out[4]) {
    uint32_t count = 0;
    str rest = str_from(text);
    while (rest.len && count < 4) {
        size_t end = 0;
        while (end < rest.len && rest.ptr[end] != ' ')
            end++;
        out[count++] = str_slice(rest, 0, end);
        rest = str_trim(str_slice(rest, end, rest.len));
    }
    return count;
}

static const char *sample(const struct schema_row *row) {
    return row->example ? row->example : row->standard ? row->standard : "...";
}

static bool is_composite(enum schema_kind kind) {
    return schema_components(kind)[0] != NULL;
}

// Whether an example of an element shows this row: the required rows, and the first of a choice.
static bool is_shown(const struct schema_element *element, uint32_t i) {
    const struct schema_row *row = &element->rows[i];
    if (row->required && !row->key)
        return true;
    if (row->choice == 0 || element->choices[row->choice - 1].rule != SCHEMA_CHOICE_EXACTLY_ONE)
        return false;
    for (uint32_t k = 0; k < i; k++)
        if (element->rows[k].choice == row->choice)
            return false;
    return true;
}

// If no row is required, the first with an example is shown.
static uint32_t telling_row(const struct schema_element *element) {
    uint32_t first = element->row_count;
    for (uint32_t i = 0; i < element->row_count; i++) {
        const struct schema_row *row = &element->rows[i];
        bool is_name = row->kind == SCHEMA_TEXT && row->text == SCHEMA_TEXT_NAME;
        if (is_shown(element, i))
            return element->row_count;
        if (first == element->row_count && row->example && !row->example_alone && !row->key && !is_name)
            first = i;
    }
    return first;
}

static str yaml_list(struct arena *arena, const char *text) {
    str part[4];
    uint32_t count = split(text, part);
    str list = STR("[");
    for (uint32_t i = 0; i < count; i++)
        list = arena_format(arena, "%.*s%s%.*s", STR_ARG(list), i ? ", " : "", STR_ARG(part[i]));
    return arena_format(arena, "%.*s]", STR_ARG(list));
}

// "1 0 0 2, 0 1 0 0" as [[1, 0, 0, 2], [0, 1, 0, 0]]
static str yaml_lists(struct arena *arena, str rest) {
    str lists = STR("");
    while (rest.len) {
        const char *comma = memchr(rest.ptr, ',', rest.len);
        const size_t end = comma ? (size_t)(comma - rest.ptr) : rest.len;
        const str list = yaml_list(arena, arena_format(arena, "%.*s", (int)end, rest.ptr).ptr);
        lists = arena_format(arena, "%.*s%s%.*s", STR_ARG(lists), lists.len ? ", " : "", STR_ARG(list));
        rest = str_trim(str_slice(rest, end + (comma != NULL), rest.len));
    }
    return arena_format(arena, "[%.*s]", STR_ARG(lists));
}

static str yaml_value(struct arena *arena, const struct schema_row *row) {
    const char *text = sample(row);
    if (row->kind == SCHEMA_LIST)
        return yaml_lists(arena, str_from(text));
    bool is_text = text[0] == '#' || (row->kind == SCHEMA_TEXT && row->text == SCHEMA_TEXT_FREE);
    if (is_text)
        return arena_format(arena, "\"%s\"", text);
    if (row->many == SCHEMA_FIXED)
        return arena_format(arena, "[%.*s, [0, 0, 0]]", STR_ARG(yaml_list(arena, text)));
    return is_composite(row->kind) ? yaml_list(arena, text) : str_from(text);
}

// What is written after the key of an element: its short form, or a map with one row.
static str yaml_body(struct arena *arena, const struct schema_element *element) {
    int bare = schema_short_row(element);
    if (bare >= 0)
        return yaml_value(arena, &element->rows[bare]);
    uint32_t telling = telling_row(element);
    str body = STR("");
    for (uint32_t i = 0; i < element->row_count; i++) {
        if (i != telling && !is_shown(element, i))
            continue;
        str row = say_example(arena, &element->rows[i], false);
        body = arena_format(arena, "%.*s%s%.*s", STR_ARG(body), body.len ? ", " : "", STR_ARG(row));
    }
    return arena_format(arena, "{%.*s}", STR_ARG(body));
}

static str yaml_example(struct arena *arena, const struct schema_row *row) {
    const char *key = row->many == SCHEMA_ONE ? row->name : schema_yaml_key(row);
    if (row->kind != SCHEMA_ELEMENT && row->kind != SCHEMA_LIST)
        return arena_format(arena, "%s: %.*s", key, STR_ARG(yaml_value(arena, row)));
    str body = yaml_body(arena, row->child);
    if (row->many == SCHEMA_SEQUENCE)
        return arena_format(arena, "%s: [%.*s]", key, STR_ARG(body));
    if (row->many == SCHEMA_NAMED_MAP)
        return arena_format(arena, "%s: {%s: %.*s}", key,
                            sample(&row->child->rows[schema_key_row(row->child)]), STR_ARG(body));
    return arena_format(arena, "%s: %.*s", key, STR_ARG(body));
}

static str xml_numbers(struct arena *arena, const char *element, const struct schema_row *row,
                       const char *numbers) {
    str part[4];
    uint32_t count = split(numbers, part);
    const char *const *names = schema_components(row->kind);
    str text = arena_format(arena, "<%s", element);
    for (uint32_t i = 0; names[i]; i++) {
        str value = i < count ? part[i] : part[0];
        if (row->kind != SCHEMA_WEIGHTS || !str_equal(value, STR("0")))
            text = arena_format(arena, "%.*s %s=\"%.*s\"", STR_ARG(text), names[i], STR_ARG(value));
    }
    text = arena_format(arena, "%.*s/>", STR_ARG(text));
    if (row->many == SCHEMA_FIXED)
        text = arena_format(arena, "%.*s<%s r=\"0\" g=\"0\" b=\"0\"/>", STR_ARG(text), element);
    return text;
}

static str xml_components(struct arena *arena, const char *element, const struct schema_row *row) {
    return xml_numbers(arena, element, row, sample(row));
}

str say_components(struct arena *arena, struct bind_subject subject, str numbers) {
    const struct bind_frame *frame = subject.frame;
    bool is_bare = frame->bare && subject.row->short_form && frame->via;
    const char *element = is_bare ? frame->via->element : subject.row->element;
    str text = arena_copy(arena, numbers);
    char *c = (char *)text.ptr;
    size_t length = 0;
    for (size_t i = 0; i < text.len; i++)
        if (c[i] != ',')
            c[length++] = c[i];
    c[length] = '\0';
    return xml_numbers(arena, element ? element : subject.row->name, subject.row, c);
}

static bool is_several(const struct schema_row *row) {
    return is_composite(row->kind) && sample(row)[0] != '#';
}

// An element with its key and the rows that it needs: attributes first, then children.
static str xml_element(struct arena *arena, const char *name, const struct schema_element *element,
                       bool keyed) {
    int bare = schema_short_row(element);
    uint32_t telling = bare >= 0 ? (uint32_t)bare : telling_row(element);
    if (bare >= 0 && is_several(&element->rows[bare]))
        return xml_components(arena, name, &element->rows[bare]);
    str attributes = STR("");
    str children = STR("");
    for (uint32_t i = 0; i < element->row_count; i++) {
        if (i != telling && !is_shown(element, i) && !(keyed && element->rows[i].key))
            continue;
        str row = say_example(arena, &element->rows[i], true);
        if (row.ptr[0] == '<')
            children = arena_format(arena, "%.*s%.*s", STR_ARG(children), STR_ARG(row));
        else
            attributes = arena_format(arena, "%.*s %.*s", STR_ARG(attributes), STR_ARG(row));
    }
    if (children.len == 0)
        return arena_format(arena, "<%s%.*s/>", name, STR_ARG(attributes));
    return arena_format(arena, "<%s%.*s>%.*s</%s>", name, STR_ARG(attributes), STR_ARG(children), name);
}

static str xml_example(struct arena *arena, const struct schema_row *row) {
    const char *name = row->element ? row->element : row->name;
    if (row->kind == SCHEMA_LIST)
        return xml_element(arena, name, row->child, true);
    if (row->kind == SCHEMA_ELEMENT)
        return xml_element(arena, name, row->child, false);
    if (is_several(row) && row->element)
        return xml_components(arena, name, row);
    return arena_format(arena, "%s=\"%s\"", row->name, sample(row));
}

str say_example(struct arena *arena, const struct schema_row *row, bool is_xml) {
    return is_xml ? xml_example(arena, row) : yaml_example(arena, row);
}

str say_subject_example(struct arena *arena, struct bind_subject subject, bool is_xml) {
    const struct bind_frame *frame = subject.frame;
    bool is_bare = !subject.row || (frame->bare && subject.row->short_form);
    const struct schema_row *row = is_bare && frame->via ? frame->via : subject.row;
    return row ? say_example(arena, row, is_xml) : STR("");
}

str say_concept(struct arena *arena, const struct concept *concept, bool is_xml) {
    const struct schema_row *use = concept_use(concept);
    str example = use ? say_example(arena, use, is_xml) : STR("");
    return arena_format(arena, "%s; %s%s%.*s", concept->lacks, concept->instead, use ? ", for example " : "",
                        STR_ARG(example));
}
