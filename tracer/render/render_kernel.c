// Which compiled kernel a renderer's settings want, and its specialization constants.
#include "core/float_bits.h"
#include "tracer/render/render_private.h"

#include "core/clock.h"
#include "core/timeline.h"
#include "shaders/kernels.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum {
    PATHS_APART = 8 << 20, // from this many paths on, a second kernel saves more time than compiling it takes
    PATHS_FOLLOWED = 3 << 19, // and on a GPU more than the further dispatch takes, for the paths that go on
};

struct kernel_pair {
    const struct kernel *texels, *storage; // by what the device fetches
};
#define KERNEL(name)                                                                                         \
    { &kernel_##name##_texels, &kernel_##name##_storage }

// The kernels of one method: their names end with its name.
#define KERNELS(way)                                                                                         \
    {                                                                                                        \
        [RENDERER_TRACE] = KERNEL(trace##way), [RENDERER_HITS] = KERNEL(hits##way),                          \
        [RENDERER_LOG] = KERNEL(log##way), [RENDERER_RESOLVE] = {                                            \
            NULL,                                                                                            \
            &kernel_resolve_storage                                                                          \
        }                                                                                                    \
    }
static const struct kernel_pair exact_kernels[RENDERER_KERNELS] = KERNELS();
static const struct kernel_pair pairs_kernels[RENDERER_KERNELS] = KERNELS(_pairs);
static const struct kernel_pair double_kernels[RENDERER_KERNELS] = KERNELS(64);
static const struct kernel_pair instance_kernels[RENDERER_KERNELS] = KERNELS(_instances);
static const struct kernel_pair double_instance_kernels[RENDERER_KERNELS] = KERNELS(64_instances);
static const struct kernel_pair alternative_kernels[RENDERER_KERNELS] = KERNELS(_alternative);
static const struct kernel_pair fused_kernels[RENDERER_KERNELS] = KERNELS(_fused);

static const struct alternative {
    const char *name;
    double offset, distance, cut; // scene units; as a fraction of the ray's length; squared scene units
} alternatives[RENDER_ALTERNATIVES] = {
    [RENDER_ALTERNATIVE_NONE] = {"none", 0, 0, 0},
    [RENDER_ALTERNATIVE_OFFSET_3] = {"offset 1e-3", 1e-3, 0, 0},
    [RENDER_ALTERNATIVE_OFFSET_4] = {"offset 1e-4", 1e-4, 0, 0},
    [RENDER_ALTERNATIVE_OFFSET_7] = {"offset 1e-7", 1e-7, 0, 0},
    [RENDER_ALTERNATIVE_OFFSET_DISTANCE] = {"offset by distance", 1e-4, 1e-4, 0},
    [RENDER_ALTERNATIVE_MOELLER] = {"moeller-trumbore", 0, 0, 1e-7},
    [RENDER_ALTERNATIVE_ORIGINAL] = {"moeller-trumbore, offset 1e-3", 1e-3, 0, 1e-7},
    [RENDER_ALTERNATIVE_FUSED] = {"fused", 0, 0, 0},
};

const char *render_alternative_name(enum render_alternative alternative) {
    return alternative < RENDER_ALTERNATIVES ? alternatives[alternative].name : "unknown";
}

static const struct kernel_pair *pair_of(const struct renderer *renderer, enum renderer_kernel kernel) {
    const struct flat_scene *flat = renderer->flat;
    if (flat->instance_count)
        return flat->is_double ? &double_instance_kernels[kernel] : &instance_kernels[kernel];
    if (flat->is_double)
        return &double_kernels[kernel];
    switch (renderer->settings.alternative) {
    case RENDER_ALTERNATIVE_NONE:
        return gpu_info(renderer->gpu)->has_double ? &exact_kernels[kernel] : &pairs_kernels[kernel];
    case RENDER_ALTERNATIVE_FUSED:
        return &fused_kernels[kernel];
    default:
        return &alternative_kernels[kernel];
    }
}

// The most groups of nodes that wait at the same time, at least 1. A group holds the siblings of a node whose
// children are visited first, so there is at most one per level: none of the root, which has no siblings, and
// none of the last level, whose nodes have no inner children.
static uint32_t stack_levels(uint32_t depth) {
    return depth > 3 ? depth - 2 : 1;
}

uint32_t renderer_stack_levels(const struct renderer *renderer) {
    const uint32_t a = stack_levels(renderer->triangle_depth);
    const uint32_t b = stack_levels(renderer->sphere_depth);
    return a > b ? a : b;
}

static uint32_t bits_of(double value) {
    return float_bits(value > 0 ? fmaxf((float)value, FLT_MIN) : 0);
}

double renderer_real(const struct renderer *renderer, uint32_t low, uint32_t high) {
    if (!renderer->flat->is_double)
        return (double)float_of_bits(low);
    return double_of_bits((uint64_t)high << 32 | low);
}

// How many waiting refracted rays a kernel has room for in private memory; 0: they are in the state buffer.
static uint32_t private_branches(const struct renderer *renderer) {
    if (renderer->samples_at_once == 0)
        return 0;
    return renderer->path_stack ? renderer->path_stack : 1;
}

static bool is_for(const struct renderer_kept *kept, const struct renderer *renderer, uint64_t features) {
    return kept->program && kept->features == features &&
           kept->alternative == renderer->settings.alternative &&
           kept->workgroup == renderer->settings.workgroup && kept->branches == private_branches(renderer) &&
           kept->is_listed == renderer_is_adaptive(renderer) &&
           kept->is_part == renderer_is_part(&renderer->settings);
}

static bool is_in_use(const struct renderer *renderer, const struct gpu_program *program) {
    return program &&
           (program == renderer->program || program == renderer->counting || program == renderer->begins);
}

// The tracing kernel with these features, compiled now or before, over the portion's buffers.
static struct gpu_program *keep_program(struct renderer *renderer, uint64_t features) {
    for (uint32_t i = 0; i < RENDERER_KEPT; i++)
        if (is_for(&renderer->kept[i], renderer, features)) {
            gpu_program_bind(renderer->gpu, renderer->kept[i].program, renderer->buffers);
            return renderer->kept[i].program;
        }
    const double start = clock_seconds();
    struct gpu_program *program = renderer_compile_kernel(renderer, RENDERER_TRACE, features, NULL, NULL);
    timeline_add(renderer->settings.timeline, "pipeline", STR(""), start);
    if (!program)
        return NULL;
    while (is_in_use(renderer, renderer->kept[renderer->kept_next].program))
        renderer->kept_next = (renderer->kept_next + 1) % RENDERER_KEPT;
    struct renderer_kept *kept = &renderer->kept[renderer->kept_next];
    gpu_program_destroy(renderer->gpu, kept->program);
    *kept = (struct renderer_kept){.features = features,
                                   .workgroup = renderer->settings.workgroup,
                                   .branches = private_branches(renderer),
                                   .is_listed = renderer_is_adaptive(renderer),
                                   .is_part = renderer_is_part(&renderer->settings),
                                   .alternative = renderer->settings.alternative,
                                   .program = program};
    renderer->kept_next = (renderer->kept_next + 1) % RENDERER_KEPT;
    return program;
}

// The paths that need what the first kernel lacks go on in a further dispatch. On a GPU that dispatch takes
// equally long however few they are, so it pays only if paths are not chains of rays and the first dispatch
// is long. In double precision it always pays: few rays are open, and the second search needs all available
// registers.
bool renderer_pays_apart(const struct renderer *renderer) {
    const struct render_settings *settings = &renderer->settings;
    const uint64_t paths = (uint64_t)settings->width * settings->height * settings->samples;
    const bool bounces = renderer->features & (FEATURE_REFLECTION | FEATURE_REFRACTION);
    const bool is_long = gpu_info(renderer->gpu)->kind == GPU_CPU || paths >= PATHS_FOLLOWED;
    return (renderer->features & FEATURE_TRIANGLES) &&
           (gpu_fetches_texels(renderer->gpu) || renderer->flat->is_double || (!bounces && is_long));
}

// On lavapipe all code of a kernel costs time, needed or not, and on a GPU the part that needs the most
// registers decides. So paths begin in a kernel that neither resumes saved paths nor searches a second time;
// those that need this are saved. Frames that count rays do without it: their counts would differ. Nor does
// it pay to compile a second kernel for a picture that is made only once, unless it is large.
bool renderer_begins_apart(const struct renderer *renderer) {
    const struct render_settings *settings = &renderer->settings;
    const bool pays = renderer->has_drawn ||
                      (uint64_t)settings->width * settings->height * settings->samples >= PATHS_APART;
    const bool fits = gpu_fetches_texels(renderer->gpu) || renderer->samples_at_once;
    return pays && fits && renderer_pays_apart(renderer) && (renderer->features & FEATURE_SLICES) &&
           !(renderer->features & FEATURE_LONG_RAYS) &&
           renderer->settings.alternative == RENDER_ALTERNATIVE_NONE;
}

struct gpu_program *renderer_program(struct renderer *renderer, bool counts) {
    struct gpu_program **program = counts ? &renderer->counting : &renderer->program;
    if (!*program)
        *program = keep_program(renderer, renderer->features | (counts ? FEATURE_COUNTERS : 0));
    return *program;
}

struct gpu_program *renderer_first_program(struct renderer *renderer, bool counts) {
    if (counts || !renderer_begins_apart(renderer))
        return renderer_program(renderer, counts);
    if (!renderer->begins)
        renderer->begins = keep_program(renderer, renderer->features | FEATURE_BEGINS);
    return renderer->begins;
}

bool renderer_packs_groups(const struct flat_scene *flat) {
    const uint64_t most = (uint64_t)NODE_WORDS << 16;
    return !flat->instance_count && flat->triangle_nodes.count <= most && flat->sphere_nodes.count <= most;
}

struct gpu_program *renderer_compile_kernel(struct renderer *renderer, enum renderer_kernel kernel,
                                            uint64_t features, struct gpu_buffer *output,
                                            struct gpu_buffer *state) {
    const struct flat_scene *flat = renderer->flat;
    const bool texels = gpu_fetches_texels(renderer->gpu);
    const struct alternative *alternative = &alternatives[renderer->settings.alternative];
    const struct kernel_pair *pair = pair_of(renderer, kernel);
    const uint32_t constants[CONSTANT_COUNT] = {
        [CONSTANT_FEATURES] = (uint32_t)features,
        [CONSTANT_MORE_FEATURES] = (uint32_t)(features >> 32),
        [CONSTANT_TRIANGLE_STACK] = stack_levels(renderer->triangle_depth),
        [CONSTANT_SPHERE_STACK] = stack_levels(renderer->sphere_depth),
        // A group of the tree over instances also tells which of its children are leaves.
        [CONSTANT_PACKED_GROUPS] = renderer_packs_groups(flat),
        [CONSTANT_WORKGROUP] = renderer->settings.workgroup,
        [CONSTANT_AT_ONCE] = renderer->samples_at_once != 0,
        [CONSTANT_BRANCHES] = renderer->samples_at_once ? private_branches(renderer) : 1,
        [CONSTANT_PART] = renderer_is_part(&renderer->settings),
        [CONSTANT_LISTED] = kernel == RENDERER_TRACE && renderer_is_adaptive(renderer),
        [CONSTANT_ALTERNATIVE_OFFSET] = bits_of(ldexp(alternative->offset, flat->scale_exponent)),
        [CONSTANT_ALTERNATIVE_DISTANCE] = bits_of(alternative->distance),
        [CONSTANT_ALTERNATIVE_CUT] = bits_of(ldexp(alternative->cut, 2 * flat->scale_exponent)),
    };
    struct gpu_program_source source = {
        .kernel = texels ? pair->texels : pair->storage,
        .constants = constants,
        .constant_count = CONSTANT_COUNT,
        .push_bytes = sizeof(struct dispatch_block),
    };
    memcpy(source.buffers, renderer->buffers, sizeof source.buffers);
    if (output)
        source.buffers[BINDING_OUTPUT] = output;
    if (state)
        source.buffers[BINDING_STATE] = state;
    return gpu_program_create(renderer->gpu, &source);
}
