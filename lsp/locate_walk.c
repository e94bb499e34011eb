#include "grammar/ir.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_walk.h"
#include "lsp/locate.h"

#include <string.h>

const struct ir_scene *locate_scene(const struct session *session) {
    return session->scene && session->origin.copies ? session->origin.written : session->scene;
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

// ---- with what is in reach of each element

struct walk {
    const struct ir_scene *scene;
    struct arena *arena;
    locate_visit_scoped *visit;
    void *context;
    struct located_scope *
        *owners; // by row of the scene, of the things in a list that are in place in entries
    bool **is_owned;
};

static const struct schema_row *for_row(const struct schema_element *schema) {
    const int row = schema_find_row(schema, STR("for"));
    return row >= 0 && schema->rows[row].child == &SCHEMA_VARIABLE ? &schema->rows[row] : NULL;
}

bool locate_is_of_copies(const struct schema_row *row) {
    return row->child == &SCHEMA_VARIABLE || (row->kind == SCHEMA_BOOLEAN && strcmp(row->name, "if") == 0);
}

bool locate_has_entries(const struct schema_row *row) {
    return row->kind == SCHEMA_LIST && for_row(row->child);
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

const struct ir_object *locate_shown(const struct session *session, const struct ir_instance *instance) {
    const struct ir_scene *scene = locate_scene(session);
    return scene && instance->object.index < scene->objects.count
               ? &scene->objects.items[instance->object.index]
               : NULL;
}

bool locate_is_argument(const struct schema_element *schema, const struct located_scope *scope) {
    return schema == &SCHEMA_PARAMETER && scope->object;
}

// What an element in a list sees: an entry has variables of its own.
static struct located_scope scope_in(const struct schema_row *list, const void *item,
                                     const struct located_scope *outside) {
    struct located_scope scope = *outside;
    if (locate_has_entries(list)) {
        scope.list = list;
        scope.entry = item;
    }
    scope.reach = UINT32_MAX;
    return scope;
}

// What the things in an object see. `instance`: of an object in place, what its instance sees.
static struct located_scope scope_of_object(const struct walk *walk, const struct ir_object *object,
                                            const struct located_scope *instance) {
    struct located_scope scope = {.reach = UINT32_MAX, .object = object};
    if (instance && object->name.len == 0) {
        struct located_scope *around = ARENA_NEW(walk->arena, struct located_scope);
        *around = *instance;
        scope.around = around;
    }
    return scope;
}

static void note_owner(struct walk *walk, const struct schema_element *schema, const void *element,
                       const struct located_scope *scope);

static void note_in_place(struct walk *walk, const struct schema_row *row,
                          const struct ir_reference *reference, const struct located_scope *scope) {
    const struct schema_row *pool = ir_walk_pool(row->child);
    const size_t number = (size_t)(pool - SCHEMA_SCENE.rows);
    const void *element = ir_walk_referent(walk->scene, row, reference);
    if (!walk->owners[number]) {
        const uint32_t count = ir_walk_list(pool, walk->scene).count;
        walk->owners[number] = ARENA_ARRAY(walk->arena, struct located_scope, count);
        walk->is_owned[number] = ARENA_ARRAY(walk->arena, bool, count);
    }
    if (walk->is_owned[number][reference->index])
        return;
    walk->is_owned[number][reference->index] = true;
    const struct located_scope inside =
        row->child == &SCHEMA_OBJECT ? scope_of_object(walk, element, scope) : *scope;
    walk->owners[number][reference->index] = inside;
    note_owner(walk, row->child, element, &inside);
}

// What is in place in the element, also in something that is.
static void note_owner(struct walk *walk, const struct schema_element *schema, const void *element,
                       const struct located_scope *scope) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const struct ir_any_list list = ir_walk_list(row, element);
        for (uint32_t k = 0; k < list.count; k++) {
            const void *item = ir_walk_item(row, list, k);
            const struct located_scope inside = scope_in(row, item, scope);
            note_owner(walk, row->child, item, &inside);
        }
        if (row->kind == SCHEMA_ELEMENT)
            note_owner(walk, row->child, schema_field_const(row, element), scope);
        if (row->kind == SCHEMA_REFERENCE &&
            ir_walk_is_inline(walk->scene, row, schema_field_const(row, element)))
            note_in_place(walk, row, schema_field_const(row, element), scope);
    }
}

static void walk_element(const struct walk *walk, const struct schema_element *schema, const void *element,
                         const struct located_scope *scope) {
    walk->visit(walk->context, schema, element, scope);
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const struct ir_any_list list = ir_walk_list(row, element);
        for (uint32_t k = 0; k < list.count; k++) {
            const void *item = ir_walk_item(row, list, k);
            struct located_scope inside = scope_in(row, item, scope);
            inside.reach = row->child == &SCHEMA_VARIABLE ? k : UINT32_MAX;
            walk_element(walk, row->child, item, &inside);
        }
        if (row->kind == SCHEMA_ELEMENT)
            walk_element(walk, row->child, schema_field_const(row, element), scope);
    }
}

static struct located_scope scope_of(const struct walk *walk, const struct schema_row *row, const void *item,
                                     uint32_t i) {
    const struct located_scope nothing = {.reach = UINT32_MAX};
    const struct located_scope *owners = walk->owners[row - SCHEMA_SCENE.rows];
    if (owners && walk->is_owned[row - SCHEMA_SCENE.rows][i])
        return owners[i];
    return row->child == &SCHEMA_OBJECT ? scope_of_object(walk, item, NULL) : scope_in(row, item, &nothing);
}

static void note_owners(struct walk *walk) {
    for (uint32_t r = 0; r < SCHEMA_SCENE.row_count; r++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[r];
        const struct ir_any_list list = ir_walk_list(row, walk->scene);
        for (uint32_t k = 0; k < list.count && (locate_has_entries(row) || row->child == &SCHEMA_OBJECT);
             k++) {
            const void *item = ir_walk_item(row, list, k);
            const struct located_scope scope = scope_of(walk, row, item, k);
            if (!ir_walk_is_anonymous(row->child, item)) // else its owner is met
                note_owner(walk, row->child, item, &scope);
        }
    }
}

void locate_walk_scoped(const struct session *session, struct arena *arena, locate_visit_scoped *visit,
                        void *context) {
    struct walk walk = {.scene = locate_scene(session), .arena = arena, .visit = visit, .context = context};
    const struct located_scope nothing = {.reach = UINT32_MAX};
    if (!walk.scene)
        return;
    walk.owners = ARENA_ARRAY(arena, struct located_scope *, SCHEMA_SCENE.row_count);
    walk.is_owned = ARENA_ARRAY(arena, bool *, SCHEMA_SCENE.row_count);
    note_owners(&walk);
    for (uint32_t r = 0; r < SCHEMA_SCENE.row_count; r++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[r];
        const struct ir_any_list list = ir_walk_list(row, walk.scene);
        for (uint32_t k = 0; k < list.count; k++) {
            const void *item = ir_walk_item(row, list, k);
            const struct located_scope scope = scope_of(&walk, row, item, k);
            walk_element(&walk, row->child, item, &scope);
        }
        if (row->kind == SCHEMA_ELEMENT)
            walk_element(&walk, row->child, schema_field_const(row, walk.scene), &nothing);
    }
}
