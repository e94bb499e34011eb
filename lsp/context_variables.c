// The names that expressions at a place see, from a text that may be torn: `for: {i: 12, p: [[0, 0, 1]]}` and
// `parameters: {h: 3}` in YAML, `<For name="i" count="12"/>` and `<Parameter name="h" value="3"/>` in XML.
// And what an instance gives its object.
#include "lsp/context.h"

#include "core/expression.h"
#include "lsp/context_maps.h"
#include "parser/tree/reader.h"

#include <string.h>

enum {
    LEVELS_MOST = 100, // maps or elements around a place that are read
};

struct finding {
    str text;
    struct context_variable *variables;
    uint32_t count;
    uint32_t entries; // that have variables, from the inside outwards
    bool is_parameter;
};

static void add_variable(struct finding *finding, str name, str value, bool is_list) {
    if (!expression_is_name(name) || finding->count == CONTEXT_VARIABLES_MOST)
        return;
    finding->variables[finding->count++] = (struct context_variable){
        name, str_trim(value), is_list, finding->is_parameter, finding->entries > 0};
}

// ---- YAML

static void add_yaml(struct finding *finding, str name, str value, bool is_list) {
    const bool has_brackets = value.len && value.ptr[0] == '[';
    if (has_brackets) // the last may not be there yet
        value = str_slice(value, 1, value.len - (value.len > 1 && value.ptr[value.len - 1] == ']'));
    add_variable(finding, name, value, is_list || has_brackets);
}

static void add_value(struct finding *finding, str name, size_t begin, size_t end) {
    str value = str_trim(str_slice(finding->text, begin, end));
    size_t after;
    if (value.len && value.ptr[0] == '{') { // {count: 5}, {values: [...]}
        const str key = context_take_key(value, context_skip_spaces(value, 1, value.len), value.len, &after);
        const bool is_list = str_equal(key, STR("values"));
        value = key.len ? str_slice(value, after, context_value_end(value, after, value.len)) : STR("");
        add_yaml(finding, name, str_trim(value), is_list);
        return;
    }
    add_yaml(finding, name, value, false);
}

// The map that is the value of a key.
static bool map_in(str text, const struct context_map *outer, const struct context_key *key,
                   struct context_map *map) {
    const size_t first = context_skip_spaces(text, key->begin, key->end);
    *map =
        (struct context_map){.begin = first + 1, .end = key->end, .column = outer->column, .is_flow = true};
    if (first < key->end && text.ptr[first] == '{')
        return true;
    map->is_flow = false;
    for (size_t at = context_line_end(text, key->begin, key->end); at < key->end;
         at = context_line_end(text, at + 1, key->end)) {
        map->column = context_column(text, at + 1, &map->begin);
        if (map->column >= 0)
            return map->column > outer->column;
    }
    return false;
}

static void read_names(struct finding *finding, const struct context_map *map) {
    const str text = finding->text;
    struct context_key key;
    for (size_t at = map->begin; context_next_key(text, map, &at, &key);) {
        const size_t end = map->is_flow ? key.end : context_line_end(text, key.begin, key.end);
        const uint32_t before = finding->count;
        add_value(finding, key.name, key.begin, end);
        // A list may be in the lines below.
        if (finding->count > before && !map->is_flow && str_trim(str_slice(text, key.begin, end)).len == 0)
            finding->variables[before].is_list = true;
    }
}

static void find_yaml(struct finding *finding, size_t offset) {
    const str text = finding->text;
    struct context_climb climb = context_climb_from(text, offset);
    struct context_map map, names;
    struct context_key key;
    for (int level = 0; level < LEVELS_MOST && context_climb(&climb, &map); level++) {
        bool is_entry = false;
        for (size_t at = map.begin; context_next_key(text, &map, &at, &key);) {
            finding->is_parameter = str_equal(key.name, STR("parameters"));
            if (!finding->is_parameter && !str_equal(key.name, STR("for")))
                continue;
            is_entry |= !finding->is_parameter;
            if (map_in(text, &map, &key, &names))
                read_names(finding, &names);
        }
        finding->entries += is_entry;
    }
}

// ---- XML

// The value of an attribute in a tag; empty: it has none.
static str attribute(str tag, str name) {
    for (size_t i = 0; i + name.len < tag.len; i++) {
        if (!context_is_space(tag.ptr[i]) || !str_starts_with(str_slice(tag, i + 1, tag.len), name))
            continue;
        size_t at = context_skip_spaces(tag, i + 1 + name.len, tag.len);
        if (at >= tag.len || tag.ptr[at] != '=')
            continue;
        at = context_skip_spaces(tag, at + 1, tag.len);
        const char *end = at < tag.len && strchr("\"'", tag.ptr[at])
                              ? memchr(tag.ptr + at + 1, tag.ptr[at], tag.len - at - 1)
                              : NULL;
        return end ? str_slice(tag, at + 1, (size_t)(end - tag.ptr)) : STR("");
    }
    return STR("");
}

// A list has `values`, a variable `count`, a parameter `value`.
static void add_tag(struct finding *finding, str tag) {
    const str values = attribute(tag, STR("values"));
    const str single = attribute(tag, finding->is_parameter ? STR("value") : STR("count"));
    add_variable(finding, attribute(tag, STR("name")), values.len ? values : single, values.len > 0);
}

static bool is_tag(str tag, str name) {
    return str_starts_with(tag, name) && (tag.len == name.len || strchr(" \t\r\n/>", tag.ptr[name.len]));
}

