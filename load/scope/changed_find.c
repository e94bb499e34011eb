// What changed, from the operands of --changed.
#include "load/scope/changed.h"

#include "files/files_walk.h"
#include "files/git.h"

// A folder at or above the current one, as a user would write it.
static str folder_above(struct changed *changed, str top) {
    str rest;
    str here = files_canonical(&changed->files, STR("."));
    if (str_equal(here, top))
        return STR(".");
    if (!path_is_below(here, top, &rest))
        return top;
    str path = STR("..");
    for (size_t i = 0; i < rest.len; i++)
        if (rest.ptr[i] == '/')
            path = arena_format(changed->arena, "../%.*s", STR_ARG(path));
    return path;
}

static str root_folder(struct changed *changed, str top) {
    if (!top.len)
        top = files_canonical(&changed->files, files_scene_root(&changed->files, STR("./scene")));
    return arena_copy(changed->arena, folder_above(changed, top));
}

static bool ask_git(struct changed *changed, const char *revision, str *top) {
    struct git_changes changes;
    if (revision[0] == '-') { // git would take it for an option
        changed->why =
            arena_format(changed->arena, "'%s' is not a revision: it begins as an option does", revision);
        return false;
    }
    if (!git_changed_since(&changes, changed->arena, str_from(revision))) {
        changed->why = arena_format(changed->arena, "what changed since '%s' is not known: %.*s", revision,
                                    STR_ARG(changes.why));
        return false;
    }
    *top = changes.top;
    for (uint32_t i = 0; i < changes.paths.count; i++)
        changed_add(changed, changes.paths.items[i]);
    return true;
}

static void add_operand(struct changed *changed, const char *operand) {
    str path = str_from(operand);
    if (files_is_folder(path)) {
        *ARENA_PUSH(changed->arena, &changed->searched) = path;
        return;
    }
    changed_add(changed, path);
    if (files_exist(path))
        *ARENA_PUSH(changed->arena, &changed->named) = path;
}

bool changed_find(struct changed *changed, char *const *operands, int count) {
    bool names_revision = count > 0 && !files_exist(str_from(operands[0]));
    str top = STR("");
    for (int i = names_revision; i < count; i++)
        add_operand(changed, operands[i]);
    changed->operand = names_revision ? 0 : -1;
    changed->names_folders = changed->searched.count > 0;
    bool names_files = count > names_revision + (int)changed->searched.count;
    if ((names_revision || !names_files) && !ask_git(changed, names_revision ? operands[0] : "HEAD", &top))
        return false;
    if (!changed->names_folders)
        *ARENA_PUSH(changed->arena, &changed->searched) = root_folder(changed, top);
    return true;
}
