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

// `path`: a row of the element; after a point, one of what is in it.
static void set(const struct schema_element *schema, void *element, const char *path, const char *text) {
    const size_t length = strcspn(path, ".");
    const struct schema_row *row = &schema->rows[schema_find_row(schema, (str){path, length})];
    void *field = schema_field(row, element);
    if (path[length])
        set(row->child, field, path + length + 1, text);
    else
        schema_set_field(row, field, text);
}

void preset_take(struct ir_material *material) {
    uint32_t preset = 0;
    for (size_t i = 0; material->preset && i < VALUE_COUNT && preset <= material->preset; i++) {
        const struct value *v = &values[i];
        preset += v->row == NULL;
        if (!v->row || preset != material->preset)
            continue;
        const int row = schema_find_row(&SCHEMA_MATERIAL, (str){v->row, strcspn(v->row, ".")});
        if (!(material->head.written >> row & 1))
            set(&SCHEMA_MATERIAL, material, v->row, v->text);
    }
}
