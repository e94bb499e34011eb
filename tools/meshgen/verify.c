#include "tools/meshgen/verify.h"

#include <stdlib.h>

struct placed {
    vec3 position;
    int vertex;
};

// Directed edge (a < b); `balance` is +1 for a->b and -1 for b->a.
struct edge {
    int a, b;
    int balance;
};

static int compare_doubles(double a, double b) {
    return (a > b) - (a < b);
}

static int compare_placed(const void *left, const void *right) {
    const struct placed *a = left, *b = right;
    int order = compare_doubles(a->position.x, b->position.x);
    if (!order)
        order = compare_doubles(a->position.y, b->position.y);
    return order ? order : compare_doubles(a->position.z, b->position.z);
}

static int compare_edges(const void *left, const void *right) {
    const struct edge *a = left, *b = right;
    return a->a != b->a ? (a->a > b->a) - (a->a < b->a) : (a->b > b->b) - (a->b < b->b);
}

// canonical[v] is the first vertex, in order of position, at the same place as v.
static bool merge_positions(const struct mesh *mesh, int *canonical) {
    struct placed *order = malloc((size_t)mesh->vertex_count * sizeof *order);
    if (!order)
        return false;
    for (int i = 0; i < mesh->vertex_count; i++)
        order[i] = (struct placed){mesh->positions[i], i};
    qsort(order, (size_t)mesh->vertex_count, sizeof *order, compare_placed);
    for (int i = 0; i < mesh->vertex_count; i++) {
        bool same = i > 0 && compare_placed(&order[i - 1], &order[i]) == 0;
        canonical[order[i].vertex] = same ? canonical[order[i - 1].vertex] : order[i].vertex;
    }
    free(order);
    return true;
}

static int count_open_edges(struct edge *edges, int count) {
    int open = 0;
    qsort(edges, (size_t)count, sizeof *edges, compare_edges);
    for (int i = 0; i < count;) {
        int balance = 0, j = i;
        for (; j < count && compare_edges(&edges[i], &edges[j]) == 0; j++)
            balance += edges[j].balance;
        open += abs(balance);
        i = j;
    }
    return open;
}

static int find_root(int *parent, int i) {
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static int collect_edges(const struct mesh *mesh, const int *canonical, struct edge *edges) {
    int count = 0;
    for (int f = 0; f < mesh->face_count; f++) {
        const struct mesh_face *face = &mesh->faces[f];
        for (int i = 0; i < face->corner_count; i++) {
            int a = canonical[face->corners[i]];
            int b = canonical[face->corners[(i + 1) % face->corner_count]];
            edges[count++] = a < b ? (struct edge){a, b, 1} : (struct edge){b, a, -1};
        }
    }
    return count;
}

// Volumes are summed about a vertex of the part, so that a part far from the origin loses no digits.
static void measure_parts(const struct mesh *mesh, const int *canonical, int *parent, double *volumes,
                          struct verify_result *result) {
    for (int f = 0; f < mesh->face_count; f++) {
        const struct mesh_face *face = &mesh->faces[f];
        for (int i = 1; i < face->corner_count; i++) {
            int a = find_root(parent, canonical[face->corners[0]]);
            parent[find_root(parent, canonical[face->corners[i]])] = a;
        }
    }
    for (int f = 0; f < mesh->face_count; f++) {
        const struct mesh_face *face = &mesh->faces[f];
        int root = find_root(parent, canonical[face->corners[0]]);
        vec3 origin = mesh->positions[root];
        vec3 offset = vec3_sub(mesh->positions[face->corners[0]], origin);
        volumes[root] += vec3_dot(offset, mesh_face_normal(mesh, face)) / 6;
    }
    for (int i = 0; i < mesh->vertex_count; i++) {
        if (canonical[i] != i || parent[i] != i)
            continue;
        result->parts++;
        result->inward_parts += volumes[i] <= 0;
        result->volume += volumes[i];
    }
}

static void check_face(const struct mesh *mesh, const struct mesh_face *face, struct verify_result *result) {
    vec3 normal = vec3_unit(mesh_face_normal(mesh, face));
    vec3 first = mesh->positions[face->corners[0]];
    bool bent = false;
    for (int i = 0; i < face->corner_count; i++) {
        vec3 a = mesh->positions[face->corners[i]];
        vec3 b = mesh->positions[face->corners[(i + 1) % face->corner_count]];
        vec3 c = mesh->positions[face->corners[(i + 2) % face->corner_count]];
        vec3 turn = vec3_cross(vec3_sub(b, a), vec3_sub(c, b));
        bent |= fabs(vec3_dot(vec3_sub(a, first), normal)) > 1e-4;
        bent |= vec3_dot(turn, normal) <= 0;
        if (i + 2 < face->corner_count)
            result->flat_triangles += vec3_length(vec3_cross(vec3_sub(b, first), vec3_sub(c, first))) < 1e-9;
        if (mesh->normals)
            result->bad_normals += vec3_dot(mesh->normals[face->corners[i]], normal) <= 0;
    }
    result->bent_faces += bent;
}

bool verify_mesh(const struct mesh *mesh, struct verify_result *result) {
    *result = (struct verify_result){0};
    size_t vertices = (size_t)mesh->vertex_count, corners = (size_t)mesh->face_count * MESH_CORNERS_MAX;
    int *canonical = malloc(vertices * sizeof *canonical);
    int *parent = malloc(vertices * sizeof *parent);
    double *volumes = calloc(vertices, sizeof *volumes);
    struct edge *edges = malloc(corners * sizeof *edges);
    bool ok = !mesh->failed && canonical && parent && volumes && edges && merge_positions(mesh, canonical);
    if (ok) {
        for (int i = 0; i < mesh->vertex_count; i++)
            parent[i] = i;
        result->open_edges = count_open_edges(edges, collect_edges(mesh, canonical, edges));
        measure_parts(mesh, canonical, parent, volumes, result);
        for (int f = 0; f < mesh->face_count; f++)
            check_face(mesh, &mesh->faces[f], result);
    }
    free(canonical);
    free(parent);
    free(volumes);
    free(edges);
    return ok;
}

bool verify_passed(const struct verify_result *result) {
    return result->parts > 0 && !result->open_edges && !result->inward_parts && !result->flat_triangles &&
           !result->bent_faces && !result->bad_normals;
}
