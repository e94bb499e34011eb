// What happened since the viewer looked last.
#include "window/viewer_private.h"

// Takes the events since the last time, and what they ask for; those for which there is no room are left for
// later.
void viewer_take_events(struct viewer *v) {
    struct steer_event event;
    while (v->action_count < VIEWER_ACTIONS && window_next(v->window, &event)) {
        const struct steer_action action = steer_event(&v->steer, &event);
        if (action.what != STEER_NOTHING)
            v->actions[v->action_count++] = action;
    }
}

bool viewer_has_changed(struct viewer *v) {
    v->has_changed = v->has_changed || watch_look(v->live->watch);
    return v->has_changed;
}

bool viewer_is_disturbed(struct viewer *v) {
    uint32_t width, height;
    window_wait(v->window, 0);
    viewer_take_events(v);
    window_size(v->window, &width, &height);
    return v->action_count > 0 || v->steer.has_turned || steer_is_flying(&v->steer) || width != v->width ||
           height != v->height || v->host->is_over(v->host->context) || viewer_has_changed(v);
}
