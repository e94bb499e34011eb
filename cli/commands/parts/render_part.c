// A render job that makes a part of a picture.
#include "cli/commands/parts/part_made.h"
#include "cli/commands/rendering.h"
#include "cli/device.h"
#include "core/hash128.h"
#include "core/heap.h"
#include "reference/cache.h"
#include "render/parts/parts.h"
#include "render/record/provenance.h"

#include <stdio.h>
#include <string.h>

static bool writes_part(const struct rendering *r) {
    bool writes = false;
    for (uint32_t i = 0; i < r->output_count; i++)
        writes |= r->outputs[i].is_part;
    return writes;
}

bool render_wants_part(const struct rendering *r) {
    const struct cli_part *part = &r->cli->options.part;
    return part->region[2] || part->tiles || part->has_samples || writes_part(r);
}

// ---- what does not go together

// The later one of those that ask for some of the samples.
static int samples_place(const struct cli *cli) {
    const int from = cli_option_place(cli, "samples-from"), to = cli_option_place(cli, "samples-to");
    return from > to ? from : to;
}

// The argument that asks for a part.
static int place_of(const struct rendering *r) {
    int place = cli_option_place(r->cli, "region");
    place = place ? place : cli_option_place(r->cli, "tile");
    place = place ? place : samples_place(r->cli);
    for (uint32_t i = 0; i < r->output_count && !place; i++)
        place = r->outputs[i].is_part ? r->outputs[i].arg : 0;
    return place;
}

// What cannot be said of, or done with, a part; NULL: nothing of it is asked for.
static const char *obstacle(const struct rendering *r) {
    const struct cli_options *o = &r->cli->options;
    if (cli_device_is_reference(r->cli))
        return "the reference renders whole pictures: choose a device";
    if (o->audit || o->has_max_off)
        return "an audit is about a whole picture: leave '--audit' and '--max-off' out";
    if (o->measure.time_s > 0)
        return "where a time ends a picture, its parts would have different samples: leave '--time' out";
    if (cli_option_place(r->cli, "max-error") || cli_option_place(r->cli, "max-time"))
        return "settings are chosen for a whole picture: choose them first, and write them into the scene";
    if (o->aovs)
        return "'--aov' is about a whole picture: leave it out";
    if (o->watch)
        return "'--watch' renders whole pictures: leave it out";
    return NULL;
}

int render_judge_part(struct rendering *r) {
    struct cli *cli = r->cli;
    if (!render_wants_part(r))
        return CLI_OK;
    if (cli_option_place(cli, "region") && cli_option_place(cli, "tile")) {
        const int status =
            cli_usage(cli, cli_option_place(cli, "tile"), "'--tile' and '--region' both say which pixels");
        diag_help(&cli->sink, "leave one of them out");
        return status;
    }
    const char *why = obstacle(r);
    return why ? cli_usage(cli, place_of(r), "this is not possible in parts: %s", why) : CLI_OK;
}

// ---- which part

static int plan_region(struct rendering *r) {
    struct cli *cli = r->cli;
    const struct cli_part *wish = &cli->options.part;
    struct part *part = &r->part;
    const uint32_t *wanted = wish->region;
    part->region = (struct part_region){0, 0, part->width, part->height};
    if (wish->region[2])
        part->region = (struct part_region){wanted[0], wanted[1], wanted[2], wanted[3]};
    if (wish->region[2] &&
        ((uint64_t)wanted[0] + wanted[2] > part->width || (uint64_t)wanted[1] + wanted[3] > part->height))
        return cli_usage(cli, cli_option_place(cli, "region"),
                         "the region ends at %u,%u, and the picture has %u x %u pixels",
                         wanted[0] + wanted[2], wanted[1] + wanted[3], part->width, part->height);
    if (wish->tiles && !parts_cut(part->width, part->height, wish->tile, wish->tiles, &part->region)) {
        const int status = cli_usage(cli, cli_option_place(cli, "tile"),
                                     "a picture of %u rows has at most %u parts, of 8 rows each, not %u",
                                     part->height, parts_most(part->height), wish->tiles);
        diag_help(&cli->sink, "take fewer, or parts of its samples: --samples-from, --samples-to");
        return status;
    }
    return CLI_OK;
}

