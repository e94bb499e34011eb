// A session through one camera by the double-precision reference.
//
// Errors: as render/shot.h; there is no device. Ownership: reference_shot_close frees all except the session,
// which must outlive it. Thread safety: one thread.
#ifndef GLINT_RENDER_REFERENCE_SHOT_H
#define GLINT_RENDER_REFERENCE_SHOT_H

#include "load/session.h"
#include "picture/write/image.h"
#include "reference/cache.h"
#include "render/shot.h"

struct reference_shot_options {
    bool as_file;  // obey max_depth, min_weight and depth_limit
    bool no_cache; // neither read nor written
};

struct reference_shot {
    struct session *session;
    struct view view;
    struct reference_settings settings;
    struct reference_source source; // for hits and single rays too
    char *store_path;
};

// `camera` is an index of session_camera. Leaves what reference_shot_close accepts, whatever the status.
enum shot_status reference_shot_open(struct reference_shot *shot, struct session *session, uint32_t camera,
                                     struct reference_shot_options options);
void reference_shot_close(struct reference_shot *shot);
// A picture of settings.width x settings.height; `rgb` (may be NULL) gets it in double, three per pixel.
// Faulty pixels become errors in the session's sink, and those whose paths `segments` ended a warning.
enum shot_status reference_shot_take(struct reference_shot *shot, struct image *image, double *rgb,
                                     const struct reference_progress *progress,
                                     struct reference_statistics *statistics);

#endif
