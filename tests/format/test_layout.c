// What the formatter makes of texts, one by one; docs/format.md says why.
#include "tests/format/format_kit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static void check(const char *path, const char *text, const char *expected) {
    struct strbuf out;
    strbuf_init(&out);
    assert_formats(path, str_from(text), &out);
    assert_string_equal(out.data, expected);
    strbuf_finish(&out);
}

static void yaml(const char *text, const char *expected) {
    check("case.yaml", text, expected);
}

static void xml(const char *text, const char *expected) {
    check("case.xml", text, expected);
}

static void test_yaml_blanks(void **state) {
    (void)state;
    yaml("glint:   1\n", "glint: 1\n");
    yaml("glint : 1   \nimage:  { width : 3,height: 4 , samples:   1}\n",
         "glint: 1\nimage: {width: 3, height: 4, samples: 1}\n");
    yaml("glint: 1\ncamera:\n      position: [ 0,1 ,2 ]\n      fov:\n         60\n",
         "glint: 1\ncamera:\n  position: [0, 1, 2]\n  fov: 60\n");
    yaml("glint: 1\nlights:\n- position: [1,2,3]\n  intensity: 2\n-   { position: [1,2,3] }\n",
         "glint: 1\nlights:\n  - position: [1, 2, 3]\n    intensity: 2\n  - {position: [1, 2, 3]}\n");
    yaml("glint: 1\nlights:\n    -\n        position: [1, 2, 3]\n",
         "glint: 1\nlights:\n  - position: [1, 2, 3]\n");
    yaml("{\"glint\":1,\"image\":{\"width\":3}}", "{\"glint\": 1, \"image\": {\"width\": 3}}");
    yaml("glint: 1\nx-a: {b: , c: }\n", "glint: 1\nx-a: {b: , c: }\n");
    yaml("glint: 1\nx-a:\n-\n- &x\n- b\n", "glint: 1\nx-a:\n  -\n  - &x\n  - b\n");
    // Blanks behind the last line end may be the last line of a block text.
    yaml("glint: 1\ndescription: |\n  x\n  \t", "glint: 1\ndescription: |\n  x\n  \t");
    yaml("glint: 1\ndescription: |\n  x \n  ", "glint: 1\ndescription: |\n  x \n");
    yaml("glint: 1\ndescription: |\n x\n  \n ", "glint: 1\ndescription: |\n  x\n   \n");
    yaml("glint: 1\nx-a: 1\n  ", "glint: 1\nx-a: 1\n");
}

static void test_yaml_lines_in_brackets(void **state) {
    (void)state;
    yaml("glint: 1\nimage: {\n width: 3,\n height: 4}\n",
         "glint: 1\nimage: {\n    width: 3,\n    height: 4}\n");
    yaml("glint: 1\nimage: {\n width: 3, samples: 1,\n height: 4\n}\n",
         "glint: 1\nimage: {\n    width: 3, samples: 1,\n    height: 4\n  }\n");
    yaml("glint: 1\nx-m: [[1, 0],\n [0, 1]\n , [2, 2]]\n",
         "glint: 1\nx-m: [[1, 0],\n      [0, 1],\n      [2, 2]]\n");
    yaml("{\n\"glint\": 1,\n\"image\": {\n\"width\": 3\n}\n}\n",
         "{\n  \"glint\": 1,\n  \"image\": {\n    \"width\": 3\n  }\n}\n");
}

