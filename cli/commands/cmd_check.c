// glint check SCENE...: every finding of every file, in the order of the command line, in folders by name.
// With --changed, only scenes that read a changed file.
//
// Files are checked at the same time, each with a session, a sink and a record of its own; each file's report
// is kept until all are done, so the output does not depend on which was first.
#include "cli/commands/commands.h"
#include "cli/commands/fix.h"
#include "cli/commands/folder_scenes.h"
#include "cli/untrusted.h"
#include "core/parallel.h"
#include "core/str_map.h"
#include "diag/codes/command.h"
#include "diag/codes/limit.h"
#include "diag/diag_report_text.h"
#include "diag/diag_text.h"
#include "edit/fixes.h"
#include "load/check.h"
#include "load/scope/baseline.h"
#include "load/scope/changed.h"
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

// A store of meshes and images belongs to one thread at a time, and serves one scene after another.
struct check_store {
    atomic_flag busy;
    struct asset_store *store;
};

struct check_file {
    const char *path;
    const char *folder; // the folder that it was found in; NULL: it was named
    struct strbuf text; // CHECK_TEXT
    struct report_scene record;
    struct baseline_found found; // if a baseline is written
    uint32_t errors, warnings, notes, in_baseline;
    enum session_state state;
    int status;
    bool failed;   // no memory for the record
    bool affected; // by what changed
    bool unnamed;  // it begins as a scene does, but has another name
};

struct check {
    struct cli *cli;
    enum check_format format;
    char root[4096];
    struct {
        struct check_file *items;
        uint32_t count, capacity;
    } files;
    struct files known;       // that paths are looked up in
    struct str_map paths;     // of files, links of their folders resolved
    struct scene_names names; // of those in folders, and of others that begin as scenes do
    uint32_t named;           // number of scenes that were named; all others were found
    uint32_t first;           // first file of the step; at the end, the first of those others
    struct check_store *stores;
    unsigned store_count;
    void (*step)(struct check *check, struct check_file *file, struct asset_store *store); // of all files
    struct changed *changed;   // NULL: everything is checked
    uint32_t looked_at;        // scenes before --changed left some out
    struct baseline *baseline; // NULL: none
    str found_folder;          // of the baseline that is written; empty: none is
};

// ---- one file

static int status_of(const struct session *session) {
    int status = cli_session_status(session);
    return status == CLI_OK && check_failed(session) ? CLI_SCENE : status;
}

static struct session_options options_of(const struct check *check, const struct check_file *file) {
    struct session_options options = cli_session_options(check->cli, file->path);
    options.found_in = str_from(file->folder);
    options.unnamed = file->unnamed;
    return options;
}

static bool shows_notes(const struct check *check) {
    return check->cli->options.verbose && !check->cli->options.quiet;
}

static void check_one(struct check *check, struct check_file *file, struct asset_store *store) {
    const struct cli *cli = check->cli;
    struct session session;
    struct session_options options = options_of(check, file);
    if (check->found_folder.len) {
        baseline_found_init(&file->found, check->found_folder);
    }
    check_scene(&session, &options, store);
    scene_names_note(&check->names, &session);
    if (check->baseline || check->found_folder.len)
        file->in_baseline =
            baseline_take(&session, check->baseline, check->found_folder.len ? &file->found : NULL);
    file->status = status_of(&session);
    file->state = session.state;
    file->errors = session.sink.errors;
    file->warnings = session.sink.warnings;
    file->notes = session.sink.notes;
    if (check->format == CHECK_TEXT) {
        struct diag_text_options text = {.color = cli->color && !cli->options.output,
                                         .notes = shows_notes(check),
                                         .most = (uint32_t)session.options.limits.value[LIMIT_MESSAGES],
                                         .alike = cli_text_alike(&session.options.limits)};
        diag_text(&file->text, &session.sink, &session.sources, text);
        file->failed = file->text.failed;
    } else {
        report_scene_init(&file->record, str_from(file->path));
        file->failed = !check_report(&file->record, &session, check->root);
        file->record.in_baseline = file->in_baseline;
    }
    session_finish(&session);
}

