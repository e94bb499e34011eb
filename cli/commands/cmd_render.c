// glint render SCENE: load, flatten, trace, write.
#include "cli/commands/commands.h"
#include "cli/commands/render_job.h"
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
    struct render_job *job = context;
    job->opening = cli_begin_opening(job->cli, job->timeline);
}

static void part_sinks(struct render_job *job) {
    job->loaded = job->session.sink;
    job->is_apart = true;
    diag_sink_init(&job->session.sink);
    diag_sink_keep(&job->session.sink, job->loaded.kept_max);
}

static int judge_load(struct render_job *job) {
    const double start = clock_seconds();
    const bool waits = job->session.unsettled;
    session_settle(&job->session);
    if (waits)
        timeline_add(job->timeline, "wait", STR(""), start);
    if (job->session.state != SESSION_LOADED || job->session.sink.errors)
        return cli_report(job->cli, &job->session, !job->cli->options.quiet);
    if (interrupt_signal())
        return render_interrupted(job);
    int status = CLI_OK;
    for (uint32_t i = 0; i < job->output_count && status == CLI_OK; i++) {
        status = cli_judge_made(job->cli, render_typed(&job->outputs[i]), job->outputs[i].path);
        if (status == CLI_OK)
            status = cli_try_output(job->cli, job->outputs[i].path);
    }
    return status;
}

// Waits for the pixels. What the load has to say comes first, and alone if there are errors; then what was
// found meanwhile. An exit code, the same each time.
static int settle(struct render_job *job) {
    if (!job->is_apart)
        return job->settled;
    struct diag_sink meanwhile = job->session.sink;
    job->session.sink = job->loaded;
    job->is_apart = false;
    job->settled = judge_load(job);
    if (job->settled == CLI_OK)
        diag_merge(&job->session.sink, &meanwhile);
    diag_sink_finish(&meanwhile);
    return job->settled;
}

static bool is_ready(void *context) {
    return settle(context) == CLI_OK;
}

// ---- frames

static int take_frames(struct render_job *job, uint32_t cameras) {
    int32_t frames = job->cli->options.repeat ? job->cli->options.repeat : 1;
    double *times = ARENA_ARRAY(&job->cli->arena, double, (size_t)frames);
    double *on_device = ARENA_ARRAY(&job->cli->arena, double, (size_t)frames);
    struct render_progress callback = progress_callback(&job->progress);
    for (int32_t i = 0; i < frames; i++) {
        job->progress.base = (double)i / frames;
        job->progress.share = 1.0 / frames;
        double start = clock_seconds();
        uint32_t errors = job->session.sink.errors;
        enum shot_status status = render_take_frame(job, cameras, &callback);
        times[i] = clock_seconds() - start;
        on_device[i] = job->stats.last.device_seconds;
        timeline_add(job->timeline, "frame", STR(""), start);
        if (status != SHOT_OK)
            return render_failed(job, status);
        if (i == 0)
            job->stats.first_frame_seconds = times[i];
        if (job->session.sink.errors > errors)
            frames = i + 1; // a faulty picture: more frames would show the same
    }
    quantile_sort(times, (size_t)frames);
    quantile_sort(on_device, (size_t)frames);
    job->stats.frames = frames;
    job->stats.least_frame_seconds = times[0];
    job->stats.most_frame_seconds = times[frames - 1];
    job->stats.median_frame_seconds = quantile(times, (size_t)frames, 0.5);
    job->stats.median_device_seconds = quantile(on_device, (size_t)frames, 0.5);
    return CLI_OK;
}

