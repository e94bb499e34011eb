#include "reader_kit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const struct reader_kit_options yaml = {0};

// A text, its tree and its diagnostics.
struct reading {
    const char *text, *tree, *errors;
};

static void check(struct reading reading, struct reader_kit_options options) {
    struct reader_kit kit;
    reader_kit_read(&kit, str_from(reading.text), options);
    if (strcmp(reader_kit_errors(&kit), reading.errors) != 0 ||
        strcmp(reader_kit_dump(&kit), reading.tree) != 0)
        print_message("in: %s\n", reading.text);
    assert_string_equal(reader_kit_errors(&kit), reading.errors);
    assert_string_equal(reader_kit_dump(&kit), reading.tree);
    reader_kit_finish(&kit);
}

#define CHECK_ALL(table, options)                                                                            \
    for (size_t i = 0; i < sizeof(table) / sizeof *(table); i++)                                             \
    check((table)[i], options)

static void reads_values(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"a: 1\nb: two\nc: \"3\"\nd: '4'\n", "{a: 1, b: two, c: \"3\", d: \"4\"}", ""},
        {"a: |\n  x\n  y\nb: >-\n  p\n  q\n", "{a: \"x\ny\n\", b: \"p q\"}", ""},
        {"a: [1, [2, 3], {b: 4}]\n", "{a: [1, [2, 3], {b: 4}]}", ""},
        {"a:\n- 1\n- b: 2\n  c: 3\n-\n  - 4\n", "{a: [1, {b: 2, c: 3}, [4]]}", ""},
        {"a: [b: 1, c]\n", "{a: [{b: 1}, c]}", ""},
        {"{\"a\":1,\"b\":[true,null,\"\\u00e9\\/\"],\"c\":{}}",
         "{\"a\": 1, \"b\": [true, ~, \"\xC3\xA9/\"], \"c\": {}}", ""},
        {"%YAML 1.2\n---\na: 1\n...\n", "{a: 1}", ""},
        {"\xEF\xBB\xBF"
         "a: 1\r\nb: 2\r\n",
         "{a: 1, b: 2}", ""},
        {"a: NO\nb: yes\nc: 010\n", "{a: NO, b: yes, c: 010}", ""},
        {"? a\n: 1\n", "{a: 1}", ""},
        {"x-home: &h {a: 1}\nb: *h\n", "{x-home: {a: 1}, b: {a: 1}}", ""},
    };
    CHECK_ALL(readings, yaml);
}

static void knows_nulls(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"a:\nb: ~\nc: null\nd: Null\ne: \"null\"\nf: ''\n",
         "{a: ~, b: ~, c: ~, d: Null, e: \"null\", f: \"\"}", ""},
        {"a: [~, , 1]\n", "{a: [~]?}?", "E101 1:8-1:9"},
        {"a:\n  -\n  - 1\n", "{a: [~, 1]}", ""},
        {"{a, b: , c: 1}\n", "{a: ~, b: ~, c: 1}", ""},
        {"null: 1\n~: 2\n", "{null: 1, ~: 2}", ""},
    };
    CHECK_ALL(readings, yaml);
}

static void places_are_bytes(void **state) {
    (void)state;
    struct reader_kit kit;
    reader_kit_read(&kit,
                    STR("\xEF\xBB\xBF# \xC3\xA4\r\n\xC3\xA4\xE2\x82\xAC: &x  'w\xF0\x9F\x98\x80'  # t\r\n"
                        "b:\r\n  - [ \xC3\xB6, 2 ]\r\n  - {c: |\r\n    text\r\n\r\nd: 1\r\n"),
                    yaml);
    assert_string_equal(
        reader_kit_place(&kit, tree_span(&kit.tree, reader_kit_at(&kit, "\xC3\xA4\xE2\x82\xAC@"))),
        "2:1-2:3");
    assert_string_equal(
        reader_kit_place(&kit, tree_span(&kit.tree, reader_kit_at(&kit, "\xC3\xA4\xE2\x82\xAC"))),
        "2:9-2:13");
    assert_string_equal(reader_kit_place(&kit, tree_span(&kit.tree, reader_kit_at(&kit, "b/0"))), "4:5-4:13");
    assert_string_equal(reader_kit_place(&kit, tree_span(&kit.tree, reader_kit_at(&kit, "b/0/0"))),
                        "4:7-4:8");
    assert_string_equal(
        reader_kit_source(&kit, tree_comments(&kit.tree, reader_kit_at(&kit, "\xC3\xA4\xE2\x82\xAC@"))),
        "# \xC3\xA4");
    // '|' means nothing inside brackets.
    assert_string_equal(reader_kit_errors(&kit), "E101 5:9-5:10");
    assert_true(kit.tree.broken);
    reader_kit_finish(&kit);
}

