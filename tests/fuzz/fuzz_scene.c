// libFuzzer entry: any bytes as a scene, through all stages behind the readers. A form feed ends the scene;
// what follows is a --set option. A scene without errors must come back the same from both writers; and
// whether its entries are bound while it is read must not show.
#include "core/strbuf.h"
#include "fuzz_sample.h"
#include "grammar/ir.h"
#include "grammar/ir_expand.h"
#include "grammar/print/ir_print.h"
#include "parser/parser.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MEMORY_BYTES = 64 * 1024 * 1024
};

struct loaded {
    struct arena arena;
    struct source_set sources;
    struct files files;
    struct diag_sink sink;
    struct limits limits;
    struct parser_output output;
    bool found;
};

static void require(bool holds, const char *what) {
    if (holds)
        return;
    fprintf(stderr, "the parser broke its promise: %s\n", what);
    abort();
}

static void load(struct loaded *l, const char *name, str text, const str *set, bool whole) {
    memset(l, 0, sizeof *l);
    l->limits = limits_default();
    l->limits.value[LIMIT_ALIAS_NODES] = 2000;
    l->limits.value[LIMIT_SCENE_DEPTH] = 24;
    arena_init(&l->arena, MEMORY_BYTES);
    source_set_init(&l->sources, &l->arena);
    files_init(&l->files, &l->arena);
    diag_sink_init(&l->sink);
    uint32_t source = source_add(&l->sources, SOURCE_KIND_OVERLAY, str_from(name), text);
    struct parser_input input = {.sources = &l->sources,
                                 .files = &l->files,
                                 .sink = &l->sink,
                                 .limits = &l->limits,
                                 .arena = &l->arena,
                                 .sets = set,
                                 .set_count = set ? 1 : 0,
                                 .whole = whole};
    l->found = parser_load(&input, source, &l->output);
    require(l->found || l->sink.errors > 0, "what is no scene has a diagnostic");
}

static void finish(struct loaded *l) {
    diag_sink_finish(&l->sink);
    arena_finish(&l->arena);
}

static void check_diagnostics(struct loaded *l) {
    for (uint32_t i = 0; i < l->sink.count && i < 50; i++) {
        const struct diag *d = &l->sink.items[i];
        require(d->at.source < l->sources.count, "the source of a diagnostic");
        size_t size = l->sources.items[d->at.source].text.len;
        require(d->at.begin <= d->at.end && d->at.end <= size, "the place of a diagnostic");
        require(d->message.len > 0, "the message of a diagnostic");
        require(!d->has_fix || (d->fix_at.begin <= d->fix_at.end && d->fix_at.end <= size),
                "the place of a fix");
    }
}

static void check_same(const char *name, struct strbuf *written, const struct strbuf *wanted) {
    struct loaded again;
    struct strbuf dump;
    strbuf_init(&dump);
    load(&again, name, strbuf_view(written), NULL, false);
    require(again.found && again.sink.errors == 0, "what is written can be read");
    ir_expand_instances(again.output.scene, &again.arena);
    ir_dump(again.output.scene, &dump);
    require(str_equal(strbuf_view(&dump), strbuf_view(wanted)), "what is written means the same");
    strbuf_finish(&dump);
    finish(&again);
}

static void check_writers(struct loaded *l, str bytes) {
    struct strbuf dump;
    struct strbuf text;
    struct ir_write_options options = {0};
    // Tracks lead into objects, which a scene that was evaluated has in place.
    if (l->output.scene->instances.count && l->output.scene->animation.tracks.count)
        return;
    strbuf_init(&dump);
    strbuf_init(&text);
    ir_expand_instances(l->output.scene, &l->arena);
    ir_dump(l->output.scene, &dump);
    if (fuzz_is_chosen(bytes, 0, 4))
        check_same("dump.yaml", &dump, &dump);
    if (fuzz_is_chosen(bytes, 1, 4)) {
        ir_write_yaml(l->output.scene, &l->output.origin, &l->sources, options, &text);
        check_same("again.yaml", &text, &dump);
    }
    if (fuzz_is_chosen(bytes, 2, 4)) {
        strbuf_clear(&text);
        ir_write_xml(l->output.scene, &l->output.origin, &l->sources, options, &text);
        check_same("again.xml", &text, &dump);
    }
    if (fuzz_is_chosen(bytes, 3, 4)) {
        strbuf_clear(&text);
        ir_write_json(l->output.scene, &text);
        check_same("again.json", &text, &dump);
    }
    strbuf_finish(&text);
    strbuf_finish(&dump);
}

static void add_diagnostics(struct strbuf *out, struct diag_sink *sink) {
    diag_sort(sink);
    for (uint32_t i = 0; i < sink->count; i++) {
        const struct diag *d = &sink->items[i];
        strbuf_format(out, "%s %u:%u-%u %.*s\n%.*s\n", diag_info(d->code)->code, d->at.source, d->at.begin,
                      d->at.end, STR_ARG(d->message), STR_ARG(d->help));
        for (const struct diag_related *note = d->notes; note; note = note->next)
            strbuf_format(out, "  %u-%u %.*s\n", note->at.begin, note->at.end, STR_ARG(note->message));
    }
}

static void check_whole(struct loaded *l, str text, const str *set) {
    struct loaded whole;
    struct strbuf there, here;
    strbuf_init(&there);
    strbuf_init(&here);
    load(&whole, "fuzz", text, set, true);
    add_diagnostics(&there, &whole.sink);
    add_diagnostics(&here, &l->sink);
    require(whole.found == l->found, "a scene either way, or none");
    if (l->found) {
        ir_dump(l->output.scene, &here);
        ir_dump(whole.output.scene, &there);
    }
    require(str_equal(strbuf_view(&here), strbuf_view(&there)), "the same said and meant either way");
    finish(&whole);
    strbuf_finish(&there);
    strbuf_finish(&here);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *copy = malloc(size + 1);
    if (!copy)
        abort();
    if (size)
        memcpy(copy, data, size);
    copy[size] = '\0';
    char *feed = memchr(copy, '\f', size);
    str scene = {copy, feed ? (size_t)(feed - copy) : size};
    str option = feed ? (str){feed + 1, size - scene.len - 1} : STR("");
    struct loaded loaded;
    load(&loaded, "fuzz", scene, feed ? &option : NULL, false);
    check_diagnostics(&loaded);
    if (fuzz_is_chosen((str){copy, size}, 0, 4))
        check_whole(&loaded, scene, feed ? &option : NULL);
    if (loaded.found && loaded.sink.errors == 0)
        check_writers(&loaded, (str){copy, size});
    finish(&loaded);
    free(copy);
    return 0;
}
