#include "grammar/emit/emit_lines.h"

#include "core/expression.h"

#include <stdarg.h>

enum {
    STEP = 2
};

void emit_indent(const struct emit_lines *w) {
    strbuf_repeat(w->out, ' ', (size_t)w->depth * STEP);
}

static void line(const struct emit_lines *w, const char *format, va_list args) {
    emit_indent(w);
    strbuf_vformat(w->out, format, args);
    strbuf_char(w->out, '\n');
}

void emit_line(const struct emit_lines *w, const char *format, ...) {
    va_list args;
    va_start(args, format);
    line(w, format, args);
    va_end(args);
}

void emit_open(struct emit_lines *w, const char *format, ...) {
    va_list args;
    va_start(args, format);
    line(w, format, args);
    va_end(args);
    w->depth++;
}

void emit_close(struct emit_lines *w, const char *tag) {
    w->depth--;
    emit_line(w, "</%s>", tag);
}

void emit_no_words(void (*put)(void *to, const char *word), void *to) {
    for (const char *const *word = expression_no_words(); *word; word++) {
        char one[16], all[16];
        size_t i = 0;
        for (; (*word)[i] && i + 1 < sizeof one; i++) {
            all[i] = (char)((*word)[i] - 'a' + 'A');
            one[i] = i ? (*word)[i] : all[i];
        }
        one[i] = all[i] = '\0';
        put(to, *word);
        put(to, one);
        put(to, all);
    }
}

bool emit_is_integer(enum schema_range range) {
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        for (uint32_t i = 0; i < (*e)->row_count; i++)
            if ((*e)->rows[i].range == range)
                return (*e)->rows[i].kind == SCHEMA_INTEGER;
    return false;
}
