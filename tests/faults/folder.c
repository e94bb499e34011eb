#define _XOPEN_SOURCE 700

#include "folder.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    PATH_BYTES = 4096
};

_Noreturn void die(const char *what) {
    fprintf(stderr, "faults: %s: %s\n", what, strerror(errno));
    exit(2);
}

static void join(char path[PATH_BYTES], const char *folder, const char *name) {
    if (snprintf(path, PATH_BYTES, "%s/%s", folder, name) >= PATH_BYTES)
        die(name);
}

struct bytes read_whole(const char *path) {
    FILE *file = fopen(path, "rb");
    struct stat info;
    if (!file || fstat(fileno(file), &info) != 0)
        die(path);
    size_t size = (size_t)info.st_size;
    struct bytes bytes = {malloc(size + 1), size};
    if (!bytes.data || fread(bytes.data, 1, size, file) != size)
        die(path);
    bytes.data[size] = '\0';
    fclose(file);
    return bytes;
}

void copy_file(const char *from, const char *to) {
    struct bytes bytes = read_whole(from);
    FILE *file = fopen(to, "wb");
    if (!file || fwrite(bytes.data, 1, bytes.size, file) != bytes.size || fclose(file) != 0)
        die(to);
    free(bytes.data);
}

static bool is_folder(const char *path) {
    struct stat info;
    return lstat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

// The names in a folder, in order.
static struct dirent **list(const char *path, int *count) {
    struct dirent **names;
    *count = scandir(path, &names, NULL, alphasort);
    if (*count < 0)
        die(path);
    return names;
}

static bool is_entry(const struct dirent *name) {
    return strcmp(name->d_name, ".") != 0 && strcmp(name->d_name, "..") != 0;
}

void copy_folder(const char *from, const char *to) {
    int count;
    struct dirent **names = list(from, &count);
    if (mkdir(to, 0777) != 0 && errno != EEXIST)
        die(to);
    for (int i = 0; i < count; free(names[i++])) {
        char source[PATH_BYTES], target[PATH_BYTES];
        if (!is_entry(names[i]))
            continue;
        join(source, from, names[i]->d_name);
        join(target, to, names[i]->d_name);
        if (is_folder(source))
            copy_folder(source, target);
        else
            copy_file(source, target);
    }
    free(names);
}

void remove_folder(const char *path) {
    int count;
    if (!is_folder(path))
        return;
    struct dirent **names = list(path, &count);
    for (int i = 0; i < count; free(names[i++])) {
        char inner[PATH_BYTES];
        if (!is_entry(names[i]))
            continue;
        join(inner, path, names[i]->d_name);
        if (is_folder(inner))
            remove_folder(inner);
        else if (unlink(inner) != 0)
            die(inner);
    }
    free(names);
    if (rmdir(path) != 0)
        die(path);
}

// ---- telling

// FNV-1a: it only has to differ where a file does.
static uint64_t hash(const struct bytes *bytes) {
    uint64_t hash = 0xcbf29ce484222325;
    for (size_t i = 0; i < bytes->size; i++)
        hash = (hash ^ (unsigned char)bytes->data[i]) * 0x100000001b3;
    return hash;
}

static void tell(FILE *out, const char *path, const char *name) {
    int count;
    struct dirent **names = list(path, &count);
    if (count <= 2)
        fprintf(out, "%s/\n", name);
    for (int i = 0; i < count; free(names[i++])) {
        char inner[PATH_BYTES], shown[PATH_BYTES];
        if (!is_entry(names[i]))
            continue;
        join(inner, path, names[i]->d_name);
        join(shown, name, names[i]->d_name);
        if (is_folder(inner)) {
            tell(out, inner, shown);
            continue;
        }
        struct bytes bytes = read_whole(inner);
        fprintf(out, "%s %zu %016llx\n", shown, bytes.size, (unsigned long long)hash(&bytes));
        free(bytes.data);
    }
    free(names);
}

struct bytes tell_folder(const char *path) {
    struct bytes told = {NULL, 0};
    FILE *out = open_memstream(&told.data, &told.size);
    if (!out)
        die(path);
    tell(out, path, ".");
    fclose(out);
    return told;
}

static bool has_start(const char *text, const char *start, size_t length) {
    for (const char *line = text; line && *line; line = strchr(line, '\n'), line += line != NULL)
        if (strncmp(line, start, length) == 0)
            return true;
    return false;
}

bool is_mix(const char *now, const char *before, const char *after) {
    for (const char *line = now; *line; line = strchr(line, '\n') + 1) {
        size_t length = strcspn(line, "\n") + 1;
        if (!has_start(before, line, length) && !has_start(after, line, length))
            return false;
    }
    for (const char *line = before; *line; line = strchr(line, '\n') + 1)
        if (!has_start(now, line, strcspn(line, " \n") + 1))
            return false;
    return true;
}
