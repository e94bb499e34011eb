#include "grammar/preset.h"

#include "grammar/ir.h"
#include "grammar/schema.h"

#include <string.h>

// All values of all presets, one after the other.
static const struct value {
    const char *row, *text; // `row` NULL: a preset begins
} values[] = {
#define PRESET(word, name, values) {NULL, NULL}, values
#define VALUE(row, value)          {row, value},
#include "grammar/presets.def"
#undef VALUE
#undef PRESET
};

enum {
    VALUE_COUNT = sizeof values / sizeof *values
};

// Of a paint or a highlight its colour, which is what it is without a word.
static void set(const struct schema_row *row, void *field, const char *text) {
    if (row->kind != SCHEMA_ELEMENT) {
        schema_set_field(row, field, text);
        return;
    }
    row = &row->child->rows[schema_find_row(row->child, STR("color"))];
    schema_set_field(row, schema_field(row, field), text);
}

void preset_fill(struct ir_material *material) {
    uint32_t preset = 0;
    for (size_t i = 0; material->preset && i < VALUE_COUNT && preset <= material->preset; i++) {
        preset += values[i].row == NULL;
        if (!values[i].row || preset != material->preset)
            continue;
        const int row = schema_find_row(&SCHEMA_MATERIAL, str_from(values[i].row));
        if (!(material->head.written >> row & 1))
            set(&SCHEMA_MATERIAL.rows[row], schema_field(&SCHEMA_MATERIAL.rows[row], material),
                values[i].text);
    }
}

bool preset_take(struct ir_scene *scene) {
    bool any = false;
    for (uint32_t i = 0; i < scene->materials.count; i++) {
        any = any || scene->materials.items[i].preset;
        preset_fill(&scene->materials.items[i]);
    }
    return any;
}

void preset_leave(struct ir_scene *scene) {
    struct ir_material standard = {0};
    schema_init(&SCHEMA_MATERIAL, &standard);
    for (uint32_t k = 0; k < scene->materials.count; k++)
        for (uint32_t i = 0; i < SCHEMA_MATERIAL.row_count; i++) {
            const struct schema_row *row = &SCHEMA_MATERIAL.rows[i];
            struct ir_material *material = &scene->materials.items[k];
            if (!row->key && !(material->head.written >> i & 1))
                memcpy(schema_field(row, material), schema_field(row, &standard), row->size);
        }
}
