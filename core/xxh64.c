#include "core/xxh64.h"

#define XXH_INLINE_ALL // nothing is linked
#include <xxhash.h>

_Static_assert(sizeof(struct xxh64) == sizeof(XXH64_state_t), "the state of xxhash.h");

void xxh64_begin(struct xxh64 *state, uint64_t seed) {
    XXH64_reset((XXH64_state_t *)state, seed);
}

void xxh64_add(struct xxh64 *state, const void *bytes, size_t count) {
    XXH64_update((XXH64_state_t *)state, bytes, count);
}

uint64_t xxh64_end(const struct xxh64 *state) {
    return XXH64_digest((const XXH64_state_t *)state);
}

uint64_t xxh64_of(const void *bytes, size_t count, uint64_t seed) {
    return XXH64(bytes, count, seed);
}
