// The key of the reference's cache: whatever changes in a scene, in any row of the table, is another key.
#include "core/arena.h"
#include "grammar/ir.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"
#include "reference/key.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

struct table {
    struct ir_scene ir;
    struct assets assets;
    struct scene scene;
    struct view view;
    uint64_t key[2]; // of the scene as it was made
    uint32_t changes;
    // Rows that were changed, by element of the table.
    uint64_t changed[64];
};

static void key_of(const struct table *t, uint64_t key[2]) {
    const struct reference_input input = {.scene = &t->scene, .view = &t->view};
    reference_scene_key(&input, key);
}

// ---- a scene with an item in every list

static void fill(struct arena *arena, const struct schema_element *schema, void *element) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (row->kind == SCHEMA_ELEMENT)
            fill(arena, row->child, schema_field(row, element));
        if (row->kind != SCHEMA_LIST || row->aside)
            continue;
        void *item = arena_alloc(arena, row->child->size);
        schema_init(row->child, item);
        fill(arena, row->child, item);
        ir_walk_append(arena, row, element, item);
    }
}

// ---- one change after the other

static void expect_another(struct table *t, const struct schema_element *schema, const char *what) {
    uint64_t key[2];
    key_of(t, key);
    t->changes++;
    if (key[0] == t->key[0] || key[1] == t->key[1])
        fail_msg("the key misses '%s' of %s", what, schema->name);
}

// Writes `bytes` over the field, looks, and puts back what was there.
static void try_bytes(struct table *t, const struct schema_element *schema, const char *what, void *field,
                      const void *bytes, size_t count) {
    unsigned char before[sizeof(struct ir_color) + sizeof(struct ir_weights)];
    assert_true(count <= sizeof before);
    memcpy(before, field, count);
    memcpy(field, bytes, count);
    expect_another(t, schema, what);
    memcpy(field, before, count);
}

static void try_numbers(struct table *t, const struct schema_element *schema, const char *what,
                        double *numbers, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        const double next = numbers[i] == 0 ? 0x1p-40 : numbers[i] * (1 + 0x1p-40);
        try_bytes(t, schema, what, &numbers[i], &next, sizeof next);
    }
}

static void try_color(struct table *t, const struct schema_element *schema, const char *what,
                      struct ir_color *color) {
    struct ir_color hex = {.is_hex = true, .hex = 0x123456}, other = {.is_hex = true, .hex = 0x123457};
    try_numbers(t, schema, what, &color->r, 3);
    try_bytes(t, schema, what, color, &hex, sizeof hex);
    try_bytes(t, schema, what, color, &other, sizeof other);
}

static void try_value(struct table *t, const struct schema_element *schema, const struct schema_row *row,
                      void *field) {
    const char *what = row->name;
    const bool flipped = row->kind == SCHEMA_BOOLEAN && !*(const bool *)field;
    const int32_t integer = row->kind == SCHEMA_INTEGER ? *(int32_t *)field + 1 : 0;
    const unsigned word = row->kind == SCHEMA_WORD ? *(unsigned *)field + 1 : 0;
    const str text = STR("another text");
    const struct ir_reference name = {STR("another name"), 0}, index = {{"", 0}, 12345};
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        try_bytes(t, schema, what, field, &flipped, sizeof flipped);
        break;
    case SCHEMA_INTEGER:
        try_bytes(t, schema, what, field, &integer, sizeof integer);
        break;
    case SCHEMA_WORD:
        try_bytes(t, schema, what, field, &word, sizeof word);
        break;
    case SCHEMA_TEXT:
        try_bytes(t, schema, what, field, &text, sizeof text);
        break;
    case SCHEMA_NUMBER:
        try_numbers(t, schema, what, field, 1);
        break;
    case SCHEMA_VECTOR:
        try_numbers(t, schema, what, field, 3);
        break;
    case SCHEMA_PAIR:
    case SCHEMA_POINT:
        try_numbers(t, schema, what, field, 2);
        break;
    case SCHEMA_QUAD:
    case SCHEMA_WEIGHTS:
        try_numbers(t, schema, what, field, 4);
        break;
    case SCHEMA_COLOR:
        try_color(t, schema, what, field);
        break;
    case SCHEMA_REFERENCE:
        try_bytes(t, schema, what, field, &name, sizeof name);
        try_bytes(t, schema, what, field, &index, sizeof index);
        break;
    case SCHEMA_ELEMENT:
    case SCHEMA_LIST:
        break;
    }
}

static void note_changed(struct table *t, const struct schema_element *schema, uint32_t row) {
    for (uint32_t i = 0; schema_elements[i]; i++)
        if (schema_elements[i] == schema)
            t->changed[i] |= UINT64_C(1) << row;
}

static void change_element(struct table *t, const struct schema_element *schema, void *element) {
    for (uint32_t i = 0; i < sizeof schema->choices / sizeof *schema->choices; i++) {
        unsigned *tag = (unsigned *)((char *)element + schema->choices[i].tag_offset);
        const unsigned next = *tag + 1;
        if (schema->choices[i].rule != SCHEMA_CHOICE_NONE)
            try_bytes(t, schema, "the row of a choice", tag, &next, sizeof next);
    }
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        void *field = schema_field(row, element);
        struct ir_any_list list = ir_walk_list(row, element),
                           shorter = {list.items, list.count - 1, list.capacity};
        const uint32_t values = row->many == SCHEMA_FIXED ? row->fixed_count : 1;
        if (row->aside)
            continue; // parameters: what is computed from them is in the key
        note_changed(t, schema, i);
        for (uint32_t k = 0; k < values; k++) {
            void *value = (char *)field + (size_t)k * row->size;
            try_value(t, schema, row, value);
            if (row->kind == SCHEMA_ELEMENT)
                change_element(t, row->child, value);
        }
        if (row->kind != SCHEMA_LIST)
            continue;
        try_bytes(t, schema, row->name, field, &shorter, sizeof shorter);
        for (uint32_t k = 0; k < list.count; k++)
            change_element(t, row->child, ir_walk_item(row, list, k));
    }
}

static uint64_t rows_aside(const struct schema_element *schema) {
    uint64_t rows = 0;
    for (uint32_t i = 0; i < schema->row_count; i++)
        rows |= (uint64_t)schema->rows[i].aside << i;
    return rows;
}

static bool is_aside(const struct schema_element *schema) {
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++)
        if (SCHEMA_SCENE.rows[i].child == schema)
            return SCHEMA_SCENE.rows[i].aside;
    return false;
}

static void test_every_row(void **state) {
    (void)state;
    struct table t = {.scene = {.ir = &t.ir, .assets = &t.assets}};
    struct arena arena;
    arena_init(&arena, SIZE_MAX);
    schema_init(&SCHEMA_SCENE, &t.ir);
    fill(&arena, &SCHEMA_SCENE, &t.ir);
    key_of(&t, t.key);
    change_element(&t, &SCHEMA_SCENE, &t.ir);
    for (uint32_t i = 0; schema_elements[i]; i++)
        if (!is_aside(schema_elements[i]) && (t.changed[i] | rows_aside(schema_elements[i])) !=
                                                 (UINT64_C(1) << schema_elements[i]->row_count) - 1)
            fail_msg("not every row of %s was changed", schema_elements[i]->name);
    uint64_t key[2];
    key_of(&t, key);
    assert_memory_equal(key, t.key, sizeof key);
    print_message("%u changes, each another key\n", t.changes);
    arena_finish(&arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_every_row)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
