// Formulas of the scene: each is read once, and its value put in its place.
#include "parser/stages/evaluate.h"
#include "diag/codes/binding.h"
#include "diag/codes/limit.h"

#include "grammar/ir_walk.h"
#include "parser/bind/bind.h"
#include "parser/tree/reader_text.h"

#include <string.h>

static struct diag_sink *sink(const struct evaluation *e) {
    return e->loader->input->sink;
}

static void store(const struct ir_formula *f, const struct expression *expression, const double *value,
                  char *field) {
    const uint32_t width = schema_component_count(f->row->kind);
    double all[EXPRESSION_WIDTH];
    if (f->component != IR_FORMULA_WHOLE) {
        memcpy(field + (size_t)f->component * sizeof *value, value, sizeof *value);
        return;
    }
    if (f->row->kind == SCHEMA_BOOLEAN) {
        *(bool *)field = value[0] != 0;
    } else if (f->row->kind == SCHEMA_INTEGER) {
        const int32_t whole = (int32_t)value[0];
        memcpy(field, &whole, sizeof whole);
    } else if (width == 0) {
        memcpy(field, value, sizeof *value);
    } else if (f->row->kind == SCHEMA_COLOR && expression->type == EXPRESSION_TRIPLE && value[3] >= 0) {
        const struct ir_color color = {.is_hex = true, .hex = (uint32_t)value[3]};
        memcpy(field, &color, sizeof color);
    } else {
        for (uint32_t i = 0; i < width; i++)
            all[i] = expression->type == EXPRESSION_TRIPLE ? value[i] : value[0];
        if (f->row->kind == SCHEMA_COLOR)
            *(struct ir_color *)(void *)field = (struct ir_color){.r = all[0], .g = all[1], .b = all[2]};
        else
            memcpy(field, all, width * sizeof *all);
    }
}

static bool value_fits(struct evaluation *e, const struct bind_frame *frame, const struct ir_formula *f,
                       const struct expression *expression, const double *value) {
    struct bind_subject subject = formula_subject(frame, f);
    const bool is_triple = expression->type == EXPRESSION_TRIPLE;
    if (f->row->kind == SCHEMA_BOOLEAN)
        return true;
    for (uint32_t i = 0; i < (is_triple ? 3u : 1u); i++) {
        if (is_triple)
            subject.component = schema_components(f->row->kind)[i];
        if (!evaluate_fits(e, subject, f, value[i]))
            return false;
    }
    return true;
}

// The limit is on what is computed once: of a film, for each frame.
static bool may_run(struct evaluation *e, const struct ir_formula *f, const struct expression *expression) {
    const struct limits *limits = e->loader->input->limits;
    e->operations += expression->cost;
    if (e->operations <= limits->value[LIMIT_EVALUATIONS])
        return true;
    if (!e->is_over && !e->is_quiet) {
        e->is_over = true;
        reader_limit(sink(e), limits, LIMIT_EVALUATIONS, f->at,
                     "computing the values of this scene takes too long");
    }
    return false;
}

static bool run(struct evaluation *e, const struct bind_frame *frame, const struct ir_formula *f,
                const struct expression *expression) {
    struct expression_fault fault;
    double value[EXPRESSION_WIDTH];
    if (!may_run(e, f, expression))
        return false;
    if (!expression_at(expression, &e->at, value, &fault)) {
        evaluation_fault(e, DIAG_EXPRESSION, f->text, f->at, true, &fault);
        return false;
    }
    if (!value_fits(e, frame, f, expression, value))
        return false;
    store(f, expression, value,
          (char *)schema_field(f->row, frame->memory) + (f->slot > 0 ? (size_t)f->slot * f->row->size : 0));
    return true;
}

// Frames of the walk are on its stack.
static const struct bind_frame *keep_frame(struct arena *arena, const struct bind_frame *frame) {
    struct bind_frame *copy = ARENA_NEW(arena, struct bind_frame);
    *copy = *frame;
    copy->parent = frame->parent ? keep_frame(arena, frame->parent) : NULL;
    return copy;
}

static void keep_moving(struct evaluation *e, const struct bind_frame *frame, const struct ir_formula *f,
                        const struct expression *expression) {
    struct arena *arena = &e->loader->scratch;
    if (ARENA_IS_FULL(&e->moving))
        e->moving.items = arena_regrow(arena, e->moving.items, e->moving.count, &e->moving.capacity,
                                       sizeof *e->moving.items);
    e->scene->formulas->items[f - e->scene->formulas->items].moves = true;
    e->moving.items[e->moving.count++] =
        (struct moving_formula){f, *expression, keep_frame(arena, frame), e->entry, e->places, e->instance};
}

// Reads the formula, and puts its value in its place.
static bool take(struct evaluation *e, const struct bind_frame *frame, const struct ir_formula *f) {
    struct expression expression;
    if (!evaluate_read(e, frame, f, &expression))
        return false;
    if (e->only_types)
        return true;
    if (expression.moves)
        keep_moving(e, frame, f, &expression);
    return run(e, frame, f, &expression);
}

