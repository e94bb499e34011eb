#include "cli/commands/folder_scenes.h"

#include "diag/codes/file.h"
#include "load/check.h"

#include <errno.h>
#include <string.h>

int cli_find_scenes(struct cli *cli, const char *folder, struct scene_names *names) {
    if (scene_names_find(names, &cli->arena, str_from(folder)) == FILE_OK)
        return CLI_OK;
    cli_error(cli, DIAG_FILE_UNREADABLE, names->unreadable.ptr, NULL, "the folder cannot be read: %s",
              strerror(errno));
    return CLI_FILE;
}

int cli_no_scene(struct cli *cli, int arg, const char *where, const struct scene_names *names) {
    cli_usage(cli, arg, "there is no scene in the folder '%s'", where);
    diag_help(&cli->sink, "%.*s", STR_ARG(scene_names_advice(names, &cli->arena)));
    return CLI_USAGE;
}

void cli_tell_others(struct cli *cli, struct scene_names *names) {
    struct session session;
    scene_names_end(names, &cli->arena);
    for (uint32_t i = 0; i < names->paths.count && names->others.count; i++) {
        struct session_options options = cli_session_options(cli, names->paths.items[i].ptr);
        options.text_only = true;
        session_load(&session, &options, NULL);
        scene_names_note(names, &session);
        session_finish(&session);
    }
    for (uint32_t i = 0; i < names->others.count; i++) {
        struct session_options options = cli_session_options(cli, names->others.items[i].path.ptr);
        if (names->read[i])
            continue;
        options.found_in = names->others.items[i].folder;
        options.unnamed = true;
        check_scene(&session, &options, NULL);
        cli_report(cli, &session, false);
        session_finish(&session);
    }
}
