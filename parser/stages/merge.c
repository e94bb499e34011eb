// One scene from several files: elements that occur once merge by attribute, lists are joined.
#include "core/heap.h"
#include "grammar/ir.h"
#include "grammar/ir_formula.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"
#include "parser/bind/bind.h"
#include "parser/bind/visit.h"
#include "parser/stages/loader.h"

#include <string.h>

// A file's own places stay as they are: the merged scene has its own.
void merge_own_places(struct ir_origin *origin, struct ir_head *into, const struct ir_head *from) {
    struct ir_element_origin element = origin->elements.items[from->origin];
    uint32_t row = origin->elements.items[into->origin].rows;
    element.rows = 0;
    into->origin = ir_origin_add(origin, element);
    for (; row; row = origin->rows.items[row].next)
        ir_origin_add_row(origin, into->origin, origin->rows.items[row]);
}

struct merging {
    struct loader *loader;
    struct ir_scene *into;
    bool is_main;
    uint32_t *first; // by row of the scene: entries there before this file's
};

static void move_reference(void *context, struct visit_place place, struct ir_reference *reference) {
    const struct merging *merging = context;
    if (reference->name.len == 0 && reference->index != IR_NO_INDEX)
        reference->index += merging->first[bind_home_row(place.schema->rows[place.row].child)];
}

void merge_clone_lists(struct arena *arena, const struct schema_element *schema, void *memory) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        void *field = schema_field(row, memory);
        if (row->kind == SCHEMA_ELEMENT)
            merge_clone_lists(arena, row->child, field);
        if (row->kind != SCHEMA_LIST)
            continue;
        struct ir_any_list list = ir_walk_list(row, memory);
        const void *was = list.items;
        list.capacity = list.count;
        list.items = list.count ? arena_alloc_array(arena, list.count, row->child->size) : NULL;
        if (list.count)
            memcpy(list.items, was, heap_times(list.count, row->child->size));
        memcpy(field, &list, sizeof list);
        for (uint32_t k = 0; k < list.count; k++)
            merge_clone_lists(arena, row->child, ir_walk_item(row, list, k));
    }
}

static void *clone(const struct merging *merging, const struct schema_element *schema, const void *from) {
    struct arena *arena = merging->loader->input->arena;
    void *copy = arena_alloc(arena, schema->size);
    memcpy(copy, from, schema->size);
    merge_clone_lists(arena, schema, copy);
    visit_references(schema, copy, move_reference, (void *)merging);
    return copy;
}

// Taking one alternative removes the others.
static void clear_alternatives(const struct merging *merging, const struct schema_element *schema, void *into,
                               uint32_t row) {
    const struct schema_row *taken = &schema->rows[row];
    if (taken->choice == 0)
        return;
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (i != row && schema->rows[i].choice == taken->choice)
            bind_clear_row(&merging->loader->scratch, &merging->loader->output->origin, schema, into, i);
    unsigned tag = taken->alternative;
    memcpy((char *)into + schema->choices[taken->choice - 1].tag_offset, &tag, sizeof tag);
}

static void take_row(const struct merging *merging, const struct schema_element *schema, void *into,
                     const void *from, uint32_t row) {
    struct ir_origin *origin = &merging->loader->output->origin;
    const struct schema_row *r = &schema->rows[row];
    struct ir_head *head = into;
    const struct ir_head *other = from;
    clear_alternatives(merging, schema, into, row);
    memcpy(schema_field(r, into), schema_field_const(r, from),
           (size_t)r->size * (r->many == SCHEMA_FIXED ? r->fixed_count : 1));
    head->written = (head->written & ~bind_bit(row)) | (other->written & bind_bit(row));
    head->poisoned = (head->poisoned & ~bind_bit(row)) | (other->poisoned & bind_bit(row));
    ir_formula_take(origin->arena, origin->formulas, head, other, r);
    const struct ir_row_origin *places = ir_origin_row(origin, other, row);
    if (places)
        ir_origin_add_row(origin, head->origin, *places);
}

static void join_rows(const struct merging *merging, const struct schema_row *row, void *into, void *from);

