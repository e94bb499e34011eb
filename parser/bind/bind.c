#include "parser/bind/bind.h"
#include "parser/bind/say.h"
#include "parser/tree/mend.h"

#include <string.h>

int bind_find_row(const struct bind_context *context, const struct schema_element *schema, tree_index key,
                  bool *is_single) {
    static const enum schema_name_kind kinds[] = {[TREE_KEY_PLAIN] = SCHEMA_NAME_KEY,
                                                  [TREE_KEY_ATTRIBUTE] = SCHEMA_NAME_ATTRIBUTE,
                                                  [TREE_KEY_CHILD] = SCHEMA_NAME_CHILD};
    enum schema_name_kind kind = kinds[tree_node(context->tree, key)->key];
    return schema_index_find(context->index, schema, kind, tree_text(context->tree, key), is_single);
}

struct bind_given bind_given_by(const struct bind_context *context, tree_index key) {
    return (struct bind_given){.key = key,
                               .key_span = tree_span(context->tree, key),
                               .comments = tree_comments(context->tree, key),
                               .value = tree_value(context->tree, key)};
}

void bind_note_row(struct bind_context *context, struct bind_frame *frame, uint32_t row,
                   struct bind_given given) {
    ir_origin_add_row(context->origin, bind_head(frame)->origin,
                      (struct ir_row_origin){.row = row,
                                             .key = given.key_span,
                                             .value = tree_span(context->tree, given.value),
                                             .comments = given.comments});
    frame->seen |= bind_bit(row);
}

// 'camera' beside 'cameras': the two forms of one row.
static bool report_both_forms(struct bind_context *context, const struct schema_row *row,
                              const struct ir_row_origin *first, struct bind_given given) {
    str before = first ? source_text(context->sources, first->key) : STR("");
    if (before.len > 2 && (before.ptr[0] == '"' || before.ptr[0] == '\''))
        before = str_slice(before, 1, before.len - 1);
    if (!row->single || context->tree->is_xml || before.len == 0 || !given.key ||
        str_equal(before, tree_text(context->tree, given.key)))
        return false;
    diag_add(context->sink, DIAG_GIVEN_TWICE, given.key_span, "both '%s' and '%s' are given", row->name,
             row->plural);
    diag_note(context->sink, first->key, "'%.*s' is here", STR_ARG(before));
    diag_help(context->sink, "'%s: {...}' is short for '%s: {%s: {...}}'; write all of them there", row->name,
              row->plural, row->single);
    return true;
}

void bind_report_twice(struct bind_context *context, struct bind_frame *frame, uint32_t row,
                       struct bind_given given) {
    const struct schema_row *r = &frame->schema->rows[row];
    const struct ir_row_origin *first = ir_origin_row(context->origin, bind_head(frame), row);
    if (report_both_forms(context, r, first, given))
        return;
    str s = say_subject(context->scratch, bind_subject(frame, r));
    diag_add(context->sink, DIAG_GIVEN_TWICE, given.key_span, "%.*s is given twice", STR_ARG(s));
    if (first)
        diag_note(context->sink, first->key, "first given here");
    diag_help(context->sink, "remove one of the two");
}

struct bind_frame bind_aside(struct bind_context *context, const struct bind_frame *frame) {
    struct bind_frame aside = *frame;
    aside.seen = 0;
    aside.memory = arena_alloc(context->scratch, frame->schema->size);
    schema_index_defaults(context->index, frame->schema, aside.memory);
    bind_head(&aside)->origin =
        ir_origin_add(context->origin, (struct ir_element_origin){.label = frame->label});
    return aside;
}

str bind_copy_once(struct bind_context *context, str text) {
    // Names that belong together differ in their last letters.
    uint32_t end = (uint32_t)text.len;
    for (size_t i = text.len > 3 ? text.len - 3 : 0; i < text.len; i++)
        end = end * 31 + (unsigned char)text.ptr[i];
    str *known = &context->texts->items[(end ^ end >> 8) % BIND_TEXTS];
    if (!str_equal(*known, text))
        *known = arena_copy(context->arena, text);
    return *known;
}

// One row.

