// Refracting bodies that share a part of space: which of them fills it, and whether their indices are meant
// as they are written.
//
// Pairs whose boxes overlap (body_pairs.c). Spheres are compared by their distance; a sphere and a mesh by
// the mesh's nearest and farthest points; two meshes by faces that cut each other, and else by points just
// below the faces of one that are inside the other; a cone by its distance from a sphere's centre, and else
// by points of one that are inside the other. Bodies that touch count as apart: an overlap within a fraction
// of the smaller one's size is touching, since values written with few digits overlap by a hair.
#include "core/angle.h"
#include "diag/codes/limit.h"
#include "diag/codes/rule.h"
#include "lint/body_pairs.h"
#include "lint/box_tree.h"
#include "lint/lint_internal.h"

#include "grammar/ir.h"
#include "scene/media.h"
#include "scene/shape.h"

#include <stdlib.h>

#define TOUCHING 0x1p-12 // of the size of the smaller body

enum {
    FACES_MAX = 10000000,  // of meshes that are looked at
    CROWDS_MAX = 20000000, // bodies around cameras: later cameras are not looked at
    SAMPLES = 512,         // points of one mesh that the search tries in another
    NOTED = 3,             // other bodies that one finding names
};

enum finding {
    FINDING_NONE,
    FINDING_EQUAL,    // they cross with equal priority: the ray's origin decides which one fills the overlap
    FINDING_HIDDEN,   // the inner one's priority is lower: it is never seen
    FINDING_RELATIVE, // the inner one's index is below 1: it was meant relative to the outer one's
};

enum relation {
    APART,
    CROSSES,
    INSIDE, // the first is inside the second
    AROUND, // the second is inside the first
};

struct overlap {
    const struct lint_body *body, *other; // inside it, or before it in the file
    enum relation relation;               // CROSSES or INSIDE
    enum finding finding;
};

struct media {
    struct lint *lint;
    uint64_t work_left;      // faces left to test
    uint32_t *around;        // by body: how many others it is inside
    int32_t highest, lowest; // extreme priorities so far, including those advised
    struct {
        struct overlap *items;
        uint32_t count, capacity;
    } found;
};

struct pair {
    struct media *media;
    const struct lint_body *a, *b;
    double tolerance;
};

// ---- which bodies

// The material that fills the body.
static const struct scene_material *filling(const struct lint *lint, const struct lint_body *body) {
    return &lint->scene->materials[scene_medium_material(lint->scene, body->is)];
}

static const struct ir_material *filling_in_file(const struct lint *lint, const struct lint_body *body) {
    return &lint->scene->assets->materials[scene_medium_material(lint->scene, body->is)];
}

static bool is_medium(const struct lint *lint, const struct lint_body *body) {
    return lint_is_there(body) && scene_is_medium(lint->scene, body->is);
}

static double size_of(const struct lint_body *body) {
    return vec3_max_abs(vec3_sub(body->box.upper, body->box.lower));
}

static double tolerance_of(const struct lint_body *a, const struct lint_body *b) {
    double far_a = fmax(vec3_max_abs(a->box.lower), vec3_max_abs(a->box.upper));
    double far_b = fmax(vec3_max_abs(b->box.lower), vec3_max_abs(b->box.upper));
    return fmax(LINT_RESOLUTION * fmax(far_a, far_b), TOUCHING * fmin(size_of(a), size_of(b)));
}

// ---- spheres

static enum relation spheres(const struct pair *p) {
    double ra = p->a->is->radius;
    double rb = p->b->is->radius;
    double distance =
        vec3_length(vec3_sub(p->a->is->object_to_world.offset, p->b->is->object_to_world.offset));
    if (distance >= ra + rb - p->tolerance)
        return APART;
    if (distance > fabs(ra - rb) + p->tolerance)
        return CROSSES;
    return ra < rb ? INSIDE : AROUND;
}

// ---- a sphere and a mesh

struct approach {
    const struct lint_tree *tree;
    affine3 object_to_world;
    vec3 point;
    double nearest;
    uint64_t *work_left;
};

static bool come_near(void *context, uint32_t first, uint32_t count) {
    struct approach *approach = context;
    for (uint32_t i = first; i < first + count; i++) {
        struct lint_triangle t = lint_mesh_triangle(approach->tree->mesh, approach->tree->order[i]);
        t = lint_triangle_place(t, &approach->object_to_world);
        approach->nearest = fmin(approach->nearest, lint_triangle_distance(&t, approach->point));
    }
    *approach->work_left -= *approach->work_left < count ? *approach->work_left : count;
    return *approach->work_left > 0;
}

