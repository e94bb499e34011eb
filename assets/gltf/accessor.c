// The contents of accessors: numbers of any type, with their sparse values, and the corners of triangles.
#include "assets/gltf/gltf_internal.h"
#include "core/float_bits.h"
#include "core/heap.h"
#include "diag/codes/file.h"
#include "diag/codes/limit.h"

#include <math.h>

// ---- numbers

static uint32_t whole_at(const char *at, unsigned component) {
    const unsigned char *p = (const unsigned char *)at;
    switch (component) {
    case GLTF_INT8:
    case GLTF_UINT8:
        return p[0];
    case GLTF_INT16:
    case GLTF_UINT16:
        return (uint32_t)p[0] | (uint32_t)p[1] << 8;
    default:
        return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
    }
}

static double number_at(const char *at, unsigned component, bool normalized) {
    const uint32_t bits = whole_at(at, component);
    switch (component) {
    case GLTF_INT8:
        return normalized ? fmax((int8_t)bits / 127.0, -1) : (int8_t)bits;
    case GLTF_UINT8:
        return normalized ? bits / 255.0 : bits;
    case GLTF_INT16:
        return normalized ? fmax((int16_t)bits / 32767.0, -1) : (int16_t)bits;
    case GLTF_UINT16:
        return normalized ? bits / 65535.0 : bits;
    case GLTF_UINT32:
        return bits;
    default:
        return (double)float_of_bits(bits);
    }
}

static void read_element(const struct gltf_accessor *a, const char *at, double *out) {
    if (a->component == GLTF_FLOAT) {
        for (uint32_t k = 0; k < a->components; k++)
            out[k] = number_at(at + 4 * (size_t)k, GLTF_FLOAT, false);
        return;
    }
    const uint32_t size = gltf_component_bytes(a->component);
    for (uint32_t k = 0; k < a->components; k++)
        out[k] = number_at(at + (size_t)k * size, a->component, a->normalized);
}

static const char *view_at(const struct gltf *gltf, uint32_t view, uint64_t offset) {
    return gltf_view_bytes(gltf, view).ptr + offset;
}

static uint32_t sparse_index(const struct gltf *gltf, const struct gltf_sparse *sparse, uint32_t i) {
    const uint32_t size = gltf_component_bytes(sparse->index_type);
    return whole_at(view_at(gltf, sparse->index_view, sparse->index_offset + (uint64_t)i * size),
                    sparse->index_type);
}

static double *read_elements(const struct gltf *gltf, const struct gltf_accessor *a) {
    double *out = ARENA_ARRAY(gltf->arena, double, heap_times(a->count, a->components));
    if (a->view != GLTF_NONE && a->count) {
        const char *at = view_at(gltf, a->view, a->offset);
        const uint32_t stride = gltf_stride(gltf, a);
        for (uint32_t i = 0; i < a->count; i++)
            read_element(a, at + (size_t)i * stride, out + (size_t)i * a->components);
    }
    const uint32_t size = gltf_element_bytes(a);
    for (uint32_t i = 0; i < a->sparse.count; i++)
        read_element(a, view_at(gltf, a->sparse.value_view, a->sparse.value_offset + (uint64_t)i * size),
                     out + (size_t)sparse_index(gltf, &a->sparse, i) * a->components);
    return out;
}

// As read_elements, for an accessor of whole numbers that are not normalized.
static uint32_t *read_indices(const struct gltf *gltf, const struct gltf_accessor *a) {
    uint32_t *out = ARENA_ARRAY(gltf->arena, uint32_t, a->count);
    if (a->view != GLTF_NONE && a->count) {
        const char *at = view_at(gltf, a->view, a->offset);
        const uint32_t stride = gltf_stride(gltf, a);
        for (uint32_t i = 0; i < a->count; i++)
            out[i] = whole_at(at + (size_t)i * stride, a->component);
    }
    const uint32_t size = gltf_element_bytes(a);
    for (uint32_t i = 0; i < a->sparse.count; i++)
        out[sparse_index(gltf, &a->sparse, i)] = whole_at(
            view_at(gltf, a->sparse.value_view, a->sparse.value_offset + (uint64_t)i * size), a->component);
    return out;
}

// ---- checks