static bool bind_reference(struct bind_context *context, struct bind_frame *frame,
                           const struct schema_row *row, struct bind_given given) {
    struct ir_material_ref *ref = schema_field(row, frame->memory);
    enum tree_kind kind = bind_kind(context, given.value);
    if (kind == TREE_SCALAR && !bind_is_bad(context, given.value)) {
        str name = tree_text(context->tree, given.value);
        if (!bind_name_text(context, bind_subject(frame, row), name, tree_span(context->tree, given.value)))
            return false;
        *ref = (struct ir_material_ref){bind_copy_once(context, name), IR_NO_INDEX};
        return true;
    }
    if (kind != TREE_MAP)
        return bind_wrong_shape(context, bind_subject(frame, row), given.value);
    void *memory = arena_alloc(context->scratch, row->child->size);
    schema_index_defaults(context->index, row->child, memory);
    struct bind_frame child = {
        .parent = frame, .schema = row->child, .via = row, .memory = memory, .label = given.key_span};
    bind_element(context, &child, given.value);
    const struct schema_row *home = &SCHEMA_SCENE.rows[bind_home_row(row->child)];
    ref->index = bind_list_push(context->arena, schema_field(home, context->scene), memory, row->child->size);
    return true;
}

static bool bind_one(struct bind_context *context, struct bind_frame *frame, const struct schema_row *row,
                     struct bind_given given) {
    if (row->kind == SCHEMA_REFERENCE)
        return bind_reference(context, frame, row, given);
    if (row->kind != SCHEMA_ELEMENT)
        return bind_value(context, bind_subject(frame, row), given.value, schema_field(row, frame->memory));
    struct bind_frame child = {.parent = frame,
                               .schema = row->child,
                               .via = row,
                               .memory = schema_field(row, frame->memory),
                               .label = given.key_span};
    return bind_element(context, &child, given.value);
}

// Whether another row of the same choice was given before; reports it.
static bool is_excluded(struct bind_context *context, struct bind_frame *frame, uint32_t row,
                        struct bind_given given) {
    const struct schema_row *r = &frame->schema->rows[row];
    for (uint32_t i = 0; i < frame->schema->row_count && r->choice; i++) {
        const struct schema_row *other = &frame->schema->rows[i];
        if (i == row || r->choice == 0 || other->choice != r->choice ||
            !(bind_head(frame)->written & bind_bit(i)))
            continue;
        str owner = say_subject(context->scratch, bind_subject(frame, NULL));
        diag_add(context->sink, DIAG_EXCLUSIVE, given.key_span,
                 "%.*s has both '%s' and '%s'; only one is allowed", STR_ARG(owner), other->name, r->name);
        const struct ir_row_origin *first = ir_origin_row(context->origin, bind_head(frame), i);
        if (first)
            diag_note(context->sink, first->key, "'%s' is here", other->name);
        diag_help(context->sink, "remove one of the two");
        return true;
    }
    return false;
}

void bind_row(struct bind_context *context, struct bind_frame *frame, uint32_t row, bool single,
              struct bind_given given) {
    const struct schema_row *r = &frame->schema->rows[row];
    if (r->many != SCHEMA_ONE) {
        bind_many(context, frame, row, single, given);
        return;
    }
    if (frame->seen & bind_bit(row)) {
        bind_report_twice(context, frame, row, given);
        struct bind_frame aside = bind_aside(context, frame);
        bind_one(context, &aside, r, given);
        return;
    }
    if (is_excluded(context, frame, row, given)) {
        struct bind_frame aside = bind_aside(context, frame);
        bind_one(context, &aside, r, given);
        bind_note_row(context, frame, row, given);
        bind_poison(frame, row);
        return;
    }
    bind_note_row(context, frame, row, given);
    bind_head(frame)->written |= bind_bit(row);
    if (r->choice) {
        unsigned tag = r->alternative;
        memcpy((char *)frame->memory + frame->schema->choices[r->choice - 1].tag_offset, &tag, sizeof tag);
    }
    if (!bind_one(context, frame, r, given))
        bind_poison(frame, row);
}

// Elements.

// Names come first, so that messages can use them; so does the version, which decides whether to go on.
static bool comes_first(const struct schema_row *row) {
    return row->range == SCHEMA_RANGE_VERSION || row->key ||
           (row->kind == SCHEMA_TEXT && row->text == SCHEMA_TEXT_NAME);
}

// Root keys for anchors; and in an element that was never closed, what belongs outside it.
static bool is_ignored(const struct bind_context *context, const struct bind_frame *frame, tree_index map,
                       tree_index key) {
    bool single;
    if (!frame->parent)
        return tree_node(context->tree, key)->key == TREE_KEY_PLAIN &&
               str_starts_with(tree_text(context->tree, key), STR("x-"));
    if (!(tree_node(context->tree, map)->flags & TREE_CUT))
        return false;
    const struct bind_frame *outer = frame->parent;
    while (outer && bind_find_row(context, outer->schema, key, &single) < 0)
        outer = outer->parent;
    return outer != NULL;
}

