// The pictures of all cases, one after another: a device is opened once for consecutive cases, and a scene is
// read once for its pictures; meshes, images and trees are kept from scene to scene (render/live).
#include "cli/commands/test/test.h"

#include "cli/device.h"
#include "cli/progress.h"
#include "core/clock.h"
#include "core/nearest.h"
#include "diag/codes/limit.h"
#include "diag/codes/reference.h"
#include "grammar/ir.h"
#include "load/check.h"
#include "render/job/job.h"
#include "render/record/record.h"

#include <string.h>

struct tester {
    struct test_run *run;
    struct gpu *gpu; // NULL: the reference
    bool is_open, is_reference;
    struct live live;
    struct live_loaded loaded;     // of the reference: what it renders
    const struct test_case *shown; // the case whose scene is loaded and good; NULL: none
    str device;
    struct job job; // that draws a case
    struct image image;
    struct progress progress;
};

// ---- devices

static bool is_reference(const struct test_run *run, const struct test_case *test) {
    return !run->cli->options.device && test->settings.device.len
               ? str_equal(test->settings.device, STR("reference"))
               : cli_device_is_reference(run->cli);
}

static void close_device(struct tester *t) {
    if (!t->is_open)
        return;
    live_drop(t->loaded);
    t->loaded = (struct live_loaded){0};
    live_finish(&t->live);
    cli_close_device(t->run->cli, t->gpu);
    t->gpu = NULL;
    t->is_open = false;
    t->shown = NULL;
}

static int open_device(struct tester *t, const struct test_case *test) {
    struct cli *cli = t->run->cli;
    const str name = cli->options.device ? STR("") : test->settings.device;
    if (t->is_open && str_equal(name, t->device))
        return CLI_OK;
    close_device(t);
    t->device = name;
    t->is_reference = is_reference(t->run, test);
    int status = CLI_OK;
    if (!t->is_reference)
        status = name.len ? cli_open_named(cli, name.ptr, &t->gpu) : cli_open_device(cli, &t->gpu);
    const struct live_wish wish = {.session = cli_session_options(cli, test->scene.ptr), .alone = true};
    t->is_open = true;
    if (status == CLI_OK && !live_begin(&t->live, &wish, t->gpu)) {
        cli_error(cli, DIAG_OUT_OF_MEMORY, test->scene.ptr, NULL, "not enough memory");
        status = CLI_FILE;
    }
    return status;
}

// ---- scenes

static bool same_load(const struct test_case *a, const struct test_case *b) {
    const struct test_settings *x = &a->settings, *y = &b->settings;
    bool same = str_equal(a->scene, b->scene) && x->width == y->width && x->height == y->height &&
                x->samples == y->samples && x->sets.count == y->sets.count;
    for (uint32_t i = 0; same && i < x->sets.count; i++)
        same = str_equal(x->sets.items[i], y->sets.items[i]);
    return same;
}

static struct session_options options_of(const struct tester *t, const struct test_case *test) {
    struct session_options options = cli_session_options(t->run->cli, test->scene.ptr);
    options.found_in = test->found_in;
    options.named_in = test->named_in;
    options.names_scene = test->named_in.len > 0;
    options.sets = test->settings.sets.items;
    options.set_count = test->settings.sets.count;
    options.width = test->settings.width;
    options.height = test->settings.height;
    options.samples = test->settings.samples;
    options.lint = LINT_NONE;
    return options;
}

static int fail(struct tester *t, struct test_case *test, const char *reason) {
    test->state = TEST_FAILED;
    test->reason = str_from(reason);
    t->shown = NULL;
    return CLI_OK;
}

static int scene_failed(struct tester *t, struct test_case *test, struct session *session) {
    progress_end(&t->progress);
    if (!session)
        return fail(t, test, "there is not enough memory for the scene");
    cli_report(t->run->cli, session, false);
    return fail(t, test, "the scene has errors");
}

