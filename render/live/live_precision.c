#include "render/live/live_precision.h"

#include "grammar/ir.h"
#include "load/session_precision.h"
#include "scene/shape.h"

// A trial counts pixels that differ; single precision is chosen where few do. An answer holds for further
// frames only if it was clear: an eighth of that, or eight times as many.
#define CLEAR 8
// The factor by which measures may become finer or coarser than they were at the trial.
#define ROOM 2.0
// A camera that turns by more from frame to frame shows something else: cosine of 20 degrees.
#define SAME_VIEW 0.94

enum {
    KEPT_MOST = 15 // frames that follow one trial: materials and lights are not measured
};

static bool is_clear(const struct precision_choice *choice) {
    const double most = PRECISION_SHARE * PRECISION_PART;
    return choice->needs_double ? choice->share >= CLEAR * most : choice->share * CLEAR <= most;
}

static bool is_like(const struct precision_report *was, const struct precision_report *now, bool is_double) {
    for (int i = 0; i < PRECISION_FEATURES; i++) {
        const struct precision_measure *a = &was->least[i], *b = &now->least[i];
        if (a->any != b->any ||
            (a->any && (is_double ? b->steps > ROOM * a->steps : b->steps * ROOM < a->steps)))
            return false;
    }
    return true;
}

// What is measured depends only on the bodies and on where the camera is.
static bool is_measured(const struct live *live, const struct session *session,
                        const struct flat_input *input) {
    const struct scene *was = &live->session->resolved, *is = &session->resolved;
    const struct view *before = &live->shot.view;
    bool same = live->has_measured && was->body_count == is->body_count &&
                vec3_is_zero(vec3_sub(before->camera.position, input->view->camera.position)) &&
                vec3_is_zero(vec3_sub(session_origin(live->session, before), input->origin));
    for (uint32_t i = 0; i < is->body_count && same; i++)
        same = shape_is_same(&was->bodies[i], &is->bodies[i]);
    return same;
}

struct looking {
    struct live *live;
    struct session *session;
    uint32_t camera;
    bool keeps;
};

static void look(void *context) {
    struct looking *l = context;
    struct live *live = l->live;
    struct session *session = l->session;
    const struct precision_choice *choice = &live->choice;
    struct precision_report now;
    struct view view;
    view_build(&session->resolved, l->camera, session->image->width, session->image->height, &session->arena,
               NULL, &view);
    const struct flat_input input = precision_input(session, &view);
    if (vec3_dot(view.camera.forward, live->shot.view.camera.forward) < SAME_VIEW)
        return;
    if (is_measured(live, session, &input))
        now = live->measured;
    else if (!precision_measure(&input, &now))
        return;
    live->measured = now;
    live->has_measured = true;
    // Large scenes are only measured, never traced.
    l->keeps = choice->traced ? is_like(&choice->report, &now, choice->needs_double)
                              : now.suffices == !choice->needs_double;
}

bool live_keeps_precision(struct live *live, struct session *session, uint32_t camera) {
    struct looking looking = {live, session, camera, false};
    const struct ir_image *was = live->session->image, *now = session->image;
    const bool is_same = live->session->resolved.body_count == session->resolved.body_count &&
                         was->width == now->width && was->height == now->height && was->tone == now->tone &&
                         was->transfer == now->transfer && was->exposure == now->exposure;
    if (!live->follows || !is_same || !live->is_asked || live->kept >= KEPT_MOST ||
        (live->choice.traced && !is_clear(&live->choice)))
        return false;
    return arena_guarded(&session->arena, look, &looking) == ARENA_FAULT_NONE && looking.keeps;
}
