#include "files/output.h"

#include "scratch.h"

#include <errno.h>
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

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

static int whole(const struct scratch *s, const char *name, const char *text) {
    return output_whole(scratch_path(s, name), text, strlen(text));
}

static mode_t mode_of(const struct scratch *s, const char *name) {
    struct stat info;
    assert_int_equal(lstat(scratch_path(s, name), &info), 0);
    return info.st_mode;
}

static void writes_new_files(void **state) {
    struct scratch *s = *state;
    assert_int_equal(whole(s, "new", "text\n"), 0);
    assert_true(scratch_holds(s, "new", "text\n"));
    assert_int_equal(output_whole(scratch_path(s, "empty"), NULL, 0), 0);
    assert_true(scratch_holds(s, "empty", ""));
    assert_int_equal(scratch_count(s, ""), 2);
}

static void nothing_is_seen_before_the_commit(void **state) {
    struct scratch *s = *state;
    struct output output;
    scratch_write(s, "file", "old");
    assert_true(output_open(&output, scratch_path(s, "file")));
    output_write(&output, "new ", 4);
    output_write(&output, "text", 4);
    assert_true(scratch_holds(s, "file", "old"));
    assert_int_equal(scratch_count(s, ""), 2);
    assert_true(output_commit(&output));
    assert_true(scratch_holds(s, "file", "new text"));
    assert_int_equal(scratch_count(s, ""), 1);
    // Both may be called again.
    assert_true(output_commit(&output));
    output_abandon(&output);
    assert_true(scratch_holds(s, "file", "new text"));
}

static void abandoning_leaves_no_trace(void **state) {
    struct scratch *s = *state;
    struct output output;
    scratch_write(s, "file", "old");
    assert_true(output_open(&output, scratch_path(s, "file")));
    output_write(&output, "new", 3);
    output_abandon(&output);
    output_abandon(&output);
    assert_true(scratch_holds(s, "file", "old"));
    assert_true(output_open(&output, scratch_path(s, "other")));
    output_write(&output, "new", 3);
    output_abandon(&output);
    assert_int_equal(scratch_count(s, ""), 1);
}

static void permissions_are_kept(void **state) {
    struct scratch *s = *state;
    scratch_write(s, "private", "old");
    assert_int_equal(chmod(scratch_path(s, "private"), 0600), 0);
    assert_int_equal(whole(s, "private", "new"), 0);
    assert_int_equal(mode_of(s, "private") & 07777, 0600);
    assert_int_equal(chmod(scratch_path(s, "private"), 04755), 0);
    assert_int_equal(whole(s, "private", "new"), 0);
    assert_int_equal(mode_of(s, "private") & 07777, 0755);
}

static void new_files_obey_the_umask(void **state) {
    struct scratch *s = *state;
    mode_t before = umask(027);
    int error = whole(s, "new", "text");
    umask(before);
    assert_int_equal(error, 0);
    assert_int_equal(mode_of(s, "new") & 0777, 0640);
}

static void links_stay_and_their_target_is_replaced(void **state) {
    struct scratch *s = *state;
    assert_int_equal(mkdir(scratch_path(s, "folder"), 0777), 0);
    scratch_write(s, "folder/target", "old");
    assert_int_equal(symlink("folder/target", scratch_path(s, "link")), 0);
    assert_int_equal(symlink(scratch_path(s, "link"), scratch_path(s, "link2")), 0);
    assert_int_equal(whole(s, "link2", "new"), 0);
    assert_true(S_ISLNK(mode_of(s, "link")) && S_ISLNK(mode_of(s, "link2")));
    assert_true(S_ISREG(mode_of(s, "folder/target")));
    assert_true(scratch_holds(s, "folder/target", "new"));
    assert_int_equal(scratch_count(s, ""), 3);
    assert_int_equal(scratch_count(s, "folder"), 1);
}

static void a_link_to_nothing_yet_creates_its_target(void **state) {
    struct scratch *s = *state;
    assert_int_equal(mkdir(scratch_path(s, "folder"), 0777), 0);
    assert_int_equal(symlink("folder/target", scratch_path(s, "link")), 0);
    assert_int_equal(whole(s, "link", "new"), 0);
    assert_true(S_ISLNK(mode_of(s, "link")));
    assert_true(scratch_holds(s, "folder/target", "new"));
}

static void other_names_of_a_file_keep_its_old_text(void **state) {
    struct scratch *s = *state;
    scratch_write(s, "file", "old");
    assert_int_equal(link(scratch_path(s, "file"), scratch_path(s, "backup")), 0);
    assert_int_equal(whole(s, "file", "new"), 0);
    assert_true(scratch_holds(s, "backup", "old"));
    assert_true(scratch_holds(s, "file", "new"));
}

static void the_longest_name_works(void **state) {
    struct scratch *s = *state;
    char name[NAME_MAX + 1];
    memset(name, 'n', NAME_MAX);
    name[NAME_MAX] = '\0';
    assert_int_equal(whole(s, name, "text"), 0);
    assert_true(scratch_holds(s, name, "text"));
}

