// One frame: bands, samples, slices, and the way back from slots to pixels.
#include "tracer/render/render_private.h"

#include "core/parallel.h"

#include <math.h>
#include <string.h>

static const double RADIANS = 3.14159265358979323846 / 180;

enum {
    TILES_A_PIECE = 256,
};

bool renderer_pixel(const struct renderer *renderer, uint32_t tile_begin, uint32_t slot, uint32_t *x,
                    uint32_t *y) {
    const uint32_t tile = tile_begin + slot / TILE_PIXELS, i = slot % TILE_PIXELS;
    const uint32_t run = tile / renderer->run_tiles * renderer->run_step % renderer->runs;
    const uint32_t place = run * renderer->run_tiles + tile % renderer->run_tiles;
    *x = place % renderer->tiles_x * TILE_SIDE + ((i & 1) | (i >> 1 & 2) | (i >> 2 & 4));
    *y = place / renderer->tiles_x * TILE_SIDE + ((i >> 1 & 1) | (i >> 2 & 2) | (i >> 3 & 4));
    return *x < renderer->settings.width && *y < renderer->settings.height;
}

static void put(float out[3], vec3 v) {
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
}

#define PUT_DOUBLES(frame, name, v)                                                                          \
    do {                                                                                                     \
        const vec3 put_vector = v;                                                                           \
        (frame).double_##name##_x = put_vector.x;                                                            \
        (frame).double_##name##_y = put_vector.y;                                                            \
        (frame).double_##name##_z = put_vector.z;                                                            \
    } while (false)

// Exact at multiples of 90 degrees.
static double cos_degrees(double degrees) {
    const double turn = remainder(degrees, 360);
    if (fmod(turn, 90) == 0)
        return turn == 0 ? 1 : fabs(turn) == 180 ? -1 : 0;
    return cos(turn * RADIANS);
}

bool renderer_write_frame(struct renderer *renderer, const struct view_camera *camera) {
    const struct render_settings *settings = &renderer->settings;
    const struct flat_scene *flat = renderer->flat;
    const double scale = ldexp(1, flat->scale_exponent);
    const double aspect = (double)settings->width / settings->height;
    struct frame_block frame = {
        .light_count = flat->light_count,
        .min_weight = (float)settings->min_weight,
        .max_depth = settings->max_depth,
        .path_segments =
            settings->path_segments < UINT32_MAX ? (uint32_t)settings->path_segments : UINT32_MAX,
        .background_intensity = (float)settings->background_intensity,
        .background_width = flat->background ? flat->background->width : 1,
        .background_height = flat->background ? flat->background->height : 1,
        .background_cos = (float)cos_degrees(settings->background_rotation),
        .background_sin = (float)cos_degrees(settings->background_rotation - 90),
        .width = settings->width,
        .height = settings->height,
        .tiles_x = renderer->tiles_x,
        .run_tiles = renderer->run_tiles,
        .runs = renderer->runs,
        .run_step = renderer->run_step,
        .sphere_count = flat->sphere_count,
        .slice_iterations = settings->slice_iterations,
        .features = flat->features,
        .top_nodes = flat->top_nodes,
        .instance_table = flat->instance_table,
        .instance_shift = flat->instance_shift,
    };
    const vec3 position = vec3_mul(vec3_sub(camera->position, flat->origin), scale);
    const vec3 right = vec3_mul(camera->right, camera->tan_half_fov * aspect);
    const vec3 up = vec3_mul(camera->up, camera->tan_half_fov);
    put(frame.camera_position, position);
    put(frame.camera_forward, camera->forward);
    put(frame.camera_right, right);
    put(frame.camera_up, up);
    put(frame.background, settings->background);
    PUT_DOUBLES(frame, position, position);
    PUT_DOUBLES(frame, forward, camera->forward);
    PUT_DOUBLES(frame, right, right);
    PUT_DOUBLES(frame, up, up);
    return gpu_write(renderer->gpu, renderer->buffers[BINDING_FRAME], 0, &frame, sizeof frame);
}

static bool is_over(struct renderer_frame *run) {
    if (run->limit && run->samples_done)
        run->is_over = run->limit->is_over(run->limit->context);
    return run->is_over;
}

bool renderer_is_wanted(const struct renderer_frame *run, double part) {
    const struct render_progress *progress = run->progress;
    return !progress || !progress->report ||
           progress->report(progress->context, ((double)run->steps_done + part) / (double)run->steps);
}

// What the dispatch added to a bank.
static void add_bank(struct renderer_frame *run, const uint32_t *now, const uint32_t *before) {
    for (int kind = 0; kind < COUNTER_SUMS; kind++)
        run->counts[kind] += now[kind] - before[kind]; // which may wrap around
    for (int kind = COUNTER_SUMS; kind < COUNTER_KINDS; kind++)
        if (now[kind] > run->counts[kind])
            run->counts[kind] = now[kind];
}

