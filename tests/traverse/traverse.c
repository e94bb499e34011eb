#include "tests/traverse/traverse.h"

#include "shaders/gpu_scene.h"
#include "shaders/records.h"
#include "tracer/bvh/bvh.h"
#include "tracer/bvh/items.h"

#include <math.h>
#include <string.h>

// Direction components nearer to 0 count as this, so that quotients stay finite.
#define DIRECTION_LEAST 1.0e-20f
// Higham's bound on the relative error of n roundings.
#define GAMMA(n) ((n)*0x1p-24f / (1 - (n)*0x1p-24f))

struct setup {
    const struct traverse_ray *ray;
    float inverse[3];
    uint32_t octant;
    int kx, ky, kz; // kz is where the direction is largest
    float sx, sy, sz;
};

// Children of one node that are still to be visited.
struct group {
    uint32_t first; // node
    uint32_t mask;  // which slots are nodes
    uint32_t hits;  // bit slot ^ octant
};

static float float_of(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static struct setup setup_make(const struct traverse_ray *ray) {
    struct setup s = {.ray = ray};
    const float *d = ray->direction;
    for (int axis = 0; axis < 3; axis++) {
        float component = fabsf(d[axis]) < DIRECTION_LEAST ? copysignf(DIRECTION_LEAST, d[axis]) : d[axis];
        s.inverse[axis] = 1 / component;
        if (component < 0)
            s.octant |= 4u >> axis;
    }
    float size[3] = {fabsf(d[0]), fabsf(d[1]), fabsf(d[2])};
    s.kz = size[2] >= size[0] && size[2] >= size[1] ? 2 : size[0] >= size[1] ? 0 : 1;
    s.kx = (s.kz + 1) % 3;
    s.ky = (s.kz + 2) % 3;
    s.sz = 1 / d[s.kz];
    s.sx = d[s.kx] * s.sz;
    s.sy = d[s.ky] * s.sz;
    return s;
}

static uint32_t byte_of(uint32_t first, uint32_t second, int slot) {
    return (slot < 4 ? first : second) >> (slot % 4 * 8) & 255;
}

// Where the ray enters and leaves a slot's box.
static bool meets_box(const struct setup *s, const struct gpu_word *n, int slot, float far) {
    const uint32_t origin[3] = {n[0].x, n[0].y, n[0].z};
    const uint32_t low[3][2] = {{n[2].x, n[2].y}, {n[2].z, n[2].w}, {n[3].x, n[3].y}};
    const uint32_t high[3][2] = {{n[3].z, n[3].w}, {n[4].x, n[4].y}, {n[4].z, n[4].w}};
    float enter = 0;
    float leave = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        float quantum = float_of((n[0].w >> (8 * axis) & 255) << 23);
        float base = (float_of(origin[axis]) - s->ray->origin[axis]) * s->inverse[axis];
        float step = quantum * s->inverse[axis];
        float below = base + (float)byte_of(low[axis][0], low[axis][1], slot) * step;
        float above = base + (float)byte_of(high[axis][0], high[axis][1], slot) * step;
        bool is_negative = s->inverse[axis] < 0;
        enter = fmaxf(enter, is_negative ? above : below);
        leave = fminf(leave, is_negative ? below : above);
    }
    return enter <= fminf(leave * (float)BOX_FAR_SCALE, far);
}

// x and y sheared so that the ray is the z axis; z as it is.
static void shear(const struct setup *s, const struct gpu_word *vertex, float out[3]) {
    const uint32_t bits[3] = {vertex->x, vertex->y, vertex->z};
    out[2] = float_of(bits[s->kz]) - s->ray->origin[s->kz];
    out[0] = float_of(bits[s->kx]) - s->ray->origin[s->kx] - s->sx * out[2];
    out[1] = float_of(bits[s->ky]) - s->ray->origin[s->ky] - s->sy * out[2];
}

static float largest(float a, float b, float c) {
    return fmaxf(fmaxf(fabsf(a), fabsf(b)), fabsf(c));
}

// What a distance must exceed to be surely positive: Pharr, Jakob, Humphreys 2023, section 6.8.7, but for
// one factor. t is a mean of the vertices' z, so an error of its weights moves it by their spread at most,
// not by their size: with the size, small triangles far away would all be refused.
static float distance_bound(const struct setup *s, const float a[3], const float b[3], const float c[3],
                            const float edges[3], float inverse) {
    float x = largest(a[0], b[0], c[0]);
    float y = largest(a[1], b[1], c[1]);
    float z = largest(a[2], b[2], c[2]);
    float spread = fmaxf(fmaxf(a[2], b[2]), c[2]) - fminf(fminf(a[2], b[2]), c[2]);
    float delta_x = GAMMA(5) * (x + z);
    float delta_y = GAMMA(5) * (y + z);
    float delta_e = 2 * (GAMMA(2) * x * y + delta_y * x + delta_x * y);
    float e = largest(edges[0], edges[1], edges[2]);
    return 3 * (2 * GAMMA(3) * e * z + delta_e * spread) * fabsf(s->sz * inverse);
}

