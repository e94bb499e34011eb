// The kernel that makes pictures: follows a sample's path through the scene, Whitted 1980.
//
// One loop, with one ray per iteration: the path's own ray, or a shadow ray of the last hit (follow_now.glsl, and
// follow_later.glsl for lavapipe). Lanes whose chain of reflections has ended wait after the inner loop, where the
// background is looked up once for all, and then continue with the refracted rays on the stack.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "scene.glsl"
#include "records.glsl"
#include "math.glsl"
#include "light/points.glsl"
#include "light/round.glsl"
#include "camera.glsl"
#include "light/lens.glsl"
#include "bits.glsl"
#include "long_rays.glsl"
#include "tree.glsl"
#include "wide.glsl"
#include "triangles.glsl"
#include "exact.glsl"
#include "cones.glsl"
#include "spheres.glsl"
#include "surface.glsl"
#include "ray_offset.glsl"
#include "background.glsl"
#include "lights.glsl"
#include "bounce.glsl"
#include "light/rough.glsl"
#include "media.glsl"
#include "light/seen.glsl"
#include "path.glsl"
#include "path_words.glsl"

layout(local_size_x = TILE_PIXELS, local_size_x_id = CONSTANT_WORKGROUP) in;

// The cost of an inner-loop iteration besides what its loops count themselves: one turn of each loop.
const uint SEGMENT_ITERATIONS = 9u + PAINT_ITERATIONS;

uint segment_iterations() { return SEGMENT_ITERATIONS + (HAS_SEEN_LIGHT ? 2u * frame.seen_count : 0u); }

// And of looking for a light; the background needs two searches.
const uint SKY_ITERATIONS = 33u;

const uint PHASE_RAY = 0u;    // the path's ray must be traced
const uint PHASE_HIT = 1u;    // it was traced before: only the surface must be made again
const uint PHASE_SHADOW = 2u; // a shadow ray

const uint GOES_ON = 0u;
const uint MISSED = 1u;    // the chain ends at the background
const uint ENDED = 2u;     // the chain ends at a surface
const uint SUSPENDED = 3u; // to be saved
const uint STOPPED = 4u;   // a fault
const uint UNDECIDED = 5u; // the ray must be traced again, exactly

// What this invocation counts, with HAS_COUNTERS, until it ends: updating the device's shared counters for each
// ray would cost as much as the rays. The host knows how many rays the camera sends.
struct ray_counts {
    uint reflected, refracted, shadow, total_reflections;
    uint cut_by_depth, cut_by_weight, deepest;
    float lost_by_depth, lost_by_weight;
};
ray_counts counted = ray_counts(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0.0, 0.0);

void add_count(uint at, uint amount) {
    if (amount != 0u)
        atomicAdd(counters[at], amount);
}

void raise_count(uint at, uint value) {
    if (value != 0u)
        atomicMax(counters[at], value);
}

void add_counts(uint group) {
    uint bank = COUNTER_SHARED + group % COUNTER_BANKS * COUNTER_BANK;
    add_count(bank + COUNTER_REFLECTED, counted.reflected);
    add_count(bank + COUNTER_REFRACTED, counted.refracted);
    add_count(bank + COUNTER_SHADOW, counted.shadow);
    add_count(bank + COUNTER_TOTAL_REFLECT, counted.total_reflections);
    add_count(bank + COUNTER_CUT_DEPTH, counted.cut_by_depth);
    add_count(bank + COUNTER_CUT_WEIGHT, counted.cut_by_weight);
    add_count(bank + COUNTER_NODES, counted_nodes);
    add_count(bank + COUNTER_ITEMS, counted_items);
    add_count(bank + COUNTER_UNSEEN, counted_unseen);
    raise_count(bank + COUNTER_DEEPEST, counted.deepest);
    raise_count(bank + COUNTER_LOST_DEPTH, floatBitsToUint(counted.lost_by_depth));
    raise_count(bank + COUNTER_LOST_WEIGHT, floatBitsToUint(counted.lost_by_weight));
}

