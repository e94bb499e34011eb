// Copies: what `for` and `if` make of the entries of the scene's lists.
#include "parser/stages/copies.h"
#include "diag/codes/binding.h"
#include "diag/codes/limit.h"

#include "core/heap.h"
#include "grammar/ir_copy.h"
#include "parser/bind/visit.h"
#include "parser/tree/reader_text.h"

#include <stdio.h>
#include <string.h>

static struct diag_sink *sink(const struct evaluation *e) {
    return e->loader->input->sink;
}

static uint32_t number_of(const struct schema_row *row) {
    return (uint32_t)(row - SCHEMA_SCENE.rows);
}

// The rows of an entry that say what is made of it.
struct copy_rows {
    const struct schema_row *variables, *condition;
    uint64_t bits;
};

static struct copy_rows rows_of(const struct schema_element *schema) {
    const uint32_t list = (uint32_t)schema_find_row(schema, STR("for"));
    const uint32_t condition = (uint32_t)schema_find_row(schema, STR("if"));
    return (struct copy_rows){&schema->rows[list], &schema->rows[condition],
                              bind_bit(list) | bind_bit(condition)};
}

static bool is_written(const struct copy_rows *rows, const void *entry) {
    const struct ir_head *head = ir_walk_head(entry);
    return ((head->written | head->poisoned) & rows->bits) != 0;
}

bool copies_are_written(const struct ir_scene *scene) {
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[i];
        if (!copies_may(row))
            continue;
        const struct copy_rows rows = rows_of(row->child);
        const struct ir_any_list list = ir_walk_list(row, scene);
        for (uint32_t k = 0; k < list.count; k++)
            if (is_written(&rows, ir_walk_item(row, list, k)))
                return true;
    }
    return false;
}

// ---- one copy after the other

static span for_place(const struct evaluation *e, const struct copy_entry *entry) {
    return ir_place_value(&e->loader->output->origin, ir_walk_head(entry->memory), entry->row->child, "for");
}

// `factors`: ": 100 x 100". `product` 0: not known yet.
static bool report_over(struct evaluation *e, const struct copy_entry *entry, double product, str factors) {
    struct arena *scratch = &e->loader->scratch;
    const char *what = schema_yaml_key(entry->row);
    const str number =
        product <= 0x1p53 ? arena_format(scratch, "%.0f", product) : arena_format(scratch, "%.3g", product);
    str text = arena_format(scratch, "this makes %.*s %s%.*s", STR_ARG(number), what, STR_ARG(factors));
    if (product <= 0)
        text = arena_format(scratch, "this makes too many %s", what);
    else if (e->copying->steps)
        text = arena_format(scratch, "%.*s, after %llu by other entries", STR_ARG(text),
                            (unsigned long long)e->copying->steps);
    e->copying->is_over = true;
    reader_limit(sink(e), e->loader->input->limits, LIMIT_COPIES, for_place(e, entry), text.ptr);
    return false;
}

static void push_place(struct evaluation *e, uint32_t place) {
    struct copying *c = e->copying;
    if (c->place_count == c->place_capacity)
        c->places = arena_regrow(e->loader->input->arena, c->places, c->place_count, &c->place_capacity,
                                 sizeof *c->places);
    c->places[c->place_count++] = place;
}

static uint32_t push_places(struct evaluation *e, const uint32_t *places, uint32_t count) {
    const uint32_t at = e->copying->place_count;
    push_place(e, count);
    for (uint32_t i = 0; i < count; i++)
        push_place(e, places[i]);
    return at;
}

static void push_made(struct evaluation *e, struct copied_list *list, struct ir_copy copy) {
    if (ARENA_IS_FULL(list))
        list->made = arena_regrow(e->loader->input->arena, list->made, list->count, &list->capacity,
                                  sizeof *list->made);
    list->made[list->count++] = copy;
}

static bool is_kept(struct evaluation *e, const struct copy_entry *entry, bool *kept) {
    struct expression_fault fault;
    double value[EXPRESSION_WIDTH];
    if (!entry->condition) {
        *kept = *(const bool *)schema_field_const(rows_of(entry->row->child).condition, entry->memory);
        return true;
    }
    if (!expression_at(&entry->if_expression, &e->at, value, &fault)) {
        evaluation_fault(e, DIAG_EXPRESSION, entry->condition->text, entry->condition->at,
                         evaluation_suffix(e), &fault);
        return false;
    }
    *kept = value[0] != 0;
    return true;
}

