// The meshes of bench/run, as OBJ.
//
//     bench_mesh knot TRIANGLES OUT.obj     a displaced torus knot of about as many triangles, at least
//     bench_mesh ply IN.ply OUT.obj         a binary PLY file
//
// It prints how many triangles and vertices there are, and the box around them. Exit: 0 done, 1 the input or
// the output fails, 2 usage. OUT is complete or absent.
#include "bench/mesh/knot.h"
#include "bench/mesh/read_ply.h"
#include "core/number.h"
#include "core/strbuf.h"
#include "files/output.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    PIECE_BYTES = 1 << 20, // written at once
    CORNERS_MOST = 64,     // of a face
    TRIANGLES_MOST = 200000000,
};

struct writing {
    struct output output;
    struct strbuf text;
    uint32_t vertices;
    uint64_t triangles;
    vec3 lower, upper;
};

static void flush(struct writing *w) {
    output_write(&w->output, w->text.data, w->text.len);
    strbuf_clear(&w->text);
}

static void put_vertex(struct writing *w, vec3 v) {
    // Seven decimals: finer than a float about 1.
    strbuf_format(&w->text, "v %.7f %.7f %.7f\n", v.x, v.y, v.z);
    w->lower = w->vertices ? vec3_min(w->lower, v) : v;
    w->upper = w->vertices ? vec3_max(w->upper, v) : v;
    w->vertices++;
    if (w->text.len > PIECE_BYTES)
        flush(w);
}

static void put_face(struct writing *w, const uint32_t *corners, uint32_t count) {
    strbuf_char(&w->text, 'f');
    for (uint32_t i = 0; i < count; i++)
        strbuf_format(&w->text, " %u", corners[i] + 1);
    strbuf_char(&w->text, '\n');
    w->triangles += count - 2;
    if (w->text.len > PIECE_BYTES)
        flush(w);
}

static void write_knot(struct writing *w, uint32_t triangles) {
    const struct knot_grid grid = knot_grid(triangles);
    for (uint32_t row = 0; row < grid.rows; row++)
        for (uint32_t column = 0; column < grid.columns; column++)
            put_vertex(w, knot_point(grid, row, column));
    for (uint32_t i = 0; i < grid.rows * grid.columns; i++) {
        uint32_t both[2][3];
        knot_cell(grid, i, both);
        put_face(w, both[0], 3);
        put_face(w, both[1], 3);
    }
}

static const char *write_ply(struct writing *w, struct ply *ply) {
    for (uint32_t i = 0; i < ply->vertex.count; i++) {
        double p[3] = {0, 0, 0};
        if (!ply_vertex(ply, p))
            return "ends within its vertices";
        put_vertex(w, (vec3){p[0], p[1], p[2]});
    }
    for (uint32_t i = 0; i < ply->face.count; i++) {
        uint32_t corners[CORNERS_MOST], count;
        if (!ply_face(ply, corners, CORNERS_MOST, &count))
            return "ends within its faces, or a face has more than 64 corners";
        for (uint32_t k = 0; k < count; k++)
            if (corners[k] >= ply->vertex.count)
                return "has a face with a vertex that does not exist";
        if (count >= 3)
            put_face(w, corners, count);
    }
    return NULL;
}

static int fail(const char *path, const char *what) {
    fprintf(stderr, "bench_mesh: %s %s\n", path, what);
    return 1;
}

static int finish(struct writing *w, const char *path, const char *fault, const char *faulty) {
    flush(w);
    const bool failed = w->text.failed;
    strbuf_finish(&w->text);
    if (fault || failed) {
        output_abandon(&w->output);
        return fail(fault ? faulty : path, fault ? fault : "needs more memory than there is");
    }
    if (!output_commit(&w->output))
        return fail(path, strerror(w->output.error));
    printf("%llu triangles, %u vertices, from %.6g %.6g %.6g to %.6g %.6g %.6g\n",
           (unsigned long long)w->triangles, w->vertices, w->lower.x, w->lower.y, w->lower.z, w->upper.x,
           w->upper.y, w->upper.z);
    return 0;
}

static bool begin(struct writing *w, const char *path) {
    *w = (struct writing){0};
    strbuf_init(&w->text);
    if (output_open(&w->output, path))
        return true;
    fail(path, strerror(w->output.error));
    return false;
}

static int make_knot(const char *count, const char *path) {
    struct writing w;
    int64_t triangles;
    if (number_parse_integer(str_from(count), &triangles) != NUMBER_OK || triangles < 18 ||
        triangles > TRIANGLES_MOST) {
        fprintf(stderr, "bench_mesh: a knot has from 18 to %d triangles\n", TRIANGLES_MOST);
        return 2;
    }
    if (!begin(&w, path))
        return 1;
    write_knot(&w, (uint32_t)triangles);
    return finish(&w, path, NULL, NULL);
}

static int convert(const char *from, const char *path) {
    struct ply ply;
    struct writing w;
    const char *fault = ply_open(&ply, from);
    int status = fault ? fail(from, fault) : 1;
    if (!fault && begin(&w, path))
        status = finish(&w, path, write_ply(&w, &ply), from);
    ply_finish(&ply);
    return status;
}

int main(int argc, char **argv) {
    if (argc == 4 && strcmp(argv[1], "knot") == 0)
        return make_knot(argv[2], argv[3]);
    if (argc == 4 && strcmp(argv[1], "ply") == 0)
        return convert(argv[2], argv[3]);
    fputs("usage: bench_mesh knot TRIANGLES OUT.obj | ply IN.ply OUT.obj\n", stderr);
    return 2;
}
