// A hash of 128 bits: XXH64 with two seeds. For the keys of cached files, not against attackers.
//
// Numbers are added value by value, since structs have padding. Thread safety: a state belongs to one thread.
#ifndef GLINT_CORE_HASH128_H
#define GLINT_CORE_HASH128_H

#include "core/str.h"
#include "core/vec3.h"
#include "core/xxh64.h"

struct hash128 {
    struct xxh64 states[2];
};

static inline void hash128_begin(struct hash128 *h) {
    xxh64_begin(&h->states[0], 0);
    xxh64_begin(&h->states[1], 1);
}
static inline void hash128_add(struct hash128 *h, const void *bytes, size_t count) {
    xxh64_add(&h->states[0], bytes, count);
    xxh64_add(&h->states[1], bytes, count);
}
static inline void hash128_end(const struct hash128 *h, uint64_t key[2]) {
    key[0] = xxh64_end(&h->states[0]);
    key[1] = xxh64_end(&h->states[1]);
}

static inline void hash128_whole(struct hash128 *h, uint64_t value) {
    hash128_add(h, &value, sizeof value);
}
static inline void hash128_number(struct hash128 *h, double value) {
    hash128_add(h, &value, sizeof value);
}
static inline void hash128_vector(struct hash128 *h, vec3 v) {
    hash128_number(h, v.x);
    hash128_number(h, v.y);
    hash128_number(h, v.z);
}
static inline void hash128_text(struct hash128 *h, str text) {
    hash128_whole(h, text.len);
    if (text.len)
        hash128_add(h, text.ptr, text.len);
}
// `count` items of `size` bytes without padding; the pointer may be NULL if there are none.
static inline void hash128_array(struct hash128 *h, const void *items, size_t count, size_t size) {
    hash128_whole(h, count);
    if (count)
        hash128_add(h, items, count * size);
}

#endif
