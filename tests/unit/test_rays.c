// Rays on the device, through the kernel's own tree, tests and starts: none slips through a closed mesh, none
// hits the surface that it leaves, none leaks out of a body.
//
// Rays are aimed at edges and vertices of icospheres, and at spheres. A second ray leaves each hit: outward
// from a convex body it must meet nothing, inward it must meet the body again, elsewhere.
#include "flat_kit.h"
#include "runtime/gpu/gpu.h"
#include "runtime/render_private.h"
#include "shaders/kernels.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    RAYS = 1 << 18,
    RAY_WORDS = 3,
    HIT_WORDS = 2,
    BATCHES = 4, // a million rays a place
};
#define NO_ITEM 0xffffffffu

struct fixture {
    struct gpu *gpu;
    uint32_t messages;
};

static int setup(void **state) {
    struct fixture *f = calloc(1, sizeof *f);
    char error[GPU_ERROR_BYTES];
    const struct gpu_options options = {
        .device = getenv("GLINT_DEVICE"), .validate = true, .validation_messages = &f->messages};
    if (gpu_create(&options, &f->gpu, error) != GPU_OK)
        fprintf(stderr, "skipped: %s\n", error);
    *state = f;
    return 0;
}

static int teardown(void **state) {
    struct fixture *f = *state;
    gpu_destroy(f->gpu);
    const uint32_t messages = f->messages;
    free(f);
    return messages ? -1 : 0;
}

// ---- the device's side

struct probe {
    struct gpu *gpu;
    struct gpu_program_source source;
    struct gpu_program *program;
    struct gpu_word *rays, *hits;
};

static struct gpu_buffer *buffer(struct gpu *gpu, enum gpu_use use, const void *data, uint64_t bytes) {
    struct gpu_buffer *made = gpu_buffer_create(gpu, use, bytes);
    assert_non_null(made);
    assert_true(!data || gpu_write(gpu, made, 0, data, bytes));
    return made;
}

// As the renderer has it.
static uint32_t levels(uint32_t depth) {
    return depth > 3 ? depth - 2 : 1;
}

static void probe_init(struct probe *probe, struct gpu *gpu, const struct flat_scene *flat, uint32_t packed) {
    const struct flat_array *arrays[] = {[BINDING_TRIANGLE_NODES] = &flat->triangle_nodes,
                                         [BINDING_TRIANGLES] = &flat->triangles,
                                         [BINDING_NORMALS] = &flat->normals,
                                         [BINDING_SPHERE_NODES] = &flat->sphere_nodes,
                                         [BINDING_SPHERES] = &flat->spheres,
                                         [BINDING_BODIES] = &flat->bodies,
                                         [BINDING_MATERIALS] = &flat->materials};
    const struct frame_block frame = {.sphere_count = flat->sphere_count};
    const uint32_t constants[CONSTANT_COUNT] = {
        flat->features & (FEATURE_TRIANGLES | FEATURE_SPHERES | FEATURE_SMOOTH), levels(flat->triangle_depth),
        levels(flat->sphere_depth), packed};
    const bool texels = gpu_fetches_texels(gpu);
    *probe = (struct probe){.gpu = gpu};
    probe->source = (struct gpu_program_source){.spirv = texels ? kernel_probe_texels : kernel_probe_storage,
                                                .spirv_words = texels ? kernel_probe_texels_words
                                                                      : kernel_probe_storage_words,
                                                .constants = constants,
                                                .constant_count = CONSTANT_COUNT,
                                                .push_bytes = sizeof(struct dispatch_block)};
    struct gpu_buffer **buffers = probe->source.buffers;
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        buffers[i] = buffer(gpu, GPU_WORDS, arrays[i]->words, arrays[i]->count * sizeof(struct gpu_word));
    buffers[BINDING_FRAME] = buffer(gpu, GPU_UNIFORM, &frame, sizeof frame);
    buffers[BINDING_STATE] = buffer(gpu, GPU_STORAGE, NULL, RAYS * RAY_WORDS * sizeof(struct gpu_word));
    buffers[BINDING_OUTPUT] = buffer(gpu, GPU_STORAGE, NULL, RAYS * HIT_WORDS * sizeof(struct gpu_word));
    probe->program = gpu_program_create(gpu, &probe->source);
    assert_non_null(probe->program);
    probe->rays = calloc(RAYS * RAY_WORDS, sizeof *probe->rays);
    probe->hits = calloc(RAYS * HIT_WORDS, sizeof *probe->hits);
}