static void spans_are_exact(void **state) {
    (void)state;
    struct reader_kit kit;
    reader_kit_read(&kit,
                    STR("top: &a !!map\n  k: !!str &b \"v\"\n  m:\n    - 1\n    - two words\n\n"
                        "text: |\n  one\n\n  two\n\n\nflow: &c [1,\n 2]\nempty:\nlast: x\n"),
                    yaml);
    static const char *const places[][2] = {
        {"", "1:1-16:8"},        {"top", "2:3-5:16"},  {"top/k", "2:15-2:18"}, {"top/m", "4:5-5:16"},
        {"top/m/1", "5:7-5:16"}, {"text", "7:7-10:6"}, {"flow", "13:10-14:4"}, {"empty", "15:7-15:7"},
    };
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        tree_index at = reader_kit_at(&kit, places[i][0]);
        assert_string_equal(reader_kit_place(&kit, tree_span(&kit.tree, at)), places[i][1]);
    }
    assert_string_equal(reader_kit_place(&kit, kit.tree.root_name), "1:1-1:4");
    reader_kit_finish(&kit);
}

static void expands_aliases(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"a: &x 1\nb: *x\na2: &x 2\nc: *x\n", "{a: 1, b: 1, a2: 2, c: 2}", ""},
        {"a: &x {p: [1, {q: 2}]}\nb: [*x, *x]\n",
         "{a: {p: [1, {q: 2}]}, b: [{p: [1, {q: 2}]}, {p: [1, {q: 2}]}]}", ""},
        {"a: &x\nb: *x\n", "{a: ~, b: ~}", ""},
        {"&k a: 1\nb: *k\n", "{a: 1, b: a}", ""},
        {"m: &m\n  &k a: 1\nb: *k\nc: *m\n", "{m: {a: 1}, b: a, c: {a: 1}}", ""},
        {"a: &glass 1\nb: *glas\n", "{a: 1, b: ~!}", "E108 2:4-2:9 =maybe>glass<"},
        {"b: *later\na: &later 1\n", "{b: ~!, a: 1}", "E108 1:4-1:10"},
        {"a: &x [1, *x]\n", "{a: [1, ~!]}", "E124 1:11-1:13 (1:4-1:6)"},
        {"a: &x {b: {c: *x}}\n", "{a: {b: {c: ~!}}}", "E124 1:15-1:17 (1:4-1:6)"},
    };
    CHECK_ALL(readings, yaml);
}