static bool meets_triangle(const struct setup *s, const struct gpu_word *words, float *distance,
                           float weights[3]) {
    float a[3], b[3], c[3];
    shear(s, &words[0], a);
    shear(s, &words[1], b);
    shear(s, &words[2], c);
    float e[3] = {c[0] * b[1] - c[1] * b[0], a[0] * c[1] - a[1] * c[0], b[0] * a[1] - b[1] * a[0]};
    if ((e[0] < 0 || e[1] < 0 || e[2] < 0) && (e[0] > 0 || e[1] > 0 || e[2] > 0))
        return false;
    float determinant = e[0] + e[1] + e[2];
    if (determinant == 0)
        return false;
    float inverse = 1 / determinant;
    *distance = (e[0] * (s->sz * a[2]) + e[1] * (s->sz * b[2]) + e[2] * (s->sz * c[2])) * inverse;
    for (int i = 0; i < 3; i++)
        weights[i] = e[i] * inverse;
    return *distance > distance_bound(s, a, b, c, e, inverse) && *distance < s->ray->far;
}

// Tests a leaf's items; keeps the nearest.
static bool visit_leaf(const struct setup *s, const struct gpu_word *triangles, uint32_t first,
                       uint32_t count, struct traverse_hit *hit) {
    bool found = false;
    for (uint32_t item = first; item < first + count; item++) {
        const struct gpu_word *words = triangles + (size_t)TRIANGLE_WORDS * item;
        float distance, weights[3];
        hit->items_read++;
        if (!meets_triangle(s, words, &distance, weights) ||
            !(distance < hit->distance || (distance == hit->distance && words[0].w < hit->triangle)))
            continue;
        hit->distance = distance;
        memcpy(hit->weights, weights, sizeof weights);
        hit->item = item;
        hit->triangle = words[0].w;
        found = true;
    }
    return found;
}

// Opens a node: its leaves are tested at once, its children that are nodes become a group.
static bool visit_node(const struct setup *s, const struct traverse_scene *scene, uint32_t index,
                       struct group *group, struct traverse_hit *hit) {
    const struct gpu_word *n = scene->nodes + (size_t)NODE_WORDS * index;
    bool found = false;
    hit->nodes_read++;
    *group = (struct group){n[1].x, n[0].w >> 24, 0};
    for (uint32_t order = 0; order < BVH_WIDTH; order++) {
        int slot = (int)(order ^ s->octant);
        uint32_t meta = byte_of(n[1].z, n[1].w, slot);
        if (!meta || !meets_box(s, n, slot, hit->distance))
            continue;
        if (group->mask >> slot & 1)
            group->hits |= 1u << order;
        else
            found |= visit_leaf(s, scene->triangles, n[1].y + (meta & 31),
                                (meta >> 5 & 1) + (meta >> 6 & 1) + (meta >> 7 & 1), hit);
    }
    return found;
}

static bool traverse(const struct traverse_scene *scene, const struct traverse_ray *ray, bool any,
                     struct traverse_hit *hit) {
    struct setup s = setup_make(ray);
    struct group stack[BVH_DEPTH_MAX];
    uint32_t depth = 0;
    uint32_t node = 0;
    bool found = false;
    *hit = (struct traverse_hit){.distance = ray->far, .triangle = UINT32_MAX};
    for (;;) {
        struct group group;
        found |= visit_node(&s, scene, node, &group, hit);
        if (found && any)
            return true;
        if (group.hits)
            stack[depth++] = group;
        if (!depth)
            return found;
        struct group *top = &stack[depth - 1];
        uint32_t order = 0;
        while (!(top->hits >> order & 1))
            order++;
        top->hits &= ~(1u << order);
        uint32_t slot = order ^ s.octant;
        node = top->first;
        for (uint32_t before = 0; before < slot; before++)
            node += top->mask >> before & 1;
        if (!top->hits)
            depth--;
    }
}

bool traverse_closest(const struct traverse_scene *scene, const struct traverse_ray *ray,
                      struct traverse_hit *hit) {
    return traverse(scene, ray, false, hit);
}

bool traverse_any(const struct traverse_scene *scene, const struct traverse_ray *ray) {
    struct traverse_hit hit;
    return traverse(scene, ray, true, &hit);
}

struct bvh_item traverse_item(const struct gpu_word *words, uint32_t index) {
    vec3 corners[3];
    for (int k = 0; k < 3; k++) {
        float place[3];
        memcpy(place, &words[k], sizeof place);
        corners[k] = (vec3){place[0], place[1], place[2]};
    }
    return bvh_triangle_item(corners, false, index);
}
