#include "parser/format/format_internal.h"
#include "parser/tree/reader_text.h"
#include "parser/yaml/yaml_tokens.h"

enum join {
    JOIN_NONE,  // directly after the previous text
    JOIN_SPACE, // on its line
    JOIN_LINE,  // on a line of its own
};

// A level of indentation, in the source and in what is written.
struct level {
    uint32_t source, written;
};

struct printer {
    struct arena *arena;
    str text;
    struct yaml_tokens tokens;
    uint32_t at;  // the next token
    uint32_t gap; // where the last one ended
    enum yaml_token_kind last;
    bool keeps_breaks; // the last token is block text whose trailing empty lines count
    struct format_lines *lines;
    struct format_place place; // of the last comment
    struct {
        struct level *items;
        uint32_t count, capacity;
    } closed;           // block lists and maps that ended since the last token, the innermost first
    struct level level; // of the block list or map that is being written
};

static const struct yaml_token *peek(const struct printer *p) {
    return &p->tokens.items[p->at];
}

// Whether a line ends between two places.
static bool has_break(const struct printer *p, uint32_t begin, uint32_t end) {
    for (uint32_t i = begin; i < end; i++)
        if (str_yaml_break_length(p->text, i))
            return true;
    return false;
}

static bool breaks_before(const struct printer *p, const struct yaml_token *token) {
    return has_break(p, p->gap, token->begin);
}

// ---- between tokens

// Where a comment on a line of its own goes: it stays with the block that it was indented with.
static uint32_t comment_indent(const struct printer *p, uint32_t column, uint32_t indent) {
    bool empty_value = p->last == YAML_TOKEN_COLON || p->last == YAML_TOKEN_ITEM;
    struct level inner = p->closed.count ? p->closed.items[0] : p->level;
    if (empty_value && indent <= inner.written && column > inner.source)
        return inner.written + FORMAT_INDENT;
    for (uint32_t i = 0; i < p->closed.count; i++)
        if (column >= p->closed.items[i].source)
            return p->closed.items[i].written;
    return indent;
}

struct gap {
    uint32_t at, end;
    uint32_t breaks; // since the last comment or token
    bool comment;    // one was found
};

// How many empty lines stay before the next text.
static uint32_t blank_lines(const struct printer *p, const struct gap *gap) {
    uint32_t blank = gap->breaks > 1 ? gap->breaks - 1 : 0;
    return blank > FORMAT_BLANK_MOST && !p->keeps_breaks ? FORMAT_BLANK_MOST : blank;
}

static void put_comment(struct printer *p, struct gap *gap, uint32_t indent) {
    uint32_t begin = gap->at;
    while (gap->at < gap->end && !str_yaml_break_length(p->text, gap->at))
        gap->at++;
    str comment = str_trim(str_slice(p->text, begin, gap->at));
    uint32_t column = format_column(p->text, &p->place, begin);
    bool after_separator = str_yaml_break_before(p->text, p->gap); // a line end that belongs to a block text
    bool own_line = gap->breaks > 0 || after_separator || p->last == YAML_TOKEN_END;
    if (own_line) {
        format_lines_next(p->lines, blank_lines(p, gap), comment_indent(p, column, indent));
        format_lines_text(p->lines, comment);
    } else {
        format_lines_comment(p->lines, comment, column);
    }
    p->keeps_breaks = false;
    gap->comment = true;
    gap->breaks = 0;
}

// Writes the comments up to `end`.
static struct gap put_gap(struct printer *p, uint32_t end, uint32_t indent) {
    struct gap gap = {.at = p->gap, .end = end};
    while (gap.at < end) {
        size_t length = str_yaml_break_length(p->text, gap.at);
        if (p->text.ptr[gap.at] == '#') {
            put_comment(p, &gap, indent);
        } else {
            gap.breaks += length > 0;
            gap.at += length ? (uint32_t)length : 1;
        }
    }
    return gap;
}

