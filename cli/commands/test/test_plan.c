// Which pictures there are to test: those that glint-test.yaml names, and the scenes of the folder, each with
// the picture of its name.
#include "cli/commands/folder_scenes.h"
#include "cli/commands/test/test.h"

#include "cli/untrusted.h"
#include "core/nearest.h"
#include "core/str_map.h"
#include "diag/codes/command.h"
#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "files/files_walk.h"
#include "files/glob.h"

#include <stdlib.h>
#include <string.h>

enum {
    FILE_BYTES_MAX = 1 << 20,
};

// The first ending that exists is the reference's; a new reference gets the first in the list.
static const char *const picture_endings[] = {".png", ".exr", ".hdr", ".pfm", ".jpg", ".jpeg", NULL};

static str without_ending(str path, const char *const *endings) {
    for (; *endings; endings++)
        if (str_ends_with_nocase(path, *endings))
            return str_slice(path, 0, path.len - strlen(*endings));
    return path;
}

// ---- the file

static int read_file(struct test_run *run) {
    struct cli *cli = run->cli;
    const char *given = cli->options.test.bounds;
    str text;
    test_file_init(&run->file);
    run->file_path = given ? str_from(given) : path_join(&cli->arena, run->folder, STR(TEST_FILE_NAME));
    if (!given && !files_exist(run->file_path)) {
        run->file_path = STR("");
        return CLI_OK;
    }
    const enum file_status read =
        given
            ? files_read_given(&run->files, run->file_path, FILE_BYTES_MAX, &cli->arena, &text)
            : files_read_found(&run->files, run->file_path, run->folder, FILE_BYTES_MAX, &cli->arena, &text);
    if (read != FILE_OK) {
        cli_error(cli, session_file_code(read), run->file_path.ptr, NULL, "the file of bounds %s",
                  file_status_text(&run->files, read));
        return read == FILE_OUTSIDE ? CLI_REFUSED : CLI_FILE;
    }
    struct diag_sink sink;
    diag_sink_init(&sink);
    const uint32_t source = source_add(&cli->sources, SOURCE_KIND_FILE, run->file_path, text);
    const struct reader_context input = {
        .sources = &cli->sources, .sink = &sink, .limits = &cli->options.limits, .arena = &cli->arena};
    if (!test_file_read(&input, source, &run->file))
        diag_add(&sink, DIAG_OUT_OF_MEMORY, SPAN_NONE, "not enough memory for the bounds");
    const bool good = sink.errors == 0;
    cli_print_sink(cli, &sink);
    diag_sink_finish(&sink);
    return good ? CLI_OK : CLI_USAGE;
}

static str file_folder(const struct test_run *run) {
    return run->file_path.len ? path_folder(run->file_path) : run->folder;
}

// The folder of the reference pictures, if the file names it; empty: there is none.
static str test_pictures_folder(struct test_run *run) {
    str folder = run->file.pictures;
    while (folder.len > 1 && folder.ptr[folder.len - 1] == '/')
        folder.len--;
    return folder.len ? path_join(&run->cli->arena, file_folder(run), folder) : folder;
}

// A mistake at its place in the file.
static int report(struct test_run *run, diag_code code, span at, str message, str help) {
    struct diag_sink sink;
    diag_sink_init(&sink);
    diag_add(&sink, code, at, "%.*s", STR_ARG(message));
    if (help.len)
        diag_help(&sink, "%.*s", STR_ARG(help));
    cli_print_sink(run->cli, &sink);
    diag_sink_finish(&sink);
    return CLI_USAGE;
}

// ---- scenes of the folder

struct plan {
    struct test_run *run;
    struct str_map stems; // 1 + place in `run->cases`
    struct scene_names names;
};

static str shown_in_folder(const struct test_run *run, str path) {
    return str_slice(path, str_equal(run->folder, STR(".")) ? 0 : run->folder.len + 1, path.len);
}

