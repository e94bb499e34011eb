#include "files/work_tree.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// Otherwise someone else could put a `.git` above a scene (where everybody may write, say) and so let the
// scene read the files around it.
static bool is_own(const struct stat *info) {
#ifdef __EMSCRIPTEN__
    (void)info; // this system has no users
    return true;
#else
    const char *caller = geteuid() == 0 ? getenv("SUDO_UID") : NULL;
    return info->st_uid == geteuid() || (caller && strtoul(caller, NULL, 10) == info->st_uid);
#endif
}

static bool is_top(struct files *files, str folder) {
    str git = path_join(files->arena, folder, STR(".git"));
    str head = path_join(files->arena, git, STR("HEAD"));
    struct stat tree, entry, link;
    if (lstat(git.ptr, &entry) != 0 || stat(arena_copy(files->arena, folder).ptr, &tree) != 0)
        return false;
    bool is_repository = S_ISDIR(entry.st_mode) && lstat(head.ptr, &link) == 0;
    return (is_repository || S_ISREG(entry.st_mode)) && is_own(&entry) && is_own(&tree);
}

static bool is_ceiling(struct files *files, str folder) {
    str rest = str_from(getenv("GIT_CEILING_DIRECTORIES"));
    while (rest.len) {
        size_t end = 0;
        while (end < rest.len && rest.ptr[end] != ':')
            end++;
        if (end && str_equal(files_canonical(files, str_slice(rest, 0, end)), folder))
            return true;
        rest = str_slice(rest, end + (end < rest.len), rest.len);
    }
    return false;
}

str files_work_tree(struct files *files, str path) {
    str folder = files_canonical(files, path_folder(path));
    while (folder.len && folder.ptr[0] == '/' && !is_top(files, folder)) {
        str above = path_folder(folder);
        if (folder.len <= 1 || is_ceiling(files, above))
            return STR("");
        folder = above;
    }
    return folder.len && folder.ptr[0] == '/' ? folder : STR("");
}

// The highest folder that "../lib/a.obj" climbs to: the target without "lib/a.obj".
static str common_folder(struct files *files, str root, str path, str target) {
    str rest;
    const size_t written = path.len;
    while (str_starts_with(path, STR("../")))
        path = str_slice(path, 3, path.len);
    if (path.len == written || path.len + 1 >= target.len)
        return STR("");
    str folder = str_slice(target, 0, target.len - path.len - 1);
    bool is_home = str_equal(files_canonical(files, str_from(getenv("HOME"))), folder);
    bool fits = str_equal(str_slice(target, folder.len + 1, target.len), path) &&
                target.ptr[folder.len] == '/' && path_is_below(root, folder, &rest);
    return fits && !is_home ? folder : STR("");
}

str files_outside_advice(struct files *files, str path, str target, struct files_marker *marker) {
    str rest, root = files->roots.count ? files->roots.items[0] : STR("/");
    str in_root = path_join(files->arena, root, STR("x"));
    str config = files_find_config(files, in_root), tree = files_work_tree(files, in_root);
    str common = config.len || tree.len ? STR("") : common_folder(files, root, path, target);
    const char *why = config.len ? "the folder of the nearest " FILES_CONFIG_NAME
                      : tree.len ? "the top of its git work tree"
                                 : "its own folder";
    *marker = (struct files_marker){STR(""), false};
    if (!common.len)
        return arena_format(files->arena,
                            "the scene may read what is below '%.*s', %s: move the file there, or allow its "
                            "folder with --asset-path %.*s",
                            STR_ARG(root), why, STR_ARG(path_folder(target)));
    marker->path = path_join(files->arena, common, STR(FILES_CONFIG_NAME));
    marker->is_certain = path_is_below(common, files_canonical(files, STR(".")), &rest);
    return arena_format(files->arena,
                        "put an empty " FILES_CONFIG_NAME
                        " into '%.*s', below which scenes may then read; 'glint check --fix%s' does",
                        STR_ARG(common), marker->is_certain ? "" : "=all");
}

str files_scene_root(struct files *files, str scene_path) {
    str config = files_find_config(files, scene_path);
    str tree = config.len ? STR("") : files_work_tree(files, scene_path);
    return tree.len ? tree : path_folder(config.len ? config : scene_path);
}

enum file_status files_add_scene_root(struct files *files, str scene_path) {
    return files_add_root(files, files_scene_root(files, scene_path));
}
