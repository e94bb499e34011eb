// From the command line to jobs: scenes, in each the sweep's grid, in each the frames, in each the cameras.
#include "cli/commands/batch/batch_job.h"
#include "diag/codes/command.h"
#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "files/stream.h"
#include "grammar/ir.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

enum {
    JOBS_MAX = 1000000
};

// ---- the scenes

struct scene_of {
    const char *path;
    bool is_animated;
    bool is_broken; // it is not known whether it moves
    int32_t last;   // frame
};

struct scenes {
    struct scene_of *items;
    uint32_t count, capacity;
};

static void add_scene(struct cli *cli, struct scenes *scenes, const char *path) {
    *(struct scene_of *)ARENA_PUSH(&cli->arena, scenes) = (struct scene_of){.path = path};
}

static int read_list(struct cli *cli, struct strbuf *text) {
    const char *path = cli->options.batch.list;
    if (strcmp(path, "-") == 0)
        return cli_read_stream(cli, text);
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    const int error =
        file < 0 ? errno : stream_read(file, limits_size(&cli->options.limits, LIMIT_SCENE_BYTES), text);
    if (file >= 0)
        close(file);
    if (!error && !text->failed)
        return CLI_OK;
    if (error)
        cli_error(cli, DIAG_FILE_UNREADABLE, path, NULL, "cannot be read: %s", strerror(error));
    else
        cli_error(cli, DIAG_LIMIT, path, NULL, "the list is larger than the limit scene-bytes");
    return CLI_FILE;
}

// One scene per line; empty lines and those that begin with '#' are skipped.
static int take_list(struct cli *cli, struct scenes *scenes) {
    struct strbuf text;
    strbuf_init(&text);
    const int status = read_list(cli, &text);
    const str all = strbuf_view(&text);
    for (size_t begin = 0, i = 0; status == CLI_OK && i <= all.len; i++) {
        if (i < all.len && !char_is_break(all.ptr[i]))
            continue;
        const str line = str_trim(str_slice(all, begin, i));
        if (line.len && line.ptr[0] != '#')
            add_scene(cli, scenes, arena_copy(&cli->arena, line).ptr);
        begin = i + 1;
    }
    strbuf_finish(&text);
    return status;
}

static int take_scenes(struct cli *cli, struct scenes *scenes) {
    for (int i = 0; i < cli->operand_count; i++)
        add_scene(cli, scenes, cli->operands[i]);
    const int status = cli->options.batch.list ? take_list(cli, scenes) : CLI_OK;
    if (status != CLI_OK || scenes->count)
        return status;
    return cli_usage(cli, cli_option_place(cli, "list"), "'%s' names no scene", cli->options.batch.list);
}

// ---- settings of a frame

// Collects the frame's --set options, then `values` of the sweep, then the frame of the scene's own
// animation.
static bool take_sets(struct batch *batch, const struct scene_of *scene, const str *values,
                      struct batch_job *job, bool *moves) {
    struct cli *cli = batch->cli;
    const struct cli_batch *b = &cli->options.batch;
    const uint32_t given = cli->options.sets.count;
    str *sets = ARENA_ARRAY(&cli->arena, str, (size_t)given + b->sweeps.count + 2);
    bool good = true;
    for (uint32_t i = 0; i < given && good; i++) {
        bool filled = false;
        sets[i] = cli->options.sets.items[i];
        good = !job->has_frame || cli_fill_set(cli, &sets[i], job->frame, batch->fps, &filled);
        *moves |= filled;
    }
    for (uint32_t i = 0; i < b->sweeps.count; i++) {
        const str path = b->sweeps.items[i].path;
        sets[given + i] = arena_format(&cli->arena, "%.*s=%.*s", STR_ARG(path), STR_ARG(values[i]));
        job->values =
            i ? arena_format(&cli->arena, "%.*s_%.*s", STR_ARG(job->values), STR_ARG(values[i])) : values[i];
    }
    job->sets = sets;
    job->set_count = given + b->sweeps.count;
    if (job->has_frame && scene->is_animated) {
        sets[job->set_count++] = arena_format(&cli->arena, "animation.frame=%d", (int)job->frame);
        *moves = true;
    }
    return good;
}

