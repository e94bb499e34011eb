// Traces a ray again where rounding leaves open what it hits: from the exact place that it leaves, with tests that
// have twice the digits. Slow, and rare: for a ray that starts within its error of a triangle other than the one it
// leaves, at an edge of a body for instance, or that hits two triangles at distances that differ only by rounding.
//
// Boxes are those of the first search: they are wide enough for the start's error (bvh/items.c).

#if !defined(DOUBLE_PRECISION) && !defined(NO_DOUBLES)
const REAL WIDE_STEP = 3.5527136788005009e-15; // 2^-48: above the error of a place in WIDE, as a fraction of its coordinates
#elif !defined(DOUBLE_PRECISION)
const REAL WIDE_STEP = 9.0949470177292824e-13; // 2^-40
#else
const REAL WIDE_STEP = 1.262177448353619e-29lf; // 2^-96
#endif
const REAL WIDE_INSET = 16384.0 * WIDE_STEP; // from a triangle's edges, as a fraction of the triangle

// Parallel planes whose heights differ by no more than this fraction of their coordinates are the same but for
// the rounding of the scene's numbers.
const REAL SAME_HEIGHT = 4.0 * GAMMA_1;
const REAL PARALLEL = 0.99993896484375; // 1 - 2^-14: cosine

// Where a ray goes.
struct exact_aim {
    REAL3 direction;
    bool has_target; // the ray ends at `target`, at t = 1
    REAL3 target;
};

exact_aim aim_along(REAL3 direction) { return exact_aim(direction, false, REAL3(0.0)); }

struct exact_search {
    WIDE3 origin, direction;
    bool along_x, along_z; // as in shear_ray
    WIDE sx, sy;
    uint left, left_body;
    REAL3 left_normal; // 0: none
    REAL least;        // least t found
    REAL blur;         // of the hit: SAME_HEIGHT measured along the ray
    REAL3 normal;      // of the hit
};

// The corners, starting with the one whose edges give the most accurate normal.
struct exact_corners {
    REAL3 p0, p1, p2;
};

exact_corners corners_of(triangle_record triangle) {
    uint first = triangle.shade >> TRIANGLE_CORNER_SHIFT;
    REAL3 v0 = triangle.v0, v1 = triangle.v1, v2 = triangle.v2;
    return exact_corners(first == 0u ? v0 : first == 1u ? v1 : v2, first == 0u ? v1 : first == 1u ? v2 : v0,
                         first == 0u ? v2 : first == 1u ? v0 : v1);
}

// Unit; the edges are divided by a power of two first, so that the product of small ones does not vanish.
// Flattening leaves out triangles for which this is not finite.
REAL3 triangle_normal(triangle_record triangle) {
    exact_corners c = corners_of(triangle);
    REAL3 u = c.p1 - c.p0, v = c.p2 - c.p0;
    REAL scale = inverse_power(max(largest3(abs(u)), largest3(abs(v))));
    return unit3(cross3(u * scale, v * scale));
}

// The place on a triangle: never outside, nor on its edge, whatever the rounding of b1 and b2.
WIDE3 exact_point(triangle_record triangle, REAL b1, REAL b2) {
    WIDE one = wide(1.0), w1 = wide(b1), w2 = wide(b2);
    WIDE w0 = plus(one, minus(plus(w1, w2)));
    bool outside = is_positive(minus(w0));
    WIDE all = plus(w1, w2);
    w1 = outside ? over(w1, all) : w1;
    w2 = outside ? plus(one, minus(w1)) : w2;
    w0 = outside ? wide(0.0) : w0;
    WIDE inset = wide(WIDE_INSET), rest = plus(one, minus(wide(3.0 * WIDE_INSET)));
    w1 = plus(times(w1, rest), inset);
    w2 = plus(times(w2, rest), inset);
    w0 = plus(one, minus(plus(w1, w2)));
    return plus3(plus3(times3(wide3(triangle.v0), w0), times3(wide3(triangle.v1), w1)),
                 times3(wide3(triangle.v2), w2));
}

