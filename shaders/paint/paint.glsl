// Colours that differ from place to place: images, and checkers that are filtered (docs/language.md, "Paint").
//
// The footprint of a pixel is that of a cone around its ray (Akenine-Moeller, Crassin, Boksansky, Belcour, Panteleev
// and Wright 2021, "Improved Shader and Texture Level of Detail Using Ray Cones"): on a surface an ellipse, whose longer
// axis is walked in as many taps as the shorter one fits into it.

const bool HAS_PAINT = HAS_TEXTURES || HAS_FOOTPRINT;
const uint TAPS_MAX = 16u;
// What the taps of surfaces may add to an iteration: of two images, or of one and a checker; of a surface that light shines through too.
const uint PAINT_ITERATIONS = HAS_FOOTPRINT ? (HAS_CLEAR_SHADOWS ? 2u : 1u) * (2u * TAPS_MAX + 4u) : 0u;

// How wide a pixel is along a ray: at its start, and what it gains for each length. Negative where rays have crossed.
#define RAY_CONE vec2
// The cone of the ray whose hit becomes a surface.
RAY_CONE surface_cone = vec2(0.0);

// Where a surface is hit in its coordinates, and how these change along the two axes of the footprint.
struct paint_spot {
    REAL2 at;
    vec2 along, across;
    REAL3 axis_along, axis_across; // in flat space
};

// ---- the footprint

// `width` of the cone, across the ray; `facing`: the surface's normal, towards the ray.
void footprint_axes(float width, REAL3 direction, REAL3 facing, out REAL3 along, out REAL3 across) {
    REAL cosine = max(-dot3(direction, facing), 1e-6);
    REAL3 flat_direction = direction - facing * dot3(direction, facing);
    bool is_straight = dot3(flat_direction, flat_direction) < 1e-8;
    REAL3 other = cross3(facing, abs(facing.x) < 0.5 ? REAL3(1.0, 0.0, 0.0) : REAL3(0.0, 1.0, 0.0));
    along = unit3(is_straight ? other : flat_direction);
    across = unit3(cross3(facing, along)) * abs(width);
    along = along * (abs(width) / cosine);
}

// How the weights of a triangle's second and third corner change along an axis.
vec2 weights_along(REAL3 edge1, REAL3 edge2, REAL3 axis) {
    REAL scale = inverse_power(max(largest3(abs(edge1)), largest3(abs(edge2))));
    REAL3 a = edge1 * scale, b = edge2 * scale, way = axis * scale;
    REAL3 normal = cross3(a, b);
    REAL area2 = dot3(normal, normal);
    return vec2(float(dot3(cross3(b, normal), way) / area2), float(dot3(cross3(normal, a), way) / area2));
}

// ---- texels

uint component_of(uvec4 word, uint i) {
    return (i & 2u) == 0u ? ((i & 1u) == 0u ? word.x : word.y) : ((i & 1u) == 0u ? word.z : word.w);
}

float decoded(paint_record p, uint value) {
    return p.table == 0u ? float(value) / 255.0 : uintBitsToFloat(FETCH(paints, p.table + value).x);
}

// `level`: its first texel, counted in words of bytes or of floats; width, height.
vec3 image_texel(paint_record p, uvec4 level, int x, int y) {
    uint i = level.x + uint(y) * level.y + uint(x);
    vec3 color;
    if ((p.flags & PAINT_FLOATS) != 0u) {
        color = uintBitsToFloat(FETCH(paints, i).xyz);
    } else {
        uint bytes = component_of(FETCH(paints, i >> 2u), i);
        color = vec3(decoded(p, bytes & 255u), decoded(p, bytes >> 8u & 255u), decoded(p, bytes >> 16u & 255u));
    }
    return color;
}

// From any coordinate to 0..1.
float folded(paint_record p, REAL x) {
    REAL rest = x - 2.0 * floor(x * 0.5);
    REAL inside = rest > 1.0 ? 2.0 - rest : rest;
    inside = (p.flags & PAINT_MIRROR) != 0u ? inside : x - floor(x);
    inside = (p.flags & PAINT_CLAMP) != 0u ? clamp(x, 0.0, 1.0) : inside;
    return float(inside);
}

// The two texels beside a place along one side.
ivec2 beside(paint_record p, float low, int size) {
    int first = int(clamp(low, -1.0, float(size) - 1.0)), second = first + 1;
    bool wraps = (p.flags & (PAINT_MIRROR | PAINT_CLAMP)) == 0u;
    first = first < 0 ? (wraps ? size - 1 : 0) : first;
    second = second >= size ? (wraps ? 0 : size - 1) : second;
    return ivec2(first, second);
}