static bool is_skipped(const struct test_run *run, str path) {
    for (uint32_t i = 0; i < run->file.skip.count; i++)
        if (glob_match(run->file.skip.items[i], shown_in_folder(run, path)))
            return true;
    return false;
}

// A scene in both spellings is one: YAML is rendered.
static void add_scene(struct plan *plan, str path) {
    struct test_run *run = plan->run;
    const str shown = shown_in_folder(run, path);
    if (is_skipped(run, path))
        return;
    const str name = arena_copy(&run->cli->arena, without_ending(shown, scene_name_endings));
    uint32_t *place = str_map_at(&plan->stems, name);
    if (!*place) {
        struct test_case *test = ARENA_PUSH(&run->cli->arena, &run->cases);
        *place = run->cases.count;
        *test = (struct test_case){.name = name, .scene = path, .found_in = run->folder};
    } else if (!str_ends_with_nocase(path, ".xml")) {
        run->cases.items[*place - 1].scene = path;
    }
}

static int refuse(struct test_run *run, span at, const char *what) {
    report(run, DIAG_FILE_OUTSIDE, at,
           arena_format(&run->cli->arena,
                        "%s is outside of the folder that " TEST_FILE_NAME " may name files in", what),
           STR("an empty .glintrc.yaml makes its folder the one below which files may be named"));
    return CLI_REFUSED;
}

static int judge_pictures(struct test_run *run) {
    const str folder = test_pictures_folder(run);
    str root;
    return !folder.len || files_place(&run->files, folder, &root) == FILE_OK
               ? CLI_OK
               : refuse(run, run->file.pictures_at, "the folder of the pictures");
}

static int find_scenes(struct plan *plan) {
    struct test_run *run = plan->run;
    const int status = cli_find_scenes(run->cli, run->folder.ptr, &plan->names);
    for (uint32_t i = 0; i < plan->names.paths.count; i++)
        add_scene(plan, plan->names.paths.items[i]);
    return status;
}

// ---- their pictures

static bool take_picture(struct test_run *run, struct test_case *test, str folder, str stem) {
    const str path = path_join(&run->cli->arena, folder, stem);
    for (const char *const *ending = picture_endings; *ending; ending++) {
        test->picture = arena_format(&run->cli->arena, "%.*s%s", STR_ARG(path), *ending);
        if (files_exist(test->picture))
            return test->is_there = true;
    }
    test->picture = arena_format(&run->cli->arena, "%.*s%s", STR_ARG(path), picture_endings[0]);
    return false;
}

static bool is_only_name(const struct test_run *run, str base) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < run->cases.count; i++)
        count += str_equal(path_base(run->cases.items[i].name), base);
    return count == 1;
}

// Looks in the folder that the file names, by the scene's path or only by its name. Else beside the scene, in
// the folder `pictures` there, or in that of the tested folder; a new picture goes into such a folder if
// there is one.
static void find_picture(struct test_run *run, struct test_case *test) {
    struct arena *arena = &run->cli->arena;
    const str named = test_pictures_folder(run), base = path_base(test->name);
    const str beside = path_folder(test->scene);
    if (named.len) {
        const bool is_only = is_only_name(run, base);
        const str inner = path_folder(path_join(arena, named, test->name));
        if (!take_picture(run, test, named, test->name) &&
            !(is_only && take_picture(run, test, named, base)) && (!is_only || files_is_folder(inner)))
            take_picture(run, test, named, test->name);
        return;
    }
    const str own = path_join(arena, beside, STR("pictures")),
              shared = path_join(arena, run->folder, STR("pictures"));
    if (take_picture(run, test, beside, base) || take_picture(run, test, own, base) ||
        take_picture(run, test, shared, test->name) || take_picture(run, test, shared, base))
        return;
    take_picture(run, test, files_is_folder(own) ? own : files_is_folder(shared) ? shared : beside, base);
}