static void probe_run(struct probe *probe) {
    const struct dispatch_block block = {.tile_count = RAYS};
    struct gpu_buffer **buffers = probe->source.buffers;
    assert_true(gpu_write(probe->gpu, buffers[BINDING_STATE], 0, probe->rays,
                          RAYS * RAY_WORDS * sizeof *probe->rays));
    assert_true(gpu_dispatch(probe->gpu, probe->program, RAYS / TILE_PIXELS, 1, &block));
    assert_true(gpu_submit(probe->gpu));
    assert_true(gpu_wait(probe->gpu, NULL));
    assert_true(gpu_read(probe->gpu, buffers[BINDING_OUTPUT], 0, probe->hits,
                         RAYS * HIT_WORDS * sizeof *probe->hits));
}

static void probe_finish(struct probe *probe) {
    gpu_program_destroy(probe->gpu, probe->program);
    for (int i = 0; i < GPU_BINDINGS; i++)
        gpu_buffer_destroy(probe->gpu, probe->source.buffers[i]);
    free(probe->rays);
    free(probe->hits);
}

// ---- rays

static uint64_t mix(uint64_t *state) { // SplitMix64
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}
static double mix_unit(uint64_t *state) {
    return (double)(mix(state) >> 11) * 0x1p-53;
}

static vec3 random_direction(uint64_t *state) {
    const double z = 2 * mix_unit(state) - 1, angle = 6.283185307179586 * mix_unit(state),
                 r = sqrt(1 - z * z);
    return (vec3){r * cos(angle), r * sin(angle), z};
}

struct aim {
    const struct flat_scene *flat;
    vec3 center; // flat
    double radius;
};

static vec3 choose_target(const struct aim *aim, uint64_t *state) {
    if (aim->flat->sphere_count)
        return vec3_add(aim->center, vec3_mul(random_direction(state), aim->radius * (1 - 1e-6)));
    const uint32_t item = (uint32_t)(mix(state) % aim->flat->triangle_count);
    const int corner = (int)(mix(state) % 3);
    const vec3 a = kit_vertex(aim->flat, item, corner), b = kit_vertex(aim->flat, item, (corner + 1) % 3);
    return mix(state) % 2 ? a : vec3_add(a, vec3_mul(vec3_sub(b, a), mix_unit(state)));
}

static struct gpu_word word_of(vec3 v, float w) {
    const float values[4] = {(float)v.x, (float)v.y, (float)v.z, w};
    struct gpu_word word;
    memcpy(&word, values, sizeof word);
    return word;
}

static vec3 vec3_of(const struct gpu_word *word) {
    return (vec3){kit_float(word->x), kit_float(word->y), kit_float(word->z)};
}

// A ray at an edge, vertex or sphere, from inside or outside, and one that leaves its target: at least 0.6
// degrees from the surface, since a mesh of rounded vertices is not quite convex.
static void choose_ray(const struct aim *aim, uint64_t seed, struct gpu_word *ray) {
    uint64_t state = seed;
    for (;;) {
        const vec3 target = choose_target(aim, &state);
        const vec3 out = vec3_unit(vec3_sub(target, aim->center));
        const bool inside = mix(&state) % 2;
        const double away = aim->radius * (inside ? 0.9 * mix_unit(&state) : 1.2 + 8 * mix_unit(&state));
        const struct gpu_word start =
            word_of(vec3_add(aim->center, vec3_mul(random_direction(&state), away)), 3e38f);
        const vec3 to = vec3_sub(target, vec3_of(&start)), next = random_direction(&state);
        if ((!inside && vec3_dot(out, vec3_unit(to)) > -0.2) || fabs(vec3_dot(out, next)) < 0.1)
            continue;
        ray[0] = start;
        ray[1] = word_of(aim->flat->sphere_count ? vec3_unit(to) : to, 0);
        ray[2] = word_of(next, 0);
        return;
    }
}

