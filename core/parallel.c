// For sched_getaffinity: a container or `taskset` may allow fewer processors than are online.
#define _GNU_SOURCE

#include "core/parallel.h"

#include <assert.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdint.h>
#include <unistd.h>

enum {
    THREADS_MAX = 64
};

// How many threads a call may use: 0 is all processors. Within a piece that runs beside others, 0 is its
// thread's share, so that nested calls do not multiply their threads.
static _Thread_local unsigned share;

struct job {
    unsigned share; // of each thread
    parallel_body *body;
    void *context;
    size_t count;
    size_t piece;
    atomic_size_t next;
};

unsigned parallel_processors(void) {
    cpu_set_t allowed;
    long online = sched_getaffinity(0, sizeof allowed, &allowed) == 0 ? CPU_COUNT(&allowed)
                                                                      : sysconf(_SC_NPROCESSORS_ONLN);
    return online < 1 ? 1 : online > THREADS_MAX ? THREADS_MAX : (unsigned)online;
}

static void *work(void *argument) {
    struct job *job = argument;
    share = job->share;
    for (;;) {
        size_t begin = atomic_fetch_add(&job->next, job->piece);
        if (begin >= job->count)
            return NULL;
        size_t left = job->count - begin;
        job->body(job->context, begin, begin + (left < job->piece ? left : job->piece));
    }
}

void parallel_for(size_t count, size_t piece, parallel_body *body, void *context) {
    assert(piece > 0 && count <= SIZE_MAX / 2);
    struct job job = {.body = body, .context = context, .count = count, .piece = piece};
    pthread_t threads[THREADS_MAX];
    size_t pieces = count / piece + (count % piece != 0);
    unsigned before = share;
    unsigned wanted = before ? before : parallel_processors();
    unsigned most = pieces < wanted ? (unsigned)pieces : wanted;
    job.share = most > 1 ? (wanted + most - 1) / most : before;
    unsigned started = 0;
    while (started + 1 < wanted && started + 1 < pieces &&
           pthread_create(&threads[started], NULL, work, &job) == 0)
        started++;
    work(&job);
    share = before;
    for (unsigned i = 0; i < started; i++)
        pthread_join(threads[i], NULL);
}
