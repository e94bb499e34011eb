#include "render/aov/layers.h"

#include "core/heap.h"
#include "core/parallel.h"
#include "grammar/ir.h"
#include "reference/reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    COVERAGE_SAMPLES_MOST = 256, // samples per pixel that its coverage is made from
    RANKS_A_LAYER = 2,
    LAYER_FLOATS = 2 * RANKS_A_LAYER,
    ROWS_A_PIECE = 4,
};

static const enum aov matte_aovs[LAYERS_MATTES] = {AOV_OBJECT, AOV_MATERIAL};
static const char *const matte_layers[LAYERS_MATTES] = {"CryptoObject", "CryptoMaterial"};

bool layers_have(const struct layers *layers, enum aov aov) {
    return layers->wish.wanted >> aov & 1;
}

// ---- what pixels see

static bool stays(void *context, double fraction) {
    const struct render_progress *progress = context;
    (void)fraction; // the picture's share is done
    return progress->report(progress->context, 1);
}

static bool makes_mattes(const struct layers *l) {
    return l->wish.in_picture && (layers_have(l, AOV_OBJECT) || layers_have(l, AOV_MATERIAL));
}

static uint32_t coverage_samples(const struct layers *l) {
    const uint32_t samples = (uint32_t)l->session->image->samples;
    return samples < COVERAGE_SAMPLES_MOST ? samples : COVERAGE_SAMPLES_MOST;
}

static uint32_t bits_of(const struct layers *l, int matte, const struct hit_pixel *hit) {
    const struct aov_names *names = &l->names;
    if (hit->body == HIT_NONE)
        return 0;
    return matte_aovs[matte] == AOV_OBJECT ? names->objects[hit->body].bits
                                           : names->materials[aov_material(&l->session->resolved, hit)].bits;
}

static void add_pixel(struct layers *l, size_t pixel, const struct hit_pixel *hit) {
    for (int m = 0; m < LAYERS_MATTES; m++)
        if (l->mattes[m].pixels)
            matte_add(&l->mattes[m], pixel, bits_of(l, m, hit));
}

static enum shot_status hits_by_device(struct layers *l, const struct render_progress *bar) {
    const size_t pixels = (size_t)l->planes.width * l->planes.height;
    const struct view_camera *camera = &l->wish.shot->view.camera;
    const struct render_progress progress = {stays, (void *)bar};
    enum render_result result =
        layers_have(l, AOV_COST) ? renderer_hits(l->wish.shot->renderer, camera, l->hits, &progress)
                                 : renderer_first_hits(l->wish.shot->renderer, camera, 0, l->hits, &progress);
    if (result == RENDER_DONE)
        aov_fill(&l->planes, &l->session->resolved, camera, l->hits);
    if (!makes_mattes(l))
        return shot_status_of(result);
    for (uint32_t s = 0; s < coverage_samples(l) && result == RENDER_DONE; s++) {
        if (s)
            result = renderer_first_hits(l->wish.shot->renderer, camera, s, l->hits, &progress);
        for (size_t i = 0; i < pixels && result == RENDER_DONE; i++)
            add_pixel(l, i, &l->hits[i]);
    }
    return shot_status_of(result);
}

struct covering {
    struct layers *layers;
    const struct reference *reference;
    const struct view_camera *camera;
};

static void cover_pixel(const struct covering *c, uint32_t x, uint32_t y) {
    const struct aov_planes *p = &c->layers->planes;
    for (uint32_t s = 0; s < coverage_samples(c->layers); s++) {
        double across, down;
        struct reference_hit hit;
        view_sample_offset(s, &across, &down);
        const struct view_ray ray =
            view_ray_at(c->camera, (double)p->width / p->height, 2 * (x + across) / p->width - 1,
                        1 - 2 * (y + down) / p->height);
        reference_closest(c->reference, ray.start, ray.direction, INFINITY, &hit);
        add_pixel(c->layers, (size_t)y * p->width + x,
                  &(struct hit_pixel){.body = hit.body, .triangle = hit.triangle});
    }
}

static void cover_rows(void *context, size_t begin, size_t end) {
    const struct covering *c = context;
    for (size_t y = begin; y < end; y++)
        for (uint32_t x = 0; x < c->layers->planes.width; x++)
            cover_pixel(c, x, (uint32_t)y);
}

static enum shot_status hits_by_reference(struct layers *l, const struct render_progress *bar) {
    struct reference_shot *shot = l->wish.reference;
    const struct view_camera *camera = &shot->view.camera;
    const struct reference_progress progress = {stays, (void *)bar};
    const enum reference_result result =
        reference_source_hits(&shot->source, &shot->settings, l->hits, &progress);
    if (result == REFERENCE_CANCELLED)
        return SHOT_CANCELLED;
    const struct reference *reference = makes_mattes(l) ? reference_source_get(&shot->source) : NULL;
    if (result != REFERENCE_DONE || (makes_mattes(l) && !reference))
        return shot_no_memory(l->session, "the reference");
    aov_fill(&l->planes, &l->session->resolved, camera, l->hits);
    struct covering covering = {l, reference, camera};
    if (reference)
        parallel_for(l->planes.height, ROWS_A_PIECE, cover_rows, &covering);
    return SHOT_OK;
}

// ---- layers of OpenEXR

