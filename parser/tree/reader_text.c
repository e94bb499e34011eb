#include "parser/tree/reader_text.h"
#include "diag/codes/limit.h"
#include "diag/codes/syntax.h"

#include <inttypes.h>

enum {
    BAD_PLACES_MAX = 1000,
    SHOWN_BYTES = 60
};

static bool looks_like_utf16(str s) {
    if (s.len < 2)
        return false;
    const unsigned char *p = (const unsigned char *)s.ptr;
    if ((p[0] == 0xFF && p[1] == 0xFE) || (p[0] == 0xFE && p[1] == 0xFF))
        return true;
    // Without a mark: each second byte of Latin text is 0.
    return s.len >= 4 && ((p[0] && !p[1] && p[2] && !p[3]) || (!p[0] && p[1] && !p[2] && p[3]));
}

// Length of the control character at `at`, 0 if there is none.
static size_t control_length(str s, size_t at) {
    const unsigned char *p = (const unsigned char *)s.ptr + at;
    size_t left = s.len - at;
    if (p[0] < 0x20)
        return p[0] != '\t' && p[0] != '\n' && p[0] != '\r';
    if (p[0] == 0x7F)
        return 1;
    if (p[0] == 0xC2 && left > 1 && p[1] >= 0x80 && p[1] < 0xA0)
        return p[1] == 0x85 ? 0 : 2; // NEL ends a line
    if (p[0] == 0xEF && left > 2) {
        bool noncharacter = p[1] == 0xBF && p[2] >= 0xBE;
        bool byte_order_mark = p[1] == 0xBB && p[2] == 0xBF;
        return noncharacter || byte_order_mark ? 3 : 0;
    }
    return 0;
}

size_t reader_find_control(str decoded) {
    for (size_t i = str_skip_printable(decoded, 0); i < decoded.len; i = str_skip_printable(decoded, i + 1))
        if (control_length(decoded, i))
            return i;
    return decoded.len;
}

static void name_control(const struct reader_context *context, struct reader_text *text, uint32_t at,
                         size_t length, uint32_t count) {
    span place = {text->source, at, at + (uint32_t)length};
    uint32_t c = utf8_decode(text->bytes, at);
    if (c == 0)
        diag_add(context->sink, DIAG_CONTROL_CHARACTER, place, "a NUL byte");
    else if (c == 0xFEFF)
        diag_add(context->sink, DIAG_CONTROL_CHARACTER, place, "a byte order mark inside the text");
    else
        diag_add(context->sink, DIAG_CONTROL_CHARACTER, place, "the control character U+%04" PRIX32, c);
    if (count > 1)
        diag_note(context->sink, SPAN_NONE, "there are %" PRIu32 " control characters in the file", count);
    diag_help(context->sink, "remove it");
}

static void name_bytes(const struct reader_context *context, struct reader_text *text, uint32_t at,
                       uint32_t count) {
    span place = {text->source, at, at + 1};
    diag_add(context->sink, DIAG_BAD_UTF8, place, "the byte 0x%02X is not part of UTF-8 text",
             (unsigned char)text->bytes.ptr[at]);
    if (count > 1)
        diag_note(context->sink, SPAN_NONE, "there are %" PRIu32 " such bytes in the file", count);
    diag_help(context->sink, "save the file as UTF-8");
}

struct bad_bytes {
    uint32_t first, length, count;
};

static void note_bad(struct bad_bytes *bad, size_t at, size_t length) {
    if (bad->count++ == 0) {
        bad->first = (uint32_t)at;
        bad->length = (uint32_t)length;
    }
}

static void overwrite(const struct reader_context *context, struct reader_text *text, size_t at,
                      size_t length, char with) {
    static const char blanks[] = "   ", marks[] = "___";
    reader_text_put(context, text, (uint32_t)at, (str){with == ' ' ? blanks : marks, length});
    reader_text_mark(context, text, (uint32_t)at, (uint32_t)(at + length));
}

// Finds and overwrites; false if there is so much that the file cannot be text.
static bool clean(const struct reader_context *context, struct reader_text *text, struct bad_bytes *bytes,
                  struct bad_bytes *controls) {
    str all = text->bytes;
    for (size_t at = str_skip_printable(all, text->begin); at < all.len; at = str_skip_printable(all, at)) {
        size_t n = utf8_sequence_length(all, at);
        size_t control = n ? control_length(all, at) : 0;
        if (n == 0)
            note_bad(bytes, at, 1);
        else if (control)
            note_bad(controls, at, control);
        if (n == 0 || control) {
            if (bytes->count + controls->count > BAD_PLACES_MAX)
                return false;
            overwrite(context, text, at, n ? n : 1, n ? ' ' : '_');
            all = text->bytes;
        }
        at += n ? n : 1;
    }
    return true;
}

bool reader_text_open(const struct reader_context *context, uint32_t source, uint32_t begin,
                      bool foreign_encoding, struct reader_text *text) {
    str all = context->sources->items[source].text;
    *text = (struct reader_text){.source = source, .begin = begin, .bytes = all};
    if (begin == 0 && looks_like_utf16(all)) {
        diag_add(context->sink, DIAG_BAD_UTF8, (span){source, 0, 1}, "the file is UTF-16 text, not UTF-8");
        diag_help(context->sink, "save it as UTF-8");
        return false;
    }
    if (begin == 0)
        text->begin = (uint32_t)str_skip_mark(all);
    struct bad_bytes bytes = {0}, controls = {0};
    bool is_text = clean(context, text, &bytes, &controls);
    text->is_binary = bytes.count + controls.count > 8;
    // The places are those in the original, which the copy has overwritten.
    str read = text->bytes;
    text->bytes = all;
    if (bytes.count && !foreign_encoding)
        name_bytes(context, text, bytes.first, is_text ? bytes.count : 0);
    if (controls.count)
        name_control(context, text, controls.first, controls.length, is_text ? controls.count : 0);
    text->bytes = read;
    if (is_text && context->sources->items[source].kind != SOURCE_KIND_OPTION)
        reader_conflicts(context, text);
    text->is_overwritten = text->copy != NULL;
    return is_text;
}

bool reader_text_is_blank(const struct reader_text *text) {
    return str_trim(str_slice(text->bytes, text->begin, text->bytes.len)).len == 0;
}

str reader_clip(str text) {
    if (text.len <= SHOWN_BYTES)
        return text;
    size_t end = SHOWN_BYTES;
    while (end > 0 && ((unsigned char)text.ptr[end] & 0xC0) == 0x80)
        end--;
    return str_slice(text, 0, end);
}

void reader_limit_needs(struct diag_sink *sink, const struct limits *limits, enum limit which, span at,
                        const char *what, double needed) {
    const struct limit_info *info = limit_info(which);
    const uint64_t now = limits->value[which];
    uint64_t more = now > info->greatest / 2 ? info->greatest : now * 2;
    if (needed > (double)more)
        more = needed <= (double)info->greatest ? (uint64_t)needed : now;
    diag_add(sink, DIAG_LIMIT, at, "%s: more than %" PRIu64 " (limit %s)", what, now, info->name);
    if (more > now)
        diag_help(sink, "if this is intended, raise the limit: --limit %s=%" PRIu64, info->name, more);
}

void reader_limit(struct diag_sink *sink, const struct limits *limits, enum limit which, span at,
                  const char *what) {
    reader_limit_needs(sink, limits, which, at, what, 0);
}
