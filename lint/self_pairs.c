// Triangles of one mesh against each other: each leaf of the tree asks for those that overlap its box.
//
// Each triangle looks for those after it on the curve and marks only itself, so that the work can be split.
// Good meshes have no marks; otherwise the marked triangles then mark the others, one by one.
//
// Leaves next to each other on the curve walk the tree together, with the box around all of them; each leaf
// then searches the result, in the order of the curve. Boxes are compared as floats, rounded outward, several
// at a time; possible overlaps are then decided in double precision, so the same pairs are found as without
// floats.
#include "lint/lint_internal.h"

#include "core/parallel.h"

#include <float.h>

enum {
    PIECE = 1 << 10,         // leaves of one piece of parallel work: some groups
    GROUP = 16,              // leaves that walk the tree together
    NEAR_MAX = 1024,         // leaves that a group may find; with more, each walks by itself
    LANES = 8,               // found leaves that are compared at once
    WORK_MAX = 1 << 26,      // for all meshes: boxes against boxes
    LEAF_WORK_MIN = 4096,    // per leaf: some thousand in a good mesh, all in a fan of needles
    LEAF_WORK_MAX = 32768,   // where all triangles lie on each other, a few thousand pairs tell enough
    TRIANGLES_MAX = 1 << 23, // larger meshes are not searched: it would take gigabytes
    PAIR_WORK = 32,          // of two triangles, in boxes
    LEAF_BOXES = LINT_LEAF + LINT_LEAF * LINT_LEAF * PAIR_WORK, // at most, for a leaf against a leaf
};

// Boxes of a leaf's triangles, in floats.
struct quad {
    float lower[3][LINT_LEAF], upper[3][LINT_LEAF];
};

struct self {
    const struct lint_tree *tree;
    struct arena *arena;
    double tolerance;
    bool refracts;
    bool is_mutual;     // mark the other triangle too
    struct quad *quads; // of each leaf
    uint32_t leaf_work; // per leaf, in box tests
    uint32_t *crossed;  // in the order of the tree: the first triangle that crosses, plus 1
    uint32_t *covered;  // the first one in its plane that covers a part of it, plus 1
};

struct leaf {
    const struct self *self;
    uint32_t first, count;
    uint32_t work_left;
    struct lint_face faces[LINT_LEAF];
    struct lint_box boxes[LINT_LEAF]; // grown by the tolerance
    struct lint_box all;              // around them
    struct quad quad;                 // of the grown boxes
};

// What a group of leaves found.
struct near {
    uint32_t count;
    bool is_full;
    uint32_t leaves[NEAR_MAX];
    float lower[3][NEAR_MAX], upper[3][NEAR_MAX];
};

// ---- floats

// Not above and not below x, by at most a few units in the last place; NaN where x is beyond all floats, so
// that no comparison finds the boxes apart.
static float rounded_down(double x) {
    const float f = (float)x;
    return f - fabsf(f) * FLT_EPSILON - FLT_MIN;
}
static float rounded_up(double x) {
    const float f = (float)x;
    return f + fabsf(f) * FLT_EPSILON + FLT_MIN;
}

static void put_box(struct quad *quad, uint32_t k, const struct lint_box *box) {
    const double lower[] = {box->lower.x, box->lower.y, box->lower.z};
    const double upper[] = {box->upper.x, box->upper.y, box->upper.z};
    for (int axis = 0; axis < 3; axis++) {
        quad->lower[axis][k] = rounded_down(lower[axis]);
        quad->upper[axis][k] = rounded_up(upper[axis]);
    }
}

// How far apart two ranges are, in a form that compilers vectorise; not above 0 where they overlap, or where
// it is not a number.
static inline float gap(float lower_a, float upper_a, float lower_b, float upper_b) {
    const float after = lower_a - upper_b;
    const float before = lower_b - upper_a;
    return after > before ? after : before;
}

static inline float widest(float x, float y, float z) {
    const float most = y > z ? y : z;
    return x > most ? x : most;
}

// ---- two triangles

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

// Testing one triangle against the other's plane rules out nearly all neighbours before the second normal is
// computed.
static void test_pair(const struct self *self, const struct leaf *leaf, uint32_t k, uint32_t j,
                      const struct lint_triangle *t) {
    const struct lint_face *own = &leaf->faces[k];
    const uint32_t i = leaf->first + k;
    const bool may_cross = self->refracts && lint_reaches_through(t, own, self->tolerance);
    const bool may_cover = lint_lies_near(t, own, self->tolerance);
    if (!may_cross && !may_cover)
        return;
    const struct lint_face other = lint_face_of(*t);
    if (may_cross && lint_faces_cross(own, &other, self->tolerance))
        mark(self, self->crossed, i, j);
    if (may_cover && shows(self, own, &other) &&
        lint_faces_coincide(own, &other, self->tolerance, self->tolerance) &&
        !is_twin(self->tree->mesh, self->tree->order[i], self->tree->order[j]))
        mark(self, self->covered, i, j);
}

