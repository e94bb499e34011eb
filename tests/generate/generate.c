#include "tests/generate/generate.h"

#include "grammar/ir.h"
#include "grammar/ir_formula.h"
#include "grammar/ir_walk.h"
#include "tests/generate/generate_values.h"

#include <string.h>

static void make_element(struct generator *g, const struct schema_element *schema, void *element);

static const struct generate_paths *paths_of(const struct generator *g, const struct schema_row *row) {
    static const struct generate_paths none = {0};
    switch (row->file) {
    case SCHEMA_FILE_SCENE:
        return &g->options->includes;
    case SCHEMA_FILE_IMAGE:
        return &g->options->images;
    case SCHEMA_FILE_MESH:
        return &g->options->meshes;
    case SCHEMA_FILE_FONT:
        return &g->options->fonts;
    default:
        return &none;
    }
}

// Names that references to the row's child may use: those of all that stands in the scene's own list.
static uint32_t count_named(const struct generator *g, const struct schema_row *row) {
    const struct schema_row *pool = ir_walk_pool(row->child);
    const struct ir_any_list list = pool ? ir_walk_list(pool, g->scene) : (struct ir_any_list){0};
    uint32_t count = 0;
    for (uint32_t i = 0; i < list.count; i++)
        count += !ir_walk_is_anonymous(pool->child, ir_walk_item(pool, list, i));
    return count;
}

// Whether the row can have a value at all: a file, a name to refer to.
static bool is_possible(const struct generator *g, const struct schema_row *row) {
    if (row->aside || generate_is_of_copies(row) || generate_is_of_objects(row))
        return false; // generate_formulas, generate_copies, generate_objects
    if (row->kind == SCHEMA_TEXT && row->text == SCHEMA_TEXT_PATH)
        return paths_of(g, row)->count > 0;
    // Of meshes that can be rendered the materials are known; none has parts.
    if (row->kind == SCHEMA_TEXT && row->text == SCHEMA_TEXT_FOREIGN_NAME && g->options->renderable)
        return row->key && g->options->mesh_materials.count > 0;
    // A scene that takes a frame of its animation has none any more.
    if (row->range == SCHEMA_RANGE_FRAME && !row->required)
        return false;
    if (row->kind == SCHEMA_REFERENCE && !row->element)
        return count_named(g, row) > 0;
    if (row->kind == SCHEMA_LIST || row->kind == SCHEMA_ELEMENT)
        for (uint32_t i = 0; i < row->child->row_count; i++)
            if (row->child->rows[i].required && !is_possible(g, &row->child->rows[i]))
                return false;
    return true;
}

// ---- lists

static uint32_t list_count(struct generator *g) {
    if (g->options->renderable)
        return 1 + generate_below(g, 3);
    return generate_chance(g, 5) ? 12 : generate_below(g, 5);
}

// A key that no item of the list has yet; false where none was found.
static bool make_key(struct generator *g, const struct schema_row *row, struct ir_any_list list, void *item) {
    const struct schema_row *key = &row->child->rows[schema_key_row(row->child)];
    const struct generate_paths *known = &g->options->mesh_materials;
    bool foreign = key->text == SCHEMA_TEXT_FOREIGN_NAME;
    for (int attempt = 0; attempt < 20; attempt++) {
        str name = key->text == SCHEMA_TEXT_TARGET     ? generate_target(g)
                   : foreign && g->options->renderable ? known->items[generate_below(g, known->count)]
                   : foreign                           ? generate_foreign_name(g)
                                                       : generate_name(g);
        if (row->single && list.count == 0 && generate_chance(g, 60))
            name = str_from(row->single);
        bool taken = name.len == 0;
        for (uint32_t i = 0; i < list.count && !taken; i++)
            taken = str_equal(ir_walk_key(row->child, ir_walk_item(row, list, i)), name);
        if (taken)
            continue;
        *(str *)schema_field(key, item) = name;
        return true;
    }
    return false;
}

