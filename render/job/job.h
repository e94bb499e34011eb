// A job: the request for a picture goes in; the picture and all that is known of it come out.
//
// The caller fills in the request (scene, camera, part of the picture, samples, device or reference), opens
// the job, draws, and takes the results that it wants. Every picture that glint writes is drawn this way, by
// itself or as one of many that a live scene shows. Errors: enum shot_status; faults of the scene are in the
// session's sink, those of the device in gpu_error; SHOT_NO_MEMORY is reported nowhere. Ownership: job_close
// frees all but session, gpu, a followed live scene and what lies in the arena, whose guard the caller sets;
// it accepts a zeroed job. An open job must not be moved. Thread safety: the gpu's thread.
#ifndef GLINT_RENDER_JOB_JOB_H
#define GLINT_RENDER_JOB_JOB_H

#include "render/aov/layers.h"
#include "render/deadline.h"
#include "render/live/live.h"
#include "render/parts/part_file.h"
#include "render/record/provenance.h"
#include "render/reference_shot.h"
#include "render/shot.h"
#include "render/stats/stats.h"

// How long it may take until the files are written, in seconds.
struct job_time {
    double begun;   // clock: when the program started
    double seconds; // 0: no limit
    uint32_t files; // number of files written
    // Encodes the picture as for its files; returns their size in bytes.
    size_t (*encode)(void *context);
    void *context;
};

struct job_wish {
    bool by_reference;      // the reference draws, else a device
    bool as_file, no_cache; // of the reference: reference_shot.h
    int32_t frames;         // drawn per picture, to time it; 0: one
    bool counts;            // its rays are counted
    bool audits;            // the picture states its own error
    double max_off;         // the share of pixels off that the audit must decide on; below 0: it need not
    uint32_t aovs;          // bits of enum aov
    bool in_picture;        // they are layers of the picture
    int32_t band_rows;      // rows of a band; 0: as many as take about a second
    struct job_time time;
    struct timeline *timeline;    // may be NULL
    bool (*ready)(void *context); // as in shot_wish
    void *ready_context;
};

struct job {
    // What is asked for.
    struct session *session;
    struct gpu *gpu; // NULL: by the reference
    struct arena *arena;
    struct job_wish wish;
    struct part part;       // what is drawn; if it lacks some samples, part.rgb gets each of its samples
    bool is_part, in_bands; // is_part: less than the picture, or a file of parts
    // What comes out.
    uint32_t camera;
    struct image image;
    bool is_scaled; // the image was drawn smaller
    struct stats stats;
    struct strbuf note;       // what the picture states of itself; empty: nothing
    struct strbuf audit_note; // what the audit says of it
    struct layers *layers;    // NULL: none
    // What draws it.
    struct shot *shot; // its own, or a live scene's
    struct shot own;
    struct reference_shot reference;
    struct reference_statistics reference_statistics;
    struct deadline deadline;
    struct ir_image *image_made; // copy of the session's, with the samples that there was time for
};

// A program without devices (docs/decisions/install.md) draws by the reference, and leaves the rest out.
static inline bool job_by_reference(const struct job *job) {
    return !CLI_HAS_DEVICES || job->wish.by_reference;
}

// ---- job.c: what draws

// `camera` is an index of session_camera. Leaves a job that job_close accepts, whatever the status.
enum shot_status job_open(struct job *job, uint32_t camera);
// Turns to another camera of the same session.
enum shot_status job_turn(struct job *job, uint32_t camera);
// Draws what a live scene shows; the scene has been loaded.
void job_follow(struct job *job, struct live *live);
void job_close(struct job *job);
// Frees the layers, before the next picture.
void job_drop_layers(struct job *job);
// Aims at the job's part, which has changed since the job was opened.
enum shot_status job_aim(struct job *job);
// Draws one frame, into an image of the part's size; its statistics go to stats.last, or
// reference_statistics.
enum shot_status job_frame(struct job *job, struct image *image, const struct render_progress *progress);
// Progress of several frames or bands: `done` of `count` are finished and one is under way.
struct job_share {
    const struct render_progress *all;
    uint32_t done, count;
};
struct render_progress job_share_progress(struct job_share *share);
// Rows of a band of the picture, a multiple of 8.
uint32_t job_band_rows(const struct job *job);

// ---- job_draw.c: the job's picture

// Draws into job->image, made by the caller with the part's size. `pictures`: how many share the time that is
// left, this one included.
enum shot_status job_draw(struct job *job, uint32_t pictures, const struct render_progress *progress);
// Makes the picture's note: if pixels end by their error, what is known of it; else nothing so far.
void job_state_estimate(struct job *job);
// Measures the picture's own error, if wished for (not by the reference): into the statistics, and added to
// the note.
enum shot_status job_audit(struct job *job, const struct render_progress *progress);
// Makes job->layers, if wished for.
enum shot_status job_make_layers(struct job *job, const struct render_progress *progress);
// Counts the picture's rays, if wished for and not done while it was drawn.
enum shot_status job_count(struct job *job);
// Enlarges job->image to this size, in pixels. false: no memory.
bool job_scale_up(struct job *job, uint32_t width, uint32_t height);

// ---- job_tell.c: what is known of it

// Where pixels ended, owned by the shot; NULL: they do not end by their error.
const struct render_estimate *job_estimate(const struct job *job);
// How the session displays its picture.
struct image_display job_display(const struct job *job);
// How the picture was made, for a file of this format.
struct provenance job_provenance(const struct job *job, enum image_format format, struct image_coding coding);
// Fills in what a part's file says of how it was made, besides its place. By a device only.
void job_describe_part(struct job *job, struct part *part);
// Appends the statistics to `out`, as text or as JSON.
void job_report(struct job *job, bool is_json, struct strbuf *out);

#endif
