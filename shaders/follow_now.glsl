// Follows a path, deciding rays that rounding leaves open within the inner loop: for a GPU, whose lanes would otherwise wait for all
// others.

// Decides at once: GOES_ON with the ray's hit, or SUSPENDED. `sphere`: the hit without triangles.
uint decide_here(path_state p, bool own, ray_start start, light_ray shadow, ray_doubts doubts, hit_record sphere,
                 bool fresh, inout hit_record hit, inout uint iterations) {
    uint state = room_for_exact(fresh, iterations);
    if (state == UNDECIDED && decide_exactly(p, own, start, shadow, doubts, sphere, iterations))
        hit = sphere;
    return state == SUSPENDED ? SUSPENDED : GOES_ON;
}

// Until the path ends, or its slice does. A kernel in which paths begin (BEGINS) saves the path before it decides an open
// ray.
uint follow(uint slot, inout path_state p, inout uint fault) {
    uint iterations = 0u, state = GOES_ON, phase = p.hit.item == NO_ITEM ? PHASE_RAY : PHASE_HIT;
    bool fresh = true; // no ray was finished in this slice
    surface s;
    ray_start start = exact_start(REAL3(0.0)); // of shadow rays
    light_ray shadow = light_ray(vec3(0.0), start.at, 0.0, start.at);
    do {
        ray_doubts doubts = no_doubts();
        do {
            iterations += segment_iterations();
            bool own = phase == PHASE_RAY;
            bool wanted = phase == PHASE_SHADOW || (own && p.depth <= frame.max_depth);
            if (HAS_SLICES && wanted && is_late(fresh, iterations)) {
                state = SUSPENDED;
                break;
            }
            hit_record hit = hit_record(!wanted ? -FAR_AWAY : own ? FAR_AWAY : shadow.t_max, 0.0, 0.0, NO_ITEM, 0u);
            ray_start from = ray_from(p, own, start);
            hit_record sphere = hit;
            REAL3 to = own ? p.direction : shadow.direction;
            bool open = trace_ray(from, to, wanted, !own && !shines(), hit, sphere, doubts, iterations);
            if (HAS_LONG_RAYS && long_stopped != TREE_NONE) {
                state = SUSPENDED;
                break;
            }
            if (BEGINS && HAS_TRIANGLES && wanted && open)
                state = SUSPENDED;
            else if (HAS_TRIANGLES && wanted && open)
                state = decide_here(p, own, from, shadow, doubts, sphere, fresh, hit, iterations);
            if (state == SUSPENDED)
                break;
            state = arrive_and_go_on(slot, p, wanted, hit, s, start, phase, shadow, iterations, fresh, fault);
        } while (state == GOES_ON);
        end_chain(slot, p, state, phase);
    } while (state == GOES_ON);
    return state;
}
