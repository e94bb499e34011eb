#include "grammar/schema_index.h"

#include <string.h>

// Of a few of the letters: the names of one element differ in them, nearly all.
static uint32_t hash_of(const struct schema_element *element, enum schema_name_kind kind, str name) {
    uint64_t h = (uint64_t)(uintptr_t)element + (uint64_t)kind;
    if (name.len)
        h += (uint64_t)(unsigned char)name.ptr[0] << 40 |
             (uint64_t)(unsigned char)name.ptr[name.len / 2] << 48 |
             (uint64_t)(unsigned char)name.ptr[name.len - 1] << 56;
    h = (h ^ name.len << 32) * UINT64_C(0x9E3779B97F4A7C15);
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

static bool is_name(const struct schema_row *row) {
    return row->kind == SCHEMA_TEXT && row->text == SCHEMA_TEXT_NAME;
}

static struct schema_facts facts_of(const struct schema_element *element, struct arena *arena) {
    void *defaults = arena_alloc(arena, element->size);
    schema_init(element, defaults);
    struct schema_facts facts = {.defaults = defaults,
                                 .short_row = schema_short_row(element),
                                 .key_row = schema_key_row(element),
                                 .name_row = -1};
    for (uint32_t i = 0; i < element->row_count; i++) {
        const struct schema_row *row = &element->rows[i];
        uint64_t bit = (uint64_t)1 << i;
        if (is_name(row) && facts.name_row < 0)
            facts.name_row = (int)i;
        facts.names |= row->key || is_name(row) ? bit : 0;
        facts.required |= row->required ? bit : 0;
    }
    for (uint32_t c = 0; c < sizeof element->choices / sizeof *element->choices; c++)
        facts.has_choices = facts.has_choices || element->choices[c].rule == SCHEMA_CHOICE_EXACTLY_ONE;
    return facts;
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
    index->facts = ARENA_ARRAY(arena, struct schema_facts, elements);
    for (uint32_t i = 0; i < elements; i++) {
        for (uint32_t row = 0; row < schema_elements[i]->row_count; row++)
            add_row(index, schema_elements[i], row);
        index->facts[i] = facts_of(schema_elements[i], arena);
    }
}

int schema_index_find(const struct schema_index *index, const struct schema_element *element,
                      enum schema_name_kind kind, str name, bool *is_single) {
    const struct schema_slot *slot = find_slot(index, element, kind, name, hash_of(element, kind, name));
    *is_single = slot->element && slot->single;
    return slot->element ? slot->row : -1;
}

const struct schema_facts *schema_index_facts(const struct schema_index *index,
                                              const struct schema_element *element) {
    return &index->facts[element_number(element)];
}

void schema_index_defaults(const struct schema_index *index, const struct schema_element *element,
                           void *memory) {
    memcpy(memory, schema_index_facts(index, element)->defaults, element->size);
}
