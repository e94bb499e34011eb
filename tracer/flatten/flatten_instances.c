// Instances on the device (shaders/gpu_scene.h): a tree for each mesh that is shared, in a space of its own
// where coordinates stay below 2, and a tree over the boxes of all instances.
//
// A record's rows and offsets are those with which flattening maps a vertex, times the scale, a power of two:
// products, sums and their rounding give the same bits before and after scaling (flatten_share.c keeps
// numbers out of the range where they would not).
#include "core/clock.h"
#include "core/heap.h"
#include "core/parallel.h"
#include "core/quantile.h"
#include "tracer/bvh/items.h"
#include "tracer/flatten/flatten_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    PIECE = 8192,
    SHIFT_MOST = 12,
    ITEM_BITS = 30, // the highest bit is ITEM_SPHERE's, and blocks are not full
};

// The possible errors of the transformed ray and of the host's inverse, in units of the numbers that they are
// made of: each component is a sum of three products and an offset, by rounded factors; then a box subtracts
// and divides (docs/decisions/instances.md).
#define EDGES_PART    0.95
#define RAY_UNITS     32.0
#define INVERSE_UNITS 32.0   // in double, times the map's condition
#define PAD_MORE      1.0625 // of the pad of flattened boxes: its own roundings
#define UNIT          0x1p-24
#define UNIT64        0x1p-53
// Covers the rounding of values that are next rounded outward to a float.
#define ABOVE 1.000001

struct placing {
    struct flattening *f;
    struct gpu_word *records; // of the instances
    struct bvh_item *items;   // of the upper tree
    struct gpu_word *leaves;  // of it, as nodes
    uint32_t words;           // of a record
    uint32_t *block;          // by instance: its first block of items, then how many there are
    struct {
        uint32_t *values;
        uint32_t count, capacity;
    } shades;
};

// ---- a mesh's own tree

struct mesh_filling {
    const struct shared_mesh *shared;
    const bool *is_apart; // by triangle: it is not shared
    struct gpu_word *records;
    struct bvh_item *items;
};

static vec3 tree_space(const struct shared_mesh *shared, vec3 position) {
    const vec3 v = vec3_sub(position, shared->middle);
    return (vec3){ldexp(v.x, shared->exponent), ldexp(v.y, shared->exponent), ldexp(v.z, shared->exponent)};
}

// An edge length that few triangles exceed; negative: no memory.
static double usual_edge(const struct mesh *mesh) {
    double *longest = heap_zeroed((size_t)mesh->triangle_count + 1, sizeof *longest);
    if (!longest)
        return -1;
    for (uint32_t i = 0; i < mesh->triangle_count; i++)
        for (int k = 0; k < 3; k++) {
            const uint32_t *corners = mesh->triangles[i].corners;
            longest[i] = fmax(longest[i], vec3_length(vec3_sub(mesh->positions[corners[(k + 1) % 3]],
                                                               mesh->positions[corners[k]])));
        }
    quantile_sort(longest, mesh->triangle_count);
    const double edge = longest[(size_t)((mesh->triangle_count - 1) * EDGES_PART)];
    free(longest);
    return edge;
}

static void choose_space(struct shared_mesh *shared) {
    const struct mesh *mesh = shared->mesh;
    const vec3 half = vec3_mul(vec3_sub(mesh->upper, mesh->lower), 0.5);
    shared->middle = vec3_add(mesh->lower, half);
    shared->exponent = vec3_max_abs(half) > 0 ? -ilogb(vec3_max_abs(half)) : 0;
    shared->farthest = fmax(vec3_max_abs(mesh->lower), vec3_max_abs(mesh->upper));
}

static struct gpu_placed placed_of(const struct mesh *mesh, uint32_t triangle) {
    const struct mesh_triangle *is = &mesh->triangles[triangle];
    const vec3 p[3] = {mesh->positions[is->corners[0]], mesh->positions[is->corners[1]],
                       mesh->positions[is->corners[2]]};
    return (struct gpu_placed){.v0_x = p[0].x,
                               .v0_y = p[0].y,
                               .v0_z = p[0].z,
                               .v1_x = p[1].x,
                               .v1_y = p[1].y,
                               .v1_z = p[1].z,
                               .v2_x = p[2].x,
                               .v2_y = p[2].y,
                               .v2_z = p[2].z,
                               .number = triangle,
                               .shade = is->group};
}

