#include "edit/fixes.h"
#include "diag/codes/file.h"

#include "core/text_edit.h"
#include "edit/layout.h"
#include "load/check.h"

#include <stdlib.h>

enum {
    ROUNDS_MAX = 8
};

struct fixer {
    struct fixes *fixes;
    const struct session_options *given;
    struct session_options options; // its overlays: the files as they are now
    enum fix_level level;
    struct asset_store *store;
    struct {
        struct text_edit *items;
        uint32_t count, capacity;
    } edits; // of one file
    struct {
        struct tried *items;
        uint32_t count, capacity;
    } tried; // places that the last round changed, in the new texts
};

struct tried {
    uint32_t file; // in fixes.files
    uint32_t begin, end;
    diag_code code;
};

// ---- which findings, in which files

static bool is_wanted(const struct fixer *f, const struct diag *item) {
    return item->has_fix && (item->fix_is_safe || f->level == FIX_ALL) &&
           item->fix_at.source != SOURCE_DEFAULT;
}

// Only scenes: not the configuration, options or the scene made around a mesh.
static bool is_scene(const struct session *session, uint32_t source) {
    const struct source *s = &session->sources.items[source];
    if (s->kind != SOURCE_KIND_FILE)
        return false;
    for (uint32_t i = 0; i < session->origin.files.count; i++)
        if (session->origin.files.items[i].source == source)
            return true;
    return str_equal(s->path, session->options.path);
}

static struct fixed_file *find_file(struct fixer *f, struct session *session, uint32_t source) {
    struct fixes *fixes = f->fixes;
    const struct source *s = &session->sources.items[source];
    str canonical = files_canonical(&session->files, s->path);
    for (uint32_t i = 0; i < fixes->files.count; i++)
        if (str_equal(fixes->files.items[i].canonical, canonical))
            return &fixes->files.items[i];
    struct fixed_file *file = ARENA_PUSH(&fixes->arena, &fixes->files);
    *file = (struct fixed_file){.path = arena_copy(&fixes->arena, s->path),
                                .canonical = arena_copy(&fixes->arena, canonical),
                                .before = arena_copy(&fixes->arena, s->text)};
    file->text = file->before;
    return file;
}

static str shown_path(struct session *session, str path) {
    str rest;
    return path_is_below(path, files_canonical(&session->files, STR(".")), &rest) ? rest : path;
}

// Creates files. Returns how many no earlier round has created.
static uint32_t create_files(struct fixer *f, struct session *session) {
    struct fixes *fixes = f->fixes;
    uint32_t created = 0;
    for (uint32_t i = 0; i < session->sink.count; i++) {
        const struct diag *item = &session->sink.items[i];
        bool known = item->fix_file.len == 0 || !(item->fix_is_safe || f->level == FIX_ALL);
        for (uint32_t k = 0; k < fixes->files.count && !known; k++)
            known = str_equal(fixes->files.items[k].canonical, item->fix_file);
        if (known)
            continue;
        *ARENA_PUSH(&fixes->arena, &fixes->files) =
            (struct fixed_file){.path = arena_copy(&fixes->arena, shown_path(session, item->fix_file)),
                                .canonical = arena_copy(&fixes->arena, item->fix_file),
                                .text = arena_copy(&fixes->arena, item->fix_text),
                                .changes = 1,
                                .is_new = true};
        created++;
    }
    return created;
}

// ---- one round

// The number of changes of the last round to one file that begin before `end`; they are in the order of its
// text.
static uint32_t count_before(const struct fixer *f, uint32_t file, uint32_t end) {
    uint32_t low = 0, high = f->tried.count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        const struct tried *tried = &f->tried.items[middle];
        bool before = tried->file < file || (tried->file == file && tried->begin <= end);
        low = before ? middle + 1 : low;
        high = before ? high : middle;
    }
    return low;
}

// If a place that was changed for a finding has one of the same kind again, the change did not help.
static void refuse_what_failed(struct fixer *f, struct session *session) {
    for (uint32_t i = 0; i < session->sink.count && f->tried.count; i++) {
        const struct diag *item = &session->sink.items[i];
        if (!is_wanted(f, item) || !is_scene(session, item->fix_at.source))
            continue;
        struct fixed_file *file = find_file(f, session, item->fix_at.source);
        uint32_t number = (uint32_t)(file - f->fixes->files.items);
        for (uint32_t t = count_before(f, number, item->at.end); t > 0 && !file->refused; t--) {
            const struct tried *tried = &f->tried.items[t - 1];
            if (tried->file != number || tried->end < item->at.begin)
                break;
            file->refused = item->code == tried->code;
        }
    }
    f->tried.count = 0;
}

static int compare_tried(const void *left, const void *right) {
    const struct tried *a = left, *b = right;
    if (a->file != b->file)
        return a->file < b->file ? -1 : 1;
    return a->begin < b->begin ? -1 : a->begin > b->begin;
}

static void note_tried(struct fixer *f, const struct session *session, uint32_t file, uint32_t kept) {
    int64_t moved = 0;
    for (uint32_t i = 0; i < kept; i++) {
        const struct text_edit *edit = &f->edits.items[i];
        uint32_t begin = (uint32_t)(edit->begin + moved);
        struct tried *tried = ARENA_PUSH(&f->fixes->arena, &f->tried);
        *tried = (struct tried){file, begin, begin + (uint32_t)edit->text.len,
                                session->sink.items[edit->order].code};
        moved += (int64_t)edit->text.len - (int64_t)(edit->end - edit->begin);
    }
}

