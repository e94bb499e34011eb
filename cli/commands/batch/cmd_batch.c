// glint render of many pictures: frames, a sweep, several scenes, a film.
//
// All share one session, one device, and one store of meshes and trees (render/live). While a picture is
// traced, the next scene is read and the last picture encoded, each on a thread of its own.
#include "cli/commands/batch/batch_run.h"
#include "cli/commands/commands.h"
#include "cli/device.h"
#include "cli/made.h"
#include "core/clock.h"
#include "diag/codes/limit.h"
#include "grammar/ir.h"

#include <string.h>

// ---- what does not go together with it

static const struct cli_no_effect no_place[] = {
    {"repeat", "each of many pictures is rendered once"},
    {"bands", "many pictures are rendered whole, one after the other"},
    {"partial", "many pictures are whole ones"},
    {"watch", "many pictures are rendered once; 'glint render --watch' follows one scene"},
    {"time", "many pictures are whole ones"},
    {"max-error", "settings are chosen for one picture"},
    {"max-time", NULL},
    {"audit", "an audit is of one picture"},
    {"max-off", NULL},
    {"count-rays", "rays are counted for one picture"},
    {"aov", "many pictures are written without what else is known of their pixels"},
    {"samples-from", "many pictures have all their samples; --tile and --region go with them"},
    {"samples-to", NULL},
    {"noise", "the error of a picture is stated for one; set image.error in the scene"},
    {0},
};
static const struct cli_no_effect no_place_in_film[] = {
    {"tile", "a film has whole frames"},
    {"region", NULL},
    {"skip-done", "a film does not say how each of its frames was made"},
    {0},
};
static const struct cli_no_effect no_place_in_sheet[] = {
    {"tile", "a sheet has whole pictures"},
    {"region", NULL},
    {0},
};

static int judge(struct batch_run *run) {
    struct cli *cli = run->cli;
    const struct cli_outputs *outputs = &cli->options.outputs;
    const struct cli_batch *b = &cli->options.batch;
    if (cli_device_is_reference(cli))
        return cli_usage(cli, 1,
                         "many pictures are rendered on a device, not by the reference: choose one with "
                         "--device");
    for (uint32_t i = 0; i < outputs->count && !b->montage; i++)
        if (batch_film_of(outputs->items[i].path) != BATCH_NO_FILM)
            run->batch.film = batch_film_of(outputs->items[i].path);
    if (run->batch.film && !b->has_frames && !b->sweeps.count && !b->list && cli->operand_count == 1) {
        const int status =
            cli_usage(cli, outputs->items[0].arg, "the output '%s' must end in %s for one picture",
                      outputs->items[0].path, IMAGE_WRITTEN_ENDINGS);
        diag_help(&cli->sink,
                  "for a film, say which frames: --frames all, of the scene's animation, or --frames 0..99");
        return status;
    }
    if (run->batch.film && outputs->count > 1)
        return cli_usage(cli, outputs->items[1].arg,
                         "a film is the only output of a run: leave this one out");
    if (b->montage && batch_film_of(outputs->count ? outputs->items[0].path : "") == BATCH_FFMPEG)
        return cli_usage(cli, cli_option_place(cli, "montage"),
                         "a sheet is one picture, and the output is a film");
    if ((run->batch.film && cli_has_no_effect(cli, "resume", "a film is whole or not there")) ||
        (b->montage && cli_has_no_effect(cli, "resume", "a sheet is whole or not there")))
        return CLI_USAGE;
    if (b->fps > 0 && !b->has_frames && !run->batch.film &&
        cli_has_no_effect(cli, "fps", "there are no frames"))
        return CLI_USAGE;
    const bool is_idle = (run->batch.film && cli_have_no_effect(cli, no_place_in_film)) ||
                         (b->montage && cli_have_no_effect(cli, no_place_in_sheet)) ||
                         cli_have_no_effect(cli, no_place);
    return is_idle ? CLI_USAGE : CLI_OK;
}

static int take_outputs(struct batch_run *run) {
    struct cli *cli = run->cli;
    struct cli_outputs *outputs = &cli->options.outputs;
    const char *standard = cli->options.batch.montage ? "sheet.png" : "picture.png";
    if (outputs->count == 0) // batch_name says what pictures are called
        *(struct cli_output *)ARENA_PUSH(&cli->arena, outputs) = (struct cli_output){.path = standard};
    run->outputs.cli = cli;
    run->outputs.job.arena = &cli->arena;
    run->outputs.outputs = outputs->items;
    run->outputs.output_count = outputs->count;
    int status = run->batch.film ? CLI_OK : render_take_outputs(&run->outputs);
    if (status == CLI_OK)
        status = render_judge_part(&run->outputs);
    return status == CLI_OK ? render_judge_done(&run->outputs) : status;
}

