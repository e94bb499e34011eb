// Work cut into pieces of a fixed size, so that results never depend on the number of threads; and work that
// runs alongside its caller's.
#ifndef GLINT_CORE_PARALLEL_H
#define GLINT_CORE_PARALLEL_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

typedef void parallel_body(void *context, size_t begin, size_t end);

// Calls `body` for [0, count) in pieces of `piece` items (the last may be smaller), on all processors;
// returns when all are done. Pieces run in any order and at the same time: `body` writes only what
// belongs to its items. `piece` is at least 1. An arena is not shared: a guard belongs to the
// thread that runs the work. Calls inside `body` share the processors: threads do not multiply. Falls back to
// the calling thread if no thread can be made.
void parallel_for(size_t count, size_t piece, parallel_body *body, void *context);
// An observer of a thread's work: called on that thread after each piece that it took, with the number of
// items taken so far of its outermost loop of several pieces. It must leave the work alone, and its own calls
// of parallel_for are not observed. NULL: none. Ownership: the observer is its caller's.
struct parallel_looker {
    void (*look)(void *context, size_t done, size_t count);
    void *context;
};
void parallel_look(const struct parallel_looker *looker);
// Processors that this process may use, at least 1.
unsigned parallel_processors(void);

// Work that runs alongside its caller's until the caller waits for it: a file that is decoded, a device that
// is opened. It is for work that cannot be cut into pieces together with other work: what can be uses
// parallel_for.
//
// The work has one thread of its own; a parallel_for inside it takes no other. With a single processor, or if
// no thread can be made, it runs when it is waited for, so its results must not depend on when it runs. It
// reads only what exists before parallel_start and does not change until parallel_wait, and writes only what
// nobody reads until then; it has its own arenas and guards them itself, so no jump leaves its thread. It
// prints and reports nothing: errors are among its results, and its caller reports them in their turn.
// Ownership: the task and its context stay where they are until parallel_wait; a zeroed task was never
// started. Thread safety: start and wait belong to one thread.
typedef void parallel_work(void *context);
struct parallel_task {
    parallel_work *work; // NULL: nothing is left to wait for
    void *context;
    bool has_thread;
    atomic_bool over;
    pthread_t thread;
};
void parallel_start(struct parallel_task *task, parallel_work *work, void *context);
// Returns when the work is done. Does nothing for a task that was not started, or was already waited for.
void parallel_wait(struct parallel_task *task);
// Whether parallel_wait would return at once.
bool parallel_is_over(struct parallel_task *task);

// Between taking the lock and giving it back, one thread at a time may change shared data.
struct parallel_lock {
    pthread_mutex_t mutex;
};
void parallel_lock_begin(struct parallel_lock *lock);
void parallel_lock_take(struct parallel_lock *lock);
void parallel_lock_give(struct parallel_lock *lock);
void parallel_lock_end(struct parallel_lock *lock);

#endif
