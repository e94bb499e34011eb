// The bytes of buffers: the binary chunk of the file, `data:` addresses, files beside it.
#include "assets/gltf/gltf_internal.h"
#include "diag/codes/file.h"

#include <string.h>

bool gltf_is_data(str uri) {
    return str_starts_with(uri, STR("data:"));
}

// The value of a digit of base64; 64: it is not one.
static unsigned digit_of(char c) {
    if (c >= 'A' && c <= 'Z')
        return (unsigned)(c - 'A');
    if (c >= 'a' && c <= 'z')
        return (unsigned)(c - 'a') + 26;
    if (c >= '0' && c <= '9')
        return (unsigned)(c - '0') + 52;
    return c == '+' ? 62 : c == '/' ? 63 : 64;
}

static bool decode_base64(str text, struct arena *arena, str *out) {
    unsigned char *bytes = arena_alloc_array(arena, text.len / 4 + 1, 3);
    size_t length = 0;
    unsigned bits = 0, held = 0;
    while (text.len && text.ptr[text.len - 1] == '=')
        text.len--;
    for (size_t i = 0; i < text.len; i++) {
        const unsigned digit = digit_of(text.ptr[i]);
        if (digit == 64)
            return false;
        bits = (bits << 6 | digit) & 0xFFFFFF;
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes[length++] = (unsigned char)(bits >> held);
        }
    }
    *out = (str){(const char *)bytes, length};
    return text.len % 4 != 1;
}

bool gltf_decode_data(str uri, struct arena *arena, str *bytes, str *mime) {
    static const char marker[] = ";base64";
    const char *comma = memchr(uri.ptr, ',', uri.len);
    const size_t at = comma ? (size_t)(comma - uri.ptr) : 0, size = sizeof marker - 1;
    if (!comma || at < 5 + size || memcmp(comma - size, marker, size) != 0)
        return false;
    const str head = str_slice(uri, 5, at - size);
    const char *end = memchr(head.ptr, ';', head.len);
    *mime = str_slice(head, 0, end ? (size_t)(end - head.ptr) : head.len);
    return decode_base64(str_slice(uri, at + 1, uri.len), arena, bytes);
}

str gltf_decode_uri(str uri, struct arena *arena) {
    if (!memchr(uri.ptr, '%', uri.len))
        return uri;
    char *out = arena_alloc(arena, uri.len + 1);
    size_t length = 0;
    for (size_t at = 0; at < uri.len; at++) {
        const bool is_code = uri.ptr[at] == '%' && at + 2 < uri.len;
        const int high = is_code ? char_hex(uri.ptr[at + 1]) : -1,
                  low = is_code ? char_hex(uri.ptr[at + 2]) : -1;
        const bool is_good = high >= 0 && low >= 0 && high + low > 0; // a path has no NUL
        out[length++] = is_good ? (char)(16 * high + low) : uri.ptr[at];
        at += is_good ? 2 : 0;
    }
    return (str){out, length};
}

// ---- buffers

static bool bytes_of(struct gltf *gltf, const struct gltf_buffer *buffer, const struct gltf_files *files,
                     str *bytes) {
    const json_index at = json_get(&gltf->json, buffer->node, "uri");
    str mime;
    *bytes = gltf->chunk;
    if (!at)
        return true;
    if (gltf_is_data(buffer->uri)) {
        if (gltf_decode_data(buffer->uri, gltf->arena, bytes, &mime))
            return true;
        gltf_add(gltf, DIAG_GLTF_DATA, at, "'%s' is not a 'data:' address in base64", gltf_where(gltf, at));
        return false;
    }
    if (files->read(files->context, gltf_decode_uri(buffer->uri, gltf->arena), at, bytes))
        return true;
    gltf->errors++;
    return false;
}

bool gltf_load_buffers(struct gltf *gltf, const struct gltf_files *files) {
    enum {
        PADDING = 3
    };
    for (uint32_t i = 0; i < gltf->buffers.count; i++) {
        struct gltf_buffer *buffer = &gltf->buffers.items[i];
        str bytes;
        if (!bytes_of(gltf, buffer, files, &bytes))
            continue;
        if (bytes.len < buffer->length)
            gltf_add(gltf, DIAG_GLTF_DATA, buffer->node,
                     "'%s' has %llu bytes by its 'byteLength', and %zu in truth",
                     gltf_where(gltf, buffer->node), (unsigned long long)buffer->length, bytes.len);
        else if (!json_get(&gltf->json, buffer->node, "uri") && bytes.len > buffer->length + PADDING)
            gltf_add(gltf, DIAG_GLTF_RULE, buffer->node,
                     "the binary chunk has %zu bytes, and '%s' uses only %llu", bytes.len,
                     gltf_where(gltf, buffer->node), (unsigned long long)buffer->length);
        if (bytes.len >= buffer->length)
            buffer->bytes = str_slice(bytes, 0, (size_t)buffer->length);
    }
    return gltf->errors == 0;
}

str gltf_view_bytes(const struct gltf *gltf, uint32_t view) {
    if (view == GLTF_NONE)
        return STR("");
    const struct gltf_view *v = &gltf->views.items[view];
    return str_slice(gltf->buffers.items[v->buffer].bytes, (size_t)v->offset,
                     (size_t)(v->offset + v->length));
}
