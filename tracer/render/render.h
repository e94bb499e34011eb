// From a flat scene, a camera and a device to a picture of linear floats.
//
// A renderer holds the scene on the device and the compiled kernel, for as many frames as wanted. Pictures
// are made in portions (the tiles whose paths are in the device's memory at the same time), samples, slices
// and pieces (docs/decisions/numbers.md), which do not affect the result. Input: the flat scene is copied to
// the device, but must still outlive the renderer. Errors: RENDER_FAILED, with the text in gpu_error.
// Ownership: renderer_destroy takes NULL. Thread safety: a renderer belongs to its gpu's thread.
#ifndef GLINT_TRACER_RENDER_RENDER_H
#define GLINT_TRACER_RENDER_RENDER_H

#include "scene/hits.h"
#include "tracer/flatten/flatten.h"
#include "tracer/gpu/gpu.h"

// Methods of other tracers, to be compared with glint's own (shaders/alternatives.glsl); none is for
// pictures. An offset moves a ray's start along the normal by a number of scene units, and accepts hits at t
// > 0.
enum render_alternative {
    RENDER_ALTERNATIVE_NONE,
    RENDER_ALTERNATIVE_OFFSET_3,        // by 1e-3
    RENDER_ALTERNATIVE_OFFSET_4,        // by 1e-4
    RENDER_ALTERNATIVE_OFFSET_7,        // by 1e-7
    RENDER_ALTERNATIVE_OFFSET_DISTANCE, // by 1e-4 of the distance that the ray came, at least 1e-4
    RENDER_ALTERNATIVE_MOELLER,  // triangles by Moeller and Trumbore, rejecting determinants below 1e-7
    RENDER_ALTERNATIVE_ORIGINAL, // that, and the offset 1e-3
    RENDER_ALTERNATIVE_FUSED,    // glint's own, but the device's compiler may fuse operations
    RENDER_ALTERNATIVES,
};
// "offset 1e-3", for reports.
const char *render_alternative_name(enum render_alternative alternative);

struct timeline;

struct render_settings {
    uint32_t width, height; // pixels
    // For a part of a larger picture: the size of the whole, and which of its pixels is the part's first;
    // zeros: the picture is whole. If pixels end by their error, the first pixel begins a tile of 8x8, so
    // that a part has the tiles of the whole.
    uint32_t whole_width, whole_height, first_x, first_y;
    uint32_t samples;       // per pixel, at least 1
    uint32_t first_sample;  // number of the first of them (view_sample_offset); pictures begin with 0
    uint32_t whole_samples; // of the whole picture, if these samples are a part of it; 0: these are all
    double apart; // above 1: pixels drawn lie this many pixels apart, at their usual size; else 1 or 0
    uint32_t max_depth;
    double min_weight;
    vec3 background; // linear, times intensity
    double background_intensity;
    double background_rotation; // degrees about +y
    // FEATURE_ bits to compile in: at least those of the flat scene. Those of the renderer (slices, counters,
    // long rays) are added as needed.
    uint64_t features;
    uint64_t path_segments;              // LIMIT_PATH_SEGMENTS
    uint32_t slice_iterations;           // SLICE_ITERATIONS of shaders/frame.h; 0: slices of one ray
    enum render_alternative alternative; // in single precision only
    uint32_t workgroup;                  // invocations of a workgroup, at most 128; 0: a tile's
    uint32_t portion_tiles;  // most tiles of 8x8 pixels in a portion; 0: as many as its memory holds
    uint32_t dispatch_paths; // the most paths of a dispatch; 0: as many as should finish soon
    // Above 0: a pixel ends before it has all its samples if the error of its displayed colour, with 95 %
    // confidence over a tile, is at most this, 0..1, but not before it has `least_samples` (at least 4;
    // rounded up to a multiple of 4).
    double error;
    uint32_t least_samples;
    // How colours are displayed: `shown` gets 0..1. Needed with `error`.
    void (*show)(const void *context, const float *linear, size_t pixels, float *shown);
    const void *show_context;
    uint32_t places;           // most paths that a GPU saves at a time; 0: as many as its memory holds
    bool counts;               // after a frame that no limit ends, count its rays (renderer_count)
    bool background_later;     // the background has no pixels yet: renderer_background, before any frame
    struct timeline *timeline; // may be NULL
};

// The settings that scene, flat scene and limits ask for.
struct render_settings render_settings_of(const struct scene *scene, const struct flat_scene *flat,
                                          const struct limits *limits);

