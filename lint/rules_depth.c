// Whether max_depth reaches through the layers of glass that the cameras see.
//
// A grid of rays goes straight through everything that refracts; the number of surfaces that a ray crosses,
// up to the first opaque one and while its throughput is at least min_weight, is the depth that it needs.
// Bending is ignored: it moves the layers in the picture, but hardly changes their number.
#include "diag/codes/rule.h"
#include "lint/lint_internal.h"

#include "core/heap.h"
#include "core/number.h"
#include "core/parallel.h"
#include "grammar/ir.h"
#include "scene/media.h"

#include <stdlib.h>

enum {
    COLUMNS = 96, // of the grid, at most
    HITS_MAX = 256,
    WORK_MAX = 20000000,    // rays times bodies
    RAY_WORK_MAX = 1 << 12, // triangles that one ray may try: in a fan of needles it hits them all
};

struct crossing {
    double t;
    uint32_t body;
};

struct glass {
    struct lint *lint;
    const struct view_camera *camera;
    uint32_t *refracting; // bodies
    uint32_t refracting_count;
    uint32_t columns, rows;
    uint32_t *layers; // per ray
    uint32_t *first;  // per ray: the body hit first
};

struct ray_hits {
    const struct lint_tree *tree;
    vec3 origin, direction;
    uint32_t body;
    struct crossing items[HITS_MAX];
    uint32_t count;
    uint32_t tried;
};

static void add_hit(struct ray_hits *hits, double t) {
    if (t > 0 && hits->count < HITS_MAX)
        hits->items[hits->count++] = (struct crossing){t, hits->body};
}

static bool intersect_leaf(void *context, uint32_t first, uint32_t count) {
    struct ray_hits *hits = context;
    for (uint32_t i = first; i < first + count; i++) {
        struct lint_triangle t = lint_mesh_triangle(hits->tree->mesh, hits->tree->order[i]);
        double at;
        int side;
        if (lint_triangle_ray(&t, hits->origin, hits->direction, &at, &side))
            add_hit(hits, at);
    }
    hits->tried += count;
    return hits->tried < RAY_WORK_MAX;
}

static void intersect_sphere(struct ray_hits *hits, const struct scene_body *sphere, vec3 origin,
                             vec3 direction) {
    vec3 to_center = vec3_sub(sphere->object_to_world.offset, origin);
    double along = vec3_dot(to_center, direction);
    double square =
        sphere->radius * sphere->radius - vec3_dot(vec3_sub(to_center, vec3_mul(direction, along)),
                                                   vec3_sub(to_center, vec3_mul(direction, along)));
    if (!(square > 0))
        return;
    add_hit(hits, along - sqrt(square));
    add_hit(hits, along + sqrt(square));
}

static void intersect_cone(struct ray_hits *hits, const struct scene_body *body, vec3 origin,
                           vec3 direction) {
    const struct shape_cone cone = shape_cone_of(body);
    double t[2];
    bool side[2];
    if (!shape_cone_crossing(&cone, origin, direction, t, side))
        return;
    add_hit(hits, t[0]);
    add_hit(hits, t[1]);
}

static void intersect_body(const struct lint *lint, uint32_t index, vec3 origin, vec3 direction,
                           struct ray_hits *hits) {
    const struct lint_body *body = &lint->bodies[index];
    hits->body = index;
    struct lint_triangle flat[LINT_FLAT_TRIANGLES];
    double t;
    int side;
    switch (body->is->shape) {
    case SCENE_SPHERE:
        intersect_sphere(hits, body->is, origin, direction);
        break;
    case SCENE_PARALLELOGRAM:
        for (uint32_t i = 0, count = lint_flat_triangles(body, flat); i < count; i++)
            if (lint_triangle_ray(&flat[i], origin, direction, &t, &side)) {
                add_hit(hits, t);
                break; // the other one shares the edge that the ray may go through
            }
        break;
    case SCENE_MESH:
        if (!body->mesh)
            break;
        hits->tree = &body->mesh->tree;
        affine3 back = transform_inverse(body->is->object_to_world);
        hits->origin = affine3_apply(back, origin);
        hits->direction = mat3_apply(back.linear, direction);
        lint_tree_on_ray(hits->tree, hits->origin, hits->direction, intersect_leaf, hits);
        break;
    case SCENE_CONE:
        intersect_cone(hits, body->is, origin, direction);
        break;
    }
}

