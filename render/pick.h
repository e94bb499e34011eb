// What is seen at one pixel, and the path of its ray: as the device's tracer sees it, and as the reference
// does.
//
// Errors: as render/shot.h. Ownership: pick_finish frees the logs; the session must outlive the pick.
// Thread safety: the gpu's thread.
#ifndef GLINT_RENDER_PICK_H
#define GLINT_RENDER_PICK_H

#include "core/strbuf.h"
#include "reference/reference.h"
#include "render/shot.h"

enum {
    PICK_SEGMENTS_MAX = 4096,  // rays of a path that are reported
    PICK_DIFFERENCES_MAX = 16, // that are reported
    PICK_SAMPLES_MAX = 16,     // whose colours are reported
};

// One tracer's path, in the reference's words. Rays deeper than max_depth are not traced: they see the
// background.
struct pick_log {
    struct reference_segment *segments;
    uint32_t count;
    bool whole; // else PICK_SEGMENTS_MAX ended it
    // Of the sample; in the device's log only what the logged rays add, while the reference follows all rays.
    vec3 color;
};

enum pick_difference_kind {
    PICK_OTHER_BODY, // or another triangle
    PICK_OTHER_LIGHTS,
    PICK_OTHER_DISTANCE, // by more than PICK_DISTANCE_ERROR of it
    PICK_OTHER_COLOR,    // of the same lights or background, by more than PICK_COLOR_ERROR
    PICK_OTHER_RAYS,     // one sends a ray that the other, whose log is whole, does not
};
#define PICK_DISTANCE_ERROR 1e-4
#define PICK_COLOR_ERROR    (1.0 / 255) // of 1, or of what the ray adds to the pixel if that is more

struct pick_difference {
    enum pick_difference_kind kind;
    uint32_t device, reference; // the ray in each log
};

struct pick {
    struct session *session;
    uint32_t x, y, sample;
    str camera;
    str device;     // its name; empty: only the reference
    bool is_double; // the device's precision
    uint32_t max_depth;
    struct pick_log logs[2];                // device, reference
    vec3 samples[2][PICK_SAMPLES_MAX];      // the colours of the first samples
    bool is_sample_whole[PICK_SAMPLES_MAX]; // else the device's colour is of PICK_SEGMENTS_MAX rays
    uint32_t sample_count;
    struct pick_difference differences[PICK_DIFFERENCES_MAX];
    uint32_t difference_count; // reported or not
};

enum {
    PICK_DEVICE,
    PICK_REFERENCE
};

// The path of a sample of pixel x, y of the session's picture. `gpu` NULL: only the reference.
enum shot_status pick_take(struct pick *pick, struct session *session, struct gpu *gpu, uint32_t camera,
                           uint32_t x, uint32_t y, uint32_t sample);
void pick_finish(struct pick *pick); // accepts NULL and zeroed ones

void pick_text(const struct pick *pick, struct strbuf *out);
void pick_json(const struct pick *pick, struct strbuf *out);

#endif
