// How long a task takes, measured: small pictures of the first, the middle and the last frame, as a task
// would make them. A pixel with all its samples is assumed to take as long in the whole picture; if a small
// picture is done at once, a larger one is measured.
#include "cli/commands/batch/batch_job.h"
#include "cli/commands/farm/farm.h"
#include "cli/commands/rendering.h"
#include "cli/device.h"
#include "core/clock.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double TASK_SECONDS = 60, ENOUGH_SECONDS = 0.2;

enum {
    FRAMES_MOST = 3,
    SIDE = 64, // of the first small picture, about
    TAKES = 3,
};

struct pilot {
    struct cli *cli;
    struct farm_plan *plan;
    struct gpu *gpu;
    struct asset_store *store;
    struct progress progress;
    uint32_t whole_width, whole_height;
    double load_s[FRAMES_MOST];
};

static int failed(struct pilot *p, const struct job *drawn, enum shot_status status) {
    progress_end(&p->progress);
    return render_not_drawn(p->cli, drawn, status, false);
}

// Draws one small picture; *seconds gets its time.
static enum shot_status take(struct pilot *p, struct job *drawn, uint32_t width, uint32_t height,
                             double *seconds) {
    const uint32_t samples = (uint32_t)drawn->session->image->samples;
    const struct render_progress progress = progress_callback(&p->progress);
    drawn->is_part = true;
    drawn->part = (struct part){.width = width,
                                .height = height,
                                .region = {0, 0, width, height},
                                .samples = samples,
                                .end_sample = samples};
    if (job_aim(drawn) != SHOT_OK)
        return SHOT_DEVICE;
    if (!image_init(&drawn->image, width, height))
        return shot_no_memory(drawn->session, "the small picture");
    const double start = clock_seconds();
    const enum shot_status status = job_frame(drawn, &drawn->image, &progress);
    *seconds = clock_seconds() - start;
    image_finish(&drawn->image);
    return status;
}

// The least time of several: the first ones also compile kernels.
static enum shot_status take_least(struct pilot *p, struct job *drawn, uint32_t width, uint32_t height,
                                   double *seconds) {
    enum shot_status status = SHOT_OK;
    *seconds = INFINITY;
    for (int i = 0; i < TAKES && status == SHOT_OK; i++) {
        double one = 0;
        status = take(p, drawn, width, height, &one);
        *seconds = fmin(*seconds, one);
    }
    return status;
}

static int measure_job(struct pilot *p, struct job *drawn) {
    struct farm_pilot *out = &p->plan->pilot;
    double seconds = 0;
    uint32_t width = (uint32_t)drawn->session->image->width, height = (uint32_t)drawn->session->image->height;
    enum shot_status status = take_least(p, drawn, width, height, &seconds);
    while (status == SHOT_OK && seconds < ENOUGH_SECONDS &&
           (width < p->whole_width || height < p->whole_height)) {
        width = width * 2 < p->whole_width ? width * 2 : p->whole_width;
        height = height * 2 < p->whole_height ? height * 2 : p->whole_height;
        status = take_least(p, drawn, width, height, &seconds);
    }
    out->width = width;
    out->height = height;
    out->picture_s += seconds / ((double)width * height) * p->whole_width * p->whole_height;
    return status == SHOT_OK ? CLI_OK : failed(p, drawn, status);
}

static int judge_session(struct pilot *p, struct session *session) {
    struct cli *cli = p->cli;
    if (session->state != SESSION_LOADED || session->sink.errors)
        return cli_report(cli, session, false);
    if (p->plan->tiles > 1 && session->image->error > 0) {
        const int status = cli_usage(cli, cli_option_place(cli, "tiles"),
                                     "the scene's pixels end by their error, and are not rendered in parts");
        diag_help(&cli->sink, "give all pixels the same samples: --set image.error=0");
        return status;
    }
    if (p->plan->tiles > (p->whole_height + 7) / 8) {
        const int status = cli_usage(cli, cli_option_place(cli, "tiles"),
                                     "a picture of %u rows has at most %u parts, of 8 rows each, not %u",
                                     p->whole_height, (p->whole_height + 7) / 8, p->plan->tiles);
        diag_help(&cli->sink, "take fewer");
        return status;
    }
    return CLI_OK;
}

int farm_check(struct cli *cli, struct farm_plan *plan) {
    struct pilot p = {.cli = cli, .plan = plan};
    struct batch batch = {.cli = cli};
    struct session session;
    int status = batch_plan(&batch);
    if (status != CLI_OK)
        return status;
    struct session_options options = cli_session_options(cli, batch.jobs.items[0].scene);
    struct asset_store *store = asset_store_create();
    options.sets = batch.jobs.items[0].sets;
    options.set_count = batch.jobs.items[0].set_count;
    options.pixels = ASSETS_SKIP_PIXELS;
    session_load(&session, &options, store);
    if (session.image)
        p.whole_height = (uint32_t)session.image->height;
    status = judge_session(&p, &session);
    if (status == CLI_OK && session_camera(&session, cli->options.camera) == IR_NO_INDEX)
        status = cli_report(cli, &session, false);
    session_finish(&session);
    asset_store_destroy(store);
    return status;
}