static int plan_samples(struct rendering *r) {
    const struct cli_part *wish = &r->cli->options.part;
    struct part *part = &r->part;
    part->first_sample = (uint32_t)wish->samples_from;
    part->end_sample = wish->samples_to ? (uint32_t)wish->samples_to : part->samples;
    if (part->first_sample < part->end_sample && part->end_sample <= part->samples)
        return CLI_OK;
    return cli_usage(r->cli, samples_place(r->cli),
                     "samples %u to %u, the last not included, are not of a picture with %u samples",
                     part->first_sample, part->end_sample, part->samples);
}

// Some of the samples are a part, and no picture.
static int judge_outputs(struct rendering *r) {
    const struct part *part = &r->part;
    const bool few = part->end_sample - part->first_sample < part->samples;
    for (uint32_t i = 0; i < r->output_count && few; i++) {
        const struct cli_output *output = &r->outputs[i];
        if (output->is_part)
            continue;
        const int status =
            cli_usage(r->cli, output->arg ? output->arg : place_of(r),
                      "some of the samples make no picture: '%s' does not end in " PART_ENDING, output->path);
        diag_help(&r->cli->sink, "write parts, -o NAME" PART_ENDING ", and join them: glint merge");
        return status;
    }
    return CLI_OK;
}

int render_plan_part(struct rendering *r) {
    const struct ir_image *image = r->session.image;
    struct part *part = &r->part;
    *part = (struct part){.width = (uint32_t)image->width,
                          .height = (uint32_t)image->height,
                          .samples = (uint32_t)image->samples,
                          .end_sample = (uint32_t)image->samples,
                          .display = {image->tone, image->transfer}};
    part->region = (struct part_region){0, 0, part->width, part->height};
    r->is_part = render_wants_part(r);
    if (!r->is_part)
        return CLI_OK;
    if (image->error > 0) {
        const int status = cli_usage(r->cli, place_of(r),
                                     "pixels that end by their error are not rendered in parts: the picture "
                                     "states an error of all its pixels");
        diag_help(&r->cli->sink, "give all pixels the same samples: --set image.error=0, without --noise");
        return status;
    }
    int status = plan_region(r);
    if (status == CLI_OK)
        status = plan_samples(r);
    return status == CLI_OK ? judge_outputs(r) : status;
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

bool render_aim_at_part(struct rendering *r) {
    return !r->is_part || part_aim(&r->shot, &r->part);
}

static size_t plane_floats(const struct part *part) {
    return heap_times(heap_times(part->region.width, part->region.height), 3);
}

// Samples one after the other, each into a plane of its own.
static enum shot_status take_samples(struct rendering *r, const struct render_progress *progress) {
    struct part *part = &r->part;
    const size_t floats = plane_floats(part);
    enum shot_status status = SHOT_OK;
    if (!part->rgb)
        part->rgb = heap_array(heap_times(floats, part_planes(part)), sizeof *part->rgb);
    if (!part->rgb)
        return shot_no_memory(&r->session, "the samples of the part");
    for (uint32_t i = 0; status == SHOT_OK && i < part_planes(part); i++) {
        r->shot.settings.first_sample = part->first_sample + i;
        if (!renderer_change(r->shot.renderer, &r->shot.flat, &r->shot.settings))
            return SHOT_DEVICE;
        status = shot_take(&r->shot, &r->image, progress, &r->stats.last);
        memcpy(part->rgb + i * floats, r->image.rgb, floats * sizeof *part->rgb);
    }
    return status;
}

enum shot_status render_take_part(struct rendering *r, const struct render_progress *progress) {
    const struct part *part = &r->part;
    return part->end_sample - part->first_sample < part->samples
               ? take_samples(r, progress)
               : shot_take(&r->shot, &r->image, progress, &r->stats.last);
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

void render_fill_part(struct rendering *r) {
    part_describe(r->cli, &r->shot, r->camera, &r->part);
}

void render_encode_part(struct rendering *r, struct strbuf *out) {
    struct part part;
    render_fill_part(r);
    part = r->part;
    if (!part.rgb)
        part.rgb = r->image.rgb;
    part_encode(&part, out);
}
