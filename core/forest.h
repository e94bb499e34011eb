// Sets of numbers that are joined one after the other (union-find): `parent` has the number itself where
// nothing was joined yet. The root of a set is the least number in it. Thread safety: of one thread; looking
// for a root shortens paths.
#ifndef GLINT_CORE_FOREST_H
#define GLINT_CORE_FOREST_H

#include <stddef.h>
#include <stdint.h>

static inline void forest_init(uint32_t *parent, size_t count) {
    for (size_t i = 0; i < count; i++)
        parent[i] = (uint32_t)i;
}

static inline uint32_t forest_root(uint32_t *parent, uint32_t i) {
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

static inline void forest_join(uint32_t *parent, uint32_t a, uint32_t b) {
    a = forest_root(parent, a);
    b = forest_root(parent, b);
    parent[a > b ? a : b] = a > b ? b : a;
}

#endif
