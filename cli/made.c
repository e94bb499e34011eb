#include "cli/made.h"

#include "core/str_map.h"
#include "files/door.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

enum {
    PATH_BYTES = 4096,
};

struct cli_made {
    struct str_map places; // of the names, in the list below, from 1
    struct {
        struct made_name *items;
        uint32_t count, capacity;
    } names;
    str typed;     // the folder that was looked up last
    str canonical; // links resolved; empty: it is not there
};

static struct cli_made *made_of(struct cli *cli) {
    if (!cli->made) {
        cli->made = ARENA_NEW(&cli->arena, struct cli_made);
        str_map_init(&cli->made->places, &cli->arena);
    }
    return cli->made;
}

str cli_made_folder(struct cli *cli, str typed) {
    struct cli_made *made = made_of(cli);
    struct files files;
    if (made->canonical.len &&
        str_equal(made->typed, typed)) // a folder that was missing may have been made since
        return made->canonical;
    files_init(&files, &cli->arena);
    made->typed = arena_copy(&cli->arena, typed);
    made->canonical = files_add_root(&files, made->typed) == FILE_OK ? files.roots.items[0] : STR("");
    return made->canonical;
}

void cli_keep_made(struct cli *cli, const char *path, struct made_name name) {
    struct cli_made *made = made_of(cli);
    uint32_t *place = str_map_at(&made->places, str_from(path));
    if (*place == 0) {
        *ARENA_PUSH(&cli->arena, &made->names) = name;
        *place = made->names.count;
    }
    made->names.items[*place - 1] = name;
}

// Also as the value of an option: --output=NAME, -oNAME.
static bool is_typed(const struct cli *cli, const char *path) {
    const size_t length = strlen(path);
    for (int i = 1; i < cli->argc; i++) {
        const char *word = cli->argv[i];
        const size_t all = strlen(word);
        if (all < length || strcmp(word + all - length, path) != 0)
            continue;
        if (all == length || word[all - length - 1] == '=' || (all == length + 2 && word[0] == '-'))
            return true;
    }
    return false;
}

static bool open_in(struct output *output, int folder, const char *path) {
    if (folder >= 0)
        return output_open_in(output, folder, path);
    *output = (struct output){.fd = -1, .error = errno ? errno : EIO};
    return false;
}

static int folder_of(const char *path) {
    char folder[PATH_BYTES];
    const char *slash = strrchr(path, '/');
    const size_t length = slash ? (size_t)(slash - path) + 1 : 1;
    errno = ENAMETOOLONG;
    if (length >= sizeof folder)
        return -1;
    memcpy(folder, slash ? path : ".", length);
    folder[length] = '\0';
    return open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

bool cli_open_output(const struct cli *cli, struct output *output, const char *path) {
    const uint32_t place = cli->made ? str_map_find(&cli->made->places, str_from(path)) : 0;
    if (!place && (strcmp(path, "-") == 0 || is_typed(cli, path)))
        return output_open(output, path);
    if (!place)
        return open_in(output, folder_of(path), path);
    const struct made_name *name = &cli->made->names.items[place - 1];
    errno = ENOENT;
    return open_in(output, name->folder ? door_folder(name->folder) : -1, name->path);
}

int cli_put_output(const struct cli *cli, const char *path, str bytes) {
    struct output output;
    if (!cli_open_output(cli, &output, path))
        return output.error;
    output_write(&output, bytes.ptr, bytes.len);
    output_commit(&output);
    return output.error;
}
