// Finds the closest or any triangle along a ray.
//
// Test: Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection". Bound of t: Pharr, Jakob, Humphreys
// 2023, section 6.8.7. At equal t the lower number wins, so the result does not depend on the tree. What the
// bound leaves open is only noted here: whether a hit lies in front of the ray's start or behind it, and
// which of two hits is nearer. Such a ray is traced again (exact.glsl).
#include "instances.glsl"

struct hit_record {
    REAL t;      // until something is hit, the ray's end
    REAL b1;     // barycentrics of v1 and v2 as stored; of a cone: cones.glsl
    REAL b2;
    uint item;   // leaf item, with ITEM_SPHERE for spheres and cones; NO_ITEM: nothing
    uint number; // spheres by body, then triangles and cones: breaks ties
};
const uint NO_ITEM = 0xffffffffu;
const uint ITEM_SPHERE = 0x80000000u;

// Where hit.b1 says that a cone is hit; 0: a sphere is. hit.b2 is 1 where the ray enters it, 0 where it leaves it.
const REAL FACE_SIDE = 1.0;
const REAL FACE_BASE = 2.0;
const REAL FACE_TOP = 3.0;

// Where a ray starts.
struct ray_start {
    REAL3 at;    // rounded: what trees and the first tests begin at
    REAL slack;  // bound of its error, by component
    uint left;   // triangle that the ray leaves, which it cannot hit; NO_ITEM: none, and `at` is exact; with ITEM_SPHERE
                 // a sphere or cone, and `at` is exact, too
    REAL b1, b2; // the exact place on that triangle; b1 of a cone: to which side (cones.glsl)
};
#define LEAVES_ROUND(start) (HAS_CONES && (start.left & ITEM_SPHERE) != 0u)

// How far rounding may move the t of a hit on a cone's disc: a triangle may lie in the same plane, as a floor does under
// a column. 0: another hit.
REAL disc_error(hit_record hit, REAL3 start, REAL3 direction, out REAL3 normal) {
    bool is_disc = HAS_CONES && hit.item != NO_ITEM && (hit.item & ITEM_SPHERE) != 0u && hit.b1 > FACE_SIDE;
    REAL error = 0.0;
    normal = REAL3(0.0);
    if (is_disc) {
        frustum_record body = load_frustum(hit.item & ~ITEM_SPHERE);
        normal = body.axis;
        error = 2.0 * GAMMA_7 * (largest3(abs(start)) + largest3(abs(body.base)) + body.height) / abs(dot3(direction, normal));
    }
    return error;
}

ray_start exact_start(REAL3 at) { return ray_start(at, 0.0, NO_ITEM, 0.0, 0.0); }

struct shear_ray {
    REAL3 origin;
    bool along_x, along_z; // the largest component of the direction; else along y
    REAL sx, sy, sz;
#ifdef ALTERNATIVES
    vec3 direction;
#endif
#ifdef INSTANCES
    REAL3 inverse;
#endif
};

REAL3 turn(REAL3 v, bool along_x, bool along_z) { return along_z ? v : along_x ? v.yzx : v.zxy; }

shear_ray make_shear_ray(REAL3 origin, REAL3 direction) {
    shear_ray ray;
    REAL3 size = abs(direction);
    ray.origin = origin;
    ray.along_z = size.z >= size.x && size.z >= size.y;
    ray.along_x = !ray.along_z && size.x >= size.y;
    REAL3 d = turn(direction, ray.along_x, ray.along_z);
    ray.sz = 1.0 / d.z;
    ray.sx = d.x * ray.sz;
    ray.sy = d.y * ray.sz;
#ifdef ALTERNATIVES
    ray.direction = direction;
#endif
#ifdef INSTANCES
    ray.inverse = make_tree_ray(origin, direction).inverse;
#endif
    return ray;
}

#ifdef ALTERNATIVES
// Barycentrics are multiplied by the determinant, which holds for a unit direction.
bool test_moeller(triangle_record triangle, shear_ray ray, inout float v, inout float w, inout float det,
                  inout float t) {
    vec3 ab = triangle.v1 - triangle.v0, ac = triangle.v2 - triangle.v0;
    vec3 p = cross3(ray.direction, ac), s = ray.origin - triangle.v0, q = cross3(s, ab);
    det = dot3(ab, p);
    v = dot3(s, p);
    w = dot3(ray.direction, q);
    float inverse = 1.0 / det;
    t = dot3(ac, q) * inverse;
    return abs(det) >= ALTERNATIVE_CUT * sqrt(dot3(ray.direction, ray.direction)) && v * inverse >= 0.0 &&
           w * inverse >= 0.0 && (v + w) * inverse <= 1.0;
}
#endif

