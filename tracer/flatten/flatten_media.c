// Media (scene/media.h): the numbers by which rays know what they are inside.
#include "core/heap.h"
#include "diag/codes/limit.h"
#include "shaders/features.h"
#include "shaders/gpu_scene.h"
#include "tracer/flatten/flatten_internal.h"

#include <assert.h>
#include <stdlib.h>

static_assert(MEDIA_MOST == SCENE_MEDIA_MOST, "a path has room for what the language allows");

static int compare(const void *a, const void *b) {
    return scene_compare_media(*(const struct scene_material *const *)a,
                               *(const struct scene_material *const *)b);
}

// The materials of all media, with alike ones next to each other.
static const struct scene_material **sorted_fillings(const struct flattening *f, uint32_t *count) {
    const struct scene *scene = f->scene;
    const struct scene_material **all = heap_array((size_t)scene->body_count + 1, sizeof *all);
    *count = 0;
    for (uint32_t i = 0; all && i < scene->body_count; i++)
        if (scene_is_medium(scene, &scene->bodies[i]))
            all[(*count)++] = &scene->materials[scene_medium_material(scene, &scene->bodies[i])];
    if (all && *count)
        qsort(all, *count, sizeof *all, compare);
    return all;
}

// By material: the first, in the scene's order, of those that are alike.
static uint32_t *first_alike(const struct flattening *f) {
    const struct scene_material *materials = f->scene->materials;
    uint32_t count;
    uint32_t *first = heap_zeroed((size_t)f->scene->material_count + 1, sizeof *first);
    const struct scene_material **all = sorted_fillings(f, &count);
    for (uint32_t i = 0, end; first && all && i < count; i = end) {
        const struct scene_material *least = all[i];
        for (end = i; end < count && compare(&all[i], &all[end]) == 0; end++)
            least = all[end] < least ? all[end] : least;
        for (uint32_t k = i; k < end; k++)
            first[all[k] - materials] = (uint32_t)(least - materials);
    }
    if (!all) {
        free(first);
        first = NULL;
    }
    free(all);
    return first;
}

static enum flatten_fault number_media(struct flattening *f) {
    const struct scene *scene = f->scene;
    uint32_t *first = first_alike(f);
    f->medium = heap_zeroed((size_t)scene->body_count + 1, sizeof *f->medium);
    for (uint32_t i = 0; first && f->medium && i < scene->body_count; i++) {
        const struct scene_body *body = &scene->bodies[i];
        if (!scene_is_medium(scene, body))
            continue;
        const uint32_t material = scene_medium_material(scene, body);
        const uint32_t priority = (uint32_t)(scene->materials[material].priority + MEDIUM_PRIORITY);
        f->medium[i] = priority << MEDIUM_BITS | (first[material] + 1);
    }
    const bool good = first && f->medium;
    free(first);
    return good ? FLATTEN_DONE : FLATTEN_NO_MEMORY;
}

enum flatten_fault flatten_media(struct flattening *f) {
    if (!scene_media_need(f->scene, &f->out->media))
        return FLATTEN_NO_MEMORY;
    if (f->out->media.need == SCENE_MEDIA_APART)
        return FLATTEN_DONE;
    if (f->scene->body_count >= MEDIUM_MASK || f->scene->material_count >= MEDIUM_MASK) {
        diag_add(f->input->sink, DIAG_LIMIT, SPAN_NONE,
                 "bodies that refract overlap or are coloured inside: then there may be at most %u bodies "
                 "and materials",
                 MEDIUM_MASK - 1);
        return FLATTEN_REPORTED;
    }
    f->media_features = FEATURE_MEDIA;
    for (uint32_t i = 0; i < f->scene->body_count; i++) {
        const struct scene_body *body = &f->scene->bodies[i];
        if (scene_is_medium(f->scene, body) &&
            !vec3_is_zero(f->scene->materials[scene_medium_material(f->scene, body)].absorption))
            f->media_features |= FEATURE_ATTENUATION;
    }
    return number_media(f);
}
