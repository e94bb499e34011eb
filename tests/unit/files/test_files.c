#include "files/files.h"

#include "scratch.h"

#include <errno.h>
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cmocka.h>

struct fixture {
    struct scratch scratch;
    struct arena arena;
    struct arena into;
    struct files files;
};

static str at(struct fixture *f, const char *name) {
    return arena_copy(&f->arena, str_from(scratch_path(&f->scratch, name)));
}

static void make_folder(struct fixture *f, const char *name) {
    assert_int_equal(mkdir(scratch_path(&f->scratch, name), 0777), 0);
}

static void make_link(struct fixture *f, const char *target, const char *name) {
    assert_int_equal(symlink(target, scratch_path(&f->scratch, name)), 0);
}

// in/ is the scene's folder; out/ lies beside it.
static int set_up(void **state) {
    struct fixture *f = calloc(1, sizeof *f);
    if (!f || !scratch_make(&f->scratch))
        return -1;
    arena_init(&f->arena, SIZE_MAX);
    arena_init(&f->into, SIZE_MAX);
    files_init(&f->files, &f->arena);
    make_folder(f, "in");
    make_folder(f, "in/sub");
    make_folder(f, "out");
    scratch_write(&f->scratch, "in/scene.yaml", "glint: 1\n");
    scratch_write(&f->scratch, "in/sub/mesh.obj", "v 0 0 0\n");
    scratch_write(&f->scratch, "out/secret", "secret\n");
    *state = f;
    return 0;
}

static int tear_down(void **state) {
    struct fixture *f = *state;
    scratch_finish(&f->scratch);
    arena_finish(&f->into);
    arena_finish(&f->arena);
    free(f);
    return 0;
}

static void paths_split(void **state) {
    (void)state;
    assert_true(str_equal_cstr(path_folder(STR("a/b/c")), "a/b"));
    assert_true(str_equal_cstr(path_folder(STR("c")), "."));
    assert_true(str_equal_cstr(path_folder(STR("/c")), "/"));
    assert_true(str_equal_cstr(path_folder(STR("")), "."));
    assert_true(str_equal_cstr(path_base(STR("a/b/c")), "c"));
    assert_true(str_equal_cstr(path_base(STR("c")), "c"));
    assert_true(str_equal_cstr(path_base(STR("a/")), ""));
}