struct turning {
    struct copy_entry *entry;
    struct copied_list *list;
    uint32_t index;   // of the entry
    bool counts_only; // and makes nothing
    uint32_t places[IR_VARIABLES_MOST];
};

static bool count_place(struct evaluation *e, const struct copy_entry *entry) {
    return ++e->copying->steps <= e->loader->input->limits->value[LIMIT_COPIES] ||
           report_over(e, entry, 0, STR(""));
}

// As an odometer: the last variable turns fastest.
static bool turn(struct evaluation *e, struct turning *t, uint32_t variable) {
    uint32_t size;
    bool kept;
    if (variable == t->entry->variable_count) {
        if (variable && !count_place(e, t->entry))
            return false;
        if (t->counts_only)
            return true;
        if (!is_kept(e, t->entry, &kept))
            return false;
        if (kept)
            push_made(e, t->list,
                      (struct ir_copy){t->index, variable ? push_places(e, t->places, variable) : 0});
        t->entry->count += kept;
        return true;
    }
    if (!copies_size(e, t->entry, variable, &size))
        return false;
    if (size == 0)
        return count_place(e, t->entry);
    for (uint32_t i = 0; i < size; i++) {
        t->places[variable] = i;
        if (!copies_set(e, t->entry, variable, i) || !turn(e, t, variable + 1))
            return false;
    }
    return true;
}

static bool fits_by_counting(struct evaluation *e, struct copy_entry *entry) {
    const uint64_t steps = e->copying->steps;
    struct turning turning = {.entry = entry, .counts_only = true};
    const bool good = turn(e, &turning, 0);
    e->copying->steps = steps;
    return good;
}

// Whether there are not too many, before any is made: by their product, where no count depends on a variable.
static bool copies_fit(struct evaluation *e, struct copy_entry *entry) {
    const uint64_t most = e->loader->input->limits->value[LIMIT_COPIES];
    double product = 1;
    str factors = STR("");
    for (uint32_t i = 0; i < entry->variable_count; i++) {
        const struct entry_variable *v = &entry->variables[i];
        uint32_t size;
        if (copies_used(e, entry, &SCHEMA_VARIABLE, v->ir) && !v->is_list)
            return fits_by_counting(e, entry);
        if (!copies_size(e, entry, i, &size))
            return false;
        product *= size;
        factors = arena_format(&e->loader->scratch, "%.*s%s%u", STR_ARG(factors), i ? " x " : ": ", size);
    }
    if ((double)e->copying->steps + product <= (double)most)
        return true;
    return report_over(e, entry, product, entry->variable_count > 1 ? factors : STR(""));
}

static void replace(void *context, struct visit_place place, struct ir_reference *reference);

static void use(void *context, struct visit_place place, struct ir_reference *reference) {
    struct evaluation *e = context;
    const struct schema_row *row = &place.schema->rows[place.row];
    struct copy_entry *entry = (struct copy_entry *)e->entry;
    if (ir_walk_is_inline(e->scene, row, reference))
        entry->used |= copies_used(e, entry, row->child, ir_walk_referent(e->scene, row, reference));
}

// Its own formulas, and those of what is in place in it.
static void find_used(struct evaluation *e, struct copy_entry *entry) {
    e->entry = entry;
    entry->used = copies_used(e, entry, entry->row->child, entry->memory);
    visit_references(entry->row->child, entry->memory, use, e);
}

static void make_entry(struct evaluation *e, struct copied_list *list, struct copy_entry *entry,
                       uint32_t index) {
    struct turning turning = {.entry = entry, .list = list, .index = index};
    const uint32_t before = list->count;
    entry->is_good = copies_read_entry(e, entry);
    if (entry->is_good)
        find_used(e, entry);
    if (entry->is_good && !e->copying->is_over && copies_fit(e, entry) && !turn(e, &turning, 0))
        list->count = before;
    entry->count = list->count - before;
    if (entry->count)
        return;
    // Nothing is made of it: mistakes in its formulas are found all the same.
    if (entry->is_good) {
        copies_enter_again(e, entry, 0);
        evaluate_types(e, entry->row, entry->memory);
    }
    visit_references(entry->row->child, entry->memory, replace, e);
}

