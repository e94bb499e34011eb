// Faces that lie in the same plane and cover each other: rounding decides which one is seen.
//
// Within a mesh: lint_find_pairs. Between bodies: those at equal places first, then each pair whose boxes
// overlap (body_pairs.c), the faces of the smaller body against the tree of the larger one. Two faces count
// only where a camera could see both: the bottom of a box on a floor is hidden by the box.
#include "diag/codes/rule.h"
#include "lint/body_pairs.h"
#include "lint/lint_internal.h"
#include "scene/media.h"

#include "grammar/ir.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_walk.h"

#include <stdlib.h>
#include <string.h>

// A few units in the last place of single precision at the camera's distance.
#define NEAR 0x1p-22

enum {
    FACES_MAX = 10000000, // faces against faces
};

// ---- within a mesh

static void check_mesh(struct lint *lint, struct lint_mesh *mesh) {
    lint_find_pairs(lint, mesh);
    const struct lint_pairs *pairs = &mesh->overlaps;
    if (pairs->count == 0)
        return;
    diag_add(lint->sink, DIAG_COINCIDENT, lint_place_mesh(lint, mesh->first),
             "%u of the mesh's %u triangles lie in the same plane as others and overlap them", pairs->count,
             mesh->mesh->triangle_count);
    lint_note_mesh(lint, mesh, mesh->mesh->triangles[pairs->first].line, "the first is this face");
    lint_note_mesh(lint, mesh, mesh->mesh->triangles[pairs->second].line, "which overlaps this one");
    diag_help(lint->sink, "remove one of the faces, or move it by a visible amount");
}

// ---- bodies at equal places

// What a body's place and shape depend on. All fields have the same width, even where pointers are narrower:
// there is no padding, whose bytes would count.
struct place {
    affine3 object_to_world;
    double radius, radius_to, height;
    uint64_t mesh; // its address
    uint64_t shape;
};

struct place_key {
    uint64_t hash;
    uint32_t body;
};

static struct place place_of(const struct lint *lint, uint32_t index) {
    const struct scene_body *body = lint->bodies[index].is;
    return (struct place){body->object_to_world, body->radius,          body->radius_to,
                          body->height,          (uintptr_t)body->mesh, body->shape};
}

static bool is_same_place(const struct lint *lint, uint32_t a, uint32_t b) {
    struct place x = place_of(lint, a);
    struct place y = place_of(lint, b);
    return memcmp(&x, &y, sizeof x) == 0;
}

static struct place_key key_of(const struct lint *lint, uint32_t body) {
    struct place place = place_of(lint, body);
    return (struct place_key){str_hash((str){(const char *)&place, sizeof place}), body};
}

static int compare_keys(const void *a, const void *b) {
    const struct place_key *x = a;
    const struct place_key *y = b;
    if (x->hash != y->hash)
        return x->hash < y->hash ? -1 : 1;
    return x->body < y->body ? -1 : x->body > y->body;
}

// Of two copies that which is written first, so that copies of two entries are reported at one of them.
static bool comes_first(const struct lint *lint, const struct lint_body *a, const struct lint_body *b) {
    const span x = lint_place(lint, a), y = lint_place(lint, b);
    if ((!lint_is_copy(lint, a) && !lint_is_copy(lint, b)) || x.source != y.source || x.begin == y.begin)
        return a < b;
    return x.begin < y.begin;
}

static void report_repeat(struct lint *lint, const struct lint_body *one, const struct lint_body *two) {
    const struct lint_body *other = comes_first(lint, one, two) ? one : two;
    const struct lint_body *body = other == one ? two : one;
    const span at = lint_place(lint, body), there = lint_place(lint, other);
    const bool is_one_entry = at.source == there.source && at.begin == there.begin; // both are its copies
    const str words = lint_words(lint, body);
    if (is_one_entry) {
        diag_add(lint->sink, DIAG_COINCIDENT, at, "%.*s is at exactly the same place as %.*s", STR_ARG(words),
                 STR_ARG(lint_words_other(lint, other)));
        diag_help(lint->sink,
                  "use every variable of 'for' where the body is, or keep one of the copies with 'if'");
        return;
    }
    diag_add(lint->sink, DIAG_COINCIDENT, at, "%.*s is at exactly the same place as another one",
             STR_ARG(words));
    if (lint_is_copy(lint, other))
        diag_note(lint->sink, there, "this is the other one: %.*s", STR_ARG(lint_words_other(lint, other)));
    else
        diag_note(lint->sink, there, "this is the other one");
    diag_help(lint->sink, "remove one of the two, or move it");
}