struct triangle_search {
    shear_ray ray;
    REAL slack; // as in ray_start
    uint left;
    REAL wrong; // bound of the error of the nearest hit's t
    REAL doubt; // the least t that rounding leaves open
    REAL edge;           // the least t of a triangle that the ray passes within its error of an edge
    uint near_a, near_b; // triangles within the error of the ray's start; NO_ITEM: none
};

// What a search of triangles leaves open.
struct ray_doubts {
    bool all;            // which of all triangles is hit
    uint near_a, near_b; // else: whether the ray starts in front of these or behind them; NO_ITEM: no triangle
};
ray_doubts no_doubts() { return ray_doubts(false, NO_ITEM, NO_ITEM); }

// Two such triangles are noted: a corner may have more, and then all triangles are tested again.
void note_near(uint item, inout triangle_search search) {
    bool is_full = HAS_LONG_RAYS || BEGINS || search.near_b != NO_ITEM;
    search.doubt = is_full ? 0.0 : search.doubt;
    if (BEGINS)
        return;
    search.near_b = search.near_a != NO_ITEM ? item : search.near_b;
    search.near_a = search.near_a == NO_ITEM ? item : search.near_a;
}

// Most triangles of a leaf are missed, often by all lanes of a GPU's subgroup. lavapipe runs every branch.
#if defined(FETCH_TEXELS) || defined(DOUBLE_PRECISION) || defined(ALTERNATIVES)
#define LEAVE_IF(condition)
#else
#define LEAVE_IF(condition)                                                                                  \
    if (condition)                                                                                           \
        return;
#endif

// Bound on the error of u, v and w, if no corner is farther than this from the ray.
REAL edge_error(REAL x_most, REAL y_most, REAL z_most, REAL slack) {
    REAL delta_x = GAMMA_5 * (x_most + z_most) + 2.0 * slack;
    REAL delta_y = GAMMA_5 * (y_most + z_most) + 2.0 * slack;
    return 2.0 * (GAMMA_2 * x_most * y_most + delta_y * x_most + delta_x * y_most);
}

