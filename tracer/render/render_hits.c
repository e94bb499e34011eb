// What every pixel's first ray hits: one dispatch per portion and kind of ray, and the mapping to bodies and
// pixels.
#include "core/float_bits.h"
#include "core/heap.h"
#include "tracer/render/render_private.h"

#include "core/parallel.h"
#include "shaders/hits.h"

#include <math.h>
#include <stdlib.h>

enum {
    PORTION_TILES_MAX = 8192, // 32 MiB of output
    TILES_A_PIECE = 256,
};

struct renderer_hits {
    struct gpu_buffer *output;
    struct gpu_program *program;
    struct gpu_word *words; // the portion's output, read back
    uint32_t portion_tiles;
    uint64_t unfinished;
};

static bool make(struct renderer *renderer) {
    struct renderer_hits *hits = heap_zeroed(1, sizeof *hits);
    if (!hits)
        return false;
    renderer->hits = hits;
    hits->portion_tiles = renderer->tiles < PORTION_TILES_MAX ? renderer->tiles : PORTION_TILES_MAX;
    const size_t words = heap_times(heap_times(hits->portion_tiles, TILE_PIXELS), HITS_WORDS);
    hits->words = heap_array(words, sizeof *hits->words);
    hits->output = gpu_buffer_create(renderer->gpu, GPU_STORAGE, words * sizeof *hits->words);
    const uint64_t own = FEATURE_SLICES | FEATURE_COUNTERS;
    if (hits->words && hits->output)
        hits->program =
            renderer_compile_kernel(renderer, RENDERER_HITS, renderer->features & ~own, hits->output, NULL);
    if (!hits->program)
        renderer_hits_destroy(renderer);
    return renderer->hits != NULL;
}

void renderer_hits_destroy(struct renderer *renderer) {
    struct renderer_hits *hits = renderer->hits;
    if (!hits)
        return;
    gpu_program_destroy(renderer->gpu, hits->program);
    gpu_buffer_destroy(renderer->gpu, hits->output);
    free(hits->words);
    free(hits);
    renderer->hits = NULL;
}

uint64_t renderer_hits_unfinished(const struct renderer *renderer) {
    return renderer->hits ? renderer->hits->unfinished : 0;
}

static bool is_kind_needed(const struct renderer *renderer, uint32_t kind) {
    const uint64_t features = renderer->flat->features;
    switch (kind) {
    case HITS_FIRST:
        return true;
    case HITS_MIRRORED:
        return features & (FEATURE_REFLECTION | FEATURE_REFRACTION);
    case HITS_REFRACTED:
        return features & FEATURE_REFRACTION;
    default:
        return features & (FEATURE_DIFFUSE | FEATURE_SPECULAR);
    }
}

static uint32_t kind_count(const struct renderer *renderer) {
    const uint32_t lights = renderer->flat->light_count;
    return HITS_LIGHTS + (lights < HITS_LIGHTS_MAX ? lights : HITS_LIGHTS_MAX);
}

// Which rays of which sample are traced.
struct asking {
    uint32_t sample, kinds;
    const struct render_progress *progress;
};

static enum render_result draw_portion(struct renderer *renderer, uint32_t tile_begin, uint32_t tile_count,
                                       const struct asking *asking) {
    const uint32_t kinds = asking->kinds, slots = tile_count * TILE_PIXELS;
    const struct render_progress *progress = asking->progress;
    double offset_x, offset_y, seconds;
    view_sample_offset(asking->sample, &offset_x, &offset_y);
    struct dispatch_block block = {.tile_begin = tile_begin,
                                   .tile_count = tile_count,
                                   .offset_x = (float)offset_x,
                                   .offset_y = (float)offset_y};
    for (uint32_t kind = 0; kind < kinds; kind++) {
        if (!is_kind_needed(renderer, kind))
            continue;
        block.resume = kind;
        for (block.path_begin = 0; block.path_begin < slots; block.path_begin = block.path_end) {
            if (!renderer_run_paths(renderer, renderer->hits->program, RENDERER_REPORTS, TILE_PIXELS, &block,
                                    slots, NULL, &seconds))
                return RENDER_FAILED;
            const double part = (kind + (double)block.path_end / slots) / kinds;
            const double done = (tile_begin + tile_count * part) / renderer->tiles;
            if (progress && progress->report && !progress->report(progress->context, done))
                return RENDER_CANCELLED;
        }
    }
    return RENDER_DONE;
}

static uint32_t body_of(const struct renderer *renderer, uint32_t number) {
    uint32_t body = HIT_NONE, triangle;
    if (number != HITS_NOTHING)
        renderer_number(renderer, number, &body, &triangle);
    return body;
}

