#include "render/preview/preview.h"

#include "core/clock.h"
#include "core/heap.h"
#include "grammar/ir.h"
#include "render/live/live.h"
#include "render/reference_shot.h"

#include <math.h>
#include <stdlib.h>

#define LEAST_GAIN  1.5 // in width and height, from which a further picture is worth its time
#define WHOLE_SHARE 0.8 // share of them above which the whole picture is made: it is seldom late

struct preview {
    const struct preview_devices *devices;
    bool is_asked; // the devices were asked
    struct gpu *gpu;
    char *path; // of the scene that `live` is about
    size_t path_length;
    struct live live;
    bool is_live;
    struct session *session; // of the reference's last picture
};

struct preview *preview_create(const struct preview_devices *devices) {
    struct preview *preview = heap_zeroed(1, sizeof *preview);
    if (preview)
        preview->devices = devices;
    return preview;
}

static void drop_session(struct preview *p) {
    live_drop((struct live_loaded){.session = p->session});
    p->session = NULL;
}

static void drop_live(struct preview *p) {
    drop_session(p);
    if (p->is_live)
        live_finish(&p->live);
    p->is_live = false;
    free(p->path);
    p->path = NULL;
}

static void drop_device(struct preview *p) {
    drop_live(p);
    if (p->gpu)
        p->devices->close(p->devices->context, p->gpu);
    p->gpu = NULL;
}

void preview_destroy(struct preview *preview) {
    if (!preview)
        return;
    drop_device(preview);
    free(preview);
}

void preview_picture_finish(struct preview_picture *picture) {
    strbuf_finish(&picture->png);
}

struct session *preview_findings(struct preview *preview) {
    return preview->session ? preview->session : preview->is_live ? live_findings(&preview->live) : NULL;
}

const char *preview_device(const struct preview *preview) {
    return preview->gpu ? gpu_info(preview->gpu)->name : "reference";
}

// ---- how long

// One picture on its way.
struct drawing {
    const atomic_bool *cancelled;
    double end;            // clock
    bool has_sample;       // of all pixels
    uint32_t samples;      // that are wanted, then those that were made
    uint32_t samples_most; // that there is time for, by what the first picture took
    struct image image;
};

// Draws what `drawing` says. SHOT_CANCELLED: by the caller, or there was no time for one sample.
typedef enum shot_status draw_one(struct preview *preview, void *context, struct drawing *drawing);

static bool report(void *context, double fraction) {
    const struct drawing *d = context;
    (void)fraction;
    return !*d->cancelled && (d->has_sample || clock_seconds() < d->end);
}

static bool goes_on(void *context, uint32_t samples, const float *rgb) {
    struct drawing *d = context;
    (void)samples;
    (void)rgb;
    d->has_sample = true;
    return !*d->cancelled && clock_seconds() < d->end;
}

static bool is_over(void *context) {
    const struct drawing *d = context;
    return clock_seconds() >= d->end;
}

static uint32_t part_of(int32_t size, double share) {
    const double part = floor(size * share + 0.5);
    return part < 1 ? 1 : (uint32_t)fmin(part, size);
}

static bool begin(struct drawing *d, const struct preview_wish *wish, double share) {
    d->end = clock_seconds() + wish->seconds;
    return image_init(&d->image, part_of(wish->session.width, share), part_of(wish->session.height, share));
}

// What is asked for, or as much of it as there is time for. The caller finishes the image, whatever the
// status.
static enum shot_status draw_in_time(struct preview *p, const struct preview_wish *wish,
                                     const atomic_bool *cancelled, draw_one *draw, void *context,
                                     struct drawing *made) {
    const double begun = clock_seconds();
    *made = (struct drawing){.cancelled = cancelled, .samples = 1, .samples_most = 1};
    if (!begin(made, wish, 1.0 / PREVIEW_SHRINK))
        return SHOT_SCENE;
    enum shot_status status = draw(p, context, made);
    const double gain = sqrt(wish->seconds / fmax(clock_seconds() - begun, 1e-6));
    if (status != SHOT_OK || gain < LEAST_GAIN)
        return status;
    struct drawing rest = {.cancelled = cancelled, .samples = (uint32_t)wish->session.samples};
    const double share = gain / PREVIEW_SHRINK;
    rest.samples_most = (uint32_t)fmin(fmax(share * share, 1), PREVIEW_SAMPLES_MOST);
    status = begin(&rest, wish, share < WHOLE_SHARE ? share : 1) ? draw(p, context, &rest) : SHOT_SCENE;
    struct image *left = status == SHOT_OK ? &made->image : &rest.image;
    image_finish(left);
    if (status == SHOT_OK)
        *made = rest;
    // If there was no time for more, the first picture stays.
    return status == SHOT_CANCELLED && !*cancelled ? SHOT_OK : status;
}

static enum preview_state state_of(enum shot_status status, const atomic_bool *cancelled) {
    return status == SHOT_OK          ? PREVIEW_DRAWN
           : status != SHOT_CANCELLED ? PREVIEW_NO_MEMORY
           : *cancelled               ? PREVIEW_CANCELLED
                                      : PREVIEW_SLOW;
}

static enum preview_state keep(struct preview_picture *picture, struct image_display display,
                               const struct drawing *made) {
    picture->width = made->image.width;
    picture->height = made->image.height;
    picture->samples = made->samples;
    image_encode(&made->image, IMAGE_PNG, display, &picture->png);
    return picture->png.failed ? PREVIEW_NO_MEMORY : PREVIEW_DRAWN;
}