static int report_stats(struct render_job *job) {
    struct stats *s = &job->stats;
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    s->peak_memory_bytes = usage.ru_maxrss * 1024;
    s->timeline = job->timeline;
    s->has_rays = job->cli->options.count_rays;
    s->begun = job->cli->begun;
    s->read_seconds = job->session.read_seconds;
    s->assets_seconds = job->session.assets_seconds;
    s->flatten_seconds = job->shot.flatten_seconds;
    s->build_seconds = job->shot.flat.build_seconds;
    s->upload_seconds = job->shot.upload_seconds;
    s->scene_bytes = renderer_scene_bytes(job->shot.renderer);
    s->band_bytes = renderer_band_bytes(job->shot.renderer);
    s->triangles = job->shot.flat.triangle_count;
    s->dropped = job->shot.flat.dropped_triangles;
    s->spheres = job->shot.flat.sphere_count;
    s->triangle_depth = job->shot.flat.triangle_depth;
    s->features = job->shot.settings.features;
    s->is_double = job->shot.flat.is_double;
    s->camera = job->shot.view.camera.name;
    s->width = job->shot.settings.width;
    s->height = job->shot.settings.height;
    s->samples = s->last.samples;
    snprintf(s->device, sizeof s->device, "%s", gpu_info(job->gpu)->name);
    struct strbuf text;
    strbuf_init(&text);
    (job->cli->options.stats == CLI_STATS_JSON ? stats_json : stats_text)(s, &text);
    const int status = render_tell_stats(job, strbuf_view(&text));
    strbuf_finish(&text);
    return status;
}

// All that is known of a picture is in memory at once.
static int render_at_once(struct render_job *job, uint32_t camera, uint32_t cameras) {
    int status = take_frames(job, cameras);
    if (status == CLI_OK)
        status = render_note_estimate(job);
    if (status == CLI_OK)
        status = render_audit(job);
    if (status == CLI_OK)
        status = render_make_aovs(job, NULL);
    progress_end(&job->progress);
    if (status == CLI_OK)
        status = render_scale_up(job);
    if (status == CLI_OK)
        status = render_write_pictures(job, camera);
    if (status == CLI_OK)
        status = render_write_aovs(job, camera);
    render_drop_aovs(job);
    return status;
}

// After the picture was written: it is not waited for. Bands and parts count while they are made.
static int count_rays(struct render_job *job) {
    const double start = clock_seconds();
    if (!job->cli->options.count_rays || job->shot.wish.counts)
        return CLI_OK;
    const enum shot_status status = shot_count(&job->shot, NULL, &job->stats.last);
    job->stats.count_seconds = clock_seconds() - start;
    timeline_add(job->timeline, "count", STR(""), start);
    return status == SHOT_OK ? CLI_OK : render_failed(job, status);
}

// One camera of those that are left: frames, picture, statistics. The shot is open and uses it.
static int render_camera(struct render_job *job, uint32_t camera, uint32_t cameras) {
    progress_begin(&job->progress, job->cli->options.quiet);
    int status = job->in_bands ? render_in_bands(job, camera) : render_at_once(job, camera, cameras);
    if (status == CLI_OK)
        status = count_rays(job);
    if (status == CLI_OK && job->cli->options.stats)
        status = report_stats(job);
    if (status == CLI_OK)
        status = render_tell_audit(job);
    if (status == CLI_OK)
        status = render_tell_time(job);
    if (status != CLI_OK || job->cli->options.quiet)
        return status;
    if (job->cli->options.repeat)
        fprintf(stderr,
                "glint: median frame %.2f ms of %d, from %.2f to %.2f ms, %.3f ms by the clock of %s\n",
                1e3 * job->stats.median_frame_seconds, job->stats.frames,
                1e3 * job->stats.least_frame_seconds, 1e3 * job->stats.most_frame_seconds,
                1e3 * job->stats.median_device_seconds, gpu_info(job->gpu)->name);
    render_tell_written(job, camera);
    return status;
}

// A device that fails is reported after what the scene has wrong.
static int open_device(struct render_job *job) {
    struct cli_opening *opening = job->opening;
    if (job->gpu)
        return CLI_OK;
    if (!cli_opening_is_good(opening) && settle(job) != CLI_OK)
        return job->settled;
    return cli_end_opening(job->cli, &job->opening, &job->gpu, &job->stats.device_seconds);
}