static struct bvh_item item_of(const struct shared_mesh *shared, uint32_t triangle) {
    const struct mesh *mesh = shared->mesh;
    const double error = ldexp(ldexp(shared->farthest, shared->exponent) + 2, -50);
    const vec3 pad = {error, error, error};
    vec3 lower = {INFINITY, INFINITY, INFINITY}, upper = {-INFINITY, -INFINITY, -INFINITY};
    for (int k = 0; k < 3; k++) {
        const vec3 p = tree_space(shared, mesh->positions[mesh->triangles[triangle].corners[k]]);
        lower = vec3_min(lower, p);
        upper = vec3_max(upper, p);
    }
    return bvh_wide_item(vec3_sub(lower, pad), vec3_add(upper, pad), triangle);
}

static void fill_mesh(void *context, size_t begin, size_t end) {
    const struct mesh_filling *m = context;
    for (size_t i = begin; i < end; i++) {
        const struct gpu_placed record = placed_of(m->shared->mesh, (uint32_t)i);
        gpu_pack_placed(&record, m->records + i * PLACED_WORDS);
        m->items[i] = item_of(m->shared, (uint32_t)i);
        m->items[i].spare = m->is_apart[i];
    }
}

// Appends the contents of `from` to `to`.
static bool append(struct flat_array *to, const struct gpu_word *from, uint64_t count) {
    struct gpu_word *words = heap_resize_array(to->words, to->count + count + 1, sizeof *words);
    if (!words)
        return false;
    memcpy(words + to->count, from, count * sizeof *words);
    to->words = words;
    to->count += count;
    return true;
}

static bool append_records(struct flat_array *to, const struct gpu_word *records, const uint32_t *order,
                           uint32_t count) {
    struct gpu_word *words =
        heap_resize_array(to->words, to->count + heap_times(count, PLACED_WORDS) + 1, sizeof *words);
    if (!words)
        return false;
    to->words = words;
    for (uint32_t i = 0; i < count; i++, to->count += PLACED_WORDS)
        memcpy(words + to->count, records + (size_t)order[i] * PLACED_WORDS, PLACED_WORDS * sizeof *words);
    return true;
}

static bool keep_tree(struct flattening *f, struct shared_mesh *shared, struct bvh *bvh,
                      const struct gpu_word *records) {
    struct flat_scene *out = f->out;
    shared->root = (uint32_t)(out->triangle_nodes.count / NODE_WORDS);
    shared->first_record = (uint32_t)(out->triangles.count / PLACED_WORDS);
    shared->count = bvh->item_count;
    shared->boxes = heap_array(BVH_BOUNDS_MOST, sizeof *shared->boxes);
    if (!shared->boxes)
        return false;
    shared->box_count = bvh_first_bounds(bvh, shared->boxes);
    bvh_move(bvh, shared->root, shared->first_record);
    out->triangle_depth = bvh->depth > out->triangle_depth ? bvh->depth : out->triangle_depth;
    out->triangle_count += bvh->item_count;
    return append(&out->triangle_nodes, bvh->nodes, (uint64_t)bvh->node_count * NODE_WORDS) &&
           append_records(&out->triangles, records, bvh->order, bvh->item_count);
}

static bool build_mesh(struct flattening *f, struct shared_mesh *shared, const struct mesh_filling *filling) {
    uint32_t count = 0;
    struct bvh bvh;
    parallel_for(shared->mesh->triangle_count, PIECE, fill_mesh, (void *)filling);
    for (uint32_t i = 0; i < shared->mesh->triangle_count; i++)
        if (!filling->items[i].spare)
            filling->items[count++] = filling->items[i];
    const double start = clock_seconds();
    if (!bvh_build_kept(f->input->keep, filling->items, count, f->input->method, &bvh))
        return false;
    f->out->build_seconds += clock_seconds() - start;
    const bool done = keep_tree(f, shared, &bvh, filling->records);
    bvh_finish(&bvh);
    return done;
}

