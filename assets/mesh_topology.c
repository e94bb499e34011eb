// What a mesh encloses: equal positions, edges without their opposite, volume.
#include "assets/mesh_build.h"

#include "core/heap.h"
#include "core/parallel.h"

#include <stdlib.h>
#include <string.h>

enum {
    INSERTION_SORT_MAX = 24,
    PIECE = 1 << 14, // lower ends of edges, in parallel work
    ROOM_ALIGN = 16,
    EXPONENT_MAX = 1000, // of a power of two that is a double
};

// `count` items of `size` bytes, not cleared.
static void *take(struct mesh_room *room, uint64_t count, size_t size) {
    const size_t bytes = (heap_times(count, size) + ROOM_ALIGN - 1) / ROOM_ALIGN * ROOM_ALIGN;
    for (int i = 0; i < 2; i++) {
        if (room->used[i].left < bytes)
            continue;
        void *taken = room->used[i].at;
        room->used[i].at += bytes;
        room->used[i].left -= bytes;
        return taken;
    }
    return arena_alloc_array(room->scratch, count, size);
}

static void *take_zeroed(struct mesh_room *room, uint64_t count, size_t size) {
    return memset(take(room, count, size), 0, heap_times(count, size));
}

// ---- equal positions

static uint64_t position_hash(vec3 p) {
    uint64_t bits[3];
    memcpy(bits, &p, sizeof bits);
    // The finalizer of MurmurHash3 over each part.
    uint64_t hash = 0;
    for (int i = 0; i < 3; i++) {
        hash = (hash ^ bits[i]) * UINT64_C(0xff51afd7ed558ccd);
        hash = (hash ^ hash >> 33) * UINT64_C(0xc4ceb9fe1a85ec53);
        hash ^= hash >> 33;
    }
    return hash;
}

void mesh_merge_positions(struct mesh *mesh, struct mesh_room *room) {
    uint64_t slots = 16;
    while (slots < 2 * (uint64_t)mesh->position_count)
        slots *= 2;
    uint32_t *table = take_zeroed(room, slots, sizeof *table); // index plus 1
    mesh->merged = ARENA_ARRAY(&mesh->arena, uint32_t, mesh->position_count);
    for (uint32_t i = 0; i < mesh->position_count; i++) {
        uint64_t at = position_hash(mesh->positions[i]) & (slots - 1);
        while (table[at] && memcmp(&mesh->positions[table[at] - 1], &mesh->positions[i], sizeof(vec3)) != 0)
            at = (at + 1) & (slots - 1);
        if (!table[at])
            table[at] = i + 1;
        mesh->merged[i] = table[at] - 1;
    }
}

// ---- edges

// An edge, stored with its end of lower index.
struct half_edge {
    uint32_t other;    // the end of higher index
    uint32_t triangle; // times two, plus 1 if the edge leads to the lower end
};

static int compare_edges(const void *a, const void *b) {
    const struct half_edge *x = a;
    const struct half_edge *y = b;
    if (x->other != y->other)
        return x->other < y->other ? -1 : 1;
    return x->triangle < y->triangle ? -1 : x->triangle > y->triangle;
}

static void sort_edges(struct half_edge *edges, uint32_t n) {
    if (n > INSERTION_SORT_MAX) {
        qsort(edges, n, sizeof *edges, compare_edges);
        return;
    }
    for (uint32_t i = 1; i < n; i++) {
        struct half_edge moving = edges[i];
        uint32_t at = i;
        for (; at > 0 && compare_edges(&moving, &edges[at - 1]) < 0; at--)
            edges[at] = edges[at - 1];
        edges[at] = moving;
    }
}

// The open edges of some of the lower ends.
struct open_edges {
    uint32_t count, line; // line: of the first face, 0: none
};

static void note_line(struct open_edges *open, uint32_t line) {
    if (line && (open->line == 0 || line < open->line))
        open->line = line;
}

static void note_open(const struct mesh *mesh, struct open_edges *open, const struct half_edge *edges,
                      uint32_t n, int64_t surplus) {
    open->count += (uint32_t)(surplus < 0 ? -surplus : surplus);
    for (uint32_t i = 0; i < n; i++) {
        bool leads_down = edges[i].triangle & 1;
        if (leads_down == (surplus < 0))
            note_line(open, mesh->triangles[edges[i].triangle / 2].line);
    }
}

// The edges of one lower end, sorted by the other: an edge is open if the two directions differ in number.
static void compare_directions(const struct mesh *mesh, struct open_edges *open,
                               const struct half_edge *edges, uint32_t n) {
    for (uint32_t begin = 0, end; begin < n; begin = end) {
        int64_t surplus = 0;
        for (end = begin; end < n && edges[end].other == edges[begin].other; end++)
            surplus += edges[end].triangle & 1 ? -1 : 1;
        if (surplus != 0)
            note_open(mesh, open, edges + begin, end - begin, surplus);
    }
}

struct comparison {
    const struct mesh *mesh;
    const uint32_t *first; // edge of each lower end
    struct half_edge *edges;
    struct open_edges *found; // for each piece
};

