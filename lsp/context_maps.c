#include "lsp/context_maps.h"

#include <string.h>

enum {
    BRACKETS_MOST = 65536, // bytes that are searched for them
};

// ---- pieces

str context_take_key(str text, size_t at, size_t end, size_t *after) {
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

size_t context_value_end(str text, size_t at, size_t end) {
    for (int depth = 0; at < end; at++) {
        const char c = text.ptr[at];
        if (depth == 0 && (c == ',' || c == '}' || c == ']'))
            break;
        depth += (c == '{' || c == '[' || c == '(') - (c == '}' || c == ']' || c == ')');
    }
    return at;
}

size_t context_open_bracket(str text, size_t at) {
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

size_t context_line_begin(str text, size_t at) {
    while (at > 0 && text.ptr[at - 1] != '\n')
        at--;
    return at;
}

size_t context_line_end(str text, size_t at, size_t end) {
    const char *found = at < end ? memchr(text.ptr + at, '\n', end - at) : NULL;
    return found ? (size_t)(found - text.ptr) : end;
}

size_t context_content(str text, size_t begin, size_t most, int *dash) {
    size_t at = begin;
    for (*dash = -1; at < most; at++) {
        if (text.ptr[at] == '-' && (at + 1 >= text.len || context_is_space(text.ptr[at + 1])))
            *dash = (int)(at - begin);
        else if (text.ptr[at] != ' ')
            break;
    }
    return at;
}

int context_column(str text, size_t begin, size_t *at) {
    *at = begin;
    while (*at < text.len && text.ptr[*at] == ' ')
        ++*at;
    return *at >= text.len || strchr("\r\n#", text.ptr[*at]) ? -1 : (int)(*at - begin);
}

// The end of lines that are further right than `column`, from the next line on.
static size_t block_end(str text, size_t at, int column) {
    size_t from;
    for (at = context_line_end(text, at, text.len); at < text.len;
         at = context_line_end(text, at + 1, text.len)) {
        const int here = context_column(text, at + 1, &from);
        if (here >= 0 && here <= column)
            return at;
    }
    return text.len;
}

// ---- the keys of a map

static size_t next_line_key(str text, const struct context_map *map, size_t at) {
    while (at < map->end) {
        size_t from;
        at = context_line_end(text, at, map->end) + 1;
        if (at < map->end && context_column(text, at, &from) == map->column)
            return from;
    }
    return map->end;
}

bool context_next_key(str text, const struct context_map *map, size_t *at, struct context_key *key) {
    while (*at < map->end) {
        size_t after, end;
        if (map->is_flow)
            *at = context_skip_spaces(text, *at, map->end);
        if (*at >= map->end || (map->is_flow && text.ptr[*at] == '}'))
            return false;
        key->name = context_take_key(text, *at, map->end, &after);
        if (map->is_flow) {
            end = context_value_end(text, key->name.len ? after : *at, map->end);
            *at = end < map->end && text.ptr[end] == ',' ? end + 1 : map->end;
        } else {
            *at = next_line_key(text, map, *at);
            end = *at < map->end ? context_line_begin(text, *at) : map->end;
        }
        key->begin = after < end ? after : end;
        key->end = end;
        if (key->name.len)
            return true;
    }
    return false;
}

// ---- from the inside outwards

// A line as a place for keys.
struct line {
    size_t begin, content;
    int dash;   // the column of the last '-' before the content; -1: none
    int column; // of the content; -1: the line says nothing
};

// What is behind `most` is not looked at.
static struct line read_line(str text, size_t begin, size_t most) {
    struct line line = {.begin = begin, .column = -1};
    line.content = context_content(text, begin, most, &line.dash);
    if (line.content < most && !strchr("#\r\n", text.ptr[line.content]))
        line.column = (int)(line.content - begin);
    return line;
}

// A map that has a key in a line: where it begins, going up.
static void begin_map(struct context_climb *climb, struct line line, struct context_map *map) {
    const str text = climb->text;
    struct line first = line;
    for (size_t begin = line.begin; first.dash < 0 && begin > 0;) {
        begin = context_line_begin(text, begin - 1);
        const struct line above = read_line(text, begin, context_line_end(text, begin, text.len));
        if (above.column < 0 || above.column > line.column || above.dash >= line.column)
            continue;
        if (above.column < line.column)
            break;
        first = above;
    }
    *map = (struct context_map){.begin = first.content, .column = line.column};
    map->end = block_end(text, first.content, line.column - 1);
    climb->at = first.begin;
    climb->limit = first.dash >= 0 ? first.dash : line.column;
    climb->is_inclusive = first.dash >= 0;
}

struct context_climb context_climb_from(str text, size_t offset) {
    return (struct context_climb){.text = text, .at = offset};
}

static bool climb_flow(struct context_climb *climb, struct context_map *map) {
    const str text = climb->text;
    size_t bracket, from;
    while ((bracket = context_open_bracket(text, climb->at)) != text.len) {
        climb->at = bracket;
        if (text.ptr[bracket] != '{')
            continue;
        *map = (struct context_map){.begin = bracket + 1, .is_flow = true};
        map->column = context_column(text, context_line_begin(text, bracket), &from);
        map->end = block_end(text, bracket + 1, map->column);
        return true;
    }
    return false;
}

// The map that the line of the place belongs to, which may be empty there.
static void begin_block(struct context_climb *climb, struct context_map *map) {
    const size_t begin = context_line_begin(climb->text, climb->at);
    struct line line = read_line(climb->text, begin, climb->at);
    if (line.column < 0)
        line.column = (int)(line.content - begin);
    climb->is_block = true;
    begin_map(climb, line, map);
}

bool context_climb(struct context_climb *climb, struct context_map *map) {
    const str text = climb->text;
    if (!climb->is_block) {
        if (climb_flow(climb, map))
            return true;
        begin_block(climb, map);
        return true;
    }
    for (size_t begin = climb->at; begin > 0 && climb->limit + climb->is_inclusive > 0;) {
        begin = context_line_begin(text, begin - 1);
        const struct line line = read_line(text, begin, context_line_end(text, begin, text.len));
        const int most = climb->limit - !climb->is_inclusive;
        if (line.column < 0 || line.column > most || line.dash >= climb->limit)
            continue;
        begin_map(climb, line, map);
        return true;
    }
    return false;
}
