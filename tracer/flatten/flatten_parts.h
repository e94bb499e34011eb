// The parts of flattening. Private to this room.
#ifndef GLINT_TRACER_FLATTEN_FLATTEN_PARTS_H
#define GLINT_TRACER_FLATTEN_FLATTEN_PARTS_H

#include "grammar/ir.h"
#include "scene/transform.h"
#include "tracer/bvh/bvh.h"
#include "tracer/flatten/flatten.h"
#include "tracer/gpu_records.h"

enum flatten_fault {
    FLATTEN_DONE,
    FLATTEN_REPORTED,  // the sink has it
    FLATTEN_NO_MEMORY, // the caller reports it
};

struct flattening {
    const struct flat_input *input;
    const struct scene *scene;
    struct flat_scene *out;
    double factor;           // 2^out->scale_exponent
    uint32_t triangle_total; // of all bodies, those without area too: what triangle numbers count
    // What the tree is built over, without the triangles that have no area. Records are made when it is
    // there, so that both are never in memory.
    struct bvh_item *items;
    uint32_t item_count;
    uint32_t *leaf_of;       // by triangle number: where its record goes; FLATTEN_NO_LEAF: it has no area
    bool *material_used;     // by index in scene->materials
    uint32_t *normal_base;   // by body: its first record of out->normals
    uint32_t light_features; // FEATURE_ bits that the lights ask for
};

// ---- flatten_bodies.c

// Numbers the triangles and checks the limits.
enum flatten_fault flatten_count(struct flattening *f);
// Largest |coordinate - origin| of all bodies, in scene units.
enum flatten_fault flatten_extent(const struct flattening *f, double *extent);
// Fills the spheres' words in IR order, and an item for each.
void flatten_spheres(struct flattening *f, struct gpu_word *words, struct bvh_item *items);
// Fills items and item_count with all that consists of triangles.
enum flatten_fault flatten_triangles(struct flattening *f);
#define FLATTEN_NO_LEAF UINT32_MAX
// Fills out->triangles, which is there, as leaf_of says.
enum flatten_fault flatten_records(struct flattening *f);

// ---- flatten_shade.c

// Fills out->normals and normal_base.
enum flatten_fault flatten_normals(struct flattening *f);
// Fills out->bodies.
enum flatten_fault flatten_body_records(struct flattening *f);

// ---- flatten_light.c

enum flatten_fault flatten_materials(struct flattening *f);
enum flatten_fault flatten_lights(struct flattening *f);
enum flatten_fault flatten_background(struct flattening *f);
// After all others: out->features.
void flatten_features(struct flattening *f);

// ---- flat_array.c, and what all share

// How a body comes into flat space, but for the scale: relative to the origin, in scene units.
static inline affine3 flatten_map(const struct flattening *f, const struct scene_body *body) {
    return transform_relative(body->object_to_world, f->out->origin);
}
// `words` zeroed words; false: no memory. At least one word is there, so that no buffer is empty.
bool flat_array_make(struct flat_array *array, uint64_t words);

#endif
