#include "tools/meshgen/mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void mesh_init(struct mesh *mesh) {
    *mesh = (struct mesh){0};
}

void mesh_finish(struct mesh *mesh) {
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->faces);
    mesh_init(mesh);
}

static bool grow_vertices(struct mesh *mesh, bool with_normals) {
    if (mesh->vertex_count < mesh->vertex_capacity)
        return true;
    int capacity = mesh->vertex_capacity ? 2 * mesh->vertex_capacity : 256;
    vec3 *positions = realloc(mesh->positions, (size_t)capacity * sizeof *positions);
    if (positions)
        mesh->positions = positions;
    vec3 *normals = NULL;
    if (with_normals) {
        normals = realloc(mesh->normals, (size_t)capacity * sizeof *normals);
        if (normals)
            mesh->normals = normals;
    }
    if (!positions || (with_normals && !normals)) {
        mesh->failed = true;
        return false;
    }
    mesh->vertex_capacity = capacity;
    return true;
}

// Adding 0 turns -0 into 0, which would be written with a sign.
static double rounded(double x) {
    double unit = pow(10.0, MESH_DECIMALS);
    return floor(x * unit + 0.5) / unit + 0.0;
}

static vec3 rounded3(vec3 v) {
    return (vec3){rounded(v.x), rounded(v.y), rounded(v.z)};
}

int mesh_vertex(struct mesh *mesh, vec3 position) {
    if (mesh->failed || !grow_vertices(mesh, false))
        return 0;
    mesh->positions[mesh->vertex_count] = rounded3(position);
    return mesh->vertex_count++;
}

int mesh_vertex_normal(struct mesh *mesh, vec3 position, vec3 normal) {
    if (mesh->failed || !grow_vertices(mesh, true))
        return 0;
    mesh->positions[mesh->vertex_count] = rounded3(position);
    mesh->normals[mesh->vertex_count] = vec3_unit(normal);
    return mesh->vertex_count++;
}

void mesh_face(struct mesh *mesh, const int *corners, int corner_count) {
    if (mesh->failed)
        return;
    if (mesh->face_count == mesh->face_capacity) {
        int capacity = mesh->face_capacity ? 2 * mesh->face_capacity : 256;
        struct mesh_face *faces = realloc(mesh->faces, (size_t)capacity * sizeof *faces);
        if (!faces) {
            mesh->failed = true;
            return;
        }
        mesh->faces = faces;
        mesh->face_capacity = capacity;
    }
    struct mesh_face *face = &mesh->faces[mesh->face_count++];
    *face = (struct mesh_face){.corner_count = corner_count, .material = mesh->material};
    memcpy(face->corners, corners, (size_t)corner_count * sizeof *corners);
}

void mesh_triangle(struct mesh *mesh, int a, int b, int c) {
    mesh_face(mesh, (int[]){a, b, c}, 3);
}

void mesh_quad(struct mesh *mesh, int a, int b, int c, int d) {
    mesh_face(mesh, (int[]){a, b, c, d}, 4);
}

int mesh_triangle_count(const struct mesh *mesh) {
    int count = 0;
    for (int i = 0; i < mesh->face_count; i++)
        count += mesh->faces[i].corner_count - 2;
    return count;
}

vec3 mesh_face_normal(const struct mesh *mesh, const struct mesh_face *face) {
    vec3 sum = {0, 0, 0};
    vec3 origin = mesh->positions[face->corners[0]];
    for (int i = 1; i + 1 < face->corner_count; i++) {
        vec3 a = vec3_sub(mesh->positions[face->corners[i]], origin);
        vec3 b = vec3_sub(mesh->positions[face->corners[i + 1]], origin);
        sum = vec3_add(sum, vec3_cross(a, b));
    }
    return sum;
}

// At most `decimals`, trailing zeros cut, so that the files that are committed stay small.
static void write_number(struct strbuf *text, double x, int decimals) {
    char digits[64];
    int length = snprintf(digits, sizeof digits, "%.*f", decimals, x);
    while (length > 1 && digits[length - 1] == '0')
        length--;
    if (digits[length - 1] == '.')
        length--;
    if (length == 2 && digits[0] == '-' && digits[1] == '0') {
        strbuf_add(text, "0", 1);
        return;
    }
    strbuf_add(text, digits, (size_t)length);
}

static void write_vector(struct strbuf *text, const char *keyword, vec3 v, int decimals) {
    const double components[3] = {v.x, v.y, v.z};
    strbuf_cstr(text, keyword);
    for (int i = 0; i < 3; i++) {
        strbuf_char(text, ' ');
        write_number(text, components[i], decimals);
    }
    strbuf_char(text, '\n');
}

void mesh_write_obj(const struct mesh *mesh, const char *title, const char *mtllib, struct strbuf *text) {
    strbuf_format(text, "# %s, made by glint-meshgen\n", title);
    if (mtllib)
        strbuf_format(text, "mtllib %s\n", mtllib);
    for (int i = 0; i < mesh->vertex_count; i++)
        write_vector(text, "v", mesh->positions[i], MESH_DECIMALS);
    for (int i = 0; mesh->normals && i < mesh->vertex_count; i++)
        write_vector(text, "vn", mesh->normals[i], 4);
    const char *material = NULL;
    for (int i = 0; i < mesh->face_count; i++) {
        const struct mesh_face *face = &mesh->faces[i];
        if (face->material && face->material != material)
            strbuf_format(text, "usemtl %s\n", face->material);
        material = face->material;
        strbuf_char(text, 'f');
        for (int j = 0; j < face->corner_count; j++) {
            int index = face->corners[j] + 1;
            if (mesh->normals)
                strbuf_format(text, " %d//%d", index, index);
            else
                strbuf_format(text, " %d", index);
        }
        strbuf_char(text, '\n');
    }
}
