#include "reader_kit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const struct reader_kit_options xml = {.is_xml = true};

struct reading {
    const char *text, *tree, *errors;
};

static void check(struct reading reading) {
    struct reader_kit kit;
    reader_kit_read(&kit, str_from(reading.text), xml);
    if (strcmp(reader_kit_errors(&kit), reading.errors) != 0 ||
        strcmp(reader_kit_dump(&kit), reading.tree) != 0)
        print_message("in: %s\n", reading.text);
    assert_string_equal(reader_kit_errors(&kit), reading.errors);
    assert_string_equal(reader_kit_dump(&kit), reading.tree);
    reader_kit_finish(&kit);
}

#define CHECK_ALL(table)                                                                                     \
    for (size_t i = 0; i < sizeof(table) / sizeof *(table); i++)                                             \
    check((table)[i])

static void reads_elements(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"<Scene glint=\"1\"/>", "{glint: 1}", ""},
        {"<S a='1'><B c=\"2\"><D/></B><B/></S>", "{a: 1, B: {c: 2, D: {}}, B: {}}", ""},
        {"\xEF\xBB\xBF<?xml version=\"1.0\" encoding=\"utf-8\"?>\r\n<S\r\n a = \"x\ty\r\nz\"\r\n/>\r\n",
         "{a: x y z}", ""},
        {"<S a=\"&lt;&amp;&#233;&#x20AC;&quot;\" b='\"'/>", "{a: <&\xC3\xA9\xE2\x82\xAC\", b: \"}", ""},
        {"<S a=\"\"/>", "{a: }", ""},
        {"<S><!-- <x y=1 / > &no; --><?pi <z / > &no;?></S>", "{}", ""},
        {"<?xml version='1.0'?><?other pi?><S/>", "{}", ""},
    };
    CHECK_ALL(readings);
    struct reader_kit kit;
    reader_kit_read(&kit, STR("<S a=\"1\"><B/></S>"), xml);
    assert_true(str_equal(kit.tree.root_tag, STR("S")));
    assert_string_equal(reader_kit_place(&kit, kit.tree.root_name), "1:2-1:3");
    assert_int_equal(tree_node(&kit.tree, reader_kit_at(&kit, "a@"))->key, TREE_KEY_ATTRIBUTE);
    assert_int_equal(tree_node(&kit.tree, reader_kit_at(&kit, "B@"))->key, TREE_KEY_CHILD);
    assert_int_equal(tree_node(&kit.tree, reader_kit_at(&kit, "B"))->style, TREE_ELEMENT);
    reader_kit_finish(&kit);
}

static void places_are_bytes(void **state) {
    (void)state;
    struct reader_kit kit;
    reader_kit_read(&kit,
                    STR("\xEF\xBB\xBF<S  \xC3\xA9='\xC3\xA9&amp;\xF0\x9F\x98\x80' b = \"2\">\r\n"
                        "  <B\r\n\tc=\"3\"\r\n  ></B>\r\n</S>"),
                    xml);
    static const char *const places[][2] = {
        {"", "1:1-5:5"},     {"\xC3\xA9@", "1:5-1:6"}, {"\xC3\xA9", "1:8-1:15"},
        {"b@", "1:17-1:18"}, {"b", "1:22-1:23"},       {"B@", "2:4-2:5"},
        {"B", "2:3-4:8"},    {"B/c@", "3:2-3:3"},      {"B/c", "3:5-3:6"},
    };
    assert_string_equal(reader_kit_errors(&kit), "");
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        tree_index at = reader_kit_at(&kit, places[i][0]);
        assert_string_equal(reader_kit_place(&kit, tree_span(&kit.tree, at)), places[i][1]);
    }
    reader_kit_finish(&kit);
}

static void repairs_spaced_ends(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"<S>\n<T x=\"-4.15\" y=\"1\" / >\n<U/ >\n<V a=\"b\"/\n></S>",
         "{T: {x: -4.15, y: 1}, U: {}, V: {a: b}}",
         "E116 2:20-2:23 =safe>/><, E116 3:3-3:6 =safe>/><, E116 4:9-5:2 =safe>/><"},
        {"<S a=\"/ >\"><!-- / > --><B/></S>", "{a: / >, B: {}}", ""},
        {"<S><![CDATA[<b / >]]></S>", "{}!", "E115 1:4-1:22"},
    };
    CHECK_ALL(readings);
}

