// A renderer over a scene that changes: what is equal stays on the device, by comparison with what lies
// there.
#include "grammar/ir.h"
#include "tracer/render/render_private.h"

#include <string.h>

static bool is_same_word(const struct gpu_word *a, const struct gpu_word *b) {
    return memcmp(a, b, sizeof *a) == 0;
}

// Writes the words from the first to the last that differ.
static bool write_difference(struct renderer *renderer, uint32_t binding, const struct flat_array *old,
                             const struct flat_array *now, struct render_update *done) {
    uint64_t begin = 0, end = now->count;
    // The same geometry, shared (flatten.h).
    if (old->words == now->words)
        return true;
    while (begin < end && is_same_word(&old->words[begin], &now->words[begin]))
        begin++;
    if (begin == end)
        return true;
    while (is_same_word(&old->words[end - 1], &now->words[end - 1]))
        end--;
    const uint64_t bytes = (end - begin) * sizeof *now->words;
    done->arrays++;
    done->bytes += bytes;
    return gpu_write(renderer->gpu, renderer->buffers[binding], begin * sizeof *now->words,
                     now->words + begin, bytes);
}

static void drop_buffer(struct renderer *renderer, uint32_t binding) {
    gpu_buffer_destroy(renderer->gpu, renderer->buffers[binding]);
    renderer->buffers[binding] = NULL;
}

static bool replace(struct renderer *renderer, const struct renderer_array *now, struct render_update *done) {
    drop_buffer(renderer, now->binding);
    if (!renderer_upload_array(renderer, now))
        return false;
    done->arrays++;
    done->bytes += gpu_buffer_bytes(renderer->buffers[now->binding]);
    return true;
}

static bool update_arrays(struct renderer *renderer, const struct flat_scene *was,
                          const struct flat_scene *flat, struct render_update *done) {
    struct renderer_array old[RENDERER_ARRAYS], now[RENDERER_ARRAYS];
    const uint32_t before = renderer_arrays(was, old), count = renderer_arrays(flat, now);
    for (uint32_t i = 0; i < count; i++) {
        const bool fits = i < before && old[i].array->count == now[i].array->count &&
                          (now[i].binding != BINDING_PAINTS || flat_has_texels_of(was, flat));
        if (!(fits ? write_difference(renderer, now[i].binding, old[i].array, now[i].array, done)
                   : replace(renderer, &now[i], done)))
            return false;
    }
    if (count < before)
        drop_buffer(renderer, now[count].binding);
    return true;
}

// The same picture in the store becomes the same texels.
static bool is_same_background(const struct flat_scene *a, const struct flat_scene *b) {
    return a->background == b->background && a->background_texels.bytes == b->background_texels.bytes &&
           a->background_texels.is_float == b->background_texels.is_float &&
           a->scene->ir->image.transfer == b->scene->ir->image.transfer;
}

static bool update_background(struct renderer *renderer, const struct flat_scene *old,
                              struct render_update *done) {
    if (is_same_background(old, renderer->flat))
        return true;
    done->arrays++;
    done->bytes += renderer->flat->background_texels.bytes;
    drop_buffer(renderer, BINDING_BACKGROUND);
    return renderer_make_background(renderer);
}

// Whether kernels for one scene are kernels for the other, whatever their features.
static bool has_kernels_for(const struct renderer *renderer, const struct flat_scene *old,
                            const struct flat_scene *flat) {
    return old->is_double == flat->is_double && (old->instance_count != 0) == (flat->instance_count != 0) &&
           flat->triangle_depth <= renderer->triangle_depth && flat->sphere_depth <= renderer->sphere_depth &&
           renderer_packs_groups(old) == renderer_packs_groups(flat);
}

// The kernels' descriptors still name buffers that are gone.
static void bind_kernels(struct renderer *renderer) {
    struct gpu_program *const programs[] = {renderer->program, renderer->counting, renderer->begins,
                                            renderer->resolve};
    for (size_t i = 0; i < sizeof programs / sizeof *programs; i++)
        if (programs[i])
            gpu_program_bind(renderer->gpu, programs[i], renderer->buffers);
}

bool renderer_update(struct renderer *renderer, const struct flat_scene *old, const struct flat_scene *flat,
                     const struct render_settings *settings, struct render_update *done) {
    struct render_update unseen;
    struct render_settings wanted = *settings;
    const uint64_t had = renderer->settings.features;
    done = done ? done : &unseen;
    *done = (struct render_update){0};
    // These have their own descriptors, and are made when they are needed.
    renderer_hits_destroy(renderer);
    renderer_log_destroy(renderer);
    if (!has_kernels_for(renderer, old, flat))
        renderer_forget_kernels(renderer);
    else if ((wanted.features | had) == had)
        wanted.features = had;
    // The possible length of paths depends on them, too.
    if (old->light_count != flat->light_count)
        renderer->settings.width = 0;
    renderer->flat = flat;
    if (!update_arrays(renderer, old, flat, done))
        return false;
    if (!update_background(renderer, old, done))
        return false;
    bind_kernels(renderer);
    // Tiles are in the order of what the old scene showed.
    renderer->ordered = (struct view_camera){0};
    return renderer_change(renderer, flat, &wanted);
}

bool renderer_warm(struct renderer *renderer) {
    const struct dispatch_block nothing = {0};
    struct gpu_program *program = renderer_first_program(renderer, false);
    return program && gpu_compile(renderer->gpu, program, &nothing) && gpu_wait(renderer->gpu, NULL);
}