static void *new_element(struct generator *g, const struct schema_element *schema) {
    void *element = arena_alloc(g->arena, schema->size);
    schema_init(schema, element);
    make_element(g, schema, element);
    return element;
}

static bool make_list(struct generator *g, const struct schema_row *row, void *element) {
    uint32_t count = list_count(g);
    for (uint32_t i = 0; i < count; i++) {
        void *item = new_element(g, row->child);
        if (row->many == SCHEMA_NAMED_MAP && !make_key(g, row, ir_walk_list(row, element), item))
            break;
        ir_walk_append(g->arena, row, element, item);
    }
    return ir_walk_list(row, element).count > 0;
}

// ---- values

static bool make_reference(struct generator *g, const struct schema_row *row, struct ir_reference *out) {
    const struct schema_row *pool = ir_walk_pool(row->child);
    const struct generate_paths *paths = paths_of(g, row);
    uint32_t named = count_named(g, row);
    if (paths->count > 0 && generate_chance(g, 60)) {
        *out = (struct ir_reference){paths->items[generate_below(g, paths->count)], IR_NO_INDEX};
        return true;
    }
    if (row->element && (named == 0 || generate_chance(g, 30))) {
        *out = (struct ir_reference){
            .index = ir_walk_append(g->arena, pool, g->scene, new_element(g, row->child))};
        return true;
    }
    uint32_t wanted = generate_below(g, named);
    struct ir_any_list list = ir_walk_list(pool, g->scene);
    for (uint32_t i = 0; i < list.count; i++) {
        const void *item = ir_walk_item(pool, list, i);
        if (ir_walk_is_anonymous(pool->child, item) || wanted-- > 0)
            continue;
        *out = (struct ir_reference){.name = ir_walk_key(pool->child, item), .index = i};
        return true;
    }
    return false;
}

static str unique_name(struct generator *g) {
    for (;;) {
        str name = generate_name(g);
        bool taken = false;
        for (uint32_t i = 0; i < g->names.count; i++)
            taken = taken || str_equal(g->names.items[i], name);
        if (taken)
            continue;
        *ARENA_PUSH(g->arena, &g->names) = name;
        return name;
    }
}

static str make_text(struct generator *g, const struct schema_row *row) {
    const struct generate_paths *paths = paths_of(g, row);
    switch (row->text) {
    case SCHEMA_TEXT_NAME:
        return unique_name(g);
    case SCHEMA_TEXT_BODY_NAME:
        return STR("nothing"); // rules that mend the scene put a distance in its place
    case SCHEMA_TEXT_FOREIGN_NAME:
        return generate_foreign_name(g);
    case SCHEMA_TEXT_TARGET:
        return generate_target(g);
    case SCHEMA_TEXT_VALUES:
        return generate_moving(g);
    case SCHEMA_TEXT_PATH:
        return paths->items[generate_below(g, paths->count)];
    default:
        return generate_text(g);
    }
}

static vec3 make_vector(struct generator *g, const struct schema_row *row) {
    double x = generate_number(g, row->range);
    if (row->fill && generate_chance(g, 60))
        return (vec3){x, x, x};
    double y = generate_number(g, row->range);
    double z = generate_number(g, row->range);
    return (vec3){x, y, z};
}

static struct ir_weights make_weights(struct generator *g, const struct schema_row *row) {
    double n[4];
    for (int i = 0; i < 4; i++)
        n[i] = generate_chance(g, 40) ? 0 : generate_number(g, row->range);
    return (struct ir_weights){n[0], n[1], n[2], n[3]};
}

static unsigned make_word(struct generator *g, const struct schema_row *row) {
    uint32_t count = 0;
    while (row->words[count])
        count++;
    return generate_below(g, count);
}

