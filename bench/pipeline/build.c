// The two levels of the vendor's tree: all triangles in one geometry, and one instance of it.
#include "bench/pipeline/rt.h"

#include "core/clock.h"

#include <string.h>

// What is built: a level, from one geometry of `count` parts.
struct level {
    VkAccelerationStructureTypeKHR type;
    const VkAccelerationStructureGeometryKHR *geometry;
    uint32_t count;
    struct rt_buffer *storage;
    VkAccelerationStructureKHR *tree;
};

static bool create_tree(struct rt *rt, const struct level *level, VkDeviceSize bytes) {
    if (!rt_buffer_make(rt, level->storage, bytes, VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR,
                        false))
        return false;
    const VkAccelerationStructureCreateInfoKHR create = {
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR,
        .buffer = level->storage->buffer,
        .size = bytes,
        .type = level->type};
    return rt_check(rt, rt->vk.vkCreateAccelerationStructureKHR(rt->device, &create, NULL, level->tree),
                    "vkCreateAccelerationStructureKHR");
}

static bool build_level(struct rt *rt, const struct level *level) {
    VkAccelerationStructureBuildGeometryInfoKHR info = {
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR,
        .type = level->type,
        .flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR,
        .mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR,
        .geometryCount = 1,
        .pGeometries = level->geometry};
    VkAccelerationStructureBuildSizesInfoKHR sizes = {
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
    rt->vk.vkGetAccelerationStructureBuildSizesKHR(
        rt->device, VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, &level->count, &sizes);
    const VkDeviceSize step = rt->tree_limits.minAccelerationStructureScratchOffsetAlignment;
    struct rt_buffer scratch = {0};
    if (!create_tree(rt, level, sizes.accelerationStructureSize) ||
        !rt_buffer_make(rt, &scratch, sizes.buildScratchSize + step, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                        false) ||
        !rt_begin(rt)) {
        rt_buffer_free(rt, &scratch);
        return false;
    }
    info.dstAccelerationStructure = *level->tree;
    info.scratchData.deviceAddress = rt_aligned(scratch.address, step);
    const VkAccelerationStructureBuildRangeInfoKHR range = {.primitiveCount = level->count};
    const VkAccelerationStructureBuildRangeInfoKHR *ranges = &range;
    rt->vk.vkCmdBuildAccelerationStructuresKHR(rt->commands, 1, &info, &ranges);
    const bool done = rt_finish(rt);
    rt_buffer_free(rt, &scratch);
    return done;
}

static bool build_low(struct rt *rt, const struct rt_scene *scene) {
    const VkAccelerationStructureGeometryKHR geometry = {
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR,
        .geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR,
        .geometry.triangles = {.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR,
                               .vertexFormat = VK_FORMAT_R32G32B32_SFLOAT,
                               .vertexData.deviceAddress = rt->vertices.address,
                               .vertexStride = 3 * sizeof(float),
                               .maxVertex = scene->vertex_count - 1,
                               .indexType = VK_INDEX_TYPE_UINT32,
                               .indexData.deviceAddress = rt->indices.address},
        .flags = VK_GEOMETRY_OPAQUE_BIT_KHR};
    const struct level level = {VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, &geometry,
                                scene->triangle_count, &rt->low, &rt->low_tree};
    return build_level(rt, &level);
}

static bool build_top(struct rt *rt) {
    const VkAccelerationStructureDeviceAddressInfoKHR ask = {
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR,
        .accelerationStructure = rt->low_tree};
    const VkAccelerationStructureInstanceKHR instance = {
        .transform = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}},
        .mask = 0xff,
        .flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR,
        .accelerationStructureReference =
            rt->vk.vkGetAccelerationStructureDeviceAddressKHR(rt->device, &ask)};
    if (!rt_buffer_fill(rt, &rt->instances, &instance, sizeof instance,
                        VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR))
        return false;
    const VkAccelerationStructureGeometryKHR geometry = {
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR,
        .geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR,
        .geometry.instances = {.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR,
                               .data.deviceAddress = rt->instances.address}};
    const struct level level = {VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, &geometry, 1, &rt->top,
                                &rt->top_tree};
    return build_level(rt, &level);
}

// Each step was waited for, and rt_begin lets the next see what it wrote.
bool rt_build(struct rt *rt, const struct rt_scene *scene) {
    const double start = clock_seconds();
    const bool done = build_low(rt, scene) && build_top(rt);
    rt->build_seconds = clock_seconds() - start;
    return done;
}
