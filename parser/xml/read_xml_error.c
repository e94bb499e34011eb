#include "diag/codes/limit.h"
#include "diag/codes/syntax.h"
#include "parser/xml/xml_reader.h"

#include "core/nearest.h"
#include "parser/tree/mend.h"

#include <string.h>

static span word_at(const struct xml_reader *r, uint32_t at) {
    str text = r->text->bytes;
    uint32_t end = at;
    while (end < text.len && !char_is_space(text.ptr[end]) && !memchr("<>=/\"'", text.ptr[end], 6))
        end++;
    return xml_span(r, at, end > at ? end : at + (at < text.len));
}

static span character_at(const struct xml_reader *r, uint32_t at) {
    str text = r->text->bytes;
    return xml_span(r, at, at + (at < text.len ? (uint32_t)utf8_sequence_length(text, at) : 0));
}

static bool begins_with(const struct xml_reader *r, uint32_t at, const char *what) {
    return str_starts_with(str_slice(r->text->bytes, at, r->text->bytes.len), str_from(what));
}

// The element that was open when the file ended or another was closed.
static const struct xml_frame *innermost(const struct xml_reader *r) {
    return r->depth ? &r->frames[r->depth - 1] : NULL;
}

static str frame_name(const struct xml_reader *r, const struct xml_frame *frame) {
    return str_slice(r->text->bytes, frame->name.begin, frame->name.end);
}

static void report_end(struct xml_reader *r) {
    struct diag_sink *sink = r->context->sink;
    const struct xml_frame *open = innermost(r);
    if (!open) {
        if (sink->errors)
            return;
        diag_add(sink, DIAG_EMPTY_FILE, xml_span(r, 0, 0), "the file contains no scene");
        diag_help(sink, "a scene begins with <Scene glint=\"1\">");
        return;
    }
    str name = frame_name(r, open);
    diag_add(sink, DIAG_XML_SYNTAX, open->name, "<%.*s> is not closed", STR_ARG(reader_clip(name)));
    diag_help(sink, "write </%.*s> after its content, or '/>' at the end of its tag",
              STR_ARG(reader_clip(name)));
}

static void report_mismatch(struct xml_reader *r, uint32_t at) {
    struct diag_sink *sink = r->context->sink;
    const struct xml_frame *open = innermost(r);
    if (begins_with(r, at, "</"))
        at += 2;
    span closing = word_at(r, at);
    str name = str_slice(r->text->bytes, closing.begin, closing.end);
    if (!open) {
        diag_add(sink, DIAG_XML_SYNTAX, closing, "</%.*s> closes nothing", STR_ARG(reader_clip(name)));
        return;
    }
    str expected = frame_name(r, open);
    diag_add(sink, DIAG_XML_SYNTAX, closing, "this is </%.*s>, but </%.*s> is expected",
             STR_ARG(reader_clip(name)), STR_ARG(reader_clip(expected)));
    diag_note(sink, open->name, "<%.*s> was opened here", STR_ARG(reader_clip(expected)));
    bool by_case =
        name.len == expected.len && str_ends_with_nocase(name, arena_copy(r->context->arena, expected).ptr);
    if (by_case || (expected.len > 3 && nearest_distance(name, expected) == 1))
        diag_fix(sink, true, closing, expected);
    if (by_case)
        diag_help(sink, "write </%.*s>: case matters", STR_ARG(reader_clip(expected)));
    else
        diag_help(sink, "write </%.*s> after its content, or '/>' at the end of its tag",
                  STR_ARG(reader_clip(expected)));
}

// Where the tag that contains the byte `at` begins; `at` itself if it is not in a tag.
static uint32_t tag_around(const struct xml_reader *r, uint32_t at) {
    str text = r->text->bytes;
    uint32_t begin = at;
    while (begin > r->tag_end && begin > r->text->begin && text.ptr[begin - 1] != '<')
        begin--;
    return begin > r->text->begin && text.ptr[begin - 1] == '<' && begin > r->tag_end ? begin - 1 : at;
}

static bool report_tag_end(struct xml_reader *r, uint32_t tag, uint32_t at) {
    struct diag_sink *sink = r->context->sink;
    if (begins_with(r, at, "/")) {
        diag_add(sink, DIAG_XML_SYNTAX, character_at(r, at), "'>' must follow this '/'");
        return true;
    }
    if (begins_with(r, at, "<")) {
        diag_add(sink, DIAG_XML_SYNTAX, word_at(r, tag + 1), "this tag is not closed");
        diag_note(sink, character_at(r, at), "the next tag begins here");
        diag_help(sink, "write '>' or '/>' after its last attribute");
        return true;
    }
    return false;
}

