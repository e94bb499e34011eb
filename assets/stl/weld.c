#include "assets/stl/weld.h"

#include <math.h>
#include <string.h>

enum {
    SLOTS_LEAST = 64,
    FULL_OF = 3, // two thirds of the slots are used at most
    SPARE = 64,  // out of so many vertices, room for one more does not matter
};

// A position as bits: equal numbers are equal bits where none is -0 or NaN.
struct bits {
    uint64_t xy;
    uint32_t z;
};

static struct bits bits_of(const float *position) {
    struct bits bits;
    memcpy(&bits.xy, position, sizeof bits.xy);
    memcpy(&bits.z, position + 2, sizeof bits.z);
    return bits;
}

static uint64_t hash_of(struct bits bits) {
    // Multipliers as in the finalizer of MurmurHash3.
    uint64_t hash = bits.xy * UINT64_C(0xff51afd7ed558ccd);
    hash = (hash ^ hash >> 32 ^ bits.z) * UINT64_C(0xc4ceb9fe1a85ec53);
    return hash ^ hash >> 32;
}

static uint32_t place_of(const struct weld *weld, uint64_t hash) {
    return (uint32_t)hash & (weld->slot_count - 1);
}

static bool is_full(const struct weld *weld) {
    return (uint64_t)weld->out->vertices.count * FULL_OF >= (uint64_t)weld->slot_count * (FULL_OF - 1);
}

static void put(struct weld *weld, uint64_t slot, uint64_t hash) {
    uint32_t at = place_of(weld, hash);
    while (weld->slots[at])
        at = (at + 1) & (weld->slot_count - 1);
    weld->slots[at] = slot;
}

static void make_slots(struct weld *weld, uint32_t count) {
    arena_give_back(weld->arena, weld->slots, weld->slot_count, sizeof *weld->slots);
    weld->slots = ARENA_ARRAY(weld->arena, uint64_t, count);
    weld->slot_count = count;
    for (uint32_t i = 0; i < weld->out->vertices.count; i++) {
        const vec3 *v = &weld->out->vertices.items[i];
        const float position[3] = {(float)v->x, (float)v->y, (float)v->z};
        const uint64_t hash = hash_of(bits_of(position));
        put(weld, (hash >> 32 << 32) | (i + 1), hash);
    }
}

void weld_init(struct weld *weld, struct arena *arena, struct polygons *out, uint32_t expected) {
    uint32_t count = SLOTS_LEAST;
    *weld = (struct weld){.arena = arena, .out = out};
    while ((uint64_t)count * (FULL_OF - 1) <= (uint64_t)expected * FULL_OF)
        count *= 2;
    make_slots(weld, count);
    for (int i = 0; i < WELD_FLOATS; i++)
        weld->batches[0].positions[i] = NAN; // equals no corner
    out->vertices.items = ARENA_ARRAY(arena, vec3, expected);
    out->vertices.capacity = expected;
}

static uint32_t add_vertex(struct weld *weld, const float *position) {
    struct polygons *out = weld->out;
    if (ARENA_IS_FULL(&out->vertices))
        out->vertices.items = arena_regrow(weld->arena, out->vertices.items, out->vertices.count,
                                           &out->vertices.capacity, sizeof *out->vertices.items);
    out->vertices.items[out->vertices.count++] =
        (vec3){(double)position[0], (double)position[1], (double)position[2]};
    return out->vertices.count;
}

static bool is_at(const struct weld *weld, uint32_t vertex, const float *position) {
    const vec3 *v = &weld->out->vertices.items[vertex];
    return v->x == (double)position[0] && v->y == (double)position[1] && v->z == (double)position[2];
}

static uint32_t weld_one(struct weld *weld, const float *position, uint64_t hash) {
    const uint32_t mask = weld->slot_count - 1;
    uint32_t at = place_of(weld, hash);
    for (uint64_t slot; (slot = weld->slots[at]) != 0; at = (at + 1) & mask)
        if (slot >> 32 == hash >> 32 && is_at(weld, (uint32_t)slot - 1, position))
            return (uint32_t)slot - 1;
    const uint32_t vertex = add_vertex(weld, position);
    weld->slots[at] = (hash >> 32 << 32) | vertex;
    if (is_full(weld))
        make_slots(weld, 2 * weld->slot_count);
    return vertex - 1;
}

static bool are_equal(const float *a, const float *b) {
    const struct bits x = bits_of(a), y = bits_of(b);
    return x.xy == y.xy && x.z == y.z;
}

// How many corners back, in the facet before, the same corner is; 0: it is not there. Hashes are compared
// without branches, since which one matches cannot be predicted.
static uint32_t link_of(const struct weld_batch *batch, uint32_t corner, uint32_t before) {
    const uint64_t *hashes = batch->hashes;
    const uint64_t hash = hashes[corner];
    uint32_t link = 0;
    for (uint32_t k = before; k < before + WELD_CORNERS; k++)
        link = hash == hashes[k] ? corner - k : link;
    const float *position = batch->positions + 3 * (size_t)corner;
    return link && are_equal(position, position - 3 * (size_t)link) ? link : 0;
}

float *weld_room(struct weld *weld) {
    return weld->batches[weld->filling].positions + WELD_FLOATS;
}

static void ask_for(const struct weld *weld, struct weld_batch *batch) {
    for (uint32_t first = WELD_CORNERS; first < WELD_CORNERS * (batch->count + 1); first += WELD_CORNERS)
        for (uint32_t i = first; i < first + WELD_CORNERS; i++) {
            batch->hashes[i] = hash_of(bits_of(batch->positions + 3 * (size_t)i));
            batch->links[i] = link_of(batch, i, first - WELD_CORNERS);
            if (!batch->links[i])
                __builtin_prefetch(&weld->slots[place_of(weld, batch->hashes[i])], 1);
        }
}

static void settle(struct weld *weld, struct weld_batch *batch) {
    struct polygon_corner *corner = batch->corners;
    for (uint32_t i = WELD_CORNERS; i < WELD_CORNERS * (batch->count + 1); i++, corner++) {
        const uint32_t link = batch->links[i];
        const uint32_t vertex = link ? (corner - link)->vertex
                                     : weld_one(weld, batch->positions + 3 * (size_t)i, batch->hashes[i]);
        *corner = (struct polygon_corner){vertex, IR_NO_INDEX};
    }
    batch->count = 0;
}

void weld_facets(struct weld *weld, uint32_t count, struct polygon_corner *corners) {
    struct weld_batch *batch = &weld->batches[weld->filling], *other = &weld->batches[!weld->filling];
    batch->count = count;
    batch->corners = corners;
    ask_for(weld, batch);
    settle(weld, other);
    memcpy(other->positions, batch->positions + WELD_FLOATS * (size_t)count, WELD_FLOATS * sizeof(float));
    memcpy(other->hashes, batch->hashes + WELD_CORNERS * (size_t)count, WELD_CORNERS * sizeof(uint64_t));
    weld->filling = !weld->filling;
}

void weld_finish(struct weld *weld) {
    struct polygons *out = weld->out;
    settle(weld, &weld->batches[!weld->filling]);
    const uint32_t room = out->vertices.capacity - out->vertices.count;
    arena_give_back(weld->arena, weld->slots, weld->slot_count, sizeof *weld->slots);
    weld->slots = NULL;
    if (room <= out->vertices.count / SPARE)
        out->vertices.capacity = out->vertices.count;
}
