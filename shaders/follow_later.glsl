// Follows a path, deciding rays that rounding leaves open after the inner loop: for lavapipe, which runs 8 invocations as a vector
// in which an `if` never skips code, only the end of a loop does.

// Until the path ends, or its slice does. A kernel in which paths begin (BEGINS) saves the path before it decides an open
// ray.
uint follow(uint slot, inout path_state p, inout uint fault) {
    uint iterations = 0u, state = GOES_ON, phase = p.hit.item == NO_ITEM ? PHASE_RAY : PHASE_HIT;
    bool fresh = true, decided = false; // no ray was finished in this slice; the ray is
    surface s;
    ray_start start = exact_start(REAL3(0.0)); // of shadow rays
    light_ray shadow = light_ray(vec3(0.0), start.at, 0.0, start.at);
    hit_record held = p.hit, rough = p.hit; // UNDECIDED: the spheres' hit, and the first search's; decided: the ray's hit
    do {
        ray_doubts doubts = no_doubts();
        do {
            iterations += segment_iterations();
            bool own = phase == PHASE_RAY;
            bool wanted = phase == PHASE_SHADOW || (own && p.depth <= frame.max_depth);
            bool traced = wanted && (BEGINS || !decided);
            if (HAS_SLICES && traced && is_late(fresh, iterations)) {
                state = SUSPENDED;
                break;
            }
            hit_record hit = hit_record(!traced ? -FAR_AWAY : own ? FAR_AWAY : shadow.t_max, 0.0, 0.0, NO_ITEM, 0u);
            ray_start from = ray_from(p, own, start);
            hit_record sphere = hit;
            REAL3 to = own ? p.direction : shadow.direction;
            bool open = trace_ray(from, to, traced, !own && !shines(), hit, sphere, doubts, iterations);
            if (HAS_LONG_RAYS && long_stopped != TREE_NONE) {
                state = SUSPENDED;
                break;
            }
            if (HAS_TRIANGLES && traced && open) {
                state = BEGINS ? SUSPENDED : room_for_exact(fresh, iterations);
                held = sphere;
                rough = hit;
                if (state != GOES_ON)
                    break;
            }
            if (!BEGINS && decided)
                hit = held;
            decided = false;
            state = arrive_and_go_on(slot, p, wanted, hit, s, start, phase, shadow, iterations, fresh, fault);
        } while (state == GOES_ON);
        if (HAS_TRIANGLES && !BEGINS && state == UNDECIDED) {
            if (!decide_exactly(p, phase == PHASE_RAY, ray_from(p, false, start), shadow, doubts, held, iterations))
                held = rough;
            decided = true;
            state = GOES_ON;
        }
        end_chain(slot, p, state, phase);
    } while (state == GOES_ON);
    return state;
}
