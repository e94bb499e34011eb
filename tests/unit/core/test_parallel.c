// For sched_setaffinity.
#define _GNU_SOURCE

#include "core/parallel.h"

#include <sched.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

struct cover {
    size_t count;
    size_t piece;
    atomic_uint *visits;
    atomic_size_t pieces;
    atomic_bool wrong;
};

static void visit(void *context, size_t begin, size_t end) {
    struct cover *cover = context;
    // Always the same cuts, whatever the threads.
    size_t expected_end = begin + cover->piece < cover->count ? begin + cover->piece : cover->count;
    if (begin % cover->piece != 0 || end != expected_end || begin >= end)
        atomic_store(&cover->wrong, true);
    for (size_t i = begin; i < end && i < cover->count; i++)
        atomic_fetch_add(&cover->visits[i], 1);
    atomic_fetch_add(&cover->pieces, 1);
}

static void covers_each_index_once(void **state) {
    (void)state;
    static const size_t counts[] = {0, 1, 2, 3, 7, 63, 64, 65, 127, 1000, 1001, 4096, 99991};
    static const size_t pieces[] = {1, 2, 3, 7, 64, 1000, 100000};
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
        for (size_t p = 0; p < sizeof pieces / sizeof *pieces; p++) {
            struct cover cover = {.count = counts[c], .piece = pieces[p]};
            cover.visits = calloc(counts[c] + 1, sizeof *cover.visits);
            assert_non_null(cover.visits);
            parallel_for(counts[c], pieces[p], visit, &cover);
            assert_false(atomic_load(&cover.wrong));
            assert_int_equal(atomic_load(&cover.pieces), (counts[c] + pieces[p] - 1) / pieces[p]);
            for (size_t i = 0; i < counts[c]; i++)
                assert_int_equal(atomic_load(&cover.visits[i]), 1);
            free(cover.visits);
        }
}

struct nest {
    atomic_uint running, most;
    atomic_uint visits;
};

static void inner(void *context, size_t begin, size_t end) {
    struct nest *nest = context;
    unsigned now = atomic_fetch_add(&nest->running, 1) + 1;
    unsigned most = atomic_load(&nest->most);
    while (now > most && !atomic_compare_exchange_weak(&nest->most, &most, now))
        ;
    atomic_fetch_add(&nest->visits, (unsigned)(end - begin));
    atomic_fetch_sub(&nest->running, 1);
}

static void outer(void *context, size_t begin, size_t end) {
    for (size_t i = begin; i < end; i++)
        parallel_for(1000, 1, inner, context);
}

static void threads_do_not_multiply(void **state) {
    (void)state;
    struct nest nest = {0};
    parallel_for(200, 1, outer, &nest);
    assert_int_equal(atomic_load(&nest.visits), 200000);
    assert_in_range(atomic_load(&nest.most), 1, 2 * parallel_processors());
}

static void a_huge_piece_does_not_overflow(void **state) {
    (void)state;
    struct cover cover = {.count = 5, .piece = SIZE_MAX / 2};
    cover.visits = calloc(5, sizeof *cover.visits);
    assert_non_null(cover.visits);
    parallel_for(5, SIZE_MAX / 2, visit, &cover);
    assert_false(atomic_load(&cover.wrong));
    assert_int_equal(atomic_load(&cover.pieces), 1);
    free(cover.visits);
}

static void nest(void *context, size_t begin, size_t end) {
    for (size_t i = begin; i < end; i++)
        parallel_for(10, 3, visit, (struct cover *)context + i);
}

static void loops_may_nest(void **state) {
    (void)state;
    enum {
        OUTER = 20
    };
    struct cover covers[OUTER];
    for (int i = 0; i < OUTER; i++) {
        covers[i] = (struct cover){.count = 10, .piece = 3};
        covers[i].visits = calloc(10, sizeof *covers[i].visits);
    }
    parallel_for(OUTER, 1, nest, covers);
    for (int i = 0; i < OUTER; i++) {
        for (int k = 0; k < 10; k++)
            assert_int_equal(atomic_load(&covers[i].visits[k]), 1);
        free(covers[i].visits);
    }
}

struct beside {
    struct nest nest;
    int done;
    bool own_thread;
    pthread_t caller;
};