// ---- by the device

static enum shot_status draw_by_device(struct preview *p, void *context, struct drawing *d) {
    struct shot *shot = context;
    struct render_statistics statistics = {0};
    const struct render_progress progress = {report, d};
    const struct render_limit limit = {.goes_on = goes_on, .is_over = is_over, .context = d};
    (void)p;
    shot->settings.width = d->image.width;
    shot->settings.height = d->image.height;
    shot->settings.samples = d->samples;
    shot->settings.error = 0;
    if (!renderer_change(shot->renderer, &shot->flat, &shot->settings))
        return SHOT_DEVICE;
    const enum render_result result = renderer_render_until(shot->renderer, &shot->view.camera, d->image.rgb,
                                                            &progress, &limit, &statistics);
    d->samples = statistics.samples;
    return shot_status_of(result);
}

static enum preview_state take_by_device(struct preview *p, const struct preview_wish *wish,
                                         const atomic_bool *cancelled, struct preview_picture *picture,
                                         bool *failed) {
    struct drawing made = {.cancelled = cancelled};
    const enum live_state shown =
        live_show(&p->live, live_read(&p->live, &wish->session, false), wish->camera);
    *failed = shown == LIVE_FAILED;
    if (shown != LIVE_SHOWN)
        return p->live.broken ? PREVIEW_BROKEN : PREVIEW_NO_MEMORY;
    // Or the first picture would wait for what the second begins in.
    *failed = p->live.change.is_whole && !live_warm(&p->live);
    if (*failed || *cancelled)
        return PREVIEW_CANCELLED;
    const enum shot_status status = draw_in_time(p, wish, cancelled, draw_by_device, &p->live.shot, &made);
    *failed = status == SHOT_DEVICE;
    enum preview_state state = state_of(status, cancelled);
    if (state == PREVIEW_DRAWN)
        state = keep(picture, p->live.shot.display, &made);
    picture->by_device = true;
    image_finish(&made.image);
    return state;
}

// ---- by the reference

static enum shot_status draw_by_reference(struct preview *p, void *context, struct drawing *d) {
    struct reference_shot *shot = context;
    struct reference_statistics statistics;
    const struct reference_progress progress = {report, d};
    (void)p;
    if (d->samples > d->samples_most)
        d->samples = d->samples_most;
    shot->settings.width = d->image.width;
    shot->settings.height = d->image.height;
    shot->settings.samples = d->samples;
    return reference_shot_take(shot, &d->image, NULL, &progress, &statistics);
}

static enum preview_state take_by_reference(struct preview *p, const struct preview_wish *wish,
                                            const atomic_bool *cancelled, struct preview_picture *picture) {
    struct drawing made = {.cancelled = cancelled};
    struct reference_shot shot;
    drop_session(p);
    p->session = live_read(&p->live, &wish->session, false).session;
    struct session *session = p->session;
    if (!session)
        return PREVIEW_NO_MEMORY;
    if (session->state != SESSION_LOADED || session->sink.errors)
        return PREVIEW_BROKEN;
    const uint32_t camera = session_camera(session, wish->camera);
    if (camera == IR_NO_INDEX)
        return PREVIEW_BROKEN;
    enum shot_status status = reference_shot_open(
        &shot, session, camera, (struct reference_shot_options){.as_file = true, .no_cache = true});
    if (status != SHOT_OK) {
        reference_shot_close(&shot);
        return PREVIEW_BROKEN;
    }
    // Before timing starts: the tree is made once, for all pictures of this scene.
    if (!reference_source_get(&shot.source))
        status = SHOT_SCENE;
    else if (!*cancelled)
        status = draw_in_time(p, wish, cancelled, draw_by_reference, &shot, &made);
    else
        status = SHOT_CANCELLED;
    enum preview_state state = state_of(status, cancelled);
    const struct image_display display = image_display_of(session->image);
    if (state == PREVIEW_DRAWN)
        state = keep(picture, display, &made);
    image_finish(&made.image);
    reference_shot_close(&shot);
    return state;
}

// ---- the whole

static bool begin_live(struct preview *p, const struct preview_wish *wish) {
    const str path = wish->session.path;
    if (p->is_live && p->path && str_equal((str){p->path, p->path_length}, path))
        return true;
    drop_live(p);
    p->path = heap_text_of(path.ptr, path.len);
    p->path_length = path.len;
    // Each picture says what must be read.
    const struct live_wish live = {0};
    p->is_live = p->path != NULL;
    return p->is_live && live_begin(&p->live, &live, p->gpu);
}

static void ask_for_device(struct preview *p) {
    if (!p->is_asked && p->devices)
        p->gpu = p->devices->open(p->devices->context);
    p->is_asked = true;
}

enum preview_state preview_draw(struct preview *preview, const struct preview_wish *wish,
                                const atomic_bool *cancelled, struct preview_picture *picture) {
    *picture = (struct preview_picture){0};
    strbuf_init(&picture->png);
    ask_for_device(preview);
    if (!begin_live(preview, wish)) {
        drop_live(preview);
        return PREVIEW_NO_MEMORY;
    }
    if (preview->gpu) {
        bool failed;
        const enum preview_state state = take_by_device(preview, wish, cancelled, picture, &failed);
        if (!failed)
            return state;
        drop_device(preview);
        preview_picture_finish(picture);
        return preview_draw(preview, wish, cancelled, picture);
    }
    return take_by_reference(preview, wish, cancelled, picture);
}
