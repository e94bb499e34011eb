// Decides which triangles of a mesh its instances share.
//
// An instance must show what a copy would, bit for bit, and flattening drops triangles that rounding leaves
// without area. So it is asked about each triangle that is low enough in some model: what it drops in none is
// shared, what it drops in all is left out, and only what some models show and others do not is copied for
// each. If that is too much, all models are copies.
#include "core/heap.h"
#include "core/parallel.h"
#include "core/quantile.h"
#include "tracer/flatten/flatten_internal.h"

#include <math.h>
#include <stdlib.h>

// A triangle whose least height exceeds so many units of the last place has an area. With u = 2^-24 or 2^-53,
// corners of up to R and edges of up to L: a rounded corner is off by uR along an axis, an edge by 2uR + uL.
// That changes a component of the cross product of two edges by at most 4 sqrt(2) uRL + (2 sqrt(2) + 2) uL^2,
// with its own rounding; its largest is at least the height times L/sqrt(3): 9.8 uR + 8.4 uL. In double
// precision what maps the corners rounds as coarsely.
#define REACH_UNITS   11.0
#define EDGE_UNITS    9.0
#define REACH_UNITS64 64.0
#define UNIT          0x1p-24
#define UNIT64        0x1p-53
// More than a COPIED_PART-th of a mesh's triangles is too much to copy for each instance.
#define COPIED_PART 32
// How different scales may be in different directions; with numbers within these bounds all operations on
// them, also the device's, stay away from the limits of doubles.
#define UNEVEN_MOST  1e4
#define NUMBER_LEAST 0x1p-200
#define NUMBER_MOST  0x1p200

enum {
    PIECE = 8192,
    PIECE_LOW = 16,
};

struct use {
    const struct scene_body *body;
    affine3 map;
    double critical; // the height at which triangles may lose their area; negative: cannot be an instance
};

// Of a triangle that is low in some model.
enum fate {
    FATE_SHOWN, // in every model
    FATE_GONE,  // in none
    FATE_MIXED,
};

struct judging {
    struct flattening *f;
    struct shared_mesh *shared;
    double *height, *sorted; // by triangle
    double longest;          // edge
    struct use *uses;
    uint32_t *low; // triangles that are low in some instance, ascending
    enum fate *fate;
    uint32_t low_count;
};

// ---- the mesh

static void edges_of(const struct mesh *mesh, size_t triangle, vec3 edges[3]) {
    const uint32_t *corners = mesh->triangles[triangle].corners;
    for (int k = 0; k < 3; k++)
        edges[k] = vec3_sub(mesh->positions[corners[(k + 1) % 3]], mesh->positions[corners[k]]);
}

static double longest_of(const vec3 edges[3]) {
    return fmax(vec3_length(edges[0]), fmax(vec3_length(edges[1]), vec3_length(edges[2])));
}

static void measure_heights(void *context, size_t begin, size_t end) {
    const struct judging *j = context;
    for (size_t i = begin; i < end; i++) {
        vec3 edges[3];
        edges_of(j->shared->mesh, i, edges);
        const double longest = longest_of(edges);
        j->height[i] = longest > 0 ? vec3_length(vec3_cross(edges[0], edges[2])) / longest : 0;
        j->sorted[i] = longest;
    }
}

// Two of its corners are one: it has no area anywhere.
static bool is_needle(const struct mesh *mesh, size_t triangle) {
    vec3 edges[3];
    edges_of(mesh, triangle, edges);
    return !(vec3_max_abs(edges[0]) > 0 && vec3_max_abs(edges[1]) > 0 && vec3_max_abs(edges[2]) > 0);
}

static bool is_moderate(double value) {
    return value == 0 || (fabs(value) >= NUMBER_LEAST && fabs(value) <= NUMBER_MOST);
}

static bool is_moderate3(vec3 v) {
    return is_moderate(v.x) && is_moderate(v.y) && is_moderate(v.z);
}

static bool has_moderate_positions(const struct mesh *mesh) {
    for (uint32_t i = 0; i < mesh->position_count; i++)
        if (!is_moderate3(mesh->positions[i]))
            return false;
    return true;
}

static void measure_mesh(struct judging *j) {
    const uint32_t count = j->shared->mesh->triangle_count;
    parallel_for(count, PIECE, measure_heights, j);
    for (uint32_t i = 0; i < count; i++) {
        j->longest = fmax(j->longest, j->sorted[i]);
        j->sorted[i] = j->height[i];
    }
    quantile_sort(j->sorted, count);
}