void count_ray(path_state p, bool own) {
    if (!HAS_COUNTERS)
        return;
    counted.shadow += own ? 0u : 1u;
    counted.reflected += own && p.kind == RAY_REFLECTED ? 1u : 0u;
    counted.refracted += own && p.kind == RAY_REFRACTED ? 1u : 0u;
    counted.deepest = own ? max(counted.deepest, p.depth) : counted.deepest;
}

void count_cut(bool by_depth, bool by_weight, float throughput) {
    if (!HAS_COUNTERS)
        return;
    counted.cut_by_depth += by_depth ? 1u : 0u;
    counted.cut_by_weight += by_weight ? 1u : 0u;
    counted.lost_by_depth = by_depth ? max(counted.lost_by_depth, throughput) : counted.lost_by_depth;
    counted.lost_by_weight = by_weight ? max(counted.lost_by_weight, throughput) : counted.lost_by_weight;
}

// A surface or a ray has an infinite or NaN value: its result could look like any other pixel, so the sample
// becomes a fault.
void taint(inout path_state p, bool exists, REAL3 v, float throughput) {
    // The sum of finite parts of unit vectors is finite.
    bool sound = is_finite(float(v.x + v.y + v.z) + throughput);
    p.radiance = exists && !sound ? vec3(uintBitsToFloat(0x7fc00000u)) : p.radiance;
}

// Whether a child ray of this throughput is followed; one cut by depth is, but only sees the background.
bool is_followed(path_state p, vec3 tint, float throughput) {
    throughput = greatest_part(tint, throughput);
    bool heavy = throughput > 0.0 && throughput >= frame.min_weight;
    bool last = p.depth == frame.max_depth;
    count_cut(heavy && last, throughput > 0.0 && !heavy, throughput);
    return heavy && !(HAS_DEPTH_BLACK && last && wants(FEATURE_DEPTH_BLACK));
}

// Sends the rays that leave the surface: the path goes on with one, the other waits. false: none.
bool send_rays(uint slot, inout path_state p, surface s, ray_start start, ray_start start_through) {
    if (HAS_ROUGHNESS)
        roughen(p.direction, p.key, s);
    scatter_rays rays = scatter(p.direction, s);
    if (HAS_COUNTERS && HAS_REFRACTION)
        counted.total_reflections += rays.total ? 1u : 0u;
    float throughput = p.throughput;
    vec3 tint = p.tint;
    if (HAS_REFLECTION_COLOR)
        tint *= rays.color;
    bool through = HAS_REFRACTION && is_followed(p, p.tint, throughput * rays.refraction);
    bool back = (HAS_REFLECTION || HAS_REFRACTION) && is_followed(p, tint, throughput * rays.reflection);
    if (HAS_BRANCHES && back && through)
        push_branch(slot, p, start_through, rays.bent, HAS_FOOTPRINT ? bent_cone(s, p.cone, p.direction, rays.bent) : p.cone,
                    throughput * rays.refraction, p.depth + 1u);
    if (CARRIES && HAS_BRANCHES && back && through)
        push_media(slot, p, s.after);
    if (HAS_MEDIA && !back)
        p.inside = s.after;
    if (HAS_FOOTPRINT)
        p.cone = back ? mirrored_cone(s, p.cone) : bent_cone(s, p.cone, p.direction, rays.bent);
    p.start = start;
    if (!back)
        p.start = start_through;
    p.direction = back ? reflected(p.direction, s) : rays.bent;
    p.throughput = throughput * (back ? rays.reflection : rays.refraction);
    if (HAS_REFLECTION_COLOR)
        p.tint = back ? tint : p.tint;
    p.kind = back ? RAY_REFLECTED : RAY_REFRACTED;
    if (HAS_POINTS)
        p.key = point_key(p.key, back ? POINT_REFLECTED : POINT_REFRACTED);
    p.depth++;
    taint(p, back || through, p.direction, p.throughput);
    taint(p, HAS_BRANCHES && back && through, rays.bent, throughput * rays.refraction);
    return back || through;
}

