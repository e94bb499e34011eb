#define _GNU_SOURCE // memmem
// Of all misspellings by one edit (a letter left out, put in, taken for another, or two exchanged) of every
// key, element, word and material name of four letters and more: how many get the right one suggested.
//     misspelt [STRIDE]: every STRIDE-th misspelling, 1 by default
#include "files/files.h"
#include "grammar/schema.h"
#include "parser/parser.h"
#include "parser/tree/reader.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    LETTERS_LEAST = 4,
    SHARE_LEAST = 95 // percent
};

static unsigned long stride = 1;

struct score {
    unsigned long tried, right, valid, count;
    unsigned reported;
};

static str load(const char *path, struct arena *arena) {
    struct files files;
    str text = STR("");
    files_init(&files, arena);
    if (files_read_given(&files, str_from(path), 1 << 20, arena, &text) != FILE_OK)
        fail_msg("cannot read %s", path);
    return text;
}

// ---- one misspelling

struct target {
    str word;
    uint32_t begin;
    uint32_t end_tag; // XML: where the name stands in the end tag; 0: there is none
};

static bool suggests(const struct diag *item, str word) {
    char quoted[80];
    snprintf(quoted, sizeof quoted, "'%.*s'", STR_ARG(word));
    bool fixed = item->has_fix && str_starts_with(item->fix_text, word) &&
                 (item->fix_text.len == word.len || strchr("\t\n />", item->fix_text.ptr[word.len]));
    return fixed || (item->help.len && memmem(item->help.ptr, item->help.len, quoted, strlen(quoted)));
}

// Whether a finding at the place suggests the word; *silent: there is none, so that the word is right too.
static bool is_suggested(const char *path, str text, const struct target *target, bool *silent) {
    struct arena arena, scene;
    struct source_set sources;
    struct files files;
    struct diag_sink sink;
    struct limits limits = limits_default();
    struct parser_output output;
    arena_init(&arena, (size_t)1 << 26), arena_init(&scene, (size_t)1 << 26);
    source_set_init(&sources, &arena);
    files_init(&files, &arena);
    diag_sink_init(&sink);
    files_add_root(&files, STR("tests/nearest"));
    files_add_overlay(&files, STR("tests/nearest/base.yaml"), STR("glint: 1\n"));
    uint32_t source = source_add(&sources, SOURCE_KIND_FILE, str_from(path), text);
    struct parser_input input = {
        .sources = &sources, .files = &files, .sink = &sink, .limits = &limits, .arena = &scene};
    parser_load(&input, source, &output);
    bool found = false;
    *silent = sink.errors == 0;
    for (uint32_t i = 0; i < sink.count && !found; i++)
        found = sink.items[i].at.source == source && sink.items[i].at.begin == target->begin &&
                suggests(&sink.items[i], target->word);
    diag_sink_finish(&sink);
    arena_finish(&scene), arena_finish(&arena);
    return found;
}

static void try_word(const char *path, str text, const struct target *target, const char *wrong,
                     struct score *score) {
    static char changed[8192];
    size_t length = target->word.len, at = target->begin;
    if (score->count++ % stride || str_equal_cstr(target->word, wrong))
        return;
    int n = snprintf(changed, sizeof changed, "%.*s%s", (int)at, text.ptr, wrong);
    at += length;
    if (target->end_tag) {
        n += snprintf(changed + n, sizeof changed - (size_t)n, "%.*s%s", (int)(target->end_tag - at),
                      text.ptr + at, wrong);
        at = target->end_tag + length;
    }
    n += snprintf(changed + n, sizeof changed - (size_t)n, "%.*s", (int)(text.len - at), text.ptr + at);
    bool silent;
    bool right = is_suggested(path, (str){changed, (size_t)n}, target, &silent);
    score->valid += silent;
    score->tried += !silent;
    score->right += right;
    if (!right && !silent && score->reported++ < 20)
        print_message("not suggested: '%s' for '%.*s' in %s\n", wrong, STR_ARG(target->word), path);
}

static void try_all(const char *path, str text, const struct target *target, struct score *score) {
    static const char letters[] = "abcdefghijklmnopqrstuvwxyz_";
    const char *w = target->word.ptr;
    int n = (int)target->word.len;
    char wrong[80];
    for (int i = 0; i <= n; i++) {
        if (i < n) {
            snprintf(wrong, sizeof wrong, "%.*s%.*s", i, w, n - i - 1, w + i + 1);
            try_word(path, text, target, wrong, score);
        }
        if (i + 1 < n) {
            snprintf(wrong, sizeof wrong, "%.*s%c%c%.*s", i, w, w[i + 1], w[i], n - i - 2, w + i + 2);
            try_word(path, text, target, wrong, score);
        }
        for (const char *c = letters; *c; c++) {
            snprintf(wrong, sizeof wrong, "%.*s%c%.*s", i, w, *c, n - i, w + i);
            try_word(path, text, target, wrong, score);
            if (i == n)
                continue;
            snprintf(wrong, sizeof wrong, "%.*s%c%.*s", i, w, *c, n - i - 1, w + i + 1);
            try_word(path, text, target, wrong, score);
        }
    }
}

// ---- the words of a file

struct words {
    const char *path;
    str text;
    const struct tree *tree;
    struct score *score;
    struct target done[400];
    str done_in[400];
    unsigned count;
};

