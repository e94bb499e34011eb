#include "load/scope/baseline.h"
#include "diag/codes/command.h"
#include "diag/codes/limit.h"

#include "core/number.h"
#include "files/files_walk.h"

#include <stdlib.h>
#include <string.h>

enum {
    FILE_BYTES_MAX = 256 * 1024 * 1024,
    LINES_SHOWN = 5,
};

static const char header[] = "glint baseline 1";

str baseline_folder(struct arena *arena, const char *path) {
    struct files files;
    files_init(&files, arena);
    return path_folder(files_canonical(&files, str_from(path)));
}

// ---- reading

struct reading {
    struct baseline *baseline;
    struct source_set *sources;
    struct diag_sink *sink;
    uint32_t source;
    uint32_t scene_count;
    bool good;
};

static bool refuse(struct reading *r, size_t begin, size_t end, const char *what) {
    diag_add(r->sink, DIAG_BASELINE, (span){r->source, (uint32_t)begin, (uint32_t)end}, "%s", what);
    diag_help(r->sink, "'glint check --write-baseline FILE' writes one");
    return false;
}

// The fields of a line, which tabs separate; returns their number, at most `most`.
static uint32_t split(str line, str *fields, uint32_t most) {
    uint32_t count = 0;
    for (size_t at = 0; at <= line.len && count < most; at++) {
        size_t begin = at;
        while (at < line.len && line.ptr[at] != '\t')
            at++;
        fields[count++] = str_slice(line, begin, at);
    }
    return count;
}

static bool read_entry(struct reading *r, str line, size_t begin, uint32_t number) {
    struct baseline *b = r->baseline;
    str f[7];
    int64_t count = 0;
    uint32_t fields = split(line, f, 7);
    if (fields < 5 || fields > 6 || number_parse_integer(f[2], &count) != NUMBER_OK || count < 1 ||
        count > UINT32_MAX)
        return refuse(
            r, begin, begin + line.len,
            "this is not an entry of a baseline: path, code, number, message and line, separated by tabs");
    str key = arena_format(b->arena, "%.*s\t%.*s\t%.*s\t%.*s", STR_ARG(f[0]), STR_ARG(f[1]), STR_ARG(f[3]),
                           STR_ARG(f[4]));
    uint32_t *place = str_map_at(&b->keys, key);
    if (*place == 0) {
        *ARENA_PUSH(b->arena, &b->entries) =
            (struct baseline_entry){.key = key, .via = fields == 6 ? f[5] : f[0], .line = number};
        *place = b->entries.count;
    }
    struct baseline_entry *entry = &b->entries.items[*place - 1];
    entry->count = entry->count > (uint32_t)count ? entry->count : (uint32_t)count;
    uint32_t *scene = str_map_at(&b->scenes, entry->via);
    if (*scene == 0)
        *scene = ++r->scene_count;
    return true;
}

static bool read_lines(struct reading *r, str text) {
    uint32_t number = 0;
    bool good = true;
    for (size_t at = 0; at < text.len || number == 0; at++) {
        size_t begin = at;
        while (at < text.len && text.ptr[at] != '\n')
            at++;
        str line = str_slice(text, begin, at);
        if (line.len && line.ptr[line.len - 1] == '\r')
            line.len--;
        if (++number == 1 && !str_equal_cstr(line, header))
            return refuse(r, begin, begin + line.len, "this is not a baseline of glint");
        if (number > 1 && line.len && line.ptr[0] != '#')
            good = read_entry(r, line, begin, number) && good;
    }
    return good;
}

static void read_file(void *context) {
    struct reading *r = context;
    struct baseline *b = r->baseline;
    struct files files;
    str text = STR("");
    str_map_init(&b->keys, b->arena);
    str_map_init(&b->scenes, b->arena);
    files_init(&files, b->arena);
    b->folder = baseline_folder(b->arena, b->path);
    enum file_status status = files_read_given(&files, str_from(b->path), FILE_BYTES_MAX, b->arena, &text);
    r->source = source_add(r->sources, SOURCE_KIND_FILE, str_from(b->path), text);
    if (status != FILE_OK) {
        diag_add(r->sink, session_file_code(status), (span){r->source, 0, 0}, "the baseline %s",
                 file_status_text(&files, status));
        if (status == FILE_MISSING)
            diag_help(r->sink, "'glint check --write-baseline %s' writes it", b->path);
        return;
    }
    r->good = read_lines(r, text);
    b->used = ARENA_ARRAY(b->arena, _Atomic uint32_t, b->entries.count + 1);
    b->checked = ARENA_ARRAY(b->arena, _Atomic bool, r->scene_count + 1);
}

bool baseline_read(struct baseline *baseline, const char *path, struct arena *arena,
                   struct source_set *sources, struct diag_sink *sink) {
    struct reading reading = {.baseline = baseline, .sources = sources, .sink = sink};
    *baseline = (struct baseline){.path = path, .arena = arena};
    if (arena_guarded(arena, read_file, &reading) != ARENA_FAULT_NONE)
        diag_add(sink, DIAG_OUT_OF_MEMORY, SPAN_NONE, "not enough memory for the baseline");
    return reading.good;
}

