// Traces one ray through all trees of a scene, for kernels that trace few rays.

void trace_all(ray_start start, exact_aim aim, bool any, inout hit_record hit, inout uint iterations) {
    REAL3 direction = aim.direction;
    if (HAS_CONES)
        round_start = start;
    if (HAS_ROUND)
        trace_spheres(start.at, direction, any, hit, iterations);
    if (HAS_TRIANGLES && !(any && hit.item != NO_ITEM)) {
        hit_record before = hit;
        ray_doubts doubts = no_doubts();
        if (trace_triangles(start, direction, any, hit, doubts, iterations) &&
            iterations + EXACT_ITERATIONS <= ITERATION_LIMIT) {
            if (retrace_triangles(start, aim, doubts, any, before, iterations))
                hit = before;
        }
    }
}

// What is left of a light that would add `shadow.value`; `ended` is false if a ray did not end.
vec3 shine_all(ray_start start, uint light, light_ray shadow, media_set inside, inout bool ended) {
    shining way = shine_from(start, inside);
    uint rays = 0u;
    // Loops carry `arrived` over: after a loop's end lavapipe would show some lanes the hit of others.
    bool goes_on = true, arrived = false;
    do {
        uint iterations = 0u;
        hit_record hit = hit_record(shadow.t_max, 0.0, 0.0, NO_ITEM, 0u);
        trace_all(way.start, aim_at(light, shadow), false, hit, iterations);
        ended = ended && iterations < ITERATION_LIMIT;
        arrived = arrived || hit.item == NO_ITEM;
        goes_on = shine_on(way, hit, shadow);
        shadow.direction = shine_direction(way, load_light(light), shadow);
        rays++;
    } while (goes_on && rays < SHINE_RAYS);
    ended = ended && !goes_on;
    return arrived ? way.left : vec3(0.0);
}
