// One `glint render`: what its two tracers, the device's and the reference, share. Private to cli.
#ifndef GLINT_CLI_RENDER_JOB_H
#define GLINT_CLI_RENDER_JOB_H

#include "app/shot.h"
#include "cli/cli.h"
#include "cli/progress.h"
#include "cli/stats.h"

struct render_job {
    struct cli *cli;
    struct session session;
    struct gpu *gpu;
    struct shot shot;
    struct image image;
    struct stats stats;
    struct progress progress;
    enum image_format format;
    const char *output; // without the camera's name
    bool all_cameras;
};

// Where a camera's picture goes.
const char *render_output_of(struct render_job *job, uint32_t camera);
// These return an exit code.
int render_interrupted(struct render_job *job);
int render_write_picture(struct render_job *job, const char *path);

// render_reference.c: session and output are ready; `first` to before `end` are the cameras. Returns an exit
// code.
int render_by_reference(struct render_job *job, uint32_t first, uint32_t end);

#endif