// ---- reading the next scene

static void read_scene(void *context) {
    struct batch_reading *reading = context;
    reading->loaded = live_read(reading->live, &reading->options, reading->again);
}

static bool is_same_scene(const struct batch_run *run, uint32_t job, uint32_t other) {
    return other < run->batch.jobs.count &&
           strcmp(run->batch.jobs.items[job].scene, run->batch.jobs.items[other].scene) == 0;
}

static void begin_reading(struct batch_run *run, uint32_t job) {
    const struct batch_job *j = &run->batch.jobs.items[job];
    run->next.live = &run->live;
    run->next.options = cli_session_options(run->cli, j->scene);
    run->next.options.sets = j->sets;
    run->next.options.set_count = j->set_count;
    run->next.options.lint = LINT_CHEAP;
    run->next.again = is_same_scene(run, job, job + 1) || (job && is_same_scene(run, job, job - 1));
    run->next.is_under_way = true;
    parallel_start(&run->next.task, read_scene, &run->next);
}

static struct live_loaded end_reading(struct batch_run *run) {
    parallel_wait(&run->next.task);
    run->next.is_under_way = false;
    return run->next.loaded;
}

static bool is_other_load(const struct batch_run *run, uint32_t job) {
    return job == 0 || run->batch.jobs.items[job].load != run->batch.jobs.items[job - 1].load;
}

// ---- one picture

// Warnings and notes are reported once per scene, and again if they differ.
static void tell_findings(struct batch_run *run, const struct batch_job *job, bool failed) {
    struct session *session = live_findings(&run->live);
    if (!session)
        return;
    const bool is_new = run->told_scene != job->scene || run->told_count != session->sink.count;
    if (failed ? run->told_load != job->load || is_new : is_new) {
        progress_end(&run->progress);
        cli_report(run->cli, session, !run->cli->options.quiet && run->told_scene != job->scene);
    }
    run->told_scene = job->scene;
    run->told_load = job->load;
    run->told_count = session->sink.count;
}

static void drop_pending(struct batch_run *run) {
    if (run->is_pending)
        live_drop(run->pending);
    run->is_pending = false;
}

// Takes the next scene, which is shown once a picture of it is rendered.
static void take_loaded(struct batch_run *run, uint32_t number) {
    if (!is_other_load(run, number))
        return;
    const struct live_loaded loaded = end_reading(run);
    drop_pending(run);
    run->pending = loaded;
    run->is_pending = true;
    run->counts.loads++;
}

// Whether a picture shows the scene of the previous one, in the next frame.
static bool is_next_frame(const struct batch_run *run, uint32_t number) {
    const struct batch_job *job = &run->batch.jobs.items[number];
    if (number == 0 || !job->has_frame)
        return false;
    const struct batch_job *before = job - 1;
    return before->has_frame && job->frame == before->frame + 1 && job->scene == before->scene &&
           str_equal(job->values, before->values) && str_equal(job->camera, before->camera);
}

static enum live_state show(struct batch_run *run, uint32_t number) {
    const struct batch_job *job = &run->batch.jobs.items[number];
    struct batch_counts *c = &run->counts;
    enum live_state state = LIVE_BROKEN;
    if (run->is_pending) {
        run->is_pending = false;
        run->live.follows = is_next_frame(run, number);
        state = live_show(&run->live, run->pending, job->camera);
        run->is_load_good = state == LIVE_SHOWN;
    } else if (run->is_load_good) {
        state = live_turn(&run->live, job->camera);
    }
    const struct live_change *change = &run->live.change;
    c->meshes_read += change->meshes_read;
    c->images_read += change->images_read;
    c->trees_built += change->trees_built;
    c->trees_kept += change->trees_kept;
    c->pipelines_made += change->pipelines_made;
    c->precision_asked += change->precision_asked;
    return state;
}

// The camera of this name; IR_NO_INDEX: there is none, which is reported when it would be shown.
static uint32_t camera_of(const struct session *session, str name) {
    const struct ir_cameras *cameras = &session->scene->cameras;
    for (uint32_t i = 0; i < cameras->count; i++)
        if (str_equal(cameras->items[i].name, name))
            return i;
    return name.len ? IR_NO_INDEX : 0;
}

static int plan_part(struct batch_run *run, const struct batch_job *job, struct session *session) {
    run->outputs.job.session = session;
    if (run->planned != job->number + 1)
        run->plan_status = run->batch.film ? CLI_OK : render_plan_part(&run->outputs);
    run->planned = job->number + 1;
    return run->plan_status;
}

