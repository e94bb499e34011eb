// Walking over the tags of XML as they are written: the place of each attribute, which expat does not report.
//
// All places are bytes of the text. Thread safety: pure functions.
#ifndef GLINT_PARSER_TREE_XML_SCAN_H
#define GLINT_PARSER_TREE_XML_SCAN_H

#include "core/str.h"

struct xml_attribute {
    uint32_t name_begin, name_end;
    uint32_t value_begin, value_end; // inside the quotes
};

enum xml_tag_end {
    XML_TAG_MORE,      // an attribute was found
    XML_TAG_OPEN,      // '>'
    XML_TAG_EMPTY,     // '/>'
    XML_TAG_SPLIT,     // '/', spaces, '>'
    XML_TAG_MALFORMED, // something that expat will refuse
};

// The name after '<', or after the '/' of an end tag, at `at`; returns its end, `at` + 1 if there is none.
uint32_t xml_name_end(str text, uint32_t at);
// The next attribute from *at on, which moves past it, or how the tag ends (*at is at its '/' or '>').
enum xml_tag_end xml_next_attribute(str text, uint32_t *at, struct xml_attribute *attribute);
// After the first `what` from `at` on; 0: there is none.
uint32_t xml_behind(str text, uint32_t at, const char *what);
// Where the name begins in the end tag of an element that reaches from `begin` to before `end`; 0: it has
// none.
uint32_t xml_end_name(str text, uint32_t begin, uint32_t end);

uint32_t xml_skip_blanks(str text, uint32_t at);

#endif