static int measure_frame(struct pilot *p, const struct batch_job *job, uint32_t number) {
    struct session session;
    struct session_options options = cli_session_options(p->cli, job->scene);
    struct job drawn = {.session = &session, .gpu = p->gpu};
    const double start = clock_seconds();
    options.sets = job->sets;
    options.set_count = job->set_count;
    session_load(&session, &options, p->store);
    if (session.image) {
        p->whole_width = (uint32_t)session.image->width;
        p->whole_height = (uint32_t)session.image->height;
    }
    int status = judge_session(p, &session);
    const double loaded = clock_seconds() - start;
    if (status == CLI_OK) {
        // Opened again at the small size: a large picture would need all its memory.
        const double most = fmax(p->whole_width, p->whole_height), shrink = fmax(1, most / SIDE);
        session_finish(&session);
        options.width = (int32_t)ceil(p->whole_width / shrink);
        options.height = (int32_t)ceil(p->whole_height / shrink);
        session_load(&session, &options, p->store);
        status = judge_session(p, &session);
    }
    const double opened = clock_seconds();
    if (status == CLI_OK) {
        const uint32_t camera = session_camera(&session, job->camera);
        const enum shot_status open = camera == IR_NO_INDEX ? SHOT_SCENE : job_open(&drawn, camera);
        p->load_s[number] = loaded + clock_seconds() - opened;
        status = open == SHOT_OK ? measure_job(p, &drawn) : failed(p, &drawn, open);
    }
    job_close(&drawn);
    session_finish(&session);
    return status;
}

static int measure_frames(struct pilot *p, const struct batch *batch) {
    const uint32_t count = batch->jobs.count, frames = count < FRAMES_MOST ? count : FRAMES_MOST;
    struct farm_pilot *out = &p->plan->pilot;
    int status = CLI_OK;
    for (uint32_t i = 0; i < frames && status == CLI_OK; i++) {
        const uint32_t job = frames > 1 ? (uint32_t)((uint64_t)(count - 1) * i / (frames - 1)) : 0;
        status = measure_frame(p, &batch->jobs.items[job], i);
    }
    // The first frame also compiles kernels, which counts as start.
    double later = 0;
    for (uint32_t i = 1; i < frames; i++)
        later += p->load_s[i] / (frames - 1);
    out->frames = frames;
    out->load_s = frames > 1 ? later : p->load_s[0];
    out->start_s += frames > 1 ? fmax(0, p->load_s[0] - later) : 0;
    out->picture_s /= frames;
    return status;
}

static void choose_chunk(struct cli *cli, struct farm_plan *plan) {
    const struct farm_pilot *m = &plan->pilot;
    const double cell = m->load_s + m->picture_s / plan->tiles;
    const double fits = floor((TASK_SECONDS - m->start_s) / cell + 0.5);
    plan->chunk = fits < 1 ? 1 : fits < plan->frames ? (uint32_t)fits : plan->frames;
    if (cli->options.quiet)
        return;
    fprintf(stderr,
            "glint: measured %u small picture%s up to %u x %u: a frame takes about %.3g s after %.3g s of "
            "start\n",
            m->frames, m->frames == 1 ? "" : "s", m->width, m->height, m->load_s + m->picture_s, m->start_s);
    if (cell > 2 * TASK_SECONDS)
        fprintf(stderr, "glint: a task takes about %.0f s; with --tiles %.0f it would be about a minute\n",
                m->start_s + cell, ceil(m->picture_s / TASK_SECONDS));
}

int farm_measure(struct cli *cli, struct farm_plan *plan) {
    struct pilot p = {.cli = cli, .plan = plan};
    struct batch batch = {.cli = cli};
    const double start = clock_seconds();
    int status = batch_plan(&batch);
    if (status != CLI_OK)
        return status;
    interrupt_catch();
    progress_begin(&p.progress, true);
    status = cli_open_device(cli, &p.gpu);
    plan->pilot.start_s = clock_seconds() - start;
    p.store = asset_store_create();
    if (status == CLI_OK)
        status = measure_frames(&p, &batch);
    asset_store_destroy(p.store);
    cli_close_device(cli, p.gpu);
    if (status != CLI_OK)
        return status;
    plan->is_measured = true;
    choose_chunk(cli, plan);
    return CLI_OK;
}
