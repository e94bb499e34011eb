// render --time: a frame that ends in time to be written.
#include "cli/render_job.h"
#include "core/clock.h"

#include <math.h>
#include <stdio.h>

// What is expected after the frame takes this much longer than it did with its first sample.
static const double RESERVE = 1.25;
// A file is written to the disk at least this fast, and its name changed.
static const double BYTES_A_SECOND = 1e8, RENAME_SECONDS = 0.005;

static void set_samples(struct render_job *job, uint32_t samples) {
    job->image_made = *job->session.image;
    job->image_made.samples = (int32_t)samples;
    job->session.image = &job->image_made;
}

// With the first sample's picture: what comes after the frame is done once, to know what it takes.
static void measure_rest(struct render_job *job) {
    const struct image_display display = {job->session.image->tone, job->session.image->transfer};
    const double start = clock_seconds();
    struct strbuf file;
    strbuf_init(&file);
    image_encode(&job->image, job->format, display, &file);
    job->deadline.after =
        RESERVE * (clock_seconds() - start) + (double)file.len / BYTES_A_SECOND + RENAME_SECONDS;
    strbuf_finish(&file);
    if (!render_wants_audit(&job->cli->options))
        return;
    const uint32_t samples = (uint32_t)job->session.image->samples;
    struct audit audit;
    set_samples(job, 1);
    if (audit_take(&job->session, &job->shot.view, &job->image, NULL, &audit) == SHOT_OK)
        job->deadline.after_a_sample = RESERVE * audit.seconds;
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
    if (!(time > 0))
        return shot_take(&job->shot, &job->image, progress, &job->stats.last);
    const struct render_limit limit = {goes_on, is_over, job};
    // Pictures of several cameras share what is left.
    deadline_begin(&job->deadline, now, now + (job->cli->begun + time - now) / cameras);
    set_samples(job, job->shot.settings.samples);
    struct timed_progress timed = {job, progress, now};
    const struct render_progress by_time = {report, &timed};
    const enum shot_status status =
        shot_take_until(&job->shot, &job->image, &by_time, &limit, &job->stats.last);
    if (status == SHOT_OK)
        set_samples(job, job->stats.last.samples);
    return status;
}

void render_tell_time(const struct render_job *job) {
    const struct cli_options *options = &job->cli->options;
    const uint32_t made = job->stats.last.samples, wanted = job->shot.settings.samples;
    const double seconds = job->written - job->cli->begun;
    if (!(options->measure.time_s > 0) || options->quiet)
        return;
    if (made < wanted)
        fprintf(stderr, "glint: --time %g allowed %u of %u samples\n", options->measure.time_s, made, wanted);
    if (seconds > options->measure.time_s && made == 1)
        fprintf(stderr,
                "glint: one sample, the least that a picture has, took longer than --time %g: %.2f s\n",
                options->measure.time_s, seconds);
    else if (seconds > options->measure.time_s)
        fprintf(stderr, "glint: the picture was written %.2f s after the start, later than --time %g\n",
                seconds, options->measure.time_s);
}
