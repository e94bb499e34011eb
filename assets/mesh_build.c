#include "assets/mesh_build.h"

#include "assets/mesh_reader.h"
#include "assets/triangulate.h"
#include "core/heap.h"
#include "core/parallel.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

// How far a corner must be off its face's plane to be reported: as a share of the face's size and, to allow
// for files with six digits, of its coordinates.
#define BEND_SEEN  0.001
#define RESOLUTION 0x1p-18

enum {
    PIECE = 1 << 14, // triangles, in parallel work
};

static void copy_names(const struct polygons *polygons, str path, struct mesh *mesh) {
    struct arena *arena = &mesh->arena;
    mesh->path = arena_copy(arena, path);
    mesh->group_count = polygons->groups.count;
    mesh->groups = ARENA_ARRAY(arena, struct mesh_group, polygons->groups.count);
    for (uint32_t i = 0; i < polygons->groups.count; i++) {
        mesh->groups[i] = polygons->groups.items[i];
        mesh->groups[i].name = arena_copy(arena, mesh->groups[i].name);
    }
    mesh->library_count = polygons->libraries.count;
    mesh->libraries = ARENA_ARRAY(arena, struct mesh_library, polygons->libraries.count);
    for (uint32_t i = 0; i < polygons->libraries.count; i++) {
        mesh->libraries[i] = polygons->libraries.items[i];
        mesh->libraries[i].names = arena_copy(arena, mesh->libraries[i].names);
    }
    memcpy(mesh->losses, polygons->losses, sizeof mesh->losses);
    mesh->is_binary = polygons->is_binary;
    mesh->face_count = polygons->faces.count;
}

// Keeps the positions that faces use, in file order. Returns the new index of each vertex.
static uint32_t *keep_used_positions(struct polygons *polygons, struct arena *scratch, struct mesh *mesh) {
    uint32_t *place = ARENA_ARRAY(scratch, uint32_t, polygons->vertices.count);
    for (uint32_t i = 0; i < polygons->corners.count; i++)
        place[polygons->corners.items[i].vertex] = 1;
    uint32_t count = 0;
    for (uint32_t i = 0; i < polygons->vertices.count; i++)
        count += place[i];
    const bool all = count == polygons->vertices.count && count == polygons->vertices.capacity;
    if (all && arena_hand_over(scratch, &mesh->arena, polygons->vertices.items, count, sizeof(vec3)))
        mesh->positions = polygons->vertices.items;
    else
        mesh->positions = ARENA_ARRAY(&mesh->arena, vec3, count);
    for (uint32_t i = 0; i < polygons->vertices.count; i++) {
        if (!place[i])
            continue;
        place[i] = mesh->position_count;
        mesh->positions[mesh->position_count++] = polygons->vertices.items[i];
    }
    return place;
}

static void keep_normals(const struct polygons *polygons, struct mesh *mesh) {
    mesh->normal_count = polygons->normals.count;
    mesh->normals = ARENA_ARRAY(&mesh->arena, vec3, polygons->normals.count);
    for (uint32_t i = 0; i < polygons->normals.count; i++)
        mesh->normals[i] = vec3_unit(polygons->normals.items[i]);
}

struct face_buffer {
    uint32_t capacity;
    vec3 *corners;
    uint32_t *cuts;
};

static void add_face(const struct polygons *polygons, const uint32_t *place, const struct polygon_face *face,
                     const uint32_t *cuts, uint32_t triangles, const struct mesh *mesh,
                     struct mesh_triangle *out) {
    for (uint32_t t = 0; t < triangles; t++) {
        struct mesh_triangle *triangle = &out[t];
        triangle->group = face->group;
        triangle->line = face->line;
        for (int k = 0; k < 3; k++) {
            const struct polygon_corner *corner =
                &polygons->corners.items[face->first + cuts[3 * t + (uint32_t)k]];
            triangle->corners[k] = place[corner->vertex];
            // A normal of length 0 counts as none.
            bool has = corner->normal != IR_NO_INDEX && !vec3_is_zero(mesh->normals[corner->normal]);
            triangle->normals[k] = has ? corner->normal : IR_NO_INDEX;
        }
    }
}

