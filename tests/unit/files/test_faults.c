// Every system call that an output makes is made to fail in turn, and every kind of refusal that the system
// itself can be brought to: the old file stays, nothing is left behind, and the error is told.
#include "files/output.h"

#include "scratch.h"

#include <errno.h>
#include <fcntl.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cmocka.h>

// ---- calls that fail on demand: the linker sends those of the core here (-Wl,--wrap)

static struct {
    int left; // calls until the one that fails; 0: none does
    int error;
    const char *failed; // the call that did
} fault;

static bool fails(const char *call) {
    if (fault.left == 0 || --fault.left > 0)
        return false;
    fault.failed = call;
    errno = fault.error;
    return true;
}

// The core is compiled with 64-bit file offsets, where the name of open is open64.
int __real_openat64(int folder, const char *path, int flags, ...);
int __wrap_openat64(int folder, const char *path, int flags, ...);
ssize_t __real_write(int fd, const void *bytes, size_t count);
ssize_t __wrap_write(int fd, const void *bytes, size_t count);
int __real_fsync(int fd);
int __wrap_fsync(int fd);
int __real_close(int fd);
int __wrap_close(int fd);
int __real_renameat(int from_folder, const char *from, int to_folder, const char *to);
int __wrap_renameat(int from_folder, const char *from, int to_folder, const char *to);
void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);

int __wrap_openat64(int folder, const char *path, int flags, ...) {
    va_list args;
    va_start(args, flags);
    int mode = flags & O_CREAT ? va_arg(args, int) : 0;
    va_end(args);
    return fails("open") ? -1 : __real_openat64(folder, path, flags, mode);
}

// Error 0: half of it is written.
ssize_t __wrap_write(int fd, const void *bytes, size_t count) {
    if (!fails("write"))
        return __real_write(fd, bytes, count);
    return fault.error ? -1 : __real_write(fd, bytes, (count + 1) / 2);
}

int __wrap_fsync(int fd) {
    return fails("fsync") ? -1 : __real_fsync(fd);
}

int __wrap_close(int fd) {
    if (!fails("close"))
        return __real_close(fd);
    __real_close(fd); // a failed close closes too
    errno = fault.error;
    return -1;
}

int __wrap_renameat(int from_folder, const char *from, int to_folder, const char *to) {
    return fails("rename") ? -1 : __real_renameat(from_folder, from, to_folder, to);
}

void *__wrap_malloc(size_t size) {
    return fails("malloc") ? NULL : __real_malloc(size);
}

// ---- fixtures

static int set_up(void **state) {
    struct scratch *scratch = calloc(1, sizeof *scratch);
    *state = scratch;
    return scratch && scratch_make(scratch) ? 0 : -1;
}

static int tear_down(void **state) {
    scratch_finish(*state);
    free(*state);
    return 0;
}

static int lowest_free_descriptor(void) {
    int fd = dup(STDIN_FILENO);
    close(fd);
    return fd;
}

// Writes with the call number `step` failing; 0 where all went well.
static int write_with_fault(const char *path, int step, int error) {
    fault.left = step;
    fault.error = error;
    fault.failed = NULL;
    int result = output_whole(path, "new text", 8);
    fault.left = 0;
    return result;
}

static void fail_every_step(const struct scratch *s, const char *name, const char *old, int files) {
    bool seen_rename = false;
    int step = 1;
    for (;; step++) {
        int descriptor = lowest_free_descriptor();
        int error = write_with_fault(scratch_path(s, name), step, step % 2 ? ENOSPC : EIO);
        assert_int_equal(lowest_free_descriptor(), descriptor);
        if (!fault.failed) {
            assert_int_equal(error, 0);
            break;
        }
        if (error != (step % 2 ? ENOSPC : EIO))
            fail_msg("%s failed, and the output gave error %d", fault.failed, error);
        if (scratch_count(s, "") != files)
            fail_msg("%s failed, and something was left or lost", fault.failed);
        if (old && !scratch_holds(s, "file", old))
            fail_msg("%s failed, and the old file is not what it was", fault.failed);
        seen_rename = seen_rename || strcmp(fault.failed, "rename") == 0;
    }
    assert_true(seen_rename);
    assert_true(step > 7);
    assert_true(scratch_holds(s, "file", "new text"));
}

