// One sample's path, logged ray by ray: the host decides which rays go on, as the tracer does, and the log
// kernel follows all rays of a level at once. Weights and sums are floats in the tracer's order.
#include "core/float_bits.h"
#include "core/heap.h"
#include "tracer/render/render_private.h"

#include "scene/points.h"
#include "shaders/log.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    BATCH_RAYS = 256,
    NO_NODE = UINT32_MAX,
};

struct renderer_log {
    struct gpu_buffer *state, *output;
    struct gpu_program *program;
    struct gpu_word rays[BATCH_RAYS * LOG_RAY_WORDS];
    struct gpu_word told[BATCH_RAYS * LOG_WORDS];
};

// A ray while the path is walked level by level, so that children come after their parents.
struct node {
    struct render_segment segment;
    struct gpu_word ray[LOG_RAY_WORDS];
    float throughput, radiance[3];
    float tint[3];        // what attenuation and coloured mirrors have left of each channel
    uint32_t key;         // of its points, as the device reports it
    uint32_t children[2]; // mirrored, refracted; NO_NODE: none
};

struct walk {
    struct renderer *renderer;
    uint32_t x, y, sample; // the pixel, and which sample of it
    struct node *nodes;
    uint32_t count, capacity;
    bool whole;
};

static bool make(struct renderer *renderer) {
    struct renderer_log *log = heap_zeroed(1, sizeof *log);
    if (!log)
        return false;
    renderer->log = log;
    log->state = gpu_buffer_create(renderer->gpu, GPU_STORAGE, sizeof log->rays);
    log->output = gpu_buffer_create(renderer->gpu, GPU_STORAGE, sizeof log->told);
    const uint64_t own = FEATURE_SLICES | FEATURE_COUNTERS;
    if (log->state && log->output)
        log->program = renderer_compile_kernel(renderer, RENDERER_LOG, renderer->features & ~own, log->output,
                                               log->state);
    if (!log->program)
        renderer_log_destroy(renderer);
    return renderer->log != NULL;
}

void renderer_log_destroy(struct renderer *renderer) {
    struct renderer_log *log = renderer->log;
    if (!log)
        return;
    gpu_program_destroy(renderer->gpu, log->program);
    gpu_buffer_destroy(renderer->gpu, log->output);
    gpu_buffer_destroy(renderer->gpu, log->state);
    free(log);
    renderer->log = NULL;
}

static bool dispatch(struct renderer *renderer, struct dispatch_block block, uint32_t kind) {
    block.resume = kind;
    return gpu_dispatch(renderer->gpu, renderer->log->program,
                        (block.tile_count + TILE_PIXELS - 1) / TILE_PIXELS, 1, &block) &&
           gpu_submit(renderer->gpu) && gpu_wait(renderer->gpu, NULL);
}

static struct dispatch_block block_of(const struct walk *walk, uint32_t rays) {
    return (struct dispatch_block){.tile_count = rays,
                                   .grid_width = 1,
                                   .read_list = walk->x,
                                   .pending_base = walk->y,
                                   .first_sample = walk->sample};
}

// Where the sample lies in its pixel.
static void place_of(const struct walk *walk, double *a, double *b) {
    const struct render_settings *settings = &walk->renderer->settings;
    const struct points points = {walk->x, walk->y, walk->sample,
                                  points_bits(settings->first_sample, settings->samples)};
    if (renderer_is_adaptive(walk->renderer))
        points_at(&points, point_key(point_root(walk->x, walk->y), POINT_PIXEL), a, b);
    else
        view_sample_offset(walk->sample, a, b);
}

static bool make_camera_ray(const struct walk *walk, struct gpu_word ray[LOG_RAY_WORDS]) {
    struct renderer *renderer = walk->renderer;
    struct dispatch_block block = block_of(walk, 1);
    double offset_x, offset_y;
    place_of(walk, &offset_x, &offset_y);
    block.offset_x = (float)offset_x;
    block.offset_y = (float)offset_y;
    return dispatch(renderer, block, LOG_CAMERA) &&
           gpu_read(renderer->gpu, renderer->log->state, 0, ray, LOG_RAY_WORDS * sizeof *ray);
}

