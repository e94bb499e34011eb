// Colours that differ from place to place: images, and checkers that are filtered (docs/language.md, "Paint").
//
// The footprint of a pixel is that of a cone around its ray (Akenine-Moeller, Crassin, Boksansky, Belcour, Panteleev and
// Wright 2021, "Improved Shader and Texture Level of Detail Using Ray Cones"): on a surface an ellipse, whose longer
// axis is cut into as many parts as the shorter axis fits into it.

const bool HAS_PAINT = HAS_TEXTURES || HAS_FOOTPRINT;
const uint TAPS_MAX = 15u; // odd
// How much the taps of surfaces may add to an iteration: for two images, or for one and a checker; also for a surface that light shines
// through.
const uint PAINT_ITERATIONS = HAS_FOOTPRINT ? (HAS_CLEAR_SHADOWS ? 2u : 1u) * (2u * TAPS_MAX + 4u) : 0u;

// How wide a pixel is along a ray: its width at the start, and its growth per length. Negative where rays have crossed. In
// the kernel's precision, because focusing lenses and mirrors leave a small difference of large numbers.
#define RAY_CONE REAL2
// The cone of the ray whose hit is made into a surface.
RAY_CONE surface_cone = REAL2(0.0);

// A hit in a surface's coordinates, and how these change along the two axes of the footprint.
struct paint_spot {
    REAL2 at;
    REAL2 along, across;
    REAL3 axis_along, axis_across; // in flat space
};

// ---- the footprint

// `width` of the cone, across the ray; `facing`: the surface's normal, towards the ray.
void footprint_axes(REAL width, REAL3 direction, REAL3 facing, out REAL3 along, out REAL3 across) {
    REAL cosine = max(-dot3(direction, facing), 1e-6);
    REAL3 flat_direction = direction - facing * dot3(direction, facing);
    bool is_straight = dot3(flat_direction, flat_direction) < 1e-8;
    REAL3 other = cross3(facing, abs(facing.x) < 0.5 ? REAL3(1.0, 0.0, 0.0) : REAL3(0.0, 1.0, 0.0));
    along = unit3(is_straight ? other : flat_direction);
    across = unit3(cross3(facing, along)) * abs(width);
    along = along * (abs(width) / cosine);
}

// How the weights of a triangle's second and third corner change along an axis.
REAL2 weights_along(REAL3 edge1, REAL3 edge2, REAL3 axis) {
    REAL scale = inverse_power(max(largest3(abs(edge1)), largest3(abs(edge2))));
    REAL3 a = edge1 * scale, b = edge2 * scale, way = axis * scale;
    REAL3 normal = cross3(a, b);
    REAL area2 = dot3(normal, normal);
    return REAL2(dot3(cross3(b, normal), way) / area2, dot3(cross3(normal, a), way) / area2);
}

// ---- texels

uint component_of(uvec4 word, uint i) {
    return (i & 2u) == 0u ? ((i & 1u) == 0u ? word.x : word.y) : ((i & 1u) == 0u ? word.z : word.w);
}

float decoded(paint_record p, uint value) {
    return p.table == 0u ? float(value) / 255.0 : uintBitsToFloat(FETCH(paints, p.table + value).x);
}

// Sixteen bits after the point, and a power of two from -31 to 0: gpu_scene.h.
float unpacked(uint bits) { return bits == 0u ? 0.0 : uintBitsToFloat((bits << 7u) + 0x30000000u); }

// `level`: its first texel, counted in texels; width, height, kind.
vec3 image_texel(paint_record p, uvec4 level, int x, int y) {
    uint i = level.x + uint(y) * level.y + uint(x);
    uvec4 word = FETCH(paints, i >> level.w);
    vec3 color = uintBitsToFloat(word.xyz);
    if (level.w == TEXELS_BYTES) {
        uint bytes = component_of(word, i);
        color = vec3(decoded(p, bytes & 255u), decoded(p, bytes >> 8u & 255u), decoded(p, bytes >> 16u & 255u));
    }
    uvec2 two = (i & 1u) == 0u ? word.xy : word.zw;
    if (level.w == TEXELS_PACKED)
        color = vec3(unpacked(two.x & 0x1fffffu), unpacked((two.x >> 21u) | (two.y & 0x3ffu) << 11u), unpacked(two.y >> 10u));
    return color;
}

