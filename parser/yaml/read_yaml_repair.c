#include "diag/codes/syntax.h"
#include "parser/yaml/yaml_reader.h"

#include "core/heap.h"

#include <string.h>

// Finds an unquoted colour such as #ff8800 in text that libyaml has scanned without an event: the colour's
// '#' has turned the rest of its line into a comment.
static bool find_color(const struct yaml_reader *r, uint32_t begin, uint32_t end,
                       struct reader_range *color) {
    str text = r->text->bytes;
    for (uint32_t at = begin; at < end && at < text.len; at++) {
        bool starts = text.ptr[at] == '#' && at > 0 &&
                      (char_is_blank(text.ptr[at - 1]) || strchr("[,:{", text.ptr[at - 1]));
        if (starts && yaml_comment_color(r, at, color)) {
            bool six = color->end - color->begin == 7;
            if (six || (color->end < text.len && strchr(",]}", text.ptr[color->end])))
                return true;
        }
    }
    return false;
}

static bool repair_color(struct yaml_reader *r, struct diag_sink *sink, uint32_t problem) {
    struct reader_range color = r->lost_color;
    if (color.begin == color.end && !find_color(r, r->gap, problem, &color))
        return false;
    yaml_report_color(sink, r->text->bytes, yaml_span(r, color.begin, color.end));
    reader_text_put(r->context, r->text, color.begin, STR("x"));
    reader_text_mark(r->context, r->text, color.begin, color.end);
    return true;
}

// Puts a space in place of each tab before the first token of a line; counts the lines.
static uint32_t replace_tabs(struct yaml_reader *r) {
    uint32_t lines = 0;
    str text = r->text->bytes;
    for (uint32_t at = r->text->begin; at < text.len;) {
        bool found = false;
        for (; at < text.len && yaml_is_indent(r, at); at++) {
            if (text.ptr[at] != '\t')
                continue;
            found = true;
            reader_text_put(r->context, r->text, at, STR(" "));
            text = r->text->bytes;
        }
        lines += found;
        while (at < text.len && !char_is_break(text.ptr[at]))
            at++;
        at++;
    }
    return lines;
}

// Two spaces for each tab before the first token of a line, starting at `begin`, which is inside such white
// space; *end is after the last of these tabs.
static str with_spaces(struct yaml_reader *r, uint32_t begin, uint32_t *end) {
    str text = r->text->bytes;
    char *out = arena_alloc(r->context->arena, heap_times(2, text.len - begin) + 1);
    size_t length = 0, whole = 0;
    bool indent = true;
    for (uint32_t at = begin; at < text.len; at++) {
        char c = text.ptr[at];
        indent = char_is_break(c) || (indent && yaml_is_indent(r, at));
        out[length++] = indent && c == '\t' ? ' ' : c;
        if (!indent || c != '\t')
            continue;
        out[length++] = ' ';
        whole = length;
        *end = at + 1;
    }
    return (str){out, whole};
}

static bool repair_tabs(struct yaml_reader *r, struct diag_sink *sink, uint32_t problem) {
    str text = r->text->bytes;
    uint32_t at = problem;
    while (at < text.len && text.ptr[at] == ' ')
        at++;
    if (yaml_char(r, at) != '\t')
        return false;
    uint32_t end = at;
    while (end < text.len && text.ptr[end] == '\t')
        end++;
    diag_add(sink, DIAG_YAML_TAB, yaml_span(r, at, end), "a tab in the indentation");
    diag_help(sink, "indent with spaces");
    uint32_t last = end;
    str spaces = with_spaces(r, at, &last);
    diag_fix(sink, true, yaml_span(r, at, last), spaces);
    uint32_t lines = replace_tabs(r);
    if (lines > 1)
        diag_note(sink, SPAN_NONE, "%u lines of the file are indented with tabs", lines);
    return yaml_char(r, at) != '\t';
}

// A tag that is malformed or whose handle is not declared: overwritten with spaces, and the node after it is
// bad.
static bool repair_tag(struct yaml_reader *r, struct diag_sink *sink, uint32_t problem) {
    const yaml_parser_t *p = &r->parser;
    bool in_tag = p->context && (strstr(p->context, "scanning a tag") || strstr(p->context, "parsing a tag"));
    uint32_t begin = in_tag && !strstr(p->context, "directive") ? yaml_byte(r, p->context_mark) : problem;
    if (yaml_char(r, begin) != '!')
        return false;
    uint32_t end = begin;
    for (; end < r->text->bytes.len && !char_is_space(yaml_char(r, end)); end++)
        reader_text_put(r->context, r->text, end, STR(" "));
    str written = source_text(r->context->sources, yaml_span(r, begin, end));
    diag_add(sink, DIAG_YAML_TAG, yaml_span(r, begin, end), "the tag '%.*s' has no meaning in a scene",
             STR_ARG(reader_clip(written)));
    diag_help(sink, "remove it; text that begins with '!' needs quotes");
    while (end < r->text->bytes.len && !char_is_break(yaml_char(r, end)))
        end++;
    reader_text_mark(r->context, r->text, begin, end);
    return true;
}

bool yaml_repair(struct yaml_reader *r, struct diag_sink *sink, bool *tabs_repaired) {
    const yaml_parser_t *p = &r->parser;
    bool refused = p->error == YAML_SCANNER_ERROR || p->error == YAML_PARSER_ERROR;
    uint32_t problem = refused ? yaml_byte(r, p->problem_mark) : r->gap;
    if (repair_color(r, sink, problem))
        return true;
    if (refused && repair_tag(r, sink, problem))
        return true;
    bool tab = refused && p->problem &&
               (strstr(p->problem, "cannot start any token") || strstr(p->problem, "found a tab"));
    if (!tab || *tabs_repaired)
        return false;
    *tabs_repaired = repair_tabs(r, sink, problem);
    return *tabs_repaired;
}
