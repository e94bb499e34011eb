// What the writers and the table's examples make is read back without an error; comments survive; values
// just outside a range are refused in both spellings.
#include "diag/codes/binding.h"
#include "grammar/emit/emit_words.h"
#include "grammar/emit/example.h"
#include "grammar/ir.h"
#include "grammar/ir_walk.h"
#include "tests/equal/equal_kit.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

// ---- examples

static void check_example(const struct schema_element *schema, bool xml) {
    struct strbuf text;
    struct loaded loaded;
    bool is_whole = schema == &SCHEMA_SCENE;
    strbuf_init(&text);
    if (!is_whole)
        strbuf_cstr(&text, xml ? "<Scene glint=\"1\">\n" : "glint: 1\n");
    if (xml)
        emit_xml_example(schema, &text);
    else
        emit_yaml_example(schema, &text);
    if (!is_whole && xml)
        strbuf_cstr(&text, "</Scene>\n");
    load_text(&loaded, xml ? "example.xml" : "example.yaml", strbuf_view(&text));
    assert_no_errors(&loaded, schema->name);
    loaded_finish(&loaded);
    strbuf_finish(&text);
}

static void test_examples_load(void **state) {
    (void)state;
    for (const struct schema_element *const *e = schema_elements; *e; e++) {
        check_example(*e, false);
        check_example(*e, true);
    }
}

// ---- ranges

// Puts `value` into the first component of the row.
static void set_number(const struct schema_row *row, void *element, double value) {
    void *field = schema_field(row, element);
    switch (row->kind) {
    case SCHEMA_INTEGER:
        *(int32_t *)field = (int32_t)value;
        break;
    case SCHEMA_NUMBER:
        *(double *)field = value;
        break;
    case SCHEMA_VECTOR:
        ((vec3 *)field)->x = value;
        break;
    case SCHEMA_PAIR:
        ((struct ir_pair *)field)->u = value;
        break;
    case SCHEMA_POINT:
        ((struct ir_point *)field)->x = value;
        break;
    case SCHEMA_QUAD:
        ((struct ir_quad *)field)->x = value;
        break;
    case SCHEMA_COLOR:
        ((struct ir_color *)field)->r = value;
        break;
    default:
        ((struct ir_weights *)field)->diffuse = value;
        break;
    }
}

// The element of this schema in an example scene.
static void *find_in(const struct schema_element *wanted, const struct schema_element *schema,
                     void *element) {
    if (schema == wanted)
        return element;
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (!ir_walk_written(schema, i, element) || !row->child || row->kind == SCHEMA_REFERENCE)
            continue;
        struct ir_any_list list = ir_walk_list(row, element);
        void *child = row->kind == SCHEMA_LIST ? list.items : schema_field(row, element);
        void *found = find_in(wanted, row->child, child);
        if (found)
            return found;
    }
    return NULL;
}

static void check_value(const struct schema_element *schema, uint32_t i, double value, bool xml) {
    const struct schema_row *row = &schema->rows[i];
    bool good = schema_in_range(row->range, value);
    diag_code wanted = row->range == SCHEMA_RANGE_VERSION ? DIAG_BAD_VERSION : DIAG_OUT_OF_RANGE;
    struct arena arena;
    struct strbuf text;
    struct loaded loaded;
    arena_init(&arena, (size_t)1 << 24);
    strbuf_init(&text);
    struct ir_scene *scene = example_scene(schema, &arena);
    void *element = find_in(schema, &SCHEMA_SCENE, scene);
    // The row, and nothing of its choice beside it.
    for (uint32_t k = 0; k < schema->row_count; k++)
        if (row->choice && schema->rows[k].choice == row->choice)
            ((struct ir_head *)element)->written &= ~(UINT64_C(1) << k);
    example_row(row, i, element, &arena);
    set_number(row, element, value);
    scene->head.written |= 1;
    scene->version = schema == &SCHEMA_SCENE ? scene->version : 1;
    if (xml)
        ir_write_xml(scene, NULL, NULL, (struct ir_write_options){0}, &text);
    else
        ir_write_yaml(scene, NULL, NULL, (struct ir_write_options){0}, &text);
    load_text(&loaded, xml ? "range.xml" : "range.yaml", strbuf_view(&text));
    unsigned reports = 0;
    for (uint32_t k = 0; k < loaded.sink.count; k++)
        reports += loaded.sink.items[k].code == wanted;
    if (reports != !good)
        fail_msg("%s.%s = %.17g in %s: %u reports of its range\n%s", schema->name, row->name, value,
                 xml ? "XML" : "YAML", reports, text.data);
    loaded_finish(&loaded);
    strbuf_finish(&text);
    arena_finish(&arena);
}

static double beside(const struct schema_row *row, double end, double direction) {
    return row->kind == SCHEMA_INTEGER ? end + direction : nextafter(end, direction * INFINITY);
}

