#include "parser/format/format_lines.h"
#include "parser/tree/reader_text.h"

void format_lines_init(struct format_lines *lines, struct arena *arena, uint32_t comment_gap) {
    *lines = (struct format_lines){.arena = arena, .comment_gap = comment_gap};
    strbuf_init(&lines->body);
}

void format_lines_finish(struct format_lines *lines) {
    strbuf_finish(&lines->body);
}

static struct format_line *last_line(struct format_lines *lines) {
    return &lines->lines.items[lines->lines.count - 1];
}

void format_lines_next(struct format_lines *lines, uint32_t blank, uint32_t indent) {
    for (uint32_t i = lines->begun ? 0 : blank; i <= blank; i++) {
        struct format_line *line = ARENA_PUSH(lines->arena, &lines->lines);
        line->begin = line->end = lines->body.len;
    }
    strbuf_repeat(&lines->body, ' ', indent);
    lines->column = indent;
    lines->begun = true;
}

void format_lines_text(struct format_lines *lines, str text) {
    strbuf_str(&lines->body, text);
    last_line(lines)->end = lines->body.len;
    lines->column += (uint32_t)utf8_count(text);
}

void format_lines_ended(struct format_lines *lines) {
    last_line(lines)->is_ended = true;
}

void format_lines_comment(struct format_lines *lines, str comment, uint32_t column) {
    struct format_line *line = last_line(lines);
    if (line->comment.len) {
        line->comment.len = (size_t)(comment.ptr + comment.len - line->comment.ptr);
        return;
    }
    line->comment = comment;
    line->column = column;
}

str format_take_line(str text, size_t *at) {
    size_t begin = *at, end = *at;
    while (end < text.len && !char_is_break(text.ptr[end]))
        end++;
    *at = end < text.len ? end + str_break_length(text, end) : end;
    return str_slice(text, begin, end);
}

// The next line without trailing spaces. *last: the comment ends here.
static str take_comment_line(str comment, size_t *at, bool *last) {
    str line = format_take_line(comment, at);
    *last = line.ptr + line.len == comment.ptr + comment.len;
    while (line.len > 0 && char_is_blank(line.ptr[line.len - 1]))
        line.len--;
    return line;
}

static bool begins_line(str text, uint32_t at, bool is_yaml) {
    return is_yaml ? str_yaml_break_before(text, at) : char_is_break(text.ptr[at - 1]);
}

uint32_t format_column(str text, struct format_place *last, uint32_t at) {
    uint32_t start = at;
    while (start > last->at && !begins_line(text, start, last->is_yaml))
        start--;
    const uint32_t before = start == last->at ? last->column : 0;
    last->column = before + (uint32_t)utf8_count(str_slice(text, start, at));
    last->at = at;
    return last->column;
}

// The column of a further line of a comment that began at `from` and now begins at `to`: moved as far as the
// comment, but never to where it would be the mark of a merge conflict. Lines that are indented by tabs stay.
static uint32_t moved_indent(str line, uint32_t from, uint32_t to, size_t *skip) {
    size_t blanks = 0;
    while (blanks < line.len && line.ptr[blanks] == ' ')
        blanks++;
    bool tab = blanks < line.len && line.ptr[blanks] == '\t';
    *skip = tab ? 0 : blanks;
    if (tab)
        return 0;
    int64_t moved = (int64_t)blanks + (int64_t)to - (int64_t)from;
    if (moved <= 0)
        return reader_begins_conflict(str_slice(line, blanks, line.len));
    return (uint32_t)moved;
}

void format_lines_moved(struct format_lines *lines, str comment, uint32_t column) {
    uint32_t to = lines->column;
    bool last = false;
    size_t at = 0;
    format_lines_text(lines, take_comment_line(comment, &at, &last));
    while (!last) {
        size_t skip = 0;
        str line = take_comment_line(comment, &at, &last);
        uint32_t indent = moved_indent(line, column, to, &skip);
        format_lines_next(lines, 0, line.len ? indent : 0);
        if (line.len)
            format_lines_text(lines, str_slice(line, skip, line.len));
    }
}

static uint32_t width(const struct format_lines *lines, const struct format_line *line) {
    return (uint32_t)utf8_count(str_slice(strbuf_view(&lines->body), line->begin, line->end));
}

// How many lines from `first` on have a comment after them that was in the same column, and its new column.
static uint32_t comment_run(const struct format_lines *lines, uint32_t first, uint32_t *column) {
    const struct format_line *all = lines->lines.items;
    uint32_t n = 0;
    *column = 0;
    for (uint32_t i = first;
         i < lines->lines.count && all[i].comment.len && all[i].column == all[first].column; i++, n++) {
        uint32_t need = width(lines, &all[i]) + lines->comment_gap;
        *column = need > *column ? need : *column;
    }
    return n;
}

static void write_comment(const struct format_line *line, uint32_t column, str line_end, struct strbuf *out) {
    bool last = false;
    size_t at = 0;
    strbuf_str(out, take_comment_line(line->comment, &at, &last));
    while (!last) {
        size_t skip = 0;
        str text = take_comment_line(line->comment, &at, &last);
        uint32_t indent = moved_indent(text, line->column, column, &skip);
        strbuf_str(out, line_end);
        strbuf_repeat(out, ' ', text.len ? indent : 0);
        strbuf_str(out, str_slice(text, skip, text.len));
    }
}

void format_lines_write(const struct format_lines *lines, str line_end, bool last_end, struct strbuf *out) {
    uint32_t run = 0, column = 0;
    for (uint32_t i = 0; i < lines->lines.count; i++) {
        const struct format_line *line = &lines->lines.items[i];
        strbuf_str(out, str_slice(strbuf_view(&lines->body), line->begin, line->end));
        if (run == 0 && line->comment.len)
            run = comment_run(lines, i, &column);
        if (line->comment.len) {
            strbuf_repeat(out, ' ', column - width(lines, line));
            write_comment(line, column, line_end, out);
            run--;
        }
        if (!line->is_ended && (last_end || i + 1 < lines->lines.count))
            strbuf_str(out, line_end);
    }
    out->failed = out->failed || lines->body.failed;
}