static void add_channel(struct layers *l, const char *name, enum exr_type type, const void *first,
                        uint32_t step) {
    l->channels[l->layers.channel_count++] =
        (struct exr_channel){name, type, first, (int32_t)(step * sizeof(float))};
}

static void add_plane(struct layers *l, enum aov aov) {
    const struct aov_info *info = aov_info(aov);
    for (uint32_t k = 0; k < info->channel_count; k++)
        add_channel(l, arena_format(l->arena, "%s.%c", info->name, info->channels[k]).ptr,
                    info->is_whole ? EXR_TYPE_UINT : EXR_TYPE_FLOAT, (float *)l->planes.planes[aov] + k,
                    info->channel_count);
}

static void add_attribute(struct layers *l, const char *key, const char *name, const char *value) {
    struct image_layers *layers = &l->layers;
    l->attributes[layers->attribute_count++] =
        (struct exr_attribute){arena_format(l->arena, "cryptomatte/%s/%s", key, name).ptr, value};
}

static void add_matte(struct layers *l, int number) {
    const struct matte *matte = &l->mattes[number];
    struct strbuf *manifest = &l->manifests[number];
    const bool is_object = matte_aovs[number] == AOV_OBJECT;
    char key[8];
    matte_key(str_from(matte_layers[number]), key);
    aov_manifest(is_object ? l->names.objects : l->names.materials,
                 is_object ? l->names.object_count : l->names.material_count, manifest);
    add_attribute(l, key, "name", matte_layers[number]);
    add_attribute(l, key, "hash", "MurmurHash3_32");
    add_attribute(l, key, "conversion", "uint32_to_float32");
    add_attribute(l, key, "manifest", manifest->data);
    for (uint32_t i = 0; i < LAYERS_MATTE_CHANNELS; i++)
        add_channel(l,
                    arena_format(l->arena, "%s%02u.%c", matte_layers[number], i / LAYER_FLOATS,
                                 "RGBA"[i % LAYER_FLOATS])
                        .ptr,
                    EXR_TYPE_FLOAT, matte->ranks + i, LAYERS_MATTE_CHANNELS);
}

static bool make_layers(struct layers *l) {
    for (int i = 0; i < AOVS; i++)
        if (l->planes.planes[i])
            add_plane(l, (enum aov)i);
    for (int m = 0; m < LAYERS_MATTES; m++) {
        if (!l->mattes[m].pixels)
            continue;
        if (!matte_end(&l->mattes[m], coverage_samples(l)))
            return false;
        add_matte(l, m);
        if (l->manifests[m].failed)
            return false;
    }
    l->layers.channels = l->channels;
    l->layers.attributes = l->attributes;
    return true;
}

// ---- all of it

static bool begin(struct layers *l) {
    const struct layers_wish *wish = &l->wish;
    for (int m = 0; m < LAYERS_MATTES; m++)
        strbuf_init(&l->manifests[m]);
    aov_names_make(l->session, l->arena, &l->names);
    if (!aov_init(&l->planes, wish->width, wish->height, wish->wanted))
        return false;
    for (int m = 0; m < LAYERS_MATTES; m++)
        if (wish->in_picture && layers_have(l, matte_aovs[m]) &&
            !matte_init(&l->mattes[m], wish->width, wish->height))
            return false;
    if (aov_needs_hits(wish->wanted))
        l->hits = heap_zeroed(heap_times(wish->width, wish->height), sizeof *l->hits);
    return l->hits || !aov_needs_hits(wish->wanted);
}

enum shot_status layers_make(struct layers *layers, struct session *session, const struct layers_wish *wish,
                             const struct render_progress *progress, struct arena *arena) {
    const struct render_estimate *estimate = wish->estimate;
    enum shot_status status = SHOT_OK;
    *layers = (struct layers){.wish = *wish, .session = session, .arena = arena};
    if (!begin(layers))
        return SHOT_NO_MEMORY;
    aov_fill_samples(&layers->planes, estimate ? estimate->error : NULL, estimate ? estimate->samples : NULL,
                     (uint32_t)session->image->samples);
    if (layers->hits)
        status = wish->shot ? hits_by_device(layers, progress) : hits_by_reference(layers, progress);
    if (status == SHOT_OK && wish->in_picture && !make_layers(layers))
        status = SHOT_NO_MEMORY;
    return status;
}

static float value_of(const struct aov_info *info, const void *plane, size_t pixel, size_t channel) {
    const size_t at = pixel * info->channel_count + (info->channel_count > 1 ? channel : 0);
    return info->is_whole ? (float)((const uint32_t *)plane)[at] : ((const float *)plane)[at];
}

bool layers_plane(const struct layers *layers, enum aov aov, struct image *image) {
    if (!image_init(image, layers->planes.width, layers->planes.height))
        return false;
    for (size_t i = 0; i < 3 * (size_t)image->width * image->height; i++)
        image->rgb[i] = value_of(aov_info(aov), layers->planes.planes[aov], i / 3, i % 3);
    return true;
}

void layers_finish(struct layers *layers) {
    aov_finish(&layers->planes);
    free(layers->hits);
    for (int m = 0; m < LAYERS_MATTES; m++) {
        matte_finish(&layers->mattes[m]);
        strbuf_finish(&layers->manifests[m]);
    }
    *layers = (struct layers){0};
}
