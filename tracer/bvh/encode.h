// One node of the wide tree as the words of shaders/gpu_scene.h, and back. Private to tracer/bvh.
#ifndef GLINT_TRACER_BVH_ENCODE_H
#define GLINT_TRACER_BVH_ENCODE_H

#include "tracer/bvh/box.h"

struct wide_child {
    struct bvh_box box;
    uint32_t count; // items of a leaf; 0: no child here
    bool is_node;
};

// Slots hold the children; `first_node` and `first_item` are where this node's children and items begin.
void encode_node(const struct wide_child slots[BVH_WIDTH], uint32_t first_node, uint32_t first_item,
                 struct gpu_word words[5]);

#endif