static int compare_crossings(const void *a, const void *b) {
    const struct crossing *x = a;
    const struct crossing *y = b;
    return x->t < y->t ? -1 : x->t > y->t;
}

// 0 where the ray's work limit is reached first: an untried triangle may be in front of all glass.
static double nearest_opaque(const struct glass *glass, vec3 origin, vec3 direction) {
    struct ray_hits hits = {.count = 0};
    double nearest = INFINITY;
    for (uint32_t k = 0; k < glass->lint->body_count; k++) {
        const struct lint_body *body = &glass->lint->bodies[k];
        if (!body->is_opaque || !lint_box_on_ray(&body->box, origin, direction))
            continue;
        hits.count = 0;
        intersect_body(glass->lint, k, origin, direction, &hits);
        for (uint32_t i = 0; i < hits.count; i++)
            nearest = fmin(nearest, hits.items[i].t);
    }
    return hits.tried < RAY_WORK_MAX ? nearest : 0;
}

// What a ray is inside, in the order in which it entered.
struct layers {
    const struct lint *lint;
    uint32_t inside[HITS_MAX];
    uint32_t count;
};

static const struct scene_material *filling(const struct layers *l) {
    const struct scene_material *found = NULL;
    for (uint32_t i = 0; i < l->count; i++) {
        const struct scene_body *body = l->lint->bodies[l->inside[i]].is;
        const struct scene_material *m =
            &l->lint->scene->materials[scene_medium_material(l->lint->scene, body)];
        found = !found || m->priority >= found->priority ? m : found;
    }
    return found;
}

// Enters the body, or leaves it if the ray is inside.
static void cross(struct layers *l, uint32_t body) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < l->count; i++)
        if (l->inside[i] != body)
            l->inside[kept++] = l->inside[i];
    if (kept == l->count && kept < HITS_MAX)
        l->inside[kept++] = body;
    l->count = kept;
}

// Whether the medium is the same on both sides, so that nobody sees the surface.
static bool passes(struct layers *l, uint32_t body) {
    if (!scene_is_medium(l->lint->scene, l->lint->bodies[body].is))
        return false;
    const struct scene_material *before = filling(l);
    cross(l, body);
    const struct scene_material *after = filling(l);
    return before && after && scene_compare_media(before, after) == 0;
}

// Where the camera is: inside what the ray crosses an odd number of times.
static void begin_inside(struct layers *l, const struct ray_hits *hits) {
    for (uint32_t i = hits->count; i-- > 0;)
        if (scene_is_medium(l->lint->scene, l->lint->bodies[hits->items[i].body].is))
            cross(l, hits->items[i].body);
}

// Counts the surfaces that the ray passes before `end`, while its throughput is high enough for it to be
// traced.
static uint32_t count_layers(const struct lint *lint, const struct ray_hits *hits, double end) {
    struct layers l = {.lint = lint};
    double throughput = 1;
    uint32_t layers = 0;
    begin_inside(&l, hits);
    for (uint32_t i = 0; i < hits->count && hits->items[i].t < end; i++) {
        if (passes(&l, hits->items[i].body))
            continue;
        throughput *= lint->bodies[hits->items[i].body].refraction;
        if (throughput < lint->ir->trace.min_weight)
            break;
        layers++;
    }
    return layers;
}

static void trace_ray(const struct glass *glass, uint32_t index) {
    const struct lint *lint = glass->lint;
    const struct view_camera *camera = glass->camera;
    double aspect = (double)lint->input->image->width / lint->input->image->height;
    double x = 2 * (index % glass->columns + 0.5) / glass->columns - 1;
    double y = 1 - 2 * (index / glass->columns + 0.5) / glass->rows;
    const struct view_ray ray = view_ray_at(camera, aspect, x, y);
    struct ray_hits hits = {.count = 0};
    for (uint32_t i = 0; i < glass->refracting_count; i++)
        if (lint_box_on_ray(&lint->bodies[glass->refracting[i]].box, ray.start, ray.direction))
            intersect_body(lint, glass->refracting[i], ray.start, ray.direction, &hits);
    uint32_t most = (uint32_t)lint->ir->trace.max_depth;
    if (hits.count <= most || hits.tried >= RAY_WORK_MAX)
        return;
    qsort(hits.items, hits.count, sizeof *hits.items, compare_crossings);
    if (count_layers(lint, &hits, INFINITY) <= most)
        return;
    glass->layers[index] = count_layers(lint, &hits, nearest_opaque(glass, ray.start, ray.direction));
    glass->first[index] = hits.items[0].body;
}

