// OBJ files read in chunks: the same as in order, to the bit, wherever the chunks' borders are; what is not
// ordinary is left to the other reader, without a word.
#include "assets/mesh_build.h"
#include "assets/obj/obj_chunk.h"

#include <glob.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    ARENA_BYTES = 1 << 26,
    TEXT_MOST = 1 << 16,
    NUMBER_ROOM = 64,
};

static const size_t SIZES[] = {1, 7, 40, 300};

struct reading {
    str text;
    size_t chunk_bytes; // 0: in order
    struct arena arena;
    struct source_set sources;
    struct files files;
    struct diag_sink sink;
    struct limits limits;
    struct asset_file file;
    struct polygons obj;
    bool is_read;
};

static void read_text(void *context) {
    struct reading *r = context;
    source_set_init(&r->sources, &r->arena);
    files_init(&r->files, &r->arena);
    files_add_overlay(&r->files, STR("/mesh.obj"), r->text);
    struct assets_input input = {
        .sources = &r->sources, .files = &r->files, .sink = &r->sink, .limits = &r->limits};
    r->file = (struct asset_file){.input = &input,
                                  .what = "mesh",
                                  .path = STR("/mesh.obj"),
                                  .text = r->text,
                                  .limit = LIMIT_MESH_BYTES};
    r->is_read = true;
    if (r->chunk_bytes)
        r->is_read = read_obj_in_chunks(&r->file, &r->arena, r->chunk_bytes, &r->obj);
    else
        read_obj_in_order(&r->file, &r->arena, &r->obj);
    r->file.input = NULL;
}

static void reading_begin(struct reading *r, str text, size_t chunk_bytes, const struct limits *limits) {
    *r = (struct reading){.text = text, .chunk_bytes = chunk_bytes, .limits = *limits};
    arena_init(&r->arena, ARENA_BYTES);
    diag_sink_init(&r->sink);
    assert_int_equal(arena_guarded(&r->arena, read_text, r), ARENA_FAULT_NONE);
}

static void reading_end(struct reading *r) {
    diag_sink_finish(&r->sink);
    arena_finish(&r->arena);
}

static void assert_bytes(const void *a, const void *b, size_t size) {
    if (size)
        assert_memory_equal(a, b, size);
}

static void assert_same_obj(const struct polygons *a, const struct polygons *b) {
    assert_int_equal(a->vertices.count, b->vertices.count);
    assert_int_equal(a->normals.count, b->normals.count);
    assert_int_equal(a->corners.count, b->corners.count);
    assert_int_equal(a->faces.count, b->faces.count);
    assert_int_equal(a->groups.count, b->groups.count);
    assert_int_equal(a->libraries.count, b->libraries.count);
    assert_true(a->triangle_count == b->triangle_count);
    assert_bytes(a->vertices.items, b->vertices.items, a->vertices.count * sizeof *a->vertices.items);
    assert_bytes(a->normals.items, b->normals.items, a->normals.count * sizeof *a->normals.items);
    assert_bytes(a->corners.items, b->corners.items, a->corners.count * sizeof *a->corners.items);
    assert_bytes(a->faces.items, b->faces.items, a->faces.count * sizeof *a->faces.items);
    assert_bytes(a->losses, b->losses, sizeof a->losses);
    for (uint32_t i = 0; i < a->groups.count; i++) {
        assert_true(str_equal(a->groups.items[i].name, b->groups.items[i].name));
        assert_int_equal(a->groups.items[i].line, b->groups.items[i].line);
    }
    for (uint32_t i = 0; i < a->libraries.count; i++) {
        assert_true(str_equal(a->libraries.items[i].names, b->libraries.items[i].names));
        assert_int_equal(a->libraries.items[i].line, b->libraries.items[i].line);
    }
}

static void assert_same_words(const struct diag_sink *a, const struct diag_sink *b) {
    assert_int_equal(a->count, b->count);
    for (uint32_t i = 0; i < a->count; i++) {
        assert_int_equal(a->items[i].code, b->items[i].code);
        assert_true(str_equal(a->items[i].message, b->items[i].message));
        assert_int_equal(a->items[i].at.begin, b->items[i].at.begin);
        assert_int_equal(a->items[i].at.end, b->items[i].at.end);
    }
}

