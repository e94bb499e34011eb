#include "diag/codes/syntax.h"
#include "parser/xml/xml_reader.h"

#include "core/str_map.h"

#include <string.h>

struct repairer {
    const struct reader_context *context;
    struct reader_text *text;
    struct str_map names; // attributes of the tag
};

static span place(const struct repairer *r, uint32_t begin, uint32_t end) {
    return (span){r->text->source, begin, end};
}

static void blank_out(struct repairer *r, uint32_t begin, uint32_t end) {
    for (uint32_t at = begin; at < end; at++)
        if (!char_is_space(r->text->bytes.ptr[at]))
            reader_text_put(r->context, r->text, at, STR(" "));
}

// A reference by number to a character that XML allows: "#233", "#xE9".
static bool is_character(str name) {
    bool hex = name.len > 1 && name.ptr[1] == 'x';
    uint32_t value = 0;
    size_t at = hex ? 2 : 1;
    if (at >= name.len)
        return false;
    for (; at < name.len && value <= 0x10FFFF; at++) {
        const int digit = char_hex(name.ptr[at]);
        if (digit < 0 || (!hex && digit > 9))
            return false;
        value = value * (hex ? 16 : 10) + (uint32_t)digit;
    }
    return (value >= 0x20 && value <= 0xD7FF) || (value >= 0xE000 && value <= 0xFFFD) ||
           (value >= 0x10000 && value <= 0x10FFFF) || value == '\t' || value == '\n' || value == '\r';
}

static bool is_known_entity(str name) {
    static const char *const known[] = {"amp", "lt", "gt", "quot", "apos"};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (str_equal_cstr(name, known[i]))
            return true;
    return name.len > 0 && name.ptr[0] == '#' && is_character(name);
}

static bool in_entity(char c) {
    return (unsigned char)c >= 0x80 || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           (c >= '0' && c <= '9') || memchr("_-.:#", c, 5) != NULL;
}

// The '&' at `at`; returns the offset after it.
static uint32_t check_entity(struct repairer *r, uint32_t at) {
    str text = r->text->bytes;
    uint32_t end = at + 1;
    while (end < text.len && in_entity(text.ptr[end]))
        end++;
    bool closed = end > at + 1 && end < text.len && text.ptr[end] == ';';
    str name = str_slice(text, at + 1, end);
    if (closed && is_known_entity(name))
        return end + 1;
    struct diag_sink *sink = r->context->sink;
    if (!closed) {
        diag_add(sink, DIAG_XML_ENTITY, place(r, at, at + 1), "'&' begins an entity, but none follows");
        diag_help(sink, "write '&amp;' for the character '&'");
        diag_fix(sink, end == at + 1, place(r, at, at + 1), STR("&amp;"));
        end = at + 1;
    } else {
        end++;
        diag_add(sink, DIAG_XML_ENTITY, place(r, at, end), "there is no entity '&%.*s;' in a scene",
                 STR_ARG(reader_clip(name)));
        diag_help(sink,
                  "write the character itself; XML has &amp; &lt; &gt; &quot; &apos; and &#233; for others");
    }
    blank_out(r, at, end);
    reader_text_mark(r->context, r->text, at, end);
    return end;
}

static void check_entities(struct repairer *r, uint32_t begin, uint32_t end) {
    for (uint32_t at = begin; at < end;)
        at = r->text->bytes.ptr[at] == '&' ? check_entity(r, at) : at + 1;
}

static void check_twice(struct repairer *r, struct xml_attribute attribute) {
    str name =
        str_slice(r->context->sources->items[r->text->source].text, attribute.name_begin, attribute.name_end);
    uint32_t *first = str_map_at(&r->names, name);
    if (!*first) {
        *first = attribute.name_begin;
        return;
    }
    struct diag_sink *sink = r->context->sink;
    diag_add(sink, DIAG_DUPLICATE_ATTRIBUTE, place(r, attribute.name_begin, attribute.name_end),
             "the attribute '%.*s' is given twice", STR_ARG(reader_clip(name)));
    diag_note(sink, place(r, *first, *first + (uint32_t)name.len), "it was given here first");
    diag_help(sink, "remove one of the two");
    blank_out(r, attribute.name_begin, attribute.value_end + 1);
}