static void merges_maps(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"a: &x {p: 1, q: 2}\nb: {<<: *x, r: 3}\n", "{a: {p: 1, q: 2}, b: {p+: 1, q+: 2, r: 3}}", ""},
        {"a: &x {p: 1, q: 2}\nb: {<<: *x, q: 3}\nc: {q: 3, <<: *x}\n",
         "{a: {p: 1, q: 2}, b: {p+: 1, q: 3}, c: {q: 3, p+: 1}}", ""},
        {"a: &x {p: 1}\nb: &y {p: 2, q: 2}\nc: {<<: [*x, *y]}\n",
         "{a: {p: 1}, b: {p: 2, q: 2}, c: {p+: 1, q+: 2}}", ""},
        {"a: &x {p: 1}\nb: &y {<<: *x, q: 2}\nc: {<<: *y, p: 3}\n",
         "{a: {p: 1}, b: {p+: 1, q: 2}, c: {q+: 2, p: 3}}", ""},
        {"c: {<<: {p: 1}, '<<': 2}\n", "{c: {p+: 1, \"<<\": 2}}", ""},
        {"a: &x {}\nb: {<<: *x}\n", "{a: {}, b: {}}", ""},
        // What is merged where it is anchored stays what the anchor names.
        {"a: {<<: &x {p: 1}, q: 2}\nb: *x\n", "{a: {p+: 1, q: 2}, b: {p: 1}}", ""},
        {"a: {<<: [&x {p: 1}, {r: 3}], q: 2}\nb: *x\n", "{a: {p+: 1, r+: 3, q: 2}, b: {p: 1}}", ""},
        {"a: {<<: &x [{p: 1}, {p: 2, r: 3}], q: 2}\nb: *x\n",
         "{a: {p+: 1, r+: 3, q: 2}, b: [{p: 1}, {p: 2, r: 3}]}", ""},
        {"b: {<<: 5}\n", "{b: {}?}", "E118 1:9-1:10"},
        {"a: &x [1]\nb: {<<: *x, c: 1}\n", "{a: [1], b: {c: 1}?}", "E118 2:5-2:7"},
        {"b: {<<: *x}\n", "{b: {}?}", "E108 1:9-1:11"},
    };
    CHECK_ALL(readings, yaml);
}

static void reads_the_first_of_two_versions(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"a: 1\n<<<<<<< x\nb: 2\n=======\nb: 3\n>>>>>>> y\nc: 4\n", "{a: 1, b: 2, c: 4}",
         "E125 2:1-2:8 (4:1-4:8) (6:1-6:8)"},
        {"a: 1\r<<<<<<< x\rb: 2\r=======\rb: 3\r>>>>>>> y\rc: 4\r", "{a: 1, b: 2, c: 4}",
         "E125 2:1-2:8 (4:1-4:8) (6:1-6:8)"},
        {"a: 1\r\n<<<<<<< x\r\nb: 2\r\n", "{a: 1, b: 2}", "E125 2:1-2:8"},
    };
    CHECK_ALL(readings, yaml);
}

static void finds_keys_given_twice(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"a: 1\nb: 2\na: 3\n", "{a: 1, b: 2}", "E109 3:1-3:2 (1:1-1:2)"},
        {"a: 1\n\"a\": 3\na: 4\n", "{a: 1}", "E109 2:1-2:4 (1:1-1:2), E109 3:1-3:2 (1:1-1:2)"},
        {"c: {a: 1, a: 2}\n", "{c: {a: 1}}", "E109 1:11-1:12 (1:5-1:6)"},
        // What both hold is checked, and reported once.
        {"m: {a: 1}\nm: {b: 2, a: 3}\n", "{m: {a: 1, b: 2}}", "E109 2:1-2:2 (1:1-1:2)"},
        {"l: [{a: 1}]\nl: [{b: 2}]\n", "{l: [{a: 1}, {b: 2}]}", "E109 2:1-2:2 (1:1-1:2)"},
        {"a: &x {p: 1}\na: {q: 2}\nb: *x\n", "{a: {p: 1}, b: {p: 1}}", "E109 2:1-2:2 (1:1-1:2)"},
        {"v: [1, 2]\nv: [3, 4]\n", "{v: [1, 2]}", "E109 2:1-2:2 (1:1-1:2)"},
        {"m: {}\nm: {b: 2}\nl: []\nl: [1]\n", "{m: {b: 2}, l: [1]}",
         "E109 2:1-2:2 (1:1-1:2), E109 4:1-4:2 (3:1-3:2)"},
    };
    CHECK_ALL(readings, yaml);
}

static void refuses_strange_keys(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"[a, b]: 1\nc: 2\n", "{c: 2}", "E119 1:1-1:7"},
        {"? {a: 1}\n: 2\nc: 3\n", "{c: 3}", "E119 1:3-1:9"},
        {"? - a\n: 2\nc: 3\n", "{c: 3}", "E119 1:3-1:6"},
        {"a: &x b\n*x : 1\nc: 2\n", "{a: b, c: 2}", "E119 2:1-2:3"},
        {"? \n: 1\na: 2\n", "{a: 2}", "E119 1:2-1:2"},
    };
    CHECK_ALL(readings, yaml);
}

