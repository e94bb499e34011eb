// From strings to numbers: open addressing in an arena, cleared in constant time.
//
// Keys are not copied: they must live until the map's next clearing or its end. 0 stands for "not there", so
// callers that store indices store them plus 1. Ownership: the arena given to str_map_init, whose guard the
// caller sets. Thread safety: lookups change nothing; else one map belongs to one thread.
#ifndef GLINT_CORE_STR_MAP_H
#define GLINT_CORE_STR_MAP_H

#include "core/arena.h"

struct str_map_entry {
    str key;
    uint32_t value;
    uint32_t stamp;
};

struct str_map {
    struct arena *arena;
    struct str_map_entry *entries;
    uint32_t capacity; // a power of two, or 0
    uint32_t count;
    uint32_t stamp; // entries of other stamps are empty
};

void str_map_init(struct str_map *map, struct arena *arena);
void str_map_clear(struct str_map *map);
// The value of `key`, added as 0 if there is none; valid until the next call.
uint32_t *str_map_at(struct str_map *map, str key);
// The value of `key`, 0 if there is none.
uint32_t str_map_find(const struct str_map *map, str key);

#endif
