#include "core/json_write.h"

#include "core/number.h"

#include <assert.h>
#include <math.h>
#include <string.h>

void json_writer_init(struct json_writer *writer, struct strbuf *out, unsigned flat_depth) {
    *writer = (struct json_writer){.out = out, .flat_depth = flat_depth};
}

static void put_string(struct strbuf *out, str s) {
    strbuf_char(out, '"');
    for (size_t at = 0; at < s.len;) {
        size_t size = utf8_sequence_length(s, at);
        unsigned char c = (unsigned char)s.ptr[at];
        if (size == 0)
            strbuf_cstr(out, "\xEF\xBF\xBD");
        else if (c == '"' || c == '\\')
            strbuf_format(out, "\\%c", c);
        else if (c == '\n')
            strbuf_cstr(out, "\\n");
        else if (c < 0x20 || c == 0x7F)
            strbuf_format(out, "\\u%04x", c);
        else
            strbuf_add(out, s.ptr + at, size);
        at += size ? size : 1;
    }
    strbuf_char(out, '"');
}

static void new_line(struct json_writer *w) {
    if (w->depth == 0 || w->depth >= w->flat_depth)
        return;
    strbuf_char(w->out, '\n');
    strbuf_repeat(w->out, ' ', (size_t)w->depth * 2);
}

// Writes what comes before a value: the comma after the previous one, and the key.
static void begin_value(struct json_writer *w, const char *key) {
    if (w->filled[w->depth])
        strbuf_cstr(w->out, w->depth >= w->flat_depth ? ", " : ",");
    w->filled[w->depth] = true;
    new_line(w);
    if (key) {
        put_string(w->out, str_from(key));
        strbuf_cstr(w->out, ": ");
    }
}

static void begin(struct json_writer *w, const char *key, char bracket) {
    assert(w->depth + 1 < JSON_WRITE_DEPTH_MAX);
    begin_value(w, key);
    strbuf_char(w->out, bracket);
    w->filled[++w->depth] = false;
}

static void end(struct json_writer *w, char bracket) {
    bool filled = w->filled[w->depth];
    bool flat = w->depth >= w->flat_depth;
    w->depth--;
    if (filled && !flat) {
        strbuf_char(w->out, '\n');
        strbuf_repeat(w->out, ' ', (size_t)w->depth * 2);
    }
    strbuf_char(w->out, bracket);
}

void json_open_object(struct json_writer *writer, const char *key) {
    begin(writer, key, '{');
}

void json_close_object(struct json_writer *writer) {
    end(writer, '}');
}

void json_open_list(struct json_writer *writer, const char *key) {
    begin(writer, key, '[');
}

void json_close_list(struct json_writer *writer) {
    end(writer, ']');
}

void json_write_text(struct json_writer *writer, const char *key, str value) {
    begin_value(writer, key);
    put_string(writer->out, value);
}

void json_write_literal(struct json_writer *writer, const char *key, str value) {
    begin_value(writer, key);
    strbuf_str(writer->out, value);
}

void json_write_integer(struct json_writer *writer, const char *key, uint64_t value) {
    begin_value(writer, key);
    strbuf_format(writer->out, "%llu", (unsigned long long)value);
}

void json_write_real(struct json_writer *writer, const char *key, double value) {
    char digits[NUMBER_FORMAT_MAX];
    begin_value(writer, key);
    if (isfinite(value))
        strbuf_add(writer->out, digits, number_format(value, digits));
    else
        strbuf_cstr(writer->out, "null");
}

void json_write_boolean(struct json_writer *writer, const char *key, bool value) {
    begin_value(writer, key);
    strbuf_cstr(writer->out, value ? "true" : "false");
}

void json_write_null(struct json_writer *writer, const char *key) {
    begin_value(writer, key);
    strbuf_cstr(writer->out, "null");
}

void json_report_begin(struct json_writer *writer, struct strbuf *out, unsigned flat_depth, const char *name,
                       unsigned version) {
    json_writer_init(writer, out, flat_depth);
    json_open_object(writer, NULL);
    json_write_text(writer, "report", str_from(name));
    json_write_integer(writer, "version", version);
}

void json_end(struct json_writer *writer) {
    strbuf_char(writer->out, '\n');
}

void json_report_end(struct json_writer *writer) {
    json_close_object(writer);
    json_end(writer);
}