void write_sample(uint path, path_state p, uint fault) {
    uvec4 before = dispatch.sample_index == OPAQUE_ZERO ? uvec4(0u) : pixels[path];
    vec3 sum = uintBitsToFloat(before.xyz) + p.radiance;
    bool finite = is_finite3(sum);
    if (fault >> FAULT_KIND_SHIFT == FAULT_ITERATIONS)
        atomicAdd(counters[COUNTER_LONG_RAYS], 1u);
    fault = (finite ? fault : FAULT_NOT_FINITE << FAULT_KIND_SHIFT) | p.hit.number;
    bool faulty = before.w >> FAULT_KIND_SHIFT != FAULT_NONE;
    uvec4 after = uvec4(finite ? floatBitsToUint(sum) : before.xyz, faulty ? before.w : fault);
    pixels[path] = after;
#ifndef FETCH_TEXELS
    if (AT_ONCE && dispatch.shows > OPAQUE_ZERO)
        show(pixel_in_order(path), after);
#endif
}

// After a ray: whether the path may go on.
uint after_ray(inout path_state p, uint iterations, inout bool fresh, inout uint fault) {
    if (iterations >= ITERATION_LIMIT) {
        fault = FAULT_ITERATIONS << FAULT_KIND_SHIFT;
        return HAS_SLICES && !fresh ? SUSPENDED : STOPPED;
    }
    fresh = false;
    p.segments++;
    fault = p.segments > frame.path_segments ? FAULT_SEGMENTS << FAULT_KIND_SHIFT : fault;
    return p.segments > frame.path_segments ? STOPPED : GOES_ON;
}

// From light `p.light` on, finds the next one that would add something; adds those that need no shadow ray.
bool find_light(inout path_state p, surface s, ray_start start, inout light_ray shadow, inout uint iterations) {
    uint count = light_end() + OPAQUE_ZERO;
    bool found = false;
    while (p.light < count && !found && iterations < ITERATION_LIMIT) {
        iterations += HAS_SKY_LIGHT ? SKY_ITERATIONS : 1u;
        shadow = light_at(p.light, s, start.at, p.direction, p.key);
        found = HAS_SHADOWS && wants(FEATURE_SHADOWS) && shadow.value != vec3(0.0);
        if (!(HAS_SHADOWS && wants(FEATURE_SHADOWS)))
            add_light(shadow.value, p.light_sum, p.light_low);
        p.light += found ? 0u : 1u;
    }
    return found;
}

// What the path's own ray hit.
uint take_hit(inout path_state p, hit_record hit) {
    hit.number = hit.item == NO_ITEM ? p.hit.number : hit.number; // a fault names the last hit
    p.hit = hit;
    p.light = 0u;
    p.light_sum = vec3(0.0);
    p.light_low = vec3(0.0);
    return hit.item == NO_ITEM ? MISSED : GOES_ON;
}

// A light nearer than the hit of the path's own ray. A ray that was not traced sees none.
uint take_seen(inout path_state p, REAL t_max, uint state) {
    seen_light seen = no_light(t_max);
    see_lights(p.start.at, p.direction, seen);
    bool found = seen.number != 0u;
    if (found && HAS_ATTENUATION && wants(FEATURE_ATTENUATION))
        p.tint *= media_left(p.inside, seen.t);
    if (found) {
        p.radiance += tinted(p, seen.radiance);
        p.hit.item = NO_ITEM;
    }
    return found ? ENDED : state;
}

