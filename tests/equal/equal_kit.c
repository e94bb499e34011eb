#include "tests/equal/equal_kit.h"

#include "diag/diag_text.h"
#include "grammar/ir_walk.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static void begin(struct loaded *loaded) {
    memset(loaded, 0, sizeof *loaded);
    arena_init(&loaded->arena, (size_t)1 << 30);
    arena_init(&loaded->scene_arena, (size_t)1 << 30);
    source_set_init(&loaded->sources, &loaded->arena);
    files_init(&loaded->files, &loaded->arena);
    diag_sink_init(&loaded->sink);
    loaded->limits = limits_default();
}

static struct parser_input input_of(struct loaded *loaded) {
    return (struct parser_input){.sources = &loaded->sources,
                                 .files = &loaded->files,
                                 .sink = &loaded->sink,
                                 .limits = &loaded->limits,
                                 .arena = &loaded->scene_arena};
}

void load_text(struct loaded *loaded, const char *path, str text) {
    begin(loaded);
    str copy = arena_copy(&loaded->arena, text);
    loaded->main_source = source_add(&loaded->sources, SOURCE_KIND_OVERLAY, str_from(path), copy);
    struct parser_input input = input_of(loaded);
    loaded->is_there = parser_load_file(&input, loaded->main_source, &loaded->output);
}

void load_whole_text(struct loaded *loaded, const char *path, str text) {
    begin(loaded);
    files_add_overlay(&loaded->files, str_from(path), text);
    loaded->main_source =
        source_add(&loaded->sources, SOURCE_KIND_OVERLAY, str_from(path), arena_copy(&loaded->arena, text));
    struct parser_input input = input_of(loaded);
    if (files_add_root(&loaded->files, STR(".")) != FILE_OK)
        fail_msg("no folder");
    loaded->is_there = parser_load(&input, loaded->main_source, &loaded->output);
}

void load_path(struct loaded *loaded, const char *path) {
    str text = STR("");
    begin(loaded);
    if (files_add_scene_root(&loaded->files, str_from(path)) != FILE_OK ||
        files_read_given(&loaded->files, str_from(path), (uint64_t)1 << 28, &loaded->arena, &text) != FILE_OK)
        fail_msg("cannot read %s", path);
    loaded->main_source = source_add(&loaded->sources, SOURCE_KIND_FILE, str_from(path), text);
    struct parser_input input = input_of(loaded);
    loaded->is_there = parser_load(&input, loaded->main_source, &loaded->output);
}

void loaded_finish(struct loaded *loaded) {
    diag_sink_finish(&loaded->sink);
    arena_finish(&loaded->scene_arena);
    arena_finish(&loaded->arena);
}

void assert_no_errors(struct loaded *loaded, const char *what) {
    if (loaded->is_there && loaded->sink.errors == 0)
        return;
    struct strbuf text;
    strbuf_init(&text);
    diag_sort(&loaded->sink);
    diag_text(&text, &loaded->sink, &loaded->sources, (struct diag_text_options){.most = 5});
    print_error("%s:\n%s", what, text.data ? text.data : "no scene, and no diagnostic\n");
    strbuf_finish(&text);
    fail();
}

void write_loaded(const struct loaded *loaded, bool xml, struct strbuf *out) {
    const struct ir_scene *scene = loaded->output.origin.files.items[0].scene;
    struct ir_write_options options = {0};
    if (xml)
        ir_write_xml(scene, &loaded->output.origin, &loaded->sources, options, out);
    else
        ir_write_yaml(scene, &loaded->output.origin, &loaded->sources, options, out);
    assert_false(out->failed);
}

void assert_same_text(const char *what, const struct strbuf *a, const struct strbuf *b) {
    size_t at = 0, line = 0;
    if (a->len == b->len && memcmp(a->data, b->data, a->len) == 0)
        return;
    for (size_t i = 0; i < a->len && i < b->len && a->data[i] == b->data[i]; i++)
        if (a->data[i] == '\n') {
            at = i + 1;
            line++;
        }
    print_error("%s differs from line %zu on:\n--- first\n%.300s\n--- second\n%.300s\n", what, line + 1,
                a->data + at, b->data + at);
    fail();
}

void note_written(const struct schema_element *schema, const void *element, uint64_t used[ELEMENTS_MAX]) {
    int which = 0;
    while (schema_elements[which] != schema)
        which++;
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        struct ir_any_list list = ir_walk_list(row, element);
        // Anonymous items too: they stand in the list that references point into.
        for (uint32_t k = 0; k < list.count; k++)
            note_written(row->child, ir_walk_item(row, list, k), used);
        if (!ir_walk_written(schema, i, element))
            continue;
        used[which] |= UINT64_C(1) << i;
        if (row->kind == SCHEMA_ELEMENT)
            note_written(row->child, schema_field_const(row, element), used);
    }
}

void assert_all_written(const uint64_t used[ELEMENTS_MAX], const char *complaint) {
    unsigned missing = 0;
    for (int e = 0; schema_elements[e]; e++)
        for (uint32_t i = 0; i < schema_elements[e]->row_count; i++) {
            const struct schema_row *row = &schema_elements[e]->rows[i];
            // A frame that a scene shows by itself has been put into its values.
            if (used[e] >> i & 1 || (row->range == SCHEMA_RANGE_FRAME && !row->required))
                continue;
            print_error("%s %s.%s\n", complaint, schema_elements[e]->name, row->name);
            missing++;
        }
    assert_int_equal(missing, 0);
}
