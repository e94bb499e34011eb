#include "render/job/job.h"

#include "core/heap.h"
#include "grammar/ir.h"

#include <string.h>

enum {
    TILE_ROWS = 8,
    BAND_PIXELS = 4 << 20,   // most pixels of a band: 48 MiB
    PATHS_OF_CPU = 2 << 20,  // in a band: about a second of a few processors
    PATHS_OF_GPU = 32 << 20, // enough to keep it busy
};

// ---- what draws

uint32_t job_band_rows(const struct job *job) {
    const struct part *part = &job->part;
    const bool is_cpu = gpu_info(job->gpu)->kind == GPU_CPU;
    const uint64_t paths = is_cpu ? PATHS_OF_CPU : PATHS_OF_GPU;
    const uint32_t wanted = (uint32_t)job->wish.band_rows;
    uint64_t pixels = paths / part->samples;
    pixels = pixels < BAND_PIXELS ? pixels : BAND_PIXELS;
    const uint32_t rows = wanted ? wanted + TILE_ROWS - 1 : (uint32_t)(pixels / part->region.width);
    return rows < TILE_ROWS ? TILE_ROWS : rows / TILE_ROWS * TILE_ROWS;
}

// The part of the picture that a shot begins with; width 0: all of it.
static struct shot_region first_region(const struct job *job) {
    const struct part_region *region = &job->part.region;
    if (!job->in_bands && !job->is_part)
        return (struct shot_region){0};
    const uint32_t rows = job->in_bands ? job_band_rows(job) : region->height;
    return (struct shot_region){region->x, region->y, region->width,
                                rows < region->height ? rows : region->height};
}

static enum shot_status open_reference(struct job *job) {
    return reference_shot_open(&job->reference, job->session, job->camera,
                               (struct reference_shot_options){job->wish.as_file, job->wish.no_cache});
}

enum shot_status job_open(struct job *job, uint32_t camera) {
    job->camera = camera;
    if (job_by_reference(job))
        return open_reference(job);
    const struct shot_wish wish = {.region = first_region(job),
                                   .counts = job->wish.counts && (job->in_bands || job->is_part),
                                   .audits = job->wish.audits,
                                   .ready = job->wish.ready,
                                   .ready_context = job->wish.ready_context};
    job->shot = &job->own;
    const enum shot_status status = shot_open_for(job->shot, job->session, job->gpu, camera, wish);
    return status == SHOT_OK ? job_aim(job) : status;
}

enum shot_status job_turn(struct job *job, uint32_t camera) {
    job->camera = camera;
    if (job_by_reference(job)) {
        reference_shot_close(&job->reference);
        return open_reference(job);
    }
    const enum shot_status status = shot_turn(job->shot, camera);
    return status == SHOT_OK ? job_aim(job) : status;
}

void job_follow(struct job *job, struct live *live) {
    job->session = live->session;
    job->gpu = live->gpu;
    job->camera = live->camera;
    job->shot = &live->shot;
}

void job_drop_layers(struct job *job) {
    if (job->layers)
        layers_finish(job->layers);
    job->layers = NULL;
    job->image.layers = NULL;
}

void job_close(struct job *job) {
    job_drop_layers(job);
    shot_close(&job->own);
    reference_shot_close(&job->reference);
    image_finish(&job->image);
    part_finish(&job->part);
    strbuf_finish(&job->note);
    strbuf_finish(&job->audit_note);
}

// ---- one frame

static bool has_all_samples(const struct part *part) {
    return part->end_sample - part->first_sample == part->samples;
}

// Bands are aimed at one by one.
enum shot_status job_aim(struct job *job) {
    const struct part *part = &job->part;
    struct render_settings *settings = &job->shot->settings;
    if (job->in_bands || !job->is_part)
        return SHOT_OK;
    settings->width = part->region.width;
    settings->height = part->region.height;
    settings->whole_width = part->width;
    settings->whole_height = part->height;
    settings->first_x = part->region.x;
    settings->first_y = part->region.y;
    settings->whole_samples = part->samples;
    settings->first_sample = part->first_sample;
    settings->samples = has_all_samples(part) ? part->samples : 1;
    return renderer_change(job->shot->renderer, &job->shot->flat, settings) ? SHOT_OK : SHOT_DEVICE;
}

// Samples one after the other, each into a plane of its own.
static enum shot_status take_samples(struct job *job, struct image *image,
                                     const struct render_progress *progress) {
    struct part *part = &job->part;
    struct shot *shot = job->shot;
    const size_t floats = heap_times(heap_times(part->region.width, part->region.height), 3);
    enum shot_status status = SHOT_OK;
    if (!part->rgb)
        part->rgb = heap_array(heap_times(floats, part_planes(part)), sizeof *part->rgb);
    if (!part->rgb)
        return shot_no_memory(job->session, "the samples of the part");
    for (uint32_t i = 0; status == SHOT_OK && i < part_planes(part); i++) {
        shot->settings.first_sample = part->first_sample + i;
        if (!renderer_change(shot->renderer, &shot->flat, &shot->settings))
            return SHOT_DEVICE;
        status = shot_take(shot, image, progress, &job->stats.last);
        memcpy(part->rgb + i * floats, image->rgb, floats * sizeof *part->rgb);
    }
    return status;
}

// Adapts a render_progress: both callbacks answer whether to continue.
static bool report(void *context, double fraction) {
    const struct render_progress *progress = context;
    return progress->report(progress->context, fraction);
}

enum shot_status job_frame(struct job *job, struct image *image, const struct render_progress *progress) {
    const struct reference_progress of_reference = {report, (void *)progress};
    if (job_by_reference(job))
        return reference_shot_take(&job->reference, image, NULL, &of_reference, &job->reference_statistics);
    return job->is_part && !has_all_samples(&job->part)
               ? take_samples(job, image, progress)
               : shot_take(job->shot, image, progress, &job->stats.last);
}

static bool report_share(void *context, double fraction) {
    const struct job_share *share = context;
    return share->all->report(share->all->context, (share->done + fraction) / share->count);
}

struct render_progress job_share_progress(struct job_share *share) {
    return (struct render_progress){report_share, share};
}
