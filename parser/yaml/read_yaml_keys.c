#include "diag/codes/syntax.h"
#include "parser/yaml/yaml_reader.h"

// Links the pairs of `map` after the children of the frame.
static void move_pairs(struct yaml_reader *r, struct yaml_frame *frame, tree_index map) {
    tree_index first = tree_first(r->tree, map);
    if (!first)
        return;
    if (frame->last)
        tree_node(r->tree, frame->last)->next = first;
    else
        tree_node(r->tree, frame->node)->value = first;
    for (tree_index key = first; key; key = tree_next_key(r->tree, key)) {
        tree_node(r->tree, key)->flags |= TREE_MERGED;
        frame->last = tree_value(r->tree, key);
        tree_node(r->tree, frame->node)->count++;
    }
    frame->has_merged = true;
}

// The contents of a node, to be moved away: of an anchored one, a copy.
static tree_index own(struct yaml_reader *r, tree_index node) {
    return tree_node(r->tree, node)->flags & TREE_SHARED ? yaml_copy(r, node, tree_span(r->tree, node))
                                                         : node;
}

// Merges a map; false: it is not a map (reported, unless the reader has).
static bool merge_one(struct yaml_reader *r, struct yaml_frame *frame, tree_index key, tree_index value) {
    const struct tree_node *node = tree_node(r->tree, value);
    if (node->kind == TREE_MAP) {
        tree_index pairs = own(r, value);
        if (!r->stopped)
            move_pairs(r, frame, pairs);
        return true;
    }
    tree_node(r->tree, frame->node)->flags |= TREE_CUT; // its missing keys should have come from there
    if (node->flags & TREE_BAD)
        return false;
    // Nodes that came by an alias have the place of their anchor.
    bool is_alias = node->begin < tree_node(r->tree, key)->begin;
    diag_add(&r->sink, DIAG_YAML_MERGE, tree_span(r->tree, is_alias ? key : value),
             "'<<' merges maps, and this is not a map");
    diag_help(&r->sink, "write '<<: *name', where '&name' comes before a map");
    return false;
}

void yaml_merge(struct yaml_reader *r, struct yaml_frame *frame, tree_index key, tree_index value) {
    if (tree_node(r->tree, value)->kind != TREE_LIST) {
        merge_one(r, frame, key, value);
        return;
    }
    bool good = true;
    tree_index list = own(r, value);
    if (r->stopped)
        return;
    for (tree_index item = tree_first(r->tree, list); item && good;) {
        tree_index next = tree_next(r->tree, item);
        good = merge_one(r, frame, key, item) || (tree_node(r->tree, item)->flags & TREE_BAD);
        item = next;
    }
}

// Each join walks over everything joined before.
enum {
    JOINS_MAX = 100
};

// Joins the contents of two values of one key, if that cannot change what is right in either: both are maps,
// or lists of maps.
static bool joins(const struct tree *tree, tree_index a, tree_index b) {
    unsigned kind = tree_node(tree, a)->kind;
    if ((tree_node(tree, a)->flags | tree_node(tree, b)->flags) & TREE_SHARED)
        return false;
    if (kind != tree_node(tree, b)->kind || (kind != TREE_LIST && kind != TREE_MAP))
        return false;
    if (!tree_first(tree, a) || !tree_first(tree, b))
        return true;
    return kind == TREE_MAP || (tree_node(tree, tree_first(tree, a))->kind == TREE_MAP &&
                                tree_node(tree, tree_first(tree, b))->kind == TREE_MAP);
}

static void join(struct yaml_reader *r, tree_index into, tree_index from) {
    struct tree *tree = r->tree;
    bool is_map = tree_node(tree, into)->kind == TREE_MAP;
    str_map_clear(&r->joined_keys);
    tree_index last = 0;
    for (tree_index child = tree_first(tree, into); child; child = tree_next(tree, last)) {
        if (is_map)
            *str_map_at(&r->joined_keys, tree_text(tree, child)) = child;
        last = is_map ? tree_value(tree, child) : child;
    }
    for (tree_index child = tree_first(tree, from); child;) {
        tree_index end = is_map ? tree_value(tree, child) : child;
        tree_index next = tree_next(tree, end);
        tree_node(tree, end)->next = 0;
        if (!is_map || !*str_map_at(&r->joined_keys, tree_text(tree, child))) {
            if (last)
                tree_node(tree, last)->next = child;
            else
                tree_node(tree, into)->value = child;
            last = end;
            tree_node(tree, into)->count++;
        }
        child = next;
    }
}

static void report_twice(struct yaml_reader *r, tree_index first, tree_index second) {
    str text = tree_text(r->tree, second);
    diag_add(&r->sink, DIAG_DUPLICATE_KEY, tree_span(r->tree, second), "the key '%.*s' is given twice",
             STR_ARG(reader_clip(text)));
    diag_note(&r->sink, tree_span(r->tree, first), "it was given here first");
    tree_index a = tree_value(r->tree, first), b = tree_value(r->tree, second);
    if (r->sink.errors < JOINS_MAX && joins(r->tree, a, b)) {
        // The entries of both are checked, and references to them are valid: the mistake is reported once.
        join(r, a, b);
        diag_help(&r->sink, "put the contents of both under one key, or rename one of the two");
    } else {
        diag_help(&r->sink, "remove one of the two");
    }
}

// "0" in {0, 0, 0}, which was probably meant as a list: that will be reported.
static bool is_item(const struct tree *tree, tree_index value) {
    const struct tree_node *node = tree_node(tree, value);
    return node->kind == TREE_NULL && node->begin == node->end && !(node->flags & TREE_BAD);
}

// One walk over the pairs: the `merged` ones or the map's own.
static void unique(struct yaml_reader *r, struct yaml_frame *frame, bool merged) {
    struct tree *tree = r->tree;
    tree_index before = 0; // the value before the pair
    for (tree_index key = tree_first(tree, frame->node); key;) {
        tree_index value = tree_value(tree, key);
        tree_index next = tree_next(tree, value);
        bool concerns = ((tree_node(tree, key)->flags & TREE_MERGED) != 0) == merged;
        uint32_t *first = concerns ? str_map_at(&r->keys, tree_text(tree, key)) : NULL;
        if (first && *first) {
            if (!merged && !is_item(r->tree, value))
                report_twice(r, *first, key);
            if (before)
                tree_node(tree, before)->next = next;
            else
                tree_node(tree, frame->node)->value = next;
            tree_node(tree, frame->node)->count--;
        } else {
            if (first)
                *first = key;
            before = value;
        }
        key = next;
    }
    frame->last = before;
}

// Most maps are small, and have no key twice.
enum {
    SMALL_MAP = 8
};

static bool is_plainly_unique(const struct tree *tree, const struct yaml_frame *frame) {
    str names[SMALL_MAP];
    uint32_t count = 0;
    for (tree_index key = tree_first(tree, frame->node); key; key = tree_next_key(tree, key)) {
        if (count == SMALL_MAP)
            return false;
        names[count] = tree_text(tree, key);
        for (uint32_t i = 0; i < count; i++)
            if (str_equal(names[i], names[count]))
                return false;
        count++;
    }
    return true;
}

void yaml_unique_keys(struct yaml_reader *r, struct yaml_frame *frame) {
    if (tree_node(r->tree, frame->node)->count < 2 || is_plainly_unique(r->tree, frame))
        return;
    str_map_clear(&r->keys);
    unique(r, frame, false);
    if (frame->has_merged)
        unique(r, frame, true);
}
