// The parts of flattening. Private to runtime/flatten*.c.
#ifndef GLINT_TRACER_FLATTEN_FLATTEN_PARTS_H
#define GLINT_TRACER_FLATTEN_FLATTEN_PARTS_H

#include "grammar/ir.h"
#include "tracer/bvh/bvh.h"
#include "tracer/flatten/flatten.h"

enum flatten_fault {
    FLATTEN_DONE,
    FLATTEN_REPORTED,  // the sink has it
    FLATTEN_NO_MEMORY, // the caller reports it
};

struct flattening {
    const struct flat_input *input;
    struct flat_scene *out;
    double factor;            // 2^out->scale_exponent
    uint32_t triangle_total;  // of all bodies, those without area too: what triangle numbers count
    uint32_t *first_triangle; // by body
    // Leaf records by triangle number, and what the tree is built over; the latter without the triangles
    // that have no area.
    struct gpu_word *records;
    struct bvh_item *items;
    uint32_t item_count;
    bool *material_used; // by index in assets.materials
};

// ---- flatten_bodies.c

// Numbers the triangles and checks the limits.
enum flatten_fault flatten_count(struct flattening *f);
// Largest |coordinate - origin| of all bodies, in scene units.
enum flatten_fault flatten_extent(const struct flattening *f, double *extent);
// Fills the spheres' words in IR order, and an item for each.
void flatten_spheres(struct flattening *f, struct gpu_word *words, struct bvh_item *items);
// Fills records, items and item_count with rectangles and models.
enum flatten_fault flatten_triangles(struct flattening *f);

// ---- flatten_shade.c

// Fills out->bodies.
enum flatten_fault flatten_body_records(struct flattening *f);
// Fills out->normals, and the bodies' normal base.
enum flatten_fault flatten_normals(struct flattening *f);

// ---- flatten_light.c

enum flatten_fault flatten_materials(struct flattening *f);
enum flatten_fault flatten_lights(struct flattening *f);
enum flatten_fault flatten_background(struct flattening *f);
// After all others: out->features.
void flatten_features(struct flattening *f);

// ---- shared

// How a model's mesh comes into flat space, but for the scale: relative to the origin, in scene units.
struct placing {
    mat3 linear;
    vec3 offset;  // the origin is already taken off
    bool mirrors; // negative determinant
};
struct placing flatten_placing(const struct flattening *f, uint32_t model);
// The stored winding is outward: a mirror exchanges the second and third corner.
static inline int flatten_corner(const struct placing *placing, int k) {
    return placing->mirrors && k ? 3 - k : k;
}
// Body numbers.
static inline uint32_t flatten_rectangle_body(const struct ir_scene *scene, uint32_t i) {
    return scene->spheres.count + i;
}
static inline uint32_t flatten_model_body(const struct ir_scene *scene, uint32_t i) {
    return scene->spheres.count + scene->rectangles.count + i;
}
// `words` zeroed words; false: no memory. At least one word is there, so that no buffer is empty.
bool flat_array_make(struct flat_array *array, uint64_t words);
uint32_t flat_bits(double value); // of the nearest float
static inline struct gpu_word flat_word(vec3 v, uint32_t w) {
    return (struct gpu_word){flat_bits(v.x), flat_bits(v.y), flat_bits(v.z), w};
}
// REAL and REAL3 of shaders/records.h: a double in half a word, three of them in one and a half, with what
// the other half holds.
struct flat_pair {
    uint32_t low, high;
};
struct flat_pair flat_double(double value);
static inline struct gpu_word flat_doubles(double a, double b) {
    struct flat_pair p = flat_double(a), q = flat_double(b);
    return (struct gpu_word){p.low, p.high, q.low, q.high};
}
static inline void flat_put_real3(struct gpu_word words[2], vec3 v, struct flat_pair more) {
    struct flat_pair z = flat_double(v.z);
    words[0] = flat_doubles(v.x, v.y);
    words[1] = (struct gpu_word){z.low, z.high, more.low, more.high};
}

#endif
