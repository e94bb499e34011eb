// Objects are read before their instances are carried out: each after all instances that show it, so that it
// is known which of its parameters depend on the frame.
#include "parser/stages/objects.h"
#include "diag/codes/binding.h"

static struct diag_sink *sink(const struct evaluation *e) {
    return e->loader->input->sink;
}

static const struct ir_origin *origin(const struct evaluation *e) {
    return &e->loader->output->origin;
}

// ---- which instances show which object

static struct object *object_of(const struct evaluation *e, const struct ir_instance *instance) {
    return instance->object.index < e->objects->count ? &e->objects->items[instance->object.index] : NULL;
}

static void count_waits(struct evaluation *e, const struct ir_instances *instances) {
    for (uint32_t i = 0; i < instances->count; i++) {
        struct object *object = object_of(e, &instances->items[i]);
        if (!object)
            continue;
        object->waits++;
        object->uses++;
    }
}

static void push(struct objects *objects, struct object *object) {
    objects->queue[objects->queued++] = object;
}

// ---- entries

static void read_instance(struct evaluation *e, struct copy_entry *entry) {
    struct object *object = object_of(e, entry->memory);
    if (!object)
        return;
    if (object->ir->name.len == 0)
        object->owner = entry;
    if (objects_declare(e, object)) {
        entry->object = object;
        copies_enter_types(e, entry);
        objects_read_given(e, entry);
    }
    if (--object->waits == 0)
        push(e->objects, object);
}

static void read_entry(struct evaluation *e, struct copy_entry *entry) {
    entry->is_good = copies_read_entry(e, entry);
    if (entry->row->child == &SCHEMA_INSTANCE)
        read_instance(e, entry);
}

// What a parameter is computed from may be given by an instance.
static void find_moving(struct object *object) {
    for (uint32_t i = 0; i < object->ordered; i++) {
        struct parameter *p = &object->parameters[object->order[i]];
        size_t at = 0;
        str name;
        while (expression_next_name(p->ir->value, &at, &name))
            for (uint32_t k = 0; k < object->ordered; k++) {
                const struct parameter *other = &object->parameters[object->order[k]];
                p->moves |= other->moves && str_equal(other->ir->name, name);
            }
        object->types[object->outer + object->order[i]].moves = p->moves;
    }
}

static void read_object(struct evaluation *e, struct object *object) {
    struct arena *scratch = &e->loader->scratch;
    if (!objects_declare(e, object))
        return;
    find_moving(object);
    object->entries = ARENA_ARRAY(scratch, struct copy_entry **, SCHEMA_OBJECT.row_count);
    for (uint32_t i = 0; i < SCHEMA_OBJECT.row_count; i++) {
        const struct schema_row *row = &SCHEMA_OBJECT.rows[i];
        const struct ir_any_list list = ir_walk_list(row, object->ir);
        if (!copies_may(row))
            continue;
        object->entries[i] = ARENA_ARRAY(scratch, struct copy_entry *, (size_t)list.count + 1);
        for (uint32_t k = 0; k < list.count; k++) {
            struct copy_entry *entry = copies_new_entry(e, row, ir_walk_item(row, list, k));
            object->entries[i][k] = entry;
            entry->in = object;
            objects_reach(e, object);
            read_entry(e, entry);
        }
    }
    object->state = OBJECT_READ;
}

// ---- rings

static bool is_in_ring(const struct object *object) {
    return object && object->state != OBJECT_READ && object->waits > 0;
}

// An object that was not read shows one that was not read, by itself or by way of those in place in it.
static const struct object *next_in_ring(const struct evaluation *e, const struct ir_object *ir) {
    for (uint32_t i = 0; i < ir->instances.count; i++) {
        const struct object *shown = object_of(e, &ir->instances.items[i]);
        if (!shown)
            continue;
        if (shown->ir->name.len && is_in_ring(shown))
            return shown;
        const struct object *further = shown->ir->name.len ? NULL : next_in_ring(e, shown->ir);
        if (further)
            return further;
    }
    return NULL;
}

enum {
    RING_NAMES_MOST = 8 // that a message lists
};

static void report_ring(struct evaluation *e, const struct object *first) {
    struct strbuf chain;
    const struct object *object = first;
    uint32_t count = 0;
    strbuf_init(&chain);
    do {
        if (count++ < RING_NAMES_MOST)
            strbuf_format(&chain, "%.*s > ", STR_ARG(object->ir->name));
        object = next_in_ring(e, object->ir);
    } while (object && object != first);
    if (count > RING_NAMES_MOST)
        strbuf_format(&chain, "%u more > ", count - RING_NAMES_MOST);
    diag_add(sink(e), DIAG_OBJECT_RING, ir_place_label(origin(e), &first->ir->head),
             "object '%.*s' holds itself: %.*s%.*s", STR_ARG(first->ir->name), STR_ARG(strbuf_view(&chain)),
             STR_ARG(first->ir->name));
    diag_help(sink(e), "objects cannot grow out of themselves; write an object for each step");
    strbuf_finish(&chain);
}

