#include "files/files.h"

#include <string.h>
#include <unistd.h>

// The part of a path up to the next '/'; *rest continues after it.
static str next_part(str *rest) {
    const char *slash = rest->len ? memchr(rest->ptr, '/', rest->len) : NULL;
    size_t end = slash ? (size_t)(slash - rest->ptr) : rest->len;
    str part = str_slice(*rest, 0, end);
    *rest = str_slice(*rest, slash ? end + 1 : end, rest->len);
    return part;
}

// The relative path from one folder to another, both absolute and without links: "", "a/", "../a/".
static str way(struct arena *arena, str from, str to) {
    str from_rest = str_slice(from, 1, from.len);
    str to_rest = str_slice(to, 1, to.len);
    for (;;) {
        str next_from = from_rest;
        str next_to = to_rest;
        str part = next_part(&next_from);
        if (part.len == 0 || !str_equal(part, next_part(&next_to)))
            break;
        from_rest = next_from;
        to_rest = next_to;
    }
    str text = STR("");
    while (next_part(&from_rest).len)
        text = arena_format(arena, "%.*s../", STR_ARG(text));
    bool is_root = to_rest.len == 0;
    return arena_format(arena, "%.*s%.*s%s", STR_ARG(text), STR_ARG(to_rest), is_root ? "" : "/");
}

static bool exists_beside(struct files *files, str folder, str path) {
    return access(path_join(files->arena, folder, path).ptr, F_OK) == 0;
}

str files_rebase(struct files *files, str path, str from_file, str to_file) {
    str from = files_canonical(files, path_folder(from_file));
    str to = files_canonical(files, path_folder(to_file));
    bool absolute = from.len && from.ptr[0] == '/' && to.len && to.ptr[0] == '/';
    if (path.len == 0 || path.ptr[0] == '/' || !absolute || str_equal(from, to) ||
        !exists_beside(files, from, path))
        return path;
    // '..' can be removed from a folder without links; after a name it may lead elsewhere.
    str rest = path;
    for (str after = rest; rest.len; rest = after) {
        str part = next_part(&after);
        if (str_equal(part, STR("..")))
            from = from.len > 1 ? path_folder(from) : from;
        else if (part.len && !str_equal(part, STR(".")))
            break;
    }
    return arena_format(files->arena, "%.*s%.*s", STR_ARG(way(files->arena, to, from)), STR_ARG(rest));
}