static void names_without_a_folder_work(void **state) {
    struct scratch *s = *state;
    char before[PATH_MAX];
    assert_non_null(getcwd(before, sizeof before));
    assert_int_equal(chdir(s->folder), 0);
    int error = output_whole("plain", "text", 4);
    assert_int_equal(chdir(before), 0);
    assert_int_equal(error, 0);
    assert_true(scratch_holds(s, "plain", "text"));
    assert_int_equal(scratch_count(s, ""), 1);
}

static void a_temporary_name_left_behind_is_no_hindrance(void **state) {
    struct scratch *s = *state;
    char name[64];
    snprintf(name, sizeof name, ".glint-%ld-0.tmp", (long)getpid());
    scratch_write(s, name, "left by a crash");
    assert_int_equal(whole(s, "file", "text"), 0);
    assert_true(scratch_holds(s, name, "left by a crash"));
    assert_true(scratch_holds(s, "file", "text"));
}

static void two_outputs_of_one_name_do_not_mix(void **state) {
    struct scratch *s = *state;
    struct output a;
    struct output b;
    assert_true(output_open(&a, scratch_path(s, "file")));
    assert_true(output_open(&b, scratch_path(s, "file")));
    output_write(&a, "aaaa", 4);
    output_write(&b, "bb", 2);
    assert_true(output_commit(&a));
    assert_true(scratch_holds(s, "file", "aaaa"));
    assert_true(output_commit(&b));
    assert_true(scratch_holds(s, "file", "bb"));
    assert_int_equal(scratch_count(s, ""), 1);
}

static void devices_and_pipes_are_written_to(void **state) {
    struct scratch *s = *state;
    assert_int_equal(output_whole("/dev/null", "text", 4), 0);
    assert_int_equal(mkfifo(scratch_path(s, "pipe"), 0666), 0);
    int reader = open(scratch_path(s, "pipe"), O_RDONLY | O_NONBLOCK);
    assert_true(reader >= 0);
    assert_int_equal(whole(s, "pipe", "through"), 0);
    char bytes[16];
    assert_int_equal(read(reader, bytes, sizeof bytes), 7);
    assert_memory_equal(bytes, "through", 7);
    close(reader);
    assert_true(S_ISFIFO(mode_of(s, "pipe")));
    assert_int_equal(scratch_count(s, ""), 1);
}

static void a_dash_is_standard_output(void **state) {
    struct scratch *s = *state;
    fflush(stdout);
    int before = dup(STDOUT_FILENO);
    int file = open(scratch_path(s, "stdout"), O_WRONLY | O_CREAT, 0666);
    assert_true(before >= 0 && file >= 0);
    dup2(file, STDOUT_FILENO);
    int error = output_whole("-", "to stdout", 9);
    dup2(before, STDOUT_FILENO);
    close(file);
    close(before);
    assert_int_equal(error, 0);
    assert_true(scratch_holds(s, "stdout", "to stdout"));
    // Abandoning does not close it.
    struct output output;
    assert_true(output_open(&output, "-"));
    output_abandon(&output);
    assert_true(fcntl(STDOUT_FILENO, F_GETFD) >= 0);
}

static void large_outputs_arrive_whole(void **state) {
    struct scratch *s = *state;
    enum {
        SIZE = 3 * 1024 * 1024 + 17
    };
    char *bytes = malloc(SIZE);
    assert_non_null(bytes);
    for (size_t i = 0; i < SIZE; i++)
        bytes[i] = (char)(i * 31 >> 3);
    assert_int_equal(output_whole(scratch_path(s, "large"), bytes, SIZE), 0);
    FILE *file = fopen(scratch_path(s, "large"), "rb");
    assert_non_null(file);
    char *read_back = malloc(SIZE + 1);
    assert_non_null(read_back);
    assert_int_equal(fread(read_back, 1, SIZE + 1, file), SIZE);
    assert_memory_equal(bytes, read_back, SIZE);
    fclose(file);
    free(read_back);
    free(bytes);
}

int main(void) {
#define T(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        T(writes_new_files),
        T(nothing_is_seen_before_the_commit),
        T(abandoning_leaves_no_trace),
        T(permissions_are_kept),
        T(new_files_obey_the_umask),
        T(links_stay_and_their_target_is_replaced),
        T(a_link_to_nothing_yet_creates_its_target),
        T(other_names_of_a_file_keep_its_old_text),
        T(the_longest_name_works),
        T(names_without_a_folder_work),
        T(a_temporary_name_left_behind_is_no_hindrance),
        T(two_outputs_of_one_name_do_not_mix),
        T(devices_and_pipes_are_written_to),
        T(a_dash_is_standard_output),
        T(large_outputs_arrive_whole),
    };
    return cmocka_run_group_tests_name("output", tests, NULL, NULL);
}