static int render_by_device(struct render_job *job, uint32_t first, uint32_t end) {
    int status = open_device(job);
    if (status != CLI_OK)
        return status;
    const struct shot_wish wish = {.region = render_first_region(job),
                                   .counts = job->cli->options.count_rays && (job->in_bands || job->is_part),
                                   .audits = render_wants_audit(&job->cli->options),
                                   .ready = job->is_apart ? is_ready : NULL,
                                   .ready_context = job};
    enum shot_status opened = shot_open_for(&job->shot, &job->session, job->gpu, first, wish);
    if (opened != SHOT_OK)
        return settle(job) != CLI_OK ? job->settled : render_failed(job, opened);
    for (uint32_t i = first; i < end && status == CLI_OK; i++) {
        if (job->done && job->done[i])
            continue;
        if (i != first && (opened = shot_turn(&job->shot, i)) != SHOT_OK)
            return render_failed(job, opened);
        if (!job->in_bands && !render_aim_at_part(job))
            return render_failed(job, SHOT_DEVICE);
        status = render_camera(job, i, end - i);
    }
    int reported = cli_report(job->cli, &job->session, !job->cli->options.quiet);
    return status != CLI_OK ? status : reported;
}

// --skip-done: what is there is not rendered again.
static int leave_done(struct render_job *job, uint32_t *first, uint32_t end) {
    int status = job->cli->options.batch.skip_done ? settle(job) : CLI_OK;
    if (status != CLI_OK || !job->cli->options.batch.skip_done)
        return status;
    if (!cli_device_is_reference(job->cli))
        status = open_device(job);
    if (status != CLI_OK)
        return status;
    render_find_done(job, first, end);
    return *first == end ? cli_report(job->cli, &job->session, !job->cli->options.quiet) : CLI_OK;
}

// All names that are made of the outputs', through these cameras.
static int judge_made(struct render_job *job, uint32_t first, uint32_t end) {
    int status = CLI_OK;
    for (uint32_t k = first; k < end && status == CLI_OK && !job->kept; k++) {
        for (uint32_t i = 0; i < job->output_count && status == CLI_OK; i++)
            status = cli_judge_made(job->cli, render_typed(&job->outputs[i]),
                                    render_output_of(job, &job->outputs[i], k));
        if (status == CLI_OK)
            status = render_judge_partial(job, k);
        if (status == CLI_OK)
            status = render_judge_aov_names(job, k);
    }
    return status;
}

static int render_cameras(struct render_job *job) {
    const struct ir_cameras *cameras = &job->session.scene->cameras;
    const bool by_reference = cli_device_is_reference(job->cli);
    bool all = str_equal(job->cli->options.camera, STR("all"));
    job->all_cameras = all && cameras->count > 0;
    uint32_t first = all ? 0 : session_camera(&job->session, job->cli->options.camera);
    if (first != IR_NO_INDEX && (render_plan_part(job) != CLI_OK || render_plan_bands(job) != CLI_OK))
        return CLI_USAGE;
    const bool good =
        first != IR_NO_INDEX &&
        (job->in_bands || image_init(&job->image, job->part.region.width, job->part.region.height));
    if ((!good || by_reference) && settle(job) != CLI_OK)
        return job->settled;
    if (first == IR_NO_INDEX)
        return cli_report(job->cli, &job->session, !job->cli->options.quiet);
    if (!good) {
        cli_error(job->cli, DIAG_OUT_OF_MEMORY, job->outputs[0].path, NULL,
                  "not enough memory for the picture");
        return CLI_SCENE;
    }
    int fits = render_judge_size(job);
    if (fits == CLI_OK)
        fits = render_judge_aovs(job);
    if (fits != CLI_OK)
        return fits;
    uint32_t end = job->all_cameras ? cameras->count : first + 1;
    fits = judge_made(job, first, end);
    if (fits == CLI_OK)
        fits = leave_done(job, &first, end);
    if (fits != CLI_OK || first == end)
        return fits;
    return by_reference ? render_by_reference(job, first, end) : render_by_device(job, first, end);
}

