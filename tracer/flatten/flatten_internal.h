// The parts of flattening. Private to this room.
#ifndef GLINT_TRACER_FLATTEN_FLATTEN_INTERNAL_H
#define GLINT_TRACER_FLATTEN_FLATTEN_INTERNAL_H

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

// A mesh that several bodies show. Counts in TRIANGLES and in the nodes are in records.
struct shared_mesh {
    const struct mesh *mesh;
    uint32_t first_use, use_count; // of sharing.uses
    uint32_t instances;
    uint32_t *copied;   // triangles that each instance has as copies, ascending
    uint32_t *left_out; // triangles that no instance shows, ascending
    uint32_t copied_count, left_out_count;
    enum flat_reason reason;
    int64_t saved_bytes;
    // The space of its tree: (mesh space - middle) * 2^exponent.
    vec3 middle;
    int exponent;
    double farthest;              // largest |coordinate| in mesh space
    double edge;                  // in mesh space: few edges are longer
    uint32_t first_record, count; // of its tree
    uint32_t root;                // of its tree, among all nodes
    bool has_normals;
    uint32_t normal_base;     // of the mesh's own normals
    double crease_angle;      // of those
    struct bvh_bounds *boxes; // which together hold the whole mesh, in the tree's space
    uint32_t box_count;
};

struct sharing {
    uint32_t *instance;      // by body: 0 if it is copied; out->instance_of
    uint32_t instance_count; // with instance 0; 0: none
    uint32_t *mesh_of;       // by body that is an instance: its mesh
    uint32_t *uses;          // bodies, those of one mesh together, in IR order
    struct shared_mesh *meshes;
    uint32_t mesh_count;
};

struct flattening {
    const struct flat_input *input;
    const struct scene *scene;
    struct flat_scene *out;
    double factor;           // 2^out->scale_exponent
    uint32_t triangle_total; // of all bodies, including those without area
    struct sharing sharing;
    // The items of the tree, body by body, without the triangles that have no area. Records are made after
    // the tree is built, so that both are never in memory.
    struct bvh_item *items;
    uint32_t record_total;
    uint32_t item_count;
    uint32_t *leaf_of;       // by copied triangle: where its record goes; FLATTEN_NO_LEAF: it has no area
    bool *material_used;     // by index in scene->materials
    uint32_t *coordinates;   // by body: its word of out->paints; 0: it has none
    uint64_t light_features; // FEATURE_ bits that the lights ask for
    uint64_t media_features; // FEATURE_ bits that the media ask for
    uint32_t *medium;        // by body: as in its record; NULL: rays need not know what they are inside
};

// ---- flatten_corners.c

// A triangle as kernels will see it.
struct flat_corners {
    vec3 at[3];    // outward winding
    uint32_t best; // the corner whose edges give the most accurate normal
    bool has_area; // else it is dropped
};
// `map`: flatten_map of the body.
struct flat_corners flatten_corners(const struct flattening *f, const struct scene_body *body,
                                    const affine3 *map, uint32_t triangle);

// ---- flatten_bodies.c

// Numbers the triangles and checks the limits.
enum flatten_fault flatten_count(struct flattening *f);
// The extent of all bodies: its power of two is that of the largest |coordinate - origin|, in scene units.
enum flatten_fault flatten_extent(const struct flattening *f, double *extent);
// Fills the spheres' words in IR order, and an item for each.
void flatten_spheres(struct flattening *f, struct gpu_word *words, struct bvh_item *items);
// Material and flags of a group of a body that has a mesh.
uint32_t flatten_group_shade(struct flattening *f, const struct scene_body *body, uint32_t group);
// Fills items and item_count with all triangles that are copied.
enum flatten_fault flatten_triangles(struct flattening *f);
#define FLATTEN_NO_LEAF UINT32_MAX
// Fills out->triangles, already allocated, in the order of leaf_of.
enum flatten_fault flatten_records(struct flattening *f);

// Marks the materials that the body's triangles, or its sphere, show.
void flatten_use_materials(struct flattening *f, const struct scene_body *body);

