// Triangles of one mesh against each other: each leaf of the tree asks for those that meet its box.
//
// Every triangle looks for all others and marks itself alone, so that the marks do not depend on how the work
// is cut.
#include "runtime/lint/lint_parts.h"

#include "core/parallel.h"

enum {
    PIECE = 1 << 10, // leaves of one piece of parallel work
};

struct self {
    const struct lint_tree *tree;
    double tolerance;
    bool refracts;
    vec3 *normals;     // in the order of the tree
    uint32_t *crossed; // the same order: the first triangle that crosses, plus 1
    uint32_t *covered; // the first one in its plane that covers a part of it, plus 1
};

struct leaf {
    struct self *self;
    uint32_t first, count;
    struct lint_face faces[LINT_LEAF];
    struct lint_box boxes[LINT_LEAF]; // grown by the tolerance
};

static struct lint_face face_at(const struct self *self, uint32_t i) {
    return (struct lint_face){lint_mesh_triangle(self->tree->mesh, self->tree->order[i]), self->normals[i]};
}

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

static void meet(struct leaf *leaf, uint32_t k, uint32_t j, const struct lint_face *other) {
    struct self *self = leaf->self;
    uint32_t i = leaf->first + k;
    uint32_t triangle = self->tree->order[j];
    const struct lint_face *own = &leaf->faces[k];
    if (self->refracts && lint_faces_cross(own, other, self->tolerance))
        keep_first(&self->crossed[i], triangle);
    if (shows(self, own, other) && lint_faces_coincide(own, other, self->tolerance, self->tolerance) &&
        !is_twin(self->tree->mesh, self->tree->order[i], triangle))
        keep_first(&self->covered[i], triangle);
}

static bool visit(void *context, uint32_t first, uint32_t count) {
    struct leaf *leaf = context;
    for (uint32_t j = first; j < first + count; j++) {
        struct lint_face other = face_at(leaf->self, j);
        struct lint_box box = lint_box_of(&other.t);
        for (uint32_t k = 0; k < leaf->count; k++)
            if (leaf->first + k != j && lint_box_meets(&box, &leaf->boxes[k]))
                meet(leaf, k, j, &other);
    }
    return true;
}

static void leaf_piece(void *context, size_t begin, size_t end) {
    struct self *self = context;
    const struct lint_tree *tree = self->tree;
    for (size_t at = begin; at < end; at++) {
        struct leaf leaf = {.self = self, .first = (uint32_t)at * LINT_LEAF};
        leaf.count = tree->count - leaf.first < LINT_LEAF ? tree->count - leaf.first : LINT_LEAF;
        struct lint_box all = lint_box_empty();
        for (uint32_t k = 0; k < leaf.count; k++) {
            leaf.faces[k] = face_at(self, leaf.first + k);
            leaf.boxes[k] = lint_box_grow(lint_box_of(&leaf.faces[k].t), self->tolerance);
            all = lint_box_join(all, leaf.boxes[k]);
        }
        lint_tree_in_box(tree, &all, visit, &leaf);
    }
}

static void normal_piece(void *context, size_t begin, size_t end) {
    struct self *self = context;
    for (size_t i = begin; i < end; i++)
        self->normals[i] = lint_face_of(lint_mesh_triangle(self->tree->mesh, self->tree->order[i])).normal;
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
    if (mesh->has_pairs)
        return;
    mesh->has_pairs = true;
    struct self self = {.tree = lint_tree_of(lint, mesh),
                        .tolerance = mesh->tolerance,
                        .refracts = mesh->first_refracting != IR_NO_INDEX};
    if (self.tree->count == 0)
        return;
    self.normals = ARENA_ARRAY(lint->arena, vec3, self.tree->count);
    self.crossed = ARENA_ARRAY(lint->arena, uint32_t, self.tree->count);
    self.covered = ARENA_ARRAY(lint->arena, uint32_t, self.tree->count);
    parallel_for(self.tree->count, PIECE * LINT_LEAF, normal_piece, &self);
    parallel_for(self.tree->leaf_count, PIECE, leaf_piece, &self);
    mesh->crossings = count_pairs(self.tree, self.crossed);
    mesh->overlaps = count_pairs(self.tree, self.covered);
}
