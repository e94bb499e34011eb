// From a scene (scene/scene.h) to the buffers of shaders/gpu_scene.h: origin, scale, float rounding, trees.
//
// The origin (the camera's position, or the first of several; in double precision the place of the bodies'
// box that is nearest to it) is subtracted from the transforms in double before any vertex is touched; the
// scale is 2^-ilogb(largest |coordinate - origin| of bodies), lights excluded; then values are rounded to
// float, or stay double for the kernels in double precision, whose boxes alone are float. A point light
// further than 2^40 after scaling is flattened as a direction, its 1/|P-p|^2 taken once in double. The
// background stays as its file has it: flat_background makes a few texels at a time of it. Ownership:
// flat_finish frees everything. Thread safety: immutable once made.
#ifndef GLINT_TRACER_FLATTEN_FLATTEN_H
#define GLINT_TRACER_FLATTEN_FLATTEN_H

#include "scene/view.h"
#include "tracer/bvh/bvh.h"
#include "tracer/gpu_word.h"

struct flat_array {
    struct gpu_word *words;
    uint64_t count; // words
};

// Words of a record of each kind, and of an entry of `normals`.
struct flat_strides {
    uint32_t triangle, sphere, normal, body, material, light;
};

struct flat_scene {
    bool is_double; // for the kernels in double precision
    struct flat_strides strides;
    vec3 origin;
    int scale_exponent; // flat = (scene - origin) * 2^scale_exponent
    struct flat_array triangle_nodes, triangles, normals, sphere_nodes, spheres, bodies, materials, lights;
    const struct picture *background; // not owned
    struct {
        uint64_t bytes; // as texels of the device; 0: there is no image
        bool is_float;  // four floats a texel, else four bytes of 1/255
        float *decoded; // by stored value, where these are whole numbers that become floats
    } background_texels;
    uint32_t body_count, light_count, triangle_count, sphere_count;
    uint32_t *first_triangle;              // by body: the number of its first triangle
    uint32_t dropped_triangles;            // without area after rounding
    uint32_t features;                     // FEATURE_ bits that the scene needs
    uint32_t triangle_depth, sphere_depth; // levels of the trees: traversal stack size
    double build_seconds;                  // tree building
};

struct timeline;

struct flat_input {
    const struct scene *scene;
    const struct view *view;
    vec3 origin; // of single precision; scene units
    bool is_double;
    enum bvh_method method; // of the trees; none shows in a picture
    const struct limits *limits;
    struct diag_sink *sink;
    struct timeline *timeline; // may be NULL
};

// false: too large or no memory (the sink says which).
bool flatten(const struct flat_input *input, struct flat_scene *out);
// Makes texels [begin, end) of the background, whose picture must have its pixels, from `to` on.
void flat_background(const struct flat_scene *flat, size_t begin, size_t end, void *to);
void flat_finish(struct flat_scene *flat);

#endif