static void test_yaml_comments(void **state) {
    (void)state;
    yaml("\n\n# first\n\n\n\n\nglint: 1 # version\nimage: {width: 3}#no\n",
         "# first\n\n\nglint: 1  # version\nimage: {width: 3}  #no\n");
    yaml("glint: 1\ncamera:\n   # where\n   position: [0, 0, 1]\n      # off\n   fov: 3\n",
         "glint: 1\ncamera:\n  # where\n  position: [0, 0, 1]\n  # off\n  fov: 3\n");
    yaml("glint: 1\nlights:\n    - {}\n    # none left\n# materials\nmaterials:\n    # none\nmodels:\n# x\n",
         "glint: 1\nlights:\n  - {}\n  # none left\n# materials\nmaterials:\n  # none\nmodels:\n# x\n");
    // Comments in one column stay in one column.
    yaml("glint: 1        # a\nimage:          # b\n  width: 3      # c\n  height: 4 # d\n",
         "glint: 1    # a\nimage:      # b\n  width: 3  # c\n  height: 4  # d\n");
    yaml("glint: 1\ncamera:\n  position: [0, # x\n   1, 2] # y\n",
         "glint: 1\ncamera:\n  position: [0,  # x\n             1, 2]  # y\n");
    // What stood indented does not become the mark of a document or of a merge conflict.
    yaml(" glint: 1\n --- a: 1\n", "  glint: 1\n  --- a: 1\n");
    yaml(" glint: 1\n --- : 1\n <<<<<<< : 2\n", "glint: 1\n---: 1\n<<<<<<<: 2\n");
    yaml(" glint: 1\n ... a: {\n --- b: 1}\n", "  glint: 1\n  ... a: {\n      --- b: 1}\n");
    yaml(" glint: 1\n # c\n <<<<<<< a: 1\n", "  glint: 1\n  # c\n  <<<<<<< a: 1\n");
    yaml("glint: 1\nx-m: {!!null : 1, &a : 2}\nx-n:\n  !!null : 1\n",
         "glint: 1\nx-m: {!!null : 1, &a : 2}\nx-n:\n  !!null : 1\n");
    yaml("glint: 1\nx-m: {a, ?\nb, c} # c\n", "glint: 1\nx-m: {a, ?\n        b, c}  # c\n");
    yaml("glint: 1\nx-m: {? a\n: , b} # c\n", "glint: 1\nx-m: {? a: ,\n      b}  # c\n");
    yaml("glint: 1\nx-m: {? a\n: 1, b} # c\n", "glint: 1\nx-m: {? a:\n        1, b}  # c\n");
    yaml("glint: 1\nx-m: {? a # c\n: 1, b} # d\n", "glint: 1\nx-m: {? a  # c\n      : 1, b}  # d\n");
    yaml("glint: 1\nx-m: {?a : 1, ?b:: , ? c::: 2}\n", "glint: 1\nx-m: {? a: 1, ? b:: , ? c::: 2}\n");
    // Behind an anchor or a comma that begins its line.
    yaml("glint: 1\nx-m:\n   &a # c\n b: 1\n", "glint: 1\nx-m:\n  &a  # c\n  b: 1\n");
    yaml("glint: 1\nx-m:\n   &a\n b: 1\n", "glint: 1\nx-m: &a\n  b: 1\n");
    yaml("glint: 1\nx-m: {a\n,# c\n b: 2}\n", "glint: 1\nx-m: {a\n      ,  # c\n      b: 2}\n");
    yaml("glint: 1\nx-a:\n &b {c: 1}# d\n", "glint: 1\nx-a:\n  &b {c: 1}  # d\n");
}

static void test_yaml_texts(void **state) {
    (void)state;
    yaml("glint: 1\ndescription: |\n      one\n        two\n\n      three   \nimage: {}\n",
         "glint: 1\ndescription: |\n  one\n    two\n\n  three   \nimage: {}\n");
    yaml("glint: 1\ndescription: >2-   # folded\n     one\n    two\n",
         "glint: 1\ndescription: >2-  # folded\n     one\n    two\n");
    yaml("glint: 1\ndescription: |+\n one\n\n\n\n\nimage: {}\n",
         "glint: 1\ndescription: |+\n  one\n\n\n\n\nimage: {}\n");
    yaml("glint: 1\ndescription: |+\n one\n\n\n", "glint: 1\ndescription: |+\n  one\n\n\n");
    yaml("glint: 1\ndescription: \"one  \n\n     two\\\n\n   \\  three\"\n",
         "glint: 1\ndescription: \"one  \n\n  two\\\n\n  \\  three\"\n");
    yaml("glint: 1\ndescription: one\n         two\nimage: {}\n",
         "glint: 1\ndescription: one\n  two\nimage: {}\n");
    yaml("glint: 1\ndescription: 'it''s  so'\n", "glint: 1\ndescription: 'it''s  so'\n");
}

