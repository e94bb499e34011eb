#include "bench/original/original.h"

#include "bench/original/boxes.h"
#include "bench/original/layout.h"
#include "shaders/kernel.h"
#include "tracer/render/render_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

extern const struct kernel kernel_original_storage, kernel_original_texels;

enum {
    GRID_WIDTH = 1024, // workgroups in x; the rest go to y
};

static const double EPSILON_SCENE = 1e-3; // tinyraytracer's

struct original {
    struct renderer *renderer; // not owned
    enum original_fetch fetch;
    uint32_t box_count, rectangle_count, triangle_count;
    bool owns[GPU_BINDINGS];
    struct gpu_buffer *buffers[GPU_BINDINGS];
    struct gpu_program *program;
    struct gpu_word *slots; // read back
    uint32_t tiles;
};

static bool own(struct original *o, uint32_t binding, enum gpu_use use, const void *data, uint64_t bytes) {
    struct gpu *gpu = o->renderer->gpu;
    o->owns[binding] = true;
    o->buffers[binding] = gpu_buffer_create(gpu, use, bytes);
    return o->buffers[binding] && (!data || gpu_write(gpu, o->buffers[binding], 0, data, bytes));
}

static bool make_buffers(struct original *o, const struct original_boxes *boxes) {
    const struct flat_scene *flat = o->renderer->flat;
    const struct {
        uint32_t binding;
        const struct flat_array *array;
    } arrays[] = {
        {BINDING_TRIANGLES, &boxes->triangles},   {BINDING_BOXES, &boxes->boxes},
        {BINDING_RECTANGLES, &boxes->rectangles}, {BINDING_NORMALS, &flat->normals},
        {BINDING_BODIES, &flat->bodies},          {BINDING_MATERIALS, &flat->materials},
        {BINDING_LIGHTS, &flat->lights},
    };
    const enum gpu_use use = o->fetch == ORIGINAL_TEXELS ? GPU_WORDS : GPU_STORAGE;
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        if (!own(o, arrays[i].binding, use, arrays[i].array->words,
                 arrays[i].array->count * sizeof(struct gpu_word)))
            return false;
    o->buffers[BINDING_BACKGROUND] = o->renderer->buffers[BINDING_BACKGROUND];
    o->buffers[BINDING_FRAME] = o->renderer->buffers[BINDING_FRAME];
    return own(o, BINDING_OUTPUT, GPU_STORAGE, NULL, (uint64_t)o->tiles * TILE_PIXELS * sizeof *o->slots);
}

static bool compile(struct original *o) {
    const float epsilon = (float)ldexp(EPSILON_SCENE, o->renderer->flat->scale_exponent);
    const bool texels = o->fetch == ORIGINAL_TEXELS;
    uint32_t constants[ORIGINAL_CONSTANTS] = {
        [CONSTANT_FEATURES] = (uint32_t)o->renderer->flat->features,
        [CONSTANT_TRIANGLE_STACK] = 1,
        [CONSTANT_SPHERE_STACK] = 1,
        [CONSTANT_BOXES] = o->box_count,
        [CONSTANT_RECTANGLES] = o->rectangle_count,
        [CONSTANT_DEPTH] = ORIGINAL_DEPTH,
    };
    memcpy(&constants[CONSTANT_EPSILON], &epsilon, sizeof epsilon);
    struct gpu_program_source source = {
        .kernel = texels ? &kernel_original_texels : &kernel_original_storage,
        .constants = constants,
        .constant_count = ORIGINAL_CONSTANTS,
        .push_bytes = sizeof(struct dispatch_block),
    };
    memcpy(source.buffers, o->buffers, sizeof source.buffers);
    o->program = gpu_program_create(o->renderer->gpu, &source);
    return o->program;
}

// lavapipe compiles at the first dispatch: one without pixels leaves that out of the first frame.
static bool warm(struct original *o) {
    const struct dispatch_block none = {.grid_width = 1};
    struct gpu *gpu = o->renderer->gpu;
    return gpu_dispatch(gpu, o->program, 1, 1, &none) && gpu_submit(gpu) && gpu_wait(gpu, NULL);
}

static bool prepare(struct original *o) {
    struct original_boxes boxes;
    bool done = original_boxes_make(o->renderer->flat, &boxes);
    o->box_count = boxes.box_count;
    o->rectangle_count = boxes.rectangle_count;
    o->triangle_count = boxes.triangle_count;
    o->slots = malloc((size_t)o->tiles * TILE_PIXELS * sizeof *o->slots);
    done = done && o->slots && make_buffers(o, &boxes) && compile(o) && warm(o);
    original_boxes_finish(&boxes);
    return done;
}

struct original *original_create(struct renderer *renderer, enum original_fetch fetch,
                                 char error[GPU_ERROR_BYTES]) {
    const char *lack = original_lacks(renderer->flat);
    if (lack) {
        snprintf(error, GPU_ERROR_BYTES, "the original's method knows no %s", lack);
        return NULL;
    }
    if (fetch == ORIGINAL_TEXELS && !gpu_fetches_texels(renderer->gpu)) {
        snprintf(error, GPU_ERROR_BYTES, "texels are for CPU devices; this is %s",
                 gpu_info(renderer->gpu)->name);
        return NULL;
    }
    struct original *o = calloc(1, sizeof *o);
    if (o) {
        o->renderer = renderer;
        o->fetch = fetch;
        o->tiles = renderer->tiles;
        if (prepare(o))
            return o;
        original_destroy(o);
    }
    const char *text = gpu_error(renderer->gpu);
    snprintf(error, GPU_ERROR_BYTES, "%s", *text ? text : "not enough memory");
    return NULL;
}

void original_destroy(struct original *o) {
    if (!o)
        return;
    gpu_program_destroy(o->renderer->gpu, o->program);
    for (int i = 0; i < GPU_BINDINGS; i++)
        if (o->owns[i])
            gpu_buffer_destroy(o->renderer->gpu, o->buffers[i]);
    free(o->slots);
    free(o);
}

static void unpack(const struct original *o, float *rgb, uint32_t *cut) {
    const uint32_t width = o->renderer->settings.width;
    *cut = 0;
    for (uint32_t slot = 0; slot < o->tiles * TILE_PIXELS; slot++) {
        uint32_t x, y;
        if (!renderer_pixel(o->renderer, 0, slot, &x, &y))
            continue;
        memcpy(rgb + ((size_t)y * width + x) * 3, &o->slots[slot], 3 * sizeof *rgb);
        *cut += o->slots[slot].w != PIXEL_WHOLE;
    }
}

bool original_render(struct original *o, float *rgb, double *device_seconds, uint32_t *cut) {
    struct gpu *gpu = o->renderer->gpu;
    struct dispatch_block block = {.tile_count = o->tiles, .offset_x = 0.5F, .offset_y = 0.5F};
    block.grid_width = o->tiles < GRID_WIDTH ? o->tiles : GRID_WIDTH;
    const uint32_t height = (o->tiles + block.grid_width - 1) / block.grid_width;
    if (!gpu_dispatch(gpu, o->program, block.grid_width, height, &block) || !gpu_submit(gpu) ||
        !gpu_wait(gpu, device_seconds) ||
        !gpu_read(gpu, o->buffers[BINDING_OUTPUT], 0, o->slots,
                  (uint64_t)o->tiles * TILE_PIXELS * sizeof *o->slots))
        return false;
    unpack(o, rgb, cut);
    return true;
}

uint32_t original_box_count(const struct original *original) {
    return original->box_count;
}
uint32_t original_triangle_count(const struct original *original) {
    return original->triangle_count;
}
