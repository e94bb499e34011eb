// Scenes that were changed at random, and that still read without an error, mean the same after `convert`
// there and back, and after `format`; no comment's text becomes content.
#include "parser/format/format.h"
#include "tests/equal/equal_kit.h"
#include "tests/generate/generate.h"
#include "tests/generate/mutate.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    SEED_COUNT = 120,     // of scenes, each in both spellings
    MUTANTS_OF_EACH = 12, // a tenth of them is to be readable, or the test says nothing
};

struct tally {
    uint64_t seeds;
    unsigned mutants, readable;
    unsigned broken_comments; // readable, with a line end in it that is not YAML 1.2's
};

struct trip {
    const char *what;
    bool xml;
    str text; // as it was before
};

// What is tried, for whoever has to find out why it fails.
static void fail_with(const struct trip *trip, const char *how, const struct strbuf *written) {
    print_error("%s: %s\n--- the scene\n", trip->what, how);
    fwrite(trip->text.ptr, 1, trip->text.len, stderr);
    fputs("\n--- written\n", stderr);
    fwrite(written->data ? written->data : "", 1, written->len, stderr);
    fail();
}

static void assert_means(const struct trip *trip, const char *how, struct loaded *loaded,
                         const struct strbuf *written, const struct strbuf *dump) {
    struct strbuf again;
    strbuf_init(&again);
    if (!loaded->is_there || loaded->sink.errors) {
        print_error("%.*s\n", STR_ARG(loaded->sink.count ? loaded->sink.items[0].message : STR("no scene")));
        fail_with(trip, how, written);
    }
    ir_dump(loaded->output.scene, &again);
    if (!str_equal(strbuf_view(dump), strbuf_view(&again)))
        fail_with(trip, how, written);
    strbuf_finish(&again);
}

static void check_there_and_back(const struct trip *trip, const struct loaded *loaded, bool xml,
                                 const struct strbuf *dump) {
    struct strbuf there, back;
    struct loaded other, again;
    strbuf_init(&there), strbuf_init(&back);
    write_loaded(loaded, xml, &there);
    load_text(&other, xml ? "there.xml" : "there.yaml", strbuf_view(&there));
    assert_means(trip, xml ? "as XML" : "as YAML", &other, &there, dump);
    write_loaded(&other, trip->xml, &back);
    load_text(&again, trip->xml ? "back.xml" : "back.yaml", strbuf_view(&back));
    assert_means(trip, "and back", &again, &back, dump);
    loaded_finish(&other), loaded_finish(&again);
    strbuf_finish(&there), strbuf_finish(&back);
}

static void check_json(const struct trip *trip, const struct loaded *loaded, const struct strbuf *dump) {
    struct strbuf json;
    struct loaded other;
    strbuf_init(&json);
    ir_write_json(loaded->output.scene, &json);
    load_text(&other, "there.json", strbuf_view(&json));
    assert_means(trip, "as JSON", &other, &json, dump);
    loaded_finish(&other);
    strbuf_finish(&json);
}

struct layout {
    struct reader_context context;
    uint32_t source;
    struct strbuf out;
    enum format_status status;
};

static void lay_out(void *context) {
    struct layout *layout = context;
    layout->status = format_source(&layout->context, layout->source, NULL, &layout->out);
}

static void check_layout(const struct trip *trip, struct loaded *loaded, const struct strbuf *dump) {
    struct layout layout = {.context = {.sources = &loaded->sources,
                                        .sink = &loaded->sink,
                                        .limits = &loaded->limits,
                                        .arena = &loaded->arena},
                            .source = loaded->main_source};
    strbuf_init(&layout.out);
    assert_int_equal(arena_guarded(&loaded->arena, lay_out, &layout), ARENA_FAULT_NONE);
    if (layout.status == FORMAT_UNSAFE)
        fail_with(trip, "the layout would have another meaning", &layout.out);
    if (layout.status == FORMAT_DONE) {
        struct loaded other;
        load_text(&other, trip->xml ? "laid-out.xml" : "laid-out.yaml", strbuf_view(&layout.out));
        assert_means(trip, "laid out", &other, &layout.out, dump);
        str once = arena_copy(&loaded->arena, strbuf_view(&layout.out));
        layout.source =
            source_add(&loaded->sources, SOURCE_KIND_OVERLAY, str_from(trip->xml ? "a.xml" : "a.yaml"), once);
        strbuf_clear(&layout.out);
        assert_int_equal(arena_guarded(&loaded->arena, lay_out, &layout), ARENA_FAULT_NONE);
        if (layout.status != FORMAT_DONE || !str_equal(once, strbuf_view(&layout.out)))
            fail_with(trip, "laid out twice", &layout.out);
        loaded_finish(&other);
    }
    strbuf_finish(&layout.out);
}

static bool has_odd_break(str text) {
    bool odd = false;
    for (size_t i = 0; i < text.len && !odd; i++) {
        size_t length = str_yaml_break_length(text, i);
        odd = length && text.ptr[i] != '\n' && !(text.ptr[i] == '\r' && length == 2);
    }
    return odd;
}

static void check_text(const struct trip *trip, struct tally *tally) {
    struct loaded loaded;
    struct strbuf dump;
    strbuf_init(&dump);
    load_text(&loaded, trip->xml ? "scene.xml" : "scene.yaml", trip->text);
    tally->mutants++;
    if (loaded.is_there && loaded.sink.errors == 0) {
        tally->readable++;
        tally->broken_comments += has_odd_break(trip->text);
        ir_dump(loaded.output.scene, &dump);
        check_there_and_back(trip, &loaded, !trip->xml, &dump);
        check_there_and_back(trip, &loaded, trip->xml, &dump);
        check_json(trip, &loaded, &dump);
        check_layout(trip, &loaded, &dump);
    }
    strbuf_finish(&dump);
    loaded_finish(&loaded);
}

