#include "render/shot.h"
#include "diag/codes/device.h"
#include "diag/codes/limit.h"

#include "core/clock.h"
#include "core/ranges.h"
#include "grammar/ir.h"
#include "load/session_precision.h"
#include "load/where.h"
#include "reference/reference.h"

struct opening {
    struct shot *shot;
    bool asked;            // the trial that `auto` makes has asked for the pixels
    double waited_seconds; // for them
};

static bool ask(void *context) {
    struct opening *opening = context;
    const struct shot_wish *wish = &opening->shot->wish;
    const double start = clock_seconds();
    opening->asked = true;
    const bool goes_on = !wish->ready || wish->ready(wish->ready_context);
    opening->waited_seconds = clock_seconds() - start;
    return goes_on;
}

static enum shot_status flatten_shot(struct opening *opening, struct precision_gains *gains) {
    struct shot *shot = opening->shot;
    struct session *s = shot->session;
    double start = clock_seconds();
    struct flat_input input = precision_input(s, &shot->view);
    input.keep = shot->wish.keep;
    input.sharing = gpu_info(shot->gpu)->has_double && !shot->wish.copies ? FLAT_CHEAPER : FLAT_COPIES;
    const struct precision_wish wish = {.reference = shot->wish.audits ? &shot->reference : NULL,
                                        .ready = shot->wish.ready ? ask : NULL,
                                        .ready_context = opening,
                                        .choice = shot->wish.choice};
    const enum precision_status status =
        precision_choose(s, &input, shot->gpu, gpu_info(shot->gpu)->has_double, wish, gains);
    bool good = status == PRECISION_DONE;
    if (good && gains->has_flat)
        shot->flat = gains->flat;
    else
        good = good && flatten(&input, &shot->flat);
    gains->flat = (struct flat_scene){0};
    shot->flatten_seconds += clock_seconds() - start - opening->waited_seconds;
    return good                         ? SHOT_OK
           : status == PRECISION_DEVICE ? SHOT_DEVICE
           : status == PRECISION_ENDED  ? SHOT_ENDED
                                        : SHOT_SCENE;
}

enum shot_status shot_no_memory(struct session *session, const char *what) {
    session_no_memory(session, what);
    return SHOT_SCENE;
}

static void show(const void *context, const float *linear, size_t pixels, float *shown) {
    const struct image_display *display = context;
    image_to_displayed(linear, pixels, *display, shown);
}

// Aims at a part of the picture.
static void aim(struct shot *shot) {
    const struct shot_region *region = &shot->wish.region;
    struct render_settings *settings = &shot->settings;
    settings->whole_width = settings->width;
    settings->whole_height = settings->height;
    settings->first_x = region->x;
    settings->first_y = region->y;
    settings->width = region->width;
    settings->height = region->height;
}

bool shot_fits(struct session *session, const struct shot_region *region) {
    const struct ir_image *image = session->image;
    const uint64_t pixels = region && region->width ? (uint64_t)region->width * region->height
                                                    : (uint64_t)image->width * (uint64_t)image->height;
    if (pixels <= RANGE_PIXELS_MOST)
        return true;
    session_report_pixels(session);
    return false;
}

void shot_set_up(struct shot *shot) {
    const struct session *session = shot->session;
    shot->settings = render_settings_of(&session->resolved, &shot->flat, &session->options.limits);
    shot->settings.width = (uint32_t)session->image->width;
    shot->settings.height = (uint32_t)session->image->height;
    shot->settings.samples = (uint32_t)session->image->samples;
    shot->display = image_display_of(session->image);
    shot->settings.error = session->image->error;
    shot->settings.least_samples = (uint32_t)session->image->min_samples;
    shot->settings.show = show;
    shot->settings.show_context = &shot->display;
    shot->settings.counts = shot->wish.counts;
    shot->settings.timeline = session->options.timeline;
    if (shot->wish.region.width)
        aim(shot);
}

// The scene is on the device if a trial left it there.
static enum shot_status make_renderer(struct opening *opening, struct renderer *renderer) {
    struct shot *shot = opening->shot;
    const bool waits = shot->wish.ready && !opening->asked;
    shot->settings.background_later = waits;
    shot->renderer = renderer ? renderer : renderer_create(shot->gpu, &shot->flat, &shot->settings);
    if (!shot->renderer || (renderer && !renderer_change(renderer, &shot->flat, &shot->settings)))
        return SHOT_DEVICE;
    if (waits && !ask(opening))
        return SHOT_ENDED;
    return !waits || renderer_background(shot->renderer) ? SHOT_OK : SHOT_DEVICE;
}

static enum shot_status open_shot(struct shot *shot, uint32_t camera) {
    struct opening opening = {.shot = shot};
    struct precision_gains gains;
    if (!CLI_HAS_DEVICES)
        return SHOT_DEVICE; // there is no gpu to call this with: what follows is left out of the program
    if (!session_view(shot->session, camera, &shot->view))
        return shot_no_memory(shot->session, "the view");
    if (!where_camera_fits(shot->session, camera, &shot->view) ||
        !shot_fits(shot->session, &shot->wish.region))
        return SHOT_SCENE;
    enum shot_status status = flatten_shot(&opening, &gains);
    if (status != SHOT_OK)
        return status;
    shot_set_up(shot);
    const double start = clock_seconds(), waited = opening.waited_seconds;
    status = make_renderer(&opening, gains.renderer);
    shot->upload_seconds = clock_seconds() - start - (opening.waited_seconds - waited);
    return status;
}

