// glint extremes SCENE: the scene moved, scaled, far away, lit from its own surfaces ...: what breaks.
#include "cli/commands/commands.h"
#include "cli/device.h"
#include "cli/progress.h"
#include "core/nearest.h"
#include "diag/codes/limit.h"
#include "diag/diag_text.h"
#include "files/files.h"
#include "load/settings/extreme_bounds.h"

#include <string.h>

enum {
    WIDTH = 128, // unless --size says otherwise
    HEIGHT = 96,
    BOUNDS_BYTES_MAX = 1 << 20,
};

enum kind {
    KIND_TEXT,
    KIND_JSON
};

struct extremes_run {
    struct cli *cli;
    struct session session;
    struct gpu *gpu;
    struct extreme_bounds bounds;
    str bounds_path;
    uint32_t axes;
    enum render_alternative alternative;
    struct extremes_input input;
    struct extremes extremes;
    struct progress progress;
};

// ---- bounds

static int read_bounds(struct extremes_run *run) {
    struct cli *cli = run->cli;
    const char *path = cli->options.thresholds;
    str text = str_from(extremes_default_bounds);
    run->bounds_path = path ? str_from(path) : STR("glint's own");
    struct files files;
    files_init(&files, &cli->arena);
    enum file_status status =
        path ? files_read_given(&files, run->bounds_path, BOUNDS_BYTES_MAX, &cli->arena, &text) : FILE_OK;
    if (status != FILE_OK) {
        cli_error(cli, session_file_code(status), path, NULL, "the file of bounds %s",
                  file_status_text(&files, status));
        return CLI_FILE;
    }
    struct diag_sink sink;
    diag_sink_init(&sink);
    const uint32_t source = source_add(&cli->sources, SOURCE_KIND_FILE, run->bounds_path, text);
    const struct reader_context input = {
        .sources = &cli->sources, .sink = &sink, .limits = &cli->options.limits, .arena = &cli->arena};
    bool good = extreme_bounds_read(&input, source, &run->bounds);
    if (!good)
        diag_add(&sink, DIAG_OUT_OF_MEMORY, SPAN_NONE, "not enough memory for the bounds");
    good = sink.errors == 0;
    cli_print_sink(cli, &sink);
    diag_sink_finish(&sink);
    return good ? CLI_OK : CLI_SCENE;
}

// ---- axes

static bool read_axes(struct cli *cli, uint32_t *axes) {
    const char *text = cli->options.axes;
    *axes = (1u << EXTREME_AXES) - 1;
    if (!text)
        return true;
    *axes = 0;
    while (*text) {
        const size_t length = strcspn(text, ",");
        const str name = {text, length};
        struct nearest search = nearest_begin(name);
        int axis = 0;
        while (axis < EXTREME_AXES && !str_equal(name, str_from(extreme_axes[axis].name)))
            nearest_offer(&search, str_from(extreme_axes[axis++].name));
        if (axis == EXTREME_AXES) {
            cli_usage(cli, cli_option_place(cli, "axis"), "there is no axis '%.*s'", STR_ARG(name));
            cli_did_you_mean(cli, &search,
                             "the axes are move, scale, distance, index, exponent, sliver, light, camera, "
                             "coplanar and gap");
            return false;
        }
        *axes |= 1u << axis;
        text += length + (text[length] == ',');
    }
    if (!*axes)
        cli_usage(cli, cli_option_place(cli, "axis"), "--axis names no axis");
    return *axes;
}

static bool read_alternative(struct cli *cli, enum render_alternative *alternative) {
    const char *text = cli->options.alternative;
    *alternative = RENDER_ALTERNATIVE_NONE;
    if (!text)
        return true;
    struct nearest search = nearest_begin(str_from(text));
    for (int i = 0; i < RENDER_ALTERNATIVES; i++) {
        const char *name = render_alternative_name((enum render_alternative)i);
        nearest_offer(&search, str_from(name));
        if (strcmp(text, name) == 0) {
            *alternative = (enum render_alternative)i;
            return true;
        }
    }
    cli_usage(cli, cli_option_place(cli, "study"), "there is no study '%s'", text);
    cli_did_you_mean(cli, &search, "docs/accuracy.md lists them, under 'Alternatives'");
    return false;
}

// ---- the run