static void merge_element(const struct merging *merging, const struct schema_element *schema, void *into,
                          const void *from) {
    const struct ir_head *other = from;
    void *copy = clone(merging, schema, from);
    merge_own_places(&merging->loader->output->origin, into, other);
    for (uint32_t i = 0; i < schema->row_count; i++)
        if ((other->written | other->poisoned) & bind_bit(i)) {
            if (schema->rows[i].kind == SCHEMA_LIST)
                join_rows(merging, &schema->rows[i], schema_field(&schema->rows[i], into),
                          schema_field(&schema->rows[i], copy));
            take_row(merging, schema, into, copy, i);
        }
}

// The entry that occurs once, whichever file writes it; NULL if there is none.
static void *find_single(const struct schema_row *row, void *list, const void *item) {
    int key = row->single ? schema_key_row(row->child) : -1;
    if (key < 0)
        return NULL;
    const struct schema_row *name = &row->child->rows[key];
    if (!str_equal_cstr(*(const str *)schema_field_const(name, item), row->single))
        return NULL;
    for (uint32_t i = 0; i < bind_list_count(list); i++) {
        void *other = bind_list_item(list, i, row->child->size);
        if (str_equal_cstr(*(const str *)schema_field_const(name, other), row->single))
            return other;
    }
    return NULL;
}

static void join_lists(const struct merging *merging, const struct schema_row *row, void *into, void *from) {
    uint32_t before = bind_list_count(into);
    for (uint32_t i = 0; i < bind_list_count(from); i++) {
        const void *item = bind_list_item(from, i, row->child->size);
        struct ir_lights earlier;
        memcpy(&earlier, into, sizeof earlier);
        earlier.count = before;
        void *single = find_single(row, &earlier, item);
        if (single)
            merge_element(merging, row->child, single, item);
        else
            bind_list_push(merging->loader->input->arena, into, clone(merging, row->child, item),
                           row->child->size);
    }
}

// A list inside an element that occurs once, such as tracks: the entries of `from`, a copy of the later
// file's, replace all others.
static void join_rows(const struct merging *merging, const struct schema_row *row, void *into, void *from) {
    struct arena *arena = merging->loader->input->arena;
    for (uint32_t i = 0; i < bind_list_count(from); i++)
        bind_list_push(arena, into, bind_list_item(from, i, row->child->size), row->child->size);
    memcpy(from, into, row->size);
}

static void merge_scene_row(const struct merging *merging, struct ir_scene *from, uint32_t row) {
    const struct schema_row *r = &SCHEMA_SCENE.rows[row];
    struct ir_head *head = &merging->into->head;
    uint64_t given = (from->head.written | from->head.poisoned) & bind_bit(row);
    void *into_field = schema_field(r, merging->into);
    void *from_field = schema_field(r, from);
    if (r->child == &SCHEMA_INCLUDE)
        return;
    if (r->kind == SCHEMA_LIST) {
        join_lists(merging, r, into_field, from_field); // anonymous entries too, which nobody wrote there
    } else if (!given) {
        return;
    } else if (r->kind == SCHEMA_ELEMENT) {
        merge_element(merging, r->child, into_field, from_field);
    } else if (!(head->written & bind_bit(row)) || merging->is_main) {
        take_row(merging, &SCHEMA_SCENE, merging->into, from, row);
        return;
    }
    head->written |= from->head.written & bind_bit(row);
    head->poisoned |= from->head.poisoned & bind_bit(row);
    const struct ir_row_origin *places = ir_origin_row(&merging->loader->output->origin, &from->head, row);
    if (places)
        ir_origin_add_row(&merging->loader->output->origin, head->origin, *places);
}

// A single file that nothing overrides shares its lists and places with the scene.
static struct ir_scene *take_only_file(struct loader *loader, uint32_t include_row) {
    struct ir_origin *origin = &loader->output->origin;
    const struct ir_scene *from = loader->files.items[0].scene;
    struct ir_scene *scene = ARENA_NEW(loader->input->arena, struct ir_scene);
    *scene = *from;
    scene->head.written &= ~bind_bit(include_row);
    scene->head.poisoned &= ~bind_bit(include_row);
    scene->includes = (struct ir_includes){0};
    merge_own_places(origin, &scene->head, &from->head);
    ir_origin_remove_row(origin, scene->head.origin, include_row);
    return scene;
}

