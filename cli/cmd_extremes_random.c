// glint extremes --random N: scenes that nobody wrote, and whether `auto` chose their precision well.
#include "cli/cli.h"
#include "cli/device.h"
#include "cli/progress.h"
#include "core/nearest.h"
#include "files/files.h"
#include "files/output.h"
#include "measure/sweep/sweep.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

enum {
    WIDTH = 64, // unless --size says otherwise
    HEIGHT = 48,
};
static const double MAX_NEEDLESS = 0.05;

struct job {
    struct cli *cli;
    struct gpu *gpu;
    struct sweep_input input;
    struct sweep sweep;
    struct progress progress;
};

// ---- the command line

static bool read_family(struct cli *cli, str name, uint64_t *families) {
    struct nearest search = nearest_begin(name);
    for (int i = 0; i < SWEEP_FAMILIES; i++) {
        nearest_offer(&search, str_from(sweep_families[i].name));
        if (!str_equal(name, str_from(sweep_families[i].name)))
            continue;
        *families |= UINT64_C(1) << i;
        return true;
    }
    cli_usage(cli, cli->options.measure.sweep.families_arg, "there is no family '%.*s'", STR_ARG(name));
    if (nearest_best(&search).len)
        diag_help(&cli->sink, "did you mean '%.*s'?", STR_ARG(nearest_best(&search)));
    else
        diag_help(&cli->sink, "docs/accuracy.md lists them, under 'Random scenes'");
    return false;
}

static bool read_families(struct cli *cli, uint64_t *families) {
    const char *text = cli->options.measure.sweep.families;
    *families = text ? 0 : (UINT64_C(1) << SWEEP_FAMILIES) - 1;
    while (text && *text) {
        const size_t length = strcspn(text, ",");
        if (!read_family(cli, (str){text, length}, families))
            return false;
        text += length + (text[length] == ',');
    }
    if (!*families)
        cli_usage(cli, cli->options.measure.sweep.families_arg, "--family names no family");
    return *families;
}

static int check_options(struct cli *cli) {
    const struct cli_options *o = &cli->options;
    if (cli->operand_count)
        return cli_usage(cli, cli_operand_place(cli, 0), "'--random' makes its own scenes: name none");
    if (cli_device_is_reference(cli))
        return cli_usage(cli, 1, "extremes are measured against the reference: choose a device");
    if (o->axes || o->alternative)
        return cli_usage(cli, o->axes ? o->axes_arg : o->alternative_arg,
                         "random scenes have no axes and no studies");
    if (o->output && strcmp(o->output, "-") != 0 && !str_ends_with_nocase(str_from(o->output), ".html"))
        return cli_usage(cli, o->output_arg, "the report '%s' must end in .html", o->output);
    return CLI_OK;
}

// ---- scenes as files

static int keep_file(struct job *job, const char *name, const struct strbuf *text) {
    const char *folder = job->cli->options.measure.sweep.keep;
    const str path = path_join(&job->cli->arena, str_from(folder), str_from(name));
    return cli_write_made(job->cli, path.ptr, text, "the scene");
}

static int keep_scene(struct job *job, const struct sweep_scene *scene) {
    const char *folder = job->cli->options.measure.sweep.keep;
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
        cli_error(job->cli, DIAG_OUTPUT, folder, NULL, "the folder cannot be made: %s", strerror(errno));
        return CLI_FILE;
    }
    int status = keep_file(job, scene->name, &scene->text);
    for (uint32_t i = 0; i < scene->mesh_count && status == CLI_OK; i++)
        status = keep_file(job, scene->meshes[i].name, &scene->meshes[i].text);
    return status;
}

// ---- the run

static int tell_failure(struct job *job, enum sweep_status status, const struct sweep_scene *scene) {
    if (status == SWEEP_DEVICE)
        return cli_device_failed(job->cli, job->gpu);
    cli_error(job->cli, status == SWEEP_MEMORY ? DIAG_OUT_OF_MEMORY : DIAG_TRANSFORM_OVERFLOW, scene->name,
              NULL,
              status == SWEEP_MEMORY ? "not enough memory for the scene"
                                     : "the scene's coordinates are too large to trace");
    return CLI_SCENE;
}

// Scenes are read in a place where no other file is.
static void add_overlay(struct file_overlay *overlay, struct arena *arena, const char *name,
                        const struct strbuf *text) {
    overlay->path = path_join(arena, STR("/"), str_from(name));
    overlay->text = strbuf_view(text);
}