static void refuses_tags(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"a: !!float 1\nb: 2\n", "{a: 1, b: 2}", "E107 1:4-1:11 =safe><"},
        {"a: !include x.yaml\n", "{a: x.yaml!}", "E107 1:4-1:12 =safe><"},
        {"a: &x !t {b: 1}\n", "{a: {b: 1}!}", "E107 1:7-1:9 =safe><"},
        {"a: !t &x 1\n", "{a: 1!}", "E107 1:4-1:6 =safe><"},
        {"!scene\na: 1\n", "{a: 1}", "E107 1:1-1:7 =safe><"},
        {"a: !no!such 1\nb: !<bad 2\nc: 3\n", "{a: 1!, b: 2!, c: 3}", "E107 1:4-1:12, E107 2:4-2:9"},
    };
    CHECK_ALL(readings, yaml);
}

static void finds_lost_colors(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"a: #aabbcc\nb: 1\n", "{a: ~!, b: 1}", "E120 1:4-1:11 =safe>\"#aabbcc\"<"},
        {"a: #abc  # blue\n", "{a: ~!}", "E120 1:4-1:8 =safe>\"#abc\"<"},
        {"a:\n  - #AABBCC\n  - 1\n", "{a: [~!, 1]}", "E120 2:5-2:12 =safe>\"#AABBCC\"<"},
        {"a: [#aabbcc, #ddeeff]\nb: 1\n", "{a: [xaabbcc!, xddeeff!], b: 1}",
         "E120 1:5-1:12 =safe>\"#aabbcc\"<, E120 1:14-1:21 =safe>\"#ddeeff\"<"},
        {"a: {b: #aabbcc}\nc: 1\n", "{a: {b: xaabbcc!}, c: 1}", "E120 1:8-1:15 =safe>\"#aabbcc\"<"},
        {"a: {b: #aabbcc\n}\nc: 1\n", "{a: {b: ~!}, c: 1}", "E120 1:8-1:15 =safe>\"#aabbcc\"<"},
        {"a: [\n  #aabbcc\n]\nc: 1\n", "{a: []!, c: 1}", "E120 2:3-2:10 =safe>\"#aabbcc\"<"},
        {"a: [\"[#aabbcc]\", 1\nb: 2\n", "{a: [\"[#aabbcc]\", 1 b!]?}?", "E101 2:2-2:3 (1:4-1:5)"},
        // Comments all the same.
        {"a: # aabbcc\nb: #aabbccd\nc: 1 #aabbcc\n", "{a: ~, b: ~, c: 1}", ""},
        {"m: #facade\n  a: 1\n", "{m: {a: 1}}", ""},
    };
    CHECK_ALL(readings, yaml);
}

static void finds_tabs(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"a:\n\tb: 1\n\tc: 2\nd: 3\n", "{a: {b: 1, c: 2}, d: 3}", "E123 2:1-2:2 (-) =safe>  b: 1\n  <"},
        {"a:\n  b: 1\n\tc: 2\n", "{a: {b: 1}?}?", "E123 3:1-3:2 =safe>  <"},
        {"a:\n  -\tb: 1\n", "{a: [{b: 1}]}", "E123 2:4-2:5 =safe>  <"},
        {"a: {\n\tb: 1\n}\n", "{a: {b: 1}}", ""},
        {"a:\t1\nb: 2\t# c\n", "{a: 1, b: 2}", ""},
    };
    CHECK_ALL(readings, yaml);
}

