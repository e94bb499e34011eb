// Buffers, views and accessors: the layout of a file's bytes, checked by counts before any byte is read.
#include "assets/gltf/gltf_internal.h"
#include "diag/codes/file.h"

#include <string.h>

#define BYTES_MOST 0x1p53 // how many bytes a JSON number can count exactly

enum {
    STRIDE_LEAST = 4,
    STRIDE_MOST = 252
};

// ---- buffers

static void read_buffer(struct gltf *gltf, json_index node) {
    struct gltf_buffer *buffer = ARENA_PUSH(gltf->arena, &gltf->buffers);
    *buffer = (struct gltf_buffer){.node = node, .uri = STR("")};
    const bool has_uri = gltf_get_text(gltf, node, "uri", &buffer->uri);
    if (!gltf_get_whole(gltf, node, "byteLength", (uint64_t)BYTES_MOST, &buffer->length) &&
        !json_get(&gltf->json, node, "byteLength"))
        gltf_missing(gltf, node, "byteLength");
    if (has_uri || json_get(&gltf->json, node, "uri"))
        return;
    if (gltf->buffers.count > 1 || !gltf->is_binary)
        gltf_missing(gltf, node, "uri");
    else if (!gltf->has_chunk)
        gltf_add(gltf, DIAG_GLTF_DATA, node, "'%s' is in the binary chunk of the file, which has none",
                 gltf_where(gltf, node));
}

// ---- views

static void read_view(struct gltf *gltf, json_index node) {
    struct gltf_view *view = ARENA_PUSH(gltf->arena, &gltf->views);
    uint64_t stride = 0;
    *view = (struct gltf_view){.node = node};
    if (!gltf_get_index(gltf, node, "buffer", gltf->buffers.count, &view->buffer)) {
        if (!json_get(&gltf->json, node, "buffer"))
            gltf_missing(gltf, node, "buffer");
        return;
    }
    if (!gltf_get_whole(gltf, node, "byteLength", (uint64_t)BYTES_MOST, &view->length) &&
        !json_get(&gltf->json, node, "byteLength"))
        gltf_missing(gltf, node, "byteLength");
    gltf_get_whole(gltf, node, "byteOffset", (uint64_t)BYTES_MOST, &view->offset);
    if (gltf_get_whole(gltf, node, "byteStride", STRIDE_MOST, &stride) &&
        (stride < STRIDE_LEAST || stride % 4))
        gltf_add(gltf, DIAG_GLTF_VALUE, json_get(&gltf->json, node, "byteStride"),
                 "'%s' must be a multiple of 4 from 4 to 252",
                 gltf_where(gltf, json_get(&gltf->json, node, "byteStride")));
    else
        view->stride = (uint32_t)stride;
    const struct gltf_buffer *buffer = &gltf->buffers.items[view->buffer];
    if (view->offset + view->length > buffer->length)
        gltf_add(gltf, DIAG_GLTF_DATA, node, "'%s' ends at byte %llu of a buffer of %llu",
                 gltf_where(gltf, node), (unsigned long long)(view->offset + view->length),
                 (unsigned long long)buffer->length);
}

// ---- accessors

uint32_t gltf_component_bytes(unsigned component) {
    return component == GLTF_INT8 || component == GLTF_UINT8     ? 1
           : component == GLTF_INT16 || component == GLTF_UINT16 ? 2
                                                                 : 4;
}

// The columns of a matrix begin at multiples of 4 bytes.
uint32_t gltf_element_bytes(const struct gltf_accessor *accessor) {
    const uint32_t size = gltf_component_bytes(accessor->component);
    if (!accessor->is_matrix)
        return size * accessor->components;
    const uint32_t side = accessor->components == 4 ? 2 : accessor->components == 9 ? 3 : 4;
    return side * ((side * size + 3) / 4 * 4);
}

uint32_t gltf_stride(const struct gltf *gltf, const struct gltf_accessor *accessor) {
    const uint32_t stride = accessor->view == GLTF_NONE ? 0 : gltf->views.items[accessor->view].stride;
    return stride ? stride : gltf_element_bytes(accessor);
}

static bool read_type(struct gltf *gltf, json_index node, struct gltf_accessor *accessor) {
    static const struct {
        const char *name;
        uint32_t components;
        bool is_matrix;
    } types[] = {{"SCALAR", 1, false}, {"VEC2", 2, false}, {"VEC3", 3, false}, {"VEC4", 4, false},
                 {"MAT2", 4, true},    {"MAT3", 9, true},  {"MAT4", 16, true}};
    str name = STR("");
    if (!gltf_get_text(gltf, node, "type", &name)) {
        if (!json_get(&gltf->json, node, "type"))
            gltf_missing(gltf, node, "type");
        return false;
    }
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (str_equal_cstr(name, types[i].name)) {
            accessor->components = types[i].components;
            accessor->is_matrix = types[i].is_matrix;
            return true;
        }
    const json_index at = json_get(&gltf->json, node, "type");
    gltf_add(gltf, DIAG_GLTF_VALUE, at, "'%s' must be SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4",
             gltf_where(gltf, at));
    return false;
}

static bool read_component(struct gltf *gltf, json_index node, unsigned *out) {
    uint64_t value;
    if (!gltf_get_whole(gltf, node, "componentType", UINT32_MAX, &value)) {
        if (!json_get(&gltf->json, node, "componentType"))
            gltf_missing(gltf, node, "componentType");
        return false;
    }
    *out = (unsigned)value;
    if (value >= GLTF_INT8 && value <= GLTF_FLOAT && value != GLTF_UINT32 - 1)
        return true;
    const json_index at = json_get(&gltf->json, node, "componentType");
    gltf_add(gltf, DIAG_GLTF_VALUE, at, "'%s' must be 5120, 5121, 5122, 5123, 5125 or 5126",
             gltf_where(gltf, at));
    return false;
}

