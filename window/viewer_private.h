// Inside of the viewer: what the files viewer*.c share. Thread safety: as viewer.h.
#ifndef GLINT_WINDOW_VIEWER_PRIVATE_H
#define GLINT_WINDOW_VIEWER_PRIVATE_H

#include "core/parallel.h"
#include "core/timeline.h"
#include "scene/hits.h"
#include "tracer/gpu/gpu_screen.h"
#include "window/canvas.h"
#include "window/viewer.h"

// What is shown of each pixel.
enum viewer_mode {
    VIEWER_COLOR,
    VIEWER_NORMALS,
    VIEWER_DEPTH,
    VIEWER_COST,  // rays that the first hit sends
    VIEWER_ERROR, // the standard error of the samples' mean
    VIEWER_MODES,
};

enum {
    VIEWER_ACTIONS = 16
};

// A picture that is being made or shown.
struct viewer_picture {
    struct image image;
    uint32_t samples; // 0: none yet
    struct render_statistics statistics;
    double seconds; // per sample of all pixels
};

// Steps of a load, in their order.
enum viewer_step {
    VIEWER_READS_TEXT,
    VIEWER_READS_FILES, // meshes and images
    VIEWER_BUILDS,
    VIEWER_COMPILES,
    VIEWER_STEPS,
};

// A load that is going on.
struct viewer_loading {
    struct timeline timeline; // says how far the load is
    struct parallel_looker looker;
    enum viewer_step step;
    double rest;     // of the step: 1 at its beginning, half as much after each loop
    double fraction; // of the loop that goes on
    double paused;   // clock: the bar is not drawn again before
};

struct viewer {
    const struct viewer_wish *wish;
    const struct viewer_host *host;
    struct gpu *gpu;
    struct window *window;
    struct live *live;
    struct gpu_screen *screen;
    struct canvas canvas;
    struct steer steer;
    uint32_t camera;        // index of the scene's camera that the view began with
    struct view scene;      // through that camera, as in the scene
    struct view_camera eye; // the camera that is looked through
    uint32_t width, height; // of the window
    struct viewer_picture shown, next;
    double *squares;        // per pixel, of the samples' differences, for VIEWER_ERROR
    float *before;          // the mean of the samples before
    struct hit_pixel *hits; // of the shown picture's pixels, for modes that need them
    bool has_hits;
    uint8_t *bytes; // displayed, as large as `byte_room`
    size_t byte_room;
    enum viewer_mode mode;
    bool hides_overlay, shows_keys;
    bool is_stale;  // what is shown is not what the eye sees
    bool is_coarse; // it has fewer pixels than the window
    bool is_broken; // the files have errors
    bool quits;
    bool wants_write; // the picture, once it has all pixels and the scene's samples
    struct steer_action actions[VIEWER_ACTIONS]; // that were seen while a picture was made
    uint32_t action_count;
    double pixel_seconds; // per sample of a pixel
    double moved;         // clock: when the eye moved last
    double stepped;       // clock: time of the last step
    bool has_changed;     // a file of the scene has changed
    double shown_speed;   // speed of flight that the window's text states
    struct viewer_loading loading;
    char said[256]; // about what was clicked, or done
};

// viewer_look.c: sets up a picture of this size and number of samples. false: see gpu_error.
bool viewer_set_up(struct viewer *v, uint32_t width, uint32_t height, uint32_t samples);
// The first hits of what is shown. false: see gpu_error.
bool viewer_find_hits(struct viewer *v);

// viewer_load.c: live_load, with its progress shown in the window.
void viewer_begin_loads(struct viewer *v);
enum live_state viewer_load(struct viewer *v);

// viewer_draw.c: a picture of few pixels, with one sample. false: see gpu_error.
bool viewer_draw_coarse(struct viewer *v);
// Draws the next samples of the whole picture, until something happens. false: see gpu_error.
bool viewer_draw_more(struct viewer *v);
bool viewer_is_finished(const struct viewer *v);
void viewer_drop_pictures(struct viewer *v);

// viewer_show.c: shows the current picture, with text over it. false: see gpu_error.
bool viewer_show(struct viewer *v);

// viewer_act.c: does what new events ask for. Returns whether there were any.
bool viewer_act(struct viewer *v);
// Writes the picture, if wanted and whole. false: see gpu_error.
bool viewer_write(struct viewer *v);

// viewer_events.c: events become actions and a steered camera.
void viewer_take_events(struct viewer *v);
// Whether something happened for which a picture under way must stop. Events are acted on later, by
// viewer_act.
bool viewer_is_disturbed(struct viewer *v);
// Whether a file has changed since the scene was loaded.
bool viewer_has_changed(struct viewer *v);
// Moves the eye back to the scene's camera.
void viewer_go_back(struct viewer *v);

#endif