static bool *find_repeats(struct lint *lint) {
    struct place_key *keys = ARENA_ARRAY(lint->arena, struct place_key, lint->body_count);
    bool *repeats = ARENA_ARRAY(lint->arena, bool, lint->body_count);
    uint32_t count = 0;
    for (uint32_t i = 0; i < lint->body_count; i++)
        if (lint_is_there(&lint->bodies[i]))
            keys[count++] = key_of(lint, i);
    qsort(keys, count, sizeof *keys, compare_keys);
    for (uint32_t i = 1, first = 0; i < count; i++) {
        if (keys[first].hash != keys[i].hash || !is_same_place(lint, keys[first].body, keys[i].body)) {
            first = i;
            continue;
        }
        repeats[keys[i].body] = true;
        report_repeat(lint, &lint->bodies[keys[i].body], &lint->bodies[keys[first].body]);
    }
    return repeats;
}

// ---- faces of two bodies

struct search {
    struct lint *lint;
    const struct lint_body *a, *b; // faces of `a` against those of `b`
    affine3 back_b;                // into the object space of its mesh
    struct lint_box own, other; // parts of `a` and `b` that can count, in the object spaces of their meshes
    struct lint_face face;      // of `a`, in scene units
    uint32_t triangle;          // of `a`
    double near;
    uint64_t *work_left;
    uint32_t count;
    uint32_t first_a, first_b; // triangles of the first pair
};

static bool shows(const struct lint_body *body, const struct lint_face *face,
                  const struct view_camera *camera) {
    if (!body->is->closed || !body->is_opaque)
        return true;
    const bool is_parallel = camera->projection == IR_PROJECTION_ORTHOGRAPHIC;
    const vec3 way = vec3_sub(camera->position, face->t.p[0]);
    double facing = vec3_dot(face->normal, is_parallel ? vec3_neg(camera->forward) : way);
    return body->is->mirrored ? facing < 0 : facing > 0;
}

static bool both_show(const struct search *s, const struct lint_face *other) {
    for (uint32_t i = 0; i < s->lint->view_count; i++) {
        const struct view_camera *camera = &s->lint->views[i].camera;
        if (shows(s->a, &s->face, camera) && shows(s->b, other, camera))
            return true;
    }
    return false;
}

static void compare_faces(struct search *s, struct lint_triangle triangle, uint32_t index) {
    struct lint_face other = lint_face_of(triangle);
    if (!lint_faces_coincide(&s->face, &other, s->near, 16 * s->near) || !both_show(s, &other))
        return;
    if (s->count == 0 || s->triangle < s->first_a || (s->triangle == s->first_a && index < s->first_b)) {
        s->first_a = s->triangle;
        s->first_b = index;
    }
    s->count++;
}

// Leaves hold several triangles, most of which lie outside the box that is searched.
static bool is_in(const struct lint_triangle *t, const struct lint_box *box) {
    const struct lint_box own = lint_box_of(t);
    return lint_boxes_overlap(&own, box);
}

static bool visit_other(void *context, uint32_t first, uint32_t count) {
    struct search *s = context;
    const struct lint_tree *tree = &s->b->mesh->tree;
    for (uint32_t i = first; i < first + count; i++) {
        struct lint_triangle t = lint_mesh_triangle(tree->mesh, tree->order[i]);
        if (!is_in(&t, &s->other))
            continue;
        compare_faces(s, lint_triangle_place(t, &s->b->is->object_to_world), tree->order[i]);
    }
    *s->work_left -= *s->work_left < count ? *s->work_left : count;
    return *s->work_left > 0;
}

static void search_face(struct search *s, struct lint_triangle triangle, uint32_t index) {
    s->face = lint_face_of(triangle);
    s->triangle = index;
    struct lint_triangle flat[LINT_FLAT_TRIANGLES];
    uint32_t count = lint_flat_triangles(s->b, flat);
    for (uint32_t i = 0; i < count; i++)
        compare_faces(s, flat[i], i);
    if (count)
        return;
    struct lint_box box = lint_box_grow(lint_box_of(&triangle), s->near);
    s->other = lint_box_place(box, &s->back_b);
    lint_tree_in_box(lint_tree_of(s->lint, s->b->mesh), &s->other, visit_other, s);
}

