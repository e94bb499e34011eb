#include "files/files_walk.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum {
    DEPTH_MAX = 64
};

bool files_is_folder(str path) {
    struct stat info;
    return stat(path.ptr, &info) == 0 && S_ISDIR(info.st_mode);
}

static bool has_ending(const struct files_found *found, str name) {
    for (const char *const *ending = found->endings; *ending; ending++) {
        size_t length = strlen(*ending);
        if (name.len > length && memcmp(name.ptr + name.len - length, *ending, length) == 0)
            return true;
    }
    return false;
}

static int compare(const void *a, const void *b) {
    return str_compare(*(const str *)a, *(const str *)b);
}

// The names in a folder are taken before anything is done with them: an arena that ends jumps past closedir.
bool files_list_folder(struct arena *arena, str folder, struct files_names *names) {
    DIR *directory = opendir(folder.ptr);
    struct arena_guard *before = arena->guard;
    struct arena_guard guard = {.fault = ARENA_FAULT_NONE};
    if (!directory)
        return false;
    arena_set_guard(arena, &guard);
    if (setjmp(guard.jump) == 0) {
        for (struct dirent *entry; (entry = readdir(directory));)
            if (entry->d_name[0] != '.')
                *ARENA_PUSH(arena, names) = arena_copy(arena, str_from(entry->d_name));
    }
    arena_set_guard(arena, before);
    closedir(directory);
    if (guard.fault != ARENA_FAULT_NONE)
        arena_raise(arena, guard.fault);
    if (names->count)
        qsort(names->items, names->count, sizeof *names->items, compare);
    return true;
}

enum file_status files_walk(struct files_found *found, str folder) {
    struct files_names names = {0};
    if (!files_list_folder(found->arena, folder, &names))
        return FILE_UNREADABLE;
    found->depth++;
    for (uint32_t i = 0; i < names.count; i++) {
        str path = path_join(found->arena, folder, names.items[i]);
        struct stat link;
        struct stat target;
        if (lstat(path.ptr, &link) != 0 || stat(path.ptr, &target) != 0)
            continue;
        if (S_ISREG(target.st_mode) && has_ending(found, names.items[i]))
            *ARENA_PUSH(found->arena, &found->paths) = path;
        else if (S_ISDIR(link.st_mode) && found->depth < DEPTH_MAX)
            files_walk(found, path);
    }
    found->depth--;
    return FILE_OK;
}
