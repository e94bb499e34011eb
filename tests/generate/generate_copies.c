// Entries that are written once and make several bodies or lights: `for` and `if`, and values that depend on
// their variables.
#include "core/number.h"
#include "grammar/ir.h"
#include "grammar/ir_formula.h"
#include "grammar/ir_walk.h"
#include "tests/generate/generate_values.h"

#include <string.h>

enum {
    VARIABLES_MOST = 3,
    COPIES_MOST = 6 // of an entry: more of what refracts, in one place, no ray can go through
};

struct entry {
    str names[VARIABLES_MOST];
    bool is_triple[VARIABLES_MOST];
    uint32_t count;
    uint32_t copies;
    uint32_t component; // in which copies are next to each other
    uint32_t object;    // 1 + the object that it is in, whose variables have names of their own; 0: none
};

bool generate_is_of_copies(const struct schema_row *row) {
    return row->child == &SCHEMA_VARIABLE || (row->kind == SCHEMA_BOOLEAN && strcmp(row->name, "if") == 0);
}

static void add(struct generator *g, void *element, const struct schema_row *row, int component, str text) {
    ir_formula_add(
        g->arena, g->scene->formulas, element,
        (struct ir_formula){.row = row, .slot = -1, .component = component, .text = text, .at = SPAN_NONE});
}

static void mark(void *element, const struct schema_element *schema, const char *row) {
    ((struct ir_head *)element)->written |= UINT64_C(1) << schema_find_row(schema, str_from(row));
}

// One of the variables, as a number.
static str number_of(struct generator *g, const struct entry *entry) {
    static const char *const parts[] = {".x", ".y", ".z"};
    const uint32_t i = generate_below(g, entry->count);
    return arena_format(g->arena, "%.*s%s", STR_ARG(entry->names[i]),
                        entry->is_triple[i] ? parts[generate_below(g, 3)] : "");
}

// A text with a number in it: "%s/2".
static str with_number(struct generator *g, const struct entry *entry, const char *before,
                       const char *after) {
    const str number = number_of(g, entry);
    return arena_format(g->arena, "%s%.*s%s", before, STR_ARG(number), after);
}

static void add_variable(struct generator *g, struct entry *entry, const struct schema_row *list,
                         void *element) {
    static const char *const names[] = {"i", "row", "größe", "石", "k_2", "n"};
    static const char *const values[] = {
        "0", "-1, 0.5", "1/4, 2*1, cos(60)", "[0, 1, 0], [0.5, -1, 1/2]", "[1, 2, 3]", "#ff8800, #0088ff"};
    static const uint32_t sizes[] = {1, 2, 3, 2, 1, 2}; // of these lists
    const char *base = names[2 * entry->count + generate_below(g, 2)];
    const str name = entry->object ? arena_format(g->arena, "%s_%u", base, entry->object) : str_from(base);
    struct ir_variable variable = {.name = name};
    mark(&variable, &SCHEMA_VARIABLE, "name");
    if (generate_chance(g, 40)) {
        const uint32_t wanted = generate_below(g, sizeof values / sizeof *values);
        const uint32_t which = entry->copies * sizes[wanted] <= COPIES_MOST ? wanted : 0;
        entry->copies *= sizes[which];
        variable.kind = IR_VARIABLE_VALUES;
        variable.values = str_from(values[which]);
        entry->is_triple[entry->count] = which > 2;
        mark(&variable, &SCHEMA_VARIABLE, "values");
    } else {
        const uint32_t wanted = generate_below(g, 4),
                       count = entry->copies * wanted <= COPIES_MOST ? wanted : 1;
        variable.count = (int32_t)count;
        mark(&variable, &SCHEMA_VARIABLE, "count");
        if (entry->count && entry->copies < 3 && generate_chance(g, 50)) {
            const int row = schema_find_row(&SCHEMA_VARIABLE, STR("count"));
            variable.count = 0;
            add(g, &variable, &SCHEMA_VARIABLE.rows[row], IR_FORMULA_WHOLE,
                with_number(g, entry, "floor(abs(", ")) + 1"));
        }
    }
    entry->copies *= variable.count > 1 ? (uint32_t)variable.count : 1;
    entry->names[entry->count++] = name;
    ir_walk_append(g->arena, list, element, &variable);
}

static void add_condition(struct generator *g, const struct entry *entry, const struct schema_element *schema,
                          void *element) {
    const struct schema_row *row = &schema->rows[schema_find_row(schema, STR("if"))];
    mark(element, schema, "if");
    if (entry->count == 0 || generate_chance(g, 20))
        *(bool *)schema_field(row, element) = generate_chance(g, 70);
    else if (generate_chance(g, 50))
        add(g, element, row, IR_FORMULA_WHOLE, with_number(g, entry, "", " != 1"));
    else
        add(g, element, row, IR_FORMULA_WHOLE, with_number(g, entry, "not ", " < 0"));
}