// Maps any coordinate to 0..1.
REAL folded(paint_record p, REAL x) {
    REAL rest = x - 2.0 * floor(x * 0.5);
    REAL inside = rest > 1.0 ? 2.0 - rest : rest;
    inside = (p.flags & PAINT_MIRROR) != 0u ? inside : x - floor(x);
    return (p.flags & PAINT_CLAMP) != 0u ? clamp(x, 0.0, 1.0) : inside;
}

// The two texels beside a place along one side.
ivec2 beside(paint_record p, REAL low, int size) {
    int first = int(clamp(low, -1.0, REAL(size) - 1.0)), second = first + 1;
    bool wraps = (p.flags & (PAINT_MIRROR | PAINT_CLAMP)) == 0u;
    first = first < 0 ? (wraps ? size - 1 : 0) : first;
    second = second >= size ? (wraps ? 0 : size - 1) : second;
    return ivec2(first, second);
}

vec3 image_nearest(paint_record p, REAL2 at) {
    uvec4 level = FETCH(paints, p.levels);
    REAL x = min(floor(folded(p, at.x) * REAL(level.y)), REAL(level.y) - 1.0);
    REAL y = min(floor((1.0 - folded(p, at.y)) * REAL(level.z)), REAL(level.z) - 1.0);
    return image_texel(p, level, int(x), int(y));
}

vec3 image_bilinear(paint_record p, uint number, REAL2 at) {
    uvec4 level = FETCH(paints, p.levels + number);
    REAL x = folded(p, at.x) * REAL(level.y) - 0.5, y = (1.0 - folded(p, at.y)) * REAL(level.z) - 0.5;
    REAL x0 = floor(x), y0 = floor(y);
    float right = float(x - x0), low = float(y - y0);
    ivec2 column = beside(p, x0, int(level.y)), row = beside(p, y0, int(level.z));
#ifdef WEBGPU
    // The same sums, texel by texel: a browser's compiler inlines every call.
    vec3 sum = vec3(0.0), side = vec3(0.0);
    for (uint i = 0u; i < 4u + OPAQUE_ZERO; i++) {
        vec3 texel = image_texel(p, level, (i & 1u) == 0u ? column.x : column.y, i < 2u ? row.x : row.y);
        side = (i & 1u) == 0u ? texel * (1.0 - right) : side + texel * right;
        if ((i & 1u) != 0u)
            sum = i < 2u ? side * (1.0 - low) : sum + side * low;
    }
    return sum;
#else
    vec3 above = image_texel(p, level, column.x, row.x) * (1.0 - right) + image_texel(p, level, column.y, row.x) * right;
    vec3 below = image_texel(p, level, column.x, row.y) * (1.0 - right) + image_texel(p, level, column.y, row.y) * right;
    return above * (1.0 - low) + below * low;
#endif
}

// ---- taps

// An axis that is `parts` times as long as each of its taps, which are symmetric about the middle: whole ones, and half of
// the remainder at each end. So their places and weights change smoothly with `parts`.
struct tap_row {
    REAL parts; // 1 .. TAPS_MAX
    uint count; // odd
    REAL end;   // what fraction of a tap the first and the last one are
};

tap_row taps_of(REAL longer, REAL shorter) {
    tap_row row;
    row.parts = longer >= REAL(TAPS_MAX) * shorter ? REAL(TAPS_MAX) : longer <= shorter ? REAL(1.0) : longer / shorter;
    REAL pairs = ceil((row.parts - 1.0) * 0.5);
    row.count = 2u * uint(pairs) + 1u;
    row.end = pairs == 0.0 ? REAL(1.0) : (row.parts - (2.0 * pairs - 1.0)) * 0.5;
    return row;
}

REAL tap_weight(tap_row row, uint i) { return i == 0u || i + 1u == row.count ? row.end : REAL(1.0); }

// The tap's middle, from -1/2 to 1/2 along the axis.
REAL tap_place(tap_row row, uint i) {
    REAL last = REAL(row.count / 2u), from_middle = REAL(i) - last;
    REAL inward = 0.5 * (1.0 - row.end);
    from_middle += i == 0u ? inward : i + 1u == row.count ? -inward : REAL(0.0);
    return from_middle / row.parts;
}

