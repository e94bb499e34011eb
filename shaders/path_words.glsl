// How a path, with its waiting refracted rays, is stored between dispatches.

const uint NO_PLACE = 0xffffffffu;
const uint BRANCHES_WORD = PATH_WORDS + LONG_WORDS; // the first of those rays

// Words are ordered by kind first, then by place, so that neighbours are adjacent. A place is a slot, unless samples are
// traced at once (at_once.glsl): then only saved paths have a place.
uint state_word(uint place, uint word) { return word * dispatch.places + place; }

// ---- what a path is inside, and what its waiting refracted rays are inside

const uint MEDIA_WORD = LOW_WORD + (HAS_MANY_LIGHTS ? 1u : 0u);
const uint SHINE_WORD = MEDIA_WORD + CARRIED_WORDS;
const uint KEY_BRANCH_WORDS = HAS_POINTS ? KEY_WORDS : 0u;
const uint MORE_BRANCH_WORDS = KEY_BRANCH_WORDS + CARRIED_WORDS;

void put_media(uint slot, uint word, media_set inside, vec3 tint) {
    if (HAS_MEDIA) {
        states[state_word(slot, word)] = inside.a;
        states[state_word(slot, word + 1u)] = inside.b;
    }
    states[state_word(slot, word + CARRIED_WORDS - 1u)] = uvec4(floatBitsToUint(tint), 0u);
}

void get_media(uint slot, uint word, inout path_state p) {
    if (HAS_MEDIA)
        p.inside = media_set(states[state_word(slot, word)], states[state_word(slot, word + 1u)]);
    p.tint = uintBitsToFloat(states[state_word(slot, word + CARRIED_WORDS - 1u)].xyz);
}

// Numbers of the kernel's precision, two to a word.
uvec4 two_reals(REAL a, REAL b) { return uvec4(bits_of(a), bits_of(b)); }

void put_shine(uint slot, shining way) {
    ray_start start = way.start;
    states[state_word(slot, SHINE_WORD)] = way.inside.a;
    states[state_word(slot, SHINE_WORD + 1u)] = way.inside.b;
    states[state_word(slot, SHINE_WORD + 2u)] = uvec4(floatBitsToUint(way.left), way.goes_on ? 1u : 0u);
    states[state_word(slot, SHINE_WORD + 3u)] = two_reals(start.at.x, start.at.y);
    states[state_word(slot, SHINE_WORD + 4u)] = two_reals(start.at.z, start.slack);
    states[state_word(slot, SHINE_WORD + 5u)] = two_reals(start.b1, start.b2);
    states[state_word(slot, SHINE_WORD + 6u)] = uvec4(start.left, 0u, 0u, 0u);
}

shining get_shine(uint slot) {
    uvec4 left = states[state_word(slot, SHINE_WORD + 2u)];
    uvec4 c = states[state_word(slot, SHINE_WORD + 3u)], d = states[state_word(slot, SHINE_WORD + 4u)];
    uvec4 e = states[state_word(slot, SHINE_WORD + 5u)];
    ray_start start = ray_start(REAL3(number_of(c.xy), number_of(c.zw), number_of(d.xy)), number_of(d.zw),
                                states[state_word(slot, SHINE_WORD + 6u)].x, number_of(e.xy), number_of(e.zw));
    media_set inside = media_set(states[state_word(slot, SHINE_WORD)], states[state_word(slot, SHINE_WORD + 1u)]);
    return shining(left.w != 0u, start, uintBitsToFloat(left.xyz), inside);
}

void put_path_media(uint slot, path_state p) {
    if (CARRIES)
        put_media(slot, MEDIA_WORD, p.inside, p.tint);
    if (HAS_CLEAR_SHADOWS)
        put_shine(slot, p.shine);
}

void get_path_media(uint slot, inout path_state p) {
    p.tint = vec3(1.0);
    p.shine.goes_on = false;
    if (CARRIES)
        get_media(slot, MEDIA_WORD, p);
    if (HAS_CLEAR_SHADOWS)
        p.shine = get_shine(slot);
}

// ---- the key of its points, and those of its waiting refracted rays

void put_key(uint slot, uint word, uint key) {
    if (HAS_POINTS)
        states[state_word(slot, word)] = uvec4(key, 0u, 0u, 0u);
}

uint get_key(uint slot, uint word) {
    uint key = 0u;
    if (HAS_POINTS)
        key = states[state_word(slot, word)].x;
    return key;
}

// ---- the rest of it

