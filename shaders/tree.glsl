// The 8-wide compressed tree of gpu_scene.h: one node against one ray.
//
// Ylitie, Karras, Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs",
// sections 4.1 and 4.2, with a decoding that never loses a hit: t = (p - o)/d + q * (2^e/d), the far side
// multiplied by BOX_FAR_SCALE. In double precision t counts from where the ray enters the node, so single
// precision is enough from there: see gpu_scene.h.

struct tree_ray {
    REAL3 origin;
    REAL3 inverse; // 1/direction, finite
    uint flip;    // 7 - octant: slots are visited in the order of slot ^ flip, highest first
    uint flip4;   // in each byte
#ifdef INSTANCES
    REAL3 pad;    // how much earlier and later than its planes a box begins and ends
    REAL begin;   // the value that the ray's t counts from
#endif
};

tree_ray make_tree_ray(REAL3 origin, REAL3 direction) {
    tree_ray ray;
    ray.origin = origin;
    // A component of 0 would give 0 * infinity on the planes of a box.
    REAL3 size = max(abs(direction), REAL3(1.0e-20));
    ray.inverse = REAL3(direction.x < 0.0 ? -1.0 : 1.0, direction.y < 0.0 ? -1.0 : 1.0,
                        direction.z < 0.0 ? -1.0 : 1.0) / size;
    ray.flip = (direction.x < 0.0 ? 0u : 4u) | (direction.y < 0.0 ? 0u : 2u) | (direction.z < 0.0 ? 0u : 1u);
    ray.flip4 = ray.flip * 0x01010101u;
#ifdef INSTANCES
    ray.pad = REAL3(0.0);
    ray.begin = 0.0;
#endif
    return ray;
}

// Byte k of `bytes`, still times 256^k for k < 3: the axis' scale is divided by this factor instead.
float byte_scaled(uint bytes, uint k) {
    return k == 3u ? float(int(bytes >> 24u)) : float(int(bytes & (0xffu << (8u * k))));
}

// A node relative to a ray: plane q of an axis lies at base + q * scale, a far one at far_base + q * scale.
#ifdef INSTANCES
#define FAR_BASE(f) f.far_base
#else
#define FAR_BASE(f) f.base
#endif
#ifdef DOUBLE_PRECISION
struct node_frame {
    vec3 base, scale;
#ifdef INSTANCES
    vec3 far_base;
#endif
    float t_max, t_min; // relative to the t at which the ray enters the node
    float slack;
};
#define NODE_BEGIN(f)    f.t_min
#define NODE_LEAVE(f, t) (t + f.slack)
#else
struct node_frame {
    vec3 base, scale;
#ifdef INSTANCES
    vec3 far_base;
#endif
    float t_max;
};
#define NODE_BEGIN(f)    0.0
#define NODE_LEAVE(f, t) (t * BOX_FAR_SCALE)
#endif

// The larger and the smaller of two floats, by their bits: lavapipe's own take three instructions, because of NaN.
// For two negative floats they give the wrong one, which does not matter to boxes because rays begin at 0.
#ifdef DOUBLE_PRECISION
#define MOST(a, b)  LARGER(a, b)
#define LEAST(a, b) SMALLER(a, b)
#else
#define MOST(a, b)  intBitsToFloat(max(floatBitsToInt(a), floatBitsToInt(b)))
#define LEAST(a, b) intBitsToFloat(min(floatBitsToInt(a), floatBitsToInt(b)))
#endif

node_frame make_node_frame(node_record node, tree_ray ray, bvec3 up, REAL t_max) {
    uint e = node.exponents;
    vec3 cell = vec3(uintBitsToFloat((e & 0xffu) << 23u), uintBitsToFloat((e & 0xff00u) << 15u),
                     uintBitsToFloat((e & 0xff0000u) << 7u));
    node_frame f;
#ifdef DOUBLE_PRECISION
    dvec3 base = (dvec3(node.corner) - ray.origin) * ray.inverse;
    dvec3 enter = base + dvec3(up.x ? 0.0 : 255.0, up.y ? 0.0 : 255.0, up.z ? 0.0 : 255.0) * dvec3(cell) * ray.inverse;
    double t = largest3(enter);
#ifdef INSTANCES
    f.base = vec3(base - ray.pad - t);
    f.far_base = vec3(base + ray.pad - t);
#else
    f.base = vec3(base - t);
#endif
    f.scale = cell * vec3(ray.inverse);
    f.t_max = float(t_max - t);
    f.t_min = float(-t);
    f.slack = float(abs(t)) * BOX_SLACK;
#else
    f.scale = cell * ray.inverse;
    f.base = (node.corner - ray.origin) * ray.inverse;
#ifdef INSTANCES
    f.far_base = f.base + ray.pad;
    f.base -= ray.pad;
    f.t_max = t_max - ray.begin;
#else
    f.t_max = t_max;
#endif
#endif
    return f;
}

