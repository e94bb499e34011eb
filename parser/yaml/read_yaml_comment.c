#include "diag/codes/syntax.h"
#include "parser/yaml/yaml_reader.h"

#include <string.h>

static bool is_schema_line(str comment) {
    str body = str_trim(str_slice(comment, 1, comment.len));
    return str_starts_with(body, STR("yaml-language-server:"));
}

// Where libyaml also ends a comment: text after NEL, LS and PS is content.
static uint32_t line_end(str text, uint32_t at) {
    while (at < text.len && !str_yaml_break_length(text, at))
        at++;
    return at;
}

static void add_comment(struct yaml_reader *r, uint32_t begin, uint32_t end, bool trailing) {
    str comment = str_slice(r->text->bytes, begin, end);
    tree_add_directive(r->tree, comment, begin, end);
    struct reader_range color;
    bool in_brackets = r->depth && tree_node(r->tree, r->frames[r->depth - 1].node)->style == TREE_FLOW;
    if (in_brackets && r->lost_color.begin == r->lost_color.end && yaml_comment_color(r, begin, &color))
        r->lost_color = color;
    bool first_schema = span_is_none(r->tree->schema_line) && !r->seen_token && is_schema_line(comment);
    if (first_schema)
        r->tree->schema_line = yaml_span(r, begin, end);
    if (trailing) {
        // It belongs to the first entry that begins on the line.
        if (r->line_entry == YAML_LOST_ENTRY)
            r->taken.failed = true;
        else if (r->line_entry)
            tree_add_trailing(r->tree, r->line_entry, begin, end);
    } else if (r->pending.begin == r->pending.end) {
        if (!first_schema)
            r->pending = (struct tree_comment){.begin = begin, .end = end};
    } else {
        r->pending.end = end;
    }
}

void yaml_gap(struct yaml_reader *r, uint32_t end) {
    str text = r->text->bytes;
    uint32_t at = r->gap;
    // A block scalar ends on the line after it, and a missing value where the next token begins.
    uint32_t last = at;
    while (last > r->text->begin && char_is_blank(text.ptr[last - 1]))
        last--;
    bool same_line = r->seen_token && last > r->text->begin && !str_yaml_break_before(text, last);
    while (at < end) {
        char c = text.ptr[at];
        uint32_t stop = at + 1;
        bool directive =
            c == '%' && !r->seen_token && (at == r->text->begin || str_yaml_break_before(text, at));
        if (str_yaml_break_length(text, at)) {
            same_line = false;
            r->line_entry = 0;
        } else if (c == '#') {
            stop = line_end(text, at);
            add_comment(r, at, stop, same_line);
        } else if (directive) {
            stop = line_end(text, at);
        }
        at = stop;
    }
    if (end > r->gap)
        r->gap = end;
}

void yaml_begin_entry(struct yaml_reader *r, tree_index entry) {
    if (r->pending.begin != r->pending.end) {
        uint32_t added = tree_add_comment(r->tree, r->pending);
        tree_node(r->tree, entry)->comments = added;
        r->pending = (struct tree_comment){0};
    }
    if (!r->line_entry)
        r->line_entry = entry;
}

void yaml_begin_value(struct yaml_reader *r) {
    if (r->pending.begin == r->pending.end || r->depth == 0)
        return;
    tree_index key = r->frames[r->depth - 1].key;
    if (key && !tree_node(r->tree, key)->comments) {
        uint32_t added = tree_add_comment(r->tree, r->pending);
        tree_node(r->tree, key)->comments = added;
    }
    r->pending = (struct tree_comment){0};
}

void yaml_end_comments(struct yaml_reader *r) {
    yaml_gap(r, (uint32_t)r->text->bytes.len);
    if (r->pending.begin != r->pending.end)
        r->tree->closing_comments = yaml_span(r, r->pending.begin, r->pending.end);
    r->pending = (struct tree_comment){0};
}

bool yaml_comment_color(const struct yaml_reader *r, uint32_t at, struct reader_range *color) {
    str text = r->text->bytes;
    while (at < text.len && char_is_blank(text.ptr[at]))
        at++;
    if (at >= text.len || text.ptr[at] != '#')
        return false;
    uint32_t end = at + 1;
    while (end < text.len && char_hex(text.ptr[end]) >= 0)
        end++;
    uint32_t digits = end - at - 1;
    bool ends = end == text.len || char_is_space(text.ptr[end]) || str_yaml_break_length(text, end) ||
                memchr(",]}", text.ptr[end], 3) != NULL;
    *color = (struct reader_range){at, end};
    return ends && (digits == 6 || digits == 3);
}

void yaml_report_color(struct diag_sink *sink, str text, span at) {
    str color = str_slice(text, at.begin, at.end);
    char quoted[16] = "\"";
    memcpy(quoted + 1, color.ptr, color.len);
    quoted[color.len + 1] = '"';
    diag_add(sink, DIAG_YAML_UNQUOTED_COLOR, at, "YAML takes this colour for a comment: it needs quotes");
    diag_help(sink, "write \"%.*s\"", STR_ARG(color));
    diag_fix(sink, true, at, (str){quoted, color.len + 2});
}