// --skip-done: whether all files of a picture are there.
static bool is_done(struct batch_run *run, const struct batch_job *job) {
    struct session *session = run->is_pending ? run->pending.session : run->live.session;
    if (!run->cli->options.batch.skip_done || !session || session->state != SESSION_LOADED ||
        session->sink.errors || camera_of(session, job->camera) == IR_NO_INDEX)
        return false;
    if (plan_part(run, job, session) != CLI_OK)
        return false;
    run->outputs.job.camera = camera_of(session, job->camera);
    bool done = true;
    for (uint32_t i = 0; i < run->outputs.output_count && done; i++)
        done = render_output_is_done(&run->outputs, &run->outputs.outputs[i], job->paths[i]);
    run->counts.skipped += done;
    return done;
}

static int fit_image(struct batch_run *run, struct image *image, const struct render_settings *settings) {
    const int status = run->batch.film ? CLI_OK : render_judge_size(&run->outputs);
    if (status != CLI_OK || image_fit(image, settings->width, settings->height))
        return status;
    cli_error(run->cli, DIAG_OUT_OF_MEMORY, run->outputs.outputs[0].path, NULL,
              "not enough memory for the picture");
    return CLI_FILE;
}

// Traces the picture that is shown into `made`.
static int trace(struct batch_run *run, const struct batch_job *job, struct batch_made *made) {
    struct job *drawn = &run->outputs.job;
    const struct render_progress progress = progress_callback(&run->progress);
    int status = plan_part(run, job, run->live.session);
    job_follow(drawn, &run->live);
    if (status == CLI_OK && job_aim(drawn) != SHOT_OK) {
        progress_end(&run->progress);
        return cli_device_failed(run->cli, run->outputs.job.gpu);
    }
    if (status == CLI_OK)
        status = fit_image(run, &made->image, &drawn->shot->settings);
    if (status != CLI_OK)
        return status;
    const uint32_t errors = drawn->session->sink.errors;
    const double start = clock_seconds();
    const enum shot_status taken = job_frame(drawn, &made->image, &progress);
    run->counts.trace_seconds += clock_seconds() - start;
    if (taken == SHOT_CANCELLED)
        return CLI_INTERRUPTED;
    if (taken != SHOT_OK) {
        progress_end(&run->progress);
        return taken == SHOT_DEVICE ? cli_device_failed(run->cli, run->outputs.job.gpu) : CLI_SCENE;
    }
    made->job = job;
    made->display = job_display(drawn);
    return drawn->session->sink.errors > errors ? CLI_SCENE : CLI_OK;
}

static int broken_status(struct batch_run *run) {
    const struct session *session = live_findings(&run->live);
    return session && session->state == SESSION_UNREADABLE ? cli_session_status(session) : CLI_SCENE;
}

static int render_one(struct batch_run *run, uint32_t number, struct batch_made *made) {
    const struct batch_job *job = &run->batch.jobs.items[number];
    const uint32_t count = run->batch.jobs.count;
    run->counts.begun++;
    run->progress.base = (double)number / count;
    run->progress.share = 1.0 / count;
    take_loaded(run, number);
    const bool done = is_done(run, job);
    const enum live_state state = done ? LIVE_BROKEN : show(run, number);
    if (number + 1 < count && is_other_load(run, number + 1))
        begin_reading(run, number + 1);
    if (done)
        return CLI_OK;
    if (state == LIVE_FAILED) {
        progress_end(&run->progress);
        return cli_device_failed(run->cli, run->outputs.job.gpu);
    }
    const int status = state == LIVE_SHOWN ? trace(run, job, made) : broken_status(run);
    tell_findings(run, job, status != CLI_OK);
    // A picture with faulty pixels is written and counts as failed, like a single picture.
    made->is_faulty = status != CLI_OK;
    if (made->job)
        batch_encode(run, made);
    return status;
}

// ---- all of them

// Whether what ended one picture ends all.
static bool is_end(const struct batch_run *run, int status) {
    return status == CLI_INTERRUPTED || status == CLI_DEVICE || status == CLI_PIPE || status == CLI_USAGE ||
           (status != CLI_OK && (run->cli->options.batch.stops || run->batch.film));
}

static int note_failure(struct batch_run *run, const struct batch_job *job, int status) {
    if (status == CLI_OK || status == CLI_INTERRUPTED)
        return status;
    run->first_failed = run->first_failed ? run->first_failed : job;
    run->counts.failed++;
    run->worst = status > run->worst ? status : run->worst;
    progress_end(&run->progress);
    batch_tell_failure(run, job);
    return status;
}

