#include "parser/read_xml.h"

#include "core/number.h"
#include "parser/mend.h"

#include <string.h>

enum {
    CHUNK_BYTES = 1 << 24
};

#define XSI      "xsi:"
#define XINCLUDE "http://www.w3.org/2001/XInclude"

static void stop(struct xml_reader *r) {
    if (!r->stopped)
        XML_StopParser(r->parser, XML_FALSE);
    r->stopped = true;
}

// What a callback has to work on.
struct xml_event {
    const char *name;
    const char **attributes;
    uint32_t begin, end; // bytes of the source
};

// Runs the body of a callback. A jump of the arena must not cross expat's frames: it is caught here, within
// the callback, and handed on when expat has returned.
static void guarded(struct xml_reader *r, void (*body)(struct xml_reader *, const struct xml_event *),
                    const char *name, const char **attributes) {
    if (r->stopped)
        return;
    uint32_t begin = r->text->begin + (uint32_t)XML_GetCurrentByteIndex(r->parser);
    struct xml_event event = {name, attributes, begin, begin + (uint32_t)XML_GetCurrentByteCount(r->parser)};
    struct arena *arena = r->context->arena;
    struct arena_guard *outer = arena->guard;
    struct arena_guard guard;
    arena_set_guard(arena, &guard);
    if (setjmp(guard.jump) == 0) {
        body(r, &event);
    } else {
        r->fault = guard.fault;
        stop(r);
    }
    arena->guard = outer;
}

static void exceed(struct xml_reader *r, enum limit which, span at, const char *what) {
    reader_limit(r->context->sink, r->context->limits, which, at, what);
    stop(r);
}

static tree_index add(struct xml_reader *r, struct tree_node node) {
    if (r->tree->nodes.count + r->taken.nodes > r->context->limits->value[LIMIT_SCENE_NODES] && !r->stopped)
        exceed(r, LIMIT_SCENE_NODES, xml_span(r, node.begin, node.end), "too many values in the file");
    return tree_add(r->tree, node);
}

static tree_index add_scalar(struct xml_reader *r, str text, span at, enum tree_key key, unsigned flags) {
    if (text.len > r->context->limits->value[LIMIT_SCALAR_BYTES]) {
        exceed(r, LIMIT_SCALAR_BYTES, xml_span(r, at.begin, at.begin + 1), "bytes in one value");
        text.len = 0;
        flags |= TREE_BAD;
    }
    uint32_t offset = tree_add_text(r->tree, text);
    return add(r, (struct tree_node){.kind = TREE_SCALAR,
                                     .key = (uint8_t)key,
                                     .flags = (uint8_t)flags,
                                     .begin = at.begin,
                                     .end = at.end,
                                     .value = offset,
                                     .count = (uint32_t)text.len});
}

// Links a key and its value behind what the element holds.
static void link_pair(struct xml_reader *r, struct xml_frame *frame, tree_index key, tree_index value) {
    tree_node(r->tree, key)->next = value;
    if (frame->last)
        tree_node(r->tree, frame->last)->next = key;
    else
        tree_node(r->tree, frame->node)->value = key;
    frame->last = value;
    frame->last_key = key;
    tree_node(r->tree, frame->node)->count++;
}

static void take_comments(struct xml_reader *r, tree_index entry) {
    if (r->pending.begin == r->pending.end)
        return;
    uint32_t added = tree_add_comment(r->tree, r->pending);
    tree_node(r->tree, entry)->comments = added;
    r->pending = (struct tree_comment){0};
}

// ---- text between elements

// <Radius>1</Radius>: what the author of other XML would write for an attribute.
static void help_text(struct xml_reader *r, str text) {
    const struct xml_frame *frame = r->depth > 1 ? &r->frames[r->depth - 1] : NULL;
    struct diag_sink *sink = r->context->sink;
    double number;
    bool one = number_parse(text, &number) == NUMBER_OK || mend_boolean(text).len || text.ptr[0] == '#';
    if (str_equal(text, STR(">")) || str_equal(text, STR("/>"))) {
        diag_help(sink, "remove it: the tag before it has ended");
    } else if (frame && tree_node(r->tree, frame->node)->count == 0 && one) {
        str element = source_text(r->context->sources, frame[-1].name);
        str attribute = mend_snake(r->context->arena, source_text(r->context->sources, frame->name));
        diag_help(sink, "a value stands in an attribute, as in <%.*s %.*s=\"%.*s\">",
                  STR_ARG(reader_clip(element)), STR_ARG(reader_clip(attribute)), STR_ARG(reader_clip(text)));
    } else if (frame && mend_is_numbers(text)) {
        str element = source_text(r->context->sources, frame->name);
        diag_help(sink, "values stand in attributes, as in <%.*s x=\"1\" y=\"2\" z=\"3\"/>",
                  STR_ARG(reader_clip(element)));
    } else {
        diag_help(sink, "values stand in attributes; a remark stands in <!-- ... -->");
    }
}