// How far a corner is off the plane of the polygon (Newell's normal through the middle), as a share of its
// size.
static double bend_of(const vec3 *corners, uint32_t n) {
    vec3 middle = {0, 0, 0};
    vec3 normal = {0, 0, 0};
    for (uint32_t i = 0; i < n; i++)
        middle = vec3_add(middle, vec3_mul(vec3_sub(corners[i], corners[0]), 1.0 / n));
    middle = vec3_add(middle, corners[0]);
    double size = 0, off = 0;
    for (uint32_t i = 0; i < n; i++) {
        vec3 a = vec3_sub(corners[i], middle);
        vec3 b = vec3_sub(corners[i + 1 < n ? i + 1 : 0], middle);
        normal = vec3_add(normal, vec3_cross(a, b));
        size = fmax(size, 2 * vec3_length(a));
    }
    normal = vec3_unit(normal);
    for (uint32_t i = 0; i < n; i++)
        off = fmax(off, fabs(vec3_dot(vec3_sub(corners[i], middle), normal)));
    return size > 0 && off > RESOLUTION * vec3_max_abs(middle) ? off / size : 0;
}

static void measure_bend(struct mesh *mesh, const vec3 *corners, uint32_t n, uint32_t line) {
    double bend = bend_of(corners, n);
    if (bend <= BEND_SEEN)
        return;
    mesh_lose(mesh->losses, MESH_LOSS_BENT, line);
    if (bend > mesh->bent_most) {
        mesh->bent_most = bend;
        mesh->bent_line = line;
    }
}

static void count_lost_normals(const struct polygons *polygons, const struct polygon_face *face,
                               uint32_t corners, struct mesh *mesh) {
    for (uint32_t i = 0; i < corners; i++) {
        uint32_t normal = polygons->corners.items[face->first + i].normal;
        if (normal != IR_NO_INDEX && vec3_is_zero(mesh->normals[normal]))
            mesh_lose(mesh->losses, MESH_LOSS_NORMALS, face->line);
    }
}

static const uint32_t whole[3] = {0, 1, 2};

struct taking {
    const struct polygons *polygons;
    const uint32_t *place;
    const struct mesh *mesh;
};

static void take_faces(void *context, size_t begin, size_t end) {
    const struct taking *t = context;
    for (size_t i = begin; i < end; i++)
        add_face(t->polygons, t->place, &t->polygons->faces.items[i], whole, 1, t->mesh,
                 &t->mesh->triangles[i]);
}

// Whether every face is a triangle and no normal is lost: then faces do not depend on each other.
static bool are_plain(const struct polygons *polygons, const struct mesh *mesh) {
    bool are = polygons->triangle_count == polygons->faces.count;
    for (uint32_t i = 0; are && i < mesh->normal_count; i++)
        are = !vec3_is_zero(mesh->normals[i]);
    return are;
}

static void cut_faces(const struct polygons *polygons, const uint32_t *place, struct arena *scratch,
                      struct mesh *mesh) {
    struct face_buffer buffer = {0};
    struct triangulator triangulator;
    triangulate_init(&triangulator, scratch);
    mesh->triangles = ARENA_ARRAY(&mesh->arena, struct mesh_triangle, (size_t)polygons->triangle_count);
    if (are_plain(polygons, mesh)) {
        struct taking taking = {polygons, place, mesh};
        mesh->triangle_count = polygons->faces.count;
        parallel_for(mesh->triangle_count, PIECE, take_faces, &taking);
        return;
    }
    for (uint32_t f = 0; f < polygons->faces.count; f++) {
        const struct polygon_face *face = &polygons->faces.items[f];
        uint32_t end = f + 1 < polygons->faces.count ? face[1].first : polygons->corners.count;
        uint32_t n = end - face->first;
        count_lost_normals(polygons, face, n, mesh);
        if (n == 3) {
            add_face(polygons, place, face, whole, 1, mesh, &mesh->triangles[mesh->triangle_count++]);
            continue;
        }
        if (n > buffer.capacity) {
            buffer.capacity = n > 2 * buffer.capacity ? n : 2 * buffer.capacity;
            buffer.corners = ARENA_ARRAY(scratch, vec3, buffer.capacity);
            buffer.cuts = ARENA_ARRAY(scratch, uint32_t, heap_times(3, buffer.capacity));
        }
        for (uint32_t i = 0; i < n; i++)
            buffer.corners[i] = polygons->vertices.items[polygons->corners.items[face->first + i].vertex];
        measure_bend(mesh, buffer.corners, n, face->line);
        triangulate(&triangulator, buffer.corners, n, buffer.cuts);
        add_face(polygons, place, face, buffer.cuts, n - 2, mesh, &mesh->triangles[mesh->triangle_count]);
        mesh->triangle_count += n - 2;
    }
}