static void trace_piece(void *context, size_t begin, size_t end) {
    for (size_t i = begin; i < end; i++)
        trace_ray(context, (uint32_t)i);
}

static span depth_place(const struct lint *lint, const struct lint_body *body) {
    span at = ir_place_value(lint->origin, &lint->ir->trace.head, &SCHEMA_TRACE, "max_depth");
    return span_is_none(at) ? lint_place(lint, body) : at;
}

static void report(const struct glass *glass, uint32_t at, uint32_t rays) {
    struct lint *lint = glass->lint;
    const struct lint_body *body = &lint->bodies[glass->first[at]];
    const struct ir_image *image = lint->input->image;
    uint32_t x = (uint32_t)((at % glass->columns + 0.5) / glass->columns * image->width);
    uint32_t y = (uint32_t)((at / glass->columns + 0.5) / glass->rows * image->height);
    uint32_t needed = glass->layers[at];
    diag_add(lint->sink, DIAG_DEPTH_SHORT, depth_place(lint, body),
             "max_depth is %d, but a ray through pixel %u,%u crosses %u glass surfaces: it ends before it "
             "has passed all of them",
             lint->ir->trace.max_depth, x, y, needed);
    diag_note(lint->sink, lint_place(lint, body),
              "the first is the surface of %.*s; in %.3g %% of the picture rays end in glass",
              STR_ARG(lint_words_other(lint, body)), 100.0 * rays / (glass->columns * glass->rows));
    if (needed <= 64)
        diag_help(lint->sink, "write max_depth: %u", needed);
    int row = schema_find_row(&SCHEMA_TRACE, STR("max_depth"));
    const struct ir_row_origin *place = ir_origin_row(lint->origin, &lint->ir->trace.head, (uint32_t)row);
    if (needed <= 64 && place)
        diag_fix(lint->sink, false, place->value, arena_format(lint->arena, "%u", needed));
}

static void look(struct glass *glass) {
    uint32_t rays = glass->columns * glass->rows;
    for (uint32_t i = 0; i < rays; i++)
        glass->layers[i] = 0;
    parallel_for(rays, COLUMNS, trace_piece, glass);
    uint32_t worst = 0;
    uint32_t cut = 0;
    for (uint32_t i = 0; i < rays; i++) {
        cut += glass->layers[i] > (uint32_t)glass->lint->ir->trace.max_depth;
        if (glass->layers[i] > glass->layers[worst])
            worst = i;
    }
    if (cut)
        report(glass, worst, cut);
}

void lint_depth_short(struct lint *lint) {
    struct glass glass = {.lint = lint};
    glass.refracting = ARENA_ARRAY(lint->arena, uint32_t, lint->body_count);
    uint64_t surfaces = 0;
    for (uint32_t i = 0; i < lint->body_count; i++) {
        const struct lint_body *body = &lint->bodies[i];
        if (body->is_opaque)
            continue;
        glass.refracting[glass.refracting_count++] = i;
        surfaces += body->mesh ? body->mesh->mesh->triangle_count : 2;
    }
    if (surfaces <= (uint32_t)lint->ir->trace.max_depth)
        return;
    for (uint32_t i = 0; i < lint->body_count; i++)
        if (lint->bodies[i].mesh)
            lint_tree_of(lint, lint->bodies[i].mesh);
    const struct ir_image *image = lint->input->image;
    glass.columns = COLUMNS < image->width ? COLUMNS : (uint32_t)image->width;
    while (glass.columns > 8 && (uint64_t)glass.columns * glass.columns * lint->body_count > WORK_MAX)
        glass.columns /= 2;
    glass.rows = (uint32_t)ceil((double)glass.columns * image->height / image->width);
    glass.rows = glass.rows > 4 * glass.columns ? 4 * glass.columns : glass.rows;
    glass.layers = ARENA_ARRAY(lint->arena, uint32_t, heap_times(glass.columns, glass.rows));
    glass.first = ARENA_ARRAY(lint->arena, uint32_t, heap_times(glass.columns, glass.rows));
    const uint64_t work = (uint64_t)glass.columns * glass.rows * lint->body_count;
    for (uint32_t i = 0; i < lint->view_count && i * work <= WORK_MAX; i++) {
        glass.camera = &lint->views[i].camera;
        look(&glass);
    }
}