// ---- cameras

static void add_job(struct batch *batch, struct batch_job job) {
    job.number = batch->jobs.count;
    *(struct batch_job *)ARENA_PUSH(&batch->cli->arena, &batch->jobs) = job;
}

// Adds one job for each camera of the scene. If the scene has mistakes, one for all: rendering reports them.
static void add_all_cameras(struct batch *batch, struct batch_job job) {
    struct session session;
    struct session_options options = cli_session_options(batch->cli, job.scene);
    struct asset_store *store = asset_store_create();
    options.text_only = true;
    options.sets = job.sets;
    options.set_count = job.set_count;
    session_load(&session, &options, store);
    const struct ir_cameras *cameras = session.scene ? &session.scene->cameras : NULL;
    if (session.sink.errors || !cameras || cameras->count == 0) {
        job.camera = STR("");
        add_job(batch, job);
    }
    for (uint32_t i = 0; session.sink.errors == 0 && cameras && i < cameras->count; i++) {
        job.camera = arena_copy(&batch->cli->arena, cameras->items[i].name);
        add_job(batch, job);
    }
    session_finish(&session);
    asset_store_destroy(store);
}

static void add_cameras(struct batch *batch, struct batch_job job) {
    job.load = batch->jobs.count ? batch->jobs.items[batch->jobs.count - 1].load + 1 : 0;
    if (str_equal(batch->cli->options.camera, STR("all")))
        add_all_cameras(batch, job);
    else
        add_job(batch, job);
}

// ---- the grid

static uint64_t grid_size(const struct cli_batch *b) {
    uint64_t size = 1;
    for (uint32_t i = 0; i < b->sweeps.count && size <= JOBS_MAX; i++)
        size *= b->sweeps.items[i].values.count;
    return size;
}

static int refuse_count(struct batch *batch, const struct scenes *scenes) {
    const struct cli_batch *b = &batch->cli->options.batch;
    uint64_t frames = 0;
    for (uint32_t i = 0; i < scenes->count; i++)
        frames += b->has_frames
                      ? (uint64_t)(scenes->items[i].last - b->first_frame) / (uint64_t)b->frame_step + 1
                      : 1;
    if (grid_size(b) * frames <= JOBS_MAX)
        return CLI_OK;
    return cli_usage(batch->cli,
                     b->has_frames     ? cli_option_place(batch->cli, "frames")
                     : b->sweeps.count ? b->sweeps.items[0].arg
                                       : 1,
                     "these are more than %d pictures", JOBS_MAX);
}

// Frames of a scene in which nothing moves would be the same picture many times.
static int refuse_still(struct batch *batch) {
    struct cli *cli = batch->cli;
    const int status = cli_usage(cli, cli_option_place(cli, "frames"),
                                 "all frames would be the same picture: nothing depends on the frame");
    diag_help(
        &cli->sink,
        "write an animation in the scene, or expressions of 'frame' or 'time' in braces, for example --set "
        "'camera.position=[{4*cos(360*frame/100)}, 1, {4*sin(360*frame/100)}]'");
    return status;
}

static bool add_frames(struct batch *batch, const struct scene_of *scene, const str *values, bool *moves) {
    const struct cli_batch *b = &batch->cli->options.batch;
    for (int64_t frame = b->first_frame; frame <= scene->last; frame += b->has_frames ? b->frame_step : 1) {
        struct batch_job job = {.scene = scene->path,
                                .camera = batch->cli->options.camera,
                                .has_frame = b->has_frames,
                                .frame = (int32_t)frame};
        if (!take_sets(batch, scene, values, &job, moves))
            return false;
        add_cameras(batch, job);
    }
    return true;
}

