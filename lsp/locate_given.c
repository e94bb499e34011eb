// What texts come to that the evaluated scene does not keep: variables and parameters of objects, in a copy
// of an entry. They are computed anew, each from what its names come to there.
#include "lsp/locate_given.h"

#include "core/srgb.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_formula.h"
#include "grammar/ir_values.h"
#include "grammar/ir_walk.h"
#include "parser/tree/mend.h"

#include <string.h>

enum {
    NAMES_MOST = 1000, // that are looked up for one value
    VALUES_MOST = 32,  // names in one text
    NESTED_MOST = 64,  // values that are computed from each other
};

// What is in reach of a copy: of an entry, or of an object's parameter.
struct reach {
    const struct located_scope *scope;
    const uint32_t *places; // of the entry's variables, after their number; NULL: they have no values
    uint32_t instance;      // 1 + the evaluated scene's instance in whose object it is; 0: in none
};

struct computing {
    struct located_copies *copies;
    struct arena *arena;
    uint32_t names, depth;
};

// A text that is being compiled; its names get their values at once.
struct reading {
    struct computing *computing;
    const struct reach *reach;
    double values[VALUES_MOST * EXPRESSION_WIDTH];
    uint32_t count;
};

static const struct schema_row *instances(void) {
    return ir_walk_pool(&SCHEMA_INSTANCE);
}

static const struct ir_instance *instance_of(const struct computing *c, uint32_t instance) {
    const struct ir_instances *all = &c->copies->session->scene->instances;
    return instance && instance <= all->count ? &all->items[instance - 1] : NULL;
}

// What the instance that is evaluated sees.
static bool reach_of_instance(const struct computing *c, uint32_t instance, struct reach *reach) {
    const struct ir_instance *made = instance_of(c, instance);
    const struct ir_copies *copies = c->copies->session->origin.copies;
    if (!made || made->head.origin >= c->copies->count)
        return false;
    *reach = (struct reach){c->copies->instances[made->head.origin],
                            ir_copies_at(copies, instances(), instance - 1),
                            ir_copies_instance(copies, instances(), instance - 1)};
    return reach->scope != NULL;
}

static bool compute(struct computing *c, const struct reach *reach, str text, struct ir_result *result);

static bool compute_variable(struct computing *c, const struct reach *reach, uint32_t number,
                             struct ir_result *result) {
    const struct ir_variable *variable = &locate_variables(reach->scope).items[number];
    str rest = variable->values, text = STR(""), inside;
    if (!reach->places || reach->places[0] <= number)
        return false;
    const uint32_t place = reach->places[1 + number];
    if (variable->kind != IR_VARIABLE_VALUES) {
        *result = (struct ir_result){.is_known = true, .type = EXPRESSION_NUMBER, .value = {place}};
        return true;
    }
    for (uint32_t i = 0; i <= place; i++)
        if (!ir_values_next(&rest, &text))
            return false;
    struct located_scope before = *reach->scope;
    before.reach = number;
    const struct reach inner = {&before, reach->places, reach->instance};
    return compute(c, &inner, ir_values_open(text, &inside) ? inside : text, result);
}

// What the instance gives it, or its own value.
static bool compute_argument(struct computing *c, const struct reach *reach,
                             const struct ir_parameter *parameter, struct ir_result *result) {
    struct reach outside;
    if (!reach_of_instance(c, reach->instance, &outside))
        return false;
    const struct ir_instance *instance = outside.scope->entry;
    for (uint32_t i = 0; i < instance->with.count; i++)
        if (str_equal(instance->with.items[i].name, parameter->name))
            return compute(c, &outside, instance->with.items[i].value, result);
    struct located_scope own = *reach->scope;
    own.list = NULL;
    const struct reach inner = {&own, NULL, reach->instance};
    return compute(c, &inner, parameter->value, result);
}

static bool compute_name(struct computing *c, struct reach reach, str name, struct ir_result *result) {
    const struct ir_scene *scene = locate_scene(c->copies->session);
    while (reach.scope) {
        const struct ir_variables variables = locate_variables(reach.scope);
        const struct ir_object *object = reach.scope->object;
        for (uint32_t i = 0; i < variables.count && i < reach.scope->reach; i++)
            if (str_equal(variables.items[i].name, name))
                return compute_variable(c, &reach, i, result);
        for (uint32_t i = 0; object && i < object->parameters.count; i++)
            if (str_equal(object->parameters.items[i].name, name))
                return compute_argument(c, &reach, &object->parameters.items[i], result);
        if (!reach.scope->around || !reach_of_instance(c, reach.instance, &reach))
            break;
    }
    const struct ir_result *results = scene->formulas ? scene->formulas->results : NULL;
    for (uint32_t i = 0; results && i < scene->parameters.count; i++)
        if (str_equal(scene->parameters.items[i].name, name)) {
            *result = results[i];
            return results[i].is_known;
        }
    return false;
}

