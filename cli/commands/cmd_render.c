// glint render SCENE: load, flatten, trace, write.
#include "cli/commands/commands.h"
#include "cli/commands/rendering.h"
#include "cli/commands/study.h"
#include "cli/device.h"
#include "cli/made.h"
#include "core/clock.h"
#include "core/quantile.h"
#include "core/timeline.h"
#include "files/output.h"
#include "grammar/ir.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

// ---- what goes on while the background's pixels are decoded

static void begin_device(void *context) {
    struct rendering *r = context;
    r->opening = cli_begin_opening(r->cli, r->timeline);
}

static void part_sinks(struct rendering *r) {
    r->loaded = r->session.sink;
    r->is_apart = true;
    diag_sink_init(&r->session.sink);
    diag_sink_keep(&r->session.sink, r->loaded.kept_max);
}

static int judge_load(struct rendering *r) {
    const double start = clock_seconds();
    const bool waits = r->session.unsettled;
    session_settle(&r->session);
    if (waits)
        timeline_add(r->timeline, "wait", STR(""), start);
    if (r->session.state != SESSION_LOADED || r->session.sink.errors)
        return cli_report(r->cli, &r->session, !r->cli->options.quiet);
    if (interrupt_signal())
        return render_interrupted(r);
    int status = CLI_OK;
    for (uint32_t i = 0; i < r->output_count && status == CLI_OK; i++) {
        status = cli_judge_made(r->cli, render_typed(&r->outputs[i]), r->outputs[i].path);
        if (status == CLI_OK)
            status = cli_try_output(r->cli, r->outputs[i].path);
    }
    return status;
}

// Waits for the pixels. What the load has to say comes first, and alone if there are errors; then what was
// found meanwhile. An exit code, the same each time.
static int settle(struct rendering *r) {
    if (!r->is_apart)
        return r->settled;
    struct diag_sink meanwhile = r->session.sink;
    r->session.sink = r->loaded;
    r->is_apart = false;
    r->settled = judge_load(r);
    if (r->settled == CLI_OK)
        diag_merge(&r->session.sink, &meanwhile);
    diag_sink_finish(&meanwhile);
    return r->settled;
}

static bool is_ready(void *context) {
    return settle(context) == CLI_OK;
}

// ---- frames

static int take_frames(struct rendering *r, uint32_t cameras) {
    int32_t frames = r->cli->options.repeat ? r->cli->options.repeat : 1;
    double *times = ARENA_ARRAY(&r->cli->arena, double, (size_t)frames);
    double *on_device = ARENA_ARRAY(&r->cli->arena, double, (size_t)frames);
    struct render_progress callback = progress_callback(&r->progress);
    for (int32_t i = 0; i < frames; i++) {
        r->progress.base = (double)i / frames;
        r->progress.share = 1.0 / frames;
        double start = clock_seconds();
        uint32_t errors = r->session.sink.errors;
        enum shot_status status = render_take_frame(r, cameras, &callback);
        times[i] = clock_seconds() - start;
        on_device[i] = r->stats.last.device_seconds;
        timeline_add(r->timeline, "frame", STR(""), start);
        if (status != SHOT_OK)
            return render_failed(r, status);
        if (i == 0)
            r->stats.first_frame_seconds = times[i];
        if (r->session.sink.errors > errors)
            frames = i + 1; // a faulty picture: more frames would show the same
    }
    quantile_sort(times, (size_t)frames);
    quantile_sort(on_device, (size_t)frames);
    r->stats.frames = frames;
    r->stats.least_frame_seconds = times[0];
    r->stats.most_frame_seconds = times[frames - 1];
    r->stats.median_frame_seconds = quantile(times, (size_t)frames, 0.5);
    r->stats.median_device_seconds = quantile(on_device, (size_t)frames, 0.5);
    return CLI_OK;
}

