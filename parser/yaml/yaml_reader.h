// What the files of the YAML reader share: its state, one libyaml parser at a time.
//
// read_yaml.c runs libyaml's events, read_yaml_build.c links nodes into the tree, read_yaml_take.c hands
// entries of the root's lists over before the file is read to its end, read_yaml_alias.c finds the nodes that
// aliases stand for, read_yaml_copy.c copies them, read_yaml_keys.c merges maps and finds keys given twice,
// read_yaml_comment.c finds comments between tokens, read_yaml_repair.c repairs text that glint understands
// better than libyaml, read_yaml_error.c puts libyaml's errors in words. They call read_yaml_place.c, which
// knows where the reader is, and none calls read_yaml.c. All places are bytes of the source. Ownership: the
// arena of the reader_context; libyaml's own memory is freed before any jump leaves. Thread safety: one
// reader belongs to one thread.
#ifndef GLINT_PARSER_YAML_YAML_READER_H
#define GLINT_PARSER_YAML_YAML_READER_H

#include "core/str_map.h"
#include "parser/tree/reader_text.h"

#include <yaml.h>

enum {
    YAML_NO_ANCHOR = 0
};
#define YAML_LOST_ENTRY UINT32_MAX

// A list or map that is being read.
struct yaml_frame {
    tree_index node;
    tree_index last; // the child linked last
    tree_index key;  // map: the key that waits for its value
    uint32_t anchor; // the anchor of this collection; YAML_NO_ANCHOR: none
    bool is_key;     // the collection is where a key belongs
    bool merges;     // the waiting key is '<<'
    bool has_merged; // pairs that came by '<<' are among the children
};

struct yaml_anchor {
    str name;
    span at;
    tree_index node;
    bool open; // the node is being read
};

struct yaml_reader {
    const struct reader_context *context;
    struct reader_text *text;
    struct tree *tree;
    struct diag_sink sink; // of this attempt
    bool is_option;        // the value of a --set option: flow text only
    bool stopped;          // a limit or a second document ended the reading
    uint32_t documents;
    uint32_t document_end; // after the first one; 0 while it is read

    yaml_parser_t parser;
    yaml_event_t event;

    // libyaml counts characters; this is one place in both measures.
    bool ascii;
    uint32_t place_characters, place_bytes;

    struct yaml_frame *frames; // one more than the limit allows
    uint32_t depth;

    struct {
        struct yaml_anchor *items;
        uint32_t count, capacity;
    } anchors;                   // [0] is none
    struct str_map anchor_names; // the last anchor of each name
    struct str_map keys, joined_keys;
    uint64_t alias_nodes;

    // Comments are searched for between tokens.
    uint32_t gap; // text before this has been searched
    tree_index
        line_entry; // the first entry that begins on the line of the last token; YAML_LOST_ENTRY: taken
    struct tree_comment pending; // comments that wait for the entry that they precede
    bool seen_token;
    struct reader_range lost_color; // a colour that became a comment inside open brackets; equal: none
    tree_index last_scalar;
    tree_index closed; // the block collection that ended last, with no token since; 0: none
    struct {
        bool on;
        bool failed;          // the file must be read whole
        tree_index list_key;  // of the list or map whose entries are taken; 0: none is open
        tree_index entry;     // one that waits for the token after it
        tree_index entry_key; // of its list
        uint64_t nodes;       // already handed over
        uint32_t nodes_mark, texts_mark, comments_mark, anchors_mark; // before the entry
        struct str_map keys;                                          // of the map
    } taken;
    uint32_t blamed; // 1 + the place of a mistake that makes libyaml refuse the rest of the line; 0: none
};

// ---- read_yaml_place.c
// The span of `begin` to `end` in the reader's source.
span yaml_span(const struct yaml_reader *reader, uint32_t begin, uint32_t end);
// Byte offset of a mark.
uint32_t yaml_byte(struct yaml_reader *reader, yaml_mark_t mark);