// ---- flatten_bounces.c

// Fills out->bounces.
enum flatten_fault flatten_bounces(struct flattening *f);

// ---- flatten_share.c

// Decides which bodies are instances.
enum flatten_fault flatten_share(struct flattening *f);
void flatten_share_finish(struct sharing *sharing);
// The mesh of a body that is an instance; NULL: it is not.
struct shared_mesh *flatten_shared(const struct flattening *f, uint32_t body);
// How many triangles are copied.
uint64_t flatten_copied(const struct flattening *f);
// How many triangles of shared meshes are without area, those of each instance counted.
uint32_t flatten_left_out(const struct flattening *f);

// ---- flatten_thin.c

// Marks the models of a mesh that are instances, and lists the triangles that they do not share.
enum flatten_fault flatten_judge(struct flattening *f, struct shared_mesh *shared);

// All models of a mesh are copies, for this reason.
void flatten_keep_copies(struct flattening *f, struct shared_mesh *shared, enum flat_reason reason);

// ---- flatten_instances.c

// After flatten_triangles and the tree over copied triangles: adds to it the trees of shared meshes and one
// over all instances, and fills out->instances.
enum flatten_fault flatten_instances(struct flattening *f);

// ---- flatten_keep.c

// Whether the geometry of input->before is that of this scene.
bool flatten_is_kept(const struct flattening *f);
// If so: shares it.
void flatten_keep(struct flattening *f);

// ---- flatten_media.c

// Which media the scene has, if rays must know them.
enum flatten_fault flatten_media(struct flattening *f);

// ---- flatten_shade.c

// Whether a sphere has axes of its own.
bool flatten_turns_spheres(const struct flattening *f);
// Fills out->normals and out->normal_base.
enum flatten_fault flatten_normals(struct flattening *f);
// Fills out->bodies.
enum flatten_fault flatten_body_records(struct flattening *f);

// ---- flatten_paint.c

// Fills out->paints, if a material that is used needs them, and coordinates.
enum flatten_fault flatten_paints(struct flattening *f);
// FEATURE_ bits that a material's images and its checker ask for.
uint64_t flatten_paint_features(const struct scene_material *material);

// ---- flatten_light.c

enum flatten_fault flatten_materials(struct flattening *f);
enum flatten_fault flatten_lights(struct flattening *f);
enum flatten_fault flatten_background(struct flattening *f);
// Called last: fills out->features.
void flatten_features(struct flattening *f);

// ---- flat_array.c, and what all share

// How a body is mapped to flat space, except for the scale: relative to the origin, in scene units.
static inline affine3 flatten_map(const struct flattening *f, const struct scene_body *body) {
    return transform_relative(body->object_to_world, f->out->origin);
}
// Numbers as kernels will see them.
static inline double flatten_rounded(const struct flattening *f, double value) {
    return f->out->is_double ? value : (double)(float)value;
}
static inline vec3 flatten_rounded3(const struct flattening *f, vec3 v) {
    return (vec3){flatten_rounded(f, v.x), flatten_rounded(f, v.y), flatten_rounded(f, v.z)};
}
// More than the rounding error of a bound from a box's corners.
#define FLATTEN_BOUND (1 + 0x1p-40)
// An upper bound on |coordinate - origin| of a mesh's vertices, from the corners of its box.
static inline double flatten_reach(const struct flattening *f, const struct scene_body *body) {
    const affine3 map = flatten_map(f, body);
    const struct mesh *mesh = body->mesh;
    double most = 0;
    for (int i = 0; i < 8; i++)
        most = fmax(most, vec3_max_abs(affine3_apply(map, (vec3){i & 1 ? mesh->upper.x : mesh->lower.x,
                                                                 i & 2 ? mesh->upper.y : mesh->lower.y,
                                                                 i & 4 ? mesh->upper.z : mesh->lower.z})));
    return most * FLATTEN_BOUND;
}
// `words` zeroed words; false: no memory. At least one word is there, so that no buffer is empty.
bool flat_array_make(struct flat_array *array, uint64_t words);

#endif