static void begin_token(struct printer *p, const struct yaml_token *token, enum join join, uint32_t indent) {
    struct gap gap = put_gap(p, token->begin, indent);
    if (gap.comment || join == JOIN_LINE || p->last == YAML_TOKEN_END) {
        format_lines_next(p->lines, blank_lines(p, &gap), indent);
    } else if (join == JOIN_SPACE) {
        format_lines_text(p->lines, STR(" "));
    }
    p->closed.count = 0;
    p->keeps_breaks = false;
}

static void end_token(struct printer *p, const struct yaml_token *token) {
    p->gap = token->end;
    p->last = token->kind;
    p->at++;
}

static str skip_blanks(str line) {
    size_t i = 0;
    while (i < line.len && char_is_blank(line.ptr[i]))
        i++;
    return str_slice(line, i, line.len);
}

// A line of a text. NEL is read as LF; LS and PS end a line too, but belong to the text.
static str take_line(str text, size_t *at, bool at_separators) {
    size_t begin = *at, end = *at, length = 0;
    for (; end < text.len; end++) {
        length = str_yaml_break_length(text, end);
        if (length && (length < 3 || at_separators))
            break;
    }
    *at = end < text.len ? end + length : end;
    return str_slice(text, begin, end);
}

// A token as written; if it has several lines, each further one begins at `indent`.
static void put(struct printer *p, enum join join, uint32_t indent) {
    const struct yaml_token *token = peek(p);
    begin_token(p, token, join, indent);
    str text = str_slice(p->text, token->begin, token->end);
    for (size_t at = 0, begin = 0; at < text.len; begin = at) {
        str line = take_line(text, &at, true);
        const str line_end = str_slice(text, begin + line.len, at);
        line = begin ? skip_blanks(line) : line;
        if (begin)
            format_lines_next(p->lines, 0, line.len ? indent : 0);
        if (line.len || !begin)
            format_lines_text(p->lines, line);
        if (line_end.len == 3) {
            format_lines_text(p->lines, line_end);
            format_lines_ended(p->lines);
        }
    }
    end_token(p, token);
}

// ---- block text

static uint32_t count_spaces(str line) {
    uint32_t n = 0;
    while (n < line.len && line.ptr[n] == ' ')
        n++;
    return n;
}

// Writes a line that was indented by `from` spaces with `to` spaces; also the lines after an LS or PS in it.
static void put_block_line(struct printer *p, str line, uint32_t from, uint32_t to) {
    for (size_t at = 0, begin = 0; at < line.len; begin = at) {
        str part = take_line(line, &at, true);
        if (begin > 0 && part.len > from)
            strbuf_repeat(&p->lines->body, ' ', to);
        format_lines_text(p->lines, str_slice(part, from, part.len));
        format_lines_text(p->lines, str_slice(line, begin + part.len, at));
    }
}

// The indentation of a block text's lines: that of its first line, or the digit in its header.
static uint32_t block_text_indent(const struct printer *p, str text, uint32_t digit) {
    if (digit)
        return p->level.source + digit;
    size_t at = 0;
    take_line(text, &at, true);
    while (at < text.len) {
        str line = take_line(text, &at, true);
        if (skip_blanks(line).len)
            return count_spaces(line);
    }
    return UINT32_MAX;
}

// Where the last line that is not empty ends, with its break: what follows does not belong to the text,
// unless its header says so.
static size_t block_text_end(str text, size_t at, uint32_t from) {
    size_t end = at;
    while (at < text.len) {
        const str line = take_line(text, &at, true);
        if (line.len > from || skip_blanks(line).len)
            end = at;
    }
    return end;
}

static uint32_t after_blanks(str text, uint32_t at) {
    while (at < text.len && char_is_blank(text.ptr[at]))
        at++;
    return at;
}

// Whether an LS or PS is all that ends the line before `end`: a line end after it would be one more line,
// which counts if the text keeps its empty lines.
static bool ends_with_separator(const struct printer *p, uint32_t end) {
    const uint32_t next = after_blanks(p->text, end);
    return str_yaml_break_before(p->text, end) && next < p->text.len && !str_yaml_break_length(p->text, next);
}

