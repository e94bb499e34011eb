#include "diag/codes/syntax.h"
#include "parser/yaml/yaml_reader.h"

#include <string.h>

static void link_child(struct yaml_reader *r, struct yaml_frame *frame, tree_index child) {
    if (frame->last)
        tree_node(r->tree, frame->last)->next = child;
    else
        tree_node(r->tree, frame->node)->value = child;
    frame->last = child;
}

// "camera {position": the colon is missing, and libyaml will stumble over the rest of the line.
static bool lacks_colon(struct yaml_reader *r, const struct tree_node *node, str text) {
    const char *blank = text.len ? memchr(text.ptr, ' ', text.len) : NULL;
    size_t end = blank ? (size_t)(blank - text.ptr) : text.len;
    bool bracket = end > 0 && end + 1 < text.len && (text.ptr[end + 1] == '{' || text.ptr[end + 1] == '[');
    for (size_t i = 0; i < end && bracket; i++)
        bracket = !strchr(":{[", text.ptr[i]);
    if (node->style != TREE_PLAIN || !bracket)
        return false;
    diag_add(&r->sink, DIAG_YAML_SYNTAX, yaml_span(r, node->begin, node->begin + (uint32_t)end),
             "a ':' is missing after '%.*s'", STR_ARG(reader_clip(str_slice(text, 0, end))));
    diag_help(&r->sink, "write '%.*s: %c'", STR_ARG(reader_clip(str_slice(text, 0, end))), text.ptr[end + 1]);
    r->blamed = node->begin + 1;
    return true;
}

// "// remark" in brackets, which YAML reads as a key.
static bool is_remark(struct yaml_reader *r, const struct tree_node *node, str text) {
    if (node->style != TREE_PLAIN || !str_starts_with(text, STR("//")))
        return false;
    diag_add(&r->sink, DIAG_YAML_SYNTAX, yaml_span(r, node->begin, node->begin + 2),
             "'//' does not begin a comment in YAML");
    diag_help(&r->sink, "a comment begins with '#' and ends with its line");
    r->blamed = node->end; // the end of the last line that was read as part of it
    return true;
}

static void take_key(struct yaml_reader *r, struct yaml_frame *frame, tree_index key) {
    struct tree_node *node = tree_node(r->tree, key);
    frame->key = key;
    frame->merges = false;
    node->key = TREE_KEY_PLAIN;
    span at = yaml_span(r, node->begin, node->end);
    str text = tree_text(r->tree, key);
    if (node->kind == TREE_NULL && node->begin == node->end) {
        diag_add(&r->sink, DIAG_YAML_KEY, at, "a ':' without a key before it");
        node->flags |= TREE_BAD;
    } else if (node->kind == TREE_SCALAR || node->kind == TREE_NULL) {
        node->kind = TREE_SCALAR;
        if (lacks_colon(r, node, text) || is_remark(r, node, text))
            node->flags |= TREE_BAD;
        frame->merges = node->style == TREE_PLAIN && str_equal(text, STR("<<"));
    } else {
        diag_add(&r->sink, DIAG_YAML_KEY, at, "a %s where a key belongs",
                 node->kind == TREE_LIST ? "list" : "map");
        diag_help(&r->sink, "a key is one word; text that begins with '[' or '{' needs quotes");
        node->flags |= TREE_BAD;
    }
}

void yaml_put_bad_key(struct yaml_reader *r, tree_index node) {
    tree_node(r->tree, node)->flags |= TREE_BAD;
    tree_node(r->tree, node)->key = TREE_KEY_PLAIN;
    yaml_top(r)->key = node;
    yaml_top(r)->merges = false;
}

static void take_value(struct yaml_reader *r, struct yaml_frame *frame, tree_index value) {
    tree_index key = frame->key;
    frame->key = 0;
    if (frame->merges) {
        r->taken.failed = r->taken.failed || (r->taken.list_key && r->depth == 2);
        yaml_merge(r, frame, key, value);
        return;
    }
    // The pair of an invalid key was reported; it is left out.
    if (tree_node(r->tree, key)->flags & TREE_BAD)
        return;
    if (r->taken.list_key) {
        tree_node(r->tree, key)->next = value;
        if (yaml_take(r, key))
            return;
    }
    link_child(r, frame, key);
    link_child(r, frame, value);
    tree_node(r->tree, frame->node)->count++;
}

void yaml_put(struct yaml_reader *r, tree_index node) {
    struct yaml_frame *frame = yaml_top(r);
    if (!frame) {
        r->tree->root = node;
    } else if (tree_node(r->tree, frame->node)->kind == TREE_LIST) {
        if (yaml_take(r, node))
            return;
        link_child(r, frame, node);
        tree_node(r->tree, frame->node)->count++;
    } else if (frame->key == 0) {
        take_key(r, frame, node);
    } else {
        take_value(r, frame, node);
    }
}

void yaml_open(struct yaml_reader *r, tree_index node, uint32_t anchor) {
    uint64_t most = r->context->limits->value[LIMIT_SCENE_DEPTH];
    if (r->depth >= most) {
        uint32_t begin = tree_node(r->tree, node)->begin;
        reader_limit(&r->sink, r->context->limits, LIMIT_SCENE_DEPTH, yaml_span(r, begin, begin + 1),
                     "lists and maps nested too deeply");
        r->stopped = true;
        return;
    }
    r->frames[r->depth] = (struct yaml_frame){.node = node, .anchor = anchor, .is_key = yaml_at_key(r)};
    r->depth++;
    yaml_take_open(r);
}

void yaml_close(struct yaml_reader *r, uint32_t end) {
    struct yaml_frame *frame = yaml_top(r);
    tree_index node = frame->node;
    if (tree_node(r->tree, node)->kind == TREE_MAP)
        yaml_unique_keys(r, frame);
    if (end > tree_node(r->tree, node)->begin)
        tree_node(r->tree, node)->end = end;
    if (frame->anchor)
        r->anchors.items[frame->anchor].open = false;
    if (tree_node(r->tree, node)->style == TREE_BLOCK)
        r->closed = node;
    r->depth--;
    yaml_take_close(r);
    bool in_brackets = r->depth && tree_node(r->tree, r->frames[r->depth - 1].node)->style == TREE_FLOW;
    if (!in_brackets)
        r->lost_color = (struct reader_range){0};
    yaml_put(r, node);
}

void yaml_close_cut(struct yaml_reader *r) {
    while (r->depth) {
        struct yaml_frame *frame = yaml_top(r);
        bool is_key = frame->is_key;
        frame->key = 0;
        tree_node(r->tree, frame->node)->flags |= TREE_CUT;
        if (is_key)
            r->depth--;
        else
            yaml_close(r, r->gap);
    }
}
