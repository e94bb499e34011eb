// The scene's lists get what `for`, `if` and instances make.
#include "parser/stages/objects.h"

static struct diag_sink *sink(const struct evaluation *e) {
    return e->loader->input->sink;
}

static void list_written(struct evaluation *e, const struct schema_row *row) {
    const struct ir_any_list written = ir_walk_list(row, e->scene);
    struct copied_list *list = copies_list(e, row);
    list->written = written.count;
    list->entries = ARENA_ARRAY(&e->loader->scratch, struct copy_entry *, (size_t)written.count + 1);
    list->first = ARENA_ARRAY(&e->loader->scratch, uint32_t, (size_t)written.count + 1);
    for (uint32_t i = 0; i < written.count; i++) {
        void *item = ir_walk_item(row, written, i);
        if (row->child == &SCHEMA_INSTANCE || copies_is_copied(row, item)) {
            list->entries[i] = copies_new_entry(e, row, item);
            list->is_copied = true;
        }
    }
}

static void make_list(struct evaluation *e, const struct schema_row *row) {
    struct copied_list *list = copies_list(e, row);
    if (!list->is_copied && !e->objects) // all are as written
        return;
    for (uint32_t i = 0; i < list->written; i++) {
        struct copy_entry *entry = list->entries[i];
        list->first[i] = list->count;
        if (!entry) {
            copies_push(e, list, (struct ir_copy){i, 0, 0});
            continue;
        }
        copies_leave_all(e);
        if (row->child == &SCHEMA_INSTANCE && e->objects)
            copies_enter_types(e, entry);
        else
            entry->is_good = copies_read_entry(e, entry);
        copies_make_entry(e, list, entry, i, 0);
        // Nothing is made of it: mistakes in its formulas are found all the same.
        if (!entry->count)
            copies_read_types(e, entry);
    }
    list->first[list->written] = list->count;
    if (!list->made)
        list->made = ARENA_ARRAY(e->loader->input->arena, struct ir_copy, 1);
}

// What is said of them afterwards: in messages, once for all copies.
static void list_entries(struct evaluation *e, struct ir_copies *copies) {
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[i];
        const struct copied_list *list = &e->copying->lists[i];
        for (uint32_t k = 0; k < list->written; k++) {
            const struct copy_entry *entry = list->entries[k];
            if (!entry)
                continue;
            const struct ir_head *head = ir_walk_head(entry->memory);
            if (!copies_is_copied(row, entry->memory))
                continue;
            diag_repeats(sink(e), e->loader->output->origin.elements.items[head->origin].at);
            *ARENA_PUSH(e->loader->input->arena, &copies->entries) =
                (struct ir_copied){row, k, (uint32_t)entry->count, entry->frame->name,
                                   ir_place_label(&e->loader->output->origin, head)};
        }
    }
}

void copies_make(struct evaluation *e) {
    struct arena *scratch = &e->loader->scratch;
    if (e->copying || !copies_are_written(e->scene))
        return;
    e->copying = ARENA_NEW(scratch, struct copying);
    *e->copying = (struct copying){.written = *e->scene,
                                   .lists = ARENA_ARRAY(scratch, struct copied_list, SCHEMA_SCENE.row_count)};
    str_map_init(&e->copying->cloned, scratch);
    copies_push_places(e, NULL, 0); // none
    e->formula_count = e->scene->formulas->count;
    e->formulas = ARENA_ARRAY(scratch, struct copy_formula, e->formula_count);
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++)
        if (copies_may(&SCHEMA_SCENE.rows[i]))
            list_written(e, &SCHEMA_SCENE.rows[i]);
    objects_read(e);
    if (e->objects)
        objects_check_count(e);
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++)
        if (copies_may(&SCHEMA_SCENE.rows[i]))
            make_list(e, &SCHEMA_SCENE.rows[i]);
    if (e->objects)
        objects_make(e);
    struct ir_copies *copies = ARENA_NEW(e->loader->input->arena, struct ir_copies);
    list_entries(e, copies);
    struct ir_scene *document = ARENA_NEW(e->loader->input->arena, struct ir_scene);
    document->objects = e->scene->objects;
    document->instances = e->scene->instances;
    copies->document = document;
    if (e->objects)
        objects_list(e, copies);
    copies->lists = ARENA_ARRAY(e->loader->input->arena, struct ir_copy *, SCHEMA_SCENE.row_count);
    copies->places = e->copying->places;
    copies->instances = &e->scene->instances;
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++)
        copies->lists[i] = e->copying->lists[i].made;
    e->loader->output->origin.copies = copies;
    e->scene->copies = copies;
    copies_fill(e);
}
