// What else is known of a picture's pixels: --aov, by the tracer that made the picture.
#include "cli/commands/render_job.h"
#include "cli/device.h"
#include "cli/made.h"
#include "core/heap.h"
#include "core/parallel.h"
#include "picture/write/exr_file.h"
#include "reference/reference.h"
#include "render/aov/aov.h"
#include "render/aov/matte.h"
#include "render/aov/names.h"
#include "render/reference_shot.h"
#include "scene/view.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MATTES = 2,
    COVERAGE_SAMPLES_MOST = 256, // of a pixel, that its coverage is made of
    RANKS_A_LAYER = 2,
    LAYER_FLOATS = 2 * RANKS_A_LAYER,
    MATTE_CHANNELS = 2 * MATTE_RANKS,
    CHANNELS_MOST = AOVS * AOV_CHANNELS_MOST + MATTES * MATTE_CHANNELS,
    MATTE_ATTRIBUTES = 4,
    FLOAT_WHOLE_MOST = 1 << 24, // a float holds all whole numbers up to here
    ROWS_A_PIECE = 4,
};

struct render_aovs {
    struct aov_planes planes;
    struct aov_names names;
    struct matte mattes[MATTES]; // of bodies, of materials
    struct hit_pixel *hits;
    struct exr_channel channels[CHANNELS_MOST];
    struct exr_attribute attributes[MATTES * MATTE_ATTRIBUTES];
    struct image_layers layers;
    struct strbuf manifests[MATTES];
};

static const enum aov matte_aovs[MATTES] = {AOV_OBJECT, AOV_MATERIAL};
static const char *const matte_layers[MATTES] = {"CryptoObject", "CryptoMaterial"};

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

// ---- what pixels see

static bool stays(void *context, double fraction) {
    const struct render_progress *progress = context;
    (void)fraction; // the picture's share is done
    return progress->report(progress->context, 1);
}

static bool makes_mattes(const struct render_job *job) {
    return exr_output(job) && (wants(job, AOV_OBJECT) || wants(job, AOV_MATERIAL));
}

static uint32_t coverage_samples(const struct render_job *job) {
    const uint32_t samples = (uint32_t)job->session.image->samples;
    return samples < COVERAGE_SAMPLES_MOST ? samples : COVERAGE_SAMPLES_MOST;
}

static uint32_t bits_of(const struct render_job *job, int matte, const struct hit_pixel *hit) {
    const struct aov_names *names = &job->aovs->names;
    if (hit->body == HIT_NONE)
        return 0;
    return matte_aovs[matte] == AOV_OBJECT ? names->objects[hit->body].bits
                                           : names->materials[aov_material(&job->session.resolved, hit)].bits;
}

static void add_pixel(const struct render_job *job, size_t pixel, const struct hit_pixel *hit) {
    for (int m = 0; m < MATTES; m++)
        if (job->aovs->mattes[m].pixels)
            matte_add(&job->aovs->mattes[m], pixel, bits_of(job, m, hit));
}

static enum shot_status of_result(enum render_result result) {
    return result == RENDER_DONE ? SHOT_OK : result == RENDER_CANCELLED ? SHOT_CANCELLED : SHOT_DEVICE;
}

static enum shot_status hits_by_device(struct render_job *job) {
    struct render_aovs *a = job->aovs;
    const size_t pixels = (size_t)a->planes.width * a->planes.height;
    const struct view_camera *camera = &job->shot.view.camera;
    struct render_progress bar = progress_callback(&job->progress);
    const struct render_progress progress = {stays, &bar};
    enum render_result result = wants(job, AOV_COST)
                                    ? renderer_hits(job->shot.renderer, camera, a->hits, &progress)
                                    : renderer_first_hits(job->shot.renderer, camera, 0, a->hits, &progress);
    if (result == RENDER_DONE)
        aov_fill(&a->planes, &job->session.resolved, camera, a->hits);
    if (!makes_mattes(job))
        return of_result(result);
    for (uint32_t s = 0; s < coverage_samples(job) && result == RENDER_DONE; s++) {
        if (s)
            result = renderer_first_hits(job->shot.renderer, camera, s, a->hits, &progress);
        for (size_t i = 0; i < pixels && result == RENDER_DONE; i++)
            add_pixel(job, i, &a->hits[i]);
    }
    return of_result(result);
}

