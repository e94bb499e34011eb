// How fast PLY and STL files are read, beside a bare loop over the same bytes.
//
//     bench_scans [TRIANGLES | MESH.ply]...
//
// A mesh (bench/mesh/mesh.h) is written into memory as binary PLY and as binary STL. For each: megabytes
// (10^6 bytes) of the file per second of the wall and of all threads' processor time, the best of the rounds,
// of
//   bare       a loop that knows where everything is, and makes what the reader makes of PLY: positions as
//   doubles,
//              corners and faces; of STL, whose corners have no vertices, it leaves each corner one of its
//              own
//   reader     glint's: polygons, with every number and index checked, and the corners of STL joined
//   mesh       what is made of them: triangles, merged positions, edges, volume
// `x bare` is the median over the rounds of the bare loop's processor time as a multiple of the part's.
#include "assets/mesh_build.h"
#include "assets/mesh_reader.h"
#include "bench/clocks.h"
#include "bench/mesh/mesh.h"
#include "core/strbuf.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    ROUNDS = 7,
    ARENA_BYTES_LOG = 36,
    STL_HEAD = 84,
    STL_FACET = 50,
    PLY_ROW = 13, // of a face: one byte and three numbers
};

enum part {
    PART_BARE,
    PART_READER,
    PART_MESH,
    PARTS
};

static const char *const part_names[PARTS] = {"bare", "reader", "mesh"};

struct contest {
    const char *path; // its ending says the format
    str bytes;
    size_t head; // bytes of the header
    uint32_t vertices, triangles;
    struct source_set sources;
    struct diag_sink sink;
    struct limits limits;
    struct arena arena; // of the sources
    double wall[PARTS][ROUNDS], processor[PARTS][ROUNDS];
    bool is_whole;
};

// ---- files in memory

static void write_ply(const struct bench_mesh *mesh, struct strbuf *out, size_t *head) {
    strbuf_format(
        out,
        "ply\nformat binary_little_endian 1.0\nelement vertex %u\nproperty float x\nproperty float "
        "y\nproperty float z\nelement face %u\nproperty list uchar int vertex_indices\nend_header\n",
        mesh->vertex_count, mesh->triangle_count);
    *head = out->len;
    strbuf_add(out, mesh->positions, 3 * sizeof(float) * (size_t)mesh->vertex_count);
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        strbuf_char(out, 3);
        strbuf_add(out, mesh->corners + 3 * (size_t)i, 3 * sizeof(uint32_t));
    }
}

static void write_stl(const struct bench_mesh *mesh, struct strbuf *out, size_t *head) {
    static const char zeros[12];
    strbuf_format(out, "%-80s", "bench");
    strbuf_add(out, &mesh->triangle_count, sizeof mesh->triangle_count);
    *head = out->len;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        strbuf_add(out, zeros, 12);
        for (int k = 0; k < 3; k++)
            strbuf_add(out, mesh->positions + 3 * (size_t)mesh->corners[3 * (size_t)i + (size_t)k],
                       3 * sizeof(float));
        strbuf_add(out, zeros, 2);
    }
}

// ---- the bare loop

static vec3 bare_point(const char *at) {
    float p[3];
    memcpy(p, at, sizeof p);
    return (vec3){(double)p[0], (double)p[1], (double)p[2]};
}

static void bare_ply(const struct contest *c, struct arena *arena) {
    vec3 *positions = ARENA_ARRAY(arena, vec3, c->vertices);
    struct polygon_corner *corners = ARENA_ARRAY(arena, struct polygon_corner, 3 * (size_t)c->triangles);
    struct polygon_face *faces = ARENA_ARRAY(arena, struct polygon_face, c->triangles);
    const char *at = c->bytes.ptr + c->head;
    for (uint32_t i = 0; i < c->vertices; i++, at += 3 * sizeof(float))
        positions[i] = bare_point(at);
    for (uint32_t i = 0; i < c->triangles; i++, at += PLY_ROW) {
        faces[i] = (struct polygon_face){.first = 3 * i, .line = i + 1};
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t vertex;
            memcpy(&vertex, at + 1 + 4 * k, sizeof vertex);
            corners[3 * (size_t)i + k] = (struct polygon_corner){vertex, IR_NO_INDEX};
        }
    }
}

static void bare_stl(const struct contest *c, struct arena *arena) {
    vec3 *positions = ARENA_ARRAY(arena, vec3, 3 * (size_t)c->triangles);
    struct polygon_corner *corners = ARENA_ARRAY(arena, struct polygon_corner, 3 * (size_t)c->triangles);
    struct polygon_face *faces = ARENA_ARRAY(arena, struct polygon_face, c->triangles);
    const char *at = c->bytes.ptr + c->head;
    for (uint32_t i = 0; i < c->triangles; i++, at += STL_FACET) {
        faces[i] = (struct polygon_face){.first = 3 * i, .line = i + 1};
        for (uint32_t k = 0; k < 3; k++) {
            positions[3 * (size_t)i + k] = bare_point(at + 12 + 12 * k);
            corners[3 * (size_t)i + k] = (struct polygon_corner){3 * i + k, IR_NO_INDEX};
        }
    }
}