static void finds_attributes_given_twice(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"<S a=\"1\" b=\"2\"\n a='3' a=\"4\"><B a=\"5\"/></S>", "{a: 1, b: 2, B: {a: 5}}",
         "E110 2:2-2:3 (1:4-1:5), E110 2:8-2:9 (1:4-1:5)"},
    };
    CHECK_ALL(readings);
    struct reader_kit kit;
    reader_kit_read(&kit, STR("<S a=\"1\" a=\"2\"/>"), xml);
    assert_false(kit.tree.broken);
    reader_kit_finish(&kit);
}

static void refuses_entities(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"<S a=\"x&nbsp;y\" b=\"1\"/>", "{a: x      y!, b: 1}", "E112 1:8-1:14"},
        {"<S a=\"x & y\"/>", "{a: x   y!}", "E112 1:9-1:10 =safe>&amp;<"},
        {"<S a=\"a&b;c&\"/>", "{a: a   c !}", "E112 1:8-1:11, E112 1:12-1:13 =safe>&amp;<"},
        {"<S a=\"&#0;\" b=\"&#xD800;\" c=\"&#x110000;\" d=\"&#;\" e=\"&#x;\"/>",
         "{a:     !, b:         !, c:           !, d:    !, e:     !}",
         "E112 1:7-1:11, E112 1:16-1:24, E112 1:29-1:39, E112 1:44-1:47, E112 1:52-1:56"},
        {"<S>\n&foo;\n</S>", "{}", "E112 2:1-2:6"},
    };
    CHECK_ALL(readings);
    struct reader_kit kit;
    reader_kit_read(&kit, STR("<S a=\"&#127;\" b=\"&#9;\"/>"), xml);
    assert_string_equal(reader_kit_errors(&kit), "E104 1:7-1:13");
    assert_true(tree_node(&kit.tree, reader_kit_at(&kit, "a"))->flags & TREE_BAD);
    reader_kit_finish(&kit);
}

static void refuses_doctypes(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"<!DOCTYPE S>\n<S a=\"1\"/>", "{a: 1}", "E111 1:1-1:13 =safe><"},
        {"<!DOCTYPE S SYSTEM \"a>b.dtd\">\n<S a=\"1\"/>", "{a: 1}", "E111 1:1-1:30 =safe><"},
        {"<!DOCTYPE S [<!ENTITY a \"b\">]>\n<S a=\"&a;\"/>", "none", "E111 1:1-1:10"},
        {"<!-- c -->\n<!DOCTYPE S [\n<!ENTITY % a SYSTEM \"/etc/passwd\"> %a;]>\n<S/>", "none",
         "E111 2:1-2:10"},
        {"<!doctype S>\n<S/>", "none", "E111 1:1-1:10"},
    };
    CHECK_ALL(readings);
}

static void refuses_namespaces(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"<S xmlns=\"u\" a=\"1\"/>", "{a: 1}", "E113 1:4-1:9"},
        {"<g:S xmlns:g=\"u\"><g:B a=\"1\"/><h:C/></g:S>", "{B: {a: 1}, h:C!: {}!}",
         "E113 1:2-1:5, E113 1:6-1:13, E113 1:31-1:34"},
        {"<S g:a=\"1\" b=\"2\"/>", "{b: 2}", "E113 1:4-1:7"},
        {"<S><B xmlns:xsi=\"u\" xsi:schemaLocation=\"v\"/></S>", "{B: {}}", "E113 1:7-1:16, E113 1:21-1:39"},
        {"<S xml:base=\"x\"><B xml:space=\"preserve\"/></S>", "{B: {}}", "E114 1:4-1:12, E114 1:20-1:29"},
        {"<S xmlns:xi=\"http://www.w3.org/2001/XInclude\"><xi:include href=\"a\"/></S>",
         "{xi:include!: {href: a}!}", "E114 1:48-1:58"},
        {"<S xmlns:xi=\"http://www.w3.org/2001/XInclude\"/>", "{}", "E113 1:4-1:12"},
    };
    CHECK_ALL(readings);
    struct reader_kit kit;
    reader_kit_read(&kit,
                    STR("<?xml version=\"1.0\"?>\n<?xml-model href=\"glint.rng\"?>\n"
                        "<S xmlns:xsi=\"u\" a=\"1\"\n xsi:noNamespaceSchemaLocation = 'x.xsd'/>"),
                    xml);
    assert_string_equal(reader_kit_errors(&kit), "");
    assert_string_equal(reader_kit_dump(&kit), "{a: 1}");
    assert_true(
        str_equal(kit.tree.xsi_attributes, STR("xmlns:xsi=\"u\" xsi:noNamespaceSchemaLocation = 'x.xsd'")));
    assert_string_equal(reader_kit_source(&kit, kit.tree.schema_line), "<?xml-model href=\"glint.rng\"?>");
    reader_kit_finish(&kit);
}

