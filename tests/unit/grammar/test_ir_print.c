// The writers on IR that was made by hand: quoting, layout, what is written and what is not.
#include "grammar/ir.h"
#include "grammar/ir_print_text.h"
#include "grammar/ir_walk.h"
#include "grammar/print/ir_print.h"
#include "grammar/print/ir_print_comment.h"
#include "grammar/schema.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

struct kit {
    struct arena arena;
    struct ir_scene scene;
    struct strbuf out;
};

static int set_up(void **state) {
    static struct kit kit;
    memset(&kit, 0, sizeof kit);
    arena_init(&kit.arena, 1 << 24);
    schema_init(&SCHEMA_SCENE, &kit.scene);
    kit.scene.version = 1;
    kit.scene.head.written = 1;
    strbuf_init(&kit.out);
    *state = &kit;
    return 0;
}

static int tear_down(void **state) {
    struct kit *kit = *state;
    strbuf_finish(&kit->out);
    arena_finish(&kit->arena);
    return 0;
}

static void wrote(const struct schema_element *schema, void *element, const char *row) {
    int i = schema_find_row(schema, str_from(row));
    assert_true(i >= 0);
    ((struct ir_head *)element)->written |= UINT64_C(1) << i;
}

static struct ir_material *add_material(struct kit *kit, const char *name) {
    struct ir_material *material = ARENA_PUSH(&kit->arena, &kit->scene.materials);
    schema_init(&SCHEMA_MATERIAL, material);
    material->name = str_from(name);
    return material;
}

static struct ir_sphere *add_sphere(struct kit *kit) {
    struct ir_sphere *sphere = ARENA_PUSH(&kit->arena, &kit->scene.spheres);
    schema_init(&SCHEMA_SPHERE, sphere);
    sphere->center = (vec3){0, 1, -2.5};
    sphere->radius = 2;
    wrote(&SCHEMA_SPHERE, sphere, "center");
    wrote(&SCHEMA_SPHERE, sphere, "radius");
    return sphere;
}

static void assert_dump(struct kit *kit, const char *wanted) {
    strbuf_clear(&kit->out);
    ir_dump(&kit->scene, &kit->out);
    assert_string_equal(kit->out.data, wanted);
}

static void assert_yaml(struct kit *kit, const char *wanted) {
    strbuf_clear(&kit->out);
    ir_write_yaml(&kit->scene, NULL, NULL, (struct ir_write_options){0}, &kit->out);
    assert_string_equal(kit->out.data, wanted);
}

static void assert_xml(struct kit *kit, const char *wanted) {
    static const char declaration[] = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    strbuf_clear(&kit->out);
    ir_write_xml(&kit->scene, NULL, NULL, (struct ir_write_options){0}, &kit->out);
    assert_memory_equal(kit->out.data, declaration, sizeof declaration - 1);
    assert_string_equal(kit->out.data + sizeof declaration - 1, wanted);
}

// ---- text

static void assert_yaml_text(struct kit *kit, const char *text, bool in_flow, const char *wanted) {
    strbuf_clear(&kit->out);
    print_yaml_text(&kit->out, str_from(text), in_flow);
    assert_string_equal(kit->out.data, wanted);
}

