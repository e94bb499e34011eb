// The reference's own tree: binary, boxes in double, split by the surface area heuristic in bins (Wald 2007,
// "On fast Construction of SAH-based Bounding Volume Hierarchies").
//
// A range of n items has at most 2n - 1 nodes: its own node, then its first child's, then its second child's.
// So every node's place is known before its children are built, and the tree does not depend on threads.
#include "core/heap.h"
#include "core/parallel.h"
#include "reference/reference_internal.h"

#include <assert.h>
#include <stdlib.h>

enum {
    PIECE = 4096,
    PIECE_INSTANCES = 64,
    BINS = 16,
    LEAF_MOST = 4,
    DEPTH_MOST = 64,   // below this, ranges are halved: at most 32 more levels
    TASK_ITEMS = 8192, // smaller ranges are built by one thread
};

// Boxes grow by this fraction of their largest coordinate: rounding must not let the triangle test hit what
// the box test misses.
#define BOX_PAD 0x1p-49

struct box {
    double lower[3], upper[3];
};

struct item {
    struct box box;
    uint32_t number; // in IR order
    bool is_empty;   // no area
};

struct range {
    size_t begin, end; // items
    size_t node;
    uint32_t depth;
};

struct building {
    struct reference *r;
    const struct shared_mesh *shared; // the mesh whose tree it is; NULL: the scene's
    struct item *items;
    struct tree_node *nodes;
    struct range *tasks;
    uint32_t task_count, task_capacity;
};

// ---- items

static void put_box(struct item *item, double v[3][3], bool is_sphere) {
    double most = 0;
    for (int a = 0; a < 3; a++) {
        double radius = is_sphere ? v[1][0] : 0;
        double least = v[0][a];
        double greatest = v[0][a];
        for (int k = 1; k < 3 && !is_sphere; k++) {
            least = fmin(least, v[k][a]);
            greatest = fmax(greatest, v[k][a]);
        }
        item->box.lower[a] = least - radius;
        item->box.upper[a] = greatest + radius;
        most = fmax(most, fmax(fabs(item->box.lower[a]), fabs(item->box.upper[a])));
    }
    for (int a = 0; a < 3; a++) {
        item->box.lower[a] -= most * BOX_PAD;
        item->box.upper[a] += most * BOX_PAD;
    }
}

// Around its two discs, each widened by its whole radius along every axis.
static void put_cone_box(struct item *item, double v[3][3]) {
    double most = 0;
    for (int a = 0; a < 3; a++) {
        const double from = v[0][a], to = from + v[1][a] * v[2][2];
        item->box.lower[a] = fmin(from - v[2][0], to - v[2][1]);
        item->box.upper[a] = fmax(from + v[2][0], to + v[2][1]);
        most = fmax(most, fmax(fabs(item->box.lower[a]), fabs(item->box.upper[a])));
    }
    for (int a = 0; a < 3; a++) {
        item->box.lower[a] -= most * BOX_PAD;
        item->box.upper[a] += most * BOX_PAD;
    }
}

// The last body that begins no later: bodies without primitives come before the one whose number they share.
static const struct body *body_of(const struct reference *r, uint32_t number) {
    uint32_t low = 0;
    uint32_t high = r->input.scene->body_count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (r->bodies[middle].first_primitive <= number)
            low = middle;
        else
            high = middle;
    }
    return &r->bodies[low];
}

static void put_instance(struct item *item, const struct instance *instance) {
    for (int a = 0; a < 3; a++) {
        item->box.lower[a] = instance->lower[a];
        item->box.upper[a] = instance->upper[a];
    }
}

static void make_items(void *context, size_t begin, size_t end) {
    struct building *b = context;
    const struct body *body = body_of(b->r, (uint32_t)begin);
    for (size_t i = begin; i < end; i++) {
        struct primitive p;
        while (i - body->first_primitive >= body->primitive_count)
            body++;
        b->items[i].number = (uint32_t)i;
        b->items[i].is_empty = false;
        if (body->instance != NO_INSTANCE) {
            put_instance(&b->items[i], &b->r->instances[body->instance]);
            continue;
        }
        b->items[i].is_empty = !reference_make_primitive(b->r, body, (uint32_t)i - body->first_primitive, &p);
        if (p.is_cone)
            put_cone_box(&b->items[i], p.v);
        else
            put_box(&b->items[i], p.v, p.is_sphere);
    }
}

// For a mesh, whose triangles are checked where they are shown.
static void make_mesh_items(void *context, size_t begin, size_t end) {
    struct building *b = context;
    const struct mesh *mesh = b->shared->mesh;
    for (size_t i = begin; i < end; i++) {
        double v[3][3];
        for (int k = 0; k < 3; k++) {
            const vec3 corner = mesh->positions[mesh->triangles[i].corners[k]];
            v[k][0] = corner.x;
            v[k][1] = corner.y;
            v[k][2] = corner.z;
        }
        b->items[i].number = (uint32_t)i;
        b->items[i].is_empty = false;
        put_box(&b->items[i], v, false);
    }
}

