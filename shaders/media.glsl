// Which media a ray is inside (docs/language.md, "Media"), and what they do to its light.
//
// A set holds an entry for each: its priority, and below it the number of the body (gpu_scene.h, MEDIUM_BITS). The one
// entered last comes first, and 0 ends them. Not an array: lavapipe writes those lane by lane.

media_set camera_media() {
    return media_set(uvec4(frame.inside_0, frame.inside_1, frame.inside_2, frame.inside_3),
                     uvec4(frame.inside_4, frame.inside_5, frame.inside_6, frame.inside_7));
}

// The entry that fills the place: the highest priority, among equals the last one entered. 0: air.
uint more_filling(uint first, uint next) { return (next >> MEDIUM_BITS) > (first >> MEDIUM_BITS) ? next : first; }
uint filling(media_set set) {
    uint best = more_filling(more_filling(set.a.x, set.a.y), more_filling(set.a.z, set.a.w));
    return more_filling(best, more_filling(more_filling(set.b.x, set.b.y), more_filling(set.b.z, set.b.w)));
}

bool is_among(media_set set, uint entry) { return any(equal(set.a, uvec4(entry))) || any(equal(set.b, uvec4(entry))); }

// From `entry` on, each entry is replaced by the next one.
media_set without(media_set set, uint entry) {
    bvec4 a = equal(set.a, uvec4(entry)), b = equal(set.b, uvec4(entry));
    a.y = a.x || a.y;
    a.z = a.y || a.z;
    a.w = a.z || a.w;
    b.x = a.w || b.x;
    b.y = b.x || b.y;
    b.z = b.y || b.z;
    b.w = b.z || b.w;
    return media_set(mix(set.a, uvec4(set.a.yzw, set.b.x), a), mix(set.b, uvec4(set.b.yzw, 0u), b));
}

media_set with(media_set set, uint entry) {
    return media_set(uvec4(entry, set.a.xyz), uvec4(set.a.w, set.b.xyz));
}

// The number, from 1 on, of the material that fills an entry's body.
uint medium_of(uint entry) {
    uint number = 0u;
    if (entry != 0u)
        number = load_body((entry & MEDIUM_MASK) - 1u).medium & MEDIUM_MASK;
    return number;
}

// The index on one side of a surface; a body's own faces give the body's index.
REAL medium_index(uint entry, uint medium, uint own, REAL own_index) {
    REAL index = 1.0;
    if (medium != 0u)
        index = entry == own ? own_index : load_material(medium - 1u).refractive_index;
    return index;
}

// If no two media can share a point, the side of the surface decides everything.
void cross_alone(inout surface s) {
    bool leaves = s.solid && s.refraction > 0.0 && !s.enters;
    s.index_before = leaves ? s.index : 1.0;
    s.index_after = leaves ? 1.0 : s.index;
    s.passes = false;
    s.is_over = false;
}

// Finds the media on both sides of a surface hit by a ray from inside `before`. `before` is corrected if the side of a
// sphere contradicts it; a mesh may have walls turned either way, so there only the set counts.
void cross_media(inout media_set before, hit_record hit, inout surface s) {
    uint word = load_body(s.body).medium;
    uint own = (word & ~MEDIUM_MASK) | (s.body + 1u);
    bool crosses = s.solid && s.refraction > 0.0 && word != 0u;
    bool inside = is_among(before, own), leaves = (hit.item & ITEM_SPHERE) != 0u ? !s.enters : inside;
    media_set around = before;
    if (inside)
        around = without(before, own);
    media_set within = before;
    if (!inside)
        within = with(before, own);
    s.is_over = crosses && !inside && before.b.w != 0u;
    media_set here = before;
    s.after = before;
    if (crosses && leaves) {
        here = within;
        s.after = around;
    }
    if (crosses && !leaves) {
        here = around;
        s.after = within;
    }
    uint left = filling(here), entered = filling(s.after);
    uint medium = medium_of(left), next = medium_of(entered);
    s.index_before = medium_index(left, medium, own, s.index);
    s.index_after = crosses ? medium_index(entered, next, own, s.index) : s.index;
    s.passes = crosses && medium == next;
    before = here;
}

void cross_surface(inout media_set before, hit_record hit, inout surface s) {
    if (HAS_SIDES)
        cross_alone(s);
    if (HAS_MEDIA && wants(FEATURE_MEDIA))
        cross_media(before, hit, s);
}