static int render_all(struct batch_run *run) {
    int end = CLI_OK;
    if (run->batch.jobs.count == 0)
        return end;
    begin_reading(run, 0);
    for (uint32_t i = 0; i < run->batch.jobs.count && end == CLI_OK; i++) {
        struct batch_made *made = &run->made[i % 2], *last = &run->made[(i + 1) % 2];
        const struct batch_job *job = &run->batch.jobs.items[i], *before = last->job;
        int status = note_failure(run, job, render_one(run, i, made));
        const int written = note_failure(run, before, batch_write(run, last));
        end = is_end(run, status) ? status : is_end(run, written) ? written : CLI_OK;
        if (end == CLI_OK && interrupt_signal())
            end = CLI_INTERRUPTED;
    }
    for (uint32_t i = 0; i < 2; i++) {
        const struct batch_job *job = run->made[i].job;
        const int written = note_failure(run, job, batch_write(run, &run->made[i]));
        end = end == CLI_OK && is_end(run, written) ? written : end;
    }
    return end;
}

static int finish(struct batch_run *run, int status) {
    struct batch_reading *next = &run->next;
    progress_end(&run->progress);
    if (next->is_under_way)
        live_drop(end_reading(run));
    drop_pending(run);
    const bool whole = status == CLI_OK && run->counts.failed == 0;
    int last = CLI_OK;
    if (run->batch.film)
        last = film_end(&run->film, whole);
    else if (run->cli->options.batch.montage && status == CLI_OK)
        last = batch_write_sheet(run);
    if (status == CLI_INTERRUPTED)
        return batch_stopped(run);
    if (last == CLI_OK || run->counts.failed)
        batch_tell(run);
    const int told = batch_stats(run);
    return status != CLI_OK ? status : run->counts.failed ? run->worst : last != CLI_OK ? last : told;
}

static int run_batch(struct batch_run *run) {
    struct cli *cli = run->cli;
    const double start = clock_seconds();
    int status = cli_open_device(cli, &run->outputs.job.gpu);
    run->counts.device_seconds = clock_seconds() - start;
    const struct live_wish wish = {.session = cli_session_options(cli, run->batch.jobs.items[0].scene),
                                   .alone = true};
    if (status == CLI_OK)
        status = batch_resume(run);
    if (status == CLI_OK && !live_begin(&run->live, &wish, run->outputs.job.gpu)) {
        cli_error(cli, DIAG_OUT_OF_MEMORY, run->batch.jobs.items[0].scene, NULL, "not enough memory");
        status = CLI_FILE;
    }
    for (int i = 0; i < 2; i++) {
        run->made[i].files = ARENA_ARRAY(&cli->arena, struct strbuf, run->outputs.output_count);
        run->made[i].errors = ARENA_ARRAY(&cli->arena, int, run->outputs.output_count);
        run->made[i].texts = ARENA_ARRAY(&cli->arena, struct image_texts, run->outputs.output_count);
        for (uint32_t k = 0; k < run->outputs.output_count; k++)
            strbuf_init(&run->made[i].files[k]);
    }
    progress_begin(&run->progress, cli->options.quiet);
    run->progress.patience = cli->options.part.resume ? PROGRESS_PATIENCE : 0;
    if (status == CLI_OK)
        status = finish(run, render_all(run));
    for (int i = 0; i < 2; i++) {
        for (uint32_t k = 0; k < run->outputs.output_count; k++)
            strbuf_finish(&run->made[i].files[k]);
        image_finish(&run->made[i].image);
    }
    batch_end_resume(run, status == CLI_OK);
    live_finish(&run->live);
    image_finish(&run->sheet);
    cli_close_device(cli, run->outputs.job.gpu);
    return status;
}

int cmd_batch(struct cli *cli) {
    struct batch_run *run = ARENA_NEW(&cli->arena, struct batch_run);
    run->cli = cli;
    run->batch.cli = cli;
    int status = judge(run);
    if (status == CLI_OK)
        status = take_outputs(run);
    if (status == CLI_OK)
        status = batch_plan(&run->batch);
    if (status == CLI_OK && !run->batch.film && !cli->options.batch.montage)
        status = batch_name(&run->batch);
    if (status == CLI_OK && run->batch.film)
        status = film_begin(&run->film, cli, run->outputs.outputs[0].path, run->batch.film, run->batch.fps);
    for (uint32_t i = 0; i < run->outputs.output_count && status == CLI_OK && cli->options.batch.montage; i++)
        status = cli_judge_made(cli, render_typed(&run->outputs.outputs[i]), run->outputs.outputs[i].path);
    if (status != CLI_OK)
        return status;
    interrupt_catch();
    return run_batch(run);
}