static bool tell_progress(void *context, double fraction, const struct extreme_cell *cell) {
    struct extremes_run *run = context;
    (void)cell;
    struct render_progress callback = progress_callback(&run->progress);
    return callback.report(callback.context, fraction);
}

static int failed(struct extremes_run *run, enum extremes_status status) {
    struct cli *cli = run->cli;
    if (status == EXTREMES_CANCELLED)
        return cli_interrupted(cli);
    if (status == EXTREMES_DEVICE)
        return cli_device_failed(cli, run->gpu);
    cli_error(cli, DIAG_OUT_OF_MEMORY, cli->operands[0], NULL, "not enough memory for the extremes");
    return CLI_SCENE;
}

static int tell(struct extremes_run *run, enum kind kind) {
    struct cli *cli = run->cli;
    const struct extremes_report report = {.extremes = &run->extremes,
                                           .input = &run->input,
                                           .scene = str_from(cli->operands[0]),
                                           .thresholds = run->bounds_path};
    struct strbuf text;
    strbuf_init(&text);
    int status = cli_report(cli, &run->session, !cli->options.quiet);
    if (status == CLI_OK && cli->options.output) {
        extremes_html(&report, &text);
        status = cli_write_made(cli, cli->options.output, &text, "the report");
    }
    strbuf_clear(&text);
    if (kind == KIND_JSON)
        extremes_json(&report, &text);
    else
        extremes_text(&report, &text);
    if (status == CLI_OK && !(cli->options.output && strcmp(cli->options.output, "-") == 0))
        status = cli_write_made(cli, "-", &text, "the report");
    strbuf_finish(&text);
    return status == CLI_OK && run->extremes.broken ? CLI_SCENE : status;
}

static int run_scene(struct extremes_run *run, enum kind kind) {
    struct cli *cli = run->cli;
    const uint32_t camera = session_camera(&run->session, cli->options.camera);
    if (camera == IR_NO_INDEX)
        return cli_report(cli, &run->session, !cli->options.quiet);
    int status = cli_try_output(cli, cli->options.output);
    if (status == CLI_OK)
        status = cli_open_device(cli, &run->gpu);
    if (status != CLI_OK)
        return status;
    run->input =
        (struct extremes_input){.scene = &run->session.resolved,
                                .camera = camera,
                                .width = cli->options.width ? (uint32_t)cli->options.width : WIDTH,
                                .height = cli->options.height ? (uint32_t)cli->options.height : HEIGHT,
                                .limits = &run->session.options.limits,
                                .gpu = run->gpu,
                                .bounds = run->bounds.items,
                                .bound_count = run->bounds.count,
                                .axes = run->axes,
                                .alternative = run->alternative};
    const struct extremes_progress progress = {tell_progress, run};
    progress_begin(&run->progress, cli->options.quiet);
    const enum extremes_status result = extremes_run(&run->extremes, &run->input, &progress);
    progress_end(&run->progress);
    return result == EXTREMES_DONE ? tell(run, kind) : failed(run, result);
}

int cmd_extremes(struct cli *cli) {
    static const char *const kinds[] = {[KIND_TEXT] = "text", [KIND_JSON] = "json", NULL};
    struct extremes_run run = {.cli = cli};
    int kind;
    if (!cli_format(cli, kinds, &kind) || !read_axes(cli, &run.axes) ||
        !read_alternative(cli, &run.alternative))
        return CLI_USAGE;
    const char *report = cli->options.output;
    if (cli_device_is_reference(cli))
        return cli_usage(cli, 1, "extremes are measured against the reference: choose a device");
    if (report && strcmp(report, "-") != 0 && !str_ends_with_nocase(str_from(report), ".html"))
        return cli_usage(cli, cli_option_place(cli, "output"), "the report '%s' must end in .html", report);
    int status = read_bounds(&run);
    if (status != CLI_OK)
        return status;
    interrupt_catch();
    struct asset_store *store = asset_store_create();
    struct session_options options = cli_session_options(cli, cli->operands[0]);
    options.whole_picture = true;
    session_load(&run.session, &options, store);
    const bool good = run.session.state == SESSION_LOADED && run.session.sink.errors == 0;
    status = good ? run_scene(&run, (enum kind)kind) : cli_report(cli, &run.session, !cli->options.quiet);
    extremes_finish(&run.extremes);
    cli_close_device(cli, run.gpu);
    session_finish(&run.session);
    asset_store_destroy(store);
    return status;
}