// ---- pictures that the file names

static struct test_case *find_case(struct plan *plan, str name) {
    struct test_run *run = plan->run;
    const uint32_t place = str_map_find(&plan->stems, name);
    struct test_case *only = NULL;
    if (place)
        return &run->cases.items[place - 1];
    for (uint32_t i = 0; i < run->cases.count; i++)
        if (run->cases.items[i].found_in.len && str_equal(path_base(run->cases.items[i].name), name)) {
            if (only)
                return NULL; // which of them is meant?
            only = &run->cases.items[i];
        }
    return only;
}

static int no_scene(struct plan *plan, const struct test_entry *entry, str name) {
    struct test_run *run = plan->run;
    struct nearest search = nearest_begin(name);
    str help = STR("name one: {scene: hall.glint.yaml}");
    for (uint32_t i = 0; i < run->cases.count; i++)
        nearest_offer(&search, run->cases.items[i].name);
    if (nearest_best(&search).len)
        help = arena_format(&run->cli->arena,
                            "did you mean '%.*s.png'? Or name the scene: {scene: hall.glint.yaml}",
                            STR_ARG(nearest_best(&search)));
    return report(run, DIAG_CONFIG_VALUE, entry->picture_at,
                  arena_format(&run->cli->arena, "there is no scene '%.*s' in the folder for this picture",
                               STR_ARG(name)),
                  help);
}

static int missing_scene(struct plan *plan, const struct test_entry *entry) {
    struct test_run *run = plan->run;
    struct nearest search = nearest_begin(entry->scene);
    const str folder = file_folder(run);
    str help = STR("");
    for (uint32_t i = 0; i < run->cases.count; i++) {
        str rest;
        if (str_equal(folder, STR(".")))
            nearest_offer(&search, run->cases.items[i].scene);
        else if (path_is_below(run->cases.items[i].scene, folder, &rest))
            nearest_offer(&search, rest);
    }
    if (nearest_best(&search).len)
        help = arena_format(&run->cli->arena, "did you mean '%.*s'?", STR_ARG(nearest_best(&search)));
    return report(run, DIAG_FILE_MISSING, entry->scene_at,
                  arena_format(&run->cli->arena, "the scene '%.*s' does not exist", STR_ARG(entry->scene)),
                  help);
}

static int add_entry(struct plan *plan, const struct test_entry *entry, struct test_case *named) {
    struct test_run *run = plan->run;
    struct cli *cli = run->cli;
    const str pictures = test_pictures_folder(run), folder = pictures.len ? pictures : file_folder(run);
    enum image_format format;
    const str name = arena_copy(&cli->arena, without_ending(entry->picture, picture_endings));
    if (!image_format_of_path(entry->picture, IMAGE_COMPARED, &format))
        return report(run, DIAG_CONFIG_VALUE, entry->picture_at,
                      STR("a picture's name must end in .png, .jpg, .jpeg, .exr, .pfm or .hdr"),
                      STR("write 'hall.png', for example"));
    *named = (struct test_case){.name = name, .picture = path_join(&cli->arena, folder, entry->picture)};
    struct test_case *found = entry->scene.len ? NULL : find_case(plan, name);
    if (!entry->scene.len && !found)
        return no_scene(plan, entry, name);
    named->scene = found ? found->scene : path_join(&cli->arena, file_folder(run), entry->scene);
    named->found_in = found ? found->found_in : STR("");
    named->name = found ? found->name : name;
    str root;
    if (files_place(&run->files, named->picture, &root) != FILE_OK)
        return refuse(run, entry->picture_at, "this picture");
    if (!found && files_place(&run->files, named->scene, &named->named_in) != FILE_OK)
        return refuse(run, entry->scene_at, "this scene");
    if (!files_exist(named->scene) || files_is_folder(named->scene))
        return missing_scene(plan, entry);
    named->is_there = files_exist(named->picture);
    named->settings = test_settings_join(&run->file.all, &entry->own, &cli->arena);
    return CLI_OK;
}

