// A time at which work must be over: whether another sample fits, and whether the one under way still does.
//
// Pure: the caller passes the time. A sample is expected to take as long as the longest of the last two.
// Units: seconds of any clock. Thread safety: one thread.
#ifndef GLINT_RENDER_DEADLINE_H
#define GLINT_RENDER_DEADLINE_H

#include <stdbool.h>

struct deadline {
    double end;            // when all must be over
    double after;          // what comes after the last sample takes
    double after_a_sample; // and how much of it each sample adds
    double begun;          // the sample under way
    double last, before;   // what the last sample took, and the one before; 0: there was none
    unsigned samples;      // made
};

void deadline_begin(struct deadline *deadline, double now, double end);
// The sample under way is made. What happens from now to the next deadline_begin_sample is not its time.
void deadline_end_sample(struct deadline *deadline, double now);
void deadline_begin_sample(struct deadline *deadline, double now);
// Whether one more sample, begun now, would be over in time.
bool deadline_fits(const struct deadline *deadline, double now);
// Whether no time is left for the sample under way.
bool deadline_is_over(const struct deadline *deadline, double now);

#endif