static int judge_scene(struct job *job, const struct sweep_scene *made) {
    struct cli *cli = job->cli;
    struct arena arena;
    struct file_overlay overlays[SWEEP_MESHES + 1];
    struct session session;
    arena_init(&arena, SIZE_MAX);
    add_overlay(&overlays[0], &arena, made->name, &made->text);
    for (uint32_t i = 0; i < made->mesh_count; i++)
        add_overlay(&overlays[i + 1], &arena, made->meshes[i].name, &made->meshes[i].text);
    struct session_options options = cli_session_options(cli, overlays[0].path.ptr);
    options.overlays = overlays;
    options.overlay_count = made->mesh_count + 1;
    struct asset_store *store = asset_store_create();
    session_load(&session, &options, store);
    int status = CLI_OK;
    if (session.state != SESSION_LOADED || session.sink.errors) {
        status = cli_report(cli, &session, false);
    } else {
        const enum sweep_status judged = sweep_judge(&job->sweep, &job->input, made, &session.resolved);
        if (judged != SWEEP_DONE)
            status = tell_failure(job, judged, made);
    }
    session_finish(&session);
    asset_store_destroy(store);
    arena_finish(&arena);
    return status;
}

static int run_scene(struct job *job, uint32_t index) {
    enum sweep_family family;
    uint32_t number;
    struct sweep_scene made;
    sweep_which(&job->input, index, &family, &number);
    sweep_scene_make(&made, job->input.seed, family, number);
    int status = made.text.failed ? tell_failure(job, SWEEP_MEMORY, &made) : judge_scene(job, &made);
    const bool keeps = status == CLI_OK && job->cli->options.measure.sweep.keep;
    if (keeps && (job->cli->options.verbose || sweep_is_noted(&job->sweep.items[job->sweep.count - 1])))
        status = keep_scene(job, &made);
    sweep_scene_finish(&made);
    return status;
}

static int run_scenes(struct job *job) {
    int status = CLI_OK;
    progress_begin(&job->progress, job->cli->options.quiet);
    struct render_progress callback = progress_callback(&job->progress);
    for (uint32_t i = 0; i < job->input.count && status == CLI_OK; i++) {
        if (!callback.report(callback.context, (double)i / job->input.count)) {
            progress_end(&job->progress);
            return cli_interrupted(job->cli);
        }
        status = run_scene(job, i);
    }
    progress_end(&job->progress);
    return status;
}

static int tell(struct job *job, bool is_json) {
    struct cli *cli = job->cli;
    const struct cli_sweep *o = &cli->options.measure.sweep;
    const struct sweep_report report = {.sweep = &job->sweep,
                                        .input = &job->input,
                                        .max_wrong = o->max_wrong,
                                        .max_needless = o->has_max_needless ? o->max_needless : MAX_NEEDLESS,
                                        .all = cli->options.verbose};
    const char *output = cli->options.output;
    struct strbuf text;
    strbuf_init(&text);
    int status = CLI_OK;
    if (output) {
        sweep_html(&report, &text);
        status = cli_write_made(cli, output, &text, "the report");
    }
    strbuf_clear(&text);
    (is_json ? sweep_json : sweep_text)(&report, &text);
    if (status == CLI_OK && !(output && strcmp(output, "-") == 0))
        status = cli_write_made(cli, "-", &text, "the report");
    strbuf_finish(&text);
    return status == CLI_OK && sweep_is_broken(&report) ? CLI_SCENE : status;
}

static int run_job(struct job *job, bool is_json) {
    struct cli *cli = job->cli;
    int status = cli_try_output(cli, cli->options.output);
    if (status == CLI_OK)
        status = cli_open_device(cli, &job->gpu);
    if (status != CLI_OK)
        return status;
    job->input.gpu = job->gpu;
    if (!gpu_info(job->gpu)->has_double) {
        cli_error(cli, DIAG_NO_DOUBLE, gpu_info(job->gpu)->name, NULL,
                  "the device cannot compute in double precision, with which single is compared");
        return CLI_DEVICE;
    }
    if (!sweep_init(&job->sweep, &job->input)) {
        cli_error(cli, DIAG_OUT_OF_MEMORY, "-", NULL, "not enough memory for the random scenes");
        return CLI_SCENE;
    }
    status = run_scenes(job);
    return status == CLI_OK ? tell(job, is_json) : status;
}

int cmd_extremes_random(struct cli *cli) {
    static const char *const kinds[] = {"text", "json", NULL};
    struct job job = {.cli = cli};
    int kind;
    uint64_t families;
    if (!cli_format(cli, kinds, &kind) || !read_families(cli, &families))
        return CLI_USAGE;
    int status = check_options(cli);
    if (status != CLI_OK)
        return status;
    job.input = (struct sweep_input){.limits = &cli->options.limits,
                                     .width = cli->options.width ? (uint32_t)cli->options.width : WIDTH,
                                     .height = cli->options.height ? (uint32_t)cli->options.height : HEIGHT,
                                     .families = families,
                                     .count = cli->options.measure.sweep.count,
                                     .seed = cli->options.measure.sweep.seed};
    interrupt_catch();
    status = run_job(&job, kind == 1);
    sweep_finish(&job.sweep);
    gpu_destroy(job.gpu);
    return status;
}