static bool is_word_of(const struct schema_row *row, str text) {
    for (int i = 0; row->words && row->words[i]; i++)
        if (str_equal_cstr(text, row->words[i]))
            return true;
    return false;
}

// A name of the language; with `values` a word that an attribute takes.
static bool is_of_language(str text, bool values) {
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        for (uint32_t i = 0; i < (*e)->row_count; i++) {
            const struct schema_row *row = &(*e)->rows[i];
            const char *const *parts = schema_components(row->kind);
            if (values ? is_word_of(row, text)
                       : str_equal_cstr(text, row->name) ||
                             str_equal_cstr(text, row->element ? row->element : "") ||
                             str_equal_cstr(text, row->plural ? row->plural : ""))
                return true;
            for (; !values && parts && *parts; parts++)
                if (str_equal_cstr(text, *parts))
                    return true;
        }
    return false;
}

static void take(struct words *w, tree_index node, str in, uint32_t end_tag) {
    str word = tree_text(w->tree, node);
    if (word.len < LETTERS_LEAST)
        return;
    for (unsigned i = 0; i < w->count; i++)
        if (str_equal(w->done[i].word, word) && str_equal(w->done_in[i], in))
            return;
    w->done_in[w->count] = in;
    w->done[w->count] = (struct target){word, tree_node(w->tree, node)->begin, end_tag};
    try_all(w->path, w->text, &w->done[w->count++], w->score);
}

static uint32_t end_tag_of(struct words *w, tree_index value, str name) {
    const struct tree_node *node = tree_node(w->tree, value);
    uint32_t at = node->end - (uint32_t)name.len - 1;
    return w->text.ptr[node->end - 2] == '/' ? 0 : at;
}

static void visit(struct words *w, tree_index node, str in) {
    bool map = tree_node(w->tree, node)->kind == TREE_MAP;
    for (tree_index entry = tree_first(w->tree, node); entry;
         entry = map ? tree_next_key(w->tree, entry) : tree_next(w->tree, entry)) {
        tree_index value = map ? tree_value(w->tree, entry) : entry;
        str key = map ? tree_text(w->tree, entry) : in;
        bool own = str_equal(in, STR("materials")) || str_equal(in, STR("cameras")) ||
                   str_equal(in, STR("material_map"));
        bool child = map && tree_node(w->tree, entry)->key == TREE_KEY_CHILD;
        if (map && !own && is_of_language(key, false) && !str_equal(key, STR("glint")))
            take(w, entry, in, child ? end_tag_of(w, value, key) : 0);
        bool named = str_equal(key, STR("name")) || str_equal(key, STR("description"));
        str text = tree_text(w->tree, value);
        bool material = str_equal(text, STR("chrome")) || str_equal(text, STR("brass"));
        if (!named && (material || is_of_language(text, true)))
            take(w, value, key, 0);
        visit(w, value, key);
    }
}

// Fails where a name of the language is not in the file, so that new ones are tested too.
static void assert_holds_names(str text, const char *path, const struct schema_element *element,
                               bool is_xml) {
    for (uint32_t i = 0; i < element->row_count; i++) {
        const struct schema_row *row = &element->rows[i];
        const char *name = is_xml ? row->name : schema_yaml_key(row);
        const char *other = is_xml && row->element ? row->element : name;
        bool there = memmem(text.ptr, text.len, name, strlen(name)) ||
                     memmem(text.ptr, text.len, other, strlen(other));
        if (strlen(name) >= LETTERS_LEAST && !there && (is_xml || !row->key))
            fail_msg("%s lacks '%s' of %s", path, name, element->name);
    }
}

// `whole`: the file holds every name of the language.
static void check(const char *path, bool whole) {
    struct arena arena;
    struct source_set sources;
    struct diag_sink sink;
    struct limits limits = limits_default();
    struct score score = {0};
    struct tree tree;
    arena_init(&arena, (size_t)1 << 26);
    source_set_init(&sources, &arena);
    diag_sink_init(&sink);
    str text = load(path, &arena);
    struct reader_context context = {.sources = &sources, .sink = &sink, .limits = &limits, .arena = &arena};
    uint32_t source = source_add(&sources, SOURCE_KIND_FILE, str_from(path), text);
    bool is_xml = reader_is_xml(str_from(path), text);
    assert_true((is_xml ? read_xml : read_yaml)(&context, source, &tree));
    struct words words = {.path = path, .text = text, .tree = &tree, .score = &score};
    visit(&words, tree.root, STR(""));
    for (const struct schema_element *const *e = schema_elements; whole && *e; e++)
        assert_holds_names(text, path, *e, is_xml);
    double share = score.tried ? 100.0 * (double)score.right / (double)score.tried : 0;
    print_message(
        "%s: %u words, %lu misspellings (%lu more mean something else), %.2f %% suggest the right one\n",
        path, words.count, score.tried, score.valid, share);
    assert_true(words.count > (whole ? 60 : 0));
    assert_true(share >= SHARE_LEAST);
    diag_sink_finish(&sink);
    arena_finish(&arena);
}

static void test_yaml(void **state) {
    (void)state;
    check("tests/nearest/names.yaml", true);
    check("tests/nearest/camera.yaml", false);
}

static void test_xml(void **state) {
    (void)state;
    check("tests/nearest/names.xml", true);
}

int main(int count, char **arguments) {
    if (count > 1)
        stride = strtoul(arguments[1], NULL, 10);
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_yaml), cmocka_unit_test(test_xml)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