// Hits of children 4h .. 4h+3, whose near and far planes are given: bits 24..31 inner nodes by order of
// visit, bits 0..23 leaf items.
uint node_half(uvec3 near, uvec3 far, uint meta, node_frame f, uint flip4) {
    uint inner = (meta & (meta << 1u)) & 0x10101010u;
    uint bits = (meta ^ (flip4 & ((inner >> 4u) * 0xffu))) & 0x1f1f1f1fu;
    uint counts = (meta >> 5u) & 0x07070707u;
    uint hits = 0u;
    for (uint k = 0u; k < 4u; k++) {
        vec3 unit = f.scale * (k == 1u ? 1.0 / 256.0 : k == 2u ? 1.0 / 65536.0 : 1.0);
        vec3 q_near = vec3(byte_scaled(near.x, k), byte_scaled(near.y, k), byte_scaled(near.z, k));
        vec3 q_far = vec3(byte_scaled(far.x, k), byte_scaled(far.y, k), byte_scaled(far.z, k));
        // Fused or not, the boxes stay conservative, and all that they let through is tested exactly.
        vec3 t_near = fma(q_near, unit, f.base), t_far = fma(q_far, unit, FAR_BASE(f));
        float enter = MOST(MOST(t_near.x, t_near.y), MOST(t_near.z, NODE_BEGIN(f)));
        float leave = NODE_LEAVE(f, LEAST(LEAST(t_far.x, t_far.y), LEAST(t_far.z, f.t_max)));
        uint found = ((counts >> (8u * k)) & 0xffu) << ((bits >> (8u * k)) & 0x1fu);
        hits |= enter <= leave ? found : 0u;
    }
    return hits;
}

uint node_hits(node_record node, tree_ray ray, REAL t_max) {
    bool x_up = (ray.flip & 4u) != 0u, y_up = (ray.flip & 2u) != 0u, z_up = (ray.flip & 1u) != 0u;
    node_frame f = make_node_frame(node, ray, bvec3(x_up, y_up, z_up), t_max);
    uvec3 near_a = uvec3(x_up ? node.low_x_a : node.high_x_a, y_up ? node.low_y_a : node.high_y_a,
                         z_up ? node.low_z_a : node.high_z_a);
    uvec3 near_b = uvec3(x_up ? node.low_x_b : node.high_x_b, y_up ? node.low_y_b : node.high_y_b,
                         z_up ? node.low_z_b : node.high_z_b);
    uvec3 far_a = uvec3(x_up ? node.high_x_a : node.low_x_a, y_up ? node.high_y_a : node.low_y_a,
                        z_up ? node.high_z_a : node.low_z_a);
    uvec3 far_b = uvec3(x_up ? node.high_x_b : node.low_x_b, y_up ? node.high_y_b : node.low_y_b,
                        z_up ? node.high_z_b : node.low_z_b);
    return node_half(near_a, far_a, node.meta_a, f, ray.flip4) |
           node_half(near_b, far_b, node.meta_b, f, ray.flip4);
}

// Inner nodes still to be visited below one parent: the first child, hits in bits 24..31, the parent's mask
// of inner children in bits 0..7.
uvec2 root_group() { return uvec2(0u, 0x80000000u); }
bool has_nodes(uvec2 group) { return group.y > 0x00ffffffu; }