// Each ring that is found on the way from some object, once.
static void report_rings(struct evaluation *e) {
    const struct objects *objects = e->objects;
    uint32_t *passed =
        ARENA_ARRAY(&e->loader->scratch, uint32_t, objects->count); // on the way from which, 1 + it
    for (uint32_t i = 0; i < objects->count; i++) {
        const struct object *object = &objects->items[i];
        while (is_in_ring(object) && object->ir->name.len && !passed[object - objects->items]) {
            passed[object - objects->items] = i + 1;
            object = next_in_ring(e, object->ir);
        }
        if (is_in_ring(object) && object->ir->name.len && passed[object - objects->items] == i + 1)
            report_ring(e, object);
    }
}

void objects_read(struct evaluation *e) {
    struct arena *scratch = &e->loader->scratch;
    const struct ir_objects *all = &e->scene->objects;
    const struct schema_row *instances = ir_walk_pool(&SCHEMA_INSTANCE);
    if (all->count == 0)
        return;
    e->objects = ARENA_NEW(scratch, struct objects);
    *e->objects = (struct objects){.items = ARENA_ARRAY(scratch, struct object, all->count),
                                   .count = all->count,
                                   .queue = ARENA_ARRAY(scratch, struct object *, all->count)};
    for (uint32_t i = 0; i < all->count; i++)
        e->objects->items[i] = (struct object){.ir = &all->items[i]};
    count_waits(e, &e->scene->instances);
    for (uint32_t i = 0; i < all->count; i++)
        count_waits(e, &all->items[i].instances);
    for (uint32_t i = 0; i < all->count; i++)
        if (e->objects->items[i].waits == 0)
            push(e->objects, &e->objects->items[i]);
    struct copied_list *list = copies_list(e, instances);
    for (uint32_t i = 0; i < list->written; i++) {
        objects_reach(e, NULL);
        read_entry(e, list->entries[i]);
    }
    for (uint32_t i = 0; i < e->objects->queued; i++)
        read_object(e, e->objects->queue[i]);
    copies_leave_all(e);
    if (e->objects->queued < all->count)
        report_rings(e);
}

// A file that has objects for others, and neither a camera nor anything to be seen.
static bool is_library(const struct ir_scene *scene) {
    return ir_body_count(scene) == 0 && scene->instances.count == 0 && scene->lights.count == 0 &&
           scene->cameras.count == 0;
}

static bool is_empty(const struct ir_object *object) {
    for (uint32_t i = 0; i < SCHEMA_OBJECT.row_count; i++)
        if (copies_may(&SCHEMA_OBJECT.rows[i]) && ir_walk_list(&SCHEMA_OBJECT.rows[i], object).count)
            return false;
    return true;
}

static void tell_empty(const struct evaluation *e, const struct ir_object *object) {
    const str name = object->name.len
                         ? arena_format(&e->loader->scratch, "the object '%.*s'", STR_ARG(object->name))
                         : STR("this object");
    diag_add(sink(e), DIAG_OBJECT_EMPTY, ir_place_label(origin(e), &object->head),
             "%.*s has nothing in it that could be shown", STR_ARG(name));
    diag_help(sink(e), "write bodies, lights or instances in it, or remove it");
}

void objects_tell_unused(const struct evaluation *e) {
    const bool tells_objects = !is_library(e->scene);
    for (uint32_t i = 0; e->objects && i < e->objects->count; i++) {
        const struct object *object = &e->objects->items[i];
        const struct ir_head *head = &object->ir->head;
        // Only those of the main file are meant to be shown.
        const span at = ir_place_label(origin(e), head);
        const bool is_main = at.source == e->loader->files.items[0].source;
        if (!head->poisoned && is_empty(object->ir))
            tell_empty(e, object->ir);
        else if (object->ir->name.len && object->uses == 0 && tells_objects && is_main && !head->poisoned) {
            diag_add(sink(e), DIAG_OBJECT_UNUSED, at,
                     "no instance shows the object '%.*s', which shows nothing by itself",
                     STR_ARG(object->ir->name));
            diag_help(sink(e), "write an instance of it, or remove it");
        }
        for (uint32_t k = 0; k < object->ordered; k++) {
            const struct parameter *p = &object->parameters[object->order[k]];
            if (p->is_used || p->ir->head.poisoned)
                continue;
            diag_add(sink(e), DIAG_PARAMETER_UNUSED, ir_place_label(origin(e), &p->ir->head),
                     "nothing in the object uses the parameter '%.*s'", STR_ARG(p->ir->name));
            diag_help(sink(e), "use it in an expression, or remove it");
        }
    }
}
