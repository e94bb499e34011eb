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

struct branch {
    vec3 origin, direction;
    float weight;
    uint depth;
};

// Refracted rays that wait until the reflected ones before them are done.
const uint BRANCH_ENTRIES = HAS_BRANCHES ? PATH_STACK : 1u;
uvec4 branch_stack_a[BRANCH_ENTRIES];
uvec4 branch_stack_b[BRANCH_ENTRIES];

uint state_base(uint slot) {
    return slot * (STATE_WORDS + (HAS_BRANCHES ? PATH_STACK * STACK_ENTRY_WORDS : 0u));
}

void save_path(uint slot, path_state p) {
    uint at = state_base(slot);
    states[at] = uvec4(floatBitsToUint(p.origin), floatBitsToUint(p.weight));
    states[at + 1u] = uvec4(floatBitsToUint(p.direction), p.depth);
    states[at + 2u] = uvec4(floatBitsToUint(p.radiance), p.segments);
    states[at + 3u] = uvec4(floatBitsToUint(p.light_sum), p.light);
    states[at + 4u] = uvec4(floatBitsToUint(vec3(p.hit.t, p.hit.b1, p.hit.b2)), p.hit.item);
    states[at + 5u] = uvec4(p.hit.number, p.stack_size, p.kind, 0u);
    if (HAS_BRANCHES)
        for (uint i = 0u; i < p.stack_size; i++) {
            states[at + STATE_WORDS + 2u * i] = branch_stack_a[i];
            states[at + STATE_WORDS + 2u * i + 1u] = branch_stack_b[i];
        }
    // Each saved path takes a place in the list that the next dispatch reads. Their order may differ from
    // run to run; the picture does not know it.
    uint slots = dispatch.tile_count * TILE_PIXELS;
    uint place = atomicAdd(counters[COUNTER_PENDING], 1u) - dispatch.pending_base;
    counters[COUNTER_COUNT + (1u - dispatch.read_list) * slots + place] = slot;
}

path_state load_path(uint slot) {
    path_state p;
    uint at = state_base(slot);
    uvec4 w0 = states[at], w1 = states[at + 1u], w2 = states[at + 2u];
    uvec4 w3 = states[at + 3u], w4 = states[at + 4u], w5 = states[at + 5u];
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
    if (HAS_BRANCHES)
        for (uint i = 0u; i < p.stack_size; i++) {
            branch_stack_a[i] = states[at + STATE_WORDS + 2u * i];
            branch_stack_b[i] = states[at + STATE_WORDS + 2u * i + 1u];
        }
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

void push_branch(inout path_state p, vec3 origin, vec3 direction, float weight, uint depth) {
    branch_stack_a[p.stack_size] = uvec4(floatBitsToUint(origin), floatBitsToUint(weight));
    branch_stack_b[p.stack_size] = uvec4(floatBitsToUint(direction), depth);
    p.stack_size++;
}

void pop_branch(inout path_state p) {
    p.stack_size--;
    uvec4 a = branch_stack_a[p.stack_size], b = branch_stack_b[p.stack_size];
    p.origin = uintBitsToFloat(a.xyz);
    p.weight = uintBitsToFloat(a.w);
    p.direction = uintBitsToFloat(b.xyz);
    p.depth = b.w;
    p.kind = RAY_REFRACTED;
}
