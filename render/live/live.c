#include "render/live/live.h"

#include "core/clock.h"
#include "core/heap.h"
#include "grammar/ir.h"
#include "load/session_kept.h"
#include "load/session_precision.h"
#include "load/where.h"
#include "render/live/live_precision.h"

#include <math.h>
#include <stdlib.h>

// A camera farther from the origin than this, in flat units (the scene's bodies are within 2), gets an origin
// of its own: else what is close to it would be rounded as coarsely as what is far.
#define ORIGIN_REACH 4.0

// ---- beginning and end

bool live_begin(struct live *live, const struct live_wish *wish, struct gpu *gpu) {
    *live = (struct live){.wish = *wish, .gpu = gpu};
    live->store = asset_store_create();
    live->keep = bvh_keep_create();
    live->watch = wish->alone ? NULL : watch_create(wish->polls);
    return live->store && live->keep && (live->watch || wish->alone);
}

static void drop_session(struct session **session) {
    if (*session)
        session_finish(*session);
    free(*session);
    *session = NULL;
}

void live_finish(struct live *live) {
    if (!live)
        return;
    shot_close(&live->shot);
    drop_session(&live->session);
    drop_session(&live->broken);
    session_kept_release(live->text);
    watch_destroy(live->watch);
    bvh_keep_destroy(live->keep);
    asset_store_destroy(live->store);
}

struct session *live_findings(struct live *live) {
    return live->broken ? live->broken : live->session;
}

// ---- what is watched

static void watch_reads(struct live *live, const struct session *session) {
    for (uint32_t i = 0; i < session->files.log.count; i++)
        watch_add(live->watch, &session->files.log.items[i]);
    for (uint32_t i = 0; i < session->files.missed.count; i++)
        watch_add_missing(live->watch, session->files.missed.items[i]);
}

// Loading a scene with errors may stop before it has read all files of the good one, so those are watched
// too.
static void watch_all(struct live *live, const struct session *loaded) {
    watch_begin(live->watch);
    watch_reads(live, loaded);
    watch_add_now(live->watch, live->wish.session.path);
    for (uint32_t i = 0; live->session && i < live->session->files.log.count; i++)
        watch_add_now(live->watch, live->session->files.log.items[i].path);
}

// ---- counters

// Files read are counted in live_loaded, because reading may run in parallel with what is counted here.
static struct live_change counters_of(const struct live *live) {
    return (struct live_change){.trees_built = bvh_keep_built(live->keep),
                                .trees_kept = bvh_keep_found(live->keep),
                                .pipelines_made = gpu_pipelines_made(live->gpu)};
}

static void count_since(struct live *live, const struct live_change *before) {
    const struct live_change now = counters_of(live);
    struct live_change *change = &live->change;
    change->trees_built = now.trees_built - before->trees_built;
    change->trees_kept = now.trees_kept - before->trees_kept;
    change->pipelines_made = now.pipelines_made - before->pipelines_made;
}

// ---- from a session to a shot

static enum live_state state_of(enum shot_status status) {
    return status == SHOT_OK ? LIVE_SHOWN : status == SHOT_DEVICE ? LIVE_FAILED : LIVE_BROKEN;
}

// Opens a new shot, in the same place, because there are pointers into it. If the scene makes this fail, the
// old shot stays.
static enum live_state open_whole(struct live *live, struct session *session, uint32_t camera) {
    const bool asks = session->scene->trace.precision == IR_PRECISION_AUTO;
    const struct shot_wish wish = {.keep = live->keep, .choice = asks ? &live->choice : NULL};
    struct shot old = live->shot;
    live->change.is_whole = true;
    live->change.precision_asked = asks;
    live->is_asked = asks;
    live->has_measured = false;
    live->kept = 0;
    const enum shot_status status = shot_open_for(&live->shot, session, live->gpu, camera, wish);
    if (status != SHOT_OK) {
        shot_close(&live->shot);
        live->shot = old;
        return state_of(status);
    }
    shot_close(&old);
    live->origin = session_origin(session, &live->shot.view);
    live->change.flatten_seconds = live->shot.flatten_seconds;
    live->change.upload_seconds = live->shot.upload_seconds;
    return LIVE_SHOWN;
}

// Whether `auto` might choose another precision: it looks at bodies more than at how they are lit.
static bool is_other_geometry(struct live *live, const struct live_loaded *loaded, uint32_t camera) {
    const struct session *old = live->session, *session = loaded->session;
    if (old->scene->trace.precision != session->scene->trace.precision)
        return true;
    if (session->scene->trace.precision != IR_PRECISION_AUTO)
        return false;
    if (loaded->meshes_read || old->resolved.body_count != session->resolved.body_count)
        return true;
    const bool keeps = !live->wish.alone || live_keeps_precision(live, loaded->session, camera);
    live->kept += keeps;
    return !keeps;
}

static vec3 choose_origin(const struct live *live, const struct session *session, const struct view *view) {
    if (live->wish.alone)
        return session_origin(session, view);
    const struct flat_scene *flat = &live->shot.flat;
    const vec3 way = vec3_sub(view->camera.position, flat->origin);
    const bool is_near = flat->is_double || ldexp(vec3_length(way), flat->scale_exponent) <= ORIGIN_REACH;
    return is_near ? live->origin : session_origin(session, view);
}