static void repair_split(struct repairer *r, uint32_t slash) {
    uint32_t end = xml_skip_blanks(r->text->bytes, slash + 1);
    struct diag_sink *sink = r->context->sink;
    diag_add(sink, DIAG_XML_SPLIT_CLOSE, place(r, slash, end + 1), "there is a space inside '/>'");
    diag_help(sink, "write '/>'");
    diag_fix(sink, true, place(r, slash, end + 1), STR("/>"));
    reader_text_put(r->context, r->text, slash, STR(" "));
    reader_text_put(r->context, r->text, end - 1, STR("/"));
}

// The opening tag at `at`; returns the offset after it, the text's length if expat will stop.
static uint32_t repair_tag(struct repairer *r, uint32_t at) {
    uint32_t tag = at;
    at = xml_name_end(r->text->bytes, at);
    if (at == tag + 1)
        return (uint32_t)r->text->bytes.len;
    str_map_clear(&r->names);
    for (;;) {
        struct xml_attribute attribute;
        enum xml_tag_end end = xml_next_attribute(r->text->bytes, &at, &attribute);
        if (end == XML_TAG_MALFORMED)
            return (uint32_t)r->text->bytes.len;
        if (end == XML_TAG_OPEN)
            return at + 1;
        if (end != XML_TAG_MORE) {
            if (end == XML_TAG_SPLIT)
                repair_split(r, at);
            return xml_skip_blanks(r->text->bytes, at + 1) + 1;
        }
        check_entities(r, attribute.value_begin, attribute.value_end);
        check_twice(r, attribute);
    }
}

// A DOCTYPE without declarations of its own is overwritten with spaces; expat's handler refuses the others.
static uint32_t repair_doctype(struct repairer *r, uint32_t at) {
    str text = r->text->bytes;
    uint32_t end = at;
    char quote = '\0';
    for (; end < text.len && (quote || text.ptr[end] != '>'); end++) {
        char c = text.ptr[end];
        if (!quote && c == '[')
            return (uint32_t)text.len;
        if (c == quote)
            quote = '\0';
        else if (!quote && (c == '"' || c == '\''))
            quote = c;
    }
    if (end >= text.len)
        return end;
    diag_add(r->context->sink, DIAG_XML_DOCTYPE, place(r, at, end + 1), "a scene must not have a DOCTYPE");
    diag_help(r->context->sink, "remove it");
    diag_fix(r->context->sink, true, place(r, at, end + 1), STR(""));
    blank_out(r, at, end + 1);
    return end + 1;
}

static uint32_t behind(str text, uint32_t at, const char *end) {
    uint32_t found = xml_behind(text, at, end);
    return found ? found : (uint32_t)text.len;
}

void xml_repair(const struct reader_context *context, struct reader_text *text) {
    struct repairer r = {.context = context, .text = text};
    str_map_init(&r.names, context->arena);
    for (uint32_t at = text->begin; at < text->bytes.len;) {
        str rest = str_slice(text->bytes, at, text->bytes.len);
        if (rest.ptr[0] == '&')
            at = check_entity(&r, at);
        else if (rest.ptr[0] != '<')
            at++;
        else if (str_starts_with(rest, STR("<!--")))
            at = behind(text->bytes, at + 4, "-->");
        else if (str_starts_with(rest, STR("<![CDATA[")))
            at = behind(text->bytes, at, "]]>");
        else if (str_starts_with(rest, STR("<?")))
            at = behind(text->bytes, at, "?>");
        else if (str_starts_with(rest, STR("<!DOCTYPE")))
            at = repair_doctype(&r, at);
        else if (str_starts_with(rest, STR("</")))
            at = behind(text->bytes, at, ">");
        else
            at = repair_tag(&r, at);
    }
}
