// What a program did when, and on which thread: phases with a name, a start and a length, by clock_seconds.
//
// A call with NULL in place of a timeline does nothing, so a timeline that nobody asked for costs one
// comparison. Ownership: names are constants; details are the caller's and must live as long as the timeline
// is read. Errors: phases beyond TIMELINE_MOST are only counted. Thread safety: timeline_add is safe on any
// thread; read only after all of them are done.
#ifndef GLINT_CORE_TIMELINE_H
#define GLINT_CORE_TIMELINE_H

#include "core/str.h"

#include <stdatomic.h>

enum {
    TIMELINE_MOST = 512
};

struct timeline_phase {
    const char *name;
    str detail; // a file's path; empty: none
    long thread;
    double begin, seconds; // begin: by clock_seconds
};

struct timeline {
    atomic_uint count; // may be above TIMELINE_MOST
    // Called by timeline_add, on its thread, when a phase has ended. NULL: nothing.
    void (*ended)(void *context, const char *name);
    void *context;
    struct timeline_phase phases[TIMELINE_MOST];
};

// Adds the phase `name` of this thread, which began at `begin` and ends now.
void timeline_add(struct timeline *timeline, const char *name, str detail, double begin);
// Sorts the kept phases by when they began.
unsigned timeline_sort(struct timeline *timeline);

#endif
