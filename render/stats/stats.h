// What a rendering reports of itself: times by stage, rays by kind, triangles, memory, device, its own error.
//
// Ownership: nothing is owned. Errors: the buffer's (`failed`). Thread safety: pure.
#ifndef GLINT_APP_STATS_H
#define GLINT_APP_STATS_H

#include "render/audit.h"
#include "render/shot.h"

struct timeline;

struct stats {
    double read_seconds, assets_seconds, device_seconds;   // device: opening it
    double flatten_seconds, build_seconds, upload_seconds; // build: the trees, a part of flatten
    double first_frame_seconds, encode_seconds;            // first: compiling included
    double count_seconds; // of tracing the last frame once more to count its rays; 0: they were counted while
                          // it was made, or not at all
    double median_device_seconds; // of the frames, by the device's own clock
    double median_frame_seconds, least_frame_seconds, most_frame_seconds;
    int32_t frames;
    struct render_statistics last;
    uint64_t scene_bytes, portion_bytes, triangles, dropped, spheres;
    uint32_t triangle_depth;
    uint64_t features;
    bool is_double;         // the precision that was used for tracing
    long peak_memory_bytes; // of the process
    char device[256];
    uint32_t width, height, samples;
    str camera;                             // its name; empty where the scene has none
    const struct render_estimate *estimate; // where pixels end by their error; NULL: all have `samples`
    double unused_error;                    // the scene's, if no pixel ends by it; 0: it has none
    bool has_rays;                          // they were counted
    bool has_audit;
    struct audit audit;
    struct timeline *timeline; // since `begun`, a time of the clock
    double begun;
};

void stats_text(const struct stats *stats, struct strbuf *out);
void stats_json(const struct stats *stats, struct strbuf *out);

#endif