// Whether the text is ordinary, which does not depend on the chunks.
static bool compare(const char *text, size_t length, const struct limits *limits) {
    // A block of the exact size, so that reading beyond it is seen.
    char *copy = malloc(length ? length : 1);
    bool is_ordinary = false;
    struct reading in_order, in_chunks;
    memcpy(copy, text, length);
    reading_begin(&in_order, (str){copy, length}, 0, limits);
    for (size_t i = 0; i < sizeof SIZES / sizeof *SIZES; i++) {
        reading_begin(&in_chunks, (str){copy, length}, SIZES[i], limits);
        if (i == 0)
            is_ordinary = in_chunks.is_read;
        assert_int_equal(in_chunks.is_read, is_ordinary);
        if (is_ordinary)
            assert_same_words(&in_order.sink, &in_chunks.sink);
        else
            assert_int_equal(in_chunks.sink.count + in_chunks.obj.faces.count, 0);
        assert_int_equal(in_chunks.file.errors, is_ordinary ? in_order.file.errors : 0);
        if (is_ordinary && !in_order.file.errors)
            assert_same_obj(&in_order.obj, &in_chunks.obj);
        reading_end(&in_chunks);
    }
    reading_end(&in_order);
    free(copy);
    return is_ordinary;
}

static bool compare_text(const char *text) {
    const struct limits limits = limits_default();
    return compare(text, strlen(text), &limits);
}

#define SAMPLE                                                                                               \
    "mtllib own.mtl\n# comment \\ of it\nv 0 0 0\nv 1 0 0 1\nv +1 1.5e0 -0\nv 0 1 0 .1 .2 .3\nv 0.5 -.5 "    \
    "1e-3\n"                                                                                                 \
    "vt 0 0\nvn 0 0 1\nvn 1 0 0\no thing\ng part\ns 1\nusemtl red\nf 1/1/1 2/1/1 3/1/1 4/1/1\n"              \
    "f 1//1 5//2 2//1\r\n\nusemtl blue  green \nusemtl red\n\tf -1 -2 -3 # three\nusemtl\nf 1/ 2/7 3//\n"    \
    "usemtl blue  green\nf 1/2/ 2// 3 4 5\nl 1 2\np 1\nusemap a.png\ncurv 0 1 1 2\nf 1 2 6\nv 3 3 3\n"       \
    "usemtl red\nf -1 -2 -3"

