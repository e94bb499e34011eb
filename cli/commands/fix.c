#include "cli/commands/fix.h"

#include "core/text_diff.h"
#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "edit/fixes.h"

#include <stdio.h>
#include <string.h>

static bool is_done(struct cli *cli, str canonical) {
    for (uint32_t i = 0; i < cli->fixed.count; i++)
        if (str_equal(cli->fixed.items[i], canonical))
            return true;
    *ARENA_PUSH(&cli->arena, &cli->fixed) = arena_copy(&cli->arena, canonical);
    return false;
}

static void tell(struct strbuf *text, const struct fixed_file *file) {
    if (file->refused)
        strbuf_format(text, "%.*s: not changed: the fixes would make a file that cannot be read\n",
                      STR_ARG(file->path));
    else if (file->is_new)
        strbuf_format(text, "%.*s: created\n", STR_ARG(file->path));
    else
        strbuf_format(text, "%.*s: %u %s made\n", STR_ARG(file->path), file->changes,
                      file->changes == 1 ? "fix" : "fixes");
}

// A scene that the user named may be anywhere. Files that it reads, and scenes found in a folder, are written
// only where they may be read.
static int write_file(struct cli *cli, const struct session_options *options, const struct fixed_file *file) {
    struct files files;
    files_init(&files, &cli->arena);
    if (!options->found_in.len && str_equal(files_canonical(&files, options->path), file->canonical))
        return cli_write(cli, arena_copy(&cli->arena, file->path).ptr, file->text);
    files_add_scene_root(&files, options->path);
    if (options->found_in.len)
        files_add_root(&files, options->found_in);
    if (file->is_new) // it marks a root that lies above the current one
        files_add_root(&files, path_folder(file->canonical));
    for (uint32_t i = 0; i < options->asset_path_count; i++)
        files_add_root(&files, options->asset_paths[i]);
    return cli_write_named(cli, &files, file->path, file->text);
}

int cli_fix(struct cli *cli, const struct session_options *options, struct asset_store *store,
            struct strbuf *patch) {
    struct fixes fixes;
    struct strbuf text;
    int status = CLI_OK;
    strbuf_init(&text);
    fixes_make(&fixes, options, cli->options.fix, store);
    for (uint32_t i = 0; i < fixes.files.count && !fixes.failed; i++) {
        const struct fixed_file *file = &fixes.files.items[i];
        // A file that several scenes include is shown once; files that were written have no findings left to
        // fix.
        bool shown = cli->options.diff && is_done(cli, file->canonical);
        bool changed = file->is_new || !str_equal(file->before, file->text);
        int written = CLI_OK;
        if (changed && cli->options.diff && !shown)
            text_diff(file->is_new ? STR("/dev/null") : file->path, file->before, file->path, file->text,
                      patch);
        else if (changed && !cli->options.diff)
            written = write_file(cli, options, file);
        status = written > status ? written : status;
        if (written == CLI_OK && !shown && (changed || file->refused) &&
            (!cli->options.diff || file->refused))
            tell(&text, file);
    }
    if (fixes.failed) {
        cli_error(cli, DIAG_OUT_OF_MEMORY, arena_copy(&cli->arena, options->path).ptr, NULL,
                  "not enough memory for its fixes");
        status = CLI_FILE;
    }
    if (fixes.unreadable.len) {
        cli_error(cli, DIAG_FILE_UNREADABLE, arena_copy(&cli->arena, options->path).ptr, NULL,
                  "no fixes were made: %.*s", STR_ARG(fixes.unreadable));
        status = CLI_FILE;
    }
    if (!cli->options.quiet)
        cli_write_error(strbuf_view(&text));
    strbuf_finish(&text);
    fixes_finish(&fixes);
    return status;
}
