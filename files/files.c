#include "files/files.h"

#include "core/heap.h"
#include "core/nearest.h"
#include "core/parallel.h"
#include "files/door.h"
#include "files/folder.h"
#include "files/output.h"
#include "files/sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    SUGGEST_ENTRIES_MAX = 10000,
    PIECE_BYTES = 4 << 20, // how much of a large file is read at a time
    PIECES_MAX = 1024,
    MISSES_MAX = 256,
};

void files_init(struct files *files, struct arena *arena) {
    *files = (struct files){.arena = arena};
}

str path_folder(str path) {
    size_t at = path.len;
    while (at > 0 && path.ptr[at - 1] != '/')
        at--;
    if (at == 0)
        return STR(".");
    return str_slice(path, 0, at == 1 ? 1 : at - 1);
}

str path_base(str path) {
    size_t at = path.len;
    while (at > 0 && path.ptr[at - 1] != '/')
        at--;
    return str_slice(path, at, path.len);
}

str path_join(struct arena *arena, str folder, str path) {
    if (path.len && path.ptr[0] == '/')
        return arena_copy(arena, path);
    if (str_equal(folder, STR(".")))
        return arena_copy(arena, path);
    bool slash = folder.len && folder.ptr[folder.len - 1] == '/';
    return arena_format(arena, "%.*s%s%.*s", STR_ARG(folder), slash ? "" : "/", STR_ARG(path));
}

bool path_is_below(str path, str folder, str *rest) {
    while (folder.len && folder.ptr[folder.len - 1] == '/')
        folder.len--;
    *rest = str_slice(path, folder.len + 1, path.len);
    return str_starts_with(path, folder) && (path.len == folder.len || path.ptr[folder.len] == '/');
}

// A NUL-terminated copy of a path; NULL if it contains a NUL or is too long for the system.
static const char *system_path(struct files *files, str path) {
    if (path.len == 0 || path.len >= PATH_MAX || memchr(path.ptr, '\0', path.len))
        return NULL;
    return arena_copy(files->arena, path).ptr;
}

// false: errno says why.
static bool resolve_links(struct files *files, str path, str *resolved) {
    const char *name = system_path(files, path);
    char text[PATH_MAX];
    if (!name)
        errno = ENOENT;
    if (!name || !realpath(name, text)) {
        if (errno == ENOMEM)
            heap_exhausted(0);
        return false;
    }
    *resolved = arena_copy(files->arena, str_from(text));
    return true;
}

str files_canonical(struct files *files, str path) {
    str resolved;
    if (resolve_links(files, path, &resolved))
        return resolved;
    // A file that is not written yet already has a folder.
    str base = path_base(path);
    if (base.len && !str_equal(base, STR("..")) && resolve_links(files, path_folder(path), &resolved))
        return path_join(files->arena, resolved, base);
    return arena_copy(files->arena, path);
}

// The last one added: an editor's newest text counts.
static const struct file_overlay *find_overlay(const struct files *files, str canonical) {
    for (uint32_t i = files->overlays.count; i > 0; i--)
        if (str_equal(files->overlays.items[i - 1].path, canonical))
            return &files->overlays.items[i - 1];
    return NULL;
}

void files_add_overlay(struct files *files, str path, str text) {
    struct file_overlay *overlay = ARENA_PUSH(files->arena, &files->overlays);
    *overlay = (struct file_overlay){files_canonical(files, path), arena_copy(files->arena, text)};
}

static enum file_status status_of_errno(struct files *files, int error) {
    if (error == ENOMEM)
        heap_exhausted(0);
    files->system_error = error;
    return error == ENOENT || error == ENOTDIR ? FILE_MISSING : FILE_UNREADABLE;
}

static void *copy_list(struct arena *arena, const void *items, uint32_t count, size_t size) {
    return count ? memcpy(arena_alloc(arena, heap_times(count, size)), items, count * size) : NULL;
}

#define COPY_LIST(name)                                                                                      \
    (out->name.items = copy_list(arena, from->name.items, from->name.count, sizeof *from->name.items),       \
     out->name.capacity = from->name.count)

