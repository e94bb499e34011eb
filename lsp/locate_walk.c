#include "grammar/ir.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_walk.h"
#include "lsp/locate.h"

#include <string.h>

const struct ir_scene *locate_scene(const struct session *session) {
    const struct ir_copies *copies = session->origin.copies;
    return session->scene && copies && copies->written ? copies->written : session->scene;
}

span locate_name_place(const struct session *session, const struct schema_element *schema,
                       const void *element) {
    int key = schema_key_row(schema);
    const struct ir_row_origin *row =
        key < 0 ? NULL : ir_origin_row(&session->origin, ir_walk_head(element), (uint32_t)key);
    return row ? row->value : ir_place_label(&session->origin, ir_walk_head(element));
}

void locate_walk(const struct schema_element *schema, const void *element, locate_visit *visit,
                 void *context) {
    visit(context, schema, element);
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (row->kind == SCHEMA_ELEMENT)
            locate_walk(row->child, schema_field_const(row, element), visit, context);
        struct ir_any_list list = ir_walk_list(row, element);
        for (uint32_t k = 0; k < list.count; k++)
            locate_walk(row->child, ir_walk_item(row, list, k), visit, context);
    }
}

// ---- with the entry around each element

struct walk {
    const struct ir_scene *scene;
    struct arena *arena;
    locate_visit_scoped *visit;
    void *context;
    struct located_scope *
        *owners; // by row of the scene, of the things in a list that are in place in entries
};

static const struct schema_row *for_row(const struct schema_element *schema) {
    const int row = schema_find_row(schema, STR("for"));
    return row >= 0 && schema->rows[row].child == &SCHEMA_VARIABLE ? &schema->rows[row] : NULL;
}

bool locate_is_of_copies(const struct schema_row *row) {
    return row->child == &SCHEMA_VARIABLE || (row->kind == SCHEMA_BOOLEAN && strcmp(row->name, "if") == 0);
}

struct ir_variables locate_variables(const struct located_scope *scope) {
    struct ir_variables variables = {0};
    if (!scope->list)
        return variables;
    const struct ir_any_list list = ir_walk_list(for_row(scope->list->child), scope->entry);
    variables.items = list.items;
    variables.count = list.count;
    return variables;
}

// What is in place in the entry, also in something that is.
static void note_owner(struct walk *walk, const struct schema_element *schema, const void *element,
                       const struct located_scope *scope) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const struct ir_any_list list = ir_walk_list(row, element);
        for (uint32_t k = 0; k < list.count; k++)
            note_owner(walk, row->child, ir_walk_item(row, list, k), scope);
        if (row->kind == SCHEMA_ELEMENT)
            note_owner(walk, row->child, schema_field_const(row, element), scope);
        if (row->kind != SCHEMA_REFERENCE)
            continue;
        const struct ir_reference *reference = schema_field_const(row, element);
        if (!ir_walk_is_inline(walk->scene, row, reference))
            continue;
        const struct schema_row *pool = ir_walk_pool(row->child);
        struct located_scope **owners = &walk->owners[pool - SCHEMA_SCENE.rows];
        if (!*owners)
            *owners = ARENA_ARRAY(walk->arena, struct located_scope, ir_walk_list(pool, walk->scene).count);
        if ((*owners)[reference->index].list)
            continue;
        (*owners)[reference->index] = *scope;
        note_owner(walk, row->child, ir_walk_referent(walk->scene, row, reference), scope);
    }
}

static void walk_element(const struct walk *walk, const struct schema_element *schema, const void *element,
                         struct located_scope scope) {
    walk->visit(walk->context, schema, element, &scope);
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const struct ir_any_list list = ir_walk_list(row, element);
        for (uint32_t k = 0; k < list.count; k++) {
            scope.reach = row->child == &SCHEMA_VARIABLE ? k : UINT32_MAX;
            walk_element(walk, row->child, ir_walk_item(row, list, k), scope);
        }
        scope.reach = UINT32_MAX;
        if (row->kind == SCHEMA_ELEMENT)
            walk_element(walk, row->child, schema_field_const(row, element), scope);
    }
}

static struct located_scope scope_of(const struct walk *walk, const struct schema_row *row, const void *item,
                                     uint32_t i) {
    const struct located_scope *owners = walk->owners[row - SCHEMA_SCENE.rows];
    if (for_row(row->child))
        return (struct located_scope){row, item, i, UINT32_MAX};
    return owners ? owners[i] : (struct located_scope){.reach = UINT32_MAX};
}

static void note_owners(struct walk *walk) {
    for (uint32_t r = 0; r < SCHEMA_SCENE.row_count; r++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[r];
        const struct ir_any_list list = ir_walk_list(row, walk->scene);
        for (uint32_t k = 0; k < list.count && for_row(row->child); k++) {
            const struct located_scope scope = {row, ir_walk_item(row, list, k), k, UINT32_MAX};
            note_owner(walk, row->child, scope.entry, &scope);
        }
    }
}

void locate_walk_scoped(const struct session *session, struct arena *arena, locate_visit_scoped *visit,
                        void *context) {
    struct walk walk = {.scene = locate_scene(session), .arena = arena, .visit = visit, .context = context};
    if (!walk.scene)
        return;
    walk.owners = ARENA_ARRAY(arena, struct located_scope *, SCHEMA_SCENE.row_count);
    note_owners(&walk);
    for (uint32_t r = 0; r < SCHEMA_SCENE.row_count; r++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[r];
        const struct ir_any_list list = ir_walk_list(row, walk.scene);
        for (uint32_t k = 0; k < list.count; k++) {
            const void *item = ir_walk_item(row, list, k);
            walk_element(&walk, row->child, item, scope_of(&walk, row, item, k));
        }
        if (row->kind == SCHEMA_ELEMENT)
            walk_element(&walk, row->child, schema_field_const(row, walk.scene),
                         (struct located_scope){.reach = UINT32_MAX});
    }
}
