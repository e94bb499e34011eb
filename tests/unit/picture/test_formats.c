// The table of picture formats, and the words that are made from it.
#include "picture/formats/formats.h"

#include "core/strbuf.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static void add(struct strbuf *out, const char *word, int *left) {
    strbuf_cstr(out, out->len == 0 ? "" : *left == 1 ? " or " : ", ");
    strbuf_cstr(out, word);
    --*left;
}

static int count_of(enum image_use use, bool endings) {
    int count = 0;
    for (int i = 0; i < IMAGE_FORMATS; i++) {
        const struct image_format_info *info = image_format_info((enum image_format)i);
        for (int k = 0; info->uses & use && info->endings[k] && (endings || k == 0); k++)
            count++;
    }
    return count;
}

// What the words of a use must be.
static void words_of(enum image_use use, bool endings, struct strbuf *out) {
    int left = count_of(use, endings);
    strbuf_init(out);
    for (int i = 0; i < IMAGE_FORMATS; i++) {
        const struct image_format_info *info = image_format_info((enum image_format)i);
        for (int k = 0; info->uses & use && info->endings[k] && (endings || k == 0); k++)
            add(out, endings ? info->endings[k] : info->words, &left);
    }
}

static void test_words(void **state) {
    (void)state;
    static const struct {
        enum image_use use;
        bool endings;
        const char *words;
    } cases[] = {{IMAGE_WRITTEN, true, IMAGE_WRITTEN_ENDINGS},
                 {IMAGE_IN_SCENE, false, IMAGE_IN_SCENE_NAMES},
                 {IMAGE_COMPARED, false, IMAGE_COMPARED_NAMES}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct strbuf words;
        words_of(cases[i].use, cases[i].endings, &words);
        assert_string_equal(words.data, cases[i].words);
        strbuf_finish(&words);
    }
}

static void test_scene_endings(void **state) {
    (void)state;
    const char *const *given = image_scene_endings();
    for (int i = 0; i < IMAGE_FORMATS; i++) {
        const struct image_format_info *info = image_format_info((enum image_format)i);
        for (int k = 0; info->uses & IMAGE_IN_SCENE && info->endings[k]; k++)
            assert_string_equal(*given++, info->endings[k]);
    }
    assert_null(*given);
}

static void test_paths(void **state) {
    (void)state;
    enum image_format format = IMAGE_NONE;
    assert_true(image_format_of_path(STR("a/b.PNG"), IMAGE_WRITTEN, &format));
    assert_int_equal(format, IMAGE_PNG);
    assert_true(image_format_of_path(STR("sky.jpeg"), IMAGE_IN_SCENE, &format));
    assert_int_equal(format, IMAGE_JPEG);
    assert_false(image_format_of_path(STR("a.pfm"), IMAGE_IN_SCENE, &format));
    assert_false(image_format_of_path(STR("png"), IMAGE_WRITTEN, &format));
    assert_false(image_format_of_path(STR(""), IMAGE_COMPARED, &format));
    assert_int_equal(format, IMAGE_JPEG);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_words),
        cmocka_unit_test(test_scene_endings),
        cmocka_unit_test(test_paths),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
