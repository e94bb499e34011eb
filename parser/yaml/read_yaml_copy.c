// Copies the nodes that aliases and merge keys stand for.
#include "parser/yaml/yaml_reader.h"

// Whether one more copied node is allowed at this depth; reports if not.
static bool may_copy(struct yaml_reader *r, uint64_t depth, span at) {
    const struct limits *limits = r->context->limits;
    if (r->stopped)
        return false;
    if (depth > limits->value[LIMIT_SCENE_DEPTH])
        reader_limit(&r->sink, limits, LIMIT_SCENE_DEPTH, at, "this alias nests lists and maps too deeply");
    else if (++r->alias_nodes > limits->value[LIMIT_ALIAS_NODES])
        reader_limit(&r->sink, limits, LIMIT_ALIAS_NODES, at, "aliases add too many values to the file");
    else
        return true;
    r->stopped = true;
    return false;
}

// Recursion ends at the depth limit.
static tree_index copy_node(struct yaml_reader *r, tree_index from, uint64_t depth, span at) {
    struct tree_node node = *tree_node(r->tree, from);
    bool nests = node.kind == TREE_LIST || node.kind == TREE_MAP;
    if (!may_copy(r, depth + nests, at))
        return 0;
    tree_index child = nests ? node.value : 0;
    node.next = 0;
    node.flags &= (uint8_t)~TREE_SHARED;
    if (nests)
        node.value = 0;
    tree_index copy = yaml_add(r, node);
    for (tree_index last = 0; child && !r->stopped; child = tree_next(r->tree, child)) {
        tree_index copied = copy_node(r, child, depth + 1, at);
        if (last)
            tree_node(r->tree, last)->next = copied;
        else
            tree_node(r->tree, copy)->value = copied;
        last = copied;
    }
    return copy;
}

tree_index yaml_copy(struct yaml_reader *r, tree_index node, span at) {
    return copy_node(r, node, r->depth, at);
}