static enum flatten_fault make_mesh(struct flattening *f, struct shared_mesh *shared) {
    const size_t count = shared->mesh->triangle_count;
    bool *is_apart = heap_zeroed(count + 1, sizeof *is_apart);
    struct mesh_filling filling = {
        .shared = shared,
        .is_apart = is_apart,
        .records = heap_array(heap_times(count + 1, PLACED_WORDS), sizeof(struct gpu_word)),
        .items = heap_array(count + 1, sizeof *filling.items)};
    bool done = is_apart && filling.records && filling.items;
    choose_space(shared);
    shared->edge = usual_edge(shared->mesh);
    done = done && shared->edge >= 0;
    if (done) {
        for (uint32_t i = 0; i < shared->copied_count; i++)
            is_apart[shared->copied[i]] = true;
        for (uint32_t i = 0; i < shared->left_out_count; i++)
            is_apart[shared->left_out[i]] = true;
        done = build_mesh(f, shared, &filling);
    }
    free(filling.items);
    free(filling.records);
    free(is_apart);
    return done ? FLATTEN_DONE : FLATTEN_NO_MEMORY;
}

// ---- records

// From flat space to a mesh's tree.
static affine3 entry_map(const struct shared_mesh *shared, affine3 flat) {
    affine3 map = transform_inverse(flat);
    map.offset = vec3_sub(map.offset, shared->middle);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            map.linear.m[i][k] = ldexp(map.linear.m[i][k], shared->exponent);
    map.offset = (vec3){ldexp(map.offset.x, shared->exponent), ldexp(map.offset.y, shared->exponent),
                        ldexp(map.offset.z, shared->exponent)};
    return map;
}

static double largest_row(const mat3 *m) {
    double most = 0;
    for (int i = 0; i < 3; i++)
        most = fmax(most, fabs(m->m[i][0]) + fabs(m->m[i][1]) + fabs(m->m[i][2]));
    return most;
}

// An upper bound on how much a map lengthens anything: the square root of the product of two norms.
static double largest_scale(const mat3 *m) {
    mat3 turned;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            turned.m[i][k] = m->m[k][i];
    return sqrt(largest_row(m) * largest_row(&turned));
}

// `reach`: largest coordinate of the instance.
static struct gpu_entry entry_of(const struct flattening *f, const struct shared_mesh *shared, affine3 flat,
                                 double reach) {
    const affine3 map = entry_map(shared, flat);
    const double condition = largest_row(&flat.linear) * ldexp(largest_row(&map.linear), -shared->exponent);
    const double inverse = INVERSE_UNITS * condition * UNIT64;
    const double unit = (RAY_UNITS * (f->out->is_double ? UNIT64 : UNIT) + inverse) * ABOVE;
    const double middle = ldexp(shared->farthest, shared->exponent);
    return (struct gpu_entry){.row_x = mat3_row(map.linear, 0),
                              .row_y = mat3_row(map.linear, 1),
                              .row_z = mat3_row(map.linear, 2),
                              .offset_x = map.offset.x,
                              .offset_y = map.offset.y,
                              .offset_z = map.offset.z,
                              .reach = (bvh_pad(f->out->is_double) * PAD_MORE + unit) * reach * ABOVE,
                              .unit = unit,
                              .edge = shared->edge * largest_scale(&flat.linear) * ABOVE,
                              .margin = unit * (vec3_max_abs(map.offset) + middle + 2) * ABOVE};
}

static affine3 flat_map(const struct flattening *f, const struct scene_body *body) {
    affine3 map = flatten_map(f, body);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            map.linear.m[i][k] *= f->factor;
    map.offset = vec3_mul(map.offset, f->factor);
    return map;
}

