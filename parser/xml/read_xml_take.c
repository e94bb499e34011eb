// Handing the root's children to the taker as they are read. A child is whole when the next one begins: until
// then a comment on the line of its end may belong to it.
#include "parser/xml/xml_reader.h"

void xml_take_mark(struct xml_reader *r) {
    r->taken.nodes_mark = r->tree->nodes.count;
    r->taken.texts_mark = r->tree->texts.count;
    r->taken.comments_mark = r->tree->comments.count;
}

// Drops everything read since the mark.
static void forget(struct xml_reader *r) {
    r->taken.nodes += r->tree->nodes.count - r->taken.nodes_mark;
    r->tree->nodes.count = r->taken.nodes_mark;
    r->tree->texts.count = r->taken.texts_mark;
    r->tree->comments.count = r->taken.comments_mark;
}

bool xml_take_ready(struct xml_reader *r) {
    tree_index entry = r->taken.entry;
    r->taken.entry = 0;
    if (!entry)
        return true;
    struct reader_taker *taker = r->context->taker;
    if (r->context->sink->count || !taker->take(taker, r->tree, 0, entry))
        return false;
    if (tree_node(r->tree, entry)->flags & TREE_TAKEN) {
        tree_node(r->tree, tree_value(r->tree, entry))->value = 0;
        r->taken.comments_mark = r->tree->comments.count;
    }
    forget(r);
    return true;
}

// The first child of this name represents all of them in the tree.
static bool has_first(struct xml_reader *r, tree_index key) {
    str name = tree_text(r->tree, key);
    for (uint32_t i = 0; i < r->taken.first_count; i++)
        if (str_equal(tree_text(r->tree, r->taken.first[i]), name))
            return true;
    return false;
}

enum xml_taking xml_take(struct xml_reader *r, tree_index key, tree_index value) {
    struct reader_taker *taker = r->context->taker;
    if (!taker || r->depth != 1 || !taker->wants(taker, r->tree, key, TREE_MAP))
        return XML_NOT_TAKEN;
    bool first = !has_first(r, key);
    if (first && r->taken.first_count == XML_FIRST_MAX)
        return XML_NOT_TAKEN;
    tree_node(r->tree, key)->next = value;
    r->taken.open = key;
    if (!first)
        return XML_TAKEN;
    r->taken.first[r->taken.first_count++] = key;
    tree_node(r->tree, key)->flags |= TREE_TAKEN;
    xml_take_mark(r);
    return XML_TAKEN_FIRST;
}

void xml_take_close(struct xml_reader *r, tree_index key) {
    if (r->taken.open != key)
        return;
    r->taken.entry = key;
    r->taken.open = 0;
}