static void ordinary_files_are_read_in_chunks(void **state) {
    (void)state;
    assert_true(compare_text(SAMPLE));
    assert_true(compare_text("\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 3"));
    assert_true(compare_text("v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\n\r\nf 1 2 3\r\n"));
    assert_true(compare_text("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"));
    assert_true(compare_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n")); // the whole file shows the fault
    assert_true(compare_text("v 0 0 0\n"));
    assert_true(compare_text(""));
}

static void others_are_left(void **state) {
    (void)state;
    static const char *const texts[] = {
        "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r",       "v 0 0 0\nv 1 \\\n0 0\nv 0 1 0\nf 1 2 3\n",
        "v 0 0 0\nv 1 0 x\nv 0 1 0\nf 1 2 3\n",       "v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n",
        "v 0 0 0\nv 1 0 2e18\nv 0 1 0\nf 1 2 3\n",    "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3/x\n",     "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n",       "v 0 0 0\nv 1 0 0\nv 0 1 0\nfo 1 2 3\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nwhat\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        assert_false(compare_text(texts[i]));
}

// Only the other reader says where a limit is exceeded.
static void limits_are_left(void **state) {
    (void)state;
    struct limits limits = limits_default();
    limits.value[LIMIT_MESH_CORNERS] = 4;
    assert_false(compare(SAMPLE, strlen(SAMPLE), &limits));
    limits.value[LIMIT_MESH_CORNERS] = 5;
    limits.value[LIMIT_MESH_TRIANGLES] = 9;
    assert_false(compare(SAMPLE, strlen(SAMPLE), &limits));
    limits.value[LIMIT_MESH_TRIANGLES] = 10;
    assert_true(compare(SAMPLE, strlen(SAMPLE), &limits));
}

static void damaged_files_are_the_same(void **state) {
    (void)state;
    static const char replacements[] = {'\0', '\n', '\r', ' ', '\\', '-', '9', '/', '#', 'f', '.', 'e'};
    const struct limits limits = limits_default();
    const size_t length = strlen(SAMPLE);
    uint32_t ordinary = 0, all = 0;
    for (size_t at = 0; at < length; at++)
        for (size_t r = 0; r < sizeof replacements; r++) {
            char copy[sizeof SAMPLE] = SAMPLE;
            copy[at] = replacements[r];
            ordinary += compare(copy, length, &limits);
            all++;
        }
    assert_in_range(ordinary, all / 4, all - all / 4);
}

static uint64_t random_state = 5;
static uint32_t random_below(uint32_t n) {
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(random_state >> 33) % n;
}

// A number in one of the forms that programs write.
static size_t put_number(char *to) {
    const double size = (double)random_below(1u << 30) / (1 << 20) / (1 + random_below(1000));
    const double value = random_below(2) ? size : -size;
    const int digits = (int)random_below(18);
    switch (random_below(4)) {
    case 0:
        return (size_t)snprintf(to, NUMBER_ROOM, "%.*e", digits, value);
    case 1:
        return (size_t)snprintf(to, NUMBER_ROOM, "%.*g", digits, value);
    default:
        return (size_t)snprintf(to, NUMBER_ROOM, "%.*f", digits, value);
    }
}

static void numbers_are_the_same(void **state) {
    (void)state;
    char *text = malloc(TEXT_MOST);
    size_t length = 0;
    while (length < TEXT_MOST - 400) {
        length += (size_t)snprintf(text + length, TEXT_MOST - length, "%s", random_below(3) ? "v" : "vn");
        for (int i = 0; i < 3; i++) {
            text[length++] = random_below(9) ? ' ' : '\t';
            length += put_number(text + length);
        }
        text[length++] = '\n';
    }
    length += (size_t)snprintf(text + length, TEXT_MOST - length, "f 1 2 3\nf -1 -2 -3");
    const struct limits limits = limits_default();
    assert_true(compare(text, length, &limits));
    free(text);
}

// All meshes of the repository, the invalid ones and the seeds of fuzzing too.
static void files_are_the_same(void **state) {
    (void)state;
    const struct limits limits = limits_default();
    static const char *const patterns[] = {"tests/*/*.obj", "tests/*/*/*.obj", "tests/*/*/*/*.obj",
                                           "scenes/*/*.obj"};
    glob_t found = {0};
    for (size_t i = 0; i < sizeof patterns / sizeof *patterns; i++) {
        char pattern[1024];
        snprintf(pattern, sizeof pattern, "%s/%s", SOURCE_FOLDER, patterns[i]);
        const int status = glob(pattern, i ? GLOB_APPEND : 0, NULL, &found);
        assert_true(status == 0 || status == GLOB_NOMATCH);
    }
    uint32_t ordinary = 0;
    char *text = malloc(TEXT_MOST);
    for (size_t i = 0; i < found.gl_pathc; i++) {
        FILE *file = fopen(found.gl_pathv[i], "rb");
        assert_non_null(file);
        const size_t length = fread(text, 1, TEXT_MOST, file);
        fclose(file);
        ordinary += compare(text, length, &limits);
    }
    free(text);
    assert_true(found.gl_pathc > 30);
    assert_in_range(ordinary, found.gl_pathc / 2, found.gl_pathc);
    globfree(&found);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ordinary_files_are_read_in_chunks),
        cmocka_unit_test(others_are_left),
        cmocka_unit_test(limits_are_left),
        cmocka_unit_test(damaged_files_are_the_same),
        cmocka_unit_test(numbers_are_the_same),
        cmocka_unit_test(files_are_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
