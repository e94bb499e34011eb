#include "files/folder_store.h"

#include "core/heap.h"
#include "core/xxh64.h"
#include "files/folder.h"
#include "files/output.h"
#include "files/sandbox.h"

#include <assert.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    FOLDER_FLAGS = O_RDONLY | O_DIRECTORY | O_CLOEXEC
};

static bool is_usable(const struct folder_store *store) {
    return store->path && store->path[0] != '\0';
}

static char *joined(const char *folder, const char *name) {
    size_t size = strlen(folder) + strlen(name) + 2;
    char *path = heap_alloc(size);
    if (path)
        snprintf(path, size, "%s/%s", folder, name);
    return path;
}

// Makes the folder and those above it.
static bool make_folders(const char *path) {
    char *copy = heap_text(path);
    if (!copy)
        return false;
    for (char *p = copy + 1; *p; p++) {
        if (*p != '/')
            continue;
        *p = '\0';
        mkdir(copy, 0700);
        *p = '/';
    }
    bool made = mkdir(copy, 0700) == 0 || errno == EEXIST;
    free(copy);
    return made;
}

// ---- reading

static bool read_all(int fd, char *bytes, size_t count) {
    size_t have = 0;
    while (have < count) {
        ssize_t got = read(fd, bytes + have, count - have);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            return false;
        have += (size_t)got;
    }
    return true;
}

static char *read_file(int fd, size_t most_bytes, size_t *count) {
    struct stat info;
    if (fstat(fd, &info) != 0 || !S_ISREG(info.st_mode) || (uintmax_t)info.st_size > most_bytes)
        return NULL;
    char *bytes = heap_array((uint64_t)info.st_size + 1, 1);
    if (!bytes)
        return NULL;
    *count = (size_t)info.st_size;
    if (read_all(fd, bytes, *count))
        return bytes;
    free(bytes);
    return NULL;
}

void *folder_store_read(const struct folder_store *store, const char *name, size_t most_bytes,
                        size_t *count) {
    *count = 0;
    const int folder = is_usable(store) ? open(store->path, FOLDER_FLAGS) : -1;
    if (folder < 0)
        return NULL;
    // Nothing here writes an entry that is not a regular file.
    int fd = openat(folder, name, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    close(folder);
    if (fd < 0)
        return NULL;
    char *bytes = read_file(fd, most_bytes, count);
    if (bytes && futimens(fd, NULL) != 0)
        errno = 0; // a read-only cache is a cache too
    close(fd);
    return bytes;
}

// ---- removing

struct entry {
    char *name;
    struct timespec used;
    uint64_t size_bytes;
};

static int compare_entries(const void *a, const void *b) {
    const struct entry *x = a;
    const struct entry *y = b;
    if (x->used.tv_sec != y->used.tv_sec)
        return x->used.tv_sec < y->used.tv_sec ? -1 : 1;
    if (x->used.tv_nsec != y->used.tv_nsec)
        return x->used.tv_nsec < y->used.tv_nsec ? -1 : 1;
    return strcmp(x->name, y->name);
}

// Lists all regular files of the folder, including leftovers of killed programs.
static size_t list_entries(DIR *folder, struct entry **entries, uint64_t *total) {
    size_t count = 0;
    uint32_t capacity = 0;
    for (struct dirent *item = folder_next(folder); item; item = folder_next(folder)) {
        struct stat info;
        if (fstatat(dirfd(folder), item->d_name, &info, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(info.st_mode))
            continue;
        struct entry *grown = heap_grow(*entries, count, &capacity, sizeof *grown);
        if (!grown)
            break;
        *entries = grown;
        struct entry *entry = &(*entries)[count];
        *entry = (struct entry){heap_text(item->d_name), info.st_mtim, (uint64_t)info.st_size};
        if (!entry->name)
            break;
        *total += entry->size_bytes;
        count++;
    }
    return count;
}

static void evict(const struct folder_store *store) {
    DIR *folder = folder_open(store->path);
    struct entry *entries = NULL;
    uint64_t total = 0;
    if (!folder)
        return;
    size_t count = list_entries(folder, &entries, &total);
    if (count)
        qsort(entries, count, sizeof *entries, compare_entries);
    for (size_t i = 0; i < count; i++) {
        if (total > store->cap_bytes && unlinkat(dirfd(folder), entries[i].name, 0) == 0)
            total -= entries[i].size_bytes;
        free(entries[i].name);
    }
    free(entries);
    closedir(folder);
}

// ---- writing

bool folder_store_write(const struct folder_store *store, const char *name,
                        const struct folder_store_part *parts, int part_count) {
    uint64_t size = 0;
    for (int i = 0; i < part_count; i++)
        size += parts[i].count;
    if (!is_usable(store) || size > store->cap_bytes || !make_folders(store->path))
        return false;
    char *path = joined(store->path, name);
    struct output output;
    const int folder = path ? open(store->path, FOLDER_FLAGS) : -1;
    bool kept = folder >= 0 && output_open_over(&output, folder, path);
    if (kept) {
        for (int i = 0; i < part_count; i++)
            output_write(&output, parts[i].bytes, parts[i].count);
        kept = output_commit(&output);
    }
    free(path);
    evict(store);
    return kept;
}

// ---- with a seal

struct head {
    struct folder_seal seal;
    uint64_t count, hash; // of what follows
};

enum {
    PARTS_MOST = 4
};

void *folder_store_open(const struct folder_store *store, const char *name, const struct folder_seal *seal,
                        size_t most_bytes, size_t *count) {
    struct head head;
    size_t whole;
    *count = 0;
    char *bytes = folder_store_read(store, name, sizeof head + most_bytes, &whole);
    if (bytes && whole >= sizeof head) {
        memcpy(&head, bytes, sizeof head);
        memmove(bytes, bytes + sizeof head, whole - sizeof head);
        if (memcmp(&head.seal, seal, sizeof *seal) == 0 && head.count == whole - sizeof head &&
            head.hash == xxh64_of(bytes, whole - sizeof head, 0)) {
            *count = whole - sizeof head;
            return bytes;
        }
    }
    free(bytes);
    return NULL;
}

bool folder_store_seal(const struct folder_store *store, const char *name, const struct folder_seal *seal,
                       const struct folder_store_part *parts, int part_count) {
    struct head head = {.seal = *seal};
    struct folder_store_part all[PARTS_MOST] = {{&head, sizeof head}};
    struct xxh64 hash;
    assert(part_count < PARTS_MOST);
    xxh64_begin(&hash, 0);
    for (int i = 0; i < part_count; i++) {
        all[i + 1] = parts[i];
        head.count += parts[i].count;
        xxh64_add(&hash, parts[i].bytes, parts[i].count);
    }
    head.hash = xxh64_end(&hash);
    return folder_store_write(store, name, all, part_count + 1);
}

// ---- where

char *folder_store_path(const char *name) {
    const char *cache = getenv("XDG_CACHE_HOME");
    const char *home = getenv("HOME");
    if (sandbox_entered()) // an untrusted scene neither reads others' entries nor adds any
        return NULL;
    bool has_cache = cache && cache[0] == '/';
    if (!has_cache && (!home || home[0] != '/'))
        return NULL;
    const char *base = has_cache ? cache : home;
    const char *middle = has_cache ? "glint" : ".cache/glint";
    size_t size = strlen(base) + strlen(middle) + strlen(name) + 3;
    char *path = heap_alloc(size);
    if (path)
        snprintf(path, size, "%s/%s/%s", base, middle, name);
    return path;
}
