// Triangles of one mesh against each other: each leaf of the tree asks for those that overlap its box.
//
// Each triangle looks for those after it on the curve and marks itself alone, so that the work can be cut.
// Where there are marks, which good meshes have none of, those triangles then mark the others, one by one.
#include "lint/lint_parts.h"

#include "core/parallel.h"

enum {
    PIECE = 1 << 10,         // leaves of one piece of parallel work
    WORK_MAX = 1 << 28,      // for the mesh: boxes against boxes
    LEAF_WORK_MIN = 4096,    // for each leaf: some thousand in a good mesh, all of them in a fan of needles
    LEAF_WORK_MAX = 32768,   // where all triangles lie on each other, a few thousand pairs tell enough
    TRIANGLES_MAX = 1 << 23, // larger meshes are not searched: it would take gigabytes
    PAIR_WORK = 32,          // of two triangles, in boxes
};

struct self {
    const struct lint_tree *tree;
    struct arena *arena;
    double tolerance;
    bool refracts;
    bool is_mutual;          // mark the other triangle too
    struct lint_face *faces; // in the order of the tree
    uint32_t *crossed;       // the same order: the first triangle that crosses, plus 1
    uint32_t *covered;       // the first one in its plane that covers a part of it, plus 1
};

struct leaf {
    const struct self *self;
    uint32_t first, count;
    uint32_t work_left;
    struct lint_box boxes[LINT_LEAF]; // grown by the tolerance
};

static bool has_corner(const struct mesh *mesh, uint32_t triangle, uint32_t merged) {
    const uint32_t *c = mesh->triangles[triangle].corners;
    return mesh->merged[c[0]] == merged || mesh->merged[c[1]] == merged || mesh->merged[c[2]] == merged;
}

// Triangles given twice have a rule of their own.
static bool is_twin(const struct mesh *mesh, uint32_t a, uint32_t b) {
    const uint32_t *c = mesh->triangles[a].corners;
    return has_corner(mesh, b, mesh->merged[c[0]]) && has_corner(mesh, b, mesh->merged[c[1]]) &&
           has_corner(mesh, b, mesh->merged[c[2]]);
}

static void keep_first(uint32_t *mark, uint32_t triangle) {
    if (*mark == 0 || triangle + 1 < *mark)
        *mark = triangle + 1;
}

// Faces of an opaque mesh that lie back to back hide each other.
static bool shows(const struct self *self, const struct lint_face *a, const struct lint_face *b) {
    return self->refracts || vec3_dot(a->normal, b->normal) > 0;
}

static void mark(const struct self *self, uint32_t *marks, uint32_t i, uint32_t j) {
    keep_first(&marks[i], self->tree->order[j]);
    if (self->is_mutual)
        keep_first(&marks[j], self->tree->order[i]);
}

static void test_pair(const struct self *self, uint32_t i, uint32_t j) {
    const struct lint_face *other = &self->faces[j];
    const struct lint_face *own = &self->faces[i];
    if (self->refracts && lint_faces_cross(own, other, self->tolerance))
        mark(self, self->crossed, i, j);
    if (shows(self, own, other) && lint_faces_coincide(own, other, self->tolerance, self->tolerance) &&
        !is_twin(self->tree->mesh, self->tree->order[i], self->tree->order[j]))
        mark(self, self->covered, i, j);
}

static bool visit(void *context, uint32_t first, uint32_t count) {
    struct leaf *leaf = context;
    uint32_t work = leaf->count * count;
    for (uint32_t j = first; j < first + count; j++) {
        struct lint_box box = lint_box_of(&leaf->self->faces[j].t);
        for (uint32_t k = 0; k < leaf->count && leaf->first + k < j; k++)
            if (lint_boxes_overlap(&box, &leaf->boxes[k])) {
                test_pair(leaf->self, leaf->first + k, j);
                work += PAIR_WORK;
            }
    }
    leaf->work_left -= work < leaf->work_left ? work : leaf->work_left;
    return leaf->work_left > 0;
}

static void search_leaf(const struct self *self, uint32_t at) {
    struct leaf leaf = {
        .self = self, .first = at * LINT_LEAF, .work_left = WORK_MAX / self->tree->leaf_count};
    leaf.work_left = leaf.work_left > LEAF_WORK_MIN ? leaf.work_left : LEAF_WORK_MIN;
    leaf.work_left = leaf.work_left < LEAF_WORK_MAX ? leaf.work_left : LEAF_WORK_MAX;
    uint32_t left = self->tree->count - leaf.first;
    leaf.count = left < LINT_LEAF ? left : LINT_LEAF;
    struct lint_box all = lint_box_empty();
    for (uint32_t k = 0; k < leaf.count; k++) {
        leaf.boxes[k] = lint_box_grow(lint_box_of(&self->faces[leaf.first + k].t), self->tolerance);
        all = lint_box_join(all, leaf.boxes[k]);
    }
    lint_tree_in_box_from(self->tree, &all, at, visit, &leaf);
}

static void leaf_piece(void *context, size_t begin, size_t end) {
    for (size_t at = begin; at < end; at++)
        search_leaf(context, (uint32_t)at);
}

static void spread_marks(struct self *self) {
    bool *marked = ARENA_ARRAY(self->arena, bool, self->tree->leaf_count);
    for (uint32_t i = 0; i < self->tree->count; i++)
        marked[i / LINT_LEAF] = marked[i / LINT_LEAF] || self->crossed[i] || self->covered[i];
    self->is_mutual = true;
    for (uint32_t at = 0; at < self->tree->leaf_count; at++)
        if (marked[at])
            search_leaf(self, at);
}

static void face_piece(void *context, size_t begin, size_t end) {
    struct self *self = context;
    for (size_t i = begin; i < end; i++)
        self->faces[i] = lint_face_of(lint_mesh_triangle(self->tree->mesh, self->tree->order[i]));
}

static struct lint_pairs count_pairs(const struct lint_tree *tree, const uint32_t *marks) {
    struct lint_pairs pairs = {0, UINT32_MAX, 0};
    for (uint32_t i = 0; i < tree->count; i++) {
        if (!marks[i])
            continue;
        pairs.count++;
        if (tree->order[i] < pairs.first) {
            pairs.first = tree->order[i];
            pairs.second = marks[i] - 1;
        }
    }
    return pairs;
}

void lint_find_pairs(struct lint *lint, struct lint_mesh *mesh) {
    if (mesh->has_pairs || mesh->mesh->triangle_count > TRIANGLES_MAX)
        return;
    mesh->has_pairs = true;
    struct self self = {.tree = lint_tree_of(lint, mesh),
                        .arena = lint->arena,
                        .tolerance = mesh->tolerance,
                        .refracts = mesh->first_refracting != NULL};
    if (self.tree->count == 0)
        return;
    self.faces = ARENA_ARRAY(lint->arena, struct lint_face, self.tree->count);
    self.crossed = ARENA_ARRAY(lint->arena, uint32_t, self.tree->count);
    self.covered = ARENA_ARRAY(lint->arena, uint32_t, self.tree->count);
    parallel_for(self.tree->count, PIECE * LINT_LEAF, face_piece, &self);
    parallel_for(self.tree->leaf_count, PIECE, leaf_piece, &self);
    spread_marks(&self);
    mesh->crossings = count_pairs(self.tree, self.crossed);
    mesh->overlaps = count_pairs(self.tree, self.covered);
}