static void check_mutants(const char *name, bool xml, str text, uint64_t seed, struct tally *tally) {
    struct strbuf mutant;
    char what[96];
    strbuf_init(&mutant);
    for (unsigned i = 0; i < MUTANTS_OF_EACH; i++) {
        uint64_t state = seed * 1000 + i;
        mutate_text(&state, text, &mutant);
        snprintf(what, sizeof what, "%s in %s, mutant %u", name, xml ? "XML" : "YAML", i);
        check_text(&(struct trip){what, xml, strbuf_view(&mutant)}, tally);
    }
    strbuf_finish(&mutant);
}

static void test_generated(void **state) {
    struct tally *tally = *state;
    for (uint64_t seed = 0; seed < tally->seeds; seed++) {
        struct arena arena;
        struct strbuf text;
        char name[32];
        const struct generate_options options = {.seed = seed, .renderable = seed % 2 == 0};
        snprintf(name, sizeof name, "seed %d", (int)seed);
        arena_init(&arena, (size_t)1 << 26);
        strbuf_init(&text);
        const struct ir_scene *scene = generate_scene(&options, &arena);
        ir_write_yaml(scene, NULL, NULL, (struct ir_write_options){0}, &text);
        check_mutants(name, false, strbuf_view(&text), seed, tally);
        strbuf_clear(&text);
        ir_write_xml(scene, NULL, NULL, (struct ir_write_options){0}, &text);
        check_mutants(name, true, strbuf_view(&text), seed, tally);
        strbuf_finish(&text);
        arena_finish(&arena);
    }
}

// With the comments of people.
static void test_shipped(void **state) {
    static const char *const scenes[] = {
        "scenes/showcase.glint.yaml", "scenes/showcase.glint.xml", "scenes/elements/anchors.glint.yaml",
        "scenes/elements/materials.glint.xml", "scenes/elements/description.glint.yaml"};
    struct tally *tally = *state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct loaded loaded;
        load_path(&loaded, scenes[i]);
        str text = loaded.sources.items[loaded.main_source].text;
        for (uint64_t seed = 0; seed < 4; seed++)
            check_mutants(scenes[i], str_ends_with_nocase(str_from(scenes[i]), ".xml"), text, i + 100 * seed,
                          tally);
        loaded_finish(&loaded);
    }
}

// The texts with which comments were found to become content, or to be no YAML at all.
static void test_found(void **state) {
    static const struct {
        bool xml;
        const char *text;
    } found[] = {
        {true,
         "<Scene glint=\"1\">\n<!-- key\r  - {position: [9, 9, 9]} -->\n<Light><Position x=\"1\" y=\"1\" "
         "z=\"1\"/></Light>\n</Scene>\n"},
        {true,
         "<Scene glint=\"1\">\n<!-- a\xC2\x85lights: [] -->\n<Image width=\"9\" height=\"9\"/>\n</Scene>\n"},
        {true, "<Scene glint=\"1\">\n<!-- a\xE2\x80\xA8glint: 2 -->\n<Image width=\"9\" "
               "height=\"9\"/>\n</Scene>\n"},
        {true,
         "<Scene glint=\"1\">\n<!-- a\xE2\x80\xA9glint: 2 --><Image width=\"9\" height=\"9\"/>\n</Scene>\n"},
        {true, "<!-- one\rtwo\r\rthree -->\r<Scene glint=\"1\">\r<!-- four\r     five -->\r\r<!-- six -->\r"
               "<Image width=\"9\" height=\"9\"/>\r</Scene>\r"},
        {true, "<?xml-model href=\"a\nglint: 2\"?>\n<Scene glint=\"1\"/>\n"},
        {true, "<Scene glint=\"1\"><Sphere material=\"a&lt;b\" radius=\"1\"><Center x=\"0\" y=\"1\" "
               "z=\"0\"/></Sphere></Scene>\n"},
        {false, "glint: 1\ndescription: |-\n  one\n\xC2\x85  two\xE2\x80\xA8  three\xE2\x80\xA8\xE2\x80\xA8# "
                "four\n\n"
                "trace: {max_depth: 64}\n"},
        {false, "# one\rglint: 1\r# two\rimage: {width: 9, height: 9} # three\r# four\r"},
        {false, "# one\xC2\x85glint: 1\n# two\xC2\x85# three\nimage: {width: 9, height: 9}\n"},
        {false, "glint: 1\n# two\xE2\x80\xA8image: # three\xE2\x80\xA9  {width: 9, height: 9}\n"},
    };
    struct tally none = {0};
    (void)state;
    for (size_t i = 0; i < sizeof found / sizeof *found; i++)
        check_text(&(struct trip){"found", found[i].xml, str_from(found[i].text)}, &none);
    assert_int_equal(none.readable, sizeof found / sizeof *found);
}

static void test_enough_was_readable(void **state) {
    const struct tally *tally = *state;
    print_message("%u mutants, %u readable, %u of these with line ends of other kinds\n", tally->mutants,
                  tally->readable, tally->broken_comments);
    assert_true(tally->readable > tally->mutants / 10);
    assert_true(tally->broken_comments > tally->readable / 20);
}

int main(int argc, char **argv) {
    struct tally tally = {.seeds = argc > 1 ? strtoull(argv[1], NULL, 10) : SEED_COUNT};
    struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_found, &tally),
        cmocka_unit_test_prestate(test_generated, &tally),
        cmocka_unit_test_prestate(test_shipped, &tally),
        cmocka_unit_test_prestate(test_enough_was_readable, &tally),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
