// Decides which models become instances of the mesh that they share, and which get triangles of their own.
#include "core/heap.h"
#include "diag/codes/limit.h"
#include "scene/mesh_use.h"
#include "tracer/flatten/flatten_internal.h"

#include <inttypes.h>
#include <stdlib.h>

// The least that sharing must save on the device (docs/decisions/instances.md).
#define SAVED_LEAST (INT64_C(32) << 20)

enum {
    NODE_BYTES = 9, // of the trees, for each triangle: measured on meshes of 1e3 to 1e6 triangles
};

// ---- the choice

static int64_t word_bytes(uint64_t words) {
    return (int64_t)(words * sizeof(struct gpu_word));
}

// The bytes of a triangle that models share, or that is copied next to shared ones.
static int64_t placed_bytes(bool smooth) {
    return word_bytes(PLACED_WORDS) + (smooth ? 3 * word_bytes(NORMAL64_WORDS) : 0) + NODE_BYTES;
}

static void count_bytes(const struct flattening *f, struct shared_mesh *shared) {
    const struct flat_strides *strides = &f->out->strides;
    const int64_t triangles = shared->mesh->triangle_count;
    int64_t copies = 0, own = 0;
    bool any_smooth = false;
    for (uint32_t i = 0; i < shared->use_count; i++) {
        const uint32_t body = f->sharing.uses[shared->first_use + i];
        const bool smooth = f->scene->bodies[body].smooth;
        if (!f->sharing.instance[body])
            continue;
        any_smooth = any_smooth || smooth;
        copies +=
            triangles * (word_bytes(strides->triangle + (smooth ? 3 * strides->normal : 0)) + NODE_BYTES);
        own += word_bytes(ENTRY64_WORDS + INSTANCE_WORDS + NODE_WORDS) +
               shared->copied_count * placed_bytes(false);
    }
    shared->saved_bytes = copies - own - (shared->instances ? triangles * placed_bytes(any_smooth) : 0);
}

// For triangles that are not shared: in a scene with instances their records are larger.
static int64_t lost_bytes(const struct flattening *f) {
    int64_t triangles = f->triangle_total;
    for (uint32_t i = 0; i < f->sharing.mesh_count; i++)
        triangles -= (int64_t)f->sharing.meshes[i].instances * f->sharing.meshes[i].mesh->triangle_count;
    return triangles * (word_bytes(PLACED_WORDS) - word_bytes(f->out->strides.triangle));
}

static void decide(struct flattening *f) {
    struct sharing *sharing = &f->sharing;
    const enum flat_sharing wanted = f->input->sharing;
    int64_t saved = 0;
    for (uint32_t i = 0; i < sharing->mesh_count; i++) {
        count_bytes(f, &sharing->meshes[i]);
        if (wanted == FLAT_CHEAPER && sharing->meshes[i].saved_bytes <= 0)
            flatten_keep_copies(f, &sharing->meshes[i], FLAT_REASON_SMALL);
        saved += sharing->meshes[i].instances ? sharing->meshes[i].saved_bytes : 0;
    }
    if (wanted == FLAT_CHEAPER && saved - lost_bytes(f) < SAVED_LEAST)
        for (uint32_t i = 0; i < sharing->mesh_count; i++)
            flatten_keep_copies(f, &sharing->meshes[i], FLAT_REASON_SMALL);
}

// Decides without looking at the triangles: sharing would save too little even if all models could be
// instances, or copies are asked for.
static bool is_decided(struct flattening *f) {
    struct sharing *sharing = &f->sharing;
    int64_t saved = 0;
    if (f->input->sharing == FLAT_SHARED)
        return false;
    for (uint32_t i = 0; i < sharing->mesh_count; i++) {
        struct shared_mesh *shared = &sharing->meshes[i];
        for (uint32_t k = 0; k < shared->use_count; k++)
            sharing->instance[sharing->uses[shared->first_use + k]] = 1;
        shared->instances = shared->use_count;
        count_bytes(f, shared);
        saved += shared->saved_bytes > 0 ? shared->saved_bytes : 0;
        flatten_keep_copies(f, shared,
                            f->input->sharing == FLAT_COPIES ? FLAT_REASON_COPIES : FLAT_REASON_SMALL);
    }
    return f->input->sharing == FLAT_COPIES || saved < SAVED_LEAST;
}

