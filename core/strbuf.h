// A growing byte buffer on the heap, for text and files that are made in memory before they are written.
//
// Appending never fails loudly: when memory runs out or `cap_bytes` is passed, `failed` is set and further
// appends do nothing; the owner asks once at the end. Ownership: `strbuf_finish` frees; views are valid until
// the next append, and must not be appended to their own buffer.
// Thread safety: one thread at a time.
#ifndef GLINT_CORE_STRBUF_H
#define GLINT_CORE_STRBUF_H

#include "core/str.h"

#include <stdarg.h>

struct strbuf {
    char *data; // NUL-terminated if not NULL
    size_t len;
    size_t capacity;
    size_t cap_bytes; // of memory, the closing NUL included; 0: no cap
    bool failed;
};

void strbuf_init(struct strbuf *buffer);
void strbuf_finish(struct strbuf *buffer);
// Empties it and keeps its memory; `failed` stays as it is.
void strbuf_clear(struct strbuf *buffer);
void strbuf_add(struct strbuf *buffer, const void *bytes, size_t count);
void strbuf_str(struct strbuf *buffer, str s);
void strbuf_cstr(struct strbuf *buffer, const char *s);
void strbuf_char(struct strbuf *buffer, char c);
// Text of XML and HTML, also within double quotes.
void strbuf_markup(struct strbuf *buffer, str s);
// As base64 (RFC 4648), padded with '=' to a multiple of four.
void strbuf_base64(struct strbuf *buffer, str bytes);
void strbuf_repeat(struct strbuf *buffer, char c, size_t count);
void strbuf_format(struct strbuf *buffer, const char *format, ...) __attribute__((format(printf, 2, 3)));
void strbuf_vformat(struct strbuf *buffer, const char *format, va_list args)
    __attribute__((format(printf, 2, 0)));
str strbuf_view(const struct strbuf *buffer);

#endif
