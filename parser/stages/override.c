// Applies `--set` options to the merged scene: the path's target is bound again, by the same rules and with
// the same words as in a file.
#include "parser/stages/override.h"
#include "diag/codes/binding.h"
#include "grammar/ir_formula.h"
#include "grammar/preset.h"

#include "parser/bind/say.h"
#include "parser/bind/visit.h"
#include "parser/tree/reader.h"

#include <string.h>

static struct ir_origin *origin_of(const struct override *o) {
    return &o->loader->output->origin;
}

void override_mark(struct override *o, struct bind_frame *frame) {
    struct ir_head *head = bind_head(frame);
    merge_own_places(origin_of(o), head, head);
    if (origin_of(o)->elements.items[head->origin].at.source == SOURCE_DEFAULT)
        origin_of(o)->elements.items[head->origin].at = o->path;
    if (!frame->parent)
        return;
    struct bind_frame *parent = (struct bind_frame *)frame->parent;
    uint32_t row = (uint32_t)(frame->via - parent->schema->rows);
    bool was = (bind_head(parent)->written & bind_bit(row)) != 0;
    override_mark(o, parent);
    bind_head(parent)->written |= bind_bit(row);
    if (!was)
        ir_origin_add_row(origin_of(o), bind_head(parent)->origin,
                          (struct ir_row_origin){.row = row, .key = o->path, .value = o->path});
}

static void set_tag(const struct bind_frame *frame, const struct schema_row *row, unsigned tag) {
    if (row->choice)
        memcpy((char *)frame->memory + frame->schema->choices[row->choice - 1].tag_offset, &tag, sizeof tag);
}

// Lists.

struct removal {
    const struct schema_element *schema;
    uint32_t index;
};

static void move_down(void *context, struct visit_place place, struct ir_reference *reference) {
    const struct removal *removal = context;
    bool concerns = place.schema->rows[place.row].child == removal->schema && reference->index != IR_NO_INDEX;
    if (concerns && reference->index > removal->index)
        reference->index--;
}

// Anonymous elements are found by their index, which changes.
static void remove_entry(struct override *o, struct bind_frame *frame, const struct schema_row *row,
                         uint32_t index) {
    bind_list_remove(schema_field(row, frame->memory), index, row->child->size);
    struct removal removal = {row->child, index};
    if (!frame->parent)
        visit_references(&SCHEMA_SCENE, o->scene, move_down, &removal);
}

static bool is_anonymous(const struct bind_frame *frame, const struct schema_row *row, uint32_t index) {
    int key = row->many == SCHEMA_NAMED_MAP ? schema_key_row(row->child) : -1;
    void *item = bind_list_item(schema_field(row, frame->memory), index, row->child->size);
    return key >= 0 && ((const str *)schema_field_const(&row->child->rows[key], item))->len == 0;
}

static void clear_list(struct override *o, struct bind_frame *frame, uint32_t row) {
    const struct schema_row *r = &frame->schema->rows[row];
    for (uint32_t i = bind_list_count(schema_field(r, frame->memory)); i > 0; i--)
        if (!is_anonymous(frame, r, i - 1))
            remove_entry(o, frame, r, i - 1);
    bind_head(frame)->written &= ~bind_bit(row);
    bind_head(frame)->poisoned &= ~bind_bit(row);
    ir_origin_remove_row(origin_of(o), bind_head(frame)->origin, row);
}

static void clear_row(struct override *o, struct bind_frame *frame, uint32_t row) {
    if (frame->schema->rows[row].kind == SCHEMA_LIST)
        clear_list(o, frame, row);
    else
        bind_clear_row(&o->loader->scratch, origin_of(o), frame->schema, frame->memory, row);
}

// Removing.

static void remove_row(struct override *o, struct bind_frame *frame, uint32_t row) {
    const struct schema_row *r = &frame->schema->rows[row];
    bool was = (bind_head(frame)->written & bind_bit(row)) != 0;
    clear_row(o, frame, row);
    if (was)
        set_tag(frame, r, 0);
    frame->seen = bind_head(frame)->written;
    for (uint32_t i = 0; i < frame->schema->row_count; i++)
        if (i != row && !(r->choice && frame->schema->rows[i].choice == r->choice))
            frame->seen |= bind_bit(i);
    bind_missing(&o->context, frame, false);
}

