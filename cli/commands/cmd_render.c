// glint render SCENE: load, flatten, trace, write.
#include "cli/commands/commands.h"
#include "cli/commands/rendering.h"
#include "cli/commands/study.h"
#include "cli/device.h"
#include "cli/made.h"
#include "core/clock.h"
#include "core/timeline.h"
#include "diag/codes/limit.h"
#include "files/output.h"
#include "grammar/ir.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// ---- what goes on while the background's pixels are decoded

static void begin_device(void *context) {
    struct rendering *r = context;
    r->opening = cli_begin_opening(r->cli, r->job.wish.timeline);
}

static void part_sinks(struct rendering *r) {
    r->loaded = r->job.session->sink;
    r->is_apart = true;
    diag_sink_init(&r->job.session->sink);
    diag_sink_keep(&r->job.session->sink, r->loaded.kept_max);
}

static int judge_load(struct rendering *r) {
    const double start = clock_seconds();
    const bool waits = r->job.session->unsettled;
    session_settle(r->job.session);
    if (waits)
        timeline_add(r->job.wish.timeline, "wait", STR(""), start);
    if (r->job.session->state != SESSION_LOADED || r->job.session->sink.errors)
        return cli_report(r->cli, r->job.session, !r->cli->options.quiet);
    if (interrupt_signal())
        return render_failed(r, SHOT_CANCELLED);
    int status = CLI_OK;
    for (uint32_t i = 0; i < r->output_count && status == CLI_OK; i++) {
        status = cli_judge_made(r->cli, render_typed(&r->outputs[i]), r->outputs[i].path);
        if (status == CLI_OK)
            status = cli_try_output(r->cli, r->outputs[i].path);
    }
    return status;
}

// Waits for the pixels. Reports findings of the load first, and nothing else if there are errors; then those
// found meanwhile. An exit code, the same each time.
static int settle(struct rendering *r) {
    if (!r->is_apart)
        return r->settled;
    struct diag_sink meanwhile = r->job.session->sink;
    r->job.session->sink = r->loaded;
    r->is_apart = false;
    r->settled = judge_load(r);
    if (r->settled == CLI_OK)
        diag_merge(&r->job.session->sink, &meanwhile);
    diag_sink_finish(&meanwhile);
    return r->settled;
}

static bool is_ready(void *context) {
    return settle(context) == CLI_OK;
}

// ---- one picture

// The scene's findings are reported after all pictures.
static int drawing_failed(struct rendering *r, enum shot_status status) {
    return status == SHOT_SCENE ? CLI_SCENE : render_failed(r, status);
}

static void tell_estimate(struct rendering *r) {
    job_state_estimate(&r->job);
    if (r->job.wish.by_reference)
        return;
    render_tell_unused_error(r);
    if (r->job.note.len && !r->cli->options.quiet)
        fprintf(stderr, "glint: %s\n", r->job.note.data);
}

static int draw(struct rendering *r, uint32_t pictures) {
    const struct render_progress progress = progress_callback(&r->progress);
    enum shot_status status = job_draw(&r->job, pictures, &progress);
    if (status != SHOT_OK)
        return drawing_failed(r, status);
    tell_estimate(r);
    status = job_audit(&r->job, &progress);
    if (status == SHOT_OK)
        status = job_make_layers(&r->job, &progress);
    if (status == SHOT_NO_MEMORY)
        return render_no_memory_for_aovs(r);
    return status == SHOT_OK ? CLI_OK : drawing_failed(r, status);
}

// Renders a picture that is held in memory as a whole.
static int render_at_once(struct rendering *r, uint32_t camera, uint32_t pictures) {
    int status = draw(r, pictures);
    progress_end(&r->progress);
    if (status == CLI_OK)
        status = render_scale_up(r);
    if (status == CLI_OK)
        status = render_write_pictures(r, camera);
    if (status == CLI_OK)
        status = render_write_aovs(r, camera);
    job_drop_layers(&r->job);
    return status;
}