// What a shadow ray hit. A hit blocks the light, unless light shines through refracting bodies.
void take_light(inout path_state p, ray_start start, hit_record hit, light_ray shadow) {
    bool arrives = hit.item == NO_ITEM, goes_on = false;
    vec3 value = shadow.value;
    if (HAS_CLEAR_SHADOWS && shines()) {
        shining way = p.shine;
        if (!p.shine.goes_on)
            way = shine_from(start, p.inside);
        goes_on = shine_on(way, hit, shadow);
        value = shadow.value * way.left;
        p.shine = way;
        p.shine.goes_on = goes_on;
    } else if (arrives)
        value *= arriving_left(p.inside, shadow);
    if (arrives)
        add_light(value, p.light_sum, p.light_low);
    p.light += goes_on ? 0u : 1u;
}

// All lights of a surface are summed: continue with the rays that it sends.
uint leave_surface(uint slot, inout path_state p, surface s, ray_start start) {
    ray_start start_through = leave(s, p.hit, -s.geometric);
    p.radiance += tinted(p, p.light_sum);
    p.hit.item = NO_ITEM;
    return send_rays(slot, p, s, start, start_through) ? GOES_ON : ENDED;
}

// Whether a slice has no room for another ray.
bool is_late(bool fresh, uint iterations) {
    bool late = !fresh && iterations > frame.slice_iterations;
    // Looking for a light may have used the first ray's iterations.
    return late || (HAS_LONG_RAYS && iterations > SLICE_ITERATIONS);
}

// Whether a slice has room for a second search. A ray that fills it alone keeps what the first search found.
uint room_for_exact(bool fresh, uint iterations) {
    bool room = iterations + EXACT_ITERATIONS <= ITERATION_LIMIT;
    return room ? UNDECIDED : HAS_SLICES && !fresh ? SUSPENDED : GOES_ON;
}

// Searches both trees. A ray that stopped in the previous slice resumes there; it may stop again: long_stopped.
// true: rounding leaves open what is hit; `sphere` is the hit without triangles.
bool trace_ray(ray_start start, REAL3 direction, bool traced, bool any, inout hit_record hit, inout hit_record sphere,
               inout ray_doubts doubts, inout uint iterations) {
    bool before_triangles = true, open = false;
    if (HAS_LONG_RAYS) {
        long_resumes = traced && long_tree != TREE_NONE;
        before_triangles = !(long_resumes && long_tree == TREE_TRIANGLES);
        if (long_resumes)
            hit = long_hit();
    }
    if (HAS_CONES)
        round_start = start;
    if (HAS_ROUND && before_triangles)
        trace_spheres(start.at, direction, any, hit, iterations);
    if (hit.item == NO_ITEM || (hit.item & ITEM_SPHERE) != 0u)
        sphere = hit;
    if (HAS_TRIANGLES && !(any && hit.item != NO_ITEM) && !(HAS_LONG_RAYS && long_stopped != TREE_NONE))
        open = trace_triangles(start, direction, any, hit, doubts, iterations);
    if (HAS_LONG_RAYS && traced)
        long_tree = TREE_NONE;
    if (HAS_LONG_RAYS && long_stopped != TREE_NONE)
        put_long_ray(hit);
    return open;
}

// Traces the path's own ray or a shadow ray again. `hit`: what it hits without triangles, then with them.
bool decide_exactly(path_state p, bool own, ray_start shadow_start, light_ray shadow, ray_doubts doubts,
                    inout hit_record hit, inout uint iterations) {
    ray_start start = shadow_start;
    exact_aim aim = aim_along(p.direction);
    if (own)
        start = p.start;
    else
        aim = aim_at(p.light, shadow);
    return retrace_triangles(start, aim, doubts, !own && !shines(), hit, iterations);
}

// From a surface: to its next light, or on along the path.
uint go_on(uint slot, inout path_state p, surface s, ray_start start, inout uint phase, inout light_ray shadow,
           inout uint iterations, inout uint fault) {
    uint state = GOES_ON;
    phase = PHASE_SHADOW;
    bool found = find_light(p, s, start, shadow, iterations);
    if (!found && p.light < light_end()) {
        fault = FAULT_ITERATIONS << FAULT_KIND_SHIFT;
        state = HAS_SLICES ? SUSPENDED : STOPPED;
    } else if (!found) {
        phase = PHASE_RAY;
        state = leave_surface(slot, p, s, start);
    }
    if (HAS_CLEAR_SHADOWS && found && p.shine.goes_on)
        shadow.direction = shine_direction(p.shine, load_light(p.light), shadow);
    return state;
}

