// A track to what is written for copies, or in an object, moves all that is made of it.
#include "parser/stages/animate.h"

#include "grammar/ir_walk.h"

#include <string.h>

static void push(struct motion *motion, const struct moving *m) {
    if (ARENA_IS_FULL(motion))
        motion->items = arena_regrow(motion->loader->input->arena, motion->items, motion->count,
                                     &motion->capacity, sizeof *motion->items);
    motion->items[motion->count++] = *m;
}

// The entry of an object that a target is in, and how many steps lead there; NULL: it is in no object.
static const struct bind_frame *entry_in_object(const struct motion *motion, struct moving *m,
                                                uint32_t *steps) {
    const struct bind_frame *entry = m->frame;
    struct override *path = m->path;
    const uint32_t count = path->step_count;
    struct override_target target;
    while (entry && !(entry->parent && entry->parent->schema == &SCHEMA_OBJECT))
        entry = entry->parent;
    if (!entry || !motion->evaluation->objects)
        return NULL;
    for (*steps = 1; *steps <= count; ++*steps) {
        path->step_count = *steps;
        const bool is_there = override_walk(path, &target) && target.kind == OVERRIDE_ENTRY;
        path->step_count = count;
        const struct schema_row *row = is_there ? &target.frame->schema->rows[target.row] : NULL;
        if (row && row->kind == SCHEMA_LIST &&
            ir_walk_item(row, ir_walk_list(row, target.frame->memory), target.entry) == entry->memory)
            return entry;
    }
    return NULL;
}

// The way to the same value in an item of a list of the scene.
static void lead_to_item(struct override *path, const struct override_step *rest, uint32_t count,
                         const struct schema_row *row, uint32_t index) {
    path->steps[0].kind = OVERRIDE_KEY;
    path->steps[0].text = str_from(schema_yaml_key(row));
    path->steps[1].kind = OVERRIDE_INDEX;
    path->steps[1].index = index;
    memcpy(path->steps + 2, rest, count * sizeof *rest);
    path->step_count = 2 + count;
}

// What is written in an object moves wherever instances show it.
static bool push_of_object(struct motion *motion, struct moving *m, const struct bind_frame *entry,
                           uint32_t steps) {
    struct override *path = m->path;
    struct override_step rest[OVERRIDE_STEPS_MAX];
    const uint32_t count = path->step_count - steps;
    const struct schema_row *row = ir_walk_pool(entry->schema);
    const uint32_t items = ir_walk_list(row, motion->scene).count;
    bool is_first = true;
    memcpy(rest, path->steps + steps, count * sizeof *rest);
    path->scene = motion->scene;
    for (uint32_t i = 0; i < items; i++) {
        struct override_target target;
        if (!copies_is_of(motion->evaluation, row, i, entry->memory))
            continue;
        lead_to_item(path, rest, count, row, i);
        copies_enter(motion->evaluation, row, i);
        const bool good = override_walk(path, &target) && moving_take_target(motion, m, &target);
        copies_leave_all(motion->evaluation);
        if (!good)
            return false;
        m->is_repeat = !is_first;
        if (is_first || m->field != motion->items[motion->count - 1].field)
            push(motion, m);
        is_first = false;
    }
    return true;
}

// What is written for a copy moves with all copies. false: it cannot move (reported).
bool moving_push_all(struct motion *motion, struct moving *m) {
    struct override *path = m->path;
    struct override_target target;
    bool single;
    const int number = schema_find_yaml(&SCHEMA_SCENE, path->steps[0].text, &single);
    const struct schema_row *row = number < 0 ? NULL : &SCHEMA_SCENE.rows[number];
    struct override_step *step = &path->steps[1];
    uint32_t count = 1, first = 0;
    if (!motion->evaluation || !motion->evaluation->copying) {
        push(motion, m);
        return true;
    }
    uint32_t steps;
    const struct bind_frame *entry = entry_in_object(motion, m, &steps);
    if (entry)
        return push_of_object(motion, m, entry, steps);
    if (row && row->kind == SCHEMA_LIST && row->many == SCHEMA_SEQUENCE && path->step_count > 1)
        first = copies_of(motion->evaluation, row, path->entry, &count);
    else
        row = NULL;
    path->scene = motion->scene;
    for (uint32_t i = 0; i < count; i++) {
        if (row) {
            step->kind = OVERRIDE_INDEX;
            step->index = first + i;
            copies_enter(motion->evaluation, row, first + i);
        }
        const bool good = override_walk(path, &target) && moving_take_target(motion, m, &target);
        copies_leave_all(motion->evaluation);
        if (!good)
            return false;
        m->is_repeat = i > 0;
        // Copies may share a material in place.
        if (i == 0 || m->field != motion->items[motion->count - 1].field)
            push(motion, m);
    }
    return true;
}
