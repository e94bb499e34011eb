#include "grammar/emit/example.h"

#include "grammar/ir.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"

#include <string.h>

enum {
    PATH_MAX_ROWS = 8
};

static void fill(const struct schema_element *schema, void *element, struct arena *arena);

static void *new_element(const struct schema_element *schema, struct arena *arena) {
    void *element = arena_alloc(arena, schema->size);
    schema_init(schema, element);
    return element;
}

static void mark(const struct schema_element *schema, uint32_t i, void *element) {
    const struct schema_row *row = &schema->rows[i];
    ((struct ir_head *)element)->written |= UINT64_C(1) << i;
    if (row->choice) {
        unsigned tag = row->alternative;
        memcpy((char *)element + schema->choices[row->choice - 1].tag_offset, &tag, sizeof tag);
    }
}

static const char *with_commas(struct arena *arena, str text) {
    str out = STR("");
    for (size_t i = 0; i < text.len; i++)
        out = arena_format(arena, "%.*s%s%c", STR_ARG(out), text.ptr[i] == ' ' ? "," : "", text.ptr[i]);
    return out.ptr;
}

// A list of items that have only their short row; that may be a list of its own, with blanks between its
// items.
static void example_items(const struct schema_row *row, void *element, struct arena *arena) {
    const struct schema_row *inner = &row->child->rows[schema_short_row(row->child)];
    str rest = str_from(row->example);
    while (rest.len) {
        const char *end = memchr(rest.ptr, ',', rest.len);
        const str one = str_slice(rest, 0, end ? (size_t)(end - rest.ptr) : rest.len);
        const struct schema_row nested = {.child = inner->child,
                                          .kind = inner->kind,
                                          .offset = inner->offset,
                                          .example = with_commas(arena, one)};
        void *item = new_element(row->child, arena);
        if (inner->kind == SCHEMA_LIST)
            example_items(&nested, item, arena);
        else
            schema_set_field(inner, schema_field(inner, item), arena_copy(arena, one).ptr);
        mark(row->child, (uint32_t)schema_short_row(row->child), item);
        ir_walk_append(arena, row, element, item);
        rest = end ? str_slice(rest, one.len + 2, rest.len) : STR("");
    }
}

void example_row(const struct schema_row *row, uint32_t i, void *element, struct arena *arena) {
    const char *text = row->example    ? row->example
                       : row->standard ? row->standard
                       : row->words    ? row->words[0]
                                       : NULL;
    char *field = schema_field(row, element);
    if (row->kind == SCHEMA_LIST && row->example) {
        example_items(row, element, arena);
    } else if (row->kind == SCHEMA_LIST) {
        void *item = new_element(row->child, arena);
        fill(row->child, item, arena);
        ir_walk_append(arena, row, element, item);
    } else if (row->kind == SCHEMA_ELEMENT) {
        int only = schema_short_row(row->child);
        if (only >= 0) {
            example_row(&row->child->rows[only], (uint32_t)only, field, arena);
            mark(row->child, (uint32_t)only, field);
        } else {
            fill(row->child, field, arena);
        }
    } else if (text) {
        schema_set_field(row, field, text);
        for (uint32_t k = 1; row->many == SCHEMA_FIXED && k < row->fixed_count; k++)
            schema_set_field(row, field + (size_t)k * row->size,
                             row->example_next ? row->example_next : text);
    }
    ((struct ir_head *)element)->written |= UINT64_C(1) << i;
}

// Whether an earlier row of the same choice is the one to show.
static bool is_alternative(const struct schema_element *schema, uint32_t i) {
    for (uint32_t k = 0; k < i; k++)
        if (schema->rows[i].choice && schema->rows[k].choice == schema->rows[i].choice)
            return true;
    return false;
}

static void fill(const struct schema_element *schema, void *element, struct arena *arena) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        bool shown =
            !row->example_alone && (row->example || row->kind == SCHEMA_LIST || row->kind == SCHEMA_ELEMENT);
        // Of all that an object may hold, boxes.
        if (schema == &SCHEMA_OBJECT && row->kind == SCHEMA_LIST)
            shown = row->child == &SCHEMA_BOX;
        if (!shown || is_alternative(schema, i))
            continue;
        example_row(row, i, element, arena);
        mark(schema, i, element);
    }
}

// The rows that lead from the scene to the element; returns their number, -1 if there is no way.
static int find_path(const struct schema_element *from, const struct schema_element *to,
                     uint32_t path[PATH_MAX_ROWS], int depth, int most) {
    if (from == to)
        return depth;
    for (uint32_t i = 0; i < from->row_count && depth < most; i++) {
        if (!from->rows[i].child || from->rows[i].kind == SCHEMA_REFERENCE) // the scene has a list of those
            continue;
        path[depth] = i;
        int found = find_path(from->rows[i].child, to, path, depth + 1, most);
        if (found >= 0)
            return found;
    }
    return -1;
}

// Whether an element on the way must have the row: it is required, or the first of which one is.
static bool is_needed(const struct schema_element *schema, uint32_t i, uint32_t on_path) {
    const struct schema_row *row = &schema->rows[i];
    const bool is_first =
        row->choice && !is_alternative(schema, i) && row->choice != schema->rows[on_path].choice;
    return row->required || row->key ||
           (is_first && schema->choices[row->choice - 1].rule == SCHEMA_CHOICE_EXACTLY_ONE);
}

static void fill_path(const struct schema_element *schema, void *element, const uint32_t *path, int left,
                      struct arena *arena) {
    if (left == 0) {
        fill(schema, element, arena);
        return;
    }
    const struct schema_row *row = &schema->rows[*path];
    for (uint32_t i = 0; i < schema->row_count; i++) {
        bool is_root = schema == &SCHEMA_SCENE;
        if (!is_needed(schema, i, *path) || i == *path || is_root)
            continue;
        example_row(&schema->rows[i], i, element, arena);
        mark(schema, i, element);
    }
    if (row->kind == SCHEMA_LIST && row->example) {
        example_row(row, *path, element, arena);
    } else if (row->kind == SCHEMA_LIST) {
        void *item = new_element(row->child, arena);
        fill_path(row->child, item, path + 1, left - 1, arena);
        ir_walk_append(arena, row, element, item);
    } else {
        fill_path(row->child, schema_field(row, element), path + 1, left - 1, arena);
    }
    mark(schema, *path, element);
}

struct ir_scene *example_scene(const struct schema_element *element, struct arena *arena) {
    struct ir_scene *scene = ARENA_NEW(arena, struct ir_scene);
    uint32_t path[PATH_MAX_ROWS] = {0};
    schema_init(&SCHEMA_SCENE, scene);
    int length = -1;
    for (int most = 0; most <= PATH_MAX_ROWS && length < 0; most++) // the shortest
        length = find_path(&SCHEMA_SCENE, element, path, 0, most);
    if (length >= 0)
        fill_path(&SCHEMA_SCENE, scene, path, length, arena);
    return scene;
}