// A frame of an animation overwrites the values of the file.
static bool takes_frame(const struct ir_scene *scene) {
    const uint32_t row = (uint32_t)schema_find_row(&SCHEMA_ANIMATION, STR("frame"));
    return (scene->animation.head.written & bind_bit(row)) != 0;
}

struct ir_scene *merge_files(struct loader *loader) {
    if (loader->order.count == 1 && loader->input->set_count == 0 &&
        !takes_frame(loader->files.items[0].scene))
        return take_only_file(loader, (uint32_t)schema_find_row(&SCHEMA_SCENE, STR("include")));
    struct ir_origin *origin = &loader->output->origin;
    struct ir_scene *scene = ARENA_NEW(loader->input->arena, struct ir_scene);
    schema_init(&SCHEMA_SCENE, scene);
    scene->formulas = origin->formulas;
    struct ir_element_origin root = origin->elements.items[loader->files.items[0].scene->head.origin];
    root.rows = 0;
    scene->head.origin = ir_origin_add(origin, root);
    uint32_t *first = ARENA_ARRAY(loader->input->arena, uint32_t, SCHEMA_SCENE.row_count);
    for (uint32_t i = 0; i < loader->order.count; i++) {
        uint32_t file = loader->order.items[i];
        struct ir_scene *from = loader->files.items[file].scene;
        struct merging merging = {.loader = loader, .into = scene, .is_main = file == 0, .first = first};
        for (uint32_t row = 0; from && row < SCHEMA_SCENE.row_count; row++)
            if (SCHEMA_SCENE.rows[row].kind == SCHEMA_LIST)
                first[row] = bind_list_count(schema_field(&SCHEMA_SCENE.rows[row], scene));
        for (uint32_t row = 0; from && row < SCHEMA_SCENE.row_count; row++)
            merge_scene_row(&merging, from, row);
    }
    arena_finish(&loader->scratch);
    return scene;
}

// Compacting.

struct uses {
    const struct schema_element *of;
    bool *used;
    uint32_t *moved_to;
};

static bool is_use(const struct uses *uses, struct visit_place place, const struct ir_reference *reference) {
    return reference->index != IR_NO_INDEX && place.schema->rows[place.row].child == uses->of;
}

static void mark_use(void *context, struct visit_place place, struct ir_reference *reference) {
    struct uses *uses = context;
    if (is_use(uses, place, reference))
        uses->used[reference->index] = true;
}

static void move_use(void *context, struct visit_place place, struct ir_reference *reference) {
    const struct uses *uses = context;
    if (is_use(uses, place, reference))
        reference->index = uses->moved_to[reference->index];
}

static void compact(struct loader *loader, struct ir_scene *scene, const struct schema_element *of) {
    const struct schema_row *pool = ir_walk_pool(of);
    const struct ir_any_list list = ir_walk_list(pool, scene);
    uint32_t kept = 0, named = 0;
    while (named < list.count && !ir_walk_is_anonymous(of, ir_walk_item(pool, list, named)))
        named++;
    if (named == list.count)
        return;
    struct uses uses = {of, ARENA_ARRAY(&loader->scratch, bool, list.count),
                        ARENA_ARRAY(&loader->scratch, uint32_t, list.count)};
    visit_references(&SCHEMA_SCENE, scene, mark_use, &uses);
    for (uint32_t i = 0; i < list.count; i++) {
        const void *item = ir_walk_item(pool, list, i);
        uses.moved_to[i] = kept;
        if (uses.used[i] || !ir_walk_is_anonymous(of, item))
            memmove(ir_walk_item(pool, list, kept++), item, of->size);
    }
    bind_list_cut(schema_field(pool, scene), kept);
    visit_references(&SCHEMA_SCENE, scene, move_use, &uses);
}

void merge_compact(struct loader *loader, struct ir_scene *scene) {
    compact(loader, scene, &SCHEMA_MATERIAL);
    compact(loader, scene, &SCHEMA_MESH);
    arena_finish(&loader->scratch);
}