enum shot_status shot_open_for(struct shot *shot, struct session *session, struct gpu *gpu, uint32_t camera,
                               struct shot_wish wish) {
    *shot = (struct shot){.session = session, .gpu = gpu, .wish = wish};
    return open_shot(shot, camera);
}

enum shot_status shot_open(struct shot *shot, struct session *session, struct gpu *gpu, uint32_t camera) {
    return shot_open_for(shot, session, gpu, camera, (struct shot_wish){0});
}

// It holds for one camera position only.
static void drop_reference(struct shot *shot) {
    reference_destroy(shot->reference);
    shot->reference = NULL;
}

void shot_close(struct shot *shot) {
    if (!shot)
        return;
    drop_reference(shot);
    renderer_destroy(shot->renderer);
    flat_finish(&shot->flat);
    shot->renderer = NULL;
}

enum shot_status shot_turn(struct shot *shot, uint32_t camera) {
    struct session *session = shot->session;
    drop_reference(shot);
    if (session->scene->lights.count && shot->renderer)
        return !session_view(session, camera, &shot->view)       ? shot_no_memory(session, "the view")
               : where_camera_fits(session, camera, &shot->view) ? SHOT_OK
                                                                 : SHOT_SCENE;
    struct gpu *gpu = shot->gpu;
    const struct shot_wish wish = {.region = shot->wish.region,
                                   .counts = shot->wish.counts,
                                   .audits = shot->wish.audits,
                                   .copies = shot->wish.copies,
                                   .keep = shot->wish.keep};
    shot_close(shot);
    return shot_open_for(shot, session, gpu, camera, wish);
}

static void report_fault(struct shot *shot, enum render_fault_kind kind, const struct render_fault *fault) {
    static const char *const words[RENDER_FAULT_KINDS] = {
        [RENDER_NOT_FINITE] = WHERE_NOT_FINITE,
        [RENDER_SEGMENTS] = WHERE_OVER_SEGMENTS,
    };
    struct session *s = shot->session;
    where_report_fault(s, &(struct where_fault){.code = fault->is_nested            ? DIAG_LIMIT
                                                        : kind == RENDER_NOT_FINITE ? DIAG_NOT_FINITE
                                                                                    : DIAG_PATH_SEGMENTS,
                                                .words = fault->is_nested ? WHERE_NESTED : words[kind],
                                                .pixels = fault->pixels,
                                                .x = fault->x,
                                                .y = fault->y,
                                                .body = fault->has_body ? fault->body : HIT_NONE,
                                                .triangle = fault->triangle});
    if (fault->is_nested)
        diag_help(&s->sink, "move some of them apart, or join those of one material into one mesh");
    else if (kind == RENDER_NOT_FINITE)
        diag_help(&s->sink,
                  "they are magenta in PNG and HDR, and NaN in PFM; 'glint pick SCENE %u,%u' shows what "
                  "happens there",
                  fault->x, fault->y);
    if (kind == RENDER_SEGMENTS)
        diag_help(
            &s->sink,
            "lower trace.max_depth, raise trace.min_weight, or raise the limit with --limit path-segments=N");
}

void shot_report_faults(struct shot *shot, const struct render_fault faults[RENDER_FAULT_KINDS]) {
    for (int kind = RENDER_NOT_FINITE; kind < RENDER_FAULT_KINDS; kind++)
        if (faults[kind].pixels)
            report_fault(shot, (enum render_fault_kind)kind, &faults[kind]);
}

enum shot_status shot_take(struct shot *shot, struct image *image, const struct render_progress *progress,
                           struct render_statistics *statistics) {
    return shot_take_until(shot, image, progress, NULL, statistics);
}

enum shot_status shot_count(struct shot *shot, const struct render_progress *progress,
                            struct render_statistics *statistics) {
    struct render_settings settings = shot->settings;
    if (!CLI_HAS_DEVICES)
        return SHOT_DEVICE;
    settings.samples = statistics->samples;
    if (settings.samples != shot->settings.samples &&
        !renderer_change(shot->renderer, &shot->flat, &settings))
        return SHOT_DEVICE;
    const enum render_result result =
        renderer_count(shot->renderer, &shot->view.camera, progress, &statistics->rays);
    if (settings.samples != shot->settings.samples &&
        !renderer_change(shot->renderer, &shot->flat, &shot->settings))
        return SHOT_DEVICE;
    return shot_status_of(result);
}

static enum shot_status take(struct shot *shot, struct image *image, const struct render_progress *progress,
                             const struct render_limit *limit, struct render_statistics *statistics) {
    if (!CLI_HAS_DEVICES)
        return SHOT_DEVICE;
    return shot_status_of(
        renderer_render_until(shot->renderer, &shot->view.camera, image->rgb, progress, limit, statistics));
}

enum shot_status shot_take_silently(struct shot *shot, struct image *image,
                                    const struct render_progress *progress,
                                    struct render_statistics *statistics) {
    return take(shot, image, progress, NULL, statistics);
}

enum shot_status shot_take_until(struct shot *shot, struct image *image,
                                 const struct render_progress *progress, const struct render_limit *limit,
                                 struct render_statistics *statistics) {
    const enum shot_status status = take(shot, image, progress, limit, statistics);
    struct render_fault faults[RENDER_FAULT_KINDS];
    if (status != SHOT_OK)
        return status;
    for (int kind = 0; kind < RENDER_FAULT_KINDS; kind++) {
        faults[kind] = statistics->faults[kind];
        faults[kind].x += shot->settings.first_x;
        faults[kind].y += shot->settings.first_y;
    }
    shot_report_faults(shot, faults);
    return SHOT_OK;
}
