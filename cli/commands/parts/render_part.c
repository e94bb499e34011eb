// A render job that makes a part of a picture.
#include "cli/commands/parts/part_made.h"
#include "cli/commands/render_job.h"
#include "cli/device.h"
#include "core/hash128.h"
#include "core/heap.h"
#include "reference/cache.h"
#include "render/parts/parts.h"
#include "render/record/provenance.h"

#include <stdio.h>
#include <string.h>

static bool writes_part(const struct render_job *job) {
    bool writes = false;
    for (uint32_t i = 0; i < job->output_count; i++)
        writes |= job->outputs[i].is_part;
    return writes;
}

bool render_wants_part(const struct render_job *job) {
    const struct cli_part *part = &job->cli->options.part;
    return part->region[2] || part->tiles || part->has_samples || writes_part(job);
}

// ---- what does not go together

// The later one of those that ask for some of the samples.
static int samples_place(const struct cli *cli) {
    const int from = cli_option_place(cli, "samples-from"), to = cli_option_place(cli, "samples-to");
    return from > to ? from : to;
}

// The argument that asks for a part.
static int place_of(const struct render_job *job) {
    int place = cli_option_place(job->cli, "region");
    place = place ? place : cli_option_place(job->cli, "tile");
    place = place ? place : samples_place(job->cli);
    for (uint32_t i = 0; i < job->output_count && !place; i++)
        place = job->outputs[i].is_part ? job->outputs[i].arg : 0;
    return place;
}

// What cannot be said of, or done with, a part; NULL: nothing of it is asked for.
static const char *obstacle(const struct render_job *job) {
    const struct cli_options *o = &job->cli->options;
    if (cli_device_is_reference(job->cli))
        return "the reference renders whole pictures: choose a device";
    if (o->audit || o->has_max_off)
        return "an audit is about a whole picture: leave '--audit' and '--max-off' out";
    if (o->measure.time_s > 0)
        return "where a time ends a picture, its parts would have different samples: leave '--time' out";
    if (cli_option_place(job->cli, "max-error") || cli_option_place(job->cli, "max-time"))
        return "settings are chosen for a whole picture: choose them first, and write them into the scene";
    if (o->aovs)
        return "'--aov' is about a whole picture: leave it out";
    if (o->watch)
        return "'--watch' renders whole pictures: leave it out";
    return NULL;
}

int render_judge_part(struct render_job *job) {
    struct cli *cli = job->cli;
    if (!render_wants_part(job))
        return CLI_OK;
    if (cli_option_place(cli, "region") && cli_option_place(cli, "tile")) {
        const int status =
            cli_usage(cli, cli_option_place(cli, "tile"), "'--tile' and '--region' both say which pixels");
        diag_help(&cli->sink, "leave one of them out");
        return status;
    }
    const char *why = obstacle(job);
    return why ? cli_usage(cli, place_of(job), "this is not possible in parts: %s", why) : CLI_OK;
}

// ---- which part

static int plan_region(struct render_job *job) {
    struct cli *cli = job->cli;
    const struct cli_part *wish = &cli->options.part;
    struct part *part = &job->part;
    const uint32_t *r = wish->region;
    part->region = (struct part_region){0, 0, part->width, part->height};
    if (wish->region[2])
        part->region = (struct part_region){r[0], r[1], r[2], r[3]};
    if (wish->region[2] && ((uint64_t)r[0] + r[2] > part->width || (uint64_t)r[1] + r[3] > part->height))
        return cli_usage(cli, cli_option_place(cli, "region"),
                         "the region ends at %u,%u, and the picture has %u x %u pixels", r[0] + r[2],
                         r[1] + r[3], part->width, part->height);
    if (wish->tiles && !parts_cut(part->width, part->height, wish->tile, wish->tiles, &part->region)) {
        const int status = cli_usage(cli, cli_option_place(cli, "tile"),
                                     "a picture of %u rows has at most %u parts, of 8 rows each, not %u",
                                     part->height, parts_most(part->height), wish->tiles);
        diag_help(&cli->sink, "take fewer, or parts of its samples: --samples-from, --samples-to");
        return status;
    }
    return CLI_OK;
}

static int plan_samples(struct render_job *job) {
    const struct cli_part *wish = &job->cli->options.part;
    struct part *part = &job->part;
    part->first_sample = (uint32_t)wish->samples_from;
    part->end_sample = wish->samples_to ? (uint32_t)wish->samples_to : part->samples;
    if (part->first_sample < part->end_sample && part->end_sample <= part->samples)
        return CLI_OK;
    return cli_usage(job->cli, samples_place(job->cli),
                     "samples %u to %u, the last not included, are not of a picture with %u samples",
                     part->first_sample, part->end_sample, part->samples);
}