static struct copy_entry *new_entry(struct evaluation *e, const struct schema_row *row, void *memory) {
    struct arena *scratch = &e->loader->scratch;
    const int name = visit_name_row(row->child);
    struct copy_entry *entry = ARENA_NEW(scratch, struct copy_entry);
    struct bind_frame *root = ARENA_NEW(scratch, struct bind_frame);
    struct bind_frame *frame = ARENA_NEW(scratch, struct bind_frame);
    *root = (struct bind_frame){.schema = &SCHEMA_SCENE, .memory = e->scene};
    *frame = (struct bind_frame){.parent = root,
                                 .schema = row->child,
                                 .via = row,
                                 .memory = memory,
                                 .label = ir_place_label(&e->loader->output->origin, memory)};
    if (name >= 0)
        frame->name = *(const str *)schema_field_const(&row->child->rows[name], memory);
    *entry = (struct copy_entry){.row = row, .memory = memory, .frame = frame};
    return entry;
}

// ---- materials and meshes in place

static void list_pool(struct evaluation *e, const struct schema_row *row) {
    struct copied_list *pool = copies_list(e, row);
    if (pool->is_replaced)
        return;
    pool->own = ir_walk_list(row, e->scene).count;
    pool->is_replaced = ARENA_ARRAY(&e->loader->scratch, bool, pool->own + 1);
}

// What is in place in an entry that makes nothing.
static void replace(void *context, struct visit_place place, struct ir_reference *reference) {
    struct evaluation *e = context;
    const struct schema_row *row = &place.schema->rows[place.row];
    if (!ir_walk_is_inline(e->scene, row, reference))
        return;
    const struct schema_row *pool = ir_walk_pool(row->child);
    void *item = (void *)ir_walk_referent(e->scene, row, reference);
    list_pool(e, pool);
    copies_list(e, pool)->is_replaced[reference->index] = true;
    if (e->entry && e->entry->is_good)
        evaluate_types(e, pool, item);
}

static uint32_t push_clone(struct evaluation *e, const struct schema_row *row, const void *item) {
    struct copied_list *pool = copies_list(e, row);
    struct arena *arena = e->loader->input->arena;
    void *copy = arena_alloc(arena, row->child->size);
    memcpy(copy, item, row->child->size);
    merge_clone_lists(arena, row->child, copy);
    if (pool->clone_count == pool->clone_capacity)
        pool->clones = arena_regrow(&e->loader->scratch, pool->clones, pool->clone_count,
                                    &pool->clone_capacity, sizeof *pool->clones);
    pool->clones[pool->clone_count++] = (struct copy_clone){e->entry, e->places};
    return ir_walk_append(arena, row, e->scene, copy);
}

// Copies with the same values of the variables that are in it share what is in place.
static void clone_in_place(void *context, struct visit_place place, struct ir_reference *reference) {
    struct evaluation *e = context;
    const struct schema_row *row = &place.schema->rows[place.row];
    if (!ir_walk_is_inline(e->scene, row, reference))
        return;
    const struct schema_row *pool = ir_walk_pool(row->child);
    const void *item = ir_walk_referent(e->scene, row, reference);
    const uint32_t used = copies_used(e, e->entry, row->child, item);
    if (!used)
        return;
    list_pool(e, pool);
    copies_list(e, pool)->is_replaced[reference->index] = true;
    uint32_t key[IR_VARIABLES_MOST + 2] = {number_of(pool), reference->index};
    for (uint32_t i = 0; i < e->entry->variable_count; i++)
        key[2 + i] = used >> i & 1 ? e->copying->places[e->places + 1 + i] : 0;
    const str bytes = {(const char *)key, sizeof *key * (e->entry->variable_count + 2)};
    uint32_t number = str_map_find(&e->copying->cloned, bytes);
    if (number == 0) {
        number = push_clone(e, pool, item) + 1;
        *str_map_at(&e->copying->cloned, arena_copy(&e->loader->scratch, bytes)) = number;
    }
    reference->index = number - 1;
}

static bool has_lists(const struct schema_element *schema, const void *memory) {
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (ir_walk_list(&schema->rows[i], memory).count)
            return true;
    return false;
}

// ---- the scene's list

static void name_copy(struct evaluation *e, const struct schema_row *row, void *item, uint32_t places) {
    const int name_row = visit_name_row(row->child);
    str *name = name_row < 0 ? NULL : schema_field(&row->child->rows[name_row], item);
    if (!name || !name->len || !places)
        return;
    char text[IR_VARIABLES_MOST * 12 + 1];
    size_t length = 0;
    const uint32_t *at = e->copying->places + places;
    for (uint32_t i = 0; i < at[0]; i++)
        length += (size_t)snprintf(text + length, sizeof text - length, "[%u]", at[1 + i]);
    *name = arena_format(e->loader->input->arena, "%.*s%s", STR_ARG(*name), text);
}

