#include "bench/mesh/mesh.h"

#include "bench/mesh/knot.h"
#include "bench/mesh/read_ply.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool reserve(struct bench_mesh *mesh, uint32_t vertices, uint32_t triangles) {
    *mesh = (struct bench_mesh){.positions = malloc(3 * sizeof(float) * ((size_t)vertices + 1)),
                                .corners = malloc(3 * sizeof(uint32_t) * ((size_t)triangles + 1)),
                                .vertex_count = vertices,
                                .triangle_count = triangles};
    return mesh->positions && mesh->corners;
}

static void put_point(float *position, const double point[3]) {
    for (int axis = 0; axis < 3; axis++)
        position[axis] = (float)point[axis];
}

static bool make_knot(uint32_t wanted, struct bench_mesh *mesh) {
    const struct knot_grid grid = knot_grid(wanted);
    const uint32_t cells = grid.rows * grid.columns;
    if (!reserve(mesh, cells, 2 * cells))
        return false;
    for (uint32_t i = 0; i < cells; i++) {
        const vec3 p = knot_point(grid, i / grid.columns, i % grid.columns);
        put_point(mesh->positions + 3 * (size_t)i, (const double[]){p.x, p.y, p.z});
        knot_cell(grid, i, (uint32_t(*)[3])(mesh->corners + 6 * (size_t)i));
    }
    return true;
}

// Long thin triangles in all directions, across a cube: no tree over boxes likes them.
static bool make_needles(uint32_t count, struct bench_mesh *mesh) {
    if (!reserve(mesh, 3 * count, count))
        return false;
    uint64_t state = 1;
    for (uint32_t i = 0; i < count; i++) {
        double r[9];
        for (int k = 0; k < 9; k++) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            r[k] = (double)(state >> 40) * 0x1p-23 - 1;
        }
        for (uint32_t k = 0; k < 3; k++) {
            for (int axis = 0; axis < 3; axis++)
                mesh->positions[3 * (3 * (size_t)i + k) + (size_t)axis] =
                    (float)(r[axis] + (k == 1 ? 0.3 * r[3 + axis] : 0) + (k == 2 ? 0.002 * r[6 + axis] : 0));
            mesh->corners[3 * (size_t)i + k] = 3 * i + k;
        }
    }
    return true;
}

static bool read_vertices(struct ply *ply, struct bench_mesh *mesh) {
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        double p[3] = {0, 0, 0};
        if (!ply_vertex(ply, p))
            return false;
        put_point(mesh->positions + 3 * (size_t)i, p);
    }
    return true;
}

static bool read_faces(struct ply *ply, struct bench_mesh *mesh) {
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        uint32_t *corners = mesh->corners + 3 * (size_t)i, count;
        if (!ply_face(ply, corners, 3, &count) || count != 3)
            return false;
        for (int k = 0; k < 3; k++)
            if (corners[k] >= mesh->vertex_count)
                return false;
    }
    return true;
}

static bool read_ply(const char *path, struct bench_mesh *mesh) {
    struct ply ply;
    const bool done = !ply_open(&ply, path) && reserve(mesh, ply.vertex.count, ply.face.count) &&
                      read_vertices(&ply, mesh) && read_faces(&ply, mesh);
    ply_finish(&ply);
    return done;
}

bool bench_mesh_open(const char *program, const char *word, struct bench_mesh *mesh) {
    char *end;
    const bool is_needles = strncmp(word, "needles:", 8) == 0;
    const char *number = is_needles ? word + 8 : word;
    const unsigned long wanted = strtoul(number, &end, 10);
    *mesh = (struct bench_mesh){0};
    if (*number && !*end && wanted > 0 && wanted <= UINT32_MAX / 4) {
        if (is_needles ? make_needles((uint32_t)wanted, mesh) : make_knot((uint32_t)wanted, mesh))
            return true;
        fprintf(stderr, "%s: not enough memory for %s triangles\n", program, word);
    } else {
        if (read_ply(word, mesh))
            return true;
        fprintf(stderr, "%s: '%s' is neither a number of triangles nor a PLY file that benches read\n",
                program, word);
    }
    bench_mesh_finish(mesh);
    return false;
}

void bench_mesh_finish(struct bench_mesh *mesh) {
    free(mesh->positions);
    free(mesh->corners);
    *mesh = (struct bench_mesh){0};
}