static int add_grid(struct batch *batch, const struct scenes *scenes) {
    struct cli *cli = batch->cli;
    const struct cli_batch *b = &cli->options.batch;
    const uint64_t size = grid_size(b);
    str *values = ARENA_ARRAY(&cli->arena, str, (size_t)b->sweeps.count + 1);
    bool moves = false;
    for (uint32_t s = 0; s < scenes->count; s++)
        moves |= scenes->items[s].is_broken;
    for (uint32_t s = 0; s < scenes->count; s++)
        for (uint64_t cell = 0; cell < size; cell++) {
            uint64_t rest = cell; // the last sweep changes fastest
            for (uint32_t i = b->sweeps.count; i-- > 0; rest /= b->sweeps.items[i].values.count)
                values[i] = b->sweeps.items[i].values.items[rest % b->sweeps.items[i].values.count];
            if (!add_frames(batch, &scenes->items[s], values, &moves))
                return CLI_USAGE;
        }
    const bool several = batch->jobs.count > scenes->count * size;
    return b->has_frames && several && !moves ? refuse_still(batch) : CLI_OK;
}

// ---- the scenes' own animations

// `is_only`: mistakes in its file end everything; with several scenes, rendering reports them and goes on.
static int take_motion(struct batch *batch, struct scene_of *scene, bool is_only) {
    struct cli *cli = batch->cli;
    const struct cli_batch *b = &cli->options.batch;
    str *values = ARENA_ARRAY(&cli->arena, str, (size_t)b->sweeps.count + 1);
    struct batch_job job = {.scene = scene->path, .has_frame = true, .frame = b->first_frame};
    bool moves = false;
    for (uint32_t i = 0; i < b->sweeps.count; i++)
        values[i] = b->sweeps.items[i].values.items[0];
    if (!take_sets(batch, scene, values, &job, &moves))
        return CLI_USAGE;
    const struct batch_motion motion = batch_motion_of(cli, scene->path, job.sets, job.set_count);
    scene->is_animated = motion.is_animated;
    scene->is_broken = !motion.is_good;
    const int status = is_only && !motion.is_good ? batch_judge_file(cli, scene->path) : CLI_OK;
    if (status != CLI_OK)
        return status;
    if (motion.is_animated && b->fps == 0 && batch->fps == 0)
        batch->fps = motion.rate;
    if (b->all_frames && !motion.is_animated && motion.is_good)
        return batch_no_animation(cli, scene->path);
    scene->last = !b->all_frames ? b->last_frame : motion.is_animated ? motion.frames - 1 : 0;
    if (!motion.is_animated || scene->last < motion.frames)
        return CLI_OK;
    cli_usage(cli, cli_option_place(cli, "frames"), "the animation of '%s' has %d frame%s, 0 to %d",
              scene->path, (int)motion.frames, motion.frames == 1 ? "" : "s", (int)motion.frames - 1);
    diag_help(&cli->sink, "--frames all renders them all; --set animation.frames=N makes more of them");
    return CLI_USAGE;
}

static int take_motions(struct batch *batch, struct scenes *scenes) {
    const struct cli_batch *b = &batch->cli->options.batch;
    int status = CLI_OK;
    for (uint32_t i = 0; i < scenes->count && status == CLI_OK; i++) {
        scenes->items[i].last = b->last_frame;
        if (b->has_frames)
            status = take_motion(batch, &scenes->items[i], scenes->count == 1);
    }
    batch->fps = b->fps > 0 ? b->fps : batch->fps > 0 ? batch->fps : 25;
    return status;
}

int batch_plan(struct batch *batch) {
    struct cli *cli = batch->cli;
    const struct cli_batch *b = &cli->options.batch;
    struct scenes scenes = {0};
    int status = take_scenes(cli, &scenes);
    if (status == CLI_OK)
        status = take_motions(batch, &scenes);
    if (status == CLI_OK)
        status = refuse_count(batch, &scenes);
    if (status == CLI_OK)
        status = add_grid(batch, &scenes);
    const uint32_t count = batch->jobs.count;
    batch->columns = b->sweeps.count > 1 ? b->sweeps.items[b->sweeps.count - 1].values.count
                                         : (uint32_t)ceil(sqrt((double)count));
    return status;
}