static void fill(struct evaluation *e, const struct schema_row *row, struct copied_list *list,
                 struct ir_any_list written) {
    const struct copy_rows rows = rows_of(row->child);
    struct arena *arena = e->loader->input->arena;
    struct ir_any_list made = {
        .items = arena_alloc(arena, heap_times(list->count ? list->count : 1, row->child->size)),
        .count = list->count,
        .capacity = list->count};
    for (uint32_t i = 0; i < made.count; i++) {
        const struct ir_copy *copy = &list->made[i];
        const struct copy_entry *entry = list->entries[copy->entry];
        void *item = ir_walk_item(row, made, i);
        memcpy(item, ir_walk_item(row, written, copy->entry), row->child->size);
        if (!entry)
            continue;
        memset(schema_field(rows.variables, item), 0, rows.variables->size);
        *(bool *)schema_field(rows.condition, item) = true;
        ((struct ir_head *)item)->written &= ~rows.bits;
        name_copy(e, row, item, copy->places);
        if (!entry->variable_count)
            continue;
        e->entry = entry;
        e->places = copy->places;
        if (has_lists(row->child, item))
            merge_clone_lists(arena, row->child, item);
        visit_references(row->child, item, clone_in_place, e);
    }
    memcpy(schema_field(row, e->scene), &made, sizeof made);
    if (made.count == 0) // an empty list is left out
        e->scene->head.written &= ~bind_bit(number_of(row));
    copies_leave(e);
}

static void make_list(struct evaluation *e, const struct schema_row *row) {
    const struct copy_rows rows = rows_of(row->child);
    const struct ir_any_list written = ir_walk_list(row, e->scene);
    struct copied_list *list = copies_list(e, row);
    uint32_t at = 0;
    while (at < written.count && !is_written(&rows, ir_walk_item(row, written, at)))
        at++;
    if (at == written.count)
        return;
    list->entries = ARENA_ARRAY(&e->loader->scratch, struct copy_entry *, written.count);
    list->first = ARENA_ARRAY(&e->loader->scratch, uint32_t, (size_t)written.count + 1);
    for (uint32_t i = 0; i < written.count; i++) {
        void *item = ir_walk_item(row, written, i);
        list->first[i] = list->count;
        if (is_written(&rows, item)) {
            list->entries[i] = new_entry(e, row, item);
            make_entry(e, list, list->entries[i], i);
        } else {
            push_made(e, list, (struct ir_copy){i, 0});
        }
    }
    list->first[written.count] = list->count;
    if (!list->made)
        list->made = ARENA_ARRAY(e->loader->input->arena, struct ir_copy, 1);
    fill(e, row, list, written);
}

// What is said of them afterwards: in messages, once for all copies.
static void list_entries(struct evaluation *e, struct ir_copies *copies) {
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[i];
        const struct copied_list *list = &e->copying->lists[i];
        const uint32_t count = list->entries ? ir_walk_list(row, &e->copying->written).count : 0;
        for (uint32_t k = 0; k < count; k++) {
            const struct copy_entry *entry = list->entries[k];
            if (!entry)
                continue;
            const struct ir_head *head = ir_walk_head(entry->memory);
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
    push_places(e, (const uint32_t[]){0}, 0); // none
    e->formula_count = e->scene->formulas->count;
    e->formulas = ARENA_ARRAY(scratch, struct copy_formula, e->formula_count);
    // Later stages move what is in place, and the lists without copies are the scene's own.
    const struct ir_scene *written =
        e->loader->input->keeps_written ? ir_copy(e->scene, e->loader->input->arena) : NULL;
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++)
        if (copies_may(&SCHEMA_SCENE.rows[i]))
            make_list(e, &SCHEMA_SCENE.rows[i]);
    copies_leave(e);
    struct ir_copies *copies = ARENA_NEW(e->loader->input->arena, struct ir_copies);
    list_entries(e, copies);
    copies->lists = ARENA_ARRAY(e->loader->input->arena, struct ir_copy *, SCHEMA_SCENE.row_count);
    copies->places = e->copying->places;
    copies->written = written;
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++)
        copies->lists[i] = e->copying->lists[i].made;
    e->loader->output->origin.copies = copies;
}
