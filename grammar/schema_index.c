#include "grammar/schema_index.h"

#include <string.h>

// Of rows with the same name the first counts, as in a search row by row.
static void add(struct schema_facts *facts, enum schema_name_kind kind, const char *name, uint32_t row,
                bool single) {
    uint32_t *found = str_map_at(&facts->rows[kind], str_from(name));
    if (*found == 0)
        *found = (row + 1) << 1 | single;
}

static void add_row(struct schema_facts *facts, const struct schema_element *element, uint32_t row) {
    const struct schema_row *r = &element->rows[row];
    if (!r->key)
        add(facts, SCHEMA_NAME_KEY, schema_yaml_key(r), row, false);
    if (!r->key && r->single)
        add(facts, SCHEMA_NAME_KEY, r->name, row, true);
    if (schema_is_attribute(r))
        add(facts, SCHEMA_NAME_ATTRIBUTE, r->name, row, false);
    if (r->element)
        add(facts, SCHEMA_NAME_CHILD, r->element, row, false);
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
    for (int kind = 0; kind < SCHEMA_NAME_KINDS; kind++)
        str_map_init(&facts.rows[kind], arena);
    for (uint32_t i = 0; i < element->row_count; i++) {
        add_row(&facts, element, i);
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
    uint32_t elements = 0;
    while (schema_elements[elements])
        elements++;
    index->facts = ARENA_ARRAY(arena, struct schema_facts, elements);
    for (uint32_t i = 0; i < elements; i++)
        index->facts[i] = facts_of(schema_elements[i], arena);
}

int schema_index_find(const struct schema_index *index, const struct schema_element *element,
                      enum schema_name_kind kind, str name, bool *is_single) {
    uint32_t found = str_map_find(&schema_index_facts(index, element)->rows[kind], name);
    *is_single = found & 1;
    return (int)(found >> 1) - 1;
}

const struct schema_facts *schema_index_facts(const struct schema_index *index,
                                              const struct schema_element *element) {
    return &index->facts[element_number(element)];
}

void schema_index_defaults(const struct schema_index *index, const struct schema_element *element,
                           void *memory) {
    memcpy(memory, schema_index_facts(index, element)->defaults, element->size);
}
