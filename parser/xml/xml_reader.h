// What the files of the XML reader share.
//
// read_xml_repair.c repairs beforehand what would otherwise end the file ('/ >', attributes given twice,
// unknown entities). read_xml.c runs expat, with the places of attributes from xml_scan.h, read_xml_plain.c
// reads what does not need expat, read_xml_build.c builds the tree for both, read_xml_take.c hands children
// of the root over before the file is read to its end, read_xml_error.c puts expat's errors in words.
// Ownership: the arena of the reader_context. Nothing ever jumps through expat's frames. Thread safety: one
// reader belongs to one thread.
#ifndef GLINT_PARSER_XML_XML_READER_H
#define GLINT_PARSER_XML_XML_READER_H

#include "parser/tree/reader_text.h"
#include "parser/tree/xml_scan.h"

#include <expat.h>

// An element that is being read.
struct xml_frame {
    tree_index node;
    tree_index key; // 0 for the root
    tree_index last_key;
    tree_index last; // the value linked last
    span name;       // in the opening tag
};

enum {
    XML_FIRST_MAX = 32
};

// Whether a child of the root is taken, and whether it is linked anyway.
enum xml_taking {
    XML_NOT_TAKEN,
    XML_TAKEN_FIRST,
    XML_TAKEN,
};

struct xml_reader {
    const struct reader_context *context;
    struct reader_text *text;
    struct tree *tree;
    XML_Parser parser;
    struct xml_frame *frames;
    uint32_t depth;
    bool stopped;           // a limit, a DOCTYPE or lack of memory ended the reading
    enum arena_fault fault; // set in a callback, passed on outside expat

    struct reader_range run; // of text between elements; equal: none
    bool in_cdata;
    uint32_t cdata_begin;
    struct tree_comment pending; // comments that wait for the element that they precede
    tree_index line_entry;       // the element whose tag ended last, on this line
    uint32_t tag_end;            // where the last tag or comment ended
    span xinclude;               // the declaration of XInclude's prefix, until an element uses it
    bool uses_xinclude;          // an element used it, which was reported
    span root_end;               // the tag that closed the root

    struct {
        tree_index open;                                // the key of a child that is being read
        tree_index entry;                               // the key of one that waits for the next
        uint64_t nodes;                                 // already handed over
        uint32_t nodes_mark, texts_mark, comments_mark; // before the child
        tree_index first[XML_FIRST_MAX];                // of each name
        uint32_t first_count;
    } taken;
};

// ---- read_xml_repair.c
// Reports and repairs, in the whole text.
void xml_repair(const struct reader_context *context, struct reader_text *text);

// ---- read_xml_build.c
// An opening tag, from '<' to after '>'; its attributes follow, then xml_opened. false: the reader stopped.
bool xml_open(struct xml_reader *reader, struct reader_range tag, str name);
void xml_add_attribute(struct xml_reader *reader, str name, str value, struct xml_attribute place);
void xml_opened(struct xml_reader *reader);
// A closing tag, or the end of an empty element.
void xml_close(struct xml_reader *reader, uint32_t end);
void xml_see_comment(struct xml_reader *reader, uint32_t begin, uint32_t end);
void xml_see_instruction(struct xml_reader *reader, str target, uint32_t begin, uint32_t end);
// Reports the text between elements that has just ended.
void xml_end_text(struct xml_reader *reader);

// ---- read_xml_plain.c
// Reads XML that needs neither decoding nor repairs. false: read it with expat.
bool xml_read_plain(struct xml_reader *reader);

// ---- read_xml_take.c
// Everything read from here on is dropped once the next child has been taken.
void xml_take_mark(struct xml_reader *reader);
// A child of the root begins, or the root ends: hands over the child that waits. false: read the file whole.
bool xml_take_ready(struct xml_reader *reader);
// Whether the child that begins is taken.
enum xml_taking xml_take(struct xml_reader *reader, tree_index key, tree_index value);
// A child of the root was closed.
void xml_take_close(struct xml_reader *reader, tree_index key);

// ---- read_xml_error.c
void xml_report(struct xml_reader *reader);

// Ends the reading, here and in expat.
static inline void xml_stop(struct xml_reader *reader) {
    if (!reader->stopped && reader->parser)
        XML_StopParser(reader->parser, XML_FALSE);
    reader->stopped = true;
}
static inline span xml_span(const struct xml_reader *reader, uint32_t begin, uint32_t end) {
    return (span){reader->text->source, begin, end};
}
static inline bool xml_has_prefix(str name, const char *prefix) {
    str p = str_from(prefix);
    return str_starts_with(name, p);
}

#endif