static int run_job(struct render_job *job, struct asset_store *store) {
    struct session_options options = cli_session_options(job->cli, job->cli->operands[0]);
    const bool device = !cli_device_is_reference(job->cli);
    options.lint = LINT_CHEAP;
    options.error = device ? options.error : -1; // the reference takes all samples
    options.whole_picture = !device || job->kept;
    options.pixels_later = device;
    options.on_text = device && !job->gpu ? begin_device : NULL;
    options.on_text_context = job;
    options.timeline = job->timeline;
    session_load(&job->session, &options, store);
    if (job->session.sink.errors == 0 && job->session.image && options.error > 0 &&
        !(job->session.image->error > 0)) {
        cli_has_no_effect(job->cli, "noise", "no pixel ends before it has image.min_samples");
        return CLI_USAGE;
    }
    part_sinks(job);
    const bool goes_on = job->session.unsettled || settle(job) == CLI_OK;
    return goes_on ? render_cameras(job) : job->settled;
}

static bool has_useless_option(struct cli *cli) {
    bool by_reference = cli_device_is_reference(cli);
    return (by_reference &&
            cli_has_no_effect(cli, "repeat", "it times frames of a device, not of the reference")) ||
           (!by_reference && !cli_has_study(cli) &&
            cli_has_no_effect(cli, "no-cache", "the cache is that of '--device reference'"));
}

static bool noise_fits(struct render_job *job) {
    struct cli *cli = job->cli;
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
    else if (cli->options.aovs && job->output_count == 1 && render_uses_stdout(job))
        cli_usage(cli, cli_option_place(cli, "aov"),
                  "--aov writes files beside the picture: name one with -o");
    else
        return true;
    return false;
}

// Steps between black and white of the output that is rounded most; 0: none is.
static double coarsest_levels(const struct render_job *job) {
    double levels = 0;
    for (uint32_t i = 0; i < job->output_count; i++) {
        const enum image_format format = job->outputs[i].format;
        const double own = image_format_info(format)->is_linear
                               ? 0
                               : ldexp(1, (int)render_coding(&job->cli->options, format).bits) - 1;
        levels = own > 0 && (own < levels || !(levels > 0)) ? own : levels;
    }
    return levels;
}

static int choose_settings(struct render_job *job, struct asset_store *store) {
    if (!GLINT_DEVICE)
        return cli_left_out(job->cli, "'--max-error' and '--max-time'");
    return cli_choose_settings(job->cli, coarsest_levels(job), store, &job->gpu);
}

int render_whole(struct render_job *job) {
    struct cli *cli = job->cli;
    interrupt_catch();
    strbuf_init(&job->note);
    strbuf_init(&job->audit_note);
    struct asset_store *store = asset_store_create();
    if (cli->options.stats)
        job->timeline = ARENA_NEW(&cli->arena, struct timeline);
    int status = cli_has_study(cli) ? choose_settings(job, store) : CLI_OK;
    if (status == CLI_OK)
        status = run_job(job, store);
    shot_close(&job->shot);
    cli_drop_opening(cli, job->opening);
    image_finish(&job->image);
    part_finish(&job->part);
    strbuf_finish(&job->note);
    strbuf_finish(&job->audit_note);
    cli_close_device(cli, job->gpu);
    session_finish(&job->session);
    asset_store_destroy(store);
    return status;
}

// The later one of those that ask for an audit.
static int audit_place(const struct cli *cli) {
    const int audit = cli_option_place(cli, "audit"), most = cli_option_place(cli, "max-off");
    return audit > most ? audit : most;
}

int cmd_render(struct cli *cli) {
    struct render_job job = {.cli = cli};
    if (batch_is_wanted(cli))
#ifdef __EMSCRIPTEN__
        return cli_left_out(cli, "films, and renders one picture");
#else
        return cmd_batch(cli);
#endif
    if (cli->operand_count == 0)
        return cli_usage(cli, 1, "'glint render' needs SCENE");
    const int outputs = render_take_outputs(&job);
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
    if (!noise_fits(&job) || render_judge_part(&job) != CLI_OK || render_judge_bands(&job) != CLI_OK ||
        render_judge_done(&job) != CLI_OK)
        return CLI_USAGE;
    if (cli->options.watch)
        return cmd_watch(cli);
    return render_whole(&job);
}