static void paths_join(void **state) {
    struct fixture *f = *state;
    static const char *const rows[][3] = {
        {"a/b", "c/d", "a/b/c/d"}, {"/", "c", "/c"},   {".", "c", "c"}, {"a", "/c", "/c"},
        {"..", "c", "../c"},       {"a/", "c", "a/c"}, {"a", "", "a/"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        assert_true(
            str_equal_cstr(path_join(&f->arena, str_from(rows[i][0]), str_from(rows[i][1])), rows[i][2]));
}

static void a_folder_holds_what_lies_below_it(void **state) {
    (void)state;
    static const struct {
        const char *path, *folder, *rest; // NULL: it is not below
    } rows[] = {
        {"/a/b/c", "/a", "b/c"}, {"/a/b", "/a/", "b"}, {"/a", "/a", ""},    {"/", "/", ""},
        {"/a", "/", "a"},        {"/ab", "/a", NULL},  {"/a", "/ab", NULL}, {"/b/a", "/a", NULL},
        {"a/b", "/", NULL},      {"/", "/a", NULL},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        str rest;
        bool below = path_is_below(str_from(rows[i].path), str_from(rows[i].folder), &rest);
        assert_int_equal(below, rows[i].rest != NULL);
        if (below)
            assert_true(str_equal_cstr(rest, rows[i].rest));
    }
}

static enum file_status resolve(struct fixture *f, const char *path, str *out) {
    return files_resolve(&f->files, at(f, "in/scene.yaml"), str_from(path), out);
}

static void expect_resolves(struct fixture *f, const char *path, const char *led_to) {
    str out;
    assert_int_equal(resolve(f, path, &out), FILE_OK);
    assert_true(str_equal(files_canonical(&f->files, out), at(f, led_to)));
}

static void the_scene_s_folder_is_its_root(void **state) {
    struct fixture *f = *state;
    assert_int_equal(files_add_scene_root(&f->files, at(f, "in/scene.yaml")), FILE_OK);
    assert_int_equal(f->files.roots.count, 1);
    assert_true(str_equal(f->files.roots.items[0], at(f, "in")));
    expect_resolves(f, "sub/mesh.obj", "in/sub/mesh.obj");
    expect_resolves(f, "./sub/../sub/mesh.obj", "in/sub/mesh.obj");
    expect_resolves(f, "../in/sub/mesh.obj", "in/sub/mesh.obj");
    expect_resolves(f, at(f, "in/sub/mesh.obj").ptr, "in/sub/mesh.obj");
}

static void nothing_outside_the_roots_is_reached(void **state) {
    struct fixture *f = *state;
    files_add_scene_root(&f->files, at(f, "in/scene.yaml"));
    make_folder(f, "in-beside");
    scratch_write(&f->scratch, "in-beside/file", "x");
    make_link(f, "../out/secret", "in/link");
    make_link(f, scratch_path(&f->scratch, "out"), "in/folder-link");
    make_link(f, "sub/../link", "in/link-to-link");
    make_link(f, "sub/mesh.obj", "in/inner-link");
    const char *const refused[] = {"../out/secret",
                                   "sub/../../out/secret",
                                   "link",
                                   "link-to-link",
                                   "folder-link/secret",
                                   "../in-beside/file", // shares a prefix, no more
                                   "/etc/passwd",
                                   "../../../../../../../../../../etc/passwd"};
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        str out;
        if (resolve(f, refused[i], &out) != FILE_OUTSIDE)
            fail_msg("%s is not refused", refused[i]);
        assert_int_equal(out.ptr[0], '/');
    }
    str out;
    assert_int_equal(resolve(f, "link", &out), FILE_OUTSIDE);
    assert_true(str_equal(out, at(f, "out/secret")));
    expect_resolves(f, "inner-link", "in/sub/mesh.obj");
    // A device is no file wherever it lies: no root could help.
    assert_int_equal(resolve(f, "/dev/zero", &out), FILE_NOT_REGULAR);
}

static void what_is_missing_is_missing(void **state) {
    struct fixture *f = *state;
    files_add_scene_root(&f->files, at(f, "in/scene.yaml"));
    make_link(f, "nowhere", "in/dangling");
    const char *const missing[] = {"nothing.obj", "sub/nothing", "nowhere/mesh.obj", "sub/mesh.obj/x",
                                   "dangling",    "../nothing",  "/nothing"};
    str out;
    for (size_t i = 0; i < sizeof missing / sizeof *missing; i++)
        assert_int_equal(resolve(f, missing[i], &out), FILE_MISSING);
    assert_int_equal(resolve(f, "nothing.obj", &out), FILE_MISSING);
    assert_true(str_equal(out, at(f, "in/nothing.obj")));
    char longest[PATH_MAX + 10];
    memset(longest, 'a', sizeof longest);
    assert_int_equal(files_resolve(&f->files, STR("s"), (str){longest, sizeof longest}, &out), FILE_MISSING);
    assert_int_equal(files_resolve(&f->files, STR("s"), STR("a\0b"), &out), FILE_MISSING);
    // Longer than a name may be, and a ring of links: the system refuses.
    assert_int_equal(files_resolve(&f->files, STR("s"), (str){longest, 300}, &out), FILE_UNREADABLE);
    make_link(f, "ring", "in/ring");
    assert_int_equal(resolve(f, "ring", &out), FILE_UNREADABLE);
    assert_int_equal(f->files.system_error, ELOOP);
    assert_string_equal(file_status_text(&f->files, FILE_UNREADABLE), strerror(ELOOP));
}

static void a_marker_above_widens_the_root(void **state) {
    struct fixture *f = *state;
    scratch_write(&f->scratch, ".glintrc.yaml", "");
    assert_int_equal(files_add_scene_root(&f->files, at(f, "in/sub/mesh.obj")), FILE_OK);
    assert_true(str_equal(f->files.roots.items[0], str_from(f->scratch.folder)));
    expect_resolves(f, "../out/secret", "out/secret");
    str out;
    assert_int_equal(resolve(f, "../../x", &out), FILE_MISSING);
    assert_int_equal(resolve(f, "../..", &out), FILE_OUTSIDE);
}

static void the_nearest_marker_counts_and_must_be_a_file(void **state) {
    struct fixture *f = *state;
    scratch_write(&f->scratch, ".glintrc.yaml", "");
    make_folder(f, "in/sub/.glintrc.yaml");
    scratch_write(&f->scratch, "in/.glintrc.yaml", "");
    assert_int_equal(files_add_scene_root(&f->files, at(f, "in/sub/mesh.obj")), FILE_OK);
    assert_true(str_equal(f->files.roots.items[0], at(f, "in")));
}

static void roots_must_be_folders(void **state) {
    struct fixture *f = *state;
    assert_int_equal(files_add_root(&f->files, at(f, "nothing")), FILE_MISSING);
    assert_int_equal(files_add_root(&f->files, at(f, "in/scene.yaml")), FILE_NOT_REGULAR);
    assert_int_equal(files_add_root(&f->files, STR("")), FILE_MISSING);
    assert_int_equal(files_add_scene_root(&f->files, at(f, "nowhere/scene.yaml")), FILE_MISSING);
    assert_int_equal(f->files.roots.count, 0);
    make_link(f, "out", "link");
    assert_int_equal(files_add_root(&f->files, at(f, "link")), FILE_OK);
    assert_true(str_equal(f->files.roots.items[0], at(f, "out")));
}

static void asset_paths_come_after_the_file_s_own_folder(void **state) {
    struct fixture *f = *state;
    make_folder(f, "first");
    make_folder(f, "second");
    scratch_write(&f->scratch, "first/a", "1");
    scratch_write(&f->scratch, "second/a", "2");
    scratch_write(&f->scratch, "second/b", "2");
    scratch_write(&f->scratch, "second/scene.yaml", "2");
    files_add_scene_root(&f->files, at(f, "in/scene.yaml"));
    files_add_root(&f->files, at(f, "first"));
    files_add_root(&f->files, at(f, "second"));
    expect_resolves(f, "scene.yaml", "in/scene.yaml");
    expect_resolves(f, "a", "first/a");
    expect_resolves(f, "b", "second/b");
    expect_resolves(f, "../second/b", "second/b");
    str out;
    assert_int_equal(resolve(f, "../out/secret", &out), FILE_OUTSIDE);
    assert_int_equal(resolve(f, "c", &out), FILE_MISSING);
    assert_true(str_equal(out, at(f, "in/c")));
    // An absolute path is not looked for anywhere else.
    assert_int_equal(resolve(f, "/a", &out), FILE_MISSING);
}

static void relative_scenes_work(void **state) {
    struct fixture *f = *state;
    char before[PATH_MAX];
    assert_non_null(getcwd(before, sizeof before));
    assert_int_equal(chdir(scratch_path(&f->scratch, "in")), 0);
    assert_int_equal(files_add_scene_root(&f->files, STR("scene.yaml")), FILE_OK);
    str out;
    enum file_status status = files_resolve(&f->files, STR("scene.yaml"), STR("sub/mesh.obj"), &out);
    str root = f->files.roots.items[0];
    files_add_overlay(&f->files, STR("new.yaml"), STR("glint: 1"));
    str contents;
    enum file_status overlay = files_read_given(&f->files, at(f, "in/new.yaml"), 100, &f->into, &contents);
    assert_int_equal(chdir(before), 0);
    assert_true(str_equal(root, at(f, "in")));
    assert_int_equal(status, FILE_OK);
    assert_true(str_equal_cstr(out, "sub/mesh.obj"));
    assert_int_equal(overlay, FILE_OK);
    assert_true(str_equal_cstr(contents, "glint: 1"));
}

static enum file_status read_file(struct fixture *f, const char *name, uint64_t cap, str *contents) {
    return files_read_given(&f->files, at(f, name), cap, &f->into, contents);
}

static void reads_whole_files_with_a_nul_behind(void **state) {
    struct fixture *f = *state;
    str contents;
    assert_int_equal(read_file(f, "in/scene.yaml", 9, &contents), FILE_OK);
    assert_int_equal(contents.len, 9);
    assert_string_equal(contents.ptr, "glint: 1\n");
    scratch_write(&f->scratch, "empty", "");
    assert_int_equal(read_file(f, "empty", 0, &contents), FILE_OK);
    assert_int_equal(contents.len, 0);
    assert_string_equal(contents.ptr, "");
}

// Larger than what is read in one piece, and not a multiple of it.
static void reads_large_files_in_pieces(void **state) {
    struct fixture *f = *state;
    const size_t size = 9000001;
    char *text = malloc(size + 1);
    str contents;
    assert_non_null(text);
    for (size_t i = 0; i < size; i++)
        text[i] = (char)('!' + (i * 7 + i / 4099) % 90);
    text[size] = '\0';
    scratch_write(&f->scratch, "large", text);
    f->into.cap_bytes = 2 * size;
    assert_int_equal(read_file(f, "large", size - 1, &contents), FILE_TOO_LARGE);
    assert_int_equal(read_file(f, "large", size, &contents), FILE_OK);
    assert_int_equal(contents.len, size);
    assert_memory_equal(contents.ptr, text, size + 1);
    free(text);
}

static void refuses_what_is_too_large_before_taking_memory(void **state) {
    struct fixture *f = *state;
    str contents;
    assert_int_equal(read_file(f, "in/scene.yaml", 8, &contents), FILE_TOO_LARGE);
    assert_int_equal(contents.len, 0);
    // A sparse file of 1 TiB.
    assert_int_equal(truncate(scratch_path(&f->scratch, "out/secret"), (off_t)1 << 40), 0);
    assert_int_equal(read_file(f, "out/secret", 1 << 20, &contents), FILE_TOO_LARGE);
    assert_int_equal(f->into.used_bytes, 0);
    f->into.cap_bytes = 4;
    assert_int_equal(read_file(f, "in/scene.yaml", 100, &contents), FILE_NO_MEMORY);
    assert_int_equal(f->files.log.count, 0);
}

static void refuses_what_is_no_regular_file_at_once(void **state) {
    struct fixture *f = *state;
    str contents;
    assert_int_equal(read_file(f, "in", 100, &contents), FILE_NOT_REGULAR);
    // A pipe without a writer would block an open that waits.
    assert_int_equal(mkfifo(scratch_path(&f->scratch, "pipe"), 0666), 0);
    assert_int_equal(read_file(f, "pipe", 100, &contents), FILE_NOT_REGULAR);
    assert_int_equal(files_read_given(&f->files, STR("/dev/zero"), 100, &f->into, &contents),
                     FILE_NOT_REGULAR);
    assert_int_equal(files_read_given(&f->files, STR("/dev/null"), 100, &f->into, &contents),
                     FILE_NOT_REGULAR);
    make_link(f, "/dev/zero", "zero");
    assert_int_equal(read_file(f, "zero", 100, &contents), FILE_NOT_REGULAR);
    struct sockaddr_un name = {.sun_family = AF_UNIX};
    int s = socket(AF_UNIX, SOCK_STREAM, 0);
    assert_true(s >= 0);
    str path = at(f, "socket");
    if (path.len < sizeof name.sun_path) {
        memcpy(name.sun_path, path.ptr, path.len + 1);
        assert_int_equal(bind(s, (struct sockaddr *)&name, sizeof name), 0);
        assert_int_equal(read_file(f, "socket", 100, &contents), FILE_NOT_REGULAR);
    }
    close(s);
}

static void reports_what_cannot_be_read(void **state) {
    struct fixture *f = *state;
    str contents;
    assert_int_equal(read_file(f, "nothing", 100, &contents), FILE_MISSING);
    assert_int_equal(read_file(f, "in/scene.yaml/x", 100, &contents), FILE_MISSING);
    assert_int_equal(files_read_given(&f->files, STR(""), 100, &f->into, &contents), FILE_MISSING);
    make_link(f, "ring", "ring");
    assert_int_equal(read_file(f, "ring", 100, &contents), FILE_UNREADABLE);
    assert_int_equal(f->files.system_error, ELOOP);
    assert_int_equal(chmod(scratch_path(&f->scratch, "in/scene.yaml"), 0), 0);
    if (geteuid() == 0) // who may read everything
        return;
    assert_int_equal(read_file(f, "in/scene.yaml", 100, &contents), FILE_UNREADABLE);
    assert_int_equal(f->files.system_error, EACCES);
}

static void leaves_no_descriptor_open(void **state) {
    struct fixture *f = *state;
    str contents;
    int before = dup(0);
    close(before);
    read_file(f, "in/scene.yaml", 100, &contents);
    read_file(f, "in/scene.yaml", 1, &contents);
    read_file(f, "in", 100, &contents);
    read_file(f, "nothing", 100, &contents);
    files_suggest(&f->files, at(f, "in/scen.yaml"), NULL);
    int after = dup(0);
    close(after);
    assert_int_equal(before, after);
}

static void logs_each_file_once(void **state) {
    struct fixture *f = *state;
    str contents;
    make_link(f, "scene.yaml", "in/link");
    read_file(f, "in/scene.yaml", 100, &contents);
    read_file(f, "in/sub/mesh.obj", 100, &contents);
    read_file(f, "in/sub/../link", 100, &contents);
    read_file(f, "nothing", 100, &contents);
    assert_int_equal(f->files.log.count, 2);
    assert_true(str_equal(f->files.log.items[0].path, at(f, "in/scene.yaml")));
    assert_int_equal(f->files.log.items[0].size_bytes, 9);
    assert_true(f->files.log.items[0].modified_ns > INT64_C(1500000000000000000));
    assert_true(str_equal(f->files.log.items[1].path, at(f, "in/sub/mesh.obj")));
    struct file_read identity;
    assert_int_equal(files_identify(&f->files, at(f, "in/link"), &identity), FILE_OK);
    assert_true(str_equal(identity.path, at(f, "in/scene.yaml")));
    assert_int_equal(identity.modified_ns, f->files.log.items[0].modified_ns);
    assert_int_equal(files_identify(&f->files, at(f, "in"), &identity), FILE_NOT_REGULAR);
    assert_int_equal(files_identify(&f->files, at(f, "nothing"), &identity), FILE_MISSING);
    assert_int_equal(f->files.log.count, 2);
}

static void overlays_stand_for_files(void **state) {
    struct fixture *f = *state;
    files_add_scene_root(&f->files, at(f, "in/scene.yaml"));
    char text[] = "old";
    files_add_overlay(&f->files, at(f, "in/scene.yaml"), str_from(text));
    files_add_overlay(&f->files, at(f, "in/unsaved.yaml"), STR("new file"));
    text[0] = 'X';
    str contents;
    assert_int_equal(read_file(f, "in/sub/../scene.yaml", 100, &contents), FILE_OK);
    assert_string_equal(contents.ptr, "old");
    files_add_overlay(&f->files, at(f, "in/scene.yaml"), STR("newer"));
    assert_int_equal(read_file(f, "in/scene.yaml", 100, &contents), FILE_OK);
    assert_string_equal(contents.ptr, "newer");
    assert_int_equal(read_file(f, "in/scene.yaml", 4, &contents), FILE_TOO_LARGE);
    expect_resolves(f, "unsaved.yaml", "in/unsaved.yaml");
    expect_resolves(f, "sub/../unsaved.yaml", "in/unsaved.yaml");
    assert_int_equal(read_file(f, "in/unsaved.yaml", 100, &contents), FILE_OK);
    assert_string_equal(contents.ptr, "new file");
    struct file_read before;
    struct file_read after;
    files_identify(&f->files, at(f, "in/scene.yaml"), &before);
    files_add_overlay(&f->files, at(f, "in/scene.yaml"), STR("other"));
    files_identify(&f->files, at(f, "in/scene.yaml"), &after);
    assert_int_equal(before.size_bytes, after.size_bytes);
    assert_true(before.modified_ns != after.modified_ns);
    // Being open in an editor does not move a file below the roots.
    files_add_overlay(&f->files, at(f, "out/open.yaml"), STR("x"));
    files_add_overlay(&f->files, at(f, "out/secret"), STR("x"));
    str out;
    assert_int_equal(resolve(f, "../out/secret", &out), FILE_OUTSIDE);
    assert_int_equal(resolve(f, "../out/open.yaml", &out), FILE_MISSING);
}

static void suggests_near_names_inside_the_roots_only(void **state) {
    struct fixture *f = *state;
    files_add_scene_root(&f->files, at(f, "in/scene.yaml"));
    assert_true(str_equal_cstr(files_suggest(&f->files, at(f, "in/scnee.yaml"), NULL), "scene.yaml"));
    assert_true(str_equal_cstr(files_suggest(&f->files, at(f, "in/sub/Mesh.OBJ"), NULL), "mesh.obj"));
    assert_int_equal(files_suggest(&f->files, at(f, "in/entirely-different.png"), NULL).len, 0);
    assert_int_equal(files_suggest(&f->files, at(f, "out/secrets"), NULL).len, 0);
    assert_int_equal(files_suggest(&f->files, at(f, "nowhere/scene.yaml"), NULL).len, 0);
    // Of equals the first by name, whatever the order of the folder.
    scratch_write(&f->scratch, "in/sky3.png", "");
    scratch_write(&f->scratch, "in/sky1.png", "");
    scratch_write(&f->scratch, "in/sky2.png", "");
    assert_true(str_equal_cstr(files_suggest(&f->files, at(f, "in/sky.png"), NULL), "sky1.png"));
}

static void suggests_names_of_the_right_kind(void **state) {
    struct fixture *f = *state;
    static const char *const endings[] = {".obj", NULL};
    files_add_scene_root(&f->files, at(f, "in/scene.yaml"));
    scratch_write(&f->scratch, "in/fox.mtl", "");
    assert_true(str_equal_cstr(files_suggest(&f->files, at(f, "in/fox.stl"), NULL), "fox.mtl"));
    assert_int_equal(files_suggest(&f->files, at(f, "in/fox.stl"), endings).len, 0);
    scratch_write(&f->scratch, "in/fox.OBJ", "");
    assert_true(str_equal_cstr(files_suggest(&f->files, at(f, "in/fox.stl"), endings), "fox.OBJ"));
}

static void foreign_paths_get_advice(void **state) {
    struct fixture *f = *state;
    static const char *const foreign[] = {"C:\\a.obj", "c:/a.obj", "~/a.obj", "$HOME/a.obj",
                                          "http://a/b.obj"};
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++)
        assert_true(files_advice(&f->arena, str_from(foreign[i])).len > 0);
    assert_true(str_starts_with(files_advice(&f->arena, STR("a\\b\\c.obj")), STR("write 'a/b/c.obj'")));
    static const char *const good[] = {"a.obj", "../a/b.obj", "/a/b.obj", "a b.obj", "", ":"};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        assert_int_equal(files_advice(&f->arena, str_from(good[i])).len, 0);
}