static void test_yaml_anchors(void **state) {
    (void)state;
    yaml("glint: 1\nx-a:    &a {b: 1}\nx-b:   &b\n     c: 1\nx-c: {<<: *a, d:   *b}\nx-d:\n- *a\n-  <<:  "
         "*a\n   e: 1\n",
         "glint: 1\nx-a: &a {b: 1}\nx-b: &b\n  c: 1\nx-c: {<<: *a, d: *b}\nx-d:\n  - *a\n  - <<: *a\n    e: "
         "1\n");
    yaml("glint: 1\nx-a: &k name\nx-b: {*k : 1}\nx-c:\n   *k :   2\n",
         "glint: 1\nx-a: &k name\nx-b: {*k : 1}\nx-c:\n  *k : 2\n");
    yaml("glint: 1\nx-a: !!map {b:   !x 1}\n", "glint: 1\nx-a: !!map {b: !x 1}\n");
}

static void test_yaml_documents(void **state) {
    (void)state;
    yaml("%YAML 1.1\n---   # begins\nglint: 1\n...\n", "%YAML 1.1\n---  # begins\nglint: 1\n...\n");
    yaml("--- {glint:  1}\n", "--- {glint: 1}\n");
    yaml("? glint\n: 1\n? image\n:   width: 3\n", "? glint\n: 1\n? image\n:\n  width: 3\n");
}

static void test_xml(void **state) {
    (void)state;
    xml("<Scene   glint = '1' ><Image  width=\"3\"\n  height=\"4\" / ></Scene>\n",
        "<Scene glint='1'>\n  <Image width=\"3\" height=\"4\"/>\n</Scene>\n");
    xml("<?xml version='1.0'?><Scene glint=\"1\">\n<Light>\n<Position x='1' y='2' z='3' "
        "/></Light>\n\n\n\n\n<Light></Light"
        " ></Scene>",
        "<?xml version='1.0'?>\n<Scene glint=\"1\">\n  <Light>\n    <Position x='1' y='2' z='3'/>\n  "
        "</Light>\n\n\n"
        "  <Light></Light>\n</Scene>");
    xml("<!-- one\n     two -->\n  <Scene glint=\"1\"> <!-- a --> <!-- b -->\n      <!-- three\n           "
        "four\n"
        "tabs -->\n      <Light/>   <!-- l -->\n</Scene>\n<!-- end -->\n",
        "<!-- one\n     two -->\n<Scene glint=\"1\"> <!-- a --> <!-- b -->\n  <!-- three\n       four\ntabs "
        "-->\n"
        "  <Light/> <!-- l -->\n</Scene>\n<!-- end -->\n");
    // Lines of a comment that are indented by tabs stay.
    xml("   <!-- one\n <<<<<<< two -->\n<Scene glint=\"1\"/>\n",
        "<!-- one\n <<<<<<< two -->\n<Scene glint=\"1\"/>\n");
    xml("<Scene glint=\"1\">\n<!-- one\n\ttwo -->\n<Light/> <!-- l\n \tm -->\n</Scene>\n",
        "<Scene glint=\"1\">\n  <!-- one\n\ttwo -->\n  <Light/> <!-- l\n \tm -->\n</Scene>\n");
}

static void test_xml_long_tags(void **state) {
    (void)state;
    xml("<Scene glint=\"1\">\n<Model name=\"a_rather_long_name_of_a_model\" "
        "mesh=\"somewhere/in/a/folder/there/is/a/mesh.obj\" material=\"something\" "
        "smooth=\"true\"/>\n</Scene>\n",
        "<Scene glint=\"1\">\n  <Model name=\"a_rather_long_name_of_a_model\" "
        "mesh=\"somewhere/in/a/folder/there/is/a/mesh.obj\"\n         material=\"something\" "
        "smooth=\"true\"/>\n"
        "</Scene>\n");
    xml("<Scene glint=\"1\">\n<Sphere radius=\"1\" material=\"a_material_with_a_long_name\"><Center "
        "x=\"1.000001\" "
        "y=\"2.000002\" z=\"3.000003\"/></Sphere>\n</Scene>\n",
        "<Scene glint=\"1\">\n  <Sphere radius=\"1\" material=\"a_material_with_a_long_name\">\n"
        "    <Center x=\"1.000001\" y=\"2.000002\" z=\"3.000003\"/>\n  </Sphere>\n</Scene>\n");
}