// A scene that the file names has the pictures given there, and the one of its own name only if it exists.
static bool is_replaced(struct test_run *run, const struct test_case *test, const struct test_case *named,
                        uint32_t count) {
    struct files *files = &run->files;
    bool has_other = false;
    for (uint32_t i = 0; i < count; i++) {
        if (str_equal(named[i].picture, test->picture))
            return true;
        has_other = has_other ||
                    str_equal(files_canonical(files, named[i].scene), files_canonical(files, test->scene));
    }
    return has_other && !test->is_there;
}

static int add_entries(struct plan *plan) {
    struct test_run *run = plan->run;
    const uint32_t count = run->file.entries.count;
    struct test_case *named = ARENA_ARRAY(&run->cli->arena, struct test_case, count);
    int status = CLI_OK;
    for (uint32_t i = 0; i < count; i++) {
        const int added = add_entry(plan, &run->file.entries.items[i], &named[i]);
        status = added > status ? added : status;
    }
    if (status != CLI_OK)
        return status;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < run->cases.count; i++) {
        struct test_case *test = &run->cases.items[i];
        find_picture(run, test);
        test->settings = test_settings_join(&run->file.all, &(struct test_settings){0}, &run->cli->arena);
        if (!is_replaced(run, test, named, count))
            run->cases.items[kept++] = *test;
    }
    run->cases.count = kept;
    for (uint32_t i = 0; i < count; i++)
        *ARENA_PUSH(&run->cli->arena, &run->cases) = named[i];
    return CLI_OK;
}

// ---- all of them

// By device, then by scene, so each is opened or read only once.
static int compare(const void *a, const void *b) {
    const struct test_case *x = a, *y = b;
    const int by_device = str_compare(x->settings.device, y->settings.device);
    const int by_scene = by_device ? by_device : str_compare(x->scene, y->scene);
    return by_scene ? by_scene : str_compare(x->picture, y->picture);
}

static int judge_doubles(struct test_run *run) {
    struct str_map seen;
    str_map_init(&seen, &run->cli->arena);
    for (uint32_t i = 0; i < run->cases.count; i++) {
        const struct test_case *test = &run->cases.items[i];
        uint32_t *place = str_map_at(&seen, test->picture);
        if (*place) {
            const struct test_case *other = &run->cases.items[*place - 1];
            cli_error(run->cli, DIAG_CONFIG_VALUE, test->picture.ptr,
                      "give one of them a picture of its own under 'tests' in " TEST_FILE_NAME
                      ", or 'skip' one of them",
                      "this is the picture of two scenes, %.*s and %.*s", STR_ARG(other->scene),
                      STR_ARG(test->scene));
            return CLI_USAGE;
        }
        *place = i + 1;
    }
    return CLI_OK;
}

static bool matches(const char *pattern, const struct test_case *test) {
    const str p = str_from(pattern);
    return glob_match(p, test->name) || glob_match(p, test->scene) ||
           (!strpbrk(pattern, "*?") &&
            (strstr(test->name.ptr, pattern) || strstr(path_base(test->scene).ptr, pattern)));
}

static int choose(struct test_run *run) {
    struct cli *cli = run->cli;
    const char *only = cli->options.test.only;
    struct nearest search = nearest_begin(str_from(only));
    uint32_t kept = 0;
    for (uint32_t i = 0; only && i < run->cases.count; i++) {
        nearest_offer(&search, run->cases.items[i].name);
        if (matches(only, &run->cases.items[i]))
            run->cases.items[kept++] = run->cases.items[i];
    }
    if (!only)
        return CLI_OK;
    run->left_out = run->cases.count - kept;
    run->cases.count = kept;
    if (kept)
        return CLI_OK;
    cli_usage(cli, cli_option_place(cli, "only"), "no picture's name matches '%s'", only);
    cli_did_you_mean(cli, &search, "names are those of the scenes in the folder: 'hall', 'lamps/*'");
    return CLI_USAGE;
}