static void every_status_has_words(void **state) {
    struct fixture *f = *state;
    for (int status = FILE_OK; status <= FILE_NO_MEMORY; status++)
        assert_true(strlen(file_status_text(&f->files, (enum file_status)status)) > 3);
}

static void read_without_room(void *context) {
    struct fixture *f = context;
    str contents;
    str name = at(f, "in/scene.yaml");
    f->arena.cap_bytes = f->arena.used_bytes;
    files_read_given(&f->files, name, 100, &f->into, &contents);
}

static void memory_for_paths_is_guarded(void **state) {
    struct fixture *f = *state;
    assert_int_equal(arena_guarded(&f->arena, read_without_room, f), ARENA_FAULT_CAP);
    f->arena.cap_bytes = SIZE_MAX;
}

int main(void) {
#define T(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        T(paths_split),
        T(paths_join),
        T(a_folder_holds_what_lies_below_it),
        T(the_scene_s_folder_is_its_root),
        T(nothing_outside_the_roots_is_reached),
        T(what_is_missing_is_missing),
        T(a_marker_above_widens_the_root),
        T(the_nearest_marker_counts_and_must_be_a_file),
        T(roots_must_be_folders),
        T(asset_paths_come_after_the_file_s_own_folder),
        T(relative_scenes_work),
        T(reads_whole_files_with_a_nul_behind),
        T(reads_large_files_in_pieces),
        T(refuses_what_is_too_large_before_taking_memory),
        T(refuses_what_is_no_regular_file_at_once),
        T(reports_what_cannot_be_read),
        T(leaves_no_descriptor_open),
        T(logs_each_file_once),
        T(overlays_stand_for_files),
        T(suggests_near_names_inside_the_roots_only),
        T(suggests_names_of_the_right_kind),
        T(foreign_paths_get_advice),
        T(every_status_has_words),
        T(memory_for_paths_is_guarded),
    };
    return cmocka_run_group_tests_name("files", tests, NULL, NULL);
}
