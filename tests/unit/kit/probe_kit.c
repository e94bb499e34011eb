#include "probe_kit.h"

#include "flat_kit.h"
#include "tests/kernels/kernels.h"
#include "tracer/render/render_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    RAY_WORDS = 3, // and in double precision
    RAY64_WORDS = 6,
    HIT_WORDS = 2,
    HIT64_WORDS = 3,
    MOST_WORDS = RAY64_WORDS,
};
#define NO_ITEM 0xffffffffu

static bool fill(struct probe *probe, uint32_t binding, enum gpu_use use, const void *data, uint64_t bytes) {
    struct gpu_buffer *made = gpu_buffer_create(probe->gpu, use, bytes);
    probe->source.buffers[binding] = made;
    return made && (!data || gpu_write(probe->gpu, made, 0, data, bytes));
}

static bool fill_scene(struct probe *probe, const struct flat_scene *flat) {
    const struct flat_array *arrays[] = {[BINDING_TRIANGLE_NODES] = &flat->triangle_nodes,
                                         [BINDING_TRIANGLES] = &flat->triangles,
                                         [BINDING_NORMALS] = &flat->normals,
                                         [BINDING_SPHERE_NODES] = &flat->sphere_nodes,
                                         [BINDING_SPHERES] = &flat->spheres,
                                         [BINDING_BODIES] = &flat->bodies,
                                         [BINDING_MATERIALS] = &flat->materials,
                                         [BINDING_PAINTS] = &flat->paints};
    bool good = true;
    for (uint32_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        good = !arrays[i] ? good
                          : good && fill(probe, i, GPU_WORDS, arrays[i]->words,
                                         arrays[i]->count * sizeof(struct gpu_word));
    return good;
}

// As the renderer has it.
static uint32_t levels(uint32_t depth) {
    return depth > 3 ? depth - 2 : 1;
}

// Some numbers have no item: of triangles that flattening leaves out.
static uint32_t *list_items(const struct flat_scene *flat) {
    uint32_t most = 0;
    for (uint32_t i = 0; i < flat->triangle_count; i++)
        most = kit_number(flat, i) > most ? kit_number(flat, i) : most;
    uint32_t *items = calloc((size_t)most + 1, sizeof *items);
    for (uint32_t i = 0; items && i < flat->triangle_count; i++)
        items[kit_number(flat, i)] = i;
    return items;
}

bool probe_init(struct probe *probe, struct gpu *gpu, const struct flat_scene *flat, bool packed) {
    return probe_init_way(probe, gpu, flat, packed, PROBE_EXACT);
}

bool probe_init_way(struct probe *probe, struct gpu *gpu, const struct flat_scene *flat, bool packed,
                    enum probe_way way) {
    const struct frame_block frame = {.sphere_count = flat->sphere_count};
    const uint32_t constants[CONSTANT_COUNT] = {
        [CONSTANT_FEATURES] =
            (uint32_t)(flat->features & (FEATURE_TRIANGLES | FEATURE_SPHERES | FEATURE_SMOOTH)),
        [CONSTANT_MORE_FEATURES] = (uint32_t)((flat->features & FEATURE_CONES) >> 32),
        [CONSTANT_TRIANGLE_STACK] = levels(flat->triangle_depth),
        [CONSTANT_SPHERE_STACK] = levels(flat->sphere_depth),
        [CONSTANT_PACKED_GROUPS] = packed,
        [CONSTANT_ALTERNATIVE_START] = way == PROBE_POSITIVE};
    const struct kernel *const kernels[2][2] = {{&kernel_probe_storage, &kernel_probe_texels},
                                                {&kernel_probe64_storage, &kernel_probe64_texels}};
    const struct kernel *const other[][2] = {
        [PROBE_BOUND] = {&kernel_probe_alternative_storage, &kernel_probe_alternative_texels},
        [PROBE_POSITIVE] = {&kernel_probe_alternative_storage, &kernel_probe_alternative_texels},
        [PROBE_WHOLE] = {&kernel_probe64_whole_storage, &kernel_probe64_whole_texels},
        [PROBE_BOLD] = {&kernel_probe64_bold_storage, &kernel_probe64_bold_texels}};
    const bool texels = gpu_fetches_texels(gpu);
    *probe =
        (struct probe){.gpu = gpu, .flat = flat, .is_double = flat->is_double, .items = list_items(flat)};
    probe->source = (struct gpu_program_source){
        .kernel = way == PROBE_EXACT ? kernels[flat->is_double][texels] : other[way][texels],
        .constants = constants,
        .constant_count = CONSTANT_COUNT,
        .push_bytes = sizeof(struct dispatch_block)};
    const uint64_t bytes = (uint64_t)PROBE_RAYS * MOST_WORDS * sizeof(struct gpu_word);
    bool good = fill_scene(probe, flat) && fill(probe, BINDING_FRAME, GPU_UNIFORM, &frame, sizeof frame) &&
                fill(probe, BINDING_STATE, GPU_STORAGE, NULL, bytes) &&
                fill(probe, BINDING_OUTPUT, GPU_STORAGE, NULL, bytes);
    probe->program = good ? gpu_program_create(gpu, &probe->source) : NULL;
    probe->source.constants = NULL;
    probe->words = malloc(bytes);
    return probe->program && probe->words && probe->items;
}

void probe_finish(struct probe *probe) {
    gpu_program_destroy(probe->gpu, probe->program);
    for (int i = 0; i < GPU_BINDINGS; i++)
        gpu_buffer_destroy(probe->gpu, probe->source.buffers[i]);
    free(probe->words);
    free(probe->items);
}

vec3 probe_round(const struct probe *probe, vec3 v) {
    return probe->is_double ? v : (vec3){(float)v.x, (float)v.y, (float)v.z};
}

vec3 probe_place(const struct probe *probe, vec3 scene) {
    const double factor = ldexp(1, probe->flat->scale_exponent);
    return probe_round(probe, vec3_mul(vec3_sub(scene, probe->flat->origin), factor));
}

vec3 probe_normal(const struct probe *probe, uint32_t number) {
    const uint32_t item = probe->items[number];
    const vec3 a = kit_vertex(probe->flat, item, 0), b = kit_vertex(probe->flat, item, 1),
               c = kit_vertex(probe->flat, item, 2);
    return vec3_unit(vec3_cross(vec3_sub(b, a), vec3_sub(c, a)));
}

static void put(const struct probe *probe, struct gpu_word *words, vec3 v, double w) {
    const double values[4] = {v.x, v.y, v.z, w};
    const float rounded[4] = {(float)v.x, (float)v.y, (float)v.z, (float)w};
    if (probe->is_double)
        memcpy(words, values, sizeof values);
    else
        memcpy(words, rounded, sizeof rounded);
}

static double number_of(uint32_t low, uint32_t high, bool is_double) {
    const uint64_t bits = (uint64_t)high << 32 | low;
    double value;
    float single;
    memcpy(&value, &bits, sizeof value);
    memcpy(&single, &low, sizeof single);
    return is_double ? value : (double)single;
}

static struct probe_hit read_hit(const struct probe *probe, const struct gpu_word *words) {
    const struct gpu_word a = words[0], b = words[1];
    if (probe->is_double) {
        struct probe_hit hit = {.first = {a.w != NO_ITEM, number_of(a.x, a.y, true), a.z}, .any = words[2].x};
        if (hit.first.found) {
            hit.second = (struct probe_met){b.w != NO_ITEM, number_of(b.x, b.y, true), b.z};
            hit.same_side = words[2].y & 1;
            hit.blocked = words[2].y & 2;
        }
        return hit;
    }
    struct probe_hit hit = {.first = {a.z != NO_ITEM, number_of(a.x, 0, false), a.y}, .any = a.w};
    if (hit.first.found) {
        hit.second = (struct probe_met){b.z != NO_ITEM, number_of(b.x, 0, false), b.y};
        hit.same_side = b.w & 1;
        hit.blocked = b.w & 2;
    }
    return hit;
}

bool probe_trace(struct probe *probe, const struct probe_ray *rays, uint32_t count, struct probe_hit *hits) {
    const struct dispatch_block block = {.tile_count = count};
    const uint32_t ray_words = probe->is_double ? RAY64_WORDS : RAY_WORDS, part = ray_words / 3;
    const uint32_t hit_words = probe->is_double ? HIT64_WORDS : HIT_WORDS;
    struct gpu_buffer **buffers = probe->source.buffers;
    for (uint32_t i = 0; i < count; i++) {
        struct gpu_word *words = probe->words + (size_t)i * ray_words;
        put(probe, words, rays[i].origin, rays[i].end);
        put(probe, words + part, rays[i].direction, 0);
        put(probe, words + 2 * (size_t)part, rays[i].next, 0);
    }
    const uint64_t sent = (uint64_t)count * ray_words * sizeof(struct gpu_word);
    const uint64_t taken = (uint64_t)count * hit_words * sizeof(struct gpu_word);
    if (!gpu_write(probe->gpu, buffers[BINDING_STATE], 0, probe->words, sent) ||
        !gpu_dispatch(probe->gpu, probe->program, (count + TILE_PIXELS - 1) / TILE_PIXELS, 1, &block) ||
        !gpu_submit(probe->gpu) || !gpu_wait(probe->gpu, NULL) ||
        !gpu_read(probe->gpu, buffers[BINDING_OUTPUT], 0, probe->words, taken))
        return false;
    for (uint32_t i = 0; i < count; i++)
        hits[i] = read_hit(probe, probe->words + (size_t)i * hit_words);
    return true;
}

int probe_setup(void **state) {
    struct probe_fixture *f = calloc(1, sizeof *f);
    device_kit_open(&f->device);
    f->rays = calloc(PROBE_RAYS, sizeof *f->rays);
    f->hits = calloc(PROBE_RAYS, sizeof *f->hits);
    *state = f;
    return 0;
}

int probe_teardown(void **state) {
    struct probe_fixture *f = *state;
    printf("%llu rays were sent, and as many from what they hit\n", (unsigned long long)f->sent);
    free(f->rays);
    free(f->hits);
    return device_kit_teardown(state);
}

struct probe_fixture *probe_need(void **state, bool is_double) {
    device_kit_need(state, is_double);
    return *state;
}
