// A job's picture: its frames, within a time limit if there is one, and what is made after them.
#include "core/clock.h"
#include "core/quantile.h"
#include "core/timeline.h"
#include "grammar/ir.h"
#include "picture/write/scale.h"
#include "render/job/job.h"

#include <math.h>

// ---- a frame that ends in time for its files to be written

// What follows the frame is expected to take this much longer than with the first sample.
static const double RESERVE = 1.5;
// A file is written to the disk, and renamed, at least this fast.
static const double BYTES_A_SECOND = 1e8, RENAME_SECONDS = 0.005;

// If the audit takes one look at the first sample's picture, the whole picture may need a second look at
// twice as many pixels.
static const double LOOKS = 3;
// How much of the time is planned for: a dispatch cannot be interrupted, and other programs run too.
static const double AIM = 0.98, DISPATCH_SECONDS = 0.05;

static void set_samples(struct job *job, uint32_t samples) {
    if (!job->image_made)
        job->image_made = ARENA_NEW(job->arena, struct ir_image);
    *job->image_made = *job->session->image;
    job->image_made->samples = (int32_t)samples;
    job->session->image = job->image_made;
}

static struct audit_wish audit_wish(const struct job *job) {
    const struct job_wish *wish = &job->wish;
    // With a time limit the audit does not decide: that may take any time.
    const bool in_time = wish->time.seconds > 0, decides = wish->max_off >= 0;
    const struct render_estimate *estimate = job_estimate(job);
    return (struct audit_wish){.reference = job->shot->reference,
                               .samples = estimate ? estimate->samples : NULL,
                               .planned = in_time ? job->shot->settings.samples : 0,
                               .share = decides ? wish->max_off : AUDIT_SHARE,
                               .decides = decides && !in_time};
}

// Does what follows the frame once, with the first sample's picture, to know how long it takes.
static void measure_rest(struct job *job) {
    const struct job_time *time = &job->wish.time;
    const double start = clock_seconds();
    const size_t bytes = time->encode(time->context);
    job->deadline.after =
        RESERVE * (clock_seconds() - start) + (double)bytes / BYTES_A_SECOND + RENAME_SECONDS * time->files;
    if (!job->wish.audits)
        return;
    const uint32_t samples = (uint32_t)job->session->image->samples;
    struct audit audit;
    const struct audit_wish wish = audit_wish(job);
    set_samples(job, 1);
    if (audit_take(job->session, &job->shot->view, &job->image, &wish, NULL, &audit) == SHOT_OK)
        job->deadline.after_a_sample = RESERVE * audit.seconds * (audit.off || audit.whole ? 1 : LOOKS);
    set_samples(job, samples);
}

static bool goes_on(void *context, uint32_t samples, const float *rgb) {
    struct job *job = context;
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
    const struct job *job = context;
    return deadline_is_over(&job->deadline, clock_seconds());
}

// Progress of a frame that may end by its time before its samples.
struct timed_progress {
    const struct job *job;
    const struct render_progress *progress;
    double start;
};

static bool report_time(void *context, double fraction) {
    const struct timed_progress *t = context;
    const double all = t->job->deadline.end - t->start, now = clock_seconds() - t->start;
    return t->progress->report(t->progress->context, fmax(fraction, all > 0 ? fmin(now / all, 1) : 0));
}

static enum shot_status take_in_time(struct job *job, uint32_t pictures,
                                     const struct render_progress *progress) {
    const struct job_time *time = &job->wish.time;
    const double now = clock_seconds(), end = time->begun + AIM * time->seconds - DISPATCH_SECONDS;
    const struct render_limit limit = {.goes_on = goes_on, .is_over = is_over, .context = job};
    deadline_begin(&job->deadline, now, now + (end - now) / pictures);
    set_samples(job, job->shot->settings.samples);
    struct timed_progress timed = {job, progress, now};
    const struct render_progress by_time = {report_time, &timed};
    const enum shot_status status =
        shot_take_until(job->shot, &job->image, &by_time, &limit, &job->stats.last);
    if (status == SHOT_OK)
        set_samples(job, job->stats.last.samples);
    return status;
}

// ---- frames

static void note_frames(struct stats *stats, double *times, double *on_device, int32_t frames) {
    quantile_sort(times, (size_t)frames);
    quantile_sort(on_device, (size_t)frames);
    stats->frames = frames;
    stats->least_frame_seconds = times[0];
    stats->most_frame_seconds = times[frames - 1];
    stats->median_frame_seconds = quantile(times, (size_t)frames, 0.5);
    stats->median_device_seconds = quantile(on_device, (size_t)frames, 0.5);
}