static int report_stats(struct rendering *r) {
    const bool is_json = r->cli->options.stats == CLI_STATS_JSON;
    struct strbuf text;
    int status = CLI_OK;
    strbuf_init(&text);
    job_report(&r->job, is_json, &text);
    if (is_json && !render_uses_stdout(r))
        status = cli_print(r->cli, strbuf_view(&text));
    else
        cli_write_error(strbuf_view(&text));
    strbuf_finish(&text);
    return status;
}

// One of the cameras that are left: picture, files, statistics. The job is open and uses this camera.
static int render_camera(struct rendering *r, uint32_t camera, uint32_t cameras) {
    progress_begin(&r->progress, r->cli->options.quiet);
    int status =
        CLI_HAS_DEVICES && r->job.in_bands ? render_in_bands(r, camera) : render_at_once(r, camera, cameras);
    // Counted only after the picture was written, which does not wait for it.
    const enum shot_status counted = status == CLI_OK ? job_count(&r->job) : SHOT_OK;
    if (counted != SHOT_OK)
        status = render_failed(r, counted);
    if (status == CLI_OK && r->cli->options.stats)
        status = report_stats(r);
    if (status == CLI_OK)
        status = render_tell_end(r);
    if (status == CLI_OK && !r->cli->options.quiet)
        render_tell_written(r, camera);
    return status;
}

// A device failure is reported after the scene's mistakes.
static int open_device(struct rendering *r) {
    struct cli_opening *opening = r->opening;
    if (r->job.gpu)
        return CLI_OK;
    if (!cli_opening_is_good(opening) && settle(r) != CLI_OK)
        return r->settled;
    return cli_end_opening(r->cli, &r->opening, &r->job.gpu, &r->job.stats.device_seconds);
}

static int draw_cameras(struct rendering *r, uint32_t first, uint32_t end) {
    int status = r->job.wish.by_reference ? CLI_OK : open_device(r);
    if (status != CLI_OK)
        return status;
    r->job.wish.ready = r->is_apart ? is_ready : NULL;
    r->job.wish.ready_context = r;
    enum shot_status opened = job_open(&r->job, first);
    if (opened != SHOT_OK)
        return settle(r) != CLI_OK ? r->settled : render_failed(r, opened);
    for (uint32_t i = first; i < end && status == CLI_OK; i++) {
        if (r->done && r->done[i])
            continue;
        if (i != first && (opened = job_turn(&r->job, i)) != SHOT_OK)
            return render_failed(r, opened);
        status = render_camera(r, i, end - i);
    }
    int reported = cli_report(r->cli, r->job.session, !r->cli->options.quiet);
    return status != CLI_OK ? status : reported;
}

// --skip-done: pictures that are there are not rendered again.
static int leave_done(struct rendering *r, uint32_t *first, uint32_t end) {
    int status = r->cli->options.batch.skip_done ? settle(r) : CLI_OK;
    if (status != CLI_OK || !r->cli->options.batch.skip_done)
        return status;
    if (!r->job.wish.by_reference)
        status = open_device(r);
    if (status != CLI_OK)
        return status;
    render_find_done(r, first, end);
    return *first == end ? cli_report(r->cli, r->job.session, !r->cli->options.quiet) : CLI_OK;
}

// Judges all names that are made from those of the outputs, for these cameras.
static int judge_made(struct rendering *r, uint32_t first, uint32_t end) {
    int status = CLI_OK;
    for (uint32_t k = first; k < end && status == CLI_OK; k++) {
        for (uint32_t i = 0; i < r->output_count && status == CLI_OK; i++)
            status =
                cli_judge_made(r->cli, render_typed(&r->outputs[i]), render_output_of(r, &r->outputs[i], k));
        if (status == CLI_OK)
            status = render_judge_partial(r, k);
        if (status == CLI_OK)
            status = render_judge_aov_names(r, k);
    }
    return status;
}

