// How fast PLY, STL and GLB files are read, beside a bare loop over the same bytes.
//
//     bench_scans [TRIANGLES | MESH.ply]...
//
// A mesh (bench/mesh/mesh.h) is written into memory as binary PLY, as binary STL, and as GLB. For each:
// megabytes (10^6 bytes) of the file per second of the wall and of all threads' processor time, the best of
// the rounds, of
//   bare       a loop that knows where everything is, and makes what the reader makes of PLY and GLB:
//   positions as
//              doubles, corners and faces; of STL, whose corners have no vertices, it leaves each corner one
//              of its own
//   reader     glint's: polygons, with every number and index checked, and the corners of STL joined
//   mesh       what is made of them: triangles, merged positions, edges, volume
// `x bare` is the median over the rounds of the bare loop's processor time as a multiple of the part's.
#include "assets/gltf/asset_gltf.h"
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
    INDICES = 3 * sizeof(uint32_t), // of a face
    GLB_HEADS = 20,                 // of the file and of the first chunk
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

static void put_word(struct strbuf *out, uint32_t word) {
    strbuf_add(out, &word, sizeof word);
}

static void write_glb(const struct bench_mesh *mesh, struct strbuf *out, size_t *head) {
    const uint32_t positions = 3 * (uint32_t)sizeof(float) * mesh->vertex_count;
    const uint32_t indices = (uint32_t)INDICES * mesh->triangle_count;
    float low[3], high[3];
    memcpy(low, mesh->positions, sizeof low);
    memcpy(high, mesh->positions, sizeof high);
    for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++) {
        low[i % 3] = mesh->positions[i] < low[i % 3] ? mesh->positions[i] : low[i % 3];
        high[i % 3] = mesh->positions[i] > high[i % 3] ? mesh->positions[i] : high[i % 3];
    }
    struct strbuf json;
    strbuf_init(&json);
    strbuf_format(&json,
                  "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":%u}],\"bufferViews\":["
                  "{\"buffer\":0,\"byteLength\":%u},{\"buffer\":0,\"byteOffset\":%u,\"byteLength\":%u}],",
                  positions + indices, positions, positions, indices);
    strbuf_format(&json,
                  "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":%u,"
                  "\"min\":[%.9g,%.9g,%.9g],\"max\":[%.9g,%.9g,%.9g]},",
                  mesh->vertex_count, (double)low[0], (double)low[1], (double)low[2], (double)high[0],
                  (double)high[1], (double)high[2]);
    strbuf_format(&json,
                  "{\"bufferView\":1,\"componentType\":5125,\"type\":\"SCALAR\",\"count\":%u}],"
                  "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
                  "\"nodes\":[{\"mesh\":0}]}",
                  3 * mesh->triangle_count);
    while (json.len % 4)
        strbuf_char(&json, ' ');
    *head = GLB_HEADS + json.len + 8;
    strbuf_cstr(out, "glTF");
    put_word(out, 2);
    put_word(out, (uint32_t)*head + positions + indices);
    put_word(out, (uint32_t)json.len);
    strbuf_cstr(out, "JSON");
    strbuf_add(out, json.data, json.len);
    put_word(out, positions + indices);
    strbuf_add(out, "BIN", 4);
    strbuf_add(out, mesh->positions, positions);
    strbuf_add(out, mesh->corners, indices);
    strbuf_finish(&json);
}

// ---- the bare loop

static vec3 bare_point(const char *at) {
    float p[3];
    memcpy(p, at, sizeof p);
    return (vec3){(double)p[0], (double)p[1], (double)p[2]};
}

// `before` bytes are before the indices of each face.
static void bare_faces(const struct contest *c, struct arena *arena, size_t before) {
    vec3 *positions = ARENA_ARRAY(arena, vec3, c->vertices);
    struct polygon_corner *corners = ARENA_ARRAY(arena, struct polygon_corner, 3 * (size_t)c->triangles);
    struct polygon_face *faces = ARENA_ARRAY(arena, struct polygon_face, c->triangles);
    const char *at = c->bytes.ptr + c->head;
    for (uint32_t i = 0; i < c->vertices; i++, at += 3 * sizeof(float))
        positions[i] = bare_point(at);
    for (uint32_t i = 0; i < c->triangles; i++, at += before + INDICES) {
        faces[i] = (struct polygon_face){.first = 3 * i, .line = i + 1};
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t vertex;
            memcpy(&vertex, at + before + 4 * k, sizeof vertex);
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
    struct gltf_document document;
    struct mesh mesh;
    int number;
};

// What is in a file of this format, as polygons.
static void read_polygons(struct round *round, struct asset_file *file, struct polygons *polygons) {
    struct gltf_document *document = &round->document;
    if (str_ends_with_nocase(file->path, ".glb")) {
        document->file = *file;
        file->document = document;
        gltf_open(&document->gltf, file->text, NULL, &document->arena);
        document->gltf.most_elements = 3 * file->input->limits->value[LIMIT_MESH_TRIANGLES];
        document->file.errors += document->gltf.errors;
    }
    mesh_reader_of(file->path)->polygons(file, &round->arenas[1], polygons);
}

static void measure(void *context) {
    struct round *round = context;
    struct contest *c = round->contest;
    struct assets_input input = {.sources = &c->sources, .sink = &c->sink, .limits = &c->limits};
    struct asset_file file = {.input = &input, .what = "mesh", .path = str_from(c->path), .text = c->bytes};
    struct polygons polygons = {0};
    for (enum part part = 0; part < PARTS; part++) {
        const struct bench_clocks start = bench_clocks_now();
        if (part == PART_READER)
            read_polygons(round, &file, &polygons);
        else if (part == PART_MESH && file.errors == 0)
            mesh_build(&polygons, file.path, &round->arenas[1], &round->mesh);
        else if (str_ends_with_nocase(file.path, ".stl"))
            bare_stl(c, &round->arenas[0]);
        else
            bare_faces(c, &round->arenas[0], str_ends_with_nocase(file.path, ".ply"));
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
        struct arena *arenas[] = {&round.arenas[0],      &round.arenas[1], &round.mesh.arena,
                                  &round.document.arena, &c.arena,         NULL};
        for (int k = 0; k < 4; k++)
            arena_init(arenas[k], (size_t)1 << ARENA_BYTES_LOG);
        done = arena_guarded_all(arenas, measure, &round) == ARENA_FAULT_NONE && c.is_whole;
        for (int k = 0; k < 4; k++)
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
        failed |= !run(&mesh, "bench.glb", write_glb);
        bench_mesh_finish(&mesh);
    }
    return failed;
}