// A tag with all behind it, up to the next one; the text's end if there is none. No value has a '<' in it.
static str next_tag(str text, size_t *at) {
    const char *begin = *at < text.len ? memchr(text.ptr + *at, '<', text.len - *at) : NULL;
    if (!begin)
        return STR("");
    const size_t from = (size_t)(begin - text.ptr);
    const char *end = memchr(begin + 1, '<', text.len - from - 1);
    *at = end ? (size_t)(end - text.ptr) : text.len;
    return str_slice(text, from, *at);
}

static bool is_whole(str tag) {
    for (size_t i = 0; i + 1 < tag.len; i++)
        if (tag.ptr[i] == '/' && tag.ptr[i + 1] == '>')
            return true;
    return false;
}

// The elements that are open at a place, from the inside outwards.
struct open_tags {
    str text;
    size_t offset, at;
    int closed;
};

// The next one; *at: where it begins.
static bool next_open_tag(struct open_tags *open, str *tag, size_t *at) {
    const str text = open->text;
    for (; open->at > 0; open->at--) {
        if (text.ptr[open->at - 1] != '<' || (open->at < text.len && strchr("!?", text.ptr[open->at])))
            continue;
        size_t end = open->at - 1;
        *tag = next_tag(text, &end);
        const bool is_here = end >= open->offset;
        if (tag->len > 1 && tag->ptr[1] == '/') {
            open->closed += !is_here;
        } else if (is_here || !is_whole(*tag)) {
            if (open->closed == 0 || is_here) {
                *at = --open->at;
                return true;
            }
            open->closed--;
        }
    }
    return false;
}

// The tags of the children of the element that begins at `at`: first that of the element itself is taken.
struct children {
    str text;
    size_t at;
    int depth;
};

static bool next_child(struct children *children, str *tag) {
    while (children->depth > 0 && (*tag = next_tag(children->text, &children->at)).len) {
        const bool is_child = children->depth == 1;
        if (tag->len > 1 && strchr("!?", tag->ptr[1]))
            continue;
        children->depth += tag->len > 1 && tag->ptr[1] == '/' ? -1 : !is_whole(*tag);
        if (is_child && children->depth >= 1)
            return true;
    }
    return false;
}

static struct children children_of(str text, size_t at) {
    struct children children = {text, at, 0};
    children.depth = !is_whole(next_tag(text, &children.at));
    return children;
}

static void find_xml(struct finding *finding, size_t offset) {
    struct open_tags open = {finding->text, offset, offset, 0};
    str tag;
    size_t at;
    for (int level = 0; level < LEVELS_MOST && next_open_tag(&open, &tag, &at); level++) {
        struct children children = children_of(finding->text, at);
        bool is_entry = false;
        while (next_child(&children, &tag)) {
            finding->is_parameter = is_tag(tag, STR("<Parameter"));
            const bool is_variable = is_tag(tag, STR("<For"));
            is_entry |= is_variable;
            if (is_variable || finding->is_parameter)
                add_tag(finding, tag);
        }
        finding->entries += is_entry;
    }
}

uint32_t context_variables(str path, str text, size_t offset,
                           struct context_variable variables[CONTEXT_VARIABLES_MOST]) {
    struct finding finding = {.text = text, .variables = variables};
    if (reader_is_xml(path, text))
        find_xml(&finding, offset);
    else
        find_yaml(&finding, offset);
    return finding.count;
}

// ---- what an instance gives

static void add_given(struct context_given *given, str name) {
    if (name.len && given->count < CONTEXT_VARIABLES_MOST)
        given->names[given->count++] = name;
}

// A name without the quotes around it and the comment after it.
static str bare_name(str value) {
    for (size_t i = 1; i < value.len; i++)
        if (value.ptr[i] == '#' && context_is_space(value.ptr[i - 1]))
            value = str_slice(value, 0, i);
    value = str_trim(value);
    if (value.len >= 2 && strchr("\"'", value.ptr[0]) && value.ptr[value.len - 1] == value.ptr[0])
        return str_slice(value, 1, value.len - 1);
    return value;
}

static void given_in_yaml(str text, size_t offset, struct context_given *given) {
    struct context_climb climb = context_climb_from(text, offset);
    struct context_map map;
    struct context_key key;
    if (!context_climb(&climb, &map))
        return;
    for (size_t at = map.begin; context_next_key(text, &map, &at, &key);)
        if (key.name.ptr > text.ptr + offset || key.name.ptr + key.name.len < text.ptr + offset)
            add_given(given, key.name);
    if (!context_climb(&climb, &map))
        return;
    for (size_t at = map.begin; context_next_key(text, &map, &at, &key);)
        if (str_equal(key.name, STR("object")))
            given->object = bare_name(str_slice(
                text, key.begin, map.is_flow ? key.end : context_line_end(text, key.begin, key.end)));
}

static void given_in_xml(str text, size_t offset, struct context_given *given) {
    struct open_tags open = {text, offset, offset, 0};
    str tag;
    size_t own, at;
    if (!next_open_tag(&open, &tag, &own) || !next_open_tag(&open, &tag, &at))
        return;
    given->object = attribute(tag, STR("object"));
    struct children children = children_of(text, at);
    while (next_child(&children, &tag))
        if (tag.ptr != text.ptr + own && is_tag(tag, STR("<With")))
            add_given(given, attribute(tag, STR("name")));
}

void context_given(str path, str text, size_t offset, struct context_given *given) {
    given->object = STR("");
    given->count = 0;
    if (reader_is_xml(path, text))
        given_in_xml(text, offset, given);
    else
        given_in_yaml(text, offset, given);
}