static bool flatten_again(struct live *live, struct session *session, const struct view *view,
                          struct flat_scene *flat) {
    struct flat_input input = precision_input(session, view);
    input.origin = choose_origin(live, session, view);
    input.is_double = live->shot.flat.is_double;
    input.sharing = gpu_info(live->gpu)->has_double ? FLAT_CHEAPER : FLAT_COPIES;
    input.keep = live->keep;
    input.before = &live->shot.flat;
    const double start = clock_seconds();
    const bool done = flatten(&input, flat);
    live->change.flatten_seconds = clock_seconds() - start;
    if (done)
        live->origin = input.origin;
    return done;
}

// Reuses the old shot for the new session.
static enum live_state renew(struct live *live, struct session *session, uint32_t camera) {
    struct shot *shot = &live->shot;
    struct flat_scene flat, old = shot->flat;
    struct view view;
    if (!session_view(session, camera, &view)) {
        shot_no_memory(session, "the view");
        return LIVE_BROKEN;
    }
    if (!where_camera_fits(session, camera, &view) || !shot_fits(session, NULL) ||
        !flatten_again(live, session, &view, &flat))
        return LIVE_BROKEN;
    shot->session = session;
    shot->view = view;
    shot->flat = flat;
    shot_set_up(shot);
    const double start = clock_seconds();
    const bool done =
        renderer_update(shot->renderer, &old, &shot->flat, &shot->settings, &live->change.written);
    live->change.upload_seconds = clock_seconds() - start;
    flat_take(&shot->flat, &old);
    flat_finish(&old);
    return done ? LIVE_SHOWN : LIVE_FAILED;
}

// ---- loading

static bool is_good(const struct session *session) {
    return session->state == SESSION_LOADED && session->sink.errors == 0;
}

static enum live_state show(struct live *live, const struct live_loaded *loaded, str name) {
    struct session *session = loaded->session;
    if (!is_good(session))
        return LIVE_BROKEN;
    const uint32_t camera = session_camera(session, name);
    if (camera == IR_NO_INDEX)
        return LIVE_BROKEN;
    const enum live_state state =
        !live->session || !live->shot.renderer || is_other_geometry(live, loaded, camera)
            ? open_whole(live, session, camera)
            : renew(live, session, camera);
    if (state == LIVE_SHOWN)
        live->camera = camera;
    return state;
}

// The scene's text, kept; NULL: it is not kept, or cannot be.
static struct session_kept *keep_text(struct live *live, const struct session_options *options) {
    if (live->text && session_kept_fits(live->text, options))
        return live->text;
    session_kept_release(live->text);
    live->text = NULL;
    if (!str_equal(live->unkept, options->path))
        live->text = session_keep(options);
    if (!live->text)
        live->unkept = options->path;
    return live->text;
}

struct live_loaded live_read(struct live *live, const struct session_options *options, bool again) {
    struct session_options own = *options;
    const struct asset_reads before = asset_store_reads(live->store);
    struct live_loaded loaded = {.session = heap_zeroed(1, sizeof *loaded.session)};
    if (!loaded.session)
        return loaded;
    own.kept = again ? keep_text(live, options) : NULL;
    session_load(loaded.session, &own, live->store);
    const struct asset_reads now = asset_store_reads(live->store);
    loaded.meshes_read = now.meshes - before.meshes;
    loaded.images_read = now.images - before.images;
    return loaded;
}

void live_drop(struct live_loaded loaded) {
    drop_session(&loaded.session);
}

enum live_state live_show(struct live *live, struct live_loaded loaded, str camera) {
    const struct live_change before = counters_of(live);
    live->change = (struct live_change){.meshes_read = loaded.meshes_read, .images_read = loaded.images_read};
    live->loads++;
    drop_session(&live->broken);
    if (!loaded.session)
        return LIVE_BROKEN;
    live->change.read_seconds = loaded.session->read_seconds;
    live->change.assets_seconds = loaded.session->assets_seconds;
    const enum live_state state = show(live, &loaded, camera);
    count_since(live, &before);
    if (state == LIVE_SHOWN) {
        drop_session(&live->session);
        live->session = loaded.session;
        bvh_keep_sweep(live->keep);
    } else {
        live->broken = loaded.session;
        live->has_measured = false; // it was measured for this session
    }
    return state;
}

enum live_state live_turn(struct live *live, str name) {
    const struct live_change before = counters_of(live);
    live->change = (struct live_change){0};
    drop_session(&live->broken);
    const uint32_t camera = session_camera(live->session, name);
    if (camera == IR_NO_INDEX)
        return LIVE_BROKEN;
    const enum shot_status status = shot_turn(&live->shot, camera);
    count_since(live, &before);
    if (status == SHOT_OK)
        live->camera = camera;
    return state_of(status);
}

enum live_state live_load(struct live *live) {
    const double start = clock_seconds();
    const struct live_loaded loaded = live_read(live, &live->wish.session, false);
    if (loaded.session)
        watch_all(live, loaded.session);
    if (live->wish.is_read)
        live->wish.is_read(live->wish.context);
    const enum live_state state = live_show(live, loaded, live->wish.camera);
    live->change.seconds = clock_seconds() - start;
    return state;
}

bool live_warm(struct live *live) {
    return renderer_warm(live->shot.renderer);
}