// Whether all of the mesh is nearer to the point than `distance`.
static bool is_within(const struct lint_body *body, vec3 point, double distance) {
    const struct mesh *mesh = body->mesh->mesh;
    for (uint32_t i = 0; i < mesh->position_count; i++) {
        vec3 at = affine3_apply(body->is->object_to_world, mesh->positions[i]);
        if (vec3_length(vec3_sub(at, point)) > distance)
            return false;
    }
    return true;
}

// `a` is the sphere.
static enum relation sphere_and_mesh(const struct pair *p) {
    struct lint *lint = p->media->lint;
    vec3 center = p->a->is->object_to_world.offset;
    double radius = p->a->is->radius;
    struct approach approach = {lint_tree_of(lint, p->b->mesh), p->b->is->object_to_world, center, INFINITY,
                                &p->media->work_left};
    affine3 back = transform_inverse(p->b->is->object_to_world);
    struct lint_box around = lint_box_place(p->a->box, &back);
    lint_tree_in_box(approach.tree, &around, come_near, &approach);
    if (approach.nearest >= radius - p->tolerance)
        return lint_is_inside(lint, p->b, center) ? INSIDE : APART;
    p->media->work_left -= p->media->work_left < p->b->mesh->mesh->position_count
                               ? p->media->work_left
                               : p->b->mesh->mesh->position_count;
    return is_within(p->b, center, radius + p->tolerance) ? AROUND : CROSSES;
}

// ---- two meshes

struct cutting {
    const struct pair *pair;
    affine3 back_b; // into the object space of b's mesh
    struct lint_face face;
    bool cuts;
};

static bool cut_other(void *context, uint32_t first, uint32_t count) {
    struct cutting *c = context;
    const struct lint_tree *tree = &c->pair->b->mesh->tree;
    for (uint32_t i = first; i < first + count && !c->cuts; i++) {
        struct lint_triangle t = lint_mesh_triangle(tree->mesh, tree->order[i]);
        struct lint_face other = lint_face_of(lint_triangle_place(t, &c->pair->b->is->object_to_world));
        c->cuts = lint_faces_cross(&c->face, &other, c->pair->tolerance);
    }
    uint64_t *left = &c->pair->media->work_left;
    *left -= *left < count ? *left : count;
    return !c->cuts && *left > 0;
}

static bool cut_own(void *context, uint32_t first, uint32_t count) {
    struct cutting *c = context;
    const struct lint_tree *tree = &c->pair->a->mesh->tree;
    for (uint32_t i = first; i < first + count && !c->cuts; i++) {
        struct lint_triangle t = lint_mesh_triangle(tree->mesh, tree->order[i]);
        c->face = lint_face_of(lint_triangle_place(t, &c->pair->a->is->object_to_world));
        struct lint_box box = lint_box_of(&c->face.t);
        box = lint_box_place(box, &c->back_b);
        lint_tree_in_box(&c->pair->b->mesh->tree, &box, cut_other, c);
    }
    return !c->cuts && c->pair->media->work_left > 0;
}

static bool cut_each_other(const struct pair *p) {
    struct cutting c = {.pair = p, .back_b = transform_inverse(p->b->is->object_to_world)};
    struct lint_box common = {vec3_max(p->a->box.lower, p->b->box.lower),
                              vec3_min(p->a->box.upper, p->b->box.upper)};
    affine3 back = transform_inverse(p->a->is->object_to_world);
    struct lint_box own = lint_box_place(common, &back);
    lint_tree_of(p->media->lint, p->b->mesh);
    lint_tree_in_box(lint_tree_of(p->media->lint, p->a->mesh), &own, cut_own, &c);
    return c.cuts;
}

