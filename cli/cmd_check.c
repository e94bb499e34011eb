// glint check SCENE...: every finding of every file, in the order of the command line; folders by name.
//
// Files are checked at the same time, each with a session, a sink and a record of its own; what is reported
// about each is kept until all are done, so that the output does not depend on which was first.
#include "app/check.h"
#include "app/fixes.h"
#include "cli/cli.h"
#include "cli/fix.h"
#include "core/parallel.h"
#include "core/str_map.h"
#include "diag/diag_text.h"
#include "files/files_walk.h"
#include "parser/tree/reader_text.h"

#include <errno.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum check_format {
    CHECK_TEXT,
    CHECK_JSON,
    CHECK_SARIF,
    CHECK_GITHUB,
    CHECK_GITLAB,
    CHECK_JUNIT,
};
static const char *const formats[] = {"text", "json", "sarif", "github", "gitlab", "junit", NULL};
static const char *const endings[] = {".glint.yaml", ".glint.yml", ".glint.xml", NULL};

// A store of meshes and images belongs to one thread at a time, and serves one scene after another.
struct check_store {
    atomic_flag busy;
    struct asset_store *store;
};

struct check_file {
    const char *path;
    const char *folder; // that it was found in; NULL: it was named
    struct strbuf text; // CHECK_TEXT
    struct report_scene record;
    int status;
    bool failed; // no memory for the record
};

struct check {
    struct cli *cli;
    enum check_format format;
    char root[4096];
    struct {
        struct check_file *items;
        uint32_t count, capacity;
    } files;
    struct str_map paths; // of files
    struct check_store *stores;
    unsigned store_count;
};

// ---- one file

static int status_of(const struct session *session) {
    int status = cli_session_status(session);
    return status == CLI_OK && check_failed(session) ? CLI_SCENE : status;
}

static struct session_options options_of(const struct check *check, const struct check_file *file) {
    struct session_options options = cli_session_options(check->cli, file->path);
    options.found_in = str_from(file->folder);
    return options;
}

static void check_one(struct check *check, struct check_file *file, struct asset_store *store) {
    const struct cli *cli = check->cli;
    struct session session;
    struct session_options options = options_of(check, file);
    check_scene(&session, &options, store);
    file->status = status_of(&session);
    if (check->format == CHECK_TEXT) {
        struct diag_text_options text = {.color = cli->color && !cli->options.output,
                                         .notes = cli->options.verbose && !cli->options.quiet,
                                         .most = (uint32_t)session.options.limits.value[LIMIT_MESSAGES]};
        diag_text(&file->text, &session.sink, &session.sources, text);
        file->failed = file->text.failed;
    } else {
        report_scene_init(&file->record, str_from(file->path));
        file->failed = !check_report(&file->record, &session, check->root);
    }
    session_finish(&session);
}

static void check_some(void *context, size_t begin, size_t end) {
    struct check *check = context;
    unsigned slot = 0;
    // There is a store for each thread, so that one is always free.
    while (atomic_flag_test_and_set(&check->stores[slot].busy))
        slot = (slot + 1) % check->store_count;
    for (size_t i = begin; i < end; i++)
        check_one(check, &check->files.items[i], check->stores[slot].store);
    atomic_flag_clear(&check->stores[slot].busy);
}

static bool check_all(struct check *check) {
    check->store_count = parallel_processors();
    check->stores = ARENA_ARRAY(&check->cli->arena, struct check_store, check->store_count);
    bool good = true;
    for (unsigned i = 0; i < check->store_count; i++) {
        atomic_flag_clear(&check->stores[i].busy);
        check->stores[i].store = asset_store_create();
        good = good && check->stores[i].store;
    }
    if (good)
        parallel_for(check->files.count, 1, check_some, check);
    for (unsigned i = 0; i < check->store_count; i++)
        asset_store_destroy(check->stores[i].store);
    return good;
}

// ---- the files

// A file that is named twice, or is in a folder that is named too, is checked once.
static void add_file(struct check *check, const char *path, const char *folder) {
    uint32_t *place = str_map_at(&check->paths, str_from(path));
    if (*place) {
        check->files.items[*place - 1].folder = folder ? check->files.items[*place - 1].folder : NULL;
        return;
    }
    struct check_file *file = ARENA_PUSH(&check->cli->arena, &check->files);
    *place = check->files.count;
    file->path = path;
    file->folder = folder;
    strbuf_init(&file->text);
}

static int add_folder(struct check *check, int operand) {
    struct cli *cli = check->cli;
    struct files_found found = {.arena = &cli->arena, .endings = endings};
    const char *path = cli->operands[operand];
    if (files_walk(&found, str_from(path)) != FILE_OK) {
        cli_error(cli, DIAG_FILE_UNREADABLE, found.unreadable.ptr, NULL, "the folder cannot be read: %s",
                  strerror(errno));
        return CLI_FILE;
    }
    for (uint32_t i = 0; i < found.paths.count; i++)
        add_file(check, found.paths.items[i].ptr, path);
    if (found.paths.count)
        return CLI_OK;
    cli_usage(cli, cli_operand_place(cli, operand), "there is no scene in the folder '%s'", path);
    diag_help(&cli->sink,
              "in a folder, the files named *.glint.yaml, *.glint.yml and *.glint.xml are scenes");
    return CLI_USAGE;
}

