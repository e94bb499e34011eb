// Links the contents of the file into the tree, whichever reader found them: read_xml.c with expat, or
// read_xml_plain.c.
#include "diag/codes/syntax.h"
#include "parser/xml/xml_reader.h"

#include "core/number.h"
#include "parser/tree/mend.h"

#include <string.h>

#define XINCLUDE "http://www.w3.org/2001/XInclude"

static void exceed(struct xml_reader *r, enum limit which, span at, const char *what) {
    reader_limit(r->context->sink, r->context->limits, which, at, what);
    xml_stop(r);
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

// Links a key and its value after the element's present contents.
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

// <Radius>1</Radius>: what authors of other XML would write for an attribute.
static void help_text(struct xml_reader *r, str text) {
    const struct xml_frame *frame = r->depth > 1 ? &r->frames[r->depth - 1] : NULL;
    struct diag_sink *sink = r->context->sink;
    double number;
    bool one = number_parse(text, &number) == NUMBER_OK || mend_boolean(text).len || text.ptr[0] == '#';
    if (str_equal(text, STR(">")) || str_equal(text, STR("/>"))) {
        diag_help(sink, "remove it: the tag before it has already ended");
    } else if (frame && tree_node(r->tree, frame->node)->count == 0 && one) {
        str element = source_text(r->context->sources, frame[-1].name);
        str attribute = mend_snake(r->context->arena, source_text(r->context->sources, frame->name));
        diag_help(sink, "a value belongs in an attribute, as in <%.*s %.*s=\"%.*s\">",
                  STR_ARG(reader_clip(element)), STR_ARG(reader_clip(attribute)), STR_ARG(reader_clip(text)));
    } else if (frame && mend_is_numbers(text)) {
        str element = source_text(r->context->sources, frame->name);
        diag_help(sink, "values belong in attributes, as in <%.*s x=\"1\" y=\"2\" z=\"3\"/>",
                  STR_ARG(reader_clip(element)));
    } else {
        diag_help(sink, "values belong in attributes, comments in <!-- ... -->");
    }
}

void xml_end_text(struct xml_reader *r) {
    if (r->run.begin == r->run.end)
        return;
    span at = xml_span(r, r->run.begin, r->run.end);
    diag_add(r->context->sink, DIAG_XML_TEXT, at, "text between elements");
    help_text(r, source_text(r->context->sources, at));
    r->run = (struct reader_range){0};
    // The element's missing parts were probably written as text.
    if (r->depth > 0)
        tree_node(r->tree, r->frames[r->depth - 1].node)->flags |= TREE_BAD;
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
    diag_add(sink, DIAG_XML_NAMESPACE, at, "the elements of a scene must not have a prefix");
    diag_help(sink, "write <%.*s>", STR_ARG(reader_clip(local)));
}

// Whether the attribute concerns the file's form instead of the scene; reports those that must not be there.
static bool is_foreign(struct xml_reader *r, str name, str value, struct xml_attribute place, bool is_root) {
    bool plain = name.ptr[0] != 'x' && !memchr(name.ptr, ':', name.len);
    if (plain)
        return false;
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
                  base ? "remove it: paths are relative to the file that contains them" : "remove it");
    } else if (declares && str_equal(value, STR(XINCLUDE))) {
        r->xinclude = r->uses_xinclude ? SPAN_NONE : at;
    } else {
        diag_add(sink, DIAG_XML_NAMESPACE, at, "a scene must not use namespaces: '%.*s'",
                 STR_ARG(reader_clip(name)));
        diag_help(sink, schema ? "the schema attributes belong on the root element" : "remove it");
    }
    return true;
}

// ---- elements

void xml_add_attribute(struct xml_reader *r, str name, str value, struct xml_attribute place) {
    struct xml_frame *frame = &r->frames[r->depth - 1];
    if (is_foreign(r, name, value, place, r->depth == 1))
        return;
    unsigned flags = 0;
    span at = xml_span(r, place.value_begin, place.value_end);
    // Literal text was checked before; a reference makes the text shorter.
    bool decoded = place.value_end - place.value_begin != value.len;
    if (decoded && reader_find_control(value) < value.len) {
        diag_add(r->context->sink, DIAG_CONTROL_CHARACTER, at,
                 "a reference in this text is a control character");
        diag_help(r->context->sink, "remove it");
        flags = TREE_BAD;
    }
    if (reader_text_is_bad(r->text, place.value_begin, place.value_end))
        flags = TREE_BAD;
    tree_index key =
        add_scalar(r, name, xml_span(r, place.name_begin, place.name_end), TREE_KEY_ATTRIBUTE, 0);
    tree_index scalar = add_scalar(r, value, at, TREE_KEY_NONE, flags);
    if (r->depth == 1)
        take_comments(r, key); // those before the root belong to its first attribute
    link_pair(r, frame, key, scalar);
}