// Follows nodes begin .. end - 1, at most BATCH_RAYS of them, into log->told.
static bool follow(struct walk *walk, uint32_t begin, uint32_t end) {
    struct renderer *renderer = walk->renderer;
    struct renderer_log *log = renderer->log;
    const struct dispatch_block block = block_of(walk, end - begin);
    for (uint32_t i = begin; i < end; i++)
        memcpy(log->rays + (size_t)(i - begin) * LOG_RAY_WORDS, walk->nodes[i].ray,
               sizeof walk->nodes[i].ray);
    if (!gpu_write(renderer->gpu, log->state, 0, log->rays, sizeof log->rays) ||
        !dispatch(renderer, block, LOG_FOLLOW))
        return false;
    // After the lights come ambient light, if bodies may block it, and the background.
    const uint32_t lights = renderer->flat->light_count +
                            (renderer->flat->features & FEATURE_OCCLUSION ? 1 : 0) +
                            (renderer->flat->sky.rows ? 1 : 0);
    for (uint32_t light = 0; light < lights; light++)
        if (!dispatch(renderer, block, LOG_LIGHTS + light))
            return false;
    return gpu_read(renderer->gpu, log->output, 0, log->told, sizeof log->told);
}

// Three numbers in two words.
static vec3 vector_at(const struct renderer *renderer, const struct gpu_word *words) {
    return (vec3){renderer_real(renderer, words[0].x, words[0].y),
                  renderer_real(renderer, words[0].z, words[0].w),
                  renderer_real(renderer, words[1].x, words[1].y)};
}

static vec3 point_at(const struct renderer *renderer, const struct gpu_word *words) {
    const vec3 flat = vector_at(renderer, words);
    const int exponent = -renderer->flat->scale_exponent;
    const vec3 scaled = {ldexp(flat.x, exponent), ldexp(flat.y, exponent), ldexp(flat.z, exponent)};
    return vec3_add(scaled, renderer->flat->origin);
}

// NULL: there is no room.
static struct node *put_child(struct walk *walk, uint32_t parent, enum render_ray kind,
                              const struct gpu_word *ray, const struct gpu_word inside[2]) {
    struct node *from = &walk->nodes[parent];
    if (walk->count == walk->capacity) {
        walk->whole = false;
        return NULL;
    }
    struct node *child = &walk->nodes[walk->count];
    *child = (struct node){.children = {NO_NODE, NO_NODE}};
    child->segment.kind = kind;
    child->segment.parent = parent;
    memcpy(child->tint, from->tint, sizeof child->tint);
    memcpy(child->ray, ray, LOG_INSIDE * sizeof *ray);
    memcpy(child->ray + LOG_INSIDE, inside, 2 * sizeof *inside);
    child->ray[LOG_KEY] = (struct gpu_word){
        .x = from->key, .y = kind == RENDER_RAY_REFRACTED ? POINT_REFRACTED : POINT_REFLECTED};
    from->children[kind == RENDER_RAY_REFRACTED] = walk->count++;
    return child;
}

// Adds the rays that leave a surface, as the tracer's is_followed and send_rays decide.
static void add_child(struct walk *walk, uint32_t parent, enum render_ray kind, float share, vec3 color,
                      const struct gpu_word *ray, const struct gpu_word inside[2]) {
    const struct render_settings *settings = &walk->renderer->settings;
    const struct node *from = &walk->nodes[parent];
    const float throughput = from->throughput * share;
    const float tint[3] = {from->tint[0] * (float)color.x, from->tint[1] * (float)color.y,
                           from->tint[2] * (float)color.z};
    const float part = throughput * fmaxf(tint[0], fmaxf(tint[1], tint[2]));
    const bool heavy = part > 0 && part >= (float)settings->min_weight;
    const bool last = from->segment.depth == settings->max_depth;
    if (part > 0 && (!heavy || last))
        walk->nodes[parent].segment.cut_weight += (double)part;
    if (!heavy || (last && (walk->renderer->flat->features & FEATURE_DEPTH_BLACK)))
        return;
    struct node *child = put_child(walk, parent, kind, ray, inside);
    if (!child)
        return;
    memcpy(child->tint, tint, sizeof tint);
    child->throughput = throughput;
    child->segment.depth = from->segment.depth + 1;
    child->ray[1].z = last ? LOG_BLIND : 0;
}