// '<' between the quotes of a value, `quote` being the first of them.
static bool report_less_than(struct xml_reader *r, uint32_t quote, uint32_t at, str name) {
    struct diag_sink *sink = r->context->sink;
    str text = r->text->bytes;
    uint32_t end = at;
    if (at < quote || quote >= text.len)
        return false; // the file ends before the value
    while (end < text.len && text.ptr[end] != text.ptr[quote] && text.ptr[end] != '\n')
        end++;
    bool closed = end + 1 < text.len && text.ptr[end] == text.ptr[quote] && text.ptr[end - 1] != '=' &&
                  memchr(" \t\r\n/>", text.ptr[end + 1], 6);
    if (!begins_with(r, at, "<") || !closed)
        return false;
    diag_add(sink, DIAG_XML_SYNTAX, character_at(r, at), "a '<' inside the value of '%.*s'",
             STR_ARG(reader_clip(name)));
    diag_help(sink, "write '&lt;' for the character '<'");
    diag_fix(sink, true, character_at(r, at), STR("&lt;"));
    return true;
}

// What is wrong inside a tag, from its beginning on; false: not known.
static bool report_in_tag(struct xml_reader *r, uint32_t tag, uint32_t at) {
    struct diag_sink *sink = r->context->sink;
    str text = r->text->bytes;
    uint32_t pos = xml_name_end(text, tag);
    if (pos == tag + 1) {
        diag_add(sink, DIAG_XML_SYNTAX, character_at(r, tag), "a tag's name must follow '<' directly");
        diag_help(sink, "write '&lt;' for the character '<'");
        return true;
    }
    struct xml_attribute attribute;
    while (xml_next_attribute(text, &pos, &attribute) == XML_TAG_MORE) {
        if (attribute.value_end + 1 == at && at < text.len && !memchr(" \t\r\n/>?", text.ptr[at], 7)) {
            diag_add(sink, DIAG_XML_SYNTAX, word_at(r, at), "a space is missing before this attribute");
            diag_fix(sink, true, xml_span(r, at, at), STR(" "));
            return true;
        }
        if (attribute.value_end > at)
            return false;
    }
    span name = word_at(r, pos);
    str written = str_slice(text, name.begin, name.end);
    uint32_t sign = name.end;
    while (sign < text.len && char_is_space(text.ptr[sign]))
        sign++;
    char next = sign < text.len ? text.ptr[sign] : '\0';
    if (pos >= text.len || memchr("<>=/\"'&", text.ptr[pos], 7))
        return report_tag_end(r, tag, pos);
    if (next != '=') {
        diag_add(sink, DIAG_XML_SYNTAX, name, "the attribute '%.*s' has no value",
                 STR_ARG(reader_clip(written)));
        diag_help(sink, "write %.*s=\"...\"", STR_ARG(reader_clip(written)));
        return true;
    }
    sign++;
    while (sign < text.len && char_is_space(text.ptr[sign]))
        sign++;
    if (sign < text.len && text.ptr[sign] != '"' && text.ptr[sign] != '\'') {
        span value = word_at(r, sign);
        str bare = mend_quotes(str_slice(text, value.begin, value.end));
        diag_add(sink, DIAG_XML_SYNTAX, value, "the value of '%.*s' needs quotes",
                 STR_ARG(reader_clip(written)));
        diag_help(sink, "write %.*s=\"%.*s\"", STR_ARG(reader_clip(written)), STR_ARG(reader_clip(bare)));
        diag_fix(sink, true, value, arena_format(r->context->arena, "\"%.*s\"", STR_ARG(bare)));
        return true;
    }
    if (report_less_than(r, sign, at, written))
        return true;
    diag_add(sink, DIAG_XML_SYNTAX, name, "the value of '%.*s' has no closing quote",
             STR_ARG(reader_clip(written)));
    diag_help(sink, "close the quotes; write '&lt;' for the character '<'");
    return true;
}

static void report_unclosed(struct xml_reader *r, uint32_t at) {
    struct diag_sink *sink = r->context->sink;
    if (begins_with(r, at, "<!--")) {
        diag_add(sink, DIAG_XML_SYNTAX, xml_span(r, at, at + 4), "this comment is not closed");
        diag_help(sink, "write --> after it");
    } else if (begins_with(r, at, "<?")) {
        diag_add(sink, DIAG_XML_SYNTAX, xml_span(r, at, at + 2), "'<?' is not closed");
        diag_help(sink, "write ?> after it");
    } else if (!report_in_tag(r, at, (uint32_t)r->text->bytes.len)) {
        diag_add(sink, DIAG_XML_SYNTAX, word_at(r, at + 1), "this tag is not closed");
        diag_help(sink, "write '>' or '/>' after its last attribute");
    }
}

