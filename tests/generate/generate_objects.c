// Bodies and lights that instances show: some entries of the scene's lists move into objects.
#include "core/number.h"
#include "grammar/ir.h"
#include "grammar/ir_formula.h"
#include "grammar/ir_walk.h"
#include "tests/generate/generate_values.h"

#include <string.h>

bool generate_is_of_objects(const struct schema_row *row) {
    return row->child == &SCHEMA_OBJECT || row->child == &SCHEMA_INSTANCE;
}

static void mark(void *element, const struct schema_element *schema, const char *row) {
    ((struct ir_head *)element)->written |= UINT64_C(1) << schema_find_row(schema, str_from(row));
}

// Those that cameras are focused on keep the names that they have.
static bool is_named(const struct schema_element *schema, const void *item) {
    const int row = schema_find_row(schema, STR("name"));
    return ((const str *)schema_field_const(&schema->rows[row], item))->len > 0;
}

// A share of a length that an instance may choose.
static void compute(struct generator *g, const struct schema_element *schema, void *item) {
    const int number = schema_find_row(schema, STR("radius"));
    if (number < 0 || !generate_chance(g, 60) || !ir_walk_written(schema, (uint32_t)number, item))
        return;
    char digits[NUMBER_FORMAT_MAX];
    number_format(*(const double *)schema_field_const(&schema->rows[number], item), digits);
    ir_formula_add(g->arena, g->scene->formulas, item,
                   (struct ir_formula){.row = &schema->rows[number],
                                       .slot = -1,
                                       .component = IR_FORMULA_WHOLE,
                                       .text = arena_format(g->arena, "%s*part", digits),
                                       .at = SPAN_NONE});
}

// It is handed one down by the instance.
static void forget_material(struct generator *g, const struct schema_element *schema, void *item) {
    const int row = schema_find_row(schema, STR("material"));
    if (row < 0 || !generate_chance(g, 40))
        return;
    *(struct ir_reference *)schema_field(&schema->rows[row], item) =
        (struct ir_reference){.index = IR_NO_INDEX};
    ((struct ir_head *)item)->written &= ~(UINT64_C(1) << row);
}

// Moves the last entry of some lists of the scene.
static void take_entries(struct generator *g, struct ir_object *object, bool has_parameter) {
    for (uint32_t i = 0; i < SCHEMA_OBJECT.row_count; i++) {
        const struct schema_row *row = &SCHEMA_OBJECT.rows[i];
        const struct schema_row *pool = row->kind == SCHEMA_LIST ? ir_walk_pool(row->child) : NULL;
        if (!pool || row->child == &SCHEMA_PARAMETER || generate_is_of_objects(row))
            continue;
        struct ir_any_list list = ir_walk_list(pool, g->scene);
        while (list.count && generate_chance(g, 45)) {
            void *item = ir_walk_item(pool, list, list.count - 1);
            if (row->child == &SCHEMA_SPHERE && is_named(row->child, item))
                break;
            if (has_parameter)
                compute(g, row->child, item);
            forget_material(g, row->child, item);
            ir_walk_append(g->arena, row, object, item);
            list.count--;
            memcpy(schema_field(pool, g->scene), &list, sizeof list);
            object->head.written |= UINT64_C(1) << i;
        }
        if (list.count == 0)
            g->scene->head.written &= ~(UINT64_C(1) << (pool - SCHEMA_SCENE.rows));
    }
}

static void place(struct generator *g, struct ir_instance *instance) {
    static const double scales[] = {0.5, 1, 2, -1, 0.7};
    if (generate_chance(g, 20)) {
        const double turned[3][4] = {{0, 0, 1, 0.5}, {0, 1, 0, 0.25}, {-1, 0, 0, -0.5}};
        for (int i = 0; i < 3; i++) {
            struct ir_matrix_row row = {.numbers = {turned[i][0], turned[i][1], turned[i][2], turned[i][3]}};
            mark(&row, &SCHEMA_MATRIX_ROW, "numbers");
            ir_walk_append(g->arena, &SCHEMA_MATRIX.rows[0], &instance->matrix, &row);
        }
        mark(&instance->matrix, &SCHEMA_MATRIX, "row");
        mark(instance, &SCHEMA_INSTANCE, "matrix");
        return;
    }
    if (generate_chance(g, 60)) {
        const double scale = scales[generate_below(g, sizeof scales / sizeof *scales)];
        instance->scale = (vec3){scale, scale, scale};
        mark(instance, &SCHEMA_INSTANCE, "scale");
    }
    if (generate_chance(g, 60)) {
        instance->rotation = generate_chance(g, 50) ? (vec3){0, 90, 0} : (vec3){10, -25, 3};
        mark(instance, &SCHEMA_INSTANCE, "rotation");
    }
    if (generate_chance(g, 80)) {
        instance->translation = (vec3){generate_below(g, 5) * 0.5 - 1, 0.25, generate_below(g, 3) * 0.5};
        mark(instance, &SCHEMA_INSTANCE, "translation");
    }
}