// ---- which models share a mesh

static int compare_meshes(const void *a, const void *b) {
    const struct shared_mesh *x = a, *y = b;
    return x->first_use < y->first_use ? -1 : x->first_use > y->first_use;
}

// Meshes with at least two models, in the order of their first models: during sorting `first_use` is that
// body, afterwards a place in `uses`.
static bool list_meshes(struct flattening *f, const struct mesh_use *uses, uint32_t count) {
    struct sharing *sharing = &f->sharing;
    sharing->meshes = heap_zeroed((size_t)count / 2 + 1, sizeof *sharing->meshes);
    sharing->uses = heap_array((size_t)count + 1, sizeof *sharing->uses);
    sharing->instance = heap_zeroed((size_t)f->scene->body_count + 1, sizeof *sharing->instance);
    f->out->instance_of = sharing->instance;
    if (!sharing->meshes || !sharing->uses || !sharing->instance)
        return false;
    for (uint32_t begin = 0, end; begin < count; begin = end) {
        for (end = begin + 1; end < count && uses[end].mesh == uses[begin].mesh;)
            end++;
        for (uint32_t i = begin; i < end; i++)
            sharing->uses[i] = uses[i].body;
        if (end - begin > 1)
            sharing->meshes[sharing->mesh_count++] =
                (struct shared_mesh){.mesh = uses[begin].mesh, .first_use = begin, .use_count = end - begin};
    }
    return true;
}

static void order_meshes(struct sharing *sharing) {
    for (uint32_t i = 0; i < sharing->mesh_count; i++) {
        // The place, kept here while no mesh has a root yet.
        sharing->meshes[i].root = sharing->meshes[i].first_use;
        sharing->meshes[i].first_use = sharing->uses[sharing->meshes[i].first_use];
    }
    qsort(sharing->meshes, sharing->mesh_count, sizeof *sharing->meshes, compare_meshes);
    for (uint32_t i = 0; i < sharing->mesh_count; i++)
        sharing->meshes[i].first_use = sharing->meshes[i].root;
}

static enum flatten_fault find_meshes(struct flattening *f) {
    struct mesh_use *uses = heap_array((size_t)f->scene->body_count + 1, sizeof *uses);
    if (!uses)
        return FLATTEN_NO_MEMORY;
    const uint32_t count = mesh_uses(f->scene, 1, uses);
    const bool done = list_meshes(f, uses, count);
    free(uses);
    if (done)
        order_meshes(&f->sharing);
    return done ? FLATTEN_DONE : FLATTEN_NO_MEMORY;
}

// ---- the whole

static enum flatten_fault report_uses(struct flattening *f) {
    struct flat_scene *out = f->out;
    out->uses = heap_array((size_t)f->sharing.mesh_count + 1, sizeof *out->uses);
    if (!out->uses)
        return FLATTEN_NO_MEMORY;
    for (uint32_t i = 0; i < f->sharing.mesh_count; i++) {
        const struct shared_mesh *shared = &f->sharing.meshes[i];
        out->uses[out->use_count++] = (struct flat_use){.mesh = shared->mesh,
                                                        .models = shared->use_count,
                                                        .instances = shared->instances,
                                                        .copied = shared->copied_count,
                                                        .left_out = shared->left_out_count,
                                                        .reason = shared->reason,
                                                        .saved_bytes = shared->saved_bytes};
    }
    return FLATTEN_DONE;
}

