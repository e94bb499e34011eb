#include "grammar/ir_features.h"

#include "grammar/ir.h"
#include "grammar/ir_print_text.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

struct feature_walk {
    const struct ir_scene *scene;
    const struct ir_origin *origin;    // may be NULL
    struct ir_feature_reason *reasons; // by bit number; NULL: only the mask is wanted
    uint64_t mask;
    const struct schema_element *standard; // whose defaults were walked
};

// What switches a feature on.
struct feature_use {
    const struct schema_element *schema;
    const void *element;
    uint32_t row;
    const char *component; // for weights; else NULL
    double weight;
};

static int bit_number(uint64_t bit) {
    int n = 0;
    while (bit >> n > 1)
        n++;
    return n;
}

static span place_of(const struct feature_walk *w, const struct feature_use *use) {
    const struct schema_row *row = &use->schema->rows[use->row];
    struct ir_any_list list = ir_walk_list(row, use->element);
    if (!w->origin)
        return SPAN_NONE;
    if (list.count)
        return ir_place_label(w->origin, ir_walk_head(ir_walk_item(row, list, 0)));
    const struct ir_row_origin *found = ir_origin_row(w->origin, ir_walk_head(use->element), use->row);
    return found ? found->value : ir_place_label(w->origin, ir_walk_head(use->element));
}

// The name that the file gave the element: its key, or its row of the name text kind.
static str name_of(const struct schema_element *schema, const void *element) {
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (schema->rows[i].kind == SCHEMA_TEXT && schema->rows[i].text == SCHEMA_TEXT_NAME)
            return *(const str *)schema_field_const(&schema->rows[i], element);
    return (str){"", 0};
}

static bool is_by_preset(const struct feature_use *use) {
    return use->schema == &SCHEMA_MATERIAL && ((const struct ir_material *)use->element)->preset;
}

static void explain_use(struct feature_walk *w, const struct feature_use *use,
                        struct ir_feature_reason *reason) {
    const struct schema_row *row = &use->schema->rows[use->row];
    const void *field = schema_field_const(row, use->element);
    struct strbuf words;
    strbuf_init(&words);
    str name = name_of(use->schema, use->element);
    uint32_t count = ir_walk_list(row, use->element).count;
    if (count) {
        strbuf_format(&words, "%u %s", count, count == 1 ? row->name : schema_yaml_key(row));
    } else {
        strbuf_cstr(&words, use->schema->name);
        if (name.len)
            strbuf_format(&words, " '%.*s'", STR_ARG(name));
        strbuf_format(&words, ": %s", row->name);
    }
    if (use->component) {
        strbuf_format(&words, ": %s is ", use->component);
        print_number(&words, use->weight);
    } else if (row->kind == SCHEMA_WORD || row->kind == SCHEMA_BOOLEAN || row->kind == SCHEMA_TEXT) {
        strbuf_cstr(&words, " is ");
        print_plain_value(&words, row, field);
    }
    if (!count && !ir_walk_written(use->schema, use->row, use->element))
        strbuf_cstr(&words, is_by_preset(use) ? " by its preset" : " by default");
    snprintf(reason->words, sizeof reason->words, "%s", words.data ? words.data : "");
    strbuf_finish(&words);
    reason->at = place_of(w, use);
}

static void switch_on(struct feature_walk *w, uint64_t bit, const struct feature_use *use) {
    if (!bit || w->mask & bit)
        return;
    w->mask |= bit;
    if (!w->reasons)
        return;
    struct ir_feature_reason *reason = &w->reasons[bit_number(bit)];
    reason->bit = bit;
    explain_use(w, use, reason);
}

// A grey other than its default: white or black.
static bool is_coloured(const struct schema_row *row, const struct ir_color *color) {
    const bool black = row->standard && row->standard[0] == '0';
    const double grey = black ? 0 : 1;
    if (color->is_hex)
        return color->hex != (black ? 0 : 0xffffff);
    return color->r != grey || color->g != grey || color->b != grey;
}

static bool is_on(const struct schema_row *row, const void *element) {
    const void *field = schema_field_const(row, element);
    if (row->choice)
        return true; // this row is the one taken
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        return *(const bool *)field;
    case SCHEMA_INTEGER:
        return *(const int32_t *)field != 0;
    case SCHEMA_NUMBER:
        return *(const double *)field != 0;
    case SCHEMA_VECTOR:
        return !vec3_is_zero(*(const vec3 *)field);
    case SCHEMA_WORD:
        return (*(const unsigned *)field == 0) == row->feature_of_first;
    case SCHEMA_TEXT:
        return ((const str *)field)->len > 0;
    case SCHEMA_LIST:
        return ir_walk_list(row, element).count > 0;
    case SCHEMA_COLOR:
        return is_coloured(row, field);
    default:
        return true;
    }
}

