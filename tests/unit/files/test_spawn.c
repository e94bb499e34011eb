// A program that may only read: it starts no other and writes nothing, where the system can see to it.
#include "files/git_run.h"
#include "files/sandbox.h"
#include "files/spawn.h"

#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

static const struct sandbox limits = {NULL, 0, 60, (uint64_t)1 << 30};

// What a shell says to this, in both streams.
static struct git_answer shell(const char *script, bool only_reads) {
    const char *const words[] = {"sh", "-c", script, NULL};
    struct git_answer answer = {.error = 0};
    strbuf_init(&answer.text[GIT_OUT]);
    strbuf_init(&answer.text[GIT_ERR]);
    git_run(&answer, words, only_reads ? &limits : NULL);
    return answer;
}

static void finish(struct git_answer *answer) {
    strbuf_finish(&answer->text[GIT_OUT]);
    strbuf_finish(&answer->text[GIT_ERR]);
}

static void test_reads(void **state) {
    (void)state;
    struct git_answer answer = shell("read line </proc/self/stat; echo read; exit 3", true);
    assert_int_equal(answer.error, 0);
    assert_int_equal(answer.status, 3);
    assert_true(str_equal_cstr(strbuf_view(&answer.text[GIT_OUT]), "read\n"));
    finish(&answer);
}

static void test_starts_nothing(void **state) {
    (void)state;
    const char *script = "(echo ran); (echo again)";
    struct git_answer answer = shell(script, false);
    assert_true(str_equal_cstr(strbuf_view(&answer.text[GIT_OUT]), "ran\nagain\n"));
    finish(&answer);
    answer = shell(script, true);
#if defined __x86_64__ || defined __i386__ || defined __aarch64__
    assert_int_equal(strbuf_view(&answer.text[GIT_OUT]).len, 0);
    assert_true(answer.status != 0);
#endif
    finish(&answer);
}

static void test_writes_nothing(void **state) {
    (void)state;
    char script[128];
    char path[64];
    struct stat there;
    snprintf(path, sizeof path, "spawned-%ld.txt", (long)getpid());
    snprintf(script, sizeof script, "echo nothing >/dev/null && : >%s", path);
    if (!sandbox_landlock())
        skip();
    struct git_answer answer = shell(script, true);
    assert_true(answer.status != 0);
    assert_int_equal(stat(path, &there), -1);
    finish(&answer);
}

static void test_is_not_there(void **state) {
    (void)state;
    const char *const words[] = {"glint-has-no-such-program", NULL};
    pid_t child = 1;
    assert_int_equal(spawn_reader(&child, words, &(struct spawn_streams){-1, -1, -1}, &limits), ENOENT);
    assert_int_equal(child, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reads),
        cmocka_unit_test(test_starts_nothing),
        cmocka_unit_test(test_writes_nothing),
        cmocka_unit_test(test_is_not_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
