#include "tracer/flatten/flatten.h"
#include "diag/codes/limit.h"

#include "core/clock.h"
#include "core/heap.h"
#include "core/parallel.h"
#include "core/timeline.h"
#include "tracer/bvh/items.h"
#include "tracer/flatten/flatten_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    PIECE_ITEMS = 16384,
    SCALE_EXPONENT_MAX = 200, // for scenes smaller than any that the language accepts
};

// ---- trees

struct gather {
    const uint32_t *order;
    const struct gpu_word *from;
    struct gpu_word *to;
    uint32_t words;
};

static void gather_items(void *context, size_t begin, size_t end) {
    const struct gather *g = context;
    for (size_t i = begin; i < end; i++)
        memcpy(g->to + i * g->words, g->from + (size_t)g->order[i] * g->words, g->words * sizeof *g->to);
}

// Builds a tree over `items` and reorders the `records` that they name to the order of its leaves.
static bool make_tree(const struct flat_input *input, struct bvh_item *items, uint32_t count,
                      const struct gpu_word *records, uint32_t words, struct flat_array *nodes,
                      struct flat_array *leaves, uint32_t *depth) {
    struct bvh bvh;
    if (!bvh_build_kept(input->keep, items, count, input->method, &bvh))
        return false;
    *nodes = (struct flat_array){bvh.nodes, (uint64_t)bvh.node_count * NODE_WORDS};
    *depth = bvh.depth;
    bvh.nodes = NULL;
    bool done = flat_array_make(leaves, (uint64_t)count * words);
    if (done) {
        struct gather gather = {bvh.order, records, leaves->words, words};
        parallel_for(count, PIECE_ITEMS, gather_items, &gather);
    }
    bvh_finish(&bvh);
    return done;
}

struct placing {
    const uint32_t *order;
    uint32_t *leaf_of;
};

static void place_leaves(void *context, size_t begin, size_t end) {
    const struct placing *p = context;
    for (size_t i = begin; i < end; i++)
        p->leaf_of[p->order[i]] = (uint32_t)i;
}

// Builds the tree over the items, frees them, and says where records go.
static bool make_triangle_tree(struct flattening *f) {
    struct flat_scene *out = f->out;
    struct bvh bvh;
    if (!bvh_build_kept(f->input->keep, f->items, f->item_count, f->input->method, &bvh))
        return false;
    free(f->items);
    f->items = NULL;
    out->triangle_nodes = (struct flat_array){bvh.nodes, (uint64_t)bvh.node_count * NODE_WORDS};
    out->triangle_depth = bvh.depth;
    bvh.nodes = NULL;
    const size_t total = f->record_total;
    f->leaf_of = heap_array(total ? total : 1, sizeof *f->leaf_of);
    if (f->leaf_of) {
        memset(f->leaf_of, 0xFF, total * sizeof *f->leaf_of);
        struct placing placing = {bvh.order, f->leaf_of};
        parallel_for(f->item_count, PIECE_ITEMS, place_leaves, &placing);
    }
    bvh_finish(&bvh);
    return f->leaf_of != NULL;
}

static void end_tree(struct flattening *f, double start) {
    f->out->build_seconds += clock_seconds() - start;
    timeline_add(f->input->timeline, "tree", STR(""), start);
}

static enum flatten_fault make_triangles(struct flattening *f) {
    struct flat_scene *out = f->out;
    const size_t total = f->record_total = (uint32_t)flatten_copied(f);
    if (f->sharing.instance_count) {
        out->strides.triangle = PLACED_WORDS;
        out->strides.normal = NORMAL64_WORDS;
    }
    f->items = heap_array(total ? total : 1, sizeof *f->items);
    if (!f->items)
        return FLATTEN_NO_MEMORY;
    enum flatten_fault fault = flatten_triangles(f);
    if (fault != FLATTEN_DONE)
        return fault;
    out->triangle_count = f->item_count;
    out->dropped_triangles = f->record_total - f->item_count + flatten_left_out(f);
    out->shown_triangles = f->triangle_total - out->dropped_triangles;
    double start = clock_seconds();
    bool done = make_triangle_tree(f);
    end_tree(f, start);
    if (!done || !flat_array_make(&out->triangles, (uint64_t)out->triangle_count * out->strides.triangle))
        return FLATTEN_NO_MEMORY;
    return flatten_records(f);
}

static enum flatten_fault make_spheres(struct flattening *f) {
    struct flat_scene *out = f->out;
    const uint32_t count = out->sphere_count + out->cone_count;
    if (out->cone_count)
        out->strides.sphere = out->is_double ? FRUSTUM64_WORDS : FRUSTUM_WORDS;
    struct gpu_word *words = heap_array(heap_times((size_t)count + 1, out->strides.sphere), sizeof *words);
    struct bvh_item *items = heap_array((size_t)count + 1, sizeof *items);
    bool done = words && items;
    if (done) {
        flatten_spheres(f, words, items);
        double start = clock_seconds();
        done = make_tree(f->input, items, count, words, out->strides.sphere, &out->sphere_nodes,
                         &out->spheres, &out->sphere_depth);
        end_tree(f, start);
    }
    free(items);
    free(words);
    return done ? FLATTEN_DONE : FLATTEN_NO_MEMORY;
}