static void test_ranges_are_kept(void **state) {
    (void)state;
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        for (uint32_t i = 0; i < (*e)->row_count; i++) {
            const struct schema_row *row = &(*e)->rows[i];
            const struct schema_range_info *info = schema_range_info(row->range);
            if (row->range == SCHEMA_RANGE_NONE)
                continue;
            for (int xml = 0; xml < 2; xml++) {
                check_value(*e, i, info->least, xml);
                check_value(*e, i, beside(row, info->least, -1), xml);
                check_value(*e, i, info->greatest, xml);
                check_value(*e, i, beside(row, info->greatest, 1), xml);
                if (info->least < info->greatest) {
                    check_value(*e, i, beside(row, info->least, 1), xml);
                    check_value(*e, i, beside(row, info->greatest, -1), xml);
                }
            }
        }
}

// ---- comments

// Loads `from`, writes it in the other spelling, and compares with `wanted`; and back.
static void check_spelling(const char *name, const char *from, const char *wanted, bool xml) {
    struct strbuf written, expected;
    struct loaded loaded;
    strbuf_init(&written), strbuf_init(&expected);
    strbuf_cstr(&expected, wanted);
    load_text(&loaded, xml ? "in.yaml" : "in.xml", str_from(from));
    assert_no_errors(&loaded, name);
    write_loaded(&loaded, xml, &written);
    assert_same_text(name, &expected, &written);
    loaded_finish(&loaded);
    strbuf_finish(&written), strbuf_finish(&expected);
}

static const char commented_yaml[] = "# yaml-language-server: $schema=https://example.org/glint.schema.json\n"
                                     "# A file -- with comments\n"
                                     "#\n"
                                     "## and --- dashes -\n"
                                     "glint: 1\n"
                                     "\n"
                                     "# The picture.\n"
                                     "image: {width: 10, height: 20}\n"
                                     "\n"
                                     "camera:\n"
                                     "  # Far away.\n"
                                     "  position: [0, 0, 99]\n"
                                     "  look_at: [0, 1, 0]\n"
                                     "\n"
                                     "lights:\n"
                                     "  # The first.\n"
                                     "  - {position: [1, 2, 3], intensity: 2}\n"
                                     "  - position: [4, 5, 6]\n"
                                     "    # Reddish.\n"
                                     "    color: [1, 0.5, 0.5]\n"
                                     "\n"
                                     "materials:\n"
                                     "  # Two lines,\n"
                                     "  # one comment.\n"
                                     "  glass: {albedo: [0, 1, 0, 0]}\n"
                                     "\n"
                                     "# The end.\n";
static const char commented_xml[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<?xml-model href=\"https://example.org/glint.rng\" type=\"application/xml\" "
    "schematypens=\"http://relaxng.org/ns/structure/1.0\"?>\n"
    "<!-- A file -\\- with comments -->\n"
    "<!-- -->\n"
    "<!--# and -\\-\\- dashes - -->\n"
    "<Scene glint=\"1\">\n"
    "  <!-- The picture. -->\n"
    "  <Image width=\"10\" height=\"20\"/>\n"
    "\n"
    "  <Camera>\n"
    "    <!-- Far away. -->\n"
    "    <Position x=\"0\" y=\"0\" z=\"99\"/>\n"
    "    <LookAt x=\"0\" y=\"1\" z=\"0\"/>\n"
    "  </Camera>\n"
    "\n"
    "  <!-- The first. -->\n"
    "  <Light intensity=\"2\"><Position x=\"1\" y=\"2\" z=\"3\"/></Light>\n"
    "  <Light>\n"
    "    <Position x=\"4\" y=\"5\" z=\"6\"/>\n"
    "    <!-- Reddish. -->\n"
    "    <Color r=\"1\" g=\"0.5\" b=\"0.5\"/>\n"
    "  </Light>\n"
    "\n"
    "  <!-- Two lines, -->\n"
    "  <!-- one comment. -->\n"
    "  <Material name=\"glass\"><Albedo specular=\"1\"/></Material>\n"
    "\n"
    "  <!-- The end. -->\n"
    "</Scene>\n";

static void test_comments_cross_over(void **state) {
    (void)state;
    check_spelling("comments from YAML to XML", commented_yaml, commented_xml, true);
    check_spelling("comments from XML to YAML", commented_xml, commented_yaml, false);
}

// Attributes have no room for comments of their own: they stand before the element, and stay there.
static void test_comments_of_attributes_move_up(void **state) {
    (void)state;
    check_spelling("comments inside",
                   "glint: 1\nspheres:\n  - center: [0, 0, 0]\n    # Large.\n    radius: 5\n",
                   "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Scene glint=\"1\">\n  <!-- Large. -->\n"
                   "  <Sphere radius=\"5\"><Center x=\"0\" y=\"0\" z=\"0\"/></Sphere>\n</Scene>\n",
                   true);
    check_spelling(
        "comments of several lines",
        "<Scene glint=\"1\">\n  <!-- One\n         deeper\n       level. -->\n  <Image/>\n</Scene>\n",
        "glint: 1\n\n# One\n#   deeper\n# level.\nimage: {}\n", false);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_examples_load),
        cmocka_unit_test(test_ranges_are_kept),
        cmocka_unit_test(test_comments_cross_over),
        cmocka_unit_test(test_comments_of_attributes_move_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