// ---- two leaves

// One bit per box of `quad` that box `j` of `other` may overlap.
static unsigned may_overlap(const struct quad *quad, const struct quad *other, uint32_t j) {
    float gaps[LINT_LEAF];
    unsigned bits = 0;
    for (int k = 0; k < LINT_LEAF; k++)
        gaps[k] = widest(gap(quad->lower[0][k], quad->upper[0][k], other->lower[0][j], other->upper[0][j]),
                         gap(quad->lower[1][k], quad->upper[1][k], other->lower[1][j], other->upper[1][j]),
                         gap(quad->lower[2][k], quad->upper[2][k], other->lower[2][j], other->upper[2][j]));
    for (int k = 0; k < LINT_LEAF; k++)
        bits |= gaps[k] > 0 ? 0u : 1u << k;
    return bits;
}

// Returns how many pairs were tested.
static uint32_t test_triangle(const struct leaf *leaf, uint32_t j, unsigned bits) {
    const struct lint_tree *tree = leaf->self->tree;
    const struct lint_triangle t = lint_mesh_triangle(tree->mesh, tree->order[j]);
    const struct lint_box box = lint_box_of(&t);
    uint32_t pairs = 0;
    for (uint32_t k = 0; k < leaf->count && leaf->first + k < j; k++)
        if ((bits >> k & 1) && lint_boxes_overlap(&box, &leaf->boxes[k])) {
            test_pair(leaf->self, leaf, k, j, &t);
            pairs++;
        }
    return pairs;
}

static bool visit(void *context, uint32_t first, uint32_t count) {
    struct leaf *leaf = context;
    const struct quad *other = &leaf->self->quads[first / LINT_LEAF];
    uint32_t work = leaf->count * count;
    for (uint32_t j = 0; j < count; j++) {
        const unsigned bits = may_overlap(&leaf->quad, other, j);
        if (bits)
            work += PAIR_WORK * test_triangle(leaf, first + j, bits);
    }
    leaf->work_left -= work < leaf->work_left ? work : leaf->work_left;
    return leaf->work_left > 0;
}

static void begin_leaf(const struct self *self, uint32_t at, struct leaf *leaf) {
    const struct lint_tree *tree = self->tree;
    *leaf = (struct leaf){
        .self = self, .first = at * LINT_LEAF, .work_left = self->leaf_work, .all = lint_box_empty()};
    leaf->count = lint_tree_leaf_size(tree, at);
    for (uint32_t k = 0; k < leaf->count; k++) {
        leaf->faces[k] = lint_face_of(lint_mesh_triangle(tree->mesh, tree->order[leaf->first + k]));
        leaf->boxes[k] = lint_box_grow(lint_box_of(&leaf->faces[k].t), self->tolerance);
        leaf->all = lint_box_join(leaf->all, leaf->boxes[k]);
        put_box(&leaf->quad, k, &leaf->boxes[k]);
    }
}

static void search_leaf(const struct self *self, uint32_t at) {
    struct leaf leaf;
    begin_leaf(self, at, &leaf);
    lint_tree_in_box_from(self->tree, &leaf.all, at, visit, &leaf);
}

// ---- groups

struct gathering {
    const struct lint_tree *tree;
    struct near *near;
};

static bool gather(void *context, uint32_t first, uint32_t count) {
    const struct gathering *g = context;
    struct near *near = g->near;
    (void)count;
    near->is_full = near->count == NEAR_MAX;
    if (near->is_full)
        return false;
    const struct lint_box *box = &g->tree->leaves[first / LINT_LEAF];
    const double lower[] = {box->lower.x, box->lower.y, box->lower.z};
    const double upper[] = {box->upper.x, box->upper.y, box->upper.z};
    for (int axis = 0; axis < 3; axis++) {
        near->lower[axis][near->count] = rounded_down(lower[axis]);
        near->upper[axis][near->count] = rounded_up(upper[axis]);
    }
    near->leaves[near->count++] = first / LINT_LEAF;
    return true;
}