void files_copy(const struct files *from, struct arena *arena, struct files *out) {
    *out = *from;
    out->arena = arena;
    COPY_LIST(roots);
    COPY_LIST(given);
    COPY_LIST(overlays);
    COPY_LIST(log);
    COPY_LIST(missed);
}

bool files_are_same(const struct files *files) {
    struct stat info;
    for (uint32_t i = 0; i < files->log.count; i++) {
        const struct file_read *read = &files->log.items[i];
        if (stat(read->path.ptr, &info) != 0 || (uint64_t)info.st_size != read->size_bytes ||
            (int64_t)info.st_mtim.tv_sec * 1000000000 + info.st_mtim.tv_nsec != read->modified_ns)
            return false;
    }
    for (uint32_t i = 0; i < files->missed.count; i++)
        if (stat(files->missed.items[i].ptr, &info) == 0)
            return false;
    return true;
}

enum file_status files_add_root(struct files *files, str directory) {
    const char *name = system_path(files, directory);
    struct stat info;
    if (!name)
        return FILE_MISSING;
    if (stat(name, &info) != 0)
        return status_of_errno(files, errno);
    if (!S_ISDIR(info.st_mode))
        return FILE_NOT_REGULAR;
    str canonical = files_canonical(files, directory);
    for (uint32_t i = 0; i < files->roots.count; i++)
        if (str_equal(files->roots.items[i], canonical))
            return FILE_OK;
    *ARENA_PUSH(files->arena, &files->roots) = canonical;
    return FILE_OK;
}

str files_find_config(struct files *files, str scene_path) {
    str above = files_canonical(files, path_folder(scene_path));
    for (;;) {
        str marker = path_join(files->arena, above, STR(FILES_CONFIG_NAME));
        struct stat info;
        if ((stat(marker.ptr, &info) == 0 && S_ISREG(info.st_mode)) || find_overlay(files, marker))
            return marker;
        if (above.len <= 1)
            return STR("");
        above = path_folder(above);
    }
}

static enum file_status outside(void) {
    sandbox_refuse();
    return FILE_OUTSIDE;
}

// The root that the path is below, or NULL.
static const str *root_above(const struct files *files, str canonical) {
    str rest;
    for (uint32_t i = 0; i < files->roots.count; i++)
        if (path_is_below(canonical, files->roots.items[i], &rest))
            return &files->roots.items[i];
    return NULL;
}

static bool below_a_root(const struct files *files, str canonical) {
    return root_above(files, canonical);
}

static void log_miss(struct files *files, str canonical) {
    if (files->missed.count == MISSES_MAX)
        return;
    for (uint32_t i = 0; i < files->missed.count; i++)
        if (str_equal(files->missed.items[i], canonical))
            return;
    *ARENA_PUSH(files->arena, &files->missed) = canonical;
}

