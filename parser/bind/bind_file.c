// The root of a file: whether it is a scene, and its contents.
#include "diag/codes/binding.h"
#include "grammar/ir.h"
#include "parser/bind/bind.h"
#include "parser/bind/say.h"
#include "parser/tree/mend.h"

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
    // A root in another style is still a scene, and its other mistakes are reported too.
    return good || (is_map && tree->is_xml && str_equal_cstr(tag, frame->schema->name));
}

struct ir_scene *bind_new_scene(struct bind_context *context) {
    struct ir_scene *scene = ARENA_NEW(context->arena, struct ir_scene);
    schema_index_defaults(context->index, &SCHEMA_SCENE, scene);
    scene->formulas = context->origin->formulas;
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
    struct bind_key_rows known;
    known.count = 0;
    bind_keys(context, &root, tree->root, true, &known);
    if (context->other_version)
        return NULL;
    bind_keys(context, &root, tree->root, false, &known);
    bind_missing(context, &root, (tree_node(tree, tree->root)->flags & (TREE_BAD | TREE_CUT)) != 0);
    return scene;
}
