#include "lint/lint_parts.h"

// The rules in the order of their codes.
static const struct rule {
    enum diag_code code;
    const char *name;
    void (*run)(struct lint *lint);
    enum lint_level level;
} RULES[] = {
    // One test of a box for each pair of camera and solid, rays only where the box holds the camera.
    {DIAG_CAMERA_INSIDE, "camera inside a body", lint_camera_inside, LINT_ALL},
    {DIAG_LIGHT_INSIDE, "light on or inside a body", lint_light_inside, LINT_ALL},
    // One pass over the bodies.
    {DIAG_INDEX_ONE, "refraction without an index", lint_index_one, LINT_CHEAP},
    {DIAG_AMPLIFYING, "mirrors that amplify", lint_amplifying, LINT_CHEAP},
    // A few thousand rays through the refracting bodies of each camera.
    {DIAG_DEPTH_SHORT, "too few bounces for the glass in view", lint_depth_short, LINT_ALL},
    // One pass over the bodies for each camera and light.
    {DIAG_UNSEEN, "bodies that no camera sees", lint_unseen, LINT_ALL},
    {DIAG_UNUSED_MATERIAL, "materials that nothing uses", lint_unused_material, LINT_ALL},
    {DIAG_UNUSED_INCLUDE, "includes that add nothing", lint_unused_include, LINT_ALL},
    // A tree for each mesh and a walk for each leaf; then a walk through what pairs of bodies have in common.
    {DIAG_COINCIDENT, "faces in the same plane", lint_coincident, LINT_ALL},
    // One pass over the triangles of each mesh, the second one with a hash table.
    {DIAG_ZERO_AREA, "triangles without area", lint_zero_area, LINT_ALL},
    {DIAG_DUPLICATE_TRIANGLES, "triangles given twice", lint_duplicates, LINT_ALL},
    // For meshes that refract: a tree and a walk for each leaf; then connected parts.
    {DIAG_SELF_OVERLAP, "a mesh that crosses itself", lint_self_overlap, LINT_ALL},
    {DIAG_INSIDE_OUT, "parts that are inside out", lint_inside_out, LINT_ALL},
    // One pass over the triangles of meshes with normals.
    {DIAG_OPPOSING_NORMALS, "normals that oppose their faces", lint_opposing_normals, LINT_ALL},
    // The header of one image.
    {DIAG_OVERSIZED_IMAGE, "images larger than can be seen", lint_oversized_image, LINT_ALL},
};

enum {
    RULE_COUNT = sizeof RULES / sizeof *RULES
};

unsigned lint_rule_count(void) {
    return RULE_COUNT;
}

struct lint_rule_info lint_rule(unsigned index) {
    return (struct lint_rule_info){RULES[index].code, RULES[index].name, RULES[index].level};
}

static void run_rules(struct lint *lint, enum lint_level level) {
    lint_collect(lint);
    for (unsigned i = 0; i < RULE_COUNT; i++)
        if (RULES[i].level <= level)
            RULES[i].run(lint);
}

void lint_run(const struct lint_input *input, enum lint_level level) {
    if (level == LINT_NONE)
        return;
    struct arena arena;
    struct arena_guard guard;
    struct arena_guard *outer = input->scene->arena->guard;
    arena_init(&arena, (size_t)input->scene->limits->value[LIMIT_MESH_MEMORY]);
    arena_set_guard(&arena, &guard);
    // Sources that notes need lie in the scene's arena.
    arena_set_guard(input->scene->arena, &guard);
    if (setjmp(guard.jump) == 0) {
        struct lint lint = {.input = input,
                            .scene = input->scene->scene,
                            .origin = input->scene->origin,
                            .assets = input->assets,
                            .sink = input->scene->sink,
                            .arena = &arena};
        run_rules(&lint, level);
    } else {
        diag_add(input->scene->sink, DIAG_OUT_OF_MEMORY, SPAN_NONE,
                 "there is not enough memory for the rules that look at meshes");
    }
    arena_set_guard(input->scene->arena, outer);
    arena_finish(&arena);
}
