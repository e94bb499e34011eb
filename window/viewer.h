// A window for flying through a live scene: all of `glint view`.
//
// After any change a picture of fewer pixels is there at once, then one of all pixels, then more samples as
// long as nothing happens. A picture of n samples equals, bit for bit, the one that `glint render` makes from
// the same place with as many samples and the same size. The scene follows its files (render/live/live.h).
// Errors: enum viewer_status; messages go to the host. Ownership: as live.h; the host outlives it. Thread
// safety: the main thread, which is the gpu's too.
#ifndef GLINT_WINDOW_VIEWER_H
#define GLINT_WINDOW_VIEWER_H

#include "picture/write/image.h"
#include "render/live/live.h"
#include "window/window.h"

enum viewer_status {
    VIEWER_DONE,
    VIEWER_BROKEN, // the scene has errors at the start: live_findings
    VIEWER_NO_MEMORY,
    VIEWER_DEVICE, // see gpu_error
};

// Who shows text and writes files.
struct viewer_host {
    void *context;
    void (*say)(void *context, str line); // what the user asked for: a pixel's body, or a camera
    // What a load has found, and what it did. `is_broken`: the previous picture stays.
    void (*loaded)(void *context, struct live *live, bool is_broken);
    // false: the host has said why.
    bool (*write)(void *context, const struct image *image, struct image_display display, uint32_t samples);
    bool (*is_over)(void *context); // a signal came
};

struct viewer_wish {
    struct live_wish live;
    const char *name; // of the scene, for the title
    bool is_xml;      // how cameras are printed
};

// Runs until the window is closed.
enum viewer_status viewer_run(const struct viewer_wish *wish, const struct viewer_host *host, struct gpu *gpu,
                              struct window *window, struct live *live);

#endif