// Loads the scene as `glint deps` does.
static void find_affected(struct check *check, struct check_file *file, struct asset_store *store) {
    struct session session;
    struct session_options options = options_of(check, file);
    options.pixels = ASSETS_SKIP_PIXELS;
    session_load(&session, &options, store);
    scene_names_note(&check->names, &session);
    file->affected = changed_affects(check->changed, &session);
    session_finish(&session);
}

static void step_some(void *context, size_t begin, size_t end) {
    struct check *check = context;
    unsigned slot = 0;
    // There is a store for each thread, so one is always free.
    while (atomic_flag_test_and_set(&check->stores[slot].busy))
        slot = (slot + 1) % check->store_count;
    for (size_t i = begin; i < end; i++)
        check->step(check, &check->files.items[check->first + i], check->stores[slot].store);
    atomic_flag_clear(&check->stores[slot].busy);
}

static bool make_stores(struct check *check) {
    check->store_count = parallel_processors();
    check->stores = ARENA_ARRAY(&check->cli->arena, struct check_store, check->store_count);
    bool good = true;
    for (unsigned i = 0; i < check->store_count; i++) {
        atomic_flag_clear(&check->stores[i].busy);
        check->stores[i].store = asset_store_create();
        good = good && check->stores[i].store;
    }
    return good;
}

static void finish_stores(struct check *check) {
    for (unsigned i = 0; i < check->store_count; i++)
        asset_store_destroy(check->stores[i].store);
}

static void with_all(struct check *check,
                     void (*step)(struct check *check, struct check_file *file, struct asset_store *store)) {
    check->step = step;
    parallel_for(check->files.count - check->first, 1, step_some, check);
}

// ---- the files

// A file that is named twice, or is also in a named folder, is checked once. NULL: it is there already.
static struct check_file *add_file(struct check *check, const char *path, const char *folder) {
    struct arena *arena = &check->cli->arena;
    const str name = str_from(path);
    const str folder_of = files_canonical(&check->known, path_folder(name));
    uint32_t *place = str_map_at(&check->paths, path_join(arena, folder_of, path_base(name)));
    if (*place) {
        check->files.items[*place - 1].folder = folder ? check->files.items[*place - 1].folder : NULL;
        return NULL;
    }
    struct check_file *file = ARENA_PUSH(arena, &check->files);
    *place = check->files.count;
    file->path = path;
    file->folder = folder;
    strbuf_init(&file->text);
    return file;
}

// Adds the scenes in a folder; CLI_FILE if it cannot be read, CLI_USAGE if it has none.
static int add_folder(struct check *check, int arg, const char *path) {
    struct cli *cli = check->cli;
    struct scene_names found = {0};
    const int status = cli_find_scenes(cli, path, &found);
    for (uint32_t i = 0; i < found.paths.count; i++)
        add_file(check, found.paths.items[i].ptr, path);
    for (uint32_t i = 0; i < found.others.count; i++)
        *ARENA_PUSH(&cli->arena, &check->names.others) = found.others.items[i];
    // Files named besides the folder are still checked.
    if (status == CLI_OK && !found.paths.count && !check->named)
        return cli_no_scene(cli, arg, path, &found);
    return status;
}

static int add_operands(struct check *check) {
    struct cli *cli = check->cli;
    int worst = CLI_OK;
    for (int i = 0; i < cli->operand_count; i++) {
        int status = CLI_OK;
        if (files_is_folder(str_from(cli->operands[i])))
            status = add_folder(check, cli_operand_place(cli, i), cli->operands[i]);
        else if (!check->changed)
            add_file(check, cli->operands[i], NULL);
        worst = status > worst ? status : worst;
    }
    return worst;
}