// `there`: whether the item is one.
void test_triangle(uint item, bool there, inout triangle_search search, inout hit_record hit) {
    triangle_record triangle = load_tested(item);
    shear_ray ray = search.ray;
    REAL3 a = turn(triangle.v0 - ray.origin, ray.along_x, ray.along_z);
    REAL3 b = turn(triangle.v1 - ray.origin, ray.along_x, ray.along_z);
    REAL3 c = turn(triangle.v2 - ray.origin, ray.along_x, ray.along_z);
    REAL ax = a.x - ray.sx * a.z, ay = a.y - ray.sy * a.z;
    REAL bx = b.x - ray.sx * b.z, by = b.y - ray.sy * b.z;
    REAL cx = c.x - ray.sx * c.z, cy = c.y - ray.sy * c.z;
    REAL u = cx * by - cy * bx;
    REAL v = ax * cy - ay * cx;
    REAL w = bx * ay - by * ax;
    REAL det = u + v + w;
    REAL highest = LARGER(LARGER(u, v), w), lowest = SMALLER(SMALLER(u, v), w);
    bool inside = there && (highest <= 0.0 || lowest >= 0.0) && det != 0.0;
    REAL x_most = LARGER(LARGER(abs(ax), abs(bx)), abs(cx));
    REAL y_most = LARGER(LARGER(abs(ay), abs(by)), abs(cy));
    REAL z_most = LARGER(LARGER(abs(a.z), abs(b.z)), abs(c.z));
    REAL delta_e = edge_error(x_most, y_most, z_most, search.slack);
    LEAVE_IF(!(highest <= delta_e || lowest >= -delta_e || inside))
    REAL inverse = 1.0 / det;
    REAL t = (u * (ray.sz * a.z) + v * (ray.sz * b.z) + w * (ray.sz * c.z)) * inverse;
    // t is a mean of the vertices' z: an error of its weights moves it by at most their spread. Seen edge-on, it
    // may be anywhere between them.
    REAL z_low = SMALLER(SMALLER(a.z, b.z), c.z) * ray.sz, z_high = LARGER(LARGER(a.z, b.z), c.z) * ray.sz;
    REAL first = SMALLER(z_low, z_high), last = LARGER(z_low, z_high);
    bool edge_on = !(abs(det) > 3.0 * delta_e);
    t = edge_on ? SMALLER(LARGER(t, first), last) : t;
    REAL delta_z = (6.0 * GAMMA_3 * z_most + search.slack) * abs(ray.sz);
    REAL delta_t = delta_z + (edge_on ? last - first : (last - first) * (3.0 * delta_e * abs(inverse)));
    bool starts_before = (edge_on ? first - delta_z : t - delta_t) > 0.0;
    bool starts_behind = (edge_on ? last + delta_z : t + delta_t) < 0.0;
    uint number = triangle.number + frame.sphere_count;
#ifdef ALTERNATIVES
    if (alternative_cuts()) {
        inside = there && test_moeller(triangle, ray, v, w, det, t) && det != 0.0;
        inverse = 1.0 / det;
    }
    starts_before = t > (alternative_moves() || ALTERNATIVE_START != 0u ? 0.0 : delta_t);
#else
    bool possible = there && (highest <= delta_e || lowest >= -delta_e);
    bool start_open = possible && !starts_before && !starts_behind && item != search.left && MEETS_BOX(triangle, ray);
    bool order_open = inside && starts_before && abs(t - hit.t) <= delta_t + search.wrong;
    search.doubt = order_open ? SMALLER(search.doubt, SMALLER(t, hit.t)) : search.doubt;
    bool edge_open = !BEGINS && possible && starts_before && lowest <= delta_e && highest >= -delta_e;
    search.edge = edge_open ? min(search.edge, edge_on ? first - delta_z : t - delta_t) : search.edge;
    if (start_open)
        note_near(item, search);
#endif
    bool nearer = t < hit.t || (t == hit.t && number < hit.number);
    if (inside && starts_before && nearer) {
        hit.t = t;
        hit.b1 = v * inverse;
        hit.b2 = w * inverse;
        hit.item = item;
        hit.number = number;
        search.wrong = delta_t;
    }
}

#if defined(DOUBLE_PRECISION) && !defined(INSTANCES) && !defined(NO_OUTLINES)
#define HAS_OUTLINES
#include "misses.glsl"
#define OUTLINES_MAKE(search) outline_ray outline = make_outline_ray(search);
#define SKIP_MISSED(item)                                                                                    \
    if (misses(item, outline, search.ray))                                                                   \
        continue;
#else
#define OUTLINES_MAKE(search)
#define SKIP_MISSED(item)
#endif

// On lavapipe nodes are searched until one has items to test, which all lanes that have some then test at once
// (docs/decisions/kernel.md). A lane that has left a loop keeps what it had only through a branch: one that is always
// taken.
#ifdef FETCH_TEXELS
#define ITEMS_WAIT
// Items of a node, as bits counted from `first`.
void test_kept(inout uint kept, uint first, bool any, inout triangle_search search, inout hit_record hit,
               inout uint iterations) {
    do {
        uint bit = kept & (0u - kept);
        bool there = bit != 0u;
        iterations += there ? 1u : 0u;
#ifndef HAS_OUTLINES
        if (HAS_COUNTERS)
            counted_items += there ? 1u : 0u;
#endif
        kept ^= bit;
        uint item = first + (floatBitsToUint(float(int(bit))) >> 23u) - 127u;
        test_triangle(INSTANCE_ITEM(item), there, search, hit);
        if (any && hit.item != NO_ITEM)
            kept = 0u;
    } while (kept != 0u);
}
#define KEPT_BEGIN(search)                                                                                   \
    OUTLINES_MAKE(search)                                                                                    \
    uint kept = 0u, kept_first = 0u;                                                                         \
    do {
#define KEPT_NODE if (iterations < ITERATION_LIMIT) {
#define TEST_ITEM(item, bit, there) kept |= there && !misses(item, outline, search.ray) ? bit : 0u;
#define KEPT_END(first)                                                                                      \
    kept_first = kept != 0u ? first : kept_first;                                                            \
    }                                                                                                        \
    }                                                                                                        \
    while (more && kept == 0u && INSTANCE_SEEN && iterations < TRAVERSAL_LIMIT)                              \
        ;                                                                                                    \
    test_kept(kept, kept_first, any, search, hit, iterations);                                               \
    more = more && !(any && hit.item != NO_ITEM);
