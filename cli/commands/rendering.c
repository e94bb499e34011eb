#include "cli/commands/rendering.h"
#include "diag/codes/limit.h"

#include "cli/device.h"

#include <stdio.h>

int render_not_drawn(struct cli *cli, const struct job *job, enum shot_status status, bool notes) {
    if (status == SHOT_SCENE)
        return cli_report(cli, job->session, notes);
    return status == SHOT_CANCELLED ? cli_interrupted(cli) : cli_device_failed(cli, job->gpu);
}

int render_failed(struct rendering *r, enum shot_status status) {
    progress_end(&r->progress);
    return render_not_drawn(r->cli, &r->job, status, !r->cli->options.quiet);
}

int render_scale_up(struct rendering *r) {
    const struct cli_measure *m = &r->cli->options.measure;
    const uint32_t width = r->job.image.width, height = r->job.image.height;
    if (!CLI_HAS_DEVICES || !m->scale_width) // a search by a device chose it
        return CLI_OK;
    if (!job_scale_up(&r->job, m->scale_width, m->scale_height)) {
        cli_error(r->cli, DIAG_OUT_OF_MEMORY, r->outputs[0].path, NULL, "not enough memory for the picture");
        return CLI_SCENE;
    }
    if (!r->cli->options.quiet)
        fprintf(stderr, "glint: rendered at %u x %u and scaled up, as --allow-resolution allows\n", width,
                height);
    return CLI_OK;
}

// ---- what is said after a picture was written

void render_tell_unused_error(const struct rendering *r) {
    const struct session *session = r->job.session;
    const struct ir_image *image = &session->scene->image;
    if (!(session->unused_error > 0) || image->samples <= image->min_samples || r->cli->options.quiet)
        return;
    if (job_by_reference(&r->job))
        fprintf(stderr, "glint: image.error ends no pixel: the reference takes all %d samples of each\n",
                session->image->samples);
    else if (session->options.error < 0)
        fprintf(stderr, "glint: image.error ends no pixel: %s says how many samples all have\n",
                r->cli->options.measure.time_s > 0 ? "--time" : "the search");
    else
        fprintf(stderr, "glint: image.error ends no pixel before it has %d samples, and each takes %d\n",
                image->min_samples, session->image->samples);
}

int render_tell_audit(const struct cli *cli, const struct job *job) {
    const struct audit *audit = &job->stats.audit;
    if (!job->stats.has_audit)
        return CLI_OK;
    const bool broken = job->wish.max_off >= 0 && audit->bound > job->wish.max_off;
    if (broken || !cli->options.quiet) {
        fprintf(stderr, "glint: %.*s", STR_ARG(strbuf_view(&job->audit_note)));
        if (audit->off)
            fprintf(stderr, ", the first at %u,%u", audit->x, audit->y);
        if (broken)
            fprintf(stderr, "; more than %g %%", 100 * job->wish.max_off);
        fputc('\n', stderr);
    }
    return broken ? CLI_SCENE : CLI_OK;
}

static void tell_seconds(double seconds, double wanted, bool is_least) {
    if (is_least)
        fprintf(stderr,
                "glint: one sample, the least that a picture has, took longer than --time %g: %.2f s\n",
                wanted, seconds);
    else
        fprintf(stderr, "glint: the picture was written %.2f s after the start, later than --time %g\n",
                seconds, wanted);
}

static int tell_time(const struct rendering *r) {
    const struct cli_options *options = &r->cli->options;
    const double time = options->measure.time_s, seconds = r->written - r->cli->begun;
    if (!(time > 0))
        return CLI_OK;
    const uint32_t made = r->job.stats.last.samples, wanted = r->job.shot->settings.samples;
    const bool broken = options->measure.max_error && made < wanted;
    if (broken)
        fprintf(stderr, "glint: --time %g allowed %u of the %u samples that --max-error %s needs\n", time,
                made, wanted, options->measure.max_error);
    else if (made < wanted && !options->quiet)
        fprintf(stderr, "glint: --time %g allowed %u of %u samples\n", time, made, wanted);
    if (seconds > time && !options->quiet)
        tell_seconds(seconds, time, made == 1);
    return broken ? CLI_SCENE : CLI_OK;
}

static void tell_repeats(const struct rendering *r) {
    const struct stats *stats = &r->job.stats;
    fprintf(stderr, "glint: median frame %.2f ms of %d, from %.2f to %.2f ms, %.3f ms by the clock of %s\n",
            1e3 * stats->median_frame_seconds, stats->frames, 1e3 * stats->least_frame_seconds,
            1e3 * stats->most_frame_seconds, 1e3 * stats->median_device_seconds, gpu_info(r->job.gpu)->name);
}

static void tell_left_out(const struct rendering *r) {
    const struct reference_statistics *statistics = &r->job.reference_statistics;
    render_tell_unused_error(r);
    fprintf(stderr,
            "glint: the reference left out at most %.3g of a pixel's weight, which could add %.3g%s\n",
            statistics->left_weight_most, statistics->bound,
            r->job.reference.source.found ? " (picture from its cache)" : "");
}

int render_tell_end(const struct rendering *r) {
    const bool quiet = r->cli->options.quiet;
    if (job_by_reference(&r->job)) {
        if (!quiet)
            tell_left_out(r);
        return CLI_OK;
    }
    int status = render_tell_audit(r->cli, &r->job);
    if (status == CLI_OK)
        status = tell_time(r);
    if (status == CLI_OK && !quiet && r->cli->options.repeat)
        tell_repeats(r);
    return status;
}