static void refuses_text(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"<S>\n  0.9 0.1\n  x <B/> y\n</S>", "{B: {}}!", "E115 2:3-3:4, E115 3:10-3:11"},
        {"<S><A>1</A><B>&#65;&amp;</B></S>", "{A: {}!, B: {}!}", "E115 1:7-1:8, E115 1:15-1:25"},
        {"<S>a<![CDATA[ b ]]>c<!-- --> d</S>", "{}!", "E115 1:4-1:21, E115 1:30-1:31"},
        {"<S>\n<![CDATA[ x ]]>\n</S>", "{}!", "E115 2:1-2:16"},
        {"<S> \t\r\n </S>", "{}", ""},
    };
    CHECK_ALL(readings);
}

static void checks_encodings(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?><S a=\"\xFC\"/>", "{a: _!}", "E117 1:31-1:41"},
        {"<?xml version=\"1.0\" encoding='UTF-16'?><S a=\"1\"/>", "{a: 1}", "E117 1:31-1:37"},
        {"<S a=\"\xFC\" b=\"1\"/>\n<!-- \xFC -->", "{a: _!, b: 1}", "E103 1:7-1:8 (-)"},
        {"<S a=\"\x01\" b=\"\x7F\"/>", "{a:  !, b:  !}", "E104 1:7-1:8 (-)"},
        {"<S\x01 a=\"1\"/>", "{a: 1}", "E104 1:3-1:4"},
    };
    CHECK_ALL(readings);
    struct reader_kit kit;
    reader_kit_read(&kit, STR("<S a=\"x\0y\"/>"), xml);
    assert_string_equal(reader_kit_errors(&kit), "E104 1:8-1:9");
    reader_kit_finish(&kit);
    reader_kit_read(&kit, STR("\xFE\xFF\0<\0S\0/\0>"), xml);
    assert_string_equal(reader_kit_errors(&kit), "E103 1:1-1:2");
    reader_kit_finish(&kit);
}

