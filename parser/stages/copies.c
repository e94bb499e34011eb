// Copies: what `for` and `if` make of entries, of the scene's lists and of objects.
#include "diag/codes/binding.h"
#include "diag/codes/limit.h"
#include "parser/stages/objects.h"

#include "parser/bind/visit.h"
#include "parser/tree/reader_text.h"

#include <string.h>

static struct diag_sink *sink(const struct evaluation *e) {
    return e->loader->input->sink;
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

bool copies_is_copied(const struct schema_row *row, const void *entry) {
    const struct copy_rows rows = rows_of(row->child);
    return is_written(&rows, entry);
}

void copies_clear_rows(const struct schema_element *schema, void *item) {
    const struct copy_rows rows = rows_of(schema);
    memset(schema_field(rows.variables, item), 0, rows.variables->size);
    *(bool *)schema_field(rows.condition, item) = true;
    ((struct ir_head *)item)->written &= ~rows.bits;
}

bool copies_are_written(const struct ir_scene *scene) {
    if (scene->objects.count || scene->instances.count)
        return true;
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
    reader_limit_needs(sink(e), e->loader->input->limits, LIMIT_COPIES, for_place(e, entry), text.ptr,
                       product > 0 ? product + (double)e->copying->steps : 0);
    return false;
}

static void push_place(struct evaluation *e, uint32_t place) {
    struct copying *c = e->copying;
    if (c->place_count == c->place_capacity)
        c->places = arena_regrow(e->loader->input->arena, c->places, c->place_count, &c->place_capacity,
                                 sizeof *c->places);
    c->places[c->place_count++] = place;
}

uint32_t copies_push_places(struct evaluation *e, const uint32_t *places, uint32_t count) {
    const uint32_t at = e->copying->place_count;
    push_place(e, count);
    for (uint32_t i = 0; i < count; i++)
        push_place(e, places[i]);
    return at;
}

void copies_push(struct evaluation *e, struct copied_list *list, struct ir_copy copy) {
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
        evaluation_fault(e, DIAG_EXPRESSION, entry->condition->text, entry->condition->at, true, &fault);
        return false;
    }
    *kept = value[0] != 0;
    return true;
}

struct turning {
    struct copy_entry *entry;
    struct copied_list *list;
    uint32_t index;    // of the entry
    uint32_t instance; // as in ir_copy
    bool counts_only;  // and makes nothing
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
        if ((variable || t->instance) && !count_place(e, t->entry))
            return false;
        if (t->counts_only)
            return true;
        if (!is_kept(e, t->entry, &kept))
            return false;
        if (kept)
            copies_push(e, t->list,
                        (struct ir_copy){t->index, variable ? copies_push_places(e, t->places, variable) : 0,
                                         t->instance});
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

static uint32_t used_in(struct evaluation *e, struct copy_entry *entry, const struct schema_element *schema,
                        const void *memory);

static void use(void *context, struct visit_place place, struct ir_reference *reference) {
    struct evaluation *e = context;
    const struct schema_row *row = &place.schema->rows[place.row];
    struct copy_entry *entry = (struct copy_entry *)e->entry;
    if (ir_walk_is_inline(e->scene, row, reference))
        entry->used |= used_in(e, entry, row->child, ir_walk_referent(e->scene, row, reference));
}

// With what is in place in it, objects and all that is in these.
static uint32_t used_in(struct evaluation *e, struct copy_entry *entry, const struct schema_element *schema,
                        const void *memory) {
    visit_references(schema, (void *)memory, use, e);
    return copies_used(e, entry, schema, memory);
}

static void find_used(struct evaluation *e, struct copy_entry *entry) {
    e->entry = entry;
    entry->used |= used_in(e, entry, entry->row->child, entry->memory);
}

// What is in place in an entry that makes nothing.
static void replace(void *context, struct visit_place place, struct ir_reference *reference) {
    struct evaluation *e = context;
    const struct schema_row *row = &place.schema->rows[place.row];
    if (!ir_walk_is_inline(e->scene, row, reference) || row->child == &SCHEMA_OBJECT)
        return;
    const struct schema_row *pool = ir_walk_pool(row->child);
    void *item = (void *)ir_walk_referent(e->scene, row, reference);
    copies_list_pool(e, pool);
    copies_list(e, pool)->is_replaced[reference->index] = true;
    if (e->entry && e->entry->is_good)
        evaluate_types(e, pool, item);
}

void copies_read_types(struct evaluation *e, struct copy_entry *entry) {
    copies_leave_all(e);
    if (entry->is_good) {
        copies_enter_types(e, entry);
        find_used(e, entry);
        evaluate_types(e, entry->row, entry->memory);
    }
    visit_references(entry->row->child, entry->memory, replace, e);
}

void copies_make_entry(struct evaluation *e, struct copied_list *list, struct copy_entry *entry,
                       uint32_t index, uint32_t instance) {
    struct turning turning = {.entry = entry, .list = list, .index = index, .instance = instance};
    const uint32_t before = list->count;
    if (entry->is_good && !entry->is_made)
        find_used(e, entry);
    if (entry->is_good && !e->copying->is_over && copies_fit(e, entry) && !turn(e, &turning, 0))
        list->count = before;
    entry->is_made = true;
    entry->count += list->count - before;
}

struct copy_entry *copies_new_entry(struct evaluation *e, const struct schema_row *row, void *memory) {
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