vec3 get_low(uint slot) {
    vec3 low = vec3(0.0);
    if (HAS_MANY_LIGHTS)
        low = uintBitsToFloat(states[state_word(slot, LOW_WORD)].xyz);
    return low;
}

// With HAS_FOOTPRINT, in a word of their own.
void put_cone(uint slot, uint word, RAY_CONE cone) {
    if (HAS_FOOTPRINT)
        states[state_word(slot, word)] = uvec4(bits_of(cone.x), bits_of(cone.y));
}
RAY_CONE get_cone(uint slot, uint word) {
    RAY_CONE cone = REAL2(0.0);
    if (HAS_FOOTPRINT)
        cone = REAL2(number_of(states[state_word(slot, word)].xy), number_of(states[state_word(slot, word)].zw));
    return cone;
}

#ifdef DOUBLE_PRECISION
const uint BRANCH_WORDS = STACK64_ENTRY_WORDS + (HAS_FOOTPRINT ? 1u : 0u) + MORE_BRANCH_WORDS;

// Two numbers in a word, the third in the next with two more components.
void put_real3(uint slot, uint word, dvec3 v, uvec2 more) {
    states[state_word(slot, word)] = uvec4(unpackDouble2x32(v.x), unpackDouble2x32(v.y));
    states[state_word(slot, word + 1u)] = uvec4(unpackDouble2x32(v.z), more);
}
dvec3 get_real3(uint slot, uint word, out uvec2 more) {
    uvec4 a = states[state_word(slot, word)], b = states[state_word(slot, word + 1u)];
    more = b.zw;
    return double3_of(a, b.xy);
}

void put_path(uint slot, path_state p, uint number) {
    put_cone(slot, CONE_WORD, p.cone);
    put_real3(slot, 0u, p.start.at, uvec2(floatBitsToUint(p.throughput), p.depth));
    put_real3(slot, 2u, p.direction, uvec2(p.stack_size, p.kind));
    states[state_word(slot, 4u)] = uvec4(floatBitsToUint(p.radiance), p.segments);
    states[state_word(slot, 5u)] = uvec4(floatBitsToUint(p.light_sum), p.light);
    put_real3(slot, 6u, dvec3(p.hit.t, p.hit.b1, p.hit.b2), uvec2(p.hit.item, p.hit.number));
    put_real3(slot, 8u, dvec3(p.start.slack, p.start.b1, p.start.b2), uvec2(p.start.left, number));
}

uint saved_number(uint slot) { return states[state_word(slot, 9u)].w; }

path_state load_path(uint slot) {
    path_state p;
    uvec2 a, b, c, d;
    dvec3 at = get_real3(slot, 0u, a);
    p.direction = get_real3(slot, 2u, b);
    uvec4 w4 = states[state_word(slot, 4u)], w5 = states[state_word(slot, 5u)];
    dvec3 hit = get_real3(slot, 6u, c), left = get_real3(slot, 8u, d);
    p.start = ray_start(at, left.x, d.x, left.y, left.z);
    p.throughput = uintBitsToFloat(a.x);
    p.depth = a.y;
    p.stack_size = b.x;
    p.kind = b.y;
    p.radiance = uintBitsToFloat(w4.xyz);
    p.segments = w4.w;
    p.light_sum = uintBitsToFloat(w5.xyz);
    p.light_low = get_low(slot);
    p.cone = get_cone(slot, CONE_WORD);
    p.light = w5.w;
    p.hit = hit_record(hit.x, hit.y, hit.z, c.x, c.y);
    get_path_media(slot, p);
    p.key = get_key(slot, KEY_WORD);
    return p;
}

void put_branch(uint slot, uint word, ray_start start, dvec3 direction, RAY_CONE cone, float throughput,
                uint depth) {
    put_cone(slot, word + STACK64_ENTRY_WORDS, cone);
    put_real3(slot, word, start.at, uvec2(floatBitsToUint(throughput), depth));
    put_real3(slot, word + 2u, direction, uvec2(0u));
    put_real3(slot, word + 4u, dvec3(start.slack, start.b1, start.b2), uvec2(start.left, 0u));
}

