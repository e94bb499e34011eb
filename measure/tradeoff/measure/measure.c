// What all measurements share: progress, time, and which rows trace the file's own rays.
#include "measure/tradeoff/measure/measure.h"

#include "core/clock.h"

#include <math.h>

double measuring_seconds(const struct measuring *s) {
    return clock_seconds() - s->begun;
}

bool measuring_is_late(struct measuring *s) {
    s->late |= s->deadline > 0 && clock_seconds() > s->deadline;
    return s->late;
}

bool measuring_report(struct measuring *s, double steps) {
    // If a budget ends the work, it may end before all steps are done.
    const double budget = s->out->options.budget_s;
    const double of_steps = steps / (s->steps + 1), of_time = budget > 0 ? measuring_seconds(s) / budget : 0;
    return !s->progress ||
           s->progress->report(s->progress->context, fmax(of_steps, fmin(of_time, 1)), s->step);
}

bool measuring_step(struct measuring *s, const char *what) {
    s->step = what;
    if (s->steps_done < s->steps)
        s->steps_done++;
    return measuring_report(s, s->steps_done);
}

static bool report_reference(void *context, double fraction) {
    struct measuring *s = context;
    return !measuring_is_late(s) && measuring_report(s, s->steps_done + fraction);
}

struct reference_progress measuring_reference_progress(struct measuring *s) {
    return (struct reference_progress){report_reference, s};
}

struct reference_settings measuring_all_paths(const struct measuring *s, const struct ir_image *image) {
    const struct scene *scene = s->input->scene;
    struct reference_settings full = reference_settings_of(scene->ir, image, s->input->limits, false);
    if (scene_amplifies(scene)) {
        full.max_depth = (uint32_t)scene->ir->trace.max_depth;
        full.cut_sees_background = scene->ir->trace.depth_limit == IR_DEPTH_BACKGROUND;
    }
    return full;
}

bool measuring_traces_as_file(const struct row *row) {
    return !(row->knobs & ~(1u << KNOB_PRECISION | 1u << KNOB_FEATURES | 1u << KNOB_ALTERNATIVE));
}

enum tradeoff_status measuring_reference_status(enum reference_result result) {
    return result == REFERENCE_DONE        ? TRADEOFF_DONE
           : result == REFERENCE_CANCELLED ? TRADEOFF_CANCELLED
                                           : TRADEOFF_MEMORY;
}
