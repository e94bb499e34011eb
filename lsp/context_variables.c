// The variables of the entry at a place, from a text that may be torn: `for: {i: 12, p: [[0, 0, 1]]}` in
// YAML,
// `<For name="i" count="12"/>` in XML.
#include "lsp/context.h"

#include "core/expression.h"
#include "parser/tree/reader.h"

#include <string.h>

enum {
    BRACKETS_MOST = 65536, // bytes that are searched for them
};

struct finding {
    str text;
    struct context_variable *variables;
    uint32_t count;
};

static void add_variable(struct finding *finding, str name, str value, bool is_list) {
    if (!expression_is_name(name) || finding->count == IR_VARIABLES_MOST)
        return;
    finding->variables[finding->count++] = (struct context_variable){name, str_trim(value), is_list};
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

static size_t skip_blanks(str text, size_t at, size_t end) {
    while (at < end && is_blank(text.ptr[at]))
        at++;
    return at;
}

// ---- YAML

// A key with or without quotes, and its colon. *after: behind that. Empty: there is none.
static str take_key(str text, size_t at, size_t end, size_t *after) {
    const bool is_quoted = at < end && (text.ptr[at] == '"' || text.ptr[at] == '\'');
    size_t begin = at + is_quoted, stop = begin;
    while (stop < end && !strchr(" \t\r\n:,{}[]\"'#", text.ptr[stop]))
        stop++;
    at = stop + (is_quoted && stop < end);
    while (at < end && (text.ptr[at] == ' ' || text.ptr[at] == '\t'))
        at++;
    *after = at + 1;
    return at < end && text.ptr[at] == ':' ? str_slice(text, begin, stop) : STR("");
}

// Where a value in braces ends: at the comma or bracket behind it.
static size_t value_end(str text, size_t at, size_t end) {
    for (int depth = 0; at < end; at++) {
        const char c = text.ptr[at];
        if (depth == 0 && (c == ',' || c == '}' || c == ']'))
            break;
        depth += (c == '{' || c == '[' || c == '(') - (c == '}' || c == ']' || c == ')');
    }
    return at;
}

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
        const str key = take_key(value, skip_blanks(value, 1, value.len), value.len, &after);
        const bool is_list = str_equal(key, STR("values"));
        value = key.len ? str_slice(value, after, value_end(value, after, value.len)) : STR("");
        add_yaml(finding, name, str_trim(value), is_list);
        return;
    }
    add_yaml(finding, name, value, false);
}

static void read_braces(struct finding *finding, size_t at, size_t end) {
    const str text = finding->text;
    while (at < end && text.ptr[at] != '}') {
        size_t after;
        at = skip_blanks(text, at, end);
        const str name = take_key(text, at, end, &after);
        const size_t stop = value_end(text, name.len ? after : at, end);
        if (name.len)
            add_value(finding, name, after, stop);
        if (stop >= end || text.ptr[stop] != ',')
            break;
        at = stop + 1;
    }
}

static size_t line_end(str text, size_t at, size_t end) {
    const char *found = at < end ? memchr(text.ptr + at, '\n', end - at) : NULL;
    return found ? (size_t)(found - text.ptr) : end;
}

static size_t line_begin(str text, size_t at) {
    while (at > 0 && text.ptr[at - 1] != '\n')
        at--;
    return at;
}

// The column of the first thing in a line; *at: its place. -1: the line is empty, or a comment.
static int column_of(str text, size_t begin, size_t *at) {
    *at = begin;
    while (*at < text.len && text.ptr[*at] == ' ')
        ++*at;
    return *at >= text.len || strchr("\r\n#", text.ptr[*at]) ? -1 : (int)(*at - begin);
}

// The end of lines that are further right than `column`, from the next line on.
static size_t block_end(str text, size_t at, int column) {
    size_t from;
    for (at = line_end(text, at, text.len); at < text.len; at = line_end(text, at + 1, text.len)) {
        const int here = column_of(text, at + 1, &from);
        if (here >= 0 && here <= column)
            return at;
    }
    return text.len;
}

// The variables behind `for:`, whose line begins at a column.
static void read_variables(struct finding *finding, size_t at, size_t end, int column) {
    const str text = finding->text;
    const size_t first = skip_blanks(text, at, end);
    if (first < end && text.ptr[first] == '{') {
        read_braces(finding, first + 1, end);
        return;
    }
    int own = -1;
    for (at = line_end(text, at, end); at < end; at = line_end(text, at + 1, end)) {
        size_t from, after;
        const int here = column_of(text, at + 1, &from);
        if (here < 0)
            continue;
        if (here <= column)
            return;
        own = own < 0 ? here : own;
        const str name = here == own ? take_key(text, from, end, &after) : STR("");
        const size_t stop = name.len ? line_end(text, after, end) : 0;
        if (name.len)
            add_value(finding, name, after, stop);
        // A list may be in the lines below.
        if (name.len && str_trim(str_slice(text, after, stop)).len == 0)
            finding->variables[finding->count - (finding->count > 0)].is_list = true;
    }
}

// The bracket that is open at `at`, looking back; text.len: none.
static size_t open_brace(str text, size_t at) {
    int depth = 0;
    const size_t least = at > BRACKETS_MOST ? at - BRACKETS_MOST : 0;
    for (; at > least; at--) {
        const char c = text.ptr[at - 1];
        depth += c == '}' || c == ']';
        if ((c == '{' || c == '[') && depth-- == 0)
            return at - 1;
    }
    return text.len;
}

