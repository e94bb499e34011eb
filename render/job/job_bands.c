#include "render/job/job_bands.h"

#include "core/clock.h"
#include "core/timeline.h"

#include <string.h>

struct job_band_device {
    struct job_bands *run;
    struct gpu *gpu;
    struct renderer *renderer;
    struct render_settings settings;
    struct render_progress progress;
    struct image band;
    struct parallel_task task;
    enum shot_status status;
};

// ---- bands

// Claims a band that is missing and that nobody works on. The number of bands: none is left, or no more are
// begun.
static uint32_t claim(struct job_bands *run) {
    uint32_t band = run->bands.count;
    parallel_lock_take(&run->lock);
    while (run->next < run->bands.count && run->bands.done[run->next])
        run->next++;
    if (run->next < run->bands.count && !run->gives_up && !run->is_stopped())
        band = run->next++;
    parallel_lock_give(&run->lock);
    return band;
}

static void aim(const struct job_bands *run, uint32_t band, struct render_settings *settings) {
    const struct part *part = &run->bands.part;
    settings->width = part->region.width;
    settings->height = bands_rows(&run->bands, band);
    settings->whole_width = part->width;
    settings->whole_height = part->height;
    settings->first_x = part->region.x;
    settings->first_y = part->region.y + bands_begin(&run->bands, band);
}

static void add_statistics(struct render_statistics *all, const struct render_statistics *band) {
    const struct render_rays *from = &band->rays;
    struct render_rays *to = &all->rays;
    all->device_seconds += band->device_seconds;
    all->wall_seconds += band->wall_seconds;
    all->samples = band->samples;
    all->all_samples += band->all_samples;
    all->portions += band->portions;
    all->dispatches += band->dispatches;
    all->slices += band->slices;
    to->primary += from->primary;
    to->reflected += from->reflected;
    to->refracted += from->refracted;
    to->shadow += from->shadow;
    to->cut_by_depth += from->cut_by_depth;
    to->cut_by_weight += from->cut_by_weight;
    to->total_reflections += from->total_reflections;
    to->unseen += from->unseen;
    to->nodes += from->nodes;
    to->items += from->items;
    to->deepest = from->deepest > to->deepest ? from->deepest : to->deepest;
    to->lost_by_depth = from->lost_by_depth > to->lost_by_depth ? from->lost_by_depth : to->lost_by_depth;
    to->lost_by_weight =
        from->lost_by_weight > to->lost_by_weight ? from->lost_by_weight : to->lost_by_weight;
}

// Packs faults as the checkpoint has them, with positions in the whole picture.
static void pack_faults(const struct render_settings *settings, const struct render_fault *faults,
                        struct bands_faults *out) {
    *out = (struct bands_faults){0};
    for (int kind = 1; kind < RENDER_FAULT_KINDS; kind++) {
        const struct render_fault *f = &faults[kind];
        const uint32_t words[BANDS_FAULT_WORDS] = {f->pixels,
                                                   f->x + settings->first_x,
                                                   f->y + settings->first_y,
                                                   f->has_body,
                                                   f->body,
                                                   f->triangle,
                                                   f->is_nested};
        if (f->pixels)
            memcpy(out->words[kind - 1], words, sizeof words);
    }
}

// Writes a band that was made with these settings.
static enum shot_status keep(struct job_bands *run, uint32_t band, const float *rgb,
                             const struct render_settings *settings, const struct render_statistics *made) {
    struct bands_faults faults;
    pack_faults(settings, made->faults, &faults);
    parallel_lock_take(&run->lock);
    add_statistics(&run->all, made);
    const bool kept = bands_put(&run->bands, band, rgb, &faults);
    run->gives_up |= !kept;
    parallel_lock_give(&run->lock);
    return kept ? SHOT_OK : SHOT_ENDED;
}

void job_bands_give_up(struct job_bands *run) {
    parallel_lock_take(&run->lock);
    run->gives_up = true;
    parallel_lock_give(&run->lock);
}

// ---- a device besides the job's

static enum shot_status take_beside(struct job_band_device *d, uint32_t band) {
    struct job_bands *run = d->run;
    const struct shot *shot = run->job->shot;
    struct render_statistics made;
    aim(run, band, &d->settings);
    if (d->renderer ? !renderer_change(d->renderer, &shot->flat, &d->settings)
                    : !(d->renderer = renderer_create(d->gpu, &shot->flat, &d->settings)))
        return SHOT_DEVICE;
    const enum shot_status status =
        shot_status_of(renderer_render(d->renderer, &shot->view.camera, d->band.rgb, &d->progress, &made));
    return status == SHOT_OK ? keep(run, band, d->band.rgb, &d->settings, &made) : status;
}