// ---- values that differ from copy to copy

static str digits_of(struct generator *g, double value) {
    char digits[NUMBER_FORMAT_MAX];
    number_format(value, digits);
    return arena_format(g->arena, "%s", digits);
}

static void move(struct generator *g, const struct entry *entry, const struct schema_row *row,
                 void *element) {
    double n[4];
    ir_walk_components(row, schema_field(row, element), n);
    const double value = n[entry->component];
    const str number = number_of(g, entry), digits = digits_of(g, value);
    if (value > -1e6 && value < 1e6)
        add(g, element, row, (int)entry->component,
            arena_format(g->arena, "%.*s + 0.75*%.*s", STR_ARG(digits), STR_ARG(number)));
}

static void shrink(struct generator *g, const struct entry *entry, const struct schema_row *row,
                   void *element) {
    double n[4];
    const uint32_t count = ir_walk_components(row, schema_field(row, element), n);
    const uint32_t which = count ? generate_below(g, count) : 0;
    const double value = count ? n[which] : *(const double *)schema_field(row, element);
    const str number = number_of(g, entry), digits = digits_of(g, value);
    if (value > 1e-6 || (count && value == 0))
        add(g, element, row, count ? (int)which : IR_FORMULA_WHOLE,
            arena_format(g->arena, "%.*s/(1 + abs(%.*s))", STR_ARG(digits), STR_ARG(number)));
}

static void vary(struct generator *g, const struct entry *entry, const struct schema_element *schema,
                 void *element) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        void *field = schema_field(row, element);
        if (!ir_walk_written(schema, i, element) || row->many == SCHEMA_FIXED || generate_is_of_copies(row))
            continue;
        if (row->kind == SCHEMA_ELEMENT)
            vary(g, entry, row->child, field);
        else if (row->kind == SCHEMA_REFERENCE && ir_walk_is_inline(g->scene, row, field) &&
                 row->child == &SCHEMA_MATERIAL)
            vary(g, entry, row->child, (void *)ir_walk_referent(g->scene, row, field));
        else if (row->kind == SCHEMA_VECTOR && row->range == SCHEMA_RANGE_COORDINATE &&
                 strncmp(row->name, "edge", 4) != 0 && strcmp(row->name, "direction") != 0)
            move(g, entry, row, element);
        else if ((row->kind == SCHEMA_COLOR && !((const struct ir_color *)field)->is_hex) ||
                 (row->kind == SCHEMA_NUMBER && row->range == SCHEMA_RANGE_LENGTH))
            shrink(g, entry, row, element);
    }
}

static void copy_entry(struct generator *g, const struct schema_element *schema, void *element,
                       uint32_t object) {
    const struct schema_row *list = &schema->rows[schema_find_row(schema, STR("for"))];
    struct entry entry = {.copies = 1, .component = generate_below(g, 3), .object = object};
    const uint32_t count = generate_chance(g, 85) ? 1 + generate_below(g, VARIABLES_MOST) : 0;
    while (entry.count < count)
        add_variable(g, &entry, list, element);
    if (count)
        mark(element, schema, "for");
    if (count == 0 || generate_chance(g, 40))
        add_condition(g, &entry, schema, element);
    if (count)
        vary(g, &entry, schema, element);
}

static bool is_focused_on(const struct ir_scene *scene, const struct schema_element *schema,
                          const void *element) {
    const int row = schema_find_row(schema, STR("name"));
    const str name = *(const str *)schema_field_const(&schema->rows[row], element);
    for (uint32_t i = 0; name.len && i < scene->cameras.count; i++)
        if (str_equal(scene->cameras.items[i].focus_on, name))
            return true;
    return false;
}

static void copy_entries(struct generator *g, const struct schema_element *schema, void *holder,
                         uint32_t object) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const struct ir_any_list list = ir_walk_list(row, holder);
        if (row->kind != SCHEMA_LIST || schema_find_row(row->child, STR("for")) < 0)
            continue;
        for (uint32_t k = 0; k < list.count; k++)
            if (generate_chance(g, 35) && !is_focused_on(g->scene, row->child, ir_walk_item(row, list, k)))
                copy_entry(g, row->child, ir_walk_item(row, list, k), object);
    }
}

void generate_copies(struct generator *g, struct ir_scene *scene) {
    if (g->options->plain || !generate_chance(g, 40))
        return;
    copy_entries(g, &SCHEMA_SCENE, scene, 0);
    for (uint32_t i = 0; i < scene->objects.count; i++)
        copy_entries(g, &SCHEMA_OBJECT, &scene->objects.items[i], i + 1);
}