static void test_plain_text_stays_plain(void **state) {
    static const char *const texts[] = {"a",        "glass",      "Gold-2",  "_x",       "a b",   "./a.obj",
                                        "../b.obj", "meshes/a.b", "石",      "Größe",    "/a/b",  "e5",
                                        "yes-no",   "nothing",    "trueish", "infinity", "x (1)", "a+b"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        assert_yaml_text(*state, texts[i], true, texts[i]);
    assert_yaml_text(*state, "it's here, now; why? yes!", false, "it's here, now; why? yes!");
    assert_yaml_text(*state, "a, b", true, "\"a, b\"");
}

// What YAML 1.1 or 1.2 takes for something else than text.
static void test_other_text_is_quoted(void **state) {
    static const char *const texts[] = {
        "",    "NO",    "no",  "Yes",   "y",    "N",          "on", "OFF", "true", "False", "null", "NULL",
        "~",   "nan",   "Inf", ".nan",  ".inf", "-.inf",      "1",  "-1",  "+1",   "1.0",   "0x10", "0o17",
        "1e3", "1_000", ".5",  "12:30", "1:2",  "2026-11-21", "-",  "--",  "---",  "...",   "- a",  "? a",
        ": a", "a: b",  "a:",  "a #b",  "#a",   "*a",         "&a", "!a",  "%a",   "@a",    "`a",   "|",
        ">",   "<<",    "=",   "{a}",   "[a]",  "'a'",        " a", "a ",  "a\\b", "x-1:2", "a\"b",
    };
    struct kit *kit = *state;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        for (int in_flow = 0; in_flow < 2; in_flow++) {
            strbuf_clear(&kit->out);
            print_yaml_text(&kit->out, str_from(texts[i]), in_flow);
            if (kit->out.data[0] != '"')
                fail_msg("%s is written without quotes", texts[i]);
        }
}

static void test_escapes(void **state) {
    assert_yaml_text(*state, "a\nb\t\"c\"\\", true, "\"a\\nb\\t\\\"c\\\"\\\\\"");
    assert_yaml_text(*state, "\x01\x7F", true, "\"\\x01\\x7F\"");
    assert_yaml_text(*state, "a\xC2\x85\xE2\x80\xA8\xEF\xBB\xBF", true, "\"a\\x85\\u2028\\uFEFF\"");
    struct kit *kit = *state;
    strbuf_clear(&kit->out);
    print_xml_text(&kit->out, STR("<a> & \"b\"\n\t'c' \xC2\x85\xE7\x9F\xB3"));
    assert_string_equal(kit->out.data, "&lt;a&gt; &amp; &quot;b&quot;&#10;&#9;'c' &#133;\xE7\x9F\xB3");
}

static void test_literal_blocks(void **state) {
    struct kit *kit = *state;
    kit->scene.description = STR("one\n\n  two: #3\nlast");
    wrote(&SCHEMA_SCENE, &kit->scene, "description");
    assert_yaml(kit, "glint: 1\ndescription: |-\n  one\n\n    two: #3\n  last\n");
    assert_dump(kit, "glint: 1\ndescription: \"one\\n\\n  two: #3\\nlast\"\n");
    kit->scene.description = STR("one\ntwo\n");
    assert_yaml(kit, "glint: 1\ndescription: |\n  one\n  two\n");
    // Lines that a block would change are escaped.
    kit->scene.description = STR("one \ntwo");
    assert_yaml(kit, "glint: 1\ndescription: \"one \\ntwo\"\n");
    kit->scene.description = STR(" one\ntwo");
    assert_yaml(kit, "glint: 1\ndescription: \" one\\ntwo\"\n");
    kit->scene.description = STR("one\ntwo\n\n");
    assert_yaml(kit, "glint: 1\ndescription: \"one\\ntwo\\n\\n\"\n");
}

// ---- what is written

static void test_only_what_was_written(void **state) {
    struct kit *kit = *state;
    struct ir_sphere *sphere = add_sphere(kit);
    sphere->name = STR("unwritten");
    kit->scene.image.width = 7;
    assert_dump(kit, "glint: 1\nspheres:\n  - center: [0, 1, -2.5]\n    radius: 2\n");
    // The element is there, its rows are not.
    wrote(&SCHEMA_SCENE, &kit->scene, "image");
    assert_dump(kit, "glint: 1\nimage: {}\nspheres:\n  - center: [0, 1, -2.5]\n    radius: 2\n");
    assert_xml(kit, "<Scene glint=\"1\">\n  <Image/>\n\n"
                    "  <Sphere radius=\"2\"><Center x=\"0\" y=\"1\" z=\"-2.5\"/></Sphere>\n</Scene>\n");
    // Poison does not hide what was written.
    kit->scene.spheres.items[0].head.poisoned = ~UINT64_C(0);
    wrote(&SCHEMA_IMAGE, &kit->scene.image, "width");
    assert_dump(kit, "glint: 1\nimage:\n  width: 7\nspheres:\n  - center: [0, 1, -2.5]\n    radius: 2\n");
}

static void test_anonymous_materials_are_inlined(void **state) {
    struct kit *kit = *state;
    add_material(kit, "");
    add_material(kit, "used");
    kit->scene.materials.items[0].refractive_index = 1.5;
    wrote(&SCHEMA_MATERIAL, &kit->scene.materials.items[0], "refractive_index");
    struct ir_sphere *sphere = add_sphere(kit);
    sphere->material.index = 0;
    wrote(&SCHEMA_SPHERE, sphere, "material");
    sphere = add_sphere(kit);
    sphere->material = (struct ir_reference){STR("used"), 1};
    wrote(&SCHEMA_SPHERE, sphere, "material");
    assert_yaml(kit, "glint: 1\n\nmaterials:\n  used: {}\n\nspheres:\n"
                     "  - {center: [0, 1, -2.5], radius: 2, material: {refractive_index: 1.5}}\n"
                     "  - {center: [0, 1, -2.5], radius: 2, material: used}\n");
    assert_xml(kit, "<Scene glint=\"1\">\n  <Material name=\"used\"/>\n\n  <Sphere radius=\"2\">"
                    "<Center x=\"0\" y=\"1\" z=\"-2.5\"/><Material refractive_index=\"1.5\"/></Sphere>\n"
                    "  <Sphere radius=\"2\" material=\"used\"><Center x=\"0\" y=\"1\" z=\"-2.5\"/></Sphere>\n"
                    "</Scene>\n");
}

static void test_one_number_for_equal_components(void **state) {
    struct kit *kit = *state;
    struct ir_material *material = add_material(kit, "m");
    material->diffuse_color.color = (struct ir_color){.r = 0.5, .g = 0.5, .b = 0.5};
    material->specular_color.color = (struct ir_color){.r = 0.5, .g = 0.5, .b = 0.25};
    wrote(&SCHEMA_MATERIAL, material, "diffuse_color");
    wrote(&SCHEMA_PAINT, &material->diffuse_color, "color");
    wrote(&SCHEMA_MATERIAL, material, "specular_color");
    wrote(&SCHEMA_HIGHLIGHT, &material->specular_color, "color");
    assert_yaml(kit, "glint: 1\n\nmaterials:\n  m: {diffuse_color: 0.5, specular_color: [0.5, 0.5, 0.25]}\n");
    assert_xml(kit, "<Scene glint=\"1\">\n"
                    "  <Material name=\"m\" diffuse_color=\"0.5\"><SpecularColor r=\"0.5\" g=\"0.5\" "
                    "b=\"0.25\"/></Material>\n"
                    "</Scene>\n");
    material->specular_color.color = (struct ir_color){.is_hex = true, .hex = 0x00FFAA};
    assert_yaml(kit, "glint: 1\n\nmaterials:\n  m: {diffuse_color: 0.5, specular_color: \"#00ffaa\"}\n");
    assert_xml(
        kit,
        "<Scene glint=\"1\">\n  <Material name=\"m\" diffuse_color=\"0.5\" specular_color=\"#00ffaa\"/>\n"
        "</Scene>\n");
}

static void test_weights(void **state) {
    struct kit *kit = *state;
    struct ir_material *material = add_material(kit, "m");
    wrote(&SCHEMA_MATERIAL, material, "albedo");
    material->albedo = (struct ir_weights){0, 0, 0, 0};
    assert_xml(kit,
               "<Scene glint=\"1\">\n  <Material name=\"m\"><Albedo diffuse=\"0\"/></Material>\n</Scene>\n");
    material->albedo = (struct ir_weights){0, 10, 0, 1e20};
    assert_xml(
        kit,
        "<Scene glint=\"1\">\n"
        "  <Material name=\"m\"><Albedo specular=\"10\" refraction=\"1.0e+20\"/></Material>\n</Scene>\n");
    assert_dump(kit, "glint: 1\nmaterials:\n  m:\n    albedo: [0, 10, 0, 1.0e+20]\n");
}

static struct ir_camera *add_camera(struct kit *kit, const char *name) {
    struct ir_camera *camera = ARENA_PUSH(&kit->arena, &kit->scene.cameras);
    schema_init(&SCHEMA_CAMERA, camera);
    camera->name = str_from(name);
    return camera;
}

static void test_cameras(void **state) {
    struct kit *kit = *state;
    add_camera(kit, "main");
    assert_yaml(kit, "glint: 1\n\ncamera: {}\n");
    assert_dump(kit, "glint: 1\ncameras:\n  main: {}\n");
    assert_xml(kit, "<Scene glint=\"1\">\n  <Camera/>\n</Scene>\n");
    add_camera(kit, "no");
    assert_yaml(kit, "glint: 1\n\ncameras:\n  main: {}\n  \"no\": {}\n");
    assert_xml(kit, "<Scene glint=\"1\">\n  <Camera/>\n  <Camera name=\"no\"/>\n</Scene>\n");
    kit->scene.cameras.items++;
    kit->scene.cameras.count = 1;
    assert_yaml(kit, "glint: 1\n\ncameras:\n  \"no\": {}\n");
}

static void test_long_elements_take_lines(void **state) {
    struct kit *kit = *state;
    struct ir_sphere *sphere = add_sphere(kit);
    sphere->name = STR("a_name_that_is_so_long_that_no_line_of_braces_holds_it_together");
    wrote(&SCHEMA_SPHERE, sphere, "name");
    assert_yaml(
        kit,
        "glint: 1\n\nspheres:\n  - name: a_name_that_is_so_long_that_no_line_of_braces_holds_it_together\n"
        "    center: [0, 1, -2.5]\n    radius: 2\n");
    strbuf_clear(&kit->out);
    ir_write_xml(&kit->scene, NULL, NULL, (struct ir_write_options){.width = 60, .bare = true}, &kit->out);
    assert_string_equal(kit->out.data,
                        "<Sphere name=\"a_name_that_is_so_long_that_no_line_of_braces_holds_it_together\""
                        " radius=\"2\">\n  <Center x=\"0\" y=\"1\" z=\"-2.5\"/>\n</Sphere>\n");
}

static void test_includes(void **state) {
    struct kit *kit = *state;
    for (int i = 0; i < 2; i++) {
        struct ir_include *include = ARENA_PUSH(&kit->arena, &kit->scene.includes);
        include->file = i ? STR("b.xml") : STR("1.0");
        wrote(&SCHEMA_INCLUDE, include, "file");
    }
    assert_yaml(kit, "glint: 1\n\ninclude: [\"1.0\", b.xml]\n");
    assert_dump(kit, "glint: 1\ninclude:\n  - \"1.0\"\n  - b.xml\n");
    assert_xml(kit,
               "<Scene glint=\"1\">\n  <Include file=\"1.0\"/>\n  <Include file=\"b.xml\"/>\n</Scene>\n");
}

static void test_full_memory_is_told(void **state) {
    struct kit *kit = *state;
    struct strbuf small;
    add_sphere(kit);
    strbuf_init(&small);
    small.cap_bytes = 20;
    ir_write_yaml(&kit->scene, NULL, NULL, (struct ir_write_options){0}, &small);
    assert_true(small.failed);
    strbuf_finish(&small);
}

// ---- comments

struct commented {
    struct arena arena;
    struct source_set sources;
    struct ir_origin origin;
    struct print_places places;
};

static void set_comment(struct commented *c, const char *text, bool is_xml) {
    arena_init(&c->arena, 1 << 24);
    source_set_init(&c->sources, &c->arena);
    ir_origin_init(&c->origin, &c->arena);
    struct ir_file_origin *file = ARENA_PUSH(&c->arena, &c->origin.files);
    file->source = source_add(&c->sources, SOURCE_KIND_OVERLAY, STR("in"), str_from(text));
    file->is_xml = is_xml;
    c->places = (struct print_places){&c->origin, &c->sources, SPAN_NONE};
}

static void assert_comment(struct kit *kit, const char *text, const char *yaml, const char *xml) {
    bool is_xml = text[0] == '<';
    struct commented c;
    for (int to_xml = 0; to_xml < 2; to_xml++) {
        set_comment(&c, text, is_xml);
        span all = {c.origin.files.items[0].source, 0, (uint32_t)strlen(text)};
        strbuf_clear(&kit->out);
        (to_xml ? print_xml_comments : print_yaml_comments)(&c.places, all, 2, &kit->out);
        assert_string_equal(kit->out.data, to_xml ? xml : yaml);
        // The same place is written once.
        (to_xml ? print_xml_comments : print_yaml_comments)(&c.places, all, 2, &kit->out);
        assert_string_equal(kit->out.data, to_xml ? xml : yaml);
        arena_finish(&c.arena);
    }
}

static void test_comments(void **state) {
    assert_comment(*state, "# a", "  # a\n", "  <!-- a -->\n");
    assert_comment(*state, "#a", "  #a\n", "  <!--a-->\n");
    assert_comment(*state, "#", "  #\n", "  <!-- -->\n");
    assert_comment(*state, "# a\n  #   b", "  # a\n  #   b\n", "  <!-- a -->\n  <!--   b -->\n");
    assert_comment(*state, "# a\n\n# b", "  # a\n\n  # b\n", "  <!-- a -->\n\n  <!-- b -->\n");
    assert_comment(*state, "# a -- b --- c -\\- d-", "  # a -- b --- c -\\- d-\n",
                   "  <!-- a -\\- b -\\-\\- c -\\\\- d- -->\n");
    assert_comment(*state, "<!-- a -\\- b -\\-\\- c -\\\\- d- -->", "  # a -- b --- c -\\- d-\n",
                   "  <!-- a -\\- b -\\-\\- c -\\\\- d- -->\n");
    assert_comment(*state, "<!-- a -->\n\n<!--b--><!-- c -->", "  # a\n\n  #b\n  # c\n",
                   "  <!-- a -->\n\n  <!--b-->\n  <!-- c -->\n");
    assert_comment(*state, "<!--\n  a\n    b\n\n  c\n-->", "  # a\n  #   b\n  #\n  # c\n",
                   "  <!-- a -->\n  <!--   b -->\n  <!-- -->\n  <!-- c -->\n");
}

static void assert_schema_line(struct kit *kit, const char *text, bool is_xml, const char *yaml,
                               const char *xml) {
    struct commented c;
    set_comment(&c, text, is_xml);
    struct ir_file_origin *file = &c.origin.files.items[0];
    file->schema_line = (span){file->source, 0, (uint32_t)strlen(text)};
    strbuf_clear(&kit->out);
    print_yaml_schema_line(&c.places, file, &kit->out);
    assert_string_equal(kit->out.data, yaml);
    strbuf_clear(&kit->out);
    print_xml_schema_line(&c.places, file, &kit->out);
    assert_string_equal(kit->out.data, xml);
    arena_finish(&c.arena);
}

static void test_schema_lines(void **state) {
    static const char tail[] =
        "\" type=\"application/xml\" schematypens=\"http://relaxng.org/ns/structure/1.0\"?>\n";
    char xml[256];
    snprintf(xml, sizeof xml, "<?xml-model href=\"a/glint.rng%s", tail);
    assert_schema_line(*state, "# yaml-language-server: $schema=a/glint.schema.json", false,
                       "# yaml-language-server: $schema=a/glint.schema.json\n", xml);
    snprintf(xml, sizeof xml, "<?xml-model href=\"x.json?a&amp;b%s", tail);
    assert_schema_line(*state, "# yaml-language-server: $schema=x.json?a&b", false,
                       "# yaml-language-server: $schema=x.json?a&b\n", xml);
    assert_schema_line(*state, "<?xml-model type='x' href='a/glint.rng'?>", true,
                       "# yaml-language-server: $schema=a/glint.schema.json\n",
                       "<?xml-model type='x' href='a/glint.rng'?>\n");
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        TEST(test_plain_text_stays_plain),
        TEST(test_other_text_is_quoted),
        TEST(test_escapes),
        TEST(test_literal_blocks),
        TEST(test_only_what_was_written),
        TEST(test_anonymous_materials_are_inlined),
        TEST(test_one_number_for_equal_components),
        TEST(test_weights),
        TEST(test_cameras),
        TEST(test_long_elements_take_lines),
        TEST(test_includes),
        TEST(test_full_memory_is_told),
        TEST(test_comments),
        TEST(test_schema_lines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
