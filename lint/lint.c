#include "diag/codes/limit.h"
#include "diag/codes/rule.h"
#include "lint/lint_internal.h"

// The rules in the order of their codes.
const struct lint_rule lint_rules[] = {
    // For each solid a walk through a tree of the cameras; rays only where its box holds a camera.
    {DIAG_CAMERA_INSIDE, lint_camera_inside, LINT_ALL},
    {DIAG_LIGHT_INSIDE, lint_light_inside, LINT_ALL},
    // One pass over the bodies.
    {DIAG_INDEX_ONE, lint_index_one, LINT_CHEAP},
    {DIAG_AMPLIFYING, lint_amplifying, LINT_CHEAP},
    // A few thousand rays through the refracting bodies of each camera.
    {DIAG_DEPTH_SHORT, lint_depth_short, LINT_ALL},
    // One pass over the bodies for each camera and light.
    {DIAG_UNSEEN, lint_unseen, LINT_ALL},
    {DIAG_UNUSED_MATERIAL, lint_unused_material, LINT_ALL},
    {DIAG_UNUSED_INCLUDE, lint_unused_include, LINT_ALL},
    // A tree for each mesh and a walk for each leaf; then a walk through the common part of each pair of
    // bodies.
    {DIAG_COINCIDENT, lint_coincident, LINT_ALL},
    // One pass over the triangles of each mesh, and a second one with a hash table.
    {DIAG_ZERO_AREA, lint_zero_area, LINT_ALL},
    {DIAG_DUPLICATE_TRIANGLES, lint_duplicates, LINT_ALL},
    // For meshes that refract: a tree and a walk for each leaf; then connected parts.
    {DIAG_SELF_OVERLAP, lint_self_overlap, LINT_ALL},
    {DIAG_INSIDE_OUT, lint_inside_out, LINT_ALL},
    // One pass over the triangles of meshes with normals.
    {DIAG_OPPOSING_NORMALS, lint_opposing_normals, LINT_ALL},
    // The header of one image.
    {DIAG_OVERSIZED_IMAGE, lint_oversized_image, LINT_ALL},
    // Refracting bodies whose boxes overlap; for meshes their common faces. W419 too.
    {DIAG_MEDIA_OVERLAP, lint_media, LINT_ALL},
    // One pass over the bodies.
    {DIAG_NO_EFFECT, lint_attenuation, LINT_ALL},
    // A few thousand rays, or triangles, for each camera and body with an image or a checker that nothing
    // filters.
    {DIAG_TOO_FINE, lint_too_fine, LINT_ALL},
    // One pass over the lights; then one over the bodies for each spherical light.
    {DIAG_FEW_SAMPLES, lint_few_samples, LINT_CHEAP},
    {DIAG_LIGHT_AROUND, lint_light_around, LINT_ALL},
    // One value; one pass over the bodies.
    {DIAG_AMBIENT, lint_ambient, LINT_ALL},
    {DIAG_EMISSION_ALONE, lint_emission, LINT_ALL},
    {DIAG_ONE_SAMPLE, lint_one_sample, LINT_ALL},
    {DIAG_NOTHING_SHARP, lint_nothing_sharp, LINT_ALL},
    // A few places for each refracting body and camera.
    {DIAG_LENS_INSIDE, lint_lens_inside, LINT_ALL},
    // Three values.
    {DIAG_NEVER_ENDS, lint_never_ends, LINT_CHEAP},
    // One value each.
    {DIAG_SKY_SAMPLES, lint_sky_samples, LINT_CHEAP},
    {DIAG_SKY_DARK, lint_sky_dark, LINT_ALL},
    // The boxes of bodies for each panel, up to the first one that it lights.
    {DIAG_PANEL_AWAY, lint_panel_away, LINT_ALL},
    // One pass over cameras and bodies.
    {DIAG_UNUSED_VALUE, lint_unused_value, LINT_ALL},
    // The bodies whose boxes each panel overlaps; for meshes the faces there.
    {DIAG_PANEL_IN_PLANE, lint_panel_in_plane, LINT_ALL},
    // One pass over the bodies; three values.
    {DIAG_BLACK_MEDIUM, lint_black_medium, LINT_ALL},
    {DIAG_STRETCHED, lint_panorama, LINT_CHEAP},
    // For smooth meshes that refract: one pass over the triangles.
    {DIAG_COARSE_GLASS, lint_coarse_glass, LINT_ALL},
    // One pass over bodies, lights and instances.
    {DIAG_SCALED_LAW, lint_scaled, LINT_ALL},
    {.run = NULL},
};

struct run {
    struct lint lint;
    enum lint_level level;
};

static void run_rules(void *context) {
    struct run *run = context;
    lint_collect(&run->lint);
    for (const struct lint_rule *rule = lint_rules; rule->run; rule++)
        if (rule->level <= run->level)
            rule->run(&run->lint);
}

void lint_run(const struct lint_input *input, enum lint_level level) {
    if (level == LINT_NONE)
        return;
    struct arena arena;
    arena_init(&arena, limits_size(input->files->limits, LIMIT_MESH_MEMORY));
    struct run run = {{.input = input,
                       .scene = input->scene,
                       .ir = input->scene->ir,
                       .origin = input->files->origin,
                       .sink = input->files->sink,
                       .arena = &arena},
                      level};
    // Sources that notes need are in the scene's arena.
    struct arena *arenas[] = {&arena, input->files->arena, NULL};
    if (arena_guarded_all(arenas, run_rules, &run) != ARENA_FAULT_NONE)
        diag_add(input->files->sink, DIAG_OUT_OF_MEMORY, SPAN_NONE,
                 "there is not enough memory for the rules that look at meshes");
    arena_finish(&arena);
}