static void explains_what_expat_refuses(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"<S>\n  <A x=\"1\"y=\"2\"/>\n</S>", "{}?", "E102 2:11-2:12 =safe> <"},
        {"<S>\n  <A x=1/>\n</S>", "{}?", "E102 2:8-2:9 =safe>\"1\"<"},
        {"<S>\n  <A smooth/>\n</S>", "{}?", "E102 2:6-2:12"},
        {"<S>\n  <A x=\"1/>\n  <B y=\"2\"/>\n</S>", "{}?", "E102 2:6-2:7"},
        {"<S>\n  <A x=\"1\"\n  <B y=\"2\"/>\n</S>", "{}?", "E102 2:4-2:5 (3:3-3:4)"},
        {"<S>\n  <A x=\"1\">\n</S>", "{A: {x: 1}?}?", "E102 3:3-3:4 (2:4-2:5)"},
        {"<S>\n  <A x=\"1\">\n", "{A: {x: 1}?}?", "E102 2:4-2:5"},
        {"<S>\n  <A x=\"1\"/\n", "{}?", "E102 2:11-2:12"},
        {"<S>\n  <!-- a -- b -->\n</S>", "{}?", "E102 2:12-2:13"},
        {"<S>\n  <!-- a\n</S>", "{}?", "E102 2:3-2:7"},
        {"<S>\n  <?pi\n</S>", "{}?", "E102 2:3-2:5"},
        {"<S>\n  < A/>\n</S>", "{}?", "E102 2:3-2:4"},
        {"<S>]]></S>", "{}?", "E102 1:4-1:7"},
        {"<S/>\n<B/>", "{}", "E102 2:1-2:2 (1:4-1:5)"},
        {"<S/>\nmore", "{}", "E102 2:1-2:2 (1:4-1:5)"},
        {"more <S/>", "none", "E102 1:1-1:5"},
        {"\n<?xml version=\"1.0\"?><S/>", "none", "E102 2:1-2:6"},
        {"<?xml encoding=\"UTF-8\"?><S/>", "none", "E102 1:7-1:8"},
        {"<S a=\"1", "none", "E102 1:4-1:5"},
        {"<S", "none", "E102 1:2-1:3"},
        {"<S><A/></S x=\"1\">", "{A: {}}?", "E102 1:12-1:13"},
        {"<S></T>", "{}?", "E102 1:6-1:7 (1:2-1:3)"},
        {"", "none", "E105 1:1-1:1"},
        {" \n", "none", "E105 1:1-1:1"},
        {"<!-- nothing -->", "none", "E105 1:1-1:1"},
    };
    CHECK_ALL(readings);
    struct reader_kit kit;
    reader_kit_read(&kit, STR("<S a=\"1\"><A b=\"2\"/><B"), xml);
    assert_true(kit.readable && kit.tree.broken);
    reader_kit_finish(&kit);
}

static void keeps_comments(void **state) {
    (void)state;
    static const char text[] =
        "<?xml version=\"1.0\"?>\n<!-- head -->\n\n<!-- more -->\n<S glint=\"1\"> <!-- first -->\n"
        "  <!-- a1 -->\n\n  <!-- a2 --><A/> <!-- ta -->\n"
        "  <B x=\"1\"> <!-- tb -->\n    <!-- c --><C/>\n    <!-- end of b -->\n  </B>\n"
        "  <!-- closing -->\n</S>\n<!-- very end -->\n";
    static const char *const leading[][2] = {
        {"glint@", "<!-- head -->\n\n<!-- more -->"},
        {"A@", "<!-- first -->\n  <!-- a1 -->\n\n  <!-- a2 -->"},
        {"B/C@", "<!-- c -->"},
    };
    static const char *const trailing[][2] = {
        {"A@", "<!-- ta -->"},
        {"B@", "<!-- tb -->"},
        {"B/C@", "<!-- end of b -->"},
    };
    struct reader_kit kit;
    reader_kit_read(&kit, str_from(text), xml);
    assert_string_equal(reader_kit_errors(&kit), "");
    for (size_t i = 0; i < sizeof leading / sizeof *leading; i++) {
        tree_index at = reader_kit_at(&kit, leading[i][0]);
        assert_string_equal(reader_kit_source(&kit, tree_comments(&kit.tree, at)), leading[i][1]);
        at = reader_kit_at(&kit, trailing[i][0]);
        assert_string_equal(reader_kit_source(&kit, tree_trailing_comment(&kit.tree, at)), trailing[i][1]);
    }
    assert_string_equal(reader_kit_source(&kit, kit.tree.closing_comments),
                        "<!-- closing -->\n</S>\n<!-- very end -->");
    reader_kit_finish(&kit);
}

static str repeated(const char *before, const char *piece, size_t count, const char *after) {
    size_t head = strlen(before), size = strlen(piece), tail = strlen(after);
    char *text = malloc(head + size * count + tail);
    assert_non_null(text);
    memcpy(text, before, head);
    for (size_t i = 0; i < count; i++)
        memcpy(text + head + i * size, piece, size);
    memcpy(text + head + size * count, after, tail);
    return (str){text, head + size * count + tail};
}

