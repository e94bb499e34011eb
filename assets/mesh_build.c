#include "assets/mesh_build.h"

#include "assets/triangulate.h"
#include "core/heap.h"
#include "core/parallel.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

// How far a corner must be off its face's plane to be told of: of the face's size, and, for what a file of
// six digits leaves open, of its coordinates.
#define BEND_SEEN  0.001
#define RESOLUTION 0x1p-18

enum {
    PIECE = 1 << 14, // triangles, in parallel work
};

static void copy_names(const struct obj *obj, str path, struct mesh *mesh) {
    struct arena *arena = &mesh->arena;
    mesh->path = arena_copy(arena, path);
    mesh->group_count = obj->groups.count;
    mesh->groups = ARENA_ARRAY(arena, struct mesh_group, obj->groups.count);
    for (uint32_t i = 0; i < obj->groups.count; i++) {
        mesh->groups[i] = obj->groups.items[i];
        mesh->groups[i].name = arena_copy(arena, mesh->groups[i].name);
    }
    mesh->library_count = obj->libraries.count;
    mesh->libraries = ARENA_ARRAY(arena, struct mesh_library, obj->libraries.count);
    for (uint32_t i = 0; i < obj->libraries.count; i++) {
        mesh->libraries[i] = obj->libraries.items[i];
        mesh->libraries[i].names = arena_copy(arena, mesh->libraries[i].names);
    }
    memcpy(mesh->losses, obj->losses, sizeof mesh->losses);
    mesh->face_count = obj->faces.count;
}

// Positions that faces use, in file order. Returns the new index of each vertex.
static uint32_t *keep_used_positions(struct obj *obj, struct arena *scratch, struct mesh *mesh) {
    uint32_t *place = ARENA_ARRAY(scratch, uint32_t, obj->vertices.count);
    for (uint32_t i = 0; i < obj->corners.count; i++)
        place[obj->corners.items[i].vertex] = 1;
    uint32_t count = 0;
    for (uint32_t i = 0; i < obj->vertices.count; i++)
        count += place[i];
    const bool all = count == obj->vertices.count && count == obj->vertices.capacity;
    if (all && arena_hand_over(scratch, &mesh->arena, obj->vertices.items, count, sizeof(vec3)))
        mesh->positions = obj->vertices.items;
    else
        mesh->positions = ARENA_ARRAY(&mesh->arena, vec3, count);
    for (uint32_t i = 0; i < obj->vertices.count; i++) {
        if (!place[i])
            continue;
        place[i] = mesh->position_count;
        mesh->positions[mesh->position_count++] = obj->vertices.items[i];
    }
    return place;
}

static void keep_normals(const struct obj *obj, struct mesh *mesh) {
    mesh->normal_count = obj->normals.count;
    mesh->normals = ARENA_ARRAY(&mesh->arena, vec3, obj->normals.count);
    for (uint32_t i = 0; i < obj->normals.count; i++)
        mesh->normals[i] = vec3_unit(obj->normals.items[i]);
}

struct face_buffer {
    uint32_t capacity;
    vec3 *corners;
    uint32_t *cuts;
};

