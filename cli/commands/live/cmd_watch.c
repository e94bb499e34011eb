// glint render SCENE --watch: a picture now, and one after each change of a file that it is made from.
#include "cli/commands/commands.h"
#include "cli/commands/rendering.h"
#include "cli/device.h"
#include "cli/made.h"
#include "cli/progress.h"
#include "core/clock.h"
#include "diag/codes/limit.h"
#include "grammar/ir.h"
#include "picture/write/image.h"
#include "render/live/coarse.h"
#include "render/live/live_report.h"

#include <stdio.h>
#include <string.h>

// A file that an editor writes counts as complete when it has not changed for this long.
#define QUIET_SECONDS 0.01
// How often files are checked while a picture is made, to see whether its scene is already old.
#define LOOK_SECONDS 0.1
#define WAIT_SECONDS 1.0

struct watching {
    struct cli *cli;
    struct live live;
    struct job job; // of what is shown
    struct gpu *gpu;
    const char *output;
    enum image_format format;
    struct image image;
    struct progress progress;
    double looked;        // clock: last check of the files during a frame
    bool is_stale;        // the frame was ended because a file has changed
    double changed;       // clock: when the last change was seen
    double pixel_seconds; // per sample of a pixel in the last frame; 0: there was none
};

// ---- what does not go together with it

static const struct cli_no_effect no_place[] = {
    {"repeat", "--watch renders after each change"},
    {"time", "--watch makes whole pictures"},
    {"max-error", "--watch follows the scene, and does not choose settings"},
    {"max-time", NULL},
    {"audit", "--watch makes no audits; 'glint render' without it does"},
    {"max-off", NULL},
    {"count-rays", "--watch counts no rays; 'glint render' without it does"},
    {"aov", "--watch writes only the picture"},
    {0},
};

static int refuse(struct cli *cli, const char *output) {
    const int place = cli_option_place(cli, "watch");
    if (cli_is_stream(cli, cli->operands[0]))
        return cli_usage(cli, place, "--watch waits for changes of a file, and standard input is none");
    if (strcmp(output, "-") == 0 || strncmp(output, "/dev/", 5) == 0)
        return cli_usage(cli, place,
                         "--watch replaces the picture's file after each change: name one with -o");
    if (str_equal(cli->options.camera, STR("all")))
        return cli_usage(cli, place, "--watch looks through one camera: name it with --camera");
    if (cli->options.outputs.count > 1)
        return cli_usage(cli, cli->options.outputs.items[1].arg,
                         "--watch writes one picture: leave this one out");
    if (cli_device_is_reference(cli))
        return cli_usage(cli, place, "--watch works on a device, not by the reference");
    return cli_have_no_effect(cli, no_place) ? CLI_USAGE : CLI_OK;
}

// ---- one picture

static bool goes_on(void *context, double fraction) {
    struct watching *w = context;
    const struct render_progress shown = progress_callback(&w->progress);
    const double now = clock_seconds();
    if (now - w->looked > LOOK_SECONDS) {
        w->looked = now;
        w->is_stale = watch_differs(w->live.watch);
    }
    return shown.report(shown.context, fraction) && !w->is_stale;
}

static int encode_and_write(struct watching *w, double *encode_seconds) {
    struct strbuf file;
    strbuf_init(&file);
    const double start = clock_seconds();
    image_encode(&w->image, w->format, job_display(&w->job), &file);
    *encode_seconds = clock_seconds() - start;
    const int status = cli_write_made(w->cli, w->output, &file, "the picture");
    strbuf_finish(&file);
    return status;
}

// Shows something at once if the frame takes long; the file does not say how it was made.
static int show_coarse(struct watching *w, const struct render_progress *progress, double *seconds) {
    const uint32_t shrink = coarse_shrink(&w->live.shot.settings, w->pixel_seconds);
    double encode_seconds;
    *seconds = 0;
    if (shrink == 1 || image_format_info(w->format)->is_linear)
        return CLI_OK;
    const enum shot_status taken = coarse_take(&w->live.shot, shrink, &w->image, progress);
    if (taken != SHOT_OK)
        return taken == SHOT_DEVICE ? cli_device_failed(w->cli, w->gpu) : CLI_OK;
    w->image.coding = render_coding(&w->cli->options, w->format);
    w->image.texts = (struct image_texts){0};
    const int status = encode_and_write(w, &encode_seconds);
    *seconds = clock_seconds() - w->changed;
    return status;
}

static int write_picture(struct watching *w, double *encode_seconds) {
    w->image.coding = render_coding(&w->cli->options, w->format);
    const struct provenance made = job_provenance(&w->job, w->format, w->image.coding);
    w->image.texts = provenance_texts(&made, &w->cli->arena);
    return encode_and_write(w, encode_seconds);
}

static int tell(struct watching *w, const struct live_report *report) {
    const enum cli_stats stats = w->cli->options.stats;
    struct strbuf text;
    int status = CLI_OK;
    if (!report->is_broken && !w->cli->options.quiet)
        fprintf(stderr, "glint: wrote %s, %u x %u, %.0f ms after the %s\n", w->output, report->width,
                report->height, 1e3 * report->total_seconds, w->live.loads == 1 ? "start" : "change");
    if (!stats)
        return CLI_OK;
    strbuf_init(&text);
    (stats == CLI_STATS_JSON ? live_json : live_text)(report, &text);
    if (stats == CLI_STATS_JSON)
        status = cli_print(w->cli, strbuf_view(&text));
    else
        cli_write_error(strbuf_view(&text));
    strbuf_finish(&text);
    return status;
}

