#include "core/parallel.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

enum { THREADS_MAX = 64 };

struct job {
    parallel_body *body;
    void *context;
    size_t count;
    size_t piece;
    atomic_size_t next;
};

unsigned parallel_processors(void) {
    long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online < 1 ? 1 : online > THREADS_MAX ? THREADS_MAX : (unsigned)online;
}

static void *work(void *argument) {
    struct job *job = argument;
    for (;;) {
        size_t begin = atomic_fetch_add(&job->next, job->piece);
        if (begin >= job->count)
            return NULL;
        size_t left = job->count - begin;
        job->body(job->context, begin, begin + (left < job->piece ? left : job->piece));
    }
}

void parallel_for(size_t count, size_t piece, parallel_body *body, void *context) {
    struct job job = {.body = body, .context = context, .count = count, .piece = piece};
    pthread_t threads[THREADS_MAX];
    size_t pieces = (count + piece - 1) / piece;
    unsigned wanted = parallel_processors();
    unsigned started = 0;
    while (started + 1 < wanted && started + 1 < pieces &&
           pthread_create(&threads[started], NULL, work, &job) == 0)
        started++;
    work(&job);
    for (unsigned i = 0; i < started; i++)
        pthread_join(threads[i], NULL);
}