// ---- images

// Longer footprints are all treated alike: squares of squares must fit into floats, too.
const float MOST_PIXELS = 1073741824.0;

// Grows by one with each power of two, and linearly between them.
REAL level_of(REAL size, uint count) {
    uint bits = floatBitsToUint(float(size));
    REAL part = size * uintBitsToFloat(0x7f000000u - (bits & 0x7f800000u));
    REAL level = REAL(int(bits >> 23u) - 127) + (part - 1.0);
    return size > 1.0 ? min(level, REAL(count) - 1.0) : REAL(0.0);
}

// An ellipse given by two conjugate radii, in pixels: its axes do not depend on which two.
struct image_ellipse {
    REAL2 axis; // its longer one
    REAL longer, shorter;
};

image_ellipse ellipse_of(REAL2 a, REAL2 b) {
    REAL xx = a.x * a.x + b.x * b.x, yy = a.y * a.y + b.y * b.y, xy = a.x * a.y + b.x * b.y;
    REAL part = 0.5 * (xx - yy), root = sqrt(part * part + xy * xy);
    REAL2 way = part >= 0.0 ? REAL2(root + part, xy) : REAL2(xy, root - part);
    REAL size = sqrt(way.x * way.x + way.y * way.y);
    image_ellipse e;
    e.longer = sqrt(0.5 * (xx + yy) + root);
    e.axis = size > 0.0 ? way * (e.longer / size) : REAL2(e.longer, 0.0);
    e.shorter = e.longer > 0.0 ? abs(a.x * b.y - a.y * b.x) / e.longer : 0.0;
    return e;
}

vec3 image_filtered(paint_record p, REAL2 at, REAL2 along, REAL2 across) {
    REAL2 size = REAL2(FETCH(paints, p.levels).yz);
    image_ellipse e = ellipse_of(clamp(along * size, -MOST_PIXELS, MOST_PIXELS), clamp(across * size, -MOST_PIXELS, MOST_PIXELS));
    tap_row row = taps_of(e.longer, max(e.shorter, 1.0));
    REAL level = level_of(max(e.longer / REAL(TAPS_MAX), e.shorter), p.level_count);
    uint below = uint(level);
    float share = float(level - REAL(below));
    REAL2 axis = e.axis / size;
    vec3 sum = vec3(0.0);
    // The last level's successor is itself: lavapipe computes it for all lanes.
    uint above = min(below + 1u, p.level_count - 1u);
    for (uint i = 0u; i < row.count; i++) {
        if (i < row.count) {
            REAL2 tap = at + axis * tap_place(row, i);
            float weight = float(tap_weight(row, i));
#ifdef WEBGPU
            vec3 level_sum = vec3(0.0);
            for (uint k = 0u; k < 2u + OPAQUE_ZERO; k++) {
                vec3 color = image_bilinear(p, k == 0u ? below : above, tap);
                level_sum = k == 0u ? color * (1.0 - share) : level_sum + color * share;
            }
            sum += level_sum * weight;
#else
            sum += (image_bilinear(p, below, tap) * (1.0 - share) + image_bilinear(p, above, tap) * share) * weight;
#endif
        }
    }
    return sum / float(row.parts);
}

REAL2 turned(paint_record p, REAL2 v) {
    REAL2 to_u = REAL2(p.row_u.xy), to_v = REAL2(p.row_v.xy);
    return REAL2(to_u.x * v.x + to_u.y * v.y, to_v.x * v.x + to_v.y * v.y);
}

