#include "core/str_map.h"

enum {
    CAPACITY_LEAST = 16
};

void str_map_init(struct str_map *map, struct arena *arena) {
    *map = (struct str_map){.arena = arena, .stamp = 1};
}

void str_map_clear(struct str_map *map) {
    map->stamp++;
    map->count = 0;
}

// The entry that holds the key, or the free one where it belongs.
static struct str_map_entry *find_entry(const struct str_map *map, str key) {
    uint64_t hash = str_hash(key);
    uint32_t mask = map->capacity - 1;
    uint32_t i = (uint32_t)(hash ^ hash >> 32) & mask;
    while (map->entries[i].stamp == map->stamp && !str_equal(map->entries[i].key, key))
        i = (i + 1) & mask;
    return &map->entries[i];
}

static void grow(struct str_map *map) {
    struct str_map old = *map;
    map->capacity = old.capacity ? old.capacity * 2 : CAPACITY_LEAST;
    map->entries = ARENA_ARRAY(map->arena, struct str_map_entry, map->capacity);
    for (uint32_t i = 0; i < old.capacity; i++)
        if (old.entries[i].stamp == old.stamp)
            *find_entry(map, old.entries[i].key) = old.entries[i];
}

uint32_t *str_map_at(struct str_map *map, str key) {
    if ((uint64_t)map->count * 2 >= map->capacity)
        grow(map);
    struct str_map_entry *entry = find_entry(map, key);
    if (entry->stamp != map->stamp) {
        *entry = (struct str_map_entry){.key = key, .stamp = map->stamp};
        map->count++;
    }
    return &entry->value;
}

uint32_t str_map_find(const struct str_map *map, str key) {
    if (map->count == 0)
        return 0;
    const struct str_map_entry *entry = find_entry(map, key);
    return entry->stamp == map->stamp ? entry->value : 0;
}
