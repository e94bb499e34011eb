#include "parser/tree/tree.h"

#include <assert.h>
#include <string.h>

static_assert(sizeof(struct tree_node) <= 32, "a node of the neutral tree has at most 32 bytes");

void tree_init(struct tree *tree, struct arena *arena, uint32_t source, bool is_xml) {
    *tree = (struct tree){.arena = arena, .source = source, .is_xml = is_xml};
    // Index 0 is "none" for nodes and for comments.
    (void)ARENA_PUSH(arena, &tree->nodes);
    (void)ARENA_PUSH(arena, &tree->comments);
}

void tree_grow_texts(struct tree *tree, size_t bytes) {
    uint64_t need = (uint64_t)tree->texts.count + bytes;
    uint64_t wanted = tree->texts.capacity ? (uint64_t)tree->texts.capacity * 2 : 256;
    if (wanted < need)
        wanted = need;
    if (wanted > UINT32_MAX)
        wanted = need > UINT32_MAX ? SIZE_MAX : UINT32_MAX; // beyond any arena's cap
    char *moved = arena_alloc_array(tree->arena, wanted, 1);
    if (tree->texts.count)
        memcpy(moved, tree->texts.items, tree->texts.count);
    tree->texts.items = moved;
    tree->texts.capacity = (uint32_t)wanted;
}

uint32_t tree_add_comment(struct tree *tree, struct tree_comment comment) {
    struct tree_comment *added = ARENA_PUSH(tree->arena, &tree->comments);
    *added = comment;
    return tree->comments.count - 1;
}

void tree_add_directive(struct tree *tree, str comment, uint32_t begin, uint32_t end) {
    size_t skipped = 0;
    while (skipped < comment.len && memchr("#<!-", comment.ptr[skipped], 4))
        skipped++;
    str body = str_trim(str_slice(comment, skipped, comment.len));
    if (str_starts_with(body, STR("glint:")))
        *ARENA_PUSH(tree->arena, &tree->directives) = (struct tree_comment){.begin = begin, .end = end};
}

void tree_add_trailing(struct tree *tree, tree_index entry, uint32_t begin, uint32_t end) {
    if (!tree_node(tree, entry)->comments) {
        uint32_t added = tree_add_comment(tree, (struct tree_comment){0});
        tree_node(tree, entry)->comments = added;
    }
    struct tree_comment *comment = &tree->comments.items[tree_node(tree, entry)->comments];
    if (comment->trailing_begin == comment->trailing_end) {
        comment->trailing_begin = begin;
        comment->trailing_end = end;
    }
}

span tree_trailing_comment(const struct tree *tree, tree_index node) {
    const struct tree_comment *comment = &tree->comments.items[tree_node(tree, node)->comments];
    if (comment->trailing_begin == comment->trailing_end)
        return SPAN_NONE;
    return (span){tree->source, comment->trailing_begin, comment->trailing_end};
}

span tree_comments(const struct tree *tree, tree_index node) {
    const struct tree_comment *comment = &tree->comments.items[tree_node(tree, node)->comments];
    if (comment->begin == comment->end)
        return tree_trailing_comment(tree, node);
    return (span){tree->source, comment->begin, comment->end};
}