static void every_step_of_a_new_file(void **state) {
    struct scratch *s = *state;
    fail_every_step(s, "file", NULL, 0);
    assert_int_equal(scratch_count(s, ""), 1);
}

static void every_step_of_a_replaced_file(void **state) {
    struct scratch *s = *state;
    scratch_write(s, "file", "old");
    fail_every_step(s, "file", "old", 1);
    assert_int_equal(scratch_count(s, ""), 1);
}

static void every_step_of_a_linked_file(void **state) {
    struct scratch *s = *state;
    scratch_write(s, "file", "old");
    assert_int_equal(symlink("file", scratch_path(s, "link")), 0);
    fail_every_step(s, "link", "old", 2);
    struct stat info;
    assert_int_equal(lstat(scratch_path(s, "link"), &info), 0);
    assert_true(S_ISLNK(info.st_mode));
}

// A signal, and a write that took less than it was given, end nothing.
static void interrupted_and_short_calls(void **state) {
    struct scratch *s = *state;
    static const char *const calls[] = {"open", "write", "fsync", "close"};
    unsigned seen = 0;
    for (int step = 1; step == 1 || fault.failed; step++) {
        int error = write_with_fault(scratch_path(s, "file"), step, EINTR);
        for (unsigned i = 0; fault.failed && i < sizeof calls / sizeof *calls; i++)
            if (strcmp(fault.failed, calls[i]) == 0) {
                seen |= 1u << i;
                assert_int_equal(error, 0);
                assert_true(scratch_holds(s, "file", "new text"));
            }
        write_with_fault(scratch_path(s, "file"), step, 0);
        if (fault.failed && strcmp(fault.failed, "write") == 0)
            assert_true(scratch_holds(s, "file", "new text"));
    }
    assert_int_equal(seen, 0xf);
    assert_int_equal(scratch_count(s, ""), 1);
}

// ---- refusals of the system itself

static void a_full_device(void **state) {
    (void)state;
    assert_int_equal(output_whole("/dev/full", "text", 4), ENOSPC);
    struct output output;
    assert_true(output_open(&output, "/dev/full"));
    char block[65536] = {0};
    for (int i = 0; i < 4; i++)
        output_write(&output, block, sizeof block);
    assert_int_equal(output.error, ENOSPC);
    assert_false(output_commit(&output));
    assert_int_equal(output.error, ENOSPC);
}

static void a_full_standard_output(void **state) {
    (void)state;
    fflush(stdout);
    int before = dup(STDOUT_FILENO);
    int full = open("/dev/full", O_WRONLY);
    assert_true(before >= 0 && full >= 0);
    dup2(full, STDOUT_FILENO);
    int error = output_whole("-", "text", 4);
    dup2(before, STDOUT_FILENO);
    clearerr(stdout);
    close(full);
    close(before);
    assert_int_equal(error, ENOSPC);
}

// As a disk that fills up in the middle: the limit on a file's size, with its signal ignored.
static void a_disk_that_fills_up(void **state) {
    struct scratch *s = *state;
    scratch_write(s, "file", "old");
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    struct rlimit before;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    struct rlimit small = {.rlim_cur = 100000, .rlim_max = before.rlim_max};
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    struct output output;
    bool opened = output_open(&output, scratch_path(s, "file"));
    char block[4096] = {0};
    for (int i = 0; i < 100; i++)
        output_write(&output, block, sizeof block);
    bool committed = output_commit(&output);
    setrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, handler);
    assert_true(opened);
    assert_false(committed);
    assert_int_equal(output.error, EFBIG);
    assert_true(scratch_holds(s, "file", "old"));
    assert_int_equal(scratch_count(s, ""), 1);
}

static void a_closed_pipe(void **state) {
    struct scratch *s = *state;
    assert_int_equal(mkfifo(scratch_path(s, "pipe"), 0666), 0);
    void (*handler)(int) = signal(SIGPIPE, SIG_IGN);
    int reader = open(scratch_path(s, "pipe"), O_RDONLY | O_NONBLOCK);
    struct output output;
    bool opened = output_open(&output, scratch_path(s, "pipe"));
    close(reader);
    output_write(&output, "text", 4);
    bool committed = output_commit(&output);
    signal(SIGPIPE, handler);
    assert_true(opened);
    assert_false(committed);
    assert_int_equal(output.error, EPIPE);
}

