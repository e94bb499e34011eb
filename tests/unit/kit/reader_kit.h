// What the tests of the readers share: a text is read, and tree and diagnostics become short texts.
//
// Ownership: the kit owns all; reader_kit_finish frees it. Thread safety: one test at a time.
#ifndef GLINT_TESTS_UNIT_READER_KIT_H
#define GLINT_TESTS_UNIT_READER_KIT_H

#include "core/strbuf.h"
#include "diag/diag.h"
#include "parser/tree/reader.h"

struct reader_kit {
    struct arena arena;
    struct source_set sources;
    struct diag_sink sink;
    struct limits limits;
    struct tree tree;
    uint32_t source;
    bool readable;          // what the reader returned
    enum arena_fault fault; // that ended the reading
    char *text;             // a copy of exactly the text's size
    struct strbuf out;
};

// `begin` is 0, or the offset of a --set value with `is_value`.
struct reader_kit_options {
    bool is_xml, is_value;
    uint32_t begin;
    size_t memory_bytes;         // 0: plenty
    const struct limits *limits; // NULL: the standard ones
};

void reader_kit_read(struct reader_kit *kit, str text, struct reader_kit_options options);
void reader_kit_finish(struct reader_kit *kit);

// The tree in one line: {key: value, ...}, [a, b], "quoted", ~ for null; a '!' behind what is bad, a '?'
// behind what was cut, a '+' behind a merged key. Valid until the next call.
const char *reader_kit_dump(struct reader_kit *kit);
// The diagnostics in order of place: "E109 2:1-2:4, E101 3:1-3:1"; each note follows as "(1:1-1:2)", a fix as
// "=safe>text<" or "=maybe>text<". Valid until the next call.
const char *reader_kit_errors(struct reader_kit *kit);
// "2:1-2:4" for a place, "-" for SPAN_NONE. Valid until the next call.
const char *reader_kit_place(struct reader_kit *kit, span at);
// The node at a path of keys and indices, "a/0/b"; with a '@' at the end the key itself. 0: none.
tree_index reader_kit_at(const struct reader_kit *kit, const char *path);
// The text of the place of a node, of its comments (leading, else trailing) and of its trailing comment.
const char *reader_kit_source(struct reader_kit *kit, span at);

#endif
