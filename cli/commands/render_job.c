#include "cli/commands/render_job.h"

#include "cli/device.h"
#include "core/clock.h"
#include "core/timeline.h"
#include "grammar/ir.h"
#include "picture/write/scale.h"

#include <math.h>
#include <stdio.h>

int render_interrupted(struct render_job *job) {
    progress_end(&job->progress);
    return cli_interrupted(job->cli);
}

int render_failed(struct render_job *job, enum shot_status status) {
    progress_end(&job->progress);
    if (status == SHOT_CANCELLED)
        return render_interrupted(job);
    if (status == SHOT_SCENE)
        return cli_report(job->cli, &job->session, !job->cli->options.quiet);
    return cli_device_failed(job->cli, job->gpu);
}

int render_scale_up(struct render_job *job) {
    const struct cli_measure *m = &job->cli->options.measure;
    struct image large;
    if (!m->scale_width)
        return CLI_OK;
    if (!image_init(&large, m->scale_width, m->scale_height)) {
        cli_error(job->cli, DIAG_OUT_OF_MEMORY, job->outputs[0].path, NULL,
                  "not enough memory for the picture");
        return CLI_SCENE;
    }
    scale_picture(job->image.rgb, job->image.width, job->image.height, large.rgb, large.width, large.height);
    if (!job->cli->options.quiet)
        fprintf(stderr, "glint: rendered at %u x %u and scaled up, as --allow-resolution allows\n",
                job->image.width, job->image.height);
    large.note = job->image.note;
    image_finish(&job->image);
    job->image = large;
    return CLI_OK;
}

int render_tell_stats(const struct render_job *job, str text) {
    if (job->cli->options.stats == CLI_STATS_JSON && !render_uses_stdout(job))
        return cli_print(job->cli, text);
    cli_write_error(text);
    return CLI_OK;
}

// ---- a picture states its own error: --audit and --max-off

bool render_wants_audit(const struct cli_options *options) {
    return options->audit || options->has_max_off;
}

static struct audit_wish wish_of(const struct render_job *job) {
    const struct cli_options *options = &job->cli->options;
    // With --time it is not decided: that may take any time.
    const struct render_estimate *estimate = render_estimate_of(job);
    return (struct audit_wish){.reference = job->shot.reference,
                               .samples = estimate ? estimate->samples : NULL,
                               .planned = options->measure.time_s > 0 ? job->shot.settings.samples : 0,
                               .share = options->has_max_off ? options->max_off : AUDIT_SHARE,
                               .decides = options->has_max_off && options->measure.time_s <= 0};
}

int render_audit(struct render_job *job) {
    job->stats.has_audit = render_wants_audit(&job->cli->options);
    if (!job->stats.has_audit)
        return CLI_OK;
    struct audit *audit = &job->stats.audit;
    const struct audit_wish wish = wish_of(job);
    struct render_progress callback = progress_callback(&job->progress);
    const enum shot_status status =
        audit_take(&job->session, &job->shot.view, &job->image, &wish, &callback, audit);
    if (status != SHOT_OK)
        return render_failed(job, status);
    strbuf_clear(&job->audit_note);
    audit_words(audit, &job->audit_note);
    if (job->note.len)
        strbuf_cstr(&job->note, "; ");
    strbuf_str(&job->note, strbuf_view(&job->audit_note));
    job->image.note = job->note.data;
    return CLI_OK;
}

// ---- a picture states its noise: --noise and image.error

int render_note_estimate(struct render_job *job) {
    const struct render_estimate *estimate = render_estimate_of(job);
    const struct ir_image *image = job->session.image;
    strbuf_clear(&job->note);
    job->image.note = NULL;
    job->stats.estimate = estimate;
    job->stats.unused_error = job->session.unused_error;
    render_tell_unused_error(job);
    if (!estimate)
        return CLI_OK;
    const double pixels = (double)job->image.width * job->image.height;
    strbuf_format(&job->note,
                  "standard error %.3g of displayed colours, at most %.3g (95 %% sure), by %.4g samples per "
                  "pixel of at most %d",
                  estimate->mean, estimate->most, (double)job->stats.last.all_samples / pixels,
                  (int)image->samples);
    if (estimate->unknown)
        strbuf_format(&job->note, ", without %u that %s not finite", estimate->unknown,
                      estimate->unknown == 1 ? "is" : "are");
    job->image.note = job->note.data;
    if (!job->cli->options.quiet)
        fprintf(stderr, "glint: %s\n", job->note.data);
    return CLI_OK;
}

void render_tell_unused_error(const struct render_job *job) {
    const struct session *session = &job->session;
    const struct ir_image *image = &session->scene->image;
    if (!(session->unused_error > 0) || image->samples <= image->min_samples || job->cli->options.quiet)
        return;
    if (cli_device_is_reference(job->cli))
        fprintf(stderr, "glint: image.error ends no pixel: the reference takes all %d samples of each\n",
                session->image->samples);
    else if (session->options.error < 0)
        fprintf(stderr, "glint: image.error ends no pixel: %s says how many samples all have\n",
                job->cli->options.measure.time_s > 0 ? "--time" : "the search");
    else
        fprintf(stderr, "glint: image.error ends no pixel before it has %d samples, and each takes %d\n",
                image->min_samples, session->image->samples);
}

