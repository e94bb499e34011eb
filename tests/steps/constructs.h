// Files that say one thing n times: what a writer, a generator or an attacker repeats.
//
// Thread safety: constant data.
#ifndef GLINT_TESTS_STEPS_CONSTRUCTS_H
#define GLINT_TESTS_STEPS_CONSTRUCTS_H

#include <stdbool.h>

// A part of a file. In `each`, '@' is the number of the repetition, from 0, and '^' a number that is never
// the same twice.
struct piece {
    const char *file; // NULL: as the piece before
    const char *once;
    const char *each; // n times after it; NULL: nothing
};

enum {
    PIECES_MAX = 6
};

struct construct {
    const char *name;
    unsigned n;           // the smaller count
    const char *constant; // an option with which the work is only bounded by a constant; NULL: none
    struct piece pieces[PIECES_MAX]; // the first one's file is the scene
};

extern const struct construct constructs[]; // a row without a name at the end

#endif
