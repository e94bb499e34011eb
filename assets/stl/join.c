#include "assets/stl/join.h"

#include <string.h>

enum {
    SLOTS_LEAST = 64,
    AT_ONCE = 96,
};

static uint64_t hash_of(vec3 p) {
    uint64_t bits[3];
    memcpy(bits, &p, sizeof bits);
    // Multipliers as in the finalizer of MurmurHash3.
    uint64_t hash = bits[0] * UINT64_C(0xff51afd7ed558ccd);
    hash = (hash ^ hash >> 32 ^ bits[1]) * UINT64_C(0xc4ceb9fe1a85ec53);
    hash = (hash ^ hash >> 32 ^ bits[2]) * UINT64_C(0xff51afd7ed558ccd);
    return hash ^ hash >> 32;
}

static uint32_t *slot_of(const struct join *join, vec3 position, uint64_t hash) {
    const vec3 *vertices = join->out->vertices.items;
    uint32_t at = (uint32_t)hash & (join->slot_count - 1);
    while (join->slots[at]) {
        const vec3 *other = &vertices[join->slots[at] - 1];
        // Equal numbers are equal bits where none is -0 or NaN.
        if (other->x == position.x && other->y == position.y && other->z == position.z)
            break;
        at = (at + 1) & (join->slot_count - 1);
    }
    return &join->slots[at];
}

static void make_slots(struct join *join, uint32_t count) {
    uint32_t *old = join->slots;
    const uint32_t old_count = join->slot_count;
    join->slots = ARENA_ARRAY(join->arena, uint32_t, count);
    join->slot_count = count;
    for (uint32_t i = 0; i < join->out->vertices.count; i++)
        *slot_of(join, join->out->vertices.items[i], hash_of(join->out->vertices.items[i])) = i + 1;
    if (old)
        arena_give_back(join->arena, old, old_count, sizeof *old);
}

void join_init(struct join *join, struct arena *arena, struct polygons *out, uint32_t expected) {
    uint32_t count = SLOTS_LEAST;
    *join = (struct join){.arena = arena, .out = out};
    while (count / 2 < expected)
        count *= 2;
    make_slots(join, count);
}

static uint32_t join_vertex(struct join *join, vec3 position, uint64_t hash) {
    uint32_t *slot = slot_of(join, position, hash);
    if (*slot)
        return *slot - 1;
    if (ARENA_IS_FULL(&join->out->vertices))
        join->out->vertices.items =
            arena_regrow(join->arena, join->out->vertices.items, join->out->vertices.count,
                         &join->out->vertices.capacity, sizeof *join->out->vertices.items);
    join->out->vertices.items[join->out->vertices.count++] = position;
    *slot = join->out->vertices.count;
    if (join->out->vertices.count > join->slot_count / 2)
        make_slots(join, 2 * join->slot_count);
    return join->out->vertices.count - 1;
}

static void join_few(struct join *join, const vec3 *positions, uint32_t count, uint32_t *numbers) {
    uint64_t hashes[AT_ONCE];
    for (uint32_t i = 0; i < count; i++) {
        hashes[i] = hash_of(positions[i]);
        __builtin_prefetch(&join->slots[(uint32_t)hashes[i] & (join->slot_count - 1)]);
    }
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t slot = join->slots[(uint32_t)hashes[i] & (join->slot_count - 1)];
        if (slot)
            __builtin_prefetch(&join->out->vertices.items[slot - 1]);
    }
    for (uint32_t i = 0; i < count; i++)
        numbers[i] = join_vertex(join, positions[i], hashes[i]);
}

void join_vertices(struct join *join, const vec3 *positions, uint32_t count, uint32_t *numbers) {
    for (uint32_t first = 0; first < count; first += AT_ONCE)
        join_few(join, positions + first, count - first < AT_ONCE ? count - first : AT_ONCE, numbers + first);
}