// Scenes among the files that are named are checked wherever they are, whatever they are called.
static int add_changed(struct check *check) {
    struct changed *changed = check->changed;
    struct cli *cli = check->cli;
    for (uint32_t i = 0; i < changed->named.count; i++) {
        const str path = changed->named.items[i];
        if (scene_name_fits(path) && add_file(check, path.ptr, NULL))
            check->named++;
        else
            scene_names_add(&check->names, &cli->arena, path);
    }
    check->named += check->names.others.count;
    return changed->names_folders
               ? add_operands(check)
               : add_folder(check, cli_option_place(cli, "changed"), changed->searched.items[0].ptr);
}

// Leaves out the scenes that read nothing that changed.
static void keep_affected(struct check *check) {
    uint32_t kept = 0;
    check->looked_at = check->files.count;
    if (!check->changed)
        return;
    with_all(check, find_affected);
    for (uint32_t i = 0; i < check->files.count; i++)
        if (check->files.items[i].affected)
            check->files.items[kept++] = check->files.items[i];
    check->files.count = kept;
}

// Adds files that begin as scenes do and that no scene reads: named ones are scenes, for others there is a
// warning.
static void add_others(struct check *check, bool named) {
    const struct scene_names *names = &check->names;
    for (uint32_t i = 0; i < names->others.count; i++) {
        const struct scene_other *other = &names->others.items[i];
        if (names->read[i] || (other->folder.len == 0) != named ||
            (check->changed && !changed_holds(check->changed, files_canonical(&check->known, other->path))))
            continue;
        struct check_file *file = add_file(check, other->path.ptr, named ? NULL : other->folder.ptr);
        check->looked_at += named && file;
        if (file)
            file->unnamed = !named;
    }
}

// ---- the report

struct sums {
    uint32_t errors, warnings, notes, clean, ignored;
    uint64_t in_baseline;
};

static struct sums sum_up(const struct check *check) {
    struct sums sums = {0};
    for (uint32_t i = 0; i < check->files.count; i++) {
        const struct check_file *file = &check->files.items[i];
        uint32_t notes = shows_notes(check) ? file->notes : 0;
        uint32_t findings = file->errors + file->warnings + notes;
        sums.errors += file->errors;
        sums.warnings += file->warnings;
        sums.notes += notes;
        sums.ignored += file->state == SESSION_IGNORED && findings == 0;
        sums.clean += file->state != SESSION_IGNORED && findings == 0;
        sums.in_baseline += file->in_baseline;
    }
    return sums;
}

// Whether 'ignore' leaves no scene of the folders: success would mean that nothing was checked. Named files
// may be ignored: hooks name whatever changed.
static bool is_all_ignored(const struct check *check) {
    bool found = false;
    for (uint32_t i = 0; i < check->files.count; i++)
        found = found || check->files.items[i].folder;
    return found && !check->changed && sum_up(check).ignored == check->files.count;
}

static void put_changed(const struct check *check, struct strbuf *out) {
    if (check->first)
        strbuf_format(out, "%u of %u scene%s read%s what changed", check->first, check->looked_at,
                      check->looked_at == 1 ? "" : "s", check->first == 1 ? "s" : "");
    else
        strbuf_format(out, "none of %u scene%s reads what changed", check->looked_at,
                      check->looked_at == 1 ? "" : "s");
}

// The last line, such as "glint: 5 errors, 7 warnings in 31 files; 26 clean". There is none if nothing was
// found, or one thing in one file; except with --changed, and if all files that were named are ignored,
// because nothing else shows how few were checked.
static void put_closing(const struct check *check, struct strbuf *out) {
    const struct sums sums = sum_up(check);
    const uint32_t findings = sums.errors + sums.warnings + sums.notes;
    const uint32_t files = check->files.count;
    const bool nothing = files && sums.ignored == files && !is_all_ignored(check);
    bool tells = findings > 1 || (findings == 1 && files > 1) || nothing;
    if (check->cli->options.quiet || !(tells || check->changed))
        return;
    strbuf_cstr(out, "glint: ");
    if (check->changed)
        put_changed(check, out);
    if (check->changed && files)
        strbuf_cstr(out, ": ");
    if (nothing)
        strbuf_format(out, "nothing was checked: 'ignore' leaves out %u scene%s", files,
                      files == 1 ? "" : "s");
    else if (files)
        report_counts(out, sums.errors, sums.warnings, sums.notes);
    if (files > 1 && findings) {
        strbuf_format(out, " in %u files", files);
        if (sums.clean)
            strbuf_format(out, "; %u clean", sums.clean);
        if (sums.ignored)
            strbuf_format(out, ", %u ignored", sums.ignored);
    }
    if (sums.in_baseline && check->baseline)
        strbuf_format(out, "; %llu in the baseline", (unsigned long long)sums.in_baseline);
    strbuf_char(out, '\n');
}