// The file of bounds names the camera, so a mistake is reported there.
static bool has_camera(struct tester *t, const struct test_case *test, const struct session *session) {
    const struct ir_cameras *cameras = &session->scene->cameras;
    struct nearest search = nearest_begin(test->settings.camera);
    for (uint32_t i = 0; i < cameras->count; i++) {
        nearest_offer(&search, cameras->items[i].name);
        if (str_equal(cameras->items[i].name, test->settings.camera))
            return true;
    }
    if (test->settings.camera.len == 0)
        return true;
    struct diag_sink sink;
    diag_sink_init(&sink);
    diag_add(&sink, DIAG_UNKNOWN_CAMERA, test->settings.camera_at, "%.*s has no camera '%.*s'",
             STR_ARG(test->scene), STR_ARG(test->settings.camera));
    if (nearest_best(&search).len)
        diag_help(&sink, "did you mean '%.*s'?", STR_ARG(nearest_best(&search)));
    progress_end(&t->progress);
    cli_print_sink(t->run->cli, &sink);
    diag_sink_finish(&sink);
    return false;
}

static bool is_good(const struct session *session) {
    return session && session->state == SESSION_LOADED && session->sink.errors == 0;
}

// The session of the case's scene, loaded if it is not yet; NULL: the case failed.
static struct session *load(struct tester *t, struct test_case *test) {
    if (t->shown && same_load(t->shown, test)) {
        struct session *session = t->is_reference ? t->loaded.session : t->live.session;
        if (has_camera(t, test, session))
            return session;
        fail(t, test, "there is no such camera");
        return NULL;
    }
    const struct session_options options = options_of(t, test);
    live_drop(t->loaded);
    t->shown = NULL;
    t->loaded = live_read(&t->live, &options, false);
    t->run->loads++;
    struct session *session = t->loaded.session;
    if (!is_good(session))
        scene_failed(t, test, session);
    else if (!has_camera(t, test, session))
        fail(t, test, "there is no such camera");
    return test->state == TEST_FAILED ? NULL : session;
}

// ---- one picture

static int fit_image(struct tester *t, const struct test_case *test, const struct session *session) {
    if (image_fit(&t->image, (uint32_t)session->image->width, (uint32_t)session->image->height))
        return CLI_OK;
    cli_error(t->run->cli, DIAG_OUT_OF_MEMORY, test->scene.ptr, NULL, "not enough memory for the picture");
    return CLI_FILE;
}

static int ended(struct tester *t, struct test_case *test, struct session *session, enum shot_status status,
                 uint32_t errors) {
    if (status == SHOT_CANCELLED) {
        progress_end(&t->progress);
        return cli_interrupted(t->run->cli);
    }
    if (status == SHOT_DEVICE) {
        progress_end(&t->progress);
        return cli_device_failed(t->run->cli, t->gpu);
    }
    if (status == SHOT_OK && session->sink.errors == errors)
        return CLI_OK;
    progress_end(&t->progress);
    cli_report(t->run->cli, session, false);
    return fail(t, test, status == SHOT_OK ? "some of its pixels are faulty" : "the scene has errors");
}

// Shows the scene that was read, or turns to another camera of the one that is shown.
static int show(struct tester *t, struct test_case *test) {
    enum live_state state;
    if (t->loaded.session) {
        const struct live_loaded loaded = t->loaded;
        t->loaded = (struct live_loaded){0};
        state = live_show(&t->live, loaded, test->settings.camera);
    } else {
        state = live_turn(&t->live, test->settings.camera);
    }
    if (state == LIVE_FAILED) {
        progress_end(&t->progress);
        return cli_device_failed(t->run->cli, t->gpu);
    }
    return state == LIVE_SHOWN ? CLI_OK : scene_failed(t, test, live_findings(&t->live));
}

