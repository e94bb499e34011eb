// Many samples of many pixels traced at once, for GPUs: path k * slots + s is sample k of slot s. A path lives in private
// memory, with its waiting refracted rays, and takes a place in the state buffer only when its slice ends. If all places
// are taken, the path starts again in a later dispatch.
//
// The samples of a tile follow each other, and the host chooses the order of tiles: long paths should start first,
// because the last ones leave a GPU idle.

layout(constant_id = CONSTANT_AT_ONCE) const bool AT_ONCE = false;
layout(constant_id = CONSTANT_BRANCHES) const uint BRANCHES = 1u;

layout(set = 0, binding = BINDING_SAMPLES, std140) uniform sample_block {
    vec4 offsets[SAMPLES_AT_ONCE / 2]; // two samples each
} sample_places;

#include "picture.glsl"

vec2 sample_offset(uint k) {
    vec4 both = sample_places.offsets[k / 2u];
    return (k & 1u) == 0u ? both.xy : both.zw;
}

// Where the saved paths that go on with RESUME_COUNTED end. `spread`: as far apart as there are invocations for
// them.
uint count_saved(inout uint spread) {
    uint saved = counters[COUNTER_PENDING + dispatch.read_list] - dispatch.read_base;
    while (spread > 1u && saved > dispatch.path_end / spread)
        spread /= 2u;
    return min(saved, dispatch.path_end);
}

// The path that an invocation starts.
uint path_of(uint index, uint slots) {
    uint samples = max(dispatch.samples, 1u), block = index / TILE_PIXELS;
    return block % samples * slots + block / samples * TILE_PIXELS + index % TILE_PIXELS;
}

struct waiting_ray {
    ray_start start;
    REAL3 direction;
    float throughput;
    uint depth;
};
waiting_ray waiting[BRANCHES];

// With HAS_FOOTPRINT. Not in the struct of the rays: there it would cost kernels that never read it 40 registers on a GPU.
const uint CONE_BRANCHES = HAS_FOOTPRINT ? BRANCHES : 1u;
RAY_CONE waiting_cones[CONE_BRANCHES];

// Of each of them.
struct waiting_medium {
    media_set inside;
    vec3 tint;
};
const uint MEDIA_BRANCHES = CARRIES ? BRANCHES : 1u;
waiting_medium waiting_media[MEDIA_BRANCHES];

const uint KEY_BRANCHES = HAS_POINTS ? BRANCHES : 1u;
uint waiting_keys[KEY_BRANCHES];

void take_waiting(inout path_state p) {
    waiting_ray ray = waiting[p.stack_size];
    p.start = ray.start;
    p.direction = ray.direction;
    if (HAS_FOOTPRINT)
        p.cone = waiting_cones[p.stack_size];
    p.throughput = ray.throughput;
    p.depth = ray.depth;
    if (CARRIES) {
        p.inside = waiting_media[p.stack_size].inside;
        p.tint = waiting_media[p.stack_size].tint;
    }
    if (HAS_POINTS)
        p.key = waiting_keys[p.stack_size];
}

void save_waiting(uint place, uint count) {
    for (uint i = 0u; i < count; i++) {
        uint word = BRANCHES_WORD + BRANCH_WORDS * i;
        put_branch(place, word, waiting[i].start, waiting[i].direction, waiting_cones[HAS_FOOTPRINT ? i : 0u],
                   waiting[i].throughput, waiting[i].depth);
        if (CARRIES)
            put_media(place, word + BRANCH_WORDS - CARRIED_WORDS, waiting_media[i].inside, waiting_media[i].tint);
        if (HAS_POINTS)
            put_key(place, word + BRANCH_WORDS - MORE_BRANCH_WORDS, waiting_keys[i]);
    }
}

void load_waiting(uint place, uint count) {
    for (uint i = 0u; i < count; i++) {
        path_state p;
        get_branch(place, BRANCHES_WORD + BRANCH_WORDS * i, p);
        waiting[i] = waiting_ray(p.start, p.direction, p.throughput, p.depth);
        if (HAS_FOOTPRINT)
            waiting_cones[i] = p.cone;
        if (CARRIES) {
            get_media(place, BRANCHES_WORD + BRANCH_WORDS * (i + 1u) - CARRIED_WORDS, p);
            waiting_media[i] = waiting_medium(p.inside, p.tint);
        }
        if (HAS_POINTS)
            waiting_keys[i] = get_key(place, BRANCHES_WORD + BRANCH_WORDS * (i + 1u) - MORE_BRANCH_WORDS);
    }
}

// A place for a path to be saved; NO_PLACE if none is left: then the path is listed to start again.
uint at_once_place(bool resumes, uint place, uint path) {
    if (resumes)
        return place;
    uint taken = atomicAdd(counters[COUNTER_PLACES], 1u) - dispatch.place_base;
    if (taken < dispatch.places)
        return taken;
    uint entry = atomicAdd(counters[COUNTER_RESTARTS], 1u) - dispatch.restart_base;
    counters[COUNTER_COUNT + 2u * dispatch.places + entry] = path;
    return NO_PLACE;
}