static bool make_text(struct check *check, struct strbuf *out) {
    for (uint32_t i = 0; i < check->files.count; i++)
        strbuf_str(out, strbuf_view(&check->files.items[i].text));
    put_closing(check, out);
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
                            .home = GLINT_HOME,
                            .root = check->root,
                            .scenes = scenes,
                            .scene_count = check->files.count,
                            .notes = shows_notes(check)};
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

// Runs before the check, which then reports what is left; one file after another, since several may include
// the same one.
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

// ---- the baseline

static bool read_baseline(struct check *check, struct baseline *baseline) {
    struct cli *cli = check->cli;
    if (!cli->options.baseline)
        return true;
    if (cli->options.write_baseline) {
        cli_usage(cli, cli_option_place(cli, "write-baseline"),
                  "--write-baseline writes all that is found; it does not go with --baseline");
        return false;
    }
    check->baseline = baseline;
    return baseline_read(baseline, cli->options.baseline, &cli->arena, &cli->sources, &cli->sink);
}

// Reports entries of the baseline that are gone, in every format, on standard error; they make nothing fail.
static void tell_stale(struct check *check) {
    struct strbuf text;
    if (!check->baseline || check->cli->options.quiet)
        return;
    strbuf_init(&text);
    baseline_put_stale(check->baseline, &text);
    cli_write_error(strbuf_view(&text));
    strbuf_finish(&text);
}

// All current findings must be in it, or the next check would report them as new.
static bool is_whole(struct check *check, const char *path) {
    for (uint32_t i = 0; i < check->files.count; i++) {
        const struct check_file *file = &check->files.items[i];
        if (file->found.dropped)
            cli_error(check->cli, DIAG_OUTPUT, path, "keep more findings with --max-messages",
                      "the baseline is not written: '%s' has %u findings more than are kept", file->path,
                      file->found.dropped);
        else if (file->failed || file->status != CLI_OK)
            cli_error(check->cli, DIAG_OUTPUT, path,
                      "correct the errors above first: a baseline cannot hold them",
                      "the baseline is not written: '%s' could not be checked", file->path);
        else
            continue;
        return false;
    }
    return true;
}

static int write_found(struct check *check) {
    struct cli *cli = check->cli;
    const char *path = cli->options.write_baseline;
    const struct baseline_found **found =
        ARENA_ARRAY(&cli->arena, const struct baseline_found *, check->files.count + 1);
    struct strbuf text;
    if (!is_whole(check, path))
        return CLI_FILE;
    for (uint32_t i = 0; i < check->files.count; i++)
        found[i] = &check->files.items[i].found;
    strbuf_init(&text);
    uint32_t count = baseline_put(found, check->files.count, &cli->arena, &text);
    int status = cli_write_made(cli, path, &text, "the baseline");
    strbuf_clear(&text);
    strbuf_format(&text, "glint: %u finding%s written to %s\n", count, count == 1 ? "" : "s", path);
    if (status == CLI_OK && !cli->options.quiet)
        cli_write_error(strbuf_view(&text));
    strbuf_finish(&text);
    return status;
}

// ---- all of it