static bool read_counters(struct renderer_frame *run) {
    struct renderer *renderer = run->renderer;
    uint32_t counters[COUNTER_COUNT];
    const uint64_t bytes = run->counting ? sizeof counters : COUNTER_SHARED * sizeof *counters;
    if (renderer->counters)
        memcpy(counters, gpu_contents(renderer->counters), bytes);
    else if (!gpu_read(renderer->gpu, renderer->buffers[BINDING_COUNTERS], 0, counters, bytes))
        return false;
    for (uint32_t at = COUNTER_SHARED; at < COUNTER_COUNT && run->counting; at += COUNTER_BANK)
        add_bank(run, counters + at, run->counters + at);
    memcpy(run->counters, counters, bytes);
    renderer->pending = counters[COUNTER_PENDING];
    renderer->taken = counters[COUNTER_PLACES];
    renderer->restarts = counters[COUNTER_RESTARTS];
    run->met_long_ray = counters[COUNTER_LONG_RAYS] != 0;
    return true;
}

static bool run_paths(struct renderer_frame *run, struct dispatch_block *block, uint32_t end) {
    struct renderer *renderer = run->renderer;
    double seconds;
    if (!renderer_run_paths(renderer, run->program, block->resume ? RENDERER_RESUMES : RENDERER_BEGINS,
                            renderer->settings.workgroup, block, end, renderer->counters ? run : NULL,
                            &seconds))
        return false;
    run->statistics->device_seconds += seconds;
    run->statistics->dispatches++;
    return read_counters(run);
}

// All paths from the camera, or all that were saved, until they end or are saved again.
static enum render_result draw_pass(struct renderer_frame *run, struct dispatch_block *block, uint32_t end) {
    const uint32_t all = block->tile_count * TILE_PIXELS * (block->samples ? block->samples : 1);
    block->pending_base = run->renderer->pending;
    for (; block->path_begin < end; block->path_begin = block->path_end) {
        if (!run_paths(run, block, end))
            return RENDER_FAILED;
        const uint32_t saved = run->renderer->pending - block->pending_base;
        const uint32_t open = end - block->path_end + saved;
        if (run->met_long_ray)
            return RENDER_CANCELLED;
        if (open > 0 && (is_over(run) || !renderer_is_wanted(run, open < all ? 1 - (double)open / all : 0)))
            return RENDER_CANCELLED;
    }
    return RENDER_DONE;
}

// A pass, and others until none of its paths is left.
static enum render_result draw_to_end(struct renderer_frame *run, struct dispatch_block *block,
                                      uint32_t begin, uint32_t end) {
    block->place_base = run->renderer->taken;
    block->resume = 0;
    for (;;) {
        block->path_begin = begin;
        const enum render_result result = draw_pass(run, block, end);
        if (result != RENDER_DONE)
            return result;
        block->resume = run->renderer->pending - block->pending_base;
        if (block->resume == 0)
            return RENDER_DONE;
        begin = 0;
        end = block->resume;
        block->read_list = 1 - block->read_list;
        run->statistics->slices++;
    }
}

enum render_result renderer_draw_paths(struct renderer_frame *run, struct dispatch_block *block) {
    struct renderer *renderer = run->renderer;
    block->places = renderer->places;
    block->restart_base = renderer->restarts;
    block->restarts = 0;
    const uint32_t all = block->tile_count * TILE_PIXELS * (block->samples ? block->samples : 1);
    enum render_result result = draw_to_end(run, block, 0, all);
    // Those that found no place, as many at a time as there are places.
    const uint32_t left = renderer->restarts - block->restart_base;
    block->restarts = 1;
    for (uint32_t begin = 0; result == RENDER_DONE && begin < left; begin += renderer->places) {
        const uint32_t end = left - begin < renderer->places ? left : begin + renderer->places;
        result = draw_to_end(run, block, begin, end);
    }
    return result;
}

enum render_result renderer_draw_sample(struct renderer_frame *run, uint32_t tile_begin, uint32_t tile_count,
                                        uint32_t sample) {
    struct renderer *renderer = run->renderer;
    double a, b;
    view_sample_offset(renderer->settings.first_sample + sample, &a, &b);
    struct dispatch_block block = {.tile_begin = tile_begin,
                                   .tile_count = tile_count,
                                   .sample_index = sample,
                                   .offset_x = (float)a,
                                   .offset_y = (float)b};
    if (renderer->samples_at_once && !renderer_write_samples(renderer, sample, 1))
        return RENDER_FAILED;
    const enum render_result result = renderer_draw_paths(run, &block);
    if (result != RENDER_DONE)
        return result;
    run->steps_done++;
    return renderer_is_wanted(run, 0) ? RENDER_DONE : RENDER_CANCELLED;
}

struct unpacking {
    const struct renderer *renderer;
    uint32_t tile_begin, samples;
    const uint32_t *sums;
    float *rgb;
};

