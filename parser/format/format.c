#include "parser/format/format.h"

#include "parser/format/format_internal.h"

// Whether the last line has an end, after which there may be LS and PS: by themselves they are text.
static bool ends_line(str text) {
    size_t end = text.len;
    while (end > 0) {
        const bool separator = end > 2 && str_yaml_break_length(text, end - 3) == 3;
        if (!separator && !char_is_blank(text.ptr[end - 1]))
            break;
        end -= separator ? 3 : 1;
    }
    const bool ends_with_nel = end > 1 && text.ptr[end - 1] == '\x85' && text.ptr[end - 2] == '\xC2';
    return ends_with_nel || (end > 0 && char_is_break(text.ptr[end - 1]));
}

struct layout {
    str text;
    uint32_t begin; // after a byte order mark
    bool is_xml, found;
    struct format_lines lines;
};

static void find_lines(void *context) {
    struct layout *l = context;
    l->found = (l->is_xml ? format_xml : format_yaml)(l->lines.arena, l->text, l->begin, &l->lines);
}

static bool lay_out(struct arena *arena, str text, bool is_xml, struct strbuf *out) {
    struct layout layout = {.text = text, .is_xml = is_xml};
    layout.begin = (uint32_t)str_skip_mark(text);
    format_lines_init(&layout.lines, arena, is_xml ? 1 : 2);
    enum arena_fault fault = arena_guarded(arena, find_lines, &layout);
    if (layout.found) {
        strbuf_str(out, str_slice(text, 0, layout.begin));
        format_lines_write(&layout.lines, str_line_end(text), ends_line(text) && !layout.lines.is_open, out);
    }
    format_lines_finish(&layout.lines);
    if (fault)
        arena_raise(arena, fault);
    return layout.found && !out->failed;
}

static bool read_tree(const struct reader_context *context, uint32_t source, bool is_xml, struct tree *tree) {
    *tree = (struct tree){.source = source};
    return (is_xml ? read_xml : read_yaml)(context, source, tree);
}

struct second_reading {
    struct reader_context context;
    const struct tree *tree;
    str text, written;
    bool same;
};

static void read_again(void *context) {
    struct second_reading *r = context;
    struct tree again;
    uint32_t source = source_add(r->context.sources, SOURCE_KIND_OVERLAY, STR(""), r->written);
    r->same = read_tree(&r->context, source, r->tree->is_xml, &again) &&
              format_same(r->tree, r->text, &again, r->written);
}

// Reads the output again, and compares.
static bool is_safe(const struct reader_context *context, const struct tree *tree, str text, str written) {
    struct source_set sources;
    struct diag_sink sink;
    struct second_reading reading = {.context = *context, .tree = tree, .text = text, .written = written};
    source_set_init(&sources, context->arena);
    diag_sink_init(&sink);
    reading.context.sources = &sources;
    reading.context.sink = &sink;
    enum arena_fault fault = arena_guarded(context->arena, read_again, &reading);
    diag_sink_finish(&sink);
    if (fault)
        arena_raise(context->arena, fault);
    return reading.same;
}

enum format_status format_source(const struct reader_context *context, uint32_t source,
                                 const struct upgrade_table *upgrade, struct strbuf *out) {
    struct source *from = &context->sources->items[source];
    str text = from->text;
    struct tree tree;
    size_t before = out->len;
    bool is_xml = reader_is_xml(from->path, text);
    bool readable = read_tree(context, source, is_xml, &tree);
    if (!readable || tree.broken || tree.overwritten)
        return FORMAT_REFUSED;
    if (upgrade && upgrade_text(context, upgrade, &tree, text, &text)) {
        uint32_t raised = source_add(context->sources, SOURCE_KIND_OVERLAY, from->path, text);
        if (!read_tree(context, raised, is_xml, &tree) || tree.broken)
            return FORMAT_UNSAFE;
    }
    uint32_t errors = context->sink->errors;
    if (!lay_out(context->arena, text, is_xml, out))
        return errors ? FORMAT_REFUSED : FORMAT_UNSAFE;
    if (is_safe(context, &tree, text, str_slice(strbuf_view(out), before, out->len)))
        return FORMAT_DONE;
    out->len = before;
    return errors ? FORMAT_REFUSED : FORMAT_UNSAFE; // repaired text cannot always be laid out
}