static void refuses_documents(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"a: 1\n---\nb: 2\n", "{a: 1}", "E106 2:1-2:4"},
        {"a: 1\n...\nb: 2\n", "{a: 1}", "E106 3:1-3:3"},
        {"---\na: 1\n...\n---\nb: 2\n", "{a: 1}", "E106 4:1-4:4"},
        {"", "none", "E105 1:1-1:1"},
        {"# only\n\n# comments\n", "none", "E105 1:1-1:1"},
        {"---\n...\n", "none", "E105 1:1-1:1"},
        {"~\n", "none", "E105 1:1-1:1"},
        {"- a\n- b\n", "none", "E201 1:1-1:2"},
        {"just words\n", "none", "E201 1:1-1:11"},
    };
    CHECK_ALL(readings, yaml);
    struct reader_kit kit;
    reader_kit_read(&kit, STR("a: 1\n---\nb: 2\n"), yaml);
    assert_true(kit.readable && !kit.tree.broken);
    reader_kit_finish(&kit);
}

static void explains_what_libyaml_refuses(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"a: b: c\n", "{a: b!}?", "E101 1:5-1:6"},
        {"a: 1\n  b: 2\n", "{a: 1 b!}?", "E101 2:3-2:4"},
        {"a: 1\nb\nc: 2\n", "{a: 1}?", "E101 2:1-2:2"},
        {"a:\n  b: 2\n c: 3\n", "{a: {b: 2}?}?", "E101 3:2-3:3 (1:1-1:2)"},
        {"a:\n  - 1\n  b: 2\n", "{a: [1]?}?", "E101 3:3-3:4 (2:3-2:4)"},
        {"a: - 1\n", "{}?", "E101 1:4-1:5"},
        {"a: [1, 2\nb: 3\n", "{a: [1, 2 b!]?}?", "E101 2:2-2:3 (1:4-1:5)"},
        {"a: [1, {b: 2\n", "{a: [1, {b: 2}?]?}?", "E101 1:8-1:9"},
        {"a: [1, 2\n# end\n", "{a: [1, 2]?}?", "E101 1:4-1:5"},
        {"a: [\n", "{a: []?}?", "E101 1:4-1:5"},
        {"a: {b: 1\n", "{a: {b: 1}?}?", "E101 1:4-1:5"},
        {"a: \"x\nb: 3\n", "{}?", "E101 1:4-1:5"},
        {"a: 1\nb: 'x\n", "{a: 1}?", "E101 2:4-2:5"},
        {"a: \"\\q\"\n", "{}?", "E101 1:5-1:6 (1:4-1:5)"},
        {"a: @x\n", "{}?", "E101 1:4-1:5"},
        {"a: *.obj\n", "{}?", "E101 1:4-1:5"},
        {"a: > b\n", "{}?", "E101 1:4-1:5"},
        {"a: \"b\" c\n", "{a: \"b\"!}?", "E101 1:8-1:9"},
        {"a: 'it's'\n", "{a: \"it\"!}?", "E101 1:8-1:10"},
        {"a: [1, 2] 3\n", "{a: [1, 2]}?", "E101 1:11-1:12"},
        {"%YAML 9.9\n---\na: 1\n", "none", "E101 1:1-1:2"},
    };
    CHECK_ALL(readings, yaml);
}

