// Models that share a mesh: a tree of instances over trees of meshes (gpu_scene.h).
//
// A triangle is placed where flattening would have placed it, by the same operations in double precision and one
// rounding, so a picture has the same bytes as with copies. Only boxes are in the mesh's own space: a ray is
// transformed to it, keeping its t, and boxes are widened as flattened ones would be, plus the ray's possible
// error (docs/decisions/instances.md).
#ifdef INSTANCES
#define MEMBER_DOUBLE(name, word, half64)  double name;
#define MEMBER_WHOLE(name, word, component) uint name;
#define LOAD_DOUBLE(name, word, half64)     record.name = packDouble2x32(FETCH(SOURCE, at + word).half64);
#define LOAD_WHOLE(name, word, component)   record.name = FETCH(SOURCE, at + word).component;

struct placed_record { PLACED_FIELDS(MEMBER_DOUBLE, MEMBER_WHOLE) };
struct instance_record { INSTANCE_FIELDS(MEMBER_DOUBLE, MEMBER_WHOLE) };
struct entry_record { MEMBERS(ENTRY_FIELDS) };
struct normal64_record { dvec3 unit; };

const uint INSTANCE_STRIDE = WORDS_OF(ENTRY) + INSTANCE_WORDS;
#define SOURCE triangles
placed_record load_placed(uint index) {
    uint at = index * PLACED_WORDS;
    placed_record record;
    PLACED_FIELDS(LOAD_DOUBLE, LOAD_WHOLE)
    return record;
}
#undef SOURCE
#define SOURCE instances
DEFINE_LOADER(entry_record, load_entry, INSTANCE_STRIDE, ENTRY_FIELDS)
instance_record load_instance(uint index) {
    uint at = index * INSTANCE_STRIDE + WORDS_OF(ENTRY);
    instance_record record;
    INSTANCE_FIELDS(LOAD_DOUBLE, LOAD_WHOLE)
    return record;
}
#undef SOURCE

// Component `index` of INSTANCES from its table on.
uint instance_table(uint index) {
    uvec4 word = FETCH(instances, frame.instance_table + index / 4u);
    uint k = index % 4u;
    return k == 0u ? word.x : k == 1u ? word.y : k == 2u ? word.z : word.w;
}

// The instance whose triangles this invocation loads: only what a test needs stays in registers.
uint seen_instance = 0u;
instance_record seen;

void see_instance(uint instance) {
    seen_instance = instance;
    seen = load_instance(instance);
}

// ---- triangles

dvec3 placed(double x, double y, double z) {
    return dvec3(seen.x_x * x + seen.x_y * y + seen.x_z * z + seen.x_offset,
                 seen.y_x * x + seen.y_y * y + seen.y_z * z + seen.y_offset,
                 seen.z_x * x + seen.z_y * y + seen.z_z * z + seen.z_offset);
}

