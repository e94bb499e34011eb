// glint merge OUT PART...: joins the parts of a picture.
#include "cli/commands/commands.h"
#include "cli/commands/parts/merge_rows.h"
#include "cli/commands/rendering.h"
#include "cli/made.h"
#include "cli/progress.h"
#include "core/ranges.h"
#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "render/frames/frame_name.h"
#include "render/job/job_done.h"
#include "render/parts/parts.h"
#include "render/record/provenance.h"

#include <stdio.h>
#include <string.h>

// Which part an error is about.
static const char *name_of(const struct cli *cli, uint32_t part) {
    return cli->operands[part + 1];
}

static int unreadable(struct cli *cli, uint32_t part, const struct strbuf *error) {
    cli_error(cli, DIAG_FILE_UNREADABLE, name_of(cli, part), NULL, "the file %s",
              error->data ? error->data : "needs more memory than there is");
    return CLI_FILE;
}

static int read_part(struct cli *cli, uint32_t number, bool head_only, struct part *part) {
    struct strbuf error;
    strbuf_init(&error);
    const int status =
        part_read(name_of(cli, number), head_only, part, &error) ? CLI_OK : unreadable(cli, number, &error);
    strbuf_finish(&error);
    return status;
}

static int misfit(struct cli *cli, const struct parts_fault *fault) {
    const char *text = fault->text.data;
    if (!text) {
        cli_error(cli, DIAG_OUT_OF_MEMORY, cli->operands[0], NULL, "not enough memory for the parts");
        return CLI_SCENE;
    }
    if (fault->part == PARTS_NONE) {
        const int status = cli_usage(cli, cli_operand_place(cli, 0), "the parts make no picture: %s", text);
        diag_help(
            &cli->sink,
            "name all parts, or render those that are missing; parts with some of the samples must have the "
            "same regions");
        return status;
    }
    return cli_usage(cli, cli_operand_place(cli, (int)fault->part + 1), "'%s' %s '%s'",
                     name_of(cli, fault->part), text, name_of(cli, fault->other));
}

static int judge(struct cli *cli, const struct part *parts, uint32_t count, uint32_t *order) {
    struct parts_fault fault = {0};
    strbuf_init(&fault.text);
    const int status = parts_fit(parts, count, order, &fault) ? CLI_OK : misfit(cli, &fault);
    strbuf_finish(&fault.text);
    return status;
}

static int take_output(struct rendering *r) {
    struct cli *cli = r->cli;
    *(struct cli_output *)ARENA_PUSH(&cli->arena, &cli->options.outputs) =
        (struct cli_output){.path = cli->operands[0], .arg = cli_operand_place(cli, 0)};
    const int status = render_take_outputs(r);
    if (status != CLI_OK || !r->outputs[0].is_part)
        return status;
    return cli_usage(cli, cli_operand_place(cli, 0),
                     "'%s' is a part: a picture is written first, then its parts", cli->operands[0]);
}

// Adds parts that fit into the job's image.
static int add_parts(struct rendering *r, const uint32_t *order, uint32_t count) {
    int status = CLI_OK;
    for (uint32_t i = 0; i < count && status == CLI_OK; i++) {
        struct part part;
        status = read_part(r->cli, order[i], false, &part);
        if (status == CLI_OK)
            parts_add(&part, &r->job.image);
        part_finish(&part);
    }
    return status;
}

// For pictures that cannot be made row by row: of parts of samples, and in formats that are coded as a whole.
static int merge_at_once(struct rendering *r, const uint32_t *order, uint32_t count) {
    struct cli *cli = r->cli;
    const uint32_t width = r->job.image.width, height = r->job.image.height;
    if ((uint64_t)width * height > RANGE_PIXELS_MOST) {
        const int status =
            cli_usage(cli, cli_operand_place(cli, 0),
                      "a picture of more than 64 megapixels is joined row by row: of parts with all "
                      "samples, to .png, .exr, .pfm or .hdr");
        diag_help(&cli->sink, "choose one of these endings, and take parts by --tile or --region");
        return status;
    }
    if (!image_init(&r->job.image, width, height)) {
        cli_error(cli, DIAG_OUT_OF_MEMORY, cli->operands[0], NULL, "not enough memory for the picture");
        return CLI_SCENE;
    }
    const int status = add_parts(r, order, count);
    return status == CLI_OK ? render_write_pictures(r, 0) : status;
}

// --skip-done: the picture says the same of how it was made as its parts.
static bool is_done(struct rendering *r) {
    struct cli *cli = r->cli;
    const struct cli_output *output = &r->outputs[0];
    if (!cli->options.batch.skip_done || !r->record || !*r->record)
        return false;
    const struct image_texts texts = provenance_of_line(
        r->record, output->format, render_coding(&cli->options, output->format), &cli->arena);
    const bool done = job_texts_are_done(output->path, &texts, &cli->arena);
    if (done && !cli->options.quiet)
        fprintf(stderr, "glint: %s is done already\n", output->path);
    return done;
}

