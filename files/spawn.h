// Starts another program, found by PATH. Signals that this one ignores are not ignored by it.
#ifndef GLINT_FILES_SPAWN_H
#define GLINT_FILES_SPAWN_H

#include <stdbool.h>
#include <sys/types.h>

struct sandbox;

// What the program has as standard input, output and error; -1: what this one has.
struct spawn_streams {
    int in, out, err;
};

// `words`, the first of which is the program's name, end with NULL. `own_group`: Ctrl-C does not reach it.
// Returns 0, or errno with *child 0. The caller waits for *child.
int spawn(pid_t *child, const char *const *words, const struct spawn_streams *streams, bool own_group);
// The same for a program that may only read (sandbox.h: sandbox_only_read). Call it while only one thread
// runs.
int spawn_reader(pid_t *child, const char *const *words, const struct spawn_streams *streams,
                 const struct sandbox *limits);

#endif
