#include "cli/check_changed.h"

#include "files/files_walk.h"
#include "files/git.h"

// The folder above the current one by as many steps as `top` is, as a user would write it.
static str folder_above(struct cli *cli, struct files *files, str top) {
    str rest;
    str here = files_canonical(files, STR("."));
    if (str_equal(here, top))
        return STR(".");
    if (!path_is_below(here, top, &rest))
        return top;
    str path = STR("..");
    for (size_t i = 0; i < rest.len; i++)
        if (rest.ptr[i] == '/')
            path = arena_format(&cli->arena, "../%.*s", STR_ARG(path));
    return path;
}

// Where scenes are looked for if no folder is named: in the repository that was asked, else below the nearest
// settings, which mark the root of scenes, else here.
static str root_folder(struct cli *cli, struct files *files, str top) {
    str config = top.len ? STR("") : files_find_config(files, STR("./scene"));
    if (config.len)
        top = path_folder(config);
    return top.len ? folder_above(cli, files, top) : STR(".");
}

static bool ask_git(struct cli *cli, struct check_changed *out, const char *revision, int arg, str *top) {
    struct git_changes changes;
    if (!git_changed_since(&changes, &cli->arena, str_from(revision))) {
        diag_add(&cli->sink, DIAG_GIT, cli_place(cli, arg), "what changed since '%s' is not known: %.*s",
                 revision, STR_ARG(changes.why));
        diag_help(&cli->sink,
                  "the first name is a revision if there is no such file; without a revision, files "
                  "can be named: glint check --changed FILE...");
        return false;
    }
    *top = changes.top;
    for (uint32_t i = 0; i < changes.paths.count; i++)
        changed_add(&out->changed, changes.paths.items[i]);
    return true;
}

bool check_changed_read(struct cli *cli, struct check_changed *out) {
    const char *revision = NULL;
    int revision_arg = cli->options.changed_arg;
    uint32_t files = 0;
    str top = STR("");
    *out = (struct check_changed){.named_folders = false};
    changed_init(&out->changed, &cli->arena);
    for (int i = 0; i < cli->operand_count; i++) {
        str path = str_from(cli->operands[i]);
        if (files_is_folder(path)) {
            *ARENA_PUSH(&cli->arena, &out->folders) = path;
            continue;
        }
        if (i == 0 && !files_exist(path)) {
            revision = cli->operands[i];
            revision_arg = cli_operand_place(cli, i);
            continue;
        }
        changed_add(&out->changed, path);
        files++;
        if (files_exist(path))
            *ARENA_PUSH(&cli->arena, &out->scenes) = path;
    }
    if ((revision || files == 0) && !ask_git(cli, out, revision ? revision : "HEAD", revision_arg, &top))
        return false;
    out->named_folders = out->folders.count > 0;
    if (!out->named_folders)
        *ARENA_PUSH(&cli->arena, &out->folders) = root_folder(cli, &out->changed.files, top);
    return true;
}
