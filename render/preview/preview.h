// A small picture of a scene, soon: for people who edit it and have not saved.
//
// First a picture of a quarter of the width and height is drawn, which tells how long the rest takes; then as
// many of the requested pixels and samples as fit in the time. What a picture of the same scene needs again
// stays from one to the next (render/live/live.h). A device that fails is given up: from then on the
// reference draws. Errors: enum preview_state. Ownership: preview_destroy takes NULL; pictures are the
// caller's to finish. Thread safety: one thread at a time; `cancelled` may be set by any.
#ifndef GLINT_RENDER_PREVIEW_PREVIEW_H
#define GLINT_RENDER_PREVIEW_PREVIEW_H

#include "core/strbuf.h"
#include "load/session.h"

#include <stdatomic.h>

struct gpu;

// Where the device comes from. It is opened for the first picture, on the thread that draws it.
struct preview_devices {
    struct gpu *(*open)(void *context); // NULL: there is none
    void (*close)(void *context, struct gpu *gpu);
    void *context;
};

enum {
    PREVIEW_SIZE_LEAST = 16, // pixels of the longer side
    PREVIEW_SIZE_MOST = 1024,
    PREVIEW_SIZE = 320,
    PREVIEW_SAMPLES_MOST = 256,
    PREVIEW_SAMPLES = 4,
    PREVIEW_SHRINK = 4, // the first picture is smaller by that much, in width and in height
};
#define PREVIEW_SECONDS       1.0
#define PREVIEW_SECONDS_LEAST 0.1
#define PREVIEW_SECONDS_MOST  60.0

struct preview_wish {
    struct session_options session; // with width, height and samples of the picture
    str camera;                     // as session_camera has it
    double seconds;                 // for the first picture, and again for the rest; loading comes before
};

enum preview_state {
    PREVIEW_DRAWN,
    PREVIEW_BROKEN,    // preview_findings says why
    PREVIEW_CANCELLED, // by the caller
    PREVIEW_SLOW,      // not even the first picture was made in time
    PREVIEW_NO_MEMORY,
};

struct preview_picture {
    struct strbuf png;
    uint32_t width, height; // at most those of the wish
    uint32_t samples;
    bool by_device;
};

struct preview;

// `devices` may be NULL: the reference draws. It outlives the preview. NULL: no memory.
struct preview *preview_create(const struct preview_devices *devices);
void preview_destroy(struct preview *preview);
// *picture must be finished by preview_picture_finish, whatever the state.
enum preview_state preview_draw(struct preview *preview, const struct preview_wish *wish,
                                const atomic_bool *cancelled, struct preview_picture *picture);
void preview_picture_finish(struct preview_picture *picture);
// The session that was loaded last; NULL: none. The preview's, until the next picture.
struct session *preview_findings(struct preview *preview);
// What drew last: the device's name, or "reference".
const char *preview_device(const struct preview *preview);

#endif