static int render_cameras(struct rendering *r) {
    const struct ir_cameras *cameras = &r->job.session->scene->cameras;
    bool all = str_equal(r->cli->options.camera, STR("all"));
    r->all_cameras = all && cameras->count > 0;
    uint32_t first = all ? 0 : session_camera(r->job.session, r->cli->options.camera);
    if (first != IR_NO_INDEX && (render_plan_part(r) != CLI_OK || render_plan_bands(r) != CLI_OK))
        return CLI_USAGE;
    const bool good =
        first != IR_NO_INDEX &&
        (r->job.in_bands || image_init(&r->job.image, r->job.part.region.width, r->job.part.region.height));
    if ((!good || r->job.wish.by_reference) && settle(r) != CLI_OK)
        return r->settled;
    if (first == IR_NO_INDEX)
        return cli_report(r->cli, r->job.session, !r->cli->options.quiet);
    if (!good) {
        cli_error(r->cli, DIAG_OUT_OF_MEMORY, r->outputs[0].path, NULL, "not enough memory for the picture");
        return CLI_SCENE;
    }
    int fits = render_judge_size(r);
    if (fits == CLI_OK)
        fits = render_judge_aovs(r);
    if (fits != CLI_OK)
        return fits;
    uint32_t end = r->all_cameras ? cameras->count : first + 1;
    fits = judge_made(r, first, end);
    if (fits == CLI_OK)
        fits = leave_done(r, &first, end);
    if (fits != CLI_OK || first == end)
        return fits;
    return draw_cameras(r, first, end);
}

static int run_job(struct rendering *r, struct asset_store *store) {
    struct session_options options = cli_session_options(r->cli, r->cli->operands[0]);
    const bool device = !r->job.wish.by_reference;
    options.lint = LINT_CHEAP;
    options.error = device ? options.error : -1; // the reference takes all samples
    options.whole_picture = !device;
    options.pixels_later = device;
    options.on_text = device && !r->job.gpu ? begin_device : NULL;
    options.on_text_context = r;
    options.timeline = r->job.wish.timeline;
    session_load(r->job.session, &options, store);
    if (r->job.session->sink.errors == 0 && r->job.session->image && options.error > 0 &&
        !(r->job.session->image->error > 0)) {
        cli_has_no_effect(r->cli, "noise", "no pixel ends before it has image.min_samples");
        return CLI_USAGE;
    }
    part_sinks(r);
    const bool goes_on = r->job.session->unsettled || settle(r) == CLI_OK;
    return goes_on ? render_cameras(r) : r->settled;
}

static bool has_useless_option(struct cli *cli) {
    bool by_reference = cli_device_is_reference(cli);
    return (by_reference &&
            cli_has_no_effect(cli, "repeat", "it times frames of a device, not of the reference")) ||
           (!by_reference && !cli_has_study(cli) &&
            cli_has_no_effect(cli, "no-cache", "the cache is that of '--device reference'"));
}

static bool noise_fits(struct rendering *r) {
    struct cli *cli = r->cli;
    const struct cli_measure *m = &cli->options.measure;
    if (m->noise > 0 && (m->time_s > 0 || cli_has_study(cli)))
        cli_usage(cli, cli_option_place(cli, "noise"),
                  "--noise says when pixels end, and so do --time, --max-error and --max-time: choose one");
    else if (m->noise > 0 && cli_device_is_reference(cli))
        cli_usage(cli, cli_option_place(cli, "noise"),
                  "the reference takes all samples of all pixels: --noise works on a device");
    else if (cli->options.aovs && (m->time_s > 0 || m->allow_resolution))
        cli_usage(cli, cli_option_place(cli, "aov"),
                  "--aov is for pictures of the samples and the size asked for: without --time and "
                  "--allow-resolution");
    else if (cli->options.aovs && r->output_count == 1 && render_uses_stdout(r))
        cli_usage(cli, cli_option_place(cli, "aov"),
                  "--aov writes files beside the picture: name one with -o");
    else
        return true;
    return false;
}

// Steps between black and white in the most coarsely rounded output; 0: none is rounded.
static double coarsest_levels(const struct rendering *r) {
    double levels = 0;
    for (uint32_t i = 0; i < r->output_count; i++) {
        const enum image_format format = r->outputs[i].format;
        const double own = image_format_info(format)->is_linear
                               ? 0
                               : ldexp(1, (int)render_coding(&r->cli->options, format).bits) - 1;
        levels = own > 0 && (own < levels || !(levels > 0)) ? own : levels;
    }
    return levels;
}

