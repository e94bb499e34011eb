// How fast OBJ files are read: by one thread from the first line to the last, and in chunks by all, in turn.
//
//     bench_obj [TRIANGLES | MESH.ply | MESH.obj]...
//
// A mesh that is not an OBJ file (bench/mesh/mesh.h) is written as one into memory, with six decimals. For
// each part: megabytes (10^6 bytes) per second on the wall and of all threads' processor time, the best of
// the rounds; the median over the rounds of the processor time as a multiple of that of reading in order; and
// where this makes sense, whether the results are the same to the bit.
#include "assets/mesh_build.h"
#include "assets/obj/read_obj.h"
#include "bench/clocks.h"
#include "bench/mesh/mesh.h"
#include "core/strbuf.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    ROUNDS = 5,
    CHUNK_BYTES = 1 << 18,
    ARENA_BYTES_LOG = 36
};

enum part {
    PART_ORDER,
    PART_CHUNKS,
    PART_MESH, // what is made of the result: triangles, merged positions, edges, volume
    PARTS
};

static const char *const part_names[PARTS] = {"in order", "in chunks", "mesh of it"};

struct contest {
    str text;
    struct source_set sources;
    struct diag_sink sink;
    struct limits limits;
    struct arena arena; // of the sources
    double wall[PARTS][ROUNDS], processor[PARTS][ROUNDS];
    bool is_same, is_read;
    uint32_t triangles;
};

static bool write_obj(const struct bench_mesh *mesh, char **text, size_t *length) {
    FILE *file = open_memstream(text, length);
    if (!file)
        return false;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->positions + 3 * (size_t)i;
        fprintf(file, "v %.6f %.6f %.6f\n", (double)p[0], (double)p[1], (double)p[2]);
    }
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *c = mesh->corners + 3 * (size_t)i;
        fprintf(file, "f %u %u %u\n", c[0] + 1, c[1] + 1, c[2] + 1);
    }
    return fclose(file) == 0;
}

static bool read_file(const char *path, char **text, size_t *length) {
    FILE *file = fopen(path, "rb");
    long size = -1;
    if (file && fseek(file, 0, SEEK_END) == 0)
        size = ftell(file);
    if (size >= 0) {
        rewind(file);
        *length = (size_t)size;
        *text = malloc(*length + 1);
        if (*text && fread(*text, 1, *length, file) != *length)
            size = -1;
    }
    if (file)
        fclose(file);
    return size >= 0 && *text;
}

static bool open_text(const char *word, char **text, size_t *length) {
    const size_t n = strlen(word);
    if (n > 4 && strcmp(word + n - 4, ".obj") == 0) {
        if (read_file(word, text, length))
            return true;
        fprintf(stderr, "bench_obj: '%s' cannot be read\n", word);
        return false;
    }
    struct bench_mesh mesh;
    if (!bench_mesh_open("bench_obj", word, &mesh))
        return false;
    const bool done = write_obj(&mesh, text, length);
    bench_mesh_finish(&mesh);
    return done;
}

static bool same(const struct polygons *a, const struct polygons *b) {
    return a->vertices.count == b->vertices.count && a->normals.count == b->normals.count &&
           a->corners.count == b->corners.count && a->faces.count == b->faces.count &&
           memcmp(a->vertices.items, b->vertices.items, a->vertices.count * sizeof *a->vertices.items) == 0 &&
           memcmp(a->normals.items, b->normals.items, a->normals.count * sizeof *a->normals.items) == 0 &&
           memcmp(a->corners.items, b->corners.items, a->corners.count * sizeof *a->corners.items) == 0 &&
           memcmp(a->faces.items, b->faces.items, a->faces.count * sizeof *a->faces.items) == 0;
}

struct round {
    struct contest *contest;
    struct arena arenas[2]; // of the two readers
    struct mesh mesh;
    int number;
};

static void measure(void *context) {
    struct round *round = context;
    struct contest *c = round->contest;
    struct assets_input input = {.sources = &c->sources, .sink = &c->sink, .limits = &c->limits};
    struct asset_file file = {.input = &input, .what = "mesh", .text = c->text};
    struct polygons by_one, by_all;
    for (enum part part = 0; part < PARTS; part++) {
        if (part == PART_MESH)
            c->is_same = c->is_read && file.errors == 0 && same(&by_one, &by_all);
        struct bench_clocks start = bench_clocks_now();
        if (part == PART_ORDER)
            read_obj_in_order(&file, &round->arenas[0], &by_one);
        else if (part == PART_CHUNKS)
            c->is_read = read_obj_in_chunks(&file, &round->arenas[1], CHUNK_BYTES, &by_all);
        else if (file.errors == 0)
            mesh_build(c->is_read ? &by_all : &by_one, STR("bench"), &round->arenas[c->is_read],
                       &round->mesh);
        const struct bench_clocks taken = bench_clocks_since(start);
        c->wall[part][round->number] = taken.wall;
        c->processor[part][round->number] = taken.processor;
    }
    c->is_read = c->is_read && file.errors == 0;
    c->triangles = round->mesh.triangle_count;
}

static void print(const struct contest *c) {
    for (enum part part = 0; part < PARTS; part++) {
        double ratios[ROUNDS];
        for (int i = 0; i < ROUNDS; i++)
            ratios[i] = c->processor[part][i] / c->processor[PART_ORDER][i];
        printf("%10u %8.1f  %-10s %8.0f %8.0f %8.2f  %s\n", c->triangles, (double)c->text.len / 1e6,
               part_names[part], (double)c->text.len / 1e6 / bench_least(c->wall[part], ROUNDS),
               (double)c->text.len / 1e6 / bench_least(c->processor[part], ROUNDS),
               bench_median(ratios, ROUNDS),
               part != PART_CHUNKS ? ""
               : c->is_same        ? "the same"
               : c->is_read        ? "NOT the same"
                                   : "left to the other");
    }
}

static bool run(const char *word) {
    char *text = NULL;
    size_t length = 0;
    if (!open_text(word, &text, &length))
        return false;
    struct contest c = {.text = {text, length}, .limits = limits_default()};
    arena_init(&c.arena, (size_t)1 << ARENA_BYTES_LOG);
    source_set_init(&c.sources, &c.arena);
    diag_sink_init(&c.sink);
    bool done = true;
    for (int i = 0; i < ROUNDS && done; i++) {
        struct round round = {.contest = &c, .number = i};
        for (int k = 0; k < 2; k++)
            arena_init(&round.arenas[k], (size_t)1 << ARENA_BYTES_LOG);
        arena_init(&round.mesh.arena, (size_t)1 << ARENA_BYTES_LOG);
        struct arena *arenas[] = {&round.arenas[0], &round.arenas[1], &round.mesh.arena, &c.arena, NULL};
        done = arena_guarded_all(arenas, measure, &round) == ARENA_FAULT_NONE;
        for (int k = 0; k < 3; k++)
            arena_finish(arenas[k]);
    }
    if (done)
        print(&c);
    else
        fprintf(stderr, "bench_obj: not enough memory for '%s'\n", word);
    diag_sink_finish(&c.sink);
    arena_finish(&c.arena);
    free(text);
    return done && c.is_same;
}

int main(int argc, char **argv) {
    static const char *const standard[] = {"1100000"};
    const int count = argc > 1 ? argc - 1 : 1;
    printf(" triangles       MB  part           wall  threads x in order\n");
    int failed = 0;
    for (int i = 0; i < count; i++)
        failed |= !run(argc > 1 ? argv[i + 1] : standard[i]);
    return failed;
}
