// Each way in which a file changes is seen, with inotify and without: written in place, replaced by another
// that takes its name, removed and made again; a file that was missing, and one in a folder that was missing.
#include "files/watch.h"

#include "core/clock.h"
#include "scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#define LONG_SECONDS 20.0 // far more than a change takes to be seen

struct fixture {
    struct scratch scratch;
    struct watch *watch;
};

static void begin(struct fixture *f, bool polls) {
    assert_true(scratch_make(&f->scratch));
    f->watch = watch_create(polls);
    assert_non_null(f->watch);
    if (polls)
        assert_false(watch_is_told(f->watch));
}

static void end(struct fixture *f) {
    watch_destroy(f->watch);
    scratch_finish(&f->scratch);
}

static void watch_only(struct fixture *f, const char *name) {
    watch_begin(f->watch);
    assert_true(watch_add_now(f->watch, str_from(scratch_path(&f->scratch, name))));
    assert_false(watch_differs(f->watch));
}

static void see(struct fixture *f) {
    assert_true(watch_wait(f->watch, LONG_SECONDS));
    assert_true(watch_settle(f->watch, 0.001));
}

static void test_changes(void **state) {
    struct fixture f;
    begin(&f, *(const bool *)*state);
    assert_true(scratch_write(&f.scratch, "a", "one"));
    watch_only(&f, "a");
    assert_true(scratch_write(&f.scratch, "a", "written in place"));
    see(&f);
    watch_only(&f, "a");
    assert_true(scratch_write(&f.scratch, "b", "another"));
    assert_int_equal(0, rename(scratch_path(&f.scratch, "b"), scratch_path(&f.scratch, "a")));
    see(&f);
    watch_only(&f, "a");
    assert_int_equal(0, remove(scratch_path(&f.scratch, "a")));
    see(&f);
    watch_only(&f, "a");
    assert_true(scratch_write(&f.scratch, "a", "again"));
    see(&f);
    end(&f);
}

static void test_missing(void **state) {
    struct fixture f;
    begin(&f, *(const bool *)*state);
    assert_true(watch_add_missing(f.watch, str_from(scratch_path(&f.scratch, "none/a"))));
    assert_false(watch_differs(f.watch));
    assert_int_equal(0, mkdir(scratch_path(&f.scratch, "none"), 0777));
    assert_true(scratch_write(&f.scratch, "none/a", "there"));
    see(&f);
    end(&f);
}

// What changed between the reading and the watching.
static void test_before(void **state) {
    struct fixture f;
    begin(&f, *(const bool *)*state);
    assert_true(scratch_write(&f.scratch, "a", "one"));
    const struct file_read old = {str_from(scratch_path(&f.scratch, "a")), 2, 1};
    assert_true(watch_add(f.watch, &old));
    assert_true(watch_differs(f.watch));
    see(&f);
    end(&f);
}

// Nothing happens, or only beside it: the time is over.
static void test_nothing(void **state) {
    struct fixture f;
    begin(&f, *(const bool *)*state);
    assert_true(scratch_write(&f.scratch, "a", "one"));
    watch_only(&f, "a");
    assert_true(scratch_write(&f.scratch, "b", "beside it"));
    const double start = clock_seconds();
    assert_false(watch_wait(f.watch, 0.05));
    assert_true(clock_seconds() - start >= 0.05);
    end(&f);
}

// One who looks all the time finds a change once, and what inotify has told at the next look.
static void test_looks(void **state) {
    const bool polls = *(const bool *)*state;
    struct fixture f;
    begin(&f, polls);
    assert_true(scratch_write(&f.scratch, "a", "one"));
    watch_only(&f, "a");
    assert_false(watch_look(f.watch));
    assert_true(scratch_write(&f.scratch, "a", "another"));
    const double begun = clock_seconds();
    bool seen = watch_look(f.watch);
    assert_true(seen || polls);
    while (!seen && clock_seconds() - begun < LONG_SECONDS)
        seen = watch_look(f.watch);
    assert_true(seen);
    // It goes on to differ, until it is added as it is now.
    assert_true(watch_differs(f.watch));
    watch_only(&f, "a");
    assert_false(watch_look(f.watch));
    end(&f);
}

int main(void) {
    static bool ways[] = {false, true};
    const struct CMUnitTest tests[] = {
        {"changes, told", test_changes, NULL, NULL, &ways[0]},
        {"changes, looked for", test_changes, NULL, NULL, &ways[1]},
        {"missing, told", test_missing, NULL, NULL, &ways[0]},
        {"missing, looked for", test_missing, NULL, NULL, &ways[1]},
        {"before, told", test_before, NULL, NULL, &ways[0]},
        {"before, looked for", test_before, NULL, NULL, &ways[1]},
        {"nothing, told", test_nothing, NULL, NULL, &ways[0]},
        {"nothing, looked for", test_nothing, NULL, NULL, &ways[1]},
        {"looks, told", test_looks, NULL, NULL, &ways[0]},
        {"looks, looked for", test_looks, NULL, NULL, &ways[1]},
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