// Pictures in the file's folder that belong to no scene: perhaps it was renamed or removed.
static void find_unused(struct test_run *run) {
    struct cli *cli = run->cli;
    struct files_found found = {.arena = &cli->arena, .endings = picture_endings};
    struct str_map used;
    const str folder = test_pictures_folder(run);
    if (!folder.len || !files_is_folder(folder) || files_walk(&found, folder) != FILE_OK)
        return;
    str_map_init(&used, &cli->arena);
    for (uint32_t i = 0; i < run->cases.count; i++)
        *str_map_at(&used, run->cases.items[i].picture) = 1;
    for (uint32_t i = 0; i < found.paths.count; i++)
        if (!str_map_find(&used, found.paths.items[i]))
            *(str *)ARENA_PUSH(&cli->arena, &run->unused) = found.paths.items[i];
}

// Scenes that are tested only if the file names them, and it does not.
static void tell_others(struct plan *plan) {
    struct scene_names *names = &plan->names;
    struct test_run *run = plan->run;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < names->others.count; i++)
        if (!is_skipped(run, names->others.items[i].path))
            names->others.items[kept++] = names->others.items[i];
    names->others.count = kept;
    for (uint32_t i = 0; i < run->cases.count; i++)
        *(str *)ARENA_PUSH(&run->cli->arena, &names->paths) = run->cases.items[i].scene;
    cli_tell_others(run->cli, names);
}

static int judge_folder(struct test_run *run) {
    struct cli *cli = run->cli;
    if (files_is_folder(run->folder))
        return CLI_OK;
    const bool is_file = files_exist(run->folder);
    const int status =
        cli_usage(cli, cli_operand_place(cli, 0),
                  is_file ? "'%s' is not a folder" : "there is no folder '%s'", run->folder.ptr);
    if (is_file)
        diag_help(&cli->sink, "test its folder, and only this: glint test %.*s --only %.*s",
                  STR_ARG(path_folder(run->folder)),
                  STR_ARG(without_ending(path_base(run->folder), scene_name_endings)));
    return status;
}

int test_plan(struct test_run *run) {
    struct cli *cli = run->cli;
    struct plan plan = {.run = run};
    str folder = str_from(cli->operands[0]);
    while (folder.len > 1 && folder.ptr[folder.len - 1] == '/')
        folder.len--;
    run->folder = arena_copy(&cli->arena, folder);
    str_map_init(&plan.stems, &cli->arena);
    int status = judge_folder(run);
    files_init(&run->files, &cli->arena);
    if (status == CLI_OK) {
        cli_add_root(&run->files, run->folder);
        status = read_file(run);
    }
    if (status == CLI_OK && run->file_path.len) {
        cli_add_root(&run->files, file_folder(run));
        status = judge_pictures(run);
    }
    if (status == CLI_OK)
        status = find_scenes(&plan);
    if (status == CLI_OK)
        status = add_entries(&plan);
    if (status == CLI_OK && run->cases.count == 0) {
        status = cli_no_scene(cli, cli_operand_place(cli, 0), run->folder.ptr, &plan.names);
    }
    if (status == CLI_OK)
        status = judge_doubles(run);
    if (status == CLI_OK && !cli->options.test.only)
        tell_others(&plan);
    if (status == CLI_OK)
        find_unused(run);
    if (status == CLI_OK)
        status = choose(run);
    for (uint32_t i = 0; status == CLI_OK && i < run->cases.count; i++)
        image_format_of_path(run->cases.items[i].picture, IMAGE_COMPARED, &run->cases.items[i].format);
    if (status == CLI_OK)
        qsort(run->cases.items, run->cases.count, sizeof *run->cases.items, compare);
    return status;
}
