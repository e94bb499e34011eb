// One picture in bands while it is rendered. Private to cli/bands.
#ifndef GLINT_CLI_COMMANDS_BANDS_BANDS_RUN_H
#define GLINT_CLI_COMMANDS_BANDS_BANDS_RUN_H

#include "cli/commands/rendering.h"
#include "core/parallel.h"
#include "render/parts/bands.h"

struct bands_run {
    struct rendering *r;
    uint32_t camera;
    const char *path; // of the checkpoint
    struct bands bands;
    bool is_open;
    uint32_t found; // bands that another process had made
    struct image band;
    // What devices that work side by side share.
    struct parallel_lock lock;
    uint32_t next;                // the first band that nobody has taken
    bool gives_up;                // a device or the disk has failed
    struct render_statistics all; // of the bands that were made now
};

// The picture's files. A signal ends it: CLI_STOPPED.
int bands_write(struct bands_run *run);
// Files of what is there, beside the picture's.
int bands_write_partial(struct bands_run *run);

#endif