// Whether a point just below a face of `body` is inside `other`; *all: whether every point tried is.
static bool is_some_inside(const struct pair *p, const struct lint_body *body, const struct lint_body *other,
                           bool *all) {
    struct lint *lint = p->media->lint;
    const struct lint_tree *tree = lint_tree_of(lint, body->mesh);
    uint32_t step = tree->count / SAMPLES + 1;
    bool some = false;
    *all = true;
    for (uint32_t i = 0; i < tree->count; i += step) {
        struct lint_triangle t = lint_mesh_triangle(tree->mesh, tree->order[i]);
        struct lint_face face = lint_face_of(lint_triangle_place(t, &body->is->object_to_world));
        vec3 middle = vec3_mul(vec3_add(vec3_add(face.t.p[0], face.t.p[1]), face.t.p[2]), 1.0 / 3);
        double depth = body->is->mirrored ? -2 * p->tolerance : 2 * p->tolerance;
        vec3 below = vec3_sub(middle, vec3_mul(face.normal, depth));
        if (!lint_is_inside(lint, body, below))
            continue; // a wall thinner than that
        bool inside = lint_is_inside(lint, other, below);
        some = some || inside;
        *all = *all && inside;
    }
    return some;
}

// Whether points of one body, or all of them, are inside the other. Water whose surface lies in the wall of
// its glass: the other side of the wall is in the water.
static enum relation by_points(bool a_in_b, bool all_a, bool b_in_a, bool all_b) {
    if (a_in_b && b_in_a)
        return CROSSES;
    if (a_in_b)
        return all_a ? INSIDE : CROSSES;
    if (b_in_a)
        return all_b ? AROUND : CROSSES;
    return APART;
}

static enum relation meshes(const struct pair *p) {
    bool all_a, all_b;
    if (cut_each_other(p))
        return CROSSES;
    const bool a_in_b = is_some_inside(p, p->a, p->b, &all_a), b_in_a = is_some_inside(p, p->b, p->a, &all_b);
    return by_points(a_in_b, all_a, b_in_a, all_b);
}

// ---- cones

// `a` is the cone. It is inside the sphere if its rims are, of which a point opposite the centre is the
// farthest.
static enum relation cone_and_sphere(const struct pair *p) {
    const struct shape_cone cone = shape_cone_of(p->a->is);
    const vec3 center = p->b->is->object_to_world.offset, to = vec3_sub(center, cone.from);
    const double radius = p->b->is->radius, distance = shape_cone_distance(&cone, center);
    const double y = vec3_dot(to, cone.axis), away = vec3_length(vec3_sub(to, vec3_mul(cone.axis, y)));
    if (distance >= radius - p->tolerance)
        return APART;
    if (distance <= p->tolerance - radius)
        return AROUND;
    const double farthest = fmax(hypot(y, away + cone.radius), hypot(cone.height - y, away + cone.radius_to));
    return farthest <= radius + p->tolerance ? INSIDE : CROSSES;
}

// A point just below the surface of a cone, of ROUNDS at each of LEVELS heights.
enum {
    ROUNDS = 32,
    LEVELS = 16,
};
static vec3 below_side(const struct scene_body *body, uint32_t i, double depth) {
    const double share = (i / ROUNDS) / (LEVELS - 1.0), turn = 2 * PI * (i % ROUNDS) / ROUNDS;
    const double y = fmin(fmax(share * body->height, depth), fmax(body->height - depth, 0));
    const double side = body->radius + (body->radius_to - body->radius) * (y / body->height);
    const double slant = hypot(1, (body->radius_to - body->radius) / body->height);
    const double r = fmax(side - depth * slant, 0);
    return affine3_apply(body->object_to_world, (vec3){r * cos(turn), y, r * sin(turn)});
}

// Whether a point of a cone's or a mesh's surface is deep inside the other one; *all: whether every point
// tried is.
static bool has_inside(const struct pair *p, const struct lint_body *of, const struct lint_body *other,
                       bool *all) {
    const bool is_mesh = of->mesh != NULL;
    const uint32_t count = is_mesh ? of->mesh->mesh->position_count : ROUNDS * LEVELS;
    const uint32_t step = count / (ROUNDS * LEVELS) + 1;
    bool some = false;
    *all = true;
    for (uint32_t i = 0; i < count; i += step) {
        const vec3 at = is_mesh ? affine3_apply(of->is->object_to_world, of->mesh->mesh->positions[i])
                                : below_side(of->is, i, 2 * p->tolerance);
        bool inside = lint_is_inside(p->media->lint, other, at);
        if (other->is->shape == SCENE_CONE) {
            const struct shape_cone cone = shape_cone_of(other->is);
            inside = shape_cone_distance(&cone, at) < -2 * p->tolerance;
        }
        some = some || inside;
        *all = *all && inside;
    }
    return some;
}

