#include "window/viewer.h"

#include "core/clock.h"
#include "core/heap.h"
#include "grammar/ir.h"
#include "window/viewer_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define QUIET_SECONDS 0.01 // a file that is being written is taken as whole after this time
#define STILL_SECONDS 0.06 // the eye is taken to rest after this time
#define IDLE_SECONDS  0.02 // between two checks for changed files, when all is done

// ---- the scene

static bool is_same_camera(const struct view_camera *a, const struct view_camera *b) {
    return vec3_is_zero(vec3_sub(a->position, b->position)) &&
           vec3_is_zero(vec3_sub(a->forward, b->forward)) && vec3_is_zero(vec3_sub(a->up, b->up)) &&
           a->tan_half_fov == b->tan_half_fov && a->projection == b->projection &&
           a->half_height == b->half_height && a->half_field == b->half_field &&
           a->lens_radius == b->lens_radius && a->focus == b->focus;
}

// The eye stays where it is, unless its camera was changed in the file.
static void take_scene(struct viewer *v) {
    const struct view_camera old = v->scene.camera;
    struct session *session = v->live->session;
    const uint32_t count = session->scene->cameras.count;
    if (v->camera >= count)
        v->camera = 0;
    v->scene = v->live->shot.view;
    struct view view;
    if (v->camera != v->live->camera && count && session_view(session, v->camera, &view))
        v->scene.camera = view.camera;
    if (!is_same_camera(&old, &v->scene.camera))
        viewer_go_back(v);
    v->said[0] = '\0';
    v->is_stale = true;
    v->has_hits = false;
}

// false: the device failed.
static bool reload(struct viewer *v) {
    v->has_changed = false;
    const enum live_state state = viewer_load(v);
    if (state == LIVE_FAILED)
        return false;
    v->is_broken = state == LIVE_BROKEN;
    if (!v->is_broken)
        take_scene(v);
    v->host->loaded(v->host->context, v->live, v->is_broken);
    return v->is_broken ? viewer_set_up(v, v->width, v->height, 1) && viewer_show(v) : true;
}

// ---- the window

static bool take_size(struct viewer *v) {
    uint32_t width, height;
    window_size(v->window, &width, &height);
    if (width == v->width && height == v->height)
        return true;
    v->width = width;
    v->height = height;
    viewer_drop_pictures(v);
    steer_resize(&v->steer, height, 2 * atan(v->eye.tan_half_fov));
    v->is_stale = true;
    return true;
}

static bool is_hidden(const struct viewer *v) {
    return v->width == 0 || v->height == 0;
}

// ---- the loop

// Draws what is left to draw when nothing else happens. false: the device failed.
static bool draw(struct viewer *v, bool has_acted) {
    if (is_hidden(v))
        return true;
    const bool moves = steer_is_flying(&v->steer) || clock_seconds() - v->moved < STILL_SECONDS;
    if (v->is_stale)
        return viewer_draw_coarse(v) && viewer_show(v);
    if (has_acted && !viewer_show(v))
        return false;
    return moves || viewer_is_finished(v) || viewer_draw_more(v);
}

static double time_to_wait(const struct viewer *v) {
    if (is_hidden(v))
        return IDLE_SECONDS;
    if (v->is_stale || steer_is_flying(&v->steer))
        return 0;
    return viewer_is_finished(v)                        ? IDLE_SECONDS
           : clock_seconds() - v->moved < STILL_SECONDS ? STILL_SECONDS
                                                        : 0;
}

static bool step(struct viewer *v) {
    window_wait(v->window, time_to_wait(v));
    const bool has_acted = viewer_act(v);
    if (!take_size(v))
        return false;
    if (viewer_has_changed(v)) {
        watch_settle(v->live->watch, QUIET_SECONDS);
        if (!reload(v))
            return false;
    }
    if (!v->quits && !draw(v, has_acted))
        return false;
    return viewer_write(v);
}

static double extent_of(const struct session *session) {
    vec3 lower, upper;
    return scene_bounds(&session->resolved, &lower, &upper) ? vec3_length(vec3_sub(upper, lower)) : 1;
}

static enum viewer_status begin(struct viewer *v) {
    v->screen = gpu_screen_create(v->gpu, window_make_surface, v->window);
    if (!v->screen)
        return VIEWER_DEVICE;
    viewer_begin_loads(v);
    const enum live_state state = viewer_load(v);
    if (state != LIVE_SHOWN)
        return state == LIVE_BROKEN ? VIEWER_BROKEN : VIEWER_DEVICE;
    v->camera = v->live->camera;
    v->scene = v->live->shot.view;
    v->eye = v->scene.camera;
    steer_begin(&v->steer, (struct steer_pose){0}, (vec3){0, 1, 0}, extent_of(v->live->session));
    const struct ir_image *image = v->live->session->image;
    window_resize(v->window, (uint32_t)image->width, (uint32_t)image->height);
    window_size(v->window, &v->width, &v->height);
    viewer_go_back(v);
    v->host->loaded(v->host->context, v->live, false);
    return VIEWER_DONE;
}

enum viewer_status viewer_run(const struct viewer_wish *wish, const struct viewer_host *host, struct gpu *gpu,
                              struct window *window, struct live *live) {
    struct viewer *v = heap_zeroed(1, sizeof *v);
    if (!v)
        return VIEWER_NO_MEMORY;
    *v = (struct viewer){.wish = wish, .host = host, .gpu = gpu, .window = window, .live = live};
    enum viewer_status status = begin(v);
    v->stepped = clock_seconds();
    while (status == VIEWER_DONE && !v->quits && !host->is_over(host->context))
        if (!step(v))
            status = VIEWER_DEVICE;
    gpu_screen_destroy(gpu, v->screen);
    viewer_drop_pictures(v);
    canvas_finish(&v->canvas);
    free(v->bytes);
    free(v);
    return status;
}