REAL farthest_of(triangle_record triangle) {
    return largest3(max(max(abs(triangle.v0), abs(triangle.v1)), abs(triangle.v2)));
}

// Components in the order of `turn`.
WIDE3 turned(WIDE3 v, bool along_x, bool along_z) {
    WIDE3 other = v;
    if (!along_z)
        other = WIDE3(along_x ? v.y : v.z, along_x ? v.z : v.x, along_x ? v.x : v.y);
    return other;
}

// Starts on the side of the triangle that the ray heads to, by more than the error of WIDE. A ray to a target ends
// exactly there.
exact_search begin_exact(ray_start start, exact_aim aim, hit_record hit) {
    exact_search search;
    REAL3 direction = aim.direction;
    shear_ray shear = make_shear_ray(start.at, direction);
    search.origin = wide3(start.at);
    search.along_x = shear.along_x;
    search.along_z = shear.along_z;
    search.left = start.left;
    search.left_body = NO_ITEM;
    search.left_normal = REAL3(0.0);
    search.least = hit.t;
    search.blur = 0.0;
    search.normal = REAL3(0.0);
    if (HAS_CONES)
        search.blur = disc_error(hit, start.at, direction, search.normal);
    if (!LEAVES_ROUND(start) && start.left != NO_ITEM) {
        triangle_record left = load_triangle(start.left);
        search.left_body = left.body;
        search.left_normal = triangle_normal(left);
        REAL step = WIDE_STEP * farthest_of(left);
        step = dot3(search.left_normal, direction) < 0.0 ? -step : step;
        search.origin =
            plus3(exact_point(left, start.b1, start.b2), times3(wide3(search.left_normal), wide(step)));
    }
    search.direction = wide3(direction);
    if (aim.has_target)
        search.direction = minus3(wide3(aim.target), search.origin);
    WIDE3 d = turned(search.direction, search.along_x, search.along_z);
    search.sx = over(d.x, d.z);
    search.sy = over(d.y, d.z);
    return search;
}

bool are_parallel(REAL3 a, REAL3 b) { return abs(dot3(a, b)) > PARALLEL; }

// A corner as the ray sees it: its place across the ray, the same for all triangles around it.
struct exact_place {
    WIDE x, y;
};

exact_place place_of(REAL3 corner, exact_search search) {
    WIDE3 p = turned(minus3(wide3(corner), search.origin), search.along_x, search.along_z);
    return exact_place(plus(p.x, minus(times(search.sx, p.z))), plus(p.y, minus(times(search.sy, p.z))));
}

WIDE edge_of(exact_place a, exact_place b) { return wide_difference(a.x, b.y, a.y, b.x); }

