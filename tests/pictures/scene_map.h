// A scene whose places, edges and lengths are changed at once: moved, or scaled.
#ifndef GLINT_TESTS_SCENE_MAP_H
#define GLINT_TESTS_SCENE_MAP_H

#include "grammar/ir.h"

// What becomes of what a scene measures in its units; NULL: it stays.
struct scene_map {
    void (*point)(vec3 *point, const void *context);
    void (*vector)(vec3 *edge, const void *context); // edges, sizes, and the scales of models
    void (*length)(double *length, const void *context);
    const void *context;
};

// Cells of a checker are lengths of the bodies whose own material it is, and are changed once for each such
// body; those of a model are measured in its mesh's units, and stay.
void scene_map_apply(struct ir_scene *scene, const struct scene_map *map);

#endif