struct covering {
    const struct render_job *job;
    const struct reference *reference;
    const struct view_camera *camera;
};

static void cover_pixel(const struct covering *c, uint32_t x, uint32_t y) {
    const struct aov_planes *p = &c->job->aovs->planes;
    for (uint32_t s = 0; s < coverage_samples(c->job); s++) {
        double across, down;
        struct reference_hit hit;
        view_sample_offset(s, &across, &down);
        const struct view_ray ray =
            view_ray_at(c->camera, (double)p->width / p->height, 2 * (x + across) / p->width - 1,
                        1 - 2 * (y + down) / p->height);
        reference_closest(c->reference, ray.start, ray.direction, INFINITY, &hit);
        add_pixel(c->job, (size_t)y * p->width + x,
                  &(struct hit_pixel){.body = hit.body, .triangle = hit.triangle});
    }
}

static void cover_rows(void *context, size_t begin, size_t end) {
    const struct covering *c = context;
    for (size_t y = begin; y < end; y++)
        for (uint32_t x = 0; x < c->job->aovs->planes.width; x++)
            cover_pixel(c, x, (uint32_t)y);
}

static bool report(void *context, double fraction) {
    return stays(context, fraction);
}

static enum shot_status hits_by_reference(struct render_job *job, struct reference_shot *shot) {
    struct render_aovs *a = job->aovs;
    const struct view_camera *camera = &shot->view.camera;
    struct render_progress bar = progress_callback(&job->progress);
    const struct reference_progress progress = {report, &bar};
    const enum reference_result result =
        reference_source_hits(&shot->source, &shot->settings, a->hits, &progress);
    if (result == REFERENCE_CANCELLED)
        return SHOT_CANCELLED;
    const struct reference *reference = makes_mattes(job) ? reference_source_get(&shot->source) : NULL;
    if (result != REFERENCE_DONE || (makes_mattes(job) && !reference))
        return shot_no_memory(&job->session, "the reference");
    aov_fill(&a->planes, &job->session.resolved, camera, a->hits);
    struct covering covering = {job, reference, camera};
    if (reference)
        parallel_for(a->planes.height, ROWS_A_PIECE, cover_rows, &covering);
    return SHOT_OK;
}

// ---- layers of OpenEXR

static void add_channel(struct render_aovs *a, const char *name, enum exr_type type, const void *first,
                        uint32_t step) {
    a->channels[a->layers.channel_count++] =
        (struct exr_channel){name, type, first, (int32_t)(step * sizeof(float))};
}

static void add_plane(struct render_job *job, enum aov aov) {
    struct render_aovs *a = job->aovs;
    const struct aov_info *info = aov_info(aov);
    for (uint32_t k = 0; k < info->channel_count; k++)
        add_channel(a, arena_format(&job->cli->arena, "%s.%c", info->name, info->channels[k]).ptr,
                    info->is_whole ? EXR_TYPE_UINT : EXR_TYPE_FLOAT, (float *)a->planes.planes[aov] + k,
                    info->channel_count);
}

static void add_attribute(struct render_job *job, const char *key, const char *name, const char *value) {
    struct image_layers *layers = &job->aovs->layers;
    job->aovs->attributes[layers->attribute_count++] =
        (struct exr_attribute){arena_format(&job->cli->arena, "cryptomatte/%s/%s", key, name).ptr, value};
}

static void add_matte(struct render_job *job, int number) {
    struct render_aovs *a = job->aovs;
    const struct matte *matte = &a->mattes[number];
    struct strbuf *manifest = &a->manifests[number];
    const bool is_object = matte_aovs[number] == AOV_OBJECT;
    char key[8];
    matte_key(str_from(matte_layers[number]), key);
    aov_manifest(is_object ? a->names.objects : a->names.materials,
                 is_object ? a->names.object_count : a->names.material_count, manifest);
    add_attribute(job, key, "name", matte_layers[number]);
    add_attribute(job, key, "hash", "MurmurHash3_32");
    add_attribute(job, key, "conversion", "uint32_to_float32");
    add_attribute(job, key, "manifest", manifest->data);
    for (uint32_t i = 0; i < MATTE_CHANNELS; i++)
        add_channel(a,
                    arena_format(&job->cli->arena, "%s%02u.%c", matte_layers[number], i / LAYER_FLOATS,
                                 "RGBA"[i % LAYER_FLOATS])
                        .ptr,
                    EXR_TYPE_FLOAT, matte->ranks + i, MATTE_CHANNELS);
}