// Some of the samples are a part, and no picture.
static int judge_outputs(struct render_job *job) {
    const struct part *part = &job->part;
    const bool few = part->end_sample - part->first_sample < part->samples;
    for (uint32_t i = 0; i < job->output_count && few; i++) {
        const struct cli_output *output = &job->outputs[i];
        if (output->is_part)
            continue;
        const int status =
            cli_usage(job->cli, output->arg ? output->arg : place_of(job),
                      "some of the samples make no picture: '%s' does not end in " PART_ENDING, output->path);
        diag_help(&job->cli->sink, "write parts, -o NAME" PART_ENDING ", and join them: glint merge");
        return status;
    }
    return CLI_OK;
}

int render_plan_part(struct render_job *job) {
    const struct ir_image *image = job->session.image;
    struct part *part = &job->part;
    *part = (struct part){.width = (uint32_t)image->width,
                          .height = (uint32_t)image->height,
                          .samples = (uint32_t)image->samples,
                          .end_sample = (uint32_t)image->samples,
                          .display = {image->tone, image->transfer}};
    part->region = (struct part_region){0, 0, part->width, part->height};
    job->is_part = render_wants_part(job);
    if (!job->is_part)
        return CLI_OK;
    if (image->error > 0) {
        const int status = cli_usage(job->cli, place_of(job),
                                     "pixels that end by their error are not rendered in parts: the picture "
                                     "states an error of all its pixels");
        diag_help(&job->cli->sink, "give all pixels the same samples: --set image.error=0, without --noise");
        return status;
    }
    int status = plan_region(job);
    if (status == CLI_OK)
        status = plan_samples(job);
    return status == CLI_OK ? judge_outputs(job) : status;
}

// ---- rendering it

bool part_aim(struct shot *shot, const struct part *part) {
    shot->settings.width = part->region.width;
    shot->settings.height = part->region.height;
    shot->settings.whole_width = part->width;
    shot->settings.whole_height = part->height;
    shot->settings.first_x = part->region.x;
    shot->settings.first_y = part->region.y;
    shot->settings.whole_samples = part->samples;
    shot->settings.first_sample = part->first_sample;
    shot->settings.samples =
        part_planes(part) > 1 || part->samples > part->end_sample - part->first_sample ? 1 : part->samples;
    return renderer_change(shot->renderer, &shot->flat, &shot->settings);
}

bool render_aim_at_part(struct render_job *job) {
    return !job->is_part || part_aim(&job->shot, &job->part);
}

static size_t plane_floats(const struct part *part) {
    return heap_times(heap_times(part->region.width, part->region.height), 3);
}

// Samples one after the other, each into a plane of its own.
static enum shot_status take_samples(struct render_job *job, const struct render_progress *progress) {
    struct part *part = &job->part;
    const size_t floats = plane_floats(part);
    enum shot_status status = SHOT_OK;
    if (!part->rgb)
        part->rgb = heap_array(heap_times(floats, part_planes(part)), sizeof *part->rgb);
    if (!part->rgb)
        return shot_no_memory(&job->session, "the samples of the part");
    for (uint32_t i = 0; status == SHOT_OK && i < part_planes(part); i++) {
        job->shot.settings.first_sample = part->first_sample + i;
        if (!renderer_change(job->shot.renderer, &job->shot.flat, &job->shot.settings))
            return SHOT_DEVICE;
        status = shot_take(&job->shot, &job->image, progress, &job->stats.last);
        memcpy(part->rgb + i * floats, job->image.rgb, floats * sizeof *part->rgb);
    }
    return status;
}

enum shot_status render_take_part(struct render_job *job, const struct render_progress *progress) {
    const struct part *part = &job->part;
    return part->end_sample - part->first_sample < part->samples
               ? take_samples(job, progress)
               : shot_take(&job->shot, &job->image, progress, &job->stats.last);
}

// ---- its file

static void make_keys(const struct shot *shot, struct part *part) {
    const struct reference_input input = {.scene = &shot->session->resolved, .view = &shot->view};
    struct hash128 h;
    reference_input_key(&input, part->scene);
    hash128_begin(&h);
    hash128_text(&h, STR(GLINT_VERSION));
    hash128_whole(&h, shot->flat.is_double);
    hash128_whole(&h, shot->settings.features);
    hash128_whole(&h, shot->settings.path_segments);
    hash128_end(&h, part->settings);
}

void part_describe(struct cli *cli, const struct shot *shot, uint32_t camera, struct part *part) {
    make_keys(shot, part);
    snprintf(part->device, sizeof part->device, "%s", gpu_info(shot->gpu)->name);
    const struct provenance made = {.session = shot->session,
                                    .gpu = shot->gpu,
                                    .camera = camera,
                                    .is_double = shot->flat.is_double,
                                    .format = IMAGE_PNG};
    provenance_line(&made, &cli->arena, part->record, sizeof part->record);
}

void render_fill_part(struct render_job *job) {
    part_describe(job->cli, &job->shot, job->camera, &job->part);
}

void render_encode_part(struct render_job *job, struct strbuf *out) {
    struct part part;
    render_fill_part(job);
    part = job->part;
    if (!part.rgb)
        part.rgb = job->image.rgb;
    part_encode(&part, out);
}