static struct hit_pixel read_hit(const struct renderer *renderer, const struct gpu_word words[HITS_WORDS]) {
    struct hit_pixel hit = {.body = HIT_NONE, .reflected = HIT_NONE, .refracted = HIT_NONE};
    if (words[1].w == HITS_NOTHING)
        return hit;
    renderer_number(renderer, words[1].w, &hit.body, &hit.triangle);
    hit.considered = words[2].x;
    hit.lit = words[2].y;
    hit.reflected = body_of(renderer, words[2].z);
    hit.refracted = body_of(renderer, words[2].w);
    hit.distance = ldexp(renderer_real(renderer, words[0].x, words[0].y), -renderer->flat->scale_exponent);
    hit.normal = (vec3){float_of_bits(words[3].x), float_of_bits(words[3].y), float_of_bits(words[3].z)};
    hit.albedo = (vec3){float_of_bits(words[4].x), float_of_bits(words[4].y), float_of_bits(words[4].z)};
    hit.reflects = (words[4].w & HITS_REFLECTS) != 0;
    hit.refracts = (words[4].w & HITS_REFRACTS) != 0;
    return hit;
}

struct unpacking {
    const struct renderer *renderer;
    uint32_t tile_begin;
    struct hit_pixel *out;
};

static void unpack_tiles(void *context, size_t begin, size_t end) {
    const struct unpacking *u = context;
    for (size_t slot = begin * TILE_PIXELS; slot < end * TILE_PIXELS; slot++) {
        uint32_t x, y;
        if (renderer_pixel(u->renderer, u->tile_begin, (uint32_t)slot, &x, &y))
            u->out[(size_t)y * u->renderer->settings.width + x] =
                read_hit(u->renderer, u->renderer->hits->words + slot * HITS_WORDS);
    }
}

static void count_unfinished(struct renderer *renderer, uint32_t tile_begin, uint32_t tile_count) {
    for (uint32_t slot = 0; slot < tile_count * TILE_PIXELS; slot++) {
        uint32_t x, y;
        if (renderer_pixel(renderer, tile_begin, slot, &x, &y))
            renderer->hits->unfinished += renderer->hits->words[(size_t)slot * HITS_WORDS + 3].w;
    }
}

// As for a picture of one sample: through the middle of the lens.
static bool write_frame(struct renderer *renderer, const struct view_camera *camera) {
    const uint32_t samples = renderer->settings.samples, first = renderer->settings.first_sample;
    renderer->settings.samples = 1;
    renderer->settings.first_sample = 0;
    const bool written = renderer_write_frame(renderer, camera);
    renderer->settings.samples = samples;
    renderer->settings.first_sample = first;
    return written;
}

static enum render_result take(struct renderer *renderer, const struct view_camera *camera,
                               struct hit_pixel *out, const struct asking *asking) {
    if ((!renderer->hits && !make(renderer)) || !write_frame(renderer, camera))
        return RENDER_FAILED;
    struct renderer_hits *hits = renderer->hits;
    hits->unfinished = 0;
    for (uint32_t begin = 0; begin < renderer->tiles; begin += hits->portion_tiles) {
        const uint32_t left = renderer->tiles - begin;
        const uint32_t count = left < hits->portion_tiles ? left : hits->portion_tiles;
        enum render_result result = draw_portion(renderer, begin, count, asking);
        if (result != RENDER_DONE)
            return result;
        const uint64_t words = (uint64_t)count * TILE_PIXELS * HITS_WORDS;
        if (!gpu_read(renderer->gpu, hits->output, 0, hits->words, words * sizeof *hits->words))
            return RENDER_FAILED;
        struct unpacking unpacking = {renderer, begin, out};
        parallel_for(count, TILES_A_PIECE, unpack_tiles, &unpacking);
        count_unfinished(renderer, begin, count);
    }
    return RENDER_DONE;
}

enum render_result renderer_hits(struct renderer *renderer, const struct view_camera *camera,
                                 struct hit_pixel *out, const struct render_progress *progress) {
    if (!CLI_HAS_DEVICES)
        return RENDER_FAILED;
    const struct asking all = {0, kind_count(renderer), progress};
    return take(renderer, camera, out, &all);
}

enum render_result renderer_first_hits(struct renderer *renderer, const struct view_camera *camera,
                                       uint32_t sample, struct hit_pixel *out,
                                       const struct render_progress *progress) {
    if (!CLI_HAS_DEVICES)
        return RENDER_FAILED;
    const struct asking first = {sample, HITS_FIRST + 1, progress};
    return take(renderer, camera, out, &first);
}