vec3 image_color(paint_record p, paint_spot spot) {
    REAL2 at = REAL2(p.row_u.x * spot.at.x + p.row_u.y * spot.at.y + p.row_u.z,
                     p.row_v.x * spot.at.x + p.row_v.y * spot.at.y + p.row_v.z);
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

// The mean over an interval of width w around x of a function that is 1 in even cells and -1 in odd ones.
REAL wave(REAL x, REAL w) {
    REAL cell = floor(x), odd = cell - 2.0 * floor(cell * 0.5);
    REAL at = x - cell + odd, low = at - 0.5 * w, high = at + 0.5 * w; // even cells begin at 0
    REAL a = low - 2.0 * floor(low * 0.5), b = high - 2.0 * floor(high * 0.5);
    REAL mean = ((b < 1.0 ? b : 2.0 - b) - (a < 1.0 ? a : 2.0 - a)) / w;
    return floor(low) == floor(high) ? (odd != 0.0 ? REAL(-1.0) : REAL(1.0)) : mean;
}

// The share of odd cells: the footprint is cut into boxes along its longer axis. `is_flat`: there are two coordinates.
float odd_share(REAL3 at, REAL3 along, REAL3 across, bool is_flat) {
    REAL la = sqrt(dot3(along, along)), lb = sqrt(dot3(across, across));
    bool is_across = lb > la;
    REAL3 axis = is_across ? across : along, other = is_across ? along : across;
    tap_row row = taps_of(max(la, lb), min(la, lb));
    REAL sum = 0.0;
    for (uint i = 0u; i < row.count; i++) {
        if (i < row.count) {
            REAL3 tap = at + axis * tap_place(row, i);
            REAL weight = tap_weight(row, i);
            REAL3 w = abs(axis) * (weight / row.parts) + abs(other);
            REAL third = wave(tap.z, w.z);
            sum += wave(tap.x, w.x) * wave(tap.y, w.y) * (is_flat ? REAL(1.0) : third) * weight;
        }
    }
    return float(0.5 - 0.5 * sum / row.parts);
}

// ---- coordinates

// For a mesh's triangle: COORDINATE_WORDS for its three corners, starting at the body's first word.
void mesh_spot(uint coordinates, uint triangle, REAL b1, REAL b2, REAL2 db_along, REAL2 db_across, inout paint_spot spot) {
#ifdef DOUBLE_PRECISION
    uint at = (coordinates & ~1u) + COORDINATE64_WORDS * triangle;
    uvec4 first = FETCH(paints, at), next = FETCH(paints, at + 1u), last = FETCH(paints, at + 2u);
    dvec2 t0 = dvec2(packDouble2x32(first.xy), packDouble2x32(first.zw));
    dvec2 second = dvec2(packDouble2x32(next.xy), packDouble2x32(next.zw));
    dvec2 third = dvec2(packDouble2x32(last.xy), packDouble2x32(last.zw));
#else
    uint at = (coordinates & ~1u) + COORDINATE_WORDS * triangle;
    vec4 first = uintBitsToFloat(FETCH(paints, at));
    vec2 t0 = first.xy, second = first.zw, third = uintBitsToFloat(FETCH(paints, at + 1u).xy);
#endif
    bool exchanged = (coordinates & 1u) != 0u;
    REAL2 t1 = (exchanged ? third : second) - t0, t2 = (exchanged ? second : third) - t0;
    spot.at = t0 + t1 * b1 + t2 * b2;
    spot.along = t1 * db_along.x + t2 * db_along.y;
    spot.across = t1 * db_across.x + t2 * db_across.y;
}

void half_spot(bool is_second, REAL2 at, REAL2 db_along, REAL2 db_across, inout paint_spot spot) {
    REAL2 a = db_along, b = db_across;
    spot.at = at;
    spot.along = is_second ? REAL2(a.x, a.x + a.y) : REAL2(a.x + a.y, a.y);
    spot.across = is_second ? REAL2(b.x, b.x + b.y) : REAL2(b.x + b.y, b.y);
}

// Longitude and latitude of a sphere's unit normal, as for the background; v grows towards +y.
struct sphere_map {
    REAL3 o;
    REAL2 outward; // x and z of the meridian, unit
    REAL around;   // distance from the axis, radius 1
    REAL least;    // the same, but at least the distance where a pixel covers all longitudes
};

REAL2 sphere_change(sphere_map map, REAL3 way) {
    REAL down = (map.outward.x * way.x + map.outward.y * way.z) * map.o.y - way.y * map.around;
    return REAL2((map.outward.x * way.z - map.outward.y * way.x) / map.least * (0.5 / REAL_PI), -down * (1.0 / REAL_PI));
}

void sphere_spot(REAL3 outward, REAL radius, REAL width, inout paint_spot spot) {
    REAL around = sqrt(outward.x * outward.x + outward.z * outward.z);
    spot.at = REAL2(0.5 + arctan2(outward.z, outward.x) * (0.5 / REAL_PI), 1.0 - arctan2(around, outward.y) * (1.0 / REAL_PI));
    sphere_map map = sphere_map(outward, REAL2(1.0, 0.0), around, 0.0);
    map.least = max(max(map.around, abs(width) / radius * (0.5 / REAL_PI)), 1e-12);
    map.outward = map.around > 0.0 ? map.o.xz / map.around : map.outward;
    spot.along = sphere_change(map, spot.axis_along / radius);
    spot.across = sphere_change(map, spot.axis_across / radius);
}

// The same in the axes of the body, which are its rows.
void turned_sphere_spot(body_record body, REAL3 outward, REAL radius, REAL width, inout paint_spot spot) {
    REAL3 x = unit3(body.row_x), y = unit3(body.row_y), z = unit3(body.row_z);
    paint_spot own = spot;
    own.axis_along = REAL3(dot3(x, spot.axis_along), dot3(y, spot.axis_along), dot3(z, spot.axis_along));
    own.axis_across = REAL3(dot3(x, spot.axis_across), dot3(y, spot.axis_across), dot3(z, spot.axis_across));
    sphere_spot(REAL3(dot3(x, outward), dot3(y, outward), dot3(z, outward)), radius, width, own);
    spot.at = own.at;
    spot.along = own.along;
    spot.across = own.across;
}

// Of a cylinder or cone: a hit on it.
struct frustum_map {
    REAL3 arm;     // from the axis
    REAL radius;   // of the body there
    bool turned;   // the base is the end 'to'
    REAL height;   // of the body
    REAL above;    // the base
};

// The side: u around the axis, as on a sphere whose poles are the ends; v along it, from 'from' to 'to'. A disc: the image's
// inscribed one, as seen from outside. `face`: hit.b1. The body's rows are its own axes.
void frustum_spot(body_record body, frustum_map map, REAL face, REAL width, inout paint_spot spot) {
    REAL3 x = unit3(body.row_x), y = unit3(body.row_y), z = unit3(body.row_z);
    REAL2 arm = REAL2(dot3(x, map.arm), dot3(z, map.arm));
    REAL2 along = REAL2(dot3(x, spot.axis_along), dot3(z, spot.axis_along));
    REAL2 across = REAL2(dot3(x, spot.axis_across), dot3(z, spot.axis_across));
    if (face == FACE_SIDE) {
        REAL share = map.above / map.height, around = sqrt(arm.x * arm.x + arm.y * arm.y);
        spot.at = REAL2(0.5 + arctan2(arm.y, arm.x) * (0.5 / REAL_PI), map.turned ? 1.0 - share : share);
        REAL2 outward = around > 0.0 ? arm / around : REAL2(1.0, 0.0);
        // Near a tip a pixel covers all of u.
        REAL turn = 0.5 / REAL_PI / max(max(around, abs(width) * (0.5 / REAL_PI)), 1e-12 * map.height);
        spot.along = REAL2((outward.x * along.y - outward.y * along.x) * turn, dot3(y, spot.axis_along) / map.height);
        spot.across = REAL2((outward.x * across.y - outward.y * across.x) * turn, dot3(y, spot.axis_across) / map.height);
    } else {
        REAL2 half_image = REAL2(0.5, (face == FACE_TOP) == map.turned ? 0.5 : -0.5) / map.radius;
        spot.at = 0.5 + arm * half_image;
        spot.along = along * half_image;
        spot.across = across * half_image;
    }
}

// ---- cones of rays

// The rounding of frame.footprint, a float, is a common factor of all widths: it cancels when they are compared.
RAY_CONE camera_cone(REAL3 direction) {
    RAY_CONE cone = REAL2(0.0, frame.footprint * dot3(direction, CAMERA(forward)));
    uint projection = frame.projection + OPAQUE_ZERO;
    if (HAS_CAMERA && projection == PROJECTION_ORTHOGRAPHIC)
        cone = REAL2(frame.footprint, 0.0);
    else if (HAS_CAMERA && projection != PROJECTION_PERSPECTIVE)
        cone = REAL2(0.0, frame.footprint);
    return cone;
}