// Draws what is shown on the device, or the session by the reference.
static int draw(struct tester *t, struct test_case *test, struct session *session) {
    struct job *job = &t->job;
    const uint32_t errors = session->sink.errors;
    const struct render_progress progress = progress_callback(&t->progress);
    const int fits = fit_image(t, test, session);
    enum shot_status status = SHOT_OK;
    if (fits != CLI_OK)
        return fits;
    *job = (struct job){.session = session,
                        .wish = {.by_reference = t->is_reference, .no_cache = t->run->cli->options.no_cache}};
    if (t->is_reference)
        status = job_open(job, session_camera(session, test->settings.camera));
    else
        job_follow(job, &t->live);
    if (status == SHOT_OK)
        status = job_frame(job, &t->image, &progress);
    job_close(job);
    return ended(t, test, session, status, errors);
}

// How the reference says that it is coded; a new one is coded the same.
static struct image_coding test_coding(struct test_run *run, const struct test_case *test) {
    struct image_coding coding = {0};
    struct record_read record;
    struct record_command command;
    str bytes;
    if (test->is_there &&
        files_read(&run->files, test->picture, run->cli->options.limits.value[LIMIT_IMAGE_BYTES],
                   &run->cli->arena, &bytes) == FILE_OK) {
        record_find(bytes, &record);
        if (record.is_there && record_read_command(record.fields[RECORD_COMMAND], &run->cli->arena, &command))
            coding = command.coding;
    }
    return coding;
}

static void encode(struct tester *t, const struct test_case *test, struct test_made *made) {
    made->display = job_display(&t->job);
    t->image.coding = test_coding(t->run, test);
    const struct provenance provenance = job_provenance(&t->job, test->format, t->image.coding);
    t->image.texts = provenance_texts(&provenance, &t->run->cli->arena);
    strbuf_clear(&made->file);
    image_encode(&t->image, test->format, made->display, &made->file);
    t->image.texts = (struct image_texts){0};
}

static int make(struct tester *t, struct test_case *test, struct test_made *made) {
    int status = open_device(t, test);
    struct session *session = status == CLI_OK ? load(t, test) : NULL;
    if (!session)
        return status;
    if (!test->is_there && test->found_in.len && check_is_library(session->scene)) {
        test->state = TEST_LIBRARY;
        return CLI_OK;
    }
    test->samples = session->image->samples;
    const char *missing = image_format_missing(test->format);
    if (missing)
        return fail(t, test, missing);
    if (!t->is_reference) {
        status = show(t, test);
        session = t->live.session;
    }
    if (status == CLI_OK && test->state == TEST_PENDING)
        status = draw(t, test, session);
    if (status != CLI_OK || test->state != TEST_PENDING)
        return status;
    t->shown = test;
    test->now = (struct test_size){t->image.width, t->image.height};
    encode(t, test, made);
    return CLI_OK;
}

// ---- all of them

int test_render(struct test_run *run, test_judge_fn judge) {
    struct tester t = {.run = run};
    struct test_made made = {0};
    int status = CLI_OK;
    strbuf_init(&made.file);
    interrupt_catch();
    // If lines are printed as results come, they show the progress.
    progress_begin(&t.progress, run->cli->options.quiet || !run->format);
    for (uint32_t i = 0; i < run->cases.count && status == CLI_OK; i++) {
        struct test_case *test = &run->cases.items[i];
        const double start = clock_seconds();
        t.progress.base = (double)i / run->cases.count;
        t.progress.share = 1.0 / run->cases.count;
        strbuf_clear(&made.file);
        status = make(&t, test, &made);
        test->seconds = clock_seconds() - start;
        if (status == CLI_OK)
            status = judge(run, test, test->state == TEST_PENDING ? &made : NULL);
        if (status == CLI_OK && interrupt_signal())
            status = cli_interrupted(run->cli);
    }
    progress_end(&t.progress);
    close_device(&t);
    image_finish(&t.image);
    strbuf_finish(&made.file);
    return status;
}
