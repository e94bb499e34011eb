#include "core/clock.h"
#include "core/heap.h"
#include "core/parallel.h"
#include "core/timeline.h"
#include "tracer/render/render_private.h"

#include "grammar/ir.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    SHORT_PATH_RAYS = 4,       // paths of at most these are never saved
    MANY_LIGHTS = 64,          // with more lights the sum keeps what rounding drops
    PORTION_TILES_MAX = 16384, // a megapixel: between portions, progress is reported and Ctrl-C handled
    RUN_TILES = 8,             // few, so that threads with equally many runs have equally much work
    RUNS_MOST = 65536,         // so that products fit 32 bits
    PATH_OUTPUT_BYTES = 16,
    PRIVATE_BRANCHES = 64,   // refracted rays that wait in a GPU's private memory, at most
    PATHS_AT_ONCE = 8 << 20, // enough that the last ones of a frame do not leave a GPU idle for long
    PICTURE_PIXEL_BYTES = 12,
    WORD_BYTES = 16,
};

struct render_settings render_settings_of(const struct scene *scene, const struct flat_scene *flat,
                                          const struct limits *limits) {
    const struct ir_scene *ir = scene->ir;
    return (struct render_settings){
        .width = (uint32_t)ir->image.width,
        .height = (uint32_t)ir->image.height,
        .samples = (uint32_t)ir->image.samples,
        .max_depth = (uint32_t)ir->trace.max_depth,
        .min_weight = ir->trace.min_weight,
        .background = scene->background.color,
        .background_intensity = scene->background.intensity,
        .background_rotation = ir->background.rotation,
        .features = flat->features,
        .path_segments = limits->value[LIMIT_PATH_SEGMENTS],
        .slice_iterations = SLICE_ITERATIONS,
    };
}

// A step through the runs that is coprime to their number and near the golden section of that number.
static uint32_t run_step_of(uint32_t runs) {
    for (uint32_t step = (uint32_t)(runs * 0.618); step > 1; step--) {
        uint32_t a = runs, b = step;
        while (b) {
            const uint32_t rest = a % b;
            a = b;
            b = rest;
        }
        if (a == 1)
            return step;
    }
    return 1;
}

// The most bytes of a portion's output, and of its path state. A GPU needs a million paths at a time to be
// busy: with 64 MiB the original's scene takes 4.2 ms on an H200, with 1 GiB 0.75 ms. lavapipe's threads wait
// for each other at the end of a portion: at 512x384, one of 128 MiB takes 53 ms, two of 64 MiB take 69 ms.
static uint64_t portion_bytes(const struct gpu_device_info *device) {
    const uint64_t least = 128u << 20, most = 1u << 30;
    uint64_t bytes = device->kind == GPU_CPU ? least : device->memory_bytes / 16;
    bytes = bytes < least ? least : bytes < most ? bytes : most;
    return bytes < device->storage_bytes ? bytes : device->storage_bytes;
}

static uint64_t slot_state_bytes(const struct renderer *renderer) {
    if (!(renderer->features & FEATURE_SLICES))
        return 0;
    const bool is_double = renderer->flat->is_double;
    const uint64_t state = is_double ? STATE64_WORDS : STATE_WORDS;
    const uint64_t entry = is_double ? STACK64_ENTRY_WORDS : STACK_ENTRY_WORDS;
    const uint64_t ray = renderer->features & FEATURE_LONG_RAYS
                             ? LONG_RAY_WORDS + (renderer_stack_levels(renderer) + 1) / 2
                             : 0;
    const uint64_t low = renderer->features & FEATURE_MANY_LIGHTS ? 1 : 0;
    const uint64_t carried = renderer->features & FEATURE_MEDIA              ? MEDIA_WORDS
                             : renderer->features & FEATURE_REFLECTION_COLOR ? TINT_WORDS
                                                                             : 0;
    const uint64_t shine = renderer->features & FEATURE_CLEAR_SHADOWS ? SHINE_WORDS : 0;
    const uint64_t cone = renderer->features & FEATURE_FOOTPRINT ? 1 : 0;
    const uint64_t key = renderer->features & FEATURE_POINTS ? KEY_WORDS : 0;
    const uint64_t more = carried + cone + key;
    return (state + low + shine + more + ray + renderer->path_stack * (entry + more)) * WORD_BYTES;
}

