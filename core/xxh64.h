// XXH64, the 64-bit hash of Yann Collet's xxHash, from his library's header: fast, well spread, not for
// secrets. Thread safety: a state belongs to one thread.
#ifndef GLINT_CORE_XXH64_H
#define GLINT_CORE_XXH64_H

#include <stddef.h>
#include <stdint.h>

struct xxh64 {
    uint64_t words[11]; // the library's own state
};

void xxh64_begin(struct xxh64 *state, uint64_t seed);
void xxh64_add(struct xxh64 *state, const void *bytes, size_t count);
// The hash of everything added so far; more may be added afterwards.
uint64_t xxh64_end(const struct xxh64 *state);
uint64_t xxh64_of(const void *bytes, size_t count, uint64_t seed);

#endif
