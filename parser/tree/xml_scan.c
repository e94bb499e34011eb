#include "parser/tree/xml_scan.h"

#include <string.h>

// A table, since each byte of a name is checked.
static bool ends_name(char c) {
    static const bool ends[256] = {
        [' '] = true, ['\t'] = true, ['\n'] = true, ['\r'] = true, ['='] = true, ['/'] = true,
        ['>'] = true, ['<'] = true,  ['"'] = true,  ['\''] = true, ['&'] = true};
    return ends[(unsigned char)c];
}

uint32_t xml_name_end(str text, uint32_t at) {
    at++;
    while (at < text.len && !ends_name(text.ptr[at]))
        at++;
    return at;
}

uint32_t xml_skip_blanks(str text, uint32_t at) {
    while (at < text.len && char_is_space(text.ptr[at]))
        at++;
    return at;
}

static enum xml_tag_end tag_end(str text, uint32_t at) {
    if (text.ptr[at] == '>')
        return XML_TAG_OPEN;
    uint32_t behind = xml_skip_blanks(text, at + 1);
    if (text.ptr[at] != '/' || behind >= text.len || text.ptr[behind] != '>')
        return XML_TAG_MALFORMED;
    return behind == at + 1 ? XML_TAG_EMPTY : XML_TAG_SPLIT;
}

enum xml_tag_end xml_next_attribute(str text, uint32_t *at, struct xml_attribute *attribute) {
    uint32_t begin = xml_skip_blanks(text, *at);
    *at = begin;
    if (begin >= text.len)
        return XML_TAG_MALFORMED;
    uint32_t end = begin;
    while (end < text.len && !ends_name(text.ptr[end]))
        end++;
    if (end == begin)
        return tag_end(text, begin);
    uint32_t sign = xml_skip_blanks(text, end);
    uint32_t quote =
        sign < text.len && text.ptr[sign] == '=' ? xml_skip_blanks(text, sign + 1) : (uint32_t)text.len;
    if (quote >= text.len || (text.ptr[quote] != '"' && text.ptr[quote] != '\''))
        return XML_TAG_MALFORMED;
    uint32_t stop = quote + 1;
    while (stop < text.len && text.ptr[stop] != text.ptr[quote] && text.ptr[stop] != '<')
        stop++;
    if (stop >= text.len || text.ptr[stop] == '<')
        return XML_TAG_MALFORMED;
    *attribute = (struct xml_attribute){begin, end, quote + 1, stop};
    *at = stop + 1;
    return XML_TAG_MORE;
}

uint32_t xml_behind(str text, uint32_t at, const char *what) {
    size_t length = strlen(what);
    for (size_t from = at; from + length <= text.len; from++) {
        const char *hit = memchr(text.ptr + from, what[0], text.len - length + 1 - from);
        if (!hit)
            break;
        from = (size_t)(hit - text.ptr);
        if (memcmp(hit, what, length) == 0)
            return (uint32_t)(from + length);
    }
    return 0;
}

uint32_t xml_end_name(str text, uint32_t begin, uint32_t end) {
    uint32_t at = end;
    while (at > begin && text.ptr[at - 1] != '<')
        at--;
    return at > begin && at < end && text.ptr[at] == '/' ? at + 1 : 0;
}