enum render_fault_kind {
    RENDER_NOT_FINITE = 1, // a value on the way was infinite or NaN; the pixel is NaN
    RENDER_SEGMENTS,       // more rays than path_segments; the rest of the sample is missing
    RENDER_FAULT_KINDS,
};

struct render_fault {
    uint32_t pixels; // how many pixels have this fault; the rest describes the first of them, by rows
    uint32_t x, y;
    bool has_body;     // something was hit before the fault
    uint32_t body;     // in IR order
    uint32_t triangle; // of the body, in file order; 0 for spheres
    bool is_nested;    // RENDER_NOT_FINITE: a ray would be inside more than SCENE_MEDIA_MOST media
};

struct render_rays {
    uint64_t primary, reflected, refracted, shadow;
    uint64_t cut_by_depth, cut_by_weight; // not sent
    uint64_t total_reflections;
    uint64_t unseen;       // crossings between equal media, behind which the same ray goes on
    uint64_t nodes, items; // tested; nodes of the trees; items are triangles and spheres
    uint32_t deepest;      // deepest level of a traced ray; the camera's is 0
    double lost_by_depth;  // largest weight of a ray cut at max_depth
    double lost_by_weight; // and below min_weight
};

struct render_statistics {
    double device_seconds; // on the device's clock, dispatches alone
    double wall_seconds;
    uint32_t samples;                               // per pixel; if pixels end by their error, at most
    uint64_t all_samples;                           // of all pixels
    uint32_t portions, dispatches, slices;          // slices: dispatches that resumed paths
    struct render_fault faults[RENDER_FAULT_KINDS]; // by kind
    struct render_rays rays;                        // if the settings ask for it
};

#define RENDER_ESTIMATE_CONFIDENCE 0.95
// What a picture whose pixels end by their error reports about itself, as displayed, 0..1.
struct render_estimate {
    float *error;      // by pixel, rows from the top: what ended the pixel, or would have
    uint32_t *samples; // that each pixel has
    uint32_t unknown;  // pixels that are not finite: their error is NaN, and not in the following
    double mean;       // root of the mean square of the error of all pixels and channels
    double most;       // the same, with confidence RENDER_ESTIMATE_CONFIDENCE
};

// Called between dispatches with the share done, 0..1; false ends the frame.
struct render_progress {
    bool (*report)(void *context, double fraction);
    void *context;
};

// What ends a frame before it has all its samples; the first sample is always made.
struct render_limit {
    // Called with the number of samples that all pixels have so far, fewer than asked for; `rgb` is their
    // picture after the first sample, else undefined. false: the frame ends with these.
    bool (*goes_on)(void *context, uint32_t samples, const float *rgb);
    // Called between dispatches after the first sample; true: the frame ends, without the sample in progress.
    bool (*is_over)(void *context);
    void *context;
    bool shows_each; // `rgb` is their picture after each sample
};

enum render_result {
    RENDER_DONE,
    RENDER_CANCELLED,
    RENDER_FAILED,
};

struct renderer;

// NULL on failure: see gpu_error.
struct renderer *renderer_create(struct gpu *gpu, const struct flat_scene *flat,
                                 const struct render_settings *settings);
void renderer_destroy(struct renderer *renderer);
// Changes settings, or features of the flat scene, for data already on the device: `flat` is the renderer's
// own or a copy of it. Recompiles if needed. false: see gpu_error; then the renderer can only be destroyed.
bool renderer_change(struct renderer *renderer, const struct flat_scene *flat,
                     const struct render_settings *settings);
// What renderer_update wrote to the device.
struct render_update {
    uint32_t arrays; // arrays written, in part or whole; the background is one
    uint64_t bytes;
};
// Replaces `old`, the renderer's flat scene or a copy of it, by another: only differences go to the device,
// and kernels are compiled only if they do not fit. Features that the renderer has but the scene does not
// need stay in its kernels, which changes no bit of a picture. *done may be NULL. false: see gpu_error; then
// the renderer can only be destroyed.
bool renderer_update(struct renderer *renderer, const struct flat_scene *old, const struct flat_scene *flat,
                     const struct render_settings *settings, struct render_update *done);