static void test_line_ends(void **state) {
    (void)state;
    yaml("\xEF\xBB\xBFglint:  1\r\nimage: {}  # x\r\n", "\xEF\xBB\xBFglint: 1\r\nimage: {}  # x\r\n");
    yaml("glint:  1\rimage: {}", "glint: 1\rimage: {}");
    xml("<Scene glint=\"1\" description=\"a\r\n  b\">\r\n<Light/>\r\n</Scene>",
        "<Scene glint=\"1\" description=\"a\r\n  b\">\r\n  <Light/>\r\n</Scene>");
    // An attribute fits or not, whichever line ends it has.
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    struct strbuf text;
    strbuf_init(&text);
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        strbuf_clear(&text);
        strbuf_cstr(&text, "<Scene glint=\"1\" x-a=\"b\" description=\"");
        for (int k = 0; k < 40; k++)
            strbuf_cstr(&text, ends[i]);
        strbuf_cstr(&text, "c\"></Scene>");
        xml(text.data, text.data);
    }
    strbuf_finish(&text);
}

#define LS  "\xE2\x80\xA8"
#define NEL "\xC2\x85"

// In YAML these end lines, too; LS (and PS) belongs to a text.
static void test_yaml_separators(void **state) {
    (void)state;
    // The column of a comment is counted from them.
    yaml("glint: 1\nx-a:\n" LS "# c\nx-b: 1\n", "glint: 1\nx-a:\n\n# c\nx-b: 1\n");
    yaml("glint: 1\nx-a:\n    b:" NEL "    # c\n", "glint: 1\nx-a:\n  b:\n  # c\n");
    yaml("glint: 1 # a" LS "x-a: 1    # b\nx-b: 10   # c\n", "glint: 1  # a\nx-a: 1   # b\nx-b: 10  # c\n");
    yaml("glint: 1\nx-a: #123456" NEL, "glint: 1\nx-a:  #123456\n"); // an unquoted colour before and after
    // A text that keeps its last lines gets no further one.
    yaml("glint: 1\nx-a: |+\n a\n" LS "x-b: 1\n", "glint: 1\nx-a: |+\n  a\n  " LS "x-b: 1\n");
    yaml("glint: 1\nx-a: |+\n a\n" LS "# c\nx-b: 1\n", "glint: 1\nx-a: |+\n  a\n  " LS "# c\nx-b: 1\n");
    yaml("glint: 1\nx-a: |+\n a" LS "\nx-b: 1\n", "glint: 1\nx-a: |+\n  a" LS "\nx-b: 1\n");
    yaml("glint: 1\nx-a: |+\n a\n" LS " ", "glint: 1\nx-a: |+\n  a\n  " LS);
    yaml("glint: 1\nx-a: |\n a\n" LS "x-b: 1\n", "glint: 1\nx-a: |\n  a\n\nx-b: 1\n");
    // Lines of other texts after them are indented like others.
    yaml("glint: 1\nx-a:\n- b" LS " c\n", "glint: 1\nx-a:\n  - b" LS "    c\n");
    yaml("glint: 1\nx-a: [b" NEL "c]\n", "glint: 1\nx-a: [b\n      c]\n");
    yaml("glint: 1\nx-a: {---" NEL "0}\n", "  glint: 1\n  x-a: {---\n        0}\n");
}

static void test_refused(void **state) {
    static const char *const yaml_texts[] = {"glint: [1\n",
                                             "glint: 1\n\timage: {}\n",
                                             "glint: 1\n---\nglint: 1\n",
                                             "glint: 1\nimage: {a: #123456}\n",
                                             "",
                                             "- 1\n",
                                             "glint: 1\nx-a: *b\n- 2\n",
                                             "glint: 1\nx-a: \x01\n",
                                             "glint: 1\nx-a: b\xEF\xBB\xBF\n",
                                             "glint: 1 # \xFF\n",
                                             "glint: 1\n<<<<<<< a\nx-a: 1\n=======\nx-a: 2\n>>>>>>> b\n"};
    static const char *const xml_texts[] = {"<Scene glint=\"1\">", "<Scene glint=1/>", "text",
                                            "<Scene/><Scene/>", "<Scene glint=\"1\"><!-- \x7F --></Scene>"};
    (void)state;
    struct strbuf out;
    strbuf_init(&out);
    for (size_t i = 0; i < sizeof yaml_texts / sizeof *yaml_texts; i++)
        assert_int_equal(format_text("a.yaml", str_from(yaml_texts[i]), NULL, &out), FORMAT_REFUSED);
    for (size_t i = 0; i < sizeof xml_texts / sizeof *xml_texts; i++)
        assert_int_equal(format_text("a.xml", str_from(xml_texts[i]), NULL, &out), FORMAT_REFUSED);
    assert_int_equal(out.len, 0);
    strbuf_finish(&out);
}

