// What the files of the formatter share. Private to parser/format*.c. Thread safety: one thread.
#ifndef GLINT_PARSER_FORMAT_FORMAT_INTERNAL_H
#define GLINT_PARSER_FORMAT_FORMAT_INTERNAL_H

#include "parser/format/format_lines.h"
#include "parser/tree/tree.h"

enum {
    FORMAT_INDENT = 2,
    FORMAT_WIDTH = 110,   // of a line of XML, for tags and elements that can be broken
    FORMAT_BLANK_MOST = 2 // empty lines one after the other
};

// format_yaml.c, format_xml.c: the lines of the text after `begin` (a byte order mark). false: the text has a
// form that the reader must report, or that cannot be laid out.
bool format_yaml(struct arena *arena, str text, uint32_t begin, struct format_lines *lines);
bool format_xml(struct arena *arena, str text, uint32_t begin, struct format_lines *lines);

// format_compare.c: whether two trees have the same contents, with comments at the same entries.
bool format_same(const struct tree *a, str a_text, const struct tree *b, str b_text);

#endif
