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

// How many threads a call may use: 0 is all processors. Within a piece that runs in parallel with others, 0
// is its thread's share, so nested calls do not multiply their threads.
static _Thread_local unsigned share;

// The observer of this thread, and the loop whose progress it sees; NULL: none.
static _Thread_local const struct parallel_looker *looker;
static _Thread_local const struct job *shown;

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

void parallel_look(const struct parallel_looker *by) {
    looker = by;
}

static void look(const struct job *job) {
    const struct parallel_looker *by = looker;
    const struct job *told = shown ? shown : job;
    const size_t taken = atomic_load(&told->next);
    looker = NULL;
    by->look(by->context, taken < told->count ? taken : told->count, told->count);
    looker = by;
}

static void *take_pieces(void *argument) {
    struct job *job = argument;
    share = job->share;
    for (;;) {
        size_t begin = atomic_fetch_add(&job->next, job->piece);
        if (begin >= job->count)
            return NULL;
        size_t left = job->count - begin;
        job->body(job->context, begin, begin + (left < job->piece ? left : job->piece));
        if (looker)
            look(job);
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
           pthread_create(&threads[started], NULL, take_pieces, &job) == 0)
        started++;
    const struct job *outer = shown;
    shown = outer || pieces < 2 || !looker ? outer : &job;
    take_pieces(&job);
    shown = outer;
    share = before;
    for (unsigned i = 0; i < started; i++)
        pthread_join(threads[i], NULL);
}

static void *run_task(void *argument) {
    struct parallel_task *task = argument;
    share = 1;
    task->work(task->context);
    task->over = true;
    return NULL;
}

void parallel_start(struct parallel_task *task, parallel_work *work, void *context) {
    task->work = work;
    task->context = context;
    task->over = false;
    task->has_thread = parallel_processors() > 1 && pthread_create(&task->thread, NULL, run_task, task) == 0;
}

void parallel_wait(struct parallel_task *task) {
    if (!task->work)
        return;
    if (task->has_thread)
        pthread_join(task->thread, NULL);
    else
        task->work(task->context);
    task->over = true;
    task->work = NULL;
}

bool parallel_is_over(struct parallel_task *task) {
    return !task->work || task->over;
}

// A default mutex needs nothing that could fail.
void parallel_lock_begin(struct parallel_lock *lock) {
    pthread_mutex_init(&lock->mutex, NULL);
}

void parallel_lock_take(struct parallel_lock *lock) {
    pthread_mutex_lock(&lock->mutex);
}

void parallel_lock_give(struct parallel_lock *lock) {
    pthread_mutex_unlock(&lock->mutex);
}

void parallel_lock_end(struct parallel_lock *lock) {
    pthread_mutex_destroy(&lock->mutex);
}
