// Finds the closest or any sphere or cone along a ray; a tree of its own, compiled in only if a scene has any.
//
// Haines, Guenther, Akenine-Moeller 2019, "Precision Improvements for Ray/Sphere Intersection" (Ray Tracing
// Gems, chapter 7), with the start of the ray placed by its error: where |o - c|^2 - r^2 is within its
// rounding error of 0 the ray starts on the sphere, and that crossing is not a hit.

// As test_triangle.
void test_sphere(uint item, bool there, REAL3 origin, REAL3 direction, inout hit_record hit) {
    sphere_record sphere = load_sphere(item);
    REAL3 f = origin - sphere.center;
    REAL r = sphere.radius;
    REAL a = dot3(direction, direction);
    REAL b = -dot3(f, direction);
    REAL3 nearest = f + direction * (b / a);
    REAL discriminant = r * r - dot3(nearest, nearest);
    REAL f2 = dot3(f, f);
    REAL c = f2 - r * r;
    REAL c_error = GAMMA_6 * f2 + GAMMA_2 * (r * r);
    REAL root = sqrt(max(a * discriminant, 0.0));
    REAL q = b < 0.0 ? b - root : b + root;
    REAL b_error = GAMMA_4 * dot3(abs(f), abs(direction));
    bool on_sphere = abs(c) <= c_error;
#ifdef ALTERNATIVES
    on_sphere = on_sphere && !alternative_moves();
#endif
    REAL t0 = c / q, t1 = q / a;
    bool first = !on_sphere && t0 > 0.0;
    bool second = t1 > 0.0 && (!on_sphere || b > b_error);
    REAL t = first && second ? min(t0, t1) : first ? t0 : t1;
    uint number = sphere.body;
    bool nearer = t < hit.t || (t == hit.t && number < hit.number);
    if (there && discriminant >= 0.0 && q != 0.0 && (first || second) && nearer) {
        hit.t = t;
        hit.item = item | ITEM_SPHERE;
        hit.number = number;
        if (HAS_CONES)
            hit.b1 = 0.0;
    }
}

// Where the ray of trace_spheres starts, with HAS_CONES.
ray_start round_start;

// As trace_triangles.
void trace_spheres(REAL3 origin, REAL3 direction, bool any, inout hit_record hit, inout uint iterations) {
    tree_ray ray = make_tree_ray(origin, direction);
    STACK(SPHERE_STACK)
    uvec2 group = root_group();
    bool more = true;
    STACK_RESUME(SPHERE_STACK, TREE_SPHERES, group)
    do {
        iterations += 2u; // this loop, and the inner one where no lane enters it
        if (HAS_COUNTERS)
            counted_nodes++;
        node_record node = load_sphere_node(next_node(group, ray.flip));
        uint hits = node_hits(node, ray, hit.t);
        uvec2 found = uvec2(node.first_node, (hits & 0xff000000u) | (node.exponents >> 24u)), rest = group;
        STACK_NEXT(SPHERE_STACK, group, rest, found, more)
        uint items = hits & 0x00ffffffu;
        WHILE(items != 0u && iterations < ITERATION_LIMIT)
            uint bit = items & (0u - items);
            bool there = IS_WANTED(bit != 0u);
            iterations += there ? 1u : 0u;
            if (HAS_COUNTERS)
                counted_items += there ? 1u : 0u;
            items ^= bit;
            // A power of two up to 2^23 is its own exponent.
            uint item = node.first_item + (floatBitsToUint(float(int(bit))) >> 23u) - 127u;
            if (HAS_CONES && (!HAS_SPHERES || is_frustum(item)))
                test_frustum(item, there, round_start, direction, hit);
            else
                test_sphere(item, there, origin, direction, hit);
            if (any && hit.item != NO_ITEM) {
                items = 0u;
                more = false;
            }
        END_WHILE(items != 0u && iterations < ITERATION_LIMIT)
    } while (more && iterations < TRAVERSAL_LIMIT);
    STACK_SUSPEND(SPHERE_STACK, TREE_SPHERES, group, more)
}