static void report_named_inline(struct bind_context *context, struct bind_frame *frame, tree_index key) {
    str owner = say_owner(context->scratch, frame);
    str name = tree_text(context->tree, tree_value(context->tree, key));
    diag_add(context->sink, DIAG_NAMED_INLINE, tree_span(context->tree, key),
             "a %s written in place must not have a name: it belongs only to %.*s", frame->schema->name,
             STR_ARG(owner));
    if (str_is_name(name))
        diag_help(context->sink, "to use a %s of the scene write %s=\"%.*s\"", frame->schema->name,
                  frame->via->name, STR_ARG(name));
}

// The rows of an element's first keys, which are asked for twice.
struct key_rows {
    uint32_t count;
    struct {
        int row;
        bool single;
    } items[16];
};

static int find_row_once(const struct bind_context *context, const struct bind_frame *frame, tree_index key,
                         uint32_t number, struct key_rows *known, bool *single) {
    if (number < known->count) {
        *single = known->items[number].single;
        return known->items[number].row;
    }
    int row = bind_find_row(context, frame->schema, key, single);
    if (number == known->count && number < sizeof known->items / sizeof *known->items) {
        known->items[number].row = row;
        known->items[number].single = *single;
        known->count++;
    }
    return row;
}

static void bind_keys(struct bind_context *context, struct bind_frame *frame, tree_index node, bool first,
                      struct key_rows *known) {
    const struct tree *tree = context->tree;
    uint32_t number = 0;
    for (tree_index key = tree_first(tree, node); key; key = tree_next_key(tree, key), number++) {
        bool single = false;
        bool bad = bind_is_bad_pair(context, node, key);
        int row = find_row_once(context, frame, key, number, known, &single);
        if (row >= 0 && !first && !bad)
            bind_loose_columns(context, frame, &frame->schema->rows[row], key);
        if (row >= 0 && comes_first(&frame->schema->rows[row]) != first)
            continue;
        if (row < 0) {
            if (!first && !bad && !is_ignored(context, frame, node, key))
                bind_unknown_name(context, frame, key);
        } else if (bad) {
            if (!(frame->seen & bind_bit((uint32_t)row)))
                bind_poison(frame, (uint32_t)row);
            frame->seen |= bind_bit((uint32_t)row);
        } else if (frame->schema->rows[row].key && frame->via && frame->via->kind == SCHEMA_REFERENCE) {
            report_named_inline(context, frame, key);
        } else {
            bind_row(context, frame, (uint32_t)row, single, bind_given_by(context, key));
            const struct schema_row *r = &frame->schema->rows[row];
            if (r->kind == SCHEMA_TEXT && comes_first(r))
                frame->name = *(const str *)schema_field_const(r, frame->memory);
        }
    }
}

void bind_pairs(struct bind_context *context, struct bind_frame *frame, tree_index node) {
    struct key_rows known;
    known.count = 0;
    bind_keys(context, frame, node, true, &known);
    bind_keys(context, frame, node, false, &known);
}

// Whether a map is the short row's value and not the element: its keys are those of the short row alone.
static bool is_bare_map(const struct bind_context *context, const struct bind_frame *frame,
                        const struct schema_row *bare, tree_index node) {
    const char *const *names = schema_components(bare->kind);
    bool is_value = false;
    bool single;
    for (tree_index key = tree_first(context->tree, node); key; key = tree_next_key(context->tree, key)) {
        if (bind_find_row(context, frame->schema, key, &single) >= 0)
            return false;
        for (uint32_t i = 0; names[i]; i++)
            is_value = is_value || str_equal_cstr(tree_text(context->tree, key), names[i]);
        is_value = is_value || (bare->kind == SCHEMA_COLOR &&
                                str_equal_cstr(tree_text(context->tree, key), SCHEMA_HEX_ATTRIBUTE));
        is_value = is_value || (bare->child && bind_find_row(context, bare->child, key, &single) >= 0);
    }
    return is_value;
}

static bool is_bare(const struct bind_context *context, const struct bind_frame *frame, int bare,
                    tree_index node) {
    enum tree_kind kind = bind_kind(context, node);
    if (bare < 0 || kind == TREE_NULL)
        return false;
    return kind != TREE_MAP || is_bare_map(context, frame, &frame->schema->rows[bare], node);
}

// The name is the best place for what concerns a whole entry.
static span best_label(const struct bind_context *context, const struct bind_frame *frame, int name_row) {
    if (frame->via->many == SCHEMA_ONE || name_row < 0 || !(frame->seen & bind_bit((uint32_t)name_row)))
        return frame->label;
    const struct ir_row_origin *name = ir_origin_row(context->origin, bind_head(frame), (uint32_t)name_row);
    return name ? name->value : frame->label;
}

