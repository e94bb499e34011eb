// Turns samples that were traced at once into a picture on the device: what is recorded after a pass of them.
#include "tracer/render/render_private.h"

bool renderer_resolve(struct renderer_frame *run, uint32_t mode) {
    struct renderer *renderer = run->renderer;
    struct dispatch_block block = run->resolve;
    block.read_list = mode;
    block.grid_width = block.tile_count < UINT16_MAX ? block.tile_count : UINT16_MAX;
    const uint32_t rows = (block.tile_count + block.grid_width - 1) / block.grid_width;
    return gpu_dispatch(renderer->gpu, renderer->resolve, block.grid_width, rows, &block);
}

bool renderer_clear_faults(struct renderer *renderer) {
    const uint64_t begin = COUNTER_FAULT_PIXELS * sizeof(uint32_t);
    const uint64_t bytes = (COUNTER_FAULT_WORD - COUNTER_FAULT_PIXELS) * sizeof(uint32_t);
    return gpu_clear(renderer->gpu, renderer->buffers[BINDING_COUNTERS], begin, bytes);
}

// Saved paths may be left that are not yet in the picture: it is made again after the next pass. A single
// sample writes its pixel when it ends.
static bool show_samples(struct renderer_frame *run) {
    struct renderer *renderer = run->renderer;
    return (renderer->settings.samples == 1 ||
            (renderer_clear_faults(renderer) && renderer_resolve(run, RESOLVE_SHOW))) &&
           (!run->shows_all || gpu_copy(renderer->gpu, renderer->buffers[BINDING_PICTURE], renderer->picture,
                                        gpu_buffer_bytes(renderer->picture)));
}

bool renderer_copy_counters(struct renderer_frame *run) {
    struct renderer *renderer = run->renderer;
    const uint64_t words = run->counting ? COUNTER_COUNT : COUNTER_SHARED;
    return gpu_copy(renderer->gpu, renderer->buffers[BINDING_COUNTERS], renderer->counters,
                    words * sizeof(uint32_t));
}

bool renderer_follow_pass(struct renderer_frame *run, bool ends) {
    return (!ends || !run->shows || show_samples(run)) && renderer_copy_counters(run);
}