// ---- versions: a second table, as it may be one day

static const struct upgrade_rule rules[] = {
    {0, &SCHEMA_SCENE, "view", "camera", "View", "Camera", NULL, NULL},
    {0, &SCHEMA_CAMERA, "angle", "lens", NULL, NULL, NULL, NULL},
    {1, &SCHEMA_CAMERA, "lens", "fov", NULL, NULL, NULL, NULL},
    {1, &SCHEMA_SCENE, "balls", "spheres", "Ball", "Sphere", NULL, NULL},
    {1, &SCHEMA_SPHERE, "size", "radius", NULL, NULL, NULL, NULL},
    {1, &SCHEMA_SPHERE, "middle", "center", "Middle", "Center", NULL, NULL},
    {0, &SCHEMA_IMAGE, "tone", "tone", NULL, NULL, "cut", "clip"},
    {1, &SCHEMA_MATERIAL, "color", "diffuse_color", "Color", "DiffuseColor", NULL, NULL},
};
static const struct upgrade_table table = {2, rules, sizeof rules / sizeof *rules};

static void check_upgrade(const char *path, const char *text, const char *expected) {
    struct strbuf out;
    strbuf_init(&out);
    assert_int_equal(format_text(path, str_from(text), &table, &out), FORMAT_DONE);
    assert_string_equal(out.data, expected);
    strbuf_finish(&out);
}

static void test_upgrade(void **state) {
    (void)state;
    check_upgrade(
        "a.yaml",
        "glint: 0  # old\nview: {angle: 40}\nimage: {tone: cut}\nx-size: &s\n  size: 2\nballs:\n"
        "  # size\n  - {size: 1, middle: [0, 0, 0], material: {color: 1}}\n  - {<<: *s}\n",
        "glint: 2  # old\ncamera: {fov: 40}\nimage: {tone: clip}\nx-size: &s\n  radius: 2\nspheres:\n"
        "  # size\n  - {radius: 1, center: [0, 0, 0], material: {diffuse_color: 1}}\n  - {<<: *s}\n");
    check_upgrade("a.yaml",
                  "glint: 1\nview: {angle: 40}\ncamera: {lens: 3}\nmaterials:\n  color: {color: 1}\n",
                  "glint: 2\nview: {angle: 40}\ncamera: {fov: 3}\nmaterials:\n  color: {diffuse_color: 1}\n");
    check_upgrade(
        "a.xml",
        "<Scene glint='0'><View angle='40'></View ><Ball size='1'><Middle x='0' y='0' z='0'/></Ball></Scene>",
        "<Scene glint='2'><Camera fov='40'></Camera><Sphere radius='1'><Center x='0' y='0' z='0'/></Sphere>"
        "</Scene>");
    // Of today's version, of none and of one to come nothing is replaced.
    check_upgrade("a.yaml", "glint: 2\nballs: []\n", "glint: 2\nballs: []\n");
    check_upgrade("a.yaml", "balls: []\n", "balls: []\n");
    check_upgrade("a.yaml", "glint: 3\nballs: []\n", "glint: 3\nballs: []\n");
}

static void test_upgrade_of_version_one(void **state) {
    (void)state;
    struct strbuf out;
    strbuf_init(&out);
    const char *text = "glint: 1\nview: {angle: 40}\nballs: []\n";
    assert_int_equal(format_text("a.yaml", str_from(text), &UPGRADE_STANDARD, &out), FORMAT_DONE);
    assert_string_equal(out.data, text);
    strbuf_finish(&out);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_yaml_blanks),
        cmocka_unit_test(test_yaml_lines_in_brackets),
        cmocka_unit_test(test_yaml_comments),
        cmocka_unit_test(test_yaml_texts),
        cmocka_unit_test(test_yaml_anchors),
        cmocka_unit_test(test_yaml_documents),
        cmocka_unit_test(test_xml),
        cmocka_unit_test(test_xml_long_tags),
        cmocka_unit_test(test_line_ends),
        cmocka_unit_test(test_yaml_separators),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_upgrade),
        cmocka_unit_test(test_upgrade_of_version_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
