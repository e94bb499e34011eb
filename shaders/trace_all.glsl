// One ray through all that a scene has, for kernels that trace few.

void trace_all(ray_start start, exact_aim aim, bool any, inout hit_record hit, inout uint iterations) {
    REAL3 direction = aim.direction;
    if (HAS_SPHERES)
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
