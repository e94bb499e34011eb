// One ray through all that a scene has, for kernels that trace few.

void trace_all(ray_start start, exact_aim aim, bool any, inout hit_record hit, inout uint iterations) {
    REAL3 direction = aim.direction;
    if (HAS_SPHERES)
        trace_spheres(start.at, direction, any, hit, iterations);
    if (HAS_TRIANGLES && !(any && hit.item != NO_ITEM)) {
        hit_record before = hit;
        if (trace_triangles(start, direction, any, hit, iterations) &&
            iterations + EXACT_ITERATIONS <= ITERATION_LIMIT) {
            if (retrace_triangles(start, aim, any, before, iterations))
                hit = before;
        }
    }
}