static void checks_bytes(void **state) {
    (void)state;
    static const struct reading readings[] = {
        {"a: 1\nb: \xFF\nc: x\xC3(\nd: 1\n", "{a: 1, b: _!, c: x_(!, d: 1}", "E103 2:4-2:5 (-)"},
        {"a: 1\n# \xE4\nb: 2\n", "{a: 1, b: 2}", "E103 2:3-2:4"},
        {"a: 1\nb: x\x01y\n", "{a: 1, b: x y!}", "E104 2:5-2:6"},
        {"a: \x7F\xC2\x80\n", "{a: ~!}", "E104 1:4-1:5 (-)"},
        {"a: {b: \x01}\n", "{a: {b: ~!}}", "E104 1:8-1:9"},
        {"a: x\xEF\xBB\xBFy\n", "{a: x   y!}", "E104 1:5-1:6"},
        {"a: \xC2\x85"
         "b: 2\n",
         "{a: ~, b: 2}", ""},
    };
    CHECK_ALL(readings, yaml);
    struct reader_kit kit;
    reader_kit_read(&kit, STR("a: \"x\\0y\"\nb: \"\\t\"\n"), yaml);
    assert_string_equal(reader_kit_errors(&kit), "E104 1:4-1:10");
    assert_true(tree_node(&kit.tree, reader_kit_at(&kit, "a"))->flags & TREE_BAD);
    assert_false(tree_node(&kit.tree, reader_kit_at(&kit, "b"))->flags & TREE_BAD);
    reader_kit_finish(&kit);

    reader_kit_read(&kit, STR("a: 1\nb: x\0y\nc: [\n"), yaml);
    assert_string_equal(reader_kit_errors(&kit), "E104 2:5-2:6, E101 3:4-3:5");
    reader_kit_finish(&kit);
    reader_kit_read(&kit,
                    STR("\xFF\xFE"
                        "a\0:\0 \0"
                        "1\0"),
                    yaml);
    assert_string_equal(reader_kit_errors(&kit), "E103 1:1-1:2");
    assert_false(kit.readable);
    reader_kit_finish(&kit);
    reader_kit_read(&kit,
                    STR("a\0:\0 \0"
                        "1\0"),
                    yaml);
    assert_string_equal(reader_kit_errors(&kit), "E103 1:1-1:2");
    reader_kit_finish(&kit);
}

static void refuses_binary_data(void **state) {
    (void)state;
    static char noise[100000];
    uint32_t seed = 7;
    for (size_t i = 0; i < sizeof noise; i++) {
        seed = seed * 1664525u + 1013904223u;
        noise[i] = (char)(seed >> 24);
    }
    struct reader_kit kit;
    reader_kit_read(&kit, (str){noise, sizeof noise}, yaml);
    assert_false(kit.readable);
    assert_in_range(kit.sink.count, 1, 2);
    reader_kit_finish(&kit);
}

static void keeps_comments(void **state) {
    (void)state;
    static const char text[] =
        "# head\n# yaml-language-server: $schema=s.json\n# more\nglint: 1 # v\n"
        "# one\n\n  # two\nlights: # all\n  # A\n  - {p: [1, 2]} # tr\n  # B\n  - p: 1 # q\n"
        "    # r\n    s: 2\ntext: |\n  # no\n# after\nb:\n  # why\n  [1, # i\n   # j\n   2]\n"
        "# closing\n\n# really\n";
    static const char *const leading[][2] = {
        {"glint@", "# head\n# yaml-language-server: $schema=s.json\n# more"},
        {"lights@", "# one\n\n  # two"},
        {"lights/0", "# A"},
        {"lights/1", "# B"},
        {"lights/1/p@", ""},
        {"lights/1/s@", "# r"},
        {"text@", ""},
        {"b@", "# after"},
        {"b/0", "# i"},
        {"b/1", "# j"},
    };
    static const char *const trailing[][2] = {
        {"glint@", "# v"}, {"lights@", "# all"}, {"lights/0", "# tr"}, {"lights/1", "# q"}, {"b@", ""},
    };
    struct reader_kit kit;
    reader_kit_read(&kit, str_from(text), yaml);
    assert_string_equal(reader_kit_errors(&kit), "");
    for (size_t i = 0; i < sizeof leading / sizeof *leading; i++) {
        tree_index at = reader_kit_at(&kit, leading[i][0]);
        assert_string_equal(reader_kit_source(&kit, tree_comments(&kit.tree, at)), leading[i][1]);
    }
    for (size_t i = 0; i < sizeof trailing / sizeof *trailing; i++) {
        tree_index at = reader_kit_at(&kit, trailing[i][0]);
        assert_string_equal(reader_kit_source(&kit, tree_trailing_comment(&kit.tree, at)), trailing[i][1]);
    }
    assert_string_equal(reader_kit_source(&kit, kit.tree.schema_line),
                        "# yaml-language-server: $schema=s.json");
    assert_string_equal(reader_kit_source(&kit, kit.tree.closing_comments), "# closing\n\n# really");
    reader_kit_finish(&kit);
    reader_kit_read(&kit, STR("# yaml-language-server: $schema=s.json\nglint: 1\n"), yaml);
    assert_true(span_is_none(tree_comments(&kit.tree, reader_kit_at(&kit, "glint@"))));
    reader_kit_finish(&kit);
}