double length_of(REAL3 a, REAL3 b) {
    dvec3 v = dvec3(b) - dvec3(a);
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

// As flattening decides it (tracer/flatten/flatten_bodies.c).
uint best_corner(REAL3 v0, REAL3 v1, REAL3 v2) {
    double a = length_of(v0, v1), b = length_of(v1, v2), c = length_of(v2, v0);
    double p0 = a * c, p1 = b * a, p2 = c * b;
    uint best = p1 < p0 ? 1u : 0u;
    double least = p1 < p0 ? p1 : p0;
    best = p2 < least ? 2u : best;
    least = p2 < least ? p2 : least;
    return p0 > TRIANGLE_CORNER_FACTOR * least ? best : 0u;
}

uint seen_shade(uint group) {
    return (seen.flags & INSTANCE_COPIED) != 0u ? group : instance_table(seen.shades + group);
}

// An item of the current instance.
triangle_record load_tested(uint item) {
    placed_record mesh = load_placed(item - seen.first_item);
    bool mirrored = (seen.flags & INSTANCE_MIRRORED) != 0u;
    REAL3 b = REAL3(placed(mesh.v1_x, mesh.v1_y, mesh.v1_z)), c = REAL3(placed(mesh.v2_x, mesh.v2_y, mesh.v2_z));
    triangle_record triangle;
    triangle.v0 = REAL3(placed(mesh.v0_x, mesh.v0_y, mesh.v0_z));
    triangle.v1 = mirrored ? c : b;
    triangle.v2 = mirrored ? b : c;
    triangle.number = seen.first_number + mesh.number;
    triangle.body = (seen.flags & INSTANCE_COPIED) != 0u ? mesh.body : seen.body;
    triangle.shade = seen_shade(mesh.shade) |
                     best_corner(triangle.v0, triangle.v1, triangle.v2) << TRIANGLE_CORNER_SHIFT;
    return triangle;
}

void see_item(uint item) { see_instance(instance_table(item >> frame.instance_shift)); }

triangle_record load_triangle(uint item) {
    see_item(item);
    return load_tested(item);
}

// ---- normals

// As flattening turns it (tracer/flatten/flatten_shade.c), by operations in the same order.
dvec3 turned_normal(dvec3 n, instance_record by) {
    dvec3 v = dvec3(by.turn_x_x * n.x + by.turn_x_y * n.y + by.turn_x_z * n.z,
                    by.turn_y_x * n.x + by.turn_y_y * n.y + by.turn_y_z * n.z,
                    by.turn_z_x * n.x + by.turn_z_y * n.y + by.turn_z_z * n.z);
    double size = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return size > 0.0lf ? dvec3(v.x / size, v.y / size, v.z / size) : v;
}

// `index`: three per triangle, starting at a multiple of three.
REAL3 load_normal(body_record body, uint index) {
    instance_record by = load_instance(body.instance);
    uint corner = index % 3u;
    bool exchanged = (by.flags & INSTANCE_MIRRORED) != 0u && corner != 0u;
    uint at = NORMAL64_WORDS * (exchanged ? index - corner + 3u - corner : index);
    uvec4 xy = FETCH(normals, at), z = FETCH(normals, at + 1u);
    dvec3 n = dvec3(packDouble2x32(xy.xy), packDouble2x32(xy.zw), packDouble2x32(z.xy));
    dvec3 turned = turned_normal(n, by);
    return REAL3(body.instance == 0u ? n : turned);
}

// ---- whether a triangle near its start concerns a ray

// A search of flattened triangles sees those whose boxes it hits. Here the boxes are others, so each triangle is asked
// the same question by itself: if a triangle matters only because of the rounding of the ray's start, the answer must
// not depend on where its box lies.
#ifdef DOUBLE_PRECISION
#define MEETS_BOX(triangle, ray) true
#else
bool meets_box(triangle_record triangle, vec3 origin, vec3 inverse) {
    vec3 lower = min(min(triangle.v0, triangle.v1), triangle.v2), upper = max(max(triangle.v0, triangle.v1), triangle.v2);
    float pad = largest3(max(abs(lower), abs(upper))) * TRIANGLE_BOX_PAD;
    vec3 a = (lower - pad - origin) * inverse, b = (upper + pad - origin) * inverse;
    vec3 first = min(a, b), last = max(a, b);
    return max(largest3(first), 0.0) <= min(min(last.x, last.y), last.z) * BOX_FAR_SCALE;
}
#define MEETS_BOX(triangle, ray) meets_box(triangle, ray.origin, ray.inverse)
#endif

// ---- the two levels of a search

// The ray in the space of an instance's tree, with the same t. Where rounding leaves its start open, it also covers
// what lies behind the start, as far as a triangle may reach.
tree_ray entered_ray(uint instance, REAL3 origin, REAL3 direction, bool is_open) {
    entry_record e = load_entry(instance);
    REAL3 place = REAL3(dot3(e.row_x, origin) + e.offset_x, dot3(e.row_y, origin) + e.offset_y,
                        dot3(e.row_z, origin) + e.offset_z);
    REAL3 along = REAL3(dot3(e.row_x, direction), dot3(e.row_y, direction), dot3(e.row_z, direction));
    REAL begin = 0.0;
#ifndef DOUBLE_PRECISION
    begin = is_open ? -e.edge / largest3(abs(direction)) : 0.0;
#endif
    tree_ray ray = make_tree_ray(place + along * begin, along);
    REAL3 sum = REAL3(dot3(abs(e.row_x), REAL3(1.0)), dot3(abs(e.row_y), REAL3(1.0)), dot3(abs(e.row_z), REAL3(1.0)));
    ray.pad = (sum * (e.reach + e.unit * largest3(abs(origin))) + e.margin) * abs(ray.inverse);
    ray.begin = begin;
    return ray;
}

// Removes the next node from the group, as next_node does. `enters`: it is a leaf of the upper tree.
uint next_entry(inout uvec2 group, uint flip, out bool enters) {
    uint slot = ((floatBitsToUint(float(int(group.y >> 24u))) >> 23u) - 127u) ^ flip;
    enters = has_nodes(group) && (group.y & (0x100u << (slot & 7u))) != 0u;
    return next_node(group, flip);
}

// A search has two rays: `ray` goes through the nodes, `flat_ray` replaces it when an instance is left. The next node,
// `node_at`, is known before the iteration that opens it: a leaf of the upper tree is not opened but entered. lavapipe runs
// the body of an `if` for all lanes, and would transform a ray at every node: there lanes that found a leaf wait outside a
// loop of their own.
#ifdef LONG_RAYS_KEPT
#define INSTANCE_RESUME(ray, start, direction, group)                                                       \
    if (HAS_LONG_RAYS && group.x >= frame.top_nodes) {                                                      \
        see_instance(long_instance);                                                                         \
        ray = entered_ray(long_instance, start.at, direction, start.slack > 0.0);                            \
    }
#define INSTANCE_KEPT(group, more)                                                                           \
    if (HAS_LONG_RAYS && more) {                                                                             \
        group = group_before;                                                                                \
        long_instance = seen_instance;                                                                       \
    }
#else
#define INSTANCE_RESUME(ray, start, direction, group)
#define INSTANCE_KEPT(group, more)
#endif
#define INSTANCE_ENTER(ray, start, direction)                                                                \
    if (enters) {                                                                                            \
        node_record leaf = load_triangle_node(node_at);                                                      \
        see_instance(leaf.first_item);                                                                       \
        ray = entered_ray(leaf.first_item, start.at, direction, start.slack > 0.0);                          \
        node_at = leaf.first_node;                                                                           \
        enters = false;                                                                                      \
    }
#define INSTANCES_FIRST(ray, start, direction, group)                                                        \
    tree_ray flat_ray = ray;                                                                                 \
    INSTANCE_RESUME(ray, start, direction, group)                                                            \
    bool enters = false;                                                                                     \
    uvec2 group_before = group;                                                                              \
    uint node_at = next_entry(group, ray.flip, enters);
#ifdef FETCH_TEXELS
#define INSTANCES_BEGIN(ray, start, direction, group)                                                        \
    INSTANCES_FIRST(ray, start, direction, group)                                                            \
    do {                                                                                                     \
        iterations++;                                                                                        \
        INSTANCE_ENTER(ray, start, direction)
#define INSTANCE_NEXT(ray, start, direction)
#define INSTANCE_SEEN (!enters)
#define INSTANCES_END(group, more, count, limit)                                                             \
    } while (more && count < limit);                                                                         \
    INSTANCE_KEPT(group, more)
#else
#define INSTANCES_BEGIN(ray, start, direction, group) INSTANCES_FIRST(ray, start, direction, group)
#define INSTANCE_NEXT(ray, start, direction) INSTANCE_ENTER(ray, start, direction)
#define INSTANCE_SEEN true
#define INSTANCES_END(group, more, count, limit) INSTANCE_KEPT(group, more)
#endif
#define NODE_AT(group, ray) node_at
// After a node: which of its children are leaves of the upper tree.
#define INSTANCE_FOUND(node, found)                                                                          \
    if (node_at < frame.top_nodes)                                                                           \
        found.y |= node.first_item << 8u;
// After the next group is chosen.
#define INSTANCE_LEFT(ray, group)                                                                           \
    if (group.x < frame.top_nodes)                                                                           \
        ray = flat_ray;                                                                                      \
    group_before = group;                                                                                    \
    node_at = next_entry(group, ray.flip, enters);
// An item of the open node.
#define INSTANCE_ITEM(item) (item + seen.first_item)
#else
#define MEETS_BOX(triangle, ray) true
#define load_tested(item) load_triangle(item)
#define see_item(item)
#define INSTANCES_BEGIN(ray, start, direction, group)
#define INSTANCE_NEXT(ray, start, direction)
#define INSTANCE_SEEN true
#define INSTANCES_END(group, more, count, limit)
#define NODE_AT(group, ray) next_node(group, ray.flip)
#define INSTANCE_FOUND(node, found)
#define INSTANCE_LEFT(ray, group)
#define INSTANCE_ITEM(item) item
#endif
