#include "core/nearest.h"
#include "diag/codes/syntax.h"
#include "parser/yaml/yaml_reader.h"

uint32_t yaml_anchor_add(struct yaml_reader *r, str name, span at, tree_index node) {
    if (r->anchors.count == 0)
        (void)ARENA_PUSH(r->context->arena, &r->anchors);
    struct yaml_anchor *anchor = ARENA_PUSH(r->context->arena, &r->anchors);
    *anchor = (struct yaml_anchor){arena_copy(r->context->arena, name), at, node, node == 0};
    uint32_t index = r->anchors.count - 1;
    if (node)
        tree_node(r->tree, node)->flags |= TREE_SHARED;
    *str_map_at(&r->anchor_names, anchor->name) = index;
    return index;
}

static tree_index add_bad(struct yaml_reader *r, span at) {
    return yaml_add(
        r, (struct tree_node){.kind = TREE_NULL, .flags = TREE_BAD, .begin = at.begin, .end = at.end});
}

enum {
    SEARCHES_MAX = 50,
    SEARCHED_MAX = 1000
};

static tree_index undefined(struct yaml_reader *r, str name, span at) {
    diag_add(&r->sink, DIAG_UNDEFINED_ALIAS, at, "there is no anchor '%.*s' before this",
             STR_ARG(reader_clip(name)));
    struct nearest nearest = nearest_begin_within(name, &r->sink.search_left);
    uint32_t searched = r->sink.errors > SEARCHES_MAX ? 0 : r->anchors.count;
    for (uint32_t i = 1; i < searched && i < SEARCHED_MAX; i++)
        nearest_offer(&nearest, r->anchors.items[i].name);
    str best = nearest_best(&nearest);
    str written = source_text(r->context->sources, at);
    if (best.len) {
        diag_help(&r->sink, "did you mean '*%.*s'?", STR_ARG(reader_clip(best)));
        diag_fix_part(&r->sink, r->context->sources, false, name, best);
    } else if (r->anchors.count <= 1) {
        diag_help(&r->sink, "'*' begins an alias; text that begins with it needs quotes: \"%.*s\"",
                  STR_ARG(reader_clip(written)));
    }
    return add_bad(r, at);
}

void yaml_alias(struct yaml_reader *r, str name, span at) {
    if (yaml_at_key(r)) {
        diag_add(&r->sink, DIAG_YAML_KEY, at, "an alias where a key belongs");
        diag_help(&r->sink, "write the key itself; to merge a map write '<<: *%.*s'",
                  STR_ARG(reader_clip(name)));
        tree_index bad = add_bad(r, at);
        yaml_begin_entry(r, bad);
        tree_node(r->tree, bad)->kind = TREE_SCALAR;
        yaml_put_bad_key(r, bad);
        return;
    }
    uint32_t index = str_map_find(&r->anchor_names, name);
    tree_index node;
    if (index == YAML_NO_ANCHOR) {
        node = undefined(r, name, at);
    } else if (r->anchors.items[index].open) {
        diag_add(&r->sink, DIAG_ALIAS_CYCLE, at, "'*%.*s' is inside the value that it names",
                 STR_ARG(reader_clip(name)));
        diag_note(&r->sink, r->anchors.items[index].at, "the anchor is here");
        node = add_bad(r, at);
    } else {
        node = yaml_copy(r, r->anchors.items[index].node, at);
        if (r->stopped)
            return;
        tree_node(r->tree, node)->key = TREE_KEY_NONE;
    }
    if (yaml_at_entry(r)) {
        tree_node(r->tree, node)->comments = 0;
        yaml_begin_entry(r, node);
    } else {
        yaml_begin_value(r);
    }
    yaml_put(r, node);
}