static bool make_layers(struct render_job *job) {
    struct render_aovs *a = job->aovs;
    for (int i = 0; i < AOVS; i++)
        if (a->planes.planes[i])
            add_plane(job, (enum aov)i);
    for (int m = 0; m < MATTES; m++) {
        if (!a->mattes[m].pixels)
            continue;
        if (!matte_end(&a->mattes[m], coverage_samples(job)))
            return false;
        add_matte(job, m);
        if (a->manifests[m].failed)
            return false;
    }
    a->layers.channels = a->channels;
    a->layers.attributes = a->attributes;
    job->image.layers = &a->layers;
    return true;
}

// ---- all of it

static int no_memory(struct render_job *job) {
    cli_error(job->cli, DIAG_OUT_OF_MEMORY, job->outputs[0].path, NULL, "not enough memory for --aov");
    return CLI_SCENE;
}

static bool begin(struct render_job *job) {
    const uint32_t width = job->image.width, height = job->image.height;
    struct render_aovs *a = job->aovs = ARENA_NEW(&job->cli->arena, struct render_aovs);
    for (int m = 0; m < MATTES; m++)
        strbuf_init(&a->manifests[m]);
    aov_names_make(&job->session, &job->cli->arena, &a->names);
    if (!aov_init(&a->planes, width, height, job->cli->options.aovs))
        return false;
    for (int m = 0; m < MATTES; m++)
        if (exr_output(job) && wants(job, matte_aovs[m]) && !matte_init(&a->mattes[m], width, height))
            return false;
    if (aov_needs_hits(job->cli->options.aovs))
        a->hits = heap_zeroed(heap_times(width, height), sizeof *a->hits);
    return a->hits || !aov_needs_hits(job->cli->options.aovs);
}

int render_make_aovs(struct render_job *job, struct reference_shot *shot) {
    const struct render_estimate *estimate = shot ? NULL : render_estimate_of(job);
    if (!job->cli->options.aovs)
        return CLI_OK;
    if (!begin(job))
        return no_memory(job);
    aov_fill_samples(&job->aovs->planes, estimate ? estimate->error : NULL,
                     estimate ? estimate->samples : NULL, (uint32_t)job->session.image->samples);
    if (job->aovs->hits) {
        const enum shot_status status = shot ? hits_by_reference(job, shot) : hits_by_device(job);
        if (status != SHOT_OK)
            return render_failed(job, status);
    }
    return !exr_output(job) || make_layers(job) ? CLI_OK : no_memory(job);
}

void render_drop_aovs(struct render_job *job) {
    struct render_aovs *a = job->aovs;
    job->aovs = NULL;
    job->image.layers = NULL;
    if (!a)
        return;
    aov_finish(&a->planes);
    free(a->hits);
    for (int m = 0; m < MATTES; m++) {
        matte_finish(&a->mattes[m]);
        strbuf_finish(&a->manifests[m]);
    }
}

// ---- files of their own

static float value_of(const struct aov_info *info, const void *plane, size_t pixel, size_t channel) {
    const size_t at = pixel * info->channel_count + (info->channel_count > 1 ? channel : 0);
    return info->is_whole ? (float)((const uint32_t *)plane)[at] : ((const float *)plane)[at];
}

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
    const struct aov_info *info = aov_info(aov);
    const char *path = plane_name(job, stem, aov);
    struct image image;
    struct strbuf file;
    if (!image_init(&image, job->image.width, job->image.height))
        return no_memory(job);
    for (size_t i = 0; i < 3 * (size_t)image.width * image.height; i++)
        image.rgb[i] = value_of(info, job->aovs->planes.planes[aov], i / 3, i % 3);
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
    aov_names_json(&job->aovs->names, &job->session.sources, &file);
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
    if (!job->aovs)
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