bool evaluate_moving(struct evaluation *e) {
    bool good = true;
    e->operations = 0;
    for (uint32_t i = 0; i < e->moving.count && good; i++) {
        const struct moving_formula *m = &e->moving.items[i];
        good = copies_enter_again(e, m->entry, m->places, m->instance) &&
               run(e, m->frame, m->formula, &m->expression);
    }
    copies_leave_all(e);
    return good;
}

// ---- all of them

static void walk_element(struct evaluation *e, struct bind_frame *frame);

static bool has_parts(const struct schema_element *schema) {
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (schema->rows[i].kind == SCHEMA_ELEMENT || schema->rows[i].kind == SCHEMA_LIST)
            return true;
    return false;
}

static str name_of(const struct schema_element *schema, const void *element) {
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (schema->rows[i].kind == SCHEMA_TEXT &&
            (schema->rows[i].key || schema->rows[i].text == SCHEMA_TEXT_NAME))
            return *(const str *)schema_field_const(&schema->rows[i], element);
    return STR("");
}

static void walk_list(struct evaluation *e, struct bind_frame *frame, const struct schema_row *row) {
    const struct ir_any_list list = ir_walk_list(row, frame->memory);
    const bool parts = has_parts(row->child);
    if (row->child == &SCHEMA_OBJECT) // has values only where an instance shows it
        return;
    for (uint32_t i = 0; i < list.count; i++) {
        void *item = ir_walk_item(row, list, i);
        if (!parts && ((const struct ir_head *)item)->formulas == 0)
            continue;
        if (!frame->parent && !copies_enter(e, row, i))
            continue;
        struct bind_frame child = {.parent = frame,
                                   .schema = row->child,
                                   .via = row,
                                   .memory = item,
                                   .name = name_of(row->child, item),
                                   .label = ir_place_label(&e->loader->output->origin, item)};
        walk_element(e, &child);
    }
    if (!frame->parent)
        copies_leave_all(e);
}

static void put_default(struct evaluation *e, const struct bind_frame *frame, const struct schema_row *row) {
    void *fresh = arena_alloc(&e->loader->scratch, frame->schema->size);
    schema_init(frame->schema, fresh);
    memcpy(schema_field(row, frame->memory), schema_field(row, fresh),
           (size_t)row->size * (row->many == SCHEMA_FIXED ? row->fixed_count : 1));
}

// `if`, which says which copies there are (copies.c).
static bool is_of_copies(const struct schema_row *row) {
    return row->kind == SCHEMA_BOOLEAN && strcmp(row->name, "if") == 0;
}

static void walk_element(struct evaluation *e, struct bind_frame *frame) {
    struct ir_head *head = bind_head(frame);
    const struct ir_formulas *formulas = e->scene->formulas;
    for (uint32_t i = head->formulas; i; i = formulas->items[i].next) {
        const struct ir_formula *f = &formulas->items[i];
        const uint32_t row = (uint32_t)(f->row - frame->schema->rows);
        if (is_of_copies(f->row) || (head->poisoned & bind_bit(row)))
            continue;
        if (!take(e, frame, f) && !e->only_types) {
            bind_poison(frame, row);
            put_default(e, frame, f->row);
        }
    }
    for (uint32_t i = 0; i < frame->schema->row_count; i++) {
        const struct schema_row *row = &frame->schema->rows[i];
        if (row->child == &SCHEMA_VARIABLE)
            continue;
        if (row->kind == SCHEMA_LIST) {
            walk_list(e, frame, row);
        } else if (row->kind == SCHEMA_ELEMENT) {
            struct bind_frame child = {.parent = frame,
                                       .schema = row->child,
                                       .via = row,
                                       .memory = schema_field(row, frame->memory),
                                       .label = frame->label};
            child.bare = ir_walk_short(e->scene, row->child, child.memory) >= 0;
            walk_element(e, &child);
        }
    }
}

void evaluate_types(struct evaluation *e, const struct schema_row *row, void *item) {
    const struct bind_frame root = {.schema = &SCHEMA_SCENE, .memory = e->scene};
    struct bind_frame frame = {.parent = &root,
                               .schema = row->child,
                               .via = row,
                               .memory = item,
                               .name = name_of(row->child, item),
                               .label = ir_place_label(&e->loader->output->origin, item)};
    e->only_types = true;
    walk_element(e, &frame);
    e->only_types = false;
}

void evaluate_formulas(struct evaluation *e) {
    struct bind_frame root = {.schema = &SCHEMA_SCENE, .memory = e->scene};
    e->operations = 0;
    e->moving.count = 0;
    if (e->scene->formulas && e->scene->formulas->count > 1)
        walk_element(e, &root);
}