static void put_block_text(struct printer *p, enum join join, uint32_t indent) {
    struct yaml_token token = *peek(p);
    begin_token(p, &token, join, indent);
    str text = str_slice(p->text, token.begin, token.end);
    size_t at = 0;
    str whole = take_line(text, &at, true);
    size_t hash = 0;
    while (hash < whole.len && whole.ptr[hash] != '#')
        hash++;
    str header = str_trim(str_slice(whole, 0, hash));
    uint32_t digit = 0;
    bool keeps_breaks = false;
    for (size_t i = 1; i < header.len; i++) {
        digit = header.ptr[i] >= '1' && header.ptr[i] <= '9' ? (uint32_t)(header.ptr[i] - '0') : digit;
        keeps_breaks = keeps_breaks || header.ptr[i] == '+';
    }
    p->keeps_breaks = p->keeps_breaks || keeps_breaks;
    format_lines_text(p->lines, header);
    if (hash < whole.len) {
        uint32_t place = token.begin + (uint32_t)hash;
        format_lines_comment(p->lines, str_trim(str_slice(whole, hash, whole.len)),
                             format_column(p->text, &p->place, place));
    }
    uint32_t from = block_text_indent(p, text, digit);
    uint32_t to = digit ? p->level.written + digit : indent;
    if (!keeps_breaks)
        text.len = block_text_end(text, at, from);
    uint32_t end = token.begin + (uint32_t)whole.len, empty = 0;
    while (at < text.len) {
        str line = take_line(text, &at, false);
        if (line.len <= from && !skip_blanks(line).len) {
            empty++;
            continue;
        }
        format_lines_next(p->lines, empty, to);
        put_block_line(p, line, from, to);
        empty = 0;
        end = (uint32_t)(line.ptr + line.len - p->text.ptr);
    }
    end_token(p, &token);
    p->gap = end;
    if (keeps_breaks && ends_with_separator(p, end))
        format_lines_ended(p->lines);
    p->lines->is_open = after_blanks(p->text, end) == p->text.len;
}

// ---- nodes

static void put_node(struct printer *p, enum join join, uint32_t indent);

static void close_block(struct printer *p, struct level outer) {
    *ARENA_PUSH(p->arena, &p->closed) = p->level;
    p->level = outer;
}

static void put_list(struct printer *p, enum join join, uint32_t indent) {
    struct level outer = p->level;
    const struct yaml_token *token = peek(p);
    bool indented = token->kind == YAML_TOKEN_LIST; // else its items are in the column of the map around it
    p->level = (struct level){indented ? token->column : outer.source, indent};
    p->at += indented;
    while (peek(p)->kind == YAML_TOKEN_ITEM) {
        put(p, join, indent);
        join = JOIN_LINE;
        put_node(p, JOIN_SPACE, indent + FORMAT_INDENT);
    }
    p->at += indented;
    close_block(p, outer);
}

// Whether a colon directly after such a token would become part of it.
static bool takes_colon(enum yaml_token_kind kind) {
    return kind == YAML_TOKEN_ALIAS || kind == YAML_TOKEN_PROPERTY;
}

static void put_map(struct printer *p, enum join join, uint32_t indent) {
    struct level outer = p->level;
    p->level = (struct level){peek(p)->column, indent};
    p->at++;
    for (;;) {
        const struct yaml_token *token = peek(p);
        bool marked = token->kind == YAML_TOKEN_KEY && token->begin < token->end;
        enum join colon = JOIN_LINE;
        if (marked) {
            put(p, join, indent);
            put_node(p, JOIN_SPACE, indent + FORMAT_INDENT);
        } else if (token->kind == YAML_TOKEN_KEY) {
            p->at++;
            put_node(p, join, indent);
            colon = takes_colon(p->last) ? JOIN_SPACE : JOIN_NONE;
        } else if (token->kind == YAML_TOKEN_COLON) {
            colon = join;
        } else {
            break;
        }
        join = JOIN_LINE;
        if (peek(p)->kind != YAML_TOKEN_COLON)
            continue;
        put(p, colon, indent);
        put_node(p, JOIN_SPACE, indent + FORMAT_INDENT);
    }
    p->at++;
    close_block(p, outer);
}