static void no_descriptor_left(void **state) {
    struct scratch *s = *state;
    scratch_write(s, "file", "old");
    struct rlimit before;
    assert_int_equal(getrlimit(RLIMIT_NOFILE, &before), 0);
    struct rlimit none = {.rlim_cur = (rlim_t)lowest_free_descriptor(), .rlim_max = before.rlim_max};
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &none), 0);
    int error = output_whole(scratch_path(s, "file"), "new", 3);
    setrlimit(RLIMIT_NOFILE, &before);
    assert_int_equal(error, EMFILE);
    assert_true(scratch_holds(s, "file", "old"));
    assert_int_equal(scratch_count(s, ""), 1);
}

static void targets_that_cannot_be(void **state) {
    struct scratch *s = *state;
    scratch_write(s, "file", "old");
    assert_int_equal(mkdir(scratch_path(s, "folder"), 0777), 0);
    assert_int_equal(symlink("ring", scratch_path(s, "ring")), 0);
    char name[300];
    memset(name, 'n', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    const struct {
        const char *name;
        int error;
    } cases[] = {
        {"missing/file", ENOENT}, {"file/below", ENOTDIR}, {"folder", EISDIR},
        {"missing/", ENOENT},     {"ring", ELOOP},         {name, ENAMETOOLONG},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct output output;
        bool opened = output_open(&output, scratch_path(s, cases[i].name));
        bool committed = opened && output_commit(&output);
        if (committed || output.error != cases[i].error)
            fail_msg("%s gave error %d", cases[i].name, output.error);
    }
    assert_int_equal(output_whole("", "text", 4), ENOENT);
    assert_int_equal(output_whole("/", "text", 4), EISDIR);
    assert_int_equal(scratch_count(s, ""), 3);
    assert_true(scratch_holds(s, "file", "old"));
}

static void a_target_that_changes_meanwhile(void **state) {
    struct scratch *s = *state;
    struct output output;
    assert_true(output_open(&output, scratch_path(s, "file")));
    output_write(&output, "text", 4);
    assert_int_equal(mkdir(scratch_path(s, "file"), 0777), 0);
    assert_false(output_commit(&output));
    assert_int_equal(output.error, EISDIR);
    assert_int_equal(scratch_count(s, ""), 1);

    assert_int_equal(mkdir(scratch_path(s, "folder"), 0777), 0);
    assert_true(output_open(&output, scratch_path(s, "folder/file")));
    output_write(&output, "text", 4);
    scratch_remove_tree(scratch_path(s, "folder"));
    assert_false(output_commit(&output));
    assert_int_equal(output.error, ENOENT);
}

// As a user without rights, which root has to become first.
static int write_as_nobody(const char *path) {
    pid_t child = fork();
    if (child == 0) {
        if (geteuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0))
            _exit(77);
        _exit(output_whole(path, "new", 3));
    }
    int status = -1;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void folders_and_files_that_are_protected(void **state) {
    struct scratch *s = *state;
    scratch_write(s, "file", "old");
    assert_int_equal(chmod(scratch_path(s, "file"), 0444), 0);
    assert_int_equal(chmod(s->folder, 0555), 0);
    int in_folder = write_as_nobody(scratch_path(s, "new"));
    assert_int_equal(chmod(s->folder, 0777), 0);
    int on_file = write_as_nobody(scratch_path(s, "file"));
    if (in_folder == 77)
        skip();
    assert_int_equal(in_folder, EACCES);
    // The folder would let it be replaced, its owner does not.
    assert_int_equal(on_file, EACCES);
    assert_true(scratch_holds(s, "file", "old"));
    assert_int_equal(scratch_count(s, ""), 1);
}

int main(void) {
#define T(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        T(every_step_of_a_new_file),
        T(every_step_of_a_replaced_file),
        T(every_step_of_a_linked_file),
        T(interrupted_and_short_calls),
        T(a_full_device),
        T(a_full_standard_output),
        T(a_disk_that_fills_up),
        T(a_closed_pipe),
        T(no_descriptor_left),
        T(targets_that_cannot_be),
        T(a_target_that_changes_meanwhile),
        T(folders_and_files_that_are_protected),
    };
    return cmocka_run_group_tests_name("faults", tests, NULL, NULL);
}
