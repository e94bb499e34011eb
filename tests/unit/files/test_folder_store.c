// A cache's folder: entries come back whole, the oldest go first, and nothing that fails is an error.
#include "core/xxh64.h"
#include "files/folder_store.h"
#include "scratch.h"

#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

static struct scratch scratch;
static const char *folder;

static struct folder_store fresh(uint64_t cap_bytes) {
    assert_true(scratch_make(&scratch));
    folder = scratch.folder;
    return (struct folder_store){folder, cap_bytes};
}

static void clear(void) {
    scratch_finish(&scratch);
}

static bool keep(const struct folder_store *store, const char *name, const char *text) {
    const struct folder_store_part parts[2] = {{text, 2}, {text + 2, strlen(text) - 2}};
    return folder_store_write(store, name, parts, 2);
}

static bool holds(const struct folder_store *store, const char *name, const char *text) {
    size_t count;
    char *bytes = folder_store_read(store, name, 100, &count);
    bool same = bytes && count == strlen(text) && memcmp(bytes, text, count) == 0;
    free(bytes);
    return same;
}

static void age(const char *name, long seconds) {
    char path[PATH_MAX + 20];
    struct timespec times[2] = {{0, UTIME_OMIT}, {1000000 - seconds, 0}};
    snprintf(path, sizeof path, "%s/%s", folder, name);
    assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
}

static void test_entries_come_back(void **state) {
    (void)state;
    char deep[PATH_MAX + 20];
    struct folder_store store = fresh(1000);
    snprintf(deep, sizeof deep, "%s/not/there/yet", folder);
    store.path = deep;
    assert_true(keep(&store, "a", "first"));
    assert_true(holds(&store, "a", "first"));
    assert_true(keep(&store, "a", "second"));
    assert_true(holds(&store, "a", "second"));
    assert_false(holds(&store, "b", "second"));
    size_t count;
    assert_null(folder_store_read(&store, "a", 3, &count));
    clear();
}

static void test_the_oldest_go(void **state) {
    (void)state;
    struct folder_store store = fresh(30);
    assert_true(keep(&store, "a", "0123456789"));
    assert_true(keep(&store, "b", "0123456789"));
    assert_true(keep(&store, "c", "0123456789"));
    age("a", 100);
    age("b", 300);
    age("c", 200);
    assert_true(holds(&store, "b", "0123456789")); // used now
    assert_true(keep(&store, "d", "0123456789"));
    assert_false(holds(&store, "c", "0123456789"));
    assert_true(holds(&store, "a", "0123456789"));
    assert_true(holds(&store, "b", "0123456789"));
    assert_true(holds(&store, "d", "0123456789"));
    assert_false(keep(&store, "e", "a text of more than thirty bytes"));
    assert_true(holds(&store, "d", "0123456789"));
    clear();
}

static void test_nothing_is_an_error(void **state) {
    (void)state;
    struct folder_store none = {NULL, 100};
    assert_false(keep(&none, "a", "text"));
    assert_false(holds(&none, "a", "text"));
    struct folder_store store = fresh(100);
    char file[PATH_MAX + 20];
    snprintf(file, sizeof file, "%s/a", folder);
    assert_true(keep(&store, "a", "text"));
    struct folder_store inside = {file, 100}; // a file, no folder
    assert_false(keep(&inside, "b", "text"));
    assert_false(holds(&inside, "b", "text"));
    clear();
}

// ---- with a seal

static const struct folder_seal plain = {.magic = "test", .version = 3, .key = {1, 2}};

static bool keep_sealed(const struct folder_store *store, const char *text) {
    const struct folder_store_part parts[2] = {{text, 2}, {text + 2, strlen(text) - 2}};
    return folder_store_seal(store, "a", &plain, parts, 2);
}

// `other` may be NULL.
static bool holds_either(const struct folder_store *store, const struct folder_seal *seal, const char *text,
                         const char *other) {
    size_t count;
    char *bytes = folder_store_open(store, "a", seal, 100, &count);
    const char *expected = bytes && other && count == strlen(other) ? other : text;
    const bool same = bytes && count == strlen(expected) && memcmp(bytes, expected, count) == 0;
    assert_true(bytes || count == 0);
    free(bytes);
    return same;
}

static bool holds_sealed(const struct folder_store *store, const struct folder_seal *seal, const char *text) {
    return holds_either(store, seal, text, NULL);
}

static size_t read_raw(char *bytes, size_t room) {
    char path[PATH_MAX + 20];
    snprintf(path, sizeof path, "%s/a", folder);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t count = fread(bytes, 1, room, file);
    fclose(file);
    return count;
}

static void write_raw(const char *bytes, size_t count) {
    char path[PATH_MAX + 20];
    snprintf(path, sizeof path, "%s/a", folder);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, count, file), count);
    fclose(file);
}

static void test_a_seal_names_the_entry(void **state) {
    (void)state;
    const struct folder_seal others[] = {{.magic = "rest", .version = 3, .key = {1, 2}},
                                         {.magic = "test", .version = 4, .key = {1, 2}},
                                         {.magic = "test", .version = 3, .key = {7, 2}},
                                         {.magic = "test", .version = 3, .key = {1, 7}}};
    struct folder_store store = fresh(1000);
    assert_false(holds_sealed(&store, &plain, "text"));
    assert_true(keep_sealed(&store, "text"));
    assert_true(holds_sealed(&store, &plain, "text"));
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        assert_false(holds_sealed(&store, &others[i], "text"));
    clear();
}

