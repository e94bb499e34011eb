// A session through one camera on a device: view, flat scene and renderer together.
//
// Errors: shot_open returns a status; faults of the scene are in the session's sink, those of the device in
// gpu_error. Ownership: shot_close frees all except session and gpu, which must outlive the shot.
// Thread safety: the gpu's thread.
#ifndef GLINT_RENDER_SHOT_H
#define GLINT_RENDER_SHOT_H

#include "load/session.h"
#include "picture/write/image.h"
#include "tracer/render/render.h"

enum shot_status {
    SHOT_OK,
    SHOT_SCENE,  // the sink has errors
    SHOT_DEVICE, // see gpu_error
    SHOT_CANCELLED,
    SHOT_NO_MEMORY, // the sink does not say so
    SHOT_ENDED,     // shot_wish.ready did not want to go on
};

struct precision_choice;

// Of a picture, in pixels.
struct shot_region {
    uint32_t x, y, width, height;
};

struct shot_wish {
    struct shot_region region; // that is rendered; width 0: all of the picture
    bool counts;               // after each frame its rays are counted: render_statistics has them
    bool audits;               // the reference that chose the precision is kept for render/audit.h
    bool copies;               // each model has triangles of its own, even where instances are cheaper
    // For a session that is not settled: called once everything is done that needs no pixels of the
    // background; it settles the session. false: the shot is not opened. NULL: the session is settled.
    bool (*ready)(void *context);
    void *ready_context;
    struct precision_choice *choice; // takes what the trial of `auto` found; NULL: not asked
    struct bvh_keep *keep; // of the trees, for a scene that changes (render/live); NULL: all are built
};

struct shot {
    struct session *session;
    struct shot_wish wish;
    struct gpu *gpu;
    struct view view;
    struct flat_scene flat;
    struct render_settings settings;
    struct image_display display;
    struct renderer *renderer;
    struct reference *reference; // of the view; NULL: none was needed, or it was not to be kept
    double flatten_seconds, upload_seconds;
};

// `camera` is an index of session_camera. Leaves a shot that shot_close accepts, whatever the status.
enum shot_status shot_open(struct shot *shot, struct session *session, struct gpu *gpu, uint32_t camera);
// The same, with wishes beyond a picture.
enum shot_status shot_open_for(struct shot *shot, struct session *session, struct gpu *gpu, uint32_t camera,
                               struct shot_wish wish);
void shot_close(struct shot *shot);
// The status of what a renderer has done.
static inline enum shot_status shot_status_of(enum render_result result) {
    return result == RENDER_DONE ? SHOT_OK : result == RENDER_CANCELLED ? SHOT_CANCELLED : SHOT_DEVICE;
}
// Whether all pixels of the region, or of the picture, can be held at once. false: an error in the sink.
bool shot_fits(struct session *session, const struct shot_region *region);
// Takes the settings, and how the picture is displayed, from the session, for the flat scene as it is.
void shot_set_up(struct shot *shot);
// Reports in the sink that there is no memory for `what`; returns SHOT_SCENE.
enum shot_status shot_no_memory(struct session *session, const char *what);
// Looks through another camera of the same session; only the lights of a scene without lights must be
// flattened again.
enum shot_status shot_turn(struct shot *shot, uint32_t camera);
// One frame into `image`, which has the session's size. Faulty pixels become errors in the session's sink.
enum shot_status shot_take(struct shot *shot, struct image *image, const struct render_progress *progress,
                           struct render_statistics *statistics);

// Counts the rays of the last frame, by tracing it once more: its statistics get them.
enum shot_status shot_count(struct shot *shot, const struct render_progress *progress,
                            struct render_statistics *statistics);

// Like shot_take, but faults stay in the statistics, with pixels counted from the first of the shot's region.
enum shot_status shot_take_silently(struct shot *shot, struct image *image,
                                    const struct render_progress *progress,
                                    struct render_statistics *statistics);
// Makes faults, by kind, errors in the session's sink; their pixels are those of the whole picture.
void shot_report_faults(struct shot *shot, const struct render_fault faults[RENDER_FAULT_KINDS]);

// Like shot_take, until `limit` ends it: statistics->samples says how many samples the picture has. NULL: it
// has all.
enum shot_status shot_take_until(struct shot *shot, struct image *image,
                                 const struct render_progress *progress, const struct render_limit *limit,
                                 struct render_statistics *statistics);

#endif