// Where a ray starts: the path's own; a shadow ray at the surface, or behind what its light shines through.
ray_start ray_from(path_state p, bool own, ray_start start) {
    if (HAS_CLEAR_SHADOWS && p.shine.goes_on)
        start = p.shine.start;
    if (own)
        start = p.start;
    return start;
}

// The media on both sides of a surface that the path's ray reached, and the light left.
uint come_to_surface(inout path_state p, bool arrives, inout surface s) {
    REAL way = p.hit.t;
    if (HAS_MEDIA || HAS_FRESNEL)
        cross_surface(p.inside, p.hit, s);
    count_unseen(s);
    if (HAS_ATTENUATION && arrives && wants(FEATURE_ATTENUATION))
        p.tint *= media_left(p.inside, way);
    if (HAS_MEDIA && s.is_over) {
        p.radiance = vec3(uintBitsToFloat(0x7fc00000u));
        p.hit.number = FAULT_NESTED;
    }
    return HAS_MEDIA && s.is_over ? STOPPED : GOES_ON;
}

// Goes straight on behind a surface that nobody sees.
void pass_surface(inout path_state p, surface s) {
    p.start = leave(s, p.hit, -s.geometric);
    p.inside = s.after;
    if (HAS_FOOTPRINT)
        p.cone.x = s.width;
    p.hit.item = NO_ITEM;
}

// Takes in what a phase's ray has hit. Unless that was a shadow ray, also makes the surface that the path is at, and finds
// where shadow rays start there. In PHASE_HIT there was no ray, and the surface is made again.
uint arrive(inout path_state p, uint phase, hit_record hit, light_ray shadow, inout surface s, inout ray_start start) {
    uint state = GOES_ON;
    if (phase == PHASE_RAY)
        state = take_hit(p, hit);
    if (HAS_SEEN_LIGHT && phase == PHASE_RAY)
        state = take_seen(p, hit.t, state);
    if (phase == PHASE_SHADOW)
        take_light(p, start, hit, shadow);
    if (state == GOES_ON && phase != PHASE_SHADOW) {
        if (HAS_FOOTPRINT)
            surface_cone = p.cone;
        make_surface(p.hit, p.start.at, p.direction, s);
        state = come_to_surface(p, phase == PHASE_RAY, s);
        taint(p, true, s.point + s.shading, 0.0);
        if ((HAS_AMBIENT || HAS_EMISSION) && phase == PHASE_RAY)
            p.light_sum = own_light(s);
        start = leave(s, p.hit, s.geometric);
    }
    return state;
}

// Continues after a wanted ray, or from a surface that was found before.
uint arrive_and_go_on(uint slot, inout path_state p, bool wanted, hit_record hit, inout surface s, inout ray_start start,
                      inout uint phase, inout light_ray shadow, inout uint iterations, inout bool fresh,
                      inout uint fault) {
    uint state = GOES_ON;
    if (wanted)
        state = after_ray(p, iterations, fresh, fault);
    bool counts = wanted && state == GOES_ON;
    uint unseen = counted_unseen;
    if (state == GOES_ON)
        state = arrive(p, phase, hit, shadow, s, start);
    if (counts && counted_unseen == unseen)
        count_ray(p, phase == PHASE_RAY);
    bool passes = HAS_MEDIA && state == GOES_ON && s.passes && phase != PHASE_SHADOW;
    if (passes) {
        pass_surface(p, s);
        phase = PHASE_RAY;
    }
    if (state == GOES_ON && !passes)
        state = go_on(slot, p, s, start, phase, shadow, iterations, fault);
    return state;
}

