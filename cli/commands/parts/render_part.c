// A render job that makes a part of a picture.
#include "cli/commands/rendering.h"
#include "cli/device.h"
#include "render/parts/parts.h"

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

// What was asked for that a part cannot have; NULL: nothing.
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
    struct part *part = &r->job.part;
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
    struct part *part = &r->job.part;
    part->first_sample = (uint32_t)wish->samples_from;
    part->end_sample = wish->samples_to ? (uint32_t)wish->samples_to : part->samples;
    if (part->first_sample < part->end_sample && part->end_sample <= part->samples)
        return CLI_OK;
    return cli_usage(r->cli, samples_place(r->cli),
                     "samples %u to %u, the last not included, are not of a picture with %u samples",
                     part->first_sample, part->end_sample, part->samples);
}

// With only some of the samples it is a part, not a picture.
static int judge_outputs(struct rendering *r) {
    const struct part *part = &r->job.part;
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
    const struct ir_image *image = r->job.session->image;
    struct part *part = &r->job.part;
    *part = (struct part){.width = (uint32_t)image->width,
                          .height = (uint32_t)image->height,
                          .samples = (uint32_t)image->samples,
                          .end_sample = (uint32_t)image->samples,
                          .display = image_display_of(image)};
    part->region = (struct part_region){0, 0, part->width, part->height};
    r->job.is_part = render_wants_part(r);
    if (!CLI_HAS_DEVICES || !r->job.is_part) // the reference draws no parts, as render_judge_part has said
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

// ---- its file

void render_encode_part(struct rendering *r, struct strbuf *out) {
    struct part part;
    job_describe_part(&r->job, &r->job.part);
    part = r->job.part;
    if (!part.rgb)
        part.rgb = r->job.image.rgb;
    part_encode(&part, out);
}