static void end_run(struct xml_reader *r) {
    if (r->run.begin == r->run.end)
        return;
    span at = xml_span(r, r->run.begin, r->run.end);
    diag_add(r->context->sink, DIAG_XML_TEXT, at, "text between elements");
    help_text(r, source_text(r->context->sources, at));
    r->run = (struct reader_range){0};
    // What the element lacks was probably written as text.
    if (r->depth > 0)
        tree_node(r->tree, r->frames[r->depth - 1].node)->flags |= TREE_BAD;
}

static void on_text(struct xml_reader *r, const struct xml_event *event) {
    str text = r->text->bytes;
    uint32_t begin = event->begin, end = event->end;
    while (begin < end && xml_is_blank(text.ptr[begin]))
        begin++;
    while (end > begin && xml_is_blank(text.ptr[end - 1]))
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

// ---- namespaces

static str prefix_of(str name) {
    const char *colon = name.len ? memchr(name.ptr, ':', name.len) : NULL;
    return str_slice(name, 0, colon ? (size_t)(colon - name.ptr) : 0);
}

static void report_element_prefix(struct xml_reader *r, str name, span at) {
    struct diag_sink *sink = r->context->sink;
    str local = str_slice(name, prefix_of(name).len + 1, name.len);
    if (str_equal(local, STR("include")) || str_equal(local, STR("fallback"))) {
        diag_add(sink, DIAG_XML_FOREIGN, at, "XInclude has no meaning in a scene");
        diag_help(sink, "write <Include file=\"...\"/>");
        r->xinclude = SPAN_NONE;
        r->uses_xinclude = true;
        return;
    }
    diag_add(sink, DIAG_XML_NAMESPACE, at, "the elements of a scene have no prefix");
    diag_help(sink, "write <%.*s>", STR_ARG(reader_clip(local)));
}

// Whether the attribute says something about the file's form and not about the scene; reports what
// must not be there.
static bool is_foreign(struct xml_reader *r, str name, str value, struct xml_attribute place, bool is_root) {
    struct diag_sink *sink = r->context->sink;
    span at = xml_span(r, place.name_begin, place.name_end);
    str prefix = prefix_of(name);
    bool declares = str_equal(name, STR("xmlns")) || str_equal(prefix, STR("xmlns"));
    if (prefix.len == 0 && !declares)
        return false;
    bool schema = str_equal(name, STR("xmlns:xsi")) || str_equal(name, STR("xsi:schemaLocation")) ||
                  str_equal(name, STR("xsi:noNamespaceSchemaLocation"));
    if (schema && is_root) {
        str written = str_slice(r->text->bytes, place.name_begin, place.value_end + 1);
        str before = r->tree->xsi_attributes;
        r->tree->xsi_attributes = arena_format(r->context->arena, "%.*s%s%.*s", STR_ARG(before),
                                               before.len ? " " : "", STR_ARG(written));
    } else if (str_equal(prefix, STR("xml"))) {
        bool base = str_equal(name, STR("xml:base"));
        diag_add(sink, DIAG_XML_FOREIGN, at, "'%.*s' has no meaning in a scene", STR_ARG(reader_clip(name)));
        diag_help(sink, "%s",
                  base ? "remove it: paths are relative to the file that holds them" : "remove it");
    } else if (declares && str_equal(value, STR(XINCLUDE))) {
        r->xinclude = r->uses_xinclude ? SPAN_NONE : at;
    } else {
        diag_add(sink, DIAG_XML_NAMESPACE, at, "a scene has no namespaces: '%.*s'",
                 STR_ARG(reader_clip(name)));
        diag_help(sink, schema ? "the schema attributes stand on the root" : "remove it");
    }
    return true;
}

// ---- elements

static void read_attribute(struct xml_reader *r, struct xml_frame *frame, str name, str value,
                           struct xml_attribute place) {
    if (is_foreign(r, name, value, place, r->depth == 1))
        return;
    unsigned flags = 0;
    span at = xml_span(r, place.value_begin, place.value_end);
    if (reader_find_control(value) < value.len) {
        diag_add(r->context->sink, DIAG_CONTROL_CHARACTER, at,
                 "a reference in this text stands for a control character");
        diag_help(r->context->sink, "remove it");
        flags = TREE_BAD;
    }
    if (reader_text_is_bad(r->text, place.value_begin, place.value_end))
        flags = TREE_BAD;
    tree_index key =
        add_scalar(r, name, xml_span(r, place.name_begin, place.name_end), TREE_KEY_ATTRIBUTE, 0);
    tree_index scalar = add_scalar(r, value, at, TREE_KEY_NONE, flags);
    if (r->depth == 1)
        take_comments(r, key); // those before the root are its first attribute's
    link_pair(r, frame, key, scalar);
}

// Decoded values come from expat, in the order of the file; places from the tag itself.
static void read_attributes(struct xml_reader *r, const struct xml_event *event, uint32_t at) {
    struct xml_frame *frame = &r->frames[r->depth - 1];
    for (const char **a = event->attributes; a[0] && !r->stopped; a += 2) {
        struct xml_attribute place;
        if (xml_next_attribute(r->text->bytes, &at, &place) != XML_TAG_MORE)
            place = (struct xml_attribute){event->begin, event->begin, event->begin, event->begin};
        read_attribute(r, frame, str_from(a[0]), str_from(a[1]), place);
    }
}

static tree_index add_element(struct xml_reader *r, const struct xml_event *event) {
    return add(r, (struct tree_node){
                      .kind = TREE_MAP, .style = TREE_ELEMENT, .begin = event->begin, .end = event->end});
}

static void open_root(struct xml_reader *r, const struct xml_event *event, str name, span at) {
    str prefix = prefix_of(name);
    if (prefix.len)
        report_element_prefix(r, name, at);
    str local = prefix.len ? str_slice(name, prefix.len + 1, name.len) : name;
    r->tree->root_tag = arena_copy(r->context->arena, local);
    r->tree->root_name = at;
    r->tree->root = add_element(r, event);
    r->frames[r->depth++] = (struct xml_frame){.node = r->tree->root, .name = at};
}

static void open_child(struct xml_reader *r, const struct xml_event *event, str name, span at) {
    unsigned flags = 0;
    str prefix = prefix_of(name);
    str root_prefix = prefix_of(str_slice(r->text->bytes, r->tree->root_name.begin, r->tree->root_name.end));
    if (prefix.len && str_equal(prefix, root_prefix)) {
        name = str_slice(name, prefix.len + 1, name.len); // reported once, at the root
    } else if (prefix.len) {
        report_element_prefix(r, name, at);
        flags = TREE_BAD;
    }
    if (r->depth == 1)
        xml_take_mark(r);
    tree_index key = add_scalar(r, name, at, TREE_KEY_CHILD, flags);
    tree_index node = add_element(r, event);
    tree_node(r->tree, node)->flags |= (uint8_t)flags;
    take_comments(r, key);
    if (xml_take(r, key, node) != XML_TAKEN)
        link_pair(r, &r->frames[r->depth - 1], key, node);
    else
        r->frames[r->depth - 1].last_key = key;
    r->frames[r->depth++] = (struct xml_frame){.node = node, .key = key, .name = at};
    r->line_entry = key;
}

static void on_start(struct xml_reader *r, const struct xml_event *event) {
    end_run(r);
    if (r->depth == 1 && !xml_take_ready(r)) {
        stop(r);
        return;
    }
    str name = str_from(event->name);
    span at = xml_span(r, event->begin + 1, event->begin + 1 + (uint32_t)name.len);
    if (r->depth >= r->context->limits->value[LIMIT_SCENE_DEPTH]) {
        exceed(r, LIMIT_SCENE_DEPTH, at, "elements nested too deeply");
        return;
    }
    if (name.len > r->context->limits->value[LIMIT_SCALAR_BYTES])
        exceed(r, LIMIT_SCALAR_BYTES, xml_span(r, at.begin, at.begin + 1), "bytes in one name");
    else if (r->depth == 0)
        open_root(r, event, name, at);
    else
        open_child(r, event, name, at);
    if (r->stopped)
        return;
    r->tag_end = event->end;
    read_attributes(r, event, at.end);
    if (r->depth == 1)
        take_comments(r, r->tree->root); // a root without attributes
}

static void on_end(struct xml_reader *r, const struct xml_event *event) {
    end_run(r);
    struct xml_frame *frame = &r->frames[--r->depth];
    tree_node(r->tree, frame->node)->end = event->end;
    r->tag_end = event->end;
    r->line_entry = frame->key;
    if (r->depth == 1)
        xml_take_close(r, frame->key);
    if (r->depth == 0) {
        r->root_end = xml_span(r, event->end - 1, event->end);
        if (!xml_take_ready(r))
            stop(r);
        return;
    }
    // Comments before a closing tag have no entry behind them.
    if (r->pending.begin != r->pending.end)
        tree_add_trailing(r->tree, frame->last_key ? frame->last_key : frame->key, r->pending.begin,
                          r->pending.end);
    r->pending = (struct tree_comment){0};
}

static void on_comment(struct xml_reader *r, const struct xml_event *event) {
    end_run(r);
    str between = str_slice(r->text->bytes, r->tag_end, event->begin);
    if (memchr(between.ptr, '\n', between.len) || memchr(between.ptr, '\r', between.len))
        r->line_entry = 0;
    r->tag_end = event->end;
    tree_add_directive(r->tree, str_slice(r->text->bytes, event->begin, event->end), event->begin, event->end);
    if (r->line_entry)
        tree_add_trailing(r->tree, r->line_entry, event->begin, event->end);
    else if (r->pending.begin == r->pending.end)
        r->pending = (struct tree_comment){.begin = event->begin, .end = event->end};
    else
        r->pending.end = event->end;
}

static void on_instruction(struct xml_reader *r, const struct xml_event *event) {
    end_run(r);
    if (r->depth == 0 && str_equal_cstr(STR("xml-model"), event->name) && span_is_none(r->tree->schema_line))
        r->tree->schema_line = xml_span(r, event->begin, event->end);
}

static void on_doctype(struct xml_reader *r, const struct xml_event *event) {
    str text = r->text->bytes;
    uint32_t begin = event->begin;
    while (begin > r->text->begin && !str_starts_with(str_slice(text, begin, text.len), STR("<!DOCTYPE")))
        begin--;
    diag_add(r->context->sink, DIAG_XML_DOCTYPE, xml_span(r, begin, begin + 9), "a scene has no DOCTYPE");
    diag_help(r->context->sink, "remove it; what it declares is not read");
    stop(r);
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
    end_run(r);
    r->tree->broken = refused;
    for (uint32_t i = 0; i < r->depth; i++) {
        struct tree_node *open = tree_node(r->tree, r->frames[i].node);
        open->flags |= TREE_CUT;
        open->end = r->tag_end;
    }
    if (r->pending.begin != r->pending.end)
        r->tree->closing_comments = xml_span(r, r->pending.begin, r->pending.end);
    if (!span_is_none(r->xinclude)) {
        diag_add(r->context->sink, DIAG_XML_NAMESPACE, r->xinclude, "a scene has no namespaces");
        diag_help(r->context->sink, "remove it");
    }
}

// What needs no expat: encoding, UTF-8, and what can be repaired.
static bool prepare(const struct reader_context *context, uint32_t source, struct reader_text *text) {
    struct reader_range encoding = {0};
    str all = context->sources->items[source].text;
    bool foreign = xml_declared_encoding(all, &encoding);
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
        diag_add(context->sink, DIAG_EMPTY_FILE, (span){source, 0, 0}, "the file holds no scene");
        diag_help(context->sink, "a scene begins with <Scene glint=\"1\">");
        return false;
    }
    if (!context->taker)
        xml_repair(context, text);
    reader_text_seal(text);
    return !context->taker || context->sink->count == 0;
}

bool read_xml(const struct reader_context *context, uint32_t source, struct tree *tree) {
    tree_init(tree, context->arena, source, true);
    struct reader_text text;
    if (!prepare(context, source, &text))
        return false;
    struct xml_reader reader = {.context = context, .text = &text, .tree = tree};
    reader.frames =
        ARENA_ARRAY(context->arena, struct xml_frame, context->limits->value[LIMIT_SCENE_DEPTH] + 1);
    reader.parser = XML_ParserCreate("UTF-8");
    if (!reader.parser) {
        diag_add(context->sink, DIAG_OUT_OF_MEMORY, (span){source, 0, 0}, "no memory for reading the file");
        return false;
    }
    run_expat(&reader);
    XML_ParserFree(reader.parser);
    if (reader.fault)
        arena_raise(context->arena, reader.fault);
    bool read_again = context->taker && (tree->broken || context->sink->count);
    return tree->root != 0 && !read_again;
}