// ---- rounds

struct round {
    struct contest *contest;
    struct arena arenas[2]; // of the bare loop and of the reader
    struct mesh mesh;
    int number;
};

static void measure(void *context) {
    struct round *round = context;
    struct contest *c = round->contest;
    struct assets_input input = {.sources = &c->sources, .sink = &c->sink, .limits = &c->limits};
    struct asset_file file = {.input = &input, .what = "mesh", .path = str_from(c->path), .text = c->bytes};
    struct polygons polygons = {0};
    for (enum part part = 0; part < PARTS; part++) {
        const struct bench_clocks start = bench_clocks_now();
        if (part == PART_READER)
            mesh_reader_of(file.path)->polygons(&file, &round->arenas[1], &polygons);
        else if (part == PART_MESH && file.errors == 0)
            mesh_build(&polygons, file.path, &round->arenas[1], &round->mesh);
        else if (str_ends_with_nocase(file.path, ".ply"))
            bare_ply(c, &round->arenas[0]);
        else
            bare_stl(c, &round->arenas[0]);
        const struct bench_clocks taken = bench_clocks_since(start);
        c->wall[part][round->number] = taken.wall;
        c->processor[part][round->number] = taken.processor;
    }
    c->is_whole = file.errors == 0 && round->mesh.triangle_count == c->triangles;
}

static void print(const struct contest *c) {
    for (enum part part = 0; part < PARTS; part++) {
        double ratios[ROUNDS];
        for (int i = 0; i < ROUNDS; i++)
            ratios[i] = c->processor[PART_BARE][i] / c->processor[part][i];
        printf("%10u %8.1f  %s %-8s %8.0f %8.0f %8.2f %8.3f\n", c->triangles, (double)c->bytes.len / 1e6,
               c->path + strlen(c->path) - 3, part_names[part],
               (double)c->bytes.len / 1e6 / bench_least(c->wall[part], ROUNDS),
               (double)c->bytes.len / 1e6 / bench_least(c->processor[part], ROUNDS),
               bench_median(ratios, ROUNDS), bench_least(c->processor[part], ROUNDS));
    }
}

static bool run(const struct bench_mesh *mesh, const char *path,
                void (*write)(const struct bench_mesh *mesh, struct strbuf *out, size_t *head)) {
    struct contest c = {.path = path,
                        .limits = limits_default(),
                        .vertices = mesh->vertex_count,
                        .triangles = mesh->triangle_count};
    struct strbuf bytes;
    strbuf_init(&bytes);
    write(mesh, &bytes, &c.head);
    c.bytes = strbuf_view(&bytes);
    arena_init(&c.arena, (size_t)1 << ARENA_BYTES_LOG);
    source_set_init(&c.sources, &c.arena);
    diag_sink_init(&c.sink);
    bool done = !bytes.failed;
    for (int i = 0; i < ROUNDS && done; i++) {
        struct round round = {.contest = &c, .number = i};
        struct arena *arenas[] = {&round.arenas[0], &round.arenas[1], &round.mesh.arena, &c.arena, NULL};
        for (int k = 0; k < 3; k++)
            arena_init(arenas[k], (size_t)1 << ARENA_BYTES_LOG);
        done = arena_guarded_all(arenas, measure, &round) == ARENA_FAULT_NONE && c.is_whole;
        for (int k = 0; k < 3; k++)
            arena_finish(arenas[k]);
    }
    if (done)
        print(&c);
    else
        fprintf(stderr, "bench_scans: %s cannot be read\n", path);
    diag_sink_finish(&c.sink);
    arena_finish(&c.arena);
    strbuf_finish(&bytes);
    return done;
}

int main(int argc, char **argv) {
    static const char *const standard[] = {"1100000"};
    const int count = argc > 1 ? argc - 1 : 1;
    printf(" triangles       MB      part         wall  threads   x bare  seconds\n");
    bool failed = false;
    for (int i = 0; i < count; i++) {
        struct bench_mesh mesh;
        if (!bench_mesh_open("bench_scans", argc > 1 ? argv[i + 1] : standard[i], &mesh))
            return 1;
        failed |= !run(&mesh, "bench.ply", write_ply);
        failed |= !run(&mesh, "bench.stl", write_stl);
        bench_mesh_finish(&mesh);
    }
    return failed;
}
