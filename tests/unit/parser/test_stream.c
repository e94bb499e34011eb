// Scenes that are bound entry by entry while they are read: the same words and scenes as otherwise, in little
// memory.
#include "diag/codes/binding.h"
#include "diag/codes/limit.h"
#include "diag/codes/syntax.h"
#include "grammar/ir.h"
#include "grammar/print/ir_print.h"
#include "grammar/schema.h"
#include "loaded.h"

enum {
    SPHERES = 20000
};

static bool load(struct loaded *l, bool xml, const char *text, uint64_t memory_bytes) {
    loaded_init(l);
    l->limits.value[LIMIT_SCENE_MEMORY] = memory_bytes;
    loaded_run(l, xml ? "a.xml" : "a.yaml", text, NULL);
    return l->ok;
}

// `odd` is the last sphere's radius.
static void write(struct strbuf *text, bool xml, const char *odd) {
    strbuf_init(text);
    strbuf_cstr(text, xml ? "<Scene glint=\"1\">\n<Material name=\"a\"/>\n"
                          : "glint: 1\nmaterials: {a: {}}\nspheres:\n");
    for (int i = 0; i < SPHERES; i++) {
        const char *radius = i + 1 < SPHERES ? "1" : odd;
        strbuf_format(
            text,
            xml ? "<Sphere radius=\"%s\" material=\"a\"><Center x=\"%d\" y=\"0\" z=\"0\"/></Sphere>\n"
                : "- {radius: %s, material: a, center: [%d, 0, 0]}\n",
            radius, i);
    }
    if (xml)
        strbuf_cstr(text, "</Scene>\n");
}

static void little_memory_is_enough(void **state) {
    (void)state;
    for (int xml = 0; xml < 2; xml++) {
        struct strbuf text;
        struct loaded l;
        write(&text, xml, "2");
        assert_true(load(&l, xml, text.data, 1 << 20));
        assert_int_equal(l.sink.count, 0);
        const struct ir_spheres *spheres = &l.output.scene->spheres;
        assert_int_equal(spheres->count, SPHERES);
        for (uint32_t i = 0; i < SPHERES; i++) {
            assert_true(spheres->items[i].center.x == i);
            assert_int_equal(spheres->items[i].material.index, 0);
            span at = ir_place_value(&l.output.origin, &spheres->items[i].head, &SCHEMA_SPHERE, "radius");
            str written = source_text(&l.sources, at);
            assert_true(str_equal(written, i + 1 < SPHERES ? STR("1") : STR("2")));
        }
        loaded_finish(&l);
        strbuf_finish(&text);
    }
}

static void mistakes_of_entries_are_told_in_little_memory(void **state) {
    (void)state;
    for (int xml = 0; xml < 2; xml++) {
        struct strbuf text;
        struct loaded l;
        write(&text, xml, "-3");
        assert_true(load(&l, xml, text.data, 1 << 20));
        assert_int_equal(l.sink.count, 1);
        assert_int_equal(l.sink.errors, 1);
        assert_int_equal(l.sink.items[0].code, DIAG_OUT_OF_RANGE);
        assert_true(str_equal(source_text(&l.sources, l.sink.items[0].at), STR("-3")));
        assert_int_equal(l.output.scene->spheres.count, SPHERES);
        loaded_finish(&l);
        strbuf_finish(&text);
    }
}

// What the reader reports may change what is said of entries: the file is read whole, which takes memory.
static void mistakes_of_the_text_have_it_read_whole(void **state) {
    (void)state;
    for (int xml = 0; xml < 2; xml++) {
        struct strbuf text;
        struct loaded l;
        write(&text, xml, xml ? "1\" radius=\"2" : "1, radius: 2");
        assert_true(load(&l, xml, text.data, (uint64_t)1 << 30));
        assert_int_equal(l.sink.count, 1);
        assert_int_equal(l.sink.items[0].code, xml ? DIAG_DUPLICATE_ATTRIBUTE : DIAG_DUPLICATE_KEY);
        assert_int_equal(l.output.scene->spheres.count, SPHERES);
        loaded_finish(&l);
        assert_false(load(&l, xml, text.data, 1 << 20));
        assert_true(l.sink.count >= 1);
        assert_int_equal(l.sink.items[0].code, DIAG_LIMIT);
        loaded_finish(&l);
        strbuf_finish(&text);
    }
}

static void write_again(struct loaded *l, bool xml, struct strbuf *out) {
    const struct ir_scene *scene = l->output.origin.files.items[0].scene;
    strbuf_init(out);
    (xml ? ir_write_xml : ir_write_yaml)(scene, &l->output.origin, &l->sources, (struct ir_write_options){0},
                                         out);
    strbuf_char(out, '\0');
}

// Comments stand beside entries that were taken, too.
static void comments_find_their_entries(void **state) {
    (void)state;
    static const char *const texts[] = {
        "glint: 1\n# many\nlights:\n  # the first\n  - position: [1, 2, 3]\n  # the second\n"
        "  - position: [4, 5, 6]\n",
        "<Scene glint=\"1\">\n  <!-- the first -->\n  <Light>\n    <Position x=\"1\" y=\"2\" z=\"3\"/>\n"
        "  </Light>\n  <!-- the second -->\n  <Light>\n    <Position x=\"4\" y=\"5\" z=\"6\"/>\n  </Light>\n"
        "</Scene>\n"};
    for (int xml = 0; xml < 2; xml++) {
        struct loaded l;
        struct strbuf out;
        assert_true(load(&l, xml, texts[xml], 1 << 20));
        write_again(&l, xml, &out);
        const char *first = strstr(strbuf_view(&out).ptr, "the first");
        const char *second = strstr(strbuf_view(&out).ptr, "the second");
        assert_non_null(first);
        assert_non_null(second);
        assert_true(first < strchr(first, '1') && strchr(first, '1') < second);
        loaded_finish(&l);
        strbuf_finish(&out);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(little_memory_is_enough),
        cmocka_unit_test(mistakes_of_entries_are_told_in_little_memory),
        cmocka_unit_test(mistakes_of_the_text_have_it_read_whole),
        cmocka_unit_test(comments_find_their_entries),
    };
    return cmocka_run_group_tests_name("stream", tests, NULL, NULL);
}