static enum file_status try_path(struct files *files, str path, str *out) {
    *out = path;
    str canonical;
    bool exists = resolve_links(files, path, &canonical);
    int error = errno;
    if (!exists)
        canonical = files_canonical(files, path);
    bool allowed = below_a_root(files, canonical);
    if (find_overlay(files, canonical) && (allowed || files->roots.count == 0))
        return FILE_OK;
    if (!exists) {
        log_miss(files, canonical);
        return status_of_errno(files, error);
    }
    if (allowed)
        return FILE_OK;
    *out = canonical;
    struct stat info;
    bool is_device = stat(canonical.ptr, &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
    return is_device ? FILE_NOT_REGULAR : outside();
}

enum file_status files_resolve(struct files *files, str base_path, str path, str *out) {
    enum file_status status = try_path(files, path_join(files->arena, path_folder(base_path), path), out);
    if (status != FILE_MISSING || (path.len && path.ptr[0] == '/'))
        return status;
    str first = *out;
    for (uint32_t i = 1; i < files->roots.count; i++) {
        enum file_status other = try_path(files, path_join(files->arena, files->roots.items[i], path), out);
        if (other != FILE_MISSING)
            return other;
    }
    *out = first;
    return FILE_MISSING;
}

static bool may_read(const struct files *files, str canonical, str folder) {
    str rest;
    if (below_a_root(files, canonical) || (folder.len && path_is_below(canonical, folder, &rest)))
        return true;
    for (uint32_t i = 0; i < files->given.count; i++)
        if (str_equal(canonical, files->given.items[i]))
            return true;
    return false;
}

// Where a path leads, if it may be read.
static enum file_status confine(struct files *files, str path, str folder, str *canonical) {
    if (!resolve_links(files, path, canonical))
        return status_of_errno(files, errno);
    if (folder.len)
        folder = files_canonical(files, folder);
    return may_read(files, *canonical, folder) ? FILE_OK : outside();
}

enum file_status files_confine(struct files *files, str path, str folder) {
    str canonical;
    return confine(files, path, folder, &canonical);
}

static void log_read(struct files *files, str path, const struct stat *info) {
    str canonical = files_canonical(files, path);
    for (uint32_t i = 0; i < files->log.count; i++)
        if (str_equal(files->log.items[i].path, canonical))
            return;
    struct file_read *entry = ARENA_PUSH(files->arena, &files->log);
    *entry = (struct file_read){canonical, (uint64_t)info->st_size,
                                (int64_t)info->st_mtim.tv_sec * 1000000000 + info->st_mtim.tv_nsec};
}

// A large file is read in pieces in parallel: its memory is new, and touching it first takes as long as the
// copying.
struct pieces {
    int fd;
    char *data;
    size_t got[PIECES_MAX];
    int error[PIECES_MAX]; // 0: none
};

static void read_piece(void *context, size_t begin, size_t end) {
    struct pieces *p = context;
    size_t at = begin;
    while (at < end) {
        const ssize_t n = pread(p->fd, p->data + at, end - at, (off_t)at);
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0)
            p->error[begin / PIECE_BYTES] = errno;
        if (n <= 0)
            break;
        at += (size_t)n;
    }
    p->got[begin / PIECE_BYTES] = at - begin;
}

// Returns how many bytes there are, fewer if the file ends early; -1: errno says why.
static ssize_t read_pieces(int fd, char *data, size_t size) {
    struct pieces pieces = {.fd = fd, .data = data};
    size_t got = 0;
    parallel_for(size, PIECE_BYTES, read_piece, &pieces);
    for (size_t i = 0; i * PIECE_BYTES < size; i++) {
        errno = pieces.error[i];
        if (errno)
            return -1;
        if (got == i * PIECE_BYTES)
            got += pieces.got[i];
    }
    return (ssize_t)got;
}

static ssize_t read_in_order(int fd, char *data, size_t size) {
    size_t got = 0;
    while (got < size) {
        ssize_t n = read(fd, data + got, size - got);
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0)
            return n;
        if (n == 0)
            break;
        got += (size_t)n;
    }
    return (ssize_t)got;
}

static enum file_status read_all(struct files *files, int fd, uint64_t size_bytes, struct arena *into,
                                 str *contents) {
    char *data = arena_try_alloc_array(into, size_bytes + 1, 1);
    if (!data)
        return FILE_NO_MEMORY;
    const size_t size = (size_t)size_bytes;
    const bool in_pieces = size > PIECE_BYTES && size <= (size_t)PIECE_BYTES * PIECES_MAX;
    const ssize_t got = in_pieces ? read_pieces(fd, data, size) : read_in_order(fd, data, size);
    if (got < 0)
        return status_of_errno(files, errno);
    data[got] = '\0';
    *contents = (str){data, (size_t)got};
    return FILE_OK;
}

static enum file_status status_of_open(struct files *files, int error) {
    if (error == ELOOP) // a link has taken its place since it was judged
        return outside();
    return error == ENXIO || error == EISDIR ? FILE_NOT_REGULAR : status_of_errno(files, error);
}

static enum file_status read_open(struct files *files, int fd, str path, uint64_t cap_bytes,
                                  struct arena *into, str *contents) {
    struct stat info;
    enum file_status status = FILE_OK;
    if (fstat(fd, &info) != 0)
        status = status_of_errno(files, errno);
    else if (!S_ISREG(info.st_mode))
        status = FILE_NOT_REGULAR;
    else if ((uint64_t)info.st_size > cap_bytes)
        status = FILE_TOO_LARGE;
    else
        status = read_all(files, fd, (uint64_t)info.st_size, into, contents);
    close(fd);
    if (status == FILE_OK)
        log_read(files, path, &info);
    return status;
}