static void report_token(struct xml_reader *r, uint32_t at) {
    struct diag_sink *sink = r->context->sink;
    uint32_t tag = tag_around(r, at);
    if (begins_with(r, tag, "<!--")) {
        diag_add(sink, DIAG_XML_SYNTAX, character_at(r, at), "'--' inside a comment");
        diag_help(sink, "a comment ends with -->, and must not contain another '--'");
    } else if (begins_with(r, tag, "<!") && !begins_with(r, tag, "<![")) {
        diag_add(sink, DIAG_XML_DOCTYPE, xml_span(r, tag, word_at(r, tag + 2).end),
                 "a scene must not have declarations");
        diag_help(sink, "remove it");
    } else if (tag != at && begins_with(r, tag, "</")) {
        diag_add(sink, DIAG_XML_SYNTAX, character_at(r, at),
                 "a closing tag contains a name and nothing else");
    } else if (tag != at && report_in_tag(r, tag, at)) {
        return;
    } else if (begins_with(r, at, "<") || begins_with(r, at > 0 ? at - 1 : 0, "<")) {
        diag_add(sink, DIAG_XML_SYNTAX, character_at(r, at), "a tag's name must follow '<' directly");
        diag_help(sink, "write '&lt;' for the character '<'");
    } else if (at >= 2 && begins_with(r, at - 2, "]]>")) {
        diag_add(sink, DIAG_XML_SYNTAX, xml_span(r, at - 2, at + 1), "']]>' between elements");
    } else {
        diag_add(sink, DIAG_XML_SYNTAX, character_at(r, at), "this character is not allowed here");
    }
}

// Errors that are clear without the text around them.
static void report_simple(struct xml_reader *r, enum XML_Error error, uint32_t at) {
    struct diag_sink *sink = r->context->sink;
    switch (error) {
    case XML_ERROR_NO_MEMORY:
        diag_add(sink, DIAG_OUT_OF_MEMORY, character_at(r, at), "not enough memory to read the file");
        break;
    case XML_ERROR_UNCLOSED_CDATA_SECTION:
        diag_add(sink, DIAG_XML_SYNTAX, character_at(r, at), "'<![CDATA[' is not closed");
        break;
    case XML_ERROR_JUNK_AFTER_DOC_ELEMENT:
        diag_add(sink, DIAG_XML_SYNTAX, character_at(r, at), "this comes after the end of the scene");
        diag_note(sink, r->root_end, "it ended here");
        diag_help(sink,
                  "a file has one element that contains all others; <Include file=\"...\"/> joins files");
        break;
    case XML_ERROR_BAD_CHAR_REF:
        diag_add(sink, DIAG_XML_ENTITY, word_at(r, at), "this reference does not name a character");
        break;
    case XML_ERROR_UNDEFINED_ENTITY:
        diag_add(sink, DIAG_XML_ENTITY, word_at(r, at), "there is no such entity in a scene");
        break;
    case XML_ERROR_DUPLICATE_ATTRIBUTE:
        diag_add(sink, DIAG_DUPLICATE_ATTRIBUTE, word_at(r, at), "an attribute is given twice");
        break;
    case XML_ERROR_MISPLACED_XML_PI:
        diag_add(sink, DIAG_XML_SYNTAX, xml_span(r, at, at + 5),
                 "<?xml ...?> must be the very first thing in the file");
        diag_help(sink, "remove everything before it, spaces and empty lines too");
        break;
    case XML_ERROR_XML_DECL:
        diag_add(sink, DIAG_XML_SYNTAX, character_at(r, at), "the XML declaration cannot be read");
        diag_help(sink, "write <?xml version=\"1.0\" encoding=\"UTF-8\"?>, or nothing");
        break;
    default:
        diag_add(sink, DIAG_XML_SYNTAX, character_at(r, at), "the XML cannot be read here: %s",
                 XML_ErrorString(error));
        break;
    }
}

static void report_start(struct xml_reader *r, uint32_t at) {
    if (begins_with(r, at, "<!")) {
        report_token(r, at);
        return;
    }
    diag_add(r->context->sink, DIAG_XML_SYNTAX, word_at(r, at), "this comes before the first element");
    str word = source_text(r->context->sources, word_at(r, at));
    bool yaml = word.len && (word.ptr[0] == '{' || word.ptr[0] == '#' || word.ptr[word.len - 1] == ':' ||
                             str_equal(word, STR("---")));
    diag_help(r->context->sink,
              yaml ? "the file looks like YAML: name it .yaml" : "a scene begins with <Scene glint=\"1\">");
}

void xml_report(struct xml_reader *r) {
    enum XML_Error error = XML_GetErrorCode(r->parser);
    uint32_t at = r->text->begin + (uint32_t)XML_GetErrorByteIndex(r->parser);
    if (at > r->text->bytes.len)
        at = (uint32_t)r->text->bytes.len;
    if (error == XML_ERROR_NO_ELEMENTS)
        report_end(r);
    else if (error == XML_ERROR_TAG_MISMATCH)
        report_mismatch(r, at);
    else if (error == XML_ERROR_UNCLOSED_TOKEN)
        report_unclosed(r, at);
    else if (error == XML_ERROR_INVALID_TOKEN)
        report_token(r, at);
    else if (error == XML_ERROR_SYNTAX)
        report_start(r, at);
    else
        report_simple(r, error, at);
}