static void reads_set_values(void **state) {
    (void)state;
    const struct reader_kit_options value = {.is_value = true, .begin = 4};
    static const struct reading readings[] = {
        {"a.b=1.5", "1.5", ""},
        {"a.b=[1, 2]", "[1, 2]", ""},
        {"a.b={c: d}", "{c: d}", ""},
        {"a.b=\"x\"", "\"x\"", ""},
        {"a.b=two words", "two words", ""},
        {"a.b=null", "~", ""},
        {"a.b=#aabbcc", "none", "E120 1:5-1:12 =safe>\"#aabbcc\"<"},
        {"a.b=# x", "none", "E219 1:5-1:8"},
        {"a.b=[1", "[1!]?", "E219 1:7-1:7"},
        {"a.b=c: d", "none", "E219 1:5-1:6"},
        {"a.b=- 1", "none", "E219 1:5-1:6"},
        {"a.b=!t 1", "1!", "E107 1:5-1:7 =safe><"},
    };
    CHECK_ALL(readings, value);
}

// A text that is `piece` many times over.
static str repeated(const char *before, const char *piece, size_t count) {
    size_t head = strlen(before), size = strlen(piece);
    char *text = malloc(head + size * count + 1);
    assert_non_null(text);
    memcpy(text, before, head);
    for (size_t i = 0; i < count; i++)
        memcpy(text + head + i * size, piece, size);
    return (str){text, head + size * count};
}

static void expect_limit(str text, struct reader_kit_options options, const char *errors, const char *name) {
    struct reader_kit kit;
    reader_kit_read(&kit, text, options);
    assert_string_equal(reader_kit_errors(&kit), errors);
    char help[64];
    snprintf(help, sizeof help, "--limit %s=", name);
    const struct diag *d = &kit.sink.items[0];
    struct strbuf found;
    strbuf_init(&found);
    strbuf_str(&found, d->help);
    assert_non_null(strstr(found.data, help));
    strbuf_finish(&found);
    reader_kit_finish(&kit);
}