static bool has_state(const struct renderer *renderer) {
    return renderer->features & FEATURE_SLICES;
}

// Whether samples are traced at once: if private memory is cheap, and the picture fits into a buffer.
static bool goes_at_once(const struct renderer *renderer) {
    const struct render_settings *settings = &renderer->settings;
    const uint64_t picture = (uint64_t)settings->width * settings->height * PICTURE_PIXEL_BYTES;
    return !renderer_is_adaptive(renderer) && !gpu_fetches_texels(renderer->gpu) &&
           !(renderer->features & FEATURE_LONG_RAYS) && renderer->path_stack <= PRIVATE_BRANCHES &&
           picture <= gpu_info(renderer->gpu)->storage_bytes;
}

static uint32_t least_of(uint64_t a, uint64_t b) {
    return (uint32_t)(a < b ? a : b);
}

// Without shadow rays the lights are scanned in one go, however many there are.
static bool is_long_path(const struct renderer *renderer) {
    return (renderer->settings.features & (FEATURE_REFLECTION | FEATURE_REFRACTION)) ||
           renderer->flat->light_count >= SHORT_PATH_RAYS;
}

// The number of a portion's samples traced at once, and of places for saved paths: usually only a few paths
// are saved.
static void plan_at_once(struct renderer *renderer) {
    const uint64_t slots = (uint64_t)renderer->portion_tiles * TILE_PIXELS;
    const uint64_t fit = slots < PATHS_AT_ONCE ? PATHS_AT_ONCE / slots : 1;
    renderer->samples_at_once = least_of(least_of(fit, renderer->settings.samples), SAMPLES_AT_ONCE);
    const uint64_t paths = slots * renderer->samples_at_once, bytes = slot_state_bytes(renderer);
    const uint64_t most = bytes ? portion_bytes(gpu_info(renderer->gpu)) / bytes : 0;
    // Few paths have an open ray; other slices end if paths are long.
    const bool is_long = is_long_path(renderer);
    renderer->places = has_state(renderer) ? least_of(is_long ? paths : (paths + 7) / 8, most) : 0;
    if (renderer->settings.places && renderer->settings.places < renderer->places)
        renderer->places = renderer->settings.places;
}

static void plan(struct renderer *renderer) {
    const struct render_settings *settings = &renderer->settings;
    renderer->features = settings->features;
    if (is_long_path(renderer))
        renderer->features |= FEATURE_SLICES;
    // Paths with an open ray may continue in another kernel (render_kernel.c).
    if (renderer_pays_apart(renderer))
        renderer->features |= FEATURE_SLICES;
    if (renderer->flat->light_count > MANY_LIGHTS)
        renderer->features |= FEATURE_MANY_LIGHTS;
    if (renderer->has_long_rays)
        renderer->features |= FEATURE_LONG_RAYS;
    if (renderer->features & FEATURE_LONG_RAYS)
        renderer->features |= FEATURE_SLICES;
    renderer->path_stack = renderer_most_waiting(renderer, false);
    renderer->tiles_x = (settings->width + TILE_SIDE - 1) / TILE_SIDE;
    const uint32_t tiles_y = (settings->height + TILE_SIDE - 1) / TILE_SIDE;
    renderer->run_tiles = RUN_TILES;
    while (renderer->tiles_x * tiles_y > renderer->run_tiles * RUNS_MOST)
        renderer->run_tiles *= 2;
    renderer->runs = (renderer->tiles_x * tiles_y + renderer->run_tiles - 1) / renderer->run_tiles;
    const bool at_once = goes_at_once(renderer);
    // Private memory of kernels has a fixed size, whatever the weights are.
    if (!at_once)
        renderer->path_stack = renderer_most_waiting(renderer, true);
    renderer->run_step = gpu_fetches_texels(renderer->gpu) ? run_step_of(renderer->runs) : 1;
    renderer->tiles = renderer->runs * renderer->run_tiles;
    uint64_t slot_bytes = at_once ? 0 : slot_state_bytes(renderer);
    slot_bytes = slot_bytes > PATH_OUTPUT_BYTES ? slot_bytes : PATH_OUTPUT_BYTES;
    const struct gpu_device_info *device = gpu_info(renderer->gpu);
    uint64_t tiles = portion_bytes(device) / (slot_bytes * TILE_PIXELS);
    tiles = device->kind != GPU_CPU || tiles < PORTION_TILES_MAX ? tiles : PORTION_TILES_MAX;
    if (settings->portion_tiles && settings->portion_tiles < tiles)
        tiles = settings->portion_tiles;
    // Portions have equal size: a small last one would keep only few threads busy.
    const uint64_t portions = (renderer->tiles + tiles - 1) / tiles;
    renderer->portion_tiles = (uint32_t)((renderer->tiles + portions - 1) / portions);
    renderer->samples_at_once = 0;
    renderer->places = has_state(renderer) ? renderer->portion_tiles * TILE_PIXELS : 0;
    if (at_once)
        plan_at_once(renderer);
}

