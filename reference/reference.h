// The reference: an independent tracer in double precision on the CPU, against which the device's tracer is
// measured.
//
// Input: a scene (scene/scene.h) and the view; never anything flattened. It has its own
// tree, its own intersections and its own shading, written from the language alone. Results do not depend on
// the number of threads. Geometry is kept relative to the camera's position, so that a scene far from 0 loses
// nothing. Positions that come in or go out are in scene units, relative to the scene's own origin.
// Ownership: scene and view must outlive the reference. Errors: NULL or REFERENCE_NO_MEMORY where
// memory ends; values that are not finite are counted and are not an error here.
// Thread safety: immutable once made; all calls may run at the same time.
#ifndef GLINT_REFERENCE_REFERENCE_H
#define GLINT_REFERENCE_REFERENCE_H

#include "core/limits.h"
#include "scene/hits.h"
#include "scene/view.h"

struct ir_image;

// Increased whenever what the reference computes changes: cached pictures of other versions are not used.
#define REFERENCE_VERSION 12

// How far paths are followed where the file's own limits do not apply.
#define REFERENCE_MIN_WEIGHT 1e-6
#define REFERENCE_MAX_DEPTH  200
#define REFERENCE_NO_SEGMENT UINT32_MAX

enum reference_test {
    REFERENCE_WATERTIGHT,       // Woop, Benthin, Wald 2013
    REFERENCE_MOELLER_TRUMBORE, // 1997; to test the other one against
};

// Whether bodies that show the same mesh share its triangles, which then are recomputed for each ray: hits
// are the same.
enum reference_sharing {
    REFERENCE_CHEAPER, // where that saves much memory
    REFERENCE_COPIES,  // never
    REFERENCE_SHARED,  // wherever that is possible; to test it
};

struct reference_input {
    const struct scene *scene;
    const struct view *view;
    enum reference_test test;
    bool no_tree; // every primitive is tested; to test the tree against
    // Numbers are like those of a device in single precision: places, directions and normals are rounded to
    // floats and moved by about the error of the operations that made them, the same in every run. Its
    // picture is wrong at about the same places, and as often, as that device's.
    bool as_single;
    bool few_rays; // the tree is built faster, and each ray takes longer; hits are the same
    bool no_bound; // statistics need not have brightest and bound, for which a background's whole image is
                   // read
    enum reference_sharing sharing;
    bool gradient; // in place of a background's image, which need not be decoded: a smooth one
};

struct reference_settings {
    uint32_t width, height; // pixels
    uint32_t samples;       // per pixel, at least 1
    uint32_t first_sample;  // number of the first of them (view_sample_offset); pictures begin with 0
    // Above 0: samples lie in a pixel at the points of a picture with this many samples (scene/points.h), as
    // when pixels end by their error. 0: view_sample_offset.
    uint32_t points_of;
    // Above 0: a pixel's footprint on images is that of this many samples, as when pixels end by their error:
    // each has at least that many. 0: that of `planned`.
    uint32_t footprint_of;
    // Above 0: lights, lens and roughness take points of this many samples, of which `samples` were traced,
    // as when a time limit ends a picture. 0: of `samples`.
    uint32_t planned;
    double apart;       // above 1: pixels drawn lie this many pixels apart, at their usual size; else 1 or 0
    uint32_t max_depth; // a surface this deep sends no ray
    double min_weight;  // rays of a lower weight are not followed
    bool cut_sees_background; // a ray cut by max_depth sees the background; else nothing
    // The most rays, including shadow rays, that one sample may take. At the limit as_file reports a fault;
    // else the rays not followed add to the weight left.
    uint64_t segments;
    bool as_file; // depth-first; else the heaviest ray first, so that little is left when segments run out
};

// as_file: max_depth, min_weight and depth_limit of the file, LIMIT_PATH_SEGMENTS. Else weight 1e-6, depth
// 200 and LIMIT_REFERENCE_SEGMENTS. Size and samples are those of `image`.
struct reference_settings reference_settings_of(const struct ir_scene *ir, const struct ir_image *image,
                                                const struct limits *limits, bool as_file);

struct reference_fault {
    uint32_t pixels; // how many; the other fields describe the first of them, by rows
    uint32_t x, y;
    uint32_t body; // last hit, in IR order; HIT_NONE: none
    uint32_t triangle;
    bool is_nested; // not finite because a ray would be inside more than SCENE_MEDIA_MOST media
};

struct reference_statistics {
    uint64_t primary, reflected, refracted, shadow; // rays traced
    uint64_t total_reflections;
    uint64_t unseen; // crossings between equal media, behind which the same ray goes on
    uint64_t cut_by_depth, cut_by_weight, cut_by_segments; // rays not followed
    uint32_t deepest;
    // Weight of the rays not followed, summed over a pixel and divided by its samples: the worst pixel's, and
    // the mean over all.
    double left_weight_most, left_weight_mean;
    double brightest; // of anything in view: background, direct light of a surface, pixel; one channel
    // left_weight_most * brightest: the most that following all rays could add to a pixel, unless they hit
    // something brighter than anything hit so far.
    double bound;
    struct reference_fault not_finite;    // the pixel is NaN
    struct reference_fault over_segments; // as_file: part of the pixel's light is missing
    struct reference_fault cut_short;     // else: `segments` ended the pixel's paths
    double seconds;
};

