#include "grammar/ir_copies.h"

#include "grammar/ir.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"

#include <string.h>

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

uint32_t ir_copies_instance(const struct ir_copies *copies, const struct schema_row *list, uint32_t index) {
    const struct ir_copy *copy = copy_of(copies, list, index);
    return copy ? copy->instance : 0;
}

bool ir_copies_are_same(const struct ir_copies *a, uint32_t instance_a, const struct ir_copies *b,
                        uint32_t instance_b) {
    const struct schema_row *row = ir_walk_pool(&SCHEMA_INSTANCE);
    if (!instance_a || !instance_b)
        return instance_a == instance_b;
    const struct ir_instance *x = &a->instances->items[instance_a - 1];
    const struct ir_instance *y = &b->instances->items[instance_b - 1];
    if (x->name.len || y->name.len)
        return str_equal(x->name, y->name);
    const struct ir_copy *p = copy_of(a, row, instance_a - 1), *q = copy_of(b, row, instance_b - 1);
    const uint32_t *from = a->places + p->places, *to = b->places + q->places;
    return p->entry == q->entry && memcmp(from, to, (from[0] + (size_t)1) * sizeof *from) == 0 &&
           ir_copies_are_same(a, p->instance, b, q->instance);
}

// Names of instances have those around them in front already.
void ir_copies_instance_name(const struct ir_copies *copies, uint32_t instance, struct strbuf *out) {
    const str name = copies->instances->items[instance].name;
    if (name.len)
        strbuf_str(out, name);
    else
        ir_copies_label(copies, ir_walk_pool(&SCHEMA_INSTANCE), instance, out);
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
    const uint32_t instance = ir_copies_instance(copies, list, index);
    if (instance) {
        ir_copies_instance_name(copies, instance - 1, out);
        strbuf_cstr(out, "/");
    }
    strbuf_cstr(out, schema_yaml_key(list));
    ir_copies_index(copies, list, index, out);
}

void ir_copies_entry_label(const struct ir_copies *copies, const struct schema_row *list, uint32_t index,
                           str name, struct strbuf *out) {
    const uint32_t instance = ir_copies_instance(copies, list, index);
    if (instance) {
        ir_copies_entry_label(copies, ir_walk_pool(&SCHEMA_INSTANCE), instance - 1,
                              copies->instances->items[instance - 1].name, out);
        strbuf_cstr(out, "/");
    }
    size_t begin = name.len; // of the last part of the whole name
    while (begin > 0 && name.ptr[begin - 1] != '/')
        begin--;
    if (name.len)
        strbuf_str(out, ir_copies_base(str_slice(name, begin, name.len)));
    else
        strbuf_format(out, "%s[%u]", schema_yaml_key(list), ir_copies_entry(copies, list, index));
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
