// Parameters: each is computed after those that are in its expression.
#include "diag/codes/binding.h"
#include "parser/stages/evaluate.h"

#include "core/heap.h"
#include "parser/bind/bind.h"

#include <string.h>

enum {
    RING_NAMES_MOST = 8 // that a message lists
};

static struct diag_sink *sink(const struct evaluation *e) {
    return e->loader->input->sink;
}

static const struct ir_origin *origin(const struct evaluation *e) {
    return &e->loader->output->origin;
}

static span place_of(const struct evaluation *e, const struct parameter *p, const char *row) {
    return ir_place_value(origin(e), &p->ir->head, &SCHEMA_PARAMETER, row);
}

// ---- types

static bool find(const void *context, str name, struct expression_name *found) {
    struct evaluation *e = (struct evaluation *)context;
    for (uint32_t i = e->variable_count; i-- > 0;)
        if (str_equal(e->names[e->count + i], name)) {
            const struct copy_variable *v = &e->variables[i];
            if (v->is_used)
                *v->is_used = true;
            *found = (struct expression_name){v->type, e->count + i, v->moves};
            return !v->is_bad;
        }
    const uint32_t number = str_map_find(&e->by_name, name);
    if (!number || e->items[number - 1].state != PARAMETER_DONE)
        return false;
    struct parameter *p = &e->items[number - 1];
    p->is_used = true;
    *found = (struct expression_name){p->value.type, number - 1, p->moves};
    return true;
}

static bool read_value(struct evaluation *e, struct parameter *p) {
    const str what = arena_format(&e->loader->scratch, "parameter '%.*s'", STR_ARG(p->ir->name));
    const bool good = computed_read(e, p->ir->value, what, place_of(e, p, "value"), &p->value);
    p->moves |= p->value.moves;
    return good;
}

// After all that its expression names.
static void compile(struct evaluation *e, uint32_t index) {
    struct parameter *p = &e->items[index];
    const bool good = !p->ir->head.poisoned &&
                      evaluation_name_fits(e, p->ir->name, place_of(e, p, "name"), "parameter") &&
                      read_value(e, p) && parameter_bounds_fit(e, p);
    p->state = good ? PARAMETER_DONE : PARAMETER_BAD;
    if (good)
        e->order[e->ordered++] = index;
}

// A parameter whose names are being read, and how far.
struct visit {
    uint32_t index;
    size_t at;
};

// The last of the stack names `first`, which is further down.
static void report_ring(struct evaluation *e, const struct visit *stack, uint32_t depth, uint32_t first) {
    struct strbuf chain;
    strbuf_init(&chain);
    uint32_t begin = depth - 1;
    while (stack[begin].index != first)
        begin--;
    for (uint32_t i = begin; i < depth && i < begin + RING_NAMES_MOST; i++)
        strbuf_format(&chain, "%s%.*s", chain.len ? ", " : "", STR_ARG(e->names[stack[i].index]));
    if (depth - begin > RING_NAMES_MOST)
        strbuf_format(&chain, " and %u more", depth - begin - RING_NAMES_MOST);
    const bool alone = depth - begin == 1;
    diag_add(sink(e), DIAG_PARAMETER_RING, place_of(e, &e->items[first], "value"),
             "parameter '%.*s' depends on itself%s%.*s", STR_ARG(e->names[first]),
             alone ? "" : ", by way of: ", alone ? 0 : (int)chain.len, alone ? "" : strbuf_view(&chain).ptr);
    diag_help(sink(e), "give one of them a value of its own");
    e->items[first].is_ring = true;
    strbuf_finish(&chain);
}

// Those that an expression names first. A chain of them may be long: no recursion.
static void compile_all(struct evaluation *e) {
    struct visit *stack = ARENA_ARRAY(&e->loader->scratch, struct visit, e->count + 1);
    for (uint32_t i = 0; i < e->count; i++) {
        uint32_t depth = 0;
        if (e->items[i].state == PARAMETER_NEW)
            stack[depth++] = (struct visit){i, 0};
        while (depth > 0) {
            struct visit *top = &stack[depth - 1];
            e->items[top->index].state = PARAMETER_OPEN;
            str name;
            if (!expression_next_name(e->items[top->index].ir->value, &top->at, &name)) {
                compile(e, top->index);
                depth--;
                continue;
            }
            const uint32_t number = str_map_find(&e->by_name, name);
            struct parameter *p = number ? &e->items[number - 1] : NULL;
            if (p && p->state == PARAMETER_OPEN && !p->is_ring)
                report_ring(e, stack, depth, number - 1);
            else if (p && p->state == PARAMETER_NEW)
                stack[depth++] = (struct visit){number - 1, 0};
        }
    }
}

// "parameters.height", "parameters[height]": the parameter that a track names. 0: none, else 1 + its index.
static uint32_t target_of(const struct evaluation *e, str target) {
    const str list = STR("parameters");
    if (!str_starts_with(target, list) || target.len <= list.len || !strchr(".[", target.ptr[list.len]))
        return 0;
    const str rest = str_slice(target, list.len + 1, target.len);
    return str_map_find(&e->by_name, str_slice(rest, 0, expression_name_length(rest)));
}

static void mark_moved(struct evaluation *e) {
    const struct ir_tracks *tracks = &e->scene->animation.tracks;
    for (uint32_t i = 0; i < tracks->count; i++) {
        const uint32_t number = target_of(e, tracks->items[i].target);
        if (number)
            e->items[number - 1].moves = true;
    }
}

