// The door: what was judged is what is opened, whatever is exchanged between the look and the opening. Each
// test runs as the system opens paths, and once more in a process where openat2 does not exist.
#define _GNU_SOURCE

#include "files/door.h"
#include "files/files.h"
#include "files/output.h"
#include "scratch.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <cmocka.h>

static struct scratch scratch;
static struct arena arena, into;

static int set_up(void **state) {
    (void)state;
    if (!scratch_make(&scratch))
        return -1;
    arena_init(&arena, SIZE_MAX);
    arena_init(&into, SIZE_MAX);
    mkdir(scratch_path(&scratch, "in"), 0777);
    mkdir(scratch_path(&scratch, "in/real"), 0777);
    mkdir(scratch_path(&scratch, "out"), 0777);
    scratch_write(&scratch, "in/real/file", "inside");
    scratch_write(&scratch, "out/file", "secret");
    symlink("../out", scratch_path(&scratch, "in/link"));
    symlink("file", scratch_path(&scratch, "in/real/last"));
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    scratch_finish(&scratch);
    arena_finish(&into);
    arena_finish(&arena);
    return 0;
}

static int error_of(const char *name, int flags) {
    const int fd = door_open(scratch_path(&scratch, name), flags);
    const int error = fd < 0 ? errno : 0;
    if (fd >= 0)
        close(fd);
    return error;
}

static void test_no_link_is_followed(void **state) {
    (void)state;
    assert_int_equal(error_of("in/real/file", O_RDONLY), 0);
    assert_int_equal(error_of("in//real///file", O_RDONLY), 0);
    assert_int_equal(error_of("in/real", O_RDONLY | O_DIRECTORY), 0);
    assert_int_equal(error_of("in/real/last", O_RDONLY), ELOOP);
    assert_int_equal(error_of("in/missing", O_RDONLY), ENOENT);
    assert_int_not_equal(error_of("in/link/file", O_RDONLY), 0);
    assert_int_not_equal(error_of("in/real/file/more", O_RDONLY), 0);
    const int fd = door_folder(scratch_path(&scratch, "in/real"));
    assert_true(fd >= 0);
    close(fd);
    assert_true(door_folder(scratch_path(&scratch, "in/link")) < 0);
    assert_true(door_open("/", O_RDONLY | O_DIRECTORY) >= 0);
}

static void test_a_pipe_is_not_waited_for(void **state) {
    (void)state;
    struct files files;
    str contents;
    assert_int_equal(mkfifo(scratch_path(&scratch, "in/pipe"), 0666), 0);
    files_init(&files, &arena);
    assert_int_equal(files_add_root(&files, str_from(scratch_path(&scratch, "in"))), FILE_OK);
    alarm(20);
    assert_int_equal(files_read(&files, str_from(scratch_path(&scratch, "in/pipe")), 100, &into, &contents),
                     FILE_NOT_REGULAR);
    alarm(0);
}

// A folder and a link to one outside take each other's name as fast as they can.
static pid_t exchange(const char *a, const char *b) {
    const pid_t child = fork();
    if (child)
        return child;
    for (;;)
        syscall(SYS_renameat2, AT_FDCWD, a, AT_FDCWD, b, 2 /* RENAME_EXCHANGE */);
}

enum {
    READS = 20000
};

// Nothing from outside is ever read, nor anything written there.
static void test_links_are_exchanged_meanwhile(void **state) {
    (void)state;
    struct files files;
    struct output output;
    str contents;
    unsigned counts[2] = {0}, written = 0;
    bool is_inside = true;
    files_init(&files, &arena);
    assert_int_equal(files_add_root(&files, str_from(scratch_path(&scratch, "in"))), FILE_OK);
    const pid_t child = exchange(scratch_path(&scratch, "in/real"), scratch_path(&scratch, "in/link"));
    assert_true(child > 0);
    for (int i = 0; i < READS || (i < 100 * READS && !(counts[0] && counts[1])); i++) {
        const enum file_status status =
            files_read(&files, str_from(scratch_path(&scratch, "in/real/file")), 100, &into, &contents);
        counts[status == FILE_OK]++;
        is_inside = is_inside && (status != FILE_OK || str_equal(contents, STR("inside")));
    }
    for (int i = 0; i < READS / 10 || (i < 10 * READS && !written); i++)
        if (files_write(&files, str_from(scratch_path(&scratch, "in/real/new")), &output) == FILE_OK) {
            output_write(&output, "new", 3);
            written += output_commit(&output);
        }
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
    assert_true(is_inside);
    assert_true(counts[0] > 0 && counts[1] > 0 && written > 0); // both were met
    assert_false(scratch_holds(&scratch, "out/new", "new"));
    assert_int_equal(scratch_count(&scratch, "out"), 1);
}

static void test_what_is_written_stays_inside(void **state) {
    (void)state;
    struct files files;
    struct output output;
    str root;
    files_init(&files, &arena);
    assert_int_equal(files_add_root(&files, str_from(scratch_path(&scratch, "in"))), FILE_OK);
    static const char *const outside[] = {"out/new", "in/link/new", "in/../out/new", "in/no/../../out/new",
                                          "in/to"};
    symlink("../out/new", scratch_path(&scratch, "in/to"));
    for (size_t i = 0; i < sizeof outside / sizeof *outside; i++) {
        const str path = arena_copy(&arena, str_from(scratch_path(&scratch, outside[i])));
        assert_int_equal(files_write(&files, path, &output), FILE_OUTSIDE);
    }
    assert_int_equal(files_place(&files, str_from(scratch_path(&scratch, "out/new")), &root), FILE_OUTSIDE);
    assert_int_equal(mkfifo(scratch_path(&scratch, "in/fifo"), 0666), 0);
    alarm(20);
    assert_int_equal(files_write(&files, str_from(scratch_path(&scratch, "in/fifo")), &output),
                     FILE_NOT_REGULAR);
    assert_int_equal(files_write(&files, str_from(scratch_path(&scratch, "in/real")), &output),
                     FILE_NOT_REGULAR);
    alarm(0);
    assert_int_equal(files_write(&files, str_from(scratch_path(&scratch, "in/a/b/new")), &output), FILE_OK);
    output_write(&output, "new", 3);
    assert_true(output_commit(&output));
    assert_true(scratch_holds(&scratch, "in/a/b/new", "new"));
    assert_int_equal(files_write(&files, str_from(scratch_path(&scratch, "in/real/last")), &output), FILE_OK);
    output_write(&output, "new", 3);
    assert_true(output_commit(&output));
    assert_true(scratch_holds(&scratch, "in/real/file", "new")); // a link that stays inside is followed
    assert_int_equal(scratch_count(&scratch, "out"), 1);
}

// openat2 is answered as a kernel before 5.6 does.
static void forget_openat2(void) {
    struct sock_filter code[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, 437, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    const struct sock_fprog program = {sizeof code / sizeof *code, code};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
        prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0)
        print_message("the system has no seccomp: openat2 stays\n");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_no_link_is_followed, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_a_pipe_is_not_waited_for, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_links_are_exchanged_meanwhile, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_what_is_written_stays_inside, set_up, tear_down),
    };
    const int failed = cmocka_run_group_tests_name("as the system does", tests, NULL, NULL);
    forget_openat2();
    return failed + cmocka_run_group_tests_name("without openat2", tests, NULL, NULL);
}