// Joins the operands.
static int merge(struct rendering *r) {
    struct cli *cli = r->cli;
    const uint32_t count = (uint32_t)cli->operand_count - 1;
    struct part *parts = ARENA_ARRAY(&cli->arena, struct part, count);
    uint32_t *order = ARENA_ARRAY(&cli->arena, uint32_t, count);
    int status = take_output(r);
    for (uint32_t i = 0; i < count && status == CLI_OK; i++)
        status = read_part(cli, i, true, &parts[i]);
    if (status == CLI_OK)
        status = judge(cli, parts, count, order);
    if (status != CLI_OK)
        return status;
    // A picture made on several devices has no record: no command makes it again.
    r->record = parts->record;
    for (uint32_t i = 1; i < count; i++)
        if (strcmp(parts[i].record, parts->record) != 0)
            r->record = NULL;
    if (is_done(r))
        return CLI_OK;
    struct ir_image image = {.tone = parts->display.tone,
                             .transfer = parts->display.transfer,
                             .exposure = parts->display.exposure};
    r->job.session->image = &image;
    r->job.image = (struct image){.width = parts->width, .height = parts->height};
    status = render_judge_size(r);
    if (status == CLI_OK)
        status = merge_is_by_rows(r, parts, count) ? merge_rows(r, parts, order, count)
                                                   : merge_at_once(r, order, count);
    if (status == CLI_OK && !cli->options.quiet)
        render_tell_written(r, 0);
    return status;
}

static int merge_once(struct cli *cli) {
    struct session session = {0}; // without a scene: the parts say how their picture is displayed
    struct rendering r = {.cli = cli, .job = {.session = &session, .arena = &cli->arena}};
    const int status = merge(&r);
    job_close(&r.job);
    return status;
}

// ---- frames

// An operand's name in a frame; NULL: a '%' is followed by something else, or there is no memory.
static char *name_in_frame(struct cli *cli, const char *pattern, int32_t frame) {
    struct strbuf name;
    strbuf_init(&name);
    const bool good = frame_name(pattern, frame, &name) && !name.failed;
    char *copy = good ? (char *)arena_copy(&cli->arena, strbuf_view(&name)).ptr : NULL;
    strbuf_finish(&name);
    return copy;
}

// The operands of a frame; CLI_OK, or CLI_USAGE with the mistake reported.
static int name_operands(struct cli *cli, char **patterns, int32_t frame, char **names) {
    for (int i = 0; i < cli->operand_count; i++) {
        names[i] = name_in_frame(cli, patterns[i], frame);
        if (names[i])
            continue;
        const int status = cli_usage(cli, cli_operand_place(cli, i),
                                     "'%%' in '%s' is followed by no word that is known", patterns[i]);
        diag_help(&cli->sink, "%%d or %%04d is the frame, and %%%% a percent sign");
        return status;
    }
    return CLI_OK;
}

// Each frame needs names of its own.
static int judge_patterns(struct cli *cli, char **patterns) {
    const struct cli_batch *b = &cli->options.batch;
    char **first = ARENA_ARRAY(&cli->arena, char *, (size_t)cli->operand_count);
    char **last = ARENA_ARRAY(&cli->arena, char *, (size_t)cli->operand_count);
    int status = name_operands(cli, patterns, b->first_frame, first);
    if (status == CLI_OK)
        status = name_operands(cli, patterns, b->last_frame, last);
    for (int i = 0; i < cli->operand_count && status == CLI_OK && b->last_frame > b->first_frame; i++)
        if (strcmp(first[i], last[i]) == 0) {
            status = cli_usage(cli, cli_operand_place(cli, i), "'%s' would be the same file in all frames",
                               patterns[i]);
            diag_help(&cli->sink, "write the frame's number into the name: %%04d");
        }
    return status;
}

// Puts the names in the place of the patterns, which are the operands, on the command line too.
static void take_names(struct cli *cli, char **argv, char **patterns, char **names) {
    for (int i = 0; i < cli->argc; i++)
        for (int k = 0; k < cli->operand_count; k++)
            if (argv[i] == patterns[k])
                cli->argv[i] = names[k];
    cli->operands = names;
}

// The picture's name in all frames.
static int judge_made(struct cli *cli, const char *pattern) {
    const struct cli_batch *b = &cli->options.batch;
    int status = CLI_OK;
    for (int64_t frame = b->first_frame; frame <= b->last_frame && status == CLI_OK; frame += b->frame_step)
        status = cli_judge_made(cli, pattern, name_in_frame(cli, pattern, (int32_t)frame));
    return status;
}

// A frame that fails is reported, and the others are still joined.
static int merge_frames(struct cli *cli) {
    const struct cli_batch *b = &cli->options.batch;
    char **patterns = cli->operands, **argv = cli->argv;
    uint32_t failed = 0, count = 0;
    int status = judge_patterns(cli, patterns);
    if (status == CLI_OK)
        status = judge_made(cli, patterns[0]);
    if (status != CLI_OK)
        return status;
    interrupt_catch();
    cli->argv = ARENA_ARRAY(&cli->arena, char *, (size_t)cli->argc + 1);
    for (int64_t frame = b->first_frame; frame <= b->last_frame; frame += b->frame_step, count++) {
        char **names = ARENA_ARRAY(&cli->arena, char *, (size_t)cli->operand_count);
        cli->argv = memcpy(cli->argv, argv, (size_t)cli->argc * sizeof *argv);
        status = name_operands(cli, patterns, (int32_t)frame, names);
        if (interrupt_signal())
            return cli_interrupted(cli);
        take_names(cli, argv, patterns, names);
        cli->options.outputs.count = 0;
        status = status == CLI_OK ? merge_once(cli) : status;
        if (status != CLI_OK) {
            failed++;
            fprintf(stderr, "glint: failed: %s\n", names[0]);
        }
    }
    if (failed)
        fprintf(stderr, "glint: %u of %u pictures failed\n", failed, count);
    return failed ? CLI_SCENE : CLI_OK;
}

int cmd_merge(struct cli *cli) {
    return cli->options.batch.has_frames ? merge_frames(cli) : merge_once(cli);
}
