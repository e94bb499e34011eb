#include "cli/commands/bands/band_devices.h"

#include "cli/device.h"
#include "core/parallel.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    DEVICES_MAX = 32,
};

struct band_device {
    struct bands_run *run;
    struct gpu *gpu;
    struct renderer *renderer;
    struct render_settings settings;
    struct image band;
    struct progress progress; // which shows nothing
    struct parallel_task task;
    int status;
};

struct band_devices {
    struct band_device items[DEVICES_MAX];
    uint32_t count;
};

// ---- which

bool bands_spread(const struct cli *cli) {
    const char *wanted = cli_device_wanted(cli);
    if (!wanted || !CLI_HAS_DEVICES)
        return false;
    return strcmp(wanted, "all") == 0 ||
           (strchr(wanted, ',') && wanted[strspn(wanted, "0123456789,")] == '\0');
}

// ---- bands

uint32_t bands_claim(struct bands_run *run) {
    uint32_t band = run->bands.count;
    parallel_lock_take(&run->lock);
    while (run->next < run->bands.count && run->bands.done[run->next])
        run->next++;
    if (run->next < run->bands.count && !run->gives_up && interrupt_signal() == 0)
        band = run->next++;
    parallel_lock_give(&run->lock);
    return band;
}

void bands_aim(const struct bands_run *run, uint32_t band, struct render_settings *settings) {
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
    all->bands += band->bands;
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

// As the checkpoint has them, with places in the whole picture.
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

bool bands_keep(struct bands_run *run, uint32_t band, const float *rgb,
                const struct render_settings *settings, const struct render_statistics *made) {
    struct bands_faults faults;
    pack_faults(settings, made->faults, &faults);
    parallel_lock_take(&run->lock);
    add_statistics(&run->all, made);
    const bool kept = bands_put(&run->bands, band, rgb, &faults);
    run->gives_up |= !kept;
    parallel_lock_give(&run->lock);
    return kept;
}

// ---- a device besides the job's

static int take_band(struct band_device *d, uint32_t band) {
    struct bands_run *run = d->run;
    const struct shot *shot = run->r->job.shot;
    const struct render_progress progress = progress_callback(&d->progress);
    struct render_statistics made;
    bands_aim(run, band, &d->settings);
    if (d->renderer ? !renderer_change(d->renderer, &shot->flat, &d->settings)
                    : !(d->renderer = renderer_create(d->gpu, &shot->flat, &d->settings)))
        return CLI_DEVICE;
    const enum render_result result =
        renderer_render(d->renderer, &shot->view.camera, d->band.rgb, &progress, &made);
    if (result != RENDER_DONE)
        return result == RENDER_CANCELLED ? CLI_STOPPED : CLI_DEVICE;
    return bands_keep(run, band, d->band.rgb, &d->settings, &made) ? CLI_OK : CLI_FILE;
}

static void work(void *context) {
    struct band_device *d = context;
    struct bands_run *run = d->run;
    for (uint32_t band; d->status == CLI_OK && (band = bands_claim(run)) < run->bands.count;)
        d->status = take_band(d, band);
    parallel_lock_take(&run->lock);
    run->gives_up |= d->status == CLI_DEVICE;
    parallel_lock_give(&run->lock);
}

static bool is_equal(const struct gpu_device_info *a, const struct gpu_device_info *b) {
    return strcmp(a->name, b->name) == 0 && strcmp(a->driver, b->driver) == 0;
}

static int begin(struct bands_run *run, struct band_devices *devices, const char *number) {
    struct cli *cli = run->r->cli;
    const struct gpu_device_info *first = gpu_info(run->r->job.gpu);
    struct band_device *d = &devices->items[devices->count];
    const int status = cli_open_named(cli, number, &d->gpu);
    if (status != CLI_OK)
        return status;
    devices->count++;
    if (!is_equal(first, gpu_info(d->gpu))) {
        const int unequal =
            cli_usage(cli, cli_option_place(cli, "device"),
                      "the devices are different: '%s' and '%s' would not give the same bytes", first->name,
                      gpu_info(d->gpu)->name);
        diag_help(&cli->sink, "name equal ones; '--device all' takes those that are equal to the first");
        return unequal;
    }
    if (!image_init(&d->band, run->bands.part.region.width, run->bands.rows)) {
        cli_error(cli, DIAG_OUT_OF_MEMORY, run->path, NULL, "not enough memory for a band");
        return CLI_SCENE;
    }
    progress_begin(&d->progress, true);
    d->progress.patience = PROGRESS_PATIENCE;
    d->run = run;
    d->settings = run->r->job.shot->settings;
    d->settings.timeline = NULL;
    d->settings.background_later = false;
    parallel_start(&d->task, work, d);
    return CLI_OK;
}

// Numbers after the first of the list, or of all equal devices but the job's.
static int begin_all(struct bands_run *run, struct band_devices *devices) {
    struct cli *cli = run->r->cli;
    const char *wanted = cli_device_wanted(cli);
    const struct gpu_device_info *first = gpu_info(run->r->job.gpu);
    int status = CLI_OK;
    for (const char *p = strchr(wanted, ','); p && status == CLI_OK; p = strchr(p + 1, ',')) {
        const size_t length = strcspn(p + 1, ",");
        if (length && devices->count < DEVICES_MAX)
            status = begin(run, devices, arena_copy(&cli->arena, (str){p + 1, length}).ptr);
    }
    if (strcmp(wanted, "all") != 0)
        return status;
    struct gpu_device_info *items = ARENA_ARRAY(&cli->arena, struct gpu_device_info, DEVICES_MAX);
    char error[GPU_ERROR_BYTES] = "";
    uint32_t count = 0;
    if (gpu_list(items, DEVICES_MAX, &count, error) != GPU_OK)
        count = 0;
    for (uint32_t i = 0; i < count && i < DEVICES_MAX && status == CLI_OK; i++)
        if (items[i].number != first->number && is_equal(first, &items[i]))
            status = begin(run, devices, arena_format(&cli->arena, "%u", items[i].number).ptr);
    return status;
}

int bands_begin_devices(struct bands_run *run, struct band_devices **devices) {
    struct cli *cli = run->r->cli;
    *devices = NULL;
    if (!bands_spread(cli))
        return CLI_OK;
    *devices = ARENA_NEW(&cli->arena, struct band_devices);
    const int status = begin_all(run, *devices);
    if (status == CLI_OK && !cli->options.quiet)
        fprintf(stderr, "glint: bands on %u device%s\n", (*devices)->count + 1, (*devices)->count ? "s" : "");
    return status;
}

int bands_end_devices(struct bands_run *run, struct band_devices *devices) {
    int status = CLI_OK;
    for (uint32_t i = 0; devices && i < devices->count; i++) {
        struct band_device *d = &devices->items[i];
        parallel_wait(&d->task);
        if (d->status == CLI_DEVICE && status != CLI_DEVICE)
            cli_device_failed(run->r->cli, d->gpu);
        status = d->status != CLI_OK && status != CLI_DEVICE ? d->status : status;
        renderer_destroy(d->renderer);
        image_finish(&d->band);
        cli_close_device(run->r->cli, d->gpu);
    }
    return status;
}
