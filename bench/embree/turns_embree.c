// The peer on Intel's Embree as a system that takes turns: the scene's triangles and spheres, the same
// shading, rays and threads as glint, and the same reading of files and writing of pictures, by glint's own
// libraries.
//
//     turns_embree [--system embree|robust|instances] ... (turns.h)
#include "bench/embree/peer.h"
#include "bench/turns/turns.h"
#include "core/parallel.h"
#include "grammar/ir.h"
#include "load/session.h"

#include <embree3/rtcore.h>
#include <string.h>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

struct embree {
    struct peer peer;
    struct view view;
    struct peer_counts counts; // of the last frame
    uint32_t samples;
};

// As Embree's manual asks for: denormal numbers count as 0, in the threads that this one starts too.
static void flush_denormals(void) {
#ifdef __SSE__
    _mm_setcsr(_mm_getcsr() | 0x8040U);
#endif
}

static enum turns_status open_embree(void *state, const struct turns_options *o, struct session *session) {
    struct embree *e = state;
    e->samples = (uint32_t)session->image->samples;
    flush_denormals();
    if (!session_view(session, 0, &e->view))
        return turns_say(TURNS_FAILED, "not enough memory");
    for (uint32_t i = 0; i < session->resolved.material_count; i++)
        if (scene_material_is_painted(&session->resolved.materials[i]))
            return turns_say(TURNS_FAILED, "images on bodies and filtered checkers are not shown here");
    for (uint32_t i = 0; i < session->resolved.body_count; i++)
        if (session->resolved.bodies[i].shape == SCENE_CONE)
            return turns_say(TURNS_FAILED, "cylinders and cones are not shown here");
    const struct peer_wish wish = {.scene = &session->resolved,
                                   .view = &e->view,
                                   .origin = session_origin(session, &e->view),
                                   .width = (uint32_t)session->image->width,
                                   .height = (uint32_t)session->image->height,
                                   .robust = strcmp(o->system, "robust") == 0,
                                   .instances = strcmp(o->system, "instances") == 0};
    if (peer_make(&e->peer, &wish))
        return TURNS_DONE;
    const char *error = peer_error(&e->peer);
    return turns_say(TURNS_FAILED, "%s", error ? error : "Embree failed");
}

static bool take_frame(void *state, struct image *image, double *device) {
    struct embree *e = state;
    (void)device;
    e->counts = (struct peer_counts){0};
    return peer_render(&e->peer, image->width, image->height, e->samples, image->rgb, &e->counts) ||
           turns_say(TURNS_FAILED, "not enough memory") == TURNS_DONE;
}

static void write_facts(void *state, struct json_writer *w) {
    const struct embree *e = state;
    const struct peer_counts *rays = &e->counts;
    json_write_text(w, "device", STR("Embree " RTC_VERSION_STRING));
    json_write_boolean(w, "on_processor", true);
    json_write_boolean(w, "robust", e->peer.robust);
    json_write_integer(w, "threads", parallel_processors());
    json_write_integer(w, "triangles", e->peer.triangles);
    json_write_integer(w, "spheres", e->peer.sphere_count);
    json_write_real(w, "flatten_s", e->peer.flatten_seconds);
    json_write_real(w, "tree_s", e->peer.build_seconds);
    json_open_object(w, "rays");
    json_write_integer(w, "primary", rays->primary);
    json_write_integer(w, "reflected", rays->reflected);
    json_write_integer(w, "refracted", rays->refracted);
    json_write_integer(w, "shadow", rays->shadow);
    json_close_object(w);
}

static void close_embree(void *state) {
    struct embree *e = state;
    peer_finish(&e->peer);
}

int main(int argc, char **argv) {
    static const struct turns_system system = {"embree", open_embree, take_frame, write_facts, close_embree};
    static struct embree embree;
    return turns_main(argc, argv, &system, &embree);
}
