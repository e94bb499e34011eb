// From the table's rows of a material to the one list of its fields: each row changes a field and the scene's
// hash, and each field is changed by a row.
#include "grammar/ir.h"
#include "grammar/ir_walk.h"
#include "grammar/preset.h"
#include "grammar/schema.h"
#include "scene/content.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define COUNT_FIELD(...) +1
enum {
    FIELDS = SCENE_MATERIAL_FIELDS(COUNT_FIELD)
};

static const struct {
    const char *name;
    size_t offset, size;
    bool is_mask; // of what other fields ask for
} fields[] = {
#define IS_MASK_NUMBER 0
#define IS_MASK_FLAG   0
#define IS_MASK_WHOLE  0
#define IS_MASK_COLOR  0
#define IS_MASK_COLORS 0
#define IS_MASK_IMAGES 0
#define IS_MASK_BITS   1
#define FIELD_ROW(kind, name, ...)                                                                           \
    {#name, offsetof(struct scene_material, name), sizeof((struct scene_material *)0)->name, IS_MASK_##kind},
    SCENE_MATERIAL_FIELDS(FIELD_ROW)};

struct bench {
    struct arena arena;
    struct ir_scene ir;
    struct ir_material material;
    struct assets assets;
    struct scene before;
    uint64_t key[2];
    bool changed[FIELDS];
    uint32_t rows;
};

static void build(struct bench *b, struct scene *scene, uint64_t key[2]) {
    struct hash128 h;
    const struct ir_material written = b->material;
    preset_fill(&b->material);
    scene_build(&b->ir, &b->assets, &b->arena, scene);
    b->material = written;
    hash128_begin(&h);
    scene_content(&h, scene);
    hash128_end(&h, key);
    // The same one, elsewhere each time.
    for (int k = 0; k < ASSETS_IMAGES; k++)
        scene->materials[0].images[k].texture = NULL;
}

// Another value that the table allows; component `k` of it.
static void change(const struct schema_row *row, void *field, uint32_t k) {
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        *(bool *)field = !*(bool *)field;
        break;
    case SCHEMA_INTEGER:
        *(int32_t *)field += 1;
        break;
    case SCHEMA_WORD:
        *(unsigned *)field = *(unsigned *)field == 0;
        break;
    case SCHEMA_COLOR:
        *(struct ir_color *)field = (struct ir_color){.r = 0.25, .g = 0.75, .b = 0.125};
        break;
    default: // numbers, one after the other
        ((double *)field)[k] = ((double *)field)[k] * 0.5 + 0.125;
    }
}

static bool is_value(const struct schema_row *row) {
    return row->kind != SCHEMA_TEXT && row->kind != SCHEMA_ELEMENT;
}

static uint32_t components(const struct schema_row *row) {
    return row->kind == SCHEMA_WEIGHTS                             ? 4
           : row->kind == SCHEMA_VECTOR                            ? 3
           : row->kind == SCHEMA_PAIR || row->kind == SCHEMA_POINT ? 2
                                                                   : 1;
}

// Whether a field is another than before that is not a mask.
static bool note_changes(struct bench *b, const struct scene *after) {
    bool any = false;
    for (int i = 0; i < FIELDS; i++) {
        const char *was = (const char *)b->before.materials + fields[i].offset;
        const char *is = (const char *)after->materials + fields[i].offset;
        const bool differs = memcmp(was, is, fields[i].size) != 0;
        b->changed[i] = b->changed[i] || differs;
        any = any || (differs && !fields[i].is_mask);
    }
    return any;
}

static void compare(struct bench *b, const struct schema_element *schema, const struct schema_row *row) {
    struct scene after;
    uint64_t key[2];
    build(b, &after, key);
    if (!note_changes(b, &after))
        fail_msg("no field of scene/material_fields.h changes with '%s' of a %s", row->name, schema->name);
    if (key[0] == b->key[0] && key[1] == b->key[1])
        fail_msg("the hash of a scene does not change with '%s' of a %s", row->name, schema->name);
    b->rows++;
}

static void try_row(struct bench *b, const struct schema_element *schema, const struct schema_row *row,
                    char *field) {
    const uint32_t values = row->many == SCHEMA_FIXED ? row->fixed_count : 1;
    for (uint32_t i = 0; i < values; i++)
        for (uint32_t k = 0; k < components(row); k++) {
            char *value = field + (size_t)i * row->size;
            unsigned char kept[64];
            assert_true(row->size <= sizeof kept);
            memcpy(kept, value, row->size);
            change(row, value, k);
            compare(b, schema, row);
            memcpy(value, kept, row->size);
        }
}

static void take(struct bench *b, void *element, uint32_t tag_offset, unsigned alternative) {
    struct scene after;
    build(b, &b->before, b->key);
    *(unsigned *)((char *)element + tag_offset) = alternative;
    build(b, &after, b->key);
    note_changes(b, &after);
}

static void try_rows(struct bench *b, const struct schema_element *schema, void *element) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (row->choice)
            take(b, element, schema->choices[row->choice - 1].tag_offset, row->alternative);
        build(b, &b->before, b->key);
        if (row->kind == SCHEMA_ELEMENT)
            try_rows(b, row->child, schema_field(row, element));
        else if (is_value(row))
            try_row(b, schema, row, schema_field(row, element));
    }
}

static void rows_and_fields_belong_together(void **state) {
    (void)state;
    static uint8_t pixels[3] = {200, 100, 50};
    static const struct picture picture = {
        .width = 1, .height = 1, .depth = PICTURE_8, .pixels = pixels, .size_bytes = sizeof pixels};
    static const struct picture *images[1][ASSETS_IMAGES] = {{&picture, &picture}};
    static struct bench b;
    arena_init(&b.arena, SIZE_MAX);
    schema_init(&SCHEMA_SCENE, &b.ir);
    schema_init(&SCHEMA_MATERIAL, &b.material);
    // The distance says something only where something is lost.
    b.material.attenuation_color = (struct ir_color){.r = 0.5, .g = 0.5, .b = 0.5};
    b.assets = (struct assets){.materials = &b.material, .material_count = 1, .images = images};
    try_rows(&b, &SCHEMA_MATERIAL, &b.material);
    for (int i = 0; i < FIELDS; i++)
        if (!b.changed[i])
            fail_msg("no row of a material changes '%s' of scene/material_fields.h", fields[i].name);
    assert_true(b.rows > SCHEMA_MATERIAL.row_count);
    arena_finish(&b.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(rows_and_fields_belong_together)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