// Line ends that the author put into brackets stay, so that a comment after a line stays after the entries of
// that line; those before a comma or a colon move after it.
static enum join flow_join(const struct printer *p, enum join otherwise) {
    return breaks_before(p, peek(p)) ? JOIN_LINE : otherwise;
}

// Returns whether a line end before its colon is still to be written, before the next entry.
static bool put_flow_entry(struct printer *p, enum join join, uint32_t indent) {
    const struct yaml_token *token = peek(p);
    bool marked = token->kind == YAML_TOKEN_KEY && token->begin < token->end;
    if (marked) {
        put(p, join, indent);
        join = flow_join(p, JOIN_SPACE);
    } else if (token->kind == YAML_TOKEN_KEY) {
        p->at++;
    }
    put_node(p, join, marked && join == JOIN_LINE ? indent + FORMAT_INDENT : indent);
    if (peek(p)->kind != YAML_TOKEN_COLON)
        return false;
    const bool breaks = breaks_before(p, peek(p));
    const uint32_t lines = p->lines->lines.count;
    bool apart = takes_colon(p->last) || p->last == YAML_TOKEN_KEY || p->last == YAML_TOKEN_COMMA;
    put(p, apart ? JOIN_SPACE : JOIN_NONE, indent);
    const bool moves = breaks && p->lines->lines.count == lines;
    enum yaml_token_kind next = peek(p)->kind;
    if (next == YAML_TOKEN_COMMA || next == YAML_TOKEN_FLOW_CLOSE)
        return moves;
    enum join value = moves ? JOIN_LINE : flow_join(p, JOIN_SPACE);
    put_node(p, value, value == JOIN_LINE ? indent + FORMAT_INDENT : indent);
    return false;
}

// A separator of entries, or a property of a value, stays at the beginning of its line if a comment follows:
// on the line before, the comment would belong to the entry there.
static enum join join_before_comment(const struct printer *p, enum join otherwise) {
    const uint32_t behind = after_blanks(p->text, peek(p)->end);
    bool comment = behind < p->text.len && p->text.ptr[behind] == '#';
    return comment ? flow_join(p, otherwise) : otherwise;
}

static void put_comma(struct printer *p, uint32_t indent) {
    put(p, join_before_comment(p, p->last == YAML_TOKEN_COLON ? JOIN_SPACE : JOIN_NONE), indent);
}

// A list or map in brackets. If the first entry is on a line of its own, entries are indented; else they are
// aligned with the first one.
static void put_flow(struct printer *p, enum join join, uint32_t indent) {
    put(p, join, indent);
    bool expanded = breaks_before(p, peek(p));
    uint32_t open = p->lines->column - 1;
    uint32_t inner = expanded ? indent + FORMAT_INDENT : open + 1;
    enum join next = JOIN_NONE;
    bool broken = false;
    while (peek(p)->kind != YAML_TOKEN_FLOW_CLOSE && peek(p)->kind != YAML_TOKEN_END) {
        uint32_t before = p->at;
        broken = broken || breaks_before(p, peek(p));
        if (peek(p)->kind == YAML_TOKEN_COMMA) {
            put_comma(p, inner);
            next = JOIN_SPACE;
            continue;
        }
        broken = put_flow_entry(p, broken ? JOIN_LINE : next, inner);
        if (p->at == before)
            return; // not YAML's grammar: the caller sees it from the tokens left over
    }
    enum join close = p->last == YAML_TOKEN_COLON ? JOIN_SPACE : JOIN_NONE;
    if (peek(p)->kind == YAML_TOKEN_FLOW_CLOSE)
        put(p, flow_join(p, close), expanded ? indent : open);
}

