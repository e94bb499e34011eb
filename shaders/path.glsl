// The state of one sample's path.

const uint RAY_PRIMARY = 0u;
const uint RAY_REFLECTED = 1u;
const uint RAY_REFRACTED = 2u;

struct path_state {
    ray_start start;
    REAL3 direction;
    RAY_CONE cone;    // with HAS_FOOTPRINT
    float throughput; // how much of what the ray sees the sample gets
    uint depth; // max_depth + 1: only sees the background
    uint kind;
    vec3 radiance; // sum so far
    uint segments; // rays traced
    hit_record hit; // NO_ITEM: the ray is still to be traced; else its lights from `light` on
    uint light;
    vec3 light_sum; // over the lights before `light`
    vec3 light_low; // with HAS_MANY_LIGHTS: what rounding dropped of it
    uint stack_size;
    media_set inside; // with HAS_MEDIA
    vec3 tint;        // with HAS_TINT: what attenuation and coloured mirrors have left of each channel
    shining shine;    // with HAS_CLEAR_SHADOWS: of the light `light`
    uint key;         // with HAS_POINTS: of its ray (points.h)
};

path_state begin_path(camera_ray ray) {
    path_state p;
    p.start = exact_start(ray.at);
    p.direction = ray.direction;
    p.cone = REAL2(0.0);
    if (HAS_FOOTPRINT)
        p.cone = camera_cone(ray.direction);
    p.throughput = 1.0;
    p.depth = 0u;
    p.kind = RAY_PRIMARY;
    p.radiance = vec3(0.0);
    p.segments = 0u;
    p.hit = hit_record(FAR_AWAY, 0.0, 0.0, NO_ITEM, FAULT_NUMBER);
    p.light = 0u;
    p.light_sum = vec3(0.0);
    p.light_low = vec3(0.0);
    p.stack_size = 0u;
    if (HAS_MEDIA)
        p.inside = camera_media();
    p.tint = vec3(1.0);
    p.shine.goes_on = false;
    p.key = point_root(point_pixel.x, point_pixel.y);
    return p;
}

// What a path adds to its pixel: `value` times what is left of each channel.
vec3 tinted(path_state p, vec3 value) {
    vec3 result = value * p.throughput;
    if (HAS_TINT)
        result = value * p.tint * p.throughput;
    return result;
}

// The largest share that a channel of its light has in the pixel.
float greatest_part(vec3 tint, float throughput) {
    float greatest = throughput;
    if (HAS_TINT)
        greatest = throughput * max(tint.x, max(tint.y, tint.z));
    return greatest;
}