enum shot_status job_draw(struct job *job, uint32_t pictures, const struct render_progress *progress) {
    int32_t frames = job->wish.frames ? job->wish.frames : 1;
    struct job_share one = {progress, 0, (uint32_t)frames};
    const struct render_progress of_frame = job_share_progress(&one);
    double *times = ARENA_ARRAY(job->arena, double, (size_t)frames);
    double *on_device = ARENA_ARRAY(job->arena, double, (size_t)frames);
    const bool in_time = !job_by_reference(job) && job->wish.time.seconds > 0;
    for (int32_t i = 0; i < frames; i++) {
        const double start = clock_seconds();
        const uint32_t errors = job->session->sink.errors;
        one.done = (uint32_t)i;
        const enum shot_status status =
            in_time ? take_in_time(job, pictures, &of_frame) : job_frame(job, &job->image, &of_frame);
        times[i] = clock_seconds() - start;
        on_device[i] = job->stats.last.device_seconds;
        timeline_add(job->wish.timeline, "frame", STR(""), start);
        if (status != SHOT_OK)
            return status;
        if (i == 0)
            job->stats.first_frame_seconds = times[i];
        if (job->session->sink.errors > errors)
            frames = i + 1; // a faulty picture: more frames would show the same
    }
    note_frames(&job->stats, times, on_device, frames);
    return SHOT_OK;
}

// ---- what the picture states of itself

void job_state_estimate(struct job *job) {
    const struct render_estimate *estimate = job_estimate(job);
    strbuf_clear(&job->note);
    job->image.note = NULL;
    job->stats.estimate = estimate;
    job->stats.unused_error = job->session->unused_error;
    if (!estimate)
        return;
    const double pixels = (double)job->image.width * job->image.height;
    strbuf_format(&job->note,
                  "standard error %.3g of displayed colours, at most %.3g (95 %% sure), by %.4g samples per "
                  "pixel of at most %d",
                  estimate->mean, estimate->most, (double)job->stats.last.all_samples / pixels,
                  (int)job->session->image->samples);
    if (estimate->unknown)
        strbuf_format(&job->note, ", without %u that %s not finite", estimate->unknown,
                      estimate->unknown == 1 ? "is" : "are");
    job->image.note = job->note.data;
}

enum shot_status job_audit(struct job *job, const struct render_progress *progress) {
    struct audit *audit = &job->stats.audit;
    job->stats.has_audit = job->wish.audits;
    if (job_by_reference(job) || !job->wish.audits)
        return SHOT_OK;
    const struct audit_wish wish = audit_wish(job);
    const enum shot_status status =
        audit_take(job->session, &job->shot->view, &job->image, &wish, progress, audit);
    if (status != SHOT_OK)
        return status;
    strbuf_clear(&job->audit_note);
    audit_words(audit, &job->audit_note);
    if (job->note.len)
        strbuf_cstr(&job->note, "; ");
    strbuf_str(&job->note, strbuf_view(&job->audit_note));
    job->image.note = job->note.data;
    return SHOT_OK;
}

// ---- what else is made

enum shot_status job_make_layers(struct job *job, const struct render_progress *progress) {
    const struct layers_wish wish = {.shot = job->shot,
                                     .reference = &job->reference,
                                     .estimate = job_estimate(job),
                                     .width = job->image.width,
                                     .height = job->image.height,
                                     .wanted = job->wish.aovs,
                                     .in_picture = job->wish.in_picture};
    if (!wish.wanted)
        return SHOT_OK;
    job->layers = ARENA_NEW(job->arena, struct layers);
    const enum shot_status status = layers_make(job->layers, job->session, &wish, progress, job->arena);
    if (wish.in_picture)
        job->image.layers = &job->layers->layers;
    return status;
}

enum shot_status job_count(struct job *job) {
    const double start = clock_seconds();
    if (!job->wish.counts || job_by_reference(job) || job->shot->wish.counts)
        return SHOT_OK;
    const enum shot_status status = shot_count(job->shot, NULL, &job->stats.last);
    job->stats.count_seconds = clock_seconds() - start;
    timeline_add(job->wish.timeline, "count", STR(""), start);
    return status;
}

bool job_scale_up(struct job *job, uint32_t width, uint32_t height) {
    struct image large;
    if (!image_init(&large, width, height))
        return false;
    scale_picture(job->image.rgb, job->image.width, job->image.height, large.rgb, width, height);
    large.note = job->image.note;
    image_finish(&job->image);
    job->image = large;
    job->is_scaled = true;
    return true;
}