// Makes the buffer of a binding and fills it, unless `data` is NULL. false: see gpu_error.
static bool renderer_upload(struct renderer *renderer, uint32_t binding, enum gpu_use use, const void *data,
                            uint64_t bytes) {
    struct gpu_buffer *buffer = gpu_buffer_create(renderer->gpu, use, bytes);
    renderer->buffers[binding] = buffer;
    return buffer && (!data || gpu_write(renderer->gpu, buffer, 0, data, bytes));
}

// Texels of a piece of work.
enum {
    TEXEL_PIECE = 1 << 16
};

struct texels {
    const struct flat_scene *flat;
    size_t first, bytes; // bytes: of a texel
    char *to;
};

static void put_texels(void *context, size_t begin, size_t end) {
    const struct texels *t = context;
    flat_background(t->flat, t->first + begin, t->first + end, t->to + begin * t->bytes);
}

static void put_background(void *context, uint64_t offset, void *to, uint64_t bytes) {
    const struct flat_scene *flat = context;
    const size_t texel = flat->background_texels.is_float ? 4 * sizeof(float) : 4;
    struct texels texels = {flat, (size_t)(offset / texel), texel, to};
    parallel_for((size_t)((offset + bytes) / texel) - texels.first, TEXEL_PIECE, put_texels, &texels);
}

// Texels are made directly where the device reads them: there is no second copy of the picture here.
bool renderer_background(struct renderer *renderer) {
    struct flat_scene flat = *renderer->flat;
    const double start = clock_seconds();
    const bool put = gpu_fill(renderer->gpu, renderer->buffers[BINDING_BACKGROUND], 0,
                              flat.background_texels.bytes, put_background, &flat);
    timeline_add(renderer->settings.timeline, "background", STR(""), start);
    return put;
}

static void put_paints(void *context, uint64_t offset, void *to, uint64_t bytes) {
    const struct flat_scene *flat = context;
    const uint64_t begin = offset / sizeof(struct gpu_word) - flat->paints.count;
    flat_texels(flat, begin, begin + bytes / sizeof(struct gpu_word), to);
}

// There is no second copy of the texels of images on surfaces here either.
bool renderer_upload_array(struct renderer *renderer, const struct renderer_array *array) {
    struct flat_scene flat = *renderer->flat;
    const uint64_t word = sizeof(struct gpu_word), bytes = array->array->count * word;
    const uint64_t more = array->binding == BINDING_PAINTS ? flat.texels.words * word : 0;
    if (more == 0)
        return renderer_upload(renderer, array->binding, GPU_WORDS, array->array->words, bytes);
    return renderer_upload(renderer, BINDING_PAINTS, GPU_WORDS, NULL, bytes + more) &&
           gpu_write(renderer->gpu, renderer->buffers[BINDING_PAINTS], 0, array->array->words, bytes) &&
           gpu_fill(renderer->gpu, renderer->buffers[BINDING_PAINTS], bytes, more, put_paints, &flat);
}

bool renderer_make_background(struct renderer *renderer) {
    const struct flat_scene *flat = renderer->flat;
    const enum gpu_use use = flat->background_texels.is_float ? GPU_TEXELS_F32 : GPU_TEXELS_U8;
    return renderer_upload(renderer, BINDING_BACKGROUND, use, NULL, flat->background_texels.bytes) &&
           (renderer->settings.background_later || renderer_background(renderer));
}

