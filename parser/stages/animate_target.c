// The targets of tracks: which numbers of the scene they move.
#include "diag/codes/binding.h"
#include "parser/stages/animate.h"

#include "grammar/ir_walk.h"
#include "parser/bind/say.h"

#include <string.h>

static struct diag_sink *sink(const struct motion *motion) {
    return motion->loader->input->sink;
}

static struct arena *scratch(const struct motion *motion) {
    return &motion->loader->scratch;
}

static bool cannot_move(const struct motion *motion, const struct moving *m, const char *why) {
    diag_add(sink(motion), DIAG_TRACK_TARGET, m->path->path, "%.*s %s",
             STR_ARG(say_subject(scratch(motion), m->subject)), why);
    return false;
}

static bool is_in_use(const struct bind_frame *frame, const struct schema_row *row) {
    unsigned tag;
    if (row->choice == 0)
        return true;
    memcpy(&tag, (const char *)frame->memory + frame->schema->choices[row->choice - 1].tag_offset,
           sizeof tag);
    return tag == row->alternative;
}

// An alternative that the scene does not use would replace the one that it uses.
static bool not_in_use(const struct motion *motion, const struct moving *m) {
    const char *other = NULL;
    for (uint32_t i = 0; i < m->frame->schema->row_count; i++) {
        const struct schema_row *row = &m->frame->schema->rows[i];
        if (row->choice == m->row->choice && row != m->row && is_in_use(m->frame, row))
            other = schema_yaml_key(row);
    }
    cannot_move(motion, m, "is not what the scene uses");
    if (other)
        diag_help(sink(motion), "it uses '%s': move that, or write '%s' in its place", other, m->row->name);
    return false;
}

// A colour that is an element, such as diffuse_color, stands for its short row.
static void enter_short(const struct motion *motion, struct moving *m) {
    const int bare = m->row->kind == SCHEMA_ELEMENT ? schema_short_row(m->row->child) : -1;
    if (bare < 0)
        return;
    struct bind_frame *child = ARENA_NEW(scratch(motion), struct bind_frame);
    *child = (struct bind_frame){.parent = m->frame,
                                 .schema = m->row->child,
                                 .via = m->row,
                                 .memory = schema_field(m->row, m->frame->memory),
                                 .label = m->path->path,
                                 .bare = true};
    m->frame = child;
    m->row_number = (uint32_t)bare;
    m->row = &child->schema->rows[bare];
    m->subject = bind_subject(child, m->row);
}

static bool take_whole(const struct motion *motion, struct moving *m, char *field) {
    const char *const *names = schema_components(m->row->kind);
    if (m->row->kind != SCHEMA_NUMBER && !names[0])
        return cannot_move(motion, m,
                           m->row->kind == SCHEMA_LIST || m->row->kind == SCHEMA_ELEMENT
                               ? "holds several values: move one of them"
                               : "is not a number that can move; --sweep renders with other values");
    m->width = names[0] ? 0 : 1;
    while (names[0] && names[m->width])
        m->width++;
    m->color = m->row->kind == SCHEMA_COLOR ? (struct ir_color *)(void *)field : NULL;
    m->fills = m->row->fill || m->color;
    m->field = (double *)(void *)field;
    return true;
}

// A component of a value that is computed as a whole is not there, and what moves by itself is moved once.
static bool is_free(const struct motion *motion, const struct moving *m,
                    const struct override_target *target) {
    const struct ir_formulas *formulas = motion->scene->formulas;
    const bool whole = target->kind == OVERRIDE_ROW || target->component == OVERRIDE_WHOLE_SLOT;
    for (uint32_t i = formulas ? bind_head(m->frame)->formulas : 0; i; i = formulas->items[i].next) {
        const struct ir_formula *f = &formulas->items[i];
        struct expression expression;
        struct expression_fault fault;
        if (f->row != m->row || (target->slot >= 0 && f->slot != target->slot))
            continue;
        if (!whole && f->component == IR_FORMULA_WHOLE)
            return cannot_move(motion, m, "is computed as a whole: move all of it");
        if ((!whole && f->component != (int)target->component) ||
            !expression_compile(f->text, &motion->evaluation->scope, scratch(motion), &expression, &fault) ||
            !expression.moves)
            continue;
        diag_add(sink(motion), DIAG_TRACK_TWICE, m->path->path, "%.*s moves by itself already",
                 STR_ARG(say_subject(scratch(motion), m->subject)));
        diag_note(sink(motion), f->at, "its value depends on the frame");
        return false;
    }
    return true;
}