static struct gpu_instance instance_of(const affine3 *flat, const mat3 *turn) {
    const double(*m)[3] = flat->linear.m, (*t)[3] = turn->m;
    return (struct gpu_instance){.x_x = m[0][0],
                                 .x_y = m[0][1],
                                 .x_z = m[0][2],
                                 .x_offset = flat->offset.x,
                                 .y_x = m[1][0],
                                 .y_y = m[1][1],
                                 .y_z = m[1][2],
                                 .y_offset = flat->offset.y,
                                 .z_x = m[2][0],
                                 .z_y = m[2][1],
                                 .z_z = m[2][2],
                                 .z_offset = flat->offset.z,
                                 .turn_x_x = t[0][0],
                                 .turn_x_y = t[0][1],
                                 .turn_x_z = t[0][2],
                                 .turn_y_x = t[1][0],
                                 .turn_y_y = t[1][1],
                                 .turn_y_z = t[1][2],
                                 .turn_z_x = t[2][0],
                                 .turn_z_y = t[2][1],
                                 .turn_z_z = t[2][2]};
}

static bool add_shade(struct placing *p, uint32_t shade) {
    uint32_t *values = heap_grow(p->shades.values, p->shades.count, &p->shades.capacity, sizeof *values);
    if (!values)
        return false;
    p->shades.values = values;
    values[p->shades.count++] = shade;
    return true;
}

// Adds the shades of a body's groups; reuses those of the previous body if they are the same.
static bool add_shades(struct placing *p, const struct scene_body *body, uint32_t *first) {
    const uint32_t last = p->shades.count;
    for (uint32_t i = 0; i < body->group_count; i++)
        if (!add_shade(p, flatten_group_shade(p->f, body, i)))
            return false;
    *first = last;
    if (last >= body->group_count &&
        memcmp(p->shades.values + last - body->group_count, p->shades.values + last,
               body->group_count * sizeof *p->shades.values) == 0) {
        *first = last - body->group_count;
        p->shades.count = last;
    }
    return true;
}

// The box of an instance, from its tree's boxes.
static void bound(const struct shared_mesh *shared, const affine3 *flat, vec3 *lower, vec3 *upper) {
    *lower = (vec3){INFINITY, INFINITY, INFINITY};
    *upper = (vec3){-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < shared->box_count; i++) {
        const struct bvh_bounds *box = &shared->boxes[i];
        double middle[3], half[3];
        for (int k = 0; k < 3; k++) {
            middle[k] = ldexp(box->lower[k] + box->upper[k], -shared->exponent - 1);
            half[k] = ldexp(box->upper[k] - box->lower[k], -shared->exponent - 1);
        }
        const vec3 centre =
            affine3_apply(*flat, vec3_add(shared->middle, (vec3){middle[0], middle[1], middle[2]}));
        vec3 arm;
        double *to[3] = {&arm.x, &arm.y, &arm.z};
        for (int k = 0; k < 3; k++)
            *to[k] = fabs(flat->linear.m[k][0]) * half[0] + fabs(flat->linear.m[k][1]) * half[1] +
                     fabs(flat->linear.m[k][2]) * half[2];
        *lower = vec3_min(*lower, vec3_sub(centre, arm));
        *upper = vec3_max(*upper, vec3_add(centre, arm));
    }
}

static void put_leaf(struct placing *p, uint32_t instance, uint32_t root) {
    const struct gpu_node node = {.first_node = root, .first_item = instance};
    gpu_pack_node(&node, false, p->leaves + (size_t)NODE_WORDS * instance);
}

static void put_record(struct placing *p, uint32_t instance, const struct gpu_entry *entry,
                       const struct gpu_instance *record) {
    struct gpu_word *words = p->records + (size_t)p->words * instance;
    gpu_pack_entry(entry, p->f->out->is_double, words);
    gpu_pack_instance(record, words + p->words - INSTANCE_WORDS);
}

