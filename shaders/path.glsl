// The state of one sample's path.

const uint RAY_PRIMARY = 0u;
const uint RAY_REFLECTED = 1u;
const uint RAY_REFRACTED = 2u;

struct path_state {
    ray_start start;
    REAL3 direction;
    RAY_CONE cone;    // with HAS_FOOTPRINT
    float throughput; // share of what the ray sees that the sample gets
    uint depth; // max_depth + 1: only sees the background
    uint kind;
    vec3 radiance; // of what is done
    uint segments; // rays traced
    hit_record hit; // NO_ITEM: the ray is still to be traced; else its lights from `light` on
    uint light;
    vec3 light_sum; // over the lights before
    vec3 light_low; // with HAS_MANY_LIGHTS: what rounding dropped of it
    uint stack_size;
};

path_state begin_path(REAL3 direction) {
    path_state p;
    p.start = exact_start(CAMERA(position));
    p.direction = direction;
    p.cone = vec2(0.0);
    if (HAS_FOOTPRINT)
        p.cone = camera_cone(direction);
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
    return p;
}