// A surface that nobody sees: straight on, at the same depth and with the same weight.
static void pass(struct walk *walk, uint32_t parent, const struct gpu_word *told) {
    const struct node *from = &walk->nodes[parent];
    struct node *child = put_child(walk, parent, from->segment.kind, told + LOG_REFRACTED, told + LOG_AFTER);
    if (!child)
        return;
    child->ray[LOG_KEY].y = POINT_SAME;
    child->throughput = from->throughput;
    child->segment.depth = from->segment.depth;
    child->ray[1].z = 0;
}

static void take_surface(struct walk *walk, uint32_t index, const struct gpu_word *told) {
    const struct renderer *renderer = walk->renderer;
    struct render_segment *s = &walk->nodes[index].segment;
    renderer_number(renderer, told[1].w, &s->body, &s->triangle);
    s->distance = ldexp(renderer_real(renderer, told[0].x, told[0].y), -renderer->flat->scale_exponent);
    s->considered = told[2].x;
    s->lit = told[2].y;
    s->enters = told[2].z & LOG_ENTERS;
    s->total_reflection = told[2].z & LOG_TOTAL;
    s->passes = told[2].z & LOG_PASSES;
    walk->nodes[index].tint[0] *= float_of_bits(told[LOG_LEFT].x);
    walk->nodes[index].tint[1] *= float_of_bits(told[LOG_LEFT].y);
    walk->nodes[index].tint[2] *= float_of_bits(told[LOG_LEFT].z);
    walk->nodes[index].key = told[LOG_LEFT].w;
    s->material = told[3].w;
    s->point = point_at(renderer, told + 4);
    s->geometric = vector_at(renderer, told + 6);
    s->shading = vector_at(renderer, told + 8);
    if (told[2].z & LOG_NESTED) {
        walk->nodes[index].radiance[0] = walk->nodes[index].radiance[1] = walk->nodes[index].radiance[2] =
            NAN;
        return;
    }
    if (s->passes) {
        pass(walk, index, told);
        return;
    }
    const vec3 color = {float_of_bits(told[LOG_COLOR].x), float_of_bits(told[LOG_COLOR].y),
                        float_of_bits(told[LOG_COLOR].z)};
    add_child(walk, index, RENDER_RAY_REFLECTED, float_of_bits(told[5].z), color, told + LOG_REFLECTED,
              walk->nodes[index].ray + LOG_INSIDE);
    add_child(walk, index, RENDER_RAY_REFRACTED, float_of_bits(told[5].w), (vec3){1, 1, 1},
              told + LOG_REFRACTED, told + LOG_AFTER);
}

// For a ray that hits nothing, what it sees: a light, or the background.
static void take_light(struct walk *walk, uint32_t index, const struct gpu_word *told) {
    const struct renderer *renderer = walk->renderer;
    struct node *node = &walk->nodes[index];
    if (told[2].z == 0)
        return;
    node->segment.light = told[2].z - 1;
    node->segment.distance =
        ldexp(renderer_real(renderer, told[0].x, told[0].y), -renderer->flat->scale_exponent);
    node->tint[0] *= float_of_bits(told[LOG_LEFT].x);
    node->tint[1] *= float_of_bits(told[LOG_LEFT].y);
    node->tint[2] *= float_of_bits(told[LOG_LEFT].z);
}

// As filling() of media.glsl.
static uint32_t filling(const struct gpu_word inside[2]) {
    const uint32_t entries[MEDIA_MOST] = {inside[0].x, inside[0].y, inside[0].z, inside[0].w,
                                          inside[1].x, inside[1].y, inside[1].z, inside[1].w};
    uint32_t best = 0;
    for (int i = 0; i < MEDIA_MOST; i++)
        best = entries[i] >> MEDIUM_BITS > best >> MEDIUM_BITS ? entries[i] : best;
    return best ? (best & MEDIUM_MASK) - 1 : HIT_NONE;
}

