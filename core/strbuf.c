#include "core/strbuf.h"

#include "core/heap.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void strbuf_init(struct strbuf *buffer) {
    *buffer = (struct strbuf){0};
}

void strbuf_finish(struct strbuf *buffer) {
    if (!buffer)
        return;
    free(buffer->data);
    *buffer = (struct strbuf){0};
}

void strbuf_clear(struct strbuf *buffer) {
    buffer->len = 0;
    if (buffer->data)
        buffer->data[0] = '\0';
}

static bool reserve(struct strbuf *buffer, size_t more) {
    if (buffer->failed)
        return false;
    size_t need = buffer->len + more + 1;
    if (need < more || (buffer->cap_bytes && need > buffer->cap_bytes)) {
        buffer->failed = true;
        return false;
    }
    if (need <= buffer->capacity)
        return true;
    size_t wanted = buffer->capacity ? buffer->capacity * 2 : 256;
    if (wanted < need)
        wanted = need;
    if (buffer->cap_bytes && wanted > buffer->cap_bytes)
        wanted = buffer->cap_bytes;
    char *moved = heap_resize(buffer->data, wanted);
    if (!moved) {
        buffer->failed = true;
        return false;
    }
    buffer->data = moved;
    buffer->capacity = wanted;
    return true;
}

void strbuf_add(struct strbuf *buffer, const void *bytes, size_t count) {
    if (!reserve(buffer, count))
        return;
    if (count)
        memcpy(buffer->data + buffer->len, bytes, count);
    buffer->len += count;
    buffer->data[buffer->len] = '\0';
}

void strbuf_str(struct strbuf *buffer, str s) {
    strbuf_add(buffer, s.ptr, s.len);
}

void strbuf_cstr(struct strbuf *buffer, const char *s) {
    strbuf_add(buffer, s, strlen(s));
}

void strbuf_char(struct strbuf *buffer, char c) {
    strbuf_add(buffer, &c, 1);
}

void strbuf_markup(struct strbuf *buffer, str s) {
    for (size_t i = 0; i < s.len; i++) {
        char c = s.ptr[i];
        if (c == '&')
            strbuf_cstr(buffer, "&amp;");
        else if (c == '<')
            strbuf_cstr(buffer, "&lt;");
        else if (c == '>')
            strbuf_cstr(buffer, "&gt;");
        else if (c == '"')
            strbuf_cstr(buffer, "&quot;");
        else
            strbuf_char(buffer, c);
    }
}

void strbuf_base64(struct strbuf *buffer, str bytes) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const unsigned char *p = (const unsigned char *)bytes.ptr;
    for (size_t i = 0; i < bytes.len; i += 3) {
        const size_t left = bytes.len - i;
        const uint32_t word =
            (uint32_t)p[i] << 16 | (left > 1 ? (uint32_t)p[i + 1] << 8 : 0) | (left > 2 ? p[i + 2] : 0u);
        const char text[4] = {digits[word >> 18], digits[word >> 12 & 63],
                              left > 1 ? digits[word >> 6 & 63] : '=', left > 2 ? digits[word & 63] : '='};
        strbuf_add(buffer, text, sizeof text);
    }
}

void strbuf_repeat(struct strbuf *buffer, char c, size_t count) {
    if (!reserve(buffer, count))
        return;
    memset(buffer->data + buffer->len, c, count);
    buffer->len += count;
    buffer->data[buffer->len] = '\0';
}

void strbuf_vformat(struct strbuf *buffer, const char *format, va_list args) {
    va_list again;
    va_copy(again, args);
    int length = vsnprintf(NULL, 0, format, args);
    if (length < 0) {
        heap_exhausted(0); // a correct format fails only for lack of memory
        buffer->failed = true;
    } else if (reserve(buffer, (size_t)length)) {
        vsnprintf(buffer->data + buffer->len, (size_t)length + 1, format, again);
        buffer->len += (size_t)length;
    }
    va_end(again);
}

void strbuf_format(struct strbuf *buffer, const char *format, ...) {
    va_list args;
    va_start(args, format);
    strbuf_vformat(buffer, format, args);
    va_end(args);
}

str strbuf_view(const struct strbuf *buffer) {
    return (str){buffer->data ? buffer->data : "", buffer->len};
}
