#include "tests/format/format_kit.h"

#include "tests/equal/equal_kit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

void reading_init(struct reading *r) {
    arena_init(&r->arena, (size_t)1 << 30);
    source_set_init(&r->sources, &r->arena);
    diag_sink_init(&r->sink);
    r->limits = limits_default();
    r->context = (struct reader_context){
        .sources = &r->sources, .sink = &r->sink, .limits = &r->limits, .arena = &r->arena};
}

void reading_finish(struct reading *r) {
    diag_sink_finish(&r->sink);
    arena_finish(&r->arena);
}

bool reading_run(struct reading *r, const char *path, str text, struct tree *tree) {
    uint32_t source = source_add(&r->sources, SOURCE_KIND_OVERLAY, str_from(path), text);
    *tree = (struct tree){.source = source};
    return (reader_is_xml(str_from(path), text) ? read_xml : read_yaml)(&r->context, source, tree);
}

enum format_status format_text(const char *path, str text, const struct upgrade_table *upgrade,
                               struct strbuf *out) {
    struct reading r;
    reading_init(&r);
    uint32_t source = source_add(&r.sources, SOURCE_KIND_OVERLAY, str_from(path), text);
    enum format_status status = format_source(&r.context, source, upgrade, out);
    if (status == FORMAT_REFUSED && r.sink.errors == 0)
        fail_msg("%s: refused without a word", path);
    reading_finish(&r);
    return status;
}

// All but white space and line ends.
static void add_words(struct strbuf *out, str text) {
    for (size_t i = 0; i < text.len;) {
        const size_t length = str_yaml_break_length(text, i);
        if (!length && !memchr(" \t", text.ptr[i], 2))
            strbuf_char(out, text.ptr[i]);
        i += length ? length : 1;
    }
}

// Each entry's path with the comments before it and behind it on its line.
static void list_comments(const struct tree *tree, str text, tree_index node, struct strbuf *path,
                          struct strbuf *out) {
    bool map = tree_node(tree, node)->kind == TREE_MAP;
    size_t length = path->len;
    unsigned count = 0;
    for (tree_index entry = tree_first(tree, node); entry;
         entry = map ? tree_next_key(tree, entry) : tree_next(tree, entry)) {
        strbuf_format(path, "/%u:%.*s", count++, STR_ARG(map ? tree_text(tree, entry) : STR("")));
        const struct tree_comment c = tree->comments.items[tree_node(tree, entry)->comments];
        strbuf_str(out, strbuf_view(path));
        strbuf_cstr(out, " before [");
        add_words(out, str_slice(text, c.begin, c.end));
        strbuf_cstr(out, "] behind [");
        add_words(out, str_slice(text, c.trailing_begin, c.trailing_end));
        strbuf_cstr(out, "]\n");
        list_comments(tree, text, map ? tree_value(tree, entry) : entry, path, out);
        path->len = length;
    }
}

static void comments_of(const char *path, str text, struct strbuf *out) {
    struct reading r;
    struct tree tree;
    struct strbuf where;
    reading_init(&r);
    strbuf_init(&where);
    if (!reading_run(&r, path, text, &tree))
        fail_msg("%s: cannot be read", path);
    list_comments(&tree, text, tree.root, &where, out);
    strbuf_cstr(out, "at the end [");
    add_words(out, source_text(&r.sources, tree.closing_comments));
    strbuf_cstr(out, "]\n");
    strbuf_finish(&where);
    reading_finish(&r);
}

// What the text means; gives the number of errors in it.
static uint32_t dump_of(const char *path, str text, struct strbuf *out) {
    struct loaded loaded;
    load_text(&loaded, path, text);
    if (loaded.is_there)
        ir_dump(loaded.output.scene, out);
    else
        strbuf_cstr(out, "nothing");
    uint32_t errors = loaded.sink.errors;
    loaded_finish(&loaded);
    return errors;
}

static str next_line(str text, size_t *at) {
    bool last;
    size_t begin = *at;
    while (*at < text.len && text.ptr[*at] != '\n')
        (*at)++;
    last = *at == text.len;
    str line = str_slice(text, begin, *at);
    *at += !last;
    return line;
}

// The same comments at the same entries; one at no entry's line may have come to one.
static bool same_comments(str a, str b) {
    size_t i = 0, j = 0;
    while (i < a.len && j < b.len) {
        str line = next_line(a, &i), other = next_line(b, &j);
        bool open = str_ends_with_nocase(line, " behind []");
        if (open ? !str_starts_with(other, str_slice(line, 0, line.len - 1)) : !str_equal(line, other))
            return false;
    }
    return i == a.len && j == b.len;
}

void assert_formats(const char *path, str text, struct strbuf *out) {
    struct strbuf again, before, after;
    strbuf_init(&again), strbuf_init(&before), strbuf_init(&after);
    enum format_status status = format_text(path, text, NULL, out);
    if (status != FORMAT_DONE)
        fail_msg("%s: %s\n%.*s", path, status == FORMAT_UNSAFE ? "the layout was unsafe" : "refused",
                 STR_ARG(text));
    add_words(&before, text);
    add_words(&after, strbuf_view(out));
    assert_same_text(path, &before, &after);
    strbuf_clear(&before), strbuf_clear(&after);
    assert_int_equal(format_text(path, strbuf_view(out), &UPGRADE_STANDARD, &again), FORMAT_DONE);
    if (!str_equal(strbuf_view(out), strbuf_view(&again)))
        print_error("from\n%.*s", STR_ARG(text));
    assert_same_text(path, out, &again);
    uint32_t errors = dump_of(path, text, &before);
    assert_true(dump_of(path, strbuf_view(out), &after) <= errors); // '/ >' becomes '/>'
    assert_same_text(path, &before, &after);
    strbuf_clear(&before), strbuf_clear(&after);
    comments_of(path, text, &before);
    comments_of(path, strbuf_view(out), &after);
    if (!same_comments(strbuf_view(&before), strbuf_view(&after))) {
        print_error("from\n%.*s\nto\n%s", STR_ARG(text), out->data);
        assert_same_text(path, &before, &after);
    }
    strbuf_finish(&again), strbuf_finish(&before), strbuf_finish(&after);
}