static void take(struct walk *walk, uint32_t index, const struct gpu_word *told) {
    const struct renderer *renderer = walk->renderer;
    struct node *node = &walk->nodes[index];
    struct render_segment *s = &node->segment;
    s->weight = (double)node->throughput;
    s->origin = point_at(renderer, node->ray);
    s->direction = vector_at(renderer, node->ray + 2);
    s->radiance = (vec3){float_of_bits(told[3].x), float_of_bits(told[3].y), float_of_bits(told[3].z)};
    node->radiance[0] = (float)s->radiance.x;
    node->radiance[1] = (float)s->radiance.y;
    node->radiance[2] = (float)s->radiance.z;
    s->unfinished = told[2].w != 0;
    s->body = HIT_NONE;
    s->medium = filling(node->ray + LOG_INSIDE);
    s->material = UINT32_MAX;
    s->light = UINT32_MAX;
    if (told[1].z == LOG_NOTHING)
        take_light(walk, index, told);
    else
        take_surface(walk, index, told);
    const float *tint = walk->nodes[index].tint;
    s->tint = (vec3){(double)tint[0], (double)tint[1], (double)tint[2]};
}

// Depth-first, mirrored rays before refracted ones: the order in which the tracer adds.
static bool tell(const struct walk *walk, struct render_log *log) {
    uint32_t *place = heap_array(heap_times(2, walk->count), sizeof *place);
    walk->nodes[0].segment.parent = UINT32_MAX;
    if (!place)
        return false;
    uint32_t *stack = place + walk->count, size = 0;
    stack[size++] = 0;
    while (size) {
        const uint32_t index = stack[--size];
        const struct node *node = &walk->nodes[index];
        struct render_segment *s = &log->segments[log->count];
        *s = node->segment;
        s->parent = index ? place[s->parent] : UINT32_MAX;
        place[index] = log->count++;
        for (int i = 0; i < 3; i++)
            log->rgb[i] += node->radiance[i] * node->tint[i] * node->throughput;
        for (int i = 1; i >= 0; i--)
            if (node->children[i] != NO_NODE)
                stack[size++] = node->children[i];
    }
    free(place);
    return true;
}

static enum render_result walk_path(struct walk *walk) {
    uint32_t begin = 0;
    while (begin < walk->count) {
        const uint32_t left = walk->count - begin;
        const uint32_t end = begin + (left < BATCH_RAYS ? left : BATCH_RAYS);
        if (!follow(walk, begin, end))
            return RENDER_FAILED;
        for (uint32_t i = begin; i < end; i++)
            take(walk, i, walk->renderer->log->told + (size_t)(i - begin) * LOG_WORDS);
        begin = end;
    }
    return RENDER_DONE;
}

enum render_result renderer_log(struct renderer *renderer, const struct view_camera *camera, uint32_t x,
                                uint32_t y, uint32_t sample, struct render_log *log) {
    log->count = 0;
    log->whole = true;
    memset(log->rgb, 0, sizeof log->rgb);
    struct walk walk = {
        .renderer = renderer, .x = x, .y = y, .sample = sample, .capacity = log->capacity, .whole = true};
    walk.nodes = heap_array(log->capacity, sizeof *walk.nodes);
    if (!walk.nodes || (!renderer->log && !make(renderer)) || !renderer_write_frame(renderer, camera)) {
        free(walk.nodes);
        return RENDER_FAILED;
    }
    walk.nodes[0] = (struct node){.throughput = 1, .tint = {1, 1, 1}, .children = {NO_NODE, NO_NODE}};
    walk.count = 1;
    enum render_result result = RENDER_FAILED;
    if (make_camera_ray(&walk, walk.nodes[0].ray))
        result = walk_path(&walk);
    log->whole = walk.whole;
    if (result == RENDER_DONE && !tell(&walk, log))
        result = RENDER_FAILED;
    free(walk.nodes);
    return result;
}