static void keeps_limits(void **state) {
    (void)state;
    static const struct {
        const char *before, *piece;
        size_t count;
        const char *after, *errors;
        size_t nodes;
    } cases[] = {
        {"", "<a>", 100000, "", "E501 1:194-1:195", 0},
        {"<S a=\"", "x", 100000, "\"/>", "E501 1:7-1:8", 0},
        {"<S a=\"", "x", 65536, "\"/>", "", 0},
        {"<", "x", 100000, "/>", "E501 1:2-1:3", 0},
        {"<S ", "x", 100000, "=\"1\"/>", "E501 1:4-1:5", 0},
        {"<S>", "<B/>", 20, "</S>", "E501 1:32-1:36", 16},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct limits limits = limits_default();
        if (cases[i].nodes)
            limits.value[LIMIT_SCENE_NODES] = cases[i].nodes;
        str text = repeated(cases[i].before, cases[i].piece, cases[i].count, cases[i].after);
        struct reader_kit kit;
        reader_kit_read(&kit, text, (struct reader_kit_options){.is_xml = true, .limits = &limits});
        assert_string_equal(reader_kit_errors(&kit), cases[i].errors);
        assert_int_equal(kit.tree.broken, cases[i].errors[0] != '\0');
        reader_kit_finish(&kit);
        free((char *)text.ptr);
    }
}

static const char sample[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<?xml-model href=\"x\"?>\n<!-- head -->\n"
    "<Scene glint=\"1\" xmlns:xsi=\"u\" xsi:schemaLocation=\"v\">\n  <Light><Position x=\"-20\" y=\"20\" "
    "z='20' / ></Light>"
    " <!-- \xC3\xA4 -->\n  <Material name=\"gl&#228;s &amp; co\">\n    <Albedo diffuse=\"1\" "
    "diffuse=\"2\"/>\n  </Material>\n"
    "  <![CDATA[ text ]]>\n  <xi:include href=\"&no;\"/>\n</Scene>\n<!-- end -->\n";

static void survives_every_prefix(void **state) {
    (void)state;
    for (size_t n = 0; n < sizeof sample; n++) {
        struct reader_kit kit;
        reader_kit_read(&kit, (str){sample, n}, xml);
        reader_kit_dump(&kit);
        assert_true(kit.readable || kit.sink.errors > 0);
        reader_kit_finish(&kit);
    }
}

static void survives_corruption(void **state) {
    (void)state;
    static const char with[] = "\0<>&/\"' !:]-\xC3";
    for (size_t at = 0; at + 1 < sizeof sample; at++)
        for (size_t i = 0; i + 1 < sizeof with; i++) {
            char text[sizeof sample];
            memcpy(text, sample, sizeof sample);
            text[at] = with[i];
            struct reader_kit kit;
            reader_kit_read(&kit, (str){text, sizeof sample - 1}, xml);
            reader_kit_dump(&kit);
            assert_true(kit.readable || kit.sink.errors > 0);
            reader_kit_finish(&kit);
        }
}

// Wherever the memory ends, the jump arrives at the guard, leaves expat in order and loses nothing.
static void survives_little_memory(void **state) {
    (void)state;
    bool whole = false;
    for (size_t bytes = 16; !whole; bytes += 48) {
        struct reader_kit kit;
        reader_kit_read(&kit, (str){sample, sizeof sample - 1},
                        (struct reader_kit_options){.is_xml = true, .memory_bytes = bytes});
        whole = kit.fault == ARENA_FAULT_NONE;
        assert_true(whole ? kit.readable : kit.fault == ARENA_FAULT_CAP);
        reader_kit_finish(&kit);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_elements),         cmocka_unit_test(places_are_bytes),
        cmocka_unit_test(repairs_spaced_ends),    cmocka_unit_test(finds_attributes_given_twice),
        cmocka_unit_test(refuses_entities),       cmocka_unit_test(refuses_doctypes),
        cmocka_unit_test(refuses_namespaces),     cmocka_unit_test(refuses_text),
        cmocka_unit_test(checks_encodings),       cmocka_unit_test(explains_what_expat_refuses),
        cmocka_unit_test(keeps_comments),         cmocka_unit_test(keeps_limits),
        cmocka_unit_test(survives_every_prefix),  cmocka_unit_test(survives_corruption),
        cmocka_unit_test(survives_little_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
