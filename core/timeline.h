// What a program did when, and on which thread: phases with a name, a start and a length, by clock_seconds.
//
// A call with NULL in place of a timeline does nothing, so that what is not asked for costs a comparison.
// Ownership: names are constants, details the caller's, which live as long as the timeline is read. Errors:
// phases beyond TIMELINE_MOST are only counted. Thread safety: timeline_add is safe on any thread; reading is
// for when all of them are done.
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

// The phase `name`, of this thread, which began at `begin` and ends now.
void timeline_add(struct timeline *timeline, const char *name, str detail, double begin);
// The phases that are kept, in the order of their beginning.
unsigned timeline_sort(struct timeline *timeline);

#endif