static bool find_name(const void *context, str name, struct expression_name *found) {
    struct reading *reading = (struct reading *)context;
    struct computing *c = reading->computing;
    struct ir_result result;
    if (reading->count == VALUES_MOST || c->names >= NAMES_MOST || c->depth >= NESTED_MOST)
        return false;
    c->names++;
    c->depth++;
    const bool is_known = compute_name(c, *reading->reach, name, &result);
    c->depth--;
    if (!is_known)
        return false;
    memcpy(reading->values + (size_t)EXPRESSION_WIDTH * reading->count, result.value, sizeof result.value);
    *found = (struct expression_name){.type = result.type, .slot = reading->count++};
    return true;
}

static bool compute_part(struct computing *c, const struct reach *reach, str text, struct ir_result *result) {
    struct reading *reading = ARENA_NEW(c->arena, struct reading);
    const struct expression_scope scope = {find_name, reading};
    const struct ir_scene *written = locate_scene(c->copies->session);
    struct expression expression;
    struct expression_fault fault;
    reading->computing = c;
    reading->reach = reach;
    const struct ir_animation *animation = &written->animation;
    const struct expression_at at = {.frame = animation->frame,
                                     .time = animation->frame / animation->rate,
                                     .decodes = written->image.transfer == IR_TRANSFER_SRGB,
                                     .values = reading->values};
    *result = (struct ir_result){0};
    if (!expression_compile(text, &scope, c->arena, &expression, &fault) ||
        !expression_at(&expression, &at, result->value, &fault))
        return false;
    result->type = expression.type;
    result->is_known = true;
    return true;
}

// #rrggbb
static bool read_color(const struct computing *c, str text, struct ir_result *result) {
    const bool decodes = locate_scene(c->copies->session)->image.transfer == IR_TRANSFER_SRGB;
    uint32_t hex;
    if (!mend_hex_color(text, &hex))
        return false;
    *result = (struct ir_result){.is_known = true, .type = EXPRESSION_TRIPLE, .value = {0, 0, 0, hex}};
    srgb_of_hex(hex, decodes, result->value);
    return true;
}

static bool compute(struct computing *c, const struct reach *reach, str text, struct ir_result *result) {
    const uint32_t count = ir_values_count(text);
    struct ir_result part;
    str one;
    if (text.len && text.ptr[0] == '#')
        return read_color(c, text, result);
    if (count == 1)
        return compute_part(c, reach, text, result);
    *result = (struct ir_result){.is_known = true, .type = EXPRESSION_TRIPLE, .value = {0, 0, 0, -1}};
    for (uint32_t i = 0; count == 3 && i < count; i++) {
        if (!ir_values_next(&text, &one) || !compute_part(c, reach, one, &part) ||
            part.type != EXPRESSION_NUMBER)
            return false;
        result->value[i] = part.value[0];
    }
    return count == 3;
}

// ---- from outside

static void note_instance(void *context, const struct schema_element *schema, const void *element,
                          const struct located_scope *scope) {
    struct located_copies *copies = context;
    const uint32_t origin = ir_walk_head(element)->origin;
    if (schema != &SCHEMA_INSTANCE || origin >= copies->count)
        return;
    struct located_scope *kept = ARENA_NEW(copies->arena, struct located_scope);
    *kept = *scope;
    copies->instances[origin] = kept;
}

struct located_copies locate_copies_begin(const struct session *session, struct arena *arena) {
    struct located_copies copies = {
        .session = session, .arena = arena, .count = session->origin.elements.count};
    copies.instances = ARENA_ARRAY(arena, const struct located_scope *, copies.count);
    locate_walk_scoped(session, arena, note_instance, &copies);
    return copies;
}

const struct located_scope *locate_made(const struct located_copies *copies, uint32_t instance) {
    const struct computing c = {.copies = (struct located_copies *)copies};
    struct reach reach;
    return copies->session->origin.copies && reach_of_instance(&c, instance + 1, &reach) ? reach.scope : NULL;
}

bool locate_given(struct located_copies *copies, struct arena *arena, uint32_t instance, str text,
                  struct ir_result *result) {
    struct computing c = {.copies = copies, .arena = arena};
    struct reach reach;
    return reach_of_instance(&c, instance + 1, &reach) && compute(&c, &reach, text, result);
}

bool locate_argument(struct located_copies *copies, struct arena *arena, uint32_t instance,
                     const struct located_scope *scope, const struct ir_parameter *parameter,
                     struct ir_result *result) {
    struct computing c = {.copies = copies, .arena = arena};
    const struct reach reach = {scope, NULL, instance + 1};
    return compute_argument(&c, &reach, parameter, result);
}
