// Which precision a scene needs, found by tracing some of its pixels.
//
// On a device: a small picture of the scene in single precision, compared as displayed with the reference
// tracer's. So everything that changes a pixel counts: slender triangles, gaps, checkers, cameras and lights
// close to a surface, mirrors and glass that magnify errors. Without one, the reference tracer draws the
// second picture too, with numbers rounded as a device in single precision rounds them: a forecast, the same
// on every machine. A scene with more than PRECISION_TRACED triangles is only measured
// (tracer/flatten/precision.h). Input: as flatten. Ownership: see precision_try. Thread safety: the gpu's
// thread; without one, pure.
#ifndef GLINT_MEASURE_PRECISION_H
#define GLINT_MEASURE_PRECISION_H

#include "tracer/flatten/precision.h"
#include "tracer/gpu/gpu.h"

#define PRECISION_TRACED 500000u     // triangles and spheres
#define PRECISION_OFF    (1.0 / 255) // of a displayed channel
#define PRECISION_SHARE  0.001       // of the pixels may differ by more
#define PRECISION_PART   0.75        // of that share, if the small picture is not the whole one

struct precision_choice {
    struct precision_report report; // what was measured
    bool traced;                    // pixels were traced
    bool on_device;                 // including those of single precision on the device
    uint32_t pixels, off;           // pixels compared, and those of them that differ
    double share;                   // estimated share of the picture's pixels that differ
    bool needs_double;
};

enum precision_status {
    PRECISION_DONE,
    PRECISION_MEMORY,
    PRECISION_SCENE,  // flattening failed; the sink has it
    PRECISION_DEVICE, // see gpu_error
    PRECISION_ENDED,  // `ready` stopped the trial
};

struct reference;
struct renderer;

// What a trial on a device leaves for reuse if single precision is enough.
struct precision_gains {
    bool has_flat;             // flat is the scene as flattened, the caller's to flat_finish;
    struct flat_scene flat;    // zeroed otherwise
    struct renderer *renderer; // over a flat scene that must be replaced: renderer_change; NULL: none
};

struct precision_trial {
    const struct flat_input *input; // is_double is ignored
    uint32_t width, height;         // of the picture
    uint32_t samples;               // of its pixels, the least if they differ; 0: 1
    struct gpu *gpu;                // NULL: none
    uint64_t features;              // compiled in besides what the scene needs
    // Receives the reference that drew on a device's behalf, to be used for the whole picture: it sees
    // input->view, and the caller destroys it. Stays NULL if there was none. May be NULL.
    struct reference **reference;
    // Called once everything that needs no background pixels is done; they must be there when it returns.
    // false: the trial ends. NULL: they are there.
    bool (*ready)(void *context);
    void *ready_context;
};

// *gains, which is the caller's to release, may be NULL.
enum precision_status precision_try(const struct precision_trial *trial, struct precision_choice *out,
                                    struct precision_gains *gains);
void precision_drop(struct precision_gains *gains);
// The precision in which a scene is traced: its own setting, or what the choice says.
bool precision_is_double(const struct ir_scene *ir, const struct precision_choice *choice);

#endif