// Numbers the instances, from 1 on in IR order.
static bool number_instances(struct flattening *f) {
    struct sharing *sharing = &f->sharing;
    sharing->mesh_of = heap_array((size_t)f->scene->body_count + 1, sizeof *sharing->mesh_of);
    if (!sharing->mesh_of)
        return false;
    for (uint32_t i = 0; i < f->scene->body_count; i++)
        if (sharing->instance[i])
            sharing->instance[i] = ++sharing->instance_count;
    sharing->instance_count += sharing->instance_count != 0;
    for (uint32_t i = 0; i < sharing->mesh_count; i++)
        for (uint32_t k = 0; k < sharing->meshes[i].use_count; k++)
            sharing->mesh_of[sharing->uses[sharing->meshes[i].first_use + k]] = i;
    return true;
}

struct shared_mesh *flatten_shared(const struct flattening *f, uint32_t body) {
    return f->sharing.instance[body] ? &f->sharing.meshes[f->sharing.mesh_of[body]] : NULL;
}

uint64_t flatten_copied(const struct flattening *f) {
    uint64_t sum = f->triangle_total;
    for (uint32_t i = 0; i < f->sharing.mesh_count; i++) {
        const struct shared_mesh *shared = &f->sharing.meshes[i];
        sum -= (uint64_t)shared->instances * (shared->mesh->triangle_count - shared->copied_count);
    }
    return sum;
}

uint32_t flatten_left_out(const struct flattening *f) {
    uint32_t sum = 0; // at most triangle_total
    for (uint32_t i = 0; i < f->sharing.mesh_count; i++)
        sum += f->sharing.meshes[i].instances * f->sharing.meshes[i].left_out_count;
    return sum;
}

// Copied triangles, and all shown ones: a triangle's number must fit.
static enum flatten_fault check_counts(const struct flattening *f) {
    const uint64_t most = f->input->limits->value[LIMIT_SCENE_TRIANGLES], copied = flatten_copied(f);
    const struct limit_info *info = limit_info(LIMIT_SCENE_TRIANGLES);
    if (copied <= most)
        return FLATTEN_DONE;
    uint32_t own = 0; // the first body that has some
    while (own + 1 < f->scene->body_count && (!f->scene->bodies[own].mesh || flatten_shared(f, own)))
        own++;
    diag_add(f->input->sink, DIAG_LIMIT, scene_body_label(f->scene, &f->scene->bodies[own]),
             "models have %" PRIu64 " triangles of their own, because %s; the limit %s is %" PRIu64, copied,
             f->input->sharing == FLAT_COPIES ? "none can share a mesh here"
                                              : "not all that show the same mesh can share it",
             info->name, most);
    if (copied <= info->greatest)
        diag_help(f->input->sink, "if this is intended, raise the limit: --limit %s=%" PRIu64, info->name,
                  copied);
    return FLATTEN_REPORTED;
}

enum flatten_fault flatten_share(struct flattening *f) {
    enum flatten_fault fault = find_meshes(f);
    if (fault != FLATTEN_DONE)
        return fault;
    if (!is_decided(f)) {
        for (uint32_t i = 0; i < f->sharing.mesh_count && fault == FLATTEN_DONE; i++)
            fault = flatten_judge(f, &f->sharing.meshes[i]);
        if (fault != FLATTEN_DONE)
            return fault;
        decide(f);
    }
    if (!number_instances(f))
        return FLATTEN_NO_MEMORY;
    fault = check_counts(f);
    return fault == FLATTEN_DONE ? report_uses(f) : fault;
}

void flatten_share_finish(struct sharing *sharing) {
    for (uint32_t i = 0; i < sharing->mesh_count; i++) {
        free(sharing->meshes[i].copied);
        free(sharing->meshes[i].left_out);
        free(sharing->meshes[i].boxes);
    }
    free(sharing->meshes);
    free(sharing->uses);
    free(sharing->mesh_of);
}