// A ray that continues behind a surface that nobody sees is still the same ray.
void count_unseen(surface s) {
    if (HAS_COUNTERS && HAS_MEDIA)
        counted_unseen += s.passes ? 1u : 0u;
}

// exp(-x) for x >= 0: a power of two times the series of the remainder, relative error 1e-7. Vulkan's own may differ
// from device to device.
float fading(float x) {
    float n = floor(x * 1.44269504 + 0.5);
    float r = (x - n * 0.693359375) + n * 2.12194440e-4;
    float p = 1.0 - r * (1.0 / 7.0);
    p = 1.0 - r * p * (1.0 / 6.0);
    p = 1.0 - r * p * 0.2;
    p = 1.0 - r * p * 0.25;
    p = 1.0 - r * p * (1.0 / 3.0);
    p = 1.0 - r * p * 0.5;
    p = 1.0 - r * p;
    return x < 86.0 ? p * uintBitsToFloat((127u - uint(n)) << 23u) : 0.0;
}

// The share of light left after a way inside.
vec3 media_left(media_set set, REAL way) {
    uint medium = medium_of(filling(set));
    vec3 left = vec3(1.0);
    if (medium != 0u) {
        vec3 depth = min(load_material(medium - 1u).absorption * float(way), vec3(100.0));
        left = vec3(fading(depth.x), fading(depth.y), fading(depth.z));
    }
    return left;
}

// The share of light left from a lamp that nothing blocks: after the way in the medium that the surface is lit in.
vec3 arriving_left(media_set inside, light_ray ray) {
    vec3 left = vec3(1.0);
    if (HAS_ATTENUATION && wants(FEATURE_ATTENUATION) && ray.t_max < FAR_AWAY)
        left = media_left(inside, ray.t_max * sqrt(dot3(ray.direction, ray.direction)));
    return left;
}

// ---- light that shines through refracting bodies: a shadow ray goes straight on behind each surface that it hits, and
// keeps a share of its light (docs/language.md, "Shadows of glass")

const uint SHINE_RAYS = 500u; // to one light, if nothing else ends them

struct shining {
    bool goes_on; // a surface was met: `start` is behind it
    ray_start start;
    vec3 left; // of the light
    media_set inside;
};

shining shine_from(ray_start start, media_set inside) { return shining(false, start, vec3(1.0), inside); }

bool shines() { return HAS_CLEAR_SHADOWS && wants(FEATURE_CLEAR_SHADOWS); }

// The share that a surface lets through. By the angle on the thinner side, whichever side the ray comes from: as for
// light that was bent on its way in.
float shine_share(surface s, REAL3 direction) {
    float share = s.refraction;
    if (HAS_FRESNEL) {
        REAL low = min(s.index_before, s.index_after), high = max(s.index_before, s.index_after);
        REAL c = -dot3(direction, s.shading);
        c = c <= 0.0 ? -dot3(direction, s.geometric) : c;
        REAL eta = low / high;
        float reflected = fresnel_share(low, high, c, 1.0 - eta * eta * (1.0 - c * c), !s.solid);
        share = s.fresnel ? share * (1.0 - reflected) : share;
    }
    return share;
}

REAL3 shine_direction(shining way, light_record light, light_ray ray) {
    REAL3 place = light.place;
    if (HAS_PLACES)
        place = ray.place;
    return ray.t_max < FAR_AWAY ? place - way.start.at : ray.direction;
}

// A shadow ray has hit a surface, or reached the light. true: it continues behind the surface.
bool shine_on(inout shining way, hit_record hit, light_ray ray) {
    bool arrived = hit.item == NO_ITEM, is_point = ray.t_max < FAR_AWAY;
    REAL size = sqrt(dot3(ray.direction, ray.direction));
    if (HAS_ATTENUATION && (!arrived || is_point))
        way.left *= media_left(way.inside, (arrived ? ray.t_max : hit.t) * size);
    if (arrived)
        return false;
    surface s;
    make_surface(hit, way.start.at, ray.direction, s);
    cross_surface(way.inside, hit, s);
    count_unseen(s);
    float share = shine_share(s, ray.direction * (1.0 / size));
    way.left *= HAS_MEDIA && s.passes ? 1.0 : share;
    if (HAS_MEDIA)
        way.inside = s.after;
    way.start = leave(s, hit, -s.geometric);
    way.goes_on = largest3(REAL3(way.left)) > 0.0;
    return way.goes_on;
}
