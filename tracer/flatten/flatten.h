// From a scene (scene/scene.h) to the buffers of shaders/gpu_scene.h: origin, scale, float rounding, trees.
//
// The origin (the camera's position, or the first of several; in double precision the place of the bodies'
// box that is nearest to it) is subtracted from the transforms in double before any vertex is touched; the
// scale is 2^-ilogb(largest |coordinate - origin| of bodies), lights excluded; then values are rounded to
// float, or stay double for the kernels in double precision, where only boxes are float. A point light
// further than 2^40 after scaling is flattened as a direction, its 1/|P-p|^2 taken once in double; a sphere
// or a panel as a smaller one at that distance. The background stays as its file has it: flat_background
// converts a few texels at a time. Ownership: flat_finish frees everything. Thread safety: immutable once
// made.
#ifndef GLINT_TRACER_FLATTEN_FLATTEN_H
#define GLINT_TRACER_FLATTEN_FLATTEN_H

#include "scene/media.h"
#include "scene/sky.h"
#include "scene/view.h"
#include "tracer/bvh/keep.h"
#include "tracer/gpu_word.h"

// Flat units: lights farther away than this count as infinitely far away, or are moved nearer with the same
// appearance; larger lengths count as this one.
#define FLAT_LENGTH_MAX 0x1p40

struct flat_array {
    struct gpu_word *words;
    uint64_t count; // words
};

// Words of a record of each kind, and of an entry of `normals`.
struct flat_strides {
    uint32_t triangle, sphere, normal, body, material, light; // sphere: of a cone, if the scene has any
};

// Whether models that show the same mesh share its triangles (docs/decisions/instances.md). The picture is
// always the same.
enum flat_sharing {
    FLAT_COPIES,  // each has its own: for kernels without instances, and devices without doubles
    FLAT_CHEAPER, // as instances if that saves enough memory
    FLAT_SHARED,  // as instances wherever possible, for tests
};

enum flat_reason {
    FLAT_REASON_SHARED,
    FLAT_REASON_SMALL,  // copies are cheaper
    FLAT_REASON_COPIES, // the input asks for copies
    FLAT_REASON_UNEVEN, // scales too different in different directions, or extreme
    FLAT_REASON_THIN,   // too many triangles that rounding may leave without area
    FLAT_REASONS,
};

// A mesh that several models show.
struct flat_use {
    const struct mesh *mesh;
    uint32_t models, instances; // how many models show it, and how many of these are instances
    uint32_t copied;            // how many of its triangles each instance has as copies
    uint32_t left_out;          // how many no instance shows: they are without area
    enum flat_reason reason;    // why models are copies, if any are
    int64_t saved_bytes;        // on the device, by sharing everything possible; negative: copies are smaller
};

// A body whose surfaces send rays on: paths are long where it is seen.
struct flat_bounce {
    vec3 lower, upper; // a box around it, scene units
    bool refracts;     // a path may branch on it
};

// Where an image's levels lie among the device's words.
struct flat_texture {
    uint64_t table;                    // of decoded stored bytes; 0: there is none
    uint64_t levels;                   // a word each
    uint64_t texels[SCENE_LEVELS_MAX]; // the first words of each, among those of texels
};

struct flat_scene {
    bool is_double; // for the kernels in double precision
    struct flat_strides strides;
    vec3 origin;
    int scale_exponent; // flat = (scene - origin) * 2^scale_exponent
    struct flat_array triangle_nodes, triangles, normals, sphere_nodes, spheres, bodies, materials, lights;
    const struct scene *scene;        // not owned: asked what a camera is inside
    struct scene_media_reason media;  // whether rays must know what they are inside
    const struct picture *background; // not owned
    struct {
        uint64_t bytes; // as texels of the device; 0: there is no image
        bool is_float;  // four floats a texel, else four bytes of 1/255
        float *decoded; // by stored value, if stored values are whole numbers that become floats
    } background_texels;
    struct flat_array paints; // without texels; no word: there are none
    struct {
        uint64_t words;                // the texels that follow `paints` on the device
        struct flat_texture *textures; // in the order of the scene's list
    } texels;
    struct flat_array instances;                        // and their tables; without words: there are none
    uint32_t instance_count;                            // with instance 0, all that is not shared
    uint32_t top_nodes, instance_table, instance_shift; // as in the frame (shaders/frame.h)
    uint32_t coordinates_table;                         // also as in the frame
    struct flat_use *uses;                              // in the order of their first models
    uint32_t use_count;
    struct flat_bounce *bounces; // in IR order
    uint32_t bounce_count;
    uint32_t body_count, light_count, sphere_count;
    uint32_t cone_count;                   // in the trees of spheres
    uint32_t triangle_count;               // that the trees hold
    uint64_t shown_triangles;              // of all models: each instance shows those of its mesh
    uint32_t *first_triangle;              // by body: the number of its first triangle, or of a cone
    uint32_t dropped_triangles;            // without area after rounding
    struct sky_size sky;                   // rows 0: the background does not light
    uint32_t sky_table;                    // as in the frame
    uint32_t seen_table, seen_count;       // also as in the frame: lights that rays see
    double occlusion;                      // of ambient light: flat
    uint64_t features;                     // FEATURE_ bits that the scene needs
    uint32_t triangle_depth, sphere_depth; // levels of the trees: traversal stack size
    double build_seconds;                  // tree building
    uint32_t *normal_base, *instance_of;   // by body, as in its record
    // What decided how the geometry was made, besides the scene.
    enum flat_sharing sharing;
    enum bvh_method method;
    uint64_t most_triangles; // that it may have: a limit
    bool shares;             // its geometry belongs to another: flat_take
};

struct timeline;

struct flat_input {
    const struct scene *scene;
    const struct view *view;
    vec3 origin; // of single precision; scene units
    bool is_double;
    enum flat_sharing sharing;
    enum bvh_method method; // of the trees; pictures do not depend on it
    struct bvh_keep *keep;  // of trees; NULL: all are built
    // An earlier flat scene, with its scene, whose meshes still exist: if nothing that geometry depends on
    // has changed, its geometry is shared, whatever changed in materials and lights. NULL: none.
    const struct flat_scene *before;
    const struct limits *limits;
    struct diag_sink *sink;
    struct timeline *timeline; // may be NULL
};

// false: too large or no memory (the sink says which).
bool flatten(const struct flat_input *input, struct flat_scene *out);
// Writes texels [begin, end) of the background, whose picture must have its pixels, to `to`.
void flat_background(const struct flat_scene *flat, size_t begin, size_t end, void *to);
// Writes words [begin, end) of the texels of images on surfaces to `to`.
void flat_texels(const struct flat_scene *flat, uint64_t begin, uint64_t end, struct gpu_word *to);
// Whether the texels of two flat scenes, with their scenes, are the same.
bool flat_has_texels_of(const struct flat_scene *a, const struct flat_scene *b);
void flat_finish(struct flat_scene *flat);
// Makes a flat scene the owner of what it shares with the earlier one; if nothing is shared, nothing happens.
void flat_take(struct flat_scene *flat, struct flat_scene *before);

#endif
