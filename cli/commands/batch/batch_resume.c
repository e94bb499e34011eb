// --resume of many pictures: a checkpoint that says which of them are written, so another process can go on
// with the others.
//
// It begins with lines of text, filled up to HEAD_BYTES: what the list is, by a hash, and how many pictures
// it has. A slot for each picture follows, written once the picture's files have their names. However the
// process ends, a slot is there or not, by its seal.
#include "cli/commands/batch/batch_run.h"
#include "core/hash128.h"
#include "diag/codes/command.h"
#include "files/stream.h"
#include "grammar/ir.h"
#include "render/parts/bands.h"
#include "scene/content.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum {
    HEAD_BYTES = 512,
    FILE_SEED = 1,
};

static const char first_line[] = "glint checkpoint of many 1\n";

struct slot {
    uint64_t scene[2]; // hash of the picture's scene, with its settings
    uint64_t files;    // of the bytes of its files
    uint64_t seal;
};

static uint64_t seal_of(const struct slot *slot, uint32_t number) {
    return xxh64_of(slot, offsetof(struct slot, seal), number + 1);
}

static uint64_t place_of(uint32_t number) {
    return HEAD_BYTES + (uint64_t)number * sizeof(struct slot);
}

// ---- which list it is

static void hash_options(const struct cli_options *o, struct hash128 *h) {
    hash128_whole(h, (uint64_t)o->width << 32 | (uint32_t)o->height);
    hash128_whole(h, (uint64_t)o->samples);
    hash128_whole(h, o->limits.value[LIMIT_PATH_SEGMENTS]);
    hash128_array(h, o->part.region, 4, sizeof *o->part.region);
    hash128_whole(h, (uint64_t)o->part.tile << 32 | o->part.tiles);
    for (uint32_t i = 0; i < o->outputs.count; i++) {
        const struct image_coding coding = render_coding(o, o->outputs.items[i].format);
        hash128_whole(h, o->outputs.items[i].format);
        hash128_whole(h, (uint64_t)coding.bits << 32 | coding.quality << 8 | coding.compression);
    }
}

static void hash_job(const struct batch_run *run, const struct batch_job *job, struct hash128 *h) {
    hash128_text(h, str_from(job->scene));
    for (uint32_t i = 0; i < job->set_count; i++)
        hash128_text(h, job->sets[i]);
    hash128_text(h, job->camera);
    for (uint32_t i = 0; i < run->outputs.output_count; i++)
        hash128_text(h, str_from(job->paths[i]));
}

static void put_head(const struct batch_run *run, struct strbuf *out) {
    struct hash128 h;
    uint64_t key[2];
    hash128_begin(&h);
    hash128_text(&h, STR(GLINT_VERSION));
    hash128_text(&h, str_from(gpu_info(run->outputs.job.gpu)->name));
    hash_options(&run->cli->options, &h);
    for (uint32_t i = 0; i < run->batch.jobs.count; i++)
        hash_job(run, &run->batch.jobs.items[i], &h);
    hash128_end(&h, key);
    strbuf_format(out, "%slist %016" PRIx64 "%016" PRIx64 "\npictures %u\n", first_line, key[0], key[1],
                  run->batch.jobs.count);
    while (out->len < HEAD_BYTES && !out->failed)
        strbuf_char(out, '\n');
}

// ---- what is there

static int refuse(struct batch_run *run, const char *words) {
    struct cli *cli = run->cli;
    const int status =
        cli_usage(cli, cli_option_place(cli, "resume"), "'%s' %s", run->checkpoint.path, words);
    diag_help(&cli->sink, "remove it to begin anew");
    return status;
}

static int cannot_use(struct batch_run *run, const char *what) {
    cli_error(run->cli, DIAG_OUTPUT, run->checkpoint.path, NULL, "cannot be %s: %s", what,
              strerror(run->checkpoint.spool.error));
    return CLI_FILE;
}

static int begin_anew(struct batch_run *run, const struct strbuf *head) {
    struct spool *spool = &run->checkpoint.spool;
    if (head->failed || !spool_create(spool, run->checkpoint.path, head->data, head->len))
        return cannot_use(run, "written");
    run->checkpoint.is_open = true;
    return CLI_OK;
}

static bool take_slot(struct batch_run *run, uint32_t number, struct slot *slot) {
    return spool_take(&run->checkpoint.spool, place_of(number), slot, sizeof *slot) &&
           slot->seal == seal_of(slot, number);
}

// The hash of the files of a picture; false: one cannot be read.
static bool hash_files(const struct batch_run *run, const struct batch_job *job, uint64_t *hash) {
    struct xxh64 h;
    struct strbuf file;
    bool good = true;
    xxh64_begin(&h, FILE_SEED);
    strbuf_init(&file);
    for (uint32_t i = 0; i < run->outputs.output_count && good; i++) {
        strbuf_clear(&file);
        good = stream_read_file(job->paths[i], SIZE_MAX, &file) == 0 && !file.failed;
        if (good)
            xxh64_add(&h, file.data, file.len);
    }
    strbuf_finish(&file);
    *hash = xxh64_end(&h);
    return good;
}