static bool check_sparse(struct gltf *gltf, const struct gltf_accessor *a) {
    uint64_t before = 0;
    for (uint32_t i = 0; i < a->sparse.count; i++) {
        const uint32_t index = sparse_index(gltf, &a->sparse, i);
        if (index >= a->count) {
            gltf_add(gltf, DIAG_GLTF_DATA, a->sparse.node,
                     "index %u of '%s' is %u, and the accessor has %u elements", i,
                     gltf_where(gltf, a->sparse.node), index, a->count);
            return false;
        }
        if (i > 0 && index <= before) {
            gltf_add(gltf, DIAG_GLTF_DATA, a->sparse.node,
                     "index %u of '%s' is %u, which is not larger than the one before", i,
                     gltf_where(gltf, a->sparse.node), index);
            return false;
        }
        before = index;
    }
    return true;
}

// Checks the file's least and largest position values, by which other programs place a camera.
static void check_bounds(struct gltf *gltf, const struct gltf_accessor *a, const double *elements) {
    double least[3], most[3], low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL},
                              high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    const bool has = json_get(&gltf->json, a->node, "min") && json_get(&gltf->json, a->node, "max");
    if (!has) {
        gltf_add(gltf, DIAG_GLTF_RULE, a->node, "'%s' holds positions, and must have 'min' and 'max'",
                 gltf_where(gltf, a->node));
        return;
    }
    if (a->normalized || a->component != GLTF_FLOAT || a->count == 0 ||
        !gltf_get_numbers(gltf, a->node, "min", -HUGE_VAL, HUGE_VAL, 3, least) ||
        !gltf_get_numbers(gltf, a->node, "max", -HUGE_VAL, HUGE_VAL, 3, most))
        return;
    for (size_t i = 0; i < 3 * (size_t)a->count; i++) {
        low[i % 3] = elements[i] < low[i % 3] ? elements[i] : low[i % 3];
        high[i % 3] = elements[i] > high[i % 3] ? elements[i] : high[i % 3];
    }
    for (int k = 0; k < 3; k++) {
        const bool is_low = (float)low[k] != (float)least[k];
        if (!is_low && (float)high[k] == (float)most[k])
            continue;
        const json_index at = json_get(&gltf->json, a->node, is_low ? "min" : "max");
        gltf_add(gltf, DIAG_GLTF_RULE, at, "'%s' says %.9g of %c, and the %s of its data is %.9g",
                 gltf_where(gltf, at), is_low ? least[k] : most[k], "xyz"[k], is_low ? "least" : "largest",
                 is_low ? low[k] : high[k]);
        return;
    }
}

// Checks that all numbers are finite, and no larger than a scene allows.
static bool check_numbers(struct gltf *gltf, const struct gltf_accessor *a, const double *elements) {
    for (size_t i = 0; i < (size_t)a->count * a->components; i++) {
        if (fabs(elements[i]) <= 1e18)
            continue;
        gltf_add(gltf, DIAG_GLTF_DATA, a->node, "number %zu of element %zu of '%s' is %s", i % a->components,
                 i / a->components, gltf_where(gltf, a->node),
                 isfinite(elements[i]) ? "larger than 1e18" : "not a number, or infinite");
        return false;
    }
    return true;
}

static bool can_read(struct gltf *gltf, const struct gltf_accessor *a) {
    if (a->view == GLTF_NONE && a->count > gltf->most_elements) {
        gltf_add(gltf, DIAG_LIMIT, a->node,
                 "'%s' has %u elements and no bytes; the limit mesh-copies allows %llu",
                 gltf_where(gltf, a->node), a->count, (unsigned long long)gltf->most_elements);
        return false;
    }
    return check_sparse(gltf, a);
}

// The elements of an accessor, read and checked once; NULL: there is none, or it has an error.
static const double *elements_of(struct gltf *gltf, uint32_t accessor, bool is_position) {
    struct gltf_accessor *a = accessor == GLTF_NONE ? NULL : &gltf->accessors.items[accessor];
    if (!a || a->elements)
        return a ? a->elements : NULL;
    if (!can_read(gltf, a))
        return NULL;
    const double *elements = read_elements(gltf, a);
    if (!check_numbers(gltf, a, elements))
        return NULL;
    if (is_position)
        check_bounds(gltf, a, elements);
    a->elements = elements;
    return elements;
}