struct misses {
    unsigned closest, any, self, leaks;
};

static void judge(const struct aim *aim, const struct gpu_word *ray, const struct gpu_word *hit,
                  struct misses *misses) {
    const vec3 origin = vec3_of(&ray[0]), direction = vec3_of(&ray[1]), next = vec3_of(&ray[2]);
    misses->any += hit[0].w != 1;
    if (hit[0].z == NO_ITEM) {
        misses->closest++;
        return;
    }
    const vec3 at = vec3_add(origin, vec3_mul(direction, kit_float(hit[0].x)));
    const vec3 out = vec3_sub(at, aim->center);
    misses->closest += fabs(vec3_length(out) / aim->radius - 1) > 0.2;
    const bool leaves = vec3_dot(vec3_unit(out), next) > 0, found = hit[1].z != NO_ITEM;
    misses->self += leaves ? found : found && !aim->flat->sphere_count && hit[1].y == hit[0].y;
    // A chord at 0.1 from the tangent is 0.2 radii long.
    misses->leaks += !leaves && !(found && kit_float(hit[1].x) > 0.05 * aim->radius);
}

static void check(void **state, const struct flat_scene *flat, vec3 center, double radius) {
    struct probe probe;
    const struct aim aim = {flat, center, radius};
    struct misses misses = {0, 0, 0, 0};
    for (uint64_t batch = 0; batch < BATCHES; batch++) {
        // Both ways to keep groups of nodes; this tree is small enough for the short one.
        probe_init(&probe, ((struct fixture *)*state)->gpu, flat, batch % 2);
        for (uint64_t i = 0; i < RAYS; i++)
            choose_ray(&aim, batch * RAYS + i, probe.rays + RAY_WORDS * i);
        probe_run(&probe);
        for (size_t i = 0; i < RAYS; i++)
            judge(&aim, probe.rays + RAY_WORDS * i, probe.hits + HIT_WORDS * i, &misses);
        probe_finish(&probe);
    }
    if (misses.closest || misses.any || misses.self || misses.leaks)
        fail_msg("of %d rays at radius %g, center %g %g %g: %u without their hit, %u without any, %u hit "
                 "what they left, "
                 "%u leaked",
                 BATCHES * RAYS, radius, center.x, center.y, center.z, misses.closest, misses.any,
                 misses.self, misses.leaks);
}

static void needs_device(void **state) {
    if (!((struct fixture *)*state)->gpu)
        skip();
}

static void check_mesh(void **state, vec3 offset, double radius, vec3 origin) {
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit.origin = origin;
    struct ir_model *model = kit_model(&kit, kit_icosphere(&kit, 3, 0));
    model->scale = (vec3){radius, radius, radius};
    model->rotation = (vec3){10, 20, 30};
    model->translation = offset;
    assert_true(kit_flatten(&kit, &flat));
    const double factor = ldexp(1, flat.scale_exponent);
    check(state, &flat, vec3_mul(vec3_sub(offset, origin), factor), radius * factor);
    flat_finish(&flat);
    kit_finish(&kit);
}

static void check_sphere(void **state, vec3 offset, double radius) {
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    struct ir_sphere *sphere = kit_sphere(&kit);
    sphere->center = offset;
    sphere->radius = radius;
    assert_true(kit_flatten(&kit, &flat));
    const double factor = ldexp(1, flat.scale_exponent);
    check(state, &flat, vec3_mul(offset, factor), radius * factor);
    flat_finish(&flat);
    kit_finish(&kit);
}