#else
#define KEPT_BEGIN(search) OUTLINES_MAKE(search)
#define KEPT_NODE
#define TEST_ITEM(item, bit, there)                                                                          \
    SKIP_MISSED(item)                                                                                        \
    test_triangle(INSTANCE_ITEM(item), there, search, hit);                                                  \
    if (any && hit.item != NO_ITEM) {                                                                        \
        items = 0u;                                                                                          \
        more = false;                                                                                        \
    }
#define KEPT_END(first)
#endif

// What the search leaves open.
ray_doubts doubts_of(triangle_search search, hit_record hit) {
    bool is_near = search.near_a != NO_ITEM;
    REAL doubt = is_near ? min(search.doubt, search.edge) : search.doubt;
    return ray_doubts(doubt <= hit.t && doubt < FAR_AWAY, search.near_a, search.near_b);
}

// `any`: the first hit found ends the search. Stops unfinished at ITERATION_LIMIT. true: rounding leaves open what
// is hit; retrace_triangles decides.
bool trace_triangles(ray_start start, REAL3 direction, bool any, inout hit_record hit, inout ray_doubts doubts,
                     inout uint iterations) {
    tree_ray ray = make_tree_ray(start.at, direction);
    triangle_search search =
        triangle_search(make_shear_ray(start.at, direction), start.slack, start.left, 0.0, FAR_AWAY, FAR_AWAY, NO_ITEM, NO_ITEM);
    if (HAS_CONES) {
        REAL3 normal;
        search.wrong = disc_error(hit, start.at, direction, normal);
    }
    STACK(TRIANGLE_STACK)
    uvec2 group = root_group();
    bool more = true;
    STACK_RESUME(TRIANGLE_STACK, TREE_TRIANGLES, group)
    LONG_TAKE(search.wrong, search.doubt)
    INSTANCES_BEGIN(ray, start, direction, group)
    KEPT_BEGIN(search)
    do {
        INSTANCE_NEXT(ray, start, direction)
        KEPT_NODE
        iterations += 2u; // this loop, and the inner one where no lane enters it
        if (HAS_COUNTERS)
            counted_nodes++;
        node_record node = load_triangle_node(NODE_AT(group, ray));
        uint hits = node_hits(node, ray, hit.t + search.wrong);
        uvec2 found = uvec2(node.first_node, (hits & 0xff000000u) | (node.exponents >> 24u)), rest = group;
        INSTANCE_FOUND(node, found)
        STACK_NEXT(TRIANGLE_STACK, group, rest, found, more)
        INSTANCE_LEFT(ray, group)
        uint items = hits & 0x00ffffffu;
#if defined(ITEMS_WAIT) && !defined(HAS_OUTLINES)
        kept = items;
#else
        WHILE(items != 0u && iterations < ITERATION_LIMIT)
            uint bit = items & (0u - items);
            bool there = IS_WANTED(bit != 0u);
            iterations += there ? 1u : 0u;
            if (HAS_COUNTERS)
                counted_items += there ? 1u : 0u;
            items ^= bit;
            // A power of two up to 2^23 is its own exponent.
            uint item = node.first_item + (floatBitsToUint(float(int(bit))) >> 23u) - 127u;
            TEST_ITEM(item, bit, there)
        END_WHILE(items != 0u && iterations < ITERATION_LIMIT)
#endif
        KEPT_END(node.first_item)
    } while (more && INSTANCE_SEEN && iterations < TRAVERSAL_LIMIT);
    INSTANCES_END(group, more, iterations, TRAVERSAL_LIMIT)
    STACK_SUSPEND(TRIANGLE_STACK, TREE_TRIANGLES, group, more)
    LONG_KEEP(search.wrong, search.doubt)
    doubts = doubts_of(search, hit);
    return (doubts.all || doubts.near_a != NO_ITEM) && !(any && hit.item != NO_ITEM);
}
