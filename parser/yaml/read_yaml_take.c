// Handing entries of the root's lists and maps to the taker as they are read. An entry is whole once the
// token after it has been found: until then a comment on its line may belong to it.
#include "parser/yaml/yaml_reader.h"

static void fail(struct yaml_reader *r) {
    r->taken.failed = true;
    r->stopped = true;
}

static void set_mark(struct yaml_reader *r) {
    r->taken.nodes_mark = r->tree->nodes.count;
    r->taken.texts_mark = r->tree->texts.count;
    r->taken.comments_mark = r->tree->comments.count;
    r->taken.anchors_mark = r->anchors.count;
}

// Drops everything read since the mark, unless an alias may still need it.
static void forget(struct yaml_reader *r) {
    if (r->anchors.count != r->taken.anchors_mark)
        return;
    r->taken.nodes += r->tree->nodes.count - r->taken.nodes_mark;
    r->tree->nodes.count = r->taken.nodes_mark;
    r->tree->texts.count = r->taken.texts_mark;
    r->tree->comments.count = r->taken.comments_mark;
    r->last_scalar = r->closed = 0;
    // The next entry is on the same line: a comment after it would belong to the one that is gone.
    if (r->line_entry >= r->taken.nodes_mark)
        r->line_entry = YAML_LOST_ENTRY;
}

static bool is_taken(const struct yaml_reader *r) {
    return r->taken.list_key && r->depth == 2;
}

void yaml_take_open(struct yaml_reader *r) {
    struct reader_taker *taker = r->taken.on ? r->context->taker : NULL;
    if (!taker || r->depth != 2 || r->frames[1].anchor || r->frames[1].is_key)
        return;
    const struct yaml_frame *root = &r->frames[0];
    const struct tree_node *list = tree_node(r->tree, r->frames[1].node);
    bool is_pair =
        tree_node(r->tree, root->node)->kind == TREE_MAP && root->key && !root->merges && !root->anchor;
    if (!is_pair || (tree_node(r->tree, root->key)->flags | list->flags) & TREE_BAD ||
        !taker->wants(taker, r->tree, root->key, (enum tree_kind)list->kind))
        return;
    r->taken.list_key = root->key;
    str_map_clear(&r->taken.keys);
}

void yaml_take_close(struct yaml_reader *r) {
    if (r->depth == 1)
        r->taken.list_key = 0;
}

void yaml_take_ready(struct yaml_reader *r) {
    if (!r->taken.on)
        return;
    tree_index entry = r->taken.entry;
    r->taken.entry = 0;
    if (entry) {
        struct reader_taker *taker = r->context->taker;
        if (r->sink.count || !taker->take(taker, r->tree, r->taken.entry_key, entry)) {
            fail(r);
            return;
        }
        forget(r);
    }
    if (is_taken(r) && yaml_at_entry(r))
        set_mark(r);
}

// Names of a map's keys outlive their nodes, so that a key given twice is noticed.
static bool is_new_key(struct yaml_reader *r, tree_index key) {
    str name = tree_text(r->tree, key);
    if (str_map_find(&r->taken.keys, name))
        return false;
    *str_map_at(&r->taken.keys, arena_copy(r->context->arena, name)) = 1;
    return true;
}

bool yaml_take(struct yaml_reader *r, tree_index entry) {
    if (!is_taken(r))
        return false;
    bool is_map = tree_node(r->tree, r->frames[1].node)->kind == TREE_MAP;
    if (is_map && !is_new_key(r, entry))
        fail(r);
    r->taken.entry = entry;
    r->taken.entry_key = r->taken.list_key;
    tree_node(r->tree, r->frames[1].node)->count++;
    return true;
}
