// What the formatter compares what it wrote with: it must see each difference that is more than white space.
#include "parser/format/format_internal.h"
#include "tests/format/format_kit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static bool same(const char *path, const char *text, const char *other) {
    struct reading a, b;
    struct tree tree, other_tree;
    reading_init(&a), reading_init(&b);
    assert_true(reading_run(&a, path, str_from(text), &tree));
    assert_true(reading_run(&b, path, str_from(other), &other_tree));
    bool result = format_same(&tree, str_from(text), &other_tree, str_from(other));
    reading_finish(&a), reading_finish(&b);
    return result;
}

static void test_layouts(void **state) {
    (void)state;
    assert_true(same("a.yaml", "glint: 1\nx-a: {b: 1}\n", "glint:   1\n\nx-a: {\n  b: 1 }"));
    assert_true(same("a.yaml", "# a\nglint: 1 #b\n# c\n", "# a\n\nglint: 1   #b\n  # c"));
    assert_true(same("a.yaml", "x-a: [1, # b\n  2]\n", "x-a: [1, # b\n2]\n"));
    assert_true(same("a.xml", "<Scene glint='1'><!-- a --><Light/></Scene>",
                     "<Scene\nglint='1'>\n  <!-- a -->\n  <Light />\n</Scene>"));
}

static void test_differences_of_yaml(void **state) {
    (void)state;
    static const char *const text = "# a\nglint: 1 # b\nx-a: [1, 2]\nx-b: {c: 'd'}\n# e\n";
    static const char *const others[] = {
        "# b\nglint: 1 # b\nx-a: [1, 2]\nx-b: {c: 'd'}\n# e\n",    // a comment before
        "# a\nglint: 1 # c\nx-a: [1, 2]\nx-b: {c: 'd'}\n# e\n",    // behind
        "# a\nglint: 1\nx-a: [1, 2] # b\nx-b: {c: 'd'}\n# e\n",    // elsewhere
        "# a\nglint: 1 # b\nx-a: [1, 2]\nx-b: {c: 'd'}\n# f\n",    // at the end
        "# a\nglint: 1 # b\nx-a: [1, 3]\nx-b: {c: 'd'}\n# e\n",    // a value
        "# a\nglint: 1 # b\nx-a: [1, 2, 3]\nx-b: {c: 'd'}\n# e\n", // one more
        "# a\nglint: 1 # b\nx-a: [1, ~]\nx-b: {c: 'd'}\n# e\n",    // none
        "# a\nglint: 1 # b\nx-a: [1, 2]\nx-c: {c: 'd'}\n# e\n",    // a key
        "# a\nglint: 1 # b\nx-a: [1, 2]\nx-b: {c: d}\n# e\n",      // quotes
        "# a\nglint: 1 # b\nx-a: [1, 2]\nx-b:\n  c: 'd'\n# e\n",   // brackets
        "# a\nglint: 1 # b\nx-a: [[1, 2]]\nx-b: {c: 'd'}\n# e\n",  // nesting
        "# a\nglint: 1 # b\nx-b: {c: 'd'}\nx-a: [1, 2]\n# e\n",    // order
        "# a\nglint: 1 # b\nx-a: [1, 2]\nx-b: {c: ' d '}\n# e\n",  // blanks in quotes
        "# a\nglint: 1 # b\nx-a: &x [1, 2]\nx-b: {c: 'd'}\n# e\n", // an anchor
    };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (same("a.yaml", text, others[i]))
            fail_msg("taken for the same:\n%s---\n%s", text, others[i]);
    assert_false(
        same("a.yaml", "# yaml-language-server: a\nglint: 1\n", "# yaml-language-server: b\nglint: 1\n"));
}

static void test_differences_of_xml(void **state) {
    (void)state;
    static const char *const text = "<Scene glint='1' xmlns:xsi='a'><Light/><!-- b --></Scene>";
    static const char *const others[] = {
        "<scene glint='1' xmlns:xsi='a'><Light/><!-- b --></scene>",         // the root's name
        "<Scene glint='1' xmlns:xsi='b'><Light/><!-- b --></Scene>",         // the schema's
        "<Scene glint='1' xmlns:xsi='a'><Light a=''/><!-- b --></Scene>",    // an attribute
        "<Scene glint='1' xmlns:xsi='a'><Camera/><!-- b --></Scene>",        // an element
        "<Scene glint='1' xmlns:xsi='a'><Light/></Scene><!-- b -->",         // behind the root
        "<Scene glint='1' xmlns:xsi='a'><Light/><Light/><!-- b --></Scene>", // one more
    };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (same("a.xml", text, others[i]))
            fail_msg("taken for the same:\n%s\n---\n%s", text, others[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_layouts),
        cmocka_unit_test(test_differences_of_yaml),
        cmocka_unit_test(test_differences_of_xml),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
