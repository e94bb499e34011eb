// Instances are carried out: what their objects are made of is added to the scene's lists, depth first.
#include "parser/stages/objects.h"

#include "parser/tree/reader_text.h"

static bool is_too_deep(struct evaluation *e, const struct copy_entry *entry, uint32_t depth) {
    const struct limits *limits = e->loader->input->limits;
    if (depth <= limits->value[LIMIT_OBJECT_DEPTH])
        return false;
    if (!e->copying->is_over)
        reader_limit(e->loader->input->sink, limits, LIMIT_OBJECT_DEPTH,
                     ir_place_label(&e->loader->output->origin, entry->memory),
                     "objects are nested too deeply");
    e->copying->is_over = true;
    return true;
}

static void make_entries(struct evaluation *e, const struct object *object, uint32_t row, uint32_t instance) {
    const struct schema_row *list = &SCHEMA_OBJECT.rows[row];
    const uint32_t count = ir_walk_list(list, object->ir).count;
    struct copied_list *to = copies_list(e, ir_walk_pool(list->child));
    for (uint32_t k = 0; k < count && !e->copying->is_over; k++) {
        struct copy_entry *entry = object->entries[row][k];
        if (entry->is_good && copies_enter_again(e, entry, 0, instance))
            copies_make_entry(e, to, entry, k, instance);
    }
}

// ---- how many there will be at least

// Whether a count needs no name but the scene's.
static bool is_same_everywhere(const struct copy_entry *entry, uint32_t variable) {
    const str text = entry->variables[variable].formula->text;
    size_t at = 0;
    str name;
    while (expression_next_name(text, &at, &name)) {
        for (uint32_t i = 0; i < variable; i++)
            if (str_equal(entry->variables[i].ir->name, name))
                return false;
        for (uint32_t i = 0; entry->in && i < entry->in->reach; i++)
            if (str_equal(entry->in->names[i], name))
                return false;
    }
    return true;
}

static double least_of_entry(struct evaluation *e, const struct copy_entry *entry) {
    double product = 1;
    for (uint32_t i = 0; i < entry->variable_count; i++) {
        const struct entry_variable *v = &entry->variables[i];
        uint32_t size = 0;
        if ((v->is_list || !v->formula || is_same_everywhere(entry, i)) && !copies_size(e, entry, i, &size))
            return 0;
        product *= size;
    }
    const struct schema_element *schema = entry->row->child;
    const struct schema_row *condition = &schema->rows[schema_find_row(schema, STR("if"))];
    const bool keeps_all = !entry->condition && *(const bool *)schema_field_const(condition, entry->memory);
    const double each = keeps_all && entry->object ? entry->object->least : 0;
    const bool is_made = entry->variable_count || entry->in; // what is written in the scene is not counted
    return product * (is_made + each);
}

// Before any is made. What depends on where it is made is not known here.
void objects_check_count(struct evaluation *e) {
    const struct limits *limits = e->loader->input->limits;
    const struct copied_list *list = copies_list(e, ir_walk_pool(&SCHEMA_INSTANCE));
    for (uint32_t i = e->objects->queued; i > 0; i--) { // those that are shown before those that show them
        struct object *object = e->objects->queue[i - 1];
        for (uint32_t row = 0; object->entries && row < SCHEMA_OBJECT.row_count; row++)
            for (uint32_t k = 0; object->entries[row] && object->entries[row][k]; k++)
                object->least +=
                    object->entries[row][k]->is_good ? least_of_entry(e, object->entries[row][k]) : 0;
    }
    for (uint32_t i = 0; i < list->written; i++) {
        const struct copy_entry *entry = list->entries[i];
        const double least = entry->is_good ? least_of_entry(e, entry) : 0;
        if (least <= (double)limits->value[LIMIT_COPIES])
            continue;
        const str what =
            arena_format(&e->loader->scratch,
                         least <= 0x1p53 ? "this makes %.0f things, the instances and what is in them"
                                         : "this makes %.3g things, the instances and what is in them",
                         least);
        reader_limit_needs(e->loader->input->sink, limits, LIMIT_COPIES,
                           ir_place_label(&e->loader->output->origin, entry->memory), what.ptr, least);
        e->copying->is_over = true;
        return;
    }
}

// ---- making

// `instance`: 1 + its place among all of the scene.
static void make_object(struct evaluation *e, uint32_t instance, uint32_t depth) {
    const struct schema_row *instances = ir_walk_pool(&SCHEMA_INSTANCE);
    const struct copied_list *list = copies_list(e, instances);
    const struct copy_entry *entry = copies_entry(e, instances, &list->made[instance - 1]);
    const struct object *object = entry->object;
    if (!object || object->state != OBJECT_READ || is_too_deep(e, entry, depth))
        return;
    entry->object->shown++;
    const uint32_t first = list->count;
    for (uint32_t i = 0; i < SCHEMA_OBJECT.row_count; i++)
        if (copies_may(&SCHEMA_OBJECT.rows[i]))
            make_entries(e, object, i, instance);
    const uint32_t end = list->count;
    for (uint32_t i = first; i < end && !e->copying->is_over; i++)
        make_object(e, i + 1, depth + 1);
}

// Nothing is made of an entry: mistakes in its formulas are found all the same. What was made is reported
// once.
static void end_object(struct evaluation *e, struct object *object) {
    if (object->state != OBJECT_READ) { // in a ring, or wrong: what is in place in it has no values
        struct copy_entry whole = {.row = ir_walk_pool(&SCHEMA_OBJECT), .memory = (void *)object->ir};
        copies_read_types(e, &whole);
        return;
    }
    for (uint32_t row = 0; row < SCHEMA_OBJECT.row_count; row++)
        for (uint32_t k = 0; object->entries[row] && object->entries[row][k]; k++) {
            struct copy_entry *entry = object->entries[row][k];
            const struct ir_head *head = entry->memory;
            diag_repeats(e->loader->input->sink, e->loader->output->origin.elements.items[head->origin].at);
            if (!entry->count)
                copies_read_types(e, entry);
        }
}

void objects_make(struct evaluation *e) {
    const struct copied_list *list = copies_list(e, ir_walk_pool(&SCHEMA_INSTANCE));
    const uint32_t count = list->count;
    for (uint32_t i = 0; i < count && !e->copying->is_over; i++)
        make_object(e, i + 1, 1);
    // There are too many: what instances made is of no use.
    for (uint32_t i = 0; e->copying->is_over && i < SCHEMA_SCENE.row_count; i++)
        if (copies_may(&SCHEMA_SCENE.rows[i])) {
            struct copied_list *made = copies_list(e, &SCHEMA_SCENE.rows[i]);
            made->count = made->first[made->written];
            if (made->written)
                continue;
            arena_give_back(e->loader->input->arena, made->made, made->capacity, sizeof *made->made);
            made->made = NULL;
            made->capacity = 0;
        }
    for (uint32_t i = 0; i < e->objects->count; i++)
        end_object(e, &e->objects->items[i]);
}

void objects_list(const struct evaluation *e, struct ir_copies *copies) {
    for (uint32_t i = 0; i < e->objects->count; i++) {
        const struct object *object = &e->objects->items[i];
        if (object->ir->name.len)
            *ARENA_PUSH(e->loader->input->arena, &copies->objects) =
                (struct ir_shown){object->ir->name, object->shown,
                                  ir_place_label(&e->loader->output->origin, &object->ir->head)};
    }
}
