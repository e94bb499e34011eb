// Rays that need more iterations than a slice has: if thousands of bodies contain each other, a ray visits all
// of their boxes. Such a ray is saved in the middle of a tree, with the groups that wait, and goes on in the
// next slice. Compiled in only after a scene was found to have one (tracer/render/render_frame.c).

const bool HAS_LONG_RAYS = (FEATURES & FEATURE_LONG_RAYS) != 0u;

const uint TREE_NONE = 0u;
const uint TREE_SPHERES = 1u;
const uint TREE_TRIANGLES = 2u;

#ifdef DOUBLE_PRECISION
const uint LOW_WORD = STATE64_WORDS;
#else
const uint LOW_WORD = STATE_WORDS;
#endif
const uint CONE_WORD = LOW_WORD + (HAS_MANY_LIGHTS ? 1u : 0u) + CARRIED_WORDS +
                        (HAS_CLEAR_SHADOWS ? SHINE_WORDS : 0u);
const uint KEY_WORD = CONE_WORD + (HAS_FOOTPRINT ? 1u : 0u);
const uint PATH_WORDS = KEY_WORD + (HAS_POINTS ? KEY_WORDS : 0u);
// Words of a slot after those of its path: which tree and instance, group, number of what was hit; t, b1; b2, item, size of
// the stack; what a search of triangles knows of its errors; then two entries of the stack a word.
const uint LONG_STACK_WORD = LONG_RAY_WORDS;
const uint LONG_LEVELS = TRIANGLE_STACK > SPHERE_STACK ? TRIANGLE_STACK : SPHERE_STACK;
const uint LONG_WORDS = HAS_LONG_RAYS ? LONG_STACK_WORD + (LONG_LEVELS + 1u) / 2u : 0u;

// This invocation's: the tree in which its ray stopped in the previous slice, until it resumes there; and the
// tree in which it has stopped now.
uint long_slot = 0u, long_tree = TREE_NONE, long_stopped = TREE_NONE;
bool long_resumes = false; // the current ray is the one that stopped
uvec2 long_group = uvec2(0u);
uint long_size = 0u;
#ifdef INSTANCES
#define LONG_RAYS_KEPT
uint long_instance = 0u; // of the group, if it lies below an instance
#else
const uint long_instance = 0u;
#endif

uint long_word(uint k) { return (PATH_WORDS + k) * dispatch.places + long_slot; }

uvec2 long_entry(uint level) {
    uvec4 both = states[long_word(LONG_STACK_WORD + level / 2u)];
    return (level & 1u) == 0u ? both.xy : both.zw;
}

void put_long_entry(uint level, uvec2 entry) {
    uint at = long_word(LONG_STACK_WORD + level / 2u);
    uvec4 both = states[at];
    states[at] = (level & 1u) == 0u ? uvec4(entry, both.zw) : uvec4(both.xy, entry);
}

// A slice ends at a node: the work of one node fits between the two limits.
uint long_limit() { return min(frame.slice_iterations, SLICE_ITERATIONS); }
#define TRAVERSAL_LIMIT (HAS_LONG_RAYS ? long_limit() : ITERATION_LIMIT)

#define STACK_RESUME(levels, tree, group)                                                                    \
    if (HAS_LONG_RAYS && long_resumes && long_tree == tree) {                                                \
        group = long_group;                                                                                  \
        for (uint i = 0u; i < levels; i++) {                                                                 \
            uvec2 entry = long_entry(i);                                                                     \
            STACK_PUT(i, entry)                                                                              \
        }                                                                                                    \
        STACK_TAKE_SIZE                                                                                      \
    }
#define STACK_SUSPEND(levels, tree, group, more)                                                             \
    if (HAS_LONG_RAYS && more) {                                                                             \
        long_stopped = tree;                                                                                 \
        long_group = group;                                                                                  \
        for (uint i = 0u; i < levels; i++)                                                                   \
            put_long_entry(i, STACK_GET(i));                                                                 \
        STACK_KEEP_SIZE                                                                                      \
    }
// State of the search that stopped (triangles.glsl).
REAL long_wrong = 0.0, long_doubt = 0.0;
#define LONG_TAKE(wrong, doubt)                                                                              \
    if (HAS_LONG_RAYS && long_resumes && long_tree == TREE_TRIANGLES) {                                      \
        wrong = long_wrong;                                                                                  \
        doubt = long_doubt;                                                                                  \
    }
#define LONG_KEEP(wrong, doubt)                                                                              \
    if (HAS_LONG_RAYS) {                                                                                     \
        long_wrong = wrong;                                                                                  \
        long_doubt = doubt;                                                                                  \
    }
