#include "fuzz_reader.h"

#include "core/strbuf.h"
#include "fuzz_sample.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MEMORY_BYTES = 32 * 1024 * 1024,
    DEPTH_MAX = 1024
};

static void require(bool holds, const char *what) {
    if (holds)
        return;
    fprintf(stderr, "the reader broke its promise: %s\n", what);
    abort();
}

struct walk {
    const struct tree *tree;
    uint32_t size;  // of the source
    uint32_t nodes; // met
};

static void check_span(const struct walk *walk, span at, const char *what) {
    require(span_is_none(at) || (at.begin <= at.end && at.end <= walk->size), what);
}

static void check_node(struct walk *walk, tree_index index, unsigned depth) {
    const struct tree *tree = walk->tree;
    require(index > 0 && index < tree->nodes.count, "an index of a node");
    require(++walk->nodes < tree->nodes.count, "each node stands in one place");
    require(depth <= DEPTH_MAX, "the depth");
    const struct tree_node *node = tree_node(tree, index);
    check_span(walk, tree_span(tree, index), "the place of a node");
    check_span(walk, tree_comments(tree, index), "the place of comments");
    check_span(walk, tree_trailing_comment(tree, index), "the place of a comment behind");
    uint32_t met = 0;
    for (tree_index child = tree_first(tree, index); child; child = tree_next(tree, child), met++) {
        check_node(walk, child, depth + 1);
        if (node->kind != TREE_MAP)
            continue;
        require(tree_node(tree, child)->kind == TREE_SCALAR, "a key is a scalar");
        require(tree_node(tree, child)->key != TREE_KEY_NONE, "a key knows that it is one");
        child = tree_value(tree, child);
        require(child != 0, "a key has a value");
        check_node(walk, child, depth + 1);
    }
    bool nests = node->kind == TREE_MAP || node->kind == TREE_LIST;
    require(!nests || met == node->count, "the count of children");
    require(nests || (uint64_t)node->value + node->count <= tree->texts.count, "the text of a scalar");
}

static void check_tree(const struct tree *tree, uint32_t size) {
    struct walk walk = {.tree = tree, .size = size};
    check_span(&walk, tree->schema_line, "the place of the schema line");
    check_span(&walk, tree->closing_comments, "the place of closing comments");
    check_span(&walk, tree->root_name, "the place of the root's name");
    if (tree->root)
        check_node(&walk, tree->root, 0);
}

static void check_diagnostics(struct source_set *sources, const struct diag_sink *sink, uint32_t size) {
    for (uint32_t i = 0; i < sink->count && i < 50; i++) {
        const struct diag *d = &sink->items[i];
        require(d->at.begin <= d->at.end && d->at.end <= size, "the place of a diagnostic");
        require(d->message.len > 0, "the message of a diagnostic");
        require(!d->has_fix || (d->fix_at.begin <= d->fix_at.end && d->fix_at.end <= size),
                "the place of a fix");
        source_locate(sources, d->at);
    }
}

// ---- entry by entry and whole: two ways to one tree

static void dump(struct strbuf *out, const struct tree *tree, tree_index index) {
    const struct tree_node *node = tree_node(tree, index);
    span comments = tree_comments(tree, index);
    span behind = tree_trailing_comment(tree, index);
    strbuf_format(out, "%u %u %u %u %u-%u %u-%u %u-%u ", node->kind, node->style, node->key,
                  node->flags & ~(unsigned)TREE_TAKEN, node->begin, node->end, comments.begin, comments.end,
                  behind.begin, behind.end);
    strbuf_str(out, tree_text(tree, index));
    strbuf_char(out, '(');
    for (tree_index child = tree_first(tree, index); child; child = tree_next(tree, child))
        dump(out, tree, child);
    strbuf_char(out, ')');
}

// Takes all it can get, and remembers it as text.
struct taken {
    struct reader_taker taker;
    struct strbuf text;
    uint32_t lists[32]; // where the keys stand whose entries were taken
    uint32_t list_count;
};

static bool wants(struct reader_taker *taker, const struct tree *tree, tree_index key, enum tree_kind kind) {
    struct taken *taken = (struct taken *)taker;
    if (tree->is_xml)
        return true;
    if (kind != TREE_LIST && kind != TREE_MAP)
        return false;
    if (taken->list_count == sizeof taken->lists / sizeof *taken->lists)
        return false;
    taken->lists[taken->list_count++] = tree_node(tree, key)->begin;
    return true;
}

