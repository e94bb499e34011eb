// A folder for one test's files, gone when the test ends.
#ifndef GLINT_TESTS_UNIT_SCRATCH_H
#define GLINT_TESTS_UNIT_SCRATCH_H

#include <dirent.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct scratch {
    char folder[PATH_MAX]; // absolute, links resolved
};

static inline bool scratch_make(struct scratch *scratch) {
    const char *base = getenv("TMPDIR");
    char name[PATH_MAX];
    int size = snprintf(name, sizeof name, "%s/glint-test-XXXXXX", base && *base ? base : P_tmpdir);
    return size < (int)sizeof name && mkdtemp(name) && realpath(name, scratch->folder);
}

static inline void scratch_remove_tree(const char *path) {
    struct stat info;
    if (lstat(path, &info) != 0)
        return;
    if (S_ISDIR(info.st_mode)) {
        DIR *directory = opendir(path);
        struct dirent *entry;
        while (directory && (entry = readdir(directory))) {
            char inner[PATH_MAX + NAME_MAX];
            if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0)
                continue;
            if (snprintf(inner, sizeof inner, "%s/%s", path, entry->d_name) < (int)sizeof inner)
                scratch_remove_tree(inner);
        }
        if (directory)
            closedir(directory);
    }
    remove(path);
}

static inline void scratch_finish(struct scratch *scratch) {
    scratch_remove_tree(scratch->folder);
}

// The path of `name` in the folder. The text lives until the eighth call after this one.
static inline const char *scratch_path(const struct scratch *scratch, const char *name) {
    static char paths[8][PATH_MAX + NAME_MAX];
    static unsigned next;
    char *path = paths[next++ % 8];
    if (snprintf(path, sizeof paths[0], "%s/%s", scratch->folder, name) >= (int)sizeof paths[0])
        abort(); // a test's own name is too long
    return path;
}

static inline bool scratch_write(const struct scratch *scratch, const char *name, const char *text) {
    FILE *file = fopen(scratch_path(scratch, name), "wb");
    if (!file)
        return false;
    bool written = fputs(text, file) >= 0;
    return fclose(file) == 0 && written;
}

// Whether the file holds exactly `text`.
static inline bool scratch_holds(const struct scratch *scratch, const char *name, const char *text) {
    FILE *file = fopen(scratch_path(scratch, name), "rb");
    if (!file)
        return false;
    char bytes[4096];
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    return size == strlen(text) && memcmp(bytes, text, size) == 0;
}

// Entries of the folder or, where `name` is not empty, of one inside it.
static inline int scratch_count(const struct scratch *scratch, const char *name) {
    DIR *directory = opendir(scratch_path(scratch, name));
    int count = 0;
    while (directory && readdir(directory))
        count++;
    if (directory)
        closedir(directory);
    return count - 2;
}

#endif
