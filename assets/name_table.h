// Names to numbers, for files with many materials: open addressing, in an arena.
//
// Names are not copied. Thread safety: one table belongs to one thread.
#ifndef GLINT_ASSETS_NAME_TABLE_H
#define GLINT_ASSETS_NAME_TABLE_H

#include "core/arena.h"

#define NAME_TABLE_NONE UINT32_MAX

struct name_slot;

struct name_table {
    struct arena *arena;
    struct name_slot *slots;
    uint32_t slot_count; // a power of two
    uint32_t count;
};

void name_table_init(struct name_table *table, struct arena *arena);
// The number of a name, or NAME_TABLE_NONE.
uint32_t name_table_find(const struct name_table *table, str name);
// Adds a name that the table does not hold.
void name_table_add(struct name_table *table, str name, uint32_t number);

#endif