// `for` among the keys of braces that begin before `at`.
static bool read_flow_entry(struct finding *finding, size_t at) {
    const str text = finding->text;
    size_t from;
    const int column = column_of(text, line_begin(text, at), &from);
    const size_t end = block_end(text, at, column);
    while (at < end && text.ptr[at] != '}') {
        size_t after;
        at = skip_blanks(text, at, end);
        const str key = take_key(text, at, end, &after);
        if (str_equal(key, STR("for"))) {
            read_variables(finding, after, end, column);
            return true;
        }
        at = value_end(text, key.len ? after : at, end);
        if (at >= end || text.ptr[at] != ',')
            return false;
        at++;
    }
    return false;
}

// `for` among the keys in the lines from `at`, all of which begin at a column.
static bool read_block_entry(struct finding *finding, size_t at, int column) {
    const str text = finding->text;
    const size_t end = block_end(text, at, column - 1);
    while (at < end) {
        size_t after;
        if (str_equal(take_key(text, at, end, &after), STR("for"))) {
            read_variables(finding, after, end, column);
            return true;
        }
        int here = -1;
        do {
            at = line_end(text, at, end) + 1;
            size_t from;
            here = at < end ? column_of(text, at, &from) : -1;
            if (here == column)
                at = from;
        } while (at < end && here != column);
    }
    return false;
}

static void find_yaml(struct finding *finding, size_t offset) {
    const str text = finding->text;
    size_t at = offset, bracket;
    while ((bracket = open_brace(text, at)) != text.len) {
        if (text.ptr[bracket] == '{' && read_flow_entry(finding, bracket + 1))
            return;
        at = bracket;
    }
    size_t from, begin = line_begin(text, at);
    int limit = column_of(text, begin, &from); // entries begin left of it
    limit = limit < 0 || from > at ? (int)(at - begin) : limit;
    for (bool is_first = true;; is_first = false) {
        const int here = column_of(text, begin, &from);
        const bool is_dash =
            here >= 0 && text.ptr[from] == '-' && from + 1 < text.len && is_blank(text.ptr[from + 1]);
        if (is_dash && (here < limit || is_first)) {
            size_t content = from + 1;
            while (content < text.len && (text.ptr[content] == ' ' || text.ptr[content] == '-'))
                content++;
            if (read_block_entry(finding, content, (int)(content - begin)))
                return;
        }
        limit = here >= 0 && here < limit ? here : limit;
        if (begin == 0 || limit <= 0)
            return;
        begin = line_begin(text, begin - 1);
    }
}

// ---- XML

// The value of an attribute in a tag; empty: it has none.
static str attribute(str tag, str name) {
    for (size_t i = 0; i + name.len < tag.len; i++) {
        if (!is_blank(tag.ptr[i]) || !str_starts_with(str_slice(tag, i + 1, tag.len), name))
            continue;
        size_t at = skip_blanks(tag, i + 1 + name.len, tag.len);
        if (at >= tag.len || tag.ptr[at] != '=')
            continue;
        at = skip_blanks(tag, at + 1, tag.len);
        const char *end = at < tag.len && strchr("\"'", tag.ptr[at])
                              ? memchr(tag.ptr + at + 1, tag.ptr[at], tag.len - at - 1)
                              : NULL;
        return end ? str_slice(tag, at + 1, (size_t)(end - tag.ptr)) : STR("");
    }
    return STR("");
}

static void add_tag(struct finding *finding, str tag) {
    const str values = attribute(tag, STR("values"));
    add_variable(finding, attribute(tag, STR("name")), values.len ? values : attribute(tag, STR("count")),
                 values.len > 0);
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

// The <For> elements that are children of the element at `at`.
static bool read_children(struct finding *finding, size_t at) {
    int depth = 0;
    str tag = next_tag(finding->text, &at);
    for (depth = is_whole(tag) ? 0 : 1; depth > 0 && (tag = next_tag(finding->text, &at)).len;) {
        if (tag.len > 1 && strchr("!?", tag.ptr[1]))
            continue;
        if (depth == 1 && is_tag(tag, STR("<For")))
            add_tag(finding, tag);
        depth += tag.len > 1 && tag.ptr[1] == '/' ? -1 : !is_whole(tag);
    }
    return finding->count > 0;
}

// From the inside outwards: each element that is open at the place.
static void find_xml(struct finding *finding, size_t offset) {
    const str text = finding->text;
    int closed = 0;
    for (size_t at = offset; at > 0; at--) {
        if (text.ptr[at - 1] != '<' || (at < text.len && strchr("!?", text.ptr[at])))
            continue;
        size_t end = at - 1;
        const str tag = next_tag(text, &end);
        const bool is_here = end >= offset;
        if (tag.len > 1 && tag.ptr[1] == '/')
            closed += !is_here;
        else if (!is_here && is_whole(tag))
            continue;
        else if (closed > 0)
            closed--;
        else if (read_children(finding, at - 1))
            return;
    }
}

uint32_t context_variables(str path, str text, size_t offset,
                           struct context_variable variables[IR_VARIABLES_MOST]) {
    struct finding finding = {text, variables, 0};
    if (reader_is_xml(path, text))
        find_xml(&finding, offset);
    else
        find_yaml(&finding, offset);
    return finding.count;
}
