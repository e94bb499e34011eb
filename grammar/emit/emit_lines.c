#include "grammar/emit/emit_lines.h"

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

bool emit_is_integer(enum schema_range range) {
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        for (uint32_t i = 0; i < (*e)->row_count; i++)
            if ((*e)->rows[i].range == range)
                return (*e)->rows[i].kind == SCHEMA_INTEGER;
    return false;
}
