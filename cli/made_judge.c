#include "cli/made.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

static int refuse(struct cli *cli, const char *typed, const char *path, enum file_status status) {
    struct files none = {0};
    cli_error(cli, session_file_code(status), path,
              typed[0] ? "remove what has this name, or choose another"
                       : "if that is meant, name the file with -o",
              "is not written: it %s",
              status == FILE_OUTSIDE ? "leads out of the folder" : file_status_text(&none, status));
    return CLI_REFUSED;
}

// The length of the folder that the user typed: the part that both paths begin with.
static size_t typed_length(const char *typed, const char *path) {
    size_t same = 0;
    while (typed[same] && typed[same] == path[same])
        same++;
    while (same > 0 && path[same - 1] != '/')
        same--;
    return same;
}

static bool is_kind(const struct stat *there, bool is_folder) {
    return is_folder ? S_ISDIR(there->st_mode) : S_ISREG(there->st_mode);
}

// Judges a name that has links in it, or lies in folders that were not typed.
static int judge_links(struct cli *cli, const char *typed, const char *path, str folder, bool is_folder) {
    struct files files;
    struct stat there;
    str root;
    files_init(&files, &cli->arena);
    files_add_root(&files, folder);
    const bool is_link = lstat(path, &there) == 0;
    const bool is_there = stat(path, &there) == 0;
    if ((is_link && !is_there) || files_place(&files, str_from(path), &root) == FILE_OUTSIDE)
        return refuse(cli, typed, path, FILE_OUTSIDE);
    if (is_there && !is_kind(&there, is_folder))
        return refuse(cli, typed, path, FILE_NOT_REGULAR);
    const str canonical = files_canonical(&files, str_from(path));
    const char *in =
        canonical.len && canonical.ptr[0] == '/' ? arena_copy(&cli->arena, path_folder(canonical)).ptr : NULL;
    cli_keep_made(cli, path, (struct made_name){in, canonical.ptr});
    return CLI_OK;
}

static int judge(struct cli *cli, const char *typed, const char *path, bool is_folder) {
    struct stat there;
    const size_t length = typed_length(typed, path);
    if (strcmp(typed, path) == 0 || strcmp(path, "-") == 0)
        return CLI_OK;
    const str folder = cli_made_folder(cli, length ? (str){path, length} : STR("."));
    if (!folder.len) { // writing reports that
        cli_keep_made(cli, path, (struct made_name){NULL, path});
        return CLI_OK;
    }
    const bool is_there = lstat(path, &there) == 0;
    const bool is_plain = is_there ? is_kind(&there, is_folder) : errno == ENOENT;
    if (!is_plain || strchr(path + length, '/'))
        return judge_links(cli, typed, path, folder, is_folder);
    cli_keep_made(cli, path, (struct made_name){folder.ptr, path});
    return CLI_OK;
}

int cli_judge_made(struct cli *cli, const char *typed, const char *path) {
    return judge(cli, typed, path, false);
}

int cli_judge_made_folder(struct cli *cli, const char *typed, const char *path) {
    return judge(cli, typed, path, true);
}
