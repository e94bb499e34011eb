#include "reader_kit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct reading {
    struct reader_kit *kit;
    struct reader_kit_options options;
};

static void run(void *context) {
    const struct reading *reading = context;
    struct reader_kit *kit = reading->kit;
    struct reader_context reader = {
        .sources = &kit->sources, .sink = &kit->sink, .limits = &kit->limits, .arena = &kit->arena};
    if (reading->options.is_value)
        kit->readable = read_yaml_value(&reader, kit->source, reading->options.begin, &kit->tree);
    else if (reading->options.is_xml)
        kit->readable = read_xml(&reader, kit->source, &kit->tree);
    else
        kit->readable = read_yaml(&reader, kit->source, &kit->tree);
}

void reader_kit_read(struct reader_kit *kit, str text, struct reader_kit_options options) {
    *kit = (struct reader_kit){.limits = options.limits ? *options.limits : limits_default()};
    size_t plenty = (size_t)256 * 1024 * 1024;
    arena_init(&kit->arena, plenty);
    diag_sink_init(&kit->sink);
    strbuf_init(&kit->out);
    source_set_init(&kit->sources, &kit->arena);
    // Of exactly this size, so that a reader that looks too far is seen.
    kit->text = malloc(text.len ? text.len : 1);
    if (!kit->text)
        abort();
    if (text.len)
        memcpy(kit->text, text.ptr, text.len);
    kit->source = source_add(&kit->sources, SOURCE_KIND_FILE, STR("scene"), (str){kit->text, text.len});
    if (options.memory_bytes)
        kit->arena.cap_bytes = kit->arena.used_bytes + options.memory_bytes;
    struct reading reading = {kit, options};
    kit->fault = arena_guarded(&kit->arena, run, &reading);
    kit->arena.cap_bytes = plenty;
    diag_sort(&kit->sink);
}

void reader_kit_finish(struct reader_kit *kit) {
    strbuf_finish(&kit->out);
    diag_sink_finish(&kit->sink);
    arena_finish(&kit->arena);
    free(kit->text);
}

static void put_node(struct reader_kit *kit, tree_index index) {
    const struct tree_node *node = tree_node(&kit->tree, index);
    struct strbuf *out = &kit->out;
    str text = tree_text(&kit->tree, index);
    bool map = node->kind == TREE_MAP;
    if (node->kind == TREE_NULL) {
        strbuf_char(out, '~');
    } else if (node->kind == TREE_SCALAR) {
        strbuf_format(out, node->style == TREE_QUOTED ? "\"%.*s\"" : "%.*s", STR_ARG(text));
    } else {
        strbuf_char(out, map ? '{' : '[');
        for (tree_index child = tree_first(&kit->tree, index); child;) {
            put_node(kit, child);
            if (map)
                strbuf_cstr(out, ": ");
            child = map ? tree_value(&kit->tree, child) : child;
            if (map)
                put_node(kit, child);
            child = tree_next(&kit->tree, child);
            strbuf_cstr(out, child ? ", " : "");
        }
        strbuf_char(out, map ? '}' : ']');
    }
    strbuf_cstr(out, node->flags & TREE_BAD ? "!" : "");
    strbuf_cstr(out, node->flags & TREE_CUT ? "?" : "");
    strbuf_cstr(out, node->flags & TREE_MERGED ? "+" : "");
}

const char *reader_kit_dump(struct reader_kit *kit) {
    strbuf_clear(&kit->out);
    if (kit->tree.root)
        put_node(kit, kit->tree.root);
    else
        strbuf_cstr(&kit->out, "none");
    return kit->out.data;
}

static void put_place(struct reader_kit *kit, span at) {
    struct source_place place = source_locate(&kit->sources, at);
    if (span_is_none(at))
        strbuf_char(&kit->out, '-');
    else
        strbuf_format(&kit->out, "%u:%u-%u:%u", place.line, place.column, place.end_line, place.end_column);
}

const char *reader_kit_errors(struct reader_kit *kit) {
    struct strbuf *out = &kit->out;
    strbuf_clear(out);
    strbuf_cstr(out, "");
    for (uint32_t i = 0; i < kit->sink.count; i++) {
        const struct diag *d = &kit->sink.items[i];
        strbuf_format(out, "%s%s ", i ? ", " : "", diag_info(d->code)->code);
        put_place(kit, d->at);
        for (const struct diag_related *note = d->notes; note; note = note->next) {
            strbuf_cstr(out, " (");
            put_place(kit, note->at);
            strbuf_char(out, ')');
        }
        if (d->has_fix)
            strbuf_format(out, " =%s>%.*s<", d->fix_is_safe ? "safe" : "maybe", STR_ARG(d->fix_text));
    }
    return out->data ? out->data : "";
}

const char *reader_kit_place(struct reader_kit *kit, span at) {
    strbuf_clear(&kit->out);
    put_place(kit, at);
    return kit->out.data;
}

const char *reader_kit_source(struct reader_kit *kit, span at) {
    strbuf_clear(&kit->out);
    strbuf_str(&kit->out, source_text(&kit->sources, at));
    return kit->out.data ? kit->out.data : "";
}

static tree_index step(const struct tree *tree, tree_index at, str name, bool wants_key) {
    if (tree_node(tree, at)->kind == TREE_LIST) {
        tree_index item = tree_first(tree, at);
        for (unsigned long n = strtoul(name.ptr, NULL, 10); n > 0 && item; n--)
            item = tree_next(tree, item);
        return item;
    }
    for (tree_index key = tree_first(tree, at); key; key = tree_next_key(tree, key))
        if (str_equal(tree_text(tree, key), name))
            return wants_key ? key : tree_value(tree, key);
    return 0;
}

tree_index reader_kit_at(const struct reader_kit *kit, const char *path) {
    tree_index at = kit->tree.root;
    while (at && *path) {
        size_t length = strcspn(path, "/@");
        bool wants_key = path[length] == '@';
        at = step(&kit->tree, at, (str){path, length}, wants_key);
        path += length + (path[length] != '\0');
    }
    return at;
}