// Gives the field a value; false: it stays unwritten.
static bool make_value(struct generator *g, const struct schema_row *row, void *element, void *field) {
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        *(bool *)field = generate_chance(g, 50);
        return true;
    case SCHEMA_INTEGER:
        *(int32_t *)field = generate_integer(g, row->range);
        return true;
    case SCHEMA_NUMBER:
        *(double *)field = generate_number(g, row->range);
        return true;
    case SCHEMA_WORD:
        *(unsigned *)field = make_word(g, row);
        return true;
    case SCHEMA_TEXT:
        *(str *)field = make_text(g, row);
        return true;
    case SCHEMA_VECTOR:
        *(vec3 *)field = make_vector(g, row);
        return true;
    case SCHEMA_PAIR: {
        const vec3 both = make_vector(g, row);
        *(struct ir_pair *)field = (struct ir_pair){both.x, both.y};
        return true;
    }
    case SCHEMA_POINT: {
        const vec3 both = make_vector(g, row);
        *(struct ir_point *)field = (struct ir_point){both.x, both.y};
        return true;
    }
    case SCHEMA_QUAD: {
        const vec3 some = make_vector(g, row);
        *(struct ir_quad *)field = (struct ir_quad){some.x, some.y, some.z, some.x};
        return true;
    }
    case SCHEMA_COLOR:
        *(struct ir_color *)field = generate_color(g, row->range);
        return true;
    case SCHEMA_WEIGHTS:
        *(struct ir_weights *)field = make_weights(g, row);
        return true;
    case SCHEMA_ELEMENT:
        make_element(g, row->child, field);
        return true;
    case SCHEMA_REFERENCE:
        return make_reference(g, row, field);
    case SCHEMA_LIST:
        return make_list(g, row, element);
    }
    return false;
}

// ---- elements

// The rows of each choice that are taken; UINT32_MAX: none.
static void choose(struct generator *g, const struct schema_element *schema, void *element,
                   uint32_t taken[3]) {
    for (uint8_t c = 0; c < 3; c++) {
        const struct schema_choice *choice = &schema->choices[c];
        uint32_t candidates[16];
        uint32_t count = 0;
        taken[c] = UINT32_MAX;
        for (uint32_t i = 0; i < schema->row_count && count < 16; i++)
            if (schema->rows[i].choice == c + 1 && is_possible(g, &schema->rows[i]))
                candidates[count++] = i;
        bool none = choice->rule == SCHEMA_CHOICE_AT_MOST_ONE && generate_chance(g, 25);
        if (choice->rule == SCHEMA_CHOICE_NONE || count == 0 || none)
            continue;
        taken[c] = candidates[generate_below(g, count)];
        *(unsigned *)((char *)element + choice->tag_offset) = schema->rows[taken[c]].alternative;
    }
}

static bool wants_row(struct generator *g, const struct schema_row *row) {
    if (row->required)
        return true;
    // A picture needs something in it; the rest is better left to the defaults now and then.
    bool worth = g->options->renderable && (row->kind == SCHEMA_LIST || row->kind == SCHEMA_REFERENCE);
    return generate_chance(g, worth ? 85 : 50);
}

static void make_element(struct generator *g, const struct schema_element *schema, void *element) {
    uint32_t taken[3];
    struct ir_head *head = element;
    choose(g, schema, element, taken);
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (row->key || !is_possible(g, row))
            continue;
        if (row->choice ? taken[row->choice - 1] != i : !wants_row(g, row))
            continue;
        bool made = true;
        for (uint32_t k = 0; k < (row->many == SCHEMA_FIXED ? row->fixed_count : 1); k++)
            made = make_value(g, row, element, (char *)schema_field(row, element) + (size_t)k * row->size) &&
                   made;
        if (made)
            head->written |= UINT64_C(1) << i;
    }
}

struct ir_scene *generate_scene(const struct generate_options *options, struct arena *arena) {
    struct generator g = {.state = options->seed, .options = options, .arena = arena};
    g.scene = ARENA_NEW(arena, struct ir_scene);
    schema_init(&SCHEMA_SCENE, g.scene);
    make_element(&g, &SCHEMA_SCENE, g.scene);
    generate_mend(&g, g.scene);
    g.scene->formulas = ir_formulas_new(arena);
    generate_objects(&g, g.scene);
    generate_copies(&g, g.scene);
    generate_formulas(&g, g.scene);
    return g.scene;
}
