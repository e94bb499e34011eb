// A picture in bands: each is on the disk before the next one begins, so a process needs memory for one, and
// another process can go on.
#include "cli/commands/bands/bands_run.h"
#include "cli/device.h"
#include "core/ranges.h"
#include "diag/codes/command.h"
#include "diag/codes/limit.h"
#include "grammar/ir.h"
#include "picture/write/rows.h"

#include <stdio.h>
#include <string.h>

enum {
    WHOLE_PIXELS = 8 << 20, // larger ones are in bands if nothing needs them whole, at 18 bytes per pixel
};

// ---- whether

static bool are_asked_for(const struct rendering *r) {
    const struct cli_part *part = &r->cli->options.part;
    return cli_option_place(r->cli, "bands") || part->resume || part->partial || part->spreads;
}

static int place_of(const struct rendering *r) {
    static const char *const options[] = {"resume", "bands", "partial"};
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        if (cli_option_place(r->cli, options[i]))
            return cli_option_place(r->cli, options[i]);
    return cli_operand_place(r->cli, 0);
}

static bool is_file(const struct cli_output *output) {
    return strcmp(output->path, "-") != 0 && strncmp(output->path, "/dev/", 5) != 0;
}

// The output that the checkpoint lies beside; NULL: there is none.
static const struct cli_output *first_file(const struct rendering *r) {
    for (uint32_t i = 0; i < r->output_count; i++)
        if (is_file(&r->outputs[i]))
            return &r->outputs[i];
    return NULL;
}

// What was asked for that needs all pixels at once; NULL: nothing.
static const char *obstacle(const struct rendering *r) {
    const struct cli_options *o = &r->cli->options;
    if (cli_device_is_reference(r->cli))
        return "the reference renders whole pictures: choose a device";
    if (o->audit || o->has_max_off)
        return "an audit is about a whole picture: leave '--audit' and '--max-off' out";
    if (o->measure.time_s > 0)
        return "a time ends whole pictures: leave '--time' out; '--resume' goes on later";
    if (cli_option_place(r->cli, "max-error") || cli_option_place(r->cli, "max-time"))
        return "settings are chosen by whole pictures: choose them first, and write them into the scene";
    if (o->measure.noise > 0)
        return "pixels that end by their error state an error of the whole picture: leave '--noise' out";
    if (o->aovs)
        return "'--aov' is about a whole picture: leave it out";
    if (o->watch)
        return "'--watch' renders whole pictures: leave it out";
    if (o->repeat)
        return "'--repeat' times whole pictures: leave it out";
    if (o->part.has_samples)
        return "some of the samples are rendered at once: take a smaller --region or --tile instead";
    if (!first_file(r))
        return "the checkpoint lies beside the picture's file: name one with -o";
    return NULL;
}

int render_judge_bands(struct rendering *r) {
    r->cli->options.part.spreads = bands_spread(r->cli);
    const char *why = are_asked_for(r) ? obstacle(r) : NULL;
    return why ? cli_usage(r->cli, place_of(r), "this is not possible in bands: %s", why) : CLI_OK;
}

// The first output whose format is made of all pixels at once; NULL: none.
static const struct cli_output *whole_output(const struct rendering *r) {
    for (uint32_t i = 0; i < r->output_count; i++)
        if (!r->outputs[i].is_part && !image_rows_can(r->outputs[i].format))
            return &r->outputs[i];
    return NULL;
}

// Whether a picture could be held as a whole but need not be.
static bool saves_memory(const struct rendering *r) {
    const struct part_region *region = &r->job.part.region;
    return (uint64_t)region->width * region->height > WHOLE_PIXELS && !obstacle(r) && !whole_output(r) &&
           !(r->job.session->image->error > 0);
}

// A picture that is too large to be held needs formats that can be written in rows.
static int judge_formats(struct rendering *r) {
    const struct cli_output *output = whole_output(r);
    if (!output)
        return CLI_OK;
    const int status = cli_usage(r->cli, output->arg ? output->arg : place_of(r),
                                 "'%s' is of a format whose file is made of all pixels at once, and this "
                                 "picture has more than 64 megapixels",
                                 output->path);
    diag_help(&r->cli->sink, "write .png, .exr, .pfm or .hdr, and convert that");
    return status;
}

int render_plan_bands(struct rendering *r) {
    const struct part_region *region = &r->job.part.region;
    const bool is_large = (uint64_t)region->width * region->height > RANGE_PIXELS_MOST;
    r->job.in_bands = is_large || are_asked_for(r) || saves_memory(r);
    if (!r->job.in_bands)
        return CLI_OK;
    const char *why = obstacle(r);
    if (why)
        return cli_usage(r->cli, place_of(r),
                         "this picture has more than 64 megapixels, and is rendered in bands: %s", why);
    if (r->job.session->image->error > 0) {
        const int status = cli_usage(r->cli, place_of(r),
                                     "pixels that end by their error are not rendered in bands: the picture "
                                     "states an error of all its pixels");
        diag_help(&r->cli->sink, "give all pixels the same samples: --set image.error=0");
        return status;
    }
    r->job.image = (struct image){.width = region->width, .height = region->height};
    return is_large ? judge_formats(r) : CLI_OK;
}

// ---- the checkpoint

static bool goes_on(void *context) {
    const struct bands_run *run = context;
    return run->r->cli->options.part.resume && interrupt_signal() == 0;
}

static int refuse(struct bands_run *run, const char *words) {
    struct cli *cli = run->r->cli;
    const int status = cli_usage(cli, place_of(run->r), "'%s' %s", run->path, words);
    diag_help(&cli->sink, cli->options.part.resume
                              ? "remove it to begin anew"
                              : "go on from it with --resume, or remove it to begin anew");
    return status;
}

