#include "load/settings/settings_file.h"
#include "diag/codes/binding.h"
#include "diag/codes/command.h"
#include "diag/codes/syntax.h"

struct reading {
    struct reader_context reader; // with a sink of its own
    uint32_t source;
    const struct settings_words *words;
    settings_take *take;
    void *binder;
    struct diag_sink *sink; // the caller's
};

static bool keep(void *context, struct diag *item) {
    const struct settings_words *words = context;
    if (item->code == DIAG_NOT_A_SCENE) {
        item->code = DIAG_CONFIG_VALUE;
        item->message = str_from(words->not_a_map);
        item->help = str_from(words->help);
    }
    return item->code != DIAG_EMPTY_FILE;
}

static void read_and_take(void *context) {
    struct reading *r = context;
    struct tree tree;
    const bool is_readable = read_yaml(&r->reader, r->source, &tree);
    diag_filter(r->reader.sink, keep, (void *)r->words);
    diag_merge(r->sink, r->reader.sink);
    for (tree_index key = is_readable ? tree_first(&tree, tree.root) : 0; key;
         key = tree_next_key(&tree, key))
        r->take(r->binder, &tree, key);
}

enum arena_fault settings_read(const struct reader_context *reader, uint32_t source,
                               const struct settings_words *words, settings_take *take, void *binder) {
    struct diag_sink sink;
    struct reading reading = {.reader = *reader,
                              .source = source,
                              .words = words,
                              .take = take,
                              .binder = binder,
                              .sink = reader->sink};
    diag_sink_init(&sink);
    reading.reader.sink = &sink;
    const enum arena_fault fault = arena_guarded(reader->arena, read_and_take, &reading);
    diag_sink_finish(&sink);
    return fault;
}