static void unpack_tiles(void *context, size_t begin, size_t end) {
    const struct unpacking *u = context;
    const struct render_settings *settings = &u->renderer->settings;
    const float samples = (float)u->samples;
    for (size_t slot = begin * TILE_PIXELS; slot < end * TILE_PIXELS; slot++) {
        uint32_t x, y;
        if (!renderer_pixel(u->renderer, u->tile_begin, (uint32_t)slot, &x, &y))
            continue;
        float sum[3];
        memcpy(sum, u->sums + 4 * slot, sizeof sum);
        float *out = u->rgb + ((size_t)y * settings->width + x) * 3;
        const bool sound = u->sums[4 * slot + 3] >> FAULT_KIND_SHIFT != FAULT_NOT_FINITE;
        for (int i = 0; i < 3; i++)
            out[i] = sound ? sum[i] / samples : NAN;
    }
}

void renderer_unpack(const struct renderer *renderer, uint32_t tile_begin, uint32_t tile_count,
                     const uint32_t *sums, uint32_t samples, float *rgb) {
    struct unpacking unpacking = {renderer, tile_begin, samples, sums, rgb};
    parallel_for(tile_count, TILES_A_PIECE, unpack_tiles, &unpacking);
}

void renderer_number(const struct renderer *renderer, uint32_t number, uint32_t *body, uint32_t *triangle) {
    const struct flat_scene *flat = renderer->flat;
    *triangle = 0;
    *body = number;
    if (number < flat->sphere_count)
        return;
    // The last body whose first triangle is not after this one.
    const uint32_t wanted = number - flat->sphere_count;
    uint32_t low = flat->sphere_count, high = flat->body_count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (flat->first_triangle[middle] <= wanted)
            low = middle;
        else
            high = middle;
    }
    *body = low;
    *triangle = wanted - flat->first_triangle[low];
}

void renderer_note_fault(const struct renderer *renderer, uint32_t word, uint32_t pixels, uint32_t x,
                         uint32_t y, struct render_fault *fault) {
    const bool first = fault->pixels == 0 || y < fault->y || (y == fault->y && x < fault->x);
    fault->pixels += pixels;
    if (!first)
        return;
    const uint32_t number = word & FAULT_NUMBER;
    fault->x = x;
    fault->y = y;
    fault->has_body = number != FAULT_NUMBER;
    fault->body = fault->triangle = 0;
    if (fault->has_body)
        renderer_number(renderer, number, &fault->body, &fault->triangle);
}

void renderer_note_faults(const struct renderer *renderer, uint32_t tile_begin, uint32_t tile_count,
                          const uint32_t *sums, struct render_statistics *statistics) {
    for (uint32_t slot = 0; slot < tile_count * TILE_PIXELS; slot++) {
        const uint32_t word = sums[4 * (size_t)slot + 3];
        if (word >> FAULT_KIND_SHIFT == FAULT_NONE)
            continue;
        uint32_t x, y;
        if (renderer_pixel(renderer, tile_begin, slot, &x, &y))
            renderer_note_fault(renderer, word, 1, x, y, &statistics->faults[word >> FAULT_KIND_SHIFT]);
    }
}

static enum render_result draw_band(struct renderer_frame *run, uint32_t tile_begin, uint32_t tile_count,
                                    float *rgb) {
    struct renderer *renderer = run->renderer;
    for (uint32_t sample = 0; sample < renderer->settings.samples; sample++) {
        const enum render_result result = renderer_draw_sample(run, tile_begin, tile_count, sample);
        if (result != RENDER_DONE)
            return result;
    }
    if (!rgb)
        return RENDER_DONE;
    if (!gpu_read(renderer->gpu, renderer->buffers[BINDING_OUTPUT], 0, renderer->band,
                  (uint64_t)tile_count * TILE_PIXELS * sizeof(struct gpu_word)))
        return RENDER_FAILED;
    renderer_unpack(renderer, tile_begin, tile_count, renderer->band, renderer->settings.samples, rgb);
    renderer_note_faults(renderer, tile_begin, tile_count, renderer->band, run->statistics);
    return RENDER_DONE;
}

bool renderer_begin_frame(struct renderer_frame *run, const struct view_camera *camera) {
    const struct renderer *renderer = run->renderer;
    run->steps_done = 0;
    run->met_long_ray = false;
    run->statistics->bands = (renderer->tiles + renderer->band_tiles - 1) / renderer->band_tiles;
    run->steps = (uint64_t)run->statistics->bands * renderer->settings.samples;
    run->statistics->samples = renderer->settings.samples;
    return renderer_write_frame(run->renderer, camera);
}

enum render_result renderer_draw_frame(struct renderer_frame *run, const struct view_camera *camera,
                                       float *rgb) {
    struct renderer *renderer = run->renderer;
    const uint32_t tiles = renderer->tiles;
    enum render_result result = renderer_begin_frame(run, camera) ? RENDER_DONE : RENDER_FAILED;
    if (result == RENDER_DONE && renderer->samples_at_once)
        return renderer_draw_at_once(run, rgb);
    for (uint32_t begin = 0; result == RENDER_DONE && begin < tiles; begin += renderer->band_tiles) {
        const uint32_t left = tiles - begin;
        result = draw_band(run, begin, left < renderer->band_tiles ? left : renderer->band_tiles, rgb);
    }
    return result;
}