static int begin_anew(struct bands_run *run, struct strbuf *error) {
    struct rendering *r = run->r;
    strbuf_clear(error);
    run->is_open = bands_create(&run->work.bands, run->path, &r->job.part, job_band_rows(&r->job), error);
    if (run->is_open)
        return CLI_OK;
    cli_error(r->cli, error->len ? DIAG_OUTPUT : DIAG_OUT_OF_MEMORY, run->path, NULL, "%s",
              error->len ? error->data : "not enough memory for the checkpoint");
    return CLI_FILE;
}

// Without --resume, an existing checkpoint may be the work of hours: it is not overwritten.
static int go_on(struct bands_run *run, struct strbuf *error) {
    struct rendering *r = run->r;
    bool missing;
    run->is_open = bands_open(&run->work.bands, run->path, goes_on, run, &missing, error);
    if (missing)
        return begin_anew(run, error);
    if (!run->is_open)
        return refuse(run, error->len ? error->data : "needs more memory than there is");
    if (!r->cli->options.part.resume)
        return refuse(run, "is there: a run before this one has left it");
    const char *words = bands_difference(&run->work.bands, &r->job.part);
    if (words)
        return refuse(run, arena_format(&r->cli->arena, "%s this one", words).ptr);
    if (!run->work.bands.is_judged)
        return CLI_STOPPED;
    run->found = run->work.bands.done_count;
    if (!r->cli->options.quiet)
        fprintf(stderr, "glint: %u of %u bands are in %s already\n", run->found, run->work.bands.count,
                run->path);
    return CLI_OK;
}

static int open_checkpoint(struct bands_run *run) {
    struct strbuf error;
    strbuf_init(&error);
    job_describe_part(&run->r->job, &run->r->job.part);
    run->path = arena_format(&run->r->cli->arena, "%s" BANDS_ENDING,
                             render_output_of(run->r, first_file(run->r), run->camera))
                    .ptr;
    const int status = go_on(run, &error);
    strbuf_finish(&error);
    return status;
}

// ---- bands

static int cannot_write(struct bands_run *run) {
    cli_error(run->r->cli, DIAG_OUTPUT, run->path,
              "a picture in bands needs 12 bytes of disk for each pixel while it is rendered",
              "cannot be written: %s", strerror(run->work.bands.spool.error));
    return CLI_FILE;
}

// Judges what became of the devices.
static int judge_devices(struct bands_run *run, enum shot_status taken) {
    const struct gpu *failed = job_bands_failed(&run->work);
    const int status = taken == SHOT_DEVICE      ? render_failed(run->r, taken)
                       : taken == SHOT_CANCELLED ? CLI_STOPPED
                                                 : CLI_OK;
    if (!failed)
        return status;
    cli_device_failed(run->r->cli, failed);
    return status == CLI_OK ? CLI_DEVICE : status;
}

static int take_bands(struct bands_run *run) {
    struct rendering *r = run->r;
    struct job_bands *work = &run->work;
    const struct render_progress progress = progress_callback(&r->progress);
    if (!job_bands_begin(work)) {
        cli_error(r->cli, DIAG_OUT_OF_MEMORY, run->path, NULL, "not enough memory for a band");
        return CLI_SCENE;
    }
    const int begun = bands_begin_devices(run);
    if (begun != CLI_OK)
        job_bands_give_up(work);
    const int taken = judge_devices(run, job_bands_take(work, &progress));
    for (uint32_t i = 0; i < run->gpu_count; i++)
        cli_close_device(r->cli, run->gpus[i]);
    if (work->bands.spool.error)
        return cannot_write(run);
    const int status = begun != CLI_OK ? begun : taken;
    return status == CLI_OK && work->bands.done_count < work->bands.count ? CLI_STOPPED : status;
}

// ---- the end

static int stop(struct bands_run *run) {
    struct rendering *r = run->r;
    struct bands *bands = &run->work.bands;
    progress_end(&r->progress);
    if (!bands->is_judged) {
        fprintf(stderr, "glint: stopped: %s is as it was; the same command with --resume goes on\n",
                run->path);
        return CLI_STOPPED;
    }
    if (!spool_settle(&bands->spool))
        return cannot_write(run);
    if (r->cli->options.part.partial && bands->done_count) {
        const int status = bands_write_partial(run);
        if (status != CLI_OK)
            return status;
    }
    fprintf(stderr, "glint: stopped: %u of %u bands are in %s; the same command with --resume goes on\n",
            bands->done_count, bands->count, run->path);
    return CLI_STOPPED;
}

static bool is_stopped(void) {
    return interrupt_signal() != 0;
}

int render_in_bands(struct rendering *r, uint32_t camera) {
    struct bands_run *run = ARENA_NEW(&r->cli->arena, struct bands_run);
    struct bands *bands = &run->work.bands;
    *run = (struct bands_run){.r = r, .camera = camera, .work = {.job = &r->job, .is_stopped = is_stopped}};
    r->progress.patience = PROGRESS_PATIENCE;
    int status = open_checkpoint(run);
    if (status == CLI_OK)
        status = take_bands(run);
    if (status == CLI_OK) {
        progress_end(&r->progress);
        status = bands_write(run);
    }
    if (status == CLI_OK)
        job_bands_report_faults(&run->work);
    if (status == CLI_STOPPED)
        status = stop(run);
    const bool is_empty = run->is_open && bands->done_count == 0 && bands->is_judged;
    if (run->is_open && (status == CLI_OK || (is_empty && status != CLI_STOPPED && status != CLI_USAGE)))
        bands_remove(bands);
    else if (run->is_open)
        bands_finish(bands);
    job_bands_finish(&run->work);
    return status;
}