// `report` is called from any thread, one call at a time, with the share done, 0..1; false ends the work.
struct reference_progress {
    bool (*report)(void *context, double fraction);
    void *context;
};

enum reference_result {
    REFERENCE_DONE,
    REFERENCE_CANCELLED,
    REFERENCE_NO_MEMORY,
};

struct reference;

// NULL: no memory.
struct reference *reference_create(const struct reference_input *input);
void reference_destroy(struct reference *reference); // NULL does nothing
// Looks elsewhere from the same place: `view` differs from the input's only in its camera's direction, and
// must outlive the reference. Nothing else may use the reference meanwhile.
void reference_look(struct reference *reference, const struct view *view);

// width * height * 3 linear values, rows from the top: the mean of the samples, before tone and transfer; NaN
// in all three where a sample is not finite.
// `progress` and `statistics` may be NULL.
enum reference_result reference_render(const struct reference *reference,
                                       const struct reference_settings *settings, double *rgb,
                                       const struct reference_progress *progress,
                                       struct reference_statistics *statistics);
// width * height records: what sample 0 of each pixel hits, as if it were the only one.
enum reference_result reference_hits(const struct reference *reference,
                                     const struct reference_settings *settings, struct hit_pixel *hits,
                                     const struct reference_progress *progress);

// What reference_render gives one pixel: three values to `rgb`. false: no memory.
bool reference_pixel(const struct reference *reference, const struct reference_settings *settings, uint32_t x,
                     uint32_t y, double rgb[3]);

// ---- single rays

struct reference_hit {
    uint32_t body, triangle; // body HIT_NONE: nothing was hit
    double t;                // in lengths of the direction
    double b1, b2;           // weights of the triangle's second and third corner, as the file has them
    vec3 point;
    vec3 geometric;                 // unit, turned towards the ray
    vec3 shading;                   // unit, on the same side
    bool enters;                    // the ray comes from outside
    uint32_t material;              // in assets.materials
    vec3 start_back, start_through; // where a ray that leaves on the ray's side begins, and on the other side
};

// The direction need not be unit; a hit has 0 < t < t_max.
void reference_closest(const struct reference *reference, vec3 origin, vec3 direction, double t_max,
                       struct reference_hit *hit);
bool reference_occluded(const struct reference *reference, vec3 origin, vec3 direction, double t_max);
// The direction of the ray of a pixel's sample, unit; and where it begins, if `origin` is not NULL.
vec3 reference_camera_ray(const struct reference *reference, const struct reference_settings *settings,
                          uint32_t x, uint32_t y, uint32_t sample, vec3 *origin);

// ---- one sample, ray by ray

enum reference_kind {
    REFERENCE_PRIMARY,
    REFERENCE_REFLECTED,
    REFERENCE_REFRACTED,
};

// What a surface shows of its image: the pixel of its nearest level, from the top left.
struct reference_texel {
    bool is_there;
    bool of_highlight; // the specular colour's: the diffuse one has no image
    double u, v;       // coordinates of the surface
    double level;      // 0: the image itself; each further one is half the size
    uint32_t x, y;     // in the image itself
    uint32_t taps;     // texels that were averaged
    vec3 color;        // linear, not yet times the weight
};

struct reference_segment {
    enum reference_kind kind;
    uint32_t parent; // index in the log; REFERENCE_NO_SEGMENT for the camera's ray
    uint32_t depth;
    double weight;
    vec3 origin, direction;         // scene units; unit
    uint32_t body, triangle;        // body HIT_NONE: the background
    uint32_t material;              // in assets.materials; IR_NO_INDEX where nothing was hit
    uint32_t light;                 // body HIT_NONE: of the view, that the ray sees; IR_NO_INDEX: none
    bool enters;                    // the ray comes from outside the body
    bool passes;                    // it goes straight on, unseen: the medium is the same on both sides
    uint32_t medium;                // the body that fills the space that the ray goes through; HIT_NONE: air
    vec3 tint;                      // what is left of each channel at its end
    bool total_reflection;          // the refracted ray was turned back
    double distance;                // scene units; 0 where nothing was hit
    vec3 point, geometric, shading; // as in reference_hit; 0 where nothing was hit
    uint32_t considered, lit;       // as in struct hit_pixel
    vec3 radiance; // direct light of the surface, or the background; times weight and tint it is what the
                   // pixel gets
    struct reference_texel texel;
    double cut_weight; // of the rays that this surface would have sent but that were not followed
};

// Follows sample `sample` of pixel x, y and returns the number of rays; the first `capacity` are written.
// *radiance (may be NULL) is the sample's value. 0: no memory.
uint32_t reference_log(const struct reference *reference, const struct reference_settings *settings,
                       uint32_t x, uint32_t y, uint32_t sample, struct reference_segment *segments,
                       uint32_t capacity, vec3 *radiance);

#endif
