// The scenes that ship: twins mean the same, `convert` keeps what they mean, and together they use every row.
#include "tests/equal/equal_kit.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

// Which rows were written in some file, by element.
static uint64_t used[ELEMENTS_MAX];
static unsigned twin_count;
static bool twins_needed; // a scene that ships has both spellings

typedef void visit(const char *path);

static void each_file(const char *folder, visit *each) {
    DIR *directory = opendir(folder);
    if (!directory)
        fail_msg("cannot read the folder %s", folder);
    for (struct dirent *entry; (entry = readdir(directory));) {
        char path[1024];
        struct stat status;
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (entry->d_name[0] == '.' || stat(path, &status) != 0)
            continue;
        if (S_ISDIR(status.st_mode))
            each_file(path, each);
        else
            each(path);
    }
    closedir(directory);
}

// Loads the file that `convert` would write, and compares with what it was made from.
static void check_convert(const char *path, const struct loaded *loaded, bool xml) {
    struct strbuf text, again, dump, dump_again;
    struct loaded back;
    strbuf_init(&text), strbuf_init(&again), strbuf_init(&dump), strbuf_init(&dump_again);
    write_loaded(loaded, xml, &text);
    ir_dump(loaded->output.origin.files.items[0].scene, &dump);
    load_text(&back, xml ? "converted.xml" : "converted.yaml", strbuf_view(&text));
    assert_no_errors(&back, path);
    ir_dump(back.output.scene, &dump_again);
    assert_same_text(path, &dump, &dump_again);
    // What was written once is written the same again, comments included.
    write_loaded(&back, xml, &again);
    assert_same_text(path, &text, &again);
    loaded_finish(&back);
    strbuf_finish(&text), strbuf_finish(&again), strbuf_finish(&dump), strbuf_finish(&dump_again);
}

static void check_twins(const char *yaml_path) {
    char xml_path[1024];
    struct stat status;
    size_t length = strlen(yaml_path);
    if (length < 12 || strcmp(yaml_path + length - 11, ".glint.yaml") != 0)
        return;
    snprintf(xml_path, sizeof xml_path, "%.*s.xml", (int)(length - 5), yaml_path);
    if (stat(xml_path, &status) != 0 && !twins_needed)
        return;
    if (stat(xml_path, &status) != 0)
        fail_msg("%s has no twin", yaml_path);
    struct loaded yaml, xml;
    struct strbuf a, b;
    strbuf_init(&a), strbuf_init(&b);
    load_path(&yaml, yaml_path);
    load_path(&xml, xml_path);
    assert_no_errors(&yaml, yaml_path);
    assert_no_errors(&xml, xml_path);
    ir_dump(yaml.output.scene, &a);
    ir_dump(xml.output.scene, &b);
    assert_same_text(yaml_path, &a, &b);
    for (int to_xml = 0; to_xml < 2; to_xml++) {
        check_convert(yaml_path, &yaml, to_xml);
        check_convert(xml_path, &xml, to_xml);
    }
    for (uint32_t i = 0; i < yaml.output.origin.files.count; i++)
        note_written(&SCHEMA_SCENE, yaml.output.origin.files.items[i].scene, used);
    loaded_finish(&yaml), loaded_finish(&xml);
    strbuf_finish(&a), strbuf_finish(&b);
    twin_count++;
}

static void test_twins_are_equal(void **state) {
    (void)state;
    twins_needed = true;
    each_file("scenes", check_twins);
    twins_needed = false;
    assert_true(twin_count >= 3);
}

static void test_test_scenes_are_equal(void **state) {
    (void)state;
    uint64_t kept[ELEMENTS_MAX];
    memcpy(kept, used, sizeof kept);
    each_file("tests/scenes", check_twins);
    memcpy(used, kept, sizeof kept);
}

// Runs behind the tests above, which note what they see.
static void test_every_row_is_used(void **state) {
    (void)state;
    assert_all_written(used, "no file in scenes/ writes");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_twins_are_equal),
        cmocka_unit_test(test_test_scenes_are_equal),
        cmocka_unit_test(test_every_row_is_used),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