static void take_material(struct generator *g, struct ir_instance *instance) {
    for (uint32_t i = 0; i < g->scene->materials.count && generate_chance(g, 60); i++) {
        const struct ir_material *material = &g->scene->materials.items[i];
        if (!material->name.len)
            continue;
        instance->material = (struct ir_reference){.name = material->name, .index = i};
        mark(instance, &SCHEMA_INSTANCE, "material");
        return;
    }
}

static void give(struct generator *g, struct ir_instance *instance) {
    static const char *const values[] = {"0.5", "1/4", "cos(60)"};
    struct ir_with with = {.name = STR("part"), .value = str_from(values[generate_below(g, 3)])};
    mark(&with, &SCHEMA_WITH, "name"), mark(&with, &SCHEMA_WITH, "value");
    ir_walk_append(g->arena, ir_walk_list_of(&SCHEMA_INSTANCE, &SCHEMA_WITH), instance, &with);
    mark(instance, &SCHEMA_INSTANCE, "with");
}

static struct ir_instance new_instance(struct generator *g, str name, uint32_t object, bool has_parameter) {
    struct ir_instance instance = {.head = {0}};
    schema_init(&SCHEMA_INSTANCE, &instance);
    instance.object = (struct ir_reference){.name = name, .index = object};
    mark(&instance, &SCHEMA_INSTANCE, "object");
    place(g, &instance);
    if (generate_chance(g, 40))
        take_material(g, &instance);
    if (name.len && has_parameter && generate_chance(g, 60))
        give(g, &instance);
    return instance;
}

static uint32_t add_object(struct generator *g, struct ir_object *object) {
    return ir_walk_append(g->arena, ir_walk_pool(&SCHEMA_OBJECT), g->scene, object);
}

// An instance of an object in place that holds it.
static void wrap(struct generator *g, struct ir_instance *instance) {
    struct ir_object group = {.head = {0}};
    schema_init(&SCHEMA_OBJECT, &group);
    ir_walk_append(g->arena, ir_walk_list_of(&SCHEMA_OBJECT, &SCHEMA_INSTANCE), &group, instance);
    mark(&group, &SCHEMA_OBJECT, "instance");
    *instance = new_instance(g, STR(""), add_object(g, &group), false);
}

void generate_objects(struct generator *g, struct ir_scene *scene) {
    if (g->options->plain || !generate_chance(g, 40))
        return;
    const uint32_t count = 1 + generate_below(g, 2);
    for (uint32_t i = 0; i < count; i++) {
        struct ir_object object = {.head = {0}};
        schema_init(&SCHEMA_OBJECT, &object);
        const bool has_name = generate_chance(g, 70), has_parameter = generate_chance(g, 60);
        if (has_parameter) {
            struct ir_parameter parameter = {.name = STR("part"), .value = STR("0.75")};
            mark(&parameter, &SCHEMA_PARAMETER, "name"), mark(&parameter, &SCHEMA_PARAMETER, "value");
            ir_walk_append(g->arena, ir_walk_list_of(&SCHEMA_OBJECT, &SCHEMA_PARAMETER), &object, &parameter);
            mark(&object, &SCHEMA_OBJECT, "parameter");
        }
        take_entries(g, &object, has_parameter);
        if (has_name) {
            object.name = arena_format(g->arena, "thing-%u", i);
            mark(&object, &SCHEMA_OBJECT, "name");
            mark(scene, &SCHEMA_SCENE, "object");
        }
        const uint32_t number = add_object(g, &object);
        const uint32_t uses = has_name ? 1 + generate_below(g, 2) : 1;
        for (uint32_t k = 0; k < uses; k++) {
            struct ir_instance instance = new_instance(g, object.name, number, has_parameter);
            if (generate_chance(g, 30))
                wrap(g, &instance);
            if (generate_chance(g, 30)) {
                instance.name = arena_format(g->arena, "use-%u-%u", i, k);
                mark(&instance, &SCHEMA_INSTANCE, "name");
            }
            ir_walk_append(g->arena, ir_walk_pool(&SCHEMA_INSTANCE), scene, &instance);
            mark(scene, &SCHEMA_SCENE, "instance");
        }
    }
}