static bool place_body(struct placing *p, uint32_t number, uint32_t shift) {
    const struct flattening *f = p->f;
    const struct scene_body *body = &f->scene->bodies[number];
    const struct shared_mesh *shared = flatten_shared(f, number);
    const uint32_t instance = f->sharing.instance[number];
    const affine3 flat = flat_map(f, body);
    const mat3 turn = transform_for_normals(body->object_to_world.linear);
    vec3 lower, upper;
    bound(shared, &flat, &lower, &upper);
    const struct gpu_entry entry = entry_of(f, shared, flat, fmax(vec3_max_abs(lower), vec3_max_abs(upper)));
    struct gpu_instance record = instance_of(&flat, &turn);
    record.first_item = (p->block[instance] << shift) - shared->first_record;
    record.first_number = f->out->first_triangle[number];
    record.flags = body->mirrored ? INSTANCE_MIRRORED : 0;
    record.body = number;
    if (!add_shades(p, body, &record.shades))
        return false;
    put_record(p, instance, &entry, &record);
    put_leaf(p, instance, shared->root);
    p->items[instance] = bvh_box_item(lower, upper, f->out->is_double, instance);
    return true;
}

// Instance 0: everything that is copied, unmoved.
static void place_copied(struct placing *p, uint32_t root) {
    static const affine3 same = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}};
    const struct gpu_entry entry = {.row_x = {1, 0, 0}, .row_y = {0, 1, 0}, .row_z = {0, 0, 1}};
    struct gpu_instance record = instance_of(&same, &same.linear);
    record.flags = INSTANCE_COPIED;
    put_record(p, 0, &entry, &record);
    put_leaf(p, 0, root);
}

// ---- numbers of items

static uint64_t count_blocks(const struct placing *p, uint32_t shift) {
    const struct flattening *f = p->f;
    const uint64_t round = (UINT64_C(1) << shift) - 1;
    uint64_t blocks = (f->item_count + round) >> shift;
    p->block[0] = 0;
    for (uint32_t i = 0; i < f->scene->body_count; i++) {
        const struct shared_mesh *shared = flatten_shared(f, i);
        if (!shared)
            continue;
        p->block[f->sharing.instance[i]] = (uint32_t)blocks;
        blocks += (shared->count + round) >> shift;
    }
    p->block[f->sharing.instance_count] = (uint32_t)blocks;
    return blocks;
}

// The largest blocks that leave room for all: they make the table short.
static uint32_t choose_blocks(const struct placing *p) {
    uint32_t shift = SHIFT_MOST;
    while (shift > 0 && count_blocks(p, shift) << shift > UINT64_C(1) << ITEM_BITS)
        shift--;
    return shift;
}

static bool make_tables(struct placing *p) {
    struct flat_scene *out = p->f->out;
    const uint32_t count = p->f->sharing.instance_count, blocks = p->block[count];
    const uint64_t records = (uint64_t)count * p->words, shades = ((uint64_t)blocks + 3) / 4;
    const uint64_t words = shades + ((uint64_t)p->shades.count + 3) / 4 + 1;
    struct gpu_word *all = heap_resize_array(p->records, records + words, sizeof *all);
    if (!all)
        return false;
    p->records = NULL;
    memset(all + records, 0, words * sizeof *all);
    out->instances = (struct flat_array){all, records + words};
    out->instance_table = (uint32_t)records;
    uint32_t *table = (uint32_t *)(void *)(all + records);
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = p->block[i]; k < p->block[i + 1]; k++)
            table[k] = i;
    if (p->shades.count)
        memcpy(table + 4 * shades, p->shades.values, p->shades.count * sizeof *table);
    // Only now is it known where they begin.
    for (uint32_t i = 0; i < count; i++) {
        struct gpu_word *word = all + (size_t)p->words * i + (p->words - 1);
        word->z += (uint32_t)(4 * shades);
    }
    return true;
}

// ---- the upper tree

