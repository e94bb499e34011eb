// The files of the repository through the formatter: the scenes that ship are in its layout, and what is
// wrong in the invalid corpus stays wrong in the same way, or is refused.
#include "files/files.h"
#include "tests/format/format_kit.h"

#include <glob.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/stat.h>

#include <cmocka.h>

static str read_file(struct arena *arena, const char *path) {
    struct files files;
    str text = STR("");
    files_init(&files, arena);
    if (files_read_given(&files, str_from(path), (uint64_t)1 << 26, arena, &text) != FILE_OK)
        fail_msg("cannot read %s", path);
    return text;
}

static unsigned each(const char *pattern, void (*visit)(const char *path, str text, unsigned *formatted),
                     unsigned *formatted) {
    glob_t found;
    unsigned count = 0;
    if (glob(pattern, 0, NULL, &found) != 0)
        return 0;
    for (size_t i = 0; i < found.gl_pathc; i++) {
        struct arena arena;
        struct stat info;
        if (stat(found.gl_pathv[i], &info) != 0 || !S_ISREG(info.st_mode))
            continue;
        arena_init(&arena, (size_t)1 << 27);
        visit(found.gl_pathv[i], read_file(&arena, found.gl_pathv[i]), formatted);
        arena_finish(&arena);
        count++;
    }
    globfree(&found);
    return count;
}

static void visit_scene(const char *path, str text, unsigned *formatted) {
    struct strbuf out;
    strbuf_init(&out);
    assert_formats(path, text, &out);
    if (!str_equal(text, strbuf_view(&out)))
        print_error("%s is not in canonical layout\n", path);
    else
        *formatted += 1;
    strbuf_finish(&out);
}

static void test_scenes(void **state) {
    static const char *const patterns[] = {"scenes/*.glint.yaml", "scenes/*.xml",        "scenes/*/*.yaml",
                                           "scenes/*/*.xml",      "scenes/*/*/*.yaml",   "scenes/*/*/*.xml",
                                           "scenes/*/*/*/*.xml",  "scenes/*/*/*/*.yaml", NULL};
    (void)state;
    unsigned count = 0, formatted = 0;
    for (int i = 0; patterns[i]; i++)
        count += each(patterns[i], visit_scene, &formatted);
    assert_true(count > 40);
    assert_int_equal(formatted, count);
}

static void visit_invalid(const char *path, str text, unsigned *formatted) {
    struct strbuf out;
    strbuf_init(&out);
    enum format_status status = format_text(path, text, NULL, &out);
    if (status == FORMAT_UNSAFE)
        fail_msg("%s: the layout was unsafe", path);
    assert_int_equal(out.len > 0, status == FORMAT_DONE);
    strbuf_clear(&out);
    if (status == FORMAT_DONE) {
        assert_formats(path, text, &out);
        *formatted += 1;
    }
    strbuf_finish(&out);
}

static void test_invalid_corpus(void **state) {
    (void)state;
    unsigned formatted = 0;
    unsigned count = each("tests/invalid/*/*.yaml", visit_invalid, &formatted) +
                     each("tests/invalid/*/*.xml", visit_invalid, &formatted);
    print_message("%u of %u files of the invalid corpus can be read to their end\n", formatted, count);
    assert_true(formatted > count / 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_scenes), cmocka_unit_test(test_invalid_corpus)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
