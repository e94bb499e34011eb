// One batch while it runs: what is shown, what is read for the next job, and what is encoded for the last
// one. Private to cli/batch.
#ifndef GLINT_CLI_COMMANDS_BATCH_BATCH_RUN_H
#define GLINT_CLI_COMMANDS_BATCH_BATCH_RUN_H

#include "cli/commands/batch/batch_job.h"
#include "cli/commands/batch/film.h"
#include "cli/commands/rendering.h"
#include "cli/progress.h"
#include "core/parallel.h"
#include "files/spool.h"
#include "render/live/live.h"

// A picture that was traced, while it is encoded.
struct batch_made {
    const struct batch_run *run;
    const struct batch_job *job; // NULL: none
    struct image image;
    bool is_faulty;           // some of its pixels are
    uint64_t scene[2];        // hash of its scene
    struct spool *checkpoint; // gets it once its files are there; NULL: none
    struct image_display display;
    struct strbuf *files;      // by output; one for a film
    int *errors;               // by output: errno of writing it, or 0
    struct image_texts *texts; // by output
    struct part part;          // what is in the image, where a file of parts is written
    struct parallel_task task;
};

struct batch_reading {
    struct live *live;
    struct session_options options;
    bool again; // other jobs are of the same scene
    struct live_loaded loaded;
    struct parallel_task task;
    bool is_under_way;
};

// Which pictures of the list are written: --resume.
struct batch_checkpoint {
    bool is_open;
    const char *path;
    struct spool spool;
    uint32_t all, found; // pictures of the list; those that were written by another process
};

struct batch_counts {
    uint32_t faulty;                                 // written with faulty pixels
    uint32_t begun, written, failed, skipped, loads; // a picture with faulty pixels is written and failed
    uint32_t meshes_read, images_read, trees_built, trees_kept, pipelines_made, precision_asked;
    double trace_seconds, device_seconds; // of frames; until the device was open
};

struct batch_run {
    struct cli *cli;
    struct batch batch;
    struct rendering outputs; // what the command line says of them
    struct live live;
    struct batch_checkpoint checkpoint;
    struct film film;
    struct image sheet;
    struct image_display sheet_display;
    struct progress progress;
    struct batch_reading next;
    struct batch_made made[2];
    struct live_loaded pending; // read, and not yet shown: --skip-done may need nothing of it
    struct batch_counts counts;
    const struct batch_job *first_failed;
    int worst; // the worst exit code of those that failed
    // Findings that were reported: for which scene and load, and how many.
    const char *told_scene;
    uint32_t told_load, told_count;
    bool is_load_good, is_pending;
    // The part of a job's picture to render: planned once per job, because planning reports mistakes.
    uint32_t planned; // 1 + the job's number; 0: none
    int plan_status;
};

// batch_made.c: pictures after tracing
void batch_encode(struct batch_run *run, struct batch_made *made);
// Waits until the picture is encoded and written; a film or a sheet gets it now. Returns an exit code;
// made->job is then NULL.
int batch_write(struct batch_run *run, struct batch_made *made);
int batch_write_sheet(struct batch_run *run);
// batch_resume.c: all do nothing without --resume
// Once the device is open: removes the pictures that are written from the list, which may then be empty. An
// exit code.
int batch_resume(struct batch_run *run);
// In turn: call it while the session is still that of this picture; call it when its files are there, on the
// thread that wrote them; whether the checkpoint could be written, as an exit code.
void batch_note_scene(struct batch_run *run, struct batch_made *made);
void batch_note_written(const struct batch_made *made);
int batch_judge_checkpoint(struct batch_run *run);
// After a signal: says what is there. An exit code.
int batch_stopped(struct batch_run *run);
// `whole`: nothing is left to go on with.
void batch_end_resume(struct batch_run *run, bool whole);
// batch_report.c: --stats and the last line
// A picture that failed, after its findings.
void batch_tell_failure(const struct batch_run *run, const struct batch_job *job);
void batch_tell(const struct batch_run *run);
int batch_stats(const struct batch_run *run);

#endif
