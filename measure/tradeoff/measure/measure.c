// What all that is measured shares: progress, time, and which rows trace the file's own rays.
#include "measure/tradeoff/measure/measure.h"

#include "core/clock.h"

double measuring_seconds(const struct measuring *s) {
    return clock_seconds() - s->begun;
}

bool measuring_step(struct measuring *s, const char *what) {
    s->step = what;
    if (s->steps_done < s->steps)
        s->steps_done++;
    return !s->progress || s->progress->report(s->progress->context, (double)s->steps_done / s->steps, what);
}

static bool report_reference(void *context, double fraction) {
    const struct measuring *s = context;
    return !s->progress || s->progress->report(s->progress->context,
                                               ((double)s->steps_done + fraction) / (s->steps + 1), s->step);
}

struct reference_progress measuring_reference_progress(struct measuring *s) {
    return (struct reference_progress){report_reference, s};
}

bool measuring_traces_as_file(const struct row *row) {
    return !(row->knobs & ~(1u << KNOB_PRECISION | 1u << KNOB_FEATURES | 1u << KNOB_ALTERNATIVE));
}

enum tradeoff_status measuring_reference_status(enum reference_result result) {
    return result == REFERENCE_DONE        ? TRADEOFF_DONE
           : result == REFERENCE_CANCELLED ? TRADEOFF_CANCELLED
                                           : TRADEOFF_MEMORY;
}
