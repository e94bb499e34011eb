// One picture in bands while it is rendered: its checkpoint, its devices and its files. Private to cli/bands.
#ifndef GLINT_CLI_COMMANDS_BANDS_BANDS_RUN_H
#define GLINT_CLI_COMMANDS_BANDS_BANDS_RUN_H

#include "cli/commands/rendering.h"
#include "render/job/job_bands.h"

struct bands_run {
    struct rendering *r;
    uint32_t camera;
    const char *path; // of the checkpoint
    struct job_bands work;
    bool is_open;   // the checkpoint
    uint32_t found; // bands that another process had made
    // Devices besides the job's.
    struct gpu *gpus[JOB_BAND_DEVICES_MOST];
    struct progress progress[JOB_BAND_DEVICES_MOST]; // which shows nothing
    uint32_t gpu_count;
};

// Writes the picture's files. A signal ends it: CLI_STOPPED.
int bands_write(struct bands_run *run);
// Writes files of the bands that are there, beside the picture's.
int bands_write_partial(struct bands_run *run);

// Whether --device names several: 'all', or numbers with commas between them.
bool bands_spread(const struct cli *cli);
// Begins these devices, besides the job's: CLI_OK, or an exit code with an error printed.
int bands_begin_devices(struct bands_run *run);

#endif