static int report_stats(struct rendering *r) {
    struct stats *s = &r->stats;
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    s->peak_memory_bytes = usage.ru_maxrss * 1024;
    s->timeline = r->timeline;
    s->has_rays = r->cli->options.count_rays;
    s->begun = r->cli->begun;
    s->read_seconds = r->session.read_seconds;
    s->assets_seconds = r->session.assets_seconds;
    s->flatten_seconds = r->shot.flatten_seconds;
    s->build_seconds = r->shot.flat.build_seconds;
    s->upload_seconds = r->shot.upload_seconds;
    s->scene_bytes = renderer_scene_bytes(r->shot.renderer);
    s->band_bytes = renderer_band_bytes(r->shot.renderer);
    s->triangles = r->shot.flat.triangle_count;
    s->dropped = r->shot.flat.dropped_triangles;
    s->spheres = r->shot.flat.sphere_count;
    s->triangle_depth = r->shot.flat.triangle_depth;
    s->features = r->shot.settings.features;
    s->is_double = r->shot.flat.is_double;
    s->camera = r->shot.view.camera.name;
    s->width = r->shot.settings.width;
    s->height = r->shot.settings.height;
    s->samples = s->last.samples;
    snprintf(s->device, sizeof s->device, "%s", gpu_info(r->gpu)->name);
    struct strbuf text;
    strbuf_init(&text);
    (r->cli->options.stats == CLI_STATS_JSON ? stats_json : stats_text)(s, &text);
    const int status = render_tell_stats(r, strbuf_view(&text));
    strbuf_finish(&text);
    return status;
}

// All that is known of a picture is in memory at once.
static int render_at_once(struct rendering *r, uint32_t camera, uint32_t cameras) {
    int status = take_frames(r, cameras);
    if (status == CLI_OK)
        status = render_note_estimate(r);
    if (status == CLI_OK)
        status = render_audit(r);
    if (status == CLI_OK)
        status = render_make_aovs(r, NULL);
    progress_end(&r->progress);
    if (status == CLI_OK)
        status = render_scale_up(r);
    if (status == CLI_OK)
        status = render_write_pictures(r, camera);
    if (status == CLI_OK)
        status = render_write_aovs(r, camera);
    render_drop_aovs(r);
    return status;
}

// After the picture was written: it is not waited for. Bands and parts count while they are made.
static int count_rays(struct rendering *r) {
    const double start = clock_seconds();
    if (!r->cli->options.count_rays || r->shot.wish.counts)
        return CLI_OK;
    const enum shot_status status = shot_count(&r->shot, NULL, &r->stats.last);
    r->stats.count_seconds = clock_seconds() - start;
    timeline_add(r->timeline, "count", STR(""), start);
    return status == SHOT_OK ? CLI_OK : render_failed(r, status);
}

// One camera of those that are left: frames, picture, statistics. The shot is open and uses it.
static int render_camera(struct rendering *r, uint32_t camera, uint32_t cameras) {
    progress_begin(&r->progress, r->cli->options.quiet);
    int status = r->in_bands ? render_in_bands(r, camera) : render_at_once(r, camera, cameras);
    if (status == CLI_OK)
        status = count_rays(r);
    if (status == CLI_OK && r->cli->options.stats)
        status = report_stats(r);
    if (status == CLI_OK)
        status = render_tell_audit(r);
    if (status == CLI_OK)
        status = render_tell_time(r);
    if (status != CLI_OK || r->cli->options.quiet)
        return status;
    if (r->cli->options.repeat)
        fprintf(
            stderr, "glint: median frame %.2f ms of %d, from %.2f to %.2f ms, %.3f ms by the clock of %s\n",
            1e3 * r->stats.median_frame_seconds, r->stats.frames, 1e3 * r->stats.least_frame_seconds,
            1e3 * r->stats.most_frame_seconds, 1e3 * r->stats.median_device_seconds, gpu_info(r->gpu)->name);
    render_tell_written(r, camera);
    return status;
}

// A device that fails is reported after what the scene has wrong.
static int open_device(struct rendering *r) {
    struct cli_opening *opening = r->opening;
    if (r->gpu)
        return CLI_OK;
    if (!cli_opening_is_good(opening) && settle(r) != CLI_OK)
        return r->settled;
    return cli_end_opening(r->cli, &r->opening, &r->gpu, &r->stats.device_seconds);
}