// A parameter's value in frames is among those that expressions see.
static bool take_parameter(const struct motion *motion, struct moving *m, uint32_t index) {
    struct parameter *p = &motion->evaluation->items[index];
    m->row_number = (uint32_t)schema_short_row(&SCHEMA_PARAMETER);
    m->row = &SCHEMA_PARAMETER.rows[m->row_number];
    m->subject = bind_subject(m->frame, NULL);
    if (p->state != PARAMETER_DONE)
        return false; // reported
    if (p->value.type == EXPRESSION_TRUTH)
        return cannot_move(motion, m, "is true or false, which cannot move");
    m->parameter = index + 1;
    m->width = p->value.type == EXPRESSION_TRIPLE ? 3 : 1;
    m->field = motion->evaluation->values + (size_t)EXPRESSION_WIDTH * index;
    p->is_used = true;
    p->is_moved = true;
    return true;
}

bool moving_take_target(const struct motion *motion, struct moving *m, const struct override_target *target) {
    const struct schema_row *list = &target->frame->schema->rows[target->row];
    const struct schema_element *in = target->frame->schema, *of = list->child;
    const bool is_entry = target->kind == OVERRIDE_ENTRY;
    if (in == &SCHEMA_WITH || (is_entry && of == &SCHEMA_WITH) || (in == &SCHEMA_PARAMETER) ||
        (is_entry && of == &SCHEMA_PARAMETER && in == &SCHEMA_OBJECT)) {
        diag_add(sink(motion), DIAG_TRACK_TARGET, m->path->path,
                 in == &SCHEMA_WITH || of == &SCHEMA_WITH
                     ? "a value of 'with' cannot be moved by a track"
                     : "a parameter of an object cannot be moved by a track");
        diag_help(sink(motion), "write an expression of frame or time in its place");
        return false;
    }
    if (target->kind == OVERRIDE_ENTRY && list->child == &SCHEMA_PARAMETER) {
        struct bind_frame *frame = ARENA_NEW(scratch(motion), struct bind_frame);
        *frame = (struct bind_frame){.parent = target->frame,
                                     .schema = &SCHEMA_PARAMETER,
                                     .via = list,
                                     .memory = &motion->scene->parameters.items[target->entry],
                                     .name = motion->scene->parameters.items[target->entry].name,
                                     .label = m->path->path};
        m->frame = frame;
        return take_parameter(motion, m, target->entry);
    }
    m->frame = target->frame;
    m->row_number = target->row;
    m->row = &m->frame->schema->rows[target->row];
    m->subject = bind_subject(m->frame, m->row);
    if (m->row->child == &SCHEMA_VARIABLE || m->frame->schema == &SCHEMA_VARIABLE)
        return cannot_move(motion, m, "says which copies there are, and they are the same in all frames");
    if (target->kind == OVERRIDE_ENTRY)
        return cannot_move(motion, m, "holds several values: move one of them");
    for (const struct bind_frame *f = m->frame; f; f = f->parent)
        if (f->schema == &SCHEMA_ANIMATION || m->row->child == &SCHEMA_ANIMATION)
            return cannot_move(motion, m, "is of the animation, which cannot move itself");
    enter_short(motion, m);
    if (!is_in_use(m->frame, m->row))
        return not_in_use(motion, m);
    if (bind_head(m->frame)->poisoned & bind_bit(m->row_number))
        return false; // reported
    m->slot = target->slot;
    m->component = target->kind == OVERRIDE_ROW || target->component == OVERRIDE_WHOLE_SLOT
                       ? IR_FORMULA_WHOLE
                       : (int)target->component;
    if (!is_free(motion, m, target))
        return false;
    char *field = schema_field(m->row, m->frame->memory);
    if (target->slot > 0)
        field += (size_t)target->slot * m->row->size;
    m->subject.index = target->slot;
    if (target->kind == OVERRIDE_ROW || target->component == OVERRIDE_WHOLE_SLOT)
        return take_whole(motion, m, field);
    if (m->row->kind == SCHEMA_COLOR && ((struct ir_color *)(void *)field)->is_hex)
        return cannot_move(motion, m, "is written as #rrggbb, which has no components; move all of it");
    m->subject.component = schema_components(m->row->kind)[target->component];
    m->field = (double *)(void *)field + target->component;
    m->width = 1;
    return true;
}
