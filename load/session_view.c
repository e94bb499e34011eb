// What other code asks of a loaded session: the input for its assets, cameras and lights.
#include "diag/codes/reference.h"
#include "load/session.h"

#include "core/nearest.h"
#include "core/strbuf.h"
#include "grammar/ir.h"

struct assets_input session_assets_input(struct session *session) {
    return (struct assets_input){.scene = session->scene,
                                 .origin = &session->origin,
                                 .sources = &session->sources,
                                 .files = &session->files,
                                 .limits = &session->options.limits,
                                 .sink = &session->sink,
                                 .arena = &session->arena,
                                 .pixels_later = session->options.pixels_later,
                                 .timeline = session->options.timeline};
}

uint32_t session_camera(struct session *session, str name) {
    const struct ir_cameras *cameras = &session->scene->cameras;
    if (name.len == 0)
        return 0;
    struct nearest search = nearest_begin(name);
    struct strbuf all;
    strbuf_init(&all);
    for (uint32_t i = 0; i < cameras->count; i++) {
        if (str_equal(cameras->items[i].name, name)) {
            strbuf_finish(&all);
            return i;
        }
        nearest_offer(&search, cameras->items[i].name);
        strbuf_format(&all, "%s'%.*s'", i ? ", " : "", STR_ARG(cameras->items[i].name));
    }
    span at = ir_place_label(&session->origin, &session->scene->head);
    diag_add(&session->sink, DIAG_UNKNOWN_CAMERA, (span){at.source, 0, 0}, "the scene has no camera '%.*s'",
             STR_ARG(name));
    if (nearest_best(&search).len)
        diag_help(&session->sink, "did you mean '%.*s'?", STR_ARG(nearest_best(&search)));
    else if (all.len)
        diag_help(&session->sink, "the scene's cameras are %.*s", STR_ARG(strbuf_view(&all)));
    else
        diag_help(&session->sink, "the scene has no cameras; leave out --camera to use the automatic one");
    strbuf_finish(&all);
    return IR_NO_INDEX;
}

struct viewing {
    struct session *session;
    uint32_t camera;
    struct view *view;
};

static void make_view(void *context) {
    const struct viewing *v = context;
    struct session *session = v->session;
    view_build(&session->resolved, v->camera, session->image->width, session->image->height, &session->arena,
               &session->sink, v->view);
}

bool session_view(struct session *session, uint32_t camera, struct view *view) {
    struct viewing viewing = {session, camera, view};
    return arena_guarded(&session->arena, make_view, &viewing) == ARENA_FAULT_NONE;
}

vec3 session_origin(const struct session *session, const struct view *view) {
    return session->scene->cameras.count ? session->scene->cameras.items[0].position : view->camera.position;
}
