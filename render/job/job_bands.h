// A job's picture in bands: each is on the disk before the next one begins, so a process needs memory for
// only one, and another process can go on. Several devices may share the work: each takes the next band that
// nobody has.
//
// A band's bytes are those of its device, so only devices of one name and driver share a picture. Errors:
// enum shot_status, and bands.spool.error for the checkpoint. Ownership: job_bands_finish frees all but the
// job and what the caller owns: the checkpoint and the devices. Thread safety: the thread of the job's
// device; callbacks of other devices come from threads of their own.
#ifndef GLINT_RENDER_JOB_JOB_BANDS_H
#define GLINT_RENDER_JOB_JOB_BANDS_H

#include "core/parallel.h"
#include "render/job/job.h"
#include "render/parts/bands.h"

struct job_band_device;

enum {
    JOB_BAND_DEVICES_MOST = 32,
};

struct job_bands {
    struct job *job;
    struct bands bands;       // the checkpoint, which the caller has opened
    bool (*is_stopped)(void); // true: no further band is begun
    struct image band;
    double begun;
    struct job_band_device *devices[JOB_BAND_DEVICES_MOST]; // besides the job's
    uint32_t device_count;
    // What devices that work side by side share.
    struct parallel_lock lock;
    uint32_t next;                // the first band that nobody has taken
    bool gives_up;                // a device or the disk has failed
    struct render_statistics all; // of the bands that were made now
};

// The caller has set job, bands and is_stopped. false: there is no memory for a band.
bool job_bands_begin(struct job_bands *run);
// Starts another device, on a thread of its own (at most JOB_BAND_DEVICES_MOST); `progress` is asked there
// whether to go on. false: as above.
bool job_bands_add_device(struct job_bands *run, struct gpu *gpu, struct render_progress progress);
// Begins no further bands.
void job_bands_give_up(struct job_bands *run);
// Makes all bands that are left, until something fails or ends it, and waits for the other devices. Returns
// the status of the job's device; bands.done_count says whether all bands are there, bands.spool.error what
// kept them from the disk.
enum shot_status job_bands_take(struct job_bands *run, const struct render_progress *progress);
// The first of the other devices that has failed; NULL: none has.
const struct gpu *job_bands_failed(const struct job_bands *run);
// Reports the faults of all bands, as errors in the session's sink.
void job_bands_report_faults(struct job_bands *run);
// Accepts one that was not begun.
void job_bands_finish(struct job_bands *run);

#endif
