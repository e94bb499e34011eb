// Random valid scenes, made by walking the table: each one loads without an error.
//
// The same seed and options give the same scene, on every machine. Rows, choices, ranges, names and texts
// come from the table; what a table cannot say (edges not parallel, look_at not at the camera, the number
// of pixels) is mended afterwards on the typed IR (generate_rules.c). Names are of many scripts and look like
// numbers and booleans; texts hold line breaks, quotes and markup; numbers reach the ends of their ranges.
// Ownership: scene and texts live in `arena`, the lists of paths stay the caller's.
// Thread safety: one call belongs to one thread.
#ifndef GLINT_TESTS_GENERATE_GENERATE_H
#define GLINT_TESTS_GENERATE_GENERATE_H

#include "core/arena.h"
#include "core/str.h"

struct ir_scene;

struct generate_paths {
    const str *items;
    uint32_t count;
};

struct generate_options {
    uint64_t seed;
    // Moderate values, a camera that sees the bodies, and a small picture: something to look at.
    bool renderable;
    bool plain; // values are written as they are, none is computed
    // Files that the scene may name; without paths of a kind, nothing names one.
    struct generate_paths meshes, images, fonts, includes;
    // The materials that faces of every mesh in `meshes` use: what material_map may map from. In scenes
    // that are not renderable, map entries have any names.
    struct generate_paths mesh_materials;
};

struct ir_scene *generate_scene(const struct generate_options *options, struct arena *arena);

#endif