vec3 image_nearest(paint_record p, REAL2 at) {
    uvec4 level = FETCH(paints, p.levels);
    float x = min(floor(folded(p, at.x) * float(level.y)), float(level.y) - 1.0);
    float y = min(floor((1.0 - folded(p, at.y)) * float(level.z)), float(level.z) - 1.0);
    return image_texel(p, level, int(x), int(y));
}

vec3 image_bilinear(paint_record p, uint number, REAL2 at) {
    uvec4 level = FETCH(paints, p.levels + number);
    float x = folded(p, at.x) * float(level.y) - 0.5, y = (1.0 - folded(p, at.y)) * float(level.z) - 0.5;
    float x0 = floor(x), y0 = floor(y);
    ivec2 column = beside(p, x0, int(level.y)), row = beside(p, y0, int(level.z));
#ifdef WEBGPU
    // The same sums, texel by texel: a browser's compiler puts each call's code in its place.
    vec3 sum = vec3(0.0), side = vec3(0.0);
    for (uint i = 0u; i < 4u + OPAQUE_ZERO; i++) {
        vec3 texel = image_texel(p, level, (i & 1u) == 0u ? column.x : column.y, i < 2u ? row.x : row.y);
        side = (i & 1u) == 0u ? texel * (1.0 - (x - x0)) : side + texel * (x - x0);
        if ((i & 1u) != 0u)
            sum = i < 2u ? side * (1.0 - (y - y0)) : sum + side * (y - y0);
    }
    return sum;
#else
    vec3 upper = image_texel(p, level, column.x, row.x) * (1.0 - (x - x0)) + image_texel(p, level, column.y, row.x) * (x - x0);
    vec3 lower = image_texel(p, level, column.x, row.y) * (1.0 - (x - x0)) + image_texel(p, level, column.y, row.y) * (x - x0);
    return upper * (1.0 - (y - y0)) + lower * (y - y0);
#endif
}

// ---- images

uint taps_of(float longer, float shorter) {
    return longer >= float(TAPS_MAX) * shorter ? TAPS_MAX : longer <= shorter ? 1u : uint(ceil(longer / shorter));
}

// Grows by one with each power of two, and evenly between them.
float level_of(float size, uint count) {
    float part = size * uintBitsToFloat(0x7f000000u - (floatBitsToUint(size) & 0x7f800000u));
    float level = float(int(floatBitsToUint(size) >> 23u) - 127) + (part - 1.0);
    return size > 1.0 ? min(level, float(count) - 1.0) : 0.0;
}

vec3 image_filtered(paint_record p, REAL2 at, vec2 along, vec2 across) {
    vec2 size = vec2(FETCH(paints, p.levels).yz);
    vec2 a = along * size, b = across * size;
    float la = sqrt(a.x * a.x + a.y * a.y), lb = sqrt(b.x * b.x + b.y * b.y);
    bool is_across = lb > la;
    float longer = max(la, lb), shorter = min(la, lb);
    vec2 axis = is_across ? across : along;
    uint taps = longer > 1.0 ? taps_of(longer, max(shorter, 1.0)) : 1u;
    float level = level_of(max(longer / float(taps), shorter), p.level_count);
    uint below = uint(level);
    float share = level - float(below);
    vec3 sum = vec3(0.0);
    // The last level's next is itself: lavapipe computes it for all lanes.
    uint above = min(below + 1u, p.level_count - 1u);
    for (uint i = 0u; i < taps; i++) {
        if (i < taps) {
            REAL2 tap = at + REAL2(axis * ((float(i) + 0.5) / float(taps) - 0.5));
#ifdef WEBGPU
            vec3 level_sum = vec3(0.0);
            for (uint k = 0u; k < 2u + OPAQUE_ZERO; k++) {
                vec3 color = image_bilinear(p, k == 0u ? below : above, tap);
                level_sum = k == 0u ? color * (1.0 - share) : level_sum + color * share;
            }
            sum += level_sum;
#else
            sum += image_bilinear(p, below, tap) * (1.0 - share) + image_bilinear(p, above, tap) * share;
#endif
        }
    }
    return sum / float(taps);
}

vec2 turned(paint_record p, vec2 v) {
    return vec2(p.row_u.x * v.x + p.row_u.y * v.y, p.row_v.x * v.x + p.row_v.y * v.y);
}

vec3 image_color(paint_record p, paint_spot spot) {
    REAL2 at = REAL2(REAL(p.row_u.x) * spot.at.x + REAL(p.row_u.y) * spot.at.y + REAL(p.row_u.z),
                     REAL(p.row_v.x) * spot.at.x + REAL(p.row_v.y) * spot.at.y + REAL(p.row_v.z));
    vec3 color = vec3(0.0);
    if ((p.flags & PAINT_NEAREST) != 0u)
        color = image_nearest(p, at);
    else if (HAS_FOOTPRINT && (p.flags & PAINT_AUTO) != 0u)
        color = image_filtered(p, at, turned(p, spot.along), turned(p, spot.across));
    else
        color = image_bilinear(p, 0u, at);
    return color;
}

