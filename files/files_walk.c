#include "files/files_walk.h"

#include "files/folder.h"

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

bool files_exist(str path) {
    struct stat info;
    return lstat(path.ptr, &info) == 0 || (errno != ENOENT && errno != ENOTDIR);
}

static bool has_ending(const struct files_found *found, str name) {
    for (const char *const *ending = found->endings; *ending; ending++)
        if (name.len > strlen(*ending) && str_ends_with_nocase(name, *ending))
            return true;
    return false;
}

static int compare(const void *a, const void *b) {
    return str_compare(*(const str *)a, *(const str *)b);
}

struct listing {
    DIR *directory;
    struct arena *arena;
    struct files_names *names;
    int error; // errno of what could not be read
};

static void take_names(void *context) {
    struct listing *listing = context;
    for (struct dirent *entry; (entry = folder_next(listing->directory));)
        if (entry->d_name[0] != '.')
            *ARENA_PUSH(listing->arena, listing->names) = arena_copy(listing->arena, str_from(entry->d_name));
    listing->error = errno;
}

// The names in a folder are read before anything is done with them, so that the folder is closed at once.
bool files_list_folder(struct arena *arena, str folder, struct files_names *names) {
    struct listing listing = {folder_open(folder.ptr), arena, names, 0};
    if (!listing.directory)
        return false;
    enum arena_fault fault = arena_guarded(arena, take_names, &listing);
    closedir(listing.directory);
    if (fault)
        arena_raise(arena, fault);
    if (names->count)
        qsort(names->items, names->count, sizeof *names->items, compare);
    errno = listing.error;
    return listing.error == 0;
}

// Left out: what this user may not see, links that lead nowhere, and what has been removed meanwhile.
static bool is_left_out(void) {
    return errno == EACCES || errno == ENOENT || errno == ENOTDIR || errno == ELOOP;
}

static enum file_status unreadable(struct files_found *found, str path) {
    found->unreadable = path;
    return FILE_UNREADABLE;
}

enum file_status files_walk(struct files_found *found, str folder) {
    struct files_names names = {0};
    enum file_status status = FILE_OK;
    if (!files_list_folder(found->arena, folder, &names))
        return unreadable(found, folder);
    found->depth++;
    for (uint32_t i = 0; status == FILE_OK && i < names.count; i++) {
        str path = path_join(found->arena, folder, names.items[i]);
        struct stat link;
        struct stat target;
        if (lstat(path.ptr, &link) != 0 || stat(path.ptr, &target) != 0)
            status = is_left_out() ? FILE_OK : unreadable(found, path);
        else if (S_ISREG(target.st_mode) && has_ending(found, names.items[i]))
            *ARENA_PUSH(found->arena, &found->paths) = path;
        else if (S_ISDIR(link.st_mode) && found->depth < DEPTH_MAX)
            status = files_walk(found, path) == FILE_OK || is_left_out() ? FILE_OK : FILE_UNREADABLE;
    }
    found->depth--;
    return status;
}
