// The picture as GPUs make it: by rows, with its faults counted.

layout(set = 0, binding = BINDING_PICTURE, std430) restrict writeonly buffer picture_words { uint picture[]; };
layout(set = 0, binding = BINDING_ORDER, std430) restrict readonly buffer order_words { uint tile_order[]; };

// As pixel_of_slot, in the order of ORDER.
uvec2 pixel_in_order(uint slot) {
    uint tile = tile_order[dispatch.tile_begin + slot / TILE_PIXELS];
    return uvec2(tile & 0xffffu, tile >> 16u) * TILE_SIDE + morton(slot % TILE_PIXELS);
}

uint kind_of(uint fault) { return fault >> FAULT_KIND_SHIFT; }

// `sum`: of all samples, and their fault.
void show(uvec2 pixel, uvec4 sum) {
    uint at = pixel.y * frame.width + pixel.x, kind = kind_of(sum.w);
    for (uint i = 0u; i < 3u; i++)
        picture[3u * at + i] = kind != FAULT_NOT_FINITE ? sum[i] : 0x7fc00000u;
    if (kind != FAULT_NONE) {
        atomicAdd(counters[COUNTER_FAULT_PIXELS + kind], 1u);
        atomicMax(counters[COUNTER_FAULT_FIRST + kind], ~at);
    }
}