bool bind_element(struct bind_context *context, struct bind_frame *frame, tree_index node) {
    struct ir_head *head = bind_head(frame);
    head->origin =
        ir_origin_add(context->origin, (struct ir_element_origin){.at = tree_span(context->tree, node),
                                                                  .label = frame->label,
                                                                  .comments = frame->comments});
    const struct schema_facts *facts = schema_index_facts(context->index, frame->schema);
    int bare = facts->short_row;
    if (is_bare(context, frame, bare, node)) {
        frame->bare = true;
        struct bind_given given = {.key_span = frame->label, .value = node};
        bind_row(context, frame, (uint32_t)bare, false, given);
    } else if (bind_kind(context, node) == TREE_MAP) {
        struct key_rows known;
        known.count = 0;
        if (facts->names)
            bind_keys(context, frame, node, true, &known);
        frame->label = best_label(context, frame, facts->name_row);
        context->origin->elements.items[head->origin].label = frame->label;
        bind_default_key(context, frame);
        bind_keys(context, frame, node, false, &known);
    } else {
        return bind_wrong_shape(context, bind_subject(frame, NULL), node);
    }
    bind_missing(context, frame, (tree_node(context->tree, node)->flags & (TREE_BAD | TREE_CUT)) != 0);
    return true;
}

// The root.

static bool knows_any_key(struct bind_context *context, const struct bind_frame *frame) {
    bool single;
    for (tree_index key = tree_first(context->tree, context->tree->root); key;
         key = tree_next_key(context->tree, key))
        if (bind_find_row(context, frame->schema, key, &single) >= 0 ||
            bind_find_style(context, frame, key) >= 0)
            return true;
    return false;
}

static void report_no_scene(struct bind_context *context, const struct bind_frame *frame, span at) {
    const struct tree *tree = context->tree;
    if (tree->is_xml) {
        str tag = say_text(context->scratch, tree->root_tag);
        diag_add(context->sink, DIAG_NOT_A_SCENE, at, "this is not a glint scene: its root is '%.*s'",
                 STR_ARG(tag));
        diag_help(context->sink, "a scene begins with <%s glint=\"1\">", frame->schema->element);
        if (str_equal_cstr(mend_snake(context->scratch, tree->root_tag), frame->schema->name))
            bind_fix_tag(context, at, tree->root, true, str_from(frame->schema->element));
    } else {
        diag_add(context->sink, DIAG_NOT_A_SCENE, at,
                 "this is not a glint scene: it has none of the keys of a scene");
        diag_help(context->sink, "a scene begins with 'glint: 1'");
    }
}

static bool is_scene(struct bind_context *context, const struct bind_frame *frame) {
    const struct tree *tree = context->tree;
    bool is_map = tree->root && bind_kind(context, tree->root) == TREE_MAP;
    str tag = mend_snake(context->scratch, tree->root_tag);
    bool good = is_map && (tree->is_xml ? str_equal_cstr(tree->root_tag, frame->schema->element)
                                        : knows_any_key(context, frame));
    bool known = tree->broken || (tree->root && bind_is_bad(context, tree->root));
    if (!good && !known)
        report_no_scene(context, frame, is_map ? tree->root_name : (span){tree->source, 0, 0});
    // In another style it is a scene all the same, whose other mistakes are told too.
    return good || (is_map && tree->is_xml && str_equal_cstr(tag, frame->schema->name));
}

struct ir_scene *bind_new_scene(struct bind_context *context) {
    struct ir_scene *scene = ARENA_NEW(context->arena, struct ir_scene);
    schema_index_defaults(context->index, &SCHEMA_SCENE, scene);
    return scene;
}

struct ir_scene *bind_file(struct bind_context *context) {
    const struct tree *tree = context->tree;
    if (!context->scene)
        context->scene = bind_new_scene(context);
    struct ir_scene *scene = context->scene;
    struct bind_frame root = {.schema = &SCHEMA_SCENE, .memory = scene, .label = tree->root_name};
    if (!is_scene(context, &root))
        return NULL;
    scene->head.origin =
        ir_origin_add(context->origin, (struct ir_element_origin){.at = tree_span(tree, tree->root),
                                                                  .label = tree->root_name});
    struct key_rows known;
    known.count = 0;
    bind_keys(context, &root, tree->root, true, &known);
    if (context->other_version)
        return NULL;
    bind_keys(context, &root, tree->root, false, &known);
    bind_missing(context, &root, (tree_node(tree, tree->root)->flags & (TREE_BAD | TREE_CUT)) != 0);
    return scene;
}
