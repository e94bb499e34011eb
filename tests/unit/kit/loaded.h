// Scenes from text in memory, for the tests of the parser's stages. Files are overlays; nothing is read from
// disk but the folder that the test runs in.
#ifndef GLINT_TESTS_LOADED_H
#define GLINT_TESTS_LOADED_H

#include "diag/diag_text.h"
#include "parser/parser.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

struct loaded {
    struct arena arena;
    struct source_set sources;
    struct files files;
    struct diag_sink sink;
    struct limits limits;
    struct parser_output output;
    bool ok;
    char codes[1024]; // of all errors and warnings, by place: "E202 E301"
};

static inline void loaded_init(struct loaded *l) {
    memset(l, 0, sizeof *l);
    arena_init(&l->arena, (size_t)1 << 28);
    source_set_init(&l->sources, &l->arena);
    files_init(&l->files, &l->arena);
    diag_sink_init(&l->sink);
    l->limits = limits_default();
}

static inline void loaded_finish(struct loaded *l) {
    diag_sink_finish(&l->sink);
    arena_finish(&l->arena);
}

// Another file of the scene.
static inline void loaded_add(struct loaded *l, const char *path, const char *text) {
    files_add_overlay(&l->files, str_from(path), str_from(text));
}

static inline void loaded_list_codes(struct loaded *l) {
    for (uint32_t i = 0; i < l->sink.count; i++) {
        size_t used = strlen(l->codes);
        const char *code = diag_info(l->sink.items[i].code)->code;
        if (used + 8 < sizeof l->codes)
            snprintf(l->codes + used, sizeof l->codes - used, "%s%s", used ? " " : "", code);
    }
}

static inline void loaded_run(struct loaded *l, const char *path, const char *text, const char *const *sets) {
    str options[16];
    uint32_t count = 0;
    for (; sets && sets[count]; count++)
        options[count] = str_from(sets[count]);
    assert_int_equal(files_add_root(&l->files, STR(".")), FILE_OK);
    loaded_add(l, path, text);
    uint32_t source = source_add(&l->sources, SOURCE_KIND_OVERLAY, str_from(path), str_from(text));
    struct parser_input input = {.sources = &l->sources,
                                 .files = &l->files,
                                 .sink = &l->sink,
                                 .limits = &l->limits,
                                 .arena = &l->arena,
                                 .sets = options,
                                 .set_count = count};
    l->ok = parser_load(&input, source, &l->output);
    diag_sort(&l->sink);
    loaded_list_codes(l);
}

static inline void loaded_yaml(struct loaded *l, const char *text) {
    loaded_init(l);
    loaded_run(l, "scene.yaml", text, NULL);
}

static inline void loaded_xml(struct loaded *l, const char *text) {
    loaded_init(l);
    loaded_run(l, "scene.xml", text, NULL);
}

static inline struct ir_scene *loaded_scene(struct loaded *l) {
    assert_true(l->ok);
    return l->output.scene;
}

// The messages as people see them; fails where `part` does not occur.
static inline void loaded_expect_text(struct loaded *l, const char *part) {
    struct strbuf text;
    strbuf_init(&text);
    diag_text(&text, &l->sink, &l->sources, (struct diag_text_options){.notes = true});
    bool found = text.data && strstr(text.data, part);
    if (!found)
        print_error("not found: %s\nin:\n%s\n", part, text.data ? text.data : "(nothing)");
    strbuf_finish(&text);
    assert_true(found);
}

// The codes of a text in one spelling; the text after them.
static inline void loaded_check(const char *yaml_or_xml, const char *codes, const char *part) {
    struct loaded l;
    if (yaml_or_xml[0] == '<')
        loaded_xml(&l, yaml_or_xml);
    else
        loaded_yaml(&l, yaml_or_xml);
    if (strcmp(l.codes, codes) != 0)
        loaded_expect_text(&l, "(codes differ)");
    assert_string_equal(l.codes, codes);
    if (part)
        loaded_expect_text(&l, part);
    loaded_finish(&l);
}

// Twins: the same codes, and for the first diagnostic the same words.
static inline void loaded_check_twins(const char *yaml, const char *xml, const char *codes,
                                      const char *message) {
    const char *text[2] = {yaml, xml};
    for (int i = 0; i < 2; i++) {
        struct loaded l;
        if (i == 0)
            loaded_yaml(&l, text[i]);
        else
            loaded_xml(&l, text[i]);
        if (strcmp(l.codes, codes) != 0)
            loaded_expect_text(&l, "(codes differ)");
        assert_string_equal(l.codes, codes);
        if (message && l.sink.count) {
            str got = l.sink.items[0].message;
            if (!str_equal_cstr(got, message))
                loaded_expect_text(&l, message);
            assert_true(str_equal_cstr(got, message));
        }
        loaded_finish(&l);
    }
}

#define HEAD_YAML "glint: 1\n"
#define HEAD_XML  "<Scene glint=\"1\">"
#define END_XML   "</Scene>"

#endif