static int show_picture(struct watching *w) {
    const struct render_settings *settings = &w->live.shot.settings;
    const struct render_statistics *frame = &w->job.stats.last;
    const struct render_progress progress = {goes_on, w};
    const bool quiet = w->cli->options.quiet;
    if (!image_fit(&w->image, settings->width, settings->height)) {
        cli_error(w->cli, DIAG_OUT_OF_MEMORY, w->output, NULL, "not enough memory for the picture");
        return CLI_SCENE;
    }
    job_follow(&w->job, &w->live);
    w->is_stale = false;
    w->looked = clock_seconds();
    progress_begin(&w->progress, quiet);
    double coarse_seconds;
    const int coarse = show_coarse(w, &progress, &coarse_seconds);
    enum shot_status status = SHOT_CANCELLED;
    if (coarse == CLI_OK && !w->is_stale && !interrupt_signal())
        status = job_frame(&w->job, &w->image, &progress);
    progress_end(&w->progress);
    if (coarse != CLI_OK)
        return coarse;
    // Ended by a signal or by a change; the caller sees which.
    if (status == SHOT_CANCELLED)
        return CLI_OK;
    if (status == SHOT_DEVICE)
        return cli_device_failed(w->cli, w->gpu);
    w->pixel_seconds = frame->wall_seconds / ((double)w->image.width * w->image.height * frame->samples);
    cli_report(w->cli, w->live.session, !quiet);
    struct live_report report = {.live = &w->live,
                                 .output = w->output,
                                 .width = w->image.width,
                                 .height = w->image.height,
                                 .frame = frame,
                                 .coarse_seconds = coarse_seconds};
    const int written = write_picture(w, &report.encode_seconds);
    report.total_seconds = clock_seconds() - w->changed;
    if (written != CLI_OK)
        return written;
    return tell(w, &report);
}

static int show_findings(struct watching *w) {
    struct session *session = live_findings(&w->live);
    if (!session) {
        cli_error(w->cli, DIAG_OUT_OF_MEMORY, w->cli->operands[0], NULL, "not enough memory for the scene");
        return CLI_FILE;
    }
    const int status = cli_report(w->cli, session, !w->cli->options.quiet);
    // No change of the scene can mend a mistake on the command line.
    if (w->live.loads == 1 && status != CLI_SCENE)
        return status;
    const struct live_report report = {.live = &w->live, .is_broken = true, .output = w->output};
    if (!w->cli->options.quiet)
        fprintf(stderr, "glint: %s\n",
                w->live.session ? "the picture of before stays until the scene is right again"
                                : "there is no picture until the scene is right");
    return tell(w, &report);
}

// ---- the whole

static int load(struct watching *w) {
    switch (live_load(&w->live)) {
    case LIVE_SHOWN:
        return show_picture(w);
    case LIVE_BROKEN:
        return show_findings(w);
    default:
        return cli_device_failed(w->cli, w->gpu);
    }
}

// Once the picture is there, compiles what the next one would wait for.
static int load_and_warm(struct watching *w) {
    const int status = load(w);
    if (status != CLI_OK || !w->live.session || interrupt_signal() || live_warm(&w->live))
        return status;
    return cli_device_failed(w->cli, w->gpu);
}

static int run(struct watching *w) {
    int status = load_and_warm(w);
    if (status == CLI_OK && !w->cli->options.quiet)
        fprintf(stderr, "glint: waiting for changes; Ctrl-C ends\n");
    while (status == CLI_OK && !interrupt_signal()) {
        if (!watch_wait(w->live.watch, WAIT_SECONDS))
            continue;
        w->changed = clock_seconds();
        if (watch_settle(w->live.watch, QUIET_SECONDS))
            status = load_and_warm(w);
    }
    return status;
}

int cmd_watch(struct cli *cli) {
    const char *scene = cli->operands[0];
    struct watching w = {.cli = cli, .changed = cli->begun};
    w.output = cli->options.output ? cli->options.output : cli_default_picture(cli, scene);
    int status = refuse(cli, w.output);
    if (status == CLI_OK && !cli->options.output)
        status = cli_judge_made(cli, "", w.output);
    if (status != CLI_OK)
        return status;
    image_format_of_path(str_from(w.output), IMAGE_WRITTEN, &w.format);
    interrupt_catch();
    status = cli_try_output(cli, w.output);
    if (status == CLI_OK)
        status = cli_open_device(cli, &w.gpu);
    if (status != CLI_OK)
        return status;
    struct live_wish wish = {.session = cli_session_options(cli, scene), .camera = cli->options.camera};
    wish.session.lint = LINT_CHEAP;
    if (live_begin(&w.live, &wish, w.gpu)) {
        status = run(&w);
    } else {
        cli_error(cli, DIAG_OUT_OF_MEMORY, scene, NULL, "not enough memory to watch the scene");
        status = CLI_FILE;
    }
    live_finish(&w.live);
    image_finish(&w.image);
    cli_close_device(cli, w.gpu);
    return status;
}
