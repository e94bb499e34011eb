#include "cli/commands/rendering.h"

#include "cli/device.h"
#include "core/clock.h"
#include "core/timeline.h"
#include "grammar/ir.h"
#include "picture/write/scale.h"

#include <math.h>
#include <stdio.h>

int render_interrupted(struct rendering *r) {
    progress_end(&r->progress);
    return cli_interrupted(r->cli);
}

int render_failed(struct rendering *r, enum shot_status status) {
    progress_end(&r->progress);
    if (status == SHOT_CANCELLED)
        return render_interrupted(r);
    if (status == SHOT_SCENE)
        return cli_report(r->cli, &r->session, !r->cli->options.quiet);
    return cli_device_failed(r->cli, r->gpu);
}

int render_scale_up(struct rendering *r) {
    const struct cli_measure *m = &r->cli->options.measure;
    struct image large;
    if (!m->scale_width)
        return CLI_OK;
    if (!image_init(&large, m->scale_width, m->scale_height)) {
        cli_error(r->cli, DIAG_OUT_OF_MEMORY, r->outputs[0].path, NULL, "not enough memory for the picture");
        return CLI_SCENE;
    }
    scale_picture(r->image.rgb, r->image.width, r->image.height, large.rgb, large.width, large.height);
    if (!r->cli->options.quiet)
        fprintf(stderr, "glint: rendered at %u x %u and scaled up, as --allow-resolution allows\n",
                r->image.width, r->image.height);
    large.note = r->image.note;
    image_finish(&r->image);
    r->image = large;
    return CLI_OK;
}

int render_tell_stats(const struct rendering *r, str text) {
    if (r->cli->options.stats == CLI_STATS_JSON && !render_uses_stdout(r))
        return cli_print(r->cli, text);
    cli_write_error(text);
    return CLI_OK;
}

// ---- a picture states its own error: --audit and --max-off

bool render_wants_audit(const struct cli_options *options) {
    return options->audit || options->has_max_off;
}

static struct audit_wish wish_of(const struct rendering *r) {
    const struct cli_options *options = &r->cli->options;
    // With --time it is not decided: that may take any time.
    const struct render_estimate *estimate = render_estimate_of(r);
    return (struct audit_wish){.reference = r->shot.reference,
                               .samples = estimate ? estimate->samples : NULL,
                               .planned = options->measure.time_s > 0 ? r->shot.settings.samples : 0,
                               .share = options->has_max_off ? options->max_off : AUDIT_SHARE,
                               .decides = options->has_max_off && options->measure.time_s <= 0};
}

int render_audit(struct rendering *r) {
    r->stats.has_audit = render_wants_audit(&r->cli->options);
    if (!r->stats.has_audit)
        return CLI_OK;
    struct audit *audit = &r->stats.audit;
    const struct audit_wish wish = wish_of(r);
    struct render_progress callback = progress_callback(&r->progress);
    const enum shot_status status =
        audit_take(&r->session, &r->shot.view, &r->image, &wish, &callback, audit);
    if (status != SHOT_OK)
        return render_failed(r, status);
    strbuf_clear(&r->audit_note);
    audit_words(audit, &r->audit_note);
    if (r->note.len)
        strbuf_cstr(&r->note, "; ");
    strbuf_str(&r->note, strbuf_view(&r->audit_note));
    r->image.note = r->note.data;
    return CLI_OK;
}

// ---- a picture states its noise: --noise and image.error

int render_note_estimate(struct rendering *r) {
    const struct render_estimate *estimate = render_estimate_of(r);
    const struct ir_image *image = r->session.image;
    strbuf_clear(&r->note);
    r->image.note = NULL;
    r->stats.estimate = estimate;
    r->stats.unused_error = r->session.unused_error;
    render_tell_unused_error(r);
    if (!estimate)
        return CLI_OK;
    const double pixels = (double)r->image.width * r->image.height;
    strbuf_format(&r->note,
                  "standard error %.3g of displayed colours, at most %.3g (95 %% sure), by %.4g samples per "
                  "pixel of at most %d",
                  estimate->mean, estimate->most, (double)r->stats.last.all_samples / pixels,
                  (int)image->samples);
    if (estimate->unknown)
        strbuf_format(&r->note, ", without %u that %s not finite", estimate->unknown,
                      estimate->unknown == 1 ? "is" : "are");
    r->image.note = r->note.data;
    if (!r->cli->options.quiet)
        fprintf(stderr, "glint: %s\n", r->note.data);
    return CLI_OK;
}

