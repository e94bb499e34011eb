// A job: what is asked for of a picture goes in; the picture comes out, and all that is known of it.
//
// The scene, the camera, a part of the picture, its samples, a device or the reference: who asks fills in
// what is wished, opens the job, draws, and takes what it wants of what came out. Every picture that glint
// writes is drawn so, by itself or as one of many that a live scene shows. Errors: enum shot_status; faults
// of the scene are in the session's sink, those of the device in gpu_error; SHOT_NO_MEMORY is said nowhere.
// Ownership: job_close frees all but session, gpu and what lies in the arena, whose guard the caller sets,
// and accepts zeroes. A job stays where it is while it is open. Thread safety: the gpu's thread.
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

// How long it may take until the files are written.
struct job_time {
    double begun;   // clock: when the program started
    double seconds; // 0: as long as it takes
    uint32_t files; // that are written
    // Encodes the picture as for its files, and says how many bytes they have.
    size_t (*encode)(void *context);
    void *context;
};

struct job_wish {
    bool by_reference;      // the reference draws, else a device
    bool as_file, no_cache; // of the reference: reference_shot.h
    int32_t frames;         // that a picture is drawn for, to time it; 0: one
    bool counts;            // its rays are counted
    bool audits;            // the picture states its own error
    double max_off;    // the share of pixels that the audit is to decide about; below 0: it decides nothing
    uint32_t aovs;     // bits of enum aov
    bool in_picture;   // they are layers of the picture
    int32_t band_rows; // of a picture in bands; 0: as many as take a few seconds
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
    struct part part;       // what is drawn of the picture; where it has some of the samples, they come here
    bool is_part, in_bands; // is_part: less than the picture, or a file of parts
    // What comes out.
    uint32_t camera;
    struct image image;
    bool is_scaled; // the image: it was drawn smaller
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
    struct ir_image *image_made; // the session's, with the samples that there was time for
};

// A program without devices (docs/decisions/install.md) draws by the reference, and leaves the rest out.
static inline bool job_by_reference(const struct job *job) {
    return !CLI_HAS_DEVICES || job->wish.by_reference;
}

// ---- job.c: what draws

enum shot_status job_open(struct job *job, uint32_t camera);
// Another camera of the same session.
enum shot_status job_turn(struct job *job, uint32_t camera);
// Draws what a live scene shows, which has been loaded.
void job_follow(struct job *job, struct live *live);
void job_close(struct job *job);
// Before the next picture.
void job_drop_layers(struct job *job);
// At the job's part, which has changed since the job was opened.
enum shot_status job_aim(struct job *job);
// One frame, into an image of the part's size; its statistics are in stats.last.
enum shot_status job_frame(struct job *job, struct image *image, const struct render_progress *progress);
// How far all of some frames, or bands, are, where `done` are and one is under way.
struct job_share {
    const struct render_progress *all;
    uint32_t done, count;
};
struct render_progress job_share_progress(struct job_share *share);
// Rows of a band of the picture.
uint32_t job_band_rows(const struct job *job);

// ---- job_draw.c: the job's picture

// Into job->image. `pictures` share the time that is left, this one included.
enum shot_status job_draw(struct job *job, uint32_t pictures, const struct render_progress *progress);
// Where pixels end by their error: the picture states what is known of it, and nothing else so far.
void job_state_estimate(struct job *job);
// The picture's own error, if it is wished for: in the statistics, and stated by the picture.
enum shot_status job_audit(struct job *job, const struct render_progress *progress);
// What else is known of its pixels, if that is wished for.
enum shot_status job_make_layers(struct job *job, const struct render_progress *progress);
// Counts the picture's rays, if that is wished for and was not done while it was drawn.
enum shot_status job_count(struct job *job);
// A smaller picture, to this size. false: no memory.
bool job_scale_up(struct job *job, uint32_t width, uint32_t height);

// ---- job_tell.c: what is known of it

// Of where pixels ended; NULL: they do not end by their error.
const struct render_estimate *job_estimate(const struct job *job);
struct image_display job_display(const struct job *job);
// How the picture was made, for a file of this format.
struct provenance job_provenance(const struct job *job, enum image_format format, struct image_coding coding);
// What the file of a part says of how it was made, besides its place.
void job_describe_part(struct job *job, struct part *part);
// All of it, as text or as JSON.
void job_report(struct job *job, bool is_json, struct strbuf *out);

#endif
