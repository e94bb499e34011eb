#include "parser/tree/reader_text.h"
#include "parser/tree/tree.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum {
    PLENTY_BYTES = 64 * 1024 * 1024,
    MANY = 5000
};

static tree_index add_scalar(struct tree *tree, const char *text) {
    str s = str_from(text);
    uint32_t offset = tree_add_text(tree, s);
    return tree_add(
        tree, (struct tree_node){
                  .kind = TREE_SCALAR, .begin = 4, .end = 8, .value = offset, .count = (uint32_t)s.len});
}

static void holds_nodes_and_texts(void **state) {
    (void)state;
    assert_true(sizeof(struct tree_node) <= 32);
    struct arena arena;
    arena_init(&arena, PLENTY_BYTES);
    struct tree tree;
    tree_init(&tree, &arena, 7, true);
    assert_true(tree.is_xml);
    char text[24];
    for (int i = 1; i <= MANY; i++) {
        snprintf(text, sizeof text, "text %d", i);
        assert_int_equal(add_scalar(&tree, text), i);
    }
    for (tree_index i = 1; i <= MANY; i += 499) {
        snprintf(text, sizeof text, "text %u", i);
        assert_true(str_equal_cstr(tree_text(&tree, i), text));
    }
    assert_int_equal(add_scalar(&tree, ""), MANY + 1);
    assert_int_equal(tree_text(&tree, MANY + 1).len, 0);
    span at = tree_span(&tree, 1);
    assert_true(at.source == 7 && at.begin == 4 && at.end == 8);
    assert_true(span_is_none(tree_span(&tree, 0)));
    tree_index list = tree_add(&tree, (struct tree_node){.kind = TREE_LIST, .value = 1, .count = 1});
    assert_int_equal(tree_text(&tree, list).len, 0);
    arena_finish(&arena);
}

static void walks_maps(void **state) {
    (void)state;
    struct arena arena;
    arena_init(&arena, PLENTY_BYTES);
    struct tree tree;
    tree_init(&tree, &arena, 1, false);
    tree_index a = add_scalar(&tree, "a"), one = add_scalar(&tree, "1");
    tree_index b = add_scalar(&tree, "b"), two = add_scalar(&tree, "2");
    tree_node(&tree, a)->next = one;
    tree_node(&tree, one)->next = b;
    tree_node(&tree, b)->next = two;
    tree_index map = tree_add(&tree, (struct tree_node){.kind = TREE_MAP, .value = a, .count = 2});
    assert_int_equal(tree_first(&tree, map), a);
    assert_int_equal(tree_value(&tree, a), one);
    assert_int_equal(tree_next_key(&tree, a), b);
    assert_int_equal(tree_next_key(&tree, b), 0);
    assert_int_equal(tree_first(&tree, a), 0); // a scalar has no children
    arena_finish(&arena);
}

static void tells_comments_apart(void **state) {
    (void)state;
    struct arena arena;
    arena_init(&arena, PLENTY_BYTES);
    struct tree tree;
    tree_init(&tree, &arena, 3, false);
    tree_index a = add_scalar(&tree, "a"), b = add_scalar(&tree, "b"), c = add_scalar(&tree, "c");
    uint32_t leading = tree_add_comment(&tree, (struct tree_comment){.begin = 10, .end = 20});
    tree_node(&tree, a)->comments = leading;
    tree_add_trailing(&tree, a, 30, 40);
    tree_add_trailing(&tree, a, 50, 60); // the first one stays
    tree_add_trailing(&tree, b, 70, 80);
    assert_int_equal(tree_comments(&tree, a).begin, 10);
    assert_int_equal(tree_trailing_comment(&tree, a).begin, 30);
    assert_int_equal(tree_comments(&tree, b).begin, 70);
    assert_int_equal(tree_comments(&tree, b).source, 3);
    assert_true(span_is_none(tree_comments(&tree, c)));
    assert_true(span_is_none(tree_trailing_comment(&tree, c)));
    arena_finish(&arena);
}

static void bad_ranges_are_found(void **state) {
    (void)state;
    struct arena arena;
    arena_init(&arena, PLENTY_BYTES);
    struct reader_context context = {.arena = &arena};
    struct reader_text text = {.bytes = STR("0123456789")};
    reader_text_mark(&context, &text, 6, 8);
    reader_text_mark(&context, &text, 2, 3);
    reader_text_mark(&context, &text, 3, 4); // joins the one before
    reader_text_seal(&text);
    assert_int_equal(text.bad.count, 2);
    assert_false(reader_text_is_bad(&text, 0, 2));
    assert_true(reader_text_is_bad(&text, 0, 3));
    assert_true(reader_text_is_bad(&text, 3, 4));
    assert_false(reader_text_is_bad(&text, 4, 6));
    assert_true(reader_text_is_bad(&text, 7, 9));
    assert_false(reader_text_is_bad(&text, 8, 10));
    arena_finish(&arena);
}

static void clips_at_characters(void **state) {
    (void)state;
    assert_true(str_equal(reader_clip(STR("short")), STR("short")));
    char text[64];
    memset(text, 'a', sizeof text);
    assert_int_equal(reader_clip((str){text, 64}).len, 60);
    memcpy(text + 58, "\xE2\x82\xAC", 3);
    assert_int_equal(reader_clip((str){text, 64}).len, 58);
}

static void tells_the_spelling(void **state) {
    (void)state;
    assert_true(reader_is_xml(STR("a.XML"), STR("glint: 1")));
    assert_false(reader_is_xml(STR("a.yaml"), STR("<Scene/>")));
    assert_false(reader_is_xml(STR("a.glint.yml"), STR("<Scene/>")));
    assert_false(reader_is_xml(STR("a.json"), STR("<Scene/>")));
    assert_true(reader_is_xml(STR("a"), STR("\xEF\xBB\xBF \r\n\t<Scene/>")));
    assert_false(reader_is_xml(STR("a.txt"), STR("glint: 1")));
    assert_false(reader_is_xml(STR(""), STR("")));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(holds_nodes_and_texts), cmocka_unit_test(walks_maps),
        cmocka_unit_test(tells_comments_apart),  cmocka_unit_test(bad_ranges_are_found),
        cmocka_unit_test(clips_at_characters),   cmocka_unit_test(tells_the_spelling),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