// Text from memory. false: there is none for this path.
static bool read_overlay(struct files *files, str path, uint64_t cap_bytes, str *contents,
                         enum file_status *status) {
    const struct file_overlay *overlay = find_overlay(files, files_canonical(files, path));
    *contents = overlay ? overlay->text : STR("");
    *status = overlay && overlay->text.len > cap_bytes ? FILE_TOO_LARGE : FILE_OK;
    return overlay;
}

enum file_status files_read_found(struct files *files, str path, str folder, uint64_t cap_bytes,
                                  struct arena *into, str *contents) {
    enum file_status status;
    str canonical;
    if (read_overlay(files, path, cap_bytes, contents, &status))
        return status;
    status = confine(files, path, folder, &canonical);
    if (status != FILE_OK)
        return status;
    const int fd = door_open(canonical.ptr, O_RDONLY);
    return fd < 0 ? status_of_open(files, errno) : read_open(files, fd, path, cap_bytes, into, contents);
}

enum file_status files_read(struct files *files, str path, uint64_t cap_bytes, struct arena *into,
                            str *contents) {
    return files_read_found(files, path, STR(""), cap_bytes, into, contents);
}

enum file_status files_read_given(struct files *files, str path, uint64_t cap_bytes, struct arena *into,
                                  str *contents) {
    enum file_status status;
    if (read_overlay(files, path, cap_bytes, contents, &status))
        return status;
    const char *name = system_path(files, path);
    if (!name)
        return FILE_MISSING;
    const int fd = open(name, O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (fd < 0)
        return errno == ELOOP ? status_of_errno(files, errno) : status_of_open(files, errno);
    *ARENA_PUSH(files->arena, &files->given) = files_canonical(files, path);
    return read_open(files, fd, path, cap_bytes, into, contents);
}

// ---- writing

// The folder of a canonical path, open; those that are not there are made, below a root.
static int open_folder(struct files *files, str canonical) {
    const str folder = arena_copy(files->arena, path_folder(canonical));
    const int fd = door_folder(folder.ptr);
    if (fd >= 0 || errno != ENOENT || !below_a_root(files, folder))
        return fd;
    const int above = open_folder(files, folder);
    if (above < 0)
        return -1;
    const int error = mkdirat(above, path_base(folder).ptr, 0777) != 0 && errno != EEXIST ? errno : 0;
    close(above);
    errno = error;
    return error ? -1 : door_folder(folder.ptr);
}

// As files_canonical, also for a path whose last folders do not exist yet; empty: it cannot be determined.
// What looks missing may be a link that leads nowhere: opening does not follow it.
static str canonical_to_be(struct files *files, str path) {
    str resolved;
    const str base = path_base(path);
    if (resolve_links(files, path, &resolved))
        return resolved;
    // '..' from a folder that does not exist leads to an unknown place.
    if (errno != ENOENT || !base.len || str_equal(base, STR("..")) || str_equal(base, STR(".")))
        return STR("");
    const str folder = canonical_to_be(files, path_folder(path));
    return folder.len ? path_join(files->arena, folder, base) : folder;
}

enum file_status files_place(struct files *files, str path, str *root) {
    const str *above = root_above(files, canonical_to_be(files, path));
    *root = above ? *above : STR("");
    return above ? FILE_OK : outside();
}

enum file_status files_write(struct files *files, str path, struct output *output) {
    const str canonical = canonical_to_be(files, path);
    *output = (struct output){.fd = -1};
    if (!below_a_root(files, canonical))
        return outside();
    const int folder = open_folder(files, canonical);
    if (folder < 0)
        return status_of_open(files, errno);
    const bool good = output_open_in(output, folder, canonical.ptr);
    return good ? FILE_OK : status_of_open(files, output->error);
}

enum file_status files_identify(struct files *files, str path, struct file_read *out) {
    *out = (struct file_read){.path = files_canonical(files, path)};
    const struct file_overlay *overlay = find_overlay(files, out->path);
    if (overlay) {
        out->size_bytes = overlay->text.len;
        out->modified_ns = (int64_t)str_hash(overlay->text);
        return FILE_OK;
    }
    const char *name = system_path(files, path);
    struct stat info;
    if (!name)
        return FILE_MISSING;
    if (stat(name, &info) != 0)
        return status_of_errno(files, errno);
    if (!S_ISREG(info.st_mode))
        return FILE_NOT_REGULAR;
    out->size_bytes = (uint64_t)info.st_size;
    out->modified_ns = (int64_t)info.st_mtim.tv_sec * 1000000000 + info.st_mtim.tv_nsec;
    log_read(files, path, &info);
    return FILE_OK;
}

// Where the ending of a name begins: at its last dot, or at its end.
static size_t ending_of(str name) {
    for (size_t at = name.len; at > 1; at--)
        if (name.ptr[at - 1] == '.')
            return at - 1;
    return name.len;
}

static bool has_ending(str name, const char *const *endings) {
    for (; endings && *endings; endings++)
        if (str_ends_with_nocase(name, *endings))
            return true;
    return !endings;
}

str files_suggest(struct files *files, str path, const char *const *endings) {
    str folder = files_canonical(files, path_folder(path));
    DIR *directory = below_a_root(files, folder) ? folder_behind(folder.ptr) : NULL;
    if (!directory)
        return STR("");
    // Endings that are equal would make any two short names look alike.
    str name = path_base(path);
    size_t dot = ending_of(name);
    struct nearest stems = nearest_begin(str_slice(name, 0, dot));
    struct nearest names = nearest_begin(name);
    char best[NAME_MAX + 1] = "";
    struct dirent *entry;
    for (int left = SUGGEST_ENTRIES_MAX; left > 0 && (entry = folder_next(directory)); left--) {
        str candidate = str_from(entry->d_name);
        if (!has_ending(candidate, endings))
            continue;
        str stem = str_slice(candidate, 0, ending_of(candidate));
        // A name without an ending is taken to have lost it.
        bool same_ending =
            dot == name.len || nearest_distance(str_slice(name, dot, name.len),
                                                str_slice(candidate, stem.len, candidate.len)) == 0;
        struct nearest *search = same_ending ? &stems : &names;
        str offered = same_ending ? stem : candidate;
        unsigned before = search->best_distance;
        nearest_offer(search, offered);
        // Folder entries have no order: of equally near names, take the first alphabetically.
        bool equal = before != UINT_MAX && nearest_distance(search->word, offered) == before;
        bool better = search->best_distance < before || (equal && str_compare(candidate, str_from(best)) < 0);
        if (!better || (!same_ending && stems.best.len))
            continue;
        snprintf(best, sizeof best, "%s", entry->d_name);
        // The entry's memory belongs to the directory.
        search->best = str_from(best);
    }
    closedir(directory);
    return arena_copy(files->arena, str_from(best));
}

str files_advice(struct arena *arena, str path) {
    if (path.len > 2 && char_is_letter(path.ptr[0]) && path.ptr[1] == ':')
        return STR("paths are relative to the file that contains them, with '/' between folders");
    if (path.len && path.ptr[0] == '~')
        return STR("'~' is not expanded: paths are relative to the file that contains them");
    if (path.len && path.ptr[0] == '$')
        return STR("variables are not expanded: paths are relative to the file that contains them");
    for (size_t at = 0; at + 3 <= path.len; at++)
        if (memcmp(path.ptr + at, "://", 3) == 0)
            return STR("only files are read, not addresses");
    if (path.len == 0 || !memchr(path.ptr, '\\', path.len))
        return STR("");
    str copy = arena_copy(arena, path);
    for (size_t at = 0; at < copy.len; at++)
        if (copy.ptr[at] == '\\')
            ((char *)copy.ptr)[at] = '/';
    return arena_format(arena, "write '%.*s': '/' goes between folders on every system", STR_ARG(copy));
}

const char *file_status_text(const struct files *files, enum file_status status) {
    switch (status) {
    case FILE_OK:
        return "was read";
    case FILE_MISSING:
        return "does not exist";
    case FILE_OUTSIDE:
        return "lies outside the folders that the scene may read";
    case FILE_NOT_REGULAR:
        return "is not a regular file";
    case FILE_UNREADABLE:
        return strerror(files->system_error);
    case FILE_TOO_LARGE:
        return "is too large";
    case FILE_NO_MEMORY:
        return "does not fit into memory";
    }
    return "cannot be read";
}
