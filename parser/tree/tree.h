// The neutral tree that both readers make of a file, before any element's name is looked up.
//
// A tree holds the tokens of one source. Nodes are 32 bytes, linked by indices; node 0 is "none".
// A map's children alternate key, value. XML becomes maps too: each attribute is a key (TREE_KEY_ATTRIBUTE)
// with a scalar, each child element a key (TREE_KEY_CHILD: its tag name) with a map; a child that is
// repeated is a repeated key. YAML keys are TREE_KEY_PLAIN; merge keys and aliases are already resolved:
// the copied nodes keep the places where the text is.
// Comments and blank lines stay in the source; a node's `comments` names those before it. Ownership: the
// arena passed to tree_init. Thread safety: one thread while it is built, then immutable.
#ifndef GLINT_PARSER_TREE_TREE_H
#define GLINT_PARSER_TREE_TREE_H

#include "core/arena.h"
#include "diag/source.h"

enum tree_kind {
    TREE_NONE,
    TREE_SCALAR,
    TREE_LIST,
    TREE_MAP,
    TREE_NULL, // YAML: an empty value, ~ or null; XML has none
};

enum tree_style {
    TREE_PLAIN,   // unquoted YAML, or an XML attribute: the attribute decides what it is
    TREE_QUOTED,  // YAML in quotes, or a block scalar: text, never a number or a boolean
    TREE_FLOW,    // lists and maps in brackets
    TREE_BLOCK,   // lists and maps by indentation
    TREE_ELEMENT, // an XML element
};

enum tree_key {
    TREE_KEY_NONE, // not a key
    TREE_KEY_PLAIN,
    TREE_KEY_ATTRIBUTE,
    TREE_KEY_CHILD,
};

enum tree_flag {
    TREE_BAD = 1,    // a diagnostic was given for this node; later stages stay silent about it
    TREE_CUT = 2,    // the file broke off inside this list, map or element: missing parts may follow
    TREE_MERGED = 4, // YAML: a key that came by '<<'
    TREE_SHARED = 8, // YAML: the node has an anchor, so that its contents must not be moved
    TREE_TAKEN = 16, // XML: a key that stands for all children of its name, which were taken one by one
};

typedef uint32_t tree_index;

struct tree_node {
    uint8_t kind;        // tree_kind
    uint8_t style;       // tree_style
    uint8_t key;         // tree_key
    uint8_t flags;       // tree_flag
    uint32_t begin, end; // span in the source: the token; of lists, maps and elements the whole
    uint32_t value;      // scalar: offset in texts; list, map: first child
    uint32_t count;      // scalar: bytes; list: items; map: pairs
    tree_index next;     // sibling
    uint32_t comments;   // index in the list of comment spans; 0: none
};

struct tree_comment {
    uint32_t begin, end;                   // before the entry: from the first comment to the end of the last
    uint32_t trailing_begin, trailing_end; // after it on its line; equal: none
};

struct tree {
    struct arena *arena;
    uint32_t source;
    bool is_xml;
    struct {
        struct tree_node *items;
        uint32_t count, capacity;
    } nodes;
    struct {
        char *items;
        uint32_t count, capacity;
    } texts; // decoded scalars, one after the other
    struct {
        struct tree_comment *items;
        uint32_t count, capacity;
    } comments;
    struct {
        struct tree_comment *items; // only begin and end
        uint32_t count, capacity;
    } directives;          // comments to glint itself: "glint: allow W401"
    tree_index root;       // a map (a --set value: anything), or TREE_NONE (0) if there is nothing to bind
    span root_name;        // XML: the root's tag name; YAML: the map's first key
    str root_tag;          // XML: "Scene"; YAML: empty
    span schema_line;      // the editor's line, or SPAN_NONE
    str xsi_attributes;    // XML: the xsi attributes of the root, as text
    span closing_comments; // comments after the last entry, or SPAN_NONE; XML: </Scene> may be inside
    bool overwritten; // the source has bytes that are not text, or marks of conflicts: reported, and read as
                      // spaces
    bool broken;      // libyaml or expat itself stopped: the rest was not read
};

void tree_init(struct tree *tree, struct arena *arena, uint32_t source, bool is_xml);
static inline tree_index tree_add(struct tree *tree, struct tree_node node) {
    if (tree->nodes.count == tree->nodes.capacity)
        tree->nodes.items =
            arena_grow(tree->arena, tree->nodes.items, tree->nodes.count, &tree->nodes.capacity, sizeof node);
    tree->nodes.items[tree->nodes.count] = node;
    return tree->nodes.count++;
}
// Makes room for `bytes` more of decoded text.
void tree_grow_texts(struct tree *tree, size_t bytes);
// Copies decoded text; returns its offset.
static inline uint32_t tree_add_text(struct tree *tree, str text) {
    uint32_t offset = tree->texts.count;
    if (text.len > tree->texts.capacity - offset)
        tree_grow_texts(tree, text.len);
    if (text.len)
        memcpy(tree->texts.items + offset, text.ptr, text.len);
    tree->texts.count = offset + (uint32_t)text.len;
    return offset;
}
uint32_t tree_add_comment(struct tree *tree, struct tree_comment comment);
// Keeps a comment if its text, without the comment's marks, begins with "glint:".
void tree_add_directive(struct tree *tree, str comment, uint32_t begin, uint32_t end);
// Gives an entry the comment after it on its line, if it has none yet.
void tree_add_trailing(struct tree *tree, tree_index entry, uint32_t begin, uint32_t end);

static inline struct tree_node *tree_node(const struct tree *tree, tree_index i) {
    return &tree->nodes.items[i];
}
static inline str tree_text(const struct tree *tree, tree_index scalar) {
    const struct tree_node *node = tree_node(tree, scalar);
    bool has_text = node->kind == TREE_SCALAR || node->kind == TREE_NULL;
    if (!has_text || node->count == 0)
        return STR("");
    return (str){tree->texts.items + node->value, node->count};
}
static inline span tree_span(const struct tree *tree, tree_index node) {
    if (node == 0)
        return SPAN_NONE;
    return (span){tree->source, tree_node(tree, node)->begin, tree_node(tree, node)->end};
}
// The comments that belong to an entry (a key or an item of a list): those before it, or if there are none
// the one after it on its line; SPAN_NONE if there are none. The editor's schema line may be inside the span.
span tree_comments(const struct tree *tree, tree_index node);
// The comment after the entry on its line, SPAN_NONE if there is none.
span tree_trailing_comment(const struct tree *tree, tree_index node);

// Walks a map: for (key = tree_first(t, map); key; key = tree_next_key(t, key)) value = tree_value(t, key)
static inline tree_index tree_first(const struct tree *tree, tree_index parent) {
    const struct tree_node *n = tree_node(tree, parent);
    return n->kind == TREE_LIST || n->kind == TREE_MAP ? n->value : 0;
}
static inline tree_index tree_next(const struct tree *tree, tree_index item) {
    return tree_node(tree, item)->next;
}
static inline tree_index tree_value(const struct tree *tree, tree_index key) {
    return tree_node(tree, key)->next;
}
static inline tree_index tree_next_key(const struct tree *tree, tree_index key) {
    return tree_node(tree, tree_node(tree, key)->next)->next;
}

#endif