// Ends a chain of rays: looks up its background, and takes a waiting refracted ray.
void end_chain(uint slot, inout path_state p, inout uint state, inout uint phase) {
    if (state == MISSED)
        p.radiance += tinted(p, seen_beyond(p.direction));
    if (HAS_BRANCHES && (state == MISSED || state == ENDED) && p.stack_size > 0u) {
        pop_branch(slot, p);
        state = GOES_ON;
        phase = PHASE_RAY;
    }
}

#ifdef FETCH_TEXELS
#include "follow_later.glsl"
#else
#include "follow_now.glsl"
#endif

layout(constant_id = CONSTANT_LISTED) const bool LISTED = false;

// Where in its pixel a sample is taken: at the same place in every pixel. Only pixels that end by their error (LISTED) have
// places of their own, because none of them would notice an error that all of them share.
vec2 offset_in_pixel(uint sample_number) {
    vec2 offset = vec2(dispatch.offset_x, dispatch.offset_y);
#ifndef FETCH_TEXELS
    if (AT_ONCE)
        offset = sample_offset(sample_number);
#endif
    if (LISTED)
        offset = point_at(point_key(point_root(point_pixel.x, point_pixel.y), POINT_PIXEL));
    return offset;
}

// Whether an invocation has a path, and its index: of those that begin, or in the list of saved ones.
bool has_path(bool resumes, inout uint index) {
    uint end = dispatch.path_end;
    bool chosen = true;
#ifndef FETCH_TEXELS
    uint spread = dispatch.spread;
    if (AT_ONCE && resumes && dispatch.resume == RESUME_COUNTED)
        end = count_saved(spread);
    if (spread > OPAQUE_ZERO) {
        chosen = index % spread == 0u;
        index /= spread;
    }
#endif
    index += dispatch.path_begin;
    return chosen && index < end;
}

void main() {
    uint group = gl_WorkGroupID.y * dispatch.grid_width + gl_WorkGroupID.x;
    uint index = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    bool resumes = HAS_SLICES && !BEGINS && dispatch.resume > OPAQUE_ZERO;
    if (!has_path(resumes, index))
        return;
    uint place = resumes ? counters[COUNTER_COUNT + dispatch.read_list * dispatch.places + index] : index;
    if (LISTED && !resumes)
        place = counters[COUNTER_COUNT + 2u * dispatch.places + index];
    uint path = place, slot = place;
    uint sample_number = 0u;
#ifndef FETCH_TEXELS
    if (AT_ONCE) {
        if (resumes)
            path = saved_number(place);
        else if (dispatch.restarts > OPAQUE_ZERO)
            path = counters[COUNTER_COUNT + 2u * dispatch.places + index];
        else
            path = path_of(index, dispatch.tile_count * TILE_PIXELS);
        slot = path % (dispatch.tile_count * TILE_PIXELS);
        sample_number = path / (dispatch.tile_count * TILE_PIXELS);
    }
    uvec2 pixel = AT_ONCE ? pixel_in_order(slot) : pixel_of_slot(slot);
#else
    uvec2 pixel = pixel_of_slot(slot);
#endif
    if (pixel.x >= frame.width || pixel.y >= frame.height)
        return;
    pixel = pixel_of_whole(pixel);
    point_pixel = pixel;
    point_sample = dispatch.first_sample + sample_number;
    path_state p;
    long_slot = slot;
    if (HAS_LONG_RAYS && resumes)
        load_long_ray();
    if (resumes) {
        p = load_path(place);
        if (AT_ONCE)
            load_waiting(place, p.stack_size);
    } else {
        p = begin_path(camera_ray_at(pixel, offset_in_pixel(sample_number)));
    }
    uint fault = FAULT_NONE;
    uint state = follow(slot, p, fault);
    bool saved = HAS_SLICES && state == SUSPENDED, kept = true;
    if (saved)
        kept = save_path(resumes, place, path, p);
    else
        write_sample(path, p, state == STOPPED ? fault : FAULT_NONE);
    if (HAS_COUNTERS && kept)
        add_counts(group);
}