static int add_operands(struct check *check) {
    int worst = CLI_OK;
    for (int i = 0; i < check->cli->operand_count; i++) {
        const char *path = check->cli->operands[i];
        int status = CLI_OK;
        if (files_is_folder(str_from(path)))
            status = add_folder(check, i);
        else
            add_file(check, path, NULL);
        worst = status > worst ? status : worst;
    }
    return worst;
}

// ---- the report

static bool make_text(struct check *check, struct strbuf *out) {
    for (uint32_t i = 0; i < check->files.count; i++)
        strbuf_str(out, strbuf_view(&check->files.items[i].text));
    return !out->failed;
}

static bool make_report(struct check *check, struct strbuf *out) {
    static void (*const make[])(struct strbuf *, const struct report *) = {
        [CHECK_JSON] = report_json,     [CHECK_SARIF] = report_sarif, [CHECK_GITHUB] = report_github,
        [CHECK_GITLAB] = report_gitlab, [CHECK_JUNIT] = report_junit,
    };
    struct report_scene *scenes = ARENA_ARRAY(&check->cli->arena, struct report_scene, check->files.count);
    for (uint32_t i = 0; i < check->files.count; i++)
        scenes[i] = check->files.items[i].record;
    struct report report = {.program_version = GLINT_VERSION,
                            .root = check->root,
                            .scenes = scenes,
                            .scene_count = check->files.count,
                            .notes = check->cli->options.verbose && !check->cli->options.quiet};
    make[check->format](out, &report);
    return !out->failed;
}

static int write_report(struct check *check) {
    struct cli *cli = check->cli;
    struct strbuf out;
    strbuf_init(&out);
    bool good = check->format == CHECK_TEXT ? make_text(check, &out) : make_report(check, &out);
    int status = CLI_OK;
    if (!good) {
        cli_error(cli, DIAG_OUT_OF_MEMORY, cli->options.output ? cli->options.output : "report", NULL,
                  "not enough memory for the report");
        status = CLI_FILE;
    } else if (cli->options.output) {
        status = cli_write(cli, cli->options.output, strbuf_view(&out));
    } else if (check->format == CHECK_TEXT) {
        cli_write_error(strbuf_view(&out));
    } else {
        status = cli_print(cli, strbuf_view(&out));
    }
    strbuf_finish(&out);
    return status;
}

// Before the check, so that it reports what is left; one file after another, since several may include one.
static int fix_files(struct check *check) {
    struct cli *cli = check->cli;
    struct strbuf patch;
    struct asset_store *store = asset_store_create();
    int worst = store ? CLI_OK : CLI_FILE;
    strbuf_init(&patch);
    for (uint32_t i = 0; store && i < check->files.count; i++) {
        struct session_options options = options_of(check, &check->files.items[i]);
        int status = cli_fix(cli, &options, store, &patch);
        worst = status > worst ? status : worst;
    }
    if (patch.len && cli_print(cli, strbuf_view(&patch)) != CLI_OK)
        worst = CLI_FILE;
    strbuf_finish(&patch);
    asset_store_destroy(store);
    return worst;
}

static int run(struct check *check) {
    int worst = add_operands(check);
    if (worst == CLI_USAGE)
        return worst;
    int fixed = check->cli->options.fix ? fix_files(check) : CLI_OK;
    worst = fixed > worst ? fixed : worst;
    bool good = check_all(check);
    for (uint32_t i = 0; i < check->files.count; i++) {
        const struct check_file *file = &check->files.items[i];
        worst = file->status > worst ? file->status : worst;
        good = good && !file->failed;
    }
    int written = write_report(check);
    if (!good) {
        cli_error(check->cli, DIAG_OUT_OF_MEMORY, "check", NULL, "not enough memory to keep all findings");
        worst = CLI_FILE;
    }
    return written > worst ? written : worst;
}

int cmd_check(struct cli *cli) {
    struct check check = {.cli = cli};
    str_map_init(&check.paths, &cli->arena);
    int format = 0;
    if (!cli_format(cli, formats, &format))
        return CLI_USAGE;
    check.format = (enum check_format)format;
    if (cli->options.quiet && cli_has_no_effect(cli, "verbose", "'--quiet' leaves notes out"))
        return CLI_USAGE;
    if (cli->options.diff && !cli->options.fix)
        cli->options.fix = FIX_SAFE;
    if (cli->options.diff && check.format != CHECK_TEXT && !cli->options.output)
        return cli_usage(cli, cli->options.fix_arg,
                         "the patch and the report would be mixed: write the report to a file with -o");
    if (cli->options.fix && !cli->options.diff && cli->stream.path.len)
        return cli_usage(cli, cli->options.fix_arg,
                         "standard input cannot be changed: '--diff' shows the fixes as a patch");
    if (!getcwd(check.root, sizeof check.root))
        check.root[0] = '\0';
    int status = run(&check);
    for (uint32_t i = 0; i < check.files.count; i++) {
        strbuf_finish(&check.files.items[i].text);
        report_scene_finish(&check.files.items[i].record);
    }
    return status;
}
