// An entry of a list or named map before and after its rows: memory, label, key.
#include "diag/codes/binding.h"
#include "parser/bind/bind.h"
#include "parser/bind/say.h"

#include <string.h>

// The span to show for an entry without a name: all of it if it fits on a line, else its first key.
static span label_of(const struct bind_context *context, struct bind_given given) {
    if (given.key)
        return given.key_span;
    span all = tree_span(context->tree, given.value);
    str text = source_text(context->sources, all);
    bool one_line = text.len == 0 || !memchr(text.ptr, '\n', text.len);
    tree_index first = tree_first(context->tree, given.value);
    return one_line || !first ? all : tree_span(context->tree, first);
}

static str *key_field(const struct bind_frame *child, uint32_t row) {
    return schema_field(&child->schema->rows[row], child->memory);
}

static void set_key(struct bind_context *context, struct bind_frame *child, uint32_t row, span at) {
    const struct schema_row *r = &child->schema->rows[row];
    bool good = bind_name_text(context, bind_subject(child, r), child->name, at);
    *key_field(child, row) = arena_copy(context->arena, child->name);
    child->name = *key_field(child, row);
    child->seen |= bind_bit(row);
    bind_head(child)->written |= bind_bit(row);
    if (!good)
        bind_poison(child, row);
}

void bind_default_key(struct bind_context *context, struct bind_frame *child) {
    int row = schema_key_row(child->schema);
    if (row < 0 || (child->seen & bind_bit((uint32_t)row)) || !child->via->single)
        return;
    child->name = arena_copy(context->arena, str_from(child->via->single));
    child->seen |= bind_bit((uint32_t)row);
    *key_field(child, (uint32_t)row) = child->name;
    bind_head(child)->written |= bind_bit((uint32_t)row);
}

// 1 + the index of the entry that has a key, or 0. A list's entries are bound one after the other, so the map
// only has to know the last list: a list with fewer entries than the map is a different one.
static uint32_t find_key(struct bind_context *context, void *list, const struct schema_element *schema,
                         uint32_t row, str key) {
    struct bind_list_keys *keys = &context->keys;
    uint32_t count = bind_list_count(list);
    if (!keys->map.arena)
        str_map_init(&keys->map, context->arena);
    if (keys->list != list || keys->count > count) {
        str_map_clear(&keys->map);
        *keys = (struct bind_list_keys){.list = list, .map = keys->map};
    }
    for (; keys->count < count; keys->count++) {
        const void *item = bind_list_item(list, keys->count, schema->size);
        uint32_t *number = str_map_at(&keys->map, *(const str *)schema_field_const(&schema->rows[row], item));
        *number = *number ? *number : keys->count + 1;
    }
    return str_map_find(&keys->map, key);
}

bool bind_is_second(struct bind_context *context, const struct bind_frame *parent,
                    const struct bind_frame *child) {
    int row = child->via->many == SCHEMA_NAMED_MAP ? schema_key_row(child->schema) : -1;
    if (row < 0 || child->schema->rows[row].text == SCHEMA_TEXT_NAME ||
        key_field(child, (uint32_t)row)->len == 0)
        return false;
    void *list = schema_field(child->via, parent->memory);
    uint32_t first = find_key(context, list, child->schema, (uint32_t)row, *key_field(child, (uint32_t)row));
    if (!first)
        return false;
    const char *item = bind_list_item(list, first - 1, child->schema->size);
    diag_add(context->sink, DIAG_GIVEN_TWICE, child->label, "%.*s is given twice",
             STR_ARG(say_owner(context->scratch, child)));
    diag_note(context->sink, ir_place_label(context->origin, (const struct ir_head *)item),
              "first given here");
    diag_help(context->sink, "remove one of the two");
    return true;
}

void bind_entry_key(struct bind_context *context, struct bind_frame *child, struct bind_given given) {
    int key_row = child->via->many == SCHEMA_NAMED_MAP ? schema_key_row(child->schema) : -1;
    if (key_row >= 0 && !context->tree->is_xml && (child->name.len || given.key))
        set_key(context, child, (uint32_t)key_row, given.key_span);
}

struct bind_frame bind_entry_begin(struct bind_context *context, const struct bind_frame *parent,
                                   const struct schema_row *row, str name, struct bind_given given) {
    void *memory = arena_alloc(context->scratch, row->child->size);
    schema_index_defaults(context->index, row->child, memory);
    return (struct bind_frame){.parent = parent,
                               .schema = row->child,
                               .via = row,
                               .memory = memory,
                               .name = name,
                               .label = label_of(context, given),
                               .comments = given.comments};
}
