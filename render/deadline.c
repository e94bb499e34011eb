#include "render/deadline.h"

#include <math.h>

void deadline_begin(struct deadline *d, double now, double end) {
    *d = (struct deadline){.end = end, .begun = now};
}

void deadline_end_sample(struct deadline *d, double now) {
    d->before = d->last;
    d->last = now - d->begun;
    d->samples++;
}

void deadline_begin_sample(struct deadline *d, double now) {
    d->begun = now;
}

static double after(const struct deadline *d, unsigned samples) {
    return d->after + samples * d->after_a_sample;
}

bool deadline_fits(const struct deadline *d, double now) {
    return now + fmax(d->last, d->before) + after(d, d->samples + 1) <= d->end;
}

bool deadline_is_over(const struct deadline *d, double now) {
    return now + after(d, d->samples) > d->end;
}