// ---- the whole

static enum flatten_fault choose_scale(struct flattening *f) {
    double extent;
    enum flatten_fault fault = flatten_extent(f, &extent);
    if (fault == FLATTEN_DONE && extent > 0) {
        int exponent = -ilogb(extent);
        f->out->scale_exponent = exponent < SCALE_EXPONENT_MAX ? exponent : SCALE_EXPONENT_MAX;
    }
    f->factor = ldexp(1, f->out->scale_exponent);
    return fault;
}

typedef enum flatten_fault step(struct flattening *);

static enum flatten_fault take_steps(struct flattening *f, step *const *steps, size_t count) {
    enum flatten_fault fault = FLATTEN_DONE;
    for (size_t i = 0; i < count && fault == FLATTEN_DONE; i++)
        fault = steps[i](f);
    return fault;
}

static enum flatten_fault make_geometry(struct flattening *f) {
    static step *const steps[] = {flatten_count,     choose_scale, flatten_share,  make_triangles,
                                  flatten_instances, make_spheres, flatten_normals};
    struct flat_scene *out = f->out;
    const size_t bodies = f->scene->body_count;
    out->first_triangle = heap_zeroed(bodies + 1, sizeof *out->first_triangle);
    out->normal_base = heap_zeroed(bodies + 1, sizeof *out->normal_base);
    if (!out->first_triangle || !out->normal_base)
        return FLATTEN_NO_MEMORY;
    return take_steps(f, steps, sizeof steps / sizeof *steps);
}

static enum flatten_fault run(struct flattening *f) {
    static step *const steps[] = {flatten_paints, flatten_media,      flatten_body_records, flatten_materials,
                                  flatten_lights, flatten_background, flatten_bounces};
    f->out->body_count = f->scene->body_count;
    f->material_used = heap_zeroed((size_t)f->scene->material_count + 1, sizeof *f->material_used);
    if (!f->material_used)
        return FLATTEN_NO_MEMORY;
    enum flatten_fault fault = FLATTEN_DONE;
    if (flatten_is_kept(f))
        flatten_keep(f);
    else
        fault = make_geometry(f);
    if (fault == FLATTEN_DONE)
        fault = take_steps(f, steps, sizeof steps / sizeof *steps);
    if (fault == FLATTEN_DONE)
        flatten_features(f);
    return fault;
}

// In double precision the camera may be so far from all bodies that the float boxes of the trees, as coarse
// as a float at their distance, would each hold many triangles: then the origin is the nearest place of the
// bodies' box. All numbers move with the scene.
static vec3 origin_of(const struct flat_input *input) {
    vec3 lower, upper;
    if (!input->is_double || !scene_bounds(input->scene, &lower, &upper))
        return input->origin;
    return vec3_max(lower, vec3_min(upper, input->origin));
}

bool flatten(const struct flat_input *input, struct flat_scene *out) {
    static const struct flat_strides strides[2] = {
        {TRIANGLE_WORDS, SPHERE_WORDS, NORMAL_WORDS, BODY_WORDS, MATERIAL_WORDS, LIGHT_WORDS},
        {TRIANGLE64_WORDS, SPHERE64_WORDS, NORMAL64_WORDS, BODY64_WORDS, MATERIAL64_WORDS, LIGHT64_WORDS}};
    *out = (struct flat_scene){.is_double = input->is_double,
                               .strides = strides[input->is_double],
                               .origin = origin_of(input),
                               .sharing = input->sharing,
                               .method = input->method,
                               .most_triangles = input->limits->value[LIMIT_SCENE_TRIANGLES],
                               .scene = input->scene,
                               .background = input->scene->background.picture};
    struct flattening f = {.input = input, .scene = input->scene, .out = out};
    const double start = clock_seconds();
    enum flatten_fault fault = run(&f);
    timeline_add(input->timeline, "flatten", STR(""), start);
    flatten_share_finish(&f.sharing);
    free(f.material_used);
    free(f.coordinates);
    free(f.items);
    free(f.leaf_of);
    free(f.medium);
    if (fault == FLATTEN_NO_MEMORY)
        diag_add(input->sink, DIAG_OUT_OF_MEMORY, SPAN_NONE,
                 "there is not enough memory for the scene's triangles");
    if (fault != FLATTEN_DONE)
        flat_finish(out);
    return fault == FLATTEN_DONE;
}

static void free_geometry(const struct flat_scene *flat) {
    const struct flat_array arrays[] = {flat->triangle_nodes, flat->triangles, flat->normals,
                                        flat->sphere_nodes,   flat->spheres,   flat->instances};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        free(arrays[i].words);
    free(flat->first_triangle);
    free(flat->normal_base);
    free(flat->instance_of);
    free(flat->uses);
}

void flat_finish(struct flat_scene *flat) {
    if (!flat)
        return;
    const struct flat_array arrays[] = {flat->bodies, flat->materials, flat->lights, flat->paints};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        free(arrays[i].words);
    if (!flat->shares)
        free_geometry(flat);
    free(flat->bounces);
    free(flat->background_texels.decoded);
    free(flat->texels.textures);
    *flat = (struct flat_scene){0};
}