// ---- checkers

// Mean over a way of width w around x of what is 1 in even cells and -1 in odd ones.
float wave(REAL x, float w) {
    REAL cell = floor(x), odd = cell - 2.0 * floor(cell * 0.5);
    float at = float(x - cell + odd), low = at - 0.5 * w, high = at + 0.5 * w; // even cells begin at 0
    float a = low - 2.0 * floor(low * 0.5), b = high - 2.0 * floor(high * 0.5);
    float mean = ((b < 1.0 ? b : 2.0 - b) - (a < 1.0 ? a : 2.0 - a)) / w;
    return floor(low) == floor(high) ? (odd != 0.0 ? -1.0 : 1.0) : mean;
}

// The share of odd cells: the footprint is cut into boxes along its longer axis. `is_flat`: there are two coordinates.
float odd_share(REAL3 at, vec3 along, vec3 across, bool is_flat) {
    float la = float(sqrt(dot3(REAL3(along), REAL3(along)))), lb = float(sqrt(dot3(REAL3(across), REAL3(across))));
    bool is_across = lb > la;
    vec3 axis = is_across ? across : along, other = is_across ? along : across;
    uint taps = taps_of(max(la, lb), min(la, lb));
    vec3 w = abs(axis) / float(taps) + abs(other);
    float sum = 0.0;
    for (uint i = 0u; i < taps; i++) {
        if (i < taps) {
            REAL3 tap = at + REAL3(axis * ((float(i) + 0.5) / float(taps) - 0.5));
            float third = wave(tap.z, w.z);
            sum += wave(tap.x, w.x) * wave(tap.y, w.y) * (is_flat ? 1.0 : third);
        }
    }
    return 0.5 - 0.5 * sum / float(taps);
}

// ---- coordinates

// Of a mesh's triangle: two words of its three corners, from the body's first one on.
void mesh_spot(uint coordinates, uint triangle, REAL b1, REAL b2, vec2 db_along, vec2 db_across, inout paint_spot spot) {
    uint at = (coordinates & ~1u) + 2u * triangle;
    vec4 first = uintBitsToFloat(FETCH(paints, at));
    vec2 third = uintBitsToFloat(FETCH(paints, at + 1u).xy);
    bool exchanged = (coordinates & 1u) != 0u;
    vec2 t0 = first.xy, t1 = (exchanged ? third : first.zw) - t0, t2 = (exchanged ? first.zw : third) - t0;
    spot.at = REAL2(t0) + REAL2(t1) * b1 + REAL2(t2) * b2;
    spot.along = t1 * db_along.x + t2 * db_along.y;
    spot.across = t1 * db_across.x + t2 * db_across.y;
}

void half_spot(bool is_second, REAL2 at, vec2 db_along, vec2 db_across, inout paint_spot spot) {
    vec2 a = db_along, b = db_across;
    spot.at = at;
    spot.along = is_second ? vec2(a.x, a.x + a.y) : vec2(a.x + a.y, a.y);
    spot.across = is_second ? vec2(b.x, b.x + b.y) : vec2(b.x + b.y, b.y);
}

// Longitude and latitude of a sphere's unit normal, as the background's; v grows to +y.
vec2 sphere_change(vec3 o, vec3 axis, float radius) {
    vec3 way = axis / radius;
    float around2 = max(o.x * o.x + o.z * o.z, 1e-12);
    return vec2((o.x * way.z - o.z * way.x) / around2 * (0.5 / PI), way.y / sqrt(around2) * (1.0 / PI));
}

void sphere_spot(REAL3 outward, REAL radius, inout paint_spot spot) {
    vec3 o = vec3(outward);
    float around = sqrt(o.x * o.x + o.z * o.z);
    spot.at = REAL2(0.5 + arctan2(o.z, o.x) * (0.5 / PI), 1.0 - arctan2(around, o.y) * (1.0 / PI));
    spot.along = sphere_change(o, vec3(spot.axis_along), float(radius));
    spot.across = sphere_change(o, vec3(spot.axis_across), float(radius));
}

// ---- cones

RAY_CONE camera_cone(REAL3 direction) {
    vec2 cone = vec2(0.0, frame.footprint * float(dot3(direction, CAMERA(forward))));
    uint projection = frame.projection + OPAQUE_ZERO;
    if (HAS_CAMERA && projection == PROJECTION_ORTHOGRAPHIC)
        cone = vec2(frame.footprint, 0.0);
    else if (HAS_CAMERA && projection != PROJECTION_PERSPECTIVE)
        cone = vec2(0.0, frame.footprint);
    return cone;
}
