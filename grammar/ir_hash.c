#include "grammar/ir_hash.h"

#include "grammar/ir.h"
#include "grammar/ir_walk.h"

#include <string.h>

static void hash_color(struct hash128 *h, const struct ir_color *color) {
    hash128_whole(h, color->is_hex);
    hash128_whole(h, color->hex);
    hash128_vector(h, (vec3){color->r, color->g, color->b});
}

static void hash_list(struct hash128 *h, const struct schema_row *row, const void *element) {
    struct ir_any_list list = ir_walk_list(row, element);
    hash128_whole(h, list.count);
    for (uint32_t i = 0; i < list.count; i++)
        ir_hash(h, row->child, ir_walk_item(row, list, i));
}

static void hash_value(struct hash128 *h, const struct schema_row *row, const void *field) {
    double numbers[4];
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        hash128_whole(h, *(const bool *)field);
        break;
    case SCHEMA_INTEGER:
        hash128_whole(h, (uint64_t)(int64_t) * (const int32_t *)field);
        break;
    case SCHEMA_NUMBER:
        hash128_number(h, *(const double *)field);
        break;
    case SCHEMA_WORD:
        hash128_whole(h, *(const unsigned *)field);
        break;
    case SCHEMA_TEXT:
        hash128_text(h, *(const str *)field);
        break;
    case SCHEMA_COLOR:
        hash_color(h, field);
        break;
    case SCHEMA_VECTOR:
    case SCHEMA_PAIR:
    case SCHEMA_POINT:
    case SCHEMA_QUAD:
    case SCHEMA_WEIGHTS:
        for (uint32_t i = 0, count = ir_walk_components(row, field, numbers); i < count; i++)
            hash128_number(h, numbers[i]);
        break;
    case SCHEMA_REFERENCE:
        hash128_text(h, ((const struct ir_reference *)field)->name);
        hash128_whole(h, ((const struct ir_reference *)field)->index);
        break;
    case SCHEMA_ELEMENT:
        ir_hash(h, row->child, field);
        break;
    case SCHEMA_LIST:
        break; // hash_list
    }
}

void ir_hash(struct hash128 *h, const struct schema_element *schema, const void *element) {
    for (uint32_t i = 0; i < sizeof schema->choices / sizeof *schema->choices; i++)
        if (schema->choices[i].rule != SCHEMA_CHOICE_NONE)
            hash128_whole(h, *(const unsigned *)((const char *)element + schema->choices[i].tag_offset));
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const char *field = schema_field_const(row, element);
        const uint32_t values = row->many == SCHEMA_FIXED ? row->fixed_count : 1;
        if (row->aside)
            continue;
        if (row->kind == SCHEMA_LIST)
            hash_list(h, row, element);
        for (uint32_t k = 0; k < values; k++)
            hash_value(h, row, field + (size_t)k * row->size);
    }
}