// Instances first, in nodes of their own; then the trees that they lead to, which are stored behind.
static bool make_top(struct placing *p) {
    struct flattening *f = p->f;
    struct flat_scene *out = f->out;
    const uint32_t first = f->item_count ? 0 : 1;
    struct bvh top;
    if (!bvh_build_kept(f->input->keep, p->items + first, f->sharing.instance_count - first, BVH_SAH_SINGLES,
                        &top))
        return false;
    bool done = bvh_open_leaves(&top, p->leaves);
    struct bvh below = {.nodes = out->triangle_nodes.words,
                        .node_count = (uint32_t)(out->triangle_nodes.count / NODE_WORDS)};
    struct flat_array nodes = {0};
    if (done) {
        bvh_move(&below, top.node_count, 0);
        for (uint32_t i = 0; i < top.node_count; i++)
            if ((top.nodes[(size_t)NODE_WORDS * i].w & 0xff) == 0)
                top.nodes[(size_t)NODE_WORDS * i + 1].x += top.node_count;
        done = append(&nodes, top.nodes, (uint64_t)top.node_count * NODE_WORDS) &&
               append(&nodes, below.nodes, (uint64_t)below.node_count * NODE_WORDS);
    }
    out->top_nodes = top.node_count;
    out->triangle_depth += top.depth;
    bvh_finish(&top);
    if (!done) {
        free(nodes.words);
        return false;
    }
    free(out->triangle_nodes.words);
    out->triangle_nodes = nodes;
    return true;
}

static bool place_all(struct placing *p) {
    const struct flattening *f = p->f;
    const uint32_t shift = choose_blocks(p);
    f->out->instance_shift = shift;
    count_blocks(p, shift);
    place_copied(p, 0);
    for (uint32_t i = 0; i < f->scene->body_count; i++)
        if (f->sharing.instance[i] && !place_body(p, i, shift))
            return false;
    return make_tables(p);
}

static enum flatten_fault place_instances(struct flattening *f, struct bvh_item copied) {
    const size_t count = f->sharing.instance_count;
    struct placing p = {.f = f};
    p.words = (f->out->is_double ? ENTRY64_WORDS : ENTRY_WORDS) + INSTANCE_WORDS;
    p.records = heap_zeroed(heap_times(count, p.words), sizeof *p.records);
    p.items = heap_array(count, sizeof *p.items);
    p.leaves = heap_array(heap_times(count, NODE_WORDS), sizeof *p.leaves);
    p.block = heap_array(count + 1, sizeof *p.block);
    bool done = p.records && p.items && p.leaves && p.block;
    if (done) {
        p.items[0] = copied;
        const double start = clock_seconds();
        done = place_all(&p) && make_top(&p);
        f->out->build_seconds += clock_seconds() - start;
    }
    free(p.shades.values);
    free(p.block);
    free(p.leaves);
    free(p.items);
    free(p.records);
    return done ? FLATTEN_DONE : FLATTEN_NO_MEMORY;
}

// The box of the copied triangles, from the root of their tree.
static struct bvh_item copied_item(const struct flattening *f) {
    struct bvh_bounds boxes[BVH_BOUNDS_MOST];
    const struct bvh bvh = {.nodes = f->out->triangle_nodes.words};
    const uint32_t count = f->item_count ? bvh_first_bounds(&bvh, boxes) : 0;
    vec3 lower = {INFINITY, INFINITY, INFINITY}, upper = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < count; i++) {
        lower = vec3_min(lower, (vec3){boxes[i].lower[0], boxes[i].lower[1], boxes[i].lower[2]});
        upper = vec3_max(upper, (vec3){boxes[i].upper[0], boxes[i].upper[1], boxes[i].upper[2]});
    }
    return bvh_wide_item(lower, upper, 0);
}

enum flatten_fault flatten_instances(struct flattening *f) {
    if (!f->sharing.instance_count)
        return FLATTEN_DONE;
    const struct bvh_item copied = copied_item(f);
    f->out->instance_count = f->sharing.instance_count;
    for (uint32_t i = 0; i < f->sharing.mesh_count; i++) {
        if (!f->sharing.meshes[i].instances)
            continue;
        enum flatten_fault fault = make_mesh(f, &f->sharing.meshes[i]);
        if (fault != FLATTEN_DONE)
            return fault;
    }
    return place_instances(f, copied);
}
