#include "diag/codes/limit.h"
#include "diag/codes/syntax.h"
#include "parser/xml/xml_reader.h"

#include "core/heap.h"

#include <stdlib.h>
#include <string.h>

enum {
    CHUNK_BYTES = 1 << 24
};

// The data that a callback works on.
struct xml_event {
    struct xml_reader *reader;
    void (*body)(struct xml_reader *, const struct xml_event *);
    const char *name;
    const char **attributes;
    uint32_t begin, end; // bytes of the source
};

static void run_body(void *context) {
    const struct xml_event *event = context;
    event->body(event->reader, event);
}

// Runs the body of a callback. A jump of the arena must not cross expat's frames: it is caught here, within
// the callback, and passed on once expat has returned.
static void guarded(struct xml_reader *r, void (*body)(struct xml_reader *, const struct xml_event *),
                    const char *name, const char **attributes) {
    if (r->stopped)
        return;
    uint32_t begin = r->text->begin + (uint32_t)XML_GetCurrentByteIndex(r->parser);
    uint32_t end = begin + (uint32_t)XML_GetCurrentByteCount(r->parser);
    struct xml_event event = {r, body, name, attributes, begin, end};
    r->fault = arena_guarded(r->context->arena, run_body, &event);
    if (r->fault)
        xml_stop(r);
}

static void on_text(struct xml_reader *r, const struct xml_event *event) {
    str text = r->text->bytes;
    uint32_t begin = event->begin, end = event->end;
    while (begin < end && char_is_space(text.ptr[begin]))
        begin++;
    while (end > begin && char_is_space(text.ptr[end - 1]))
        end--;
    if (begin == end)
        return;
    if (r->in_cdata)
        begin = r->cdata_begin;
    if (r->run.begin == r->run.end)
        r->run.begin = begin;
    r->run.end = end;
}

static void on_cdata_begin(struct xml_reader *r, const struct xml_event *event) {
    r->in_cdata = true;
    r->cdata_begin = event->begin;
}

static void on_cdata_end(struct xml_reader *r, const struct xml_event *event) {
    r->in_cdata = false;
    if (r->run.begin != r->run.end && r->run.end > r->cdata_begin)
        r->run.end = event->end;
}

// Decoded values come from expat, in the order of the file; places from the tag itself.
static void on_start(struct xml_reader *r, const struct xml_event *event) {
    str name = str_from(event->name);
    uint32_t at = event->begin + 1 + (uint32_t)name.len;
    if (!xml_open(r, (struct reader_range){event->begin, event->end}, name))
        return;
    for (const char **a = event->attributes; a[0] && !r->stopped; a += 2) {
        struct xml_attribute place;
        if (xml_next_attribute(r->text->bytes, &at, &place) != XML_TAG_MORE)
            place = (struct xml_attribute){event->begin, event->begin, event->begin, event->begin};
        xml_add_attribute(r, str_from(a[0]), str_from(a[1]), place);
    }
    xml_opened(r);
}

static void on_end(struct xml_reader *r, const struct xml_event *event) {
    xml_close(r, event->end);
}

static void on_comment(struct xml_reader *r, const struct xml_event *event) {
    xml_see_comment(r, event->begin, event->end);
}

static void on_instruction(struct xml_reader *r, const struct xml_event *event) {
    xml_see_instruction(r, str_from(event->name), event->begin, event->end);
}

static void on_doctype(struct xml_reader *r, const struct xml_event *event) {
    str text = r->text->bytes;
    uint32_t begin = event->begin;
    while (begin > r->text->begin && !str_starts_with(str_slice(text, begin, text.len), STR("<!DOCTYPE")))
        begin--;
    diag_add(r->context->sink, DIAG_XML_DOCTYPE, xml_span(r, begin, begin + 9),
             "a scene must not have a DOCTYPE");
    diag_help(r->context->sink, "remove it; what it declares is not read");
    xml_stop(r);
}

// ---- expat

static void XMLCALL start_element(void *data, const XML_Char *name, const XML_Char **attributes) {
    guarded(data, on_start, name, attributes);
}
static void XMLCALL end_element(void *data, const XML_Char *name) {
    guarded(data, on_end, name, NULL);
}
static void XMLCALL character_data(void *data, const XML_Char *text, int length) {
    (void)text;
    (void)length;
    guarded(data, on_text, NULL, NULL);
}
static void XMLCALL comment(void *data, const XML_Char *text) {
    (void)text;
    guarded(data, on_comment, NULL, NULL);
}
static void XMLCALL cdata_begin(void *data) {
    guarded(data, on_cdata_begin, NULL, NULL);
}
static void XMLCALL cdata_end(void *data) {
    guarded(data, on_cdata_end, NULL, NULL);
}
static void XMLCALL instruction(void *data, const XML_Char *target, const XML_Char *text) {
    (void)text;
    guarded(data, on_instruction, target, NULL);
}
static void XMLCALL doctype(void *data, const XML_Char *name, const XML_Char *system, const XML_Char *public,
                            int has_subset) {
    (void)system;
    (void)public;
    (void)has_subset;
    guarded(data, on_doctype, name, NULL);
}