static int render_by_device(struct rendering *r, uint32_t first, uint32_t end) {
    int status = open_device(r);
    if (status != CLI_OK)
        return status;
    const struct shot_wish wish = {.region = render_first_region(r),
                                   .counts = r->cli->options.count_rays && (r->in_bands || r->is_part),
                                   .audits = render_wants_audit(&r->cli->options),
                                   .ready = r->is_apart ? is_ready : NULL,
                                   .ready_context = r};
    enum shot_status opened = shot_open_for(&r->shot, &r->session, r->gpu, first, wish);
    if (opened != SHOT_OK)
        return settle(r) != CLI_OK ? r->settled : render_failed(r, opened);
    for (uint32_t i = first; i < end && status == CLI_OK; i++) {
        if (r->done && r->done[i])
            continue;
        if (i != first && (opened = shot_turn(&r->shot, i)) != SHOT_OK)
            return render_failed(r, opened);
        if (!r->in_bands && !render_aim_at_part(r))
            return render_failed(r, SHOT_DEVICE);
        status = render_camera(r, i, end - i);
    }
    int reported = cli_report(r->cli, &r->session, !r->cli->options.quiet);
    return status != CLI_OK ? status : reported;
}

// --skip-done: what is there is not rendered again.
static int leave_done(struct rendering *r, uint32_t *first, uint32_t end) {
    int status = r->cli->options.batch.skip_done ? settle(r) : CLI_OK;
    if (status != CLI_OK || !r->cli->options.batch.skip_done)
        return status;
    if (!cli_device_is_reference(r->cli))
        status = open_device(r);
    if (status != CLI_OK)
        return status;
    render_find_done(r, first, end);
    return *first == end ? cli_report(r->cli, &r->session, !r->cli->options.quiet) : CLI_OK;
}

// All names that are made of the outputs', through these cameras.
static int judge_made(struct rendering *r, uint32_t first, uint32_t end) {
    int status = CLI_OK;
    for (uint32_t k = first; k < end && status == CLI_OK && !r->kept; k++) {
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
    const struct ir_cameras *cameras = &r->session.scene->cameras;
    const bool by_reference = cli_device_is_reference(r->cli);
    bool all = str_equal(r->cli->options.camera, STR("all"));
    r->all_cameras = all && cameras->count > 0;
    uint32_t first = all ? 0 : session_camera(&r->session, r->cli->options.camera);
    if (first != IR_NO_INDEX && (render_plan_part(r) != CLI_OK || render_plan_bands(r) != CLI_OK))
        return CLI_USAGE;
    const bool good = first != IR_NO_INDEX &&
                      (r->in_bands || image_init(&r->image, r->part.region.width, r->part.region.height));
    if ((!good || by_reference) && settle(r) != CLI_OK)
        return r->settled;
    if (first == IR_NO_INDEX)
        return cli_report(r->cli, &r->session, !r->cli->options.quiet);
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
    return by_reference ? render_by_reference(r, first, end) : render_by_device(r, first, end);
}

static int run_job(struct rendering *r, struct asset_store *store) {
    struct session_options options = cli_session_options(r->cli, r->cli->operands[0]);
    const bool device = !cli_device_is_reference(r->cli);
    options.lint = LINT_CHEAP;
    options.error = device ? options.error : -1; // the reference takes all samples
    options.whole_picture = !device || r->kept;
    options.pixels_later = device;
    options.on_text = device && !r->gpu ? begin_device : NULL;
    options.on_text_context = r;
    options.timeline = r->timeline;
    session_load(&r->session, &options, store);
    if (r->session.sink.errors == 0 && r->session.image && options.error > 0 &&
        !(r->session.image->error > 0)) {
        cli_has_no_effect(r->cli, "noise", "no pixel ends before it has image.min_samples");
        return CLI_USAGE;
    }
    part_sinks(r);
    const bool goes_on = r->session.unsettled || settle(r) == CLI_OK;
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

// Steps between black and white of the output that is rounded most; 0: none is.
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
    return cli_choose_settings(r->cli, coarsest_levels(r), store, &r->gpu);
}

int render_whole(struct rendering *r) {
    struct cli *cli = r->cli;
    interrupt_catch();
    strbuf_init(&r->note);
    strbuf_init(&r->audit_note);
    struct asset_store *store = asset_store_create();
    if (cli->options.stats)
        r->timeline = ARENA_NEW(&cli->arena, struct timeline);
    int status = cli_has_study(cli) ? choose_settings(r, store) : CLI_OK;
    if (status == CLI_OK)
        status = run_job(r, store);
    shot_close(&r->shot);
    cli_drop_opening(cli, r->opening);
    image_finish(&r->image);
    part_finish(&r->part);
    strbuf_finish(&r->note);
    strbuf_finish(&r->audit_note);
    cli_close_device(cli, r->gpu);
    session_finish(&r->session);
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
