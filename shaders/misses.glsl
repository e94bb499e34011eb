// Whether a ray certainly misses a triangle, found in single precision. A kernel in double precision asks this first: most
// of the triangles that it comes to are missed. The others are tested in double precision, so no hit ever changes.
// docs/decisions/precision.md has the proof.

// A corner's error across the ray is at most the sum of three: a fraction (OUTLINE_STEPS) of its place relative to the
// ray's start, a fraction (OUTLINE_NEAR) of the start's largest coordinate, and more than what is lost below the smallest
// normal float.
#ifndef OUTLINE_SHARE
#define OUTLINE_SHARE 1.0 // of the margins; less than 1 to see how much they matter
#endif
const float OUTLINE_STEPS = OUTLINE_SHARE * 7.1525574e-7;  // 12 units of 2^-24
const float OUTLINE_NEAR = OUTLINE_SHARE * 5.9604645e-7;   // 10 such units
const float OUTLINE_LEAST = OUTLINE_SHARE * 7.5231638e-37; // 2^-120

struct outline_ray {
    vec3 origin;
    float sx, sy;
    float near; // bound of the part of a corner's error across the ray that is the same for all corners
};

outline_ray make_outline_ray(triangle_search search) {
    REAL3 o = search.ray.origin;
    return outline_ray(vec3(o), float(search.ray.sx), float(search.ray.sy),
                       float(OUTLINE_SHARE * 2.125 * search.slack) + OUTLINE_NEAR * float(largest3(abs(o))) + OUTLINE_LEAST);
}

vec3 turn_outline(vec3 v, shear_ray ray) { return ray.along_z ? v : ray.along_x ? v.yzx : v.zxy; }

bool misses(uint item, outline_ray outline, shear_ray ray) {
    outline_record triangle = load_outline(item);
    vec3 a = turn_outline(triangle.v0 - outline.origin, ray);
    vec3 b = turn_outline(triangle.v1 - outline.origin, ray);
    vec3 c = turn_outline(triangle.v2 - outline.origin, ray);
    float ax = a.x - outline.sx * a.z, ay = a.y - outline.sy * a.z;
    float bx = b.x - outline.sx * b.z, by = b.y - outline.sy * b.z;
    float cx = c.x - outline.sx * c.z, cy = c.y - outline.sy * c.z;
    float u = cx * by - cy * bx;
    float v = ax * cy - ay * cx;
    float w = bx * ay - by * ax;
    float x_most = max(max(abs(ax), abs(bx)), abs(cx));
    float y_most = max(max(abs(ay), abs(by)), abs(cy));
    float z_most = max(max(abs(a.z), abs(b.z)), abs(c.z));
    float wrong_x = OUTLINE_STEPS * (x_most + z_most) + outline.near;
    float wrong_y = OUTLINE_STEPS * (y_most + z_most) + outline.near;
    float margin = 2.0 * (wrong_x * (y_most + wrong_y) + wrong_y * x_most) + OUTLINE_STEPS * (x_most * y_most) +
                   OUTLINE_LEAST;
    // Also false if a number is infinite or NaN.
    return max(max(u, v), w) > margin && min(min(u, v), w) < -margin;
}