static void compare_piece(void *context, size_t begin, size_t end) {
    const struct comparison *c = context;
    for (size_t i = begin; i < end; i++) {
        const uint32_t n = c->first[i + 1] - c->first[i];
        sort_edges(c->edges + c->first[i], n);
        compare_directions(c->mesh, &c->found[begin / PIECE], c->edges + c->first[i], n);
    }
}

struct triangle_edge {
    uint32_t low, high;
    bool leads_down;
};

// Fills in the edges that have a length: an edge without one is its own opposite. Returns how many there are.
static uint32_t edges_of(const struct mesh *mesh, uint32_t triangle, struct triangle_edge edges[3]) {
    const uint32_t *corners = mesh->triangles[triangle].corners;
    const uint32_t ends[4] = {mesh->merged[corners[0]], mesh->merged[corners[1]], mesh->merged[corners[2]],
                              mesh->merged[corners[0]]};
    uint32_t count = 0;
    for (int k = 0; k < 3; k++) {
        const uint32_t a = ends[k], b = ends[k + 1];
        edges[count] = (struct triangle_edge){a < b ? a : b, a < b ? b : a, b < a};
        count += a != b;
    }
    return count;
}

void mesh_find_edges(struct mesh *mesh, struct mesh_room *room) {
    // Sorted by their lower end by counting: one pass over memory, where a hash table would jump around.
    uint32_t *first = take_zeroed(room, (size_t)mesh->position_count + 1, sizeof *first);
    struct half_edge *edges = take(room, heap_times(3, mesh->triangle_count), sizeof *edges);
    struct triangle_edge found[3];
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (uint32_t k = edges_of(mesh, t, found); k > 0; k--)
            first[found[k - 1].low]++;
    uint32_t sum = 0;
    for (uint32_t i = 0; i <= mesh->position_count; i++) {
        sum += first[i];
        first[i] = sum;
    }
    for (uint32_t t = mesh->triangle_count; t > 0; t--)
        for (uint32_t k = edges_of(mesh, t - 1, found); k > 0; k--)
            edges[--first[found[k - 1].low]] =
                (struct half_edge){found[k - 1].high, 2 * (t - 1) + found[k - 1].leads_down};
    const uint32_t pieces = mesh->position_count / PIECE + 1;
    struct comparison comparison = {mesh, first, edges,
                                    ARENA_ARRAY(room->scratch, struct open_edges, pieces)};
    parallel_for(mesh->position_count, PIECE, compare_piece, &comparison);
    struct open_edges all = {0};
    for (uint32_t i = 0; i < pieces; i++) {
        all.count += comparison.found[i].count;
        note_line(&all, comparison.found[i].line);
    }
    mesh->open_edges = all.count;
    mesh->open_line = all.line;
    mesh->closed = mesh->open_edges == 0;
}

// ---- volume

// Brings the extent of the mesh near 1, so that no product of three lengths underflows or overflows.
static double extent_scale(vec3 size) {
    double largest = vec3_max_abs(size);
    if (!(largest > 0))
        return 0;
    int exponent = -ilogb(largest);
    return scalbn(1, exponent < EXPONENT_MAX ? exponent : EXPONENT_MAX);
}

// A sixth of the sum of a·(b×c), relative to the middle of the mesh, times scale cubed. *rounding is the
// largest possible error of the sum.
static double scaled_volume(const struct mesh *mesh, double scale, double *rounding) {
    vec3 middle = vec3_add(mesh->lower, vec3_mul(vec3_sub(mesh->upper, mesh->lower), 0.5));
    double sum = 0;
    double magnitude = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        vec3 p[3];
        for (int k = 0; k < 3; k++)
            p[k] = vec3_mul(vec3_sub(mesh->positions[mesh->triangles[t].corners[k]], middle), scale);
        sum += vec3_dot(p[0], vec3_cross(p[1], p[2]));
        magnitude += vec3_max_abs(p[0]) * vec3_max_abs(p[1]) * vec3_max_abs(p[2]);
    }
    *rounding = scalbn(magnitude, -48);
    return sum / 6;
}

void mesh_turn_outward(struct mesh *mesh) {
    double scale = mesh->closed ? extent_scale(vec3_sub(mesh->upper, mesh->lower)) : 0;
    if (!(scale > 0))
        return;
    // The sign is that of the scaled volume: the volume itself can be too small for a double.
    double rounding;
    double scaled = scaled_volume(mesh, scale, &rounding);
    mesh->volume = scaled / scale / scale / scale;
    // A sheet whose every face has an opposite twin encloses nothing, whatever the rounding.
    if (!(scaled < -rounding))
        return;
    mesh->turned = true;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        struct mesh_triangle *triangle = &mesh->triangles[t];
        uint32_t corner = triangle->corners[1];
        uint32_t normal = triangle->normals[1];
        triangle->corners[1] = triangle->corners[2];
        triangle->normals[1] = triangle->normals[2];
        triangle->corners[2] = corner;
        triangle->normals[2] = normal;
    }
}