// ---- what no longer occurs

// Whether the scene was removed. Names with escaped characters are assumed to exist.
static bool is_gone(const struct baseline *b, struct arena *arena, str via) {
    if (memchr(via.ptr, '\\', via.len))
        return false;
    return !files_exist(arena_format(arena, "%.*s/%.*s", STR_ARG(b->folder), STR_ARG(via)));
}

struct stale {
    const struct baseline *baseline;
    struct arena arena;
    struct strbuf lines;
    uint32_t entries;
    uint64_t findings;
};

static void find_stale(void *context) {
    struct stale *s = context;
    const struct baseline *b = s->baseline;
    for (uint32_t i = 0; i < b->entries.count; i++) {
        const struct baseline_entry *entry = &b->entries.items[i];
        uint32_t used = atomic_load(&b->used[i]);
        uint32_t scene = str_map_find(&b->scenes, entry->via);
        if (used >= entry->count ||
            (!atomic_load(&b->checked[scene - 1]) && !is_gone(b, &s->arena, entry->via)))
            continue;
        s->findings += entry->count - used;
        if (s->entries++ < LINES_SHOWN)
            strbuf_format(&s->lines, "%s%u", s->entries > 1 ? ", " : "", entry->line);
    }
}

void baseline_put_stale(const struct baseline *baseline, struct strbuf *out) {
    struct stale s = {.baseline = baseline};
    arena_init(&s.arena, SIZE_MAX / 2);
    strbuf_init(&s.lines);
    arena_guarded(&s.arena, find_stale, &s);
    if (s.entries)
        strbuf_format(
            out, "glint: %llu finding%s in %s %s gone (line%s %.*s%s); --write-baseline %s writes it anew\n",
            (unsigned long long)s.findings, s.findings == 1 ? "" : "s", baseline->path,
            s.findings == 1 ? "is" : "are", s.entries == 1 ? "" : "s", STR_ARG(strbuf_view(&s.lines)),
            s.entries > LINES_SHOWN ? ", ..." : "", baseline->path);
    out->failed = out->failed || s.lines.failed;
    strbuf_finish(&s.lines);
    arena_finish(&s.arena);
}

// ---- writing

void baseline_found_init(struct baseline_found *found, str folder) {
    *found = (struct baseline_found){.folder = folder};
    arena_init(&found->arena, SIZE_MAX / 2);
    str_map_init(&found->keys, &found->arena);
}

void baseline_found_finish(struct baseline_found *found) {
    arena_finish(&found->arena);
}

static int compare(const void *left, const void *right) {
    return str_compare(((const struct baseline_entry *)left)->key,
                       ((const struct baseline_entry *)right)->key);
}

struct merging {
    const struct baseline_found *const *found;
    uint32_t count;
    struct arena *arena;
    struct {
        struct baseline_entry *items;
        uint32_t count, capacity;
    } all;
};

// A finding in a file that several scenes read is one entry, because each of them has it.
static void merge(void *context) {
    struct merging *m = context;
    struct str_map keys;
    str_map_init(&keys, m->arena);
    for (uint32_t i = 0; i < m->count; i++)
        for (uint32_t k = 0; k < m->found[i]->entries.count; k++) {
            const struct baseline_entry *entry = &m->found[i]->entries.items[k];
            uint32_t *place = str_map_at(&keys, entry->key);
            if (*place == 0) {
                *ARENA_PUSH(m->arena, &m->all) = *entry;
                *place = m->all.count;
            }
            struct baseline_entry *merged = &m->all.items[*place - 1];
            merged->count = merged->count > entry->count ? merged->count : entry->count;
            merged->via = str_compare(entry->via, merged->via) < 0 ? entry->via : merged->via;
        }
    if (m->all.count)
        qsort(m->all.items, m->all.count, sizeof *m->all.items, compare);
}

uint32_t baseline_put(const struct baseline_found *const *found, uint32_t count, struct arena *arena,
                      struct strbuf *out) {
    struct merging m = {.found = found, .count = count, .arena = arena};
    uint32_t findings = 0;
    out->failed = arena_guarded(arena, merge, &m) != ARENA_FAULT_NONE || out->failed;
    strbuf_format(
        out,
        "%s\n# What 'glint check --baseline' does not report again: path, code, number, message, line, and "
        "the scene if it is\n# another file. Written by 'glint check --write-baseline'.\n",
        header);
    for (uint32_t i = 0; i < m.all.count; i++) {
        const struct baseline_entry *entry = &m.all.items[i];
        str f[4];
        split(entry->key, f, 4);
        strbuf_format(out, "%.*s\t%.*s\t%u\t%.*s\t%.*s", STR_ARG(f[0]), STR_ARG(f[1]), entry->count,
                      STR_ARG(f[2]), STR_ARG(f[3]));
        if (!str_equal(entry->via, f[0]))
            strbuf_format(out, "\t%.*s", STR_ARG(entry->via));
        strbuf_char(out, '\n');
        findings += entry->count;
    }
    return findings;
}