// Makes all changes of this round to the file of one source; returns their number.
static uint32_t change_file(struct fixer *f, struct session *session, uint32_t source) {
    f->edits.count = 0;
    for (uint32_t i = 0; i < session->sink.count; i++) {
        const struct diag *item = &session->sink.items[i];
        if (item->fix_at.source != source || !is_wanted(f, item))
            continue;
        str text = arena_copy(&f->fixes->arena, item->fix_text);
        *ARENA_PUSH(&f->fixes->arena, &f->edits) =
            (struct text_edit){item->fix_at.begin, item->fix_at.end, text, i};
    }
    if (f->edits.count == 0)
        return 0;
    struct fixed_file *file = find_file(f, session, source);
    if (file->refused)
        return 0;
    struct strbuf out;
    strbuf_init(&out);
    uint32_t kept = text_edits_settle(f->edits.items, f->edits.count);
    text_edits_apply(session->sources.items[source].text, f->edits.items, kept, &out);
    f->fixes->failed = f->fixes->failed || out.failed;
    bool changed = !out.failed && !str_equal(strbuf_view(&out), file->text);
    if (changed) {
        file->text = arena_copy(&f->fixes->arena, strbuf_view(&out));
        file->changes += kept;
        note_tried(f, session, (uint32_t)(file - f->fixes->files.items), kept);
    }
    strbuf_finish(&out);
    return changed ? kept : 0;
}

struct round {
    struct fixer *fixer;
    struct session session;
    uint32_t made;
};

static void change_files(void *context) {
    struct round *round = context;
    const struct session *session = &round->session;
    if (session->state == SESSION_UNREADABLE && session->sink.count &&
        session->sink.items[0].code == DIAG_FILE_UNREADABLE) {
        struct fixes *fixes = round->fixer->fixes;
        fixes->unreadable = arena_copy(&fixes->arena, session->sink.items[0].message);
        return;
    }
    refuse_what_failed(round->fixer, &round->session);
    for (uint32_t source = 1; source < round->session.sources.count; source++)
        if (is_scene(&round->session, source))
            round->made += change_file(round->fixer, &round->session, source);
    round->made += create_files(round->fixer, &round->session);
    struct fixer *f = round->fixer;
    if (f->tried.count)
        qsort(f->tried.items, f->tried.count, sizeof *f->tried.items, compare_tried);
}

static bool round_of(struct fixer *f) {
    struct round round = {.fixer = f};
    struct arena *arenas[] = {&f->fixes->arena, &round.session.arena, NULL};
    check_scene(&round.session, &f->options, f->store);
    bool whole = arena_guarded_all(arenas, change_files, &round) == ARENA_FAULT_NONE;
    f->fixes->failed = f->fixes->failed || !whole;
    session_finish(&round.session);
    return whole && round.made > 0;
}

// ---- all rounds

static void set_overlays(struct fixer *f) {
    struct fixes *fixes = f->fixes;
    const struct session_options *given = f->given;
    uint32_t count = given->overlay_count + fixes->files.count;
    struct file_overlay *overlays = ARENA_ARRAY(&fixes->arena, struct file_overlay, count + 1);
    for (uint32_t i = 0; i < given->overlay_count; i++)
        overlays[i] = given->overlays[i];
    for (uint32_t i = 0; i < fixes->files.count; i++) {
        const struct fixed_file *file = &fixes->files.items[i];
        overlays[given->overlay_count + i] =
            (struct file_overlay){file->canonical, file->refused ? file->before : file->text};
    }
    f->options.overlays = overlays;
    f->options.overlay_count = count;
}

static void take_back_what_is_broken(struct fixer *f) {
    struct fixes *fixes = f->fixes;
    for (uint32_t i = 0; i < fixes->files.count; i++) {
        struct fixed_file *file = &fixes->files.items[i];
        if (file->is_new)
            continue;
        struct layout layout;
        enum layout_status status = layout_text(&layout, file->path, file->text, &f->options.limits, false);
        layout_finish(&layout);
        file->refused = file->refused || status == LAYOUT_REFUSED;
        if (file->refused)
            file->text = file->before;
    }
}

static void make_all(void *context) {
    struct fixer *f = context;
    for (unsigned round = 0; round < ROUNDS_MAX && !f->fixes->failed && round_of(f); round++)
        set_overlays(f);
    take_back_what_is_broken(f);
}

void fixes_make(struct fixes *fixes, const struct session_options *options, enum fix_level level,
                struct asset_store *store) {
    *fixes = (struct fixes){0};
    arena_init(&fixes->arena, limits_size(&options->limits, LIMIT_SCENE_MEMORY));
    struct fixer f = {.fixes = fixes, .given = options, .options = *options, .level = level, .store = store};
    if (arena_guarded(&fixes->arena, make_all, &f) != ARENA_FAULT_NONE)
        fixes->failed = true;
}

void fixes_finish(struct fixes *fixes) {
    arena_finish(&fixes->arena);
}
