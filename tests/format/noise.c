// Layout at random that means the same.
#include "core/splitmix.h"
#include "parser/yaml/yaml_tokens.h"
#include "tests/format/format_kit.h"

#include <string.h>

struct noise {
    uint64_t state;
    str text;
    struct strbuf *out;
    unsigned comments;
    uint32_t factor; // YAML: of the indentation
    const char *line_end;
    unsigned brackets; // YAML: open ones
};

static uint32_t below(struct noise *n, uint32_t limit) {
    return (uint32_t)(splitmix_next(&n->state) % limit);
}

static void blanks(struct noise *n, uint32_t least, uint32_t most) {
    strbuf_repeat(n->out, ' ', least + below(n, most - least + 1));
}

static void line_end(struct noise *n) {
    if (below(n, 6) == 0)
        blanks(n, 1, 3);
    strbuf_cstr(n->out, n->line_end);
}

// ---- YAML

static void yaml_comment(struct noise *n) {
    static const char *const words[] = {"", " one", " a longer remark: with [brackets", "# '\"",
                                        "\tkey: value"};
    strbuf_format(n->out, "#%s %u", words[below(n, 5)], n->comments++);
}

// A line end, perhaps with comments and empty lines.
static void yaml_break(struct noise *n, bool first) {
    if (!first && below(n, 8) == 0) {
        blanks(n, 1, 4);
        yaml_comment(n);
    }
    if (!first)
        line_end(n);
    while (below(n, 4) == 0) {
        if (below(n, 2)) {
            blanks(n, 0, 9);
            yaml_comment(n);
        }
        line_end(n);
    }
}

static bool has_break(str text, uint32_t begin, uint32_t end) {
    return memchr(text.ptr + begin, '\n', end - begin) != NULL;
}

static void yaml_gap(struct noise *n, const struct yaml_token *before, const struct yaml_token *token) {
    uint32_t from = before ? before->end : 0;
    bool block = before && before->kind == YAML_TOKEN_BLOCK_TEXT; // it ends where the next line begins
    if (block) {
        strbuf_repeat(n->out, ' ', token->column * n->factor);
        return;
    }
    bool indicator = before && (before->kind == YAML_TOKEN_ITEM || before->kind == YAML_TOKEN_COLON);
    if (!before || (has_break(n->text, from, token->begin) && !n->brackets)) {
        yaml_break(n, !before);
        strbuf_repeat(n->out, ' ', token->column * n->factor);
    } else if (before->kind == YAML_TOKEN_ITEM) {
        strbuf_repeat(n->out, ' ', (token->column - before->column) * n->factor - 1);
    } else if (n->brackets && token->kind != YAML_TOKEN_COLON && below(n, 12) == 0) {
        yaml_break(n, false);
        blanks(n, 9 * n->factor, 30);
    } else if (token->kind == YAML_TOKEN_COLON || token->kind == YAML_TOKEN_COMMA ||
               token->kind == YAML_TOKEN_FLOW_CLOSE || before->kind == YAML_TOKEN_FLOW_OPEN) {
        blanks(n, before->kind == YAML_TOKEN_COLON, 1);
    } else {
        blanks(n, from < token->begin || indicator, 3);
    }
}

static bool yaml_is_plain(str text, const struct yaml_tokens *tokens) {
    for (uint32_t i = 0; i < tokens->count; i++) {
        const struct yaml_token *t = &tokens->items[i];
        if (t->kind == YAML_TOKEN_BLOCK_TEXT ||
            (t->kind == YAML_TOKEN_TEXT && has_break(text, t->begin, t->end)))
            return false;
    }
    return true;
}

static void yaml_noise(struct noise *n) {
    struct arena arena;
    struct yaml_tokens tokens;
    arena_init(&arena, (size_t)1 << 28);
    yaml_tokens_read(&arena, n->text, 0, &tokens);
    n->factor = yaml_is_plain(n->text, &tokens) ? 1 + below(n, 3) : 1;
    const struct yaml_token *before = NULL;
    for (uint32_t i = 0; i < tokens.count; i++) {
        const struct yaml_token *token = &tokens.items[i];
        if (token->begin == token->end)
            continue;
        yaml_gap(n, before, token);
        n->brackets -= token->kind == YAML_TOKEN_FLOW_CLOSE;
        n->brackets += token->kind == YAML_TOKEN_FLOW_OPEN;
        strbuf_str(n->out, str_slice(n->text, token->begin, token->end));
        before = token;
    }
    yaml_break(n, false);
    arena_finish(&arena);
}

// ---- XML

static void xml_comment(struct noise *n) {
    static const char *const words[] = {"", "one", "a longer remark", "two\n   lines", "<Light/>", "'\""};
    strbuf_format(n->out, "<!-- %s %u -->", words[below(n, 6)], n->comments++);
}

// Between two tags.
static void xml_gap(struct noise *n) {
    for (uint32_t i = below(n, 4); i > 0; i--) {
        uint32_t what = below(n, 8);
        if (what == 0)
            xml_comment(n);
        else if (what < 4)
            line_end(n);
        else
            blanks(n, 0, 7);
    }
}

// Inside a tag, where a blank may stand.
static void xml_blank(struct noise *n, bool needed) {
    uint32_t what = below(n, 8);
    if (what == 0) {
        line_end(n);
        blanks(n, 0, 9);
    } else {
        blanks(n, needed, what == 1 ? 3 : needed);
    }
}

static void xml_noise(struct noise *n) {
    char quote = '\0';
    bool tag = false;
    size_t declared = 0; // the declaration stays at the very beginning
    if (str_starts_with(n->text, STR("<?")))
        while (declared < 2 || n->text.ptr[declared - 1] != '>')
            declared++;
    strbuf_str(n->out, str_slice(n->text, 0, declared));
    for (size_t i = declared; i < n->text.len; i++) {
        char c = n->text.ptr[i];
        if (quote) {
            quote = c == quote ? '\0' : quote;
        } else if (tag && (c == '"' || c == '\'')) {
            xml_blank(n, false);
            quote = c;
        } else if (tag && c == ' ') {
            xml_blank(n, true);
            continue;
        } else if (tag && (c == '=' || (c == '/' && n->text.ptr[i - 1] != '<') ||
                           (c == '>' && n->text.ptr[i - 1] != '/'))) {
            xml_blank(n, false);
        } else if (!tag && (c == ' ' || c == '\n')) {
            continue;
        }
        if (c == '<' && !quote) {
            xml_gap(n);
            tag = true;
        }
        strbuf_char(n->out, c);
        if (c == '>' && !quote && tag)
            tag = false;
    }
    xml_gap(n);
}

void add_noise(uint64_t seed, bool xml, str text, struct strbuf *out) {
    struct noise n = {.state = seed * 2 + xml, .text = text, .out = out};
    n.line_end = below(&n, 4) ? "\n" : "\r\n";
    if (below(&n, 16) == 0)
        strbuf_cstr(out, "\xEF\xBB\xBF");
    if (xml)
        xml_noise(&n);
    else
        yaml_noise(&n);
}
