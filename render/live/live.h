// A scene that is shown while it is written: session, flat scene and renderer that follow the files.
//
// live_load reloads everything but repeats only the work that it must: it does not read a mesh whose file is
// the same, build a tree over the same boxes, write to the device what is there already, or compile a kernel
// again. A scene with errors changes nothing: the previous one is still shown.
// Two things are decided when the geometry is loaded and stay while it is edited: the place that coordinates
// are relative to, and the precision that `auto` chooses. So after the first camera moved, a picture may be
// rounded differently from that of a program that has just started.
//
// Input: options as for a session; a device. Errors: enum live_state. Ownership: live_finish frees all but
// the device, and accepts a live that live_begin refused. Thread safety: the gpu's thread.
#ifndef GLINT_RENDER_LIVE_LIVE_H
#define GLINT_RENDER_LIVE_LIVE_H

#include "files/watch.h"
#include "measure/precision.h"
#include "render/shot.h"
#include "tracer/bvh/keep.h"

struct live_wish {
    struct session_options session; // what it points to outlives the live
    str camera;                     // as session_camera has it
    bool polls;                     // files are looked at from time to time, without inotify
    // Each of many pictures gets the bytes that a program that has just started would give it: the origin
    // and, unless live->follows, the precision are chosen for each. No file is watched.
    bool alone;
    // Called by live_load when all files are read, before anything is made of them. NULL: nothing.
    void (*is_read)(void *context);
    void *context;
};

enum live_state {
    LIVE_SHOWN,  // the shot is that of the files
    LIVE_BROKEN, // live->broken has findings; the shot, if there is one, is that of the last good scene
    LIVE_FAILED, // the device: see gpu_error. There is no shot any more
};

// What a load did. Times in seconds.
struct live_change {
    uint32_t meshes_read, images_read;
    uint32_t trees_built, trees_kept;
    uint32_t pipelines_made;
    uint32_t precision_asked;     // 1: `auto` made a trial
    struct render_update written; // to the device
    bool is_whole; // everything was made anew: the first time, and if the precision was chosen again
    double read_seconds, assets_seconds, flatten_seconds, upload_seconds;
    double seconds; // of all
};

struct live {
    struct live_wish wish;
    struct gpu *gpu;
    struct asset_store *store;
    struct bvh_keep *keep;
    struct watch *watch;
    struct session *session; // of the shot; NULL: there is none yet
    struct session *broken;  // the last one loaded, if it has errors
    struct shot shot;
    uint32_t camera; // index in the session of the one that the wish names
    vec3 origin;     // that coordinates are relative to
    // The next session shows what the shot's does, a moment later: the choice of `auto` is kept if it was
    // clear and the measures stay similar (live_precision.c).
    bool follows;
    bool is_asked; // `choice` is what the last trial found; `kept` sessions have used it since
    uint32_t kept;
    struct precision_choice choice;
    struct precision_report measured; // of the session, where has_measured
    bool has_measured;
    struct live_change change; // of the last load
    struct session_kept *text; // of the last scene that is read again; NULL: none
    str unkept;                // the path of one that could not be kept
    uint32_t loads;
};

// A session that was read for a live scene, and what reading it took.
struct live_loaded {
    struct session *session; // NULL: no memory
    uint32_t meshes_read, images_read;
};

// false: no memory.
bool live_begin(struct live *live, const struct live_wish *wish, struct gpu *gpu);
void live_finish(struct live *live);
// Reads everything again. Whatever the result, the files that it read are watched from now on.
enum live_state live_load(struct live *live);
// The two halves of live_load, for a scene and settings that change. live_read may run on another thread
// during a frame of the shot, one call at a time; pass its result to live_show or live_drop.
// `again`: the same files are read for other scenes too, so their text is kept.
struct live_loaded live_read(struct live *live, const struct session_options *options, bool again);
enum live_state live_show(struct live *live, struct live_loaded loaded, str camera);
void live_drop(struct live_loaded loaded);
// Turns to another camera of the session that is shown; if none has this name, the shot stays.
enum live_state live_turn(struct live *live, str camera);
// After the first picture: compiles what further ones would wait for. false: see gpu_error.
bool live_warm(struct live *live);
// The findings of the last load: of the broken session, else of the good one.
struct session *live_findings(struct live *live);

#endif
