// What else is known of a picture's pixels: --aov, by the tracer that made the picture.
#include "cli/commands/render_job.h"
#include "cli/device.h"
#include "cli/made.h"
#include "grammar/ir.h"
#include "render/aov/layers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    FLOAT_WHOLE_MOST = 1 << 24, // a float holds all whole numbers up to here
};

// ---- the command line

static const struct cli_output *exr_output(const struct render_job *job) {
    for (uint32_t i = 0; i < job->output_count; i++)
        if (job->outputs[i].format == IMAGE_EXR)
            return &job->outputs[i];
    return NULL;
}

static bool wants(const struct render_job *job, enum aov aov) {
    return job->cli->options.aovs >> aov & 1;
}

static int judge_error(const struct render_job *job) {
    struct cli *cli = job->cli;
    const int status = cli_usage(cli, cli_option_place(cli, "aov"),
                                 "--aov knows 'error' only where pixels end by their error");
    if (cli_device_is_reference(cli))
        diag_help(&cli->sink, "the reference takes all samples of all pixels: choose a device");
    else
        diag_help(&cli->sink,
                  "add --noise 0.01, or write image.error and more samples than min_samples into the scene");
    return status;
}

int render_judge_aovs(struct render_job *job) {
    const struct scene *scene = &job->session.resolved;
    uint32_t most = scene->material_count > scene->body_count ? scene->material_count : scene->body_count;
    if (wants(job, AOV_ERROR) && !(job->session.image->error > 0))
        return judge_error(job);
    if (exr_output(job))
        return CLI_OK;
    for (uint32_t i = 0; i < scene->body_count && wants(job, AOV_INDEX); i++)
        most = scene->bodies[i].triangle_count > most ? scene->bodies[i].triangle_count : most;
    if (most < FLOAT_WHOLE_MOST || !aov_needs_hits(job->cli->options.aovs))
        return CLI_OK;
    const int status = cli_usage(job->cli, cli_option_place(job->cli, "aov"),
                                 "--aov: a PFM file holds no number as large as %u exactly", most);
    diag_help(&job->cli->sink, "write an OpenEXR picture, which does: -o picture.exr");
    return status;
}

// ---- making them

static int no_memory(struct render_job *job) {
    cli_error(job->cli, DIAG_OUT_OF_MEMORY, job->outputs[0].path, NULL, "not enough memory for --aov");
    return CLI_SCENE;
}

int render_make_aovs(struct render_job *job, struct reference_shot *reference) {
    struct layers_wish wish = {.shot = reference ? NULL : &job->shot,
                               .reference = reference,
                               .estimate = reference ? NULL : render_estimate_of(job),
                               .width = job->image.width,
                               .height = job->image.height,
                               .wanted = job->cli->options.aovs,
                               .in_picture = exr_output(job)};
    const struct render_progress progress = progress_callback(&job->progress);
    if (!wish.wanted)
        return CLI_OK;
    job->layers = ARENA_NEW(&job->cli->arena, struct layers);
    const enum shot_status status =
        layers_make(job->layers, &job->session, &wish, &progress, &job->cli->arena);
    if (status == SHOT_NO_MEMORY)
        return no_memory(job);
    if (wish.in_picture)
        job->image.layers = &job->layers->layers;
    return status == SHOT_OK ? CLI_OK : render_failed(job, status);
}

void render_drop_aovs(struct render_job *job) {
    job->image.layers = NULL;
    if (job->layers)
        layers_finish(job->layers);
    job->layers = NULL;
}

// ---- files of their own

static int write_made(struct render_job *job, const char *path, struct strbuf *made) {
    const int status = cli_write_made(job->cli, path, made, path);
    if (status == CLI_OK && !job->cli->options.quiet)
        fprintf(stderr, "glint: wrote %s\n", path);
    return status;
}

static const char *plane_name(struct render_job *job, str stem, enum aov aov) {
    return arena_format(&job->cli->arena, "%.*s.%s.pfm", STR_ARG(stem), aov_info(aov)->name).ptr;
}

static const char *list_name(struct render_job *job, str stem) {
    return arena_format(&job->cli->arena, "%.*s.names.json", STR_ARG(stem)).ptr;
}

static int write_plane(struct render_job *job, str stem, enum aov aov) {
    const char *path = plane_name(job, stem, aov);
    struct image image;
    struct strbuf file;
    if (!layers_plane(job->layers, aov, &image))
        return no_memory(job);
    strbuf_init(&file);
    image_encode(&image, IMAGE_PFM, (struct image_display){0}, &file);
    const int status = write_made(job, path, &file);
    strbuf_finish(&file);
    image_finish(&image);
    return status;
}

static int write_names(struct render_job *job, str stem) {
    const char *path = list_name(job, stem);
    struct strbuf file;
    strbuf_init(&file);
    aov_names_json(&job->layers->names, &job->session.sources, &file);
    const int status = write_made(job, path, &file);
    strbuf_finish(&file);
    return status;
}

// The output that the files lie beside.
static const struct cli_output *output_beside(const struct render_job *job) {
    const struct cli_output *beside = exr_output(job);
    beside = beside ? beside : job->outputs;
    while (beside + 1 < job->outputs + job->output_count && strcmp(beside->path, "-") == 0)
        beside++;
    return beside;
}

int render_judge_aov_names(struct render_job *job, uint32_t camera) {
    int status = CLI_OK;
    if (!job->cli->options.aovs)
        return CLI_OK;
    const struct cli_output *beside = output_beside(job);
    const char *typed = render_typed(beside);
    const str stem = render_stem_of(str_from(render_output_of(job, beside, camera)));
    for (int i = 0; i < AOVS && status == CLI_OK && !exr_output(job); i++)
        if (wants(job, (enum aov)i))
            status = cli_judge_made(job->cli, typed, plane_name(job, stem, (enum aov)i));
    if (status == CLI_OK && (wants(job, AOV_OBJECT) || wants(job, AOV_MATERIAL)))
        status = cli_judge_made(job->cli, typed, list_name(job, stem));
    return status;
}

int render_write_aovs(struct render_job *job, uint32_t camera) {
    const bool apart = !exr_output(job);
    int status = CLI_OK;
    if (!job->layers)
        return CLI_OK;
    const struct cli_output *beside = output_beside(job);
    const str stem = render_stem_of(str_from(render_output_of(job, beside, camera)));
    for (int i = 0; i < AOVS && status == CLI_OK && apart; i++)
        if (wants(job, (enum aov)i))
            status = write_plane(job, stem, (enum aov)i);
    if (status == CLI_OK && (wants(job, AOV_OBJECT) || wants(job, AOV_MATERIAL)))
        status = write_names(job, stem);
    return status;
}