void get_branch(uint slot, uint word, inout path_state p) {
    p.cone = get_cone(slot, word + STACK64_ENTRY_WORDS);
    uvec2 more, none, left;
    dvec3 at = get_real3(slot, word, more);
    p.direction = get_real3(slot, word + 2u, none);
    dvec3 place = get_real3(slot, word + 4u, left);
    p.start = ray_start(at, place.x, left.x, place.y, place.z);
    p.throughput = uintBitsToFloat(more.x);
    p.depth = more.y;
}
#else
const uint BRANCH_WORDS = STACK_ENTRY_WORDS + (HAS_FOOTPRINT ? 1u : 0u) + MORE_BRANCH_WORDS;

uvec4 left_word(ray_start start) {
    return uvec4(floatBitsToUint(vec3(start.slack, start.b1, start.b2)), start.left);
}
ray_start start_of(uvec4 at, uvec4 left) {
    vec3 place = uintBitsToFloat(left.xyz);
    return ray_start(uintBitsToFloat(at.xyz), place.x, left.w, place.y, place.z);
}

void put_path(uint slot, path_state p, uint number) {
    put_cone(slot, CONE_WORD, p.cone);
    states[state_word(slot, 0u)] = uvec4(floatBitsToUint(p.start.at), floatBitsToUint(p.throughput));
    states[state_word(slot, 1u)] = uvec4(floatBitsToUint(p.direction), p.depth);
    states[state_word(slot, 2u)] = uvec4(floatBitsToUint(p.radiance), p.segments);
    states[state_word(slot, 3u)] = uvec4(floatBitsToUint(p.light_sum), p.light);
    states[state_word(slot, 4u)] = uvec4(floatBitsToUint(vec3(p.hit.t, p.hit.b1, p.hit.b2)), p.hit.item);
    states[state_word(slot, 5u)] = uvec4(p.hit.number, p.stack_size, p.kind, number);
    states[state_word(slot, 6u)] = left_word(p.start);
}

uint saved_number(uint slot) { return states[state_word(slot, 5u)].w; }

path_state load_path(uint slot) {
    path_state p;
    uvec4 w0 = states[state_word(slot, 0u)], w1 = states[state_word(slot, 1u)];
    uvec4 w2 = states[state_word(slot, 2u)], w3 = states[state_word(slot, 3u)];
    uvec4 w4 = states[state_word(slot, 4u)], w5 = states[state_word(slot, 5u)];
    p.start = start_of(w0, states[state_word(slot, 6u)]);
    p.throughput = uintBitsToFloat(w0.w);
    p.direction = uintBitsToFloat(w1.xyz);
    p.depth = w1.w;
    p.radiance = uintBitsToFloat(w2.xyz);
    p.segments = w2.w;
    p.light_sum = uintBitsToFloat(w3.xyz);
    p.light_low = get_low(slot);
    p.cone = get_cone(slot, CONE_WORD);
    p.light = w3.w;
    p.hit = hit_record(uintBitsToFloat(w4.x), uintBitsToFloat(w4.y), uintBitsToFloat(w4.z), w4.w, w5.x);
    p.stack_size = w5.y;
    p.kind = w5.z;
    get_path_media(slot, p);
    p.key = get_key(slot, KEY_WORD);
    return p;
}

void put_branch(uint slot, uint word, ray_start start, vec3 direction, RAY_CONE cone, float throughput,
                uint depth) {
    put_cone(slot, word + STACK_ENTRY_WORDS, cone);
    states[state_word(slot, word)] = uvec4(floatBitsToUint(start.at), floatBitsToUint(throughput));
    states[state_word(slot, word + 1u)] = uvec4(floatBitsToUint(direction), depth);
    states[state_word(slot, word + 2u)] = left_word(start);
}

void get_branch(uint slot, uint word, inout path_state p) {
    p.cone = get_cone(slot, word + STACK_ENTRY_WORDS);
    uvec4 a = states[state_word(slot, word)], b = states[state_word(slot, word + 1u)];
    p.start = start_of(a, states[state_word(slot, word + 2u)]);
    p.throughput = uintBitsToFloat(a.w);
    p.direction = uintBitsToFloat(b.xyz);
    p.depth = b.w;
}
#endif

// The ray that stopped in the middle of a tree, and what it has hit so far.
void put_long_ray(hit_record hit) {
    states[long_word(0u)] = uvec4(long_stopped | long_instance << 2u, long_group, hit.number);
    states[long_word(1u)] = uvec4(bits_of(hit.t), bits_of(hit.b1));
    states[long_word(2u)] = uvec4(bits_of(hit.b2), hit.item, long_size);
    states[long_word(3u)] = uvec4(bits_of(long_wrong), bits_of(long_doubt));
}