// Cut off anywhere, longer, or with any bit turned: it is as if it were not there, and can be written again.
static void test_a_seal_sees_damage(void **state) {
    (void)state;
    char whole[300], damaged[300];
    struct folder_store store = fresh(1000);
    assert_true(keep_sealed(&store, "some text"));
    const size_t count = read_raw(whole, sizeof whole - 1);
    for (size_t left = 0; left < count; left++) {
        write_raw(whole, left);
        assert_false(holds_sealed(&store, &plain, "some text"));
    }
    for (size_t bit = 0; bit < 8 * count; bit++) {
        memcpy(damaged, whole, count);
        damaged[bit / 8] = (char)(damaged[bit / 8] ^ 1 << bit % 8);
        write_raw(damaged, count);
        assert_false(holds_sealed(&store, &plain, "some text"));
    }
    whole[count] = 'x';
    write_raw(whole, count + 1);
    assert_false(holds_sealed(&store, &plain, "some text"));
    assert_true(keep_sealed(&store, "some text"));
    assert_true(holds_sealed(&store, &plain, "some text"));
    clear();
}

// Programs that write the same entry at once, of other lengths: whoever reads gets one of them, whole.
static void test_writers_do_not_meet(void **state) {
    (void)state;
    enum {
        WRITERS = 4,
        TIMES = 50
    };
    static const char *const texts[2] = {"short text", "a text that is a good deal longer than the other"};
    struct folder_store store = fresh(100000);
    assert_true(keep_sealed(&store, texts[0]));
    for (int i = 0; i < WRITERS; i++)
        if (fork() == 0) {
            bool good = true;
            for (int k = 0; k < TIMES; k++)
                good = good && keep_sealed(&store, texts[i % 2]);
            _exit(!good);
        }
    int status, left = WRITERS;
    while (left > 0) {
        assert_true(holds_either(&store, &plain, texts[0], texts[1]));
        while (waitpid(-1, &status, WNOHANG) > 0) {
            assert_int_equal(status, 0);
            left--;
        }
    }
    clear();
}

static void test_where_it_lies(void **state) {
    (void)state;
    const char *old = getenv("XDG_CACHE_HOME");
    char *kept = old ? strdup(old) : NULL;
    setenv("XDG_CACHE_HOME", "/somewhere", 1);
    char *path = folder_store_path("x");
    assert_string_equal(path, "/somewhere/glint/x");
    free(path);
    setenv("XDG_CACHE_HOME", "relative", 1);
    setenv("HOME", "/me", 1);
    path = folder_store_path("x");
    assert_string_equal(path, "/me/.cache/glint/x");
    free(path);
    unsetenv("HOME");
    assert_null(folder_store_path("x"));
    if (kept)
        setenv("XDG_CACHE_HOME", kept, 1);
    free(kept);
}

// Who may write into the folder may have put anything there. A pipe must not be waited for, and a link
// neither read nor written through.
static void test_only_files_are_entries(void **state) {
    (void)state;
    struct folder_store store = fresh(1000);
    char at[PATH_MAX + 20], elsewhere[PATH_MAX + 20], text[20] = "";
    struct stat info;
    snprintf(elsewhere, sizeof elsewhere, "%s/elsewhere", folder);
    FILE *file = fopen(elsewhere, "w");
    assert_non_null(file);
    fputs("precious", file);
    fclose(file);
    alarm(20); // of a wait that must not be
    for (int kind = 0; kind < 3; kind++) {
        const char *name = kind == 0 ? "pipe" : kind == 1 ? "link" : "nowhere";
        snprintf(at, sizeof at, "%s/%s", folder, name);
        assert_int_equal(kind == 0 ? mkfifo(at, 0666) : symlink(kind == 1 ? "elsewhere" : "new", at), 0);
        assert_false(holds(&store, name, "precious"));
        assert_true(keep(&store, name, "entry"));
        assert_true(holds(&store, name, "entry"));
        assert_int_equal(lstat(at, &info), 0);
        assert_true(S_ISREG(info.st_mode));
    }
    snprintf(at, sizeof at, "%s/folder", folder);
    assert_int_equal(mkdir(at, 0777), 0);
    assert_false(keep(&store, "folder", "entry"));
    alarm(0);
    file = fopen(elsewhere, "r");
    assert_non_null(file);
    assert_non_null(fgets(text, sizeof text, file));
    fclose(file);
    assert_string_equal(text, "precious");
    snprintf(at, sizeof at, "%s/new", folder);
    assert_int_not_equal(lstat(at, &info), 0);
    clear();
}

// Values of the specification's own program.
static void test_hash(void **state) {
    (void)state;
    const char *text = "Call me Ishmael. Some years ago--never mind how long precisely-";
    assert_true(xxh64_of("", 0, 0) == UINT64_C(0xEF46DB3751D8E999));
    assert_true(xxh64_of("abc", 3, 0) == UINT64_C(0x44BC2CF5AD770999));
    assert_true(xxh64_of(text, 63, 0) == UINT64_C(0x02A2E85470D6FD96));
    struct xxh64 pieces;
    xxh64_begin(&pieces, 0);
    for (size_t at = 0, step = 1; at < 63; at += step, step = step % 40 + 1) {
        step = step < 63 - at ? step : 63 - at;
        xxh64_add(&pieces, text + at, step);
    }
    assert_true(xxh64_end(&pieces) == UINT64_C(0x02A2E85470D6FD96));
    assert_true(xxh64_of(text, 63, 1) != xxh64_of(text, 63, 0));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_seal_names_the_entry), cmocka_unit_test(test_a_seal_sees_damage),
        cmocka_unit_test(test_writers_do_not_meet),    cmocka_unit_test(test_entries_come_back),
        cmocka_unit_test(test_the_oldest_go),          cmocka_unit_test(test_nothing_is_an_error),
        cmocka_unit_test(test_only_files_are_entries), cmocka_unit_test(test_hash),
        cmocka_unit_test(test_where_it_lies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