// Removes the next node from the group.
uint next_node(inout uvec2 group, uint flip) {
    // The exponent of the float is the highest bit: cheaper than findMSB where that is emulated.
    uint bit = (floatBitsToUint(float(int(group.y >> 24u))) >> 23u) - 127u;
    group.y &= ~(0x1000000u << bit);
    uint slot = bit ^ flip;
    return group.x + bitCount(group.y & ((1u << slot) - 1u) & 0xffu);
}

// The groups that wait on the way back to the root. lavapipe writes an indexed private array lane by lane, a
// fifth of the whole time: there all levels shift by one instead, which costs two blends per level and word,
// and a group is one word if node numbers are short enough. An empty group, 0, is the bottom.
#ifdef FETCH_TEXELS
uint packed_group(uvec2 group) {
    return PACKED_GROUPS ? (group.x << 16u) | ((group.y >> 16u) & 0xff00u) | (group.y & 0xffu) : group.y;
}
uvec2 unpacked_group(uint word, uint base) {
    return PACKED_GROUPS ? uvec2(word >> 16u, ((word << 16u) & 0xff000000u) | (word & 0xffu)) : uvec2(base, word);
}
#define STACK(levels)                                                                                        \
    uint stack[levels], bases[PACKED_GROUPS ? 1u : levels];                                                  \
    for (int i = 0; i < int(levels); i++) {                                                                  \
        stack[i] = 0u;                                                                                       \
        if (!PACKED_GROUPS)                                                                                  \
            bases[i] = 0u;                                                                                   \
    }
#define STACK_MOVE(levels, words, below, push, pop)                                                          \
    {                                                                                                        \
        uint under = below;                                                                                  \
        for (int i = 0; i < int(levels); i++) {                                                              \
            uint here = words[i], above = i + 1 < int(levels) ? words[i + 1] : 0u;                           \
            words[i] = push ? under : pop ? above : here;                                                    \
            under = here;                                                                                    \
        }                                                                                                    \
    }
#define STACK_NEXT(levels, group, rest, found, more)                                                         \
    {                                                                                                        \
        bool push = has_nodes(found) && has_nodes(rest), pop = !has_nodes(found) && !has_nodes(rest);        \
        uvec2 top = unpacked_group(stack[0], PACKED_GROUPS ? 0u : bases[0]);                                 \
        group = has_nodes(found) ? found : has_nodes(rest) ? rest : top;                                     \
        STACK_MOVE(levels, stack, packed_group(rest), push, pop)                                             \
        if (!PACKED_GROUPS)                                                                                  \
            STACK_MOVE(levels, bases, rest.x, push, pop)                                                     \
        more = has_nodes(group);                                                                             \
    }
#define STACK_GET(i) uvec2(stack[i], PACKED_GROUPS ? 0u : bases[i])
#define STACK_PUT(i, entry)                                                                                  \
    stack[i] = entry.x;                                                                                      \
    if (!PACKED_GROUPS)                                                                                      \
        bases[i] = entry.y;
#define STACK_TAKE_SIZE
#define STACK_KEEP_SIZE
#else
#define STACK(levels)                                                                                        \
    uvec2 stack[levels];                                                                                     \
    uint size = 0u;
#define STACK_NEXT(levels, group, rest, found, more)                                                         \
    group = found;                                                                                           \
    if (!has_nodes(found)) {                                                                                 \
        group = rest;                                                                                        \
        if (!has_nodes(rest) && size > 0u)                                                                   \
            group = stack[--size];                                                                           \
    } else if (has_nodes(rest)) {                                                                            \
        stack[size++] = rest;                                                                                \
    }                                                                                                        \
    more = has_nodes(group);
#define STACK_GET(i)        stack[i]
#define STACK_PUT(i, entry) stack[i] = entry;
#define STACK_TAKE_SIZE     size = long_size;
#define STACK_KEEP_SIZE     long_size = size;
#endif

// Kernels that keep no rays: what a ray has not found by ITERATION_LIMIT it never finds.
#ifndef TRAVERSAL_LIMIT
#define TRAVERSAL_LIMIT ITERATION_LIMIT
#define STACK_RESUME(levels, tree, group)
#define STACK_SUSPEND(levels, tree, group, more)
#define LONG_TAKE(wrong, doubt)
#define LONG_KEEP(wrong, doubt)
const bool HAS_LONG_RAYS = false;
#endif