uint32_t renderer_arrays(const struct flat_scene *flat, struct renderer_array out[RENDERER_ARRAYS]) {
    const struct renderer_array arrays[RENDERER_ARRAYS] = {
        {BINDING_TRIANGLE_NODES, &flat->triangle_nodes},
        {BINDING_TRIANGLES, &flat->triangles},
        {BINDING_NORMALS, &flat->normals},
        {BINDING_SPHERE_NODES, &flat->sphere_nodes},
        {BINDING_SPHERES, &flat->spheres},
        {BINDING_BODIES, &flat->bodies},
        {BINDING_MATERIALS, &flat->materials},
        {BINDING_LIGHTS, &flat->lights},
        {BINDING_PAINTS, &flat->paints},
        {BINDING_INSTANCES, &flat->instances},
    };
    memcpy(out, arrays, sizeof arrays);
    return RENDERER_ARRAYS - (flat->instance_count == 0);
}

static bool upload_scene(struct renderer *renderer) {
    struct renderer_array arrays[RENDERER_ARRAYS];
    const uint32_t count = renderer_arrays(renderer->flat, arrays);
    for (uint32_t i = 0; i < count; i++)
        if (!renderer_upload_array(renderer, &arrays[i]))
            return false;
    return renderer_make_background(renderer);
}

static bool make_portion(struct renderer *renderer) {
    const bool at_once = renderer->samples_at_once != 0;
    const uint64_t slots = (uint64_t)renderer->portion_tiles * TILE_PIXELS;
    const uint64_t paths = slots * (at_once ? renderer->samples_at_once : 1);
    const bool third = renderer_is_adaptive(renderer) || (at_once && has_state(renderer));
    const uint64_t lists = 2 * (uint64_t)renderer->places + (third ? paths : 0);
    const uint32_t zero[COUNTER_COUNT] = {0};
    renderer->portion = heap_array(slots, PATH_OUTPUT_BYTES);
    return renderer->portion &&
           renderer_upload(renderer, BINDING_OUTPUT, GPU_STORAGE, NULL, paths * PATH_OUTPUT_BYTES) &&
           renderer_upload(renderer, BINDING_STATE, GPU_STORAGE, NULL,
                           renderer->places * slot_state_bytes(renderer)) &&
           renderer_upload(renderer, BINDING_COUNTERS, GPU_STORAGE, NULL,
                           (COUNTER_COUNT + lists) * sizeof(uint32_t)) &&
           gpu_write(renderer->gpu, renderer->buffers[BINDING_COUNTERS], 0, zero, sizeof zero) &&
           renderer_upload(renderer, BINDING_FRAME, GPU_UNIFORM, NULL, sizeof(struct frame_block)) &&
           renderer_make_at_once(renderer);
}

// What depends on the settings: the portion's buffers and the kernel.
static bool make_frame(struct renderer *renderer) {
    plan(renderer);
    return make_portion(renderer) && renderer_first_program(renderer, false);
}

static void drop_frame(struct renderer *renderer) {
    static const int bindings[] = {BINDING_OUTPUT,  BINDING_STATE,   BINDING_COUNTERS, BINDING_FRAME,
                                   BINDING_SAMPLES, BINDING_PICTURE, BINDING_SUMS,     BINDING_ORDER};
    renderer_drop_at_once(renderer);
    renderer_hits_destroy(renderer);
    renderer_log_destroy(renderer);
    renderer->counting = renderer->program = renderer->begins = NULL;
    renderer->has_drawn = false;
    for (size_t i = 0; i < sizeof bindings / sizeof *bindings; i++) {
        gpu_buffer_destroy(renderer->gpu, renderer->buffers[bindings[i]]);
        renderer->buffers[bindings[i]] = NULL;
    }
    free(renderer->portion);
    renderer->portion = NULL;
    free(renderer->estimate.error);
    free(renderer->estimate.samples);
    renderer->estimate = (struct render_estimate){0};
    renderer->pending[0] = renderer->pending[1] = renderer->taken = renderer->restarts = 0;
}

bool renderer_take_long_rays(struct renderer *renderer) {
    renderer->has_long_rays = true;
    drop_frame(renderer);
    return make_frame(renderer);
}

static void take_settings(struct renderer *renderer, const struct render_settings *settings) {
    renderer->settings = *settings;
    if (settings->workgroup == 0)
        renderer->settings.workgroup = TILE_PIXELS;
}

