#include "lsp/markdown.h"

#include <string.h>

void markdown_code(str code, const char *language, struct strbuf *out) {
    size_t longest = 2, run = 0;
    for (size_t i = 0; i < code.len; i++) {
        run = code.ptr[i] == '`' ? run + 1 : 0;
        longest = run > longest ? run : longest;
    }
    strbuf_repeat(out, '`', longest + 1);
    strbuf_format(out, "%s\n%.*s\n", language, STR_ARG(code));
    strbuf_repeat(out, '`', longest + 1);
    strbuf_char(out, '\n');
}

// Escapes what Markdown would read as something else.
static void plain(str text, struct strbuf *out) {
    for (size_t i = 0; i < text.len; i++) {
        if (strchr("\\`*_<>[]#|", text.ptr[i]))
            strbuf_char(out, '\\');
        strbuf_char(out, text.ptr[i]);
    }
}

static str take_line(str *rest) {
    const char *end = memchr(rest->ptr, '\n', rest->len);
    size_t length = end ? (size_t)(end - rest->ptr) : rest->len;
    str line = str_slice(*rest, 0, length);
    *rest = str_slice(*rest, length + (end != NULL), rest->len);
    return line;
}

static size_t indent_of(str line) {
    size_t indent = 0;
    while (indent < line.len && line.ptr[indent] == ' ')
        indent++;
    return indent;
}

// A line is a title if more indented lines follow; "YAML ..." and "XML ..." are code.
void markdown_explanation(str text, struct strbuf *out) {
    static const struct {
        const char *word, *language;
    } spellings[] = {{"YAML  ", "yaml"}, {"XML   ", "xml"}};
    for (bool first = true; text.len; first = false) {
        str line = take_line(&text);
        str words = str_trim(line);
        const char *language = NULL;
        for (int i = 0; i < 2; i++)
            if (str_starts_with(words, str_from(spellings[i].word)))
                language = spellings[i].language;
        bool is_title = words.len && !language && (first || (text.len && indent_of(text) > indent_of(line)));
        if (language) {
            strbuf_char(out, '\n');
            markdown_code(str_trim(str_slice(words, strlen("YAML  "), words.len)), language, out);
        } else {
            strbuf_cstr(out, is_title ? "\n**" : "");
            plain(words, out);
            strbuf_cstr(out, is_title ? "**\n\n" : "\n");
        }
    }
}
