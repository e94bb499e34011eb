// For gettid.
#define _GNU_SOURCE

#include "core/timeline.h"

#include "core/clock.h"

#include <stdlib.h>
#include <unistd.h>

void timeline_add(struct timeline *timeline, const char *name, str detail, double begin) {
    if (!timeline)
        return;
    const unsigned at = atomic_fetch_add(&timeline->count, 1);
    if (at < TIMELINE_MOST)
        timeline->phases[at] =
            (struct timeline_phase){name, detail, gettid(), begin, clock_seconds() - begin};
    if (timeline->ended)
        timeline->ended(timeline->context, name);
}

// Of two phases that began together, the longer one contains the other.
static int compare(const void *a, const void *b) {
    const struct timeline_phase *x = a, *y = b;
    if (x->begin != y->begin)
        return x->begin < y->begin ? -1 : 1;
    return x->seconds > y->seconds ? -1 : x->seconds < y->seconds;
}

unsigned timeline_sort(struct timeline *timeline) {
    const unsigned count = timeline->count < TIMELINE_MOST ? timeline->count : TIMELINE_MOST;
    qsort(timeline->phases, count, sizeof *timeline->phases, compare);
    return count;
}