static int choose_settings(struct rendering *r, struct asset_store *store) {
    if (!GLINT_DEVICE)
        return cli_left_out(r->cli, "'--max-error' and '--max-time'");
    return cli_choose_settings(r->cli, coarsest_levels(r), store, &r->job.gpu);
}

static size_t encode_all(void *context) {
    struct rendering *r = context;
    struct strbuf file;
    strbuf_init(&file);
    for (uint32_t i = 0; i < r->output_count; i++)
        render_encode(r, r->outputs[i].format, &file);
    const size_t bytes = file.len;
    strbuf_finish(&file);
    return bytes;
}

// The job's wishes on the command line.
static struct job_wish wish_of(struct rendering *r) {
    const struct cli_options *o = &r->cli->options;
    const bool by_reference = cli_device_is_reference(r->cli);
    return (struct job_wish){.by_reference = by_reference,
                             .as_file = o->as_file,
                             .no_cache = o->no_cache,
                             .frames = o->repeat,
                             .counts = o->count_rays,
                             .audits = (o->audit || o->has_max_off) && !by_reference,
                             .max_off = o->has_max_off ? o->max_off : -1,
                             .aovs = o->aovs,
                             .in_picture = render_exr_output(r),
                             .band_rows = o->part.band_rows,
                             .time = {.begun = r->cli->begun,
                                      .seconds = o->measure.time_s,
                                      .files = r->output_count,
                                      .encode = encode_all,
                                      .context = r},
                             .timeline = o->stats ? ARENA_NEW(&r->cli->arena, struct timeline) : NULL};
}

// From reading the scene to the pictures.
static int render_whole(struct rendering *r) {
    struct cli *cli = r->cli;
    struct session session = {0};
    interrupt_catch();
    struct asset_store *store = asset_store_create();
    r->job.session = &session;
    r->job.arena = &cli->arena;
    r->job.wish = wish_of(r);
    int status = cli_has_study(cli) ? choose_settings(r, store) : CLI_OK;
    if (status == CLI_OK)
        status = run_job(r, store);
    job_close(&r->job);
    cli_drop_opening(cli, r->opening);
    cli_close_device(cli, r->job.gpu);
    session_finish(&session);
    asset_store_destroy(store);
    return status;
}

// The later one of those that ask for an audit.
static int audit_place(const struct cli *cli) {
    const int audit = cli_option_place(cli, "audit"), most = cli_option_place(cli, "max-off");
    return audit > most ? audit : most;
}

int cmd_render(struct cli *cli) {
    struct rendering r = {.cli = cli};
    if (batch_is_wanted(cli))
#ifdef __EMSCRIPTEN__
        return cli_left_out(cli, "films, and renders one picture");
#else
        return cmd_batch(cli);
#endif
    if (cli->operand_count == 0)
        return cli_usage(cli, 1, "'glint render' needs SCENE");
    const int outputs = render_take_outputs(&r);
    if (outputs != CLI_OK)
        return outputs;
    if (cli->options.as_file && !cli_device_is_reference(cli))
        return cli_usage(cli, cli_option_place(cli, "as-file"),
                         "'--as-file' works only with '--device reference'");
    if (has_useless_option(cli))
        return CLI_USAGE;
    if ((cli->options.audit || cli->options.has_max_off) && cli_device_is_reference(cli))
        return cli_usage(cli, audit_place(cli),
                         "an audit compares a device's picture with the reference: choose a device");
    if (cli->options.measure.allow_resolution && !cli_has_study(cli))
        return cli_usage(cli, cli_option_place(cli, "allow-resolution"),
                         "'--allow-resolution' is for settings that --max-error or --max-time chooses");
    if (cli->options.measure.time_s > 0 && (cli_device_is_reference(cli) || cli->options.repeat))
        return cli_usage(
            cli, cli_option_place(cli, "time"),
            "'--time' works for one frame on a device: without --repeat and '--device reference'");
    if (!noise_fits(&r) || render_judge_part(&r) != CLI_OK || render_judge_bands(&r) != CLI_OK ||
        render_judge_done(&r) != CLI_OK)
        return CLI_USAGE;
    if (cli->options.watch)
        return cmd_watch(cli);
    return render_whole(&r);
}