// `a` is the cone; the other one a cone or a mesh. Bodies that cross without a point of one in the other are
// missed.
static enum relation cone_and_other(const struct pair *p) {
    bool all_a, all_b;
    const bool a_in_b = has_inside(p, p->a, p->b, &all_a), b_in_a = has_inside(p, p->b, p->a, &all_b);
    return by_points(a_in_b, all_a, b_in_a, all_b);
}

// ---- pairs

// Those at exactly the same place are reported as such (W410).
static bool is_same_place(const struct lint_body *a, const struct lint_body *b) {
    const affine3 *x = &a->is->object_to_world;
    const affine3 *y = &b->is->object_to_world;
    bool same = a->is->shape == b->is->shape && a->mesh == b->mesh && a->is->radius == b->is->radius &&
                a->is->radius_to == b->is->radius_to && a->is->height == b->is->height &&
                vec3_is_zero(vec3_sub(x->offset, y->offset));
    for (int i = 0; i < 9 && a->is->shape != SCENE_SPHERE; i++)
        same = same && x->linear.m[i / 3][i % 3] == y->linear.m[i / 3][i % 3];
    return same;
}

typedef enum relation compare_pair(const struct pair *p);

// How two shapes are compared; NULL: as the other way round. Of media, which are never parallelograms.
static compare_pair *way_to_compare(enum scene_shape a, enum scene_shape b) {
    switch (a) {
    case SCENE_SPHERE:
        return b == SCENE_SPHERE ? spheres : b == SCENE_MESH ? sphere_and_mesh : NULL;
    case SCENE_CONE:
        return b == SCENE_SPHERE ? cone_and_sphere : cone_and_other;
    case SCENE_PARALLELOGRAM:
    case SCENE_MESH:
        break;
    }
    return b == SCENE_MESH ? meshes : NULL;
}

static enum relation relation_of(const struct pair *p) {
    if (is_same_place(p->a, p->b))
        return APART;
    compare_pair *way = way_to_compare(p->a->is->shape, p->b->is->shape);
    if (way)
        return way(p);
    const struct pair turned = {p->media, p->b, p->a, p->tolerance};
    enum relation relation = way_to_compare(p->b->is->shape, p->a->is->shape)(&turned);
    return relation == INSIDE ? AROUND : relation == AROUND ? INSIDE : relation;
}

// No natural material has an index below 1: inside another body it is meant relative to that body's index.
static enum finding judge(const struct lint *lint, const struct overlap *overlap) {
    const struct scene_material *own = filling(lint, overlap->body), *other = filling(lint, overlap->other);
    if (scene_compare_media(own, other) == 0)
        return FINDING_NONE;
    if (overlap->relation == CROSSES)
        return own->priority == other->priority ? FINDING_EQUAL : FINDING_NONE;
    if (own->priority < other->priority)
        return FINDING_HIDDEN;
    return own->refractive_index < 1 && other->refractive_index > 1 ? FINDING_RELATIVE : FINDING_NONE;
}

static bool take_pair(void *context, const struct lint_body *a, const struct lint_body *b) {
    struct media *media = context;
    if (a > b) {
        const struct lint_body *first = b;
        b = a;
        a = first;
    }
    const struct pair pair = {media, b, a, tolerance_of(a, b)}; // the later one is the first: it is reported
    struct overlap overlap = {b, a, relation_of(&pair), FINDING_NONE};
    if (overlap.relation == AROUND)
        overlap = (struct overlap){a, b, INSIDE, FINDING_NONE};
    if (overlap.relation == INSIDE)
        media->around[overlap.body - media->lint->bodies]++;
    if (overlap.relation != APART)
        overlap.finding = judge(media->lint, &overlap);
    if (overlap.finding != FINDING_NONE)
        *ARENA_PUSH(media->lint->arena, &media->found) = overlap;
    return media->work_left > 0;
}

// ---- reporting

static int compare_overlaps(const void *left, const void *right) {
    const struct overlap *x = left;
    const struct overlap *y = right;
    if (x->body != y->body)
        return x->body < y->body ? -1 : 1;
    if (x->finding != y->finding)
        return x->finding < y->finding ? -1 : 1;
    return x->other < y->other ? -1 : x->other > y->other;
}

// A drink compared with its glass, or with the ice in it: it is larger than the bodies that it gives way to.
static bool gives_way(const struct media *media, const struct overlap *first, uint32_t count) {
    bool all = media->around[first->body - media->lint->bodies] == 0;
    for (uint32_t i = 0; i < count && all; i++)
        all = shape_volume(first->body->is) > shape_volume(first[i].other->is);
    return all;
}