static void keeps_limits(void **state) {
    (void)state;
    static const struct {
        const char *before, *piece;
        size_t count;
        const char *errors, *name;
    } cases[] = {
        {"", "[", 200000, "E501 1:65-1:66", "scene-depth"},
        {"a: ", "{", 200000, "E501 1:67-1:68", "scene-depth"},
        {"", "- ", 200000, "E501 1:129-1:130", "scene-depth"},
        {"", "[\n", 200000, "E501 65:1-65:2", "scene-depth"},
        {"a: ", "x", 100000, "E501 1:4-1:5", "scalar-bytes"},
        {"a: |\n ", "x", 10000000, "E501 1:4-1:5", "scalar-bytes"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        str text = repeated(cases[i].before, cases[i].piece, cases[i].count);
        expect_limit(text, yaml, cases[i].errors, cases[i].name);
        free((char *)text.ptr);
    }
    struct limits limits = limits_default();
    limits.value[LIMIT_SCENE_NODES] = 16;
    struct reader_kit_options few = {.limits = &limits};
    expect_limit(STR("a: [1, 2, 3, 4, 5]\nb: [6, 7, 8, 9, 10, 11, 12]\n"), few, "E501 2:25-2:27",
                 "scene-nodes");
    limits = limits_default();
    limits.value[LIMIT_ALIAS_NODES] = 5;
    expect_limit(STR("a: &x [1, 2]\nb: *x\nc: *x\n"), few, "E501 3:4-3:6", "alias-nodes");
    limits = limits_default();
    limits.value[LIMIT_SCENE_DEPTH] = 3;
    expect_limit(STR("a: &x [[1]]\nb: *x\nc: [*x]\n"), few, "E501 3:5-3:7", "scene-depth");
}

static void stops_alias_bombs(void **state) {
    (void)state;
    expect_limit(
        STR("a: &a [x, x, x, x, x, x, x, x, x]\nb: &b [*a, *a, *a, *a, *a, *a, *a, *a, *a]\n"
            "c: &c [*b, *b, *b, *b, *b, *b, *b, *b, *b]\nd: &d [*c, *c, *c, *c, *c, *c, *c, *c, *c]\n"
            "e: &e [*d, *d, *d, *d, *d, *d, *d, *d, *d]\nf: &f [*e, *e, *e, *e, *e, *e, *e, *e, *e]\n"
            "g: &g [*f, *f, *f, *f, *f, *f, *f, *f, *f]\n"),
        yaml, "E501 7:8-7:10", "alias-nodes");
}

static const char sample[] =
    "# head\n%YAML 1.2\n---\n# yaml-language-server: $schema=s\nglint: 1 # one\nx-h: &h {albedo: [1, 0, .5, "
    "0]}\n"
    "camera: {position: [0, 0, 0], look_at: {x: 0, y: 0, z: -1}}\nlights:\n  - {position: [-20, 20, 20]}\n"
    "  # two\n  - position: [30, 50, -25]\n    color: \"#\xC3\xA4\"\nmaterials:\n  jade:\n    <<: *h\n"
    "    diffuse_color: !!str '#aabbcc'\ndescription: |\n  some\n\n  text\nmodels:\n- mesh: a.obj\n  scale: "
    "0.7\n- *h\n";

static void survives_every_prefix(void **state) {
    (void)state;
    for (size_t n = 0; n < sizeof sample; n++) {
        struct reader_kit kit;
        reader_kit_read(&kit, (str){sample, n}, yaml);
        reader_kit_dump(&kit);
        assert_true(kit.readable || kit.sink.errors > 0);
        reader_kit_finish(&kit);
    }
}

static void survives_corruption(void **state) {
    (void)state;
    static const char with[] = "\0\t\n #&*![{\"\xC3";
    for (size_t at = 0; at + 1 < sizeof sample; at++)
        for (size_t i = 0; i + 1 < sizeof with; i++) {
            char text[sizeof sample];
            memcpy(text, sample, sizeof sample);
            text[at] = with[i];
            struct reader_kit kit;
            reader_kit_read(&kit, (str){text, sizeof sample - 1}, yaml);
            reader_kit_dump(&kit);
            assert_true(kit.readable || kit.sink.errors > 0);
            reader_kit_finish(&kit);
        }
}

// Wherever the memory ends, the jump arrives at the guard and nothing is lost.
static void survives_little_memory(void **state) {
    (void)state;
    bool whole = false;
    for (size_t bytes = 16; !whole; bytes += 64) {
        struct reader_kit kit;
        reader_kit_read(&kit, (str){sample, sizeof sample - 1},
                        (struct reader_kit_options){.memory_bytes = bytes});
        whole = kit.fault == ARENA_FAULT_NONE;
        assert_true(whole ? kit.readable : kit.fault == ARENA_FAULT_CAP);
        reader_kit_finish(&kit);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_values),
        cmocka_unit_test(knows_nulls),
        cmocka_unit_test(places_are_bytes),
        cmocka_unit_test(spans_are_exact),
        cmocka_unit_test(expands_aliases),
        cmocka_unit_test(merges_maps),
        cmocka_unit_test(reads_the_first_of_two_versions),
        cmocka_unit_test(finds_keys_given_twice),
        cmocka_unit_test(refuses_strange_keys),
        cmocka_unit_test(refuses_tags),
        cmocka_unit_test(finds_lost_colors),
        cmocka_unit_test(finds_tabs),
        cmocka_unit_test(refuses_documents),
        cmocka_unit_test(explains_what_libyaml_refuses),
        cmocka_unit_test(checks_bytes),
        cmocka_unit_test(refuses_binary_data),
        cmocka_unit_test(keeps_comments),
        cmocka_unit_test(reads_set_values),
        cmocka_unit_test(keeps_limits),
        cmocka_unit_test(stops_alias_bombs),
        cmocka_unit_test(survives_every_prefix),
        cmocka_unit_test(survives_corruption),
        cmocka_unit_test(survives_little_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