// Looks at `LANES` of the found leaves, from `begin` on; false: the leaf stops.
static bool visit_lanes(struct leaf *leaf, const struct near *near, uint32_t begin, const float lower[3],
                        const float upper[3]) {
    const struct lint_tree *tree = leaf->self->tree;
    float gaps[LANES];
    for (uint32_t i = begin; i < begin + LANES; i++)
        gaps[i - begin] = widest(gap(near->lower[0][i], near->upper[0][i], lower[0], upper[0]),
                                 gap(near->lower[1][i], near->upper[1][i], lower[1], upper[1]),
                                 gap(near->lower[2][i], near->upper[2][i], lower[2], upper[2]));
    for (uint32_t i = 0; i < LANES && begin + i < near->count; i++) {
        const uint32_t other = near->leaves[begin + i];
        if (!(gaps[i] > 0) && other * LINT_LEAF >= leaf->first &&
            lint_boxes_overlap(&tree->leaves[other], &leaf->all) &&
            !visit(leaf, other * LINT_LEAF, lint_tree_leaf_size(tree, other)))
            return false;
    }
    return true;
}

static void visit_near(struct leaf *leaf, const struct near *near) {
    const float lower[] = {rounded_down(leaf->all.lower.x), rounded_down(leaf->all.lower.y),
                           rounded_down(leaf->all.lower.z)};
    const float upper[] = {rounded_up(leaf->all.upper.x), rounded_up(leaf->all.upper.y),
                           rounded_up(leaf->all.upper.z)};
    for (uint32_t begin = 0; begin < near->count; begin += LANES)
        if (!visit_lanes(leaf, near, begin, lower, upper))
            return;
}

static void search_group(const struct self *self, uint32_t begin, uint32_t end, struct near *near) {
    struct leaf leaves[GROUP];
    struct lint_box all = lint_box_empty();
    struct gathering gathering = {self->tree, near};
    for (uint32_t at = begin; at < end; at++) {
        begin_leaf(self, at, &leaves[at - begin]);
        all = lint_box_join(all, leaves[at - begin].all);
    }
    near->count = 0;
    lint_tree_in_box_from(self->tree, &all, begin, gather, &gathering);
    for (uint32_t at = begin; at < end; at++) {
        if (near->is_full)
            lint_tree_in_box_from(self->tree, &leaves[at - begin].all, at, visit, &leaves[at - begin]);
        else
            visit_near(&leaves[at - begin], near);
    }
}

static void group_piece(void *context, size_t begin, size_t end) {
    struct near near = {0};
    for (size_t at = begin; at < end; at += GROUP)
        search_group(context, (uint32_t)at, (uint32_t)(end - at < GROUP ? end : at + GROUP), &near);
}

static void quad_piece(void *context, size_t begin, size_t end) {
    const struct self *self = context;
    for (size_t at = begin; at < end; at++)
        for (uint32_t k = 0; k < lint_tree_leaf_size(self->tree, (uint32_t)at); k++) {
            const uint32_t triangle = self->tree->order[at * LINT_LEAF + k];
            const struct lint_triangle t = lint_mesh_triangle(self->tree->mesh, triangle);
            const struct lint_box box = lint_box_of(&t);
            put_box(&self->quads[at], k, &box);
        }
}

// ---- the mesh

static void spread_marks(struct self *self) {
    bool *marked = ARENA_ARRAY(self->arena, bool, self->tree->leaf_count);
    for (uint32_t i = 0; i < self->tree->count; i++)
        marked[i / LINT_LEAF] = marked[i / LINT_LEAF] || self->crossed[i] || self->covered[i];
    self->is_mutual = true;
    for (uint32_t at = 0; at < self->tree->leaf_count; at++)
        if (marked[at])
            search_leaf(self, at);
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

// How much work each leaf of a mesh may take: the first meshes of a scene get the most.
static uint32_t share_work(struct lint *lint, uint32_t leaf_count) {
    const uint64_t left = WORK_MAX - (lint->pairs_spent < WORK_MAX ? lint->pairs_spent : WORK_MAX);
    const uint64_t share = left / leaf_count;
    const uint32_t most = leaf_count < LEAF_WORK_MAX / LEAF_BOXES ? leaf_count * LEAF_BOXES : LEAF_WORK_MAX;
    const uint32_t work = share < LEAF_WORK_MIN   ? LEAF_WORK_MIN
                          : share > LEAF_WORK_MAX ? LEAF_WORK_MAX
                                                  : (uint32_t)share;
    lint->pairs_spent += (uint64_t)leaf_count * (work < most ? work : most);
    return work;
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
    self.leaf_work = share_work(lint, self.tree->leaf_count);
    self.quads = ARENA_ARRAY(lint->arena, struct quad, self.tree->leaf_count);
    self.crossed = ARENA_ARRAY(lint->arena, uint32_t, self.tree->count);
    self.covered = ARENA_ARRAY(lint->arena, uint32_t, self.tree->count);
    parallel_for(self.tree->leaf_count, PIECE, quad_piece, &self);
    parallel_for(self.tree->leaf_count, PIECE, group_piece, &self);
    spread_marks(&self);
    mesh->crossings = count_pairs(self.tree, self.crossed);
    mesh->overlaps = count_pairs(self.tree, self.covered);
}