// As test_triangle.
void test_exact(uint item, bool there, inout exact_search search, inout hit_record hit) {
    triangle_record triangle = load_tested(item);
    exact_place a = place_of(triangle.v0, search), b = place_of(triangle.v1, search), c = place_of(triangle.v2, search);
    WIDE u = edge_of(c, b), v = edge_of(a, c), w = edge_of(b, a);
    bool above = is_positive(u) || is_positive(v) || is_positive(w);
    bool below = is_positive(minus(u)) || is_positive(minus(v)) || is_positive(minus(w));
    exact_corners corners = corners_of(triangle);
    WIDE3 p0 = wide3(corners.p0);
    WIDE3 normal = wide_cross(minus3(wide3(corners.p1), p0), minus3(wide3(corners.p2), p0));
    WIDE height = wide_dot(normal, minus3(p0, search.origin)), along = wide_dot(normal, search.direction);
    bool falls = is_positive(minus(along));
    bool before = falls ? is_positive(minus(height)) : is_positive(along) && is_positive(height);
    WIDE det = plus(plus(u, v), w);
    REAL3 unit = triangle_normal(triangle);
    REAL same = SAME_HEIGHT * farthest_of(triangle) * abs(narrow(wide_dot(normal, wide3(unit))));
    bool is_left = item == search.left || (triangle.body != search.left_body && abs(narrow(height)) <= same &&
                                           are_parallel(unit, search.left_normal));
    bool is_hit = there && !(above && below) && (above || below) && before && !is_left;
    REAL t = narrow(over(height, along)), blur = abs(same / narrow(along));
    uint number = triangle.number + frame.sphere_count;
    REAL tie = hit.item != NO_ITEM && are_parallel(unit, search.normal) ? blur + search.blur : 0.0;
    bool first_found = hit.item == NO_ITEM && t < hit.t;
    bool nearer = hit.item != NO_ITEM &&
                  (t < search.least - tie || (abs(t - search.least) <= tie && number < hit.number));
    if (is_hit && (first_found || nearer)) {
        hit.t = t;
        hit.b1 = max(narrow(over(v, det)), 0.0);
        hit.b2 = max(narrow(over(w, det)), 0.0);
        hit.item = item;
        hit.number = number;
        search.blur = blur;
        search.normal = unit;
    }
    search.least = is_hit ? min(search.least, t) : search.least;
}

// If the first search would take the hit too: uses its numbers, so that a picture does not show whether a tree led to a
// second search.
void first_numbers(ray_start start, REAL3 direction, inout hit_record hit) {
    if (hit.item == NO_ITEM || (hit.item & ITEM_SPHERE) != 0u)
        return;
    hit_record first = hit_record(FAR_AWAY, 0.0, 0.0, NO_ITEM, 0u);
    triangle_search search =
        triangle_search(make_shear_ray(start.at, direction), start.slack, start.left, 0.0, FAR_AWAY, FAR_AWAY, NO_ITEM, NO_ITEM);
    see_item(hit.item);
    test_triangle(hit.item, true, search, first);
    if (first.item == hit.item) {
        hit.t = first.t;
        hit.b1 = first.b1;
        hit.b2 = first.b2;
    }
}

// The side of a triangle, by the order of its corners, that a ray heads to: 1 or -1; 0 where rounding leaves it open. The
// corners' differences are exact but for one rounding, so their product is off by less than 2^-17 of its factors; the
// direction to a target is off by the start's error.
REAL facing(triangle_record triangle, REAL3 direction, REAL slack) {
    REAL3 u = triangle.v1 - triangle.v0, v = triangle.v2 - triangle.v0;
    REAL f = dot3(cross3(u, v), direction);
    REAL off = largest3(abs(direction)) * 7.62939453125e-6 + 8.0 * slack;
    REAL bound = largest3(abs(u)) * largest3(abs(v)) * off;
    return f > bound ? 1.0 : f < -bound ? -1.0 : 0.0;
}

// Whether a triangle has an edge from one place to the other, in the order of its corners.
bool has_edge(triangle_record triangle, REAL3 from, REAL3 to) {
    return (triangle.v0 == from && triangle.v1 == to) || (triangle.v1 == from && triangle.v2 == to) ||
           (triangle.v2 == from && triangle.v0 == to);
}

// Whether the ray certainly passes beside a triangle. Seen along a direction that points to the same side of two triangles,
// these lie on opposite sides of a common edge; and the ray starts within one of them.
bool passes_beside(uint item, ray_start start, REAL3 direction) {
    if (LEAVES_ROUND(start) || start.left == NO_ITEM)
        return false;
    triangle_record a = load_triangle(start.left), b = load_triangle(item);
    // Bodies are usually wound one way: their edges run back and forth.
    bool back = has_edge(a, b.v1, b.v0) || has_edge(a, b.v2, b.v1) || has_edge(a, b.v0, b.v2);
    bool forth = has_edge(a, b.v0, b.v1) || has_edge(a, b.v1, b.v2) || has_edge(a, b.v2, b.v0);
    REAL same = facing(a, direction, start.slack) * facing(b, direction, start.slack);
    return back != forth && (back ? same > 0.0 : same < 0.0);
}

