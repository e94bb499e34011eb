// The table of mesh formats: what is asked of it agrees, and every row can be told from the others.
#include "grammar/mesh_format.h"
#include "grammar/schema.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static void test_endings_find_their_format(void **state) {
    (void)state;
    uint32_t count = 0;
    for (enum mesh_format_id id = 0; id < MESH_FORMAT_COUNT; id++) {
        assert_non_null(mesh_formats[id].endings[0]);
        for (const char *const *ending = mesh_formats[id].endings; *ending; ending++, count++) {
            char path[64];
            assert_int_equal((*ending)[0], '.');
            snprintf(path, sizeof path, "in/a.b%s", *ending);
            assert_int_equal(mesh_format_of_path(str_from(path)), id);
            assert_true(schema_file_fits(SCHEMA_FILE_MESH, str_from(path)));
            for (char *c = path; *c; c++)
                *c = *c >= 'a' && *c <= 'z' ? (char)(*c - 'a' + 'A') : *c;
            assert_int_equal(mesh_format_of_path(str_from(path)), id);
            assert_string_equal(schema_file_endings(SCHEMA_FILE_MESH)[count], *ending);
        }
    }
    assert_null(schema_file_endings(SCHEMA_FILE_MESH)[count]);
    assert_int_equal(mesh_format_of_path(STR("scene.yaml")), MESH_FORMAT_COUNT);
    assert_int_equal(mesh_format_of_path(STR("obj")), MESH_FORMAT_COUNT);
    assert_int_equal(mesh_format_of_path(STR("")), MESH_FORMAT_COUNT);
}

static void test_beginnings_find_their_format(void **state) {
    (void)state;
    for (enum mesh_format_id id = 0; id < MESH_FORMAT_COUNT; id++)
        for (const char *const *magic = mesh_formats[id].magic; *magic; magic++) {
            assert_int_equal(mesh_format_of_text(str_from(*magic)), id);
            assert_int_equal(mesh_format_of_text((str){*magic, strlen(*magic) - 1}), MESH_FORMAT_COUNT);
        }
    assert_int_equal(mesh_format_of_text(STR("glint: 1\n")), MESH_FORMAT_COUNT);
    assert_int_equal(mesh_format_of_text(STR("")), MESH_FORMAT_COUNT);
}

static void test_words_name_all(void **state) {
    (void)state;
    struct arena arena;
    arena_init(&arena, 1 << 20);
    const str words = mesh_format_words(&arena);
    char text[1024];
    snprintf(text, sizeof text, "%.*s", STR_ARG(words));
    for (enum mesh_format_id id = 0; id < MESH_FORMAT_COUNT; id++) {
        assert_non_null(strstr(text, mesh_formats[id].name));
        assert_non_null(strstr(mesh_formats[id].called, mesh_formats[id].name));
        for (const char *const *ending = mesh_formats[id].endings; *ending; ending++)
            assert_non_null(strstr(text, *ending));
    }
    arena_finish(&arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_endings_find_their_format),
        cmocka_unit_test(test_beginnings_find_their_format),
        cmocka_unit_test(test_words_name_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