static void go_beside(void *context) {
    struct beside *beside = context;
    parallel_for(1000, 1, inner, &beside->nest);
    beside->own_thread = !pthread_equal(pthread_self(), beside->caller);
    beside->done++;
}

// It is done once it was waited for, on one thread, and only once.
static void a_task_goes_on_beside(void **state) {
    (void)state;
    struct beside beside = {.caller = pthread_self()};
    struct parallel_task task = {0}, never = {0};
    assert_true(parallel_is_over(&never));
    parallel_wait(&never);
    parallel_start(&task, go_beside, &beside);
    parallel_wait(&task);
    parallel_wait(&task);
    assert_true(parallel_is_over(&task));
    assert_int_equal(beside.done, 1);
    assert_int_equal(atomic_load(&beside.nest.visits), 1000);
    assert_int_equal(beside.own_thread, parallel_processors() > 1);
    if (beside.own_thread)
        assert_int_equal(atomic_load(&beside.nest.most), 1);
}

// On one processor nothing is won by a thread: the work waits until it is needed.
static void a_task_waits_on_one_processor(void **state) {
    (void)state;
    cpu_set_t before, one;
    assert_int_equal(sched_getaffinity(0, sizeof before, &before), 0);
    CPU_ZERO(&one);
    for (int i = 0; i < CPU_SETSIZE && CPU_COUNT(&one) == 0; i++)
        if (CPU_ISSET(i, &before))
            CPU_SET(i, &one);
    assert_int_equal(sched_setaffinity(0, sizeof one, &one), 0);
    struct beside beside = {.caller = pthread_self()};
    struct parallel_task task;
    parallel_start(&task, go_beside, &beside);
    assert_int_equal(beside.done, 0);
    assert_false(parallel_is_over(&task));
    parallel_wait(&task);
    assert_int_equal(beside.done, 1);
    assert_false(beside.own_thread);
    assert_int_equal(sched_setaffinity(0, sizeof before, &before), 0);
}

static void there_is_a_processor(void **state) {
    (void)state;
    assert_in_range(parallel_processors(), 1, 1024);
}

// ---- who looks on

struct watching {
    size_t looks, last, wanted; // wanted: count of the loop that is shown
    bool wrong, loops;
    pthread_t thread;
};

static void do_nothing(void *context, size_t begin, size_t end) {
    (void)context, (void)begin, (void)end;
}

static void see(void *context, size_t done, size_t count) {
    struct watching *w = context;
    w->looks++;
    w->wrong = w->wrong || count != w->wanted || done < w->last || done > count || done == 0 ||
               !pthread_equal(pthread_self(), w->thread);
    w->last = done;
    if (w->loops)
        parallel_for(100, 10, do_nothing, NULL);
}

static void loop_inside(void *context, size_t begin, size_t end) {
    (void)begin, (void)end;
    parallel_for(20, 5, do_nothing, context);
}

static void somebody_looks_on(void **state) {
    (void)state;
    struct watching w = {.wanted = 1000, .thread = pthread_self(), .loops = true};
    const struct parallel_looker looker = {see, &w};
    parallel_look(&looker);
    parallel_for(1000, 10, do_nothing, NULL);
    assert_true(w.looks <= 100 && !w.wrong);
    // Of loops in loops, the outer one is shown, unless it is of one piece.
    w = (struct watching){.wanted = 8, .thread = w.thread};
    parallel_for(8, 1, loop_inside, NULL);
    assert_false(w.wrong);
    w = (struct watching){.wanted = 20, .thread = w.thread};
    parallel_for(1, 1, loop_inside, NULL);
    parallel_look(NULL);
    // The piece of the outer loop, when it is over, has only its own loop to show.
    assert_true(w.looks > 0);
    const size_t looks = w.looks;
    parallel_for(1000, 10, do_nothing, NULL);
    assert_int_equal(looks, w.looks);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(covers_each_index_once),        cmocka_unit_test(a_huge_piece_does_not_overflow),
        cmocka_unit_test(threads_do_not_multiply),       cmocka_unit_test(loops_may_nest),
        cmocka_unit_test(there_is_a_processor),          cmocka_unit_test(a_task_goes_on_beside),
        cmocka_unit_test(a_task_waits_on_one_processor), cmocka_unit_test(somebody_looks_on),
    };
    return cmocka_run_group_tests_name("parallel", tests, NULL, NULL);
}