void load_long_ray() {
    uvec4 a = states[long_word(0u)];
    long_tree = a.x & 3u;
#ifdef INSTANCES
    long_instance = a.x >> 2u;
#endif
    long_group = a.yz;
    long_size = states[long_word(2u)].w;
    uvec4 d = states[long_word(3u)];
    long_wrong = number_of(d.xy);
    long_doubt = number_of(d.zw);
}

hit_record long_hit() {
    uvec4 a = states[long_word(1u)], b = states[long_word(2u)];
    return hit_record(number_of(a.xy), number_of(a.zw), number_of(b.xy), b.z, states[long_word(0u)].w);
}

#ifndef FETCH_TEXELS
#include "at_once.glsl"
#else
// lavapipe accesses an indexed private array for all lanes, but a storage buffer only for active ones: waiting refracted
// rays are always in this buffer.
const bool AT_ONCE = false;
uint at_once_place(bool resumes, uint place, uint path) { return place; }
void save_waiting(uint place, uint count) {}
void load_waiting(uint place, uint count) {}
#endif

// Saves a path; `place` is its own if it was saved before. false: there was no place, and the path starts again.
bool save_path(bool resumes, uint place, uint path, path_state p) {
    if (AT_ONCE)
        place = at_once_place(resumes, place, path);
    if (AT_ONCE && place == NO_PLACE)
        return false;
    put_path(place, p, AT_ONCE ? path : 0u);
    put_path_media(place, p);
    put_key(place, KEY_WORD, p.key);
    if (AT_ONCE)
        save_waiting(place, p.stack_size);
    if (HAS_MANY_LIGHTS)
        states[state_word(place, LOW_WORD)] = uvec4(floatBitsToUint(p.light_low), 0u);
    if (HAS_LONG_RAYS && long_stopped == TREE_NONE)
        states[long_word(0u)] = uvec4(long_tree | long_instance << 2u, long_group, states[long_word(0u)].w);
    // Each saved path has an entry in the list that the next dispatch reads. Their order may differ from run
    // to run; the picture does not depend on it.
    uint list = 1u - dispatch.read_list;
    uint entry = atomicAdd(counters[COUNTER_PENDING + list], 1u) - dispatch.pending_base;
    counters[COUNTER_COUNT + list * dispatch.places + entry] = place;
    return true;
}

void push_branch(uint slot, inout path_state p, ray_start start, REAL3 direction, RAY_CONE cone, float throughput,
                 uint depth) {
#ifndef FETCH_TEXELS
    if (AT_ONCE)
        waiting[p.stack_size] = waiting_ray(start, direction, throughput, depth);
    if (AT_ONCE && HAS_FOOTPRINT)
        waiting_cones[p.stack_size] = cone;
    if (AT_ONCE && HAS_POINTS)
        waiting_keys[p.stack_size] = point_key(p.key, POINT_REFRACTED);
#endif
    uint word = BRANCHES_WORD + BRANCH_WORDS * p.stack_size;
    if (!AT_ONCE)
        put_branch(slot, word, start, direction, cone, throughput, depth);
    if (!AT_ONCE)
        put_key(slot, word + BRANCH_WORDS - MORE_BRANCH_WORDS, point_key(p.key, POINT_REFRACTED));
    p.stack_size++;
}

// The media and the tint of the ray that was pushed last.
void push_media(uint slot, path_state p, media_set inside) {
    uint word = BRANCHES_WORD + BRANCH_WORDS * p.stack_size - CARRIED_WORDS;
#ifndef FETCH_TEXELS
    if (AT_ONCE)
        waiting_media[p.stack_size - 1u] = waiting_medium(inside, p.tint);
#endif
    if (!AT_ONCE)
        put_media(slot, word, inside, p.tint);
}

void pop_branch(uint slot, inout path_state p) {
    p.stack_size--;
#ifndef FETCH_TEXELS
    if (AT_ONCE)
        take_waiting(p);
#endif
    if (!AT_ONCE)
        get_branch(slot, BRANCHES_WORD + BRANCH_WORDS * p.stack_size, p);
    if (CARRIES && !AT_ONCE)
        get_media(slot, BRANCHES_WORD + BRANCH_WORDS * (p.stack_size + 1u) - CARRIED_WORDS, p);
    if (HAS_POINTS && !AT_ONCE)
        p.key = get_key(slot, BRANCHES_WORD + BRANCH_WORDS * (p.stack_size + 1u) - MORE_BRANCH_WORDS);
    p.kind = RAY_REFRACTED;
}