static const uint32_t *indices_of(struct gltf *gltf, uint32_t accessor) {
    struct gltf_accessor *a = accessor == GLTF_NONE ? NULL : &gltf->accessors.items[accessor];
    if (a && !a->indices && can_read(gltf, a))
        a->indices = read_indices(gltf, a);
    return a ? a->indices : NULL;
}

static uint32_t corner_count(const struct gltf *gltf, const struct gltf_primitive *p) {
    if (p->position == GLTF_NONE)
        return 0;
    return gltf->accessors.items[p->indices != GLTF_NONE ? p->indices : p->position].count;
}

static void check_count(struct gltf *gltf, const struct gltf_primitive *p) {
    const uint32_t count = corner_count(gltf, p);
    const bool fits = p->mode == GLTF_TRIANGLES ? count % 3 == 0 : count == 0 || count >= 3;
    if (!fits)
        gltf_add(gltf, DIAG_GLTF_RULE, p->node,
                 "'%s' draws triangles with %u corners: those at the end make none",
                 gltf_where(gltf, p->node), count);
}

static bool check_indices(struct gltf *gltf, const struct gltf_primitive *p, const uint32_t *indices,
                          uint32_t vertices) {
    const uint32_t count = gltf->accessors.items[p->indices].count;
    for (uint32_t i = 0; i < count; i++)
        if (indices[i] >= vertices) {
            gltf_add(gltf, DIAG_GLTF_DATA, p->node, "index %u of '%s' is %u, and there are %u vertices", i,
                     gltf_where(gltf, p->node), indices[i], vertices);
            return false;
        }
    return true;
}

// ---- triangles

uint64_t gltf_triangle_count(const struct gltf *gltf, const struct gltf_primitive *p) {
    const uint32_t count = corner_count(gltf, p);
    if (p->mode < GLTF_TRIANGLES || count < 3)
        return 0;
    return p->mode == GLTF_TRIANGLES ? count / 3 : count - 2;
}

static const uint32_t *corners_of(const struct gltf *gltf, const struct gltf_primitive *p,
                                  const uint32_t *indices, struct arena *arena) {
    const uint64_t triangles = gltf_triangle_count(gltf, p);
    if (indices && p->mode == GLTF_TRIANGLES)
        return indices;
    uint32_t *out = ARENA_ARRAY(arena, uint32_t, heap_times(3, triangles));
    for (uint64_t t = 0; t < triangles; t++) {
        const uint32_t i = (uint32_t)t, odd = i & 1;
        // In the specification's order, so that all faces of a strip face the same way.
        uint32_t at[3] = {3 * i, 3 * i + 1, 3 * i + 2};
        if (p->mode == GLTF_TRIANGLE_STRIP) {
            at[0] = i;
            at[1] = i + 1 + odd;
            at[2] = i + 2 - odd;
        } else if (p->mode == GLTF_TRIANGLE_FAN) {
            at[0] = i + 1;
            at[1] = i + 2;
            at[2] = 0;
        }
        for (size_t k = 0; k < 3; k++)
            out[3 * t + k] = indices ? indices[at[k]] : at[k];
    }
    return out;
}

bool gltf_read_primitive(struct gltf *gltf, const struct gltf_primitive *p, struct arena *arena,
                         struct gltf_geometry *out) {
    const uint32_t errors = gltf->errors;
    *out = (struct gltf_geometry){0};
    if (gltf_triangle_count(gltf, p) == 0)
        return true;
    check_count(gltf, p);
    out->vertices = gltf->accessors.items[p->position].count;
    out->positions = elements_of(gltf, p->position, true);
    out->normals = elements_of(gltf, p->normal, false);
    for (int i = 0; i < GLTF_COORDINATE_SETS; i++)
        out->coordinates[i] = elements_of(gltf, p->coordinates[i], false);
    const uint32_t *indices = indices_of(gltf, p->indices);
    if (gltf->errors > errors || (indices && !check_indices(gltf, p, indices, out->vertices)))
        return false;
    out->triangles = (uint32_t)gltf_triangle_count(gltf, p);
    out->corners = corners_of(gltf, p, indices, arena);
    return true;
}
