#include "grammar/ir_copies.h"

#include "grammar/schema.h"

static const struct ir_copy *copy_of(const struct ir_copies *copies, const struct schema_row *list,
                                     uint32_t index) {
    const bool is_scenes = list >= SCHEMA_SCENE.rows && list < SCHEMA_SCENE.rows + SCHEMA_SCENE.row_count;
    const struct ir_copy *of_list = copies && is_scenes ? copies->lists[list - SCHEMA_SCENE.rows] : NULL;
    return of_list ? &of_list[index] : NULL;
}

uint32_t ir_copies_entry(const struct ir_copies *copies, const struct schema_row *list, uint32_t index) {
    const struct ir_copy *copy = copy_of(copies, list, index);
    return copy ? copy->entry : index;
}

const uint32_t *ir_copies_at(const struct ir_copies *copies, const struct schema_row *list, uint32_t index) {
    const struct ir_copy *copy = copy_of(copies, list, index);
    return copy && copy->places ? copies->places + copy->places : NULL;
}

void ir_copies_index(const struct ir_copies *copies, const struct schema_row *list, uint32_t index,
                     struct strbuf *out) {
    const uint32_t *places = ir_copies_at(copies, list, index);
    strbuf_format(out, "[%u]", ir_copies_entry(copies, list, index));
    for (uint32_t i = 0; places && i < places[0]; i++)
        strbuf_format(out, "[%u]", places[1 + i]);
}

void ir_copies_label(const struct ir_copies *copies, const struct schema_row *list, uint32_t index,
                     struct strbuf *out) {
    strbuf_cstr(out, schema_yaml_key(list));
    ir_copies_index(copies, list, index, out);
}

str ir_copies_base(str name) {
    str base = name;
    while (base.len > 2 && base.ptr[base.len - 1] == ']') {
        size_t digits = base.len - 1;
        while (digits > 0 && base.ptr[digits - 1] >= '0' && base.ptr[digits - 1] <= '9')
            digits--;
        if (digits == base.len - 1 || digits < 2 || base.ptr[digits - 1] != '[')
            break;
        base = str_slice(base, 0, digits - 1);
    }
    return base;
}