// Removes such triangles from the doubts. true: none is left.
bool settle(ray_start start, REAL3 direction, inout ray_doubts doubts) {
    if (doubts.near_a != NO_ITEM && passes_beside(doubts.near_a, start, direction))
        doubts.near_a = NO_ITEM;
    if (doubts.near_b != NO_ITEM && passes_beside(doubts.near_b, start, direction))
        doubts.near_b = NO_ITEM;
    return !doubts.all && doubts.near_a == NO_ITEM && doubts.near_b == NO_ITEM;
}

bool is_hit_exactly(uint item, exact_search search, hit_record hit) {
    see_item(item);
    test_exact(item, true, search, hit);
    return hit.item == item;
}

// Whether a search of all triangles is needed. Most rays have doubts only about triangles around their start, and hit none
// of them: then this search would find the same as the first one.
bool needs_search(exact_search search, ray_doubts doubts, hit_record hit) {
    bool needed = doubts.all;
    if (!needed && doubts.near_a != NO_ITEM)
        needed = is_hit_exactly(doubts.near_a, search, hit);
    if (!needed && doubts.near_b != NO_ITEM)
        needed = is_hit_exactly(doubts.near_b, search, hit);
    return needed;
}

// As trace_triangles, with `hit` as it was before that. false: its result stands. So it does if the search is given up at
// EXACT_ITERATIONS, which a ray reaches where a scene is so far away that most of it is the same but for rounding.
bool retrace_triangles(ray_start start, exact_aim aim, ray_doubts doubts, bool any, inout hit_record hit,
                       inout uint iterations) {
    if (settle(start, aim.direction, doubts))
        return false;
    exact_search search = begin_exact(start, aim, hit);
    if (!needs_search(search, doubts, hit))
        return false;
    tree_ray ray = make_tree_ray(start.at, aim.direction);
    REAL margin = 4.0 * start.slack / largest3(abs(aim.direction));
    STACK(TRIANGLE_STACK)
    uvec2 group = root_group();
    uint turns = 0u;
    bool more = true;
    INSTANCES_BEGIN(ray, start, aim.direction, group)
    do {
        INSTANCE_NEXT(ray, start, aim.direction)
        turns += 2u;
        if (HAS_COUNTERS)
            counted_nodes++;
        node_record node = load_triangle_node(NODE_AT(group, ray));
        uint hits = node_hits(node, ray, max(hit.t, search.least) + 2.0 * search.blur + margin);
        uvec2 found = uvec2(node.first_node, (hits & 0xff000000u) | (node.exponents >> 24u)), rest = group;
        INSTANCE_FOUND(node, found)
        STACK_NEXT(TRIANGLE_STACK, group, rest, found, more)
        INSTANCE_LEFT(ray, group)
        uint items = hits & 0x00ffffffu;
        WHILE(items != 0u && turns < EXACT_ITERATIONS)
            uint bit = items & (0u - items);
            bool there = IS_WANTED(bit != 0u);
            turns += there ? 1u : 0u;
            if (HAS_COUNTERS)
                counted_items += there ? 1u : 0u;
            items ^= bit;
            uint item = node.first_item + (floatBitsToUint(float(int(bit))) >> 23u) - 127u;
            test_exact(INSTANCE_ITEM(item), there, search, hit);
            if (any && hit.item != NO_ITEM) {
                items = 0u;
                more = false;
            }
        END_WHILE(items != 0u && turns < EXACT_ITERATIONS)
    } while (more && INSTANCE_SEEN && turns < EXACT_ITERATIONS);
    INSTANCES_END(group, more, turns, EXACT_ITERATIONS)
    iterations += turns;
    first_numbers(start, aim.direction, hit);
    return turns < EXACT_ITERATIONS;
}