static bool visit_own(void *context, uint32_t first, uint32_t count) {
    struct search *s = context;
    const struct lint_tree *tree = &s->a->mesh->tree;
    for (uint32_t i = first; i<first + count && * s->work_left> 0; i++) {
        struct lint_triangle t = lint_mesh_triangle(tree->mesh, tree->order[i]);
        if (!is_in(&t, &s->own))
            continue;
        search_face(s, lint_triangle_place(t, &s->a->is->object_to_world), tree->order[i]);
        *s->work_left -= *s->work_left > 0;
    }
    return *s->work_left > 0;
}

static void report(struct search *s) {
    const struct lint_body *first = comes_first(s->lint, s->a, s->b) ? s->a : s->b;
    const struct lint_body *second = first == s->a ? s->b : s->a;
    struct lint *lint = s->lint;
    diag_add(lint->sink, DIAG_COINCIDENT, lint_place(lint, second),
             "faces of %.*s and of %.*s lie in the same plane and overlap: only one of them is seen there",
             STR_ARG(lint_words(lint, second)), STR_ARG(lint_words_other(lint, first)));
    diag_note(lint->sink, lint_place(lint, first), "%u pair%s of triangles with this body", s->count,
              s->count == 1 ? "" : "s");
    if (s->a->mesh)
        lint_note_mesh(lint, s->a->mesh, s->a->mesh->mesh->triangles[s->first_a].line,
                       "the first is this face");
    if (s->b->mesh)
        lint_note_mesh(lint, s->b->mesh, s->b->mesh->mesh->triangles[s->first_b].line,
                       s->a->mesh ? "with this one" : "the first is this face");
    if (scene_is_medium(lint->scene, first->is) && scene_is_medium(lint->scene, second->is))
        diag_help(lint->sink,
                  "let one reach into the other, and give the material of the one that fills that place the "
                  "higher 'priority'");
    else
        diag_help(lint->sink, "move one of the bodies by a visible amount");
}

static double farthest(const struct lint *lint, const struct lint_box *box) {
    vec3 eye = lint->views[0].camera.position;
    return fmax(vec3_max_abs(vec3_sub(box->lower, eye)), vec3_max_abs(vec3_sub(box->upper, eye)));
}

static void check_pair(struct lint *lint, const struct lint_body *a, const struct lint_body *b,
                       uint64_t *work_left) {
    struct search s = {.lint = lint, .a = a, .b = b, .work_left = work_left};
    if (b->is->triangle_count < a->is->triangle_count) {
        s.a = b;
        s.b = a;
    }
    if (s.b->mesh)
        s.back_b = transform_inverse(s.b->is->object_to_world);
    struct lint_box common = {vec3_max(a->box.lower, b->box.lower), vec3_min(a->box.upper, b->box.upper)};
    s.near = NEAR * farthest(lint, &common);
    common = lint_box_grow(common, s.near);
    struct lint_triangle flat[LINT_FLAT_TRIANGLES];
    uint32_t count = lint_flat_triangles(s.a, flat);
    for (uint32_t i = 0; i < count; i++)
        search_face(&s, flat[i], i);
    if (s.a->mesh) {
        affine3 back = transform_inverse(s.a->is->object_to_world);
        s.own = lint_box_place(common, &back);
        lint_tree_in_box(lint_tree_of(lint, s.a->mesh), &s.own, visit_own, &s);
    }
    if (s.count)
        report(&s);
}

struct work {
    struct lint *lint;
    uint64_t left; // faces
};

static bool take_pair(void *context, const struct lint_body *a, const struct lint_body *b) {
    struct work *work = context;
    check_pair(work->lint, a, b, &work->left);
    return work->left > 0;
}

void lint_coincident(struct lint *lint) {
    for (uint32_t i = 0; i < lint->meshes.count; i++)
        check_mesh(lint, lint->meshes.items[i]);
    const bool *repeats = find_repeats(lint);
    uint32_t count = 0;
    for (uint32_t i = 0; i < lint->body_count; i++)
        count += !repeats[i] && lint->bodies[i].is->triangle_count;
    struct lint_box_item *flat = ARENA_ARRAY(lint->arena, struct lint_box_item, count);
    count = 0;
    for (uint32_t i = 0; i < lint->body_count; i++) {
        const struct lint_body *body = &lint->bodies[i];
        if (!repeats[i] && body->is->triangle_count)
            flat[count++] =
                (struct lint_box_item){lint_box_grow(body->box, NEAR * farthest(lint, &body->box)), body};
    }
    struct work work = {lint, FACES_MAX};
    lint_body_pairs(lint->arena, flat, count, take_pair, &work);
}
