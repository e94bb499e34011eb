#include "load/import/repeated.h"

#include "core/str_map.h"
#include "load/import/place.h"

#include <math.h>
#include <string.h>

enum {
    ENOUGH = 2
};

struct kind {
    uint32_t first;  // a node of this kind
    uint32_t bodies; // ENOUGH: so many or more
    uint32_t times;  // how often it is met in what is written
    uint32_t around; // how many objects are around it, at most
    bool has_body_below, is_whole, is_object;
};

struct kinds {
    const struct gltf *gltf;
    struct arena *arena;
    struct str_map numbers; // of kinds, by what they are
    struct kind *kinds;     // from 1
    uint32_t count;
    uint32_t *kind;         // by node; 0: there is nothing to see
    uint32_t *first, *next; // by node: 1 + the first below it, and 1 + the next below the one above it
};

bool import_has_faces(const struct gltf *gltf, uint32_t mesh) {
    const struct gltf_mesh *m = &gltf->meshes.items[mesh];
    uint64_t triangles = 0;
    for (uint32_t i = m->first; i < m->first + m->count; i++)
        triangles += gltf_triangle_count(gltf, &gltf->primitives.items[i]);
    return triangles > 0;
}

// Whether places of what is below can be told from this one without loss.
static bool is_ordinary(const affine3 *world) {
    double least = INFINITY, most = 0;
    for (int i = 0; i < 3; i++) {
        const double size = vec3_length(mat3_column(world->linear, i));
        least = fmin(least, size);
        most = fmax(most, size);
    }
    return least >= 1e-6 && most <= 1e6 && most <= 100 * least && vec3_max_abs(world->offset) <= 1e6 &&
           import_room(world->linear) >= 1e-3;
}

// ---- kinds

struct key {
    uint32_t mesh, light, camera, alone; // alone: 1 + a node that is of a kind of its own
};
struct key_below {
    double place[12];
    uint32_t kind, unused;
};

static str key_of(struct kinds *k, const struct key *key, uint32_t node) {
    size_t size = sizeof *key;
    for (uint32_t at = k->first[node]; at; at = k->next[at - 1])
        size += sizeof(struct key_below);
    char *bytes = arena_alloc(k->arena, size), *end = bytes + sizeof *key;
    memcpy(bytes, key, sizeof *key);
    for (uint32_t at = k->first[node]; at; at = k->next[at - 1], end += sizeof(struct key_below)) {
        const affine3 *local = &k->gltf->nodes.items[at - 1].local;
        struct key_below below = {.kind = k->kind[at - 1]};
        memcpy(below.place, local, sizeof below.place);
        for (int i = 0; i < 12; i++)
            below.place[i] += 0.0; // of -0
        memcpy(end, &below, sizeof below);
    }
    return (str){bytes, size};
}

// What is below the node has its kind already.
static void put_kind(struct kinds *k, uint32_t index) {
    const struct gltf_node *node = &k->gltf->nodes.items[index];
    const bool is_body = node->mesh != GLTF_NONE && import_has_faces(k->gltf, node->mesh);
    const bool is_ordinary_here = is_ordinary(&node->world);
    const struct key key = {is_body ? node->mesh : GLTF_NONE, node->light, node->camera,
                            is_ordinary_here ? 0 : index + 1};
    struct kind kind = {.first = index, .bodies = is_body};
    kind.is_whole = node->camera == GLTF_NONE && is_ordinary_here;
    for (uint32_t at = k->first[index]; at; at = k->next[at - 1]) {
        const struct kind *below = &k->kinds[k->kind[at - 1]];
        kind.bodies += below->bodies;
        kind.has_body_below |= below->bodies > 0;
        kind.is_whole &= below->is_whole;
    }
    if (!k->first[index] && !is_body && node->light == GLTF_NONE && node->camera == GLTF_NONE)
        return;
    kind.bodies = kind.bodies < ENOUGH ? kind.bodies : ENOUGH;
    uint32_t *number = str_map_at(&k->numbers, key_of(k, &key, index));
    if (!*number) {
        *number = ++k->count;
        k->kinds[*number] = kind;
    }
    k->kind[index] = *number;
    if (node->parent != GLTF_NONE) {
        k->next[index] = k->first[node->parent];
        k->first[node->parent] = index + 1;
    } else {
        k->kinds[*number].times++;
    }
}

// Kinds are numbered from those below to those above.
static void find_objects(struct kinds *k, uint32_t depth) {
    for (uint32_t i = k->count; i > 0; i--) {
        struct kind *kind = &k->kinds[i];
        kind->is_object = kind->is_whole && kind->times > 1 && kind->around + 1 < depth &&
                          (kind->bodies >= ENOUGH || kind->has_body_below);
        const uint32_t times = kind->is_object ? 1 : kind->times, around = kind->around + kind->is_object;
        for (uint32_t at = k->first[kind->first]; at; at = k->next[at - 1]) {
            struct kind *below = &k->kinds[k->kind[at - 1]];
            below->times += times;
            below->around = around > below->around ? around : below->around;
        }
    }
}

const uint32_t *import_repeated(const struct gltf *gltf, const struct limits *limits, struct arena *arena) {
    const size_t count = (size_t)gltf->nodes.count + 1;
    struct kinds k = {.gltf = gltf, .arena = arena};
    k.kind = ARENA_ARRAY(arena, uint32_t, count);
    if (2 * (uint64_t)gltf->order_count > limits->value[LIMIT_COPIES]) // what instances make is counted
        return k.kind;
    k.first = ARENA_ARRAY(arena, uint32_t, count);
    k.next = ARENA_ARRAY(arena, uint32_t, count);
    k.kinds = ARENA_ARRAY(arena, struct kind, count);
    str_map_init(&k.numbers, arena);
    for (uint32_t i = gltf->order_count; i > 0; i--)
        put_kind(&k, gltf->order[i - 1]);
    find_objects(&k, (uint32_t)limits->value[LIMIT_OBJECT_DEPTH]);
    for (uint32_t i = 0; i < gltf->nodes.count; i++)
        k.kind[i] = k.kinds[k.kind[i]].is_object ? k.kind[i] : 0;
    return k.kind;
}