static tree_index add_element(struct xml_reader *r, struct reader_range tag) {
    return add(
        r, (struct tree_node){.kind = TREE_MAP, .style = TREE_ELEMENT, .begin = tag.begin, .end = tag.end});
}

static void open_root(struct xml_reader *r, struct reader_range tag, str name, span at) {
    str prefix = prefix_of(name);
    if (prefix.len)
        report_element_prefix(r, name, at);
    str local = prefix.len ? str_slice(name, prefix.len + 1, name.len) : name;
    r->tree->root_tag = arena_copy(r->context->arena, local);
    r->tree->root_name = at;
    r->tree->root = add_element(r, tag);
    r->frames[r->depth++] = (struct xml_frame){.node = r->tree->root, .name = at};
}

static void open_child(struct xml_reader *r, struct reader_range tag, str name, span at) {
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
    tree_index node = add_element(r, tag);
    tree_node(r->tree, node)->flags |= (uint8_t)flags;
    take_comments(r, key);
    if (xml_take(r, key, node) != XML_TAKEN)
        link_pair(r, &r->frames[r->depth - 1], key, node);
    else
        r->frames[r->depth - 1].last_key = key;
    r->frames[r->depth++] = (struct xml_frame){.node = node, .key = key, .name = at};
    r->line_entry = key;
}

bool xml_open(struct xml_reader *r, struct reader_range tag, str name) {
    xml_end_text(r);
    if (r->depth == 1 && !xml_take_ready(r)) {
        xml_stop(r);
        return false;
    }
    span at = xml_span(r, tag.begin + 1, tag.begin + 1 + (uint32_t)name.len);
    if (r->depth >= r->context->limits->value[LIMIT_SCENE_DEPTH]) {
        exceed(r, LIMIT_SCENE_DEPTH, at, "elements nested too deeply");
        return false;
    }
    if (name.len > r->context->limits->value[LIMIT_SCALAR_BYTES])
        exceed(r, LIMIT_SCALAR_BYTES, xml_span(r, at.begin, at.begin + 1), "bytes in one name");
    else if (r->depth == 0)
        open_root(r, tag, name, at);
    else
        open_child(r, tag, name, at);
    r->tag_end = tag.end;
    return !r->stopped;
}

void xml_opened(struct xml_reader *r) {
    if (r->depth == 1)
        take_comments(r, r->tree->root); // a root without attributes
}

void xml_close(struct xml_reader *r, uint32_t end) {
    xml_end_text(r);
    struct xml_frame *frame = &r->frames[--r->depth];
    tree_node(r->tree, frame->node)->end = end;
    r->tag_end = end;
    r->line_entry = frame->key;
    if (r->depth == 1)
        xml_take_close(r, frame->key);
    if (r->depth == 0) {
        r->root_end = xml_span(r, end - 1, end);
        if (!xml_take_ready(r))
            xml_stop(r);
        return;
    }
    // Comments before a closing tag have no entry after them.
    if (r->pending.begin != r->pending.end)
        tree_add_trailing(r->tree, frame->last_key ? frame->last_key : frame->key, r->pending.begin,
                          r->pending.end);
    r->pending = (struct tree_comment){0};
}

void xml_see_comment(struct xml_reader *r, uint32_t begin, uint32_t end) {
    xml_end_text(r);
    str between = str_slice(r->text->bytes, r->tag_end, begin);
    if (memchr(between.ptr, '\n', between.len) || memchr(between.ptr, '\r', between.len))
        r->line_entry = 0;
    r->tag_end = end;
    tree_add_directive(r->tree, str_slice(r->text->bytes, begin, end), begin, end);
    if (r->line_entry)
        tree_add_trailing(r->tree, r->line_entry, begin, end);
    else if (r->pending.begin == r->pending.end)
        r->pending = (struct tree_comment){.begin = begin, .end = end};
    else
        r->pending.end = end;
}

void xml_see_instruction(struct xml_reader *r, str target, uint32_t begin, uint32_t end) {
    xml_end_text(r);
    if (r->depth == 0 && str_equal(target, STR("xml-model")) && span_is_none(r->tree->schema_line))
        r->tree->schema_line = xml_span(r, begin, end);
}
