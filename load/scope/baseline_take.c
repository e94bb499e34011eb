// Which findings of a session a baseline knows, or will know.
#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "load/scope/baseline.h"

#include <string.h>

enum {
    LINE_BYTES_MAX = 400,
};

// Text on one line, in a field: tabs, line ends, controls and what is not UTF-8 as backslash sequences. Line
// numbers and list indices may change while the finding stays the same: without `numbers` each number is
// written as '#'.
static void put_field(struct strbuf *out, str text, bool numbers) {
    for (size_t at = 0; at < text.len;) {
        size_t size = utf8_sequence_length(text, at);
        unsigned char c = (unsigned char)text.ptr[at];
        bool digit = c >= '0' && c <= '9';
        if (size == 0 || c < 0x20 || c == 0x7F)
            strbuf_format(out, "\\x%02X", c);
        else if (c == '\\')
            strbuf_cstr(out, "\\\\");
        else if (!digit || numbers)
            strbuf_add(out, text.ptr + at, size);
        else if (at == 0 || text.ptr[at - 1] < '0' || text.ptr[at - 1] > '9')
            strbuf_char(out, '#');
        at += size ? size : 1;
    }
}

// The path of `target` as seen from a folder, both absolute.
static void put_relative(struct strbuf *out, str folder, str target) {
    size_t common = 0;
    size_t at = 0;
    while (at < folder.len && at < target.len && folder.ptr[at] == target.ptr[at]) {
        common = folder.ptr[at] == '/' ? at + 1 : common;
        at++;
    }
    if (at == folder.len && at < target.len && target.ptr[at] == '/')
        common = at + 1;
    bool inside = common > folder.len || folder.len <= 1;
    for (size_t i = common; !inside && i <= folder.len; i++)
        if (i == folder.len || folder.ptr[i] == '/')
            strbuf_cstr(out, "../");
    put_field(out, str_slice(target, common, target.len), true);
}

struct taking {
    struct session *session;
    const struct baseline *known;
    struct baseline_found *found; // NULL: what is known is taken
    uint32_t count;
    struct strbuf text;
    str folder;
    str *paths;          // of the sources, as fields; empty: not asked for yet
    struct str_map seen; // how many of a key there were
    str via;
};

static str path_field(struct taking *t, str path) {
    strbuf_clear(&t->text);
    put_relative(&t->text, t->folder, files_canonical(&t->session->files, path));
    return arena_copy(&t->session->arena, strbuf_view(&t->text));
}

static str path_of(struct taking *t, uint32_t source) {
    if (t->paths[source].len == 0)
        t->paths[source] = path_field(t, t->session->sources.items[source].path);
    return t->paths[source];
}

static str key_of(struct taking *t, const struct diag *item) {
    str path = path_of(t, item->at.source);
    struct source_place place = source_locate(&t->session->sources, item->at);
    strbuf_clear(&t->text);
    strbuf_format(&t->text, "%.*s\t%s\t", STR_ARG(path), diag_info(item->code)->code);
    put_field(&t->text, item->message, false);
    strbuf_char(&t->text, '\t');
    put_field(&t->text, str_trim(str_slice(place.line_text, 0, LINE_BYTES_MAX)), true);
    return arena_copy(&t->session->arena, strbuf_view(&t->text));
}

// A system failure is not a mistake in the scene, and options are not in a file. If an include cannot be
// read, its mistakes are unknown.
static bool can_be_known(const struct taking *t, const struct diag *item) {
    const struct source_set *sources = &t->session->sources;
    const span unread = t->session->unread;
    enum source_kind kind =
        item->at.source < sources->count ? sources->items[item->at.source].kind : SOURCE_KIND_DEFAULT;
    if (!span_is_none(unread) && item->at.source == unread.source && item->at.begin == unread.begin)
        return false;
    return item->severity != DIAG_NOTE && item->code != DIAG_OUT_OF_MEMORY &&
           item->code != DIAG_FILE_UNREADABLE && kind != SOURCE_KIND_DEFAULT && kind != SOURCE_KIND_OPTION;
}

static void raise_to(_Atomic uint32_t *place, uint32_t value) {
    uint32_t now = atomic_load(place);
    while (now < value && !atomic_compare_exchange_weak(place, &now, value)) {
    }
}

static bool is_new(void *context, struct diag *item) {
    struct taking *t = context;
    const struct baseline *known = t->known;
    if (!can_be_known(t, item))
        return true;
    str key = key_of(t, item);
    uint32_t entry = str_map_find(&known->keys, key);
    if (entry == 0)
        return true;
    uint32_t number = ++*str_map_at(&t->seen, key);
    if (number > known->entries.items[entry - 1].count)
        return true;
    raise_to(&known->used[entry - 1], number);
    t->count++;
    return false;
}

static bool is_not_written(void *context, struct diag *item) {
    struct taking *t = context;
    struct baseline_found *found = t->found;
    if (!can_be_known(t, item))
        return true;
    str key = arena_copy(&found->arena, key_of(t, item));
    uint32_t *place = str_map_at(&found->keys, key);
    if (*place == 0) {
        *ARENA_PUSH(&found->arena, &found->entries) =
            (struct baseline_entry){.key = key, .via = arena_copy(&found->arena, t->via)};
        *place = found->entries.count;
    }
    found->entries.items[*place - 1].count++;
    t->count++;
    return false;
}

static void take(void *context) {
    struct taking *t = context;
    struct session *session = t->session;
    bool complete = session->state == SESSION_LOADED && session->sink.errors == 0;
    t->paths = ARENA_ARRAY(&session->arena, str, session->sources.count);
    t->via = path_field(t, session->options.path);
    str_map_init(&t->seen, &session->arena);
    if (t->found) {
        t->found->dropped = session->sink.dropped;
        diag_filter(&session->sink, is_not_written, t);
        return;
    }
    diag_filter(&session->sink, is_new, t);
    uint32_t scene = str_map_find(&t->known->scenes, t->via);
    if (scene && complete)
        atomic_store(&t->known->checked[scene - 1], true);
}

uint32_t baseline_take(struct session *session, const struct baseline *known, struct baseline_found *found) {
    struct taking t = {.session = session, .known = known, .found = found};
    if (session->config_failed || (session->state != SESSION_LOADED && session->state != SESSION_NO_SCENE))
        return 0;
    t.folder = found ? found->folder : known->folder;
    strbuf_init(&t.text);
    struct arena *arenas[] = {&session->arena, found ? &found->arena : NULL, NULL};
    arena_guarded_all(arenas, take, &t);
    strbuf_finish(&t.text);
    return t.count;
}