static int find_changed(struct check *check, struct changed *changed) {
    struct cli *cli = check->cli;
    check->changed = changed;
    changed_init(changed, &cli->arena);
    if (changed_find(changed, cli->operands, cli->operand_count)) {
        const int status = cli_enter_untrusted(cli, cli->command, changed->searched.items[0].ptr);
        return status == CLI_OK ? add_changed(check) : status;
    }
    int arg =
        changed->operand < 0 ? cli_option_place(cli, "changed") : cli_operand_place(cli, changed->operand);
    diag_add(&cli->sink, DIAG_GIT, cli_place(cli, arg), "%.*s", STR_ARG(changed->why));
    diag_help(&cli->sink,
              "the first name is a revision if there is no such file; without a revision, files can "
              "be named: glint check --changed FILE...");
    return CLI_USAGE;
}

static int add_files(struct check *check, struct changed *changed) {
    struct cli *cli = check->cli;
    if (cli->options.changed)
        return find_changed(check, changed);
    if (cli->operand_count == 0)
        return cli_usage(cli, 1, "'glint check' needs SCENE|FOLDER..., or --changed");
    return add_operands(check);
}

static int check_files(struct check *check, int worst) {
    struct cli *cli = check->cli;
    bool good = make_stores(check);
    scene_names_end(&check->names, &cli->arena);
    if (good)
        keep_affected(check);
    add_others(check, true);
    int fixed = good && cli->options.fix ? fix_files(check) : CLI_OK;
    worst = fixed > worst ? fixed : worst;
    if (good)
        with_all(check, check_one);
    check->first = check->files.count;
    add_others(check, false);
    if (good)
        with_all(check, check_one);
    finish_stores(check);
    for (uint32_t i = 0; i < check->files.count; i++) {
        const struct check_file *file = &check->files.items[i];
        worst = file->status > worst ? file->status : worst;
        good = good && !file->failed;
    }
    int written = write_report(check);
    worst = written > worst ? written : worst;
    if (good && is_all_ignored(check))
        worst =
            cli_usage(cli, cli_operand_place(cli, 0), "nothing was checked: 'ignore' leaves out %u scene%s",
                      check->files.count, check->files.count == 1 ? "" : "s");
    tell_stale(check);
    written = cli->options.write_baseline ? write_found(check) : CLI_OK;
    worst = written > worst ? written : worst;
    if (!good) {
        cli_error(cli, DIAG_OUT_OF_MEMORY, "check", NULL, "not enough memory to keep all findings");
        worst = CLI_FILE;
    }
    return worst;
}

static int run(struct check *check) {
    struct changed changed;
    struct baseline baseline;
    if (check->cli->options.write_baseline)
        check->found_folder = baseline_folder(&check->cli->arena, check->cli->options.write_baseline);
    int worst = read_baseline(check, &baseline) ? add_files(check, &changed) : CLI_USAGE;
    if (worst != CLI_USAGE && worst != CLI_REFUSED)
        worst = check_files(check, worst);
    return worst;
}

int cmd_check(struct cli *cli) {
    struct check check = {.cli = cli};
    str_map_init(&check.paths, &cli->arena);
    files_init(&check.known, &cli->arena);
    int format = 0;
    if (!cli_format(cli, formats, &format))
        return CLI_USAGE;
    check.format = (enum check_format)format;
    if (cli->options.diff && !cli->options.fix)
        cli->options.fix = FIX_SAFE;
    if (cli->options.diff && check.format != CHECK_TEXT && !cli->options.output)
        return cli_usage(cli, cli_option_place(cli, "fix"),
                         "the patch and the report would be mixed: write the report to a file with -o");
    if (cli->options.fix && !cli->options.diff && cli->stream.path.len)
        return cli_usage(cli, cli_option_place(cli, "fix"),
                         "standard input cannot be changed: '--diff' shows the fixes as a patch");
    if (!getcwd(check.root, sizeof check.root))
        check.root[0] = '\0';
    int status = run(&check);
    for (uint32_t i = 0; i < check.files.count; i++) {
        strbuf_finish(&check.files.items[i].text);
        report_scene_finish(&check.files.items[i].record);
        baseline_found_finish(&check.files.items[i].found);
    }
    return status;
}
