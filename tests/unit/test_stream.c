// Scenes that are bound entry by entry while they are read: the same words and scenes as otherwise, in little
// memory.
#include "core/strbuf.h"
#include "grammar/ir_print.h"
#include "grammar/schema.h"
#include "parser/parser.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum {
    SPHERES = 20000
};

struct job {
    struct arena arena;
    struct source_set sources;
    struct files files;
    struct diag_sink sink;
    struct limits limits;
    struct parser_output output;
};

static bool load(struct job *job, const char *name, str text, uint64_t memory_bytes) {
    *job = (struct job){.limits = limits_default()};
    job->limits.value[LIMIT_SCENE_MEMORY] = memory_bytes;
    arena_init(&job->arena, (size_t)1 << 30);
    source_set_init(&job->sources, &job->arena);
    files_init(&job->files, &job->arena);
    diag_sink_init(&job->sink);
    uint32_t source = source_add(&job->sources, SOURCE_KIND_OVERLAY, str_from(name), text);
    struct parser_input input = {.sources = &job->sources,
                                 .files = &job->files,
                                 .sink = &job->sink,
                                 .limits = &job->limits,
                                 .arena = &job->arena};
    bool found = parser_load(&input, source, &job->output);
    diag_sort(&job->sink);
    return found;
}

static void finish(struct job *job) {
    diag_sink_finish(&job->sink);
    arena_finish(&job->arena);
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
        struct job job;
        write(&text, xml, "2");
        assert_true(load(&job, xml ? "a.xml" : "a.yaml", strbuf_view(&text), 1 << 20));
        assert_int_equal(job.sink.count, 0);
        const struct ir_spheres *spheres = &job.output.scene->spheres;
        assert_int_equal(spheres->count, SPHERES);
        for (uint32_t i = 0; i < SPHERES; i++) {
            assert_true(spheres->items[i].center.x == i);
            assert_int_equal(spheres->items[i].material.index, 0);
            span at = ir_place_value(&job.output.origin, &spheres->items[i].head, &SCHEMA_SPHERE, "radius");
            str written = source_text(&job.sources, at);
            assert_true(str_equal(written, i + 1 < SPHERES ? STR("1") : STR("2")));
        }
        finish(&job);
        strbuf_finish(&text);
    }
}

static void mistakes_of_entries_are_told_in_little_memory(void **state) {
    (void)state;
    for (int xml = 0; xml < 2; xml++) {
        struct strbuf text;
        struct job job;
        write(&text, xml, "-3");
        assert_true(load(&job, xml ? "a.xml" : "a.yaml", strbuf_view(&text), 1 << 20));
        assert_int_equal(job.sink.count, 1);
        assert_int_equal(job.sink.errors, 1);
        assert_int_equal(job.sink.items[0].code, DIAG_OUT_OF_RANGE);
        assert_true(str_equal(source_text(&job.sources, job.sink.items[0].at), STR("-3")));
        assert_int_equal(job.output.scene->spheres.count, SPHERES);
        finish(&job);
        strbuf_finish(&text);
    }
}

// What the reader reports may change what is said of entries: the file is read whole, which takes memory.
static void mistakes_of_the_text_have_it_read_whole(void **state) {
    (void)state;
    for (int xml = 0; xml < 2; xml++) {
        struct strbuf text;
        struct job job;
        write(&text, xml, xml ? "1\" radius=\"2" : "1, radius: 2");
        assert_true(load(&job, xml ? "a.xml" : "a.yaml", strbuf_view(&text), (uint64_t)1 << 30));
        assert_int_equal(job.sink.count, 1);
        assert_int_equal(job.sink.items[0].code, xml ? DIAG_DUPLICATE_ATTRIBUTE : DIAG_DUPLICATE_KEY);
        assert_int_equal(job.output.scene->spheres.count, SPHERES);
        finish(&job);
        assert_false(load(&job, xml ? "a.xml" : "a.yaml", strbuf_view(&text), 1 << 20));
        assert_true(job.sink.count >= 1);
        assert_int_equal(job.sink.items[0].code, DIAG_LIMIT);
        finish(&job);
        strbuf_finish(&text);
    }
}

static void write_again(struct job *job, bool xml, struct strbuf *out) {
    const struct ir_scene *scene = job->output.origin.files.items[0].scene;
    strbuf_init(out);
    (xml ? ir_write_xml : ir_write_yaml)(scene, &job->output.origin, &job->sources,
                                         (struct ir_write_options){0}, out);
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
        struct job job;
        struct strbuf out;
        assert_true(load(&job, xml ? "a.xml" : "a.yaml", str_from(texts[xml]), 1 << 20));
        write_again(&job, xml, &out);
        const char *first = strstr(strbuf_view(&out).ptr, "the first");
        const char *second = strstr(strbuf_view(&out).ptr, "the second");
        assert_non_null(first);
        assert_non_null(second);
        assert_true(first < strchr(first, '1') && strchr(first, '1') < second);
        finish(&job);
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
