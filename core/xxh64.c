#include "core/xxh64.h"

#include <string.h>

#define PRIME_1 UINT64_C(0x9E3779B185EBCA87)
#define PRIME_2 UINT64_C(0xC2B2AE3D27D4EB4F)
#define PRIME_3 UINT64_C(0x165667B19E3779F9)
#define PRIME_4 UINT64_C(0x85EBCA77C2B2AE63)
#define PRIME_5 UINT64_C(0x27D4EB2F165667C5)

static uint64_t turned(uint64_t x, int bits) {
    return x << bits | x >> (64 - bits);
}

// Little endian, whatever the machine.
static uint64_t read_word(const unsigned char *p, int bytes) {
    uint64_t word = 0;
    for (int i = 0; i < bytes; i++)
        word |= (uint64_t)p[i] << (8 * i);
    return word;
}

static uint64_t step(uint64_t lane, uint64_t word) {
    return turned(lane + word * PRIME_2, 31) * PRIME_1;
}

static void add_stripe(struct xxh64 *s, const unsigned char *p) {
    for (int i = 0; i < 4; i++)
        s->lanes[i] = step(s->lanes[i], read_word(p + 8 * i, 8));
}

void xxh64_begin(struct xxh64 *s, uint64_t seed) {
    *s = (struct xxh64){.lanes = {seed + PRIME_1 + PRIME_2, seed + PRIME_2, seed, seed - PRIME_1},
                        .seed = seed};
}

void xxh64_add(struct xxh64 *s, const void *bytes, size_t count) {
    const unsigned char *p = bytes;
    s->total_bytes += count;
    if (s->rest_count) {
        size_t room = sizeof s->rest - s->rest_count;
        size_t taken = count < room ? count : room;
        memcpy(s->rest + s->rest_count, p, taken);
        s->rest_count += taken;
        p += taken;
        count -= taken;
        if (s->rest_count < sizeof s->rest)
            return;
        add_stripe(s, s->rest);
        s->rest_count = 0;
    }
    for (; count >= sizeof s->rest; p += sizeof s->rest, count -= sizeof s->rest)
        add_stripe(s, p);
    if (count)
        memcpy(s->rest, p, count);
    s->rest_count = count;
}

static uint64_t join_lanes(const struct xxh64 *s) {
    static const int turns[4] = {1, 7, 12, 18};
    uint64_t hash = 0;
    for (int i = 0; i < 4; i++)
        hash += turned(s->lanes[i], turns[i]);
    for (int i = 0; i < 4; i++)
        hash = (hash ^ step(0, s->lanes[i])) * PRIME_1 + PRIME_4;
    return hash;
}

uint64_t xxh64_end(const struct xxh64 *s) {
    uint64_t hash = s->total_bytes >= sizeof s->rest ? join_lanes(s) : s->seed + PRIME_5;
    hash += s->total_bytes;
    size_t at = 0;
    for (; at + 8 <= s->rest_count; at += 8)
        hash = turned(hash ^ step(0, read_word(s->rest + at, 8)), 27) * PRIME_1 + PRIME_4;
    if (at + 4 <= s->rest_count) {
        hash = turned(hash ^ read_word(s->rest + at, 4) * PRIME_1, 23) * PRIME_2 + PRIME_3;
        at += 4;
    }
    for (; at < s->rest_count; at++)
        hash = turned(hash ^ s->rest[at] * PRIME_5, 11) * PRIME_1;
    hash = (hash ^ hash >> 33) * PRIME_2;
    hash = (hash ^ hash >> 29) * PRIME_3;
    return hash ^ hash >> 32;
}

uint64_t xxh64_of(const void *bytes, size_t count, uint64_t seed) {
    struct xxh64 state;
    xxh64_begin(&state, seed);
    xxh64_add(&state, bytes, count);
    return xxh64_end(&state);
}