// A value in brackets that begins on a line of its own stays there, with its properties: a comment after it
// belongs to what it has in it.
static enum join value_join(const struct printer *p, enum join otherwise) {
    uint32_t at = p->at;
    while (p->tokens.items[at].kind == YAML_TOKEN_PROPERTY)
        at++;
    return p->tokens.items[at].kind == YAML_TOKEN_FLOW_OPEN ? flow_join(p, otherwise) : otherwise;
}

// A node, or nothing if a value is empty. Lists and maps by indentation begin on a line of their own if their
// first token cannot follow the previous text.
static void put_node(struct printer *p, enum join join, uint32_t indent) {
    bool after_colon = p->last == YAML_TOKEN_COLON;
    bool after_item = p->last == YAML_TOKEN_ITEM;
    bool properties = false;
    join = after_colon ? value_join(p, join) : join;
    while (peek(p)->kind == YAML_TOKEN_PROPERTY) {
        put(p, join_before_comment(p, join), indent);
        join = JOIN_SPACE;
        properties = true;
    }
    enum join block = after_colon || properties || p->last == YAML_TOKEN_DOCUMENT ? JOIN_LINE : join;
    switch ((enum yaml_token_kind)peek(p)->kind) {
    case YAML_TOKEN_ITEM:
        if (after_item)
            break; // the next item: this one is empty
        // fall through
    case YAML_TOKEN_LIST:
        put_list(p, block, indent);
        break;
    case YAML_TOKEN_MAP:
        put_map(p, block, indent);
        break;
    case YAML_TOKEN_FLOW_OPEN:
        put_flow(p, after_colon ? flow_join(p, join) : join, indent);
        break;
    case YAML_TOKEN_BLOCK_TEXT:
        put_block_text(p, join, indent);
        break;
    case YAML_TOKEN_TEXT:
    case YAML_TOKEN_ALIAS:
        put(p, join, indent);
        break;
    default:
        break;
    }
}

// ---- the file

// Whether a key at the beginning of a line would also be a mark of a document or of a merge conflict, which
// are words. (A key of one word has its colon directly after it.)
static bool is_mark(str key) {
    size_t word = 0;
    while (word < key.len && !char_is_space(key.ptr[word]) && !str_yaml_break_length(key, word))
        word++;
    str first = str_slice(key, 0, word);
    bool marks =
        reader_begins_conflict(first) || str_equal(first, STR("---")) || str_equal(first, STR("..."));
    return marks && word < key.len;
}

// 0, unless a key could not be there.
static uint32_t root_indent(const struct printer *p) {
    if (peek(p)->kind != YAML_TOKEN_MAP)
        return 0;
    for (uint32_t i = p->at; i < p->tokens.count; i++)
        if (p->tokens.items[i].kind == YAML_TOKEN_TEXT &&
            is_mark(str_slice(p->text, p->tokens.items[i].begin, p->tokens.items[i].end)))
            return FORMAT_INDENT;
    return 0;
}

static void put_document(struct printer *p) {
    while (peek(p)->kind == YAML_TOKEN_DIRECTIVE)
        put(p, JOIN_LINE, 0);
    bool marked = peek(p)->kind == YAML_TOKEN_DOCUMENT;
    if (marked)
        put(p, JOIN_LINE, 0);
    put_node(p, marked && !breaks_before(p, peek(p)) ? JOIN_SPACE : JOIN_LINE, root_indent(p));
    while (peek(p)->kind == YAML_TOKEN_DOCUMENT_END)
        put(p, JOIN_LINE, 0);
}

bool format_yaml(struct arena *arena, str text, uint32_t begin, struct format_lines *lines) {
    struct printer p = {
        .arena = arena, .text = text, .gap = begin, .lines = lines, .place = {begin, 0, true}};
    if (!yaml_tokens_read(arena, text, begin, &p.tokens) || p.tokens.documents > 1)
        return false;
    p.last = YAML_TOKEN_END;
    put_document(&p);
    if (peek(&p)->kind != YAML_TOKEN_END)
        return false;
    struct gap gap = put_gap(&p, (uint32_t)text.len, 0);
    if (p.keeps_breaks && gap.breaks > 1)
        format_lines_next(lines, gap.breaks - 2, 0);
    return true;
}