void render_tell_unused_error(const struct rendering *r) {
    const struct session *session = &r->session;
    const struct ir_image *image = &session->scene->image;
    if (!(session->unused_error > 0) || image->samples <= image->min_samples || r->cli->options.quiet)
        return;
    if (cli_device_is_reference(r->cli))
        fprintf(stderr, "glint: image.error ends no pixel: the reference takes all %d samples of each\n",
                session->image->samples);
    else if (session->options.error < 0)
        fprintf(stderr, "glint: image.error ends no pixel: %s says how many samples all have\n",
                r->cli->options.measure.time_s > 0 ? "--time" : "the search");
    else
        fprintf(stderr, "glint: image.error ends no pixel before it has %d samples, and each takes %d\n",
                image->min_samples, session->image->samples);
}

int render_tell_audit(const struct rendering *r) {
    const struct cli_options *options = &r->cli->options;
    const struct audit *audit = &r->stats.audit;
    if (!r->stats.has_audit)
        return CLI_OK;
    const bool broken = options->has_max_off && audit->bound > options->max_off;
    if ((options->audit || options->has_max_off) && (broken || !options->quiet)) {
        fprintf(stderr, "glint: %.*s", STR_ARG(strbuf_view(&r->audit_note)));
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

static void set_samples(struct rendering *r, uint32_t samples) {
    r->image_made = *r->session.image;
    r->image_made.samples = (int32_t)samples;
    r->session.image = &r->image_made;
}

// With the first sample's picture: what comes after the frame is done once, to know what it takes.
static void measure_rest(struct rendering *r) {
    const double start = clock_seconds();
    struct strbuf file;
    strbuf_init(&file);
    for (uint32_t i = 0; i < r->output_count; i++)
        render_encode(r, r->outputs[i].format, &file);
    r->deadline.after = RESERVE * (clock_seconds() - start) + (double)file.len / BYTES_A_SECOND +
                        RENAME_SECONDS * r->output_count;
    strbuf_finish(&file);
    if (!render_wants_audit(&r->cli->options))
        return;
    const uint32_t samples = (uint32_t)r->session.image->samples;
    struct audit audit;
    const struct audit_wish wish = wish_of(r);
    set_samples(r, 1);
    if (audit_take(&r->session, &r->shot.view, &r->image, &wish, NULL, &audit) == SHOT_OK)
        r->deadline.after_a_sample = RESERVE * audit.seconds * (audit.off || audit.whole ? 1 : LOOKS);
    set_samples(r, samples);
}

static bool goes_on(void *context, uint32_t samples, const float *rgb) {
    struct rendering *r = context;
    (void)rgb; // the job's image
    deadline_end_sample(&r->deadline, clock_seconds());
    if (samples == 1 && deadline_fits(&r->deadline, clock_seconds()))
        measure_rest(r);
    const double now = clock_seconds();
    if (!deadline_fits(&r->deadline, now))
        return false;
    deadline_begin_sample(&r->deadline, now);
    return true;
}

static bool is_over(void *context) {
    const struct rendering *r = context;
    return deadline_is_over(&r->deadline, clock_seconds());
}

// How far a frame is, which its time may end before its samples do.
struct timed_progress {
    const struct rendering *r;
    const struct render_progress *progress;
    double start;
};

static bool report(void *context, double fraction) {
    const struct timed_progress *t = context;
    const double all = t->r->deadline.end - t->start, now = clock_seconds() - t->start;
    return t->progress->report(t->progress->context, fmax(fraction, all > 0 ? fmin(now / all, 1) : 0));
}

enum shot_status render_take_frame(struct rendering *r, uint32_t cameras,
                                   const struct render_progress *progress) {
    const double time = r->cli->options.measure.time_s, now = clock_seconds();
    if (r->is_part)
        return render_take_part(r, progress);
    if (!(time > 0))
        return shot_take(&r->shot, &r->image, progress, &r->stats.last);
    const struct render_limit limit = {.goes_on = goes_on, .is_over = is_over, .context = r};
    // Pictures of several cameras share what is left.
    const double end = r->cli->begun + AIM * time - DISPATCH_SECONDS;
    deadline_begin(&r->deadline, now, now + (end - now) / cameras);
    set_samples(r, r->shot.settings.samples);
    struct timed_progress timed = {r, progress, now};
    const struct render_progress by_time = {report, &timed};
    const enum shot_status status = shot_take_until(&r->shot, &r->image, &by_time, &limit, &r->stats.last);
    if (status == SHOT_OK)
        set_samples(r, r->stats.last.samples);
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

int render_tell_time(const struct rendering *r) {
    const struct cli_options *options = &r->cli->options;
    const uint32_t made = r->stats.last.samples, wanted = r->shot.settings.samples;
    const double time = options->measure.time_s, seconds = r->written - r->cli->begun;
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