static void remove_target(struct override *o, const struct override_target *target) {
    struct bind_frame *frame = target->frame;
    const struct schema_row *row = &frame->schema->rows[target->row];
    if (target->kind == OVERRIDE_COMPONENT) {
        diag_add(o->loader->input->sink, DIAG_SET_PATH, o->path, "a part of %.*s cannot be removed",
                 STR_ARG(say_subject(&o->loader->scratch, bind_subject(frame, row))));
        diag_help(o->loader->input->sink, "set it to a value, or remove all of '%s'", row->name);
        return;
    }
    override_mark(o, frame);
    if (target->kind == OVERRIDE_ROW) {
        remove_row(o, frame, target->row);
        return;
    }
    remove_entry(o, frame, row, target->entry);
    if (bind_list_count(schema_field(row, frame->memory)) == 0)
        bind_head(frame)->written &= ~bind_bit(target->row);
}

// Setting.

static struct bind_given given_value(const struct override *o) {
    return (struct bind_given){.key_span = o->path, .value = o->context.tree->root};
}

static void set_row(struct override *o, struct bind_frame *frame, uint32_t row) {
    const struct schema_row *r = &frame->schema->rows[row];
    for (uint32_t i = 0; i < frame->schema->row_count; i++)
        if (i == row || (r->choice && frame->schema->rows[i].choice == r->choice))
            clear_row(o, frame, i);
    frame->seen = 0;
    bind_row(&o->context, frame, row, false, given_value(o));
}

static void set_entry(struct override *o, const struct override_target *target) {
    struct bind_frame *frame = target->frame;
    const struct schema_row *row = &frame->schema->rows[target->row];
    void *list = schema_field(row, frame->memory);
    void *memory = arena_alloc(&o->loader->scratch, row->child->size);
    schema_init(row->child, memory);
    struct bind_frame child = {.parent = frame,
                               .schema = row->child,
                               .via = row,
                               .memory = memory,
                               .name = target->name,
                               .label = o->path};
    bind_entry_into(&o->context, &child, given_value(o));
    if (target->entry < bind_list_count(list))
        memcpy(bind_list_item(list, target->entry, row->child->size), memory, row->child->size);
    else
        bind_list_push(o->loader->input->arena, list, memory, row->child->size);
    bind_head(frame)->written |= bind_bit(target->row);
}

static void set_component(struct override *o, const struct override_target *target) {
    struct bind_frame *frame = target->frame;
    const struct schema_row *row = &frame->schema->rows[target->row];
    char *field =
        (char *)schema_field(row, frame->memory) + (target->slot > 0 ? (size_t)target->slot * row->size : 0);
    struct bind_subject subject = {.frame = frame, .row = row, .index = target->slot};
    struct ir_origin *origin = origin_of(o);
    bool good;
    ir_formula_drop(origin->arena, origin->formulas, bind_head(frame), row, target->slot,
                    target->component == OVERRIDE_WHOLE_SLOT ? IR_FORMULA_WHOLE : (int)target->component);
    if (target->component == OVERRIDE_WHOLE_SLOT) {
        good = bind_value(&o->context, subject, o->context.tree->root, field);
    } else {
        double value;
        subject.component = schema_components(row->kind)[target->component];
        good = bind_number(&o->context, subject, o->context.tree->root, &value);
        // The structs of vectors, colours and weights begin with their components, in order.
        if (good)
            memcpy(field + target->component * sizeof value, &value, sizeof value);
    }
    bind_note_row(&o->context, frame, target->row, given_value(o));
    bind_head(frame)->written |= bind_bit(target->row);
    if (!good)
        bind_poison(frame, target->row);
}

// A colour of hexadecimal digits has no components to set.
static bool is_hex(struct override *o, const struct override_target *target) {
    const struct schema_row *row = &target->frame->schema->rows[target->row];
    if (target->kind != OVERRIDE_COMPONENT || target->component == OVERRIDE_WHOLE_SLOT ||
        row->kind != SCHEMA_COLOR)
        return false;
    const struct ir_color *color = schema_field(row, target->frame->memory);
    if (!color[target->slot > 0 ? target->slot : 0].is_hex)
        return false;
    diag_add(o->loader->input->sink, DIAG_SET_PATH, o->path,
             "%.*s is written as #rrggbb, which has no components; it can only be set as a whole",
             STR_ARG(say_subject(&o->loader->scratch, bind_subject(target->frame, row))));
    return true;
}