static void test_mesh(void **state) {
    needs_device(state);
    check_mesh(state, (vec3){0, 0, 0}, 1, (vec3){3, 1, 0});
}

static void test_mesh_small_and_far(void **state) {
    needs_device(state);
    check_mesh(state, (vec3){1e3, 750, -1e3}, 1e-3, (vec3){1e3, 750, -1e3 + 5e-3});
    check_mesh(state, (vec3){1e5, 7.5e4, -1e5}, 2, (vec3){1e5 + 6, 7.5e4 + 2, -1e5});
    check_mesh(state, (vec3){0, 0, 0}, 1, (vec3){0, 0, 100});
}

static void test_sphere(void **state) {
    needs_device(state);
    check_sphere(state, (vec3){0, 0, -3}, 1);
    check_sphere(state, (vec3){60, 50, -70}, 1);
    check_sphere(state, (vec3){0.1, 0.2, 0.3}, 1e3);
}

// Two plates with a gap of 2e-5 of their size between them: what leaves the first one towards the second
// arrives there.
static void check_gap(void **state, vec3 corner, double size) {
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    const vec3 u = {size, 0.3 * size, 0.2 * size}, v = {-0.1 * size, 0.9 * size, -0.4 * size};
    const vec3 normal = vec3_unit(vec3_cross(u, v));
    for (int plate = 0; plate < 2; plate++) {
        struct ir_rectangle *r = kit_rectangle(&kit);
        r->corner = vec3_sub(corner, vec3_mul(normal, plate * 2e-5 * size));
        r->edge_u = u;
        r->edge_v = v;
    }
    assert_true(kit_flatten(&kit, &flat));
    const double factor = ldexp(1, flat.scale_exponent);
    struct probe probe;
    unsigned lost = 0;
    probe_init(&probe, ((struct fixture *)*state)->gpu, &flat, 1);
    for (size_t i = 0; i < RAYS; i++) {
        uint64_t seed = i;
        struct gpu_word *ray = probe.rays + RAY_WORDS * i;
        vec3 target =
            vec3_add(vec3_mul(u, 0.1 + 0.8 * mix_unit(&seed)), vec3_mul(v, 0.1 + 0.8 * mix_unit(&seed)));
        vec3 from, next;
        do
            from = random_direction(&seed);
        while (vec3_dot(from, normal) < 0.1);
        do
            next = random_direction(&seed);
        while (vec3_dot(next, normal) > -0.1);
        target = vec3_mul(vec3_add(corner, target), factor);
        ray[0] = word_of(vec3_add(target, vec3_mul(from, size * factor * 2)), 3e38f);
        ray[1] = word_of(vec3_neg(from), 0);
        ray[2] = word_of(next, 0);
    }
    probe_run(&probe);
    for (size_t i = 0; i < RAYS; i++) {
        const struct gpu_word *hit = probe.hits + HIT_WORDS * i;
        lost += !(hit[0].z != NO_ITEM && hit[0].y < 2 && hit[1].z != NO_ITEM && hit[1].y >= 2);
    }
    probe_finish(&probe);
    flat_finish(&flat);
    kit_finish(&kit);
    if (lost)
        fail_msg("size %g: %u of %d rays were lost in the gap", size, lost, RAYS);
}

static void test_gap(void **state) {
    needs_device(state);
    check_gap(state, (vec3){1, 1, -3}, 1);
    check_gap(state, (vec3){1e-3, 2e-3, -3e-3}, 1e-3);
    check_gap(state, (vec3){-2e3, 1e3, -3e3}, 1e3);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mesh),
        cmocka_unit_test(test_mesh_small_and_far),
        cmocka_unit_test(test_sphere),
        cmocka_unit_test(test_gap),
    };
    return cmocka_run_group_tests_name("rays", tests, setup, teardown);
}