// Above or below all others, so that following one piece of advice does not require another.
static void advise_priority(struct media *media, const struct overlap *first, uint32_t count) {
    struct lint *lint = media->lint;
    const bool lower = gives_way(media, first, count);
    media->highest += !lower && media->highest < SCENE_PRIORITY_MAX;
    media->lowest -= lower && media->lowest > -SCENE_PRIORITY_MAX;
    const int32_t priority = lower ? media->lowest : media->highest;
    diag_help(lint->sink, "give the material of the one that %s a %s one, such as priority: %d",
              lower ? "gives way there" : "fills that place", lower ? "lower" : "higher", priority);
    lint_fix_row(lint, &filling_in_file(lint, first->body)->head, &SCHEMA_MATERIAL, "priority",
                 "refractive_index", arena_format(lint->arena, "%d", priority).ptr);
}

static void report_equal(struct media *media, const struct overlap *first, uint32_t count) {
    struct lint *lint = media->lint;
    const struct lint_body *body = first->body;
    const int priority = filling(lint, body)->priority;
    str words = lint_words(lint, body);
    if (count == 1)
        diag_add(lint->sink, DIAG_MEDIA_OVERLAP, lint_place(lint, body),
                 "%.*s crosses %.*s, and both refract with priority %d: what fills the place that they share "
                 "depends on "
                 "where a ray comes from",
                 STR_ARG(words), STR_ARG(lint_words_other(lint, first->other)), priority);
    else
        diag_add(lint->sink, DIAG_MEDIA_OVERLAP, lint_place(lint, body),
                 "%.*s crosses %u other bodies that refract with the same priority, %d: what fills the "
                 "places that they "
                 "share depends on where a ray comes from",
                 STR_ARG(words), count, priority);
    for (uint32_t i = 0; i < count && i < NOTED; i++)
        diag_note(lint->sink, lint_place(lint, first[i].other), "it crosses %.*s",
                  STR_ARG(lint_words_other(lint, first[i].other)));
    if (count > NOTED)
        diag_note(lint->sink, SPAN_NONE, "and %u more", count - NOTED);
    advise_priority(media, first, count);
}

static void report_hidden(struct lint *lint, const struct overlap *found) {
    const struct lint_body *body = found->body;
    const int other = filling(lint, found->other)->priority;
    diag_add(lint->sink, DIAG_MEDIA_OVERLAP, lint_place(lint, body),
             "%.*s is inside %.*s, which refracts with a higher priority, %d: it is never seen",
             STR_ARG(lint_words(lint, body)), STR_ARG(lint_words_other(lint, found->other)), other);
    diag_note(lint->sink, lint_place(lint, found->other), "it is inside %.*s",
              STR_ARG(lint_words_other(lint, found->other)));
    diag_help(lint->sink, "write priority: %d for its material, or leave both out", other);
    lint_fix_row(lint, &filling_in_file(lint, body)->head, &SCHEMA_MATERIAL, "priority", "refractive_index",
                 arena_format(lint->arena, "%d", other).ptr);
}

static void report_relative(struct lint *lint, const struct overlap *found) {
    const struct lint_body *body = found->body;
    const double own = filling(lint, body)->refractive_index;
    const double right = own * filling(lint, found->other)->refractive_index;
    const struct ir_material *material = filling_in_file(lint, body);
    const span at = material->head.origin == 0
                        ? lint_place(lint, body)
                        : ir_place_value(lint->origin, &material->head, &SCHEMA_MATERIAL, "refractive_index");
    diag_add(lint->sink, DIAG_RELATIVE_INDEX, at,
             "the index %.6g looks relative to that of %.*s, which %.*s is inside: rays know that, so light "
             "is bent twice",
             own, STR_ARG(lint_words_other(lint, found->other)), STR_ARG(lint_words_other(lint, body)));
    diag_note(lint->sink, lint_place(lint, body), "%.*s has this material", STR_ARG(lint_words(lint, body)));
    diag_help(lint->sink, "write its own index: refractive_index: %.3g", right);
    lint_fix_row(lint, &material->head, &SCHEMA_MATERIAL, "refractive_index", "refractive_index",
                 arena_format(lint->arena, "%.3g", right).ptr);
}