static void work(void *context) {
    struct job_band_device *d = context;
    for (uint32_t band; d->status == SHOT_OK && (band = claim(d->run)) < d->run->bands.count;)
        d->status = take_beside(d, band);
    if (d->status == SHOT_DEVICE)
        job_bands_give_up(d->run);
}

bool job_bands_add_device(struct job_bands *run, struct gpu *gpu, struct render_progress progress) {
    struct job_band_device *d = ARENA_NEW(run->job->arena, struct job_band_device);
    *d = (struct job_band_device){
        .run = run, .gpu = gpu, .progress = progress, .settings = run->job->shot->settings};
    if (!image_init(&d->band, run->bands.part.region.width, run->bands.rows))
        return false;
    d->settings.timeline = NULL;
    d->settings.background_later = false;
    run->devices[run->device_count++] = d;
    parallel_start(&d->task, work, d);
    return true;
}

const struct gpu *job_bands_failed(const struct job_bands *run) {
    for (uint32_t i = 0; i < run->device_count; i++)
        if (run->devices[i]->status == SHOT_DEVICE)
            return run->devices[i]->gpu;
    return NULL;
}

// ---- all of them

bool job_bands_begin(struct job_bands *run) {
    run->begun = clock_seconds();
    parallel_lock_begin(&run->lock);
    return image_init(&run->band, run->bands.part.region.width, run->bands.rows);
}

static enum shot_status take(struct job_bands *run, uint32_t band, const struct render_progress *progress) {
    struct shot *shot = run->job->shot;
    struct job_share one = {progress, run->bands.done_count, run->bands.count};
    const struct render_progress of_band = job_share_progress(&one);
    struct render_statistics made;
    aim(run, band, &shot->settings);
    if (!renderer_change(shot->renderer, &shot->flat, &shot->settings))
        return SHOT_DEVICE;
    const enum shot_status status = shot_take_silently(shot, &run->band, &of_band, &made);
    return status == SHOT_OK ? keep(run, band, run->band.rgb, &shot->settings, &made) : status;
}

static void note_statistics(struct job_bands *run) {
    struct stats *s = &run->job->stats;
    s->last = run->all;
    s->frames = 1;
    s->first_frame_seconds = s->least_frame_seconds = s->most_frame_seconds = s->median_frame_seconds =
        clock_seconds() - run->begun;
    s->median_device_seconds = run->all.device_seconds;
    run->job->shot->settings.height = run->bands.part.region.height;
}

enum shot_status job_bands_take(struct job_bands *run, const struct render_progress *progress) {
    enum shot_status status = SHOT_OK;
    for (uint32_t band; status == SHOT_OK && (band = claim(run)) < run->bands.count;)
        status = take(run, band, progress);
    if (status != SHOT_OK)
        job_bands_give_up(run);
    for (uint32_t i = 0; i < run->device_count; i++) {
        struct job_band_device *d = run->devices[i];
        parallel_wait(&d->task);
        renderer_destroy(d->renderer);
        image_finish(&d->band);
    }
    timeline_add(run->job->wish.timeline, "bands", STR(""), run->begun);
    note_statistics(run);
    return status;
}

void job_bands_finish(struct job_bands *run) {
    if (!(run->begun > 0))
        return;
    image_finish(&run->band);
    parallel_lock_end(&run->lock);
}

// ---- what was wrong

// Adds a band's faults to those of the bands above.
static void add_faults(const struct bands_faults *in, struct render_fault *faults) {
    for (int kind = 1; kind < RENDER_FAULT_KINDS; kind++) {
        const uint32_t *words = in->words[kind - 1], before = faults[kind].pixels;
        if (words[0] && before == 0)
            faults[kind] = (struct render_fault){.x = words[1],
                                                 .y = words[2],
                                                 .has_body = words[3] != 0,
                                                 .body = words[4],
                                                 .triangle = words[5],
                                                 .is_nested = words[6] != 0};
        faults[kind].pixels = before + words[0];
    }
}

void job_bands_report_faults(struct job_bands *run) {
    struct render_fault faults[RENDER_FAULT_KINDS] = {0};
    for (uint32_t i = 0; i < run->bands.count; i++)
        add_faults(&run->bands.faults[i], faults);
    shot_report_faults(run->job->shot, faults);
}
