// What is known of each pixel besides its colour, as planes of numbers: the one table of these outputs, and
// how they are made from first hits. docs/aov.md says what each holds.
//
// Input: hits of a picture of one sample, by the device or by the reference, and the view that they were seen
// through. Output: floats, or whole numbers where the table says so, rows from the top, the channels of a
// pixel side by side. Lengths are scene units, directions and places those of the scene. Errors: false if
// there is no memory. Ownership: aov_finish frees the planes, and accepts zeroed ones. Thread safety: plain
// data; filling uses all processors.
#ifndef GLINT_RENDER_AOV_AOV_H
#define GLINT_RENDER_AOV_AOV_H

#include "load/session.h"
#include "scene/hits.h"
#include "scene/view.h"

// name, channels (as OpenEXR calls them), whether they are whole numbers, whether they are made from first
// hits. The last one is separate, so lists of names have no separator after it.
#define AOV_TABLE_BUT_LAST(X)                                                                                \
    X(DEPTH, "depth", "Z", false, true)                                                                      \
    X(NORMAL, "normal", "XYZ", false, true)                                                                  \
    X(POSITION, "position", "XYZ", false, true)                                                              \
    X(ALBEDO, "albedo", "RGB", false, true)                                                                  \
    X(OBJECT, "object", "X", true, true)                                                                     \
    X(MATERIAL, "material", "X", true, true)                                                                 \
    X(INDEX, "index", "X", true, true)                                                                       \
    X(SAMPLES, "samples", "X", true, false)                                                                  \
    X(ERROR, "error", "X", false, false)
#define AOV_TABLE_LAST(X) X(COST, "cost", "X", true, true)
#define AOV_TABLE(X)      AOV_TABLE_BUT_LAST(X) AOV_TABLE_LAST(X)

enum aov {
#define AOV_ENUM(id, name, channels, is_whole, of_hits) AOV_##id,
    AOV_TABLE(AOV_ENUM)
#undef AOV_ENUM
    AOVS,
};

#define AOV_ALTERNATIVE(id, name, channels, is_whole, of_hits) name "|"
#define AOV_ONE(id, name, channels, is_whole, of_hits)         name
// "depth|normal|...": for the table of options.
#define AOV_NAMES AOV_TABLE_BUT_LAST(AOV_ALTERNATIVE) AOV_TABLE_LAST(AOV_ONE)

enum {
    AOV_CHANNELS_MOST = 3,
};

struct aov_info {
    const char *name;
    const char *channels; // a letter each
    uint32_t channel_count;
    bool is_whole; // uint32_t; else float
    bool of_hits;  // aov_fill makes it; else aov_fill_samples
};
const struct aov_info *aov_info(enum aov aov);
// AOVS: there is none of this name.
enum aov aov_named(str name);
// Whether any of the wanted ones (bits of enum aov) is made from first hits.
bool aov_needs_hits(uint32_t wanted);

struct aov_planes {
    uint32_t width, height;
    uint32_t wanted;    // bits of enum aov
    void *planes[AOVS]; // NULL where it is not wanted
};

// Zeros. false: no memory.
bool aov_init(struct aov_planes *planes, uint32_t width, uint32_t height, uint32_t wanted);
void aov_finish(struct aov_planes *planes);
// Fills all planes that are made from hits: one hit per pixel.
void aov_fill(struct aov_planes *planes, const struct scene *scene, const struct view_camera *camera,
              const struct hit_pixel *hits);
// Fills the others, from arrays with a number per pixel. `error` NULL: unknown; `samples` NULL: all pixels
// have `all`.
void aov_fill_samples(struct aov_planes *planes, const float *error, const uint32_t *samples, uint32_t all);

// What one sample costs up to the first surface: the camera's ray, and the rays that the surface sends to
// lights, mirrored and refracted.
uint32_t aov_cost(const struct hit_pixel *hit);
// The material that is seen, an index into scene.materials; HIT_NONE: the background.
uint32_t aov_material(const struct scene *scene, const struct hit_pixel *hit);

#endif
