// --aov: what else is known of a picture's pixels, by the tracer that made the picture.
#include "cli/commands/rendering.h"
#include "cli/device.h"
#include "cli/made.h"
#include "diag/codes/limit.h"
#include "grammar/ir.h"
#include "render/aov/layers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    FLOAT_WHOLE_MOST = 1 << 24, // a float holds all whole numbers up to here
};

// ---- the command line

const struct cli_output *render_exr_output(const struct rendering *r) {
    for (uint32_t i = 0; i < r->output_count; i++)
        if (r->outputs[i].format == IMAGE_EXR)
            return &r->outputs[i];
    return NULL;
}

static bool wants(const struct rendering *r, enum aov aov) {
    return r->cli->options.aovs >> aov & 1;
}

static int judge_error(const struct rendering *r) {
    struct cli *cli = r->cli;
    const int status = cli_usage(cli, cli_option_place(cli, "aov"),
                                 "--aov knows 'error' only where pixels end by their error");
    if (cli_device_is_reference(cli))
        diag_help(&cli->sink, "the reference takes all samples of all pixels: choose a device");
    else
        diag_help(&cli->sink,
                  "add --noise 0.01, or write image.error and more samples than min_samples into the scene");
    return status;
}

int render_judge_aovs(struct rendering *r) {
    const struct scene *scene = &r->job.session->resolved;
    uint32_t most = scene->material_count > scene->body_count ? scene->material_count : scene->body_count;
    if (wants(r, AOV_ERROR) && !(r->job.session->image->error > 0))
        return judge_error(r);
    if (render_exr_output(r))
        return CLI_OK;
    for (uint32_t i = 0; i < scene->body_count && wants(r, AOV_INDEX); i++)
        most = scene->bodies[i].triangle_count > most ? scene->bodies[i].triangle_count : most;
    if (most < FLOAT_WHOLE_MOST || !aov_needs_hits(r->cli->options.aovs))
        return CLI_OK;
    const int status = cli_usage(r->cli, cli_option_place(r->cli, "aov"),
                                 "--aov: a PFM file holds no number as large as %u exactly", most);
    diag_help(&r->cli->sink, "write an OpenEXR picture, which does: -o picture.exr");
    return status;
}

int render_no_memory_for_aovs(struct rendering *r) {
    cli_error(r->cli, DIAG_OUT_OF_MEMORY, r->outputs[0].path, NULL, "not enough memory for --aov");
    return CLI_SCENE;
}

// ---- files of their own

static int write_made(struct rendering *r, const char *path, struct strbuf *made) {
    const int status = cli_write_made(r->cli, path, made, path);
    if (status == CLI_OK && !r->cli->options.quiet)
        fprintf(stderr, "glint: wrote %s\n", path);
    return status;
}

static const char *plane_name(struct rendering *r, str stem, enum aov aov) {
    return arena_format(&r->cli->arena, "%.*s.%s.pfm", STR_ARG(stem), aov_info(aov)->name).ptr;
}

static const char *list_name(struct rendering *r, str stem) {
    return arena_format(&r->cli->arena, "%.*s.names.json", STR_ARG(stem)).ptr;
}

static int write_plane(struct rendering *r, str stem, enum aov aov) {
    const char *path = plane_name(r, stem, aov);
    struct image image;
    struct strbuf file;
    if (!layers_plane(r->job.layers, aov, &image))
        return render_no_memory_for_aovs(r);
    strbuf_init(&file);
    image_encode(&image, IMAGE_PFM, (struct image_display){0}, &file);
    const int status = write_made(r, path, &file);
    strbuf_finish(&file);
    image_finish(&image);
    return status;
}

static int write_names(struct rendering *r, str stem) {
    const char *path = list_name(r, stem);
    struct strbuf file;
    strbuf_init(&file);
    aov_names_json(&r->job.layers->names, &r->job.session->sources, &file);
    const int status = write_made(r, path, &file);
    strbuf_finish(&file);
    return status;
}

// The output that the files lie beside.
static const struct cli_output *output_beside(const struct rendering *r) {
    const struct cli_output *beside = render_exr_output(r);
    beside = beside ? beside : r->outputs;
    while (beside + 1 < r->outputs + r->output_count && strcmp(beside->path, "-") == 0)
        beside++;
    return beside;
}

int render_judge_aov_names(struct rendering *r, uint32_t camera) {
    int status = CLI_OK;
    if (!r->cli->options.aovs)
        return CLI_OK;
    const struct cli_output *beside = output_beside(r);
    const char *typed = render_typed(beside);
    const str stem = render_stem_of(str_from(render_output_of(r, beside, camera)));
    for (int i = 0; i < AOVS && status == CLI_OK && !render_exr_output(r); i++)
        if (wants(r, (enum aov)i))
            status = cli_judge_made(r->cli, typed, plane_name(r, stem, (enum aov)i));
    if (status == CLI_OK && (wants(r, AOV_OBJECT) || wants(r, AOV_MATERIAL)))
        status = cli_judge_made(r->cli, typed, list_name(r, stem));
    return status;
}

int render_write_aovs(struct rendering *r, uint32_t camera) {
    const bool apart = !render_exr_output(r);
    int status = CLI_OK;
    if (!r->job.layers)
        return CLI_OK;
    const struct cli_output *beside = output_beside(r);
    const str stem = render_stem_of(str_from(render_output_of(r, beside, camera)));
    for (int i = 0; i < AOVS && status == CLI_OK && apart; i++)
        if (wants(r, (enum aov)i))
            status = write_plane(r, stem, (enum aov)i);
    if (status == CLI_OK && (wants(r, AOV_OBJECT) || wants(r, AOV_MATERIAL)))
        status = write_names(r, stem);
    return status;
}