// Whether the scene of a written picture is still the same. Only the scene's files can have changed: settings
// and frame are in the list.
static bool is_same_scene(struct batch_run *run, const struct batch_job *job, const struct slot *slot) {
    struct session session;
    struct session_options options = cli_session_options(run->cli, job->scene);
    struct asset_store *store = asset_store_create();
    uint64_t key[2] = {0, 0};
    options.sets = job->sets;
    options.set_count = job->set_count;
    session_load(&session, &options, store);
    if (session.state == SESSION_LOADED && session.sink.errors == 0) {
        struct hash128 h;
        hash128_begin(&h);
        scene_content(&h, &session.resolved);
        hash128_end(&h, key);
    }
    session_finish(&session);
    asset_store_destroy(store);
    return key[0] == slot->scene[0] && key[1] == slot->scene[1];
}

// Removes the pictures that are written from the list.
static int leave_written(struct batch_run *run) {
    struct batch *batch = &run->batch;
    const uint32_t count = batch->jobs.count;
    const char *judged = NULL;
    uint32_t left = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct batch_job job = batch->jobs.items[i];
        struct slot slot;
        uint64_t files;
        bool is_written = take_slot(run, job.number, &slot);
        // Jobs of the same scene are consecutive.
        if (is_written && (!judged || strcmp(judged, job.scene) != 0)) {
            if (!is_same_scene(run, &job, &slot))
                return refuse(run, "is of another scene than this one");
            judged = job.scene;
        }
        is_written = is_written && hash_files(run, &job, &files) && files == slot.files;
        if (!is_written)
            batch->jobs.items[left++] = job;
    }
    batch->jobs.count = left;
    run->checkpoint.found = count - left;
    if (!run->cli->options.quiet)
        fprintf(stderr, "glint: %u of %u pictures are written already, as %s says\n", count - left, count,
                run->checkpoint.path);
    return CLI_OK;
}

static int go_on(struct batch_run *run, const struct strbuf *head) {
    struct spool *spool = &run->checkpoint.spool;
    char bytes[HEAD_BYTES];
    if (!spool_open(spool, run->checkpoint.path))
        return spool->error == ENOENT ? begin_anew(run, head) : cannot_use(run, "read");
    run->checkpoint.is_open = true;
    if (!spool_take(spool, 0, bytes, sizeof bytes) || memcmp(bytes, first_line, sizeof first_line - 1) != 0)
        return refuse(run, "is not a checkpoint of many pictures of this version of glint");
    if (head->failed || memcmp(bytes, head->data, sizeof bytes) != 0)
        return refuse(run, "is of other pictures, settings or another device than this command");
    return leave_written(run);
}

int batch_resume(struct batch_run *run) {
    struct cli *cli = run->cli;
    struct strbuf head;
    if (!cli->options.part.resume)
        return CLI_OK;
    run->checkpoint.all = run->batch.jobs.count;
    run->checkpoint.path =
        arena_format(&cli->arena, "%s" BANDS_ENDING, run->batch.jobs.items[0].paths[0]).ptr;
    strbuf_init(&head);
    put_head(run, &head);
    const int status = go_on(run, &head);
    strbuf_finish(&head);
    return status;
}

// ---- while pictures are written

void batch_note_scene(struct batch_run *run, struct batch_made *made) {
    struct hash128 h;
    made->checkpoint = run->checkpoint.is_open && !made->is_faulty ? &run->checkpoint.spool : NULL;
    if (!made->checkpoint)
        return;
    hash128_begin(&h);
    scene_content(&h, &run->live.session->resolved);
    hash128_end(&h, made->scene);
}

void batch_note_written(const struct batch_made *made) {
    struct slot slot = {.scene = {made->scene[0], made->scene[1]}};
    const uint32_t outputs = made->run->outputs.output_count;
    struct xxh64 h;
    bool written = made->checkpoint != NULL;
    xxh64_begin(&h, FILE_SEED);
    for (uint32_t i = 0; i < outputs && written; i++) {
        written = !made->files[i].failed && !made->errors[i];
        if (written)
            xxh64_add(&h, made->files[i].data, made->files[i].len);
    }
    slot.files = xxh64_end(&h);
    slot.seal = seal_of(&slot, made->job->number);
    if (written)
        spool_put(made->checkpoint, place_of(made->job->number), &slot, sizeof slot);
}

int batch_judge_checkpoint(struct batch_run *run) {
    return run->checkpoint.is_open && run->checkpoint.spool.error ? cannot_use(run, "written") : CLI_OK;
}

int batch_stopped(struct batch_run *run) {
    struct batch_checkpoint *c = &run->checkpoint;
    if (!c->is_open)
        return cli_interrupted(run->cli);
    if (!spool_settle(&c->spool))
        return cannot_use(run, "written");
    fprintf(stderr, "glint: stopped: %u of %u pictures are written; the same command with --resume goes on\n",
            c->found + run->counts.written - run->counts.faulty, c->all);
    return CLI_STOPPED;
}

void batch_end_resume(struct batch_run *run, bool whole) {
    if (run->checkpoint.is_open && whole)
        spool_remove(&run->checkpoint.spool);
    else
        spool_close(&run->checkpoint.spool);
}