// Checks that `count` elements, the first at `offset`, are inside a view.
static void check_range(struct gltf *gltf, json_index node, uint32_t view, uint64_t offset, uint64_t count,
                        uint32_t stride, uint32_t size, uint32_t align) {
    const struct gltf_view *v = &gltf->views.items[view];
    const uint64_t end = count ? offset + (count - 1) * stride + size : offset;
    if (stride < size)
        gltf_add(gltf, DIAG_GLTF_DATA, node,
                 "'%s' has elements of %u bytes, and its view only %u from one to the next",
                 gltf_where(gltf, node), size, stride);
    else if (end > v->length)
        gltf_add(gltf, DIAG_GLTF_DATA, node, "'%s' ends at byte %llu of a view of %llu",
                 gltf_where(gltf, node), (unsigned long long)end, (unsigned long long)v->length);
    else if ((v->offset + offset) % align)
        gltf_add(gltf, DIAG_GLTF_RULE, node,
                 "'%s' begins at byte %llu of its buffer, which is not a multiple of %u",
                 gltf_where(gltf, node), (unsigned long long)(v->offset + offset), align);
}

static void read_sparse(struct gltf *gltf, json_index node, struct gltf_accessor *accessor) {
    struct gltf_sparse *sparse = &accessor->sparse;
    uint64_t count = 0;
    sparse->node = node;
    const json_index indices = gltf_get_object(gltf, node, "indices"),
                     values = gltf_get_object(gltf, node, "values");
    if (!indices || !values || !gltf_get_whole(gltf, node, "count", accessor->count, &count)) {
        if (!indices || !values || !json_get(&gltf->json, node, "count"))
            gltf_add(gltf, DIAG_GLTF_VALUE, node, "'%s' must have 'count', 'indices' and 'values'",
                     gltf_where(gltf, node));
        return;
    }
    const uint32_t errors = gltf->errors;
    gltf_get_index(gltf, indices, "bufferView", gltf->views.count, &sparse->index_view);
    gltf_get_index(gltf, values, "bufferView", gltf->views.count, &sparse->value_view);
    gltf_get_whole(gltf, indices, "byteOffset", (uint64_t)BYTES_MOST, &sparse->index_offset);
    gltf_get_whole(gltf, values, "byteOffset", (uint64_t)BYTES_MOST, &sparse->value_offset);
    if (!read_component(gltf, indices, &sparse->index_type) || gltf->errors > errors)
        return;
    if (sparse->index_view == GLTF_NONE || sparse->value_view == GLTF_NONE) {
        gltf_missing(gltf, sparse->index_view == GLTF_NONE ? indices : values, "bufferView");
        return;
    }
    const uint32_t size = gltf_component_bytes(sparse->index_type), element = gltf_element_bytes(accessor);
    check_range(gltf, indices, sparse->index_view, sparse->index_offset, count, size, size, size);
    check_range(gltf, values, sparse->value_view, sparse->value_offset, count, element, element,
                gltf_component_bytes(accessor->component));
    if (sparse->index_type != GLTF_UINT8 && sparse->index_type != GLTF_UINT16 &&
        sparse->index_type != GLTF_UINT32)
        gltf_add(gltf, DIAG_GLTF_VALUE, indices, "'%s' must have a 'componentType' of 5121, 5123 or 5125",
                 gltf_where(gltf, indices));
    sparse->count = (uint32_t)count;
}

static void read_accessor(struct gltf *gltf, json_index node) {
    struct gltf_accessor *accessor = ARENA_PUSH(gltf->arena, &gltf->accessors);
    uint64_t count = 0;
    *accessor = (struct gltf_accessor){.node = node, .view = GLTF_NONE};
    const uint32_t errors = gltf->errors;
    read_type(gltf, node, accessor);
    read_component(gltf, node, &accessor->component);
    if (!gltf_get_whole(gltf, node, "count", UINT32_MAX - 1, &count) && !json_get(&gltf->json, node, "count"))
        gltf_missing(gltf, node, "count");
    accessor->count = (uint32_t)count;
    gltf_get_bool(gltf, node, "normalized", &accessor->normalized);
    gltf_get_whole(gltf, node, "byteOffset", (uint64_t)BYTES_MOST, &accessor->offset);
    gltf_get_index(gltf, node, "bufferView", gltf->views.count, &accessor->view);
    if (gltf->errors > errors)
        return;
    if (accessor->view != GLTF_NONE)
        check_range(gltf, node, accessor->view, accessor->offset, count, gltf_stride(gltf, accessor),
                    gltf_element_bytes(accessor), gltf_component_bytes(accessor->component));
    const json_index sparse = gltf_get_object(gltf, node, "sparse");
    if (sparse)
        read_sparse(gltf, sparse, accessor);
}

void gltf_read_buffers(struct gltf *gltf) {
    const json_index root = gltf->json.root;
    json_index list = gltf_get_list(gltf, root, "buffers");
    for (json_index at = 0; list && (at = gltf_next_object(gltf, list, at));)
        read_buffer(gltf, at);
    list = gltf_get_list(gltf, root, "bufferViews");
    for (json_index at = 0; list && (at = gltf_next_object(gltf, list, at));)
        read_view(gltf, at);
    list = gltf_get_list(gltf, root, "accessors");
    for (json_index at = 0; list && (at = gltf_next_object(gltf, list, at));)
        read_accessor(gltf, at);
}