struct evaluation *evaluation_begin(struct loader *loader, struct ir_scene *scene) {
    struct arena *scratch = &loader->scratch;
    const struct ir_parameters *parameters = &scene->parameters;
    const bool has_formulas = scene->formulas && scene->formulas->count > 1;
    if (parameters->count == 0 && !has_formulas && !copies_are_written(scene))
        return NULL;
    struct evaluation *e = ARENA_NEW(scratch, struct evaluation);
    *e = (struct evaluation){
        .loader = loader,
        .scene = scene,
        .items = ARENA_ARRAY(scratch, struct parameter, parameters->count),
        .names = ARENA_ARRAY(scratch, str, (size_t)parameters->count + REACH_MOST),
        .count = parameters->count,
        .order = ARENA_ARRAY(scratch, uint32_t, parameters->count),
        .values = ARENA_ARRAY(scratch, double,
                              heap_times(EXPRESSION_WIDTH, (size_t)parameters->count + REACH_MOST)),
        .variables = ARENA_ARRAY(scratch, struct copy_variable, REACH_MOST),
        .suffix = ""};
    e->scope = (struct expression_scope){find, e};
    e->at = (struct expression_at){.decodes = scene->image.transfer == IR_TRANSFER_SRGB, .values = e->values};
    str_map_init(&e->by_name, scratch);
    for (uint32_t i = 0; i < e->count; i++) {
        e->items[i] = (struct parameter){.ir = &parameters->items[i]};
        e->names[i] = parameters->items[i].name;
        uint32_t *number = str_map_at(&e->by_name, e->names[i]);
        *number = *number ? *number : i + 1;
    }
    mark_moved(e);
    compile_all(e);
    // Used by parameters that nothing uses is not used.
    for (uint32_t i = 0; i < e->count; i++)
        e->items[i].is_used = false;
    return e;
}

// ---- values

static bool evaluate(struct evaluation *e, struct parameter *p, double *value) {
    return computed_value(e, &p->value, place_of(e, p, "value"), value) &&
           parameter_is_in_bounds(e, p, *value, place_of(e, p, "value"));
}

bool evaluation_set_frame(struct evaluation *e, double frame, double time) {
    bool good = true;
    e->at.frame = frame;
    e->at.time = time;
    copies_leave_all(e); // objects' parameters may have other values
    if (e->move)
        e->move(e->motion, e);
    for (uint32_t i = 0; i < e->ordered; i++) {
        const uint32_t index = e->order[i];
        struct parameter *p = &e->items[index];
        double *value = e->values + (size_t)EXPRESSION_WIDTH * index;
        if (p->is_moved)
            good = parameter_is_in_bounds(e, p, *value, place_of(e, p, "value")) && good;
        else if (!evaluate(e, p, value))
            good = false, p->state = e->is_quiet ? p->state : PARAMETER_BAD;
    }
    return good;
}

static struct ir_result result_of(const struct evaluation *e, uint32_t i) {
    const struct parameter *p = &e->items[i];
    struct ir_result result = {
        .is_known = p->state == PARAMETER_DONE, .moves = p->moves, .type = p->value.type};
    memcpy(result.value, e->values + (size_t)EXPRESSION_WIDTH * i, sizeof result.value);
    return result;
}

void evaluation_stop(struct evaluation *e) {
    struct ir_origin *places = &e->loader->output->origin;
    for (uint32_t i = 0; i < e->moving.count; i++) {
        const struct moving_formula *m = &e->moving.items[i];
        if (!m->entry) // else it is a copy, which has no formulas in the end
            ir_formula_drop(places->arena, places->formulas, bind_head(m->frame), m->formula->row,
                            m->formula->slot, m->formula->component);
    }
    for (uint32_t i = 0; i < e->count; i++) {
        const struct ir_result result = result_of(e, i);
        if (result.moves && result.is_known)
            e->scene->parameters.items[i].value = ir_result_text(&result, e->loader->input->arena);
    }
}

void evaluation_keep(const struct evaluation *e) {
    struct ir_formulas *formulas = e->scene->formulas;
    formulas->results = ARENA_ARRAY(e->loader->input->arena, struct ir_result, e->count);
    for (uint32_t i = 0; i < e->count; i++)
        formulas->results[i] = result_of(e, i);
}

// From the last to the first: what a used one is computed from is used.
static void mark_used(struct evaluation *e) {
    for (uint32_t i = e->ordered; i > 0; i--) {
        const struct parameter *p = &e->items[e->order[i - 1]];
        for (uint32_t k = 0; p->is_used && k < p->value.part_count; k++)
            evaluation_mark_named(e, p->value.texts[k]); // the scene's own text may be that of a frame by now
    }
}

void evaluation_tell_unused(struct evaluation *e) {
    if (sink(e)->errors) // what uses it may be where the mistake is
        return;
    copies_tell_unused(e);
    mark_used(e);
    for (uint32_t i = 0; i < e->count; i++) {
        const struct parameter *p = &e->items[i];
        const bool is_second = str_map_find(&e->by_name, p->ir->name) != i + 1; // names.c reports it
        if (p->is_used || is_second || p->state == PARAMETER_BAD || p->ir->head.poisoned)
            continue;
        diag_add(sink(e), DIAG_PARAMETER_UNUSED, ir_place_label(origin(e), &p->ir->head),
                 "nothing uses the parameter '%.*s'", STR_ARG(p->ir->name));
        diag_help(sink(e), "use it in an expression, or remove it");
    }
}