static void add_face(const struct obj *obj, const uint32_t *place, const struct obj_face *face,
                     const uint32_t *cuts, uint32_t triangles, const struct mesh *mesh,
                     struct mesh_triangle *out) {
    for (uint32_t t = 0; t < triangles; t++) {
        struct mesh_triangle *triangle = &out[t];
        triangle->group = face->group;
        triangle->line = face->line;
        for (int k = 0; k < 3; k++) {
            const struct obj_corner *corner = &obj->corners.items[face->first + cuts[3 * t + (uint32_t)k]];
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
    mesh->bent_most = fmax(mesh->bent_most, bend);
}

static void count_lost_normals(const struct obj *obj, const struct obj_face *face, uint32_t corners,
                               struct mesh *mesh) {
    for (uint32_t i = 0; i < corners; i++) {
        uint32_t normal = obj->corners.items[face->first + i].normal;
        if (normal != IR_NO_INDEX && vec3_is_zero(mesh->normals[normal]))
            mesh_lose(mesh->losses, MESH_LOSS_NORMALS, face->line);
    }
}

static const uint32_t whole[3] = {0, 1, 2};

struct taking {
    const struct obj *obj;
    const uint32_t *place;
    const struct mesh *mesh;
};

static void take_faces(void *context, size_t begin, size_t end) {
    const struct taking *t = context;
    for (size_t i = begin; i < end; i++)
        add_face(t->obj, t->place, &t->obj->faces.items[i], whole, 1, t->mesh, &t->mesh->triangles[i]);
}

// Whether every face is a triangle and no normal is lost: then faces do not depend on each other.
static bool are_plain(const struct obj *obj, const struct mesh *mesh) {
    bool are = obj->triangle_count == obj->faces.count;
    for (uint32_t i = 0; are && i < mesh->normal_count; i++)
        are = !vec3_is_zero(mesh->normals[i]);
    return are;
}

static void cut_faces(const struct obj *obj, const uint32_t *place, struct arena *scratch,
                      struct mesh *mesh) {
    struct face_buffer buffer = {0};
    struct triangulator triangulator;
    triangulate_init(&triangulator, scratch);
    mesh->triangles = ARENA_ARRAY(&mesh->arena, struct mesh_triangle, obj->triangle_count);
    if (are_plain(obj, mesh)) {
        struct taking taking = {obj, place, mesh};
        mesh->triangle_count = obj->faces.count;
        parallel_for(mesh->triangle_count, PIECE, take_faces, &taking);
        return;
    }
    for (uint32_t f = 0; f < obj->faces.count; f++) {
        const struct obj_face *face = &obj->faces.items[f];
        uint32_t end = f + 1 < obj->faces.count ? face[1].first : obj->corners.count;
        uint32_t n = end - face->first;
        count_lost_normals(obj, face, n, mesh);
        if (n == 3) {
            add_face(obj, place, face, whole, 1, mesh, &mesh->triangles[mesh->triangle_count++]);
            continue;
        }
        if (n > buffer.capacity) {
            buffer.capacity = n > 2 * buffer.capacity ? n : 2 * buffer.capacity;
            buffer.corners = ARENA_ARRAY(scratch, vec3, buffer.capacity);
            buffer.cuts = ARENA_ARRAY(scratch, uint32_t, heap_times(3, buffer.capacity));
        }
        for (uint32_t i = 0; i < n; i++)
            buffer.corners[i] = obj->vertices.items[obj->corners.items[face->first + i].vertex];
        measure_bend(mesh, buffer.corners, n, face->line);
        triangulate(&triangulator, buffer.corners, n, buffer.cuts);
        add_face(obj, place, face, buffer.cuts, n - 2, mesh, &mesh->triangles[mesh->triangle_count]);
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

// Of what is not needed any more.
static struct mesh_room room_of(struct obj *obj, struct arena *scratch) {
    return (struct mesh_room){
        {{(char *)obj->faces.items, obj->faces.capacity * sizeof *obj->faces.items},
         {(char *)obj->corners.items, obj->corners.capacity * sizeof *obj->corners.items}},
        scratch};
}

void mesh_build(struct obj *obj, str path, struct arena *scratch, struct mesh *mesh) {
    copy_names(obj, path, mesh);
    uint32_t *place = keep_used_positions(obj, scratch, mesh);
    keep_normals(obj, mesh);
    cut_faces(obj, place, scratch, mesh);
    measure(mesh);
    struct mesh_room room = room_of(obj, scratch);
    mesh_merge_positions(mesh, &room);
    mesh_find_edges(mesh, &room);
    mesh_turn_outward(mesh);
}

void mesh_read(struct asset_file *file, struct arena *scratch, struct mesh *mesh) {
    struct obj obj;
    read_obj(file, scratch, &obj);
    mesh->arena.cap_bytes -= scratch->used_bytes;
    if (file->errors == 0)
        mesh_build(&obj, file->path, scratch, mesh);
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
