#include "assets/name_table.h"

enum {
    SLOTS_MIN = 16
};

struct name_slot {
    str name;
    uint32_t number;
    bool used;
};

void name_table_init(struct name_table *table, struct arena *arena) {
    *table = (struct name_table){.arena = arena};
}

// The slot that holds the name, or the free one where it belongs.
static struct name_slot *slot_of(const struct name_table *table, str name) {
    uint32_t mask = table->slot_count - 1;
    uint64_t hash = str_hash(name);
    uint32_t at = (uint32_t)(hash ^ hash >> 32) & mask;
    while (table->slots[at].used && !str_equal(table->slots[at].name, name))
        at = (at + 1) & mask;
    return &table->slots[at];
}

uint32_t name_table_find(const struct name_table *table, str name) {
    if (table->count == 0)
        return NAME_TABLE_NONE;
    const struct name_slot *slot = slot_of(table, name);
    return slot->used ? slot->number : NAME_TABLE_NONE;
}

static void grow(struct name_table *table) {
    struct name_table larger = *table;
    larger.slot_count = table->slot_count ? table->slot_count * 2 : SLOTS_MIN;
    larger.slots = ARENA_ARRAY(table->arena, struct name_slot, larger.slot_count);
    for (uint32_t i = 0; i < table->slot_count; i++)
        if (table->slots[i].used)
            *slot_of(&larger, table->slots[i].name) = table->slots[i];
    *table = larger;
}

void name_table_add(struct name_table *table, str name, uint32_t number) {
    if (2 * (table->count + 1) > table->slot_count)
        grow(table);
    *slot_of(table, name) = (struct name_slot){.name = name, .number = number, .used = true};
    table->count++;
}
