// A time at which work must be over: whether another sample fits, and whether the one under way still does.
//
// Pure: whoever asks says what time it is. A sample is expected to take as long as the longest of the last
// two. Units: seconds of any clock. Thread safety: one thread.
#ifndef GLINT_RENDER_DEADLINE_H
#define GLINT_RENDER_DEADLINE_H

#include <stdbool.h>

struct deadline {
    double end;            // when all must be over
    double after;          // what comes after the last sample takes
    double after_a_sample; // and how much of it each sample adds
    double begun;          // the sample under way
    double last, before;   // what the last samples took; 0: none was made
    unsigned samples;      // made
};

void deadline_begin(struct deadline *deadline, double now, double end);
// The sample under way is made. What happens from now to the next deadline_begin_sample is not its time.
void deadline_end_sample(struct deadline *deadline, double now);
void deadline_begin_sample(struct deadline *deadline, double now);
// Whether one more sample, begun now, would be over in time.
bool deadline_fits(const struct deadline *deadline, double now);
// Whether nothing of the sample under way fits any more.
bool deadline_is_over(const struct deadline *deadline, double now);

#endif
