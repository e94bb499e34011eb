#include "grammar/print/ir_print_comment.h"

#include "grammar/ir_print_text.h"
#include "grammar/ir_value.h"
#include "grammar/ir_walk.h"

#include <string.h>

span print_comments_of_row(const struct print_places *places, const struct ir_head *head, uint32_t row) {
    const struct ir_row_origin *found = places->origin ? ir_origin_row(places->origin, head, row) : NULL;
    return found ? places->origin->comments.items[found->comments] : SPAN_NONE;
}

span print_comments_of_element(const struct print_places *places, const struct ir_head *head) {
    bool known = places->origin && head->origin && head->origin < places->origin->elements.count;
    return known ? places->origin->comments.items[places->origin->elements.items[head->origin].comments]
                 : SPAN_NONE;
}

span print_comments_of_list_row(const struct print_places *places, const struct schema_element *schema,
                                uint32_t i, const void *element) {
    span comments = print_comments_of_row(places, ir_walk_head(element), i);
    struct ir_any_list list = ir_walk_list(&schema->rows[i], element);
    for (uint32_t k = 0; k < list.count && !span_is_none(comments); k++) {
        const void *item = ir_walk_item(&schema->rows[i], list, k);
        span of_item = print_comments_of_element(places, ir_walk_head(item));
        if (of_item.source == comments.source && of_item.begin == comments.begin)
            return SPAN_NONE;
    }
    return comments;
}

static bool body_has_comments(const struct print_places *places, const struct ir_scene *scene,
                              const struct schema_element *schema, const void *body) {
    return !span_is_none(print_comments_of_element(places, ir_walk_head(body))) ||
           print_has_comments(places, scene, schema, body);
}

bool print_row_has_comments(const struct print_places *places, const struct ir_scene *scene,
                            const struct schema_element *schema, uint32_t i, const void *element) {
    const struct schema_row *row = &schema->rows[i];
    if (!places->origin)
        return false;
    if (!span_is_none(print_comments_of_row(places, ir_walk_head(element), i)))
        return true;
    const void *field = schema_field_const(row, element);
    if (row->kind == SCHEMA_ELEMENT)
        return body_has_comments(places, scene, row->child, field);
    if (row->kind == SCHEMA_REFERENCE && ir_walk_is_inline(scene, row, field))
        return body_has_comments(places, scene, row->child, ir_walk_referent(scene, row, field));
    struct ir_any_list list = ir_walk_list(row, element);
    for (uint32_t k = 0; k < list.count; k++)
        if (body_has_comments(places, scene, row->child, ir_walk_item(row, list, k)))
            return true;
    return false;
}

bool print_has_comments(const struct print_places *places, const struct ir_scene *scene,
                        const struct schema_element *schema, const void *element) {
    for (uint32_t i = 0; i < schema->row_count && places->origin; i++)
        if (ir_walk_written(schema, i, element) && print_row_has_comments(places, scene, schema, i, element))
            return true;
    return false;
}

const struct ir_file_origin *print_file_of(const struct print_places *places, const struct ir_scene *scene) {
    if (!places->origin)
        return NULL;
    for (uint32_t i = 0; i < places->origin->files.count; i++)
        if (places->origin->files.items[i].scene == scene)
            return &places->origin->files.items[i];
    return places->origin->files.count ? &places->origin->files.items[0] : NULL;
}

// Takes text up to what either spelling treats as a line end: text after one would be content of a YAML
// scene.
static str next_line(str *rest) {
    size_t end = 0;
    while (end < rest->len && !str_yaml_break_length(*rest, end))
        end++;
    str line = str_slice(*rest, 0, end);
    *rest = str_slice(*rest, end < rest->len ? end + str_yaml_break_length(*rest, end) : end, rest->len);
    return line;
}

static str trim_end(str s) {
    while (s.len && strchr(" \t\r\n", s.ptr[s.len - 1]))
        s.len--;
    return s;
}

// Between two dashes there are `count` backslashes; one more or one less is written.
static void put_dashes(struct strbuf *out, str text, bool escape) {
    for (size_t i = 0; i < text.len; i++) {
        strbuf_char(out, text.ptr[i]);
        size_t run = 0;
        while (text.ptr[i] == '-' && i + 1 + run < text.len && text.ptr[i + 1 + run] == '\\')
            run++;
        if (text.ptr[i] != '-' || i + 1 + run >= text.len || text.ptr[i + 1 + run] != '-')
            continue;
        strbuf_repeat(out, '\\', escape ? run + 1 : run ? run - 1 : 0);
        i += run;
    }
}

static size_t indentation(str line) {
    size_t n = 0;
    while (n < line.len && (line.ptr[n] == ' ' || line.ptr[n] == '\t'))
        n++;
    return n;
}

// The neutral form is YAML's without indentation: lines that begin with '#', and empty ones between.
static void neutral_from_yaml(str text, struct strbuf *out) {
    while (text.len) {
        str line = str_trim(next_line(&text));
        if (str_starts_with(line, STR("# yaml-language-server:")))
            continue;
        if (line.len == 0 || line.ptr[0] == '#')
            strbuf_str(out, line);
        else
            continue;
        strbuf_char(out, '\n');
    }
}

static void neutral_from_xml_comment(str body, struct strbuf *out) {
    size_t common = SIZE_MAX;
    str rest = body;
    next_line(&rest);
    while (rest.len) {
        str line = next_line(&rest);
        if (str_trim(line).len && indentation(line) < common)
            common = indentation(line);
    }
    rest = trim_end(body);
    bool first = true;
    do {
        str line = trim_end(next_line(&rest));
        if (!first)
            line = str_slice(line, common, line.len);
        if (!(first && line.len == 0 && rest.len)) {
            strbuf_char(out, '#');
            if (line.len && !first)
                strbuf_char(out, ' ');
            put_dashes(out, line, false);
            strbuf_char(out, '\n');
        }
        first = false;
    } while (rest.len);
}