// Lists that other elements refer to: their items count where they are used.
static bool is_pool(const struct schema_row *row) {
    for (const struct schema_element *const *e = schema_elements; *e; e++)
        for (uint32_t i = 0; i < (*e)->row_count; i++)
            if ((*e)->rows[i].kind == SCHEMA_REFERENCE && (*e)->rows[i].child == row->child)
                return true;
    return false;
}

static void walk_element(struct feature_walk *w, const struct schema_element *schema, const void *element);

static void walk_reference(struct feature_walk *w, const struct schema_row *row, const void *field) {
    const void *referent = ir_walk_referent(w->scene, row, field);
    struct ir_material standard = {0};
    if (!referent) {
        if (w->standard == row->child) // its defaults have already switched on their features
            return;
        w->standard = row->child;
        assert(row->child->size <= sizeof standard);
        schema_init(row->child, &standard);
        referent = &standard;
    }
    walk_element(w, row->child, referent);
}

static void walk_weights(struct feature_walk *w, const struct schema_element *schema, uint32_t i,
                         const void *element) {
    const struct schema_row *row = &schema->rows[i];
    const char *const *names = schema_components(row->kind);
    double n[4];
    uint32_t count = ir_walk_components(row, schema_field_const(row, element), n);
    for (uint32_t k = 0; k < count; k++)
        if (n[k] != 0)
            switch_on(w, row->weight_features[k], &(struct feature_use){schema, element, i, names[k], n[k]});
}

static void walk_element(struct feature_walk *w, const struct schema_element *schema, const void *element) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (!ir_walk_taken(schema, row, element))
            continue;
        const void *field = schema_field_const(row, element);
        // Of an element that has a place of its own in its parent, whether it is written.
        const bool is_there =
            row->kind != SCHEMA_ELEMENT || row->choice || ir_walk_written(schema, i, element);
        if (row->feature && is_there && is_on(row, element))
            switch_on(w, row->feature, &(struct feature_use){.schema = schema, .element = element, .row = i});
        if (row->kind == SCHEMA_WEIGHTS)
            walk_weights(w, schema, i, element);
        else if (row->kind == SCHEMA_ELEMENT)
            walk_element(w, row->child, field);
        else if (row->kind == SCHEMA_REFERENCE)
            walk_reference(w, row, field);
        if (row->kind != SCHEMA_LIST || is_pool(row))
            continue;
        struct ir_any_list list = ir_walk_list(row, element);
        for (uint32_t k = 0; k < list.count; k++)
            walk_element(w, row->child, ir_walk_item(row, list, k));
    }
}

static void walk_scene(struct feature_walk *w) {
    walk_element(w, &SCHEMA_SCENE, w->scene);
    if (w->mask & (FEATURE_POINT_LIGHT | FEATURE_DIRECTION_LIGHT))
        return;
    w->mask |= FEATURE_POINT_LIGHT;
    if (w->reasons) {
        struct ir_feature_reason *reason = &w->reasons[bit_number(FEATURE_POINT_LIGHT)];
        *reason = (struct ir_feature_reason){.bit = FEATURE_POINT_LIGHT, .at = SPAN_NONE};
        snprintf(reason->words, sizeof reason->words, "%s",
                 w->scene->lights.count > 0 ? "each light is a panel, which shines from its points"
                                            : "no light is written, so one is placed at the camera");
    }
}

uint64_t ir_features(const struct ir_scene *scene) {
    struct feature_walk w = {.scene = scene};
    walk_scene(&w);
    return w.mask;
}

void ir_features_explain(const struct ir_scene *scene, const struct ir_origin *origin,
                         struct ir_feature_reasons *out) {
    struct ir_feature_reason reasons[FEATURE_COUNT];
    memset(reasons, 0, sizeof reasons);
    struct feature_walk w = {.scene = scene, .origin = origin, .reasons = reasons};
    walk_scene(&w);
    out->mask = w.mask;
    out->count = 0;
    for (int i = 0; i < FEATURE_COUNT; i++)
        if (reasons[i].bit)
            out->items[out->count++] = reasons[i];
}

uint64_t ir_material_features(const struct ir_material *material) {
    struct feature_walk w = {0};
    struct ir_material standard = {0};
    schema_init(&SCHEMA_MATERIAL, &standard);
    walk_element(&w, &SCHEMA_MATERIAL, material ? material : &standard);
    return w.mask;
}

const char *feature_name(uint64_t bit) {
#define FEATURE_ROW(bit, name) {FEATURE_##bit, #name},
    static const struct {
        uint64_t bit;
        const char *name;
    } rows[] = {FEATURE_TABLE(FEATURE_ROW)};
#undef FEATURE_ROW
    static_assert(sizeof rows / sizeof rows[0] == FEATURE_COUNT, "every feature has a row");
    for (size_t i = 0; i < FEATURE_COUNT; i++)
        if (rows[i].bit == bit)
            return rows[i].name;
    return "unknown";
}
