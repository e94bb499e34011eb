// A tree of boxes over the triangles of a mesh, in mesh space and double precision.
//
// Triangles are sorted along a Morton curve (Lauterbach and others 2009) and halved by number, so the tree
// has no pointers: the node of leaves [begin, end) is followed by that of its first half. Triangles without
// area are left out. Triangles with the same corners have the same place on the curve, so duplicates are
// among the crowded ones, of which good meshes have few. Ownership: the arena given. Thread safety: immutable
// once built; building uses all processors.
#ifndef GLINT_LINT_TREE_H
#define GLINT_LINT_TREE_H

#include "assets/mesh.h"
#include "core/arena.h"
#include "lint/shape.h"

enum {
    LINT_LEAF = 4, // triangles of a leaf
};

struct lint_tree {
    const struct mesh *mesh;
    uint32_t *order; // of triangles, along the curve
    uint32_t count;
    uint32_t leaf_count;
    struct lint_box *nodes;  // 2 * leaf_count - 1
    struct lint_box *leaves; // those of the leaves again, by number
    uint32_t *crowded;       // triangles that share their place on the curve with others; NULL: too many
    uint32_t crowded_count;
};

static inline uint32_t lint_tree_leaf_size(const struct lint_tree *tree, uint32_t leaf) {
    const uint32_t left = tree->count - leaf * LINT_LEAF;
    return left < LINT_LEAF ? left : LINT_LEAF;
}

void lint_tree_build(struct lint_tree *tree, const struct mesh *mesh, struct arena *arena);

static inline struct lint_triangle lint_mesh_triangle(const struct mesh *mesh, uint32_t triangle) {
    const uint32_t *c = mesh->triangles[triangle].corners;
    return (struct lint_triangle){{mesh->positions[c[0]], mesh->positions[c[1]], mesh->positions[c[2]]}};
}

// Whether the line from `origin` along `direction` (t >= 0) enters the box.
bool lint_box_on_ray(const struct lint_box *box, vec3 origin, vec3 direction);

// Called with each leaf, entries [first, first + count) of `order`, whose box overlaps the query; false ends
// the walk.
typedef bool lint_tree_visit(void *context, uint32_t first, uint32_t count);
void lint_tree_in_box(const struct lint_tree *tree, const struct lint_box *box, lint_tree_visit *visit,
                      void *context);
// The same from leaf `from` on, in the order of the curve.
void lint_tree_in_box_from(const struct lint_tree *tree, const struct lint_box *box, uint32_t from,
                           lint_tree_visit *visit, void *context);
// The leaves that the line from `origin` along `direction` (any length, t >= 0) may hit.
void lint_tree_on_ray(const struct lint_tree *tree, vec3 origin, vec3 direction, lint_tree_visit *visit,
                      void *context);

// How often the mesh surrounds the point: crossings outwards less crossings inwards, along the majority of
// three rays. 0 is outside; for closed meshes only.
int lint_tree_winding(const struct lint_tree *tree, vec3 point);

#endif