// Stacks never shrink, so that kernels stay the same if a tree loses a level.
static void take_levels(struct renderer *renderer) {
    const struct flat_scene *flat = renderer->flat;
    if (flat->triangle_depth > renderer->triangle_depth)
        renderer->triangle_depth = flat->triangle_depth;
    if (flat->sphere_depth > renderer->sphere_depth)
        renderer->sphere_depth = flat->sphere_depth;
}

bool renderer_change(struct renderer *renderer, const struct flat_scene *flat,
                     const struct render_settings *settings) {
    if (!CLI_HAS_DEVICES)
        return false;
    const struct render_settings old = renderer->settings, *now = &renderer->settings;
    renderer->flat = flat;
    take_levels(renderer);
    take_settings(renderer, settings);
    if (old.width == now->width && old.height == now->height && old.max_depth == now->max_depth &&
        old.features == now->features && old.alternative == now->alternative &&
        old.workgroup == now->workgroup && old.portion_tiles == now->portion_tiles &&
        (old.error > 0) == (now->error > 0) && renderer_is_part(&old) == renderer_is_part(now) &&
        (old.samples == now->samples || renderer->samples_at_once == 0) &&
        (renderer->samples_at_once || renderer_most_waiting(renderer, true) <= renderer->path_stack))
        return renderer_first_program(renderer, false) != NULL;
    drop_frame(renderer);
    return make_frame(renderer);
}

void renderer_forget_kernels(struct renderer *renderer) {
    drop_frame(renderer);
    for (int i = 0; i < RENDERER_KEPT; i++) {
        gpu_program_destroy(renderer->gpu, renderer->kept[i].program);
        renderer->kept[i] = (struct renderer_kept){0};
    }
    renderer->triangle_depth = renderer->sphere_depth = 0;
    // Matches no settings: the next change makes everything anew.
    renderer->settings.width = 0;
}

// There is time until the background comes.
static bool compile(struct renderer *renderer) {
    const struct dispatch_block nothing = {0};
    struct gpu_program *program = renderer_first_program(renderer, false);
    const double start = clock_seconds();
    const bool compiled = program && gpu_compile(renderer->gpu, program, &nothing);
    timeline_add(renderer->settings.timeline, "compile", STR(""), start);
    return compiled;
}

struct renderer *renderer_create(struct gpu *gpu, const struct flat_scene *flat,
                                 const struct render_settings *settings) {
    if (!CLI_HAS_DEVICES)
        return NULL; // never changed or drawn with: left out of a program linked as a whole
    struct renderer *renderer = heap_zeroed(1, sizeof *renderer);
    if (!renderer)
        return NULL;
    renderer->gpu = gpu;
    renderer->flat = flat;
    take_levels(renderer);
    take_settings(renderer, settings);
    const double start = clock_seconds();
    bool made = upload_scene(renderer);
    timeline_add(settings->timeline, "upload", STR(""), start);
    made = made && make_frame(renderer) && (!settings->background_later || compile(renderer));
    if (made)
        return renderer;
    renderer_destroy(renderer);
    return NULL;
}

void renderer_destroy(struct renderer *renderer) {
    if (!renderer)
        return;
    drop_frame(renderer);
    for (int i = 0; i < RENDERER_KEPT; i++)
        gpu_program_destroy(renderer->gpu, renderer->kept[i].program);
    for (int i = 0; i < GPU_BINDINGS; i++)
        gpu_buffer_destroy(renderer->gpu, renderer->buffers[i]);
    free(renderer);
}

static bool is_of_portion(int binding) {
    return binding == BINDING_OUTPUT || binding == BINDING_STATE || binding == BINDING_COUNTERS ||
           binding == BINDING_PICTURE || binding == BINDING_SUMS || binding == BINDING_ORDER;
}

static uint64_t sum_bytes(const struct renderer *renderer, bool of_portion) {
    uint64_t bytes = 0;
    for (int i = 0; i < GPU_BINDINGS; i++)
        if (renderer->buffers[i] && is_of_portion(i) == of_portion)
            bytes += gpu_buffer_bytes(renderer->buffers[i]);
    return bytes;
}

uint64_t renderer_scene_bytes(const struct renderer *renderer) {
    return sum_bytes(renderer, false);
}
uint64_t renderer_portion_bytes(const struct renderer *renderer) {
    return sum_bytes(renderer, true);
}
