// The state of one sample's path, and how it is kept from one dispatch to the next.

const uint RAY_PRIMARY = 0u;
const uint RAY_REFLECTED = 1u;
const uint RAY_REFRACTED = 2u;

struct path_state {
    vec3 origin, direction;
    float weight;
    uint depth; // max_depth + 1: only sees the background
    uint kind;
    vec3 radiance; // of what is done
    uint segments; // rays traced
    hit_record hit; // NO_ITEM: the ray is still to be traced; else its lights from `light` on
    uint light;
    vec3 light_sum; // over the lights before
    uint stack_size;
};

// Words lie by kind first, then by slot, so that neighbours lie together. The refracted rays that wait
// until the reflected ones before them are done are there from the start: lavapipe writes and reads an
// indexed private array for all lanes, and a storage buffer only for those that want it.
uint state_word(uint slot, uint word) { return word * (dispatch.tile_count * TILE_PIXELS) + slot; }

void save_path(uint slot, path_state p) {
    states[state_word(slot, 0u)] = uvec4(floatBitsToUint(p.origin), floatBitsToUint(p.weight));
    states[state_word(slot, 1u)] = uvec4(floatBitsToUint(p.direction), p.depth);
    states[state_word(slot, 2u)] = uvec4(floatBitsToUint(p.radiance), p.segments);
    states[state_word(slot, 3u)] = uvec4(floatBitsToUint(p.light_sum), p.light);
    states[state_word(slot, 4u)] = uvec4(floatBitsToUint(vec3(p.hit.t, p.hit.b1, p.hit.b2)), p.hit.item);
    states[state_word(slot, 5u)] = uvec4(p.hit.number, p.stack_size, p.kind, 0u);
    // Each saved path takes a place in the list that the next dispatch reads. Their order may differ from
    // run to run; the picture does not know it.
    uint slots = dispatch.tile_count * TILE_PIXELS;
    uint place = atomicAdd(counters[COUNTER_PENDING], 1u) - dispatch.pending_base;
    counters[COUNTER_COUNT + (1u - dispatch.read_list) * slots + place] = slot;
}

path_state load_path(uint slot) {
    path_state p;
    uvec4 w0 = states[state_word(slot, 0u)], w1 = states[state_word(slot, 1u)];
    uvec4 w2 = states[state_word(slot, 2u)], w3 = states[state_word(slot, 3u)];
    uvec4 w4 = states[state_word(slot, 4u)], w5 = states[state_word(slot, 5u)];
    p.origin = uintBitsToFloat(w0.xyz);
    p.weight = uintBitsToFloat(w0.w);
    p.direction = uintBitsToFloat(w1.xyz);
    p.depth = w1.w;
    p.radiance = uintBitsToFloat(w2.xyz);
    p.segments = w2.w;
    p.light_sum = uintBitsToFloat(w3.xyz);
    p.light = w3.w;
    p.hit = hit_record(uintBitsToFloat(w4.x), uintBitsToFloat(w4.y), uintBitsToFloat(w4.z), w4.w, w5.x);
    p.stack_size = w5.y;
    p.kind = w5.z;
    return p;
}

path_state begin_path(vec3 direction) {
    path_state p;
    p.origin = frame.camera_position;
    p.direction = direction;
    p.weight = 1.0;
    p.depth = 0u;
    p.kind = RAY_PRIMARY;
    p.radiance = vec3(0.0);
    p.segments = 0u;
    p.hit = hit_record(FAR_AWAY, 0.0, 0.0, NO_ITEM, FAULT_NUMBER);
    p.light = 0u;
    p.light_sum = vec3(0.0);
    p.stack_size = 0u;
    return p;
}

void push_branch(uint slot, inout path_state p, vec3 origin, vec3 direction, float weight, uint depth) {
    uint word = STATE_WORDS + STACK_ENTRY_WORDS * p.stack_size;
    states[state_word(slot, word)] = uvec4(floatBitsToUint(origin), floatBitsToUint(weight));
    states[state_word(slot, word + 1u)] = uvec4(floatBitsToUint(direction), depth);
    p.stack_size++;
}

void pop_branch(uint slot, inout path_state p) {
    p.stack_size--;
    uint word = STATE_WORDS + STACK_ENTRY_WORDS * p.stack_size;
    uvec4 a = states[state_word(slot, word)], b = states[state_word(slot, word + 1u)];
    p.origin = uintBitsToFloat(a.xyz);
    p.weight = uintBitsToFloat(a.w);
    p.direction = uintBitsToFloat(b.xyz);
    p.depth = b.w;
    p.kind = RAY_REFRACTED;
}