static enum XML_Status feed(struct xml_reader *r) {
    str text = r->text->bytes;
    enum XML_Status status = XML_STATUS_OK;
    for (size_t at = r->text->begin, n; status == XML_STATUS_OK && at < text.len; at += n) {
        n = text.len - at < CHUNK_BYTES ? text.len - at : CHUNK_BYTES;
        status = XML_Parse(r->parser, text.ptr + at, (int)n, at + n == text.len);
    }
    return status;
}

// After the end of the file, or when the reader stopped.
static void finish(struct xml_reader *r) {
    xml_end_text(r);
    for (uint32_t i = 0; i < r->depth; i++) {
        struct tree_node *open = tree_node(r->tree, r->frames[i].node);
        open->flags |= TREE_CUT;
        open->end = r->tag_end;
    }
    if (r->pending.begin != r->pending.end)
        r->tree->closing_comments = xml_span(r, r->pending.begin, r->pending.end);
    if (!span_is_none(r->xinclude)) {
        diag_add(r->context->sink, DIAG_XML_NAMESPACE, r->xinclude, "a scene must not use namespaces");
        diag_help(r->context->sink, "remove it");
    }
}

static void run_expat(struct xml_reader *r) {
    XML_SetUserData(r->parser, r);
    XML_SetElementHandler(r->parser, start_element, end_element);
    XML_SetCharacterDataHandler(r->parser, character_data);
    XML_SetCommentHandler(r->parser, comment);
    XML_SetCdataSectionHandler(r->parser, cdata_begin, cdata_end);
    XML_SetProcessingInstructionHandler(r->parser, instruction);
    XML_SetStartDoctypeDeclHandler(r->parser, doctype);
    bool refused = feed(r) != XML_STATUS_OK;
    if (r->fault)
        return;
    if (refused && !r->stopped && !(r->text->is_binary && r->tree->root))
        xml_report(r);
    r->tree->broken = refused;
    finish(r);
}

// The encoding that the XML declaration names; false: none is named.
static bool declared_encoding(str text, struct reader_range *encoding) {
    uint32_t at = (uint32_t)str_skip_mark(text);
    str rest = str_slice(text, at, text.len);
    if (!str_starts_with(rest, STR("<?xml")) || rest.len < 6 || !char_is_space(rest.ptr[5]))
        return false;
    uint32_t end = xml_behind(text, at, "?>");
    str declaration = str_slice(text, 0, end ? end : text.len);
    at += 5;
    struct xml_attribute attribute;
    while (xml_next_attribute(declaration, &at, &attribute) == XML_TAG_MORE) {
        if (!str_equal(str_slice(text, attribute.name_begin, attribute.name_end), STR("encoding")))
            continue;
        *encoding = (struct reader_range){attribute.value_begin, attribute.value_end};
        return true;
    }
    return false;
}

// The checks that do not need expat: encoding, UTF-8, and repairable mistakes.
static bool prepare(const struct reader_context *context, uint32_t source, struct reader_text *text) {
    struct reader_range encoding = {0};
    str all = context->sources->items[source].text;
    bool foreign = declared_encoding(all, &encoding);
    str named = str_slice(all, encoding.begin, encoding.end);
    foreign = foreign && !(named.len == 5 && str_ends_with_nocase(named, "utf-8"));
    if (foreign) {
        diag_add(context->sink, DIAG_XML_ENCODING, (span){source, encoding.begin, encoding.end},
                 "the encoding is '%.*s', not UTF-8", STR_ARG(reader_clip(named)));
        diag_help(context->sink, "save the file as UTF-8 and write encoding=\"UTF-8\"");
    }
    if (!reader_text_open(context, source, 0, foreign, text))
        return false;
    if (reader_text_is_blank(text)) {
        diag_add(context->sink, DIAG_EMPTY_FILE, (span){source, 0, 0}, "the file contains no scene");
        diag_help(context->sink, "a scene begins with <Scene glint=\"1\">");
        return false;
    }
    if (!context->taker)
        xml_repair(context, text);
    reader_text_seal(text);
    return !context->taker || context->sink->count == 0;
}

// expat never reads files whose entries are handed over one by one.
static bool read_plain(struct xml_reader *r) {
    if (!xml_read_plain(r))
        return false;
    finish(r);
    return r->context->sink->count == 0;
}

bool read_xml(const struct reader_context *context, uint32_t source, struct tree *tree) {
    tree_init(tree, context->arena, source, true);
    struct reader_text text;
    if (!prepare(context, source, &text))
        return false;
    tree->overwritten = text.is_overwritten;
    struct xml_reader reader = {.context = context, .text = &text, .tree = tree};
    reader.frames =
        ARENA_ARRAY(context->arena, struct xml_frame, context->limits->value[LIMIT_SCENE_DEPTH] + 1);
    if (context->taker)
        return read_plain(&reader);
    static const XML_Memory_Handling_Suite memory = {heap_alloc, heap_resize, free};
    reader.parser = XML_ParserCreate_MM("UTF-8", &memory, NULL);
    if (!reader.parser) {
        diag_add(context->sink, DIAG_OUT_OF_MEMORY, (span){source, 0, 0},
                 "not enough memory to read the file");
        return false;
    }
    run_expat(&reader);
    XML_ParserFree(reader.parser);
    if (reader.fault)
        arena_raise(context->arena, reader.fault);
    return tree->root != 0;
}