int render_tell_audit(const struct render_job *job) {
    const struct cli_options *options = &job->cli->options;
    const struct audit *audit = &job->stats.audit;
    if (!job->stats.has_audit)
        return CLI_OK;
    const bool broken = options->has_max_off && audit->bound > options->max_off;
    if ((options->audit || options->has_max_off) && (broken || !options->quiet)) {
        fprintf(stderr, "glint: %.*s", STR_ARG(strbuf_view(&job->audit_note)));
        if (audit->off)
            fprintf(stderr, ", the first at %u,%u", audit->x, audit->y);
        if (broken)
            fprintf(stderr, "; more than %g %%", 100 * options->max_off);
        fputc('\n', stderr);
    }
    return broken ? CLI_SCENE : CLI_OK;
}

// ---- a frame that ends in time to be written: --time

// What is expected after the frame takes this much longer than it did with its first sample.
static const double RESERVE = 1.5;
// A file is written to the disk at least this fast, and its name changed.
static const double BYTES_A_SECOND = 1e8, RENAME_SECONDS = 0.005;

// Where a first sample's picture needs one look of the audit, the whole one may need the second, of twice as
// many.
static const double LOOKS = 3;
// What is aimed at: a dispatch cannot be ended, and other programs run too.
static const double AIM = 0.98, DISPATCH_SECONDS = 0.05;

static void set_samples(struct render_job *job, uint32_t samples) {
    job->image_made = *job->session.image;
    job->image_made.samples = (int32_t)samples;
    job->session.image = &job->image_made;
}

// With the first sample's picture: what comes after the frame is done once, to know what it takes.
static void measure_rest(struct render_job *job) {
    const double start = clock_seconds();
    struct strbuf file;
    strbuf_init(&file);
    for (uint32_t i = 0; i < job->output_count; i++)
        render_encode(job, job->outputs[i].format, &file);
    job->deadline.after = RESERVE * (clock_seconds() - start) + (double)file.len / BYTES_A_SECOND +
                          RENAME_SECONDS * job->output_count;
    strbuf_finish(&file);
    if (!render_wants_audit(&job->cli->options))
        return;
    const uint32_t samples = (uint32_t)job->session.image->samples;
    struct audit audit;
    const struct audit_wish wish = wish_of(job);
    set_samples(job, 1);
    if (audit_take(&job->session, &job->shot.view, &job->image, &wish, NULL, &audit) == SHOT_OK)
        job->deadline.after_a_sample = RESERVE * audit.seconds * (audit.off || audit.whole ? 1 : LOOKS);
    set_samples(job, samples);
}

static bool goes_on(void *context, uint32_t samples, const float *rgb) {
    struct render_job *job = context;
    (void)rgb; // the job's image
    deadline_end_sample(&job->deadline, clock_seconds());
    if (samples == 1 && deadline_fits(&job->deadline, clock_seconds()))
        measure_rest(job);
    const double now = clock_seconds();
    if (!deadline_fits(&job->deadline, now))
        return false;
    deadline_begin_sample(&job->deadline, now);
    return true;
}

static bool is_over(void *context) {
    const struct render_job *job = context;
    return deadline_is_over(&job->deadline, clock_seconds());
}

// How far a frame is, which its time may end before its samples do.
struct timed_progress {
    const struct render_job *job;
    const struct render_progress *progress;
    double start;
};

static bool report(void *context, double fraction) {
    const struct timed_progress *t = context;
    const double all = t->job->deadline.end - t->start, now = clock_seconds() - t->start;
    return t->progress->report(t->progress->context, fmax(fraction, all > 0 ? fmin(now / all, 1) : 0));
}

enum shot_status render_take_frame(struct render_job *job, uint32_t cameras,
                                   const struct render_progress *progress) {
    const double time = job->cli->options.measure.time_s, now = clock_seconds();
    if (job->is_part)
        return render_take_part(job, progress);
    if (!(time > 0))
        return shot_take(&job->shot, &job->image, progress, &job->stats.last);
    const struct render_limit limit = {.goes_on = goes_on, .is_over = is_over, .context = job};
    // Pictures of several cameras share what is left.
    const double end = job->cli->begun + AIM * time - DISPATCH_SECONDS;
    deadline_begin(&job->deadline, now, now + (end - now) / cameras);
    set_samples(job, job->shot.settings.samples);
    struct timed_progress timed = {job, progress, now};
    const struct render_progress by_time = {report, &timed};
    const enum shot_status status =
        shot_take_until(&job->shot, &job->image, &by_time, &limit, &job->stats.last);
    if (status == SHOT_OK)
        set_samples(job, job->stats.last.samples);
    return status;
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

int render_tell_time(const struct render_job *job) {
    const struct cli_options *options = &job->cli->options;
    const uint32_t made = job->stats.last.samples, wanted = job->shot.settings.samples;
    const double time = options->measure.time_s, seconds = job->written - job->cli->begun;
    if (!(time > 0))
        return CLI_OK;
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