static bool take(struct reader_taker *taker, const struct tree *tree, tree_index list_key, tree_index entry) {
    struct taken *taken = (struct taken *)taker;
    (void)list_key;
    dump(&taken->text, tree, entry);
    if (tree_node(tree, entry)->key != TREE_KEY_NONE)
        dump(&taken->text, tree, tree_value(tree, entry));
    return true;
}

static bool was_taken(const struct taken *taken, const struct tree *tree, tree_index key) {
    if (tree->is_xml)
        return tree_node(tree, key)->key == TREE_KEY_CHILD;
    for (uint32_t i = 0; i < taken->list_count; i++)
        if (taken->lists[i] == tree_node(tree, key)->begin)
            return true;
    return false;
}

// What of the whole tree is to be found among the entries, or else in the tree that is left.
static void dump_root(struct strbuf *out, const struct taken *taken, const struct tree *tree, bool entries) {
    for (tree_index key = tree_first(tree, tree->root); key; key = tree_next_key(tree, key)) {
        tree_index value = tree_value(tree, key);
        bool is_taken = was_taken(taken, tree, key);
        if (is_taken != entries)
            continue;
        if (!is_taken || tree->is_xml) {
            dump(out, tree, key);
            dump(out, tree, value);
        } else {
            for (tree_index entry = tree_first(tree, value); entry; entry = tree_next(tree, entry))
                dump(out, tree, entry);
        }
    }
}

static void check_taken(fuzz_reader *read, const struct reader_context *outer, uint32_t source,
                        const struct tree *whole) {
    struct taken taken = {.taker = {wants, take}};
    struct diag_sink sink;
    struct tree rest;
    struct reader_context context = *outer;
    context.sink = &sink;
    context.taker = &taken.taker;
    diag_sink_init(&sink);
    strbuf_init(&taken.text);
    if (read(&context, source, &rest)) {
        struct strbuf entries, others, left;
        strbuf_init(&entries);
        strbuf_init(&others);
        strbuf_init(&left);
        require(outer->sink->count == 0, "what is read entry by entry has no mistakes");
        dump_root(&entries, &taken, whole, true);
        dump_root(&others, &taken, whole, false);
        dump_root(&left, &taken, &rest, false);
        require(str_equal(strbuf_view(&taken.text), strbuf_view(&entries)), "the same entries either way");
        require(str_equal(strbuf_view(&left), strbuf_view(&others)), "the same rest either way");
        require(rest.schema_line.begin == whole->schema_line.begin &&
                    rest.closing_comments.begin == whole->closing_comments.begin &&
                    str_equal(rest.xsi_attributes, whole->xsi_attributes),
                "the same lines around the scene");
        strbuf_finish(&entries);
        strbuf_finish(&others);
        strbuf_finish(&left);
    }
    strbuf_finish(&taken.text);
    diag_sink_finish(&sink);
}

struct job {
    fuzz_reader *read;
    bool entries; // the reader can hand over entries
    struct arena arena;
    struct source_set sources;
    struct diag_sink sink;
    struct limits limits;
    uint32_t source;
    struct tree tree;
};

static void run(void *context) {
    struct job *job = context;
    struct reader_context reader = {
        .sources = &job->sources, .sink = &job->sink, .limits = &job->limits, .arena = &job->arena};
    str text = job->sources.items[job->source].text;
    bool readable = job->read(&reader, job->source, &job->tree);
    require(readable || job->sink.errors > 0, "a text that cannot be read has a diagnostic");
    require(!readable || job->tree.root, "a text that can be read has a root");
    check_tree(&job->tree, (uint32_t)text.len);
    check_diagnostics(&job->sources, &job->sink, (uint32_t)text.len);
    if (readable && job->entries && fuzz_is_chosen(text, 0, 4))
        check_taken(job->read, &reader, job->source, &job->tree);
}

void fuzz_reader_run(fuzz_reader *read, bool entries, const uint8_t *data, size_t size) {
    struct job job = {.read = read, .entries = entries, .limits = limits_default()};
    job.limits.value[LIMIT_ALIAS_NODES] = 2000;
    job.limits.value[LIMIT_SCENE_DEPTH] = 24;
    arena_init(&job.arena, MEMORY_BYTES);
    source_set_init(&job.sources, &job.arena);
    diag_sink_init(&job.sink);
    char *copy = malloc(size ? size : 1);
    if (!copy)
        abort();
    if (size)
        memcpy(copy, data, size);
    job.source = source_add(&job.sources, SOURCE_KIND_OVERLAY, STR("fuzz"), (str){copy, size});
    arena_guarded(&job.arena, run, &job);
    diag_sink_finish(&job.sink);
    arena_finish(&job.arena);
    free(copy);
}
