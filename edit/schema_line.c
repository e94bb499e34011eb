#include "edit/schema_line.h"

#include "grammar/ir_print_text.h"

#include <string.h>

static void write_line(struct strbuf *out, bool is_xml, str address) {
    if (!is_xml) {
        strbuf_format(out, "# yaml-language-server: $schema=%.*s", STR_ARG(address));
        return;
    }
    bool compact = str_ends_with_nocase(address, ".rnc");
    strbuf_cstr(out, "<?xml-model href=\"");
    print_xml_text(out, address);
    // (Associating Schemas with XML documents 1.0, W3C and ISO/IEC 19757-11.)
    if (compact)
        strbuf_cstr(out, "\" type=\"application/relax-ng-compact-syntax\"?>");
    else
        strbuf_cstr(out,
                    "\" type=\"application/xml\" schematypens=\"http://relaxng.org/ns/structure/1.0\"?>");
}

// The place of a first line: after a byte order mark, and after XML's declaration with its line end.
static size_t first_place(str text, bool is_xml) {
    size_t at = str_skip_mark(text);
    if (!is_xml || text.len < at + 6 || memcmp(text.ptr + at, "<?xml", 5) != 0 || text.ptr[at + 5] == '-')
        return at;
    while (at < text.len && text.ptr[at] != '>')
        at++;
    at += at < text.len;
    if (at < text.len && text.ptr[at] == '\r')
        at++;
    return at < text.len && text.ptr[at] == '\n' ? at + 1 : at;
}

bool schema_line_put(struct session *session, str address, struct strbuf *out) {
    const struct ir_file_origin *file = &session->origin.files.items[0];
    str text = session->sources.items[file->source].text;
    struct strbuf line;
    strbuf_init(&line);
    write_line(&line, file->is_xml, address);
    bool there = !span_is_none(file->schema_line);
    str old = there ? source_text(&session->sources, file->schema_line) : STR("");
    bool same = there && str_equal(str_trim(old), strbuf_view(&line));
    if (!same) {
        size_t begin = there ? file->schema_line.begin : first_place(text, file->is_xml);
        size_t end = there ? file->schema_line.begin + str_trim(old).len : begin;
        bool glued = !there && begin > 0 && text.ptr[begin - 1] == '>'; // a declaration without a line end
        strbuf_str(out, str_slice(text, 0, begin));
        strbuf_str(out, glued ? str_line_end(text) : STR(""));
        strbuf_str(out, strbuf_view(&line));
        strbuf_str(out, there || glued ? STR("") : str_line_end(text));
        strbuf_str(out, str_slice(text, end, text.len));
    }
    out->failed |= line.failed;
    strbuf_finish(&line);
    return !same;
}