// NUL after the text.
static inline char yaml_char(const struct yaml_reader *reader, uint32_t at) {
    return at < reader->text->bytes.len ? reader->text->bytes.ptr[at] : '\0';
}
// A space before the first token of a line, or the '-' of an item before that.
static inline bool yaml_is_indent(const struct yaml_reader *reader, uint32_t at) {
    return char_is_blank(yaml_char(reader, at)) ||
           (yaml_char(reader, at) == '-' && char_is_blank(yaml_char(reader, at + 1)));
}

// The list or map that is being read; NULL: none.
static inline struct yaml_frame *yaml_top(const struct yaml_reader *reader) {
    return reader->depth ? &reader->frames[reader->depth - 1] : NULL;
}
// Whether the next node is an item of a list or a key of a map.
bool yaml_at_entry(const struct yaml_reader *reader);
bool yaml_at_key(const struct yaml_reader *reader);
// Adds a node, counted against the limit.
tree_index yaml_add(struct yaml_reader *reader, struct tree_node node);

// ---- read_yaml_build.c
// Puts a whole node in its place: as the root, the next item, a key or the value of the waiting key.
void yaml_put(struct yaml_reader *reader, tree_index node);
// Accepts a node that is not a key, and was reported, as one; its pair is left out.
void yaml_put_bad_key(struct yaml_reader *reader, tree_index node);
void yaml_open(struct yaml_reader *reader, tree_index node, uint32_t anchor);
void yaml_close(struct yaml_reader *reader, uint32_t end);
// Closes what is open when the reader stops early; marked TREE_CUT.
void yaml_close_cut(struct yaml_reader *reader);

// ---- read_yaml_take.c
// A collection was opened: its entries may be taken.
void yaml_take_open(struct yaml_reader *reader);
// One was closed.
void yaml_take_close(struct yaml_reader *reader);
// A token was found, and the comments before it: hands over the entry that waits.
void yaml_take_ready(struct yaml_reader *reader);
// Whether the entry, an item or a key with its value, is taken instead of linked.
bool yaml_take(struct yaml_reader *reader, tree_index entry);

// ---- read_yaml_alias.c
// Remembers a name for a node (0: one that will be added next); returns its number.
uint32_t yaml_anchor_add(struct yaml_reader *reader, str name, span at, tree_index node);
void yaml_alias(struct yaml_reader *reader, str name, span at);

// ---- read_yaml_copy.c
// A copy of a node, within the budget of aliases; 0 if that is used up (reported `at` the alias, or at the
// node).
tree_index yaml_copy(struct yaml_reader *reader, tree_index node, span at);

// ---- read_yaml_keys.c
// Moves the pairs of the value of '<<', the key, into the map of the frame.
void yaml_merge(struct yaml_reader *reader, struct yaml_frame *frame, tree_index key, tree_index value);
// Keeps one pair of each key: the first written, else the first merged.
void yaml_unique_keys(struct yaml_reader *reader, struct yaml_frame *frame);

// ---- read_yaml_comment.c
// Looks for comments up to `end`, where the next token begins.
void yaml_gap(struct yaml_reader *reader, uint32_t end);
// Gives the comments found to an entry that begins here.
void yaml_begin_entry(struct yaml_reader *reader, tree_index entry);
// Gives them to the waiting key, for a value on a line of its own.
void yaml_begin_value(struct yaml_reader *reader);
void yaml_end_comments(struct yaml_reader *reader);
// The unquoted colour after `at` on the same line that YAML reads as a comment; false: none.
bool yaml_comment_color(const struct yaml_reader *reader, uint32_t at, struct reader_range *color);
void yaml_report_color(struct diag_sink *sink, str text, span at);

// ---- read_yaml_repair.c
// After reading stopped: overwrites text that glint understands better, reports it to `sink`, and returns
// whether the text must be read again from the start.
bool yaml_repair(struct yaml_reader *reader, struct diag_sink *sink, bool *tabs_repaired);

// ---- read_yaml_error.c
// Marks the value that libyaml's error directly follows as bad, as the error is about it, and the lists and
// maps that ended before the error as cut.
void yaml_blame(struct yaml_reader *reader);
// Reports what libyaml says.
void yaml_report(struct yaml_reader *reader);
void yaml_report_document(struct yaml_reader *reader, uint32_t at);

#endif
