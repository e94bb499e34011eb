// glint merge OUT PART...: parts of a picture, to the picture.
#include "app/parts/parts.h"
#include "cli/parts/merge_rows.h"

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

static int take_output(struct render_job *job) {
    struct cli *cli = job->cli;
    *(struct cli_output *)ARENA_PUSH(&cli->arena, &cli->options.outputs) =
        (struct cli_output){.path = cli->operands[0], .arg = cli_operand_place(cli, 0)};
    const int status = render_take_outputs(job);
    if (status != CLI_OK || !job->outputs[0].is_part)
        return status;
    return cli_usage(cli, cli_operand_place(cli, 0),
                     "'%s' is a part: a picture is written first, then its parts", cli->operands[0]);
}

// The picture of parts that fit, into the job's image.
static int add_parts(struct render_job *job, const uint32_t *order, uint32_t count) {
    int status = CLI_OK;
    for (uint32_t i = 0; i < count && status == CLI_OK; i++) {
        struct part part;
        status = read_part(job->cli, order[i], false, &part);
        if (status == CLI_OK)
            parts_add(&part, &job->image);
        part_finish(&part);
    }
    return status;
}

// What a row cannot be made of alone: parts of samples, and formats that are coded as a whole.
static int merge_at_once(struct render_job *job, const uint32_t *order, uint32_t count) {
    struct cli *cli = job->cli;
    const uint32_t width = job->image.width, height = job->image.height;
    if ((uint64_t)width * height > SESSION_PIXELS_MOST) {
        const int status =
            cli_usage(cli, cli_operand_place(cli, 0),
                      "a picture of more than 64 megapixels is joined row by row: of parts with all "
                      "samples, to .png, .exr, .pfm or .hdr");
        diag_help(&cli->sink, "choose one of these endings, and take parts by --tile or --region");
        return status;
    }
    if (!image_init(&job->image, width, height)) {
        cli_error(cli, DIAG_OUT_OF_MEMORY, cli->operands[0], NULL, "not enough memory for the picture");
        return CLI_SCENE;
    }
    const int status = add_parts(job, order, count);
    return status == CLI_OK ? render_write_pictures(job, 0) : status;
}

static int merge(struct render_job *job) {
    struct cli *cli = job->cli;
    const uint32_t count = (uint32_t)cli->operand_count - 1;
    struct part *parts = ARENA_ARRAY(&cli->arena, struct part, count);
    uint32_t *order = ARENA_ARRAY(&cli->arena, uint32_t, count);
    int status = take_output(job);
    for (uint32_t i = 0; i < count && status == CLI_OK; i++)
        status = read_part(cli, i, true, &parts[i]);
    if (status == CLI_OK)
        status = judge(cli, parts, count, order);
    if (status != CLI_OK)
        return status;
    // Made on several devices it says nothing of how: no command makes it again.
    job->record = parts->record;
    for (uint32_t i = 1; i < count; i++)
        if (strcmp(parts[i].record, parts->record) != 0)
            job->record = NULL;
    job->image_made.tone = parts->display.tone;
    job->image_made.transfer = parts->display.transfer;
    job->session.image = &job->image_made;
    job->image = (struct image){.width = parts->width, .height = parts->height};
    status = render_judge_size(job);
    if (status == CLI_OK)
        status = merge_is_by_rows(job, parts, count) ? merge_rows(job, parts, order, count)
                                                     : merge_at_once(job, order, count);
    if (status == CLI_OK && !cli->options.quiet)
        render_tell_written(job, 0);
    return status;
}

int cmd_merge(struct cli *cli) {
    struct render_job job = {.cli = cli};
    const int status = merge(&job);
    image_finish(&job.image);
    return status;
}