struct measuring {
    const struct mesh *mesh;
    atomic_uint zero_area;
};

static void count_zero_area(void *context, size_t begin, size_t end) {
    const struct mesh *mesh = ((struct measuring *)context)->mesh;
    uint32_t count = 0;
    for (size_t i = begin; i < end; i++)
        count += !mesh_has_area(mesh, (uint32_t)i);
    atomic_fetch_add(&((struct measuring *)context)->zero_area, count);
}

static void measure(struct mesh *mesh) {
    struct measuring measuring = {.mesh = mesh};
    mesh->lower = mesh->upper = mesh->positions[0];
    for (uint32_t i = 1; i < mesh->position_count; i++) {
        mesh->lower = vec3_least(mesh->lower, mesh->positions[i]);
        mesh->upper = vec3_greatest(mesh->upper, mesh->positions[i]);
    }
    parallel_for(mesh->triangle_count, PIECE, count_zero_area, &measuring);
    mesh->zero_area = measuring.zero_area;
}

// Memory of polygons that is no longer needed.
static struct mesh_room room_of(struct polygons *polygons, struct arena *scratch) {
    return (struct mesh_room){
        {{(char *)polygons->faces.items, polygons->faces.capacity * sizeof *polygons->faces.items},
         {(char *)polygons->corners.items, polygons->corners.capacity * sizeof *polygons->corners.items}},
        scratch};
}

static void take_positions_as_merged(struct mesh *mesh) {
    mesh->merged = ARENA_ARRAY(&mesh->arena, uint32_t, mesh->position_count);
    for (uint32_t i = 0; i < mesh->position_count; i++)
        mesh->merged[i] = i;
}

void mesh_build(struct polygons *polygons, str path, struct arena *scratch, struct mesh *mesh) {
    copy_names(polygons, path, mesh);
    uint32_t *place = keep_used_positions(polygons, scratch, mesh);
    keep_normals(polygons, mesh);
    cut_faces(polygons, place, scratch, mesh);
    measure(mesh);
    struct mesh_room room = room_of(polygons, scratch);
    if (polygons->is_joined)
        take_positions_as_merged(mesh);
    else
        mesh_merge_positions(mesh, &room);
    mesh_find_edges(mesh, &room);
    mesh_turn_outward(mesh);
}

void mesh_read(struct asset_file *file, struct arena *scratch, struct mesh *mesh) {
    struct polygons polygons;
    mesh_reader_of(file->path)->polygons(file, scratch, &polygons);
    mesh->arena.cap_bytes -= scratch->used_bytes;
    if (file->errors == 0)
        mesh_build(&polygons, file->path, scratch, mesh);
}

bool mesh_has_area(const struct mesh *mesh, uint32_t triangle) {
    const uint32_t *c = mesh->triangles[triangle].corners;
    vec3 u = vec3_sub(mesh->positions[c[1]], mesh->positions[c[0]]);
    vec3 v = vec3_sub(mesh->positions[c[2]], mesh->positions[c[0]]);
    if (!vec3_is_zero(vec3_cross(u, v)))
        return true;
    // Zero, or too small for a double: products of components scaled near 1 show which.
    double largest_u = vec3_max_abs(u);
    double largest_v = vec3_max_abs(v);
    if (!(largest_u > 0) || !(largest_v > 0))
        return false;
    int eu = -ilogb(largest_u);
    int ev = -ilogb(largest_v);
    u = (vec3){scalbn(u.x, eu), scalbn(u.y, eu), scalbn(u.z, eu)};
    v = (vec3){scalbn(v.x, ev), scalbn(v.y, ev), scalbn(v.z, ev)};
    return !vec3_is_zero(vec3_cross(u, v));
}
