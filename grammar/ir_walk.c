#include "grammar/ir_walk.h"

#include "grammar/ir.h"
#include "grammar/schema.h"

#include <string.h>

struct ir_any_list ir_walk_list(const struct schema_row *row, const void *element) {
    struct ir_any_list list = {0};
    if (row->kind == SCHEMA_LIST)
        memcpy(&list, schema_field_const(row, element), sizeof list);
    return list;
}

void *ir_walk_item(const struct schema_row *row, struct ir_any_list list, uint32_t i) {
    return (char *)list.items + (size_t)i * row->child->size;
}

uint32_t ir_walk_append(struct arena *arena, const struct schema_row *row, void *element, const void *item) {
    struct ir_any_list list = ir_walk_list(row, element);
    list.items = arena_grow(arena, list.items, list.count, &list.capacity, row->child->size);
    memcpy(ir_walk_item(row, list, list.count), item, row->child->size);
    list.count++;
    memcpy(schema_field(row, element), &list, sizeof list);
    return list.count - 1;
}

str ir_walk_key(const struct schema_element *schema, const void *element) {
    int key = schema_key_row(schema);
    return key < 0 ? (str){"", 0} : *(const str *)schema_field_const(&schema->rows[key], element);
}

str ir_walk_name(const struct schema_element *schema, const void *element) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (row->kind == SCHEMA_TEXT && (row->key || row->text == SCHEMA_TEXT_NAME))
            return *(const str *)schema_field_const(row, element);
    }
    return STR("");
}

bool ir_walk_is_anonymous(const struct schema_element *schema, const void *item) {
    return schema_key_row(schema) >= 0 && ir_walk_key(schema, item).len == 0;
}

const struct schema_row *ir_walk_list_of(const struct schema_element *owner,
                                         const struct schema_element *child) {
    for (uint32_t i = 0; i < owner->row_count; i++)
        if (owner->rows[i].kind == SCHEMA_LIST && owner->rows[i].child == child)
            return &owner->rows[i];
    return NULL;
}

const struct schema_row *ir_walk_pool(const struct schema_element *target) {
    return ir_walk_list_of(&SCHEMA_SCENE, target);
}

const void *ir_walk_referent(const struct ir_scene *scene, const struct schema_row *row,
                             const struct ir_reference *reference) {
    const struct schema_row *pool = ir_walk_pool(row->child);
    if (!scene || !pool)
        return NULL;
    struct ir_any_list list = ir_walk_list(pool, scene);
    return reference->index < list.count ? ir_walk_item(pool, list, reference->index) : NULL;
}

bool ir_walk_is_inline(const struct ir_scene *scene, const struct schema_row *row,
                       const struct ir_reference *reference) {
    return reference->name.len == 0 && ir_walk_referent(scene, row, reference);
}

bool ir_walk_written(const struct schema_element *schema, uint32_t i, const void *element) {
    const struct schema_row *row = &schema->rows[i];
    if (row->kind == SCHEMA_LIST) {
        struct ir_any_list list = ir_walk_list(row, element);
        for (uint32_t k = 0; k < list.count; k++)
            if (!ir_walk_is_anonymous(row->child, ir_walk_item(row, list, k)))
                return true;
        return false;
    }
    if (row->key)
        return ((const str *)schema_field_const(row, element))->len > 0;
    return ir_walk_head(element)->written >> i & 1;
}

bool ir_walk_taken(const struct schema_element *schema, const struct schema_row *row, const void *element) {
    if (!row->choice)
        return true;
    const struct schema_choice *choice = &schema->choices[row->choice - 1];
    return *(const unsigned *)((const char *)element + choice->tag_offset) == row->alternative;
}

int ir_walk_short(const struct ir_scene *scene, const struct schema_element *schema, const void *element) {
    int found = -1;
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (row->key || !ir_walk_written(schema, i, element))
            continue;
        if (!row->short_form || found >= 0)
            return -1;
        if (row->kind == SCHEMA_REFERENCE && ir_walk_is_inline(scene, row, schema_field_const(row, element)))
            return -1;
        found = (int)i;
    }
    return found;
}

uint32_t ir_walk_components(const struct schema_row *row, const void *field, double out[4]) {
    if (row->kind == SCHEMA_VECTOR) {
        const vec3 *v = field;
        out[0] = v->x, out[1] = v->y, out[2] = v->z;
        return 3;
    }
    if (row->kind == SCHEMA_PAIR) {
        const struct ir_pair *p = field;
        out[0] = p->u, out[1] = p->v;
        return 2;
    }
    if (row->kind == SCHEMA_POINT) {
        const struct ir_point *p = field;
        out[0] = p->x, out[1] = p->y;
        return 2;
    }
    if (row->kind == SCHEMA_QUAD) {
        const struct ir_quad *q = field;
        out[0] = q->x, out[1] = q->y, out[2] = q->z, out[3] = q->t;
        return 4;
    }
    if (row->kind == SCHEMA_COLOR) {
        const struct ir_color *c = field;
        out[0] = c->r, out[1] = c->g, out[2] = c->b;
        return 3;
    }
    if (row->kind == SCHEMA_WEIGHTS) {
        const struct ir_weights *w = field;
        out[0] = w->diffuse, out[1] = w->specular, out[2] = w->reflection, out[3] = w->refraction;
        return 4;
    }
    return 0;
}

const str *ir_walk_path(const struct schema_row *row, const void *element) {
    const void *field = schema_field_const(row, element);
    if (row->kind == SCHEMA_TEXT)
        return row->text == SCHEMA_TEXT_PATH ? field : NULL;
    if (row->kind != SCHEMA_REFERENCE || row->file == SCHEMA_FILE_NONE)
        return NULL;
    const str *name = &((const struct ir_reference *)field)->name;
    return name->len && (memchr(name->ptr, '.', name->len) || memchr(name->ptr, '/', name->len)) ? name
                                                                                                 : NULL;
}

static void walk_paths(const struct schema_element *schema, void *element, ir_walk_visit_path *visit,
                       void *context) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        struct ir_any_list list = ir_walk_list(row, element);
        if (ir_walk_path(row, element) && ir_walk_written(schema, i, element))
            visit(context, schema, element, row, (str *)ir_walk_path(row, element));
        if (row->kind == SCHEMA_ELEMENT)
            walk_paths(row->child, schema_field(row, element), visit, context);
        for (uint32_t k = 0; k < list.count; k++)
            walk_paths(row->child, ir_walk_item(row, list, k), visit, context);
    }
}

void ir_walk_paths(struct ir_scene *scene, ir_walk_visit_path *visit, void *context) {
    walk_paths(&SCHEMA_SCENE, scene, visit, context);
}

static void walk_references(const struct schema_element *schema, const void *element,
                            ir_walk_visit_reference *visit, void *context) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        struct ir_any_list list = ir_walk_list(row, element);
        if (row->kind == SCHEMA_REFERENCE)
            visit(context, row, schema_field_const(row, element));
        if (row->kind == SCHEMA_ELEMENT)
            walk_references(row->child, schema_field_const(row, element), visit, context);
        for (uint32_t k = 0; k < list.count; k++)
            walk_references(row->child, ir_walk_item(row, list, k), visit, context);
    }
}

void ir_walk_references(const struct ir_scene *scene, ir_walk_visit_reference *visit, void *context) {
    walk_references(&SCHEMA_SCENE, scene, visit, context);
}