// How many of the sorted heights are at most `most`.
static uint32_t count_lower(const double *sorted, uint32_t count, double most) {
    uint32_t low = 0, high = count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (sorted[middle] <= most)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

// ---- models

static double frobenius(const mat3 *m) {
    double sum = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            sum += m->m[i][k] * m->m[i][k];
    return sqrt(sum);
}

static bool is_even(const struct flattening *f, const affine3 *map, double inverse) {
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            if (!is_moderate(map->linear.m[i][k] * f->factor))
                return false;
    const double product = frobenius(&map->linear) * inverse;
    return is_moderate3(vec3_mul(map->offset, f->factor)) && product <= UNEVEN_MOST;
}

// By how much a map lengthens anything at most: the norm of M^T M bounds the square.
static double most_scale(const mat3 *m) {
    double most = 0;
    for (int i = 0; i < 3; i++) {
        double sum = 0;
        for (int k = 0; k < 3; k++)
            sum += fabs(vec3_dot(mat3_column(*m, i), mat3_column(*m, k)));
        most = fmax(most, sum);
    }
    return sqrt(most);
}

static struct use use_of(const struct judging *j, uint32_t body) {
    const struct flattening *f = j->f;
    struct use use = {.body = &f->scene->bodies[body], .critical = -1};
    use.map = flatten_map(f, use.body);
    const affine3 back = transform_inverse(use.map);
    const double reach = flatten_reach(f, use.body), edge = j->longest * most_scale(&use.map.linear);
    if (is_even(f, &use.map, frobenius(&back.linear)))
        use.critical =
            most_scale(&back.linear) * (f->out->is_double ? REACH_UNITS64 * UNIT64 * reach
                                                          : UNIT * (REACH_UNITS * reach + EDGE_UNITS * edge));
    return use;
}

// Marks the models that are instances with 1, and records why the others are not. The height at which
// triangles may lose their area in any of them; negative: there is none.
static double choose_models(struct judging *j) {
    struct sharing *sharing = &j->f->sharing;
    struct shared_mesh *shared = j->shared;
    double most = -1;
    for (uint32_t i = 0; i < shared->use_count; i++) {
        const uint32_t body = sharing->uses[shared->first_use + i];
        const struct use use = use_of(j, body);
        if (use.critical >= 0) {
            sharing->instance[body] = 1;
            j->uses[shared->instances++] = use;
            most = fmax(most, use.critical);
        } else {
            shared->reason = FLAT_REASON_UNEVEN;
        }
    }
    return most;
}

// ---- the triangles

static enum fate fate_of(const struct judging *j, uint32_t triangle) {
    bool shown = false, gone = false;
    if (is_needle(j->shared->mesh, triangle))
        return FATE_GONE;
    for (uint32_t i = 0; i < j->shared->instances && !(shown && gone); i++) {
        const struct use *use = &j->uses[i];
        const bool shows = j->height[triangle] > use->critical ||
                           flatten_corners(j->f, use->body, &use->map, triangle).has_area;
        shown |= shows;
        gone |= !shows;
    }
    return shown && gone ? FATE_MIXED : gone ? FATE_GONE : FATE_SHOWN;
}

static void judge_low(void *context, size_t begin, size_t end) {
    const struct judging *j = context;
    for (size_t i = begin; i < end; i++)
        j->fate[i] = fate_of(j, j->low[i]);
}

void flatten_keep_copies(struct flattening *f, struct shared_mesh *shared, enum flat_reason reason) {
    for (uint32_t i = 0; i < shared->use_count; i++)
        f->sharing.instance[f->sharing.uses[shared->first_use + i]] = 0;
    if (shared->instances)
        shared->reason = reason;
    shared->instances = shared->copied_count = shared->left_out_count = 0;
}

static bool judge_triangles(struct judging *j, double most) {
    struct shared_mesh *shared = j->shared;
    const uint32_t count = shared->mesh->triangle_count;
    const size_t room = (size_t)count_lower(j->sorted, count, most) + 1;
    j->low = heap_array(room, sizeof *j->low);
    j->fate = heap_array(room, sizeof *j->fate);
    shared->copied = heap_array(room, sizeof *shared->copied);
    shared->left_out = heap_array(room, sizeof *shared->left_out);
    if (!j->low || !j->fate || !shared->copied || !shared->left_out)
        return false;
    for (uint32_t i = 0; i < count; i++)
        if (j->height[i] <= most)
            j->low[j->low_count++] = i;
    parallel_for(j->low_count, PIECE_LOW, judge_low, j);
    for (uint32_t i = 0; i < j->low_count; i++) {
        if (j->fate[i] == FATE_MIXED)
            shared->copied[shared->copied_count++] = j->low[i];
        if (j->fate[i] == FATE_GONE)
            shared->left_out[shared->left_out_count++] = j->low[i];
    }
    if (shared->copied_count > count / COPIED_PART)
        flatten_keep_copies(j->f, shared, FLAT_REASON_THIN);
    return true;
}

enum flatten_fault flatten_judge(struct flattening *f, struct shared_mesh *shared) {
    const size_t count = shared->mesh->triangle_count;
    struct judging j = {.f = f, .shared = shared};
    if (!has_moderate_positions(shared->mesh)) {
        shared->reason = FLAT_REASON_UNEVEN;
        return FLATTEN_DONE;
    }
    j.height = heap_array(heap_times(2, count + 1), sizeof *j.height);
    j.uses = heap_array((size_t)shared->use_count + 1, sizeof *j.uses);
    bool done = j.height && j.uses;
    if (done) {
        j.sorted = j.height + count;
        measure_mesh(&j);
        done = judge_triangles(&j, choose_models(&j));
    }
    free(j.low);
    free(j.fate);
    free(j.uses);
    free(j.height);
    return done ? FLATTEN_DONE : FLATTEN_NO_MEMORY;
}
