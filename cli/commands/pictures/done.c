#include "cli/commands/pictures/done.h"

#include "cli/commands/rendering.h"
#include "cli/device.h"
#include "files/stream.h"
#include "picture/metrics/picture_file.h"
#include "render/record/provenance.h"
#include "render/record/record.h"

#include <stdio.h>
#include <string.h>

enum {
    PIXEL_BYTES = 64, // that a picture of the wanted size needs at most while it is read
    SPARE_BYTES = 1 << 20,
};

// ---- the command line

static const char *why_not(const struct cli_output *output, bool is_part) {
    if (strcmp(output->path, "-") == 0 || strncmp(output->path, "/dev/", 5) == 0)
        return "what was written there is gone";
    if (is_part && !output->is_part)
        return "a part says which part it is only as a file that ends in " PART_ENDING;
    if (!output->is_part && (output->format == IMAGE_PFM || output->format == IMAGE_WEBP))
        return "a PFM or WebP picture does not say how it was made: write another format beside it, or "
               "instead";
    return NULL;
}

int render_judge_done(const struct rendering *r) {
    struct cli *cli = r->cli;
    const struct cli_output *outputs = r->outputs;
    const bool is_part = render_wants_part(r);
    static const char *const options[] = {"audit",     "max-off",  "aov",    "time",    "repeat",
                                          "max-error", "max-time", "budget", "montage", "watch"};
    if (!cli->options.batch.skip_done)
        return CLI_OK;
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        if (cli_option_place(cli, options[i]))
            return cli_usage(cli, cli_option_place(cli, options[i]),
                             "'--%s' needs a picture that is rendered now: it does not go with '--skip-done'",
                             options[i]);
    for (uint32_t i = 0; i < r->output_count; i++) {
        const char *why = why_not(&outputs[i], is_part);
        if (why)
            return cli_usage(cli, outputs[i].arg ? outputs[i].arg : cli_option_place(cli, "skip-done"),
                             "'--skip-done' cannot know whether '%s' is done: %s", outputs[i].path, why);
    }
    return CLI_OK;
}

// ---- files

static bool is_whole(str file, uint64_t pixels) {
    struct picture_file picture = {0};
    bool unknown;
    const uint64_t most = pixels * PIXEL_BYTES + SPARE_BYTES;
    const bool good = !picture_file_decode(file, most, &picture, &unknown);
    picture_file_finish(&picture);
    return good;
}

bool done_picture(struct cli *cli, const char *path, const struct image_texts *texts) {
    struct record_read wanted, there;
    struct record_command command;
    struct strbuf file;
    bool good = false;
    record_of_texts(texts, &wanted);
    if (!wanted.is_there || !record_read_command(wanted.fields[RECORD_COMMAND], &cli->arena, &command))
        return false;
    strbuf_init(&file);
    if (stream_read_file(path, SIZE_MAX, &file) == 0 && !file.failed) {
        record_find(strbuf_view(&file), &there);
        good = record_same(&wanted, &there, &cli->arena) &&
               is_whole(strbuf_view(&file), (uint64_t)command.width * (uint64_t)command.height);
    }
    strbuf_finish(&file);
    return good;
}

static bool same_pixels(const struct part *a, const struct part *b) {
    return a->width == b->width && a->height == b->height && a->region.x == b->region.x &&
           a->region.y == b->region.y && a->region.width == b->region.width &&
           a->region.height == b->region.height && a->first_sample == b->first_sample &&
           a->end_sample == b->end_sample && a->samples == b->samples && a->display.tone == b->display.tone &&
           a->display.transfer == b->display.transfer;
}

static bool done_part(struct cli *cli, const char *path, const struct part *part,
                      const struct image_texts *texts) {
    struct part *there = ARENA_NEW(&cli->arena, struct part);
    struct record_read wanted, read;
    struct strbuf error;
    strbuf_init(&error);
    record_of_texts(texts, &wanted);
    // Its head says what it is; all of it is read only then, to see that it is whole.
    bool good = part_read(path, true, there, &error) && same_pixels(there, part);
    if (good)
        record_of_line(str_from(there->record), &read);
    good = good && record_same(&wanted, &read, &cli->arena);
    part_finish(there);
    good = good && part_read(path, false, there, &error);
    part_finish(there);
    strbuf_finish(&error);
    return good;
}

// Where the scene leaves the precision open, the same scene had it chosen as it would be now.
bool done_is_there(struct cli *cli, const struct cli_output *output, const char *path,
                   const struct done_wish *wish) {
    const struct provenance made = {.session = wish->session,
                                    .gpu = wish->gpu,
                                    .camera = wish->camera,
                                    .as_file = cli->options.as_file,
                                    .format = output->is_part ? IMAGE_PNG : output->format,
                                    .coding = output->is_part ? (struct image_coding){0}
                                                              : render_coding(&cli->options, output->format)};
    bool done = false;
    for (int is_double = 0; is_double < 2 && !done; is_double++) {
        struct provenance one = made;
        one.is_double = is_double;
        const struct image_texts texts = provenance_texts(&one, &cli->arena);
        done = output->is_part ? done_part(cli, path, wish->part, &texts) : done_picture(cli, path, &texts);
    }
    return done;
}

// ---- one render

// What a job is to write, camera by camera.
static bool is_done(struct rendering *r, uint32_t camera) {
    const struct done_wish wish = {r->job.session, cli_device_is_reference(r->cli) ? NULL : r->job.gpu,
                                   camera, &r->job.part};
    bool done = true;
    for (uint32_t i = 0; i < r->output_count && done; i++)
        done = done_is_there(r->cli, &r->outputs[i], render_output_of(r, &r->outputs[i], camera), &wish);
    for (uint32_t i = 0; i < r->output_count && done && !r->cli->options.quiet; i++)
        fprintf(stderr, "glint: %s is done already\n", render_output_of(r, &r->outputs[i], camera));
    return done;
}

void render_find_done(struct rendering *r, uint32_t *first, uint32_t end) {
    r->done = ARENA_ARRAY(&r->cli->arena, bool, (size_t)end + 1);
    for (uint32_t i = *first; i < end; i++)
        r->done[i] = is_done(r, i);
    while (*first < end && r->done[*first])
        ++*first;
}
