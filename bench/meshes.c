#include "bench/meshes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    LINE_MAX_BYTES = 256,
    FACE_BYTES = 13, // a count and three indices
};

// A tube around a (2, 3) torus knot with waves on it.
static void knot_point(uint32_t i, uint32_t rows, uint32_t k, uint32_t columns, float point[3]) {
    const double turn = 6.283185307179586;
    double s = turn * i / rows;
    double t = turn * k / columns;
    double radius = 0.2 + 0.02 * sin(31 * s) * cos(7 * t) + 0.004 * sin(211 * s + 13 * t);
    double out = 0.6 + 0.25 * cos(3 * s) + radius * cos(t);
    point[0] = (float)(out * cos(2 * s));
    point[1] = (float)(0.25 * sin(3 * s) + radius * sin(t));
    point[2] = (float)(out * sin(2 * s));
}

static bool reserve(struct bench_mesh *mesh, uint32_t vertices, uint32_t triangles) {
    *mesh = (struct bench_mesh){.positions = malloc(3 * sizeof(float) * ((size_t)vertices + 1)),
                                .corners = malloc(3 * sizeof(uint32_t) * ((size_t)triangles + 1)),
                                .vertex_count = vertices,
                                .triangle_count = triangles};
    return mesh->positions && mesh->corners;
}

static bool make_knot(uint32_t wanted, struct bench_mesh *mesh) {
    const uint32_t columns = (uint32_t)sqrt(wanted / 16.0) + 3;
    const uint32_t rows = wanted / 2 / columns + 3;
    if (!reserve(mesh, rows * columns, rows * columns * 2))
        return false;
    uint32_t *next = mesh->corners;
    for (uint32_t i = 0; i < rows; i++)
        for (uint32_t k = 0; k < columns; k++) {
            const uint32_t row = i * columns, after = (i + 1) % rows * columns, right = (k + 1) % columns;
            const uint32_t six[6] = {row + k, after + k, after + right, row + k, after + right, row + right};
            knot_point(i, rows, k, columns, mesh->positions + 3 * (size_t)(row + k));
            memcpy(next, six, sizeof six);
            next += 6;
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

static bool read_header(FILE *file, uint32_t *vertices, uint32_t *faces) {
    char line[LINE_MAX_BYTES];
    bool is_binary = false;
    uint32_t properties = 0;
    *vertices = *faces = 0;
    while (fgets(line, sizeof line, file)) {
        if (strncmp(line, "end_header", 10) == 0)
            return is_binary && properties == 3;
        is_binary |= strncmp(line, "format binary_little_endian", 27) == 0;
        properties += strncmp(line, "property float", 14) == 0;
        if (strncmp(line, "element vertex ", 15) == 0)
            *vertices = (uint32_t)strtoul(line + 15, NULL, 10);
        if (strncmp(line, "element face ", 13) == 0)
            *faces = (uint32_t)strtoul(line + 13, NULL, 10);
    }
    return false;
}

static bool read_body(FILE *file, struct bench_mesh *mesh) {
    if (fread(mesh->positions, 3 * sizeof(float), mesh->vertex_count, file) != mesh->vertex_count)
        return false;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        unsigned char face[FACE_BYTES];
        uint32_t *corners = mesh->corners + 3 * (size_t)i;
        if (fread(face, sizeof face, 1, file) != 1 || face[0] != 3)
            return false;
        memcpy(corners, face + 1, 3 * sizeof *corners);
        for (int k = 0; k < 3; k++)
            if (corners[k] >= mesh->vertex_count)
                return false;
    }
    return true;
}

static bool read_ply(FILE *file, struct bench_mesh *mesh) {
    uint32_t vertices, faces;
    return read_header(file, &vertices, &faces) && reserve(mesh, vertices, faces) && read_body(file, mesh);
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
        FILE *file = fopen(word, "rb");
        const bool done = file && read_ply(file, mesh);
        if (file)
            fclose(file);
        if (done)
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