static void neutral_from_xml(str text, struct strbuf *out) {
    size_t at = 0;
    while (at < text.len) {
        str rest = str_slice(text, at, text.len);
        if (!str_starts_with(rest, STR("<!--"))) {
            // Two line ends in a row: an empty line between comments.
            size_t n = str_break_length(rest, 0);
            at += n;
            if (char_is_break(rest.ptr[0]) && out->len) {
                while (n < rest.len && char_is_blank(rest.ptr[n]))
                    n++;
                if (n < rest.len && char_is_break(rest.ptr[n]))
                    strbuf_char(out, '\n');
            }
            continue;
        }
        size_t end = 4;
        while (end < rest.len && !str_starts_with(str_slice(rest, end, rest.len), STR("-->")))
            end++;
        neutral_from_xml_comment(str_slice(rest, 4, end), out);
        at += end + 3;
    }
}

// Fills `lines` with the neutral form; false if there is nothing to write.
static bool neutral(struct print_places *places, span comments, struct strbuf *lines) {
    if (span_is_none(comments) || !places->sources || span_equal(comments, places->last))
        return false;
    places->last = comments;
    str text = source_text(places->sources, comments);
    if (ir_origin_is_xml(places->origin, comments.source))
        neutral_from_xml(text, lines);
    else
        neutral_from_yaml(text, lines);
    return lines->len > 0;
}

void print_yaml_comments(struct print_places *places, span comments, uint32_t indent, struct strbuf *out) {
    struct strbuf lines;
    strbuf_init(&lines);
    if (neutral(places, comments, &lines)) {
        str rest = strbuf_view(&lines);
        while (rest.len) {
            str line = next_line(&rest);
            if (line.len)
                strbuf_repeat(out, ' ', indent);
            strbuf_str(out, line);
            strbuf_char(out, '\n');
        }
    }
    out->failed = out->failed || lines.failed;
    strbuf_finish(&lines);
}

void print_xml_comments(struct print_places *places, span comments, uint32_t indent, struct strbuf *out) {
    struct strbuf lines;
    strbuf_init(&lines);
    if (neutral(places, comments, &lines)) {
        str rest = strbuf_view(&lines);
        while (rest.len) {
            str line = next_line(&rest);
            if (line.len) {
                str words = str_slice(line, 1, line.len);
                strbuf_repeat(out, ' ', indent);
                strbuf_cstr(out, "<!--");
                put_dashes(out, words, true);
                bool open = words.len == 0 || words.ptr[0] == ' ' || words.ptr[words.len - 1] == '-';
                strbuf_cstr(out, open ? " -->" : "-->");
            }
            strbuf_char(out, '\n');
        }
    }
    out->failed = out->failed || lines.failed;
    strbuf_finish(&lines);
}

// The text after `mark`, to the end of the line or to the quote before it.
static str behind(str line, str mark) {
    for (size_t i = 0; i + mark.len <= line.len; i++) {
        if (!str_starts_with(str_slice(line, i, line.len), mark))
            continue;
        str found = str_slice(line, i + mark.len, line.len);
        char quote = found.len ? found.ptr[0] : ' ';
        bool quoted = quote == '"' || quote == '\'';
        if (quoted)
            found = str_slice(found, 1, found.len);
        size_t end = 0;
        while (end < found.len && (quoted ? found.ptr[end] != quote : !strchr(" \t\r\n", found.ptr[end])))
            end++;
        return str_slice(found, 0, end);
    }
    return (str){"", 0};
}

// A comment has one line: a longer address would continue as content.
static bool is_one_line(str text) {
    for (size_t at = 0; at < text.len; at++)
        if (str_yaml_break_length(text, at))
            return false;
    return true;
}

// The two schemas are side by side: the address of one gives that of the other.
static void put_address(struct strbuf *out, str address, const char *from, const char *to) {
    if (str_ends_with_nocase(address, from)) {
        strbuf_str(out, str_slice(address, 0, address.len - strlen(from)));
        strbuf_cstr(out, to);
    } else {
        strbuf_str(out, address);
    }
}

void print_yaml_schema_line(const struct print_places *places, const struct ir_file_origin *file,
                            struct strbuf *out) {
    if (!file || !places->sources || span_is_none(file->schema_line))
        return;
    str line = str_trim(source_text(places->sources, file->schema_line));
    str address = file->is_xml ? behind(line, STR("href=")) : line;
    if (!is_one_line(address))
        return;
    if (!file->is_xml) {
        strbuf_str(out, line);
    } else {
        strbuf_cstr(out, "# yaml-language-server: $schema=");
        put_address(out, address, ".rng", ".schema.json");
    }
    strbuf_char(out, '\n');
}

void print_xml_schema_line(const struct print_places *places, const struct ir_file_origin *file,
                           struct strbuf *out) {
    if (!file || !places->sources || span_is_none(file->schema_line))
        return;
    str line = str_trim(source_text(places->sources, file->schema_line));
    if (file->is_xml) {
        strbuf_str(out, line);
    } else {
        struct strbuf address;
        strbuf_init(&address);
        put_address(&address, behind(line, STR("$schema=")), ".schema.json", ".rng");
        strbuf_cstr(out, "<?xml-model href=\"");
        print_xml_text(out, strbuf_view(&address));
        strbuf_cstr(out,
                    "\" type=\"application/xml\" schematypens=\"http://relaxng.org/ns/structure/1.0\"?>");
        out->failed = out->failed || address.failed;
        strbuf_finish(&address);
    }
    strbuf_char(out, '\n');
}