// "#aabbcc" by itself: in a file it would be a comment, here it has only one meaning.
static bool read_color(struct override *o, struct arena *arena, struct tree *tree) {
    str rest = str_slice(o->text, o->value_begin, o->text.len);
    str text = str_trim(rest);
    if (text.len != 7 || text.ptr[0] != '#')
        return false;
    for (size_t i = 1; i < text.len; i++)
        if (!memchr("0123456789abcdefABCDEF", text.ptr[i], 22))
            return false;
    uint32_t begin = (uint32_t)(text.ptr - o->text.ptr);
    tree_init(tree, arena, o->source, false);
    tree->root = tree_add(tree, (struct tree_node){.kind = TREE_SCALAR,
                                                   .style = TREE_QUOTED,
                                                   .begin = begin,
                                                   .end = begin + (uint32_t)text.len,
                                                   .value = tree_add_text(tree, text),
                                                   .count = (uint32_t)text.len});
    return true;
}

// Nor has a value that is computed as a whole.
static bool is_computed(struct override *o, const struct override_target *target) {
    const struct bind_frame *frame = target->frame;
    const struct schema_row *row = &frame->schema->rows[target->row];
    if (target->kind != OVERRIDE_COMPONENT || target->component == OVERRIDE_WHOLE_SLOT ||
        !ir_formula_of(origin_of(o)->formulas, bind_head(frame), row, target->slot, IR_FORMULA_WHOLE))
        return false;
    diag_add(o->loader->input->sink, DIAG_SET_PATH, o->path,
             "%.*s is computed as a whole; it can only be set as a whole",
             STR_ARG(say_subject(&o->loader->scratch, bind_subject(frame, row))));
    return true;
}

// A parameter that is given a value keeps its bounds and its description.
static bool is_value_alone(const struct override_target *target, const struct tree *tree) {
    return target->kind == OVERRIDE_ENTRY && target->frame->schema->rows[target->row].aside &&
           tree_node(tree, tree->root)->kind != TREE_MAP;
}

static void set_alone(struct override *o, const struct override_target *target) {
    struct bind_frame *entry = override_enter(o, target);
    override_mark(o, entry);
    set_row(o, entry, (uint32_t)schema_short_row(entry->schema));
}

static void set_target(struct override *o, const struct override_target *target) {
    struct reader_context reader = {.sources = o->loader->input->sources,
                                    .sink = o->loader->input->sink,
                                    .limits = o->loader->input->limits,
                                    .arena = &o->loader->scratch};
    struct tree tree = {.source = o->source};
    if (is_hex(o, target) || is_computed(o, target))
        return;
    if (!read_color(o, reader.arena, &tree) && !read_yaml_value(&reader, o->source, o->value_begin, &tree))
        return;
    if (tree.root == 0)
        return;
    o->context.tree = &tree;
    override_mark(o, target->frame);
    if (is_value_alone(target, &tree))
        set_alone(o, target);
    else if (target->kind == OVERRIDE_ROW)
        set_row(o, target->frame, target->row);
    else if (target->kind == OVERRIDE_ENTRY)
        set_entry(o, target);
    else
        set_component(o, target);
}

static void apply(struct loader *loader, struct ir_scene *scene, str option) {
    const struct parser_input *input = loader->input;
    struct tree nothing = {.arena = NULL};
    struct override *o = ARENA_NEW(&loader->scratch, struct override);
    *o = (struct override){.loader = loader, .scene = scene, .text = option};
    o->source = source_add(input->sources, SOURCE_KIND_OPTION, STR("--set"), option);
    nothing.source = o->source;
    o->context = loader_binding(loader, input->sink, &nothing);
    o->context.scene = scene;
    struct override_target target;
    if (!override_parse(o) || !override_walk(o, &target))
        return;
    if (str_trim(str_slice(option, o->value_begin, option.len)).len == 0)
        remove_target(o, &target);
    else
        set_target(o, &target);
}

void override_apply(struct loader *loader, struct ir_scene *scene) {
    for (uint32_t i = 0; i < loader->input->set_count; i++) {
        // A component is set beside the others of the preset, which a later option may change.
        const bool has_presets = preset_take(scene);
        apply(loader, scene, loader->input->sets[i]);
        if (has_presets)
            preset_leave(scene);
        arena_finish(&loader->scratch);
    }
}