// A ray there would be inside all of them.
static void report_nested(struct lint *lint, const struct media *media) {
    for (uint32_t i = 0; i < lint->body_count; i++) {
        if (media->around[i] < SCENE_MEDIA_MOST)
            continue;
        diag_add(lint->sink, DIAG_LIMIT, lint_place(lint, &lint->bodies[i]),
                 "%.*s is inside %u other bodies that refract; at most %d may surround a ray",
                 STR_ARG(lint_words(lint, &lint->bodies[i])), media->around[i], SCENE_MEDIA_MOST);
        diag_help(lint->sink, "leave some of them out, or join those of one material into one mesh");
        return;
    }
}

static bool count_box(void *context, const void *of) {
    (void)of;
    return ++*(uint32_t *)context <= SCENE_MEDIA_MOST;
}

static void find_media(struct lint *lint, struct lint_box_tree *tree) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < lint->body_count; i++)
        count += scene_is_medium(lint->scene, lint->bodies[i].is);
    struct lint_box_item *items = ARENA_ARRAY(lint->arena, struct lint_box_item, count);
    count = 0;
    for (uint32_t i = 0; i < lint->body_count; i++)
        if (scene_is_medium(lint->scene, lint->bodies[i].is))
            items[count++] = (struct lint_box_item){lint->bodies[i].box, &lint->bodies[i]};
    lint_box_tree_build(tree, lint->arena, items, count);
}

// The same for cameras, where the bodies around a camera need not be inside each other.
static void report_crowded(struct lint *lint) {
    struct lint_box_tree tree;
    uint64_t work = 0;
    find_media(lint, &tree);
    for (uint32_t i = 0; i < lint->ir->cameras.count && work < CROWDS_MAX; i++) {
        const struct ir_camera *camera = &lint->ir->cameras.items[i];
        const vec3 position = lint->views[i].camera.position;
        const struct lint_box point = {position, position};
        uint32_t boxes = 0;
        work += lint_box_tree_in_box(&tree, &point, 0, count_box, &boxes);
        if (boxes <= SCENE_MEDIA_MOST)
            continue;
        work += lint->body_count;
        const uint32_t crowd = scene_media_crowd(lint->scene, position);
        if (!crowd)
            continue;
        diag_add(lint->sink, DIAG_LIMIT,
                 ir_place_value(lint->origin, &camera->head, &SCHEMA_CAMERA, "position"),
                 "the camera is inside %u bodies that refract; at most %d may surround a ray", crowd,
                 SCENE_MEDIA_MOST);
        diag_help(lint->sink, "move the camera, or join bodies of one material into one mesh");
    }
}

static void report(struct media *media, const struct overlap *first, uint32_t count) {
    struct lint *lint = media->lint;
    switch (first->finding) {
    case FINDING_EQUAL:
        report_equal(media, first, count);
        break;
    case FINDING_HIDDEN:
        report_hidden(lint, first);
        break;
    case FINDING_RELATIVE:
        report_relative(lint, first);
        break;
    default:
        break;
    }
}

void lint_media(struct lint *lint) {
    struct media media = {.lint = lint, .work_left = FACES_MAX};
    uint32_t count = 0;
    media.around = ARENA_ARRAY(lint->arena, uint32_t, lint->body_count);
    for (uint32_t i = 0; i < lint->body_count; i++)
        count += is_medium(lint, &lint->bodies[i]);
    struct lint_box_item *items = ARENA_ARRAY(lint->arena, struct lint_box_item, count);
    count = 0;
    for (uint32_t i = 0; i < lint->body_count; i++)
        if (is_medium(lint, &lint->bodies[i])) {
            const int32_t priority = filling(lint, &lint->bodies[i])->priority;
            media.highest = priority > media.highest ? priority : media.highest;
            media.lowest = priority < media.lowest ? priority : media.lowest;
            items[count++] = (struct lint_box_item){lint->bodies[i].box, &lint->bodies[i]};
        }
    lint_body_pairs(lint->arena, items, count, take_pair, &media);
    report_nested(lint, &media);
    report_crowded(lint);
    if (media.found.count == 0)
        return;
    qsort(media.found.items, media.found.count, sizeof *media.found.items, compare_overlaps);
    for (uint32_t i = 0, end; i < media.found.count; i = end) {
        for (end = i + 1; end < media.found.count &&
                          media.found.items[end].body == media.found.items[i].body &&
                          media.found.items[end].finding == media.found.items[i].finding;)
            end++;
        report(&media, &media.found.items[i], end - i);
    }
}
