// A package on the disk: made under a temporary name, loaded again and compared, then named.
#include "diag/codes/file.h"
#include "edit/pack/pack.h"

#include "core/strbuf.h"
#include "files/files_walk.h"
#include "files/output.h"
#include "files/temporary.h"
#include "grammar/ir_walk.h"
#include "grammar/print/ir_print.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    PATH_BYTES = 4096,
};

static bool fail(struct pack_error *error, const char *format, ...) __attribute__((format(printf, 2, 3)));
static bool fail(struct pack_error *error, const char *format, ...) {
    va_list args;
    va_start(args, format);
    vsnprintf(error->text, sizeof error->text, format, args);
    va_end(args);
    return false;
}

// ---- files

// The folders above a file of the package.
static bool make_folders(char *path, size_t from) {
    for (char *slash = strchr(path + from, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        int made = mkdir(path, 0777);
        *slash = '/';
        if (made != 0 && errno != EEXIST)
            return false;
    }
    return true;
}

struct copying {
    struct session *session;
    const struct pack_file *file;
    const char *path;
    struct pack_error *error;
    struct arena arena;
    bool good;
};

static void copy(void *context) {
    struct copying *c = context;
    str bytes = c->file->text;
    enum file_status status = FILE_OK;
    if (c->file->path.len)
        status = files_read(&c->session->files, c->file->path, UINT64_MAX / 4, &c->arena, &bytes);
    int wrong = status == FILE_OK ? output_part(c->path, bytes.ptr, bytes.len) : 0;
    c->good = status == FILE_OK && wrong == 0;
    if (status != FILE_OK)
        fail(c->error, "'%.*s' %s", STR_ARG(c->file->path), file_status_text(&c->session->files, status));
    else if (wrong)
        fail(c->error, "'%.*s' cannot be written: %s", STR_ARG(c->file->target), strerror(wrong));
}

static bool write_file(struct session *session, const struct pack_file *file, const char *folder,
                       struct pack_error *error) {
    char path[PATH_BYTES];
    if (snprintf(path, sizeof path, "%s/%.*s", folder, STR_ARG(file->target)) >= (int)sizeof path)
        return fail(error, "the path of '%.*s' is too long", STR_ARG(file->target));
    if (!make_folders(path, strlen(folder) + 1))
        return fail(error, "cannot make the folder of '%.*s': %s", STR_ARG(file->target), strerror(errno));
    struct copying copying = {.session = session, .file = file, .path = path, .error = error};
    struct arena *arenas[] = {&copying.arena, &session->arena, NULL};
    arena_init(&copying.arena, SIZE_MAX / 2);
    if (arena_guarded_all(arenas, copy, &copying) != ARENA_FAULT_NONE)
        fail(error, "there is not enough memory for '%.*s'", STR_ARG(file->target));
    arena_finish(&copying.arena);
    return copying.good;
}

// ---- comparing

static void forget_path(void *context, const struct schema_element *schema, void *element,
                        const struct schema_row *row, str *path) {
    (void)context;
    (void)schema;
    (void)element;
    (void)row;
    *path = STR("x");
}

// What the scene means apart from its paths. It changes the scene.
static void dump(struct session *session, struct strbuf *out) {
    strbuf_init(out);
    ir_walk_paths(session->scene, forget_path, NULL);
    ir_dump(session->scene, out);
}

// Whether the packed scene reads a file in place of each one that the scene reads.
static bool same_files(struct session *session, const struct inventory *after, const struct pack_plan *plan,
                       const char *folder) {
    const struct inventory *before = plan->inventory;
    uint32_t a = 0;
    uint32_t b = 0;
    char path[PATH_BYTES];
    for (;; a++, b++) {
        while (a < before->count && before->items[a].role == INVENTORY_SETTINGS)
            a++;
        // The scene around a mesh was not a file before.
        while (b < after->count && (after->items[b].role == INVENTORY_SETTINGS ||
                                    (after->items[b].role == INVENTORY_SCENE && a < before->count &&
                                     before->items[a].role != INVENTORY_SCENE)))
            b++;
        if (a == before->count || b == after->count)
            return a == before->count && b == after->count;
        bool same = false;
        for (uint32_t i = 0; i < plan->count && !same; i++) {
            if (!str_equal(plan->items[i].canonical, before->items[a].canonical))
                continue;
            snprintf(path, sizeof path, "%s/%.*s", folder, STR_ARG(plan->items[i].target));
            same = str_equal(files_canonical(&session->files, str_from(path)), after->items[b].canonical);
        }
        if (!same)
            return false;
    }
}

struct matching {
    struct session *session;
    const struct inventory *after;
    const struct pack_plan *plan;
    const char *folder;
    bool same;
};

static void match_files(void *context) {
    struct matching *m = context;
    m->same = same_files(m->session, m->after, m->plan, m->folder);
}

static bool compare(struct session *session, struct session *packed, const struct pack_plan *plan,
                    const char *folder) {
    struct inventory after;
    if (packed->state != SESSION_LOADED || packed->sink.errors || !inventory_make(packed, &after))
        return false;
    struct matching matching = {session, &after, plan, folder, false};
    arena_guarded(&session->arena, match_files, &matching);
    if (!matching.same)
        return false;
    struct strbuf old_text;
    struct strbuf new_text;
    dump(session, &old_text);
    dump(packed, &new_text);
    bool same =
        !old_text.failed && !new_text.failed && str_equal(strbuf_view(&old_text), strbuf_view(&new_text));
    strbuf_finish(&old_text);
    strbuf_finish(&new_text);
    return same;
}

// A fault of the system, not of the package. NULL: there is none.
static const struct diag *what_is_unreadable(const struct session *packed) {
    for (uint32_t i = 0; i < packed->sink.count; i++)
        if (packed->sink.items[i].code == DIAG_FILE_UNREADABLE)
            return &packed->sink.items[i];
    return NULL;
}

// Loads the package from its folder and compares it with what was packed.
static bool verify(struct session *session, const struct pack_plan *plan, const char *folder,
                   struct pack_error *error) {
    char path[PATH_BYTES];
    struct session packed;
    if (snprintf(path, sizeof path, "%s/%.*s", folder, STR_ARG(plan->items[0].target)) >= (int)sizeof path)
        return fail(error, "the path is too long");
    struct asset_store *store = asset_store_create();
    if (!store)
        return fail(error, "there is not enough memory to load the package");
    struct session_options options = {
        .path = str_from(path), .limits = session->options.limits, .pixels = ASSETS_SKIP_PIXELS};
    session_load(&packed, &options, store);
    bool same = compare(session, &packed, plan, folder);
    const struct diag *unread = same ? NULL : what_is_unreadable(&packed);
    if (unread)
        fail(error, "the package cannot be read back: %.*s", STR_ARG(unread->message));
    session_finish(&packed);
    asset_store_destroy(store);
    return same ||
           (!unread && fail(error, "a path in the scene is written in a way that cannot be changed in place; "
                                   "write each path on one line, without a YAML tag or a block"));
}

// ---- all

struct look {
    const char *path;
    struct arena arena;
    bool taken;
};

static void look_into(void *context) {
    struct look *look = context;
    struct files_names names = {0};
    look->taken = !files_list_folder(&look->arena, str_from(look->path), &names) || names.count > 0;
}

// A folder that exists and is empty may be used.
static bool is_taken(const char *path) {
    struct stat info;
    struct look look = {.path = path, .taken = true};
    if (lstat(path, &info) != 0)
        return false;
    arena_init(&look.arena, SIZE_MAX / 2);
    arena_guarded(&look.arena, look_into, &look);
    arena_finish(&look.arena);
    return look.taken;
}

// Makes a new folder beside `out`, so that it can be renamed. Its name does not get longer with that of
// `out`.
static bool make_folder_beside(const char *out, size_t length, char *folder, struct pack_error *error) {
    while (length > 0 && out[length - 1] != '/')
        length--;
    if (snprintf(folder, PATH_BYTES, "%.*s.glint-XXXXXX", (int)length, out) >= PATH_BYTES)
        return fail(error, "the path is too long");
    return mkdtemp(folder) || fail(error, "cannot make a folder next to it: %s", strerror(errno));
}

static bool name_folder(const char *folder, const char *out, struct pack_error *error) {
    const mode_t mask = umask(0);
    umask(mask);
    return (chmod(folder, 0777 & ~mask) == 0 && rename(folder, out) == 0) ||
           fail(error, "%s", strerror(errno));
}

enum pack_status pack_write(struct session *session, const struct pack_plan *plan, const char *out,
                            pack_is_stopped *is_stopped, struct pack_error *error) {
    char folder[PATH_BYTES];
    size_t length = strlen(out);
    while (length > 1 && out[length - 1] == '/')
        length--;
    bool zips = str_ends_with_nocase((str){out, length}, ".zip");
    if (!zips && is_taken(out)) {
        fail(error, "it exists and is not an empty folder");
        return PACK_OUTPUT;
    }
    if (!make_folder_beside(out, length, folder, error))
        return PACK_OUTPUT;
    struct temporary entry;
    temporary_note(&entry, folder);
    bool stopped = false;
    bool good = true;
    for (uint32_t i = 0; good && i < plan->count; i++) {
        stopped = is_stopped && is_stopped();
        good = !stopped && write_file(session, &plan->items[i], folder, error);
    }
    good = good && verify(session, plan, folder, error);
    stopped = is_stopped && is_stopped();
    if (good && !stopped)
        good = zips ? pack_zip(plan, folder, out, is_stopped, error) : name_folder(folder, out, error);
    stopped = stopped || (!good && is_stopped && is_stopped());
    bool removed = (good && !stopped && !zips) || temporary_remove(folder);
    if (!removed && good)
        good = fail(error, "the temporary folder '%s' cannot be removed: %s", folder, strerror(errno));
    temporary_forget(&entry);
    if (stopped)
        return PACK_STOPPED;
    return good ? PACK_OK : PACK_OUTPUT;
}