// Compiles the kernel in which the renderer's later frames begin, if it differs from the first frame's.
// false: see gpu_error.
bool renderer_warm(struct renderer *renderer);
// Copies the background's pixels to the device, if background_later left them out. false: see gpu_error.
bool renderer_background(struct renderer *renderer);
// Renders a frame into width * height * 3 floats, rows from the top: the mean of the samples, before tone
// and transfer; NaN in all three where a sample has the fault RENDER_NOT_FINITE. `progress` may be NULL.
enum render_result renderer_render(struct renderer *renderer, const struct view_camera *camera, float *rgb,
                                   const struct render_progress *progress,
                                   struct render_statistics *statistics);
// The estimate of the last frame that renderer_render made with settings.error; valid until the next one.
// NULL: there was none.
const struct render_estimate *renderer_estimate(const struct renderer *renderer);
// The same as renderer_render until `limit` ends it: the picture is that of statistics->samples samples, bit
// for bit. It needs 32 bytes per pixel more.
enum render_result renderer_render_until(struct renderer *renderer, const struct view_camera *camera,
                                         float *rgb, const struct render_progress *progress,
                                         const struct render_limit *limit,
                                         struct render_statistics *statistics);
// Renders the frame with a kernel that counts, whatever the settings say, and discards the picture.
enum render_result renderer_count(struct renderer *renderer, const struct view_camera *camera,
                                  const struct render_progress *progress, struct render_rays *rays);
// What each pixel's first ray hits (scene/hits.h), by the tracer's own code: width * height entries, rows
// from the top. Sends, per pixel, the camera's ray, one to each of the first 32 lights that would add
// something, and the mirrored and refracted rays if they have a weight (total reflection mirrors), whatever
// max_depth and min_weight say. The numbers are those of the picture that renderer_render makes.
enum render_result renderer_hits(struct renderer *renderer, const struct view_camera *camera,
                                 struct hit_pixel *out, const struct render_progress *progress);
// The same for the camera's rays only, through a sample's place in the pixel (view_sample_offset) and the
// middle of the lens: the results of later rays are 0 or HIT_NONE.
enum render_result renderer_first_hits(struct renderer *renderer, const struct view_camera *camera,
                                       uint32_t sample, struct hit_pixel *out,
                                       const struct render_progress *progress);
// Rays of the last renderer_hits that did not end; what they would have hit is reported as nothing.
uint64_t renderer_hits_unfinished(const struct renderer *renderer);

enum render_ray {
    RENDER_RAY_CAMERA,
    RENDER_RAY_REFLECTED,
    RENDER_RAY_REFRACTED,
};

// A ray of a sample's path. Numbers are the kernel's own, converted to doubles and scene units.
struct render_segment {
    enum render_ray kind;
    uint32_t parent; // index in the log; UINT32_MAX for the camera's ray
    uint32_t depth;  // max_depth + 1: not traced, sees what depth_limit says
    double weight;
    vec3 origin, direction;         // scene units; unit
    uint32_t body, triangle;        // as in struct hit_pixel
    uint32_t material;              // in assets.materials; UINT32_MAX where nothing was hit
    uint32_t light;                 // body HIT_NONE: of the view, that the ray sees; UINT32_MAX: none
    bool enters;                    // the ray comes from outside the body
    bool passes;                    // it goes straight on, unseen: the medium is the same on both sides
    uint32_t medium;                // the body that fills the space that the ray goes through; HIT_NONE: air
    vec3 tint;                      // what is left of each channel at its end
    bool total_reflection;          // the refracted ray was turned back
    bool unfinished;                // a ray to it or to a light did not end
    double distance;                // scene units; 0 where nothing was hit
    vec3 point, geometric, shading; // scene units; unit, towards the ray; 0 where nothing was hit
    uint32_t considered, lit;       // as in struct hit_pixel
    vec3 radiance;     // direct light of the surface, or the background; times weight and tint it is what the
                       // pixel gets
    double cut_weight; // of the rays that this surface would have sent but that were not followed
};

struct render_log {
    struct render_segment *segments; // the caller's, in the order in which the tracer adds them
    uint32_t capacity, count;
    bool whole;   // false: `capacity` ended the path
    float rgb[3]; // of the sample; if whole and the pixel's only sample, bit for bit the picture's
};

// Follows one sample of one pixel and logs each ray.
enum render_result renderer_log(struct renderer *renderer, const struct view_camera *camera, uint32_t x,
                                uint32_t y, uint32_t sample, struct render_log *log);

// Bytes on the device: of the scene, and of a portion.
uint64_t renderer_scene_bytes(const struct renderer *renderer);
uint64_t renderer_portion_bytes(const struct renderer *renderer);

#endif
