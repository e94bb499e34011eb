#include "grammar/schema_index.h"

#include <string.h>

static uint32_t hash_of(const struct schema_element *element, enum schema_name_kind kind, str name) {
    uint64_t h = (uint64_t)(uintptr_t)element + (uint64_t)kind;
    for (size_t i = 0; i < name.len; i++)
        h = (h ^ (unsigned char)name.ptr[i]) * UINT64_C(0x9E3779B97F4A7C15);
    return (uint32_t)(h >> 32);
}

static struct schema_slot *find_slot(const struct schema_index *index, const struct schema_element *element,
                                     enum schema_name_kind kind, str name, uint32_t hash) {
    uint32_t at = hash & index->mask;
    for (;; at = (at + 1) & index->mask) {
        struct schema_slot *slot = &index->slots[at];
        bool same = slot->hash == hash && slot->element == element && slot->kind == kind &&
                    slot->length == name.len && memcmp(slot->name, name.ptr, name.len) == 0;
        if (!slot->element || same)
            return slot;
    }
}

// The first row of a name counts, as where rows are searched one by one.
static void add(struct schema_index *index, const struct schema_element *element, enum schema_name_kind kind,
                const char *name, int row, bool single) {
    str text = str_from(name);
    uint32_t hash = hash_of(element, kind, text);
    struct schema_slot *slot = find_slot(index, element, kind, text, hash);
    if (!slot->element)
        *slot = (struct schema_slot){element, name, hash, (uint16_t)text.len, (uint8_t)kind, single, row};
}

static void add_row(struct schema_index *index, const struct schema_element *element, uint32_t row) {
    const struct schema_row *r = &element->rows[row];
    if (!r->key)
        add(index, element, SCHEMA_NAME_KEY, schema_yaml_key(r), (int)row, false);
    if (!r->key && r->single)
        add(index, element, SCHEMA_NAME_KEY, r->name, (int)row, true);
    if (schema_is_attribute(r))
        add(index, element, SCHEMA_NAME_ATTRIBUTE, r->name, (int)row, false);
    if (r->element)
        add(index, element, SCHEMA_NAME_CHILD, r->element, (int)row, false);
}

static uint32_t element_number(const struct schema_element *element) {
    uint32_t number = 0;
    while (schema_elements[number] != element)
        number++;
    return number;
}

void schema_index_init(struct schema_index *index, struct arena *arena) {
    uint32_t rows = 0;
    uint32_t elements = 0;
    for (const struct schema_element *const *e = schema_elements; *e; e++, elements++)
        rows += (*e)->row_count;
    uint32_t capacity = 64;
    while (capacity < rows * 8) // up to four names a row
        capacity *= 2;
    index->slots = ARENA_ARRAY(arena, struct schema_slot, capacity);
    index->mask = capacity - 1;
    index->defaults = ARENA_ARRAY(arena, const void *, elements);
    for (uint32_t i = 0; i < elements; i++) {
        for (uint32_t row = 0; row < schema_elements[i]->row_count; row++)
            add_row(index, schema_elements[i], row);
        void *defaults = arena_alloc(arena, schema_elements[i]->size);
        schema_init(schema_elements[i], defaults);
        index->defaults[i] = defaults;
    }
}

int schema_index_find(const struct schema_index *index, const struct schema_element *element,
                      enum schema_name_kind kind, str name, bool *is_single) {
    const struct schema_slot *slot = find_slot(index, element, kind, name, hash_of(element, kind, name));
    *is_single = slot->element && slot->single;
    return slot->element ? slot->row : -1;
}

void schema_index_defaults(const struct schema_index *index, const struct schema_element *element,
                           void *memory) {
    memcpy(memory, index->defaults[element_number(element)], element->size);
}
