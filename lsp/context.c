#include "lsp/context.h"
#include "lsp/context_maps.h"

#include "parser/tree/reader.h"

#include <string.h>

enum {
    DEPTH_MAX = 32,
};

// From the inside outwards.
struct path {
    str keys[DEPTH_MAX]; // empty: an entry of a list, or of braces without a key
    int count;
};

static void push(struct path *path, str key) {
    if (path->count < DEPTH_MAX)
        path->keys[path->count++] = key;
}

// ---- YAML

// The word before a ':' that only spaces separate from `end`; empty: there is none.
static str key_before(str text, size_t begin, size_t end) {
    while (end > begin && strchr(" \t", text.ptr[end - 1]))
        end--;
    if (end == begin || text.ptr[end - 1] != ':')
        return STR("");
    size_t stop = --end;
    while (end > begin && !strchr(" \t{[,\"'", text.ptr[end - 1]))
        end--;
    return str_slice(text, end, stop);
}

// A key at the beginning of a line with nothing after it but its value.
static str line_key(str text, size_t from) {
    size_t end = from;
    while (end < text.len && !strchr(":\n\r{[", text.ptr[end]))
        end++;
    return end < text.len && text.ptr[end] == ':' ? str_slice(text, from, end) : STR("");
}

// Collects the keys above a place in block style, by columns.
static void climb(str text, size_t at, struct path *path) {
    size_t begin = context_line_begin(text, at);
    int dash;
    int column = (int)(context_content(text, begin, at, &dash) - begin);
    int limit = dash >= 0 ? dash : column; // a parent key is left of it; it may be directly above a '-'
    bool in_list = dash >= 0;
    if (in_list)
        push(path, STR(""));
    while (begin > 0 && limit + in_list > 0) {
        size_t end = begin - 1;
        begin = context_line_begin(text, end);
        size_t from = context_content(text, begin, end, &dash);
        int here = (int)(from - begin);
        if (from == end || text.ptr[from] == '#' || text.ptr[from] == '\r')
            continue;
        if (!in_list && dash >= 0 && dash < limit && here >= limit) {
            in_list = true; // another key of the same entry
            limit = dash;
            push(path, STR(""));
        }
        str key = line_key(text, from);
        if (key.len == 0 || here > limit || (here == limit && !(in_list && dash < 0)))
            continue;
        push(path, key);
        limit = dash >= 0 ? dash : here;
        in_list = dash >= 0;
        if (in_list)
            push(path, STR(""));
    }
}

static struct path yaml_path(str text, size_t offset, bool *is_flow) {
    struct path path = {.count = 0};
    size_t at = offset;
    size_t bracket;
    while ((bracket = context_open_bracket(text, at)) != text.len) {
        *is_flow = true;
        push(&path, key_before(text, context_line_begin(text, bracket), bracket));
        at = bracket;
    }
    // The key in front of the outermost bracket is at the beginning of its line, or the line has a '-' there.
    if (*is_flow) {
        size_t begin = context_line_begin(text, at);
        int dash;
        size_t from = context_content(text, begin, at, &dash);
        at = from;
    }
    climb(text, at, &path);
    return path;
}

static const struct schema_element *of_yaml(const struct path *path, const struct schema_element **name_of) {
    const struct schema_element *schema = &SCHEMA_SCENE;
    for (int i = path->count - 1; i >= 0; i--) {
        bool single = false;
        if (path->keys[i].len == 0)
            continue;
        int row = schema_find_yaml(schema, path->keys[i], &single);
        if (row < 0 || !schema->rows[row].child)
            return NULL;
        bool named = schema->rows[row].many == SCHEMA_NAMED_MAP && !single;
        schema = schema->rows[row].child;
        if (named && --i < 0) {
            *name_of = schema;
            return NULL; // a name is typed
        }
    }
    return schema;
}

// ---- XML

// The end of the tag, comment or instruction that begins at `at`; the end of the text if it is not closed.
static size_t markup_end(str text, size_t at, size_t end) {
    bool comment = end - at > 3 && memcmp(text.ptr + at, "<!--", 4) == 0;
    char quote = 0;
    for (size_t i = at + 1; i < end; i++) {
        char c = text.ptr[i];
        if (comment ? c == '>' && i >= at + 6 && memcmp(text.ptr + i - 2, "--", 2) == 0 : c == '>' && !quote)
            return i + 1;
        if (!comment && (c == '"' || c == '\''))
            quote = quote == c ? 0 : quote ? quote : c;
    }
    return end;
}

static str tag_name(str text, size_t at, size_t end) {
    size_t stop = at;
    while (stop < end && !strchr(" \t\r\n/>", text.ptr[stop]))
        stop++;
    return str_slice(text, at, stop);
}

// The elements that are open at a place, the outermost first; *in_tag: it is in the tag of the last one.
static struct path xml_path(str text, size_t offset, bool *in_tag) {
    struct path path = {.count = 0};
    *in_tag = false;
    for (size_t at = 0; at + 1 < offset;) {
        if (text.ptr[at] != '<') {
            at++;
            continue;
        }
        size_t end = markup_end(text, at, offset);
        bool closed = text.ptr[end - 1] == '>';
        char first = text.ptr[at + 1];
        if (first == '/')
            path.count -= path.count > 0;
        else if (first != '!' && first != '?')
            push(&path, tag_name(text, at + 1, end));
        if (closed && first != '!' && first != '?' && first != '/' && text.ptr[end - 2] == '/')
            path.count -= path.count > 0;
        *in_tag = !closed && first != '/';
        at = end;
    }
    return path;
}

static const struct schema_element *of_xml(const struct path *path) {
    const struct schema_element *schema = NULL;
    for (int i = 0; i < path->count; i++) {
        int row = i ? schema_find_child(schema, path->keys[i]) : -1;
        schema = i == 0                                ? &SCHEMA_SCENE
                 : row < 0 || !schema->rows[row].child ? NULL
                                                       : schema->rows[row].child;
        if (!schema)
            return NULL;
    }
    return schema;
}

struct context context_at(str path, str text, size_t offset) {
    struct context context = {.is_xml = reader_is_xml(path, text)};
    if (context.is_xml) {
        bool in_tag;
        struct path open = xml_path(text, offset, &in_tag);
        context.in_children = offset > 0 && text.ptr[offset - 1] == '<';
        if (context.in_children || in_tag)
            context.schema = of_xml(&open);
    } else {
        struct path keys = yaml_path(text, offset, &context.is_flow);
        context.schema = of_yaml(&keys, &context.named);
    }
    return context;
}
