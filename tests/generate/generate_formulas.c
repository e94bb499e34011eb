// Values that are computed: each comes out as the value that stood there.
#include "core/number.h"
#include "grammar/ir.h"
#include "grammar/ir_formula.h"
#include "grammar/ir_walk.h"
#include "tests/generate/generate_values.h"

#include <string.h>

// `one` is 1, whatever it is computed from.
static const char *const ONES[] = {"1", "cos(0)", "2 - 1", "1 if true else 2", "floor(1.5)", "max(1, -3)"};

static str number_text(struct generator *g, double value) {
    char digits[NUMBER_FORMAT_MAX];
    number_format(value, digits);
    switch (generate_below(g, 4)) {
    case 0:
        return arena_format(g->arena, "%s*one", digits);
    case 1:
        return arena_format(g->arena, "(%s)/one", digits);
    case 2:
        return arena_format(g->arena, "%s if one > 0 else 7", digits);
    default:
        return arena_format(g->arena, "mix(%s, 5, one - 1)", digits);
    }
}

static bool add(struct generator *g, void *element, const struct schema_row *row, int slot, int component,
                str text) {
    ir_formula_add(
        g->arena, g->scene->formulas, element,
        (struct ir_formula){.row = row, .slot = slot, .component = component, .text = text, .at = SPAN_NONE});
    return true;
}

static bool compute_value(struct generator *g, void *element, const struct schema_row *row, int slot) {
    const char *field = (char *)schema_field(row, element) + (slot > 0 ? (size_t)slot * row->size : 0);
    double n[4];
    const uint32_t count = ir_walk_components(row, field, n);
    if (row->kind == SCHEMA_BOOLEAN)
        return add(g, element, row, slot, IR_FORMULA_WHOLE,
                   *(const bool *)field ? STR("one == 1") : STR("not one == 1"));
    if (row->kind == SCHEMA_INTEGER)
        return add(g, element, row, slot, IR_FORMULA_WHOLE, number_text(g, *(const int32_t *)field));
    if (row->kind == SCHEMA_NUMBER)
        return add(g, element, row, slot, IR_FORMULA_WHOLE, number_text(g, *(const double *)field));
    if (count == 0 || (row->kind == SCHEMA_COLOR && ((const struct ir_color *)field)->is_hex))
        return false;
    const uint32_t which = generate_below(g, count);
    return add(g, element, row, slot, (int)which, number_text(g, n[which]));
}

static bool walk(struct generator *g, const struct schema_element *schema, void *element) {
    bool any = false;
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const struct ir_any_list list = ir_walk_list(row, element);
        if (!ir_walk_written(schema, i, element) || row->child == &SCHEMA_PARAMETER ||
            row->child == &SCHEMA_VARIABLE || row->plain)
            continue;
        for (uint32_t k = 0; k < list.count; k++)
            any = walk(g, row->child, ir_walk_item(row, list, k)) || any;
        if (row->kind == SCHEMA_ELEMENT)
            any = walk(g, row->child, schema_field(row, element)) || any;
        else if (((const struct ir_head *)element)->formulas == 0 && !generate_is_of_copies(row) &&
                 generate_chance(g, 12))
            any = compute_value(g, element, row,
                                row->many == SCHEMA_FIXED ? (int)generate_below(g, row->fixed_count) : -1) ||
                  any;
    }
    return any;
}

static bool may_write(struct generator *g, struct ir_parameter *parameter, const char *row) {
    const bool writes = generate_chance(g, 30);
    if (writes)
        parameter->head.written |= UINT64_C(1) << schema_find_row(&SCHEMA_PARAMETER, str_from(row));
    return writes;
}

static void add_bounds(struct generator *g, struct ir_parameter *parameter) {
    if (may_write(g, parameter, "min"))
        parameter->min = -(double)generate_below(g, 5);
    if (may_write(g, parameter, "max"))
        parameter->max = 2 + generate_below(g, 5);
    if (may_write(g, parameter, "description"))
        parameter->description = generate_text(g);
}

static void add_parameter(struct generator *g, struct ir_scene *scene, str name, str value) {
    const int row = schema_find_row(&SCHEMA_SCENE, STR("parameter"));
    struct ir_parameter parameter = {.name = name, .value = value};
    parameter.head.written = UINT64_C(3); // name, value
    if (!memchr(value.ptr, ',', value.len) || memchr(value.ptr, '(', value.len))
        add_bounds(g, &parameter);
    ir_walk_append(g->arena, &SCHEMA_SCENE.rows[row], scene, &parameter);
    scene->head.written |= UINT64_C(1) << row;
}

void generate_formulas(struct generator *g, struct ir_scene *scene) {
    if (g->options->plain || generate_chance(g, 50) || !walk(g, &SCHEMA_SCENE, scene))
        return;
    // `one` by way of others, in any order.
    if (generate_chance(g, 30)) {
        add_parameter(g, scene, STR("one"), STR("two - first"));
        add_parameter(g, scene, STR("first"), STR("corner.x"));
        add_parameter(g, scene, STR("two"), STR("2*first"));
        add_parameter(g, scene, STR("corner"), STR("1, 2, 0"));
    } else {
        add_parameter(g, scene, STR("one"), str_from(ONES[generate_below(g, sizeof ONES / sizeof *ONES)]));
    }
}