static void gather(void *context, size_t begin, size_t end) {
    const struct building *b = context;
    for (size_t i = begin; i < end; i++) {
        uint32_t number = b->items[i].number;
        const struct body *body = body_of(b->r, number);
        if (body->instance != NO_INSTANCE)
            b->r->primitives[i] = (struct primitive){
                .body = (uint32_t)(body - b->r->bodies), .triangle = body->instance, .is_instance = true};
        else
            reference_make_primitive(b->r, body, number - body->first_primitive, &b->r->primitives[i]);
    }
}

// ---- splitting

static struct box no_box(void) {
    return (struct box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

static void join(struct box *box, const struct box *other) {
    for (int a = 0; a < 3; a++) {
        box->lower[a] = reference_smaller(box->lower[a], other->lower[a]);
        box->upper[a] = reference_larger(box->upper[a], other->upper[a]);
    }
}

static double centre(const struct item *item, int axis) {
    return 0.5 * item->box.lower[axis] + 0.5 * item->box.upper[axis];
}

// Half the area, relative to a box of this size: no overflow.
static double area(const struct box *box, double size) {
    double d[3];
    for (int a = 0; a < 3; a++)
        d[a] = (box->upper[a] - box->lower[a]) / size;
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

struct cut {
    int axis;
    double from, scale; // bin = (centre - from) * scale
    int bin;            // the first of the right side
};

static int bin_of(const struct cut *cut, const struct item *item) {
    double place = (centre(item, cut->axis) - cut->from) * cut->scale;
    return place >= BINS - 1 ? BINS - 1 : place > 0 ? (int)place : 0;
}

// The best bin for the right side to begin with, and its cost; no split if all lie in one bin.
static double best_bin(const struct building *b, struct range range, double size, struct cut *cut) {
    struct box boxes[BINS];
    size_t counts[BINS] = {0};
    for (int i = 0; i < BINS; i++)
        boxes[i] = no_box();
    for (size_t i = range.begin; i < range.end; i++) {
        int bin = bin_of(cut, &b->items[i]);
        counts[bin]++;
        join(&boxes[bin], &b->items[i].box);
    }
    double right_cost[BINS];
    struct box box = no_box();
    size_t count = 0;
    for (int i = BINS - 1; i > 0; i--) {
        join(&box, &boxes[i]);
        count += counts[i];
        right_cost[i] = count ? area(&box, size) * (double)count : INFINITY;
    }
    double best = INFINITY;
    box = no_box();
    count = 0;
    for (int i = 1; i < BINS; i++) {
        join(&box, &boxes[i - 1]);
        count += counts[i - 1];
        double cost = count ? area(&box, size) * (double)count + right_cost[i] : INFINITY;
        if (cost < best) {
            best = cost;
            cut->bin = i;
        }
    }
    return best;
}

static size_t partition(const struct building *b, struct range range, const struct cut *cut) {
    size_t left = range.begin;
    for (size_t i = range.begin; i < range.end; i++) {
        if (bin_of(cut, &b->items[i]) >= cut->bin)
            continue;
        struct item swapped = b->items[left];
        b->items[left++] = b->items[i];
        b->items[i] = swapped;
    }
    return left;
}

// In the middle of the longest side of the centres' box: worse trees, in a fraction of the time.
static struct cut middle_of(const struct box *centres) {
    struct cut cut = {.axis = -1, .bin = BINS / 2};
    double longest = 0;
    for (int a = 0; a < 3; a++) {
        const double spread = centres->upper[a] - centres->lower[a];
        if (!(spread > longest) || !isfinite(BINS / spread))
            continue;
        longest = spread;
        cut.axis = a;
        cut.from = centres->lower[a];
        cut.scale = BINS / spread;
    }
    return cut;
}

// By the surface areas of the two sides' boxes.
static struct cut best_of(const struct building *b, struct range range, const struct box *centres,
                          double size) {
    struct cut best = {.axis = -1};
    double least = INFINITY;
    for (int a = 0; a < 3; a++) {
        double spread = centres->upper[a] - centres->lower[a];
        struct cut cut = {.axis = a, .from = centres->lower[a], .scale = BINS / spread};
        if (!(spread > 0) || !isfinite(cut.scale))
            continue;
        double cost = best_bin(b, range, size, &cut);
        if (cost < least) {
            least = cost;
            best = cut;
        }
    }
    return best;
}

// Fills the node's box and returns where the range is split.
static size_t split(const struct building *b, struct range range) {
    struct tree_node *node = &b->nodes[range.node];
    struct box box = no_box();
    struct box centres = no_box();
    for (size_t i = range.begin; i < range.end; i++) {
        const struct item *item = &b->items[i];
        join(&box, &item->box);
        for (int a = 0; a < 3; a++) {
            double at = centre(item, a);
            centres.lower[a] = reference_smaller(centres.lower[a], at);
            centres.upper[a] = reference_larger(centres.upper[a], at);
        }
    }
    double size = 0;
    for (int a = 0; a < 3; a++) {
        node->lower[a] = box.lower[a];
        node->upper[a] = box.upper[a];
        size = fmax(size, box.upper[a] - box.lower[a]);
    }
    size_t half = range.begin + (range.end - range.begin) / 2;
    if (range.depth >= DEPTH_MOST || range.end - range.begin <= LEAF_MOST)
        return half;
    const struct cut best = b->r->input.few_rays ? middle_of(&centres) : best_of(b, range, &centres, size);
    return best.axis < 0 ? half : partition(b, range, &best);
}

// Makes the node of a range; false: it is a leaf.
static bool open_node(const struct building *b, struct range range, struct range children[2]) {
    struct tree_node *node = &b->nodes[range.node];
    size_t count = range.end - range.begin;
    size_t middle = split(b, range);
    if (count <= LEAF_MOST) {
        node->second = (uint32_t)range.begin;
        node->count = (uint32_t)count;
        return false;
    }
    size_t second = range.node + 2 * (middle - range.begin);
    children[0] = (struct range){range.begin, middle, range.node + 1, range.depth + 1};
    children[1] = (struct range){middle, range.end, second, range.depth + 1};
    node->second = (uint32_t)second;
    node->count = 0;
    return true;
}

// ---- the whole

static void build_range(const struct building *b, struct range range) {
    struct range stack[TREE_STACK];
    int count = 0;
    stack[count++] = range;
    while (count) {
        struct range children[2];
        struct range top = stack[--count];
        if (!open_node(b, top, children))
            continue;
        assert(count + 2 <= TREE_STACK);
        stack[count++] = children[1];
        stack[count++] = children[0];
    }
}

static void build_tasks(void *context, size_t begin, size_t end) {
    const struct building *b = context;
    for (size_t i = begin; i < end; i++)
        build_range(b, b->tasks[i]);
}

static bool add_task(struct building *b, struct range range) {
    struct range *tasks = heap_grow(b->tasks, b->task_count, &b->task_capacity, sizeof *tasks);
    if (!tasks)
        return false;
    b->tasks = tasks;
    b->tasks[b->task_count++] = range;
    return true;
}

// Large ranges are split here, the rest by all threads.
static bool build(struct building *b, size_t count) {
    struct range stack[TREE_STACK];
    int height = 0;
    stack[height++] = (struct range){.end = count};
    while (height) {
        struct range children[2];
        struct range top = stack[--height];
        if (top.end - top.begin <= TASK_ITEMS) {
            if (!add_task(b, top))
                return false;
        } else if (open_node(b, top, children)) {
            assert(height + 2 <= TREE_STACK);
            stack[height++] = children[1];
            stack[height++] = children[0];
        }
    }
    parallel_for(b->task_count, 1, build_tasks, b);
    return true;
}

// Makes the tree over items and returns their number in *count; false: no memory.
static bool make_nodes(struct building *b, uint32_t total, parallel_body *make, uint32_t *count) {
    *count = 0;
    b->items = heap_array(total, sizeof *b->items);
    if (!b->items)
        return false;
    parallel_for(total, PIECE, make, b);
    for (uint32_t i = 0; i < total; i++)
        if (!b->items[i].is_empty)
            b->items[(*count)++] = b->items[i];
    if (*count == 0)
        return true;
    b->nodes = heap_array(heap_times(2, *count), sizeof *b->nodes);
    return b->nodes && build(b, *count);
}

static void finish(struct building *b) {
    free(b->items);
    free(b->tasks);
}

static bool make_mesh_tree(struct reference *r, struct shared_mesh *shared) {
    struct building b = {.r = r, .shared = shared};
    uint32_t count;
    bool made = make_nodes(&b, shared->mesh->triangle_count, make_mesh_items, &count);
    shared->nodes = b.nodes;
    shared->order = made ? heap_array(count, sizeof *shared->order) : NULL;
    for (uint32_t i = 0; shared->order && i < count; i++)
        shared->order[i] = b.items[i].number;
    finish(&b);
    return shared->order != NULL;
}

static bool make_scene_tree(struct reference *r) {
    struct building b = {.r = r};
    bool made =
        r->primitive_count == 0 || make_nodes(&b, r->primitive_count, make_items, &r->primitive_count);
    r->nodes = b.nodes;
    if (made && r->primitive_count) {
        r->primitives = heap_array(r->primitive_count, sizeof *r->primitives);
        made = r->primitives != NULL;
        if (made)
            parallel_for(r->primitive_count, PIECE, gather, &b);
    }
    finish(&b);
    return made;
}

static void place_instances(void *context, size_t begin, size_t end) {
    const struct reference *r = context;
    for (size_t i = begin; i < end; i++)
        reference_place(r, &r->instances[i]);
}

bool reference_make_tree(struct reference *r) {
    for (uint32_t i = 0; i < r->shared_mesh_count; i++)
        if (!make_mesh_tree(r, &r->shared_meshes[i]))
            return false;
    parallel_for(r->instance_count, PIECE_INSTANCES, place_instances, r);
    return make_scene_tree(r);
}
